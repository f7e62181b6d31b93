#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The traction of Cattaneo and Mindlin's two cylinders on the closed form.

Runs prm/cattaneo-cylinders.prm: pulled to Q1, back to no force, and on to -Q1,
and draws the traction of each node over the curve that theory has for the forces
of that run. Needs Matplotlib.

    tests/bench/cattaneo_picture.py build/release/abut picture.svg
"""
import math
import pathlib
import sys
import tempfile

import pictures

MU, RADIUS, MODULUS = 0.2, 4., 200. / (2. * (1. - 0.3 ** 2))
PULL, PRESS = 0.03, 0.184


def run(abut, folder, back):
    """Forces along normal and surface, place and friction of nodes in contact."""
    steps = 2 if back is None else 3
    way = f"t > 2 ? {PULL} - {back or 0}*(t - 2) : {PULL}*(t - 1)"
    done = pictures.run(
        abut, "cattaneo-cylinders.prm", folder, f"Time stepping/Number of steps={steps}",
        f"Time stepping/End time={steps}",
        f"Body 2/Prescribed displacement=1: (t > 1 ? ({way}) : 0), "
        f"(t < 1 ? -{PRESS}*t : -{PRESS})")
    table = done.table("pair_1.csv")
    closed = table["status"] > 0
    return (done.summary["pair_1_normal_force"], done.summary["pair_1_friction"][0],
            table["x"][closed], table["friction"][closed])


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
            normal, force, places, tractions = run(sys.argv[1], folder / "out", back)
            first = first if first is not None else force
            half = math.sqrt(4. * normal * RADIUS / (math.pi * MODULUS))
            bound = MU * 2. * normal / (math.pi * half)
            edge = 1.05 * max(abs(places))
            curve = [edge * k / 500. for k in range(-500, 501)]
            axes.plot([x / half for x in curve],
                      [closed_form(x, normal, first, force) / bound
                       for x in curve], color=style.COLOURS[i],
                      linewidth=0.9)
            axes.plot(places / half, tractions / bound, style.MARKERS[i],
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
