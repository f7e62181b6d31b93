# SPDX-License-Identifier: LGPL-2.1-or-later
"""Lagrange elements of degree 1 and 2 on lines, quadrilaterals and
hexahedra. Nodes are in lexicographic order, x fastest."""
import functools
import itertools
import math

from vectors import add, dot, invert, norm, sub


def _basis(degree, s):
    """Values and derivatives of the shape functions on [0, 1]."""
    if degree == 1:
        return (1 - s, s), (-1., 1.)
    return ((1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)), (
        4 * s - 3, 4 - 8 * s, 4 * s - 1)


@functools.lru_cache(maxsize=None)
def shapes(dim, degree, point):
    """Values and gradients of the shape functions at a point of the unit
    cell."""
    line = [_basis(degree, s) for s in point]
    values, gradients = [], []
    for index in itertools.product(range(degree + 1), repeat=dim):
        index = index[::-1]
        value = 1.
        for d in range(dim):
            value *= line[d][0][index[d]]
        values.append(value)
        gradients.append(tuple(
            math.prod(line[e][1 if e == d else 0][index[e]]
                      for e in range(dim)) for d in range(dim)))
    return tuple(values), tuple(gradients)


@functools.lru_cache(maxsize=None)
def gauss(dim, n):
    """Points and weights on the unit cell."""
    line = {1: [(.5, 1.)],
            2: [(.5 - math.sqrt(1 / 12), .5), (.5 + math.sqrt(1 / 12), .5)],
            3: [(.5 - math.sqrt(.15), 5 / 18), (.5, 4 / 9),
                (.5 + math.sqrt(.15), 5 / 18)]}[n]
    return tuple((tuple(p[0] for p in points),
                  math.prod(p[1] for p in points))
                 for points in itertools.product(line, repeat=dim))


@functools.lru_cache(maxsize=None)
def slopes(dim, degree, point):
    """The derivatives of all shape functions, one direction after the other."""
    return tuple(zip(*shapes(dim, degree, point)[1]))


def interpolate(values, nodes):
    """Sum of shape values times vectors at the nodes."""
    return tuple(dot(values, column) for column in zip(*nodes))


def derivative(directions, nodes):
    """Of an interpolated vector: a row for each component."""
    return [[dot(slope, column) for slope in directions]
            for column in zip(*nodes)]


def corners(dim, degree):
    """Numbers of the corner nodes, lexicographic."""
    n = degree + 1
    return [sum(degree * bit * n**d for d, bit in enumerate(bits[::-1]))
            for bits in itertools.product((0, 1), repeat=dim)]


def in_order(dim, degree, points):
    """Numbers of the points in the order of the nodes. VTK has the corners
    first, as it walks around them, then edges, faces and the middle; in which
    order depends on its version, and is known by their places: an edge's node is
    near the middle of its ends, a face's near that of its edges' nodes."""
    ring = [0, 1, 3, 2] if dim > 1 else [0, 1]
    if dim == 3:
        ring += [4 + i for i in ring]
    if degree == 1:
        return ring
    found = {tuple(bits[::-1]): i for bits, i in zip(
        itertools.product((0., 1.), repeat=dim), ring)}
    first = 2**dim
    for free in range(1, dim + 1):
        # edges, then faces, then the cell
        places = [index[::-1] for index in itertools.product(
            (0., .5, 1.), repeat=dim) if index.count(.5) == free]
        left = set(range(first, first + len(places)))
        first += len(places)
        for place in places:
            around = [points[found[place[:d] + (side,) + place[d + 1:]]]
                      for d in range(dim) if place[d] == .5
                      for side in (0., 1.)]
            near = tuple(sum(x) / len(around) for x in zip(*around))
            best = min(left, key=lambda i: norm(sub(points[i], near)))
            left.remove(best)
            found[place] = best
    return [found[index[::-1]] for index in itertools.product(
        (0., .5, 1.), repeat=dim)]


def contains(dim, degree, nodes, point):
    """Whether a point is inside a cell of the given nodes: Newton's method
    for its place in the unit cell."""
    place = (0.5,) * dim
    for _ in range(20):
        values, gradients = shapes.__wrapped__(dim, degree, place)
        defect = sub(point, interpolate(values, nodes))
        inverse, _ = invert(derivative(tuple(zip(*gradients)), nodes))
        if inverse is None:
            return False
        step = tuple(sum(a * b for a, b in zip(row, defect))
                     for row in inverse)
        place = add(place, step)
        if max(abs(s - 0.5) for s in place) > 5:
            return False
        if max(abs(s) for s in step) < 1e-10:
            break
    return all(-1e-9 <= s <= 1 + 1e-9 for s in place)
