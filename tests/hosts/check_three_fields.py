# SPDX-License-Identifier: LGPL-2.1-or-later
"""A host whose element has a pressure and a dilatation beside the displacement:
pressed flat, as a closed form has it; sliding over many facets, as the program
has the same scene with a displacement alone; contact in 40 lines; and the same
when contact is loaded at run time instead of linked, and on two ranks."""
import argparse
import csv
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "app"))
from program import Folder  # noqa: E402
from sliding_scenes import slide  # noqa: E402

MU, LAMBDA = 1 / 2.6, 0.3 / (1.3 * 0.4)


def steps(program, *words, ranks=1):
    """Time, force along and upwards, energy and linearisations."""
    command = ["mpirun", "--oversubscribe", "-n", str(ranks), program, *words]
    text = subprocess.run(command, text=True, check=True, capture_output=True,
                          timeout=900).stdout
    return [[float(word) for word in line.split()]
            for line in text.splitlines()]


def pressed(stretch):
    """Force and energy of a bar of width 1 and height 2 in plane strain that is
    free to grow sideways."""
    low, high = 1., 3.
    for _ in range(200):
        side = (low + high) / 2
        stress = MU * (side - 1 / side) + LAMBDA * math.log(side * stretch) / side
        low, high = (low, side) if stress > 0 else (side, high)
    log_j = math.log(side * stretch)
    force = MU * (stretch - 1 / stretch) + LAMBDA * log_j / stretch
    energy = (MU / 2 * (side**2 + stretch**2 + 1 - 3 - 2 * log_j)
              + LAMBDA / 2 * log_j**2)
    return force, 2 * energy


def main():
    parser = argparse.ArgumentParser()
    for name in ("program", "loaded", "plugin", "abut", "source"):
        parser.add_argument("--" + name, required=True)
    arguments = parser.parse_args()
    os.environ["ABUT_PLUGIN"] = arguments.plugin
    failures = []

    def expect(condition, message):
        if not condition:
            failures.append(message)

    def close(value, expected, scale, tolerance, message):
        expect(abs(value - expected) <= tolerance * abs(scale),
               f"{message}: {value} is not {expected}")

    text = pathlib.Path(arguments.source).read_text()
    parts = re.findall(r"// contact\n(.*?)// end of contact", text, re.S)
    lines = [line for part in parts for line in part.splitlines()
             if line.strip()]
    lines += [line for line in text.splitlines()
              if "contact_assembler.h" in line or "contact(MPI" in line
              or "ContactAssembler<dim> contact;" in line]
    print(f"{len(lines)} lines for contact")
    expect(len(parts) == 2 and len(lines) <= 40,
           f"{len(lines)} lines for contact in {len(parts)} places")

    for fields in ("dgq", "dgp"):
        for t, x, y, energy, _ in steps(arguments.program, "press", fields):
            force, whole = pressed(1 - 0.15 * t)
            what = f"{fields} pressed, t = {t}"
            close(y, force, force, 1e-9, f"{what}: force")
            close(x, 0., force, 1e-9, f"{what}: force sideways")
            close(energy, whole, whole, 1e-9, f"{what}: energy")

    slid = steps(arguments.program, "slide", "dgq")
    with tempfile.TemporaryDirectory(prefix="abut-test-") as folder:
        scene = slide(Folder(folder), 40, 10, 12, 5, 22)
        subprocess.run(
            [arguments.abut, "run", scene, "--output", "out", "--quiet",
             "--set", "Time stepping/Newton tolerance=1e-12",
             "--set", "Method/Final linear tolerance=1e-14"],
            cwd=folder, check=True)
        with open(pathlib.Path(folder) / "out/levels.csv",
                  encoding="utf-8") as file:
            rows = [{key: float(value) for key, value in row.items() if value}
                    for row in csv.DictReader(file)]
    expect(len(slid) == len(rows) == 44, f"{len(slid)} and {len(rows)} steps")
    for (t, x, y, energy, _), row in zip(slid, rows):
        what = f"slid, t = {t}"
        close(x, row["pair_1_force_x"], y, 1e-8, f"{what}: force along")
        close(y, row["pair_1_force_y"], y, 1e-8, f"{what}: force upwards")
        close(energy, row["energy"], energy, 1e-8, f"{what}: energy")
    n = [row[-1] for row in slid]
    print(f"linearisations: {sum(n) / len(n):.1f} in the mean, {max(n):.0f} at "
          "the most")

    constant = steps(arguments.program, "slide", "dgp")
    expect(len(constant) == 44, f"dgp: {len(constant)} steps")
    # Another element: with J by cells it is a little softer.
    close(constant[-1][2], slid[-1][2], slid[-1][2], 0.05, "dgp: force")
    for program, ranks, what in ((arguments.loaded, 1, "loaded"),
                                 (arguments.program, 2, "two ranks")):
        for one, other in zip(constant, steps(program, "slide", "dgp",
                                              ranks=ranks)):
            for k in (1, 2, 3):
                close(other[k], one[k], one[2 if k < 3 else 3], 1e-8,
                      f"{what}, t = {one[0]}")

    for failure in failures:
        print("FAILED:", failure)
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
