# SPDX-License-Identifier: GPL-3.0-or-later
"""`meson install` into a directory of one's own: program, shared and static library, headers, pkg-config file, examples.
usage: test_install.py BUILD_ROOT SOURCE_ROOT PREFIX LIBDIR COMPILER..."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD, ROOT = (pathlib.Path(a).resolve() for a in sys.argv[1:3])
PREFIX, LIBDIR, COMPILER = sys.argv[3], sys.argv[4], sys.argv[5:]


def output(*command, **more):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=600, **more)
    if done.returncode:
        raise AssertionError(f"{command}: {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.place = pathlib.Path(place.name)
        (cls.place / "a place").mkdir()
        output("meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", cls.place / "a place")
        # pkg-config prints words for a shell, and compilers' callers seldom quote them
        (cls.place / "prefix").symlink_to(cls.place / "a place" / PREFIX)
        cls.prefix = cls.place / "prefix"
        cls.lib = cls.prefix / LIBDIR

    def packages(self, lib, *options):
        return output("pkg-config", f"--define-variable=prefix={self.prefix}", f"--define-variable=libdir={lib}", *options, "gridcross",
                      env=os.environ | {"PKG_CONFIG_PATH": str(self.lib / "pkgconfig")}).split()

    def built(self, lib, *options):
        program = self.place / "bar"
        output(*COMPILER, "-Wall", "-Wextra", "-Werror", "-O2", ROOT / "runs/library/bar.c", "-o", program, *self.packages(lib, "--cflags", "--libs", *options),
               "-lm")
        return program

    def test_program_runs_where_it_is(self):
        self.assertIn("gridcross ", output(self.prefix / "bin/gridcross", "--version"))
        for name in ("quickstart.yaml", "README.md", "library/bar.c"):
            self.assertTrue((self.prefix / "share/doc/gridcross/runs" / name).is_file(), name)
        self.assertFalse((self.prefix / "share/doc/gridcross/runs/quickstart").exists())  # it builds a checkout
        out = output(self.prefix / "bin/gridcross", "check", self.prefix / "share/doc/gridcross/runs/quickstart.yaml")
        self.assertIn("18 cases", out)

    def test_completion_and_manual(self):
        self.assertIn("complete -F", (self.prefix / "share/bash-completion/completions/gridcross.bash").read_text())
        if shutil.which("scdoc"):
            for section in "15":
                self.assertIn(".TH", (self.prefix / f"share/man/man{section}/gridcross.{section}").read_text())

    def test_shared_library_has_a_soname_and_exports_gx_names_alone(self):
        real = (self.lib / "libgridcross.so").resolve()
        soname = re.search(r"SONAME.*\[(.*)\]", output("readelf", "-d", real))[1]
        self.assertRegex(soname, r"^libgridcross\.so\.\d+$")
        self.assertEqual((self.lib / soname).resolve(), real)
        names = [line.split()[-1] for line in output("nm", "-D", "--defined-only", real).splitlines()]
        self.assertGreater(len(names), 100)
        self.assertEqual([name for name in names if not name.startswith("gx_")], [])

    def test_headers_are_those_of_the_source(self):
        for header in (ROOT / "include/gridcross").glob("*.h"):
            self.assertEqual((self.prefix / "include/gridcross" / header.name).read_bytes(), header.read_bytes())

    def test_a_program_of_ones_own(self):
        """Own problem, material and basis, by the shared library and by the static one: the same bytes, and the orders that quadratic
        B-splines with lumped mass have: 2 on the moving mesh, less on the standard grid once particles cross cells."""
        shared = self.built(self.lib)
        environment = os.environ | {"LD_LIBRARY_PATH": str(self.lib.resolve())}
        self.assertIn("libgridcross.so", output("readelf", "-d", shared))
        out = output(shared, env=environment)
        alone = self.place / "static"
        alone.mkdir()
        for archive in self.lib.glob("*.a"):
            shutil.copy(archive, alone)
        static = self.built(alone, "--static")
        self.assertNotIn("libgridcross.so", output("readelf", "-d", static))
        self.assertEqual(output(static), out)
        order = {}
        for line in out.splitlines():
            space, cells, error, last = re.match(r"(\S+) +(\d+) cells  error (\S+) m  order +(\S+)", line).groups()
            order.setdefault(space, []).append(float(last))
            self.assertLess(float(error), 0.01)
        self.assertEqual(list(order), ["standard", "moving-mesh"])
        for value in order["moving-mesh"][1:]:
            self.assertAlmostEqual(value, 2, 1)
        self.assertLess(order["standard"][-1], 1.75)

    def test_words_for_a_link(self):
        self.assertEqual([w for w in self.packages(self.lib, "--libs") if w.startswith("-l")], ["-lgridcross"])
        for library in ("-lgridcross-splines", "-lgsl", "-lfftw3", "-lyaml", "-lhdf5"):
            self.assertIn(library, self.packages(self.lib, "--static", "--libs"))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
