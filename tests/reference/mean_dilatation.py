#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""A pad of nearly incompressible rubber pressed by a plate: a few cells with a
pressure and a dilatation of their own.

    mean_dilatation.py [tests/scenes/rubber-pad.json]

prints figures, or looks whether that file has them.

Cells of degree 1, Gauss' two points in each direction. Displacement u, and in
each cell a pressure p and a dilatation theta, all of them unknowns, make

    sum of  mu/2 (F:F - 3 - 2 ln J) + lambda/2 (ln theta)^2 + p (J - theta)

stationary, F = 1 + grad u with F_zz = 1, or 1 + u_x/x around an axis. Newton's
method on all unknowns, derivatives of the forces by complex steps. Below the
pad is held, above it is pressed flat without friction: all its upper nodes go
down by the same. Nothing is shared with Abut, which has no unknowns p and
theta.
"""
import cmath
import itertools
import json
import math
import sys

YOUNG, NU = 1., 0.4999
MU, LAMBDA = YOUNG / (2 * (1 + NU)), YOUNG * NU / ((1 + NU) * (1 - 2 * NU))
GAUSS = (0.5 - math.sqrt(1 / 12), 0.5 + math.sqrt(1 / 12))
STEPS = 3


def shape_functions(dim, place, size):
    """Values and gradients of a box."""
    values, slopes = [], []
    for corner in itertools.product((0, 1), repeat=dim):
        line = [s if c else 1 - s for c, s in zip(corner, place)]
        values.append(math.prod(line))
        slopes.append([math.prod(line[e] for e in range(dim) if e != d)
                       * (1 if corner[d] else -1) / size[d]
                       for d in range(dim)])
    return values, slopes


class Pad:
    """A box of n cells in each direction; the last is that of the plate."""

    def __init__(self, n, lengths, axisymmetric=False):
        self.n, self.dim, self.rings = n, len(n), axisymmetric
        self.size = [length / k for length, k in zip(lengths, n)]
        self.nodes = list(itertools.product(*(range(k + 1) for k in n)))
        number = {node: i for i, node in enumerate(self.nodes)}
        self.cells = [[number[tuple(a + b for a, b in zip(cell, corner))]
                       for corner in itertools.product((0, 1),
                                                       repeat=self.dim)]
                      for cell in itertools.product(*(range(k) for k in n))]
        self.points = [shape_functions(self.dim, place, self.size)
                       for place in itertools.product(GAUSS, repeat=self.dim)]
        self.volume = math.prod(self.size) / len(self.points)
        n_u = len(self.nodes) * self.dim
        self.n_all = n_u + 2 * len(self.cells)
        self.x = [0.] * n_u + [0., 1.] * len(self.cells)

    def dofs(self, cell):
        own = [self.dim * i + d for i in self.cells[cell]
               for d in range(self.dim)]
        first = len(self.nodes) * self.dim + 2 * cell
        return own + [first, first + 1]

    def forces(self, cell, values):
        """The derivative of the functional by the unknowns of a cell."""
        dim, n = self.dim, len(self.cells[cell])
        pressure, theta = values[-2:]
        result = [0.] * len(values)
        for shape, slopes in self.points:
            weight = self.volume
            f = [[sum(values[dim * i + a] * slopes[i][b] for i in range(n))
                  + (a == b) for b in range(dim)] for a in range(dim)]
            around = 1.
            if self.rings:
                radius = sum(shape[i] * self.nodes[self.cells[cell][i]][0]
                             * self.size[0] for i in range(n))
                weight *= 2 * math.pi * radius
                around = 1 + sum(shape[i] * values[dim * i]
                                 for i in range(n)) / radius
            cofactor, det = cofactors(f)
            volume = det * around
            # stress = mu (F - F^-T) + p J F^-T
            factor = (pressure - MU / volume) * around
            for i in range(n):
                for a in range(dim):
                    result[dim * i + a] += weight * sum(
                        (MU * f[a][b] + factor * cofactor[a][b])
                        * slopes[i][b] for b in range(dim))
                if self.rings:
                    result[dim * i] += weight * shape[i] / radius * (
                        MU * around + (pressure - MU / volume) * det)
            result[-2] += weight * (volume - theta)
            result[-1] += weight * (LAMBDA * cmath.log(theta) / theta
                                    - pressure)
        return result

    def energy(self):
        total = 0.
        dim = self.dim
        for cell, nodes in enumerate(self.cells):
            theta = self.x[self.dofs(cell)[-1]]
            for shape, slopes in self.points:
                weight, around = self.volume, 1.
                f = [[sum(self.x[dim * i + a] * slopes[k][b]
                          for k, i in enumerate(nodes)) + (a == b)
                      for b in range(dim)] for a in range(dim)]
                if self.rings:
                    radius = sum(s * self.nodes[i][0] * self.size[0]
                                 for s, i in zip(shape, nodes))
                    weight *= 2 * math.pi * radius
                    around = 1 + sum(s * self.x[dim * i] for s, i in
                                     zip(shape, nodes)) / radius
                square = sum(v * v for row in f for v in row)
                if dim == 2:
                    square += around**2
                total += weight * (
                    MU / 2 * (square - 3
                              - 2 * math.log(cofactors(f)[1] * around))
                    + LAMBDA / 2 * math.log(theta)**2)
        return total

    def press(self, way):
        """Newton's method in a few steps; returns the force on the plate."""
        last = self.dim - 1
        held = set()
        for i, node in enumerate(self.nodes):
            if node[last] == 0:
                held.update(self.dim * i + d for d in range(self.dim))
            elif node[last] == self.n[last]:
                held.add(self.dim * i + last)
            if self.rings and node[0] == 0:
                held.add(self.dim * i)
        upper = [self.dim * i + last for i, node in enumerate(self.nodes)
                 if node[last] == self.n[last]]
        free = [i for i in range(self.n_all) if i not in held]
        place = {dof: k for k, dof in enumerate(free)}
        for step in range(STEPS):
            for dof in upper:
                self.x[dof] = -way * (step + 1) / STEPS
            for _ in range(30):
                matrix, right = self.system(free, place)
                change = solve(matrix, right)
                for dof, value in zip(free, change):
                    self.x[dof] -= value
                if max(map(abs, change)) < 1e-13:
                    break
            else:
                raise SystemExit("Newton's method did not end")
        force = 0.
        for cell in range(len(self.cells)):
            dofs = self.dofs(cell)
            own = self.forces(cell, [self.x[i] for i in dofs])
            force += sum(value.real for dof, value in zip(dofs, own)
                         if dof in upper)
        return force

    def system(self, free, place):
        matrix = [[0.] * len(free) for _ in free]
        right = [0.] * len(free)
        for cell in range(len(self.cells)):
            dofs = self.dofs(cell)
            values = [complex(self.x[i]) for i in dofs]
            for dof, value in zip(dofs, self.forces(cell, values)):
                if dof in place:
                    right[place[dof]] += value.real
            for k, column in enumerate(dofs):
                if column not in place:
                    continue
                values[k] += 1e-30j
                for dof, value in zip(dofs, self.forces(cell, values)):
                    if dof in place:
                        matrix[place[dof]][place[column]] += value.imag / 1e-30
                values[k] -= 1e-30j
        return matrix, right

    def displacement(self, node):
        i = self.nodes.index(node)
        return self.x[self.dim * i:self.dim * (i + 1)]


def cofactors(f):
    """d det F / dF and det F."""
    if len(f) == 2:
        return ([[f[1][1], -f[1][0]], [-f[0][1], f[0][0]]],
                f[0][0] * f[1][1] - f[0][1] * f[1][0])
    result = [[f[(i + 1) % 3][(j + 1) % 3] * f[(i + 2) % 3][(j + 2) % 3]
               - f[(i + 1) % 3][(j + 2) % 3] * f[(i + 2) % 3][(j + 1) % 3]
               for j in range(3)] for i in range(3)]
    return result, sum(a * b for a, b in zip(f[0], result[0]))


def solve(matrix, right):
    """Gauss, largest pivot of the column."""
    n = len(right)
    rows = [row + [r] for row, r in zip(matrix, right)]
    for k in range(n):
        best = max(range(k, n), key=lambda i: abs(rows[i][k]))
        rows[k], rows[best] = rows[best], rows[k]
        pivot = rows[k]
        for i in range(k + 1, n):
            factor = rows[i][k] / pivot[k]
            if factor:
                row = rows[i]
                for j in range(k, n + 1):
                    row[j] -= factor * pivot[j]
    x = [0.] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))
                ) / rows[k][k]
    return x


CASES = {"plane strain": Pad((6, 3), (2., 1.)),
         "axisymmetric": Pad((4, 3), (1., 1.), True),
         "space": Pad((2, 2, 2), (2., 1.5, 1.))}


def main():
    figures = {}
    for name, pad in CASES.items():
        force = pad.press(0.25)
        figures[name] = {
            "energy": pad.energy(),
            "force": force,
            "corner": pad.displacement(pad.n)}
    if len(sys.argv) < 2:
        print(json.dumps(figures, indent=2))
        return
    with open(sys.argv[1], encoding="utf-8") as file:
        cases = {case["name"]: case["summary"]
                 for case in json.load(file)["cases"]}
    for name, own in figures.items():
        there = cases[name]
        pairs = [(own["energy"], there["energy"]["value"]),
                 (own["force"], there["pair_1_force"]["value"][-1])]
        pairs += zip(own["corner"], there["point_1"]["value"])
        for mine, given in pairs:
            if abs(mine - given) > 1e-9 * max(abs(mine), 1e-3):
                raise SystemExit(f"{name}: {given} is {mine}")
    print(f"{len(figures)} cases agree")


main()
