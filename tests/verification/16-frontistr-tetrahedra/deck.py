# SPDX-License-Identifier: LGPL-2.1-or-later
import math
import pathlib
import re
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(ROOT / "tests/app"))
from block_scene import section, solid  # noqa: E402
from simplices import Mesh  # noqa: E402

TITLE = "tied beams and two boxes of tetrahedra"
SOURCE = ("FrontISTR (https://github.com/FrontISTR/FrontISTR, commit 9f5e9f5f), "
          "`contact_slag_tied_iter/tetCM`, `tetMM`, "
          "`contact_slag_iter/2box_tet_nofric_iter`")
QUICK = True
PROBLEM = r"""
Bodies of linear tetrahedra, $E = 1000$, $\nu = 0.3$.

- tetCM (28 nodes, 48 cells) and tetMM (75, 216): $[0, 2] \times [0, 1]^2$ is clamped at $x = 0$ and tied at $x = 2$ to
  $[2, 4] \times [0, 1]^2$, small strain. A pressure of 1 on $y = 1$ follows the facets: their forces at FrontISTR's displacements are the dead
  loads of the scene.
- 2box (44, 108): $[0, 0.9]^2 \times [1, 2]$ is pressed by 0.1 on the unit cube, St. Venant and Kirchhoff's law, symmetry planes $x = 0$, $y = 0$,
  no friction.
"""
SKETCH = r"""
   tetCM, tetMM                          2box     -0.1
     1 v v v v v v v v v v                     +---v--+ 2
    /+----------+----------+ y = 1            o|      |
    /|          | tied     |                  o|      |
    /+----------+----------+ y = 0             +------+-+ 1
     x = 0      2          4                  o|        |
                                              o|        |
                                               +--------+ 0
"""
ELEMENTS = r"""
The same tetrahedra, contact at nodes against facets. Tolerances: 1e-9 for the tied beams. In 2box FrontISTR has lost two nodes, which have
gone through the lower box. With the four facets that have neither node, 1e-4 of the largest displacement. With all facets the force is up to
0.8 % above that of FrontISTR with wedges below, which lose no nodes: tetrahedra are stiffer.
"""
REMARKS = r"""
Differences of displacements are the largest of all nodes, divided by the largest displacement.
"""
ELASTIC = ("Young modulus = 1000", "Poisson ratio = 0.3")


class Nodes:
    """Places and displacements of all nodes, and cells of node numbers."""

    def __init__(self, rows, cells):
        self.nodes = [tuple(row[:3]) for row in rows]
        self.moved = [row[3:] for row in rows]
        self.cells = cells

    @classmethod
    def read(cls, text):
        lines = iter(line for line in text.splitlines() if line[0] != "#")

        def block(kind):
            return [[kind(word) for word in next(lines).split()]
                    for _ in range(int(next(lines).split()[1]))]
        rows = block(float)
        return cls(rows, [[v - 1 for v in cell] for cell in block(int)])

    def part(self, inside, id_of):
        """Mesh of the cells with a node that is inside, and displacements."""
        cells = [cell for cell in self.cells
                 if any(inside(self.nodes[v]) for v in cell)]
        used = sorted({v for cell in cells for v in cell})
        index = {v: k for k, v in enumerate(used)}
        mesh = Mesh(3, [self.nodes[v] for v in used],
                    [[index[v] for v in cell] for cell in cells], id_of)
        mesh.right_handed()
        mesh.moved = [self.moved[v] for v in used]
        return mesh


def tied_beams():
    """tetCM, of tests/hosts/tied_beams.h."""
    text = (ROOT / "tests/hosts/tied_beams.h").read_text()
    number = r"([-+.\de]+)"
    node = r"\{\{" + ", ".join([number] * 3) + r"\}, \{" + ", ".join(
        [number] * 3) + r"\}\}"
    rows = [[float(x) for x in row] for row in re.findall(node, text)]
    ends = [(2, 4), (1, 7), (1, 4), (2, 7), (0, 3), (5, 6)]
    deck = Nodes(rows, [])
    for cube in range(4):
        first, last = (0, 14) if cube < 2 else (14, 28)
        index = {deck.nodes[i]: i for i in range(first, last)}

        def at(corner):
            return index[(float(cube + corner % 2), float(corner // 2 % 2),
                          float(corner // 4))]
        for face in range(6):
            pair = (0, 6) if face == 0 and cube % 2 == 1 else ends[face]
            bit = 1 << face // 2
            for third in range(8):
                if third & bit == face % 2 * bit and third not in pair:
                    deck.cells.append([(12, 13, 26, 27)[cube], at(pair[0]),
                                       at(pair[1]), at(third)])
    return deck


def read_nodes(name):
    return Nodes.read((HERE / name).read_text())


def area(corners):
    a, b = ([x - y for x, y in zip(corner, corners[0])]
            for corner in corners[1:])
    return [(a[1] * b[2] - a[2] * b[1]) / 2., (a[2] * b[0] - a[0] * b[2]) / 2.,
            (a[0] * b[1] - a[1] * b[0]) / 2.]


def compare_displacements(deck, name, result, meshes, n_nodes, tolerance):
    """Largest difference to those of FrontISTR, of all nodes."""
    found = {(row["body"], row["x"], row["y"], row["z"]): [
        row["displacement_" + d] for d in "xyz"] for row in result.nodes}
    pairs = [(found[(float(number), *x)], u)
             for number, mesh in enumerate(meshes, 1)
             for x, u in zip(mesh.vertices, mesh.moved)]
    if len(pairs) != n_nodes:
        raise ValueError(f"{name} has {len(pairs)} nodes")
    for d in range(3):
        deck.compare(f"{name}, largest size of u_{'xyz'[d]}",
                     max(abs(u[d]) for _, u in pairs),
                     max(abs(v[d]) for v, _ in pairs), tolerance,
                     scale=max(abs(x) for _, u in pairs for x in u))
    deck.compare(f"{name}, difference of displacements", 0.,
                 max(abs(a - b) for one in pairs for a, b in zip(*one)),
                 tolerance, scale=max(abs(x) for _, u in pairs for x in u))


def body(number, *lines):
    return section(f"Body {number}",
                   section("Mesh", f"File = body-{number}.msh"), *ELASTIC,
                   *lines)


OUTPUT = section("Output", "Nodal values = true")
LEVEL = section("Refinement", "Level = 0")
NODES = section("Method", "Discretisation = node to segment",
                "Contact geometry = reference")


def solve_tied(deck, name, nodes, n_nodes):
    """(0, 2) x (0, 1)^2 is clamped at x = 0 and tied at x = 2 to (2, 4) x
    (0, 1)^2. The pressure of 1 on y = 1 follows the facets: their forces at the
    other program's displacements are dead loads of each here."""
    parts, meshes = [], []
    for number in (1, 2):
        mesh = nodes.part(
            lambda x, low=2 * number - 2: low < x[0] < low + 2,
            lambda corners: 1 if all(x[0] == 0 for x in corners)
            else 2 if all(x[0] == 2 for x in corners) else 0)
        loads = []
        for k, (_, face) in enumerate(mesh.faces):
            if any(mesh.vertices[v][1] != 1. for v in face):
                continue
            flat = area([mesh.vertices[v] for v in face])
            sign = math.copysign(1., flat[1])
            now = area([[x + u for x, u in zip(mesh.vertices[v],
                                               mesh.moved[v])] for v in face])
            mesh.faces[k] = (10 + len(loads), face)
            loads.append(f"{mesh.faces[k][0]}: " + ", ".join(
                "%.15g" % (-sign * x / abs(flat[1])) for x in now))
        deck.write(f"body-{number}.msh", mesh.gmsh())
        support = ["Prescribed displacement = 1: 0, 0, 0"] if number == 1 else []
        parts.append(body(number, *support, "Traction = " + "; ".join(loads)))
        meshes.append(mesh)
    deck.write("beams.prm", solid(
        3, *parts, section("Pair 1", "Secondary = 2: 2", "Primary = 1: 2",
                           "Tied = true"), LEVEL, NODES, OUTPUT))
    # The tetrahedra are too stiff, as those of FrontISTR.
    result = deck.run("beams.prm", {"Solid/Degree": 1})
    if "ABUT-F16" not in result.summary["codes"]:
        raise ValueError(f"{name}: no warning ABUT-F16")
    compare_displacements(deck, name, result, meshes, n_nodes, 1e-9)


# Nodes that the other program lost: they went through the lower box.
LOST = ((0., 0.89999998, 1.), (0.89999998, 0., 1.))


def solve_boxes(deck):
    nodes = read_nodes("2box.txt")

    def id_of(corners):
        for d in range(3):
            for side, end in enumerate((0., 2.)):
                if all(x[d] == end for x in corners):
                    return 2 * d + side
        if all(x[2] == 1 for x in corners):
            return 8 if any(tuple(x) in LOST for x in corners) else 7
        return 6
    meshes = [nodes.part(lambda x: x[2] < 1, id_of),
              nodes.part(lambda x: x[2] > 1, id_of)]
    rollers = "0: 0, free, free; 2: free, 0, free; "
    for number, (mesh, end) in enumerate(
            zip(meshes, ("4: free, free, 0", "5: free, free, -0.1")), 1):
        deck.write(f"body-{number}.msh", mesh.gmsh())
        meshes[number - 1].lines = ("Material = st venant-kirchhoff",
                                    f"Prescribed displacement = {rollers}{end}")
    deck.write("boxes.prm", solid(
        3, *(body(k + 1, *mesh.lines) for k, mesh in enumerate(meshes)),
        section("Pair 1", "Secondary = 2: 7", "Primary = 1: 7"), LEVEL, NODES, OUTPUT))
    degree = {"Solid/Degree": 1}
    result = deck.run("boxes.prm", degree)
    compare_displacements(deck, "2box, four facets", result, meshes, 44, 1e-4)
    deck.compare("2box, four facets, force", 39.481930810,
                 result.summary["pair_1_force"][2], 2e-5)
    for method in ("node to segment", "dual mortar", "mortar"):
        result = deck.run("boxes.prm", {
            **degree, "Pair 1/Secondary": "2: 7, 8",
            "Method/Discretisation": method})
        # Above that with wedges below (hexahedra: 41.053478286).
        deck.within(f"2box, eight facets, force, {method}",
                    (41.077863477, 1.0077 * 41.077863477),
                    result.summary["pair_1_force"][2])


def solve(deck):
    solve_tied(deck, "tetCM", tied_beams(), 28)
    solve_tied(deck, "tetMM", read_nodes("tetMM.txt"), 75)
    solve_boxes(deck)
