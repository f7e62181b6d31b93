#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judge every scene of prm/ and every case of tests/scenes, cut to at most 1000
unknowns, the cases to the first part of their motion, too, if it takes long.

    scenes.py --abut build/release/abut [--jobs 2] [--only PART_OF_NAME]
              [--every NUMBER]
"""
import argparse
import json
import multiprocessing
import pathlib
import shutil
import sys
import tempfile

import judge
from runs import (QUIET, ROOT, base_scenes, cost_of_motion, find_size,
                  has_mesh, in_pools, run, shorten, small, stand_in, words_of)
from scene import Scene

SECONDS = 120
MOST_UNKNOWNS = 1000
COST = 1.5e4  # of a case: unknowns times cost_of_motion()
# Part of the runs: the others may have no answer on a mesh this small.
LEAST_JUDGED = 0.6


class Case:
    """A scene with what is set on the command line."""

    def __init__(self, name, path, overrides=(), replace=(), ranks=1,
                 is_whole=True):
        self.name, self.path, self.ranks = name, path, ranks
        self.overrides, self.replace = dict(overrides), dict(replace)
        self.is_whole = is_whole

    def mesh(self):
        """What its number of unknowns depends on."""
        return self.path, tuple(sorted(
            (k, v) for k, v in self.overrides.items()
            if k.startswith(("Solid/", "Membrane/Degree", "Body", "Mesh",
                             "Refinement/Level"))))

    def shorten(self, unknowns):
        """The scene of a case is itself judged to its end: here the first part
        of a motion will do."""
        scene = Scene(self.path)
        scene.values.update(self.overrides)
        cost = unknowns * cost_of_motion(scene)
        if not self.is_whole and cost > COST:
            before = dict(scene.values)
            shorten(scene, COST / cost)
            self.overrides.update({k: v for k, v in scene.values.items()
                                   if before.get(k) != v})

    def key(self, level):
        """What makes two runs the same."""
        return json.dumps([str(self.path), level, self.ranks, self.replace,
                           {k: v for k, v in self.overrides.items()
                            if not k.startswith(("Refinement/Level",
                                                 "Refinement/Coarsest",
                                                 "Output/"))}], sort_keys=True)


def words(value):
    return str(value).lower() if isinstance(value, bool) else str(value)


def cases():
    """All of them."""
    result = [Case(name, path) for name, path in base_scenes().items()]
    for path in sorted((ROOT / "tests/scenes").glob("*.json")):
        expectation = json.loads(path.read_text(encoding="utf-8"))
        for number, own in enumerate(expectation.pop("cases", [{}])):
            case = {**expectation, **own}
            values = {**expectation.get("set", {}), **own.get("set", {})}
            if case.get("exit", 0) != 0 or "scene" not in case:
                continue
            scene = ROOT / case["scene"]
            if Scene(scene).get("Scene", "obstacle") in judge.JUDGES:
                result.append(Case(
                    f"{path.stem} {number + 1}", scene,
                    {k: words(v) for k, v in values.items()},
                    case.get("replace", ()),
                    min(2, max(case.get("ranks", [1]))), is_whole=False))
    return result


class Trial:
    """Runs and judges a case; on the same level each run once."""

    def __init__(self, abut):
        self.abut = abut

    def size(self, mesh):
        """Level and unknowns of a file and what is set of its mesh."""
        path, overrides = mesh
        return find_size(self.abut, path, overrides, MOST_UNKNOWNS)

    def __call__(self, case_and_level):
        case, level = case_and_level
        with tempfile.TemporaryDirectory(prefix="abut-judge-") as folder:
            folder = pathlib.Path(folder)
            for path in case.path.parent.iterdir():
                if path.is_file() and path.suffix != ".prm":
                    shutil.copy(path, folder)
            text = case.path.read_text(encoding="utf-8")
            for old, new in case.replace.items():
                text = text.replace(old, new)
            scene = folder / "scene.prm"
            scene.write_text(text, encoding="utf-8")
            cycles = min(2, int(case.overrides.get(
                "Refinement/Adaptive cycles", Scene(scene).get(
                    "Refinement/Adaptive cycles", "0"))))
            overrides = case.overrides
            if has_mesh(Scene(scene)):
                overrides = {**overrides, **small(level), **QUIET,
                             "Refinement/Adaptive cycles": cycles}
            code, _, errors = run(
                words_of(self.abut, scene, case.ranks, overrides.items()),
                SECONDS, folder)
            if code != 0:
                return case.name, level, code, [], errors[-300:]
            verdict, findings, reason = judge.verdict(
                folder / "out", scene,
                [f"{k}={v}" for k, v in overrides.items()])
            return (case.name, level, ["right", "WRONG", "cannot"][verdict],
                    [f"{row[0]} {row[1]:.4g} > {row[2]:.4g}"
                     for row in findings.wrong], reason)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--abut", type=pathlib.Path,
                        default=ROOT / "build/release/abut")
    parser.add_argument("--served", type=pathlib.Path,
                        help="the program for many runs")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--every", type=int, default=1,
                        help="one case of so many")
    options = parser.parse_args()
    stand_in(options.abut.resolve(), options.served)
    trial = Trial(options.abut.resolve())
    chosen = [case for case in cases()
              if options.only in case.name][::options.every]
    runs = {}
    with multiprocessing.Pool(options.jobs) as pool:
        meshes = sorted({case.mesh() for case in chosen})
        sizes = dict(zip(meshes, pool.map(trial.size, meshes, 1)))
    for case in chosen:
        level, unknowns = sizes[case.mesh()]
        case.shorten(unknowns)
        runs.setdefault(case.key(level), (case, level))
    n_right = faults = 0
    for name, level, kind, wrong, reason in in_pools(
            trial, runs.values(), options.jobs, lambda run: run[0].ranks):
        n_right += kind == "right"
        # a mesh this small may have no answer, but must not crash
        faults += kind == "WRONG" or kind not in ("right", "cannot", 2, 3)
        print(f"{kind!s:6} {name}, level {level}: "
              f"{'; '.join(wrong) or ' '.join(reason.split())}", flush=True)
    print(f"{n_right} of {len(runs)} runs judged right")
    least = LEAST_JUDGED * len(runs)
    if not options.only and n_right < least:
        print(f"FAILED fewer than {least:.0f} could be judged")
        faults += 1
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
