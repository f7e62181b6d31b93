# SPDX-License-Identifier: LGPL-2.1-or-later
"""Two rings pressed into each other, in mm and N and in m and N: the same
answer by the same number of steps, with every law. In units that are powers of
two there is not even another round-off: a disc in rubber with friction, by rows
and by saddle points, and a mass that strikes a bar give the same digits."""
from program import Program, set_words

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


def numbers(factor, *values):
    return ", ".join(repr(factor * value) for value in values)


def disc(length, stress, _, method):
    """Pressed into rubber and drawn aside, by points that move."""
    return "finite-disc.prm", {
        "Body 1/Mesh/Arguments": f"0 : {length} : true",
        "Body 1/Young modulus": stress,
        "Obstacle 1/Centre": numbers(length, 0, 2),
        "Obstacle 1/Radius": length,
        "Obstacle 1/Motion": f"{0.05 * length}*t, {-0.1 * length}*t",
        "Body 1/Prescribed displacement": "2: 0, 0", "Pair 1/Friction": "0.3",
        "Time stepping/Number of steps": 4, "Refinement/Level": 3,
        "Method/Discretisation": method, "Output/Pictures": "false"}


def bar(length, stress, time, scheme):
    """Struck by an obstacle with a mass, which forces move."""
    density = stress * (time / length)**2
    return "struck-bar.prm", {
        "Body 1/Mesh/Arguments": f"30, 1 : 0, 0 : {numbers(length, 3, 1)}"
                                 " : true",
        "Body 1/Young modulus": stress, "Body 1/Density": density,
        "Obstacle 1/Centre": numbers(length, -1, 0.5),
        "Obstacle 1/Size": numbers(length, 2, 4),
        "Obstacle 1/Mass": 2 * density * length**2,
        "Obstacle 1/Initial velocity": numbers(length / time, 0.01, 0),
        "Time stepping/Scheme": scheme, "Time stepping/Step size": 0.05 * time, "Time stepping/End time": time}


for scene, what in ((disc, "auto"), (disc, "mortar"), (bar, "hht"),
                    (bar, "contact stabilised")):
    runs = []
    for length, stress, time in ((1, 1, 1), (2.**-10, 2.**20, 2.**-5),
                                 (2.**14, 2.**-30, 2.**10)):
        name, settings = scene(length, stress, time, what)
        summary, _ = p.solve_with(name, {**settings, "Output/Points": "",
                                         "Output/Fields": "false"})
        runs.append((summary["nonlinear_iterations"],
                     summary["contact_force"] / (stress * length),
                     summary["deformation"] / length))
    for run in runs[1:]:
        p.expect(run == runs[0], f"{name}, {what}: {run} and {runs[0]}")

# Loads are as small as numbers may be whose squares are more than 0.
def bent(force, code=0):
    """Deflection of the cantilever, and what is said."""
    result = p.call("run", p.source / "prm/cantilever.prm", "--output", "out",
                    "--quiet", "--set", f"Body 1/Traction=1: 0, {force}*(1-y^2)",
                    "--set", "Output/Fields=false")
    p.expect(result.returncode == code, f"{force}: {result.returncode}")
    return p.results()[0]["point_1"][1], result.stderr


one, _ = bent(1.)
for force in 1e-90, 1e-140:
    p.close(bent(force)[0] / force / one, 1., 1e-8, f"deflection by {force}")
for force in 1e-165, 1e-310:
    _, said = bent(force, code=3)
    p.expect("other units of loads" in said, f"{force}: {said}")
# Beside other loads they are nothing, and no error.
small, _ = p.solve_with("dragged-block.prm", {"Body 1/Pressure": "1: 1e-300"})
none, _ = p.solve_with("dragged-block.prm", {})
p.close(small["contact_force"], none["contact_force"], 1e-12, "a load of 1e-300")

# Files of fields have seven digits, the solution has all.
for place, is_far in (0, False), (1e4, False), (1e6, True):
    where = {f"Body {body}/Mesh/Move": f"{place}, 0, {body - 1}"
             for body in (1, 2)}
    settings = {"Refinement/Level": "1", **where}
    for fields in "true", "false":
        result = p.call("run", p.source / "prm/two-blocks-3d.prm", "--output",
                        "out", *set_words({**settings, "Output/Fields": fields}))
        p.expect(result.returncode == 0, result.stderr)
        p.expect(("seven digits" in result.stderr)
                 == (is_far and fields == "true"), f"{place}: {result.stderr}")
    force = p.results()[0]["contact_force"]
    near = force if place == 0 else near
    p.close(force / near, 1., 1e-8, f"force at {place}")

# Nor do they hold numbers beyond 1e38 or below 1e-38.
one, _ = p.solve_with("parabola.prm", {})
for stiffness, words in ((1, []), (1e36, []),
                         (1e60, ["infinite", "stress", "traction"]),
                         (1e-60, ["are 0", "traction (6.6e-62)"])):
    for fields in "true", "false":
        result = p.call("run", p.source / "prm/parabola.prm", "--output", "out",
                        "--quiet", "--set", f"Body 1/Young modulus={stiffness}",
                        "--set", f"Output/Fields={fields}")
        p.expect(result.returncode == 0, result.stderr)
        told = fields == "true" and words
        p.expect(all(word in result.stderr for word in words) if told
                 else "files of fields" not in result.stderr.lower(),
                 f"{stiffness}: {result.stderr}")
    p.close(p.results()[0]["contact_force"] / stiffness / one["contact_force"],
            1., 1e-8, f"force with a stiffness of {stiffness}")
p.finish()
