# SPDX-License-Identifier: LGPL-2.1-or-later
"""A surface that touches itself gives what the same mesh gives when its two
parts have boundary ids of their own, on any number of ranks."""
import math

from block_scene import section, solid
from program import Program, set_words
from ucd import ucd

p = Program()
QUIET = {"Output/Fields": "false", "Output/Pictures": "false",
         "Method/Final linear tolerance": 1e-12}
KEYS = ("energy", "contact_force", "pair_1_pressure", "pair_1_covered_area")


def same(one, two, what, tolerance=1e-9):
    p.expect(one["active"] == two["active"] > 0,
             f"{what}: {one['active']} and {two['active']} in contact")
    p.expect(one["constraints"] == two["constraints"],
             f"{what}: {one['constraints']} and {two['constraints']} rows")
    for key in KEYS:
        p.close(two[key] / one[key], 1., tolerance, f"{what}: {key}")


def solve(scene, settings, ranks=0):
    return p.solve_with(scene, {**QUIET, **settings}, ranks)


# The slot that closes, from an open one on, whose two faces do not match.
LIPS = {"Pair 1/Secondary": "1: 1", "Pair 1/Primary": "1: 2"}
# The closed end of the slot is part of the surface there, and turns the normal
# of the nodes that it shares with the faces.
TURNED = {"node to segment": 1e-3, "penalty": 1e-6}
for settings in p.some([
        {"Method/Discretisation": "dual mortar"},
        {"Method/Discretisation": "node to segment"},
        {"Refinement/Level": 2, "Refinement/Adaptive cycles": 3},
        {"Method/Discretisation": "mortar"},
        {"Solid/Degree": 2, "Refinement/Level": 3},
        {"Method/Enforcement": "penalty"}], 3):
    one, rows = solve("self-contact.prm", settings)
    two, _ = solve("self-contact.prm", {**settings, **LIPS})
    same(two, one, f"slot, {settings}",
         max(TURNED.get(value, 1e-9) for value in settings.values()))
    p.expect(one["force_imbalance"] < 1e-11,
             f"slot, {settings}: {one['force_imbalance']}")
    if not settings.get("Refinement/Adaptive cycles"):
        p.expect(one["active"] < one["constraints"],
                 f"slot, {settings}: closed altogether")
first, _ = solve("self-contact.prm", {})
for ranks in p.some([3, 2]):
    same(first, solve("self-contact.prm", {}, ranks)[0], f"{ranks} ranks", 1e-8)


# A slot of rubber that closes and shears: its faces slide on each other by some
# facets, and meet others than they were opposite to. They are what the answer
# knows of as one surface as well as two.
FACES = {"Pair 1/Secondary": "1: 1, 2", "Pair 1/Primary": "1: 1, 2"}
RUBBER = {"Body 1/Material": "neo-hooke", "Body 1/Young modulus": 1,
          "Body 1/Pressure": "", "Refinement/Level": 3,
          "Body 1/Prescribed displacement": "4: 0, 0; 5: 0.2*t, -0.06*t",
          "Time stepping/Number of steps": 6, "Method/Contact geometry": "current"}
for settings in p.some([
        {}, {"Method/Enforcement": "penalty", "Pair 1/Friction": 0.3},
        {"Method/Discretisation": "node to segment"}], 2):
    one, rows = solve("self-contact.prm", {**RUBBER, **FACES, **settings})
    two, _ = solve("self-contact.prm", {**RUBBER, **LIPS, **settings})
    same(two, one, f"sheared slot, {settings}")
    p.close(one["pair_1_slip"], two["pair_1_slip"], 1e-9,
            f"sheared slot, {settings}: slip")
    p.expect(one["elements_exchanged"] == two["elements_exchanged"] > 50
             and one["pair_1_slip"] > 2 * 0.75 / 24,
             f"sheared slot, {settings}: does not slide")
    if not settings:
        same(one, solve("self-contact.prm", {**RUBBER, **FACES}, 2)[0],
             "sheared slot, 2 ranks", 1e-8)


# Closed form: two blocks of 3 and 4 cells, one on the other, in one file. The
# sides that meet are one surface. On a height of 2 the strain is uniform, and
# the stress is E / (1 - nu^2) times it, whatever meets whatever.
def layer(cells, low, high, first):
    """Nodes and cells of a row of cells, of width 1."""
    nodes = [(k / cells, y) for y in (low, high) for k in range(cells + 1)]
    above = first + cells + 1
    return nodes, [(first + k, first + k + 1, above + k + 1, above + k)
                   for k in range(cells)]


def blocks():
    """Text of a mesh file."""
    nodes, cells = [], []
    for number, low in ((3, 0), (4, 1)):
        new = layer(number, low, low + 1, len(nodes) + 1)
        nodes += new[0]
        cells += new[1]
    return ucd(nodes, [(0, "quad", *cell) for cell in cells])


p.write("blocks.inp", blocks())
SIDES = {"Body 1/Mesh/File": p.folder / "blocks.inp",
         "Body 1/Mesh/Boundary ids": "1: abs(y - 1) < 1e-6; 2: x < 1e-6; "
                                     "4: y < 1e-6; 5: y > 1.999999",
         "Body 1/Prescribed displacement": "2: 0, free; 4: free, 0; 5: free, -0.02",
         "Body 1/Pressure": "",
         "Pair 1/Secondary": "1: 1", "Pair 1/Primary": "1: 1",
         "Output/Points": "1: 1, 2", "Refinement/Level": 1}
for settings in ({"Method/Discretisation": "dual mortar"},
                 {"Method/Discretisation": "mortar"}):
    summary, _ = solve("self-contact.prm", {**SIDES, **settings})
    for key in ("contact_force", "pair_1_pressure"):
        p.close(summary[key], 1000. / (1 - 0.3**2) * 0.01, 1e-9,
                f"blocks, {settings}: {key}")
    p.close(summary["point_1"][0], 0.3 / (1 - 0.3) * 0.01, 1e-9,
            f"blocks, {settings}: widening")

# A soft ring is pressed flat between two planes until its inside meets. All of that
# is one surface: what is opposite sees each other, however many facets there are
# around. What is pressed inside is below what the planes press with.
def plane(number, y, normal, motion):
    return section(f"Obstacle {number}", "Kind = plane", f"Point = 0, {y}",
                   f"Normal = 0, {normal}", *motion)


for cells in p.some([28, 24]):
    p.write("ring.prm", solid(
        2, section("Body 1", section(
            "Mesh", "Generator = hyper_shell",
            f"Arguments = 0, 0 : 0.7 : 1 : {cells} : true"),
            "Material = neo-hooke", "Young modulus = 1", "Poisson ratio = 0.3"),
        section("Pair 1", "Secondary = 1: 0", "Primary = 1: 0", "Reach = 1.5"),
        plane(1, -1, 1, []), plane(2, 1, -1, ["Motion = 0, -1.5*t"]),
        *[section(f"Pair {n + 1}", "Secondary = 1: 1", f"Obstacle = {n}",
                  "Friction = 0.3") for n in (1, 2)],
        section("Load steps", "Steps = 19", "End time = 0.95"),
        section("Refinement", "Level = 1"), bodies=1, obstacles=2
        ).replace("Pairs = 1", "Pairs = 3"))
    summary, _ = solve(p.folder / "ring.prm", {})
    inside, below, above = (abs(summary[f"pair_{n}_force"][1])
                            for n in (1, 2, 3))
    p.expect(0.01 * below < inside < below,
             f"ring of {cells} cells: {inside} inside, {below} below")
    p.close(above, below, 1e-6, f"ring of {cells} cells: above and below")


# Its sides are found as they close: pressed along any direction, in equilibrium
# and in motion, without a reach, it gives the figures of two halves with ids of
# their own, which were split where it is pressed.
def crushed(degrees, halves, *loads, density=0):
    """A ring between two planes that come together along a direction."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    along = f"({c!r}*y - ({s!r})*x)"
    return solid(
        2, section("Body 1", section(
            "Mesh", "Generator = hyper_shell",
            "Arguments = 0, 0 : 0.7 : 1 : 28 : true",
            f"Boundary ids = 2: x^2 + y^2 < 0.6 && {along} < 0; "
            f"3: x^2 + y^2 < 0.6 && {along} >= 0"),
            "Material = neo-hooke", "Young modulus = 1", "Poisson ratio = 0.3",
            f"Density = {density}"),
        section("Pair 1", f"Secondary = 1: {halves[0]}",
                f"Primary = 1: {halves[1]}"),
        *[section(f"Obstacle {n}", "Kind = plane",
                  f"Point = {s * sign!r}, {-c * sign!r}",
                  f"Normal = {-s * sign!r}, {c * sign!r}",
                  f"Motion = {-0.75 * s * sign!r}*t, {0.75 * c * sign!r}*t")
          for n, sign in ((1, 1), (2, -1))],
        *[section(f"Pair {n + 1}", "Secondary = 1: 1", f"Obstacle = {n}")
          for n in (1, 2)],
        *loads, section("Refinement", "Level = 1"), bodies=1, obstacles=2
        ).replace("Pairs = 1", "Pairs = 3")


RESTS = [section("Load steps", "Steps = 19", "End time = 0.95")]
MOVES = [section("Time", "Scheme = newmark", "Step = 0.05", "End = 0.95")]
for degrees, loads, density in p.some([
        (90, RESTS, 0), (30, MOVES, 0.01), (45, RESTS, 0), (90, MOVES, 0.01)],
        2):
    found = []
    for halves in (("2", "3"), ("2, 3", "2, 3")):
        p.write("crushed.prm", crushed(degrees, halves, *loads,
                                       density=density))
        # Friction would hold the ring in equilibrium; planes do not.
        found.append(solve(p.folder / "crushed.prm", {} if density else {
            "Pair 2/Friction": 0.3, "Pair 3/Friction": 0.3})[0])
    two, one = found
    p.expect(one["active"] == two["active"] > 30,
             f"crushed along {degrees}: {one['active']}, {two['active']}")
    for key in ("energy", "contact_force", "pair_1_pressure"):
        p.close(one[key] / two[key], 1., 1e-10,
                f"crushed along {degrees}, density {density}: {key}")
    p.close(math.hypot(*one["pair_1_force"]) / math.hypot(*two["pair_1_force"]),
            1., 1e-10, f"crushed along {degrees}, density {density}: force")

# So are those of a slot, out of a reach that is too small.
one, _ = solve("self-contact.prm", {"Pair 1/Reach": 0.001,
                                    "Refinement/Level": 5})
two, _ = solve("self-contact.prm", {"Pair 1/Reach": 0.001,
                                    "Refinement/Level": 5, **LIPS})
same(two, one, "slot out of reach")

# Three flanks that close on each other cannot be on two sides for ever: that
# ends without an answer, by nodes without a partner, or where partners stay those
# of the reference configuration by slides of more than a facet. A triangular hole
# is closed from all sides.
N, H = 6, math.sqrt(3) / 2


def flanks(size):
    corners = [(0, 0), (1, 0), (0.5, H)]
    for k, (x, y) in enumerate(corners):
        for i in range(N):
            t, (v, w) = i / N, corners[(k + 1) % 3]
            yield (0.5 + size * ((1 - t) * x + t * v - 0.5),
                   H / 3 + size * ((1 - t) * y + t * w - H / 3))


points = [point for size in (1, 1.25, 1.5, 2) for point in flanks(size)]
rows = [[3 * N * ring + i + 1 for i in (*range(3 * N), 0)] for ring in range(4)]
quads = [(a[i], b[i], b[i + 1], a[i + 1])
         for a, b in zip(rows, rows[1:]) for i in range(3 * N)]
p.write("hole.inp", ucd(points, [(0, "quad", *quad) for quad in quads]))
inside = f"(x - 0.5)^2 + (y - {H / 3!r})^2"
p.write("hole.prm", solid(
    2, section("Body 1", section(
        "Mesh", "File = hole.inp",
        f"Boundary ids = 1: {inside} < 0.36; 2: {inside} >= 0.36"),
        "Material = neo-hooke", "Young modulus = 1", "Poisson ratio = 0.3",
        f"Support = 2: -0.75*t*(x - 0.5), -0.75*t*(y - {H / 3!r})"),
    section("Pair 1", "Secondary = 1: 1", "Primary = 1: 1", "Reach = 1"),
    section("Load steps", "Steps = 4", "Smallest step = 0.1"),
    section("Refinement", "Level = 1"), bodies=1))
for sliding, why in (("small", "ABUT-F36"), ("large", "ABUT-F24")):
    result = p.call("run", "hole.prm", "--output", "out", "--quiet", "--set",
                    f"Method/Contact geometry={sliding}")
    p.expect(result.returncode == 3 and why in result.stderr,
             f"hole, {sliding}: {result.stderr}")

# Friction: what two surfaces of their own have, and in the blocks, whose upper
# one is moved aside until all of it slides, mu times the pressure.
MU = 0.02
RUBS = {"Pair 1/Friction": MU, "Refinement/Level": 3}
for law in p.some(["penalty", "augmented lagrangian"]):
    rubs = {**RUBS, "Method/Enforcement": law}
    one, _ = solve("self-contact.prm", rubs)
    two, _ = solve("self-contact.prm", {**rubs, **LIPS})
    same(two, one, f"slot with friction, {law}", 1e-6)
    for key in ("pair_1_friction_force", "dissipation"):
        p.close(one[key] / two[key], 1., 1e-4, f"slot, {law}: {key}")
    p.expect(0 < one["pair_1_slipping"] < one["active"],
             f"slot, {law}: {one['pair_1_slipping']} slip")
    p.expect(one["dissipation"] > 0, f"slot, {law}: no dissipation")
    p.expect(0 < one["pair_1_friction_force"]
             <= MU * one["pair_1_normal_force"] * (1 + 1e-9),
             f"slot, {law}: more friction than the pressure allows")
    slides, _ = solve("self-contact.prm", {
        **SIDES, **rubs, "Refinement/Level": 1,
        "Body 1/Prescribed displacement": "4: 0, 0; 5: 0.1, -0.02",
        "Solid/Accept strains beyond linear theory": "true"})
    p.expect(slides["pair_1_slipping"] == slides["active"] > 0,
             f"blocks, {law}: {slides['pair_1_slipping']} slip of "
             f"{slides['active']}")
    p.close(slides["pair_1_friction_force"] / slides["pair_1_normal_force"],
            MU, 1e-9, f"blocks, {law}: T/N")


# Mistakes.
def refused(*settings):
    return p.call("run", p.source / "prm/self-contact.prm", "--output", "out",
                  "--quiet", *set_words(settings))


p.expect_error(refused("Pair 1/Friction=0.3"), "Pair 1/Friction",
               "touches itself", "penalty")
p.expect_error(refused("Pair 1/Tied=true"), "Pair 1/Secondary",
               "tied to itself")
p.expect_error(refused("Pair 1/Primary=1: 1, 2"), "Pair 1/Primary",
               "on both sides of the pair")
p.finish()
