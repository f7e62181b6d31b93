# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a result must not depend on: which side of a pair is the secondary (but
for the error of the discretisation), the order of the unknowns, the number of
ranks. Part 1: the sides; part 2: order and ranks."""
from program import Program

p = Program()
QUIET = {"Output/Fields": "false", "Output/Pictures": "false"}
TIGHT = {"Method/Final linear tolerance": 1e-12, "Method/Gap tolerance": 1e-10}
SWAPPED = {"press-fit.prm": {"Pair 1/Secondary": "2: 0",
                             "Pair 1/Primary": "1: 1"},
           "two-cylinders.prm": {"Pair 1/Secondary": "1: 0",
                                 "Pair 1/Primary": "2: 0"}}


def size(value):
    return max(map(abs, value)) if isinstance(value, list) else abs(value)


def difference(one, two, key):
    """Largest difference of a result, relative to its size."""
    a, b = one[key], two[key]
    if isinstance(a, list):
        return max(abs(x - y) for x, y in zip(a, b)) / size(a)
    return abs(a - b) / size(a)


def same(one, two, keys, what):
    p.expect(one["active"] == two["active"],
             f"{what}: {one['active']} and {two['active']} in contact")
    for key in keys:
        p.expect(difference(one, two, key) <= 1e-8,
                 f"{what}: {key} is {one[key]} and {two[key]}")


KEYS = ("energy", "contact_force", "reaction_1", "pair_1_pressure")


def exchange_sides():
    """Secondary and primary exchanged: the difference falls with the square of
    the facet size, as the error does, and is not larger than that."""
    for word in p.some(("dual mortar", "mortar")):
        last = None
        for level in p.some((1, 2, 3), 2):
            settings = {**QUIET, "Method/Discretisation": word,
                        "Refinement/Level": level}
            one, _ = p.solve_with("press-fit.prm", settings)
            two, _ = p.solve_with("press-fit.prm",
                                  {**settings, **SWAPPED["press-fit.prm"]})
            exact = {"contact_force": 4.045663, "point_1": [-0.003125, 0.],
                     "point_3": [0.005625, 0.]}
            error = max(difference(exact, run, key) for key in exact
                        for run in (one, two))
            change = max(difference(one, two, key) for key in exact)
            print(f"press fit, {word}, level {level}: error {error:.2e}, sides "
                  f"exchanged {change:.2e}")
            p.expect(change <= error, f"{word}, level {level}: {change} by "
                     f"exchanging sides, error {error}")
            p.expect(last is None or change < last / 3.,
                     f"{word}: exchanging sides changes {last}, then {change}")
            last = change
        settings = {**QUIET, "Method/Discretisation": word,
                    "Refinement/Adaptive cycles": 2 if p.short else 4}
        one, rows = p.solve_with("two-cylinders.prm", settings)
        two, _ = p.solve_with("two-cylinders.prm",
                              {**settings, **SWAPPED["two-cylinders.prm"]})
        error = abs(rows[-1]["energy"] / rows[-2]["energy"] - 1.)
        change = difference(one, two, "energy")
        print(f"two cylinders, {word}: energy of the last two meshes "
              f"{error:.2e}, sides exchanged {change:.2e}")
        p.expect(change <= error, f"two cylinders, {word}: {change}, {error}")
        p.close(two["contact_force"] / one["contact_force"], 1., 2e-3,
                f"two cylinders, {word}: force with sides exchanged")


def renumber_and_distribute():
    for scene, settings in p.some((
            ("press-fit.prm", {"Refinement/Level": 3}),
            ("press-fit.prm", {"Refinement/Level": 2, "Solid/Degree": 2,
                               "Method/Discretisation": "mortar"}),
            ("two-cylinders.prm", {"Refinement/Adaptive cycles": 2}),
            ("patch-3d.prm", {"Refinement/Level": 1}))):
        settings = {**QUIET, **TIGHT, **settings}
        one, _ = p.solve_with(scene, settings)
        for order, ranks in p.some((("Cuthill-McKee", 3), ("Cuthill-McKee", 1),
                                    ("none", 2), ("none", 3))):
            two, _ = p.solve_with(
                scene, {**settings, "Refinement/Renumber": order}, ranks)
            same(one, two, KEYS,
                 f"{scene}, {settings}, order {order}, {ranks} ranks")


if p.part == 1:
    exchange_sides()
else:
    renumber_and_distribute()
p.finish()
