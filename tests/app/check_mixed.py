# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bodies of triangles and tetrahedra beside others of quadrilaterals and
hexahedra: patch tests, friction, large strain, motion, levels, restart, files,
and what is refused."""
import collections
import math
import shutil
import signal
import subprocess
import time

from block_scene import section, solid
from program import Program, set_words
from simplices import box, measure
from vtu import pieces

p = Program()
ELASTIC = ("Young modulus = 1000", "Poisson ratio = 0.3")
run, refused, below = p.run_scene, p.refuse_scene, p.below


def bricks(n, low):
    """The mesh of a box of side 1 with ids as of simplices.box()."""
    corner = [0] * (len(n) - 1) + [low]
    return section(
        "Mesh", "Generator = subdivided_hyper_rectangle", "Arguments = "
        + " : ".join(", ".join(map(str, numbers)) for numbers in (
            n, corner, [1] * (len(n) - 1) + [low + 1])) + " : true")


def body(number, mesh, *lines):
    return section(f"Body {number}", mesh, *ELASTIC, *lines)


def file(name):
    return section("Mesh", f"File = {name}")


# The lower and the upper box of simplices.
for dim in (2, 3):
    for number, low in ((1, 0), (2, 1)):
        n = 4 - dim + number
        p.write(f"box-{dim}-{number}.msh",
                box((n,) * dim, (0,) * (dim - 1) + (low,),
                    (1,) * (dim - 1) + (low + 1,), 0.2, number).gmsh())


def mesh_of(dim, number, simplices):
    return file(f"box-{dim}-{number}.msh") if simplices else bricks(
        [5 - dim + number] * dim, number - 1)


def check_patch():
    """Exact stresses (prm/patch-2d.prm, prm/patch-3d.prm): either body of
    simplices, either side the secondary."""
    for dim, degree, simplices, secondary, ranks in (
            (2, "auto", 1, 2, 0), (2, "auto", 2, 2, 3), (2, 1, 1, 1, 0),
            (2, 2, 2, 1, 2), (3, "auto", 1, 2, 2), (3, "auto", 2, 2, 3),
            (3, "auto", 1, 1, 0), (3, 1, 2, 2, 0), (3, 2, 1, 1, 0)):
        what = f"patch test, {dim}D, degree {degree}, simplices in body " \
               f"{simplices}, secondary {secondary}, {ranks} ranks"
        settings = {
            f"Body {simplices}/Mesh/File":
            p.folder / f"box-{dim}-{simplices}.msh",
            f"Body {simplices}/Mesh/Arguments": "",
            "Solid/Degree": degree, "Refinement/Level": 3 - dim,
            "Method/Final linear tolerance": 1e-14}
        if secondary == 1:
            settings["Pair 1/Secondary"] = f"1: {2 * dim - 1}"
            settings["Pair 1/Primary"] = f"2: {2 * dim - 2}"
        summary, _ = p.solve_with(f"patch-{dim}d.prm", settings, ranks=ranks)
        below(summary["energy_norm_error"], 3e-13, what)
        for key in ("pair_1_pressure", "pair_1_least_pressure"):
            p.close(summary[key], 1., 1e-11, f"{what}, {key}")


# Uniaxial stress of St. Venant and Kirchhoff's material: F = 0.95, Green's
# strain e, force per undeformed area F E e.
STRETCH = 0.95
SVK = STRETCH * 1000. * (1. - STRETCH ** 2) / 2.


def column(dim, simplices, *more):
    free = ["free"] * dim
    rollers = "; ".join(f"{2 * d}: " + ", ".join(free[:d] + ["0"]
                                                 + free[d + 1:])
                        for d in range(dim - 1))
    ends = [", ".join(free[1:] + [value]) for value in ("0", "-0.1")]
    return solid(
        dim, section("Refinement", "Level = 0"),
        *(body(b + 1, mesh_of(dim, b + 1, simplices == b + 1),
               "Material = st venant-kirchhoff",
               f"Support = {rollers}; {2 * dim - 2 + b}: {ends[b]}")
          for b in range(2)),
        section("Pair 1", f"Secondary = 2: {2 * dim - 2}",
                f"Primary = 1: {2 * dim - 1}"), *more)


def check_large_strain():
    for simplices, ranks, degree in ((1, 0, "auto"), (2, 3, "auto"), (2, 0, 1)):
        p.write("column.prm", column(3, simplices,
                                     section("Method", "Sliding = large")))
        summary = run("column.prm", {"Solid/Degree": degree}, ranks=ranks)
        for key in ("pair_1_pressure", "pair_1_least_pressure"):
            p.close(summary[key], SVK, 1e-9, f"{key}, degree {degree}")


def check_rings():
    """Lame's displacement (prm/press-fit.prm), one ring of triangles."""
    for number, n in ((1, 4), (2, 3)):
        mesh = box((2, n), (number, 0.), (number + 1, 0.5 * math.pi), 0.2,
                   number)
        mesh.mapped(lambda r, angle: (r * math.cos(angle), r * math.sin(angle)))
        # 0: inner, 1: outer circle, 2: x = 0, 3: y = 0
        ids = {0: 0, 1: 1, 2: 3, 3: 2}
        mesh.faces = [(ids[id_], face) for id_, face in mesh.faces]
        p.write("ring.msh", mesh.gmsh())
        errors = []
        for level in (1, 2, 3):
            summary, _ = p.solve_with("press-fit.prm", {
                f"Body {number}/Mesh/File": p.folder / "ring.msh",
                f"Body {number}/Mesh/Arguments": "",
                f"Body {number}/Mesh/Curved sides": "0, 1: circle: 0, 0",
                "Refinement/Level": level})
            errors.append(abs(summary["point_3"][0] / 0.005625 - 1.))
        p.expect(errors[1] < 0.4 * errors[0] and errors[2] < 0.4 * errors[1]
                 and errors[2] < 1e-3, f"rings: {errors}")


def slider(dim, simplices, *more):
    """The upper box, pressed down and then drawn sideways."""
    drawn = ", ".join(["0.05*max(0, t - 1)"] + ["0"] * (dim - 2)
                      + ["-0.02*min(1, t)"])
    return solid(
        dim, section("Refinement", "Level = 0"),
        body(1, mesh_of(dim, 1, simplices == 1),
             f"Support = {2 * dim - 2}: " + ", ".join(["0"] * dim)),
        body(2, mesh_of(dim, 2, simplices == 2),
             f"Support = {2 * dim - 1}: {drawn}"),
        section("Pair 1", f"Secondary = 2: {2 * dim - 2}",
                f"Primary = 1: {2 * dim - 1}", "Friction = 0.3"),
        section("Load steps", "Steps = 6", "End time = 2"),
        section("Checkpoint", "Every steps = 1"),
        section("Output", "Pictures = true"), *more)


def check_restart():
    """What slides everywhere has the friction mu times the pressure. Stopped,
    and resumed on another number of ranks, with cubes of degree 2."""
    for simplices, degree in ((1, "auto"), (2, 2)):
        p.write("slider.prm", slider(3, simplices))
        settings = {"Solid/Degree": degree}
        whole = run("slider.prm", settings)
        p.close(math.hypot(*whole["pair_1_friction"]),
                0.3 * whole["pair_1_force"][2], 1e-2, "friction")
    shutil.rmtree(p.folder / "out")
    process = subprocess.Popen(
        [p.abut, "run", "slider.prm", "--output", "out", "--quiet",
         *set_words(settings)], cwd=p.folder, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    while process.poll() is None and not any(
            (p.folder / f"out/checkpoint.{n}").exists() for n in (3, 4, 5)):
        time.sleep(0.005)
    process.send_signal(signal.SIGTERM)
    process.communicate()
    p.expect(process.returncode == 4, f"stopped: {process.returncode}")
    resumed = run("slider.prm", settings, ranks=2, more=["--resume"])
    for a, b in zip(whole["pair_1_force"], resumed["pair_1_force"]):
        below(a - b, 1e-9 * whole["pair_1_force"][2], "resumed on two ranks")


# Volumes by VTK's types: triangle, quadrilateral, tetrahedron, hexahedron,
# triangle and tetrahedron of degree 2.
CORNERS = {5: 3, 9: 4, 10: 4, 12: 8, 22: 3, 24: 4}


def volume(kind, corners, dim):
    corners = [x[:dim] for x in corners]
    if kind == 9:
        return volume(5, corners[:3], 2) + volume(5, [corners[0]]
                                                  + corners[2:], 2)
    if kind == 12:  # a brick
        return measure([corners[v] for v in (0, 1, 3, 4)]) * 6
    return measure(corners)


def check_files():
    """Fields of both kinds fill both boxes; lines of contact, pictures."""
    for dim, degree, kinds in ((2, 1, {5, 9}), (2, 2, {22, 9}),
                               (3, "auto", {24, 12})):
        p.write("slider.prm", slider(dim, 1))
        run("slider.prm", {"Solid/Degree": degree})
        piece, = pieces(p.folder / "out/fields_0000.0.vtu")
        p.expect(set(piece.types) == kinds, f"cells of VTK: {piece.types}")
        total = collections.Counter()
        for kind, cell in zip(piece.types, piece.cells):
            total[kind] += volume(kind, [piece.points[v] for v in
                                         cell[:CORNERS[kind]]], dim)
        for kind in kinds:
            p.close(total[kind], 1., 1e-5, f"volume of cells {kind}, {dim}D")
        if dim == 3:
            continue
        rows = p.table("pair_1.csv")
        p.close(rows[-1]["arc"], 1., 1e-12, "length of the line of contact")
        picture = p.folder / "out/bodies.svg"
        p.expect(picture.exists(), "no picture")


def check_levels():
    """Volume and area of an id do not change; unknowns of each level."""
    p.write("levels.prm", solid(
        3, *(body(b, mesh_of(3, b, b == 1), "Support = 0: 0, 0, 0",
                  "Body force = 0, 0, -1", "Traction = 1: 1, 0, 0")
             for b in (1, 2)),
        section("Pair 1", "Secondary = 2: 4", "Primary = 1: 5")))
    for level, more in ((0, 0), (1, 0), (0, 1)):
        summary = run("levels.prm", {"Solid/Degree": 1,
                                     "Refinement/Level": level,
                                     "Body 2/Refinements": more})
        nodes = (2 * 2 ** level + 1) ** 3 + (4 * 2 ** (level + more) + 1) ** 3
        p.expect(summary["dofs"] == 3 * nodes, f"dofs: {summary['dofs']}")
        for b in (1, 2):
            p.close(summary[f"reaction_{b}"][0], -1., 1e-8, "area of an id")
        p.close(summary["reaction_1"][2] + summary["reaction_2"][2], 2., 1e-8,
                "volume")


def check_motion():
    """A bar of triangles strikes an equal one of quadrilaterals at rest: it
    stays behind, the other moves on. Momentum is kept."""
    p.write("bar.msh", box((16, 2), (0, 0), (10, 1), 0.2).gmsh())
    p.write("bars.prm", solid(
        2, section("Refinement", "Level = 0"),
        section("Body 1", file("bar.msh"), "Density = 1",
                "Young modulus = 900", "Poisson ratio = 0",
                "Initial velocity = 1, 0"),
        section("Body 2", section(
            "Mesh", "Generator = subdivided_hyper_rectangle",
            "Arguments = 24, 3 : 10.2, 0 : 20.2, 1 : true"), "Density = 1",
            "Young modulus = 900", "Poisson ratio = 0"),
        section("Pair 1", "Secondary = 2: 0", "Primary = 1: 1"),
        section("Time", "Step = 0.02", "End = 1.6")))
    for scheme in ("hht", "contact stabilised"):
        summary = run("bars.prm", {"Time stepping/Scheme": scheme})
        p.close(summary["mass"][0], 20., 1e-12, f"{scheme}: mass")
        p.close(summary["momentum"][0], 10., 1e-9, f"{scheme}: momentum")
        below(summary["energy_gain"], 1e-10, f"{scheme}: energy")
        p.close(summary["pair_1_impulse"][0], 10., 0.05, f"{scheme}: impulse")


def both_in_one_file():
    """Two boxes in one file of gmsh, each a physical volume with a name."""
    lower = box((2, 2, 2), (0, 0, 0), (1, 1, 1), 0.2, 1)
    points = [tuple(x) for x in lower.vertices]
    elements = [(2, 10 + id_, face) for id_, face in lower.faces]
    elements += [(4, 1, cell) for cell in lower.cells]
    first, n = len(points), 3
    points += [(i / n, j / n, 1. + k / n) for k in range(n + 1)
               for j in range(n + 1) for i in range(n + 1)]

    def node(i, j, k):
        return first + i + (n + 1) * (j + (n + 1) * k)
    square = ((0, 0), (1, 0), (1, 1), (0, 1))
    for a in range(n):
        for b in range(n):
            elements += [(3, 20 + k, [node(a + i, b + j, (k - 4) * n)
                                      for i, j in square]) for k in (4, 5)]
            elements += [(5, 2, [node(a + i, b + j, c + k) for k in (0, 1)
                                 for i, j in square]) for c in range(n)]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "6",
             '3 1 "stump"', '3 2 "brick"', '2 14 "ground"', '2 15 "seat"',
             '2 24 "foot"', '2 25 "head"', "$EndPhysicalNames", "$Nodes",
             str(len(points))]
    lines += ["%d %.17g %.17g %.17g" % ((k,) + x)
              for k, x in enumerate(points, 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements))]
    lines += [" ".join(map(str, (k, kind, 2, id_, id_,
                                 *(v + 1 for v in nodes))))
              for k, (kind, id_, nodes) in enumerate(elements, 1)]
    return p.write("both.msh", "\n".join(lines + ["$EndElements", ""]))


def part(number, name, *lines):
    return body(number, section("Mesh", "File = both.msh", f"Part = {name}"),
                *lines)


def check_parts():
    """E times the strain, nu = 0, of two boxes of one file; a third body and
    an obstacle on top."""
    both_in_one_file()
    text = solid(
        3, section("Refinement", "Level = 0"),
        part(1, "stump", "Poisson ratio = 0", "Support = ground: 0, 0, 0"),
        part(2, "brick", "Poisson ratio = 0", "Support = head: 0, 0, -0.02"),
        section("Pair 1", "Secondary = brick: foot", "Primary = stump: seat"))
    p.write("parts.prm", text)
    for settings in ({}, {"Pair 1/Secondary": "stump: seat",
                          "Pair 1/Primary": "brick: foot"}):
        summary = run("parts.prm", settings)
        p.close(summary["pair_1_pressure"], 10., 1e-9, "two parts of a file")
    # Three bodies, the last pressed by a plate.
    p.write("three.prm", "set Scene = solid\nset Dimension = 3\n"
            + section("Solid", "Bodies = 3", "Pairs = 3", "Obstacles = 1")
            + section("Refinement", "Level = 0")
            + part(1, "stump", "Poisson ratio = 0",
                   "Support = ground: 0, 0, 0")
            + part(2, "brick", "Poisson ratio = 0")
            + body(3, bricks((2, 2, 2), 2), "Poisson ratio = 0",
                   "Support = 0: 0, free, free; 2: free, 0, free")
            + section("Pair 1", "Secondary = stump: seat",
                      "Primary = brick: foot", "Tied = true")
            + section("Pair 2", "Secondary = 3: 4", "Primary = brick: head")
            + section("Pair 3", "Secondary = 3: 5", "Obstacle = 1")
            + section("Obstacle 1", "Kind = plane", "Point = 0, 0, 2.97",
                      "Normal = 0, 0, -1"))
    for degree in (1, "auto"):
        summary = run("three.prm", {"Solid/Degree": degree})
        for number in (1, 2, 3):
            below(abs(summary[f"pair_{number}_force"][2]) - 10., 1e-6,
                  f"pair {number} of three, degree {degree}")
    # A plate on two boxes, whose facets are one side of a pair.
    p.write("plate.prm", solid(
        3, section("Refinement", "Level = 0"),
        *(body(1 + k, mesh, "Poisson ratio = 0", "Support = 4: 0, 0, 0")
          for k, mesh in enumerate((
              file("box-3-1.msh"),
              section("Mesh", "Generator = subdivided_hyper_rectangle",
                      "Arguments = 3, 3, 3: 2, 0, 0: 3, 1, 1: true")))),
        section("Pair 1", "Secondary = 1: 5; 2: 5", "Obstacle = 1"),
        section("Obstacle 1", "Kind = plane", "Point = 0, 0, 0.98",
                "Normal = 0, 0, -1"), obstacles=1))
    for settings in ({}, {"Solid/Degree": 1}, {"Solid/Degree": 2},
                     {"Method/Enforcement": "augmented lagrangian"}):
        summary = run("plate.prm", settings)
        below(abs(summary["pair_1_force"][2]) - 40., 1e-3, "plate")
        for b in (1, 2):
            below(summary[f"reaction_{b}"][2] - 20., 1e-3, "force of a box")


def check_both_kinds_on_a_side():
    """A plate of hexahedra on two columns, one of each kind of cells, which
    are one side of a pair."""
    p.write("left.msh", box((2, 2, 2), (0, 0, 0), (1, 1, 1), 0.2, 1).gmsh())

    def rectangle(low, high, n):
        return section(
            "Mesh", "Generator = subdivided_hyper_rectangle", "Arguments = "
            + " : ".join(", ".join(map(str, x)) for x in (n, low, high))
            + " : true")
    for secondary, primary in (("3: 4", "1: 5; 2: 5"), ("1: 5; 2: 5", "3: 4")):
        p.write("table.prm", solid(
            3, section("Refinement", "Level = 0"),
            body(1, file("left.msh"), "Support = 4: 0, 0, 0"),
            body(2, rectangle((2, 0, 0), (3, 1, 1), (3, 3, 3)),
                 "Support = 4: 0, 0, 0"),
            body(3, rectangle((0, 0, 1), (3, 1, 1.5), (7, 3, 1)),
                 "Support = 5: 0, 0, -0.01"),
            section("Pair 1", f"Secondary = {secondary}",
                    f"Primary = {primary}"), bodies=3))
        for degree in ("auto", 1, 2):
            summary = run("table.prm", {"Solid/Degree": degree})
            force = summary["pair_1_force"][2]
            for number in (1, 2):
                reaction = summary[f"reaction_{number}"][2]
                p.close(reaction, abs(force) / 2, 0.06, "force of a column")
            total = sum(summary[f"reaction_{b}"][2] for b in (1, 2, 3))
            below(total, 1e-6 * abs(force), "sum of the reactions")


def check_refusals():
    p.write("slider.prm", slider(3, 1))
    for settings, *texts in (
            ({"Refinement/Adaptive cycles": 1}, "Refinement/Adaptive cycles",
             "tetrahedra together with hexahedra"),
            ({"Refinement/Target error": 0.1}, "Refinement/Target error",
             "tetrahedra together with hexahedra"),
            ({"Refinement/Nested iteration": "true"},
             "Refinement/Nested iteration", "has no effect"),
            ({"Body 1/Element": "mean dilatation"}, "Body 1/Element",
             "constant strain in each cell"),
            ({"Body 1/Mesh/File": "both.msh"}, "Body 1/Mesh/File",
             "one kind", "Mesh/Part"),
            ({"Body 1/Mesh/File": "both.msh", "Body 1/Mesh/Part": "bricks"},
             "Body 1/Mesh", "'brick'")):
        refused("slider.prm", settings, *texts)
    # That of the hexahedra is no obstacle to it.
    run("slider.prm", {"Body 2/Element": "mean dilatation"})
    # Nor is dual mortar on them; on quadratic tetrahedra it is.
    run("slider.prm", {"Method/Discretisation": "dual mortar"})
    p.write("slider.prm", slider(3, 2))
    refused("slider.prm", {"Method/Discretisation": "dual mortar"},
            "Method/Discretisation", "no weight at the corners")


check_patch()
check_large_strain()
check_rings()
check_restart()
check_files()
check_levels()
check_motion()
check_parts()
check_both_kinds_on_a_side()
check_refusals()
p.finish()
