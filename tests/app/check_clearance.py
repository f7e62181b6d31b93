# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that a force moves across clearances to walls or to each other: seeded
rows of blocks, whose forces are the sums of loads before them, and blocks drawn
into corners with friction, which do not depend on the clearance."""
import random

from program import Program, set_words

p = Program()
random.seed(34)


def section(name, *lines):
    return "\n".join([f"subsection {name}",
                      *(line if line.startswith("subsection")
                        else f"set {line}" for line in lines), "end"])


def row(name, dim, widths, gaps, forces, height):
    """Blocks in a row between two walls, gaps[k] before block k."""
    zeros = ", 0" * (dim - 1)
    cells = ", ".join(["2"] * dim)
    far = f", {height!r}" * (dim - 1)
    text = ["set Scene = solid", f"set Dimension = {dim}",
            section("Solid", f"Bodies = {len(widths)}",
                    f"Pairs = {len(widths) + 1}", "Obstacles = 2")]
    x = 0.
    for k, width in enumerate(widths):
        x += gaps[k]
        slides = "; ".join(
            f"{2 * d}: " + ", ".join("0" if c == d else "free"
                                     for c in range(dim))
            for d in range(1, dim))
        text += [section(
            f"Body {k + 1}", section(
                "Mesh", "Generator = subdivided_hyper_rectangle",
                f"Arguments = {cells} : {x!r}{zeros} : "
                f"{x + width!r}{far} : true"),
            "Young modulus = 100", "Poisson ratio = 0",
            f"Support = {slides}", f"Body force = {forces[k]!r}*t{zeros}")]
        x += width
    x += gaps[-1]
    text += [section("Obstacle 1", "Kind = plane", f"Point = 0{zeros}",
                     f"Normal = 1{zeros}"),
             section("Obstacle 2", "Kind = plane", f"Point = {x!r}{zeros}",
                     f"Normal = -1{zeros}"),
             section("Pair 1", "Secondary = 1: 0", "Obstacle = 1"),
             section("Pair 2", f"Secondary = {len(widths)}: 1",
                     "Obstacle = 2")]
    for k in range(1, len(widths)):
        text += [section(f"Pair {k + 2}", f"Secondary = {k}: 1",
                         f"Primary = {k + 1}: 0")]
    text += [section("Refinement", "Level = 0")]
    return p.write(name, "\n".join(text) + "\n")


def run(scene, *settings):
    return p.call("run", scene, "--output", "out", "--quiet", *set_words(
        ["Output/Fields=false", "Output/Pictures=false", *settings]))


CLEARANCES = [0., 1e-12, 1e-9, 1e-6, 1e-4, 0.003, 0.01, 0.05, 0.1, 0.2]
for number, clearance in enumerate(CLEARANCES):
    dim, n = (3 if number % 5 == 4 else 2), 1 + number % 3
    widths = [random.uniform(0.8, 1.5) for _ in range(n)]
    gaps = [clearance * random.uniform(0.5, 1) for _ in range(n + 1)]
    size = 10. ** random.uniform(-6, 0)
    forces = [size * random.uniform(0.2, 1) for _ in range(n)]
    height = random.uniform(0.6, 1.2)
    scene = row("row.prm", dim, widths, gaps, forces, height)
    for sign, wall in ((1, 2), (-1, 1)):
        signed = [f"Body {k + 1}/Body force={sign * force!r}*t"
                  + ", 0" * (dim - 1) for k, force in enumerate(forces)]
        result = run(scene, *signed)
        what = f"row {number}, {n} blocks, clearance {clearance}, {sign}"
        p.expect(result.returncode == 0, f"{what}: {result.stderr}")
        area = height ** (dim - 1)
        loads = [f * w * area for f, w in zip(forces, widths)]
        summary = p.results()[0]
        total = sum(loads)
        p.close(-sign * summary[f"pair_{wall}_force"][0] / total, 1., 1e-6,
                what)
        p.close(summary[f"pair_{3 - wall}_force"][0] / total, 0., 1e-6, what)
        for k in range(1, n):
            between = sum(loads[:k]) if sign > 0 else sum(loads[k:])
            p.close(-summary[f"pair_{k + 2}_force"][0] / total,
                    between / total, 1e-6, f"{what}, after block {k}")


def corner(name, clearance, load, size, level):
    """A block drawn into a corner that all of it is as far from as the load
    takes it, so that it touches both walls at once."""
    walls = []
    for k, normal in enumerate(("-1, 0", "0, -1")):
        point = [0., 0.]
        point[k] = size[k] + clearance * load[k]
        walls += [section(f"Obstacle {k + 1}", "Kind = plane",
                          f"Point = {point[0]!r}, {point[1]!r}",
                          f"Normal = {normal}"),
                  section(f"Pair {k + 1}", f"Secondary = 1: {2 * k + 1}",
                          f"Obstacle = {k + 1}", "Friction = 0.3")]
    return p.write(name, "\n".join([
        "set Scene = solid", "set Dimension = 2",
        section("Solid", "Pairs = 2", "Obstacles = 2"),
        section("Body 1", section(
            "Mesh", "Generator = subdivided_hyper_rectangle",
            f"Arguments = 3, 3 : 0, 0 : {size[0]!r}, {size[1]!r} : true"),
            "Young modulus = 100", "Poisson ratio = 0.3",
            f"Body force = {load[0]!r}*t, {load[1]!r}*t"),
        *walls, section("Refinement", f"Level = {level}")]) + "\n")


# Slips begin with the touch, on nested meshes too.
for number in range(2):
    block = ((random.uniform(0.8, 1.2), random.uniform(0.3, 0.5)),
             (random.uniform(0.9, 1.1), random.uniform(0.9, 1.1)), number)
    touching = None
    for clearance in (0., 1e-4, 0.01, 0.1, 0.5):
        scene = corner("corner.prm", clearance, *block)
        result = run(scene)
        what = f"corner {number}, clearance {clearance}"
        p.expect(result.returncode == 0, f"{what}: {result.stderr}")
        summary = p.results()[0]
        forces = [summary[f"pair_{k}_{key}"][d] for k in (1, 2)
                  for key in ("force", "friction") for d in (0, 1)]
        p.expect(abs(summary["pair_2_friction"][0]) > 0.01, what)
        touching = touching or forces
        for value, expected in zip(forces, touching):
            p.close(value, expected, 1e-9, what)
p.finish()
