# SPDX-License-Identifier: GPL-3.0-or-later
"""Test cases about one small study, which is run once for a class and copied for each test."""
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def checksum(data, total=0x9e3779b97f4a7c15):
    def stir(total, word):
        total = (total ^ word) * 0xff51afd7ed558ccd % 2**64
        return total ^ total >> 32

    whole = len(data) // 8 * 8
    for word, in struct.iter_unpack("<Q", data[:whole]):
        total = stir(total, word)
    rest = data[whole:]
    return stir(stir(total, int.from_bytes(rest, "little")), len(rest)) if rest else total


def seal(path):
    """Adds the checksums that a study's HDF5 files end in to one that another program wrote: of each 64 KiB, then the length."""
    data = path.read_bytes()
    sums = b"".join(struct.pack("<Q", checksum(data[i:i + 65536])) for i in range(0, len(data), 65536))
    length = struct.pack("<Q", len(data))
    path.write_bytes(data + sums + length + struct.pack("<Q", checksum(sums + length)) + b"GXSEAL1\0")


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
