#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The membrane of prm/step-41.prm on a grid of long cells, independent of Abut.

Bilinear elements in nx x ny rectangular cells of the square (-1, 1)^2, the
obstacle, stairs or a plane of some height, at the nodes; a primal-dual active
set from an empty one, Cholesky's method on the band. Prints the energy, the
force of contact and the nodes in contact; or compares them with what follows.

    tests/reference/long_cells.py 8 512 -0.3
    tests/reference/long_cells.py 8 512 -0.3 ENERGY FORCE NODES
"""
import sys

LOAD = -10.


def stairs(x):
    return -.2 if x < -.5 else -.4 if x < 0 else -.6 if x < .5 else -.8


def cell_matrix(hx, hy):
    """Of the Laplacian; nodes (0,0), (1,0), (0,1), (1,1)."""
    stiff, mass = [[1, -1], [-1, 1]], [[2 / 6, 1 / 6], [1 / 6, 2 / 6]]
    return [[stiff[a % 2][b % 2] / hx * mass[a // 2][b // 2] * hy
             + mass[a % 2][b % 2] * hx * stiff[a // 2][b // 2] / hy
             for b in range(4)] for a in range(4)]


class Membrane:
    """Free nodes row by row along x, the matrix as rows of its lower band."""

    def __init__(self, nx, ny, obstacle):
        self.hx, self.hy = 2 / nx, 2 / ny
        self.wide = nx - 1
        self.n = self.wide * (ny - 1)
        self.band = self.wide + 1
        self.rows = [[0.] * (self.band + 1) for _ in range(self.n)]
        element = cell_matrix(self.hx, self.hy)
        for j in range(ny):
            for i in range(nx):
                nodes = [self.number(i + a % 2, j + a // 2, nx, ny)
                         for a in range(4)]
                for a, r in enumerate(nodes):
                    for b, c in enumerate(nodes):
                        if r is not None and c is not None and c <= r:
                            self.rows[r][c - r + self.band] += element[a][b]
        self.load = [LOAD * self.hx * self.hy] * self.n
        self.floor = [obstacle(-1 + self.hx * (k % self.wide + 1))
                      for k in range(self.n)]

    def number(self, i, j, nx, ny):
        if 0 < i < nx and 0 < j < ny:
            return (j - 1) * self.wide + i - 1
        return None

    def times(self, u):
        result = [0.] * self.n
        for r, row in enumerate(self.rows):
            for k in range(max(0, self.band - r), self.band + 1):
                c = r + k - self.band
                result[r] += row[k] * u[c]
                if c != r:
                    result[c] += row[k] * u[r]
        return result

    def solve(self, held):
        """Displacement with the nodes of a set on the obstacle."""
        u = [self.floor[k] if held[k] else 0. for k in range(self.n)]
        f = [a - b for a, b in zip(self.load, self.times(u))]
        band, factor = self.band, []
        for r in range(self.n):
            row = [0.] * (band + 1)
            if held[r]:
                row[band] = 1.
                f[r] = 0.
                factor.append(row)
                continue
            for k in range(max(0, band - r), band + 1):
                c = r + k - band
                if held[c]:
                    continue
                value = self.rows[r][k]
                other = factor[c] if c < r else row
                for m in range(max(0, band - r), k):
                    value -= row[m] * other[m + band - k]
                row[k] = value ** .5 if c == r else value / other[band]
            factor.append(row)
            for k in range(max(0, band - r), band):
                f[r] -= row[k] * f[r + k - band]
            f[r] /= row[band]
        for r in range(self.n - 1, -1, -1):
            f[r] /= factor[r][band]
            for k in range(max(0, band - r), band):
                f[r + k - band] -= factor[r][k] * f[r]
        return [a if h else b for a, b, h in zip(u, f, held)]


def main():
    nx, ny = int(sys.argv[1]), int(sys.argv[2])
    height = float(sys.argv[3]) if len(sys.argv) > 3 else None
    membrane = Membrane(nx, ny, stairs if height is None else lambda x: height)
    held = [False] * membrane.n
    while True:
        u = membrane.solve(held)
        force = [k - f for k, f in zip(membrane.times(u), membrane.load)]
        now = [(p > 0. if h else False) or v < o - 1e-14
               for p, h, v, o in zip(force, held, u, membrane.floor)]
        if now == held:
            break
        held = now
    energy = sum(.5 * v * k - f * v
                 for v, k, f in zip(u, membrane.times(u), membrane.load))
    if len(sys.argv) > 4:
        force = sum(p for p, h in zip(force, held) if h)
        good = (abs(energy / float(sys.argv[4]) - 1) < 1e-9
                and abs(force / float(sys.argv[5]) - 1) < 1e-9
                and sum(held) == int(sys.argv[6]))
        sys.exit(not good and f"found {energy}, {force}, {sum(held)}")
    print(f"energy {energy:.12g}, force "
          f"{sum(p for p, h in zip(force, held) if h):.12g}, "
          f"{sum(held)} nodes in contact")


if __name__ == "__main__":
    main()
