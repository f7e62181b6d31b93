#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Time of a whole contact solve as a multiple of one linear solve.

Runs a scene of the kind `obstacle` on several levels, several times each, on
one rank (or more). The contact solve counts all levels of nested iteration:
assembly, transfer, contact rows and start, linear solves, to the final linear
tolerance; mesh, numbering and sparsity pattern are listed apart. The linear
solve is assembly + ML + CG to 1e-10 of the same problem without obstacle on
the finest mesh, the median of five in the same run. Medians over runs; `ratio
of work` is that of processor times, for machines with other work on them.

    tests/bench/obstacle_speed.py build/release/abut prm/step-41.prm
"""
import statistics

import measured

COUNTED = ["assembly", "transfer", "contact rows and start", "solve"]
SECTIONS = ["mesh", "unknowns and pattern", "assembly", "transfer",
            "contact rows and start", "solve"]


def run(arguments, level):
    """One run on a level."""
    return measured.Run(
        arguments.abut, arguments.scene,
        {"Refinement/Level": level, **measured.SILENT,
         "Output/Linear solves for comparison": 5}, arguments.set,
        arguments.ranks)


def work_ratio(one):
    """Processor time of the contact solve by that of the linear solve."""
    return (sum(one.seconds(name, "processor_seconds") for name in COUNTED)
            / one.summary["linear_solve_processor_seconds"])


def main():
    parser = measured.options(__doc__)
    parser.add_argument("scene", help="a scene of the kind obstacle")
    parser.add_argument("--levels", default="7,8,9,10")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--ranks", type=int, default=1)
    measured.add_set(parser)
    arguments = parser.parse_args()

    columns = ["level", "unknowns", "linear solve", "contact solve", "ratio",
               "ratio of work", "iterations, last level", "all-in"] + SECTIONS + ["ML set-up, last level",
                                       "Krylov, last level",
                                       "bytes per unknown"]
    measured.head(columns)
    for level in [int(word) for word in arguments.levels.split(",")]:
        runs = [run(arguments, level) for _ in range(arguments.repeats)]

        def middle(value):
            return statistics.median(value(one) for one in runs)

        dofs = runs[0].summary["dofs"]
        row = [f"{level}", f"{dofs}",
               f"{middle(lambda r: r.summary['linear_solve_seconds']):.3f}",
               f"{middle(lambda r: r.summary['contact_solve_seconds']):.3f}",
               f"{middle(lambda r: r.summary['contact_to_linear_ratio']):.2f}"]
        row.append(f"{middle(work_ratio):.2f}")
        row.append(f"{runs[0].levels[-1]['linear_iterations']}")
        all_in = middle(lambda r: sum(map(r.seconds, SECTIONS)))
        row.append(f"{all_in:.3f}")
        for name in SECTIONS:
            row.append(f"{middle(lambda r: r.seconds(name)):.3f}")
        for name in ("setup_seconds", "krylov_seconds"):
            row.append(f"{middle(lambda r: float(r.levels[-1][name])):.3f}")
        memory = middle(lambda r: r.summary["peak_memory_mb"]) * 2 ** 20 / dofs
        row.append(f"{memory:.0f}")
        measured.row(row)


if __name__ == "__main__":
    main()
