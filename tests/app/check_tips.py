# SPDX-License-Identifier: LGPL-2.1-or-later
"""Tips, edges and corners of obstacles at or near a node of a flat block: the
force has no component along the surface, whatever the flanks are, and it does
not change with the last digits of the position. A node that goes down by g
below a tip of depth d at the offset s from it, beside a flank of the slope k,
has g = d - k s, and the force is proportional to it."""
import math
import random

from block_scene import block, section
from program import Program

DEPTH = 5e-3
OFFSETS = (0., 1e-17, -1e-12, -1e-4, 1e-3)  # of a facet


def rotated(point, angles):
    """About x, y and z, or in the plane."""
    x = list(point)
    for (i, j), angle in zip(((0, 1),) if len(x) == 2 else
                             ((1, 2), (2, 0), (0, 1)), angles):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        x[i], x[j] = c * x[i] - s * x[j], s * x[i] + c * x[j]
    return x


def words(values):
    return ", ".join(f"{value:.17g}" for value in values)


def box(tip, angles):
    """A cube with its lowest corner, or the middle of its lowest edge, at the
    tip."""
    dimension = len(tip)
    corners = [rotated([2. if i >> d & 1 else -2.
                        for d in range(dimension)], angles)
               for i in range(2 ** dimension)]
    lowest = min(corner[-1] for corner in corners)
    at = [corner for corner in corners if corner[-1] < lowest + 1e-12]
    middle = [sum(x) / len(at) for x in zip(*at)]
    return ["Kind = box", f"Size = {words([4.] * dimension)}",
            f"Rotate = {words(angles)}",
            f"Move = {words(t - m for t, m in zip(tip, middle))}"]


def cone(tip, angle, axis):
    return ["Kind = cone", f"Angle = {angle}", f"Axis = {words(axis)}",
            f"Point = {words(tip)}"]


def roof(tip, slope):
    x = "x" if len(tip) == 2 else "x+0*y"
    return ["Kind = height", f"Axis = {words([0.] * (len(tip) - 1) + [-1.])}",
            f"Expression = {slope}*abs({x}-({tip[0]:.17g}))+({tip[-1]:.17g})",
            "Gap along = normal"]


def stl(program, name, tip, angle):
    """The lower half of a roof along y as triangles."""
    slope = math.tan(math.radians(angle))
    low = [(tip[0], y, tip[-1]) for y in (-2., 2.)]
    left, right = ([(tip[0] + side, y, tip[-1] + slope) for y in (-2., 2.)]
                   for side in (-1., 1.))
    sheets = [(low[0], left[0], left[1]), (low[0], left[1], low[1]),
              (low[0], low[1], right[1]), (low[0], right[1], right[0])]
    text = "solid roof\n"
    for sheet in sheets:
        text += ("facet normal 0 0 0\nouter loop\n"
                 + "".join(f"vertex {x:.17g} {y:.17g} {z:.17g}\n"
                           for x, y, z in sheet) + "endloop\nendfacet\n")
    program.write(name, text + "endsolid roof\n")
    return ["Kind = surface", f"File = {name}", "Open surface = true"]


def scene(dimension, obstacle, sliding):
    mesh = ("8, 4 : -1, -1 : 1, 0" if dimension == 2 else
            "4, 4, 2 : -1, -1, -1 : 1, 1, 0")
    bottom, top = (2, 3) if dimension == 2 else (4, 5)
    return (f"set Scene = solid\nset Dimension = {dimension}\n"
            + section("Solid", "Bodies = 1", "Obstacles = 1", "Pairs = 1")
            + block(1, mesh + " : true",
                    f"{bottom}: " + words([0.] * dimension))
            + section("Obstacle 1", *obstacle)
            + section("Pair 1", f"Secondary = 1: {top}", "Obstacle = 1")
            + section("Method", "Discretisation = node to segment",
                      f"Sliding = {sliding}")
            + section("Refinement", "Level = 0", "Coarsest level = 0")
            + section("Output", "Fields = false"))


def cases(program):
    """Name, dimension, function of the tip, slope of the flank on the side of
    positive offsets along x, slope of the other one."""
    r = random.Random(34)
    for _ in range(2):
        angle = r.uniform(5., 85.)
        t = math.tan(math.radians(angle))
        yield (f"box rotated by {angle:.3g}", 2,
               lambda tip, a=angle: box(tip, [a]), t, 1. / t)
    yield "wedge of 88", 2, lambda tip: cone(tip, 88., (0., 1.)), *(
        2 * [math.tan(math.radians(2.))])
    slope = r.uniform(0.2, 2.)
    yield ("height", 2, lambda tip: roof(tip, slope), slope, slope)
    angle = r.uniform(30., 70.)
    t = 1. / math.tan(math.radians(angle))
    yield ("cone", 3, lambda tip: cone(tip, angle, (0., 0., 1.)), t, t)
    edge = r.uniform(20., 70.)
    t = math.tan(math.radians(edge))
    yield ("edge of a box", 3, lambda tip: box(tip, [0., edge, 0.]), 1. / t, t)
    yield ("corner of a box", 3, lambda tip: box(tip, [40., 30., 10.]), None,
           None)
    flank = r.uniform(10., 60.)
    t = math.tan(math.radians(flank))
    yield ("triangles", 3,
           lambda tip: stl(program, "roof.stl", tip, flank), t, t)


def check(program, name, dimension, obstacle, slopes, sliding):
    facet = 0.25 if dimension == 2 else 0.5
    at_node = None
    offsets = OFFSETS if sliding == "small" else OFFSETS[::2]
    for offset in program.some(offsets, 2):
        place = offset * facet
        tip = [place] + [0.] * (dimension - 2) + [-DEPTH]
        program.write("tip.prm", scene(dimension, obstacle(tip), sliding))
        run = program.call("run", "tip.prm", "--output", "out")
        about = f"{name}, {sliding} sliding, offset {offset:g} of a facet"
        program.expect(run.returncode == 0,
                       f"{about}: exit code {run.returncode}\n{run.stderr}")
        if run.returncode == 2:
            return
        force = program.results()[0]["pair_1_force"]
        normal = abs(force[-1])
        program.expect(max(map(abs, force[:-1])) < 1e-10 * normal,
                       f"{about}: force {force}")
        at_node = at_node or normal
        # The node is on the side of the tip that the tip is not.
        slope = slopes[0 if place < 0. else 1]
        if slope is not None:
            expected = 1. - slope * abs(place) / DEPTH
            program.expect(abs(normal / at_node - max(expected, 0.)) < 1e-6,
                           f"{about}: force {normal / at_node} of that at the "
                           f"node, not {expected}")


def main():
    program = Program()
    for sliding in ("small", "large"):
        for name, dimension, obstacle, right, left in cases(program):
            check(program, name, dimension, obstacle, (right, left), sliding)
    program.finish()


main()
