#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Judge what a run has written, by the files and the scene alone.

    judge.py OUTPUT_DIR SCENE.prm [--set 'Section/Name=value'] [--quiet]

Nothing of Abut is used: elements, geometry of obstacles and surfaces, formulas
and integrals are written anew here. What it holds a run to stands in
thresholds.py, with the reasons. Prints a table of checks. Exit code 0: judged
right; 1: found wrong; 2: there is nothing that can be judged, and why.

The run must have written its fields and nodes: Output/Fields = true and
Output/Nodal values = true. --set takes the overrides that the run had.
"""
import argparse
import pathlib
import sys

from masses import MassesJudge
from masses_in_motion import MassesInMotionJudge
from membrane import MembraneJudge
from run_files import read_summary
from scene import Scene
from solid import SolidJudge
from verdict import CannotJudge, Findings, Wrong, says

JUDGES = {"solid": SolidJudge, "obstacle": MembraneJudge,
          "chain of masses": MassesJudge, "motion": MassesInMotionJudge}


def judge(folder, scene, findings):
    """Fill in the findings; throws CannotJudge or Wrong."""
    kind = scene.get("Scene", "obstacle")
    if kind not in JUDGES:
        raise CannotJudge(f"scenes of kind '{kind}' have no fields")
    summary = read_summary(folder)
    if says(summary, "iles of fields"):
        raise CannotJudge("files of fields do not hold all digits")
    try:
        JUDGES[kind](folder, scene, summary, findings).judge()
    except (KeyError, IndexError, TypeError) as error:
        raise Wrong(f"something is missing in the files: {error!r}") from error


def verdict(folder, path, overrides=()):
    """Exit code, findings and the reason why there are no more."""
    findings = Findings()
    try:
        scene = Scene(path, overrides)
        scene.folder = path.parent
        judge(folder, scene, findings)
    except OSError as error:
        return 2, findings, f"cannot judge: {error}"
    except CannotJudge as reason:
        return 2, findings, f"cannot judge: {reason}"
    except Wrong as reason:
        return 1, findings, f"WRONG {reason}"
    return (1 if findings.wrong else 0), findings, ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("output", type=pathlib.Path)
    parser.add_argument("scene", type=pathlib.Path)
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    code, findings, reason = verdict(options.output, options.scene.resolve(),
                                     options.set)
    findings.print()
    if reason:
        print(reason)
    return code


if __name__ == "__main__":
    sys.exit(main())
