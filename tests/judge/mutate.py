#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Make scenes from those in prm/ by random changes, run and judge them.

    mutate.py --seeds 0:1000 --results mutations.jsonl
    mutate.py --seeds 0:1000 --bases 'dynamics-*' 'friction-*'
    mutate.py --list tests/judge/mutations.jsonl
    mutate.py --repeat 17        the same scene again, with what it prints

A seed stands for one scene. Base scenes are first cut to at most 2000
unknowns, and fewer, or to a part of their motion, where they have many steps.
Runs on one rank are by `abut serve`, which is loaded once. Each run must end within its time with exit code 0 (and then be
judged right, or be nothing that can be judged), 2 with an error message, or 3.
Results go to a file line by line: a run that was interrupted goes on where it
was. With --sanitized PROGRAM every tenth scene is run by that program too, with
ten times the time. Ends with a table by exit code and verdict, the seeds that
failed, and exit code 1 if there are any.
"""
import argparse
import collections
import fnmatch
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time

import judge
from grammar import Mutation, read_reference
from runs import (QUIET, ROOT, base_scenes, find_cut, has_mesh, in_pools,
                  n_steps, run, shorten, small, stand_in, words_of)
from scene import Scene

SECONDS = 20  # of processor time
SANITIZED_EVERY = 10
# Unknowns times steps of a base scene; how many of those that have up to MORE
# times as many go through their whole motion all the same, and how many times
# the steps of its base a changed scene may have.
COST, WHOLE, MORE = 4e4, 0.1, 5.
FINE = {"0 right", "0 cannot be judged", "2", "3"}
SANITIZER = re.compile(r"ERROR: \w*Sanitizer|runtime error:")


def cut(scene, level, part, source):
    """A base scene on a coarse mesh that writes what the judge reads."""
    for key, value in {**small(level), **QUIET}.items():
        scene.values[key] = str(value)
    if part < 1 and (source.random() > WHOLE or part * MORE < 1):
        shorten(scene, part)
    if scene.get("Time stepping/Scheme", "quasi-static") != "quasi-static":
        scene.values["Output/Every"] = "1000000"


def cut_again(scene, base, steps):
    """A changed scene that would have many more unknowns or steps than its
    base."""
    dim = int(scene.get("Dimension", "2"))
    for name in ("Solid/Degree", "Membrane/Degree"):
        if int(scene.get(name, "1")) > int(base.get(name, "1")):
            level = int(scene.get("Refinement/Level", "0"))
            if level > 0:
                scene.values["Refinement/Level"] = str(level - 1)
            else:
                shorten(scene, 0.5**dim)
    if n_steps(scene) > MORE * steps:
        shorten(scene, MORE * steps / n_steps(scene))
    if scene.get("Refinement/Target error") != base.get(
            "Refinement/Target error"):
        scene.values["Refinement/Maximum meshes"] = "4"


def make_case(seed, levels, reference):
    """What a seed stands for: a base scene and what is other in it, so that a
    list of such cases stays the same when parameters or scenes are added."""
    source = random.Random(f"scene {seed}")
    name = source.choice(sorted(levels))
    base = Scene(base_scenes()[name])
    scene = Scene(base_scenes()[name])
    if has_mesh(scene):
        cut(scene, *levels[name], source)
    # exact solutions of the base are those of no other scene
    for key in [k for k in scene.values if k.startswith("Exact solution")]:
        del scene.values[key]
    if has_mesh(scene) and source.random() < 0.15:
        scene.values["Refinement/Adaptive cycles"] = "2"
    steps = n_steps(scene)
    mutation = Mutation(scene, reference, source)
    cut_again(scene, base, steps)
    return {"seed": seed, "base": name,
            "ranks": 2 if source.random() < 0.1 else 1,
            "changes": mutation.changes,
            "set": {k: v for k, v in scene.values.items()
                    if base.values.get(k) != v},
            "removed": [k for k in base.values if k not in scene.values]}


def scene_of(case):
    """The scene file of a case."""
    scene = Scene(base_scenes()[case["base"]])
    for key in case["removed"]:
        scene.values.pop(key, None)
    scene.values.update(case["set"])
    return scene.text()


def judged(code, text, folder):
    """The class of a run, and what was found."""
    if code == "time":
        return "time", ""
    if code == 2 and "abut: error:" not in text:
        return "2 without a word", text[-300:]
    if code not in (0, 2, 3):
        return str(code), text[-300:]
    if code != 0:
        return str(code), ""
    verdict, findings, reason = judge.verdict(folder / "out",
                                              folder / "scene.prm")
    by = reason or "; ".join(f"{row[0]} {row[1]:.3g} > {row[2]:.3g}"
                             for row in findings.wrong)
    return f"0 {['right', 'WRONG', 'cannot be judged'][verdict]}", by


class Trial:
    """Runs and judges a case."""

    def __init__(self, abut, sanitized):
        self.abut, self.sanitized = abut, sanitized

    def __call__(self, case):
        begin = time.monotonic()
        result = dict(case)
        with tempfile.TemporaryDirectory(prefix="abut-mutate-") as folder:
            folder = pathlib.Path(folder)
            self.write(case, folder)
            kind, by = self.try_once(self.abut, folder, case["ranks"], SECONDS)
            result.update({"class": kind, "by": by})
            if self.sanitized and case["seed"] % SANITIZED_EVERY == 0:
                shutil.rmtree(folder / "out", ignore_errors=True)
                code, _, text = run(
                    words_of(self.sanitized, "scene.prm", case["ranks"]),
                    10 * SECONDS, folder, None)
                if code not in (0, 2, 3) or SANITIZER.search(text):
                    result.update({"class": "sanitizer", "by": text[:600]})
        result["seconds"] = round(time.monotonic() - begin, 2)
        return result

    @staticmethod
    def write(case, folder):
        (folder / "scene.prm").write_text(scene_of(case), encoding="utf-8")
        for path in (ROOT / "prm").iterdir():
            if path.is_file() and path.suffix != ".prm":
                shutil.copy(path, folder)

    def try_once(self, abut, folder, ranks, seconds):
        code, _, text = run(words_of(abut, "scene.prm", ranks), seconds, folder)
        try:
            return judged(code, text, folder)
        except Exception as error:  # the judge's own fault, to be told
            return "judge failed", repr(error)


def table(results, command):
    """Print classes with their numbers and bases, and what failed."""
    counts = collections.Counter(r["class"] for r in results)
    print(f"{len(results)} scenes")
    for kind, n in sorted(counts.items()):
        print(f"  {n:6} {'' if kind in FINE else 'FAILED '}{kind}")
    failed = sorted((r for r in results if r["class"] not in FINE),
                    key=lambda r: (r["class"], r["base"], r["seed"]))
    for r in failed:
        print(f"FAILED {r['class']}: seed {r['seed']}, {r['base']}, "
              f"{'; '.join(r['changes'])}: {' '.join(r['by'].split())[:200]}")
    if failed:
        print(f"again: {command} --repeat SEED")
    return 1 if failed else 0


def find_levels(abut, path, patterns):
    """Levels of the base scenes whose names fit, and parts of their motions,
    kept in a file if one is given."""
    if path and path.exists():
        return json.loads(path.read_text(encoding="utf-8"))
    levels = {name: find_cut(abut, scene, cost=COST)
              for name, scene in base_scenes().items()
              if any(fnmatch.fnmatch(name, p) for p in patterns)}
    if path:
        path.write_text(json.dumps(levels, indent=1), encoding="utf-8")
    return levels


def read_list(path):
    """Cases of a committed list."""
    return [json.loads(line) for line in
            path.read_text(encoding="utf-8").split("\n") if line]


def make_cases(seeds, options, abut):
    """Cases of seeds, one after the other."""
    reference = {
        kind: read_reference(subprocess.run(
            [abut, "parameters", "--scene", kind], capture_output=True,
            text=True, check=True).stdout)
        for kind in ("obstacle", "point mass", "chain of masses", "motion",
                     "solid")}
    levels = find_levels(abut, options.levels, options.bases)
    return (make_case(seed, levels, reference) for seed in seeds)


def read_results(path):
    if path is None or not path.exists():
        return {}
    results = {}
    for line in path.read_text(encoding="utf-8").split("\n"):
        try:
            result = json.loads(line)
            results[result["seed"]] = result
        except ValueError:
            continue  # the line in which it was interrupted
    return results


def repeat(trial, case):
    """Print a case, its run and its verdict."""
    folder = pathlib.Path(tempfile.mkdtemp(
        prefix=f"abut-mutation-{case['seed']}-"))
    trial.write(case, folder)
    print(f"{case['base']} on {case['ranks']} ranks in {folder}: "
          f"{'; '.join(case['changes'])}")
    kind, by = trial.try_once(trial.abut, folder, case["ranks"], SECONDS)
    print((folder / "stderr").read_text(encoding="utf-8"))
    if kind.startswith("0"):
        judge.verdict(folder / "out", folder / "scene.prm")[1].print()
    print(kind, by)
    return 0 if kind in FINE else 1


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--abut", type=pathlib.Path,
                        default=ROOT / "build/release/abut")
    parser.add_argument("--sanitized", type=pathlib.Path)
    parser.add_argument("--served", type=pathlib.Path,
                        help="the program for many runs (default: that of --abut)")
    parser.add_argument("--seeds", default="0:200", help="FIRST:END")
    parser.add_argument("--bases", nargs="+", default=["*"],
                        metavar="PATTERN", help="names of scenes in prm/")
    parser.add_argument("--list", type=pathlib.Path,
                        help="cases in place of seeds")
    parser.add_argument("--every", type=int, default=1,
                        help="one case of the list out of so many")
    parser.add_argument("--results", type=pathlib.Path)
    parser.add_argument("--levels", type=pathlib.Path,
                        help="file that keeps the levels of the base scenes")
    parser.add_argument("--repeat", type=int, metavar="SEED")
    parser.add_argument("--jobs", type=int, default=1)
    options = parser.parse_args()
    abut = options.abut.resolve()
    stand_in(abut, options.served or abut)
    trial = Trial(abut, options.sanitized and options.sanitized.resolve())
    first, _, end = options.seeds.partition(":")
    listed = (read_list(options.list)[::options.every] if options.list
              else [])
    seeds = ([options.repeat] if options.repeat is not None else
             [case["seed"] for case in listed] or
             range(int(first), int(end)))
    results = read_results(options.results)
    left = [seed for seed in seeds if seed not in results]
    cases = ([case for case in listed if case["seed"] in left] if listed else
             make_cases(left, options, abut))
    if options.repeat is not None:
        return repeat(trial, next(iter(cases)))
    output = options.results and open(options.results, "a", encoding="utf-8")
    for result in in_pools(trial, cases, options.jobs,
                           lambda case: case["ranks"]):
        results[result["seed"]] = result
        if output:
            output.write(json.dumps(result) + "\n")
            output.flush()
    again = f" --list {options.list}" if options.list else ""
    return table([results[seed] for seed in seeds],
                 f"tests/judge/mutate.py --abut {options.abut}{again}")


if __name__ == "__main__":
    sys.exit(main())
