# SPDX-License-Identifier: LGPL-2.1-or-later
"""The example two-bodies: the same on all numbers of ranks, equal forces on
both bodies, the same when contact is loaded at run time instead of linked, and
on its first mesh the same as the program finds for the same scene."""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile

LINE = re.compile(r"cycle (\d+): (\d+) unknowns, (\d+) of (\d+) constraints "
                  r"active, (\d+) steps, force (\S+), forces differ by (\S+)")


def cycles(program, words, ranks, folder):
    """Figures of each cycle: dofs, active, rows, steps, force, imbalance."""
    command = ["mpirun", "--oversubscribe", "-n", str(ranks), program, *words]
    text = subprocess.run(command, cwd=folder, text=True, check=True,
                          capture_output=True, timeout=600).stdout
    return [(int(m[2]), int(m[3]), int(m[4]), int(m[5]), float(m[6]),
             float(m[7])) for m in LINE.finditer(text)]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--loaded", required=True)
    parser.add_argument("--plugin", required=True)
    parser.add_argument("--abut", required=True)
    parser.add_argument("--scene", required=True)
    arguments = parser.parse_args()
    failures = []
    os.environ["ABUT_PLUGIN"] = arguments.plugin

    def expect(condition, message):
        if not condition:
            failures.append(message)

    with tempfile.TemporaryDirectory(prefix="abut-test-") as folder:
        for dim, n_cycles in (("2", 3), ("3", 1)):
            words = [dim, str(n_cycles)]
            serial = cycles(arguments.program, words, 1, folder)
            expect(len(serial) == n_cycles, f"{len(serial)} cycles in {dim}D")
            for dofs, active, rows, steps, force, imbalance in serial:
                what = f"{dim}D, {dofs} unknowns"
                expect(0 < active < rows, f"{what}: {active} of {rows} active")
                expect(force > 0, f"{what}: force {force}")
                expect(imbalance < 1e-11, f"{what}: imbalance {imbalance}")
                expect(steps <= 5, f"{what}: {steps} steps")
            for one, other in zip(serial, cycles(arguments.loaded, words, 1,
                                                 folder)):
                what = f"{dim}D, {one[0]} unknowns, loaded at run time"
                expect(one[:4] == other[:4], f"{what}: {other}, not {one}")
                expect(abs(one[4] - other[4]) <= 1e-12 * one[4],
                       f"{what}: force {other[4]}, not {one[4]}")
            for ranks in (2, 3) if dim == "2" else (2,):
                for one, other in zip(serial, cycles(arguments.program, words,
                                                     ranks, folder)):
                    what = f"{dim}D, {one[0]} unknowns, {ranks} ranks"
                    expect(one[:3] == other[:3], f"{what}: {other}, not {one}")
                    # in space one rank has a multigrid that several have not
                    expect(abs(one[3] - other[3]) <= (dim == "3"),
                           f"{what}: {other[3]} steps, not {one[3]}")
                    expect(abs(one[4] - other[4]) <= 1e-8 * one[4],
                           f"{what}: force {other[4]}, not {one[4]}")
            expect(os.path.exists(os.path.join(folder, "two-bodies.vtu")),
                   "a file with the solution")
            if dim == "2":
                subprocess.run([arguments.abut, "run", arguments.scene,
                                "--output", "scene"], cwd=folder, check=True,
                               capture_output=True, timeout=600)
                with open(os.path.join(folder, "scene/summary.json")) as file:
                    summary = json.load(file)
                dofs, active, rows, _, force, _ = serial[0]
                expect((summary["dofs"], summary["active"],
                        summary["constraints"]) == (dofs, active, rows),
                       "unknowns and rows as in the scene")
                expect(abs(summary["contact_force"] - force) <= 1e-12 * force,
                       f"force {force}, not {summary['contact_force']} as in "
                       "the scene")
    for message in failures:
        print("FAILED:", message)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
