# SPDX-License-Identifier: LGPL-2.1-or-later
"""The part of a pressure that alternates from node to node (F51), where the
pressures of all nodes are known: a layer of cells h wide and 2 h high on a plane,
without Poisson's effect, with all other displacements prescribed. Upper nodes go
down by c + a cos(pi x/h). Along x, the mass and stiffness matrices of the cells
multiply what alternates by h/3 and 4/h, constants by h and 0. So the force of a
lower node in 2D is E/(2 h) h c from the constant and, with G = E/2,
  -E/(2 h) h/3 a + G (2 h/6) (4/h) a = E a/2
from the rest: pressures are E/(2 h) (c + a cos(pi x/h)). In 3D, with the product of
two cosines, it is E h (-1/18 + 8/18) a, of E h/2 c: 7/9 of that part. A strip, which
is two cells wide, with the cosine along its length alone is as in 2D."""
import math

from block_scene import block, section, solid
from program import Program
from simplices import box

p = Program()
H = 0.125
NITSCHE = ("Method/Enforcement=nitsche", "Method/Discretisation=quadrature point")


def layer(dimension, n, lift, width=0):
    """The scene with n cells along each side, or `width` along y; `lift`: a
    formula."""
    axes = dimension - 1
    numbers = [n, width or n][:axes]
    ends = ", ".join([str(k * H) for k in numbers] + [str(2 * H)])
    cells = ", ".join([str(k) for k in numbers] + ["1"])
    zero = ", ".join(["0"] * axes)
    top, bottom = 2 * axes + 1, 2 * axes
    sides = "; ".join(f"{side}: {zero}, free" for side in range(2 * axes))
    return p.write("layer.prm", solid(
        dimension,
        block(1, f"{cells} : {zero}, 0 : {ends} : true",
              f"{top}: {zero}, -1e-6*({lift}); {bottom}: {zero}, free",
              more=("Young modulus = 1000", "Poisson ratio = 0")),
        section("Obstacle 1", "Kind = plane", f"Point = {zero}, 0",
                f"Normal = {zero}, 1"),
        section("Pair 1", f"Secondary = 1: {bottom}", "Obstacle = 1"),
        section("Refinement", "Level = 0"),
        section("Output", "Fields = false", "Pictures = false"),
        bodies=1, obstacles=1))


def oscillation(dimension, n, lift, warns, **options):
    summary = p.run_scene(layer(dimension, n, lift, options.get("width", 0)),
                          options.get("settings", ()), ranks=options.get("ranks", 0),
                          words=["ABUT-F51"] if warns else [],
                          without=[] if warns else ["ABUT-F51"])
    p.expect(summary["active"] == summary["constraints"], f"open points: {lift}")
    return summary["pair_1_oscillation"]


def alternating(dimension):
    return "*".join(f"cos(pi*{x}/{H})" for x in "xy"[:dimension - 1])


# With an odd number of cells no product of the two parts is left in the mean
# square over the surface.
for dimension, n, factor in ((2, 9, 1.), (2, 21, 1.), (3, 7, 7 / 9)):
    for part in (0.03, 0.12, 0.5):
        a = factor * part
        share = a / math.hypot(1, a)
        for ranks in (0, 2) if part == 0.5 else (0,):
            found = oscillation(dimension, n, f"1 + {part}*{alternating(dimension)}",
                                share > 0.1, ranks=ranks)
            p.close(found, share, 1e-8, f"{dimension}D, part {part}, {ranks} ranks")

for part in (0.03, 0.12, 0.5):
    for ranks in (0, 2) if part == 0.5 else (0,):
        found = oscillation(3, 21, f"1 + {part}*{alternating(2)}", part > 0.11,
                            ranks=ranks, width=2)
        p.close(found, part / math.hypot(1, part), 1e-8, f"strip, part {part}")
p.below(oscillation(3, 21, "1 - 0.1*x + 0.4*y", False, width=2), 0.01, "strip, linear")

# Nothing alternates in these; the nodes at the ends, which have half a facet, are
# not on the line or parabola of the others.
for dimension, lift, limit in (
        (2, "1", 1e-8), (2, "1 + 0.7*x", 0.01), (2, "1 - 0.5*(x - 0.3)^2", 0.01),
        (3, "1 - 0.3*x + 0.4*y", 0.01), (3, "1 - 0.5*(x - 0.3)^2 - y^2", 0.01)):
    p.below(oscillation(dimension, 8, lift, False), limit, lift)

# Uniform pressure on quadratic tetrahedra, whose functions of corners have no area.
p.write("box.msh", box((4, 4, 1), (0, 0, 0), (1, 1, 1)).gmsh())
p.write("box.prm", solid(
    3, section("Body 1", section("Mesh", "File = box.msh"), "Young modulus = 1000",
               "Poisson ratio = 0", "Prescribed displacement = 5: 0, 0, -0.01"),
    section("Obstacle 1", "Kind = plane", "Point = 0, 0, 0", "Normal = 0, 0, 1"),
    section("Pair 1", "Secondary = 1: 4", "Obstacle = 1"),
    section("Refinement", "Level = 0"), section("Output", "Fields = false"),
    bodies=1, obstacles=1))
tetrahedra = p.run_scene("box.prm", ("Solid/Degree=2", *NITSCHE))
p.close(tetrahedra["pair_1_pressure"], 10., 1e-6, "tetrahedra, pressure")
p.below(tetrahedra["pair_1_oscillation"], 1e-6, "tetrahedra")

# Two rings with radii 1, 2 and 2, 3, pressed into each other by 0.001: Lame's pressure
# in plane strain. Polygons that do not match touch at some of their nodes only.
E, NU, A, B, C, OVERLAP = 1000., 0.3, 1., 2., 3., 1e-3
LAME = OVERLAP * E / (1 - NU**2) / B / ((B**2 + A**2) / (B**2 - A**2)
                                        + (C**2 + B**2) / (C**2 - B**2))


def ring(number, inner, outer, cells):
    return section(f"Body {number}",
                   section("Mesh", "Generator = quarter_hyper_shell",
                           f"Arguments = 0, 0 : {inner} : {outer} : {cells} : true"),
                   f"Young modulus = {E}", f"Poisson ratio = {NU}",
                   "Prescribed displacement = 2: 0, free; 3: free, 0")


def press_fit(cells, level, warns, degree=1, ranks=0, inner=4, settings=()):
    p.write("rings.prm", solid(
        2, ring(1, A, B, inner), ring(2, B, C, cells),
        section("Pair 1", "Secondary = 1: 1", "Primary = 2: 0",
                f"Initial gap = {-OVERLAP}"),
        section("Refinement", f"Level = {level}"),
        section("Output", "Fields = false", "Pictures = false")))
    summary = p.run_scene("rings.prm", (f"Solid/Degree={degree}", *settings), ranks=ranks,
                          words=["ABUT-F51"] if warns else [],
                          without=[] if warns else ["ABUT-F51"])
    error = summary["pair_1_pressure"] / LAME - 1
    p.expect((abs(error) > 0.2) == warns, f"{cells} cells, level {level}: {error}")
    return error, summary["pair_1_oscillation"]


for ranks in (0, 2):
    p.close(press_fit(6, 4, True, ranks=ranks)[1], math.sqrt(0.5), 1e-3, "every other node")
for cells, level in ((3, 3), (3, 4), (5, 4), (5, 5), (7, 4), (9, 3)):
    press_fit(cells, level, True)
for cells in (4, 8):
    p.below(press_fit(cells, 4, False)[1], 1e-3, f"{cells} cells match")
p.below(abs(press_fit(6, 3, False, degree=2)[0]), 1e-4, "quadratic rings")
# Every sixth node is open.
press_fit(5, 3, True, inner=6)
# Pressures at points of quadratic facets that do not match, and that do.
press_fit(5, 2, True, degree=2, inner=4, settings=NITSCHE)
press_fit(4, 2, False, degree=2, settings=NITSCHE)

p.finish()
