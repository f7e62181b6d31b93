# SPDX-License-Identifier: LGPL-2.1-or-later
"""The inf-sup constants of the multipliers that are offered stay under
refinement; with more pressures than the surface has unknowns they are 0, and
the program refuses to take those as multipliers. Prints the table of
doc/inf-sup.md."""
import subprocess

from block_scene import block, pair, section, solid
from program import Program, set_words

p = Program()


def cube(dim, number, cells, support, below):
    """Unit cube with the contact surface on top, or below."""
    low, high = ("0" if below else "1"), ("1" if below else "2")
    first = ", ".join(["0"] * (dim - 1) + [low])
    last = ", ".join(["1"] * (dim - 1) + [high])
    far = 2 * dim - 2 if below else 2 * dim - 1
    zero = ", ".join(["0"] * dim)
    load = [] if below else [f"Pressure = {far}: 0.01"]
    sides = ", ".join(map(str, range(2 * dim - 2)))
    held = f"{far}: {zero}" if below else ""
    if support == "clamped":
        held += f"{'; ' if held else ''}{sides}: {zero}"
    elif not below:
        sideways = ", ".join(["0"] * (dim - 1) + ["free"])
        held = f"{sides}: {sideways}"
    return block(number, f"{', '.join([str(cells)] * dim)} : {first} : {last} "
                 ": true", held, more=load)


def scene(dim, lower, upper, support):
    return p.write("blocks.prm", solid(
        dim, cube(dim, 1, lower, support, True),
        cube(dim, 2, upper, support, False),
        pair(f"2: {2 * dim - 2}", f"1: {2 * dim - 1}"),
        section("Output", "Fields = false", "Pictures = false")))


def run(name, **settings):
    return p.call("run", name, "--output", "out", "--quiet",
                  *set_words(settings))


def constants(what, dim, lower, upper, settings, level, support="slides"):
    """Of all meshes from level 0 on, and the constraints of the last one."""
    values = {"Refinement/Level": level, **settings}
    result = subprocess.run(
        [p.study, scene(dim, lower, upper, support),
         *(f"{path}={value}" for path, value in values.items())],
        cwd=p.folder, text=True, capture_output=True, timeout=600, check=False)
    p.expect(result.returncode == 0, f"{what}: {result.stderr}")
    lines = [line.split() for line in result.stdout.splitlines()]
    values = [float(constant) for constant, _ in lines]
    print(f"| {what} | " + ", ".join(f"{value:.3f}" for value in values)
          + " |", flush=True)
    return values, int(lines[-1][1])


def stays(what, *arguments, **more):
    """It tends to a limit above 0: what it loses from mesh to mesh dies away.
    A constant that falls like a power h^s of the mesh loses the same part each
    time; 3 % of it, h^0.05, count as none."""
    values, n_rows = constants(what, *arguments, **more)
    falls = [1 - fine / coarse for coarse, fine in zip(values, values[1:])]
    p.expect(values[-1] > 0.2 and len(falls) >= 2
             and (abs(falls[-1]) < 0.03 or falls[-1] < 0.75 * falls[-2]),
             f"{what}: {values}")
    return n_rows


def method(discretisation, degree=1, multipliers=None):
    settings = {"Method/Discretisation": discretisation,
                "Solid/Degree": degree}
    if multipliers is not None:
        settings["Method/Multiplier degree"] = multipliers
    return settings


for lower, upper in p.some(((2, 3), (1, 4), (4, 1))):
    for word in ("dual mortar", "mortar", "node to segment"):
        stays(f"Q1, {word}, {lower} cells under {upper}", 2, lower, upper,
              method(word), 4)
for word, multipliers in (("dual mortar", None), ("mortar", None),
                          ("mortar", 1)):
    stays(f"Q2, {word}" + (", linear" if multipliers else ""), 2, 2, 3,
          method(word, 2, multipliers), 3)
for degree in p.some((1, 2)):
    stays(f"Q{degree}, dual mortar, clamped at both ends", 2, 2, 3,
          method("dual mortar", degree), 4, support="clamped")
stays("Q1, mortar, clamped at both ends", 2, 2, 3, method("mortar"), 4,
      support="clamped")
for word in p.some(("dual mortar", "mortar")):
    stays(f"3D, Q1, {word}", 3, 2, 3, method(word), 2)
for word in p.some(("dual mortar", "mortar"), 0):
    n_rows = stays(
        f"3D, Q1, {word}, hanging nodes", 3, 2, 3,
        {**method(word), "Solid/Accept strains beyond linear theory": "true",
         "Refinement/Adaptive cycles": 3,
         "Refinement/Refine fraction": 0.5, "Refinement/Coarsen fraction": 0,
         "Body 2/Pressure": "5: exp(-20*(x^2 + y^2))"}, 0)
    p.expect(16 < n_rows < 49, f"refined in part: {n_rows} rows")

# More pressures than unknowns: allowed as springs only.
many, _ = constants("Q1, quadrature points (penalty)", 2, 2, 3,
                 {**method("quadrature point"),
                  "Method/Enforcement": "penalty"}, 2)
p.expect(max(many) < 1e-3, f"quadrature points: {many}")
p.expect_error(run(scene(2, 2, 3, "slides"),
                   **method("quadrature point")),
               "Pair 1", "more constraints than the surface has unknowns")
p.finish()
