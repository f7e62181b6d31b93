#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""What friction costs the iterative solver.

Runs two cubes that are pressed together and moved aside, on each level without
friction, with so little motion that all sticks, and with so much that all
slips. Iterations are those of the accurate systems (to 1e-10) of the finest
mesh, which is the only one here; the time per linear system is that of all of
them, with what preconditioners cost, by the processor and in multiples of that
without friction.

    tests/bench/friction_cost.py build/release/abut
"""
import pathlib

import measured

SCENE = pathlib.Path(__file__).resolve().parents[2] / "prm/two-blocks-3d.prm"
SLIDES, STICKS = "5: 0.2, 0.1, -0.02", "5: 0.06, 0.03, -0.02"
CASES = (("without friction", 0, SLIDES), ("all sticks", 1, STICKS),
         ("all slips, mu = 0.3", 0.3, SLIDES), ("all slips, mu = 1", 1, SLIDES))


def run(arguments, level, mu, support):
    one = measured.Run(
        arguments.abut, SCENE,
        {**measured.SILENT, "Refinement/Level": level,
         "Refinement/Coarsest level": level,
         "Pair 1/Friction": mu, "Body 2/Prescribed displacement": support,
         "Solid/Accept strains beyond linear theory": "true",
         "Solver/Linear solver": arguments.linear}, arguments.set)
    steps = [step for step in one.steps if int(step["level"]) == level]
    seconds = one.seconds("solve", "processor_seconds")
    return (one.summary, [int(s["linear_iterations"]) for s in steps],
            sum(int(s["setups"]) for s in steps), seconds / len(steps))


def main():
    parser = measured.options(__doc__)
    parser.add_argument("--levels", default="2,3")
    parser.add_argument("--linear", default="geometric",
                        help="Solver/Linear solver")
    measured.add_set(parser)
    arguments = parser.parse_args()
    measured.head(["unknowns", "case", "slip", "systems", "setups",
                   "iterations of each", "s per system", "of frictionless"])
    for level in [int(word) for word in arguments.levels.split(",")]:
        frictionless = None
        for name, mu, support in CASES:
            summary, iterations, setups, seconds = run(arguments, level, mu,
                                                       support)
            frictionless = frictionless or seconds
            measured.row([summary["dofs"], name,
                          summary.get("pair_1_slipping", "-"), len(iterations),
                          setups, " ".join(map(str, iterations)),
                          f"{seconds:.2f}", f"{seconds / frictionless:.2f}"])


if __name__ == "__main__":
    main()
