#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Work of a whole contact solve in space as a multiple of one linear solve.

A rigid ball on an elastic cube (prm/elastic-sphere.prm, all levels of nested
iteration: assembly, transfer, contact rows, linear solves) against the same cube
with its top moved down (tests/bench/tied-block.prm, cold, assembly + ML + CG).
Pairs of runs in turn; processor times, as other programs may be running.

    tests/bench/block_speed.py build/release/abut --levels 4,5
"""
import pathlib
import statistics

import measured

HERE = pathlib.Path(__file__).parent
COUNTED = ["assembly", "transfer", "contact rows", "solve"]


def work(run):
    return sum(run.seconds(name, "processor_seconds") for name in COUNTED)


def main():
    parser = measured.options(__doc__)
    parser.add_argument("--levels", default="4,5")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--solver", default="geometric",
                        help="Solver/Linear solver of the contact solve")
    arguments = parser.parse_args()
    measured.head(["level", "unknowns", "linear solve", "contact solve",
                   "ratio of work", "iterations, linear solve",
                   "iterations, contact, last level", "MiB, linear",
                   "MiB, contact"])
    for level in [int(word) for word in arguments.levels.split(",")]:
        pairs = []
        for _ in range(arguments.repeats):
            common = {"Refinement/Level": level, **measured.SILENT}
            tied = measured.Run(arguments.abut, HERE / "tied-block.prm",
                                {**common, "Solver/Linear solver": "iterative"})
            contact = measured.Run(
                arguments.abut, HERE.parent.parent / "prm/elastic-sphere.prm",
                {**common, "Solver/Linear solver": arguments.solver})
            pairs.append((tied, contact))

        def middle(value):
            return statistics.median(value(*pair) for pair in pairs)

        tied, contact = pairs[0]
        key = "linear_iterations_on_last_level"
        measured.row([
            level, contact.summary["dofs"],
            f"{middle(lambda a, b: work(a)):.3f}",
            f"{middle(lambda a, b: work(b)):.3f}",
            f"{middle(lambda a, b: work(b) / work(a)):.2f}",
            tied.summary[key], contact.summary[key],
            f"{tied.summary['peak_memory_mb']:.0f}",
            f"{contact.summary['peak_memory_mb']:.0f}"])


if __name__ == "__main__":
    main()
