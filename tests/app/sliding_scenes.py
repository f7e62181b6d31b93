# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of two bodies that turn as a whole or slide on each other, and how
Newton's method does in them."""
import csv
import math

from block_scene import block, pair, section, solid

RUBBER = ["Material = neo-hooke", "Young modulus = 1", "Poisson ratio = 0.3"]


def newton(p, load_step):
    with open(p.folder / "out/newton.csv", encoding="utf-8") as file:
        rows = [{key: float(value) for key, value in row.items()}
                for row in csv.DictReader(file)]
    return [row for row in rows if row["load_step"] == load_step]


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


# A stiff die with an arc of radius 1 below is pressed into a block and slides on,
# by 20 facets in 22 steps, without friction.
def write_die(p, columns, rows, middle, width=1.2, radius=1., height=0.6,
              name="die.inp"):
    """Mesh of the die; its lowest point is at (middle, 1). Ids: 2 arc, 3 top."""
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
    number = lambda row, column: row * (columns + 1) + column + 1
    items = []
    for row in range(rows):
        for column in range(columns):
            items.append((0, "quad", number(row, column),
                          number(row, column + 1), number(row + 1, column + 1),
                          number(row + 1, column)))
    for column in range(columns):
        items.append((2, "line", number(0, column), number(0, column + 1)))
        items.append((3, "line", number(rows, column),
                      number(rows, column + 1)))
    lines = [f"{len(nodes)} {len(items)} 0 0 0"]
    lines += [f"{n + 1} {x!r} {y!r} 0" for n, (x, y) in enumerate(nodes)]
    lines += [f"{n + 1} {' '.join(map(str, item))}"
              for n, item in enumerate(items)]
    return p.write(name, "\n".join(lines) + "\n")


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
