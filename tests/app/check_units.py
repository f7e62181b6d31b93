# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene in other units of length and force gives the same answer by the same
number of steps, with every law: x and u in thousandths, forces in millions."""
from program import Program

LENGTH, FORCE = 1e3, 1e-6
p = Program()
scene = "step-41.prm"


def steps(value):
    """The obstacle of the scene, lengths times value."""
    a, b, c, d, half = (value * x for x in (-0.2, -0.4, -0.6, -0.8, 0.5))
    return f"if(x<{-half}, {a}, if(x<0, {b}, if(x<{half}, {c}, {d})))"


other = {
    "Mesh/Arguments": f"{-LENGTH} : {LENGTH} : false",
    # Force per length of the edge over strain; force per area.
    "Membrane/Conductivity": FORCE / LENGTH,
    "Membrane/Body force": -10 * FORCE / LENGTH**2,
    "Contact/Obstacle": steps(LENGTH),
}

for law in ("lagrange", "penalty", "quadratic penalty", "augmented lagrangian",
            "barrier", "interior point"):
    for nested in ("true", "false"):
        settings = {"Method/Enforcement": law, "Refinement/Level": 6,
                    "Refinement/Nested iteration": nested,
                    "Output/Fields": "false", "Output/Pictures": "false"}
        one, one_levels = p.solve_with(scene, settings)
        two, two_levels = p.solve_with(scene, {**settings, **other})
        what = f"{law}, nested {nested}"
        p.expect(one["active"] == two["active"],
                 f"{what}: {one['active']} and {two['active']} in contact")
        for a, b in zip(one_levels, two_levels):
            p.expect(abs(a["steps"] - b["steps"]) <= 1,
                     f"{what}, level {a['level']}: {a['steps']} and "
                     f"{b['steps']} steps")
        p.close(two["energy"] / (FORCE * LENGTH), one["energy"], 1e-8,
                f"{what}: energy")
        p.close(two["contact_force"] / FORCE, one["contact_force"], 1e-8,
                f"{what}: force")
p.finish()
