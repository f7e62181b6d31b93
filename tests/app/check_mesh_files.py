# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh files of gmsh and of Abaqus: files that gmsh wrote and files by hand run
at the first try, with surfaces by name; wrong files end with their reason and
line, and exit code 2."""
import subprocess

from block_scene import section
from program import Program

p = Program()

NODES_2D = ((0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1))
BOX = tuple((x, y, z) for z in (0, 1) for y in (0, 1) for x in (0, 1))


def gmsh(nodes, *elements, form="2.2 0 8", head="", count=0):
    """Text of format 2; elements: type, group, nodes."""
    lines = ["$MeshFormat", form, "$EndMeshFormat", *([head] if head else []),
             "$Nodes", str(len(nodes))]
    lines += [f"{k} {x} {y} {z[0] if z else 0}"
              for k, (x, y, *z) in enumerate(nodes, 1)]
    lines += ["$EndNodes", "$Elements", str(count or len(elements))]
    lines += [f"{k} {kind} 2 {group} {group} {' '.join(map(str, nodes))}"
              for k, (kind, group, *nodes) in enumerate(elements, 1)]
    return "\n".join(lines + ["$EndElements"]) + "\n"


def abaqus(nodes, *more):
    """Text of an input file; more: lines after the nodes."""
    lines = ["*NODE"] + [f"{k}, " + ", ".join(map(str, x))
                         for k, x in enumerate(nodes, 1)]
    return "\n".join([*lines, *more]) + "\n"


def block(dimension, file, support, *more):
    return (f"set Scene = solid\nset Dimension = {dimension}\n"
            + section("Solid", "Bodies = 1")
            + section("Body 1", section("Mesh", f"File = {file}"),
                      "Young modulus = 1000", "Poisson ratio = 0",
                      f"Support = {support}", *more)
            + section("Output", "Points = 1: 2, 1" + ", 1" * (dimension - 2)))


def stretched(dimension, file, support, pull, expected):
    """The end of a bar that is pulled moves by stress times length over E."""
    name = p.write("bar.prm", block(dimension, file, support,
                                    f"Traction = {pull}"))
    result = p.call("run", name, "--quiet", "--output", "out")
    p.expect(result.returncode == 0, f"{file}: {result.stderr}")
    if result.returncode == 0:
        found = p.results()[0]["point_1"]
        p.expect(max(abs(a - b) for a, b in zip(found, expected)) < 1e-12,
                 f"{file}: the end moves by {found}")


# What gmsh wrote: a bar of length 2, held at its end, and a block 1 high.
FOLDER = p.source / "tests/app/mesh_files"
for name in ("quads-2.2", "quads-4.0", "quads-4.1", "quads-degree-2"):
    stretched(2, FOLDER / f"{name}.msh", "bottom: free, 0; 0: 0, free",
              "right side: 1, 0", (2e-3, 0))
for name in ("hexes-2.2", "hexes-4.1", "hexes-degree-2"):
    stretched(3, FOLDER / f"{name}.msh", "bottom: 0, 0, 0", "top: 0, 0, 1",
              (0, 0, 1e-3))
for name in ("overlap-2.2", "overlap-4.1"):
    stretched(2, FOLDER / f"{name}.msh", "1: 0, 0", "*: 1, 0", (0, 0))
stretched(2, FOLDER / "inside-4.1.msh", "LEFT: 0, 0", "0: 0, 0", (0, 0))

# Abaqus' words, by hand.
QUADS = ("*Element, type=CPS4R, elset=all", "1, 1, 2, 5, 4", "7, 2, 3, 6, 5")
HEXES = ("*ELEMENT, TYPE=C3D8, ELSET=block", "1, 1, 2, 4, 3, 5, 6, 8, 7")
LONG = tuple((2 * x, y, z) for x, y, z in BOX)
HAND = {
    "flat.inp": (2, abaqus(
        NODES_2D, "** sets", *QUADS, "*nset, nset=Left", "1, 4",
        "*Surface, type=ELEMENT, name=END", "7, S2"),
        "left: 0, 0", "End: 1, 0", (2e-3, 0)),
    "dos.inp": (2, abaqus(
        NODES_2D, *QUADS, "*ELSET, ELSET=last, GENERATE", "5, 9, 1",
        "*SURFACE,", "NAME=end", "last, s2", "*NSET, NSET=left", "1,", "4",
        "*MATERIAL, NAME=steel", "*ELASTIC", "210000., 0.3", "*STEP",
        "*STATIC", "*BOUNDARY", "1, 1, 2", "*NODE PRINT, NSET=left", "U",
        "*END STEP").replace("\n", "\r\n"),
        "left: 0, 0", "end: 1, 0", (2e-3, 0)),
    "part.inp": (3, "*HEADING\n a part of Abaqus/CAE\n*PART, NAME=Bar\n"
                 + abaqus(
        LONG, *HEXES, "*Nset, nset=Set-1, generate", "1, 8, 1", "*End Part",
        "*Assembly, name=Assembly", "*Instance, name=Bar-1, part=Bar",
        "0., 0., 0.", "*End Instance", "*Node", "1, 9., 9., 9.",
        "*Nset, nset=Point", "1", "*Nset, nset=Set-1, instance=Bar-1",
        "1, 3, 5, 7", "*Elset, elset=_End_S4, internal, instance=Bar-1", "1",
        "*Surface, type=ELEMENT, name=End", "_End_S4, S4", "*End Assembly"),
        "Set-1: 0, 0, 0", "End: 1, 0, 0", (2e-3, 0, 0)),
    "instance.inp": (3, "*PART, NAME=A\n" + abaqus(
        [(x - 5, y, z) for x, y, z in LONG], *HEXES, "*END PART",
        "*ASSEMBLY, NAME=B", "*INSTANCE, NAME=I, PART=A", "5.",
        "*END INSTANCE", "*SURFACE, NAME=left, TYPE=NODE", "I.ends, 1.",
        "*END ASSEMBLY").replace("*END PART", "*NSET, NSET=ends\n1, 3,\n"
                                 "5, 7\n*SURFACE, NAME=right\nblock, S4\n"
                                 "*END PART"),
        "left: 0, 0, 0", "right: 1, 0, 0", (2e-3, 0, 0)),
    # gmsh writes surfaces as plane elements.
    "facets.inp": (3, abaqus(
        LONG, "******* E L E M E N T S *************",
        "*ELEMENT, type=T3D2, ELSET=Line1", "20, 1, 2",
        "*ELEMENT, type=CPS4, ELSET=Surface1", "10, 1, 3, 7, 5",
        "*ELEMENT, type=CPS4, ELSET=Surface2", "11, 2, 4, 8, 6", *HEXES,
        "*ELSET,ELSET=left", "10,", "*ELSET,ELSET=right", "11, "),
        "Left: 0, 0, 0", "Surface2: 1, 0, 0", (2e-3, 0, 0)),
}
for file, (dimension, text, *rest) in HAND.items():
    p.write(file, text)
    stretched(dimension, file, *rest)

# Two bodies by name, one of them from a file of each kind; names in `check`.
p.write("low.inp", abaqus(NODES_2D, *QUADS, "*NSET, NSET=low", "1, 2, 3",
                          "*NSET, NSET=high", "4, 5, 6"))
p.write("pair.prm", "set Scene = solid\nset Dimension = 2\n"
        + section("Solid", "Bodies = 2", "Pairs = 1")
        + section("Body 1", section("Mesh", "File = low.inp"),
                  "Young modulus = 1000", "Poisson ratio = 0", "Name = bed",
                  "Support = LOW: 0, 0")
        + section("Body 2",
                  section("Mesh", f"File = {FOLDER / 'quads-2.2.msh'}",
                          "Move = 0, 1"),
                  "Young modulus = 1000", "Poisson ratio = 0",
                  "Support = top: 0, free", "Pressure = top: 10")
        + section("Pair 1", "Secondary = plate: bottom", "Primary = bed: high"))
result = p.call("run", "pair.prm", "--quiet", "--output", "out")
p.expect(result.returncode == 0, result.stderr)
p.close(p.results()[0]["contact_force"], 20, 1e-10, "force between names")
listed = p.call("check", "pair.prm").stdout
for words in ("body 1, boundary 1 ('low'): 2 faces, length 2, x from",
              "body 2, boundary 6 ('right side'): 2 faces, length 1, x = 2"):
    p.expect(words in listed, f"no '{words}' in {listed}")
for setting, *words in (
        ("Body 1/Prescribed displacement=lo: 0, 0", "no boundary 'lo'", "low, high"),
        ("Pair 1/Primary=bed: plate", "no boundary 'plate'", "low, high"),
        ("Pair 1/Secondary=plate: plate", "is a physical surface of cells"),
        ("Pair 1/Primary=bad: high", "'bad: high'", "'bed'"),
        ("Body 1/Name=plate", "several bodies have the name 'plate'"),
        ("Body 2/Mesh/Curved sides=tup: flat", "no boundary 'tup'")):
    p.expect_error(p.call("check", "pair.prm", "--set", setting), *words)

# Parts of a file, of different kinds of elements; what lies between them is the
# boundary of both.
PARTS = ("*PART, NAME=Tool\n" + abaqus(LONG, "*ELEMENT, TYPE=R3D4", "1, 1,2,3,4")
         + "*END PART\n*PART, NAME=Bar\n" + abaqus(LONG, *HEXES) + "*END PART\n"
         "*ASSEMBLY, NAME=Assembly\n*INSTANCE, NAME=Tool-1, PART=Tool\n"
         "9., 9., 9.\n*END INSTANCE\n*INSTANCE, NAME=Bar-1, PART=Bar\n"
         "*END INSTANCE\n*NSET, NSET=rigid, INSTANCE=Tool-1\n1, 2, 3, 4\n"
         "*SURFACE, NAME=outside\nTool-1.all, SPOS\n"
         "*NSET, NSET=left, INSTANCE=Bar-1\n1, 3, 5, 7\n"
         "*SURFACE, NAME=right\nBar-1.block, S4\n*END ASSEMBLY\n")
p.write("parts.inp", PARTS)
bar = p.write("part.prm", block(3, "parts.inp\nset Part = bar", "left: 0, 0, 0",
                                "Traction = right: 1, 0, 0"))
result = p.call("run", bar, "--quiet", "--output", "out")
p.expect(result.returncode == 0, result.stderr)
p.close(p.results()[0]["point_1"][0], 2e-3, 1e-10, "a part of Abaqus")
for part, *words in (("", "the parts 'Tool', 'Bar'", "Mesh/Part"),
                     ("rod", "the parts 'Tool', 'Bar'")):
    p.expect_error(p.call("check", bar, "--set", f"Body 1/Mesh/Part={part}"),
                   *words)
mixed = p.write("mixed.msh", gmsh(
    (*NODES_2D, (3, 0)), (3, 8, 1, 2, 5, 4), (3, 8, 2, 3, 6, 5),
    (2, 9, 3, 7, 6), (1, 5, 3, 6), (1, 6, 1, 4),
    head='$PhysicalNames\n4\n2 8 "rod"\n2 9 "pin"\n1 5 "between"\n1 6 "end"\n'
    "$EndPhysicalNames"))
stretched(2, "mixed.msh\nset Part = rod", "end: 0, 0", "between: 1, 0",
          (2e-3, 0))
for part, *words in (("", "all cells of a body must be of one kind"),
                     ("nut", "no part 'nut'", "'rod', 'pin', 'between', 'end'"),
                     ("end", "the part 'end' has no cells")):
    p.expect_error(p.call("check", "bar.prm", "--set",
                          f"Body 1/Mesh/Part={part}"), *words)
p.expect_error(p.call("check", p.source / "prm/patch-2d.prm", "--set",
                      "Body 1/Mesh/Part=x"), "Body 1/Mesh/Part", "no effect")
p.expect_error(p.call("check", p.source / "prm/self-contact.prm", "--set",
                      "Body 1/Mesh/Part=x"), "Body 1/Mesh/File", "no parts")
both = section("Mesh", f"File = {FOLDER / 'inside-4.1.msh'}")
p.write("both.prm", "set Scene = solid\nset Dimension = 2\n"
        + section("Solid", "Bodies = 2", "Pairs = 1")
        + "".join(section(f"Body {number}", both.replace(
            "end\n", f"set Part = {part}\n{more}end\n"),
            "Young modulus = 1000", "Poisson ratio = 0", load)
            for number, part, more, load in (
                (1, "one", "", "Support = left: 0, 0"),
                (2, "two", "set Boundary ids = 4: x > 1.99\n",
                 "Traction = 4: 1, 0")))
        + section("Pair 1", "Secondary = two: middle", "Primary = one: middle",
                  "Tied = true")
        + section("Output", "Points = two: 2, 1"))
result = p.call("run", "both.prm", "--quiet", "--output", "out")
p.expect(result.returncode == 0, result.stderr)
p.close(p.results()[0]["point_1"][0], 2e-3, 1e-10, "two parts of a file")

# Membranes and surfaces of the search.
p.write("membrane.prm", "set Scene = obstacle\nset Dimension = 2\n"
        + section("Mesh", f"File = {FOLDER / 'quads-4.1.msh'}")
        + section("Membrane", "Load = -1", "Dirichlet = top: 0; bottom: 0")
        + section("Contact", "Obstacle = -1"))
result = p.call("check", "membrane.prm")
p.expect(result.returncode == 0 and "boundary 3 ('top'): 32 faces, length 2"
         in result.stdout, result.stdout + result.stderr)
p.expect_error(p.call("check", "membrane.prm", "--set",
                      "Membrane/Prescribed displacement=tip: 0"), "no boundary 'tip'")

# Wrong files: name, dimension, text, words of the error.
SQUARE = ((0, 0), (1, 0), (1, 1), (0, 1))
QUAD = (3, 0, 1, 2, 3, 4)
MIDDLES = ((.5, 0), (1, .5), (.5, 1), (0, .5), (.5, .5))
TRIANGLE = ((0, 0), (1, 0), (0, 1), (.5, 0), (.5, .5), (0, .5))
TET = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
HEX = (5, 0, 1, 2, 4, 3, 5, 6, 8, 7)
GOOD = gmsh(SQUARE, QUAD)
WRONG = (
    ("binary.msh", 2, gmsh(SQUARE, QUAD, form="4.1 1 8"), "binary",
     "Mesh.Binary = 0"),
    ("old.msh", 2, gmsh(SQUARE, QUAD, form="3 0 8"), "line 2", "4.1"),
    ("short.msh", 2, GOOD[:GOOD.index("$EndNodes")], "cut off", "$Nodes"),
    ("shorter.msh", 2, GOOD[:GOOD.index("$Elements")], "cut off",
     "without $Elements"),
    ("word.msh", 2, GOOD[:-18], "line 13", "2 nodes"),
    ("less.msh", 2, gmsh(SQUARE, QUAD, count=2), "line 14", "more lines"),
    ("more.msh", 2, GOOD.replace("$Nodes\n4", "$Nodes\n3"), "line 9",
     "more lines than it announces"),
    ("huge.msh", 2, GOOD.replace("$Nodes\n4", "$Nodes\n999999999999"),
     "line 10", "announces more"),
    ("digits.msh", 2, GOOD.replace("$Nodes\n4", "$Nodes\n" + "9" * 30),
     "line 5", "too large"),
    ("nan.msh", 2, gmsh(((0, 0), (1, "nan"), (1, 1), (0, 1)), QUAD),
     "line 7", "'nan'", "finite"),
    ("large.msh", 2, gmsh(((0, 0), (1, "1e400"), (1, 1), (0, 1)), QUAD),
     "line 7", "'1e400'", "finite"),
    ("comma.msh", 2, gmsh(((0, 0), ("0,5", 0), (1, 1), (0, 1)), QUAD),
     "line 7", "'0,5'", "decimal comma"),
    ("coordinates.msh", 2, GOOD.replace("2 1 0 0", "2 1 0"), "line 7",
     "2 coordinates"),
    ("node-twice.msh", 2, GOOD.replace("\n3 1 1", "\n2 1 1"), "line 8",
     "the node 2", "line 7"),
    ("element-twice.msh", 2, gmsh(NODES_2D, (3, 0, 1, 2, 5, 4),
                                  (3, 0, 2, 3, 6, 5)).replace(
         "\n2 3 2", "\n1 3 2"), "element 1", "line 16", "line 15"),
    ("no-node.msh", 2, gmsh(SQUARE, (3, 0, 1, 2, 3, 9)), "element 1",
     "line 13", "node 9"),
    ("few.msh", 2, gmsh(SQUARE, (3, 0, 1, 2, 3)), "line 13", "3 nodes",
     "needs 4"),
    ("many.msh", 2, gmsh(SQUARE, (3, 0, 1, 2, 3, 4, 1)), "line 13", "5 nodes"),
    ("collapsed.msh", 2, gmsh(SQUARE, (3, 0, 1, 2, 3, 3)), "element 1",
     "node 3 twice"),
    ("type.msh", 2, gmsh(SQUARE, (36, 0, 1, 2, 3, 4)), "type 36",
     "Mesh.ElementOrder"),
    ("serendipity.msh", 2, gmsh(SQUARE + MIDDLES[:4],
                                (16, 0, 1, 2, 3, 4, 5, 6, 7, 8)),
     "serendipity", "SecondOrderIncomplete"),
    ("wedge.msh", 3, gmsh(BOX, (6, 0, 1, 2, 3, 5, 6, 7)), "wedge"),
    ("mixed.msh", 2, gmsh((*NODES_2D,), (3, 0, 1, 2, 5, 4), (2, 0, 2, 3, 6)),
     "element 1 in line 15 is a quadrilateral", "element 2 in line 16 a triangle",
     "one kind"),
    ("mixed3.msh", 3, gmsh(BOX + ((0, 0, 2),), HEX, (4, 0, 5, 6, 7, 9)),
     "hexahedron", "tetrahedron", "one kind"),
    ("degrees.msh", 2, gmsh(SQUARE + MIDDLES[:3] + ((2, 0),),
                            (9, 0, 1, 2, 3, 5, 6, 7), (2, 0, 2, 8, 3)),
     "of degree 2", "of degree 1", "one degree"),
    ("flat-cell.msh", 2, gmsh(((0, 0), (1, 0), (2, 0), (3, 0)), QUAD),
     "element 1", "line 13", "no volume"),
    ("folded.msh", 2, gmsh(((0, 0), (1, 0), (0, 1), (1, 1)), QUAD),
     "element 1", "folded"),
    ("needle.msh", 3, gmsh(((0, 0, 0), (1, 0, 0), (0, 1, 0), (.3, .3, 1e-14)),
                           (4, 0, 1, 2, 3, 4)), "no volume"),
    ("same-place.msh", 2, gmsh(((0, 0), (1, 0), (1, 0), (0, 1)), QUAD),
     "element 1", "no volume"),
    ("bow.msh", 2, gmsh((*SQUARE, (.5, -.1), *MIDDLES[1:]),
                        (10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9)), "element 1",
     "curved edges", "Curved sides"),
    ("centre.msh", 2, gmsh((*SQUARE, *MIDDLES[:4], (.5, .6)),
                           (10, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9)),
     "curved edges"),
    ("far-middle.msh", 2, gmsh((*TRIANGLE[:3], (.5, -.6), *TRIANGLE[4:]),
                               (9, 0, 1, 2, 3, 4, 5, 6)), "node 4 in line 9",
     "node 1 to 2", ".6 away"),
    ("inside-out.msh", 2, gmsh((*TRIANGLE[:3], (.9, 0), *TRIANGLE[4:]),
                               (9, 0, 1, 2, 3, 4, 5, 6)), "inverted"),
    ("two-middles.msh", 2, gmsh(
        (*TRIANGLE, (1, 1), (.5, .5), (1, .5), (.5, 1)),
        (9, 0, 1, 2, 3, 4, 5, 6), (9, 0, 2, 7, 3, 9, 10, 8)),
     "another element has another node"),
    ("corner-middle.msh", 2, gmsh((*TRIANGLE[:3], *TRIANGLE[3:]),
                                  (9, 0, 1, 2, 3, 4, 5, 6),
                                  (9, 0, 1, 4, 6, 2, 5, 3)), "it is a corner"),
    ("overlap.msh", 2, gmsh(NODES_2D + ((2, 2),), (3, 0, 1, 2, 5, 4),
                            (3, 0, 2, 3, 6, 5), (3, 0, 2, 3, 7, 5)),
     "overlap"),
    ("same-side.msh", 2, gmsh(((0, 0), (1, 0), (0, 1), (.5, .5)),
                              (2, 0, 1, 2, 3), (2, 0, 1, 2, 4)),
     "element 1", "element 2", "same side"),
    ("no-face.msh", 2, gmsh(NODES_2D, (3, 0, 1, 2, 5, 4), (3, 0, 2, 3, 6, 5),
                            (1, 4, 1, 3)), "element 3", "no face"),
    ("apart.msh", 2, gmsh((*SQUARE, (1, 0), (2, 0), (2, 1), (1, 1)), QUAD,
                          (3, 0, 5, 6, 7, 8)), "share no nodes", "Merge"),
    ("bent.msh", 2, gmsh(((0, 0, 0), (1, 0, 0), (1, 0, 1), (0, 0, 1)), QUAD),
     "plane of constant z", "line 8"),
    ("space.msh", 2, gmsh(BOX, HEX), "hexahedra", "Dimension = 3"),
    ("plane.msh", 3, GOOD, "no cells", "tetrahedra or hexahedra"),
    ("group.msh", 2, gmsh(SQUARE, (3, -99999999999, 1, 2, 3, 4)), "99999999999"),
    ("section.msh", 2, GOOD.replace("$Nodes\n", "4\n$Nodes\n"), "line 4", "'4'"),
    ("first.msh", 2, GOOD[GOOD.index("$Nodes"):], "before $MeshFormat"),
    ("garbage.msh", 2, "$\x01\x02\x00\xff\n", "line 1"),
    ("entity.msh", 2, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n"
     "1 0 0 0\n1 0 0 0 5 1\n$EndEntities\n", "line 6", "fewer groups"),
    ("entities.msh", 2, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n"
     "99 0 0 0\n1 0 0 0 0\n$EndEntities\n", "line 7", "$Entities"),
    ("partition.msh", 2, "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
     "$PartitionedEntities\n", "partitioned"),
    # Abaqus
    ("empty.inp", 2, "*HEADING\n", "no *NODE"),
    ("no-elements.inp", 2, abaqus(SQUARE), "no *ELEMENT"),
    ("star.inp", 2, "*\n*,\n**\n", "no *NODE"),
    ("serendipity.inp", 2, abaqus(SQUARE, "*ELEMENT, TYPE=CPS8R"), "line 6",
     "CPS8R", "serendipity"),
    ("c3d20.inp", 3, abaqus(BOX, "*ELEMENT, TYPE=C3D20"), "C3D20",
     "serendipity"),
    ("wedge.inp", 3, abaqus(BOX, "*ELEMENT, TYPE=C3D6"), "wedge"),
    ("shell.inp", 3, abaqus(BOX, "*ELEMENT, TYPE=S4R"), "S4R", "C3D10"),
    ("untyped.inp", 3, abaqus(BOX, "*ELEMENT"), "line 10", "type"),
    ("few.inp", 2, abaqus(SQUARE, "*ELEMENT, TYPE=CPS4", "1, 1, 2, 3"),
     "line 7", "3 nodes", "needs 4"),
    ("cut.inp", 2, abaqus(SQUARE, "*ELEMENT, TYPE=CPS4", "1, 1, 2,"),
     "line 7", "2 nodes"),
    ("swallow.inp", 2, abaqus(SQUARE, "*ELEMENT, TYPE=CPS4", "1, 1, 2, 3,",
                              "*NSET, NSET=a", "1"), "line 7", "3 nodes"),
    ("comma.inp", 2, abaqus(SQUARE, *QUADS[:1]).replace("2, 1", "2, 1,5, 0,5"),
     "line 3", "decimal comma"),
    ("nan.inp", 2, abaqus(SQUARE, *QUADS[:1]).replace("2, 1", "2, nan"),
     "line 3", "'nan'"),
    ("include.inp", 2, "*INCLUDE, INPUT=a.inp\n", "*INCLUDE", "one file"),
    ("input.inp", 2, "*NODE, INPUT=a.txt\n", "INPUT=a.txt"),
    ("system.inp", 2, "*NODE, SYSTEM=C\n1, 1, 90\n", "SYSTEM=C", "Cartesian"),
    ("ngen.inp", 2, abaqus(SQUARE, "*NGEN", "1, 5, 1"), "*NGEN"),
    ("parts.inp", 2, "*PART, NAME=A\n*END PART\n*PART, NAME=B\n",
     "the parts 'A', 'B'", "Mesh/Part"),
    ("instances.inp", 2, "*PART, NAME=A\n" + abaqus(
        NODES_2D, *QUADS, "*END PART", "*INSTANCE, NAME=I, PART=A",
        "*END INSTANCE", "*INSTANCE, NAME=J, PART=A"), "'J'", "'I'", "line 15"),
    ("elset.inp", 2, abaqus(NODES_2D, *QUADS, "*ELSET, ELSET=e", "77",
                            "*NSET, NSET=a, ELSET=e"), "element 77"),
    ("rotated.inp", 2, "*PART, NAME=A\n" + abaqus(SQUARE, *QUADS[:1],
     "1,1,2,3,4", "*END PART", "*INSTANCE, NAME=I, PART=A", "0,0,0",
                                                  "0,0,0,0,0,1,90"), "rotated"),
    ("set.inp", 2, abaqus(NODES_2D, *QUADS, "*NSET, NSET=a", "b"), "'b'",
     "node set"),
    ("set-node.inp", 2, abaqus(NODES_2D, *QUADS, "*NSET, NSET=a", "77"),
     "'a'", "node 77"),
    ("unnamed.inp", 2, abaqus(NODES_2D, *QUADS, "*NSET", "1"), "no name"),
    ("range.inp", 2, abaqus(NODES_2D, *QUADS, "*NSET, NSET=a, GENERATE",
                            "1, 99999999999999, 1"), "range"),
    ("step.inp", 2, abaqus(NODES_2D, *QUADS, "*NSET, NSET=a, GENERATE",
                           "1, 5, 0"), "range"),
    ("side.inp", 2, abaqus(NODES_2D, *QUADS, "*SURFACE, NAME=a", "1, S6"),
     "S6", "quadrilateral"),
    ("spos.inp", 2, abaqus(NODES_2D, *QUADS, "*SURFACE, NAME=a", "1, SPOS"),
     "'SPOS'", "S1 to S6"),
    ("surface.inp", 2, abaqus(NODES_2D, *QUADS, "*SURFACE, NAME=a", "9, S1"),
     "'a'", "element 9"),
    ("same.inp", 2, abaqus(NODES_2D, *QUADS, "8, 1, 2, 5, 4"), "element 8",
     "element 1"),
)
for name, dimension, text, *words in WRONG:
    (p.folder / name).write_bytes(text.encode("latin-1"))
result = subprocess.run(
    [p.study, p.folder / "read", *(f"{dimension}:{name}" for name, dimension, *_
                                   in WRONG)],
    cwd=p.folder, text=True, capture_output=True, errors="replace")
p.expect(result.returncode == 0, result.stderr)
found = dict(line.split(": ", 1) for line in result.stdout.split("\n")
             if ": " in line)
for name, dimension, text, *words in WRONG:
    for word in ("cannot be read as a mesh in", *words):
        p.expect(word in found.get(name, ""),
                 f"{name}: no '{word}' in: {found.get(name)}")
# Some of them in the program.
for name, dimension, text, *words in WRONG[::12]:
    scene = p.write(f"{name}.prm", block(dimension, name, "0: " + ", ".join(
        "0" * dimension)))
    p.expect_error(p.call("check", scene), "Body 1/Mesh/File:", name, *words)

# Sets that are no part of the boundary, and why.
p.write("sets.inp", abaqus(
    NODES_2D, *QUADS, "*NSET, NSET=point", "2", "*NSET, NSET=some", "1, 2, 6",
    "*SURFACE, NAME=inner", "1, S2", "*NSET, NSET=two", "1, 4",
    "*SURFACE, NAME=two", "1, S1"))
for word, reason in (("point", "beyond whole facets"),
                     ("some", "beyond whole facets"),
                     ("inner", "within the mesh"),
                     ("all", "of cells"),
                     ("two", "the name of a surface and of a set")):
    p.write("sets.prm", block(2, "sets.inp", f"{word}: 0, 0"))
    p.expect_error(p.call("check", "sets.prm"), f"'{word}'", reason)

# A slit without ids is told; with ids it is meant.
SLIT = (*NODES_2D, (1, 0), (1, 1), (0, 2), (1, 2))
CELLS = ((3, 0, 1, 2, 5, 4), (3, 0, 7, 3, 6, 8), (3, 0, 4, 5, 10, 9))
for name, sides, warns in (("slit.msh", (), True),
                           ("meant.msh", ((1, 1, 2, 5), (1, 2, 7, 8)), False)):
    p.write(name, gmsh(SLIT, *CELLS, *sides))
    p.write("slit.prm", block(2, name, "*: 0, 0"))
    result = p.call("check", "slit.prm")
    p.expect(result.returncode == 0
             and ("Merge the nodes" in result.stderr) == warns,
             f"{name}: {result.stderr}")

p.finish()
