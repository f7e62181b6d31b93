# SPDX-License-Identifier: LGPL-2.1-or-later
"""Contact surfaces as the judge sees them: facets in two configurations, flat
pieces of them, and a tree that finds the nearest piece."""
import math

from elements import contains, interpolate, shapes
from vectors import add, cross, dot, norm, scale, sub, unit

SMOOTH = math.radians(60)  # a larger turn is a corner, not a chord


def normal_of(points):
    """Unit normal of a segment or triangle; the sign is that of the order."""
    if len(points[0]) == 2:
        a, b = points
        return unit((b[1] - a[1], a[0] - b[0]))
    return unit(cross(sub(points[1], points[0]), sub(points[2], points[0])))


class Facet:
    """A facet of a body: reference and deformed positions of its nodes."""

    def __init__(self, cell, boundary, nodes, displacement, inside):
        self.dim, self.degree = cell.dim, cell.degree
        self.body, self.boundary, self.nodes = cell.body, boundary, cell.nodes
        self.reference = [nodes.place[i] for i in cell.nodes]
        self.deformed = [add(nodes.place[i], displacement[i])
                         for i in cell.nodes]
        corner = self.corners()
        points = [self.reference[i] for i in corner]
        normal = normal_of(points)
        centre = interpolate(shapes(self.dim, self.degree,
                                    (0.5,) * self.dim)[0], self.reference)
        # outwards is away from the middle of the cell behind
        self.sign = 1. if dot(normal, sub(centre, inside)) >= 0 else -1.
        self.normal = scale(normal, self.sign)
        self.size = max(norm(sub(a, b)) for a in points for b in points)
        if self.dim == 2:
            self.size /= math.sqrt(2)
        self.chord = 0.

    def corners(self):
        """Three nodes that span it, or the two ends."""
        n = self.degree + 1
        return [0, self.degree] if self.dim == 1 else [0, self.degree,
                                                       n * self.degree]

    def at(self, place, deformed=True):
        return interpolate(shapes(self.dim, self.degree, place)[0],
                           self.deformed if deformed else self.reference)

    def normal_at(self, place, deformed=True):
        """Unit normal outwards at a place of the unit cell."""
        nodes = self.deformed if deformed else self.reference
        gradients = shapes(self.dim, self.degree, place)[1]
        tangents = [tuple(sum(g[k] * node[d] for g, node in
                              zip(gradients, nodes))
                          for d in range(self.dim + 1))
                    for k in range(self.dim)]
        if self.dim == 1:
            t = tangents[0]
            normal = (t[1], -t[0])
        else:
            normal = cross(*tangents)
        return scale(unit(normal), self.sign)

    def samples(self):
        """Places all over the facet."""
        if self.dim == 1:
            return [((i + 0.5) / 8,) for i in range(8)]
        return [((i + 0.5) / 4, (k + 0.5) / 4)
                for i in range(4) for k in range(4)]

    def node_places(self):
        """Places of its nodes."""
        n = self.degree + 1
        line = [i / self.degree for i in range(n)]
        if self.dim == 1:
            return [(x,) for x in line]
        return [(x, y) for y in line for x in line]

    def pieces(self, deformed):
        """Flat parts of it with their normals outwards."""
        n = 2**self.degree if self.dim == 2 else 1 + 7 * (self.degree - 1)
        result = []
        if self.dim == 1:
            points = [self.at((i / n,), deformed) for i in range(n + 1)]
            result = [(a, b) for a, b in zip(points, points[1:])]
        else:
            grid = [[self.at((i / n, k / n), deformed) for i in range(n + 1)]
                    for k in range(n + 1)]
            for k in range(n):
                for i in range(n):
                    a, b = grid[k][i], grid[k][i + 1]
                    c, d = grid[k + 1][i], grid[k + 1][i + 1]
                    result += [(a, b, c), (b, d, c)]
        return [(points, scale(normal_of(points), self.sign), self)
                for points in result]


def set_chords(facets):
    """Chord heights: a facet of length h on a curve that turns by an angle to
    the next facet is h * angle / 8 away from it."""
    at_node = {}
    for facet in facets:
        for i in facet.nodes:
            at_node.setdefault(i, []).append(facet)
    for near in at_node.values():
        for a in near:
            for b in near:
                turn = math.acos(max(-1., min(1., dot(a.normal, b.normal))))
                if turn < SMOOTH:
                    a.chord = max(a.chord, max(a.size, b.size) * turn / 8)


def nearest_in_segment(x, points):
    a, b = points
    along = sub(b, a)
    square = dot(along, along)
    s = dot(sub(x, a), along) / square if square > 0 else 0.
    return add(a, along, max(0., min(1., s)))


def nearest_in_triangle(x, points):
    a, b, c = points
    ab, ac, ax = sub(b, a), sub(c, a), sub(x, a)
    d00, d01, d11 = dot(ab, ab), dot(ab, ac), dot(ac, ac)
    d20, d21 = dot(ax, ab), dot(ax, ac)
    determinant = d00 * d11 - d01 * d01
    if determinant > 0:
        v = (d11 * d20 - d01 * d21) / determinant
        w = (d00 * d21 - d01 * d20) / determinant
        if v >= 0 and w >= 0 and v + w <= 1:
            return add(add(a, ab, v), ac, w)
    return min((nearest_in_segment(x, edge)
                for edge in ((a, b), (b, c), (c, a))),
               key=lambda y: norm(sub(x, y)))


class Tree:
    """Bounding boxes over flat pieces."""

    LEAF = 4

    def __init__(self, pieces):
        points = [p for piece in pieces for p in piece[0]]
        self.lower = tuple(map(min, zip(*points)))
        self.upper = tuple(map(max, zip(*points)))
        self.pieces, self.parts = pieces, ()
        if len(pieces) > self.LEAF:
            axis = max(range(len(self.lower)),
                       key=lambda d: self.upper[d] - self.lower[d])
            pieces = sorted(pieces, key=lambda p: sum(q[axis] for q in p[0]))
            half = len(pieces) // 2
            self.parts = (Tree(pieces[:half]), Tree(pieces[half:]))

    def _least(self, x):
        return math.sqrt(sum(max(low - v, v - high, 0.)**2 for v, low, high in
                             zip(x, self.lower, self.upper)))

    def nearest(self, x, facing=None, best=None):
        """Distance, point, normal and facet of the nearest piece whose normal
        is opposed to `facing`."""
        best = best or (math.inf, None, None, None)
        if not self.parts:
            find = nearest_in_segment if len(x) == 2 else nearest_in_triangle
            for points, normal, facet in self.pieces:
                if facing is not None and dot(facing, normal) > -0.25:
                    continue
                y = find(x, points)
                distance = norm(sub(x, y))
                if distance < best[0]:
                    best = (distance, y, normal, facet)
            return best
        for least, _, part in sorted((part._least(x), i, part) for i, part in
                                     enumerate(self.parts)):
            if least < best[0]:
                best = part.nearest(x, facing, best)
        return best


class Volume:
    """Cells of the deformed bodies in a grid of boxes."""

    def __init__(self, cells, nodes, displacement):
        self.cells = []
        for cell in cells:
            points = [add(nodes.place[i], displacement[i])
                      for i in cell.nodes]
            self.cells.append((cell, points, tuple(map(min, zip(*points))),
                               tuple(map(max, zip(*points)))))
        sizes = sorted(max(h - l for l, h in zip(low, high))
                       for _, _, low, high in self.cells)
        self.step = sizes[len(sizes) // 2]
        self.grid = {}
        for entry in self.cells:
            for key in self._keys(entry[2], entry[3]):
                self.grid.setdefault(key, []).append(entry)

    def _keys(self, low, high):
        keys = [()]
        for a, b in zip(low, high):
            keys = [key + (k,) for key in keys for k in range(
                math.floor(a / self.step), math.floor(b / self.step) + 1)]
        return keys

    def body_at(self, x, bodies):
        """A body of the given ones that has the point inside, or None."""
        for cell, points, low, high in self.grid.get(
                self._keys(x, x)[0], ()):
            if cell.body in bodies and all(
                    a <= v <= b for v, a, b in zip(x, low, high)) and contains(
                        cell.dim, cell.degree, points, x):
                return cell.body
        return None
