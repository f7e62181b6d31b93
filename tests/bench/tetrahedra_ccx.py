#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Abut and CalculiX (ccx, in Debian calculix-ccx) with the same quadratic
tetrahedra (C3D10), each on one thread.

Hertz: a stiff cap of a ball of radius 1 is pressed by 0.0025 into a unit cube, a
quarter of it, on meshes that do not match. Prints unknowns, the force divided by
that of a half space and its error (fine meshes of a rigid ball: 1.0524), seconds of
processor time, and for the connecting rod of prm/connecting-rod.prm the
displacement of the pin's end.

    tests/bench/tetrahedra_ccx.py build/release/abut [--long]
"""
import json
import math
import pathlib
import shutil
import sys
import tempfile

BENCH = pathlib.Path(__file__).resolve().parent
sys.path += [str(BENCH / "peers"), str(BENCH.parent / "app")]
import process  # noqa: E402
from block_scene import section, solid  # noqa: E402
from simplices import box  # noqa: E402

SCENES = BENCH.parents[1] / "prm"
# Faces of CalculiX's tetrahedra by corners.
FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))
DEPTH, STIFF = 0.0025, 1e4
HALF_SPACE = 4. / 3. / (1. - 0.3 ** 2) * DEPTH ** 1.5 / 4.
FINE = 1.0524


class Body:
    """A body of a file of gmsh's format 2.2."""

    def __init__(self, path, part=None):
        lines = iter(pathlib.Path(path).read_text().splitlines())
        self.nodes, self.cells, self.faces, names = {}, [], {}, {}
        for line in lines:
            if line == "$PhysicalNames":
                for _ in range(int(next(lines))):
                    dim, number, name = next(lines).split(maxsplit=2)
                    names[int(dim), int(number)] = name.strip('"')
            elif line == "$Nodes":
                for _ in range(int(next(lines))):
                    number, *x = next(lines).split()
                    self.nodes[int(number)] = [float(c) for c in x]
            elif line == "$Elements":
                for _ in range(int(next(lines))):
                    w = [int(word) for word in next(lines).split()]
                    group, nodes = w[3], w[3 + w[2]:]
                    dim = {9: 2, 11: 3}[w[1]]
                    name = names.get((dim, group), group)
                    if dim == 2:
                        self.faces.setdefault(name, []).append(nodes)
                    elif part in (None, name):
                        self.cells.append(nodes)
        used = {v for cell in self.cells for v in cell}
        self.nodes = {v: x for v, x in self.nodes.items() if v in used}
        side = {tuple(sorted(cell[v] for v in face)): (k, f)
                for k, cell in enumerate(self.cells)
                for f, face in enumerate(FACES)}
        self.sides = {}
        for name, faces in self.faces.items():
            here = [nodes for nodes in faces if used.issuperset(nodes)]
            self.faces[name] = here
            self.sides[name] = [side[tuple(sorted(nodes[:3]))]
                                for nodes in here]


class Input:
    """Text for CalculiX of two bodies; numbers of both begin with 1."""

    def __init__(self, bodies, stiffness):
        self.lines, self.bodies, self.first = [], bodies, []
        nodes = cells = 0
        self.lines.append("*NODE, NSET=ALL")
        for body in bodies:
            self.first.append((nodes, cells))
            self.lines += [f"{nodes + v}, " + ", ".join("%.15g" % c for c in x)
                           for v, x in body.nodes.items()]
            nodes += max(body.nodes)
            cells += len(body.cells)
        for b, (body, young) in enumerate(zip(bodies, stiffness)):
            n, e = self.first[b]
            self.lines.append(f"*ELEMENT, TYPE=C3D10, ELSET=BODY{b}")
            self.lines += [", ".join(map(str, [e + k + 1] + [
                n + v for v in cell[:8] + [cell[9], cell[8]]]))
                for k, cell in enumerate(body.cells)]
            self.lines += [f"*MATERIAL, NAME=M{b}", "*ELASTIC",
                           f"{young}, 0.3",
                           f"*SOLID SECTION, ELSET=BODY{b}, MATERIAL=M{b}"]

    def contact(self, secondary, primary, kind, slope):
        for name, (b, face) in (("SEC", secondary), ("PRI", primary)):
            self.lines.append(f"*SURFACE, NAME={name}, TYPE=ELEMENT")
            self.lines += [f"{self.first[b][1] + k + 1}, S{f + 1}"
                           for k, f in self.bodies[b].sides[face]]
        self.lines += [f"*CONTACT PAIR, INTERACTION=LAW, TYPE={kind}",
                       "SEC, PRI", "*SURFACE INTERACTION, NAME=LAW",
                       "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR",
                       f"{slope:.9g}, {1e-6 * slope:.9g}"]

    def step(self, supports, loads=()):
        """supports: body, face, component from 1 on, value."""
        held = {}
        for b, face, component, value in supports:
            for nodes in self.bodies[b].faces[face]:
                held.update({(self.first[b][0] + v, component): value
                             for v in nodes})
        self.lines += ["*STEP, INC=100",
                       "*STATIC, SOLVER=ITERATIVE CHOLESKY", "1., 1.",
                       "*CONTROLS, PARAMETERS=FIELD", "1e-5, 1e-3, , , 1e-5",
                       "*BOUNDARY"]
        self.lines += [f"{n}, {c}, {c}, {u:.15g}"
                       for (n, c), u in sorted(held.items())]
        if loads:
            self.lines.append("*CLOAD")
            self.lines += [f"{n}, 1, {f:.15g}" for n, f in loads]
        self.lines += ["*NODE PRINT, NSET=ALL", "U",
                       "*NODE PRINT, NSET=ALL", "RF", "*END STEP", ""]

    def run(self, folder):
        """Displacements and reactions by node, seconds."""
        (folder / "job.inp").write_text("\n".join(self.lines))
        used = process.run(["ccx", "job"], folder, "job.log", seconds=1500)
        if "Job finished" not in (folder / "job.log").read_text(
                errors="replace"):
            raise process.Failure("no convergence")
        tables, name = {}, None
        for line in (folder / "job.dat").read_text().splitlines():
            words = line.split()
            if "(" in line:
                name = words[0]
                tables[name] = {}
            elif len(words) == 4:
                tables[name][int(words[0])] = [float(w) for w in words[1:]]
        return tables["displacements"], tables["forces"], used


def run_abut(abut, scene, folder, *settings):
    words = [word for setting in settings for word in ("--set", setting)]
    used = process.run([str(abut), "run", str(scene), "--output", "out",
                        "--quiet", "--set", "Output/Fields=false", *words],
                       folder, "abut.log", seconds=1500)
    return json.loads((folder / "out/summary.json").read_text()), used


def graded(n, small, end):
    """n distances from 0 to end, the first is small, in geometric order."""
    low, high = 1., 9.
    for _ in range(80):
        ratio = 0.5 * (low + high)
        total = sum(small * ratio ** k for k in range(n))
        low, high = (ratio, high) if total < end else (low, ratio)
    return [sum(small * ratio ** j for j in range(k)) for k in range(n)] + [end]


def between(places, x):
    k = min(int(abs(x)), len(places) - 2)
    return places[k] + (abs(x) - k) * (places[k + 1] - places[k])


def hertz(abut, folder, n):
    places = graded(n, 0.1 / n, 1.)
    cube = box((n,) * 3, (0, 0, -n), (n, n, 0))
    (folder / "cube.msh").write_text(cube.curved(
        lambda x, y, z: (between(places, x), between(places, y),
                         -between(places, z) + 0.)))
    m = n + 1
    cap = box((m, m, 1), (0, 0, 0), (0.12, 0.12, 1))
    (folder / "cap.msh").write_text(cap.curved(
        lambda x, y, z: (x, y, (1 - z) * (1 - math.sqrt(1 - x * x - y * y))
                         + 0.05 * z)))
    planes = "0: 0, free, free; 2: free, 0, free; "
    (folder / "hertz.prm").write_text(solid(
        3, section("Refinement", "Level = 0"),
        section("Body 1", section("Mesh", "File = cube.msh"),
                "Young modulus = 1", "Poisson ratio = 0.3",
                f"Support = {planes}4: 0, 0, 0"),
        section("Body 2", section("Mesh", "File = cap.msh"),
                f"Young modulus = {STIFF}", "Poisson ratio = 0.3",
                f"Support = {planes}5: 0, 0, -{DEPTH}"),
        section("Pair 1", "Secondary = 1: 5", "Primary = 2: 4")))
    summary, used = run_abut(abut, "hertz.prm", folder)
    print(f"Hertz, {summary['dofs']} unknowns")
    show("Abut", summary["contact_force"] / HALF_SPACE, used)
    bodies = [Body(folder / "cube.msh"), Body(folder / "cap.msh")]
    for kind, slope in (("SURFACE TO SURFACE", 1e2 / 0.06 * n),
                        ("SURFACE TO SURFACE", 1e3 / 0.06 * n),
                        ("NODE TO SURFACE", 1e2 / 0.06 * n)):
        text = Input(bodies, (1., STIFF))
        text.contact((0, 5), (1, 4), kind, slope)
        supports = [(b, 2 * c, c + 1, 0.) for b in (0, 1) for c in (0, 1)]
        supports += [(0, 4, c, 0.) for c in (1, 2, 3)]
        supports += [(1, 5, c, -DEPTH if c == 3 else 0.) for c in (1, 2, 3)]
        text.step(supports)
        name = f"CalculiX, {kind.lower()}, penalty {slope:.2g}"
        try:
            _, forces, used = text.run(folder)
        except process.Failure as failure:
            print(f"  {name}: {failure}", flush=True)
            continue
        base = {v for nodes in bodies[0].faces[4] for v in nodes}
        show(name, sum(forces[v][2] for v in base) / HALF_SPACE, used)


def show(name, force, used):
    print(f"  {name}: {force:.4f}, {100. * (force / FINE - 1.):+.2f} %, "
          f"{used['processor']:.1f} s", flush=True)


def triangle_area(corners):
    a, b = ([x - y for x, y in zip(corner, corners[0])]
            for corner in corners[1:3])
    return 0.5 * math.hypot(a[1] * b[2] - a[2] * b[1],
                            a[2] * b[0] - a[0] * b[2],
                            a[0] * b[1] - a[1] * b[0])


def rod(abut, folder):
    summary, used = run_abut(abut, SCENES / "connecting-rod.prm", folder,
                             "Output/Points=2: -10, 0, 18; 1: 16, 0, 0")
    print(f"connecting rod, {summary['dofs']} unknowns: displacement of the "
          "pin's end and of the eye")
    print(f"  Abut: {summary['point_1'][0]:.5f}, {summary['point_2'][0]:.5f}, "
          f"{used['processor']:.1f} s", flush=True)
    file = SCENES / "connecting-rod.msh"
    bodies = [Body(file, "rod"), Body(file, "pin")]
    # Uniform traction: a third of a straight facet's load on each middle node.
    loads, total = {}, 0.
    for nodes in bodies[1].faces["boss"]:
        size = triangle_area([bodies[1].nodes[v] for v in nodes[:3]])
        total += size
        for v in nodes[3:]:
            loads[v] = loads.get(v, 0.) - size / 3.
    for kind, slope in (("SURFACE TO SURFACE", 1e7),):
        text = Input(bodies, (210000., 210000.))
        text.contact((1, "pin"), (0, "eye"), kind, slope)
        supports = [(b, f"{'xyz'[c]} = 0", c + 1, 0.) for b in (0, 1)
                    for c in (1, 2)]
        supports += [(0, "crank", c, 0.) for c in (1, 2, 3)]
        text.step(supports, [(text.first[1][0] + v, f * 5000. / total)
                             for v, f in loads.items()])
        try:
            moved, _, used = text.run(folder)
        except process.Failure as failure:
            print(f"  CalculiX, {kind.lower()}: {failure}", flush=True)
            continue

        def at(b, x):
            nodes = bodies[b].nodes
            v = min(nodes, key=lambda v: math.dist(nodes[v], x))
            return moved[text.first[b][0] + v][0]
        print(f"  CalculiX, {kind.lower()}: {at(1, (-10, 0, 18)):.5f}, "
              f"{at(0, (16, 0, 0)):.5f}, {used['processor']:.1f} s", flush=True)


def main():
    if not shutil.which("ccx"):
        raise SystemExit("ccx is not installed (Debian: calculix-ccx)")
    abut = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory(prefix="abut-bench-") as name:
        folder = pathlib.Path(name)
        rod(abut, folder)
        for n in (8, 12) if "--long" in sys.argv else (8,):
            hertz(abut, folder, n)


if __name__ == "__main__":
    main()
