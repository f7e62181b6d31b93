# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction of mortar that moves with bodies of large strain: a block that is
dragged over many facets, what turns as a whole, what sticks, a die."""
import math
import statistics

from block_scene import block, pair, section, solid
from program import Program, set_words
from simplices import Mesh
from sliding_scenes import RUBBER, check_friction_turned, newton, slide

p = Program()
FINE = ["Time stepping/Newton tolerance=1e-12",
        "Method/Final linear tolerance=1e-14"]
SMALL, STANDARD = "Method/Contact geometry=reference", "Method/Discretisation=mortar"
DUAL = "Method/Discretisation=dual mortar"
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


# A block is pressed on a plate all of whose nodes are held, and that moves to
# and fro below it: its facets stay in a line, so that all tractions add up to
# mu N along it, and where nothing else moves any more, all of its way is slip.
# All of it stands at an angle.
PRESS = 0.05


def drag(angle, way):
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))

    def moved(x, y):
        return f"{c!r}*({x}) - {s!r}*({y}), {s!r}*({x}) + {c!r}*({y})"

    plate = moved(way, "0")
    return p.write("drag.prm", solid(
        2, block(1, "8, 4 : 0, 0 : 2, 1 : true",
                 f"3: {moved('0', f'-{PRESS}*min(1, t)')}",
                 f"Rotate = {angle}", more=RUBBER),
        block(2, "28, 1 : -2.5, -0.5 : 4.5, 0 : true",
              f"2: {plate}; 3: {plate}", f"Rotate = {angle}", more=RUBBER),
        pair("1: 2", "2: 3"), section("Refinement", "Level = 0"),
        section("Output", "Fields = false")))


def drag_rows(angle, way, steps, mu, *words):
    """Forces along the plate, onto it, and dissipation by load step."""
    c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
    summary = solved(drag(angle, way), *FINE, f"Pair 1/Friction={mu}",
                     f"Time stepping/Number of steps={2 * steps}", "Time stepping/End time=2",
                     *words)
    rows = p.table("levels.csv")
    for row in rows:
        x, y = row["pair_1_force_x"], row["pair_1_force_y"]
        row["along"], row["onto"] = c * x + s * y, c * y - s * x
    return summary, [row for row in rows if row["time"] > 1.01]


def check_drag(steps, *words, mu=MU):
    what = f"dragged in {steps} steps {words}"
    there = "if(t > 1, 2*(t - 1), 0)"
    summary, rows = drag_rows(0., there, steps, mu, *words)
    p.expect(summary["pair_1_slipping"] == summary["pair_1_active"] == 9,
             f"{what}: {summary['pair_1_slipping']} slip")
    for row in rows[1:]:
        p.close(row["along"] / row["onto"], mu, 1e-9,
                f"{what}: T/N at {row['time']}")
    for row in rows[2:]:
        p.close(row["dissipation"], row["along"] * 2. / steps, 1e-8,
                f"{what}: dissipation at {row['time']}")
    _, other = drag_rows(0., f"-{there}", steps, mu, *words)
    p.close(other[-1]["along"] / other[-1]["onto"], -mu, 1e-9,
            f"{what}, the other way")
    turned, _ = drag_rows(40., there, steps, mu, *words)
    for key in ("energy", "pair_1_friction_force", "pair_1_normal_force"):
        p.close(turned[key], summary[key], 1e-9, f"{what}, at an angle: {key}")


check_drag(3)                                    # 2.7 facets at a step
if not p.short:
    check_drag(8)                                # one facet at a step
    check_drag(8, STANDARD, mu=0.1)              # the front stays pressed
    check_drag(8, "Method/System=saddle point")
    check_drag(8, "Method/Enforcement=augmented lagrangian",
               "Method/Pressure tolerance=1e-12")


# What is turned as a whole by 90 degrees after it has been pressed.
for each in p.some([[], [SMALL, STANDARD], [STANDARD], [SMALL],
                    ["Method/Enforcement=penalty"]], 2):
    check_friction_turned(p, 2, solved, *FINE, FRICTION, *each)


# What sticks on a mesh that matches is one body.
def check_stick(*words):
    push = "if(t > 0.5, 0.1*(t - 0.5), 0), -0.08*min(1, 2*t)"
    steps = section("Load steps", "Steps = 4")
    level = section("Refinement", "Level = 0")
    quiet = section("Output", "Fields = false")
    one = p.write("one.prm", solid(
        2, block(1, "12, 4 : 0, 0 : 3, 1 : true", f"2: 0, 0; 3: {push}",
                 more=RUBBER), steps, level, quiet, bodies=1
        ).replace("Pairs = 1", "Pairs = 0"))
    two = p.write("two.prm", solid(
        2, block(1, "12, 2 : 0, 0 : 3, 0.5 : true", "2: 0, 0", more=RUBBER),
        block(2, "12, 2 : 0, 0.5 : 3, 1 : true", f"3: {push}", more=RUBBER),
        pair("1: 3", "2: 2"), steps, level, quiet))
    whole = solved(one, *FINE)
    parts = solved(two, *FINE, "Pair 1/Friction=100", *words)
    p.expect(parts["pair_1_active"] == 13 and parts["pair_1_slipping"] == 0,
             f"stick {words}: {parts['pair_1_active']}, "
             f"{parts['pair_1_slipping']} slip")
    p.close(parts["energy"], whole["energy"], 1e-9, f"stick {words}: energy")


for each in p.some([[STANDARD], [], [SMALL]]):
    check_stick(*each)


# A die slides over 20 facets, so far from the ends of the block that what is not
# friction is small; and in larger steps it is the same.
def check_slide(steps, *words):
    summary = solved(slide(p, 80, 10, 12, 5, steps, width=8), FRICTION, *words)
    rows = [row for row in p.table("levels.csv") if row["time"] > 1.01]
    forces = [-row["pair_1_force_y"] for row in rows]
    ratios = [-row["pair_1_force_x"] / row["pair_1_force_y"] for row in rows]
    n = [len(newton(p, step)) for step in range(steps + 1, 2 * steps + 1)]
    print(words, steps, "force", statistics.mean(forces), "ripple",
          statistics.pstdev(forces) / statistics.mean(forces), "tangential",
          min(ratios[3:]), max(ratios[3:]), "linearisations",
          statistics.mean(n), max(n))
    p.expect(summary["force_imbalance"] < 1e-12,
             f"{words}: forces {summary['force_imbalance']}")
    p.expect(all(0.155 < force < 0.168 for force in forces),
             f"{words}: forces {forces}")
    p.expect(statistics.mean(n) <= 6., f"{words}: {n} linearisations")
    return ratios


fine = check_slide(22)                           # 0.9 facets at a step
far = check_slide(6)                             # 3.3 facets
p.expect(max(fine[3:]) - min(fine[3:]) < 1e-3 * MU,
         f"ripple of the friction: {fine}")
# By the pressure along the surface, which the die bends: nearly mu.
p.close(statistics.mean(fine[3:]), MU, 5e-3, "friction by pressure")
if not p.short:
    coarse = check_slide(11)                     # 1.8 facets
    for a, b in zip(fine[3::2], coarse[1:]):
        p.close(b, a, 1e-4, "friction in steps twice as large")
    check_slide(22, STANDARD)
p.close(far[-1], fine[-1], 1e-3, "friction in steps of 3.3 facets")

# A belt around a quarter of a drum is drawn and let go again, so that it slips
# back: the support has the force at the end times e^(mu pi/2) (Euler and
# Eytelwein), whatever iterates have done, some of which lift the belt off or,
# of triangles, fold facets.
def ring(inner, outer, n, layers):
    """A quarter of a ring, with ids as of the generator below."""
    def side(face):
        (s, t), (s2, t2) = face
        return 2 if s == s2 == 1 else 3 if s == s2 == 0 else int(t + t2 > 0)

    def polar(s, t):
        r = inner + (outer - inner) * t
        return r * math.cos(math.pi / 2 * s), r * math.sin(math.pi / 2 * s)

    cells = []
    for i in range(n):
        for j in range(layers):
            a, d = (i * (layers + 1) + j + k for k in (0, 1))
            b, c = (a + layers + 1, d + layers + 1)
            cells += ([[a, b, c], [a, c, d]] if (i + j) % 2
                      else [[a, b, d], [b, c, d]])
    return Mesh(2, [(i / n, j / layers) for i in range(n + 1)
                    for j in range(layers + 1)], cells, side).curved(polar)


def check_belt(tension, triangles, *words):
    def mesh(name, inner, outer, n, layers):
        if triangles:
            p.write(f"{name}.msh", ring(inner, outer, n, layers))
            return section("Mesh", f"File = {name}.msh")
        return section("Mesh", "Generator = quarter_hyper_shell",
                       f"Arguments = 0, 0 : {inner} : {outer} : {n} : true")

    scene = p.write("belt.prm", "\n".join([
        "set Scene = solid", "set Dimension = 2",
        section("Solid", "Bodies = 2", "Pairs = 1", "Plane = stress",
                "Degree = 2"),
        section(
            "Body 1", mesh("belt", 10, 10.05, 40, 1), "Young modulus = 1e5",
            "Poisson ratio = 0", "Support = 2: 0, free",
            f"Traction = 3: 0, -100*min(1, t) "
            f"+ {100 - 20 * tension}*max(0, t - 1)"),
        section(
            "Body 2", mesh("drum", *((6, 10, 30, 4) if triangles
                                     else (9, 10, 32, 1))),
            "Young modulus = 1e7", "Poisson ratio = 0.3", "Support = 0: 0, 0"),
        section("Pair 1", "Secondary = 1: 0", "Primary = 2: 1"),
        section("Time stepping", "Number of steps = 8", "End time = 2"),
        section("Refinement", "Level = 0")]) + "\n")
    summary = solved(scene, FRICTION, "Method/Contact geometry=current",
                     "Output/Fields=false", *words)
    p.close(-summary["reaction_1"][0], tension * math.exp(MU * math.pi / 2),
            1e-2, f"belt let go to {tension} {triangles} {words}")


check_belt(1.5, False)
check_belt(1.5, True, STANDARD)
if not p.short:
    check_belt(1.2, False)

# On two ranks as on one.
words = [FRICTION, "Time stepping/End time=1.4", "Time stepping/Number of steps=7"]
one = solved("slide.prm", *words)
two = solved("slide.prm", *words, ranks=2)
for key in ("energy", "pair_1_friction_force", "pair_1_dissipation"):
    p.close(two[key], one[key], 1e-7, f"{key} on two ranks")

p.finish()
