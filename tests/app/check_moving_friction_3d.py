# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction of points that move, in space: mortar, nodes and quadrature points
between bodies, and against obstacles: blocks that are dragged in any direction,
what turns as a whole, what sticks, ranks."""
import math

from block_scene import block, pair, section, solid
from program import Program, set_words
from sliding_scenes import RUBBER, check_friction_turned, newton

p = Program()
FINE = ["Time stepping/Newton tolerance=1e-12",
        "Method/Final linear tolerance=1e-14"]
STANDARD, SMALL = "Method/Discretisation=mortar", "Method/Contact geometry=reference"
NODES = "Method/Discretisation=node to segment"
POINTS = ["Method/Discretisation=quadrature point",
          "Method/Enforcement=penalty"]
MU = 0.3
FRICTION = f"Pair 1/Friction={MU}"


def run(scene, *settings, ranks=0):
    return p.call("run", scene, "--output", "out", "--quiet",
                  *set_words(settings), ranks=ranks)


def solved(scene, *settings, ranks=0):
    result = run(scene, *settings, ranks=ranks)
    p.expect(result.returncode == 0, f"{scene} {settings}: exit code "
             f"{result.returncode}\n{result.stderr}")
    return p.results()[0]


# A block is pressed on a plate all of whose nodes are held, or on a rigid plane,
# that moves on below it, over facets. After some steps nothing else moves any more:
# all tractions are along that way.
PRESS, WAY, STEPS = 0.04, 2.5, 10


def drag(angle, on_obstacle):
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    way = f"if(t > 1, {WAY}*(t - 1), 0)"
    moved = f"{c!r}*{way}, {s!r}*{way}, 0"
    parts = [block(1, "4, 3, 2 : 0, 0, 0 : 1, 0.75, 0.5 : true",
                   f"5: 0, 0, -{PRESS}*min(1, t)", more=RUBBER)]
    if on_obstacle:
        # Muparser's other form of a choice.
        moved = moved.replace("if(t > 1, ", "(t > 1 ? ").replace(", 0)", " : 0)")
        parts += [section("Obstacle 1", "Kind = plane", "Point = 0, 0, 0",
                          "Normal = 0, 0, 1", f"Motion = {moved}"),
                  section("Pair 1", "Secondary = 1: 4", "Obstacle = 1")]
    else:
        parts += [block(2, "16, 16, 1 : -2.7, -2.7, -0.5 : 3.7, 3.45, 0 : true",
                        f"4: {moved}; 5: {moved}", more=RUBBER),
                  pair("1: 4", "2: 5")]
    parts += [section("Refinement", "Level = 0"),
              section("Load steps", f"Steps = {2 * STEPS}", "End time = 2"),
              section("Output", "Fields = false")]
    return p.write("drag.prm", solid(3, *parts, bodies=1 if on_obstacle else 2,
                                     obstacles=1 if on_obstacle else 0))


def check_drag(angle, *words, on_obstacle=False, ranks=0, mu=MU):
    """Forces along the way, across it and onto the plate."""
    what = f"dragged at {angle} degrees {words}"
    summary = solved(drag(angle, on_obstacle), *FINE, f"Pair 1/Friction={mu}",
                     *words, ranks=ranks)
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    p.expect(summary["pair_1_slipping"] == summary["pair_1_active"] > 0,
             f"{what}: {summary['pair_1_slipping']} of "
             f"{summary['pair_1_active']} slip")
    last = p.table("levels.csv")[-1]
    x, y, z = (last[f"pair_1_force_{axis}"] for axis in "xyz")
    along, across = c * x + s * y, c * y - s * x
    # The plate takes the block along with it.
    p.close(along / z, mu, 1e-9, f"{what}: T/N")
    p.expect(abs(across) < 1e-9 * z, f"{what}: across {across / z} N")
    p.close(last["dissipation"], along * WAY / STEPS, 1e-8,
            f"{what}: dissipation")
    print(what, "T/N - mu", along / z - mu, "across", across / z)
    return summary


dual = check_drag(-130.)
check_drag(-130., NODES)
check_drag(-130., *POINTS, on_obstacle=True)
if not p.short:
    # Forces of the first step are round-off sooner. With more friction a corner of
    # the block lifts, and tractions beside it are along a surface that is not flat.
    check_drag(-130., STANDARD, "Time stepping/Newton tolerance=1e-8", mu=0.15)
    check_drag(-130., *POINTS)
    check_drag(90., on_obstacle=True)
    check_drag(-130., on_obstacle=True)
    check_drag(90., "Method/Enforcement=augmented lagrangian",
               "Method/Pressure tolerance=1e-12")
two = check_drag(-130., ranks=2)
for key in ("energy", "pair_1_friction_force", "pair_1_normal_force"):
    p.close(two[key], dual[key], 1e-7, f"dragged on two ranks: {key}")


# What is turned as a whole by 90 degrees after it has been pressed.
for each in p.some([[], [SMALL], [STANDARD], [NODES]], 2):
    check_friction_turned(p, 3, solved, *FINE, FRICTION, *each)
# Springs make more of what is left over in displacements.
check_friction_turned(p, 3, solved, "Time stepping/Newton tolerance=1e-13", FINE[1],
                      FRICTION, "Method/Enforcement=penalty")


# What sticks on a mesh that matches is one body.
def check_stick(*words):
    push = "if(t > 0.5, 0.1*(t - 0.5), 0), if(t > 0.5, 0.06*(t - 0.5), 0), " \
        "-0.04*min(1, 2*t)"
    steps = section("Load steps", "Steps = 4")
    level = section("Refinement", "Level = 0")
    quiet = section("Output", "Fields = false")
    one = p.write("one.prm", solid(
        3, block(1, "4, 3, 2 : 0, 0, 0 : 2, 1.5, 0.5 : true",
                 f"4: 0, 0, 0; 5: {push}", more=RUBBER), steps, level, quiet,
        bodies=1).replace("Pairs = 1", "Pairs = 0"))
    two = p.write("two.prm", solid(
        3, block(1, "4, 3, 1 : 0, 0, 0 : 2, 1.5, 0.25 : true", "4: 0, 0, 0",
                 more=RUBBER),
        block(2, "4, 3, 1 : 0, 0, 0.25 : 2, 1.5, 0.5 : true", f"5: {push}",
              more=RUBBER), pair("1: 5", "2: 4"), steps, level, quiet))
    whole = solved(one, *FINE)
    parts = solved(two, *FINE, "Pair 1/Friction=100", *words)
    p.expect(parts["pair_1_active"] == 20 and parts["pair_1_slipping"] == 0,
             f"stick {words}: {parts['pair_1_active']}, "
             f"{parts['pair_1_slipping']} slip")
    p.close(parts["energy"], whole["energy"], 1e-9, f"stick {words}: energy")


for each in p.some([[], [NODES], [STANDARD], [SMALL]], 2):
    check_stick(*each)

# A round die that is pressed in slides over ten facets, symmetric about a plane
# along its way; without friction also about the middle of the block, which is
# half of the way.
def check_ironing(mu):
    summary, rows = p.solve("ironing-3d.prm", *set_words(
        ["Output/Fields=false", "Output/Pictures=false",
         f"Pair 1/Friction={mu}"]))
    what = f"ironing with mu = {mu}"
    n = [len(newton(p, step)) for step in range(1, 25)]
    print(what, "linearisations", n, "moments", summary["moment_imbalance"])
    p.expect(len(rows) == 24 and max(n) <= 8, f"{what}: {n} linearisations")
    p.expect(summary["force_imbalance"] < 1e-12, f"{what}: forces")
    p.expect(summary["moment_imbalance"] < 1e-4, f"{what}: moments")
    slid = rows[12:]
    for row in slid:
        x, y, z = (row[f"pair_1_force_{axis}"] for axis in "xyz")
        p.expect(abs(y) < 1e-6 * abs(z), f"{what}: sideways {y}")
        # Tractions are along the surface, which the die bends.
        p.expect(abs(-x / z - mu) < 0.02 * mu + 1e-3,
                 f"{what}: T/N = {-x / z} at {row['time']}")
    for one, other in zip(rows[11:], reversed(rows)):
        if mu == 0.:
            p.expect(abs(one["pair_1_force_x"] + other["pair_1_force_x"])
                     < 1e-6 * abs(one["pair_1_force_z"])
                     and abs(one["pair_1_force_z"] - other["pair_1_force_z"])
                     < 1e-6 * abs(one["pair_1_force_z"]),
                     f"{what}: not the same on both ends, {one['time']}")


# In short app/off_the_end, whose die comes over the corner, stands for it.
for each in () if p.short else (0., MU):
    check_ironing(each)

# Nodes are pressed in with friction where no node is exactly below an edge of the
# die, not even by a hundredth of a facet.
PLACE = "0.802, 0.801"
pressed = p.call(
    "run", p.source / "prm/ironing-3d.prm", "--output", "out", "--quiet",
    *set_words([NODES, "Output/Fields=false", "Time stepping/End time=0.5",
                "Time stepping/Number of steps=6",
                "Body 2/Prescribed displacement=5: 0, 0, -0.13*t",
                f"Body 2/Mesh/Move={PLACE}, 0.6",
                f"Body 2/Mesh/Curved sides=4: sphere: {PLACE}, 1.6"]))
count = [len(newton(p, step)) for step in range(1, 7)]
p.expect(pressed.returncode == 0 and max(count) <= 9
         and p.results()[0]["pair_1_friction_force"] > 0.,
         f"pressed by nodes: {count} linearisations\n{pressed.stderr}")

# A strip that is held across on both of its sides is the plane: tangents turn with
# the surface, and then none of them is quite along what is held.
def strip(dimension):
    def cut(cells, low, high):
        third = (", 1", ", 0", ", 0.25") if dimension == 3 else ("", "", "")
        return (f"{cells}{third[0]} : {low}{third[1]} : {high}{third[2]} "
                ": true")

    held = "; 4: free, free, 0; 5: free, free, 0" if dimension == 3 else ""
    rest = ", 0" if dimension == 3 else ""
    return p.write(f"strip{dimension}.prm", solid(
        dimension,
        block(1, cut("12, 4", "0, 0", "3, 1"), f"2: 0, 0{rest}{held}",
              more=RUBBER),
        block(2, cut("4, 2", "1, 1", "2, 1.5"),
              f"3: 0.05*t, -0.05*t{rest}{held}", more=RUBBER),
        pair("1: 3", "2: 2"), section("Load steps", "Steps = 2"),
        section("Refinement", "Level = 0"),
        section("Output", "Fields = false")))


for words in p.some([["Method/Contact geometry=current"], [NODES],
                     ["Method/Contact geometry=reference"]]):
    plane = solved(strip(2), *FINE, FRICTION, *words)
    space = solved(strip(3), *FINE, FRICTION, *words)
    p.expect(plane["pair_1_friction_force"] > 0.2 * plane["contact_force"],
             f"strip, {words}: friction {plane['pair_1_friction_force']}")
    for key in ("energy", "contact_force", "pair_1_friction_force"):
        p.close(space[key] / 0.25, plane[key], 1e-6, f"strip, {words}: {key}")

p.finish()
