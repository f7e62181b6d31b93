# SPDX-License-Identifier: LGPL-2.1-or-later
"""Wrong input of every kind gives one error that names place and cure, and
exit code 2."""
import os

from program import Program

p = Program()
scene = p.source / "prm/point-mass.prm"


def start(*words):
    """The program itself; values can be tried by the one for many runs."""
    return p.call(*words, alone=True)


# Command line.
p.expect_error(start("rum"), "'rum'", "'run'")
p.expect_error(start("run"), "scene file")
p.expect_error(start("run", scene, "--outptu", "x"), "'--output'")
p.expect_error(start("run", scene, "--set"), "'--set' needs a value")
p.expect_error(start("run", scene, "--set", "Title"), "Section/Name=value")
p.expect_error(start("run", scene, scene), "one file")
p.expect_error(start("help", "rnu"), "'run'")

# Files.
p.expect_error(start("run", "nowhere.prm"), "nowhere.prm")
p.expect_error(start("run", "."), "cannot read")


def wrong(text, *words):
    p.expect_error(p.call("run", p.write("wrong.prm", text)), *words)


POINT = "set Scene = point mass\n"
wrong("", "'set Scene'", "point mass")
wrong("set Scene = ponit mass\n", "wrong.prm:1", "Did you mean 'point mass'?")
wrong(POINT + "sett Title = x\n", "wrong.prm:2", "'sett'", "'set'")
wrong(POINT + "set Title\n", "wrong.prm:2", "'='")
wrong(POINT + "subsection Masses\n", "wrong.prm:2", "'Masses'", "'end'")
wrong(POINT + "end\n", "wrong.prm:2", "'subsection'")
wrong(POINT + "include missing.prm\n", "missing.prm")
wrong(POINT + "include wrong.prm\n", "include each other")
wrong(POINT + "set Titel = x\n", "wrong.prm:2", "Titel", "'Title'")
wrong(POINT + "subsection Massses\nset Force = 1\nend\n", "wrong.prm:3",
      "section 'Massses'", "'Masses'")
wrong(POINT + "subsection Masses\n# a comment\n\nset Stifness = 1\nend\n",
      "wrong.prm:5", "Masses/Stifness", "'Stiffness'")
# First words that are not near are no suggestion ('Mass').
result = p.call("run", p.write(
    "wrong.prm", "set Scene = solid\nset Dimension = 2\nsubsection Solid\n"
    "set Obstacles = 1\nend\nsubsection Obstacle 1\nset Half length = 3\nend\n"))
p.expect_error(result, "wrong.prm:7", "there is no such parameter")
p.expect("Did you mean" not in result.stderr, result.stderr)
wrong("set Scene = chain of masses\nsubsection Masses\n"
      "set Initial velocity = -10\nend\n", "wrong.prm:3",
      "Scene = motion has 'Motion/Initial velocity'")
wrong(POINT + "subsection Bar\nset Elements = 9\nend\n", "wrong.prm:3",
      "Scene = motion has 'Bar/Elements'")
wrong(POINT + "set Penalty = 5\n", "wrong.prm:2", "'Method/Penalty factor'")

# Values.


def wrong_value(parameter, value, *words):
    p.expect_error(p.call("run", scene, "--set", f"{parameter}={value}"),
                   parameter + ":", *words)


wrong_value("Method/Enforcement", "lagrang multiplier", "'lagrange'")
wrong_value("Method/Enforcement", "interior", "'interior point'")
wrong_value("Method/Gap tolerance", "-1", "'-1'", "above 0")
wrong_value("Method/Gap tolerance", "nan", "'nan'")
wrong_value("Method/Maximum linear systems", "1.5", "whole number")
wrong_value("Method/System", "sadle point", "'saddle point'")
wrong_value("Masses/Force", "nan", "'nan' is not a finite number")
wrong_value("Masses/Force", "1 + t", "'+' in '1 + t' is not a finite number")
wrong_value("Masses/Force", "1e400", "'1e400'")
wrong_value("Masses/Force", "1 2", "2 numbers where 1")
wrong_value("Masses/Stiffness", "1 2; 3 4", "not symmetric")
wrong_value("Masses/Stiffness", "1 2; 3", "a row has")
wrong_value("Masses/Stiffness", "-1", "negative")
p.expect_error(p.call("run", scene, "--set", "Masses/Stiffness=0"),
               "Masses/Stiffness:")  # nothing holds the mass
wrong_value("Constraints/B", "0", "a row is zero")
wrong_value("Constraints/Kind", "inequalty", "'inequality'")
wrong_value("Sweep/Penalty factors", "1, 0", "above 0")
wrong_value("Output/Pictures", "maybe", "true or false")
p.expect_error(p.call("run", scene, "--set", "Method/Barrier end=1"),
               "Method/Barrier end", "Method/Barrier start")

# Numbers that would be read as others: scene, parameter, value, words of the
# error. A comma outside of brackets is no decimal point.
MISREAD = (
    ("dragged-block", "Pair 1/Friction", "0,3", "decimal comma?", "'0.3'"),
    ("dragged-block", "Pair 1/Largest friction", "0,3", "decimal comma?"),
    ("dragged-block", "Pair 1/Friction", "max(0,1), 5", "decimal comma?"),
    ("dragged-block", "Obstacle 1/Rotation angle", "0,5", "'0.5'"),
    ("step-41", "Membrane/Body force", "-10,5", "decimal comma?", "'-10.5'"),
    ("step-41", "Membrane/Prescribed displacement", "3: 1,5", "decimal comma?"),
    ("step-41", "Mesh/Boundary ids", "7: x > 0,5", "decimal comma?"),
    ("step-41", "Contact/Obstacle", "-0,5", "decimal comma?"),
    ("press-fit", "Pair 1/Initial gap", "-0,01", "decimal comma?", "'-0.01'"),
    ("dragged-block", "Body 1/Prescribed displacement", "0: 0,5, free", "decimal comma?"),
    ("dragged-block", "Body 1/Mesh/Move", "0,5, 1", "decimal comma?"),
    ("dragged-block", "Body 1/Body force", "0; -9,81", "decimal comma?"),
    ("dragged-block", "Output/Points", "1: 0,5, 1", "decimal comma?"),
    ("dragged-block", "Body 1/Young modulus", "1,5", "decimal comma?"),
    ("dragged-block", "Refinement/Level", "1,5", "decimal comma?"),
    ("dragged-block", "Search/Thickness", "0,3", "decimal comma?"),
    ("friction-bar", "Friction/Coefficient", "0,3", "decimal comma?"),
    ("friction-bar", "Load/Force on first", "0,3", "decimal comma?"),
    ("dynamics-bouncing-ball", "Motion/Acceleration", "-9,81",
     "decimal comma?"),
    ("point-mass", "Masses/Force", "0,5", "decimal comma?"),
    ("dragged-block", "Pair 1/Friction", "sin(0,3)", "decimal comma?"),
    ("dragged-block", "Solid/Bodies", "1,0", "decimal comma?"),
    ("dragged-block", "Pair 1/Friction", "0x10", "hexadecimal"),
    ("dragged-block", "Body 1/Mesh/Move", "0x1, 0", "hexadecimal"),
    ("dragged-block", "Search/Thickness", "0x1", "'0x1'"),
    ("dragged-block", "Pair 1/Friction", "1e400", "too large"),
    ("dragged-block", "Body 1/Young modulus", "1e400", "too large"),
    ("dragged-block", "Pair 1/Friction", "1e-400", "too small"),
    ("dragged-block", "Body 1/Mesh/Move", "1e-400, 0", "too small"),
    ("dragged-block", "Body 1/Mesh/Move", "0,,1", "comma without a number"),
    ("dragged-block", "Pair 1/Friction", "1 000", "blank within a number"),
    ("dragged-block", "Body 1/Young modulus", "1 000", "blank within"),
    ("dragged-block", "Pair 1/Friction", "3 4", "several numbers"),
    ("dragged-block", "Pair 1/Friction", "1\t4", "several numbers"),
    ("dragged-block", "Pair 1/Friction", ".3 mm", "no units"),
    ("dragged-block", "Body 1/Young modulus", "1.5 MPa", "no units"),
    ("dragged-block", "Pair 1/Friction", "\u22120.3", "minus"),
    ("dragged-block", "Body 1/Young modulus", "\u22121", "minus"),
)
for name, parameter, value, *words in MISREAD:
    for command in ("check", "run"):
        p.expect_error(p.call(command, p.source / f"prm/{name}.prm", "--set",
                              f"{parameter}={value}"), parameter + ":", *words)
# In a file, with its line.
wrong("set Scene = obstacle\nset Dimension = 2\nsubsection Membrane\n"
      "set Load = -10,5\nend\n", "wrong.prm:4", "Membrane/Body force",
      "decimal comma?")
# Commas that separate arguments stay what they are.
p.expect("decimal" not in p.call("check", p.source / "prm/dragged-block.prm",
                                 "--set", "Pair 1/Friction=max(0,q)").stderr,
         "another mistake in a formula with arguments")
p.expect(p.call("run", p.source / "prm/dragged-block.prm", "--set",
                "Pair 1/Friction=max(0,0.3)", "--set", "Refinement/Level=0",
                "--quiet").returncode == 0, "arguments of max()")

# Mesh files: the reason, and its line.
CORNERS = ["0 0", "1 0", "1 1", "0 1"]
FAR = ["1e12 1e12", "1000000000000.1 1e12", "1000000000000.2 1e12",
       "1e12 1000000000000.1", "1000000000000.1 1000000000000.1",
       "1000000000000.2 1000000000000.1"]


def ucd(corners, cells=("1 2 3 4",)):
    return (f"{len(corners)} {len(cells)} 0 0 0\n"
            + "".join(f"{i + 1} {x} 0\n" for i, x in enumerate(corners))
            + "".join(f"{i + 1} 0 quad {c}\n" for i, c in enumerate(cells)))


def vtk(corners, cell="4 0 1 2 3"):
    return ("# vtk DataFile Version 3.0\nsquare\nASCII\n"
            "DATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n"
            + "".join(x + " 0\n" for x in corners)
            + f"CELLS 1 5\n{cell}\nCELL_TYPES 1\n9\n")


def stl(vertex):
    return ("solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
            f"vertex {vertex}\nvertex 0 1 0\nendloop\nendfacet\n"
            "endsolid s\n")


def with_corner(x):
    return CORNERS[:2] + [x] + CORNERS[3:]


MESH_FILES = (
    ("nan.inp", ucd(with_corner("nan 1")), "'nan' in line 4", "not a finite"),
    ("large.inp", ucd(with_corner("1e400 1")), "'1e400' in line 4"),
    ("comma.inp", ucd(with_corner("1,5 1")), "'1,5' in line 4",
     "decimal comma?"),
    ("nan.vtk", vtk(with_corner("1 nan")), "'nan' in line 8"),
    ("index.vtk", vtk(CORNERS, "4 0 1 2 9"), "line 11", "vertex 9"),
    ("cells.inp", ucd(CORNERS, ()), "no cells"),
    ("far.inp", ucd(FAR, ("1 2 5 4", "2 3 6 5")), "Its largest", "line 4",
     "too large relative to the size of cells"),
    ("outlier.inp", ucd(with_corner("1e12 1")), "diameter of 1e+12",
     "1e12, in line 4"),
    ("folded.inp", ucd(["0 0", "1 0", "2 0", "0 1", "3 1", "2 1"],
                       ("1 2 5 4", "2 3 6 5")), "folded"),
)
for name, text, *words in MESH_FILES:
    p.write(name, text)
    p.expect_error(p.call("check", p.source / "prm/patch-2d.prm", "--set",
                          f"Body 1/Mesh/File={p.folder}/{name}"),
                   "Body 1/Mesh/File:", *words)
for vertex, *words in (("nan 0 0", "'nan'", "finite number", "line 5"),
                       ("1e400 0 0", "'1e400'", "finite number", "line 5"),
                       ("0,5 0 0", "'0,5'", "line 5", "decimal comma?"),
                       ("1 0 0 0", "4 numbers", "line 5"),
                       ("1 0", "2 numbers", "line 5")):
    p.write("surface.stl", stl(vertex))
    p.expect_error(p.call("check", p.source / "prm/search-flat.prm", "--set",
                          f"Primary/File={p.folder}/surface.stl", "--set",
                          "Primary/Surface ids=*"),
                   "Primary/File:", *words)

# Output folders.
p.write("file", "")
p.expect_error(p.call("run", scene, "--output", "file/x"), "file/x")
p.expect_error(p.call("run", scene, "--output", "file"), "'file'")
os.mkdir(p.folder / "locked", 0o500)
p.expect_error(p.call("run", scene, "--output", "locked", ordinary=True),
               "'locked'")
p.expect_error(p.call("run", scene, "--output", "locked/in", ordinary=True),
               "'locked/in'")

# Files that may not be read.
for name in ("secret.prm", "secret.pgm"):
    p.write(name, "")
    (p.folder / name).chmod(0)
p.expect_error(p.call("run", "secret.prm", ordinary=True), "secret.prm")
p.expect_error(p.call("check", "secret.prm", ordinary=True), "secret.prm")
p.expect_error(p.call("run", p.source / "prm/height-map.prm", "--set",
                      f"Contact/Height map={p.folder}/secret.pgm",
                      ordinary=True), "secret.pgm", "Height map")

p.finish()
