# SPDX-License-Identifier: LGPL-2.1-or-later
"""No more than a scene needs: what runs leave out, what they say about it, and
what `Enforcement = auto` takes."""

from program import Program, set_words

p = Program()


def run(scene, settings=None, *words, code=0):
    """Summary, meshes and output of a run."""
    arguments = set_words({"Output/Fields": "false",
                           "Output/Pictures": "false", **(settings or {})})
    result = p.call("run", p.source / "prm" / (scene + ".prm"), "--output",
                    "out", *arguments, *words)
    p.expect(result.returncode == code,
             f"{scene}: exit code {result.returncode}\n{result.stderr}")
    return *p.results(), result.stdout


def integers(meshes, key):
    return [int(mesh[key]) for mesh in meshes]


# Obstacles that are formulas need no search, and without friction there is one
# row for each candidate node, with no tangential ones: the 2^l + 1 nodes of the
# side that can touch, or the (2^l - 1)^2 free nodes of a membrane.
summary, meshes, _ = run("flat-obstacle", {"Refinement/Level": 5})
p.expect(summary["search_rebuilds"] == 0 and summary["pairs"] == 0
         and not summary["modelled"]["search"]["on"], "membrane: search")
p.expect(integers(meshes, "constraints") == [49, 225, 961],
         f"membrane: rows {integers(meshes, 'constraints')}")
# Stiffness is assembled once on each mesh. Preconditioners: once on each mesh
# whose active set hardly changes.
p.expect(summary["sections"]["assembly"]["calls"] == 3, "membrane: assembly")
p.expect(max(integers(meshes, "setups")[1:]) == 1,
         f"membrane: set-ups {integers(meshes, 'setups')}")

summary, meshes, _ = run("press-fit", {"Refinement/Level": 3})
rows = integers(meshes, "constraints")
p.expect(rows == [5, 9, 17, 33], f"press fit: rows {rows}")
p.expect(integers(meshes, "setups") == [1] * 4,
         f"press fit: factorisations {integers(meshes, 'setups')}")
p.expect(summary["search_rebuilds"] == 0, "press fit: pairs made anew")
p.expect(summary["modelled"]["search"]["on"]
         and not summary["modelled"]["friction"]["on"], "press fit: model")

summary, meshes, _ = run("hertz-2d", {"Refinement/Level": 4,
                                      "Refinement/Adaptive cycles": 0})
p.expect(not summary["modelled"]["search"]["on"], "Hertz: search")
p.expect(0 < summary["active"] <= summary["constraints"] <= 2**4 + 1,
         f"Hertz: {summary['constraints']} rows")

# The matrix does not change from one load step to the next: nothing is
# factorised or set up again, whether direct or iterative. Nested iteration ends
# with the first load step.
for solver in ("direct", "iterative"):
    summary, meshes, _ = run("two-blocks-3d", {
        "Time stepping/Number of steps": 3, "Refinement/Level": 1,
        "Solver/Linear solver": solver})
    later = [int(mesh["setups"]) for mesh in meshes if mesh["load_step"] > 1]
    p.expect(later == [0, 0], f"{solver}: set-ups {later} in later load steps")
    p.expect(summary["search_rebuilds"] == 0, "two blocks: pairs made anew")
p.expect(any("Time stepping/Number of steps = 1" in line
             for line in summary["could_be_left_out"]),
         "load steps could be left out")

# Memory, above that of the program with its libraries, for each unknown: a
# matrix of 9 (scalar, plane) or 81 (space) entries of 12 bytes in a row, as
# much for the preconditioner, and for the mesh. The bounds are stated in
# doc/economy.md.
small = run("flat-obstacle", {"Refinement/Level": 4})[0]["peak_memory_mb"]
for scene, level, bound in p.some((("flat-obstacle", 8, 2000),
                                   ("press-fit", 6, 3000),
                                   ("two-blocks-3d", 3, 6000))):
    summary, _, _ = run(scene, {"Refinement/Level": level})
    bytes_each = (summary["peak_memory_mb"] - small) * 2**20 / summary["dofs"]
    p.expect(0 < bytes_each < bound,
             f"{scene}: {bytes_each:.0f} bytes for each unknown")
# The shares of an ingredient are those of its sections.
solve = summary["sections"]["solve"]
line = summary["modelled"]["linear systems"]
p.close(line["time_share"], solve["seconds"] / summary["wall_seconds"], 1e-9,
        "share of time")
p.expect(line["memory_mb"] == solve["memory_mb"] > 1, "share of memory")
p.expect(sum(one["memory_mb"] for name, one in summary["sections"].items()
             if "/" not in name) <= summary["peak_memory_mb"],
         "shares of memory add up to more")

# What could be left out, at the target and without one.
summary, _, text = run("flat-obstacle", {"Refinement/Target error": 0.1,
                                         "Method/Enforcement": "penalty",
                                         "Method/Penalty factor": "1e6"}, "--explain")
p.expect("Parts that could be left out" in text
         and "a smaller Method/Penalty factor" in text, "a penalty that is too large")
p.expect(summary["modelled"]["adaptive refinement"]["on"],
         "a target refines adaptively")
_, _, text = run("flat-obstacle", {"Refinement/Level": 4}, "--explain")
p.expect("Refinement/Target error" in text, "no target")
_, _, text = run("flat-obstacle", {"Refinement/Level": 4})
p.expect("Parts that could be left out" not in text, "explained without being asked")
_, _, text = run("step-41", {"Refinement/Level": 7,
                             "Refinement/Nested iteration": "false"},
                 "--explain")
p.expect("Nested iteration = true" in text, "a cold start")
p.expect_error(p.call("check", p.source / "prm/signorini.prm", "--explain"),
               "no option '--explain'")

# Without load the first forces are those of the obstacle.
summary, _, _ = run("curved-obstacle", {
    "Refinement/Level": 7, "Refinement/Adaptive cycles": 0,
    "Refinement/Nested iteration": "false"})
p.expect(summary["converged"], "cold start without load")

# The law that auto takes: lagrange; interior point on fine meshes from a cold
# start; Nitsche's at quadrature points of bodies.
AUTO = {"Method/Enforcement": "auto"}
exact = run("signorini", {"Refinement/Level": 4})[0]
summary, _, _ = run("signorini", {"Refinement/Level": 4, **AUTO})
p.expect(summary["method"] == "lagrange"
         and summary["energy"] == exact["energy"], "auto: signorini")
for level, law in p.some(((7, "lagrange"), (9, "interior point"))):
    summary, _, _ = run("step-41", {
        "Refinement/Level": level, "Refinement/Nested iteration": "false",
        "Method/Maximum linear systems": 1, **AUTO}, code=3)
    p.expect(summary["method"] == law,
             f"auto: {summary['method']} on level {level}")
summary, _, _ = run("press-fit", {
    "Refinement/Level": 2, "Method/Discretisation": "quadrature point", **AUTO})
p.expect(summary["method"] == "nitsche", "auto: quadrature points")
p.expect(summary["modelled"]["automatic law"]["why"] == "nitsche",
         "auto: what was modelled")
p.close(summary["point_1"][0] / -0.003125, 1, 1e-2, "auto: displacement")

p.finish()
