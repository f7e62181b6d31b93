# SPDX-License-Identifier: LGPL-2.1-or-later
"""Large strain: uniform states against roots of scalar equations, rotations,
order of Newton's method, load steps, and what is refused."""
import math

from block_scene import block, pair, section, solid
from program import Program, set_words

p = Program()
E, NU = 1., 0.3
MU, LAMBDA = E / (2 * (1 + NU)), E * NU / ((1 + NU) * (1 - 2 * NU))


def root(function, low, high):
    """By halving."""
    for _ in range(200):
        middle = (low + high) / 2
        if (function(low) < 0) == (function(middle) < 0):
            low = middle
        else:
            high = middle
    return (low + high) / 2


def neo_hooke(stretches):
    """Energy and principal nominal stresses."""
    log_j = math.log(math.prod(stretches))
    energy = (MU / 2 * (sum(s * s for s in stretches) - 3 - 2 * log_j)
              + LAMBDA / 2 * log_j**2)
    return energy, [MU * (s - 1 / s) + LAMBDA * log_j / s for s in stretches]


def st_venant(stretches):
    green = [(s * s - 1) / 2 for s in stretches]
    energy = LAMBDA / 2 * sum(green)**2 + MU * sum(e * e for e in green)
    return energy, [s * (LAMBDA * sum(green) + 2 * MU * e)
                    for s, e in zip(stretches, green)]


LAWS = {"neo-hooke": neo_hooke, "st venant-kirchhoff": st_venant}


def uniaxial(law, stretch, plane):
    """Lateral stretch, energy and stress along, with free sides."""
    def state(side):
        return law([side, 1. if plane else side, stretch])
    side = root(lambda x: state(x)[1][0], 0.5, 2.)
    energy, stress = state(side)
    return side, energy, stress[2]


# The roots themselves against figures of another program.
for is_plane, figures in ((True, (1.094876055993743, -.268631527879045)),
                          (False, (1.067338369278968, -.240005381988023))):
    side, _, stress = uniaxial(neo_hooke, .8, is_plane)
    p.close(side, figures[0], 1e-13, "lateral stretch")
    p.close(stress, figures[1], 1e-13, "nominal stress")


def run(scene, *settings):
    words = set_words(settings)
    return p.call("run", scene, "--output", "out", "--quiet", *words)


def solved(scene, *settings, code=0):
    result = run(scene, *settings)
    p.expect(result.returncode == code,
             f"{settings}: exit code {result.returncode}\n{result.stderr}")
    return p.results()[0]


def newton(load_step):
    """Rows of the last mesh of a load step."""
    rows = [row for row in p.table("newton.csv") if row["load_step"] == load_step]
    level = max(row["level"] for row in rows)
    return [row for row in rows if row["level"] == level]


def press(dimension, stretch):
    """A block under a rigid plate, on rollers."""
    d = dimension
    flat = ", ".join(["0"] * (d - 1))
    last = 2 * (d - 1)
    size = "2, 2 : 0, 0 : 1, 1 : true" if d == 2 else \
           "2, 2, 2 : 0, 0, 0 : 1, 1, 1 : true"
    rollers = {2: "0: 0, free; 2: free, 0",
               3: "0: 0, free, free; 2: free, 0, free; 4: free, free, 0"}[d]
    return p.write(f"press-{d}.prm", "\n".join([
        "set Scene = solid", f"set Dimension = {d}",
        section("Solid", "Pairs = 1", "Obstacles = 1"),
        block(1, size, rollers),
        section("Pair 1", f"Secondary = 1: {last + 1}", "Obstacle = 1"),
        section("Obstacle 1", "Kind = plane", f"Point = {flat}, 1",
                f"Normal = {flat}, -1", f"Motion = {flat}, {stretch - 1}*t"),
        section("Load steps", "Newton tolerance = 1e-12"),
        section("Refinement", "Level = 1"),
        section("Output", "Fields = false",
                f"Points = 1: {', '.join(['1'] * d)}")]))


# What cells have one change of volume for makes no difference where they deform
# evenly.
MEAN = "Body 1/Element=mean dilatation"

# Uniaxial compression by a plate; around an axis it is that of space.
for d, plane, law, stretch, area, *words in (
        (2, "strain", "neo-hooke", .8, 1.), (3, "strain", "neo-hooke", .8, 1.),
        (2, "axisymmetric", "neo-hooke", .6, math.pi),
        (2, "strain", "neo-hooke", .8, 1., MEAN),
        (3, "strain", "neo-hooke", .8, 1., MEAN),
        (2, "axisymmetric", "neo-hooke", .6, math.pi, MEAN),
        (2, "strain", "st venant-kirchhoff", .85, 1.),
        (3, "strain", "st venant-kirchhoff", .85, 1.)):
    scene = press(d, stretch)
    summary = solved(scene, f"Body 1/Material={law}", *words,
                     *([f"Solid/Plane={plane}"] if d == 2 else []))
    side, energy, stress = uniaxial(LAWS[law], stretch,
                                    d == 2 and plane == "strain")
    what = f"{law}, {d}D, {plane}"
    p.close(summary["pair_1_force"][d - 1], stress * area, 1e-10,
            f"{what}: force of the plate")
    p.close(summary["reaction_1"][d - 1], -stress * area, 1e-10,
            f"{what}: reaction")
    p.close(summary["point_1"][0], side - 1, 1e-10, f"{what}: lateral")
    p.close(summary["energy"], energy * area, 1e-10, f"{what}: energy")
    p.close(summary["least_stretch"], stretch, 1e-10, f"{what}: stretch")
    p.expect(summary["least_volume"] > 0, f"{what}: volume")

# A block whose side turns: a whole turn leads back to where it was, where the
# displacement is no scale for its error; half a turn at once folds it, with
# cells inside out at corners.
angle = "(pi*t)"
turned = p.write("turned.prm", "\n".join([
    "set Scene = solid", "set Dimension = 2",
    block(1, "4, 2 : 0, 0 : 2, 1 : true",
          f"0: x*(cos{angle}-1)-y*sin{angle}, x*sin{angle}+y*(cos{angle}-1)",
          more=("Material = neo-hooke",)),
    section("Refinement", "Level = 1"),
    section("Output", "Fields = false")]))
summary = solved(turned, "Time stepping/Number of steps=8", "Time stepping/End time=2")
p.expect(abs(summary["energy"]) < 1e-12 and summary["load_steps"] == 8,
         f"a whole turn: energy {summary['energy']}, "
         f"{summary['load_steps']} load steps")
folded = run(turned, "Time stepping/Number of steps=1")
p.expect("inverted at a corner" in folded.stderr,
         f"half a turn at once: {folded.stderr}")
p.expect("inverted at" not in run(turned, "Time stepping/Number of steps=4").stderr,
         "half a turn in steps")

# Without contact: prescribed ends, in tension and in one load step.
pulled = p.write("pulled.prm", "\n".join([
    "set Scene = solid", "set Dimension = 2",
    block(1, "2, 3 : 0, 0 : 1, 1 : true",
          "0: 0, free; 2: free, 0; 3: free, 0.5*t"),
    section("Load steps", "Newton tolerance = 1e-13"),
    section("Method", "Final linear tolerance = 1e-14"),
    section("Refinement", "Level = 1"),
    section("Output", "Fields = false", "Points = 1: 1, 1")]))
STRETCH = {"neo-hooke": 1.5, "st venant-kirchhoff": 1.2}
for law, function in LAWS.items():
    stretch = STRETCH[law]
    summary = solved(pulled, f"Body 1/Material={law}",
                     f"Body 1/Prescribed displacement=0: 0, free; 2: free, 0; 3: free, "
                     f"{stretch - 1}*t")
    side, energy, stress = uniaxial(function, stretch, True)
    p.close(summary["point_1"][0], side - 1, 1e-10, f"{law}: pulled")
    p.close(summary["energy"], energy, 1e-10, f"{law}: energy of a pull")
    # Dead loads: the same stretch by a force per undeformed area.
    summary = solved(pulled, f"Body 1/Material={law}",
                     "Body 1/Prescribed displacement=0: 0, free; 2: free, 0",
                     f"Body 1/Traction=3: 0, {stress!r}*t",
                     "Time stepping/Number of steps=2")
    p.close(summary["point_1"][1], stretch - 1, 1e-9, f"{law}: by a force")

# A rotation by a right angle leaves no stress, shear the energy of its angle.
turn = "x*cos(a) - y*sin(a) - x, x*sin(a) + y*cos(a) - y"
turn = turn.replace("a)", "pi/2*t)")
for law, more in (("neo-hooke", []), ("neo-hooke", [MEAN]),
                  ("st venant-kirchhoff", [])):
    words = [f"Body 1/Material={law}", "Time stepping/Number of steps=3", *more]
    summary = solved(pulled, *words, f"Body 1/Prescribed displacement=*: {turn}",
                     f"Exact solution/Displacement={turn}")
    p.expect(summary["nodal_error"] < 1e-10, f"{law}: turned as a whole")
    p.expect(abs(summary["energy"]) < 1e-14, f"{law}: energy of a turn")
    k = 0.6 if law == "neo-hooke" else 0.3
    shear = f"{k}*t*y, 0"
    summary = solved(pulled, *words, f"Body 1/Prescribed displacement=*: {shear}",
                     f"Exact solution/Displacement={shear}")
    expected = MU / 2 * k * k if law == "neo-hooke" else \
        LAMBDA / 2 * (k * k / 2)**2 + MU * (k * k / 2 + k**4 / 4)
    p.expect(summary["nodal_error"] < 1e-10, f"{law}: sheared")
    p.close(summary["energy"], expected, 1e-10, f"{law}: energy of shear")

# Newton's method is of second order: a block that bulges, held below.
scene = press(2, .8)
for law, stretch, *words in (
        ("neo-hooke", .6), ("st venant-kirchhoff", .9),
        ("neo-hooke", .75, MEAN, "Body 1/Poisson ratio=0.4999")):
    solved(press(2, stretch), f"Body 1/Material={law}", *words,
           "Body 1/Prescribed displacement=2: 0, 0", "Refinement/Level=2",
           "Method/Final linear tolerance=1e-14")
    forces = [row["residual"] for row in newton(1) if row["part"] == 1.]
    print(law, "residuals:", *(f"{f:.3g}" for f in forces))
    forces = [f for f in forces if f > (1e-10 if words else 1e-13)]
    orders = [math.log(c / b) / math.log(b / a) for a, b, c in
              zip(forces, forces[1:], forces[2:])]
    p.expect(len(orders) >= 1 and orders[-1] >= 1.8,
             f"{law}: orders {orders} of {forces}")

# A beam that is bent by more than one step can find.
bent = p.write("bent.prm", "\n".join([
    "set Scene = solid", "set Dimension = 2",
    block(1, "8, 2 : 0, 0 : 4, 1 : true", "0: 0, 0",
          more=["Traction = 1: 0, -0.003*t"]),
    section("Refinement", "Level = 0"),
    section("Output", "Fields = false", "Points = 1: 4, 0")]))
cut = solved(bent, "Body 1/Material=neo-hooke")
steps = solved(bent, "Body 1/Material=neo-hooke", "Time stepping/Number of steps=16")
p.expect(cut["load_steps_cut_back"] > 0,
         "one step for all of it")
p.close(cut["point_1"][1], steps["point_1"][1], 1e-6, "end of the beam")

# A step that takes too long is given up and halved, and leaves no trace.
scene = press(2, .6)
once = solved(scene, "Body 1/Material=neo-hooke")
halved = solved(scene, "Body 1/Material=neo-hooke", "Time stepping/Maximum Newton iterations=4",
                "Refinement/Level=1", "Refinement/Coarsest level=1")
p.expect(halved["load_steps_cut_back"] > 0, "no step was given up")
for key in ("energy", "contact_force"):
    p.close(halved[key], once[key], 1e-10, f"{key} after halved steps")

# St. Venant and Kirchhoff's law has an end, neo-Hooke has none.
failed = run(press(2, .7), "Body 1/Material=st venant-kirchhoff")
p.expect(failed.returncode == 3 and "F35" in failed.stderr
         and "Body 1/Material = neo-hooke" in failed.stderr, failed.stderr)
solved(press(2, .7), "Body 1/Material=neo-hooke")

# Adaptive meshes and friction on a plate.
summary = solved(press(2, .8), "Body 1/Material=neo-hooke",
                 "Body 1/Prescribed displacement=2: 0, 0", "Pair 1/Friction=0.2",
                 "Refinement/Adaptive cycles=1")
p.expect(summary["pair_1_force"][1] < -0.2 and summary["estimate"] > 0,
         "friction on an adaptive mesh")

# Several ranks.
one = solved(press(3, .8), "Body 1/Material=neo-hooke",
             "Body 1/Prescribed displacement=4: 0, 0, 0")
several = p.call("run", press(3, .8), "--output", "out", "--quiet",
                 *set_words(["Body 1/Material=neo-hooke",
                             "Body 1/Prescribed displacement=4: 0, 0, 0"]), ranks=2)
p.expect(several.returncode == 0, several.stderr)
p.close(p.results()[0]["energy"], one["energy"], 1e-10, "two ranks")

# What large strain does not have is refused.
scene = press(2, .8)
for words, parameter, text in (
        (["Solid/Plane=stress"], "Solid/Plane", "plate in 3D"),
        (["Time stepping/Scheme=trapezoid", "Body 1/Density=1", "Time stepping/Step size=0.1",
          "Time stepping/Mass matrix=consistent", "Time stepping/Stiffness damping=0.1"],
         "Time stepping/Stiffness damping", "damp rigid rotations"),
        (["Refinement/Target error=0.1"], "Refinement/Target error",
         "small strain only"),
        (["Method/Enforcement=nitsche"], "Method/Enforcement",
         "Body 1/Material"),
        ([MEAN, "Solid/Degree=2"], "Body 1/Element", "hardly lock"),
        (["Body 1/Poisson ratio=0.5", MEAN], "Body 1/Poisson ratio", "0.5")):
    p.expect_error(run(scene, "Body 1/Material=neo-hooke", *words), parameter,
                   text)
p.expect_error(run(scene, MEAN, "Body 1/Material=st venant-kirchhoff"),
               "Body 1/Element", "neo-hooke")
p.expect_error(run(scene, MEAN, "Solid/Plane=stress"), "Body 1/Element",
               "plane stress")
both = p.write("both.prm", solid(
    2, block(1, "3, 3 : 0, 0 : 1, 1 : true", "2: 0, 0"),
    block(2, "4, 4 : 0, 1 : 1, 2 : true", "3: 0, -0.01"),
    pair("2: 2", "1: 3"), section("Refinement", "Level = 1"),
    section("Output", "Fields = false")))
p.expect_error(run(both, "Body 1/Material=neo-hooke"), "Body 2/Material",
               "small strain")
p.expect_error(run(both, "Body 1/Material=rubber"), "Body 1/Material",
               "neo-hooke")

# A column between a clamp and a plate is stable up to Euler's load of a top that
# stays flat, pi^2 E I / (L^2 (1 - nu^2)) = 2.26, which it has at 0.041.
EULER = math.pi**2 * 1000 / 12 / 20**2 / (1 - 0.3**2)
for way, unstable, ranks in ((0.040, False, 0), (0.042, True, 0), (0.042, True, 2)):
    result = p.call("run", p.source / "prm/failures/buckling.prm", "--quiet",
                    "--output", "out", *set_words({
                        "Obstacle 1/Motion": f"0, -{way}*t",
                        "Time stepping/Number of steps": 1}), ranks=ranks)
    force = p.summary()["contact_force"]
    p.expect((force > EULER) == unstable and abs(force / EULER - 1.) < 0.03,
             f"column pressed by {way}: {force}")
    p.expect(("ABUT-F52" in result.stderr) == unstable, f"{way}: {result.stderr}")

p.finish()
