# SPDX-License-Identifier: LGPL-2.1-or-later
"""Forces and moments on the two sides of a pair: round-off, but for the
moments of mortar on curved surfaces, which are of second order (the table in
doc/develop/coupling.md)."""
import math

from program import Program

p = Program()
QUIET = {"Output/Fields": "false", "Output/Pictures": "false",
         "Method/Final linear tolerance": 1e-13}
METHODS = {"node to segment": "lagrange", "quadrature point": "penalty",
           "mortar": "lagrange", "dual mortar": "lagrange"}
# A load on one half only: else both moments vanish by symmetry.
PRESS_FIT = {"Body 2/Pressure": "1: if(x > y, 20, 0)",
             "Refinement/Nested iteration": "false"}
TWO_CYLINDERS = {"Refinement/Adaptive cycles": 0,
                 "Refinement/Nested iteration": "false"}


def imbalances(scene, word, levels, settings):
    """Of forces and of moments, by level."""
    result = []
    for level in levels:
        summary, _ = p.solve_with(scene, {
            **QUIET, **settings, "Refinement/Level": level,
            "Method/Discretisation": word, "Method/Enforcement": METHODS[word]})
        result.append((summary["force_imbalance"],
                       summary["moment_imbalance"]))
    return result


for scene, levels, settings in (
        ("patch-2d.prm", (1,), {}),
        ("patch-3d.prm", (0,), {}),
        ("press-fit.prm", (1, 2, 3), PRESS_FIT),
        ("two-cylinders.prm", (3, 4, 5), TWO_CYLINDERS)):
    for word in METHODS:
        found = imbalances(scene, word, levels, settings)
        moments = [moment for _, moment in found]
        print(f"| {scene} | {word} | "
              + ", ".join(f"{moment:.1e}" for moment in moments) + " |")
        for (force, moment), level in zip(found, levels):
            what = f"{scene}, {word}, level {level}"
            p.expect(force <= 1e-11, f"{what}: forces differ by {force}")
            if scene.startswith("patch") or "mortar" not in word:
                p.expect(moment <= 1e-11,
                         f"{what}: moments differ by {moment}")
        if not scene.startswith("patch") and "mortar" in word:
            order = math.log2(moments[-2] / moments[-1])
            p.expect(1.7 < order, f"{scene}, {word}: moments of order {order}")

# Large strain: what mortar does at a disc and what holds the block are in balance
# where the block is.
summary, _ = p.solve_with("finite-disc.prm", {
    "Output/Pictures": "false", "Output/Nodal values": "true",
    "Refinement/Level": 3, "Method/Discretisation": "dual mortar"})
nodes = p.table("nodal.csv")
moment, there = (sum(
    (n["x"] + part * n["displacement_x"]) * n["reaction_y"]
    - (n["y"] + part * n["displacement_y"]) * n["reaction_x"]
    for n in nodes) for part in (1., 0.))
print("large strain: moments", summary["pair_1_moment"], moment, there)
p.close(summary["pair_1_moment"][2], -moment, 1e-6,
        "moment where the block is")
p.expect(abs(there - moment) > 1e-3 * abs(moment),
         "undeformed places are no others")
p.finish()
