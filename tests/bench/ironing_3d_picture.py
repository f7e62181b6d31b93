#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The forces of a round die that is pressed into a block and slides on it, over
time, without friction and with that of the scene.

Runs prm/ironing-3d.prm, draws the vertical and the horizontal force on the die,
and prints load steps, linearisations and what moments of the two sides are out of
balance by at the end. Needs Matplotlib.

    tests/bench/ironing_3d_picture.py build/release/abut picture.svg
"""
import pathlib
import sys
import tempfile

import pictures


def run(abut, folder, mu):
    """Time, vertical and horizontal force on the die, by load step."""
    done = pictures.run(abut, "ironing-3d.prm", folder, f"Pair 1/Friction={mu}",
                        "Output/Fields=false")
    table, steps = done.table("levels.csv"), list(done.table("newton.csv")["load_step"])
    counts = [steps.count(step) for step in dict.fromkeys(steps)]
    time, v, h = table["time"], -table["pair_1_force_z"], table["pair_1_force_x"]
    slid = time > 1.01
    ratios = h[slid] / v[slid]
    print(f"mu = {mu}: {len(time)} load steps, {sum(counts)} linearisations, "
          f"at the most {max(counts)}; sliding: V from {min(v[slid]):.4g} to "
          f"{max(v[slid]):.4g}, H/V from {min(ratios):.4g} to {max(ratios):.4g}; "
          f"moments out of balance by {done.summary['moment_imbalance']:.2g}")
    return time, v, h


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    abut, picture = sys.argv[1:]
    curves = []
    with tempfile.TemporaryDirectory() as folder:
        for mu in ("0", "0.3"):
            curves.append((mu, run(abut, pathlib.Path(folder) / mu, mu)))
    draw(picture, curves)


def draw(picture, curves):
    style = pictures.style
    figure, [[axes]] = style.figure(style.PAGE, 0.42)
    for n, (mu, columns) in enumerate(curves):
        for name, k in (("vertical $V$", 1), ("horizontal $H$", 2)):
            axes.plot(columns[0], columns[k],
                      color=style.COLOURS[n], marker=style.MARKERS[n],
                      linestyle=style.DASHES[k - 1], markersize=2,
                      label=f"{name}, $\\mu$ = {mu}")
    axes.set_xlabel("time $t$: pressed until 1, then drawn")
    axes.set_ylabel("force on the die [force]")
    style.legend(axes)
    pictures.save(figure, picture)


if __name__ == "__main__":
    main()
