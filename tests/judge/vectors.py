# SPDX-License-Identifier: LGPL-2.1-or-later
"""Small vectors as tuples."""
import math
from operator import mul, sub as minus


def add(a, b, factor=1.):
    return tuple(x + factor * y for x, y in zip(a, b))


def sub(a, b):
    return tuple(map(minus, a, b))


def scale(a, factor):
    return tuple(factor * x for x in a)


def dot(a, b):
    return sum(map(mul, a, b))


def norm(a):
    return math.sqrt(dot(a, a))


def unit(a):
    length = norm(a)
    return scale(a, 1. / length) if length > 0 else a


def cross(a, b):
    """In space a vector; in the plane the third component alone."""
    if len(a) == 2:
        return (a[0] * b[1] - a[1] * b[0],)
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0])


def invert(matrix):
    """Inverse and determinant of a matrix of two or three rows, by cofactors."""
    if len(matrix) == 2:
        (a, b), (c, d) = matrix
        determinant = a * d - b * c
        columns = (d, -c), (-b, a)
    else:
        x, y, z = matrix
        columns = cross(y, z), cross(z, x), cross(x, y)
        determinant = dot(x, columns[0])
    if determinant == 0:
        return None, 0.
    return [[value / determinant for value in row]
            for row in zip(*columns)], determinant
