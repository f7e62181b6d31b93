# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes with friction that were made to break the program: obstacles that turn
too far in a step, supports that leave a node one way only, and bodies of
several parts that hold each other. What they end with is known from formulas
or is an error that says what to do."""

import math

from block_scene import section
from program import Program, set_words

p = Program()
quiet = ("Output/Fields=false", "Output/Pictures=false")


def run(scene, *settings):
    return p.call("run", scene, "--output", "out", "--quiet",
                  *set_words(settings + quiet))


def solved(scene, *settings):
    result = run(scene, *settings)
    p.expect(result.returncode == 0,
             f"{scene} {settings}: exit code {result.returncode}\n"
             + result.stderr)
    return p.summary()


# A shaft of radius 1.01 in a ring of radius 1 that turns until all slips: the
# moment is mu times the normal force times the radius of the ring.
shaft = p.write("shaft.prm", "set Scene = solid\nset Dimension = 2\n" + "".join([
    section("Solid", "Obstacles = 1", "Pairs = 1"),
    section("Body 1", section("Mesh", "Generator = hyper_shell",
                              "Arguments = 0, 0 : 1 : 2 : 24 : true"),
            "Young modulus = 1000", "Support = 1: 0, 0"),
    section("Obstacle 1", "Kind = sphere", "Centre = 0, 0", "Radius = 1.01",
            "Rotation angle = 5*t"),
    section("Pair 1", "Secondary = 1: 0", "Obstacle = 1", "Friction = 0.2"),
    section("Load steps", "Steps = 2"), section("Refinement", "Level = 1")]))
for way in (1, -1):
    summary = solved(shaft, f"Obstacle 1/Rotation angle={way * 5}*t")
    p.close(summary["pair_1_moment"][2],
            way * 0.2 * summary["pair_1_normal_force"], 1e-6,
            f"moment of a shaft that turns by {way * 5} degrees")
# 185 degrees in a step look like 175 the other way.
for turns in ("370*t", "-370*t", "31*t"):
    p.expect_error(run(shaft, f"Obstacle 1/Rotation angle={turns}"), "Pair 1",
                   "degrees within a load step", "Time stepping/Number of steps")

# Where supports hold all nodes sideways, there is nothing to rub: a uniform
# strain of 0.01 along the height, E (1 - nu) / ((1 + nu) (1 - 2 nu)) times that
# on a length of 2.
plate = p.source / "prm/rigid-plate.prm"
held = solved(plate, "Pair 1/Friction=0.3",
              "Body 1/Prescribed displacement=2: 0, 0; 0, 1, 3: 0, free")
p.close(held["pair_1_normal_force"], 2 * 0.01 * 1000 * 0.7 / (1.3 * 0.4), 1e-9,
        "normal force where nothing can slide")
# The same along the normal: no row is left, and the body is held all the same.
solved(plate, "Body 1/Prescribed displacement=2: 0, 0; 3: free, 0", "Refinement/Level=0")

# A cone on an axisymmetric body: the node on the axis moves along it only, and
# contact and stick would be two conditions for that.
frictionless = solved(p.source / "prm/cone.prm")
for mu in (0.01, 0.3):
    summary = solved(p.source / "prm/cone.prm", f"Pair 1/Friction={mu}")
    p.close(summary["contact_force"], frictionless["contact_force"], 0.05,
            f"force of a cone with friction {mu}")
    p.expect(summary["pair_1_friction_force"]
             <= mu * summary["pair_1_normal_force"] * (1 + 1e-9),
             f"friction of a cone with friction {mu}")

# A parabola pressed into a block in a few load steps. In one step all points
# were open before, and those that slip have the share that their pressures, on
# facets of the same size, have of all; half a facet is on the axis.
late = p.source / "prm/failures/friction-late.prm"
for steps, is_told in ((1, True), (2, True), (5, False)):
    result = run(late, f"Time stepping/Number of steps={steps}")
    p.expect(result.returncode == 0
             and ("ABUT-F50: Pair 1" in result.stderr) == is_told,
             f"pressed in {steps} steps: {result.stderr}")
    summary = p.summary()
    seen = summary["examination"]["pair_1_late_share"]
    p.expect((seen["value"] > seen["warning_above"]) == is_told
             and seen["code"] == "ABUT-F50", f"pressed in {steps} steps: {seen}")
    if steps == 1:
        points = [(row["pressure"] * (0.5 if row["x"] == 0 else 1.),
                   row["status"]) for row in p.table("pair_1.csv")]
        p.close(summary["pair_1_late_share"],
                sum(force for force, status in points if status == 2)
                / sum(force for force, status in points), 1e-6,
                "force at points that slip and close in the only step")
# All points slide: no step is too long for that.
drag = ("Time stepping/Number of steps=1", "Time stepping/End time=1",
        "Obstacle 1/Motion=0.05*t, -0.01*t")
result = run(p.source / "prm/dragged-block.prm", *drag)
summary = p.summary()
p.expect(summary["pair_1_slipping"] == summary["pair_1_active"]
         and summary["pair_1_late_share"] == 0
         and "ABUT-F50" not in result.stderr, f"dragged: {result.stderr}")

# Half a disc on another, pressed by P = 9.6 and pulled by more than mu P = 2.88
# in the same step; and one on a smooth plane, with a moment about its centre,
# through which all forces of contact pass.
def half_disc(number, turn, move, *lines):
    return section(f"Body {number}", section(
        "Mesh", "Generator = half_hyper_ball", "Arguments = 0, 0 : 8",
        f"Rotate = {turn}", f"Move = 0, {move}"), "Young modulus = 210",
        "Poisson ratio = 0.3", *lines)


base = "set Scene = solid\nset Dimension = 2\n"
slides = p.write("slides.prm", base + section("Solid", "Bodies = 2", "Pairs = 1")
                 + half_disc(1, 90, -8, "Support = 1: 0, 0")
                 + half_disc(2, -90, 8, "Traction = 1: 0.25*t, -0.6*t + 0.09375*x*t")
                 + section("Pair 1", "Secondary = 1: 0", "Primary = 2: 0",
                           "Friction = 0.3")
                 + section("Refinement", "Level = 5"))
for settings in ((), ("Time stepping/Cut back=false",)):
    result = run(slides, *settings)
    p.expect(result.returncode == 3 and "ABUT-F42" in result.stderr
             and "ABUT-F24" not in result.stderr,
             f"slides {settings}: {result.stderr}")
tips = p.write("tips.prm", base + section("Solid", "Obstacles = 1", "Pairs = 1")
               + half_disc(1, -90, 8, "Support = 1: 0, free",
                           "Traction = 1: 0, -0.3*t - 0.2*x*t")
               + section("Obstacle 1", "Kind = plane")
               + section("Pair 1", "Secondary = 1: 0", "Obstacle = 1")
               + section("Method", "Contact geometry = current")
               + section("Refinement", "Level = 5"))
result = run(tips)
p.expect(result.returncode == 3 and "ABUT-F12" in result.stderr
         and "body 1 can rotate about" in result.stderr
         and "check that the tangent" not in result.stderr,
         f"tips: {result.stderr}")

# The load along an incline is that of both blocks on it, though the one on top is
# only held by friction, too: sin 15 and mu cos 15 of their weight.
weight = 10 * (2 * 8 + 5 * 2)
slope = math.radians(15)
stack = p.write("stack.prm", base + section(
    "Solid", "Bodies = 2", "Pairs = 2", "Obstacles = 1",
    f"Gravity = {10 * math.sin(slope)!r}, {-10 * math.cos(slope)!r}")
    + "".join(section(f"Body {number}", section(
        "Mesh", "Generator = subdivided_hyper_rectangle",
        f"Arguments = {arguments} : true"), "Young modulus = 1e6",
        "Poisson ratio = 0.3", f"Density = {density}")
        for number, density, arguments in (
            (1, 2, "8, 4 : 0, 0 : 4, 2"), (2, 5, "5, 3 : 1, 2 : 3, 3")))
    + section("Obstacle 1", "Kind = plane")
    + section("Pair 1", "Secondary = 1: 2", "Obstacle = 1")
    + section("Pair 2", "Secondary = 2: 2", "Primary = 1: 3", "Friction = 0.4")
    + section("Refinement", "Level = 0"))
# By the last iterate, all slips, or the solver or the active sets find nothing.
n_loads = 0
for mu in (0.02, 0.05, 0.1, 0.2):
    result = run(stack, f"Pair 1/Friction={mu}")
    p.expect(result.returncode == 3, f"stack, mu = {mu}: {result.stderr}")
    for finding in p.summary()["findings"].values():
        if "load" not in finding["numbers"]:
            continue
        n_loads += 1
        p.close(finding["numbers"]["load"], weight * math.sin(slope), 1e-6,
                f"load of the stack along the incline, mu = {mu}")
        p.close(finding["numbers"]["friction"], mu * weight * math.cos(slope),
                0.05, f"friction of the stack at most, mu = {mu}")
p.expect(n_loads > 0, "loads of the stack along the incline")

# Bodies are called by their number and name, all that are free.
named = ("Body 1/Name=sled", "Body 1/Prescribed displacement=")
result = run(p.source / "prm/failures/floating-sideways.prm", *named)
p.expect(result.returncode == 3 and "ABUT-F12" in result.stderr
         and "body 1 (sled) can" in result.stderr, f"sled: {result.stderr}")
result = run(p.source / "prm/two-cylinders.prm", "Output/Expected=",
             "Body 1/Name=lower", "Body 2/Name=upper",
             "Body 1/Prescribed displacement=",
             "Body 2/Prescribed displacement=")
p.expect(result.returncode == 3 and "ABUT-F12" in result.stderr
         and "of body 1 (lower) and body 2 (upper)" in result.stderr,
         f"two free bodies: {result.stderr}")

# What `auto` does not solve by iterations is factorised; they fail by request.
few = ("Solver/Direct limit=100", "Solver/Maximum iterations=2")
expected = solved(p.source / "prm/dragged-block.prm")["energy"]
p.close(solved(p.source / "prm/dragged-block.prm", *few)["energy"], expected,
        1e-10, "energy by factors after iterations")
result = run(p.source / "prm/dragged-block.prm", few[1],
             "Solver/Linear solver=iterative")
p.expect(result.returncode == 3 and "ABUT-F30" in result.stderr,
         f"two iterations: {result.returncode} {result.stderr}")

# A cube of edge 1 that slides by 5 is not on the other one any more.
blocks = p.source / "prm/two-blocks-3d.prm"
for way, code in ((5, 3), (0.6, 0)):
    result = run(blocks, "Pair 1/Friction=0.3", "Refinement/Level=1",
                 "Solid/Accept strains beyond linear theory=true",
                 f"Body 2/Prescribed displacement=5: {way}, 0, -0.02")
    p.expect(result.returncode == code and "ABUT-F36" in result.stderr,
             f"a cube that slides by {way}: {result.returncode} "
             + result.stderr)

# Two blocks in one mesh file, the upper one held by contact and by its side.
nodes, cells, lines = [], [], []
for y, bottom, top in ((0, 1, 2), (1, 3, 4)):
    first = len(nodes) + 1
    nodes += [(i / 2, y + j / 2) for j in range(3) for i in range(3)]
    at = [[first + 3 * j + i for i in range(3)] for j in range(3)]
    cells += [(at[j][i], at[j][i + 1], at[j + 1][i + 1], at[j + 1][i])
              for j in range(2) for i in range(2)]
    lines += [(bottom, at[0][i], at[0][i + 1]) for i in range(2)]
    lines += [(top, at[2][i], at[2][i + 1]) for i in range(2)]
    lines += [(5, at[j][i], at[j + 1][i]) for j in range(2) for i in (0, 2)]
elements = ([f"1 2 {b} {b} {i} {j}" for b, i, j in lines]
            + [f"3 2 0 0 {' '.join(map(str, cell))}" for cell in cells])
p.write("two.msh", "\n".join([
    "$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(len(nodes)),
    *(f"{i} {x} {y} 0" for i, (x, y) in enumerate(nodes, 1)), "$EndNodes",
    "$Elements", str(len(elements)),
    *(f"{i} {text}" for i, text in enumerate(elements, 1)), "$EndElements"])
    + "\n")
parts = p.write("parts.prm", "set Scene = solid\nset Dimension = 2\n"
                + section("Solid", "Pairs = 1")
                + section("Body 1", section("Mesh", "File = two.msh"),
                          "Young modulus = 1000", "Poisson ratio = 0",
                          "Support = 1: 0, 0; 4: 0, free", "Pressure = 4: 1")
                + section("Pair 1", "Secondary = 1: 3", "Primary = 1: 2"))
for settings in ((), ("Pair 1/Secondary=1: 2, 3", "Pair 1/Primary=1: 2, 3")):
    summary = solved(parts, *settings)
    p.close(summary["contact_force"], 1., 1e-9,
            f"force on a part of a body {settings}")
    # two blocks of height 1 under the stress 1
    p.close(summary["energy"], -0.5 * 2 / 1000, 1e-9,
            f"energy of two parts of a body {settings}")
result = run(parts, "Body 1/Prescribed displacement=1: 0, 0")
# No load along it: the answer has the least such motion, which is reported.
p.expect(result.returncode == 0 and "ABUT-F12" in result.stderr
         and "body 1, of whose 2 parts the one with the corner (0 1), can slide"
         in result.stderr, f"a part that slides: {result.stderr}")
p.expect_error(run(parts, "Pair 1/Secondary=1: 1", "Pair 1/Primary=1: 2",
                   "Body 1/Prescribed displacement=1: free, 0; 2: 0, free"),
               "Body 1/Prescribed displacement", "(0 1)", "ABUT-F12", "in no contact pair")
p.finish()
