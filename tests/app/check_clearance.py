# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies that a force moves across clearances to walls or to each other: seeded
rows of blocks, whose forces are the sums of loads before them, blocks drawn
into corners with friction, which do not depend on the clearance, keys that turn
in grooves, and pins in holes."""
import math
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


CLEARANCES = [0., 1e-12, 1e-9, 1e-6, 1e-4, 0.003, 0.01, 0.05, 0.1, 0.2, 0.5]
SLIDING = ["small", "step", "large"]
METHODS = [["Method/Enforcement=lagrange"], ["Method/Enforcement=penalty"],
           ["Method/Enforcement=augmented lagrangian"],
           ["Method/Discretisation=node to segment"]]
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
        settings = [*METHODS[number % 4],
                    f"Method/Contact geometry={SLIDING[(number + sign) % 3]}"]
        result = run(scene, *signed, *settings)
        what = (f"row {number}, {n} blocks, clearance {clearance}, {sign}, "
                f"{settings}")
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


def block(name, size, force, walls, friction):
    """A block with a body force between planes (boundary id, point, normal)."""
    return p.write(name, "\n".join([
        "set Scene = solid", "set Dimension = 2",
        section("Solid", f"Pairs = {len(walls)}", f"Obstacles = {len(walls)}"),
        section("Body 1", section(
            "Mesh", "Generator = subdivided_hyper_rectangle",
            f"Arguments = 4, 1 : 0, 0 : {size[0]!r}, {size[1]!r} : true"),
            "Young modulus = 1e4", "Poisson ratio = 0",
            f"Body force = {force}"),
        *(text for k, (side, point, normal) in enumerate(walls) for text in (
            section(f"Obstacle {k + 1}", "Kind = plane", f"Point = {point}",
                    f"Normal = {normal}"),
            section(f"Pair {k + 1}", f"Secondary = 1: {side}",
                    f"Obstacle = {k + 1}", f"Friction = {friction}"))),
        section("Refinement", "Level = 0")]) + "\n")


# A couple turns a key in a groove until two opposite corners touch: M / L, and
# the angle that the clearances leave. Along the groove nothing does work.
for clearance, couple in ((1e-3, 1e-6), (0.1, 1.), (0.5, 1e-6), (0.5, 1.)):
    length, height = random.uniform(3, 5), random.uniform(0.8, 1.2)
    density = 12 * couple / (length * height * (length**2 + height**2))
    scene = block(
        "key.prm", (length, height),
        f"-{density!r}*(y - {height / 2!r})*t, "
        f"{density!r}*(x - {length / 2!r})*t",
        [(2, f"0, {-clearance!r}", "0, 1"),
         (3, f"0, {height + clearance!r}", "0, -1")], 0)
    what = f"key with couple {couple}, clearance {clearance}"
    checked = p.call("check", scene, "--quiet")
    p.expect(checked.returncode == 0, f"check of {what}: {checked.stderr}")
    result = run(scene)
    p.expect(result.returncode == 0 and "do not determine" in result.stderr,
             f"{what}: {result.stderr}")
    summary = p.results()[0]
    for k, sign in ((1, 1), (2, -1)):
        p.close(summary[f"pair_{k}_force"][1], sign * couple / length, 1e-5,
                what)
    p.close(summary["body_1_rotated"], 2 * clearance / length,
            1e-3 + 1e-3 * couple / clearance, what)


def pin(name, dim, clearance, load, level):
    """A ball or disc in a round hole of radius 1."""
    zeros = ", ".join(["0"] * dim)
    return p.write(name, "\n".join([
        "set Scene = solid", f"set Dimension = {dim}",
        section("Solid", "Pairs = 1", "Obstacles = 1"),
        section("Body 1", section(
            "Mesh", "Generator = hyper_ball",
            f"Arguments = {zeros} : {1 - clearance!r} : true"),
            "Young modulus = 1e3", "Poisson ratio = 0.3",
            "Body force = " + ", ".join(f"({f!r})*t" for f in load)),
        section("Obstacle 1", "Kind = sphere", "Radius = 1", "Hollow = true"),
        section("Pair 1", "Secondary = 1: 0", "Obstacle = 1",
                "Friction = 0.3"),
        section("Refinement", f"Level = {level}")]) + "\n")


# A polygon of n corners touches with the two next to the load: the contact
# carries all of it, and the motion is that of a circle but for 1 / cos(pi/n).
for number, clearance in enumerate((0., 1e-12, 1e-6, 1e-3, 0.1, 0.3)):
    size = (1e-6, 0.01)[number % 2]
    angle = random.uniform(0, 2 * math.pi)
    unit = (math.cos(angle), math.sin(angle))
    scene = pin("pin.prm", 2, clearance, [size * u for u in unit], 2)
    result = run(scene, f"Method/Contact geometry={SLIDING[number % 2]}")
    what = f"pin {number}, clearance {clearance}, load {size}"
    p.expect(result.returncode == 0 and "ABUT-F24" not in result.stderr,
             f"{what}: {result.stderr}")
    summary = p.results()[0]
    load = 8 * math.sin(math.pi / 8) * (1 - clearance)**2 * size
    for value, u in zip(summary["pair_1_force"], unit):
        p.expect(abs(value + load * u) < 1e-5 * load, what)
    moved = sum(m * u for m, u in zip(summary["body_1_moved"], unit))
    p.expect(0.999 * clearance < moved < 1.021 * clearance + 1e-2 * size,
             f"{what}: {moved}")

# At points that move the pin goes on to where both corners carry as much; of a
# stiff neo-Hookean body it rotates there. Friction may hold it before, within
# its cone.
for number, clearance in enumerate((0., 1e-12, 1e-6, 1e-3, 0.1, 0.3) * 2):
    size = (1e-6, 1e-4, 0.01, 1.)[random.randrange(4)]
    friction = (0, 0.3)[number % 2]
    angle = random.uniform(0, 2 * math.pi)
    unit = (math.cos(angle), math.sin(angle))
    scene = pin("pin.prm", 2, clearance, [size * u for u in unit], 2)
    material = ("hooke", "neo-hooke")[number // 6]
    result = run(scene, "Method/Contact geometry=current", f"Pair 1/Friction={friction}",
                 f"Body 1/Material={material}", "Output/Points=1: 0, 0")
    what = (f"moving pin {number}, {material}, friction {friction}, "
            f"clearance {clearance}, load {size}")
    p.expect(result.returncode == 0, f"{what}: {result.stderr}")
    if result.returncode != 0:
        continue
    summary = p.results()[0]
    load = 8 * math.sin(math.pi / 8) * (1 - clearance)**2 * size
    for value, u in zip(summary["pair_1_force"], unit):
        p.expect(abs(value + load * u) < 1e-5 * load, f"{what}: {value}")
    point = summary["point_1"]
    moved = sum(m * u for m, u in zip(point, unit))
    least = 0.999 / math.sqrt(1 + friction**2)
    p.expect(least * clearance < moved < 1.021 * clearance + 1e-2 * size,
             f"{what}: {moved}")
    for value, of_body in zip(point, summary["body_1_moved"]):
        p.expect(abs(value - of_body) < 1e-2 * (clearance + size),
                 f"{what}: {value}, {of_body}")

# In an elastic ring nested iteration begins with a square in a dodecagon, on
# which it need not find an answer.
for friction, size in ((0, 1.), (0.3, 1.), (0.1, 0.5)):
    angle = random.uniform(0, 2 * math.pi)
    unit = (math.cos(angle), math.sin(angle))
    radius = 0.999
    scene = p.write("ring.prm", "\n".join([
        "set Scene = solid", "set Dimension = 2",
        section("Solid", "Bodies = 2", "Pairs = 1"),
        section("Body 1", section("Mesh", "Generator = hyper_ball",
                                  f"Arguments = 0, 0 : {radius} : true"),
                "Young modulus = 1e3", "Poisson ratio = 0.3",
                "Body force = " + ", ".join(f"({size * u!r})*t"
                                            for u in unit)),
        section("Body 2", section("Mesh", "Generator = hyper_shell",
                                  "Arguments = 0, 0 : 1 : 1.5 : 12 : true"),
                "Young modulus = 1e4", "Poisson ratio = 0.3",
                "Support = 1: 0, 0"),
        section("Pair 1", "Secondary = 2: 0", "Primary = 1: 0",
                f"Friction = {friction}"),
        section("Refinement", "Level = 3")]) + "\n")
    result = run(scene, "Method/Contact geometry=current")
    what = f"disc in a ring, friction {friction}, load {size}"
    p.expect(result.returncode == 0, f"{what}: {result.stderr}")
    if result.returncode != 0:
        continue
    load = 16 * math.sin(math.pi / 16) * radius**2 * size
    for value, u in zip(p.results()[0]["pair_1_force"], unit):
        p.expect(abs(value - load * u) < 1e-5 * load, f"{what}: {value}")
p.finish()
