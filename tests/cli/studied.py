# SPDX-License-Identifier: GPL-3.0-or-later
"""Test cases about one small study, which is run once for a class and copied for each test."""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


class Studied(unittest.TestCase):
    study = None  # text of the run file
    options = ()  # of its run

    @classmethod
    def setUpClass(cls):
        if not cls.study:
            return
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.base = pathlib.Path(place.name) / "base"
        cls.base.mkdir()
        (cls.base / "small.yaml").write_text(cls.study)
        subprocess.run([PROGRAM, "run", "small.yaml", "-q", *cls.options], cwd=cls.base, check=True, capture_output=True)

    def setUp(self):
        place = tempfile.TemporaryDirectory()
        self.addCleanup(place.cleanup)
        self.dir = pathlib.Path(place.name) / "work"
        shutil.copytree(self.base, self.dir)

    def call(self, *args, code=0, **more):
        done = subprocess.run([PROGRAM, *map(str, args)], cwd=self.dir, capture_output=True, timeout=600, **more)
        done.stdout, done.stderr = done.stdout.decode(), done.stderr.decode()
        self.assertEqual(done.returncode, code, f"{args}: {done.stdout[-500:]}\n{done.stderr[-500:]}")
        return done
