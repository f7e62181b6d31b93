# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh files with round sides: refinement follows the surfaces that `Curved
sides` names and converges to Lame's formulas; without them it keeps chords, which
the program says."""
import math

from block_scene import section, solid
from program import Program, set_words
from ucd import ucd

p = Program()

# prm/press-fit.prm: pressure of the fit; displacement at the bore and outside.
PRESSURE, BORE, OUTSIDE = 1.28777472527, -0.003125, 0.005625


def ring(name, inner, outer, n, layers=1, shift=(0, 0), bad=0.):
    """A quarter of a ring, or in 3D of a tube of height 0.5, as a UCD file;
    ids 0 inside, 1 outside, 2 x = 0, 3 y = 0, 4 the ends. The node at the middle
    of the outer circle is off by `bad`."""
    dim = 2 if layers == 1 else 3
    points, cells = [], []

    def node(i, j, k):
        return (k * 2 + j) * (n + 1) + i + 1

    for k in range(layers):
        for j, radius in enumerate((inner, outer)):
            for i in range(n + 1):
                r = radius + (bad if j == 1 and 2 * i == n else 0.)
                angle = 0.5 * math.pi * i / n
                points.append((r * math.cos(angle) + shift[0],
                               r * math.sin(angle) + shift[1], 0.5 * k))

    def side(number, *corners):
        """A boundary face: an edge of the section or a wall over it."""
        if dim == 2:
            cells.append((number, "line", *(node(*c, 0) for c in corners)))
            return
        (a, b), k = corners, 0
        cells.append((number, "quad", node(*a, k), node(*b, k),
                      node(*b, k + 1), node(*a, k + 1)))

    for i in range(n):
        around = [(i, 0), (i, 1), (i + 1, 1), (i + 1, 0)]
        if dim == 2:
            cells.append((0, "quad", *(node(*c, 0) for c in around)))
        else:
            cells.append((0, "hex", *(node(*c, k) for k in range(2)
                                      for c in around)))
            for k in range(2):
                cells.append((4, "quad", *(node(*c, k) for c in around)))
        side(0, (i, 0), (i + 1, 0))
        side(1, (i, 1), (i + 1, 1))
    side(3, (0, 0), (0, 1))
    side(2, (n, 0), (n, 1))
    return p.write(name, ucd(points, cells))


def curved(center="0, 0"):
    return f"0, 1: circle: {center}"


def run(scene, settings, ranks=0, code=0, command="run"):
    """Output and summary of a scene; it must end with the code."""
    result = p.call(command, scene, "--quiet",
                    *(["--output", "out"] if command == "run" else []),
                    *set_words(settings), ranks=ranks)
    p.expect(result.returncode == code, f"{settings}: exit code "
             f"{result.returncode}\n{result.stderr}")
    good = command == "run" and result.returncode == 0
    return result, p.results()[0] if good else {}


FILES = [ring("a.inp", 1, 2, 4), ring("b.inp", 2, 3, 3)]


def press_fit(sides, *more, **how):
    """The scene prm/press-fit.prm with meshes from files."""
    settings = []
    for body, file in enumerate(FILES, start=1):
        settings += [f"Body {body}/Mesh/Generator=",
                     f"Body {body}/Mesh/Arguments=",
                     f"Body {body}/Mesh/File={p.folder / file}",
                     f"Body {body}/Mesh/Curved sides={sides}"]
    return run(p.source / "prm/press-fit.prm", [*settings, *more], **how)


def errors(levels, sides, degree):
    """Relative errors of pressure and displacement on meshes, each twice as
    fine."""
    result = []
    for level in levels:
        _, found = press_fit(sides, f"Refinement/Level={level}",
                             f"Solid/Degree={degree}")
        result.append((abs(found["contact_force"] / (math.pi * PRESSURE) - 1),
                       abs(found["point_1"][0] / BORE - 1),
                       abs(found["point_3"][0] / OUTSIDE - 1)))
    return result


# Order 2 with curved sides: each mesh errs by a quarter of the one before.
found = errors((2, 3, 4), curved(), 1)
for one, two in zip(found, found[1:]):
    orders = [math.log2(a / b) for a, b in zip(one, two)]
    p.expect(all(1.7 < order < 2.4 for order in orders),
             f"orders {orders} of force and displacements")
p.expect(max(found[-1]) < 4e-3, f"errors {found[-1]} on the last mesh")
quadratic, = errors((3,), curved(), 2)
p.expect(max(quadratic) < 1e-4, f"errors {quadratic} of degree 2")

# Chords stay chords: the error does, too, and a warning says why.
chords = errors((3, 4), "", 1)
p.expect(chords[1][0] > 0.5 * chords[0][0] > 2 * found[-1][0],
         f"errors {chords} with chords")
result, _ = press_fit("", "Refinement/Level=1")
p.expect("ABUT-F21" in result.stderr and "Curved sides" in result.stderr
         and "30 degrees" in result.stderr, result.stderr)
for sides, level in ((curved(), 2), ("0, 1: flat", 2), ("", 0)):
    result, _ = press_fit(sides, f"Refinement/Level={level}",
                          "Refinement/Coarsest level=0")
    p.expect("Curved sides" not in result.stderr, f"{sides}: {result.stderr}")

# The same on two ranks, with adaptive meshes.
adaptive = ["Refinement/Level=2", "Refinement/Adaptive cycles=2"]
_, one = press_fit(curved(), *adaptive)
_, two = press_fit(curved(), *adaptive, ranks=2)
p.expect(one["dofs"] == two["dofs"], f"{one['dofs']} and {two['dofs']} unknowns")
p.close(two["contact_force"] / one["contact_force"], 1, 1e-6, "two ranks")
p.close(one["contact_force"] / (math.pi * PRESSURE), 1, 4e-3, "adaptive")

# Moved and turned meshes: the centre is where the mesh is in the end.
_, moved = press_fit(curved("2, -1"), "Refinement/Level=2",
                     *(f"Body {body}/Mesh/Move=2, -1" for body in (1, 2)),
                     "Output/Points=")
_, still = press_fit(curved(), "Refinement/Level=2")
p.close(moved["contact_force"] / still["contact_force"], 1, 1e-9, "moved")

def body(file, sides, *lines):
    return section("Body 1", section("Mesh", f"File = {file}",
                                     f"Curved sides = {sides}"), *lines)


# A tube in 3D: a cylinder under pressure, no strain along it.
OUTWARD = "0.0013/3*(0.4+4/(x^2+y^2))"


def tube(sides, level):
    scene = p.write("tube.prm", solid(
        3, body(ring("tube.inp", 1, 2, 2, layers=2), sides,
                "Young modulus = 1000", "Poisson ratio = 0.3",
                "Support = 2: 0, free, free; 3: free, 0, free; "
                "4: free, free, 0", "Pressure = 0: 1"),
        section("Refinement", f"Level = {level}"),
        section("Exact solution",
                f"Displacement = {OUTWARD}*x, {OUTWARD}*y, 0"),
        bodies=1).replace("Pairs = 1", "Pairs = 0"))
    _, summary = run(scene, [])
    return summary["l2_error"]


axis = "0, 1: cylinder: 0, 0, 3: 0, 0, 2"
coarse, fine = tube(axis, 2), tube(axis, 3)
p.expect(1.7 < math.log2(coarse / fine) < 2.4, f"tube: {coarse}, {fine}")
p.expect(tube("", 3) > 5 * fine, "a tube of chords")

# A shallow arc of seven chords, half of a cylinder pressed on a plane: they meet at
# less than a degree, and make pressures that Hertz' p0^2 = P E*/(pi R), which needs
# nothing but the force, has not. Where the pressure is large beside that, nothing is
# said.
RADIUS, ACROSS = 10., 7


def cap():
    """Ids 1 below, 2 x = 0, 3 above."""
    nodes = [(i / ACROSS, j / ACROSS) for j in range(ACROSS + 1)
             for i in range(ACROSS + 1)]
    nodes = [(x, y if y > 0. else RADIUS - math.sqrt(RADIUS**2 - x**2))
             for x, y in nodes]

    def node(i, j):
        return j * (ACROSS + 1) + i + 1

    n = range(ACROSS)
    items = [(0, "quad", node(i, j), node(i + 1, j), node(i + 1, j + 1),
              node(i, j + 1)) for j in n for i in n]
    items += [(1, "line", node(i, 0), node(i + 1, 0)) for i in n]
    items += [(2, "line", node(0, i), node(0, i + 1)) for i in n]
    items += [(3, "line", node(i, ACROSS), node(i + 1, ACROSS)) for i in n]
    return p.write("cap.inp", ucd(nodes, items))


def pressed(sides, pressure):
    """Messages, and the largest pressure by Hertz'."""
    scene = p.write("cap.prm", solid(
        2, body(cap(), sides, "Young modulus = 1", "Poisson ratio = 0",
                "Support = 2: 0, free", f"Pressure = 3: {pressure}"),
        section("Obstacle 1", "Kind = plane"),
        section("Pair 1", "Secondary = 1: 1", "Obstacle = 1"),
        section("Refinement", "Level = 4"), bodies=1, obstacles=1))
    result, summary = run(scene, [])
    hertz = math.sqrt(2 * summary["contact_force"] / (math.pi * RADIUS))
    return result.stderr, summary["pair_1_pressure"] / hertz


said, ratio = pressed("1: circle: 0, 10", 0.0035)
# The block is no half-space.
p.expect("F21" not in said and abs(ratio - 1) < 0.05, f"arc: {ratio} {said}")
said, ratio = pressed("", 0.0035)
p.expect("ABUT-F21: Pair 1" in said and "Curved sides" in said and ratio > 1.1,
         f"chords: {ratio} {said}")
said, _ = pressed("1: flat", 0.0035)
p.expect("F21" not in said, f"corners that are meant: {said}")
said, _ = pressed("", 0.2)
p.expect("F21" not in said, f"pressed flat: {said}")

# Where nothing is refined, nothing follows: listed.
def unused(level, *lines):
    """What the report lists as not used of a ring of eight facets."""
    scene = p.write("coarse.prm", solid(
        2, body(ring("coarse.inp", 1, 2, 2), "0, 1: circle: 0, 0", *lines,
                "Young modulus = 1000", "Pressure = 0: 1",
                "Support = 2: 0, free; 3: free, 0"),
        section("Refinement", f"Level = {level}"),
        bodies=1).replace("Pairs = 1", "Pairs = 0"))
    return [line for line in run(scene, [])[1]["not_used"]
            if "Curved sides" in line]


p.expect(unused(0) == ["Body 1/Mesh/Curved sides: the mesh is not refined "
                       "and keeps straight facets: refine it "
                       "(Refinement/Level)."], f"level 0: {unused(0)}")
p.expect(unused(0, "Refinements = 1") == unused(1) == [], "refined")

# Mistakes.
for sides, words in (
        ("0, 1: circle: 0, 0.1", ["Body 1/Mesh/Curved sides", "the node (",
                                  "off the circle", "centre"]),
        ("7: circle: 0, 0", ["no boundary id 7"]),
        ("1: circel: 0, 0", ["Did you mean 'circle'?"]),
        ("1: sphere: 0, 0", ["one of circle, flat"]),
        ("1: circle", ["'ids: circle: centre'"]),
        ("1: circle: 0", ["has 1 coordinates; it needs 2"]),
        ("1: flat: 0, 0", ["'ids: flat'"]),
        ("circle: 0, 0", ["Curved sides"])):
    result, _ = press_fit(sides, code=2, command="check")
    p.expect_error(result, *words)
bad = ring("bad.inp", 1, 2, 4, bad=0.01)
result, _ = press_fit("1: circle: 0, 0", f"Body 1/Mesh/File={p.folder / bad}",
                      code=2, command="check")
middle = f"{2.01 * math.sqrt(0.5):.4g}"
p.expect_error(result, f"the node ({middle}", "is 0.01 off the circle of radius 2")
p.finish()
