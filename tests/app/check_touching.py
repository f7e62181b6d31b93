# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that touch exactly, or but for small distances, and that contact alone
supports: seeded ladders and blocks, whose forces follow from statics."""
import itertools
import math
import random
import re

from program import Program, set_words

p = Program()
random.seed(34)
SHIFTS = [0., 1e-17, -1e-17, 1e-12, -1e-12, 3e-9, -3e-9, 1e-8, 1e-6, -1e-6]


def section(name, *lines):
    return "\n".join([f"subsection {name}",
                      *(line if line.startswith("subsection")
                        else f"set {line}" for line in lines), "end"])


def ladder(name, length, thickness, degrees, weight, mu, shift):
    """A bar on a rough floor that leans on a smooth wall; the force of the
    wall by moments about the foot."""
    a = math.radians(180 - degrees)
    c, s = math.cos(a), math.sin(a)
    move = (-length * c + thickness * s, -thickness * c)
    middle = length / 2 * c - thickness / 2 * s + move[0]
    foot, top = -length * c, length * s
    force = weight * (foot - middle) / top
    density = weight / (length * thickness)
    p.write(name, "\n".join([
        "set Scene = solid", "set Dimension = 2",
        section("Solid", "Pairs = 2", "Obstacles = 2"),
        section("Body 1", section(
            "Mesh", "Generator = subdivided_hyper_rectangle",
            f"Arguments = 2, 1 : 0, 0 : {length!r}, {thickness!r} : true",
            f"Rotate = {180 - degrees!r}", f"Move = {move[0]!r}, {move[1]!r}"),
            "Young modulus = 1e5", "Poisson ratio = 0.3",
            f"Body force = 0, -{density!r}*t"),
        section("Obstacle 1", "Kind = plane", f"Point = 0, {shift!r}"),
        section("Obstacle 2", "Kind = plane", "Normal = 1, 0"),
        section("Pair 1", "Secondary = 1: 0", "Obstacle = 1",
                f"Friction = {mu * force / weight!r}"),
        section("Pair 2", "Secondary = 1: 1", "Obstacle = 2"),
        section("Refinement", "Level = 0")]) + "\n")
    return force


def codes(result):
    return set(re.findall(r"ABUT-F\d+", result.stderr))


def run(scene, *settings):
    return p.call("run", scene, "--output", "out", "--quiet", *set_words(
        ["Output/Fields=false", "Output/Pictures=false", *settings]))


# Friction is a tenth more than what holds, or less.
for number, shift in enumerate(SHIFTS):
    length, degrees = random.uniform(2, 6), random.uniform(50, 75)
    shape = (length, length * random.uniform(0.03, 0.1), degrees,
             random.uniform(0.5, 2))
    wall = ladder("ladder.prm", *shape, 1.1, shift)
    result = run("ladder.prm")
    # Two bilinear elements do not bend: right in its resultants (F16).
    p.expect(result.returncode == 0 and not codes(result) - {"ABUT-F16"},
             f"ladder {number} {shape} {shift}: {result.stderr}")
    summary = p.results()[0]
    # Shifts of 1e-6 tilt the body, linearised, by no first order of forces.
    p.close(summary["pair_2_force"][0], wall, 1e-8, f"ladder {number}")
    p.close(summary["pair_1_force"][1], shape[3], 1e-8, f"ladder {number}")
    ladder("ladder.prm", *shape, 0.9, shift)
    result = run("ladder.prm")
    p.expect(result.returncode == 3 and "ABUT-F42" in result.stderr
             and "can rotate about" in result.stderr,
             f"ladder {number} with less friction: {result.stderr}")



def groove(name, mu, part, shift, level):
    """A disc in a groove of 90 degrees with a part of the largest couple that
    friction holds, sqrt(2) mu W R / (1 + mu^2): a polygon of n corners."""
    n = 4 * 2**level
    area = n / 2 * math.sin(2 * math.pi / n)
    inertia = area / 6 * (2 + math.cos(2 * math.pi / n))
    couple = part * math.sqrt(2) * mu * area / (1 + mu**2)
    c, h = couple / inertia, math.sqrt(0.5) * (1 + shift)
    p.write(name, "\n".join([
        "set Scene = solid", "set Dimension = 2",
        section("Solid", "Pairs = 2", "Obstacles = 2"),
        section("Body 1", section("Mesh", "Generator = hyper_ball",
                                  "Arguments = 0, 0 : 1 : true"),
                "Young modulus = 1e4", "Poisson ratio = 0.3",
                f"Body force = -({c!r})*t*y, t*(({c!r})*x - 1)"),
        *(text for k, sign in ((1, -1), (2, 1)) for text in (
            section(f"Obstacle {k}", "Kind = plane",
                    f"Point = {sign * h!r}, {-h!r}",
                    f"Normal = {-sign}, 1"),
            section(f"Pair {k}", "Secondary = 1: 0", f"Obstacle = {k}",
                    f"Friction = {mu!r}"))),
        section("Refinement", f"Level = {level}",
                "Nested iteration = false")]) + "\n")
    return area, couple


# From 0.5 on both contacts may stick, with forces that the clearance sets.
for number, mu in enumerate((0.05, 0.2, 0.4, 0.5, 0.9)):
    for part in (0.3, 0.99, -0.99, 1.01):
        shift = random.choice(SHIFTS)
        area, couple = groove("groove.prm", mu, part, shift, 2)
        result = run("groove.prm")
        what = f"groove {mu} {part} {shift}: {result.stderr}"
        if part > 1:
            p.expect(result.returncode == 3 and "ABUT-F42" in result.stderr,
                     what)
            continue
        # The disc touches each plane with one node: right in its resultants,
        # not in its pressure.
        p.expect(result.returncode == 0
                 and codes(result) - {"ABUT-F16"} == {"ABUT-F48"}, what)
        summary = p.results()[0]
        (x1, y1), (x2, y2) = (summary[f"pair_{k}_force"] for k in (1, 2))
        r = math.sqrt(0.5)
        n1, t1, n2, t2 = r * (x1 + y1), r * (y1 - x1), r * (y2 - x2), r * (
            x2 + y2)
        p.close(n1 + t2, area * r, 1e-8, what)
        p.close(n2 + t1, area * r, 1e-8, what)
        p.close(t1 - t2, couple, 1e-6, what)
        p.expect(max(abs(t1) / n1, abs(t2) / n2) < mu * (1 + 1e-8), what)

# No load is an answer, as is one that passes zero, and a body that is lifted
# off its only plane is none.
block = p.write("block.prm", "\n".join([
    "set Scene = solid", "set Dimension = 2",
    section("Solid", "Pairs = 1", "Obstacles = 1"),
    section("Body 1", section(
        "Mesh", "Generator = subdivided_hyper_rectangle",
        "Arguments = 3, 2 : 0, 0 : 1.5, 1 : true"),
        "Young modulus = 100", "Poisson ratio = 0.25",
        "Support = 0: 0, free"),
    section("Obstacle 1", "Kind = plane"),
    section("Pair 1", "Secondary = 1: 2", "Obstacle = 1"),
    section("Refinement", "Level = 0")]) + "\n")
LAWS = ["lagrange", "penalty", "augmented lagrangian", "quadratic penalty"]
for law, (load, code, force) in itertools.product(
        LAWS, (("0", 0, 0.), ("-sin(pi*t)", 0, 0.), ("-t", 0, 1.5),
               ("t", 3, None))):
    result = run(block, f"Body 1/Body force=0, {load}", "Time stepping/Number of steps=2",
                 f"Method/Enforcement={law}")
    load = f"{load}, {law}"
    p.expect(result.returncode == code, f"load {load}: {result.stderr}")
    p.expect(("ABUT-F12" in result.stderr) == (force != 1.5),
             f"load {load}: {result.stderr}")
    if force is not None:
        found = p.results()[0]["pair_1_force"][1]
        p.expect(abs(found - force) < 1e-9, f"load {load}: force {found}")
p.finish()
