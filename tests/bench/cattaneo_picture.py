#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The traction of Cattaneo and Mindlin's two cylinders on the closed form.

Runs prm/cattaneo-cylinders.prm: pulled to Q1, back to no force, and on to -Q1,
and draws the traction of each node over the curve that theory has for the forces
of that run. Needs gnuplot.

    tests/bench/cattaneo_picture.py build/release/abut picture.svg
"""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

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
         "--set", f"Time stepping/Number of steps={steps}",
         "--set", f"Time stepping/End time={steps}",
         "--set", f"Body 2/Prescribed displacement=1: (t > 1 ? ({way}) : 0), "
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
    plots, data = [], []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        first = None
        for label, back in (("Q = Q1", None), ("Q = 0", 0.0295),
                            ("Q = -Q1", 2. * PULL)):
            normal, force, nodes = run(sys.argv[1], folder / "out", back)
            first = first if first is not None else force
            edge = 1.05 * max(abs(x) for x, _ in nodes)
            curve = [edge * i / 500. for i in range(-500, 501)]
            color = len(plots) // 2 + 1
            plots += [f"'-' with lines lc {color} notitle",
                      f"'-' with points pt 6 ps 0.5 lc {color} title '{label}'"]
            data += [[(x, closed_form(x, normal, first, force))
                      for x in curve], nodes]
    script = ("set terminal svg size 640,420\n"
              f"set output '{sys.argv[2]}'\n"
              "set xlabel 'x'\nset ylabel 'traction along the surface'\n"
              "set key outside\nplot " + ", ".join(plots) + "\n")
    for points in data:
        script += "".join(f"{x:.6g} {q:.6g}\n" for x, q in points) + "e\n"
    subprocess.run(["gnuplot"], input=script, text=True, check=True)


if __name__ == "__main__":
    main()
