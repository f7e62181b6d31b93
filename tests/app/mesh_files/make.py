#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Makes the mesh files of gmsh in this folder, by gmsh (4.8 wrote them):

    make.py [GMSH]

They are kept, so that tests need no gmsh."""
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

# The square [0, 2] x [0, 1], 4 by 2 cells.
SQUARE = """
Point(1) = {0, 0, 0}; Point(2) = {2, 0, 0}; Point(3) = {2, 1, 0};
Point(4) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 5; Transfinite Curve {2, 4} = 3;
Transfinite Surface {1};
"""
NAMES = """
Physical Curve("bottom", 5) = {1}; Physical Curve("right side", 6) = {2};
Physical Curve("top", 3) = {3}; Physical Surface("plate", 9) = {1};
"""
QUADS = "Recombine Surface {1};\n"
# The same, 1 high, in two layers.
CUBE = SQUARE + """
SURFACE
out[] = Extrude {0, 0, 1} { Surface{1}; Layers{2}; RECOMBINE };
Physical Surface("bottom", 1) = {1}; Physical Surface("top", 2) = {out[0]};
Physical Volume("block", 1) = {1};
"""
HEXES = CUBE.replace("RECOMBINE", "Recombine;").replace("SURFACE", QUADS)
TETS = CUBE.replace("RECOMBINE", "").replace("SURFACE", "")
# A quarter of a ring of radii 1 and 2.
RING = """
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0};
Point(4) = {0, 2, 0}; Point(5) = {0, 1, 0};
Line(1) = {2, 3}; Circle(2) = {3, 1, 4}; Line(3) = {4, 5};
Circle(4) = {5, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Mesh.MeshSizeMax = .5;
Physical Curve("outside", 1) = {2}; Physical Curve("inside", 2) = {4};
Physical Surface("ring") = {1};
"""
BALL = """
SetFactory("OpenCASCADE");
Sphere(1) = {0, 0, 0, 1};
Mesh.MeshSizeMin = .8; Mesh.MeshSizeMax = .8;
Physical Surface("sphere") = {1}; Physical Volume("ball") = {1};
"""
# Groups that overlap, and one of a curve within the mesh.
OVERLAP = SQUARE + QUADS + """
Physical Curve("around", 1) = {1, 2, 3, 4}; Physical Curve("ends", 2) = {2, 4};
Physical Surface("all") = {1}; Physical Surface("also all") = {1};
"""
INSIDE = """
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0};
Point(4) = {2, 1, 0}; Point(5) = {1, 1, 0}; Point(6) = {0, 1, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5};
Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Transfinite Curve {1:7} = 3; Transfinite Surface {1, 2};
Recombine Surface {1, 2};
Physical Curve("middle", 7) = {7}; Physical Curve("left", 8) = {6};
Physical Surface("one") = {1}; Physical Surface("two") = {2};
"""

# Name, geometry, dimension, degree, format.
FILES = (
    ("quads-2.2", SQUARE + QUADS + NAMES, 2, 1, "2.2"),
    ("quads-4.1", SQUARE + QUADS + NAMES, 2, 1, "4.1"),
    ("quads-4.0", SQUARE + QUADS + NAMES, 2, 1, "4.0"),
    ("quads-degree-2", SQUARE + QUADS + NAMES, 2, 2, "4.1"),
    ("hexes-2.2", HEXES, 3, 1, "2.2"),
    ("hexes-4.1", HEXES, 3, 1, "4.1"),
    ("hexes-degree-2", HEXES, 3, 2, "4.1"),
    ("overlap-2.2", OVERLAP, 2, 1, "2.2"),
    ("overlap-4.1", OVERLAP, 2, 1, "4.1"),
    ("inside-4.1", INSIDE, 2, 1, "4.1"),
    ("all-2.2", SQUARE + QUADS + NAMES + "Mesh.SaveAll = 1;", 2, 1, "2.2"),
    ("ring-4.1", RING, 2, 1, "4.1"),
    ("ring-degree-2", RING, 2, 2, "2.2"),
    ("tets-4.1", TETS, 3, 1, "4.1"),
    ("tets-4.0", TETS, 3, 1, "4.0"),
    ("ball-degree-2", BALL, 3, 2, "4.1"),
)


def main(gmsh="gmsh"):
    with tempfile.TemporaryDirectory() as folder:
        geometry = pathlib.Path(folder) / "geometry.geo"
        for name, text, dimension, degree, version in FILES:
            geometry.write_text(text)
            subprocess.run(
                [gmsh, geometry, f"-{dimension}", "-order", str(degree), "-v", "1",
                 "-setnumber", "Mesh.MshFileVersion", version,
                 "-o", HERE / f"{name}.msh"], check=True)


main(*sys.argv[1:])
