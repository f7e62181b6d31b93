# SPDX-License-Identifier: LGPL-2.1-or-later
"""The example elasto-plastic: contact forces of deal.II's step-42 on its
meshes, by Abut loaded at run time; with friction, also linked."""
import argparse
import json
import subprocess
import sys

# Cycle: cells, unknowns, nodes in contact and contact force of step-42.
STEP_42 = {0: (512, 2187, 1, 37.3058), 3: (14652, 52497, 145, 56.794)}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--linked", required=True)
    parser.add_argument("--plugin", required=True)
    arguments = parser.parse_args()
    failures = []

    def expect(condition, message):
        if not condition:
            failures.append(message)

    def cycles(ranks, n, *words, program=(arguments.program,
                                          arguments.plugin)):
        text = subprocess.run(
            ["mpirun", "--oversubscribe", "-n", str(ranks), *program, str(n),
             *words], text=True, check=True, capture_output=True,
            timeout=600).stdout
        return [json.loads(line) for line in text.splitlines()]

    serial = cycles(1, 4, "--tolerance", "1e-8")
    for number, (cells, dofs, active, force) in STEP_42.items():
        row = serial[number]
        what = f"cycle {number}"
        expect((row["cells"], row["dofs"]) == (cells, dofs),
               f"{what}: {row['cells']} cells, {row['dofs']} unknowns")
        expect(row["active"] == active, f"{what}: {row['active']} active")
        expect(abs(row["force"] / force - 1) < 1e-4,
               f"{what}: force {row['force']}, not {force}")
    for row in serial:
        what = f"cycle {row['cycle']}"
        expect(row["error"] <= 1e-8, f"{what}: error {row['error']}")
        expect(row["penetration"] < 1e-10,
               f"{what}: penetration {row['penetration']}")
        expect(row["steps"] <= 10, f"{what}: {row['steps']} linearisations")
    from_zero = cycles(1, 2, "--cold", "--tight", "--fresh")
    expect(abs(from_zero[1]["force"] / serial[1]["force"] - 1) < 1e-4,
           f"force {from_zero[1]['force']} from zero")
    for one, other in zip(serial, cycles(2, 2, "--tolerance", "1e-8")):
        what = f"cycle {one['cycle']} on 2 ranks"
        expect(one["active"] == other["active"], f"{what}: active set")
        expect(abs(one["force"] / other["force"] - 1) < 1e-6,
               f"{what}: force {other['force']}, not {one['force']}")
    # The ball is dragged, by more than the cube gives way: all of it slides, and
    # T = mu N.
    for ranks, mu in ((1, 0.1), (2, 0.1), (1, 1.)):
        words = ("--friction", str(mu), "--tolerance", "1e-8")
        loaded = cycles(ranks, 2, *words)
        # The same lines do it where Abut is linked, not loaded.
        linked = cycles(ranks, 2, *words, program=(arguments.linked, "none"))
        for one, other in zip(loaded, linked):
            for key in ("active", "slipping", "steps", "force", "friction"):
                expect(abs(one[key] - other[key]) <= 1e-10 * one[key],
                       f"cycle {one['cycle']}, linked: {key} {other[key]}, "
                       f"not {one[key]}")
        expect(len(linked) == 2, f"{len(linked)} cycles, linked")
        for row, smooth in zip(loaded, serial):
            what = f"cycle {row['cycle']}, mu = {mu}, {ranks} ranks"
            expect(row["slipping"] == row["active"],
                   f"{what}: {row['slipping']} of {row['active']} slip")
            expect(abs(row["friction"] / row["force"] - mu) < 1e-7 * mu,
                   f"{what}: T/N {row['friction'] / row['force']}")
            expect(row["force"] < 0.999 * smooth["force"],
                   f"{what}: force {row['force']}, {smooth['force']} without")
    expect(serial[1]["friction"] == 0, "friction without a coefficient")
    for message in failures:
        print("FAILED:", message)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
