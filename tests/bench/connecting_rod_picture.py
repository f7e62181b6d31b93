#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs prm/connecting-rod.prm and draws the deformed bodies with the plane of
symmetry y = 0 in front, displacements 50 times, coloured by von Mises' stress.

    tests/bench/connecting_rod_picture.py build/release/abut picture.svg
"""
import pathlib
import sys
import tempfile

import numpy

import pictures
from pictures import style
from abut_tools import geometry

TIMES = 50


def main():
    if len(sys.argv) != 3:
        raise SystemExit(__doc__)
    with tempfile.TemporaryDirectory() as folder:
        mesh = pictures.run(sys.argv[1], "connecting-rod.prm",
                            pathlib.Path(folder)).last_field("fields")
    x, y, z = (mesh.points + TIMES * mesh.fields["displacement"]).T
    flat, depth = numpy.stack([x + 0.35 * z, y + 0.45 * z], axis=1), z - 0.35 * x - 0.45 * y
    faces = sorted(geometry.surface(mesh), key=lambda face: depth[face].mean())
    stress = mesh.fields["von_mises_stress"].astype(float)
    figure, [[axes]] = style.figure(style.PAGE, 0.36)
    pictures.field(axes, [flat[face] for face in faces],
                   numpy.array([stress[face].mean() for face in faces]), 0.1,
                   f"von Mises stress [MPa], displacements {TIMES} times",
                   location="bottom", shrink=0.6, aspect=40)
    pictures.bare(axes, (flat[:, 0].min(), flat[:, 0].max()),
                  (flat[:, 1].min(), flat[:, 1].max()))
    pictures.save(figure, sys.argv[2])


if __name__ == "__main__":
    main()
