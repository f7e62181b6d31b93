#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Triangles and tetrahedra against closed forms.

Prints the errors of patch tests with meshes that do not match, on 1 to 3 ranks;
of the press fit of rings by level, whose displacement is Lame's; the stiffness of
a cantilever of linear and quadratic tetrahedra with what ABUT-F16 reports; and
the force of a rigid ball on a cube divided by that on a half space, on meshes
graded by hand and adaptive ones. Fine meshes of hexahedra have 1.0524. At the
end iterations of the last mesh and processor seconds of linear systems with
algebraic and geometric multigrid, hexahedra beside tetrahedra, and of
constraints that are eliminated or solved for as saddle points.

    tests/bench/tetrahedra.py build/release/abut
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

TESTS = pathlib.Path(__file__).resolve().parents[1]
SCENES = TESTS.parent / "prm"
sys.path.insert(0, str(TESTS / "app"))
from block_scene import section  # noqa: E402
from simplices import box  # noqa: E402

# Of the layers of a graded cube along each axis.
SMALL, N_SMALL, N_LAYERS = 0.03, 2, 5


class Bench:
    def __init__(self, abut, folder):
        self.abut = str(pathlib.Path(abut).resolve())
        self.folder = pathlib.Path(folder)

    def write(self, name, text):
        (self.folder / name).write_text(text)
        return self.folder / name

    def run(self, scene, settings, ranks=1):
        mpi = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        words = [word for name, value in settings.items()
                 for word in ("--set", f"{name}={value}")]
        result = subprocess.run(
            [*mpi, self.abut, "run", str(scene), "--output", "out", "--quiet",
             *words], cwd=self.folder, capture_output=True, text=True,
            check=False)
        if result.returncode != 0:
            raise SystemExit(f"{scene}: exit code {result.returncode}\n"
                             + result.stderr)
        return json.loads((self.folder / "out/summary.json").read_text())


def print_patches(bench):
    print("patch tests: relative error in energy norm")
    for dim in (2, 3):
        files = {}
        for number in (1, 2):
            low = (0,) * (dim - 1) + (number - 1,)
            mesh = box((4 - dim + number,) * dim, low,
                       (1,) * (dim - 1) + (number,), 0.2, number)
            files[f"Body {number}/Mesh/File"] = bench.write(
                f"box-{dim}-{number}.msh", mesh.gmsh())
        for degree in (1, 2):
            for ranks in (1, 2, 3):
                summary = bench.run(SCENES / f"patch-{dim}d.prm", {
                    **files, "Solid/Degree": degree, "Refinement/Level": 1,
                    "Method/Final linear tolerance": 1e-13}, ranks)
                print(f"  {dim}D, degree {degree}, ranks {ranks}: "
                      f"{summary['energy_norm_error']:.1e}, "
                      f"{summary['dofs']} unknowns", flush=True)


def print_rings(bench):
    print("press fit of rings, triangles: relative error of the displacement")
    for degree in (1, 2):
        for curved in (False, True) if degree == 2 else (False,):
            settings = {"Solid/Degree": degree}
            for number, n, radius in ((1, 4, 1), (2, 3, 2)):
                mesh = box((2, n), (radius, 0.), (radius + 1, 0.5 * math.pi))
                ids = {0: 0, 1: 1, 2: 3, 3: 2}
                mesh.faces = [(ids[id_], face) for id_, face in mesh.faces]

                def around(r, angle):
                    return r * math.cos(angle), r * math.sin(angle)
                name = f"ring-{number}.msh"
                if curved:
                    bench.write(name, mesh.curved(around))
                else:
                    mesh.mapped(around)
                    bench.write(name, mesh.gmsh())
                    settings[f"Body {number}/Mesh/Curved sides"] = \
                        "0, 1: circle: 0, 0"
                settings[f"Body {number}/Mesh/File"] = bench.folder / name
            errors = []
            for level in range(4):
                summary = bench.run(SCENES / "press-fit.prm",
                                    {**settings, "Refinement/Level": level})
                errors.append(abs(summary["point_3"][0] / 0.005625 - 1.))
            orders = [math.log2(a / b) for a, b in zip(errors, errors[1:])]
            print(f"  degree {degree}, {'curved' if curved else 'straight'} "
                  "edges: " + ", ".join(f"{e:.2e}" for e in errors)
                  + "; orders " + ", ".join(f"{o:.2f}" for o in orders),
                  flush=True)


def print_cantilever(bench):
    # Timoshenko's beam, nu = 0.3, shear coefficient 5/6.
    inertia, force = 1. / 12., 1e-5
    exact = force * 1000. / (3. * inertia) + force * 10. * 2.6 / (5. / 6.)
    print("cantilever 10 x 1 x 1: deflection, and the part F16 reports")
    for n in (1, 2, 4):
        bench.write("beam.msh", box((10 * n, n, n), (0, 0, 0),
                                    (10, 1, 1)).gmsh())
        scene = bench.write(
            "cantilever.prm", "set Scene = solid\nset Dimension = 3\n"
            + section("Refinement", "Level = 0")
            + section("Body 1", section("Mesh", "File = beam.msh"),
                      "Support = 0: 0, 0, 0", f"Traction = 1: 0, 0, -{force}",
                      "Young modulus = 1", "Poisson ratio = 0.3")
            + section("Output", "Points = 1: 10, 0.5, 0.5", "Fields = false"))
        for degree in (1, 2):
            summary = bench.run(scene, {"Solid/Degree": degree})
            print(f"  {n} cells across, degree {degree}, "
                  f"{summary['dofs']} unknowns: "
                  f"{-summary['point_1'][2] / exact:.3f}, "
                  f"{summary.get('locked_energy', 0.):.2f}", flush=True)


def graded_cube():
    low, high = 1., 6.
    for _ in range(80):
        ratio = 0.5 * (low + high)
        row = [SMALL] * N_SMALL + [SMALL * ratio ** k
                                   for k in range(1, N_LAYERS - N_SMALL + 1)]
        low, high = (ratio, high) if sum(row) < 1. else (low, ratio)
    place = [sum(row[:k]) for k in range(N_LAYERS)] + [1.]
    # From the top down, so that ids are those of prm/tetrahedra.prm.
    mesh = box((N_LAYERS,) * 3, (0, 0, -N_LAYERS), (N_LAYERS, N_LAYERS, 0))
    return mesh.mapped(lambda x, y, z: (place[round(x)], place[round(y)],
                                        -place[round(-z)] + 0.)).gmsh()


def print_hertz(bench):
    half_space = 4. / 3. / (1. - 0.3 ** 2) * 0.0025 ** 1.5 / 4.
    print("rigid ball on a cube: force by that on a half space")
    file = bench.write("graded.msh", graded_cube())
    scene = SCENES / "tetrahedra.prm"

    def show(what, settings):
        summary = bench.run(scene, settings)
        print(f"  {what}, {summary['dofs']} unknowns: "
              f"{-summary['pair_1_force'][2] / half_space:.4f}", flush=True)
    for degree, level in ((1, 0), (1, 1), (2, 0), (2, 1)):
        show(f"graded, degree {degree}, level {level}",
             {"Body 1/Mesh/File": file, "Solid/Degree": degree,
              "Refinement/Level": level, "Refinement/Adaptive cycles": 0})
    for cycles in (4, 5, 6):
        show(f"adaptive, {cycles} cycles",
             {"Refinement/Adaptive cycles": cycles})
    show("adaptive, graded first mesh",
         {"Body 1/Mesh/File": file, "Refinement/Level": 0,
          "Refinement/Adaptive cycles": 4})


def print_systems(bench):
    print("linear systems: unknowns, iterations, seconds of them, of the run")

    def show(what, scene, settings):
        summary = bench.run(SCENES / scene, {"Output/Fields": "false",
                                             **settings})
        solve = summary["sections"]["solve"]["processor_seconds"]
        print(f"  {what}: {summary['dofs']}, "
              f"{summary['linear_iterations_on_last_level']}, {solve:.2f}, "
              f"{summary['processor_seconds']:.2f}; "
              f"{summary['linear_solver']}", flush=True)
    for solver in ("iterative", "geometric"):
        for what, scene, settings in (
                ("tetrahedra, degree 2", "tetrahedra.prm",
                 {"Refinement/Level": 3, "Refinement/Adaptive cycles": 0}),
                ("tetrahedra, degree 1", "tetrahedra.prm",
                 {"Solid/Degree": 1, "Refinement/Level": 4,
                  "Refinement/Adaptive cycles": 0}),
                ("adaptive, degree 2", "tetrahedra.prm",
                 {"Refinement/Adaptive cycles": 6}),
                ("hexahedra, degree 2", "elastic-sphere.prm",
                 {"Solid/Degree": 2, "Refinement/Level": 4})):
            show(what, scene, {"Solver/Linear solver": solver, **settings})
    for what in ("dual mortar", "mortar"):
        show(f"hexahedra, degree 2, {what}", "two-blocks-3d.prm",
             {"Solid/Degree": 2, "Refinement/Level": 2,
              "Method/Discretisation": what})


def main():
    with tempfile.TemporaryDirectory(prefix="abut-bench-") as folder:
        bench = Bench(sys.argv[1], folder)
        print_patches(bench)
        print_rings(bench)
        print_cantilever(bench)
        print_hertz(bench)
        print_systems(bench)


if __name__ == "__main__":
    main()
