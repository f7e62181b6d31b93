#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of contact as a multiple of one linear elastic solve.

Runs a scene of the kind `solid` four times on each level, on one thread:
with its pair tied from the start on the finest mesh alone, which is one linear
solve, with algebraic multigrid and with what contact has; with contact, from the coarsest mesh on
(nested iteration); with contact, on the finest mesh alone (cold). The cost is
that of assembly, transfer, contact rows (search, integration, assembly) and
solve on all levels; mesh, numbering and sparsity pattern are the same for all
four. Seconds are the processor's.

    tests/bench/cost.py build/release/abut prm/two-blocks-3d.prm
"""
import statistics

import measured

SECTIONS = ["assembly", "transfer", "contact rows", "solve"]
COLUMNS = ["level", "unknowns", "solve", "steps", "iterations"] + [
    f"{name}, s" for name in SECTIONS] + ["all, s", "of the tied solve",
                                          "rows of assembly + solve"]


def run(arguments, level, settings):
    """Seconds of the sections, numbers of unknowns, steps and iterations."""
    one = measured.Run(arguments.abut, arguments.scene,
                       {"Refinement/Level": level, "Output/Fields": "false",
                        **settings}, arguments.set)
    steps = [step for step in one.steps if int(step["level"]) == level]
    result = {name: one.seconds(name, "processor_seconds")
              for name in SECTIONS}
    result["all"] = sum(result.values())
    result["dofs"] = one.summary["dofs"]
    result["steps"] = len(steps)
    result["iterations"] = sum(int(step["linear_iterations"])
                               for step in steps)
    return result


def median(runs):
    """The run with the median of all seconds."""
    middle = statistics.median_low(one["all"] for one in runs)
    return next(one for one in runs if one["all"] == middle)


def main():
    parser = measured.options(__doc__)
    parser.add_argument("scene", help="a scene of the kind solid")
    parser.add_argument("--levels", default="3")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--tied", default="Pair 1/Tied=true",
                        help="what ties the bodies")
    measured.add_set(parser)
    arguments = parser.parse_args()

    measured.head(COLUMNS)
    tie, tied = arguments.tied.split("=", 1)
    for level in [int(word) for word in arguments.levels.split(",")]:
        alone = {"Refinement/Coarsest level": level}
        kinds = {"tied, algebraic": {**alone, tie: tied,
                                     "Solver/Linear solver": "iterative"},
                 "tied": {**alone, tie: tied}, "contact, nested": {},
                 "contact, cold": alone}
        unit = None
        for kind, settings in kinds.items():
            one = median([run(arguments, level, settings)
                          for _ in range(arguments.repeats)])
            unit = unit or one["assembly"] + one["solve"]
            row = [f"{level}", f"{one['dofs']}", kind, f"{one['steps']}",
                   f"{one['iterations']}"]
            row += [f"{one[name]:.2f}" for name in SECTIONS]
            row += [f"{one['all']:.2f}", f"{one['all'] / unit:.2f}",
                    f"{100 * one['contact rows'] / unit:.1f} %"]
            measured.row(row)


if __name__ == "__main__":
    main()
