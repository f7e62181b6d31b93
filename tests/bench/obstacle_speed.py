#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Time of a whole contact solve as a multiple of one linear solve.

Runs a scene of the kind `obstacle` on several levels, several times each, on
one rank (or more). The contact solve counts all levels of nested iteration:
assembly, transfer, contact rows and start, linear solves, to the final linear
tolerance; mesh, numbering and sparsity pattern are listed apart. The linear
solve is assembly + ML + CG to 1e-10 of the same problem without obstacle on
the finest mesh, the median of five in the same run. Medians over runs.

    tests/bench/obstacle_speed.py build/release/abut prm/step-41.prm
"""
import argparse
import csv
import json
import os
import statistics
import subprocess
import tempfile

SECTIONS = ["mesh", "unknowns and pattern", "assembly", "transfer",
            "contact rows and start", "solve"]


def run(arguments, level):
    """Summary and last level of one run."""
    with tempfile.TemporaryDirectory() as folder:
        command = [arguments.abut, "run", arguments.scene, "--quiet",
                   "--output", folder]
        settings = {"Refinement/Level": level, "Output/Fields": "false",
                    "Output/Pictures": "false",
                    "Output/Linear solves for comparison": 5}
        for name, value in settings.items():
            command += ["--set", f"{name}={value}"]
        for setting in arguments.set:
            command += ["--set", setting]
        if arguments.ranks > 1:
            command = ["mpirun", "--oversubscribe", "-n",
                       str(arguments.ranks)] + command
        environment = dict(os.environ, DEAL_II_NUM_THREADS="1",
                           OMP_NUM_THREADS="1")
        subprocess.run(command, check=True, env=environment)
        with open(os.path.join(folder, "summary.json")) as file:
            summary = json.load(file)
        with open(os.path.join(folder, "levels.csv")) as file:
            last = list(csv.DictReader(file))[-1]
    return summary, last


def seconds(summary, name):
    """Seconds of a section of the summary's table."""
    entry = summary["sections"].get(name, {})
    return entry.get("seconds", 0.0) if isinstance(entry, dict) else entry


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("abut", help="the program")
    parser.add_argument("scene", help="a scene of the kind obstacle")
    parser.add_argument("--levels", default="7,8,9,10")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--set", action="append", default=[],
                        help="further parameters, as for abut run")
    arguments = parser.parse_args()

    columns = ["level", "unknowns", "linear solve", "contact solve", "ratio",
               "all-in"] + SECTIONS + ["ML set-up, last level",
                                       "Krylov, last level",
                                       "bytes per unknown"]
    print("| " + " | ".join(columns) + " |")
    print("|" + "---|" * len(columns), flush=True)
    for level in [int(word) for word in arguments.levels.split(",")]:
        runs = [run(arguments, level) for _ in range(arguments.repeats)]

        def middle(value):
            return statistics.median(value(*one) for one in runs)

        dofs = runs[0][0]["dofs"]
        row = [f"{level}", f"{dofs}",
               f"{middle(lambda s, _: s['linear_solve_seconds']):.3f}",
               f"{middle(lambda s, _: s['contact_solve_seconds']):.3f}",
               f"{middle(lambda s, _: s['contact_to_linear_ratio']):.2f}"]
        all_in = middle(lambda s, _: sum(seconds(s, name)
                                         for name in SECTIONS))
        row.append(f"{all_in:.3f}")
        for name in SECTIONS:
            row.append(f"{middle(lambda s, _: seconds(s, name)):.3f}")
        row.append(f"{middle(lambda _, l: float(l['setup_seconds'])):.3f}")
        row.append(f"{middle(lambda _, l: float(l['krylov_seconds'])):.3f}")
        memory = middle(lambda s, _: s["peak_memory_mb"]) * 2 ** 20 / dofs
        row.append(f"{memory:.0f}")
        print("| " + " | ".join(row) + " |", flush=True)


if __name__ == "__main__":
    main()
