# SPDX-License-Identifier: GPL-3.0-or-later
"""What a terminal shows: tables as wide as it is, marks, progress. usage: test_terminal.py GRIDCROSS"""
import re
import sys
import unittest

from studied import PROGRAM, Studied
from terminal import on_terminal

STUDY = """title: small
problem: {name: bar-neo-hookean}
mesh: {cells: [4, 8, 16]}
method: {space: [standard, moving-mesh], degree: [1, 2]}
time: {cfl: 0.4, periods: 0.25}
"""
ATTRIBUTE = re.compile(r"\033\[\d*m")


class Terminal(Studied):
    study = STUDY

    def shown(self, *args, columns=80, **more):
        code, text = on_terminal([str(PROGRAM), *args], columns, cwd=self.dir, **more)
        self.assertEqual(code, 0, text)
        return text

    def test_no_line_is_wider(self):
        for columns in (60, 80, 100, 200):
            for args in (["run", "small.yaml", "-q"], ["compare", "small.study"], ["check", "small.yaml"]):
                text = ATTRIBUTE.sub("", self.shown(*args, columns=columns))
                self.assertEqual([line for line in text.split("\n") if len(line) > columns], [], args)

    def test_help_and_lists_fit_80_columns(self):
        for args in (["--help"], ["list", "parameters"], ["list", "clocks"], ["list", "problems"], ["list", "spaces"], ["run", "--help"],
                     ["plot", "--help"], ["compare", "--help"]):
            lines = [line for line in self.shown(*args).split("\n") if not line.strip().startswith("gridcross ")]  # to be copied: whole
            self.assertEqual([line for line in lines if len(line) > 80], [], args)

    def test_the_same_numbers_at_every_width(self):
        numbers = [sorted(re.findall(r"\d\.\d\de-\d", self.shown("run", "small.yaml", "-q", columns=c))) for c in (50, 300)]
        self.assertEqual(*numbers)
        self.assertEqual(numbers[0], sorted(re.findall(r"\d\.\d\de-\d", self.call("run", "small.yaml", "-q").stdout)))

    def test_attributes_on_a_terminal_that_wants_them(self):
        bold = self.shown("compare", "small.study")
        self.assertEqual(len(re.findall(r"\033\[1m\d\.\d\de-\d\033\[0m", bold)), 3)  # one a row
        plain = self.call("compare", "small.study").stdout
        self.assertEqual(len(re.findall(r"\d\*", plain)), 3)
        self.assertEqual(re.findall(r"\033\[1m(\d\.\d\de-\d)", bold), re.findall(r"(\d\.\d\de-\d)\*", plain))
        for env in ({"NO_COLOR": "1"}, {"TERM": "dumb"}):
            self.assertEqual(self.shown("compare", "small.study", columns=100, env=env), plain)
        self.assertIn("\033", self.shown("compare", "small.study", env={"NO_COLOR": ""}))  # no-color.org: when not empty
        self.assertNotIn("\033", self.call("compare", "small.study").stdout)

    def test_progress_on_a_terminal_alone(self):
        long = ["run", "small.yaml", "--set", "mesh.cells=[64, 128]", "--set"]
        text = self.shown(*long, "time.periods=80")
        self.assertRegex(text, r"\r\033\[K\d of 8 cases, \d+ %, about \d+ s left")
        self.assertRegex(text, r"\r\033\[K +mesh  method[^\r]*\Z")  # and the line is empty when the table begins
        self.assertNotIn("\033", self.shown(*long, "time.periods=8", "-q"))
        self.assertEqual(self.call(*long, "time.periods=8").stderr, "study: ./small.study\n")  # short: no plain lines


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
