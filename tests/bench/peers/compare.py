#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Abut beside CalculiX and GetFEM: errors and wall time of the same problems.

Three problems in 3D (problems.py) on the same hexahedral meshes with linear
displacements, solved by every program that is installed, one at a time, on
one thread, within limits of time and memory. Time is that of the whole
process, its input read and its answer written: the median of the repeats.
Where other work shares the machine, look at the processor's time.

    tests/bench/peers/compare.py --abut build/release/abut --csv peers.csv \\
        --markdown peers.md

Debian's packages: calculix-ccx, python3-getfem. With --libraries every
program runs with the libraries of a folder first, for example those of
libopenblas0-serial instead of the reference BLAS.
"""
import argparse
import os
import statistics
import sys
import tempfile

import abut
import ccx
import figures
import getfem_peer
import problems
import process
import tables

# Program, method, options of its run: kappa is the penalty in units of E/h.
FAST = {"kappa": 100.0, "solver": "ITERATIVE CHOLESKY"}
RUNS = [(ccx, "node to surface", FAST),
        (ccx, "surface to surface", FAST),
        (ccx, "mortar", {}),
        (getfem_peer, "lagrange", {"kappa": 1.0}),
        (getfem_peer, "penalty", {"kappa": 10.0})] + [
            (abut, method, {}) for method in abut.METHODS]


def measure(program, method, options, problem, arguments):
    """Median time of the repeats (no more of them after a minute), answer."""
    answers = []
    while (len(answers) < arguments.repeats
           and sum(answer["wall"] for answer in answers) < 60):
        with tempfile.TemporaryDirectory() as folder:
            answers.append(program.run(
                problem, method, folder, seconds=arguments.seconds,
                gigabytes=arguments.gigabytes, **options))
    for name in ("wall", "processor"):
        answers[0][name] = statistics.median(answer[name]
                                             for answer in answers)
    return answers[0]


def row(program, method, options, problem, arguments):
    """One line of the table; a failure is a line too."""
    line = {"problem": problem["name"], "unknowns":
            problems.unknowns(problem), "program": program.version(),
            "method": method, "options": ", ".join(
                f"{name} {value:g}" if isinstance(value, float)
                else f"{value.lower()}" for name, value in options.items())}
    try:
        with process.alone(arguments.lock):
            answer = measure(program, method, options, problem, arguments)
    except (process.Failure, OSError) as failure:
        return dict(line, remark=str(failure))
    line.update({"wall, s": f"{answer['wall']:.2f}",
                 "processor, s": f"{answer['processor']:.2f}",
                 "iterations": answer["iterations"],
                 "megabytes": f"{answer['megabytes']:.0f}"})
    line.update({name: f"{value:.2e}" for name, value in
                 figures.errors(problem, answer).items()})
    return line


def parse():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--abut", help="the program; without it peers only")
    parser.add_argument("--problems", nargs="*", default=list(problems.SIZES))
    parser.add_argument("--sizes", nargs="*", type=int, default=[0, 1, 2])
    parser.add_argument("--programs", nargs="*", default=None,
                        choices=["ccx", "getfem_peer", "abut"])
    parser.add_argument("--methods", nargs="*", default=None)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=300,
                        help="limit of one run")
    parser.add_argument("--gigabytes", type=float, default=8)
    parser.add_argument("--libraries", help="folder of shared libraries")
    parser.add_argument("--lock", help="file to hold locked in each run")
    parser.add_argument("--csv", help="written line by line")
    parser.add_argument("--markdown")
    return parser.parse_args()


def main():
    arguments = parse()
    abut.PROGRAM = arguments.abut and os.path.abspath(arguments.abut)
    if arguments.libraries:
        process.ONE_THREAD["LD_LIBRARY_PATH"] = os.path.abspath(
            arguments.libraries)
    runs = [run for run in RUNS if run[0].version()
            and arguments.programs in (None, []) or arguments.programs
            and run[0].__name__ in arguments.programs and run[0].version()]
    if arguments.methods:
        runs = [run for run in runs if run[1] in arguments.methods]
    if not runs:
        sys.exit("no program is installed: calculix-ccx, python3-getfem, or "
                 "--abut")
    lines = []
    for name in arguments.problems:
        for size in arguments.sizes:
            problem = problems.make(name, size)
            for program, method, options in runs:
                lines.append(row(program, method, options, problem,
                                 arguments))
                print(lines[-1], flush=True)
                if arguments.csv:
                    tables.write_csv(arguments.csv, lines)
    text = tables.markdown(lines)
    if arguments.markdown:
        with open(arguments.markdown, "w") as file:
            file.write(text)
    print(text)


if __name__ == "__main__":
    main()
