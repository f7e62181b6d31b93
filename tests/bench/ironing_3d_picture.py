#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The forces of a round die that is pressed into a block and slides on it, over
time, without friction and with that of the scene.

Runs prm/ironing-3d.prm, draws the vertical and the horizontal force on the die,
and prints load steps, linearisations and what moments of the two sides are out of
balance by at the end. Needs Matplotlib.

    tests/bench/ironing_3d_picture.py build/release/abut picture.svg
"""
import csv
import json
import pathlib
import subprocess
import sys
import tempfile

import pictures

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
    curves = []
    with tempfile.TemporaryDirectory() as folder:
        for mu in ("0", "0.3"):
            rows = run(abut, pathlib.Path(folder) / mu, mu)
            curves.append((mu, [(row["time"], -row["pair_1_force_z"],
                                 row["pair_1_force_x"]) for row in rows]))
    draw(picture, curves)


def draw(picture, curves):
    """Time, vertical and horizontal force for each friction coefficient."""
    style = pictures.style
    figure, [[axes]] = style.figure(style.PAGE, 0.42)
    for n, (mu, rows) in enumerate(curves):
        for name, k in (("vertical $V$", 1), ("horizontal $H$", 2)):
            axes.plot([row[0] for row in rows], [row[k] for row in rows],
                      color=style.COLOURS[n], marker=style.MARKERS[n],
                      linestyle=style.DASHES[k - 1], markersize=2,
                      label=f"{name}, $\\mu$ = {mu}")
    axes.set_xlabel("time $t$: pressed until 1, then drawn")
    axes.set_ylabel("force on the die [force]")
    style.legend(axes)
    pictures.save(figure, picture)


if __name__ == "__main__":
    main()
