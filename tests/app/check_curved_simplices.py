# SPDX-License-Identifier: LGPL-2.1-or-later
"""Triangles of six and tetrahedra of ten nodes with curved edges: volumes, the
patch test, levels, tubes under pressure and in contact against Lame's
formulas, facets of degree 2 of obstacles, degree 1."""
import math
import shutil
import signal
import subprocess
import time

import vtu
from block_scene import section
from program import Program
from simplices import box

p = Program()
run = p.run_scene
INSIDE, OUTSIDE, E, NU = 1., 2., 1000., 0.3


def ring(divisions, low, high):
    """A quarter of a tube; 0: inside, 1: outside, 2: y = 0, 3: x = 0."""
    return box(divisions, (low, 0), (high, math.pi / 2), 0.2)


def around(r, angle):
    return r * math.cos(angle), r * math.sin(angle)


def shell(r, a, b):
    """Part of a ball above a square."""
    size = math.sqrt(1 + a * a + b * b)
    return r * a / size, r * b / size, r / size


def tube(number, file, *lines):
    return section(f"Body {number}", section("Mesh", f"File = {file}"),
                   f"Young modulus = {E}", f"Poisson ratio = {NU}", *lines)


def scene(dim, *parts, bodies=1, pairs=0):
    return (f"set Scene = solid\nset Dimension = {dim}\n"
            + section("Solid", f"Bodies = {bodies}", f"Pairs = {pairs}")
            + "".join(parts))


def check_volumes():
    """Of the body force 1 by the supports' reaction."""
    solid_angle = 4 * math.asin(0.2)
    for dim, mesh, change, volume, bound in (
            (2, ring((2, 4), INSIDE, OUTSIDE), around, 0.75 * math.pi, 2e-4),
            (3, box((2, 2, 2), (1, -.5, -.5), (2, .5, .5), 0.1), shell,
             7 / 3 * solid_angle, 2e-3)):
        fixed = ", ".join("0" * dim)
        push = ", ".join(["1"] + ["0"] * (dim - 1))
        errors = []
        for bend in (True, False):
            p.write("body.msh", mesh.curved(change, bend))
            p.write("body.prm", scene(dim, tube(
                1, "body.msh", f"Support = 2: {fixed}",
                f"Body force = {push}"),
                section("Refinement", "Level = 0")))
            for level in (0, 1):
                force = run("body.prm", {"Refinement/Level": level}
                            )["reaction_1"][0]
                errors.append(abs(abs(force) - volume) / volume)
        p.expect(errors[0] < bound, f"{dim}D: volume is wrong by {errors}")
        # Children have the shape of their parents.
        p.expect(abs(errors[1] - errors[0]) < 1e-11, f"{dim}D: {errors}")
        p.expect(errors[2] > 20 * errors[0], f"{dim}D, straight: {errors}")


def check_patch():
    """Edges curved inside of boxes, and order 2 with straight edges."""
    def bent(*x):
        bubble = math.prod(math.sin(math.pi * c) ** 2 for c in x)
        return tuple(c + 0.05 * bubble for c in x)

    for dim in (2, 3):
        for bend in (True, False):
            settings = {"Refinement/Level": 0}
            for body in (1, 2):
                mesh = box((4 - dim + body,) * dim, (0,) * (dim - 1)
                           + (body - 1,), (1,) * (dim - 1) + (body,),
                           0.1, body)
                name = f"box-{body}.msh"
                p.write(name, mesh.curved(bent, bend))
                settings[f"Body {body}/Mesh/File"] = p.folder / name
            for level in (0, 1) if dim == 2 else (0,):
                settings["Refinement/Level"] = level
                summary, _ = p.solve_with(f"patch-{dim}d.prm", settings)
                error = summary["energy_norm_error"]
                p.expect(error < 1e-11,
                         f"patch {dim}D, {bend}, level {level}: {error}")
                p.close(summary["pair_1_pressure"], 1., 1e-11, "pressure")


def lame(r):
    """Displacement and pressure at r for the pressure 1 inside."""
    factor = INSIDE ** 2 / (OUTSIDE ** 2 - INSIDE ** 2)
    return ((1 + NU) / E * factor * ((1 - 2 * NU) * r + OUTSIDE ** 2 / r),
            factor * (OUTSIDE ** 2 / r ** 2 - 1))


SYMMETRY = "Support = 2: free, 0; 3: 0, free"


def check_tube():
    errors = []
    for bend in (True, False):
        p.write("tube.msh", ring((2, 4), INSIDE, OUTSIDE).curved(around, bend))
        p.write("tube.prm", scene(2, tube(
            1, "tube.msh", SYMMETRY, "Pressure = 0: 1"),
            section("Output", "Points = 1: 1, 0"),
            section("Refinement", "Level = 0")))
        u = run("tube.prm")["point_1"][0]
        errors.append(abs(u / lame(INSIDE)[0] - 1))
    p.expect(errors[0] < 3e-3 and errors[1] > 10 * errors[0],
             f"tube: displacements are wrong by {errors}")


def check_contact():
    """Two tubes on each other, of meshes that do not match."""
    errors = []
    for bend in (True, False):
        for number, low, n in ((1, INSIDE, 10), (2, 1.5, 14)):
            p.write(f"tube-{number}.msh",
                    ring((2, n), low, low + .5).curved(around, bend))
        p.write("tubes.prm", scene(
            2, tube(1, "tube-1.msh", SYMMETRY, "Pressure = 0: 1"),
            tube(2, "tube-2.msh", SYMMETRY),
            section("Pair 1", "Secondary = 1: 1", "Primary = 2: 0"),
            section("Output", "Points = 2: 2, 0"),
            section("Refinement", "Level = 0"), bodies=2, pairs=1))
        summary = run("tubes.prm")
        u, pressure = lame(OUTSIDE)[0], lame(1.5)[1]
        errors.append([abs(summary["point_1"][0] / u - 1),
                       abs(summary["pair_1_pressure"] / pressure - 1)])
    p.expect(errors[0][0] < 2e-3 and errors[0][1] < 0.05
             and errors[1][1] > 10 * errors[0][1],
             f"tubes in contact: displacement and pressure wrong by {errors}")


def check_pressures_at_nodes():
    """Corner functions of curved facets have integrals near 0: forces divided
    by them would be pressures of 1e5."""
    summary, _ = p.solve("connecting-rod.prm")
    pressures = [value for piece in vtu.pieces(p.folder
                                               / "out/contact_0000.0.vtu")
                 for value in piece.fields["pressure"]]
    largest = summary["pair_1_pressure"]
    p.expect(.3 * largest < max(pressures) < 1.05 * largest
             and min(pressures) > -.1 * largest,
             f"pressures at nodes from {min(pressures)} to {max(pressures)}, "
             f"largest of the pair {largest}")


def check_degree_1():
    p.write("tube.msh", ring((2, 4), INSIDE, OUTSIDE).curved(around))
    p.write("tube.prm", scene(2, tube(1, "tube.msh", SYMMETRY,
                                      "Pressure = 0: 1")))
    result = p.call("check", "tube.prm", "--set", "Solid/Degree=1")
    p.expect(result.returncode == 0 and "middle nodes" in result.stdout
             + result.stderr, f"degree 1: {result.stdout} {result.stderr}")
    for name, value in (("Adaptive cycles", 1), ("Target error", 0.1)):
        result = p.call("run", "tube.prm", "--output", "out", "--quiet",
                        "--set", f"Refinement/{name}={value}")
        p.expect(result.returncode == 2 and f"Refinement/{name}" in result.stderr
                 and "curved edges" in result.stderr,
                 f"{name}: {result.returncode} {result.stderr}")


def check_restart():
    """The connecting rod, stopped and resumed on other numbers of ranks."""
    for kind in ("prm", "msh"):
        name = f"connecting-rod.{kind}"
        shutil.copy(p.source / "prm" / name, p.folder / name)
    p.write("rod.prm", (p.folder / "connecting-rod.prm").read_text().replace(
        "-5000/", "-t*5000/") + section("Load steps", "Steps = 4")
        + section("Checkpoint", "Every steps = 1"))
    whole = run("rod.prm")
    for ranks in (2, 3):
        shutil.rmtree(p.folder / "out")
        process = subprocess.Popen(
            [p.abut, "run", "rod.prm", "--output", "out", "--quiet"],
            cwd=p.folder)
        while process.poll() is None and not any(
                (p.folder / f"out/checkpoint.{n}").exists() for n in (2, 3)):
            time.sleep(0.005)
        process.send_signal(signal.SIGTERM)
        process.wait()
        p.expect(process.returncode == 4, f"stopped: {process.returncode}")
        resumed = p.expect_run(p.call("run", "rod.prm", "--output", "out",
                                      "--quiet", "--resume", ranks=ranks), 0)
        for a, b in zip(whole["pair_1_force"], resumed["pair_1_force"]):
            p.expect(abs(a - b) < 1e-9 * whole["pair_1_force"][0],
                     f"resumed on {ranks} ranks: {b} is not {a}")


check_volumes()
check_patch()
check_restart()
check_tube()
check_contact()
check_pressures_at_nodes()
check_degree_1()
p.finish()
