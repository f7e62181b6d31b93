# SPDX-License-Identifier: LGPL-2.1-or-later
"""Motions that have no answer, and what they are blamed on: obstacles that pass
through bodies within a step, motions that jump, bodies that overlap at the
start, data out of the range of numbers. (scene, settings, exit code, words of the message; words that must not
be there after '!')."""
import random

from program import Program

p = Program()
BY_MOTION = {"Obstacle 1/Initial velocity": "", "Obstacle 1/Mass": "0",
             "Obstacle 1/Free directions": ""}


def blade(thick, gap, **more):
    """A blade on the left of a bar that is 3 long."""
    return {"Obstacle 1/Size": f"{thick}, 4",
            "Obstacle 1/Centre": f"{-gap - thick / 2}, 0.5", **more}


def run(scene, settings, code, *texts):
    words = [word for key, value in settings.items()
             for word in ("--set", f"{key}={value}")]
    result = p.call("run", p.source / "prm" / scene, "--output", "out",
                    "--quiet", *words)
    said = result.stderr
    wrong = [text for text in texts
             if (text[1:] in said if text[0] == "!" else text not in said)]
    p.expect(code in (None, result.returncode) and not wrong,
             f"{scene} {settings}: {result.returncode}, {wrong}: {said}")


STEP = {"Time stepping/Step size": "4", "Time stepping/End time": "4"}
STRUCK = "struck-bar.prm"
run(STRUCK, blade(.01, .1, **{"Obstacle 1/Initial velocity": "1, 0"}, **STEP),
    3, "ABUT-F24: Pair 1", "obstacle", "Motion", "in the step from time",
    "!F23", "!F36")
run(STRUCK, blade(.01, 0, **{"Obstacle 1/Initial velocity": "1, 0"}, **STEP),
    3, "ABUT-F24: Pair 1", "in the step from time")
run(STRUCK, blade(.01, .1, **BY_MOTION, **STEP, **{"Obstacle 1/Motion": "t, 0"}),
    3, "ABUT-F24: Pair 1", "Motion", "in the step from time", "!F23", "!F36")
run(STRUCK, blade(.1, .055, **BY_MOTION, **{
    "Obstacle 1/Motion": "t, 0", "Time stepping/Step size": "0.5", "Time stepping/End time": "4"}), 3,
    "!F23")
run(STRUCK, blade(.01, .1, **{
    "Obstacle 1/Initial velocity": "", "Obstacle 1/Mass": "1e-9",
    "Obstacle 1/Force": "0.01, 0"}, **STEP), 3, "ABUT-F24: Pair 1: its "
    "obstacle, 0.01 thick, moves by", "passes through", "a slower obstacle")

# Others of the kind; steps that are halved often enough find what such
# velocities, above those of the bar's waves, do to it.
generator = random.Random(34)
for _ in range(4):
    thick = generator.uniform(.002, .05)
    gap = generator.uniform(.05, .3)
    speed = generator.uniform(1.1, 3.)
    settings = {"Obstacle 1/Motion": f"{speed}*t, 0", "Time stepping/Step size": "8",
                "Time stepping/End time": "8"}
    run(STRUCK, blade(thick, gap, **BY_MOTION, **settings), 3, "ABUT-F",
        "!F23", "!F36")
    run(STRUCK, blade(thick, gap, **BY_MOTION, **settings, **{
        "Time stepping/Cut back": "false"}), 3, "ABUT-F24: Pair 1",
        "in the step from time 0 to 8")
run(STRUCK, {**BY_MOTION, "Obstacle 1/Kind": "sphere", "Obstacle 1/Size": "1",
             "Obstacle 1/Centre": "-0.2, 0.5", "Obstacle 1/Radius": "0.05",
             "Obstacle 1/Motion": "t, 0", "Pair 1/Secondary": "1: 0",
             **STEP, "Time stepping/Cut back": "false"}, 3,
    "ABUT-F24")
# A blade that flies by, and one that goes away, pass through nothing.
for motion in ("-t, 0", "-t, 3*t"):
    summary, _ = p.solve_with(STRUCK, blade(.01, .1, **BY_MOTION, **STEP, **{
        "Obstacle 1/Motion": motion, "Output/Fields": "false"}))
    p.expect(summary["contact_force"] == 0. and
             summary["load_steps_cut_back"] == 0, f"{motion}: {summary}")

# What jumps.
for motion, jump in (("(t>1 ? 1 : 0), 0", "by 1"),
                     ("0, (t>0.7 ? 0.2 : 0)", "by 0.2"),
                     ("0.01*t + (t<0.5 ? 0 : 0.3), 0", "by 0.3")):
    run(STRUCK, {**BY_MOTION, "Obstacle 1/Motion": motion}, 2,
        "Obstacle 1/Motion", "jumps at t", jump)
run(STRUCK, {**BY_MOTION, "Obstacle 1/Motion":
             "(t>1 ? 0.01*(t - 1) : 0), 0", "Time stepping/End time": "1.2"}, 0, "!jumps")

# Overlaps at the start: of an obstacle where it is first, not where its force
# moves it to, .001 below (facets of .00125). It ends .001 below the surface
# wherever it begins.
BALL = "pressed-ball.prm"
run(BALL, {}, 0, "!ABUT-F11")
free, _ = p.solve_with(BALL, {"Refinement/Adaptive cycles": "0"})
for _ in range(2):
    depth = round(generator.uniform(.03, .09), 3)
    inside = {"Obstacle 1/Expression": f"x^2/2 - {depth}",
              "Refinement/Adaptive cycles": "0"}
    run(BALL, inside, 0, "ABUT-F11: Pair 1",
        f"inside of the obstacle by {depth} ")
    moved, _ = p.solve_with(BALL, inside)
    p.close(moved["obstacle_1_displacement"][1],
            free["obstacle_1_displacement"][1] + depth, 1e-6, "pushed out")
# Of a body on another one, .5 thick, by less than .3 of its facet of 1.
for depth in (.1, round(generator.uniform(.06, .11), 3)):
    run("landing-on-a-body.prm", {
        "Output/Points": "", "Time stepping/End time": "0.025", "Body 1/Mesh/Arguments":
        f"1, 1 : 5.1, {-depth} : 6.1, 0.8 : true"}, 3 if depth == .1 else
        None, f"ABUT-F11: Pair 1: The surfaces overlap by {depth} before",
        f"{2 * depth:.6g} times the thickness of a body", "energy balance",
        "!ABUT-F43", "!ABUT-F44", "!shorter")

# Data that leaves nothing of inertia, or is no number.
for scene in ("dynamics-bar-on-a-wall.prm", "dynamics-falling-bar.prm"):
    for setting in ("Length=1e-8", "Density=1e-20", "Stiffness=1e20"):
        name, value = setting.split("=")
        run(scene, {"Bar/" + name: value}, 3, "ABUT-F12", "inertia is below round-off",
            "density", "Time stepping/Step size")
    for setting in ("Length=1e300", "Density=1e300"):
        name, value = setting.split("=")
        run(scene, {"Bar/" + name: value}, 3, "ABUT-F39", "range of")
for density in ("1e-20", "1e-30"):
    run(STRUCK, {"Body 1/Density": density}, 3, "ABUT-F12",
        "below round-off of the stiffness", "Density", "Time stepping/Step size",
        "!Support the body in that direction")
for mass in ("1e-300", "1e300"):
    run("dynamics-bouncing-ball.prm", {"Masses/Mass": mass}, 3, "ABUT-F39",
        "units")
run("dynamics-periodic-bar.prm", {"Bar/Stiffness": "1e-300"}, 3, "ABUT-F39",
    "units")
run("friction-block.prm", {"Masses/Normal spring": "1e-300"}, 3, "ABUT")

# Newmark's Beta: 9.81/2 t^2 as long as it is a number.
FALL = {"Time stepping/Scheme": "newmark", "Time stepping/Restitution": "0", "Motion/Gap": "100",
        "Time stepping/End time": "1", "Time stepping/Step size": "0.02"}
for beta in ("1e-300", "1e-12", "9e-7"):
    run("dynamics-bouncing-ball.prm", {**FALL, "Time stepping/Newmark beta": beta}, 2,
        "Time stepping/Newmark beta", "central difference")
for beta in ("1e-6", "0.01", "0.25"):
    summary, _ = p.solve_with("dynamics-bouncing-ball.prm",
                              {**FALL, "Time stepping/Newmark beta": beta})
    p.close(summary["displacement"][0], -9.81 / 2, 1e-6, f"Beta = {beta}")
p.finish()
