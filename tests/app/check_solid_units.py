# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two rings pressed into each other, in mm and N and in m and N: the same
answer by the same number of steps, with every law."""
from program import Program

# One unit of length of the scene as a number of the other system's.
LENGTH = 1e-3
p = Program()

other = {
    "Body 1/Mesh/Arguments": f"0, 0 : {LENGTH} : {2*LENGTH} : 4 : true",
    "Body 2/Mesh/Arguments": f"0, 0 : {2*LENGTH} : {3*LENGTH} : 3 : true",
    "Body 1/Young modulus": 1000 / LENGTH**2,
    "Body 2/Young modulus": 1000 / LENGTH**2,
    "Pair 1/Initial gap": -0.01 * LENGTH,
    "Output/Points": f"1: {LENGTH}, 0; 1: 0, {2*LENGTH}; 2: {3*LENGTH}, 0",
}

for law in ("lagrange", "penalty", "quadratic penalty", "augmented lagrangian",
            "barrier", "interior point", "nitsche"):
    tight = {"Method/Final linear tolerance": 1e-12}
    for what, extra in (("defaults", {}), ("tight", tight)):
        settings = {"Method/Enforcement": law, "Refinement/Level": 2,
                    "Output/Fields": "false", "Output/Pictures": "false",
                    **extra}
        one, one_levels = p.solve_with("press-fit.prm", settings)
        two, two_levels = p.solve_with("press-fit.prm", {**settings, **other})
        name = f"{law}, {what}"
        p.expect(one["active"] == two["active"],
                 f"{name}: {one['active']} and {two['active']} in contact")
        for a, b in zip(one_levels, two_levels):
            p.expect(abs(a["steps"] - b["steps"]) <= 1,
                     f"{name}, level {a['level']}: {a['steps']} and "
                     f"{b['steps']} steps")
        if extra:
            # Forces per length of the third direction, work per the same.
            p.close(two["contact_force"] * LENGTH / one["contact_force"], 1.,
                    1e-8, f"{name}: force")
            p.close(two["energy"] / one["energy"], 1., 1e-8, f"{name}: energy")
            p.close(two["point_1"][0] / LENGTH / one["point_1"][0], 1., 1e-8,
                    f"{name}: displacement")
p.finish()
