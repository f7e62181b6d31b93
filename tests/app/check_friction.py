# SPDX-License-Identifier: LGPL-2.1-or-later
"""Friction: without a coefficient it is not there at all, the frame and the
number of ranks do not matter, and the moments of bodies that are turned on each other
are those of closed forms."""
import math
import os
import subprocess

from program import Program, set_words

p = Program()
QUIET = {"Output/Fields": "false", "Output/Pictures": "false"}


def rotation(*degrees):
    """About x, then y, then z."""
    result = [[1., 0., 0.], [0., 1., 0.], [0., 0., 1.]]
    for axis, angle in enumerate(degrees):
        c, s = math.cos(math.radians(angle)), math.sin(math.radians(angle))
        i, j = (axis + 1) % 3, (axis + 2) % 3
        result[i], result[j] = (
            [c * a - s * b for a, b in zip(result[i], result[j])],
            [s * a + c * b for a, b in zip(result[i], result[j])])
    return result


def times(matrix, vector):
    return [sum(a * b for a, b in zip(row, vector)) for row in matrix]


def distance(one, two):
    return math.dist(one, two) / math.hypot(*one)


def words(vector):
    return ", ".join(f"{v:.17g}" for v in vector)


def without_coefficient():
    """Bit by bit the run of a scene that does not know of friction."""
    for name, more in p.some([
            ("dragged-block.prm", {}),
            ("greco.prm", {"Refinement/Level": 4,
                           "Method/Enforcement": "nitsche"}),
            ("greco.prm", {}),
            ("cattaneo.prm", {"Refinement/Adaptive cycles": 2})], 2):
        text = (p.source / "prm" / name).read_text()
        bare = "".join(line for line in text.splitlines(keepends=True)
                       if "set Friction" not in line)
        p.expect(bare != text, f"{name} has no friction")
        p.write(name, bare)
        found = []
        for scene, settings in ((name,
                                 {"Pair 1/Friction": 0}), (p.folder / name, {})):
            summary, _ = p.solve_with(scene, {
                **settings, **more, "Output/Nodal values": "true"})
            p.expect("pair_1_friction_force" not in summary,
                     f"{name} has friction")
            found.append([(p.folder / "out" / file).read_bytes()
                          for file in ("nodal.csv", "pair_1.csv")])
        p.expect(found[0] == found[1], f"{name}: mu = 0 is not the "
                 "frictionless answer")


# Two cubes pressed and moved aside, so that some of the nodes stick and others slip.
CUBES = {**QUIET, "Refinement/Level": 1, "Pair 1/Friction": 0.3,
         "Time stepping/Number of steps": 2, "Solid/Accept strains beyond linear theory": "true",
         "Refinement/Nested iteration": "false",
         "Method/Final linear tolerance": 1e-12}
ASIDE = [0.025, 0.01, -0.02]
SUMS = ("pair_1_force", "pair_1_friction", "reaction_1")


def cubes(angles=(0., 0., 0.), ranks=0):
    turn = rotation(*angles)
    return p.solve_with("two-blocks-3d.prm", {
        **CUBES, "Body 1/Mesh/Rotate": words(angles),
        "Body 2/Mesh/Rotate": words(angles),
        "Body 2/Mesh/Move": words(times(turn, [0., 0., 1.])),
        "Body 2/Prescribed displacement": "5: " + ", ".join(f"({u:.17g})*t" for u in
                                            times(turn, ASIDE))}, ranks)[0]


def frames_and_ranks():
    one = cubes()
    p.expect(0 < one["pair_1_slipping"] < one["pair_1_active"],
             f"{one['pair_1_slipping']} of {one['pair_1_active']} slip")
    runs = [(f"turned by {a}", cubes(a), rotation(*a))
            for a in p.some([(20., 50., -70.), (90., 0., 0.), (0., 0., 33.)])]
    runs += [(f"{n} ranks", cubes(ranks=n), rotation())
             for n in p.some([3, 2, 5])]
    for name, other, turn in runs:
        for key in ("pair_1_active", "pair_1_slipping"):
            p.expect(one[key] == other[key],
                     f"{name}: {key} {one[key]} and {other[key]}")
        for key in SUMS:
            error = distance(times(turn, one[key]), other[key])
            p.expect(error < 1e-8, f"{name}: {key} differs by {error}")
        p.close(other["dissipation"], one["dissipation"], 1e-8,
                f"{name}: dissipation")


def cylinder():
    """Uniform pressure: 2/3 mu P a once all slides, from one increment to
    the next."""
    moments = []
    for end in (4, 6):
        summary, _ = p.solve_with("torsion.prm", {
            **QUIET, "Time stepping/Number of steps": end, "Time stepping/End time": end})
        force = summary["pair_1_normal_force"]
        moments.append(abs(summary["pair_1_moment"][0]) / (0.3 * force))
    print("cylinder: moment of mu P a", *moments)
    p.close(moments[1], 2. / 3., 1e-3, "moment of the cylinder")
    p.close(moments[0], moments[1], 1e-4, "the moment has settled")


def turned_without_friction():
    """A plane that turns by 60 degrees under the cylinder: places at the rim of
    the two are apart by the chord of that, 1, and nothing has moved."""
    summary, _ = p.solve_with("torsion.prm", {
        **QUIET, "Pair 1/Friction": 0, "Time stepping/Number of steps": 1,
        "Time stepping/End time": 61, "Refinement/Level": 1})
    p.close(summary["pair_1_slip"], 1., 1e-10, "slip of a plane that turns")


def slip_of_step():
    """The plate goes on by 0.05 over a block that slides all along: each node has
    that as its slip, against the plate, and mu N takes up its work."""
    summary, _ = p.solve_with("dragged-block.prm", {
        "Time stepping/Number of steps": 5, "Time stepping/End time": 5,
        "Output/Pictures": "false", "Output/Nodal values": "true"})
    p.close(summary["pair_1_dissipation"],
            0.25 * summary["contact_force"] * 0.05, 1e-8, "work of the last step")
    line = p.table("pair_1.csv")
    nodes = [n for n in p.table("nodal.csv") if n["status"] == 2]
    p.expect(len(line) == len(nodes) == 17, f"{len(line)} and {len(nodes)} nodes")
    for node in line:
        p.close(node["slip"], -0.05, 1e-8, f"slip at {node['x']} in pair_1.csv")
    for node in nodes:
        p.close(node["slip_x"], -0.05, 1e-8, f"slip at {node['x']} in nodal.csv")
        p.expect(abs(node["slip_y"]) < 1e-12, f"slip away from the plate: {node}")


def corner():
    """With all sides in the pair the corner at the end of the plate's way has
    two facets; what the plate does to it is mu p all the same, and only that."""
    for scheme in ({}, {"Method/Enforcement": "penalty"}):
        p.solve_with("dragged-block.prm", {
            **scheme, "Pair 1/Secondary": "1: *", "Output/Pictures": "false",
            "Output/Nodal values": "true"})
        force = {(n["x"], n["y"]): n for n in p.table("nodal.csv")}
        line = [n for n in p.table("pair_1.csv") if n["y"] == 1.]
        p.expect(len(line) == 17, f"{len(line)} nodes below the plate")
        for node in line:
            along = force[node["x"], 1.]["contact_x"]
            down = force[node["x"], 1.]["contact_y"]
            p.close(abs(along / down), 0.25, 1e-6, f"slips at {node['x']}")
            p.expect(node["pressure"] > 0., f"pressure at {node['x']}: {node}")
            p.close(abs(node["friction"]) / node["pressure"], 0.25, 1e-6,
                    f"friction by pressure at {node['x']}")


def left_out():
    """What is pressed by itself, without growing wider, needs no friction."""
    for end, needless in ((1, True), (2, False)):
        run = p.call("run", p.source / "prm/dragged-block.prm", "--explain",
                     "--output", "out", *set_words({
                         **QUIET, "Body 1/Poisson ratio": 0,
                         "Time stepping/Number of steps": end, "Time stepping/End time": end}))
        p.expect(("friction, unless it supports" in run.stdout) == needless,
                 f"friction in what could be left out at {end}: {run.stdout}")


def error_of_springs():
    """A block under uniform pressure and shear, of which nothing slips: the
    springs of the penalty give way by c p and c tau, c = 1/(kappa s). In the
    norm of the strain energy that is sqrt((p^2 + tau^2) c/kappa) per area, and
    the body has (p^2 + 2 tau^2)/E per volume."""
    pressure, shear, kappa, young = 2., 1., 100., 1000.
    p.write("sheared.prm", f"""
set Scene = solid
set Dimension = 2
subsection Solid
  set Obstacles = 1
  set Pairs = 1
end
subsection Body 1
  subsection Mesh
    set Generator = hyper_cube
    set Arguments = 0 : 1 : true
  end
  set Young modulus = {young}
  set Poisson ratio = 0
  set Traction = 0: 0, {-shear}; 1: 0, {shear}; 3: {shear}, {-pressure}
end
subsection Obstacle 1
  set Kind = plane
  set Point = 0, 0
  set Normal = 0, 1
end
subsection Pair 1
  set Secondary = 1: 2
  set Obstacle = 1
  set Friction = 1
end
subsection Method
  set Enforcement = penalty
  set Penalty = {kappa}
end
subsection Refinement
  set Target error = 0.5
end
""")
    summary, _ = p.solve_with(p.folder / "sheared.prm", QUIET)
    p.expect(summary["pair_1_slipping"] == 0 < summary["pair_1_active"],
             "the sheared block slips")
    soft = summary["max_penetration"] / pressure
    p.close(summary["pair_1_slip"], soft * shear, 1e-8, "way of the springs")
    p.close(summary["estimated_contact_error"],
            math.sqrt((pressure**2 + shear**2) * soft / kappa
                      / ((pressure**2 + 2 * shear**2) / young)), 1e-8,
            "error of the springs")


def ball():
    """Hertz: 3 pi/16 mu P a."""
    summary, _ = p.solve_with("torsion-hertz.prm", QUIET)
    force = summary["pair_1_normal_force"]
    radius = (0.75 * (1. - 0.3 ** 2) * force) ** (1. / 3.)
    moment = abs(summary["pair_1_moment"][2]) / (0.3 * force * radius)
    print("ball: moment of mu P a", moment)
    p.close(moment, 3. * math.pi / 16., 0.01, "moment of the ball")
    p.expect(summary["pair_1_slipping"] == summary["pair_1_active"] - 1,
             "more than the middle sticks")


def limited(pressure, mu, strength):
    return -strength * math.expm1(-mu * pressure / strength)


def own_law():
    """The documentation's friction law in a shared object: bodies and masses."""
    example = p.source / "doc/examples/user-law"
    library = p.folder / "shear_limit.so"
    subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-I",
                    p.source / "include", example / "shear_limit.c", "-o",
                    library, "-lm"], check=True)
    own = {"Method/Friction file": library,
           "Method/Friction parameters": "shear strength: 3"}
    summary, _ = p.solve_with(example / "sheared-block.prm", own)
    p.expect(summary["pair_1_slipping"] == summary["active"] > 5,
             "the block does not slide")
    for node in p.table("pair_1.csv"):
        p.close(node["friction"], limited(node["pressure"], 0.25, 3.), 1e-6,
                f"traction at x = {node['x']}")
    # A normal law of one's own below Coulomb's.
    law = p.folder / "soft_law.so"
    subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", "-I",
                    p.source / "include", example / "soft_law.c", "-o", law,
                    "-lm"], check=True)
    soft, _ = p.solve_with("dragged-block.prm", {
        **QUIET, "Method/Enforcement": "user", "Method/Law file": law,
        "Method/Law parameters": "touch pressure: 5, clearance: 0.002"})
    p.expect(soft["pair_1_slipping"] == soft["active"] == 17,
             "the block does not slide below a soft layer")
    p.close(soft["pair_1_friction_ratio"], 0.25, 1e-9,
            "ratio of the forces below a soft layer")
    own["Method/Friction parameters"] = "shear strength: 0.4"
    summary, _ = p.solve_with("friction-block.prm", own)
    p.close(abs(summary["friction_force"][0]),
            sum(limited(1. + 0.2 * i, 0.3, 0.4) for i in range(6)), 1e-9,
            "friction of the masses")
    run = ("run", example / "sheared-block.prm", "--output", "never")
    for settings, words in (
            ({"Method/Friction file": "none.so"},
             ("Method/Friction file", "no such file")),
            ({"Method/Friction file": library,
              "Method/Friction parameters": "strength: 3"},
             ("Method/Friction parameters", "'shear strength' is missing")),
            ({"Method/Friction file": library,
              "Method/Friction parameters": "shear strength: 0"},
             ("Method/Friction parameters", "must be above 0"))):
        p.expect_error(p.call(*run, *set_words(settings)), *words)
    p.expect_error(p.call(*run, *set_words({**own, "Pair 1/Friction": 0})),
                   "there is no friction")


without_coefficient()
own_law()
frames_and_ranks()
cylinder()
turned_without_friction()
slip_of_step()
corner()
left_out()
error_of_springs()
ball()
p.finish()
