#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The forces of shallow ironing over time, with the published ones at t = 1.5.

Runs prm/ironing.prm at each refinement level that is named, prints the forces at
t = 1.5 and draws both of the last level and the vertical one of the others; bars
are the published ranges, V from 337 to 421 and H from 102 to 189. Needs
Matplotlib.

    tests/bench/ironing_picture.py build/release/abut picture.svg 1 2
"""
import pathlib
import statistics
import sys
import tempfile

import pictures

PUBLISHED = {"V": (337., 421.), "H": (102., 189.)}


def forces(abut, folder, level):
    """Time, vertical and horizontal force on the die, by load step."""
    table = pictures.run(abut, "ironing.prm", folder, f"Refinement/Level={level}",
                         "Output/Fields=false").table("levels.csv")
    return list(zip(table["time"], -table["pair_1_force_y"], table["pair_1_force_x"]))


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
    style = pictures.style
    figure, [[axes]] = style.figure(style.PAGE, 0.45)
    for n, (level, rows) in enumerate(curves):
        for name, k, dashes in (("vertical $V$", 1, "-"),
                                ("horizontal $H$", 2, style.DASHES[1])):
            axes.plot([row[0] for row in rows], [row[k] for row in rows],
                      color=style.COLOURS[n], linestyle=dashes,
                      label=f"{name}, level {level}")
    for (name, (low, high)), shift in zip(PUBLISHED.items(), (-0.01, 0.01)):
        axes.errorbar(1.5 + shift, (low + high) / 2, (high - low) / 2,
                      color=style.BLACK, capsize=3, linewidth=1.4, zorder=3,
                      fmt="s" if name == "V" else "D",
                      label=f"${name}$, range of published results")
    axes.set_xlabel("time $t$: pressed until 1, then drawn")
    axes.set_ylabel("force on the die [N/mm]")
    style.legend(axes)
    pictures.save(figure, picture)


if __name__ == "__main__":
    main()
