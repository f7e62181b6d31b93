# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the benchmarks share: one run of the program, its options, tables."""
import argparse
import csv
import json
import os
import pathlib
import subprocess
import tempfile

SILENT = {"Output/Fields": "false", "Output/Pictures": "false"}


def options(doc):
    """Parser of a benchmark with its description and the program."""
    parser = argparse.ArgumentParser(
        description=doc,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("abut", help="the program")
    return parser


def add_set(parser):
    parser.add_argument("--set", action="append", default=[],
                        metavar="SECTION/NAME=VALUE",
                        help="further parameters, as for abut run")


def head(columns):
    print("| " + " | ".join(columns) + " |\n|" + "---|" * len(columns),
          flush=True)


def row(cells):
    print("| " + " | ".join(map(str, cells)) + " |", flush=True)


def environment():
    """One thread for each process, and MPI for root, too."""
    result = dict(os.environ, DEAL_II_NUM_THREADS="1", OMP_NUM_THREADS="1")
    if os.geteuid() == 0:
        result["OMPI_ALLOW_RUN_AS_ROOT"] = "1"
        result["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1"
    return result


def call(abut, command, scene, settings, ranks=1):
    """Run `abut command scene` on one thread for each rank, with settings by
    path or as a list SECTION/NAME=VALUE; returns what it printed. A run that
    fails raises RuntimeError with its errors."""
    if isinstance(settings, dict):
        settings = [f"{name}={value}" for name, value in settings.items()]
    words = [str(abut), *command, str(scene)]
    # Benchmarks set the same for many scenes and methods.
    for setting in settings:
        words += ["--set-if-used", setting]
    if ranks > 1:
        words = ["mpirun", "--oversubscribe", "-n", str(ranks)] + words
    done = subprocess.run(words, capture_output=True, text=True,
                          env=environment())
    if done.returncode != 0:
        raise RuntimeError(f"{' '.join(words)}\n{done.stderr}")
    return done.stdout


class Run:
    """One run of a scene: its summary and its tables."""

    def __init__(self, abut, scene, settings, more=(), ranks=1):
        settings = [f"{name}={value}" for name, value in settings.items()]
        with tempfile.TemporaryDirectory() as folder:
            call(abut, ["run", "--quiet", "--output", folder], scene,
                 settings + list(more), ranks)
            folder = pathlib.Path(folder)
            self.summary = json.loads((folder / "summary.json").read_text())
            self.levels = self._table(folder / "levels.csv")
            self.steps = self._table(folder / "steps.csv")

    @staticmethod
    def _table(path):
        if not path.exists():
            return []
        with open(path) as file:
            return list(csv.DictReader(file))

    def seconds(self, name, kind="seconds"):
        """Seconds of a section: on the wall, or `processor_seconds`."""
        return self.summary["sections"].get(name, {}).get(kind, 0.0)
