# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes prm/cube-of-tetrahedra.msh: the cube (0, 1)^2 x (-1, 0) cut into 48
tetrahedra, in gmsh's format 2.2. Ids 0 and 2 are the planes x = 0 and y = 0, 4 is
the bottom, 5 the top."""
import argparse

from simplices import box

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("file")
with open(parser.parse_args().file, "w", encoding="ascii") as out:
    out.write(box((2, 2, 2), (0, 0, -1), (1, 1, 0)).gmsh())
