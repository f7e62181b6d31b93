# SPDX-License-Identifier: LGPL-2.1-or-later
"""Writes prm/graded-ball.inp: a quarter of a ball of radius 1 around (0, 0, 1),
x, y > 0, with cells that grow in proportion to their distance from the pole at
the origin.

The quarter of a half ball |X| < 2, Z > 0 has a block of small cells around the
origin and shells of cells around that. The inversion about (0, 0, -2) takes it
to the lower half of the ball: it is conformal, so that cells keep their shapes,
and the identity near the origin. The upper half is the same, mirrored, with few
shells."""
import argparse
import math


def half(core, ratio, n):
    """Points and hexahedra of a half: half width of the block, growth of the
    shells, cells along the edge of the block."""
    shells = max(2, round(math.log(2 / core / 1.25) / math.log(ratio)))
    ratio = (2 / core / 1.25)**(1 / shells)
    points, cells = {}, []

    def point(i, j, k, shell):
        """A grid point of the surface of the block (or in it, shell 0)."""
        c = [v / n for v in (i, j, k)]
        key = (i, j, k, shell)
        if key not in points:
            width = core * ratio**shell
            weight = min(1., shell / min(4, shells))
            round_ = 1.25 / math.sqrt(sum(v * v for v in c)) if shell else 0.
            points[key] = [width * v * (1 - weight + weight * round_)
                           for v in c]
        return key

    for i in range(n):
        for j in range(n):
            for k in range(n):
                cells.append([point(i + a, j + b, k + c, 0) for c in (0, 1)
                              for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
    for shell in range(shells):
        for axis in range(3):
            for i in range(n):
                for j in range(n):
                    cell = []
                    for s in (shell, shell + 1):
                        for a, b in ((0, 0), (1, 0), (1, 1), (0, 1)):
                            place = [i + a, j + b]
                            place.insert(axis, n)
                            cell.append(point(*place, s))
                    cells.append(cell)
    return points, cells


def in_ball(x):
    """The inversion, and the ball turned to z > 0."""
    d = [x[0], x[1], x[2] + 2]
    square = sum(v * v for v in d)
    y = [4 * v / square for v in d]
    return [y[0], y[1], 2 - y[2]]


def measure(corners):
    """Six times the volume at the first corner."""
    a, b, c = ([corners[k][d] - corners[0][d] for d in range(3)]
               for k in (1, 3, 4))
    return (a[0] * (b[1] * c[2] - b[2] * c[1])
            - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--core", type=float, default=0.05)
    parser.add_argument("--ratio", type=float, default=1.55)
    parser.add_argument("--cells", type=int, default=2)
    parser.add_argument("file")
    given = parser.parse_args()
    numbers, nodes, cells = {}, [], []
    for mirrored, core, ratio in ((False, given.core, given.ratio),
                                  (True, 0.6, given.ratio)):
        points, hexahedra = half(core, ratio, given.cells)
        for corners in hexahedra:
            cell = []
            for key in corners:
                place = in_ball(points[key])
                if mirrored:
                    place[2] = 2 - place[2]
                name = tuple(round(v, 9) + 0. for v in place)
                if name not in numbers:
                    numbers[name] = len(nodes)
                    nodes.append([0. if abs(v) < 1e-15 else v for v in place])
                cell.append(numbers[name])
            if measure([nodes[k] for k in cell]) < 0:
                cell = cell[4:] + cell[:4]
            cells.append(cell)
    with open(given.file, "w", encoding="ascii") as out:
        out.write("# A quarter of a ball, by tests/scenes/graded_ball.py.\n"
                  f"{len(nodes)} {len(cells)} 0 0 0\n")
        for k, place in enumerate(nodes):
            out.write(f"{k + 1} " + " ".join(f"{v:.15g}" for v in place) + "\n")
        for k, cell in enumerate(cells):
            out.write(f"{k + 1} 0 hex "
                      + " ".join(str(v + 1) for v in cell) + "\n")


main()
