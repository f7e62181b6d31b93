#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The forces of shallow ironing over time, with the published ones at t = 1.5.

Runs prm/ironing.prm at each refinement level that is named, prints the forces at
t = 1.5 and draws both of the last level and the vertical one of the others; bars
are the published ranges, V from 337 to 421 and H from 102 to 189. Needs gnuplot.

    tests/bench/ironing_picture.py build/release/abut picture.svg 1 2
"""
import csv
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "prm/ironing.prm"
PUBLISHED = {"V": (337., 421.), "H": (102., 189.)}


def forces(abut, folder, level):
    """Time, vertical and horizontal force on the die, by load step."""
    subprocess.run(
        [abut, "run", SCENE, "--output", folder, "--quiet",
         "--set", f"Refinement/Level={level}", "--set", "Output/Fields=false",
         "--set", "Output/Pictures=false"], check=True)
    with open(folder / "levels.csv", encoding="utf-8") as file:
        return [[float(row["time"]), -float(row["pair_1_force_y"]),
                 float(row["pair_1_force_x"])] for row in csv.DictReader(file)]


def main():
    if len(sys.argv) < 4:
        raise SystemExit(__doc__)
    abut, picture, *levels = sys.argv[1:]
    curves = []
    with tempfile.TemporaryDirectory() as folder:
        for level in levels:
            rows = forces(abut, pathlib.Path(folder) / level, level)
            half = min(rows, key=lambda row: abs(row[0] - 1.5))
            way = [row for row in rows if 1.2 <= row[0] <= 1.8]
            print(f"level {level}: t = {half[0]:.4g}: V = {half[1]:.1f}, "
                  f"H = {half[2]:.1f}; t = 1.2 to 1.8: H/V from "
                  f"{min(h / v for _, v, h in way):.4f} to "
                  f"{max(h / v for _, v, h in way):.4f}, V from "
                  f"{min(v for _, v, _ in way):.1f} to "
                  f"{max(v for _, v, _ in way):.1f}, ripple "
                  f"{ripple([v for _, v, _ in way]):.2g}; "
                  f"{len(rows)} load steps to t = {rows[-1][0]:.4g}")
            curves.append((level, rows))
    draw(picture, curves)


def ripple(values):
    return statistics.pstdev(values) / statistics.mean(values)


def draw(picture, curves):
    plots, data = [], []
    for n, (level, rows) in enumerate(curves, 1):
        for name, k in (("V", 1), ("H", 2)):
            plots.append(f"'-' with lines lc {n} dt {k} "
                         f"title '{name}, level {level}'")
            data.append([(row[0], row[k]) for row in rows])
    for name, (low, high) in PUBLISHED.items():
        plots.append("'-' with yerrorbars pt 0 lw 2 lc 'black' "
                     f"title '{name}, published'")
        data.append([(1.5, (low + high) / 2, low, high)])
    script = ("set terminal svg size 640,420\n"
              f"set output '{picture}'\n"
              "set xlabel 't'\nset ylabel 'force on the die, N per mm'\n"
              "set key outside\nplot " + ", ".join(plots) + "\n")
    for points in data:
        script += "".join(" ".join(f"{x:.6g}" for x in point) + "\n"
                          for point in points) + "e\n"
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


if __name__ == "__main__":
    main()
