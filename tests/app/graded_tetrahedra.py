# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes prm/graded-tetrahedra.msh: the cube (0, 1)^2 x (-1, 0) with cells of
size 0.03 at the origin that grow with the distance from it, for gmsh's format
2.2. Ids 0 and 2 are the planes x = 0 and y = 0, 4 is the top, 5 the bottom."""
import argparse

from simplices import box

SMALL, N_SMALL, N = 0.03, 2, 5


def places():
    """Of the layers along each axis: two small ones, then a geometric row."""
    low, high = 1., 6.
    for _ in range(80):
        ratio = 0.5 * (low + high)
        row = [SMALL] * N_SMALL + [SMALL * ratio ** k
                                   for k in range(1, N - N_SMALL + 1)]
        low, high = (ratio, high) if sum(row) < 1. else (low, ratio)
    return [sum(row[:k]) for k in range(N)] + [1.]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file")
    place = places()
    mesh = box((N,) * 3, (0,) * 3, (N,) * 3)
    mesh.mapped(lambda x, y, z: (place[round(x)], place[round(y)],
                                 -place[round(z)] + 0.))
    mesh.right_handed()
    with open(parser.parse_args().file, "w", encoding="ascii") as out:
        out.write(mesh.gmsh())


main()
