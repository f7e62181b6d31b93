# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of the program share: calling it and comparing results."""
import argparse
import csv
import fcntl
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]
                       / "plugin/tools"))
from abut_tools.served import Served  # noqa: E402


class Folder:
    """A folder that scenes are written to."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name


def set_words(settings):
    """Words of the command line that set parameters: a dict by path, or a
    list of SECTION/NAME=VALUE."""
    if isinstance(settings, dict):
        settings = [f"{key}={value}" for key, value in settings.items()]
    return [word for setting in settings for word in ("--set", setting)]


# What lets root read and write everything.
NO_OVERRIDE = "-dac_override,-dac_read_search"


class Program:
    """The program under test with a folder of its own to work in."""

    def __init__(self):
        parser = argparse.ArgumentParser()
        parser.add_argument("--abut", required=True)
        parser.add_argument("--source", required=True)
        parser.add_argument("--served", help="the program for many runs")
        parser.add_argument("--study", help="a program that takes a scene")
        parser.add_argument("--part", type=int, help="of a test in parts")
        parser.add_argument("--short", action="store_true",
                            help="fewer cases on the same paths")
        arguments = parser.parse_args()
        self.abut = arguments.abut
        self.study = arguments.study
        self.part = arguments.part
        self.short = arguments.short
        self._served = arguments.served and Served(arguments.served)
        self.source = pathlib.Path(arguments.source)
        self._folder = tempfile.TemporaryDirectory(prefix="abut-test-")
        self.folder = pathlib.Path(self._folder.name)
        self.failures = 0

    def some(self, cases, number=1):
        """All of them; the first few in a short run."""
        cases = list(cases)
        return cases[:number] if self.short else cases

    def call(self, *words, ranks=0, environment=None, timeout=600,
             ordinary=False, before=(), at_start=None, alone=False):
        """Run `abut words`; ranks > 0: under mpirun; ordinary: obeying the
        permissions of files, as root otherwise does not; before: words before
        all others; at_start: called by the new process; alone: not by the
        program that is loaded once."""
        if self._served and not (ranks or environment or ordinary or before
                                 or at_start or alone):
            return self._served.run(words, self.folder, timeout)
        command = [self.abut, *map(str, words)]
        if ordinary and os.geteuid() == 0:
            command = ["setpriv", f"--bounding-set={NO_OVERRIDE}",
                       f"--inh-caps={NO_OVERRIDE}"] + command
        if ranks > 0:
            command = ["mpirun", "--oversubscribe", "-n", str(ranks)] + command
        with open(self.abut, "rb") as program:
            # Ranks wait in loops: two such runs of two tests stop each other.
            if ranks > 1:
                fcntl.flock(program, fcntl.LOCK_EX)
            return subprocess.run([*before, *command], cwd=self.folder,
                                  text=True, capture_output=True,
                                  timeout=timeout, preexec_fn=at_start,
                                  env={**os.environ, **(environment or {})})

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return name

    def expect(self, condition, message):
        if not condition:
            self.failures += 1
            print("FAILED:", message)

    def close(self, value, expected, tolerance, message):
        """A value that is expected but for a part `tolerance` of it."""
        good = (value is not None and math.isfinite(value)
                and abs(value - expected) <= tolerance * abs(expected))
        self.expect(good, f"{message}: {value} is not {expected}")

    def below(self, value, bound, what):
        self.expect(value is not None and abs(value) <= bound,
                    f"{what}: {value} is not below {bound}")

    def expect_error(self, result, *texts, code=2):
        """One error with this exit code that contains the texts."""
        lines = [line for line in result.stderr.splitlines()
                 if line.startswith("abut: error:")]
        what = " ".join(map(str, result.args[1:]))
        self.expect(result.returncode == code,
                    f"{what}: exit code {result.returncode}, not {code}")
        self.expect(len(lines) == 1,
                    f"{what}: {len(lines)} errors instead of one:\n"
                    + result.stderr)
        for text in texts:
            self.expect(any(text in line for line in lines),
                        f"{what}: no '{text}' in: {result.stderr}")

    def expect_run(self, result, codes, *words, without=()):
        """This exit code, or one of several, with these words and without
        others in what is said; returns the summary."""
        codes = codes if isinstance(codes, tuple) else (codes,)
        what = " ".join(map(str, result.args[1:]))
        self.expect(result.returncode in codes,
                    f"{what}: exit code {result.returncode} is not one of "
                    f"{codes}:\n{result.stderr}")
        for word in words:
            self.expect(word in result.stderr,
                        f"{what}: no '{word}':\n{result.stderr}")
        for word in without:
            self.expect(word not in result.stderr,
                        f"{what}: '{word}' in:\n{result.stderr}")
        exists = (self.folder / "out/summary.json").exists()
        return self.summary() if exists else {}

    def run_scene(self, scene, settings=(), codes=0, words=(), without=(),
                  ranks=0, more=()):
        """Run a scene in the folder, see expect_run(); returns its summary."""
        result = self.call("run", scene, "--output", "out", "--quiet",
                           *set_words(settings), *more, ranks=ranks)
        return self.expect_run(result, codes, *words, without=without)

    def refuse_scene(self, scene, settings, *texts):
        """The same where it is an error, see expect_error()."""
        self.expect_error(self.call("run", scene, "--output", "out", "--quiet",
                                    *set_words(settings)), *texts)

    def solve(self, scene, *words, ranks=0):
        """Run a shipped scene; returns summary and rows of levels.csv."""
        result = self.call("run", self.source / "prm" / scene, "--output",
                           "out", "--quiet", *words, ranks=ranks)
        self.expect(result.returncode == 0,
                    f"{scene} {words}: exit code {result.returncode}\n"
                    + result.stderr)
        return self.results()

    def solve_with(self, scene, settings, ranks=0):
        """Run a shipped scene with other values of some parameters."""
        return self.solve(scene, *set_words(settings), ranks=ranks)

    def results(self):
        return self.summary(), self.table("levels.csv")

    def summary(self, folder="out"):
        return json.loads((self.folder / folder / "summary.json").read_text())

    def table(self, name):
        with open(self.folder / "out" / name) as file:
            return [{key: float(value) if value else None
                     for key, value in row.items()}
                    for row in csv.DictReader(file)]

    def finish(self):
        if self.failures:
            raise SystemExit(f"{self.failures} failures")
        print("ok")
