#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The traction of Cattaneo and Mindlin's two cylinders on the closed form.

Runs prm/cattaneo-cylinders.prm: pulled to Q1, back to no force, and on to -Q1,
and draws the traction of each node over the curve that theory has for the forces
of that run. Needs Matplotlib.

    tests/bench/cattaneo_picture.py build/release/abut picture.svg
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import pictures

SCENE = (pathlib.Path(__file__).resolve().parents[2]
         / "prm/cattaneo-cylinders.prm")
MU, RADIUS, MODULUS = 0.2, 4., 200. / (2. * (1. - 0.3 ** 2))
PULL, PRESS = 0.03, 0.184


def run(abut, folder, back):
    """Forces along normal and surface, and nodes in contact."""
    steps = 2 if back is None else 3
    way = f"t > 2 ? {PULL} - {back or 0}*(t - 2) : {PULL}*(t - 1)"
    subprocess.run(
        [abut, "run", SCENE, "--output", folder, "--quiet",
         "--set", "Output/Pictures=false",
         "--set", f"Load steps/Steps={steps}",
         "--set", f"Load steps/End time={steps}",
         "--set", f"Body 2/Support=1: (t > 1 ? ({way}) : 0), "
         f"(t < 1 ? -{PRESS}*t : -{PRESS})"], check=True)
    summary = json.loads((folder / "summary.json").read_text())
    with open(folder / "pair_1.csv") as file:
        nodes = [(float(row["x"]), float(row["friction"]))
                 for row in csv.DictReader(file) if float(row["status"]) > 0]
    return (summary["pair_1_normal_force"], summary["pair_1_friction"][0],
            nodes)


def first_load(x, normal, force, mu):
    """Traction of a first load, of its sign."""
    a = math.sqrt(4. * normal * RADIUS / (math.pi * MODULUS))
    c = a * math.sqrt(1. - force / (mu * normal))
    return (mu * 2. * normal / (math.pi * a)
            * (math.sqrt(max(0., 1. - (x / a) ** 2))
               - c / a * math.sqrt(max(0., 1. - (x / c) ** 2))))


def closed_form(x, normal, first, force):
    return (first_load(x, normal, first, MU)
            - first_load(x, normal, first - force, 2. * MU))


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    style = pictures.style
    figure, [[axes]] = style.figure(style.PAGE, 0.5)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        first = None
        for i, (label, back) in enumerate((("$Q = Q_1$", None),
                                           ("$Q = 0$", 0.0295),
                                           ("$Q = -Q_1$", 2. * PULL))):
            normal, force, nodes = run(sys.argv[1], folder / "out", back)
            first = first if first is not None else force
            half = math.sqrt(4. * normal * RADIUS / (math.pi * MODULUS))
            bound = MU * 2. * normal / (math.pi * half)
            edge = 1.05 * max(abs(x) for x, _ in nodes)
            curve = [edge * k / 500. for k in range(-500, 501)]
            axes.plot([x / half for x in curve],
                      [closed_form(x, normal, first, force) / bound
                       for x in curve], color=style.COLOURS[i],
                      linewidth=0.9)
            axes.plot([x / half for x, _ in nodes],
                      [q / bound for _, q in nodes], style.MARKERS[i],
                      color=style.COLOURS[i], fillstyle="none", markersize=3,
                      label=label)
    axes.plot([], [], color=style.GREY, linewidth=0.9,
              label="Cattaneo and Mindlin")
    axes.set_xlabel("position / half width of contact, $x/a$")
    axes.set_ylabel(r"tangential traction $q/(\mu p_0)$")
    style.legend(axes)
    pictures.save(figure, sys.argv[2])


if __name__ == "__main__":
    main()
