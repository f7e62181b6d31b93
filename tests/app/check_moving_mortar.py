# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mortar between bodies of large strain: partners that follow or stay, turned as
a whole, sliding over facets, steps of Newton's method, ranks, refusals."""
import math
import re
import statistics

from block_scene import block, pair, section, solid
from program import Program, set_words
from sliding_scenes import (RUBBER, newton, press_and_slide, slide, turn,
                            turned)

p = Program()
FINE = ["Time stepping/Newton tolerance=1e-12",
        "Method/Final linear tolerance=1e-14"]
LARGE, SMALL = "Method/Contact geometry=current", "Method/Contact geometry=reference"
STANDARD = "Method/Discretisation=mortar"


def run(scene, *settings, ranks=0):
    return p.call("run", scene, "--output", "out", "--quiet",
                  *set_words(settings), ranks=ranks)


def solved(scene, *settings, ranks=0):
    result = run(scene, *settings, ranks=ranks)
    p.expect(result.returncode == 0, f"{scene} {settings}: exit code "
             f"{result.returncode}\n{result.stderr}")
    return p.results()[0]


# Two blocks of one width, whose material does not widen (nu = 0), are pressed
# to the stretch s, then turned by 90 degrees: everything is uniform. Per
# undeformed volume the energy is mu/2 (s^2 - 1 - 2 ln s), the pressure its
# derivative.
STRETCH = 1. - 0.05 / 2
MU = 0.5
PRESSURE = MU * (1 / STRETCH - STRETCH)
ENERGY = 2 * MU / 2 * (STRETCH**2 - 1 - 2 * math.log(STRETCH))


def patch(dimension):
    flat = dimension == 2
    rest = "" if flat else ", 0"
    cells = ("5, 2", "7, 2") if flat else ("2, 1, 2", "3, 1, 3")
    corners = (("0, 0 : 1, 1", "0, 1 : 1, 2") if flat else
               ("0, 0, 0 : 1, 1, 1", "0, 1, 0 : 1, 2, 1"))
    soft = ["Material = neo-hooke", "Young modulus = 1", "Poisson ratio = 0"]
    ids = (2, 3)
    part = "(min(1, 5*t)*0.05)"
    return p.write(f"patch-{dimension}.prm", solid(
        dimension,
        block(1, f"{cells[0]} : {corners[0]} : true",
              f"{ids[0]}: {turned('y')}{rest}", more=soft),
        block(2, f"{cells[1]} : {corners[1]} : true",
              f"{ids[1]}: {turned('y - ' + part)}{rest}", more=soft),
        pair(f"2: {ids[0]}", f"1: {ids[1]}"),
        section("Load steps", "Steps = 15"), section("Refinement", "Level = 0"),
        section("Output", "Fields = false")))


def check_patch(dimension, *words):
    summary = solved(patch(dimension), *FINE, *words)
    what = f"patch in {dimension}D {words}"
    # Its force per area is that of the pressure everywhere, or none is.
    for key, value in (("energy", ENERGY), ("pair_1_pressure", PRESSURE),
                       ("contact_force", PRESSURE), ("least_stretch", STRETCH),
                       ("least_volume", STRETCH), ("pair_1_contact_area", 1.)):
        p.close(summary[key], value, 1e-9, f"{what}: {key}")
    force = summary["pair_1_force"]
    p.expect(abs(force[1]) < 1e-9 * PRESSURE and force[0] < 0.,
             f"{what}: force {force}")


def last_order(load_step):
    """Of the forces out of balance in the last three linearisations, before
    they are nothing but round-off."""
    forces = [row["residual"] for row in newton(p, load_step)
              if row["part"] == 1. and row["residual"] > 1e-16]
    print(*(f"{force:.3g}" for force in forces))
    before, middle, last = forces[-3:]
    return math.log(last / middle) / math.log(middle / before)


# Blocks of two widths: nothing is uniform, but all turns with them.
def check_turn(dimension, *words):
    scene = turn(p, dimension)
    here = solved(scene, *FINE, *words, "Time stepping/End time=0.2",
                  "Time stepping/Number of steps=3")
    # Far enough from the answer for three errors above round-off.
    there = solved(scene, *FINE, *words, "Time stepping/Extrapolate=false")
    what = f"turned in {dimension}D {words}"
    for key in ("energy", "pair_1_pressure", "least_stretch", "least_volume",
                "pair_1_contact_area"):
        p.close(there[key], here[key], 1e-9, f"{what}: {key}")
    p.expect(there["pair_1_turn"] < 1e-9,
             f"{what}: directions are off by {there['pair_1_turn']}")
    scale = here["contact_force"]
    force, before = there["pair_1_force"], here["pair_1_force"]
    p.expect(abs(force[0] + before[1]) < 1e-9 * scale
             and abs(force[1] - before[0]) < 1e-9 * scale,
             f"{what}: force {force} from {before}")
    return min(last_order(step) for step in (8, 15))


for d in (2, 3):
    for words in p.some([[], [STANDARD, SMALL], [SMALL], [STANDARD]], 2):
        check_patch(d, *words)
    for words in p.some([[], [SMALL]]):
        order = check_turn(d, *words)
        p.expect(order >= 1.8,
                 f"Newton's method is of order {order}, {d}D {words}")
check_turn(2, "Method/Enforcement=penalty")


# A die slides over 20 facets without friction, so far from the ends of the block
# that its force to the side is spurious.
def check_slide(*words, steps=22):
    summary = solved(slide(p, 80, 10, 12, 5, steps, width=8), *words)
    rows = [row for row in p.table("levels.csv") if row["time"] > 1.01]
    forces = [-row["pair_1_force_y"] for row in rows]
    ratios = [abs(row["pair_1_force_x"] / row["pair_1_force_y"])
              for row in rows]
    n = [len(newton(p, step)) for step in range(steps + 1, 2 * steps + 1)]
    print(words, "force", statistics.mean(forces), "ripple",
          statistics.pstdev(forces) / statistics.mean(forces), "tangential",
          max(ratios), "linearisations", statistics.mean(n), max(n))
    p.expect(summary["pair_1_slip"] > 1.9,
             f"{words}: slid by {summary['pair_1_slip']}")
    p.expect(summary["force_imbalance"] < 1e-12,
             f"{words}: forces {summary['force_imbalance']}")
    p.expect(all(0.155 < force < 0.165 for force in forces),
             f"{words}: forces {forces}")
    p.expect(max(ratios) < 1e-4, f"{words}: tangential forces {ratios}")
    p.expect(statistics.mean(n) <= 6., f"{words}: {n} linearisations")


for words in p.some([[], [STANDARD]]):
    check_slide(*words)


# Linearisations of a load step, in the mean: at most 1.5 times those of a prototype
# that differentiates everything (3.0), the hard ones no more than those of it
# (4.8 and 4.9, with one linearisation for each change of the contact set).
def check_counts(steps, most, **scene):
    solved(press_and_slide(p, steps, **scene), "Time stepping/Newton tolerance=1e-9")
    n = [len(newton(p, step)) for step in range(1, 11 + steps)]
    p.expect(len(p.table("levels.csv")) == 10 + steps
             and statistics.mean(n) <= most,
             f"{steps} steps {scene}: {n} linearisations")


if not p.short:
    check_counts(22, 4.5)
    check_counts(5, 4.5)
    check_counts(8, 4.8, hard=True)
check_counts(8, 4.9, hard=True, die_young=1)

# Partners that stay are left behind: the run reports how far the surfaces slid,
# and what to take instead; of bodies that do not slide it would not.
left = run("slide.prm", SMALL)
p.expect(left.returncode == 3
         and re.search("slide? on each other", left.stderr)
         and "Method/Contact geometry = current" in left.stderr,
         f"partners left behind: {left.returncode}\n{left.stderr}")
stuck = run("patch-2.prm", SMALL, "Time stepping/Maximum Newton iterations=1",
            "Time stepping/Cut back=false")
p.expect(stuck.returncode == 3 and "slid on each other" not in stuck.stderr,
         f"too few steps: {stuck.returncode}\n{stuck.stderr}")

# On two ranks as on one.
words = ["Time stepping/End time=0.5", "Time stepping/Number of steps=5"]
one = solved("slide.prm", *words)
two = solved("slide.prm", *words, ranks=2)
p.close(two["energy"], one["energy"], 1e-9, "energy on two ranks")

# What does not follow.
p.expect_error(run("slide.prm", LARGE, "Method/Enforcement=interior point"),
               "Method/Contact geometry = current", "interior point")
# A stiff half disc bends a thin strip, whose forces are a millionth of what the
# disc's own motion takes as a first residual: Newton's tolerance alone would
# leave those of contact out of balance.
scene = p.write("strip.prm", solid(
    2, block(1, "40, 2 : 0, 0 : 4, 0.2 : true", "0: 0, 0", more=RUBBER),
    section("Body 2", section(
        "Mesh", "Generator = half_hyper_ball", "Arguments = 0, 0 : 0.3",
        "Rotate = -90", "Move = 3.8, 0.52"),
        "Material = neo-hooke", "Young modulus = 50", "Poisson ratio = 0.3",
        "Support = 1: 0, -0.12*t"),
    pair("2: 0", "1: 3"), section("Load steps", "Steps = 4"),
    section("Refinement", "Level = 1"), section("Output", "Fields = false")))
result = run(scene)
p.expect(result.returncode == 0 and "ABUT-F30" not in result.stderr,
         f"strip: {result.stderr}")
rough, fine = solved(scene), solved(scene, *FINE)
for strip, most in ((rough, 1e-6), (fine, 1e-8)):
    p.expect(strip["imbalance"] < most and strip["contact_force"] > 0,
             f"strip: {strip['imbalance']} of {strip['contact_force']}")
p.close(rough["contact_force"], fine["contact_force"], 1e-6, "force of a strip")

p.finish()
