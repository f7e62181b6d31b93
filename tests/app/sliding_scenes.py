# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of two bodies that turn as a whole or slide on each other, and how
Newton's method does in them."""
import math

from block_scene import block, pair, section, solid
from ucd import ucd

RUBBER = ["Material = neo-hooke", "Young modulus = 1", "Poisson ratio = 0.3"]


def newton(p, load_step):
    """Rows of the last attempt at a load step."""
    rows = [row for row in p.table("newton.csv") if row["load_step"] == load_step]
    return rows[max(i for i, row in enumerate(rows) if row["linearisation"] == 1.):]


# Two blocks are pressed until t = 0.2, then turned about the origin, as a whole
# with what holds them. Points on whole facets do not transfer a uniform pressure
# exactly, but what they do must turn with them.
PART = "(min(1, 5*t)*0.05)"
ANGLE = "(pi/2*max(0, (t - 0.2)/0.8))"


def turned(y):
    """Displacement of (x, y), which is turned, in 2D."""
    return (f"x*cos({ANGLE}) - ({y})*sin({ANGLE}) - x, "
            f"x*sin({ANGLE}) + ({y})*cos({ANGLE}) - y")


def turn(p, dimension):
    flat = dimension == 2
    rest = "" if flat else ", 0"
    size = ("9, 3 : -1, 0 : 2, 1 : true", "6, 3 : 0.1, 1 : 1.2, 2 : true")
    if not flat:
        size = ("4, 2, 3 : -1, 0, -1 : 2, 1, 1 : true",
                "3, 2, 3 : 0.1, 1, -0.4 : 1.2, 2, 0.5 : true")
    return p.write(f"turn-{dimension}.prm", solid(
        dimension,
        block(1, size[0], f"2: {turned('y')}{rest}", more=RUBBER),
        block(2, size[1], f"3: {turned('y - ' + PART)}{rest}", more=RUBBER),
        pair("2: 2", "1: 3"), section("Load steps", "Steps = 15"),
        section("Refinement", "Level = 0"),
        section("Output", "Fields = false",
                f"Points = 2: 0.1, 1{'' if flat else ', -0.4'}; "
                f"2: 1.2, 1{'' if flat else ', 0.5'}")))


def check_friction_turned(p, dimension, solved, *words):
    """All forces of the turned blocks, friction too, which some nodes take up
    by sticking, are those of before; solved(scene, *words) is a summary."""
    scene = turn(p, dimension)
    here = solved(scene, *words, "Time stepping/End time=0.2",
                  "Time stepping/Number of steps=3")
    there = solved(scene, *words)
    what = f"turned {words}"
    p.expect(here["pair_1_friction_force"] > 1e-3 * here["contact_force"],
             f"{what}: no friction to turn")
    for key in ("energy", "pair_1_pressure", "pair_1_normal_force",
                "pair_1_friction_force", "least_stretch", "least_volume"):
        p.close(there[key], here[key], 1e-9, f"{what}: {key}")
    # What has slipped is at its bound and stays there, without a way.
    p.expect(there["pair_1_dissipation"] < 1e-10 * here["energy"],
             f"{what}: dissipation {there['pair_1_dissipation']}")
    scale = here["contact_force"]
    for key in ("pair_1_force", "pair_1_friction"):
        force, before = there[key], here[key]
        p.expect(abs(force[0] + before[1]) < 1e-9 * scale
                 and abs(force[1] - before[0]) < 1e-9 * scale,
                 f"{what}: {key} {force} from {before}")
    print(what, "linearisations",
          [len(newton(p, step)) for step in range(1, 16)])


# A stiff die with an arc of radius 1 below is pressed into a block and slides on,
# by 20 facets in 22 steps, without friction.
def write_die(p, columns, rows, middle, width=1.2, radius=1., height=0.6,
              name="die.inp", thickness=0.):
    """Mesh of the die; its lowest point is at (middle, 1). With a thickness it is
    one of cells in space, from z = 0. Ids: 2 arc, 3 top, 4 and 5 front and
    back."""
    half = math.asin(width / 2 / radius)
    nodes = []
    for row in range(rows + 1):
        for column in range(columns + 1):
            angle = half * (2 * column / columns - 1)
            arc = (radius * math.sin(angle), radius * (1 - math.cos(angle)))
            top = (width * (column / columns - 0.5), height)
            part = row / rows
            nodes.append([m + a + part * (b - a)
                          for m, a, b in zip((middle, 1.), arc, top)])
    n = len(nodes)
    number = lambda row, column: row * (columns + 1) + column + 1
    quads = [(number(row, column), number(row, column + 1),
              number(row + 1, column + 1), number(row + 1, column))
             for row in range(rows) for column in range(columns)]
    lines = [(side, number(row, column), number(row, column + 1))
             for column in range(columns) for side, row in ((2, 0), (3, rows))]
    nodes = [(x, y, 0.) for x, y in nodes]
    if thickness > 0.:
        nodes += [(x, y, thickness) for x, y, _ in nodes]
        behind = lambda corners: [corner + n for corner in corners]
        items = [(0, "hex", *quad, *behind(quad)) for quad in quads]
        items += [(side, "quad", a, b, b + n, a + n) for side, a, b in lines]
        items += [(4, "quad", *quad) for quad in quads]
        items += [(5, "quad", *behind(quad)) for quad in quads]
    else:
        items = [(0, "quad", *quad) for quad in quads]
        items += [(side, "line", a, b) for side, a, b in lines]
    return p.write(name, ucd(nodes, items))


def dies(columns, rows, width, mesh, young, way, *more):
    """A die of a mesh file that moves on a block of a width and height 1."""
    return solid(
        2, block(1, f"{columns}, {rows} : 0, 0 : {width}, 1 : true", "2: 0, 0",
                 more=RUBBER),
        section("Body 2", section("Mesh", f"File = {mesh}"), RUBBER[0],
                f"Young modulus = {young}", RUBBER[2], f"Support = 3: {way}"),
        pair("1: 3", "2: 2"), section("Refinement", "Level = 0"),
        section("Output", "Fields = false"), *more)


def slide(p, columns, rows, die_columns, die_rows, steps, length=2., width=4):
    """On a block of a width, over its middle."""
    die = write_die(p, die_columns, die_rows, width / 2 - 1.)
    way = f"if(t > 1, {length}*(t - 1), 0), -0.15*min(2*t, 1)"
    return p.write("slide.prm", dies(
        columns, rows, width, die, 10, way,
        section("Load steps", f"Steps = {2 * steps}", "End time = 2")))


# It slides over the end of a block and off it, in the plane, or in space in a
# state of plane strain; what is the secondary is chosen.
THICKNESS = 0.15


def over_the_end(p, dimension, secondary, depth=0.08):
    flat = dimension == 2
    die = write_die(p, 12, 4, 1.3, name=f"die-{dimension}.inp",
                    thickness=0. if flat else THICKNESS)
    way = f"if(t > 4, 1.4*(t - 4)/16, 0), -{depth}*min(t/4, 1)"
    box = ("20, 6 : 0, 0 : 2, 1 : true" if flat else
           f"20, 6, 1 : 0, 0, 0 : 2, 1, {THICKNESS} : true")
    rest, sides = ("", "") if flat else (
        ", 0", "; 4: free, free, 0; 5: free, free, 0")
    surfaces = ("1: 3", "2: 2")
    return p.write(f"over-{dimension}.prm", solid(
        dimension, block(1, box, f"2: 0, 0{rest}{sides}", more=RUBBER),
        section("Body 2", section("Mesh", f"File = {die}"), RUBBER[0],
                "Young modulus = 10", RUBBER[2],
                f"Support = 3: {way}{rest}{sides}"),
        pair(surfaces[secondary - 1], surfaces[2 - secondary]),
        section("Refinement", "Level = 0"), section("Output", "Fields = false"),
        section("Load steps", "Steps = 20", "End time = 20")))


# The same in ten steps of pressing, and n of sliding: soft and shallow, or deep,
# with a small die whose arc is half a circle.
def press_and_slide(p, n, hard=False, die_young=10):
    columns, radius, height, depth, length = (
        11, 0.6, 1.2, 0.35, 0.7) if hard else (12, 1., 0.6, 0.15, 2.)
    die = write_die(p, columns, 5, 2. - length / 2, radius=radius, height=height,
                    name="pressed-die.inp")
    way = (f"if(t > 10, {length}*(t - 10)/{n}, 0), -{depth}*min(t/10, 1)")
    return p.write("press-and-slide.prm", dies(
        40, 10, 4, die, die_young, way,
        section("Load steps", f"Steps = {10 + n}", f"End time = {10 + n}")))


def orders(p, load_step):
    """Of the forces out of balance, the last three above round-off."""
    forces = [row["residual"] for row in newton(p, load_step)
              if row["part"] == 1. and row["residual"] > 1e-12]
    print(*(f"{force:.3g}" for force in forces))
    a, b, c = forces[-3:]
    return math.log(c / b) / math.log(b / a)
