# SPDX-License-Identifier: GPL-3.0-or-later
"""Test cases that run the program in a directory of their own."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

UNLIKE = ("run.json", "timing.csv")  # between equal runs
RECORD = (0x65736163BEEFCAFE).to_bytes(8, sys.byteorder)  # begins each record of a journal


class Runs(unittest.TestCase):
    program = None
    files = {}  # run files, by name

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.dir = pathlib.Path(temporary.name)
        for name, text in self.files.items():
            (self.dir / name).write_text(text)

    def call(self, *args, code=0, before=(), **more):
        """code: what it is to end with; several: one of them"""
        command = [*before, self.program, *map(str, args)]
        done = subprocess.run(command, cwd=self.dir, capture_output=True, text=True, timeout=600, **more)
        if done.returncode not in (code if isinstance(code, tuple) else (code,)):
            raise AssertionError(f"{args}: {done.returncode} {done.stdout[-300:]}\n{done.stderr[-800:]}")
        return done

    def start(self, *args, before=(), **more):
        process = subprocess.Popen([*before, self.program, *map(str, args)], cwd=self.dir, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True, **more)
        self.addCleanup(self.stop, process)
        return process

    def stop(self, process):
        """A test that fails leaves none running."""
        if process.poll() is None:
            process.kill()
            process.communicate()

    def files_of(self, directory):
        """What differs from run to run is left out."""
        return {p.name: p.read_bytes() for p in sorted((self.dir / directory).iterdir()) if p.name not in UNLIKE}

    def is_finished(self, directory):
        names = {p.name for p in (self.dir / directory).iterdir()}
        return not any(name.startswith(".") for name in names) and {"study.h5", "table.csv", *UNLIKE} <= names

    def bytes_of(self, directory):
        """The files of a finished study."""
        self.assertTrue(self.is_finished(directory), directory)
        return self.files_of(directory)

    def journals(self, directory):
        """Records of each that is under way."""
        return [p.read_bytes().count(RECORD) for p in (self.dir / directory).glob(".journal-*.partial")]

    def records(self, directory):
        return sum(self.journals(directory))
