# SPDX-License-Identifier: LGPL-2.1-or-later
"""deal.II's step-8 and step-17 with a wall beside the block: on their first mesh
the force of a program that shares nothing with Abut or deal.II, later near the
one of the finest mesh; step-8, whose block touches the wall and is guided, also the
force of a virtual displacement on each mesh, which goes to pi 0.2^2; step-17 the same on 1 and 3 ranks; step-44 of degree 1
those of the tutorial program with springs for a wall, and with its own
degree the same forces whether loads are reached in 5 steps or 10. At most 65
lines are added to step-8."""
import argparse
import math
import pathlib
import re
import subprocess
import sys
import tempfile

STEP_44 = """
subsection Geometry
  set Global refinement = 1
  set Pressure ratio p/p0 = 100
end
subsection Time
  set End time = 1
  set Time step size = {}
end
"""
LINEAR_44 = """
subsection Finite element system
  set Polynomial degree = 1
end
"""
# By tests/bench/step_44_springs.patch, extrapolated to rigid springs.
EXPECTED_44 = [0, 1.7756817, 7.7014548, 14.6718496]


def stiffness(h):
    """8 x 8, of bilinear elements with lambda = mu = 1 and 2 x 2 points."""
    g = 3 ** -0.5
    k = [[0.0] * 8 for _ in range(8)]
    for x in (-g, g):
        for y in (-g, g):
            grad = [(0.5 * a * (1 + b * y) / h, 0.5 * b * (1 + a * x) / h)
                    for a, b in CORNERS]
            for i in range(8):
                for j in range(8):
                    p, q = grad[i // 2], grad[j // 2]
                    a, b = i % 2, j % 2
                    k[i][j] += h * h / 4 * (
                        p[a] * q[b] + p[b] * q[a]
                        + (p[0] * q[0] + p[1] * q[1] if a == b else 0.0))
    return k


CORNERS = [(-1, -1), (1, -1), (-1, 1), (1, 1)]


def load(x, y):
    right = (x - 0.5) ** 2 + y * y < 0.04 or (x + 0.5) ** 2 + y * y < 0.04
    return (1.0 if right else 0.0, 1.0 if x * x + y * y < 0.04 else 0.0)


def system(n):
    """K, forces and half the bandwidth on n x n cells; unknown
    2 ((n + 1) i + j) + c of node (i, j)."""
    h, g = 2.0 / n, 3 ** -0.5
    size, band = 2 * (n + 1) ** 2, 2 * (n + 3)
    rows = [dict() for _ in range(size)]
    forces = [0.0] * size
    cell = stiffness(h)
    for i in range(n):
        for j in range(n):
            dofs = [2 * ((n + 1) * (i + (a > 0)) + j + (b > 0)) + c
                    for a, b in CORNERS for c in (0, 1)]
            for r in range(8):
                for s in range(8):
                    row = rows[dofs[r]]
                    row[dofs[s]] = row.get(dofs[s], 0.0) + cell[r][s]
            for x in (-g, g):
                for y in (-g, g):
                    f = load(-1 + h * (i + 0.5 + x / 2), -1 + h * (j + 0.5 + y / 2))
                    for r, (a, b) in enumerate(CORNERS):
                        shape = (1 + a * x) * (1 + b * y) / 4 * h * h / 4
                        for c in (0, 1):
                            forces[dofs[2 * r + c]] += shape * f[c]
    return rows, forces, band


def solve(rows, forces, band, held):
    """Gauss' elimination within the band; values that are held."""
    size = len(rows)
    a = []
    b = list(forces)
    for i in range(size):
        line = [0.0] * (2 * band + 1)
        if i in held:
            line[band], b[i] = 1.0, held[i]
        else:
            for j, value in rows[i].items():
                if j in held:
                    b[i] -= value * held[j]
                else:
                    line[band + j - i] = value
        a.append(line)
    for i in range(size):
        pivot = a[i]
        for k in range(i + 1, min(size, i + band + 1)):
            factor = a[k][band + i - k] / pivot[band]
            if factor != 0.0:
                line, shift = a[k], i - k
                for j in range(band, 2 * band + 1):
                    if pivot[j] != 0.0:
                        line[j + shift] -= factor * pivot[j]
                b[k] -= factor * b[i]
    for i in reversed(range(size)):
        last = min(size, i + band + 1)
        b[i] = (b[i] - sum(a[i][band + j - i] * b[j]
                           for j in range(i + 1, last))) / a[i][band]
    return b


def expected_force(n, wall, is_guided):
    """By active sets on n x n cells; sides above and below are free or guided."""
    rows, forces, band = system(n)
    left = {2 * j + c: 0.0 for j in range(n + 1) for c in (0, 1)}
    if is_guided:
        left.update({2 * ((n + 1) * i + j) + 1: 0.0 for i in range(n + 1) for j in (0, n)})
    side = [2 * ((n + 1) * n + j) for j in range(n + 1)]
    closed = set()
    while True:
        u = solve(rows, forces, band, {**left, **{i: wall for i in closed}})
        force = {i: forces[i] - sum(v * u[j] for j, v in rows[i].items())
                 for i in side}
        new = {i for i in side
               if force[i] > 0.0 and i in closed or u[i] > wall + 1e-12}
        if new == closed:
            return sum(force[i] for i in closed)
        closed = new


def output_of(command, parameters=None):
    with tempfile.TemporaryDirectory(prefix="abut-test-") as folder:
        if parameters:
            (pathlib.Path(folder) / "parameters.prm").write_text(parameters)
        return subprocess.run(command, cwd=folder, text=True, check=True,
                              capture_output=True, timeout=300).stdout


def forces_of(command, parameters=None):
    return [float(f) for f in re.findall(r"^ *Force: (\S+)", output_of(command, parameters),
                                         re.MULTILINE)]


def is_right(name, forces, n_cells, n_cycles, wall, is_guided):
    expected = expected_force(n_cells, wall, is_guided)
    print(f"{name}: forces {forces}; expected first: {expected:.6g}")
    return (len(forces) == n_cycles and abs(forces[0] / expected - 1) < 1e-5
            and abs(forces[-2] / forces[-1] - 1) < 0.01)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", required=True)
    parser.add_argument("--petsc", help="step-17; without: deal.II has no PETSc")
    parser.add_argument("--blocks", help="step-44")
    parser.add_argument("--patches", type=pathlib.Path, required=True)
    arguments = parser.parse_args()
    patch = (arguments.patches / "step-8.patch").read_text()
    n_lines = len(re.findall(r"^\+(?!\+\+)", patch, re.MULTILINE))
    lines = re.findall(r"^ *Force: (\S+) by virtual work: (\S+)$",
                       output_of([arguments.program]), re.MULTILINE)
    forces, by_work = ([float(word) for word in column] for column in zip(*lines))
    # On the block, which the wall pushes back.
    forces, by_work = ([-f for f in column] for column in (forces, by_work))
    good = is_right("step-8", forces, 16, 8, 0, True)
    good &= all(abs(a / b - 1) < 1e-5 for a, b in zip(forces, by_work))
    good &= abs(forces[-1] / (math.pi * 0.2**2) - 1) < 0.003
    if n_lines > 65:
        print(f"FAILED: {n_lines} lines are added to step-8")
        good = False
    if arguments.petsc:
        alone = forces_of([arguments.petsc])
        good &= is_right("step-17", alone, 8, 10, 0.01, False)
        shared = forces_of(["mpirun", "--oversubscribe", "-np", "3",
                            arguments.petsc])
        good &= all(abs(a / b - 1) < 1e-5 for a, b in zip(alone, shared))
        good &= len(alone) == len(shared)
    if arguments.blocks:
        ways = [[f for f in forces_of([arguments.blocks], STEP_44.format(step))
                 if f == 0 or f > 1e-3] for step in (0.2, 0.1)]
        linear = [f for f in forces_of([arguments.blocks],
                                       STEP_44.format(0.2) + LINEAR_44)
                  if f == 0 or f > 1e-3]
        print(f"step-44: {ways}, linear: {linear}")
        good &= len(linear) == 4 and all(
            abs(f - e) <= 5e-4 * e for f, e in zip(linear, EXPECTED_44))
        good &= len(ways[0]) == 4 and len(ways[1]) == 10 and ways[0][-1] > 1
        good &= all(abs(a - b) <= 1e-3 * a
                    for a, b in zip(ways[0], ways[1][1::2]))
    if not good:
        print("FAILED")
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
