#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/output.md against files of runs: it has each key of summary.json, each column
of tables and each field that small scenes write, and no other.

    tests/docs/check_output.py --abut build/release/abut"""
import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]

# Scenes that write each key at least once, with settings that make them short.
RUNS = [
    ("step-41", "Refinement/Level=5", "Output/Linear solves for comparison=1"),
    ("flat-obstacle", "Refinement/Level=4"),
    ("lifted-string", "Time stepping/Scheme=central difference with projection",
     "Time stepping/Step size=0.01", "Time stepping/End time=0.1"),
    ("elastic-signorini", "Refinement/Target error=0.1"),
    ("two-cylinders", "Refinement/Level=3", "Refinement/Adaptive cycles=1",
     "Output/Nodal values=true", "Output/Points=1: 0, 0"),
    ("two-blocks-3d", "Refinement/Level=2", "Output/Nodal values=true",
     "Solver/Linear solver=iterative"),
    ("cattaneo", "Refinement/Adaptive cycles=0", "Output/Nodal values=true",
     "Pair 1/Friction=0.2 + 0.001*x"),
    ("patch-2d", "Method/Discretisation=node to segment"),
    ("pressed-ball",),
    ("finite-compression",),
    ("hertz-impact", "Refinement/Level=1", "Time stepping/End time=1"),
    ("falling-ball", "Time stepping/End time=0.01", "Time stepping/Step size=0.001"),
    ("failures/locking-rubber",), ("failures/narrow-load",),
    ("point-mass",), ("method-of-multipliers",), ("failures/cycling",),
    ("friction-bar",),
    ("dynamics-bouncing-ball",), ("dynamics-bar-on-a-wall",), ("search-flat",),
]
# Fields of every file of ParaView.
FORMAT = {"TIME", "CYCLE", "connectivity", "offsets", "types"}


def general(name):
    """pair_1_force_y is pair_N_force_x."""
    name = re.sub(r"_\d+(?=_|$)", "_N", name)
    return re.sub(r"_(?:y|z|height)$", "_x", name)


def found_in(folder):
    """(file, name) of each key, column and field."""
    for path in folder.iterdir():
        file = general(re.sub(r"_\d{4}\.\d+$", "", path.stem))
        if path.name == "summary.json":
            for key in json.loads(path.read_text(encoding="utf-8")):
                yield "summary.json", general(key)
        elif path.suffix == ".csv":
            with path.open(encoding="utf-8") as lines:
                for name in lines.readline().strip().split(","):
                    yield file + ".csv", general(name)
        elif path.suffix == ".vtu":
            for name in re.findall(rb'<DataArray[^>]*Name="([^"]+)"',
                                   path.read_bytes()):
                if name.decode() not in FORMAT:
                    yield file, general(name.decode())


def listed_in(page):
    """The same of the tables of the page; "Pairs" are in parameters.md, too."""
    files, column = [], 0
    for line in page.split("\n"):
        if line.startswith("## "):
            files = re.findall(r"[\w.]+\.(?:json|csv)", line)
            column = 1 if line == "## Fields" else 0
        elif line.startswith("| `") and (files or column):
            cells = [re.findall(r"`([^`]+)`", cell) for cell in line.split("|")[1:]]
            for file in files or cells[0]:
                for name in cells[column]:
                    yield file, name
    parameters = (ROOT / "doc/parameters.md").read_text(encoding="utf-8")
    pairs = parameters[parameters.index("\n## Pairs in `summary.json`"):]
    for name in re.findall(r"^\| `(\w+)` \|", pairs, re.M):
        yield "summary.json", "pair_N_" + name


def run(abut, folder):
    environment = dict(os.environ, OMP_NUM_THREADS="1")
    for number, (scene, *settings) in enumerate(RUNS):
        name = folder / str(number)
        command = [abut, "run", ROOT / f"prm/{scene}.prm", "--quiet", "--output", name,
                   "--set-if-used", "Output/Pictures=false"]
        for setting in settings:
            command += ["--set", setting]
        done = subprocess.run(command, env=environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode not in (0, 3):
            raise SystemExit(f"{scene}: exit code {done.returncode}\n{done.stdout}")
        yield from found_in(name)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--abut", type=pathlib.Path, required=True)
    abut = arguments.parse_args().abut.resolve()
    with tempfile.TemporaryDirectory() as folder:
        found = set(run(abut, pathlib.Path(folder)))
    listed = set(listed_in((ROOT / "doc/output.md").read_text(encoding="utf-8")))
    # A closed form has some of the columns of its pair.
    only_pair = {("pair_N_closed_form.csv", name) for name in ("gap", "status", "slip")}
    for file, name in sorted(found - listed):
        print(f"doc/output.md does not have {name} of {file}")
    for file, name in sorted(listed - found - only_pair):
        print(f"doc/output.md has {name} of {file}, which no run writes")
    print(f"{len(found)} keys, columns and fields")
    return 1 if found - listed or listed - found - only_pair else 0


if __name__ == "__main__":
    sys.exit(main())
