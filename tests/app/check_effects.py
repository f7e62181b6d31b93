# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a scene sets has an effect, or is refused by name, or is listed as not
used; data that cannot be computed with are refused before anything is."""

from program import Program, set_words

p = Program()


def refused(scene, settings, *words):
    """`abut run` ends with one error that names the last setting and says
    the words."""
    if not isinstance(settings, dict):
        settings = dict([settings])
    path = p.source / "prm" / scene
    result = p.call("run", path, "--output", "out", *set_words(settings))
    p.expect_error(result, list(settings)[-1] + ": ", *words)


# Data of the problem without effect.
NO_EFFECT = "has no effect"
refused("pipe.prm", ("Solid/Gravity", "0, -10"), NO_EFFECT, "Body 1/Density")
refused("tied-beam.prm", ("Pair 1/Initial gap", "0.1"), NO_EFFECT, "tied")
refused("tied-beam.prm", ("Pair 1/Use mesh gap", "false"), NO_EFFECT, "tied")
refused("step-41.prm", ("Membrane/Body force", "-10*t"), NO_EFFECT, "t is always 0")
refused("step-41.prm", ("Contact/Obstacle", "-0.5 - t"), NO_EFFECT)
refused("step-41.prm", ("Membrane/Prescribed displacement", "*: t"), NO_EFFECT)
refused("step-41.prm", ("Method/Multiplier degree", "1"), NO_EFFECT)
refused("step-41.prm", ("Exact solution/Gradient", "0; 0"), NO_EFFECT)
refused("step-41.prm", ("Contact/Height map lowest", "-1"), NO_EFFECT)
refused("step-41.prm", {"Mesh/Arguments": "-1 : 1 : true",
                        "Membrane/Prescribed displacement": "0: 0",
                        "Membrane/Traction": "0: 1"}, "boundary 0", NO_EFFECT)
refused("signorini.prm", {"Membrane/Prescribed displacement": "0, 1, 2, 3: 0",
                          "Contact/Boundary ids": "0"}, NO_EFFECT)
refused("two-blocks-3d.prm", ("Refinement/Relaxation sweeps", "5"), NO_EFFECT)
refused("two-blocks-3d.prm", ("Search/Extension", "0.5"), NO_EFFECT)
refused("two-blocks-3d.prm", ("Search/Self contact", "true"), NO_EFFECT)
refused("two-blocks-3d.prm", {"Search/Algorithm": "all pairs",
                              "Search/Bucket size": "3"}, NO_EFFECT, "buckets")
refused("two-blocks-3d.prm", {"Search/Algorithm": "uniform buckets",
                              "Search/Bucket capacity": "3"}, NO_EFFECT)
refused("two-blocks-3d.prm", ("Method/Multiplier degree", "1"), NO_EFFECT)
refused("two-blocks-3d.prm", ("Solid/Plane", "stress"), NO_EFFECT)
refused("two-blocks-3d.prm", ("Solid/Obstacles", "1"), NO_EFFECT, "obstacle 1")
refused("two-blocks-3d.prm", ("Search/Thickness", "77: 1"), "77")
refused("two-blocks-3d.prm", {"Solid/Pairs": "2", "Pair 2/Primary": "1: 5",
                              "Pair 2/Secondary": "2: 4, 5"},
        "in pair 'Pair 1' and")
refused("rigid-plate.prm", {"Solid/Pairs": "2", "Pair 2/Obstacle": "1",
                            "Method/Enforcement": "penalty",
                            "Pair 2/Secondary": "1: *"}, "in pair 'Pair 1' and")
refused("rigid-plate.prm", ("Obstacle 1/Rotation centre", "1, 0"), NO_EFFECT,
        "Rotation angle")
refused("parabola-friction.prm", ("Obstacle 1/Gradient", "x; 0"), NO_EFFECT,
        "along the axis")
for gradient in ("1.3*x; 0", "-x; 0"):
    p.expect_error(p.call("run", p.source / "prm/finite-parabola.prm",
                          "--output", "out", "--set",
                          f"Obstacle 1/Gradient={gradient}"), "Obstacle 1",
                   "Gradient is (", "where Expression changes by")
refused("pipe.prm", {"Body 1/Prescribed displacement": "0: 0, 0; 2: free, 0; 3: 0, free",
                     "Body 1/Pressure": "0: 1"}, "boundary 0", NO_EFFECT,
        "Body 1/Prescribed displacement")
refused("pipe.prm", ("Pair 1/Secondary", "1: 0"), "Solid/Pairs is 0",
        "set it to 1")
refused("pipe.prm", ("Obstacle 2/Kind", "box"), "Solid/Obstacles is 0",
        "set it to 2")
refused("search-flat.prm", {"Search/Self contact": "true",
                            "Primary/Move": "0, 0, 1"}, NO_EFFECT)

# Settings of what a run does not use: listed, and refused from `--set`.
refused("step-41.prm", ("Method/Barrier factor", "0.5"), NO_EFFECT, "barrier")
refused("step-41.prm", ("Method/Segments", "false"), NO_EFFECT, "nodes")
result = p.call("check", p.source / "prm/step-41.prm", "--set-if-used",
                "Method/Barrier factor=0.5")
p.expect(result.returncode == 0, f"--set-if-used: {result.stderr}")
text = (p.source / "prm/point-mass.prm").read_text()
p.write("unused.prm", text + "\nsubsection Method\n  set Barrier factor = 0.5\n"
        "  set Enforcement = lagrange\nend\n")
result = p.call("run", "unused.prm", "--output", "out", "--verbose")
p.expect(result.returncode == 0, f"unused setting of a file: {result.stderr}")
summary = p.summary()
p.expect(summary["not_used"] == ["Method/Barrier factor: it belongs to "
                                 "Method/Enforcement = barrier."],
         f"not_used is {summary['not_used']}")
p.expect("Not used" in result.stdout, "the report does not list what it has "
         "not used")

# Ends of ranges.
for name in ("Penalty growth", "Barrier factor", "Linear tolerance",
             "Final linear tolerance"):
    refused("step-41.prm", (f"Method/{name}", "1"), "'1' is not a number")
refused("failures/floating-pulled.prm", ("Time stepping/Smallest step", "0"),
        "above 0")

# Formulas without a value somewhere.
refused("step-41.prm", ("Membrane/Prescribed displacement", "*: sqrt(x)"),
        "'sqrt(x)'", "not a number", "at the point (-1, ")
refused("pipe.prm", ("Body 1/Pressure", "0: 1e200"), "too large")
refused("pipe.prm", {"Body 1/Traction": "0: 1, 1e200"}, "too large")
HEIGHT = {"Obstacle 1/Point": "", "Obstacle 1/Normal": "",
          "Obstacle 1/Kind": "height", "Obstacle 1/Axis": "0, -1"}
refused("rigid-plate.prm", {**HEIGHT, "Obstacle 1/Expression": "1 + 0.1*y"},
        "depends on y")
refused("rigid-plate.prm",
        {**HEIGHT, "Obstacle 1/Expression": "1.2 - sqrt(0.3 - x)"},
        "not a number", "at the point")

# Geometry.
refused("pipe.prm", {
    "Solid/Plane": "axisymmetric", "Exact solution/Displacement": "",
    "Body 1/Mesh/Generator": "hyper_rectangle", "Output/Points": "",
    "Body 1/Prescribed displacement": "2, 3: free, 0",
    "Body 1/Mesh/Arguments": "-1, 0 : 2, 1 : true"}, "negative radius")
p.write("concave.inp", "4 1 0 0 0\n1 0 0 0\n2 1 0 0\n3 0.2 0.2 0\n4 0 1 0\n"
        "1 0 quad 1 2 3 4\n")
p.write("concave.prm", "set Scene = solid\nsubsection Body 1\n subsection Mesh"
        "\n  set File = concave.inp\n end\n set Support = 0: 0, 0\nend\n")
p.expect_error(p.call("run", "concave.prm"), "concave.prm:4", "concave")
p.write("huge.pgm", "P5 100000 100000 255\n")
refused("height-map.prm", ("Contact/Height map", p.folder / "huge.pgm"),
        "truncated")
refused("cantilever.prm", ("Refinement/Level", "30"), "unknowns")
refused("cantilever.prm",
        ("Body 1/Mesh/Arguments", "60000, 60000 : 0, 0 : 1, 1 : true"),
        "unknowns")
refused("cantilever.prm", {
    "Body 1/Mesh/Generator": "subdivided_hyper_rectangle",
    "Body 1/Mesh/Arguments": "2, 1 : 0, 0 : 2, 1"},
    "needs 4, repetitions : p1 : p2 : colorize; 3 are given")
refused("cantilever.prm",
        ("Body 1/Mesh/Arguments", "2, 1, 5 : 0, 0 : 2, 1 : true"),
        "3 repetitions for 2 directions")
refused("cantilever.prm",
        ("Body 1/Mesh/Arguments", "2 : 0, 0 : 2, 1 : true"),
        "1 repetitions for 2 directions")
refused("cantilever.prm",
        ("Body 1/Mesh/Arguments", "1.4, 1 : 0, 0 : 2, 1 : true"),
        "'1.4' is not a number of repetitions")

# Found before the solve, by `abut check` too.
for command in "run", "check":
    for points in "1: 0", "1: 0, 1000", "7: 0, 0":
        result = p.call(command, p.source / "prm/cantilever.prm", "--set",
                        f"Output/Points={points}", "--output", "out")
        p.expect_error(result, "Output/Points")
        p.expect("linear iterations" not in result.stdout,
                 f"{points}: found after a solve")
p.write("in-the-way", "")
p.expect_error(p.call("check", p.source / "prm/cantilever.prm", "--output",
                      "in-the-way/x"), "output folder")

# Boundary ids with their faces and places.
result = p.call("check", p.source / "prm/pipe.prm")
p.expect("body 1, boundary 2: 1 face, length 1, x = 0, y from 1 to 2" in result.stdout,
         result.stdout)

# Differences of a formula are as exact for a small pipe as for a large one.
errors = []
for size in 1., 1e-6:
    summary, _ = p.solve_with("pipe.prm", {
        "Refinement/Level": 2, "Output/Fields": "false", "Output/Points": "",
        "Body 1/Mesh/Arguments": f"0, 0 : {size} : {2 * size} : 3 : true",
        "Exact solution/Displacement": ", ".join(
            f"1.3/3*(0.4+4*{size}^2/(x^2+y^2))*{x}" for x in "xy")})
    errors.append(summary["h1_error"] / size)
p.close(errors[1], errors[0], 1e-6, "h1_error of a small pipe by its size")

p.finish()
