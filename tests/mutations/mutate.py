#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Breaks the kernels, or what is around them, one operator or constant at a time and counts how often the unit and conformance
suites notice.

Works in private copies of the tree, whose tests are linked with the shared library, so that a mutant compiles one file and
links once. A mutant is killed by the first test that fails, crashes or takes far longer than it should; what survives the
plain suites is tried with them under address and undefined-behaviour sanitizers, as tests/run does. One that compiles to the
same machine code, or not at all, does not count. The share is given with its 95 % interval of confidence (Wilson)."""
import argparse
import collections
import contextlib
import hashlib
import json
import math
import os
import pathlib
import queue
import random
import re
import resource
import select
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

sys.dont_write_bytecode = True  # beside the sources
from points import points  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
NUMERICS = ["src/spaces/*.[ch]", "src/bases/*.[ch]", "src/clocks/*.c", "src/materials/*.c", "src/measures/*.c", "src/problems/*.[ch]", "splines/*.c",
            *(f"src/core/{name}" for name in ["grid.c", "logarithm.h", "particles.c", "tensor.h", "vector.c", "vector.h"])]
OPTIONS = ["-Dbuildtype=plain", "-Doptimization=1", "-Dclones=disabled", "-Dtests=enabled", "-Dmpi=disabled", "-Dman=disabled"]
SANITIZERS = ["-Db_sanitize=address,undefined"]
HALT = {"ASAN_OPTIONS": "halt_on_error=1:detect_leaks=0", "UBSAN_OPTIONS": "halt_on_error=1"}
SANITIZED = 30  # s of processor time that a test may take there: longer ones say little of memory that shorter ones do not
MEMORY, DISK = 4 << 30, 1 << 30  # what one test may take; sanitizers set aside far more than they use
NAMES = {**{s.value: s.name for s in signal.Signals}, signal.SIGXCPU: "endless", signal.SIGKILL: "endless"}
Test = collections.namedtuple("Test", "name command")


class Stopped(Exception):
    """No mutants are to be tried any more."""


class Tree:
    """A private copy of the tree with its build, and the tests in it, of which each is timed once."""

    def __init__(self, place, sanitizers, longest, stop):
        self.root, self.build, self.sanitizers, self.stop = place / "gridcross", place / "gridcross/build", sanitizers, stop
        self.scratch = place / "scratch"  # temporary files of a test
        shutil.copytree(ROOT, self.root, ignore=lambda folder, names: [n for n in names if n == ".git" or n.endswith(".study")
                                                                       or (pathlib.Path(folder) / n / "build.ninja").exists()])
        links = self.root / "src/meson.build"
        text = links.read_text()
        assert text.count("link_with: library.get_static_lib()") == 1
        links.write_text(text.replace("get_static_lib", "get_shared_lib"))
        self.do("meson", "setup", self.build, self.root, *OPTIONS, *sanitizers)
        targets = {t["id"]: t["filename"][0] for t in json.loads(self.do("meson", "introspect", self.build, "--targets"))}
        listed = [t for t in json.loads(self.do("meson", "introspect", self.build, "--tests"))
                  if {s.split(":")[-1] for s in t["suite"]} & {"unit", "conformance"} and t["cmd"][0] in targets.values()]
        self.tests = [Test(t["name"], t["cmd"]) for t in listed]
        self.programs = [os.path.relpath(t["cmd"][0], self.build) for t in listed]
        self.do("ninja", "-C", self.build, *self.programs)
        self.unmutated = self.code()
        self.usual, self.kills = {}, collections.defaultdict(collections.Counter)
        for test in self.tests:
            failed, seconds = self.run(test, longest)
            if failed and failed != "endless":
                raise RuntimeError(f"unmutated, {test.name} fails: {failed}")
            if not failed:
                self.usual[test.name] = seconds
        self.tests = [t for t in self.tests if t.name in self.usual]

    def do(self, *command):
        done = subprocess.run(command, cwd=self.root, capture_output=True, text=True, start_new_session=True)
        if done.returncode:
            raise RuntimeError(f"{command}: {done.stdout}{done.stderr}")
        return done.stdout

    def make(self, **variables):
        return self.begin(["ninja", "-j1", *self.programs], 1800, {}, **variables)[0] is None

    def code(self):
        """Of the library and the splines."""
        objects = sorted(o for folder in ("src", "splines") for o in (self.build / folder).glob("*.p/*.o"))
        return hashlib.sha256(b"".join(hashlib.sha256(o.read_bytes()).digest() for o in objects)).digest()

    def run(self, test, most):
        """What fails, or None, and the seconds of processor time it took, of which `most` are allowed."""
        self.scratch.mkdir()
        limits = {resource.RLIMIT_CPU: math.ceil(most) + 1, resource.RLIMIT_FSIZE: DISK, resource.RLIMIT_CORE: 0}
        if not self.sanitizers:
            limits[resource.RLIMIT_AS] = MEMORY
        try:
            return self.begin(test.command, 30 * most + 60, limits, TMPDIR=str(self.scratch), **HALT)
        finally:
            shutil.rmtree(self.scratch, ignore_errors=True)

    def begin(self, command, seconds, limits, **variables):
        process = subprocess.Popen(command, cwd=self.build, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                   start_new_session=True, env={**os.environ, **variables})
        try:
            for what, limit in limits.items():
                resource.prlimit(process.pid, what, (limit, limit))
            failed = self.watch(process, seconds)
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.stdout.close()
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
        if failed is None and process.returncode:
            failed = NAMES.get(-process.returncode, f"exit {process.returncode}")
        return failed, used.ru_utime + used.ru_stime

    def watch(self, process, seconds):
        """What the process says has failed, at once; None when it ends."""
        output, deadline = b"", time.monotonic() + seconds
        while time.monotonic() < deadline:
            if self.stop.is_set():
                raise Stopped
            if not select.select([process.stdout], [], [], 1)[0]:
                continue
            piece = os.read(process.stdout.fileno(), 1 << 16)
            output = output[-4096:] + piece
            failed = re.search(rb"\[  FAILED  \] (\w+)\n", output)
            if failed:
                return failed[1].decode()
            if not piece:
                # closed: wait for the end, which killing would hide, without reaping it
                os.waitid(os.P_PID, process.pid, os.WEXITED | os.WNOWAIT)
                return None
        return "endless"

    def ordered(self, path):
        """Tests by what they are likely to find in a second: those first that killed mutants of the same file or folder."""
        near = self.kills[path], self.kills[os.path.dirname(path)]
        return sorted(self.tests, key=lambda t: -(0.2 + 5 * near[0][t.name] + near[1][t.name]) / (self.usual[t.name] + 0.05))

    def try_mutant(self, point, other):
        """killed, survived, same code or not compiled; and by which test."""
        file = self.root / point.path
        source = file.read_text()
        file.write_text(source[:point.at] + other + source[point.at + len(point.text):])
        try:
            if not self.make(CCACHE_DISABLE="1"):
                return "not compiled", ""
            if self.code() == self.unmutated:
                return "same code", ""
            for test in self.ordered(point.path):
                failed, _ = self.run(test, 10 * self.usual[test.name] + 5)
                if failed:
                    self.kills[point.path][test.name] += 1
                    self.kills[os.path.dirname(point.path)][test.name] += 1
                    return "killed", f"{test.name}{' (sanitized)' if self.sanitizers else ''}: {failed}"
            return "survived", ""
        finally:
            file.write_text(source)


def interval(killed, of):
    """Wilson's interval of confidence, 95 %."""
    z, p = 1.959964, killed / of
    centre, half = p + z * z / (2 * of), z * math.sqrt(p * (1 - p) / of + z * z / (4 * of * of))
    return (centre - half) / (1 + z * z / of), (centre + half) / (1 + z * z / of)


def sampled(found, size, chance):
    """size of the points, every file in proportion: the files' points shuffled, then every k-th from a random start."""
    by_file = collections.defaultdict(list)
    for point in found:
        by_file[point.path].append(point)
    line = [p for path in sorted(by_file) for p in chance.sample(by_file[path], len(by_file[path]))]
    if size >= len(line):
        return line
    step = len(line) / size
    start = chance.random() * step
    return [line[int(start + i * step)] for i in range(size)]


def drawn(arguments, chance):
    """Mutants to try, in random order: (point, what stands there instead)."""
    paths = sorted({p.relative_to(ROOT).as_posix() for pattern in arguments.files for p in ROOT.glob(pattern)})
    found = [p for path in paths for p in points(path, (ROOT / path).read_text()) if arguments.at or p.kernel != arguments.around]
    if arguments.at:
        wanted = [tuple(re.fullmatch(r"(.+):(\d+):(\d+)", at).groups()) for at in arguments.at]
        return [(p, other) for p in found if (p.path, str(p.line), str(p.column)) in wanted for other in p.others]
    where = f"{'around' if arguments.around else 'of'} the kernels in {len(paths)} files"
    print(f"{len(found)} mutation points {where}, {min(arguments.sample, len(found))} drawn with seed {arguments.seed}", flush=True)
    chosen = [(p, chance.choice(p.others)) for p in sampled(found, arguments.sample, chance)]
    chance.shuffle(chosen)
    return chosen


def report(results, least):
    """Prints the shares; whether the suites kill enough, as far as the sample can tell."""
    by_file = collections.defaultdict(collections.Counter)
    for (point, _), (verdict, _) in results:
        by_file[point.path][verdict] += 1
    print("\nkilled     of  file")
    for path, count in sorted(by_file.items()):
        print(f"{count['killed']:6} {count['killed'] + count['survived']:6}  {path}")
    total = sum(by_file.values(), collections.Counter())
    of = total["killed"] + total["survived"]
    if not of:
        return False
    low, high = interval(total["killed"], of)
    print(f"\n{total['killed']} of {of} mutants killed, {100 * total['killed'] / of:.1f} % (95 % confidence: {100 * low:.1f} to {100 * high:.1f} %); "
          f"not counted: {total['same code']} of equal machine code, {total['not compiled']} that do not compile")
    return 100 * high >= least


def work(place, longest, left, results, told, stop):
    try:
        tree, strict = Tree(place / "plain", [], longest, stop), None
        while not stop.is_set():
            mutant = left.get_nowait()
            (point, other), result = mutant, tree.try_mutant(*mutant)
            if result[0] == "survived":
                strict = strict or Tree(place / "strict", SANITIZERS, min(longest, SANITIZED), stop)
                result = strict.try_mutant(*mutant)
            with told:
                results.append((mutant, result))
                print(f"{result[0]:12} {point.path}:{point.line}:{point.column}: {point.text} -> {other}  {result[1]}", flush=True)
                if result[0] == "survived":
                    print(f"             {(tree.root / point.path).read_text().splitlines()[point.line - 1].strip()}", flush=True)
    except (queue.Empty, Stopped):
        pass
    except Exception as error:
        stop.set()
        print(error, file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sample", type=int, default=200, help="mutants to try (200)")
    parser.add_argument("--seed", type=int, default=random.SystemRandom().randrange(10**6), help="of the sample (another each time)")
    parser.add_argument("--jobs", type=int, default=1, help="copies of the tree that work side by side (1)")
    parser.add_argument("--around", action="store_true", help="break what is around the kernels: set-up, choices, measures")
    parser.add_argument("--files", nargs="+", default=NUMERICS, metavar="PATTERN", help="sources to break, from the top of the tree (the numerics)")
    parser.add_argument("--at", nargs="+", metavar="FILE:LINE:COLUMN", help="break these points, in every way, instead of a sample")
    parser.add_argument("--longest", type=float, default=600, metavar="SECONDS",
                        help="leave out tests that take more processor time than this: the share is then a lower bound (600)")
    parser.add_argument("--least", type=float, default=0, metavar="PERCENT",
                        help="fail when the share is lower, beyond what chance makes of a sample (0)")
    arguments = parser.parse_args()
    left, results, told, stop = queue.SimpleQueue(), [], threading.Lock(), threading.Event()
    mutants = drawn(arguments, random.Random(arguments.seed))
    if not mutants:
        sys.exit("nothing to break there")
    for mutant in mutants:
        left.put(mutant)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, lambda *_: stop.set())
    with tempfile.TemporaryDirectory(prefix="gridcross-mutations-") as place:
        workers = [threading.Thread(target=work, args=(pathlib.Path(place) / str(i), arguments.longest, left, results, told, stop))
                   for i in range(arguments.jobs)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
    enough = report(results, arguments.least)
    return 1 if stop.is_set() or not enough else 0


sys.exit(main())
