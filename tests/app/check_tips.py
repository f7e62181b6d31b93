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
OFFSETS = (0., 1e-3, 1e-17, -1e-12, -1e-4)  # of a facet


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


def triangles(program, tip, angles):
    """The same box as triangles, whose corners are apart by some 1e-8 of its
    edges."""
    r, text = random.Random(1), "solid box\n"
    for axis in range(3):
        for side in (-2., 2.):
            square = [(a, b) if side > 0. else (b, a)
                      for a, b in ((-2., -2.), (2., -2.), (2., 2.), (-2., 2.))]
            corners = [[*x[:3 - axis - 1], side, *x[3 - axis - 1:]]
                       for x in square]
            # Two coordinates in their order around the one in the middle are
            # the other way round.
            if axis == 1:
                corners.reverse()
            for triangle in (corners[:3], [corners[2], corners[3], corners[0]]):
                text += "facet normal 0 0 0\nouter loop\n" + "".join(
                    "vertex " + " ".join(f"{x + r.uniform(-4e-8, 4e-8):.17g}"
                                         for x in corner) + "\n"
                    for corner in triangle) + "endloop\nendfacet\n"
    program.write("box.stl", text + "endsolid box\n")
    return (["Kind = surface", "File = box.stl"]
            + [line for line in box(tip, angles)
               if not line.startswith(("Kind", "Size"))])


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
    yield ("triangles", 3,
           lambda tip: triangles(program, tip, [0., edge, 0.]), 1. / t, t)


def check(program, name, dimension, obstacle, slopes, sliding):
    facet = 0.25 if dimension == 2 else 0.5
    at_node = None
    offsets = OFFSETS if sliding == "small" else OFFSETS[::3]
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
        # Corners of triangles are apart: the edge is inclined by so much.
        apart = name == "triangles"
        program.expect(max(map(abs, force[:-1]))
                       < (1e-7 if apart else 1e-10) * normal,
                       f"{about}: force {force}")
        at_node = at_node or normal
        # The node is on the side of the tip that the tip is not.
        slope = slopes[0 if place < 0. else 1]
        if slope is not None:
            expected = 1. - slope * abs(place) / DEPTH
            program.expect(abs(normal / at_node - max(expected, 0.))
                           < (1e-3 if apart else 1e-6),
                           f"{about}: force {normal / at_node} of that at the "
                           f"node, not {expected}")


def main():
    program = Program()
    for sliding in ("small", "large"):
        for name, dimension, obstacle, right, left in cases(program):
            check(program, name, dimension, obstacle, (right, left), sliding)
    program.finish()


main()
