#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""step-41 beside PETSc's SNESVI with grid sequencing and hypre's BoomerAMG.

Compiles peers/snesvi.c with the PETSc that pkg-config finds (on Debian it comes
with deal.II), and runs it and Abut in turn, each nested from level 3 on, on one
rank. Both must have as many nodes in contact, and the same energy and force to
1e-9. Processor seconds, medians: SNESVI from its first grid to the last answer;
Abut's contact solve (assembly, transfer, contact rows and start, linear solves
on all levels), and all-in, that is with its adaptive meshes, numbering and
sparsity patterns, for which a structured grid needs next to nothing.

    tests/bench/snesvi_speed.py build/release/abut
"""
import json
import pathlib
import shlex
import statistics
import subprocess
import tempfile

import measured
from obstacle_speed import COUNTED, SECTIONS

HERE = pathlib.Path(__file__).resolve().parent
SCENE = HERE.parents[1] / "prm" / "step-41.prm"
COARSEST = 3
# Loose linear systems and full steps are the fastest that were found; -pc_type
# mg with Galerkin's coarse matrices is as fast.
OPTIONS = ("-pc_type hypre -ksp_type cg -ksp_rtol 1e-2 "
           "-snes_linesearch_type basic -snes_rtol 1e-10 -snes_atol 1e-11")


def build(folder):
    flags = subprocess.run(["pkg-config", "--cflags", "--libs", "petsc"],
                           check=True, capture_output=True, text=True).stdout
    program = pathlib.Path(folder) / "snesvi"
    subprocess.run(["mpicc", "-O2", "-o", program, HERE / "peers/snesvi.c",
                    *shlex.split(flags), "-lm"], check=True,
                   capture_output=True)
    return program


def run_peer(program, level, options):
    done = subprocess.run(
        [program, "-coarsest", str(COARSEST), "-snes_grid_sequence",
         str(level - COARSEST), *options.split()],
        check=True, capture_output=True, text=True,
        env=measured.environment())
    return json.loads(done.stdout.splitlines()[0])


def run_abut(arguments, level):
    return measured.Run(
        arguments.abut, SCENE,
        {"Refinement/Level": level, "Refinement/Coarsest level": COARSEST,
         **measured.SILENT}, arguments.set)


def require_same(peer, own, level):
    if own["active"] != peer["active"]:
        raise SystemExit(f"level {level}: {own['active']} nodes in contact, "
                         f"PETSc has {peer['active']}")
    for name, value in (("energy", own["energy"]),
                        ("force", own["contact_force"])):
        if abs(value / peer[name] - 1.) > 1e-9:
            raise SystemExit(f"level {level}: {name} {value}, PETSc has "
                             f"{peer[name]}")


def main():
    parser = measured.options(__doc__)
    parser.add_argument("--levels", default="8,9,10")
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--options", default=OPTIONS, help="of PETSc")
    measured.add_set(parser)
    arguments = parser.parse_args()
    measured.head(["level", "unknowns", "SNESVI", "contact solve", "ratio",
                   "all-in", "ratio", "steps on the last level, both"])
    with tempfile.TemporaryDirectory() as folder:
        program = build(folder)
        for level in map(int, arguments.levels.split(",")):
            peers, own = [], []
            for _ in range(arguments.repeats):
                peers.append(run_peer(program, level, arguments.options))
                own.append(run_abut(arguments, level))
                require_same(peers[-1], own[-1].summary, level)

            def seconds(one, names):
                return sum(one.seconds(name, "processor_seconds")
                           for name in names)

            pairs = [(peer["processor_seconds"], seconds(one, COUNTED),
                      seconds(one, SECTIONS))
                     for peer, one in zip(peers, own)]

            def middle(value):
                return statistics.median(value(*pair) for pair in pairs)

            measured.row([
                level, peers[0]["unknowns"],
                f"{middle(lambda p, c, a: p):.2f}",
                f"{middle(lambda p, c, a: c):.2f}",
                f"{middle(lambda p, c, a: c / p):.2f}",
                f"{middle(lambda p, c, a: a):.2f}",
                f"{middle(lambda p, c, a: a / p):.2f}",
                f"{peers[0]['steps']}, {own[0].levels[-1]['steps']}"])


if __name__ == "__main__":
    main()
