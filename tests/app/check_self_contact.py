# SPDX-License-Identifier: LGPL-2.1-or-later
"""A surface that touches itself gives what the same mesh gives when its two
parts have boundary ids of their own, on any number of ranks."""
from program import Program, set_words

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
for settings in ({"Method/Discretisation": "dual mortar"},
                 {"Method/Discretisation": "mortar"},
                 {"Method/Discretisation": "node to segment"},
                 {"Solid/Degree": 2, "Refinement/Level": 3},
                 {"Method/Enforcement": "penalty"},
                 {"Refinement/Level": 2, "Refinement/Adaptive cycles": 3}):
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
for ranks in (2, 3):
    same(first, solve("self-contact.prm", {}, ranks)[0], f"{ranks} ranks", 1e-8)


# Mistakes.
def refused(*settings):
    return p.call("run", p.source / "prm/self-contact.prm", "--output", "out",
                  "--quiet", *set_words(settings))


p.expect_error(refused("Pair 1/Reach=0.001", "Refinement/Level=5"),
               "Pair 1/Secondary", "face each other", "reach")
p.expect_error(refused("Pair 1/Tied=true"), "Pair 1/Secondary",
               "tied to itself")
p.expect_error(refused("Pair 1/Primary=1: 1, 2"), "Pair 1/Primary",
               "on both sides of the pair")
p.finish()
