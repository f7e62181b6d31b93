# SPDX-License-Identifier: LGPL-2.1-or-later
"""Scenes of two bodies that cannot be solved, or only with a warning, and what
the program says; secondary and primary exchanged; load steps."""
import math

from block_scene import block, pair, section, solid
from program import Program, set_words

p = Program()
scene = p.write("blocks.prm", solid(
    2, block(1, "3, 3 : 0, 0 : 1, 1 : true", "2: 0, 0"),
    block(2, "4, 4 : 0, 1 : 1, 2 : true", "3: 0, -0.01"),
    pair("2: 2", "1: 3"), section("Refinement", "Level = 1"),
    section("Output", "Fields = false")))


def run(*settings, command="run"):
    words = set_words(settings)
    if command == "run":
        words += ["--output", "out", "--quiet"]
    return p.call(command, scene, *words)


def solved(*settings):
    result = run(*settings)
    p.expect(result.returncode == 0,
             f"{settings}: exit code {result.returncode}\n{result.stderr}")
    return p.results()


# The scene itself; E = 1, so that the stress is about -0.005.
summary, levels = solved()
p.expect(summary["contact_force"] > 4e-3, "the blocks press on each other")
p.close(summary["reaction_1"][1], summary["contact_force"], 1e-6,
        "support and contact")

# A parameter by its former name, which counts as the present one.
known = p.source / "prm/failures/rich-multipliers.prm"
p.expect(p.call("check", known).returncode != 2, "a known failure is refused")
p.expect_error(p.call("check", known, "--set", "Solid/Run what fails=false"),
               "ABUT-F02")

# Mistakes.
p.expect_error(run("Pair 1/Secondary=2: 7"), "Pair 1/Secondary",
               "no boundary id 7")
p.expect_error(run("Pair 1/Secondary=3: 0"), "Pair 1/Secondary",
               "number of a body, 1 to 2")
p.expect_error(run("Pair 1/Secondary="), "Pair 1/Secondary",
               "no secondary surface")
p.expect_error(run("Pair 1/Primary="), "Pair 1/Primary", "neither")
p.expect_error(run("Pair 1/Primary=2: 2, 3"), "Pair 1/Primary",
               "on both sides of the pair")
p.expect_error(run("Pair 1/Primary=2: 2"), "Pair 1/Secondary",
               "face each other")
p.expect_error(run("Pair 1/Obstacle=1"), "Pair 1/Obstacle", "primary surface")
p.expect_error(run("Pair 1/Primary=", "Pair 1/Obstacle=2"), "Pair 1/Obstacle",
               "no obstacle 2")
p.expect_error(run("Pair 2/Reach=1"), "Pair 2/Reach",
               "Solid/Pairs is 1: set it to 2")
p.expect_error(run("Pair 1/Initial gap=x"), "Pair 1/Initial gap")
p.expect_error(run("Solid/Pairs=0"), "Pair 1/Primary",
               "Solid/Pairs is 0: set it to 1")

# Two blocks without a pair.
p.write("apart.prm", solid(
    2, block(1, "1, 1 : 0, 0 : 1, 1 : true", "2: 0, 0"),
    block(2, "1, 1 : 0, 1 : 1, 2 : true", "3: 0, -0.1"), pairs=0))
result = p.call("run", "apart.prm", "--output", "out")
p.expect(result.returncode == 0
         and "nothing keeps the 2 bodies from passing" in result.stderr,
         f"no pair: {result.stdout}{result.stderr}")

# Surfaces that cannot meet.
p.expect_error(run("Body 2/Mesh/Move=0, 0.6", "Refinement/Level=0"),
               "Pair 1/Secondary", "ABUT-F24", "too far apart", "0.6", "reach")
p.expect_error(run("Body 2/Mesh/Move=0, -0.3", "Refinement/Level=0"),
               "Pair 1/Secondary", "ABUT-F11", "overlap", "reach")
deep = ("Body 2/Mesh/Move=0, -0.3", "Pair 1/Reach=1", "Refinement/Level=0")
p.expect(run(*deep, "Search/Thickness=1").returncode == 0,
         "an interference that is meant")
p.expect_error(run(*deep, "Search/Thickness=0.5"), "Pair 1/Secondary",
               "overlap")
p.expect_error(run("Pair 1/Secondary=2: 3", "Pair 1/Reach=2"),
               "Pair 1/Secondary", "prescribed by Body 2/Prescribed displacement")
p.expect_error(run("Pair 1/Secondary=2: 3", "Pair 1/Reach=2",
                   "Body 2/Prescribed displacement=1: 0, 0"),
               "Pair 1/Secondary", "ABUT-F23", "same direction")
p.expect_error(run("Body 2/Mesh/Move=3, 0"), "Pair 1/Secondary", "ABUT-F24",
               "lies opposite the other", "position of the bodies")

# Bodies that may come from far away do not begin inside of each other, deeper
# than they would be looked for.

def start(scene, settings, ranks=0):
    return p.call("run", p.source / "prm" / scene, "--output", "out", "--quiet",
                  *set_words({"Output/Points": "", **settings}), ranks=ranks)


for place, overlaps, ranks in (("5.1, -0.3 : 6.1, 0.7", True, (0, 2)),
                               ("5.1, -0.5 : 6.1, 0.5", True, (0,)),
                               ("4.6, -0.5 : 5.6, 0.5", True, (0,)),
                               ("3.6, -0.4 : 4.6, 0.6", False, (0, 2)),
                               ("3, -2 : 4, -1", False, (0,))):
    for number in ranks:
        thrown = start("landing-on-a-body.prm", {
            "Time stepping/End time": 0.0025,
            "Body 1/Mesh/Arguments": f"4, 10 : {place} : true"}, number)
        if overlaps:
            p.expect_error(thrown, "Pair 1/Secondary", "ABUT-F11", "overlap")
        else:
            p.expect(thrown.returncode == 0, f"{place}: {thrown.stderr}")
parted = start("landing-on-a-body.prm", {
    "Time stepping/End time": 0.0025, "Body 1/Initial displacement": "0, 1.5",
    "Body 1/Mesh/Arguments": "4, 10 : 5.1, -0.3 : 6.1, 0.7 : true"})
p.expect(parted.returncode == 0, f"displaced to begin with: {parted.stderr}")
p.expect_error(start("sliding-die.prm", {"Body 1/Mesh/Scale": 1.559}),
               "Pair 1/Secondary", "ABUT-F11", "overlap by at least", "reach")
for scale, overlap in ((1.1, "0.1"), (1.02, "")):
    pressed = start("sliding-die.prm", {
        "Body 1/Mesh/Scale": scale, "Time stepping/Number of steps": 1,
        "Time stepping/End time": 1})
    p.expect(pressed.returncode == 0
             and (f"overlap by {overlap} before" in pressed.stderr
                  if overlap else "F11" not in pressed.stderr),
             f"{scale}: {pressed.stderr}")

# What is merely odd is a warning.
coarse = run("Body 1/Refinements=3", "Refinement/Level=0")
p.expect(coarse.returncode == 0 and "as coarse as the primary" in coarse.stderr,
         f"a coarse secondary side: {coarse.stderr}")

soft = run("Method/Enforcement=penalty", "Method/Penalty factor=1e-3")
p.expect(soft.returncode == 3 and "far too soft" in soft.stderr,
         f"soft penalty: {soft.stderr}")
soft = run("Method/Enforcement=quadratic penalty", "Method/Penalty factor=1e-3",
           "Method/Penalty cap=1e-3")
p.expect(soft.returncode == 3 and soft.stderr.count("at its cap") == 1,
         f"soft quadratic penalty: {soft.stderr}")

# Penalties without sense: refused, or said before anything else; then either
# the answer is right, or the run says that there is none.
for law, code in (("penalty", "ABUT-F06"), ("augmented lagrangian", "ABUT-F06"),
                  ("nitsche", "ABUT-F31")):
    method = f"Method/Enforcement={law}"
    for value in ("-1", "nan", "inf"):
        p.expect_error(run(method, f"Method/Penalty factor={value}"), "Method/Penalty factor")
    for value in ("1e-30", "1e15", "1e30", "1e300"):
        result = run(method, f"Method/Penalty factor={value}")
        warnings = [line for line in result.stderr.splitlines()
                    if line.startswith("abut: warning: " + code)]
        p.expect(warnings and "sensible range" in warnings[0],
                 f"{law}, {value}: {result.stderr}")
        if result.returncode == 0:
            p.close(p.results()[0]["contact_force"],
                    summary["contact_force"], 1e-3, f"{law}, {value}: force")
        else:
            p.expect(result.returncode == 3,
                     f"{law}, {value}: exit code {result.returncode}")

# Pulled apart: the upper block has nothing to hold it, its own supports let it
# go up and down.
gone = run("Body 2/Prescribed displacement=0, 1: 0, free", "Body 2/Traction=3: 0, 0.01")
p.expect(gone.returncode == 3, f"pulled apart: exit code {gone.returncode}")
p.expect("ABUT-F12" in gone.stderr, f"pulled apart: {gone.stderr}")
pushed, _ = solved("Body 2/Prescribed displacement=0, 1: 0, free", "Body 2/Traction=3: 0, -0.01")
p.close(pushed["contact_force"], 0.01, 1e-6, "pushed together")

# A lower block that nothing holds but the pair, and one without a pair.
p.expect_error(run("Body 2/Prescribed displacement=", "Pair 1/Secondary=1: 3",
                   "Pair 1/Primary=1: 2"), "Body 2/Prescribed displacement",
               "every rigid motion", "in no contact pair")

# A corner that is held both ways: the lower block's side goes up by more than
# the upper one's side, which is held, too.
held = "Body 1/Prescribed displacement=2: 0, 0; 0: 0, 0.02*y"
p.expect_error(run("Body 2/Prescribed displacement=3: 0, -0.01; 0: 0, 0", held),
               "Body 2/Prescribed displacement", "different displacements", "corner")
corner = run("Body 2/Prescribed displacement=3: 0, -0.01; 0: 0, 0.01 - 0.01*y", held)
p.expect(corner.returncode == 3 and "ABUT-F26" in corner.stderr
         and "prescribed displacements keep nodes" in corner.stderr,
         f"a corner held both ways: {corner.stderr}")

# Corners where a support meets the contact surface.
corner, _ = solved("Body 2/Prescribed displacement=3: 0, -0.01; 0: 0, free",
                   "Body 1/Prescribed displacement=2: 0, 0; 0: 0, free")
p.expect(corner["contact_force"] > 4e-3, "supports at the end of the surface")

# Secondary and primary exchanged: the same but for the discretisation error.
for word in ("mortar", "dual mortar", "node to segment"):
    one, _ = solved(f"Method/Discretisation={word}", "Refinement/Level=2")
    two, _ = solved(f"Method/Discretisation={word}", "Refinement/Level=2",
                    "Pair 1/Secondary=1: 3", "Pair 1/Primary=2: 2")
    p.close(two["contact_force"] / one["contact_force"], 1., 0.01,
            f"{word}: sides exchanged")
    p.close(two["energy"] / one["energy"], 1., 0.01,
            f"{word}: energy with sides exchanged")

# Load steps end where one step does: nothing here depends on the way.
one, _ = solved("Body 2/Prescribed displacement=3: 0, -0.01*t")
many, rows = solved("Body 2/Prescribed displacement=3: 0, -0.01*t", "Time stepping/Number of steps=4")
p.expect(many["load_steps"] == 4 and rows[-1]["time"] == 1., "four load steps")
p.close(many["energy"] / one["energy"], 1., 1e-6, "energy after load steps")
p.close(many["contact_force"] / one["contact_force"], 1., 1e-6,
        "force after load steps")

# A gap that closes halfway.
gap, rows = solved("Body 2/Prescribed displacement=3: 0, -0.01*t", "Time stepping/Number of steps=4",
                   "Pair 1/Initial gap=0.005")
first = [row for row in rows if row["time"] < 0.49]
p.expect(all(row["active"] == 0 for row in first), "open at first")
p.close(gap["contact_force"] / (0.5 * one["contact_force"]), 1., 1e-3,
        "half of the way is free")


def bent(elements, height, load, *body, run_settings=()):
    """Tip of a cantilever of length 50 and thickness 1 without lateral
    contraction by theory of beams, E = 1000, and what the run has."""
    dim = len(elements.split(","))
    corner = ", ".join(["0"] * dim) + " : 50, " + ", ".join(height)
    p.write("beam.prm", solid(
        dim, section("Body 1", section("Mesh", "Generator = subdivided_hyper_rectangle",
                                       f"Arguments = {elements} : {corner} : true"),
                     "Support = 0: " + ", ".join(["0"] * dim), "Young modulus = 1000",
                     "Poisson ratio = 0", f"Traction = 1: {load}", *body),
        section("Refinement", "Level = 0"),
        section("Output", "Fields = false", "Points = 1: 50, " + ", ".join(height)),
        bodies=1, pairs=0))
    result = p.call("run", "beam.prm", "--output", "out", "--quiet",
                    *set_words(run_settings))
    p.expect(result.returncode == 0, f"beam: {result.stderr}")
    return p.summary(), result.stderr


# Bilinear elements of length l in bending: too stiff by G l^2 / (E h^2).
for elements, height, load, length in (
        ("10, 1", ["1"], "0, -1e-4", 5.), ("50, 1", ["1"], "0, -1e-4", 1.),
        ("50, 3", ["1"], "0, -1e-4", 1.), ("20, 1, 2", ["2", "1"], "0, 0, -1e-4", 2.5)):
    lacking = 0.5 * length**2 / (0.5 * length**2 + 1.)
    summary, words = bent(elements, height, load)
    p.close(summary["locked_energy"], lacking, 5e-3, f"{elements}: locked")
    p.close(summary["point_1"][-1], -0.05 * (1. - lacking), 1e-3,
            f"{elements}: tip")
    p.expect("ABUT-F16" in words and "spurious shear" in words, f"{elements}: {words}")
# Short elements, quadratic ones; and torsion and tension, which need no bent edges.
for elements, height, load, settings in (
        ("250, 5", ["1"], "0, -1e-4", ()),
        ("10, 1", ["1"], "0, -1e-4", ("Solid/Degree=2",)),
        ("50, 4, 2", ["2", "1"], "0, 1e-3*(z-0.5), -1e-3*(y-1)", ()),
        ("10, 1", ["1"], "1, 0", ())):
    _, words = bent(elements, height, load, run_settings=settings)
    p.expect("ABUT-F16" not in words, f"{elements} {load}: {words}")
# Rotations are no shear.
large, _ = bent("50, 1", ["1"], "0, -8e-3*t", "Material = neo-hooke",
                run_settings=("Time stepping/Number of steps=4",))
p.expect(large["point_1"][1] < -2., f"bent far: {large['point_1']}")
p.close(large["locked_energy"], 1. / 3., 0.02, "bent far: locked")
# What is moved and not deformed has strains of round-off, which are none.
moved = [section("Mesh", "Generator = subdivided_hyper_rectangle", "Rotate = 17",
                 "Arguments = 4, 3 : 0.1, 10 : 1.37, 11 : true"),
         "Young modulus = 1000"]
for name, body, more in (
        ("moved", ["Material = neo-hooke", "Support = 2: 7.3, 1.3"], ""),
        ("thrown", ["Density = 1", "Initial velocity = 0.7, -1.3"],
         section("Time stepping", "Scheme = hht", "Step size = 0.1", "End time = 3"))):
    p.write(f"{name}.prm", solid(2, section("Body 1", *moved, *body), more,
                                 section("Refinement", "Level = 1"),
                                 section("Output", "Fields = false"), bodies=1, pairs=0))
    result = p.call("run", f"{name}.prm", "--output", "out", "--quiet")
    p.expect(result.returncode == 0 and "ABUT-F16" not in result.stderr,
             f"{name}: {result.stderr}")

# Formulas that change between the points where they are evaluated (F49).
def part_missed(measure, limit, scene):
    p.write("narrow.prm", scene + section("Refinement", "Level = 0")
            + section("Output", "Fields = false"))
    result = p.call("run", "narrow.prm", "--output", "out", "--quiet")
    p.expect(result.returncode == 0, f"{scene}: {result.stderr}")
    part = p.summary()[measure]
    p.expect(("ABUT-F49" in result.stderr) == (part > limit), f"{scene}: {result.stderr}")
    return part


def unit_block(dim, cells, support, *more):
    zero = ", ".join(["0"] * (dim - 1))
    cells = ", ".join([str(n) for n in cells])
    return solid(dim, block(1, f"{cells} : {zero}, 0 : {zero.replace('0', '1')}, 1 : true",
                            f"{2 * dim - 2}: {zero}, 0" + support,
                            more=("Young modulus = 1e4", *more)), bodies=1, pairs=0)


# Tractions and body forces in an eighth of a cell, whose force is 0 at Gauss' points;
# half a cell; and formulas that cells resolve.
for dim in (2, 3):
    zero, top = ", ".join(["0"] * (dim - 1)), 2 * dim - 1
    for load, error in (
            (f"Traction = {top}: {zero}, if(x > 0.25 && x < 0.28125, 1, 0)", 1.),
            (f"Body force = {zero}, if(x > 0.25 && x < 0.28125, 1, 0)", 1.),
            (f"Body force = {zero}, if(x > 0.25 && x < 0.375, 1, 0)", 0.),
            (f"Body force = {zero}, x^2", 0.),
            (f"Pressure = {top}: sin(x)*exp(x)", 0.)):
        found = part_missed("load_error", 0.02, unit_block(dim, [4] * dim, "", load))
        p.close(1. + found, 1. + error, 2e-3, f"{dim}: {load}")


# Displacements that are prescribed between nodes are 0 at nodes, and those of a wave are
# interpolated.
def pressed(dim, facets, formula):
    support = f"; {2 * dim - 1}: " + ", ".join(["0"] * (dim - 1)) + f", {formula}"
    return part_missed("support_error", 0.1,
                       unit_block(dim, [facets] * (dim - 1) + [1], support))


def interpolation_error(f, n, samples=4000):
    """Integral of |f - interpolation of n linear pieces| over that of |f|."""
    wrong = whole = 0.
    for k in range(samples):
        x = (k + 0.5) / samples
        i = int(x * n)
        s = x * n - i
        line = (1. - s) * f(i / n) + s * f((i + 1) / n)
        wrong += abs(line - f(x))
        whole += abs(f(x))
    return wrong / whole


def wave(x):
    return math.sin(2. * math.pi * x)


for dim in (2, 3):
    p.close(pressed(dim, 4, "if(x > 0.03 && x < 0.2, -0.001, 0)"), 1., 1e-9,
            f"{dim}: pressed between nodes")
    for n in (5, 7):
        p.close(pressed(dim, n, "1e-3*sin(2*pi*x)"), interpolation_error(wave, n), 1e-2,
                f"{dim}: a wave over {n} facets")
    p.close(1. + pressed(dim, 4, "1e-3*(1+x)"), 1., 1e-9, f"{dim}: a plane")

# Friction on a strip between nodes, on one with nodes in it, and one that changes slowly.
for friction, least, most in (("if(x > 0.27 && x < 0.48, 0.5, 0)", 1., 1.),
                              ("if(x > 0.4, 0.5, 0)", 0.05, 0.3), ("0.1+0.2*x", 0., 1e-9)):
    part = part_missed("pair_1_friction_error", 0.1, solid(
        2, block(1, "4, 4 : 0, 0 : 1, 1 : true", "3: 0.01, -0.01",
                 more=("Young modulus = 1e4",)),
        section("Obstacle 1", "Kind = plane"),
        section("Pair 1", "Secondary = 1: 2", "Obstacle = 1", f"Friction = {friction}"),
        bodies=1, obstacles=1))
    p.expect(least - 1e-9 <= part <= most + 1e-9, f"{friction}: {part}")

# The same of membranes: body forces, and fluxes through the boundary.
for load, error in (
        ("Body force = if(x > 0.25 && x < 0.28125, -1, 0)", 1.),
        ("Body force = if(x > 0.25 && x < 0.375, -1, 0)", 0.),
        ("Body force = x^2 - 0.5", 0.),
        ("Traction = 1: if(y > 0.25 && y < 0.28125, 1, 0)", 1.),
        ("Traction = 1: sin(y)", 0.)):
    found = part_missed(
        "load_error", 0.02, "set Scene = obstacle\nset Dimension = 2\n"
        + section("Membrane", load, "Prescribed displacement = 0: 0")
        + section("Mesh", "Generator = subdivided_hyper_rectangle",
                  "Arguments = 4, 4 : 0, 0 : 1, 1 : true")
        + section("Contact", "Obstacle = -10"))
    p.close(1. + found, 1. + error, 2e-3, f"membrane, {load}")

# Conditions that choose faces of the coarse mesh, here four on each side: 30 % of the
# upper side has half a face too little; y > 0.9 is also true on parts of other sides.
for condition, words in (("x < 0.3 && y > 0.999", ["changes within faces", "20 % of the area"]),
                         ("x < 0.5 && y > 0.999", []), ("y > 0.9", [])):
    p.write("ids.prm", solid(
        2, block(1, "4, 4 : 0, 0 : 1, 1 : true", "2: 0, 0",
                 f"Boundary ids = 5: {condition}",
                 more=("Young modulus = 1e4", "Pressure = 5: 1")),
        section("Refinement", "Level = 1"), section("Output", "Fields = false"),
        bodies=1, pairs=0))
    result = p.call("run", "ids.prm", "--output", "out", "--quiet")
    p.expect(result.returncode == 0 and ("warning" in result.stderr) == bool(words)
             and all(word in result.stderr for word in words),
             f"{condition}: {result.stderr}")

# Two hollow spheres, radii 1, 2 and 2, 3, pressed into each other by 0.01, as bodies of
# revolution: Lame's pressure, whichever side is secondary. Quadratic functions have no
# area at nodes on the axis.
def hollow(number, radii, young, poisson, cells):
    return section(f"Body {number}", section("Mesh", "Generator = quarter_hyper_shell",
                                             f"Arguments = 0, 0 : {radii} : {cells} : true"),
                   f"Young modulus = {young}", f"Poisson ratio = {poisson}",
                   "Prescribed displacement = 2: 0, free; 3: free, 0")


def growth(inner, outer, young, poisson, side):
    """Displacement of a side of a hollow sphere by a unit pressure there."""
    other = inner + outer - side
    return side / young * abs((1 - 2 * poisson) * side**3 + (1 + poisson) / 2 * other**3
                              ) / (outer**3 - inner**3)


spheres = 0.01 / (growth(1, 2, 1000, 0.3, 2) + growth(2, 3, 3000, 0.2, 2))
for sides in (("1: 1", "2: 0"), ("2: 0", "1: 1")):
    p.write("spheres.prm", solid(
        2, hollow(1, "1 : 2", 1000, 0.3, 3), hollow(2, "2 : 3", 3000, 0.2, 4),
        pair(*sides).replace("end", "set Initial gap = -0.01\nend"),
        section("Refinement", "Level = 2"), section("Output", "Fields = false")))
    # Mortar disturbs pressures at the axis, and beside it.
    for method, error in (("dual mortar", 0.05), ("mortar", 0.2)):
        summary = p.run_scene("spheres.prm", (
            "Solid/Degree=2", "Solid/Plane=axisymmetric", f"Method/Discretisation={method}"))
        for key in ("pair_1_pressure", "pair_1_least_pressure"):
            p.close(summary[key], spheres, error, f"spheres, {sides[0]}, {method}, {key}")

p.finish()
