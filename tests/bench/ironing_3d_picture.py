#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The forces of a round die that is pressed into a block and slides on it, over
time, without friction and with that of the scene.

Runs prm/ironing-3d.prm, draws the vertical and the horizontal force on the die,
and prints load steps, linearisations and what moments of the two sides are out of
balance by at the end. Needs gnuplot.

    tests/bench/ironing_3d_picture.py build/release/abut picture.svg
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "prm/ironing-3d.prm"


def run(abut, folder, mu):
    subprocess.run(
        [abut, "run", SCENE, "--output", folder, "--quiet",
         "--set", f"Pair 1/Friction={mu}", "--set", "Output/Fields=false",
         "--set", "Output/Pictures=false"], check=True)
    with open(folder / "levels.csv", encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items() if value}
                for row in csv.DictReader(file)]
    with open(folder / "newton.csv", encoding="utf-8") as file:
        steps = [row["load_step"] for row in csv.DictReader(file)]
    counts = [steps.count(step) for step in dict.fromkeys(steps)]
    summary = json.loads((folder / "summary.json").read_text())
    slid = [row for row in rows if row["time"] > 1.01]
    ratios = [-row["pair_1_force_x"] / row["pair_1_force_z"] for row in slid]
    print(f"mu = {mu}: {len(rows)} load steps, {sum(counts)} linearisations, "
          f"at the most {max(counts)}; sliding: V from "
          f"{min(-row['pair_1_force_z'] for row in slid):.4g} to "
          f"{max(-row['pair_1_force_z'] for row in slid):.4g}, H/V from "
          f"{min(ratios):.4g} to {max(ratios):.4g}; moments out of balance by "
          f"{summary['moment_imbalance']:.2g}")
    return rows


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    abut, picture = sys.argv[1:]
    plots, data = [], []
    with tempfile.TemporaryDirectory() as folder:
        for n, mu in enumerate(("0", "0.3"), 1):
            rows = run(abut, pathlib.Path(folder) / mu, mu)
            for name, axis, sign, dash in (("V", "z", -1, 1), ("H", "x", 1, 2)):
                plots.append(f"'-' with linespoints pt 7 ps 0.3 lc {n} dt {dash} "
                             f"title '{name}, mu = {mu}'")
                data.append([(row["time"], sign * row[f"pair_1_force_{axis}"])
                             for row in rows])
    script = ("set terminal svg size 640,360\n"
              f"set output '{picture}'\n"
              "set xlabel 't'\nset ylabel 'force on the die'\n"
              "set key outside\nplot " + ", ".join(plots) + "\n")
    for points in data:
        script += "".join(f"{x:.6g} {y:.6g}\n" for x, y in points) + "e\n"
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


if __name__ == "__main__":
    main()
