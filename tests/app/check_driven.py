# SPDX-License-Identifier: LGPL-2.1-or-later
"""Rigid obstacles that forces move. In equilibrium: an obstacle pressed by the
force that it has at a given depth goes to that depth, by every law and kind of
surface; and closed forms. In time: exchanged momentum, and a ball that falls
as it must. What cannot be is refused."""
import math

from block_scene import block, section, solid
from program import Program

p = Program()
EXACT = {"Method/Final linear tolerance": "1e-12", "Output/Fields": "false"}


def run(scene, settings, **words):
    return p.solve_with(scene, {**EXACT, **settings}, **words)


def refused(scene, settings, *texts, code=2):
    words = [word for key, value in {**EXACT, **settings}.items()
             for word in ("--set", f"{key}={value}")]
    result = p.call("run", p.source / "prm" / scene, "--output", "out",
                    "--quiet", *words)
    if code == 2:
        p.expect_error(result, *texts)
        return
    p.expect(result.returncode == code and all(text in result.stderr
                                               for text in texts),
             f"{settings}: {result.returncode} {result.stderr}")


def duality(what, scene, settings, directions, dim=2, ranks=0, digits=1e-8):
    """The force that goes with a motion goes with that motion."""
    given, _ = run(scene, settings, ranks=ranks)
    force = given["pair_1_force"]
    motion = [text.strip().removesuffix("*t")
              for text in settings["Obstacle 1/Motion"].split(",")]
    free = [d for d in range(dim) if "xyz"[d] in directions]
    back, rows = run(scene, {
        **settings,
        "Obstacle 1/Motion": ", ".join(
            "0" if d in free else settings["Obstacle 1/Motion"].split(",")[d]
            for d in range(dim)),
        "Obstacle 1/Free directions": directions,
        "Obstacle 1/Force": ", ".join(repr(f) for f in force)}, ranks=ranks)
    size = max(abs(float(motion[d])) for d in free)
    for d in free:
        p.expect(abs(back["obstacle_1_displacement"][d] - float(motion[d]))
                 <= digits * size,
                 f"{what}: {back['obstacle_1_displacement']} is not {motion}")
    p.expect(back["obstacle_imbalance"] <= 1e-10, f"{what}: imbalance")
    p.expect(rows[-1]["obstacle_1_displacement_" + directions[-1]]
             == back["obstacle_1_displacement"][free[-1]], "the table")
    print(f"{what}: {given['nonlinear_iterations']} systems by motion, "
          f"{back['nonlinear_iterations']} by force, "
          f"{back['obstacle_places']} places, imbalance "
          f"{back['obstacle_imbalance']:.1e}")


# A disc, deep enough for some facets, on a block.
DISC = {"Obstacle 1/Kind": "sphere", "Obstacle 1/Point": "",
        "Obstacle 1/Normal": "", "Obstacle 1/Centre": "1, 3",
        "Obstacle 1/Radius": "2", "Obstacle 1/Motion": "0, -0.02",
        "Body 1/Prescribed displacement": "2: 0, 0", "Refinement/Level": "4",
        "Time stepping/Number of steps": "1"}
for law in p.some(("lagrange", "penalty", "augmented lagrangian", "barrier",
                   "interior point", "quadratic penalty"), 2):
    # What a barrier ends at depends on where it began.
    duality(law, "rigid-plate.prm", {**DISC, "Method/Enforcement": law}, "y",
            digits=1e-6 if law == "barrier" else 1e-8)
duality("saddle point", "rigid-plate.prm",
        {**DISC, "Method/System": "saddle point",
         "Method/Enforcement": "lagrange"}, "y")
duality("mortar", "rigid-plate.prm",
        {**DISC, "Method/Discretisation": "dual mortar"}, "y")
if not p.short:
    duality("nitsche", "rigid-plate.prm",
            {**DISC, "Method/Enforcement": "nitsche"}, "y")
    duality("quadrature points", "rigid-plate.prm",
            {**DISC, "Method/Enforcement": "augmented lagrangian",
             "Method/Discretisation": "quadrature point"}, "y")
duality("with friction, aside", "rigid-plate.prm",
        {**DISC, "Obstacle 1/Motion": "0.001*t, -0.02*t",
         "Pair 1/Friction": "0.3"}, "x, y")
duality("drawn aside under a force", "rigid-plate.prm",
        {**DISC, "Obstacle 1/Motion": "0.001*t, -0.02*t",
         "Pair 1/Friction": "0.3"}, "y")
if not p.short:
    duality("large strain", "rigid-plate.prm",
            {**DISC, "Body 1/Material": "neo-hooke", "Body 1/Poisson ratio":
             "0.3", "Time stepping/Newton tolerance": "1e-11"}, "y")
    duality("space", "elastic-sphere.prm",
            {"Refinement/Level": "3",
             "Obstacle 1/Motion": "0, 0, 0.004"}, "z", dim=3)

# Pressed flat: F L / (E A) with nu = 0, two units wide and one high.
summary, rows = run("rigid-plate.prm", {
    "Obstacle 1/Motion": "", "Obstacle 1/Free directions": "y",
    "Obstacle 1/Force": "0, -20*t", "Body 1/Poisson ratio": "0"})
p.close(summary["obstacle_1_displacement"][1], -0.01, 1e-10, "a plate")
p.close(summary["obstacle_1_force"][1], 20, 1e-9, "force on the plate")
p.close(summary["energy"], -0.1, 1e-9, "energy of plate and block")
# From far away, by the weight of a mass.
summary, _ = run("rigid-plate.prm", {
    "Obstacle 1/Motion": "", "Obstacle 1/Point": "0, 1.7",
    "Obstacle 1/Free directions": "y", "Obstacle 1/Mass": "4",
    "Solid/Gravity": "0, -5", "Body 1/Poisson ratio": "0"})
p.close(summary["obstacle_1_displacement"][1], -0.71, 1e-10, "a fallen plate")
p.close(summary["obstacle_1_force"][1], 20, 1e-9, "weight of the plate")

# By forces that hardly deform it: places of a block 1 high have 16 digits.
for force, digits in ((1e-4, 1e-8), (1e-6, 1e-5), (1e-8, 1e-3)):
    summary, _ = run("rigid-plate.prm", {
        "Obstacle 1/Motion": "", "Obstacle 1/Free directions": "y",
        "Obstacle 1/Force": f"0, -{force}*t"})
    p.close(summary["obstacle_1_displacement"][1], -0.91 * force / 2000, digits,
            f"a plate under {force}")
    p.expect(summary["obstacle_imbalance"] <= digits, f"balance of {force}")
refused("rigid-plate.prm", {
    "Obstacle 1/Motion": "", "Obstacle 1/Free directions": "y",
    "Obstacle 1/Force": "0, -1e-11*t", "Time stepping/Smallest step": "0.5"},
    "Obstacle 1", "smaller than round-off", code=3)

# A force that comes and goes: sin(pi) is round-off of what it was.
summary, rows = run("rigid-plate.prm", {
    "Obstacle 1/Motion": "", "Obstacle 1/Free directions": "y",
    "Obstacle 1/Force": "0, -20*sin(pi*t)", "Body 1/Poisson ratio": "0",
    "Time stepping/Number of steps": "4"})
p.close(max(row["contact_force"] for row in rows), 20, 1e-9,
        "force at its largest")
p.expect(abs(summary["contact_force"]) < 1e-10,
         f"force that has gone: {summary['contact_force']}")

# Two obstacles, one on each side.
summary, _ = run("rigid-plate.prm", {
    "Solid/Obstacles": "2", "Solid/Pairs": "2", "Obstacle 1/Motion": "",
    "Obstacle 1/Free directions": "y", "Obstacle 1/Force": "0, -20",
    "Obstacle 2/Normal": "-1, 0", "Obstacle 2/Point": "2, 0",
    "Obstacle 2/Free directions": "x", "Obstacle 2/Force": "-5, 0",
    "Pair 2/Secondary": "1: 1", "Pair 2/Obstacle": "2",
    "Body 1/Poisson ratio": "0.3"})
# Plane strain: E eps = (1 - nu^2) sigma - nu (1 + nu) sigma of the other.
p.close(summary["obstacle_1_displacement"][1],
        (-0.91 * 10 + 0.39 * 5) / 1000, 1e-9, "two plates, above")
p.close(summary["obstacle_2_displacement"][0],
        2 * (-0.91 * 5 + 0.39 * 10) / 1000, 1e-9, "two plates, at the side")

# Hertz, in a graded mesh: 1e-3 deep.
if not p.short:
    summary, _ = run("pressed-ball.prm", {})
    p.close(summary["obstacle_1_displacement"][1], -1e-3, 3e-3, "Hertz")

# A rigid mass on a bar: a single wave.
for scheme in p.some(("hht", "trapezoid", "midpoint", "generalised alpha",
                      "contact stabilised",
                      "central difference with projection"), 2):
    step = ("0.01" if scheme.startswith("central") else "0.02")
    summary, rows = run("struck-bar.prm", {"Time stepping/Scheme": scheme,
                                           "Time stepping/Step size": step})
    v = 0.01 * math.exp(-1)
    p.close(summary["obstacle_1_velocity"][0], v, 0.01, f"{scheme}: velocity")
    p.close(summary["obstacle_1_displacement"][0], 0.02 * (1 - math.exp(-1)),
            2e-3, f"{scheme}: place")
    middle = next(row for row in rows if abs(row["time"] - 1) < 1e-9)
    p.close(-middle["obstacle_1_force_x"], 0.01 * math.exp(-0.5), 0.02,
            f"{scheme}: force")
    worst = max(abs(row["momentum_x"] + 2 * row["obstacle_1_velocity_x"]
                    - 0.02) for row in rows)
    p.expect(worst <= 1e-10 * 0.02, f"{scheme}: momentum {worst / 0.02:.1e}")
    p.expect(summary["energy_gain"] < 1e-3, f"{scheme}: energy")
    print(f"{scheme}: momentum to {worst / 0.02:.1e}, velocity "
          f"{summary['obstacle_1_velocity'][0] / v - 1:+.1e}, force at 1 "
          f"{-middle['obstacle_1_force_x'] / 0.01 * math.exp(0.5) - 1:+.1e}, "
          f"{summary['obstacle_places']} places in {len(rows)} steps, energy "
          f"gain {summary['energy_gain']:.1e}, loss "
          f"{summary['energy_loss']:.1e}")

# A ball that falls and comes back: m g (h + d) = 2/5 k d^(5/2) at the deepest
# place d, k = 4/3 E' for the half space that the block nearly is.
if not p.short:
    height, weight, k = 1.8533e-3, 1e-5, 4 / 3 / 0.91
    deep = 1e-3
    for _ in range(50):
        deep = (2.5 * weight * (height + deep) / k)**0.4
    summary, rows = run("falling-ball.prm", {})
    lowest = min(rows, key=lambda row: row["obstacle_1_displacement_y"])
    p.close(-lowest["obstacle_1_displacement_y"] - height, deep, 0.04, "depth")
    p.close(lowest["obstacle_1_force_y"], k * deep**1.5, 0.04, "force")
    highest = max(row["obstacle_1_displacement_y"] for row in rows[-20:])
    p.expect(abs(highest) < 1e-3 * height, f"comes back to {highest}")
    p.expect(summary["energy_gain"] < 1e-9 and summary["energy_loss"] < 1e-3,
             "energy of the ball")
    p.close(summary["obstacle_1_velocity"][1] + 1, 1, 1e-5, "at rest above")

# On coarse meshes nodes are less deep than the ball is between them when it
# touches first and last, which is no failure.
summary, rows = run("falling-ball.prm", {"Refinement/Level": "4",
                                         "Time stepping/Step size": "0.04"})
highest = max(row["obstacle_1_displacement_y"] for row in rows[-20:])
p.expect(abs(highest) < 1e-2 * 1.8533e-3, f"comes back to {highest}")

# Forces that drive the mass through the bar within a step: that is not the
# scene's mistake, nor one of the pair.
refused("struck-bar.prm", {"Obstacle 1/Force": "1e6*sin(50*t), 0",
                           "Time stepping/End time": "0.2"}, "ABUT-F", code=3)

# What cannot be.
PLATE = {"Obstacle 1/Motion": "", "Obstacle 1/Free directions": "y",
         "Obstacle 1/Force": "0, -20"}
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Motion": "0, -t"},
        "Obstacle 1/Motion", "must be 0")
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Free directions": "z"},
        "Obstacle 1/Free directions", "no z")
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Free directions": "up"},
        "Obstacle 1/Free directions", "'up'")
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Free directions": ""},
        "Obstacle 1/Force", "Free directions is empty")
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Force": "0, -x"},
        "Obstacle 1/Force", "depends on x, y or z")
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Mass": "1"},
        "Obstacle 1/Mass", "Solid/Gravity is empty")
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Initial velocity": "0, 1"},
        "Obstacle 1/Initial velocity", "Time stepping/Scheme is quasi-static")
refused("hertz-axisymmetric.prm",
        {"Obstacle 1/Motion": "", "Obstacle 1/Free directions": "x"},
        "Obstacle 1/Free directions", "along the axis")
refused("struck-bar.prm", {"Obstacle 1/Initial velocity": "0, 1"},
        "Obstacle 1/Initial velocity", "does not name it")
refused("struck-bar.prm", {"Obstacle 1/Mass": "0"},
        "Obstacle 1/Initial velocity", "Obstacle 1/Mass is 0")
refused("struck-bar.prm", {"Obstacle 1/Mass": "0",
                           "Obstacle 1/Initial velocity": "",
                           "Time stepping/Scheme": "contact stabilised"},
        "Obstacle 1/Mass", "give the obstacle a mass")
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Force": "0, 20",
                            "Time stepping/Smallest step": "0.5"},
        "ABUT-F12", "Nothing holds Obstacle 1 along y", code=3)
refused("rigid-plate.prm", {**PLATE, "Obstacle 1/Free directions": "x, y",
                            "Obstacle 1/Force": "1, -20",
                            "Time stepping/Smallest step": "0.5"},
        "ABUT-F12", "Nothing holds Obstacle 1 along x", code=3)

# A wheel that a motor turns drives off on a floor with mu m g, until it rolls with
# v = omega R. The work of the motor is m v^2: half of it stays in the velocity, half
# goes to friction. Where the origin is does not matter.
for x, y in (0, 0), (5, -3):
    p.write("wheel.prm", solid(
        2,
        block(1, f"80, 4 : {x - 1}, {y - 0.2} : {x + 3}, {y} : true", "2: 0, 0",
              more=("Young modulus = 1e6", "Density = 1")),
        section("Obstacle 1", "Kind = sphere", f"Centre = {x}, {y + 1}",
                "Radius = 1", "Mass = 3", "Free directions = x, y",
                "Rotation angle = -60*t", f"Rotation centre = {x}, {y + 1}"),
        section("Pair 1", "Secondary = 1: 3", "Obstacle = 1", "Friction = 0.3"),
        section("Time stepping", "Scheme = hht", "Step size = 0.01",
                "End time = 0.5"),
        section("Refinement", "Level = 0"),
        bodies=1, obstacles=1).replace("Pairs = 1", "Pairs = 1\nset Gravity = 0, -10"))
    wheel = p.run_scene("wheel.prm", codes=(0, 3))
    exact = 3 * (math.pi / 3)**2
    p.close(wheel["external_work"], exact, 0.01, f"work of a motor at {x}")
    p.close(wheel["kinetic_energy"], exact / 2, 0.01, f"velocity of a wheel at {x}")
    p.close(wheel["dissipation"], exact / 2, 0.02, f"friction of a wheel at {x}")

p.finish()
