# SPDX-License-Identifier: GPL-3.0-or-later
"""Help, man pages and completion say what the tables say. usage: test_documents.py GRIDCROSS"""
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = pathlib.Path(sys.argv[1]).resolve()


def say(*args):
    return subprocess.run([PROGRAM, *args], check=True, capture_output=True, text=True, timeout=600).stdout


COMMANDS = re.findall(r"^  (?!gridcross)([a-z]+) +[A-Z]", say("--help"), re.M)
OPTIONS = {name: re.findall(r"^  (?:-\w, |    )(--[\w-]+)", say(name, "--help"), re.M) for name in COMMANDS}
PATHS = re.findall(r"^([a-z_]+\.[a-z_]+)  \(", say("list", "parameters"), re.M)


class Help(unittest.TestCase):
    def test_tables_were_read(self):
        self.assertGreaterEqual(len(COMMANDS), 10)
        self.assertGreater(len(PATHS), 50)
        self.assertIn("--set", OPTIONS["run"])

    def test_every_command_has_examples_that_its_options_allow(self):
        for name in COMMANDS:
            examples = re.findall(r"^  (gridcross .*)$", say(name, "--help").split("\nexamples:\n")[1], re.M)
            self.assertTrue(examples, name)
            for line in examples:
                for call in re.findall(r"gridcross ([^|&>]*)", line):
                    command, *words = call.split()
                    self.assertIn(command, COMMANDS, line)
                    for word in words:
                        if word.startswith("--"):
                            self.assertIn(word, OPTIONS[command], line)


@unittest.skipUnless(shutil.which("scdoc") and shutil.which("mandoc"), "scdoc and mandoc are not installed")
class Manual(unittest.TestCase):
    def page(self, section):
        """As a reader sees it; fails where a formatter warns of more than the empty paragraphs that scdoc leaves."""
        roff = subprocess.run(["scdoc"], input=say("--manual", section), check=True, capture_output=True, text=True).stdout
        lint = subprocess.run(["mandoc", "-T", "lint", "-W", "warning"], input=roff, capture_output=True, text=True).stdout
        self.assertEqual([line for line in lint.splitlines() if "skipping paragraph macro" not in line], [])
        text = subprocess.run(["mandoc", "-T", "utf8"], input=roff, check=True, capture_output=True, text=True).stdout
        return re.sub(".\b", "", text)

    def test_program(self):
        page = self.page("1")
        for name in COMMANDS:
            self.assertRegex(page, rf"\n {{3}}{name}\n", name)
            for option in OPTIONS[name]:
                self.assertIn(option, page)

    def test_reference(self):
        page = self.page("5")
        for path in PATHS:
            self.assertRegex(page, rf"\n {{7}}{re.escape(path)} \(")
        for column in ("result.displacement.max.rms, m", "result.status", "result.seconds, s"):
            self.assertIn(column, page)


class Completion(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        place = tempfile.TemporaryDirectory()
        cls.addClassCleanup(place.cleanup)
        cls.dir = pathlib.Path(place.name)
        (cls.dir / "completion").write_text(say("--completion"))
        (cls.dir / "work").mkdir()
        for name in ("a.yaml", "b c.yaml", "d.csv"):
            (cls.dir / "work" / name).touch()
        (cls.dir / "work" / "one.study").mkdir()

    def offered(self, *words, breaks="= \t\n"):
        """What bash offers for the last of the words that follow `gridcross`, taken apart at = as readline does."""
        split = ["gridcross"]
        for word in words:
            split += [part for part in re.split("(=)", word) if part or word == ""] if "=" in breaks else [word]
        script = (f". {self.dir}/completion; COMP_WORDBREAKS=$'{breaks.encode('unicode_escape').decode()}'; COMP_WORDS=(\"$@\"); "
                  "COMP_CWORD=$(($# - 1)); _gridcross; printf '%s\\n' \"${COMPREPLY[@]}\"")
        done = subprocess.run(["bash", "--norc", "-c", script, "bash", *split], cwd=self.dir / "work", capture_output=True, text=True,
                              timeout=600)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout.split("\n")[:-1] if done.stdout != "\n" else []

    def test_commands_and_options(self):
        self.assertEqual(sorted(set(self.offered("")) - {"--help", "--version", "--completion", "--manual"}), sorted(COMMANDS))
        self.assertEqual(sorted(self.offered("c")), ["check", "compare"])
        for name in COMMANDS:
            self.assertEqual(sorted(set(self.offered(name, "--"))), sorted(set(OPTIONS[name])))
        self.assertEqual(self.offered("run", "a.yaml", "--no"), ["--no-timing"])

    def test_parameters_and_their_values(self):
        self.assertEqual(self.offered("run", "--set", ""), [path + "=" for path in PATHS])
        self.assertEqual(self.offered("run", "a.yaml", "--set", "method.sp"), ["method.space="])
        self.assertEqual(self.offered("run", "--set", "method.transfer="), ["flip", "pic", "apic"])
        self.assertEqual(self.offered("check", "--set=method.transfer=a"), ["apic"])
        self.assertEqual(self.offered("check", "--set", "method.transfer=a", breaks=" \t\n"), ["method.transfer=apic"])
        self.assertEqual(self.offered("compare", "--rows", "mesh.c"), ["mesh.cells"])
        self.assertIn("result.energy.drift", self.offered("compare", "--value=result.e"))
        self.assertEqual(self.offered("run", "--set", "mesh.cells="), [])

    def test_names_and_files(self):
        self.assertEqual(sorted(self.offered("run", "")), ["a.yaml", "b c.yaml", "one.study"])
        self.assertEqual(self.offered("compare", "o"), ["one.study"])
        self.assertEqual(self.offered("list", "cl"), ["clocks"])
        self.assertEqual(self.offered("init", "bar-l"), ["bar-linear"])
        self.assertIn("steffen2010/fig11", self.offered("paper", "steffen2010"))
        self.assertIn("spectrum", self.offered("plot", "one.study", "spec"))
        self.assertEqual(self.offered("run", "-j", ""), [])
        self.assertEqual(self.offered("nonsense", ""), [])

    def test_a_person_at_a_keyboard(self):
        """The word that a real bash puts on the line after two tabs."""
        pid, terminal = pty.fork()
        if pid == 0:
            os.chdir(self.dir / "work")
            os.execvpe("bash", ["bash", "--norc", "--noprofile", "-i"], {"PATH": os.environ["PATH"], "TERM": "dumb", "PS1": "> "})
        text = ""

        def read_until(pattern):
            nonlocal text
            end = time.monotonic() + 30
            while not re.search(pattern, text) and time.monotonic() < end:
                if select.select([terminal], [], [], 0.2)[0]:
                    text += os.read(terminal, 4096).decode()
            self.assertRegex(text, pattern)

        read_until("> ")
        os.write(terminal, f". {self.dir}/completion; echo rea''dy\n".encode())
        read_until("ready")
        os.write(terminal, b"gridcross check a.yaml --se\tmethod.spa\tmov\t")
        read_until(r"--set method\.space=moving-mesh")
        os.write(terminal, b"\x03exit\n")
        os.close(terminal)
        os.waitpid(pid, 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
