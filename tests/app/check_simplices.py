# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of triangles and tetrahedra from files of gmsh: patch tests, levels,
restart, files, and what is refused."""
import itertools
import math
import shutil
import signal
import subprocess
import time

from block_scene import section, solid
from program import Program
from simplices import Mesh, box
from vtu import pieces

p = Program()
ELASTIC = ("Young modulus = 1000", "Poisson ratio = 0.3")
run, refused, below = p.run_scene, p.refuse_scene, p.below


def body(number, file, *lines):
    return section(f"Body {number}", section("Mesh", f"File = {file}"), *ELASTIC,
                   *lines)


def level(number):
    return section("Refinement", f"Level = {number}")


# Two boxes on each other, of meshes that do not match.
for dim in (2, 3):
    for number, low in ((1, 0), (2, 1)):
        n = 4 - dim + number
        p.write(f"box-{dim}-{number}.msh",
                box((n,) * dim, (0,) * (dim - 1) + (low,),
                    (1,) * (dim - 1) + (low + 1,), 0.2, number).gmsh(
                        "2.2" if number == 1 else "4.1"))


def boxes(dim):
    """Settings of shipped scenes that put them there."""
    return {f"Body {number}/Mesh/File": p.folder / f"box-{dim}-{number}.msh"
            for number in (1, 2)}


def check_patch():
    for dim, degree, n_levels in ((2, 1, 1), (2, 2, 0), (3, 1, 1), (3, 2, 0)):
        what = f"patch test, {dim}D, degree {degree}"
        summary, _ = p.solve_with(f"patch-{dim}d.prm", {
            **boxes(dim), "Solid/Degree": degree, "Refinement/Level": n_levels})
        below(summary["energy_norm_error"], 3e-13, what)
        for key in ("pair_1_pressure", "pair_1_least_pressure"):
            p.close(summary[key], 1., 1e-11, f"{what}, {key}")
    for ranks in (2, 3):
        summary, _ = p.solve_with("patch-3d.prm", {
            **boxes(3), "Refinement/Level": 0}, ranks=ranks)
        below(summary["energy_norm_error"], 3e-13, f"{ranks} ranks")
        p.expect(summary["dofs"] == 1404, f"degree 2: {summary['dofs']}")


# Uniaxial stress of St. Venant and Kirchhoff's material: F = 0.95, Green's
# strain e, force per undeformed area F E e.
STRETCH = 0.95
SVK = STRETCH * 1000. * (1. - STRETCH ** 2) / 2.


def column(dim, *more):
    free = ["free"] * dim
    rollers = ["; ".join(f"{2 * d}: " + ", ".join(free[:d] + ["0"]
                                                  + free[d + 1:])
                         for d in range(dim - 1))]
    ends = [", ".join(free[1:] + [value]) for value in ("0", "-0.1")]
    return solid(
        dim, level(0),
        *(body(b + 1, f"box-{dim}-{b + 1}.msh",
               "Material = st venant-kirchhoff",
               f"Support = {rollers[0]}; {2 * dim - 2 + b}: {ends[b]}")
          for b in range(2)),
        section("Pair 1", f"Secondary = 2: {2 * dim - 2}",
                f"Primary = 1: {2 * dim - 1}"), *more)


def check_large_strain():
    p.write("column.prm", column(3, section("Method", "Sliding = large")))
    for ranks, degree in ((0, 1), (0, 2), (3, 2)):
        summary = run("column.prm", {"Solid/Degree": degree}, ranks=ranks)
        for key in ("pair_1_pressure", "pair_1_least_pressure"):
            p.close(summary[key], SVK, 1e-9, f"{key}, degree {degree}")


def check_touching():
    """Surfaces that touch but for round-off measure no length: a column of two
    cubes, shortened by 1 % by a rigid plate."""
    p.write("low.msh", box((1,) * 3, (0,) * 3, (1,) * 3).gmsh())
    p.write("high.msh", box((2,) * 3, (0, 0, 1), (1, 1, 2)).gmsh())
    scene = p.write("touching.prm", "set Scene = solid\nset Dimension = 3\n"
                    + section("Solid", "Bodies = 2", "Pairs = 2",
                              "Obstacles = 1")
                    + level(0)
                    + section("Body 1", section("Mesh", "File = low.msh"),
                              "Young modulus = 1000", "Poisson ratio = 0",
                              "Support = 4: 0, 0, 0")
                    + section("Body 2", section("Mesh", "File = high.msh"),
                              "Young modulus = 1000", "Poisson ratio = 0",
                              "Support = 0: 0, free, free; 2: free, 0, free")
                    + section("Pair 1", "Secondary = 2: 4", "Primary = 1: 5")
                    + section("Pair 2", "Secondary = 2: 5", "Obstacle = 1")
                    + section("Obstacle 1", "Kind = plane",
                              "Point = 0, 0, 1.98", "Normal = 0, 0, -1"))
    summary = run(scene)
    for pair in (1, 2):
        below(abs(summary[f"pair_{pair}_force"][2]) - 10., 1e-8,
              f"force of pair {pair} of a column")


def quality(corners):
    """3 r_in / R_circ of a tetrahedron: 1 if it is regular."""
    a, b, c = ([x - y for x, y in zip(corner, corners[0])]
               for corner in corners[1:])

    def cross(u, v):
        return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                u[0] * v[1] - u[1] * v[0]]

    def norm(u):
        return math.sqrt(sum(x * x for x in u))
    ab, bc, ca = cross(a, b), cross(b, c), cross(c, a)
    volume = abs(sum(x * y for x, y in zip(a, bc))) / 6.
    last = [x + y + z for x, y, z in zip(ab, bc, ca)]
    area = (norm(ab) + norm(bc) + norm(ca) + norm(last)) / 2.
    center = norm([norm(a) ** 2 * x + norm(b) ** 2 * y + norm(c) ** 2 * z
                   for x, y, z in zip(bc, ca, ab)]) / (12. * volume)
    return 9. * volume / area / center


def check_levels():
    """Volume and area of an id do not change, cells do not become flatter."""
    for dim in (2, 3):
        p.write("levels.prm",
                f"set Scene = solid\nset Dimension = {dim}\n"
                + section("Solid", "Degree = 1")
                + body(1, f"box-{dim}-1.msh",
                       "Support = 0: " + ", ".join(["0"] * dim),
                       "Body force = " + ", ".join(["0"] * (dim - 1) + ["-1"]),
                       f"Traction = {2 * dim - 1}: "
                       + ", ".join(["1"] + ["0"] * (dim - 1))))
        worst = []
        for number in range(3):
            summary = run("levels.prm", {"Refinement/Level": number // 2,
                                         "Body 1/Refinements":
                                         number - number // 2})
            p.close(summary["reaction_1"][dim - 1], 1., 1e-12, "volume")
            p.close(summary["reaction_1"][0], -1., 1e-12, "area of an id")
            if dim == 3:
                piece, = pieces(p.folder / "out/fields_0000.0.vtu")
                p.expect(len(piece.cells) == 48 * 8 ** number, "cells")
                worst.append(min(quality([piece.points[v] for v in cell])
                                 for cell in piece.cells))
        p.expect(dim == 2 or worst[2] > 0.99 * worst[1] > 0.7 * worst[0],
                 f"quality {worst}")
    # One cube: deal.II's own refinement up to 9.5 has .77 .57 .36.
    p.write("box-3-0.msh", box((1, 1, 1), (0, 0, 0), (1, 1, 1)).gmsh())
    for number in range(3):
        run("levels.prm", {"Body 1/Mesh/File": "box-3-0.msh",
                           "Refinement/Level": number})
        piece, = pieces(p.folder / "out/fields_0000.0.vtu")
        least = min(quality([piece.points[v] for v in cell])
                    for cell in piece.cells)
        p.expect(least > 0.5, f"level {number}: quality {least}")


def check_bisection():
    """No hanging nodes, volume and area of an id as before, quality."""
    summary = run("levels.prm", {"Refinement/Level": 0,
                                 "Refinement/Adaptive cycles": 3})
    p.close(summary["reaction_1"][2], 1., 1e-11, "volume, bisected")
    p.close(summary["reaction_1"][0], -1., 1e-11, "area of an id, bisected")
    piece, = pieces(p.folder / "out/fields_0000.0.vtu")
    sides, worst = {}, 1.
    for cell in piece.cells:
        corners = [piece.points[v] for v in cell]
        worst = min(worst, quality(corners))
        for face in itertools.combinations(corners, 3):
            key = tuple(sorted(tuple(round(x, 6) for x in c) for c in face))
            sides[key] = sides.get(key, 0) + 1
    p.expect(worst > 0.15, f"quality of bisected cells: {worst}")
    hanging = [key for key, n in sides.items() if n != 2 and not any(
        all(corner[d] == end for corner in key)
        for d in range(3) for end in (0., 1.))]
    p.expect(not hanging and len(piece.cells) > 200,
             f"{len(hanging)} faces with one cell, {len(piece.cells)} cells")
    summary, _ = p.solve_with("patch-3d.prm", {
        **boxes(3), "Solid/Degree": 1, "Refinement/Level": 0,
        "Refinement/Adaptive cycles": 2}, ranks=2)
    below(summary["energy_norm_error"], 3e-11, "patch test, bisected")


def check_estimate():
    """An exact solution with a singularity (prm/elastic-signorini.prm)."""
    p.write("signorini.msh", box((8, 4), (-1, 0), (1, 1), 0.2).gmsh())
    settings = {"Body 1/Mesh/File": p.folder / "signorini.msh",
                "Refinement/Level": 0, "Refinement/Adaptive cycles": 5}
    errors = {}
    text = (p.source / "prm/elastic-signorini.prm").read_text()
    p.write("signorini.prm", text.replace("  set Coarsest level = 2\n", ""))
    for degree in (1, 2):
        summary, rows = p.solve_with(p.folder / "signorini.prm",
                                     {**settings, "Solid/Degree": degree})
        first, last = rows[0], rows[-1]
        order = -2. * (math.log(last["energy_norm_error"]
                                / first["energy_norm_error"])
                       / math.log(last["dofs"] / first["dofs"]))
        errors[degree] = last["energy_norm_error"]
        p.expect(1. < summary["effectivity"] < 9.,
                 f"degree {degree}: {summary['effectivity']}")
        p.expect(order > 0.8 * degree, f"degree {degree}: order {order}")
    p.expect(errors[2] < 5e-4, f"errors {errors}")
    del settings["Refinement/Adaptive cycles"], settings["Refinement/Level"]
    summary, _ = p.solve_with("elastic-signorini.prm", {
        **settings, "Solid/Degree": "auto", "Refinement/Target error": 0.01})
    p.expect(summary["energy_norm_error"] < 0.01 * math.sqrt(2. * 0.22502),
             f"target error: {summary['energy_norm_error']}")


def rings():
    """Those of prm/press-fit.prm, of triangles."""
    for number, n, radius in ((1, 4, 1), (2, 3, 2)):
        mesh = box((2, n), (radius, 0.), (radius + 1, 0.5 * math.pi), 0.2,
                   number)
        mesh.mapped(lambda r, angle: (r * math.cos(angle), r * math.sin(angle)))
        # 0: inner, 1: outer circle, 2: x = 0, 3: y = 0
        ids = {0: 0, 1: 1, 2: 3, 3: 2}
        mesh.faces = [(ids[id_], face) for id_, face in mesh.faces]
        p.write(f"ring-{number}.msh", mesh.gmsh())


def check_curved_sides():
    """Levels follow circles; Lame's pressure (prm/press-fit.prm)."""
    rings()
    settings = {}
    for number in (1, 2):
        settings[f"Body {number}/Mesh/File"] = p.folder / f"ring-{number}.msh"
        settings[f"Body {number}/Mesh/Curved sides"] = "0, 1: circle: 0, 0"
    errors = []
    for number in (1, 2, 3):
        summary, _ = p.solve_with("press-fit.prm",
                                  {**settings, "Refinement/Level": number})
        errors.append(abs(summary["point_3"][0] / 0.005625 - 1.))
    p.expect(errors[1] < 0.3 * errors[0] and errors[2] < 0.3 * errors[1]
             and errors[2] < 4e-3, f"rings: {errors}")


CANTILEVER = 4e-2 * (1. + 0.78e-2)  # bending and shear: Timoshenko


def check_stiffness():
    """Linear tetrahedra are told to be stiff, and by how much."""
    for n in (1, 2):
        p.write(f"beam-{n}.msh", box((10 * n, n, n), (0, 0, 0),
                                     (10, 1, 1)).gmsh())
    p.write("cantilever.prm",
            "set Scene = solid\nset Dimension = 3\n" + level(0)
            + section("Body 1", section("Mesh", "File = beam-2.msh"),
                      "Support = 0: 0, 0, 0", "Traction = 1: 0, 0, -1e-5",
                      "Young modulus = 1", "Poisson ratio = 0.3")
            + section("Output", "Points = 1: 10, 0.5, 0.5"))
    summary = run("cantilever.prm", {"Solid/Degree": 1}, words=["ABUT-F16"])
    lacking = 1. + summary["point_1"][2] / CANTILEVER
    p.expect(0.5 * lacking < summary["locked_energy"] < lacking,
             f"stiffness: {summary['locked_energy']} of {lacking}")
    # Rotations are no error: 40 times the load, a tip that moves by 0.8.
    for material in ("neo-hooke", "st venant-kirchhoff"):
        bent = run("cantilever.prm", {
            "Solid/Degree": 1, "Body 1/Material": material,
            "Body 1/Traction": "1: 0, 0, -4e-4*t", "Time stepping/Number of steps": 4},
            words=["ABUT-F16"])
        p.expect(bent["point_1"][2] < -0.6, f"{material}: {bent['point_1']}")
        p.close(bent["locked_energy"], summary["locked_energy"], 0.02,
                f"stiffness, {material}")
    summary = run("cantilever.prm", {"Body 1/Mesh/File": "beam-1.msh"},
                  without=["ABUT-F16"])
    p.close(-summary["point_1"][2], CANTILEVER, 0.03, "tip, degree 2")


def slider(dim, friction=0.3):
    """The upper box, pressed down and then drawn sideways."""
    ends = ["0"] * dim
    drawn = ", ".join(["0.05*max(0, t - 1)"] + ["0"] * (dim - 2)
                      + ["-0.02*min(1, t)"])
    return solid(
        dim, level(0),
        body(1, f"box-{dim}-1.msh", f"Support = {2 * dim - 2}: "
             + ", ".join(ends)),
        body(2, f"box-{dim}-2.msh", f"Support = {2 * dim - 1}: {drawn}"),
        section("Pair 1", f"Secondary = 2: {2 * dim - 2}",
                f"Primary = 1: {2 * dim - 1}", f"Friction = {friction}"),
        section("Load steps", "Steps = 6", "End time = 2"),
        section("Checkpoint", "Every steps = 1"),
        section("Output", "Pictures = true"))


def check_restart():
    """Stopped, and resumed on another number of ranks."""
    p.write("slider.prm", slider(3))
    whole = run("slider.prm")
    p.close(math.hypot(*whole["pair_1_friction"]),
            0.3 * whole["pair_1_force"][2], 1e-2, "friction")
    shutil.rmtree(p.folder / "out")
    process = subprocess.Popen(
        [p.abut, "run", "slider.prm", "--output", "out", "--quiet"],
        cwd=p.folder, text=True, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE)
    while process.poll() is None and not any(
            (p.folder / f"out/checkpoint.{n}").exists() for n in (3, 4, 5)):
        time.sleep(0.005)
    process.send_signal(signal.SIGTERM)
    process.communicate()
    p.expect(process.returncode == 4, f"stopped: {process.returncode}")
    resumed = run("slider.prm", ranks=2, more=["--resume"])
    for a, b in zip(whole["pair_1_force"], resumed["pair_1_force"]):
        below(a - b, 1e-9 * whole["pair_1_force"][2], "resumed on two ranks")


def check_files():
    """VTU of degree 2 in space, the line of contact and the picture in the
    plane."""
    piece, = pieces(p.folder / "out/fields_0000.0.vtu")
    p.expect(set(piece.types) == {24}, f"tetrahedra of VTK: {piece.types}")
    for cell in piece.cells:
        corners = [piece.points[v] for v in cell[:4]]
        for node, (a, b) in zip(cell[4:], ((0, 1), (1, 2), (0, 2), (0, 3),
                                           (1, 3), (2, 3))):
            middle = [(x + y) / 2. for x, y in zip(corners[a], corners[b])]
            p.expect(math.dist(middle, piece.points[node]) < 1e-6,
                     "nodes of a tetrahedron of VTK")
    p.write("slider.prm", slider(2))
    for degree in (1, 2):
        run("slider.prm", {"Solid/Degree": degree})
        rows = p.table("pair_1.csv")
        p.expect([row["line"] for row in rows] == [1.] * (4 * degree + 1),
                 f"nodes of the line of contact, degree {degree}")
        p.close(rows[-1]["arc"], 1., 1e-12, "length of the line of contact")
        picture = p.folder / "out/bodies.svg"
        p.expect(picture.exists(), "no picture")


def check_motion():
    """A bar against a wall: momentum is turned round, energy kept."""
    p.write("bar.msh", box((16, 2), (0.5, 0), (10.5, 1), 0.2).gmsh())
    p.write("bar.prm", solid(
        2, level(0),
        section("Body 1", section("Mesh", "File = bar.msh"), "Density = 1",
                "Young modulus = 900", "Poisson ratio = 0",
                "Initial velocity = -1, 0"),
        section("Obstacle 1", "Kind = plane", "Normal = 1, 0"),
        section("Pair 1", "Secondary = 1: 0", "Obstacle = 1"),
        section("Time", "Step = 0.02", "End = 1.4"), bodies=1, obstacles=1))
    for degree, scheme, loss in (
            (2, "hht", 0.05), (1, "hht", 0.02), (2, "contact stabilised", 0.03),
            (1, "central difference with projection", 0.06)):
        summary = run("bar.prm", {
            "Solid/Degree": degree, "Time stepping/Scheme": scheme,
            "Time stepping/Step size": 0.01 if scheme[0] == "c" else 0.02})
        what = f"{scheme}, degree {degree}"
        p.close(summary["mass"][0], 10., 1e-12, f"{what}: mass")
        below(summary["energy_gain"], 1e-10, f"{what}: energy")
        below(summary["energy_loss"], loss, f"{what}: lost energy")
        p.close(summary["pair_1_impulse"][0], 20., 0.05, f"{what}: impulse")
    refused("bar.prm", {"Time stepping/Scheme": "central difference with projection"},
            "Solid/Degree", "no lumped mass")


def one_cell(name, kind, n_nodes, faces=()):
    """A file with one cell of a kind of gmsh."""
    corners = [(x, y, z) for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1),
                                                      (0, 1))]
    points = [corners[k] if k < 8 else (0.5, 0.1 * k, 0.)
              for k in range(n_nodes)]
    elements = [*faces, (kind, range(n_nodes))]
    return p.write(name, "\n".join(
        ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes", str(n_nodes)]
        + [" ".join(map(str, (k + 1,) + x)) for k, x in enumerate(points)]
        + ["$EndNodes", "$Elements", str(len(elements))]
        + [" ".join(map(str, [k + 1, kind, 2, 1, 1] + [v + 1 for v in nodes]))
           for k, (kind, nodes) in enumerate(elements)]
        + ["$EndElements", ""]))


def check_refusals():
    p.write("slider.prm", slider(3))
    file = "Body 1/Mesh/File"
    for settings, *texts in (
            ({"Body 2/Element": "mean dilatation", "Solid/Degree": 1},
             "Body 2/Element", "constant strain in each cell"),
            ({"Method/Discretisation": "dual mortar"},
             "Method/Discretisation", "no weight at the corners"),
            ({"Refinement/Coarsest level": 1, "Refinement/Level": 2},
             "Refinement/Coarsest level", "has no effect"),
            ({"Refinement/Nested iteration": "true"},
             "Refinement/Nested iteration", "has no effect"),
            ({"Refinement/Coarsen fraction": 0.1,
              "Refinement/Adaptive cycles": 1},
             "Refinement/Coarsen fraction", "has no effect"),
            ({file: one_cell("wedge.msh", 6, 6)}, file, "wedge")):
        refused("slider.prm", settings, *texts)
    p.write("slider.prm", slider(2))
    mixed = one_cell("mixed.msh", 3, 4, faces=[(2, (0, 1, 2))])
    refused("slider.prm", {file: mixed}, file, "one kind")
    p.write("membrane.prm", "set Scene = obstacle\nset Dimension = 2\n"
            + section("Mesh", "File = box-2-1.msh")
            + section("Contact", "Obstacle = -1"))
    refused("membrane.prm", {}, "Mesh/File", "the cells are triangles")
    # All ranks agree.
    result = p.call("run", "membrane.prm", "--output", "out", "--quiet",
                    ranks=2)
    p.expect(result.returncode == 2 and result.stderr.count("abut: error") == 1,
             f"two ranks: {result.stderr}")


def check_multipliers():
    for name in ("tetrahedra.prm", "cube-of-tetrahedra.msh"):
        shutil.copy(p.source / "prm" / name, p.folder / name)
    refused("tetrahedra.prm", {"Method/Multiplier degree": 0},
            "Multiplier degree", "degree 1")


def check_unseen():
    """A ball that is inside of a corner only, by less than means over the
    facets around can show: no answer, as no constraint presses."""
    for name in ("tetrahedra.prm", "cube-of-tetrahedra.msh"):
        shutil.copy(p.source / "prm" / name, p.folder / name)
    result = p.call("run", "tetrahedra.prm", "--output", "out", "--quiet",
                    "--set", "Refinement/Adaptive cycles=0")
    p.expect(result.returncode == 3 and "ABUT-F37" in result.stderr
             and "no constraint is active" in result.stderr,
             f"unseen ball: {result.returncode} {result.stderr}")
    # Its centre comes below the surface in one step.
    run("tetrahedra.prm", {"Obstacle 1/Radius": 0.002, "Refinement/Adaptive "
                           "cycles": 0, "Obstacle 1/Centre": "0, 0, 0.002"},
        3, ("ABUT-F37", "without a constraint"))


def check_surfaces():
    """Boundaries of such meshes as surfaces of a search, and as an obstacle."""
    p.write("search.prm", "set Scene = search\nset Dimension = 3\n"
            + section("Secondary", "File = box-3-2.msh", "Surface ids = 4")
            + section("Primary", "File = box-3-1.msh", "Surface ids = 5"))
    result = p.call("search", "search.prm", "--output", "out", "--quiet")
    summary = p.expect_run(result, 0)
    for key in ("secondary_area", "primary_area", "common_area"):
        p.close(summary[key], 1., 1e-12, key)
    p.expect_error(p.call("search", "search.prm", "--output", "out", "--quiet",
                          "--set", "Primary/Refinements=1"),
                   "Primary/File", "tetrahedra")


def slotted():
    """The unit cube with a slot of width 0.01 from x = 1 to 1/4; 1 and 2: its
    lower and upper face, 4: bottom, 5: top."""
    height = (0., 0.25, 0.495, 0.505, 0.75, 1.)
    mesh = box((4, 4, 5), (0, 0, 0), (1, 1, 5))
    mesh.mapped(lambda x, y, z: (x, y, height[round(z)]))
    cells = []
    for cell in mesh.cells:
        x, _, z = [sum(c) / 4 for c in zip(*(mesh.vertices[v] for v in cell))]
        if x < 0.25 or not 0.495 < z < 0.505:
            cells.append(cell)
    used = sorted({v for cell in cells for v in cell})
    index = {v: k for k, v in enumerate(used)}
    ids = {0.495: 1, 0.505: 2, 0.: 4, 1.: 5}

    def id_of(corners):
        low, *others = (x[2] for x in corners)
        return ids.get(low, 0) if all(z == low for z in others) else 0
    return Mesh(3, [mesh.vertices[v] for v in used],
                [[index[v] for v in cell] for cell in cells], id_of)


def check_slot():
    """Both faces of a slot as one surface and as two."""
    mesh = slotted()
    p.write("slot-2.msh", mesh.gmsh())
    mesh.faces = [(1 if id_ == 2 else id_, face) for id_, face in mesh.faces]
    p.write("slot-1.msh", mesh.gmsh())
    p.write("slot.prm", solid(
        3, level(0), body(1, "slot-1.msh", "Support = 4: 0, 0, 0",
                          "Pressure = 5: 20"),
        section("Pair 1", "Secondary = 1: 1", "Primary = 1: 1",
                "Reach = 0.02"), bodies=1))
    for degree, sliding in itertools.product((1, 2), ("small", "large")):
        settings = {"Solid/Degree": degree, "Method/Contact geometry": sliding}
        one = run("slot.prm", settings)
        two = run("slot.prm", {**settings, "Body 1/Mesh/File": "slot-2.msh",
                               "Pair 1/Primary": "1: 2"})
        what = f"slot, degree {degree}, {sliding}"
        p.expect(one["pair_1_active"] == two["pair_1_active"] > 10, what)
        for key in ("contact_force", "pair_1_pressure"):
            p.close(one[key], two[key], 1e-10, f"{what}: {key}")


check_patch()
check_large_strain()
check_touching()
check_slot()
check_levels()
check_bisection()
check_estimate()
check_curved_sides()
check_stiffness()
check_restart()
check_files()
check_motion()
check_refusals()
check_multipliers()
check_unseen()
check_surfaces()
p.finish()
