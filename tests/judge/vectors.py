# SPDX-License-Identifier: LGPL-2.1-or-later
"""Small vectors as tuples."""
import math


def add(a, b, factor=1.):
    return tuple(x + factor * y for x, y in zip(a, b))


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def scale(a, factor):
    return tuple(factor * x for x in a)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


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


def solve(matrix, right):
    """A small system by elimination; None if it is singular."""
    n = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(rows[k][i]))
        if rows[pivot][i] == 0:
            return None
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(n):
            if k != i and rows[k][i] != 0:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [rows[i][n] / rows[i][i] for i in range(n)]


def invert(matrix):
    """Inverse and determinant of a matrix of up to three rows."""
    n = len(matrix)
    columns = [solve(matrix, [float(i == k) for i in range(n)])
               for k in range(n)]
    if any(column is None for column in columns):
        return None, 0.
    inverse = [[columns[k][i] for k in range(n)] for i in range(n)]
    if n == 2:
        determinant = (matrix[0][0] * matrix[1][1]
                       - matrix[0][1] * matrix[1][0])
    else:
        determinant = dot(matrix[0], cross(matrix[1], matrix[2]))
    return inverse, determinant
