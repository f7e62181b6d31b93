# SPDX-License-Identifier: LGPL-2.1-or-later
"""Structured hexahedral bodies, the same numbers for every program.

A body is a dictionary that goes to files as it is: `nodes` [[x, y, z], ...],
`cells` [[eight nodes], ...] in the order that gmsh and CalculiX share (four
below, four above, both counter-clockwise from above), and `faces`: name ->
list of [cell, face], where face counts 0..5 as in FACES.
"""
import itertools

# Nodes of a cell's faces; face k is CalculiX's face k+1.
FACES = [(0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2),
         (2, 6, 7, 3), (3, 7, 4, 0)]


def uniform(begin, end, cells):
    """cells + 1 coordinates."""
    return [begin + (end - begin) * i / cells for i in range(cells + 1)]


def graded(fine_end, fine_cells, end, cells):
    """From 0: equal cells to fine_end, then growing by one ratio to end."""
    size = fine_end / fine_cells
    rest = cells - fine_cells
    low, high = 1.0, 10.0
    for _ in range(200):
        ratio = 0.5 * (low + high)
        length = sum(size * ratio ** (k + 1) for k in range(rest))
        low, high = ((low, ratio) if length > end - fine_end
                     else (ratio, high))
    points = uniform(0.0, fine_end, fine_cells)
    for k in range(rest):
        points.append(points[-1] + size * ratio ** (k + 1))
    points[-1] = end
    return points


def _middle(a, b):
    """Of two numbers, or of lists of them, entry by entry."""
    if isinstance(a, list):
        return [_middle(*pair) for pair in zip(a, b)]
    return (a + b) / 2


def _with_middles(items):
    halves = [_middle(*pair) for pair in zip(items, items[1:])]
    return [item for pair in zip(items, halves)
            for item in pair] + items[-1:]


def grid(xs, ys, zs, place=lambda x, y, z: (x, y, z)):
    """Nodes [z][y][x] of the product grid; `place` moves each."""
    return [[[list(place(x, y, z)) for x in xs] for y in ys] for z in zs]


def bisected(nodes):
    """The grid with twice as many cells each way."""
    return _with_middles([_with_middles([_with_middles(row) for row in layer])
                          for layer in nodes])


def block(nodes):
    """A body of the cells between the nodes of a grid."""
    nz, ny, nx = len(nodes) - 1, len(nodes[0]) - 1, len(nodes[0][0]) - 1

    def number(i, j, k):
        return i + (nx + 1) * (j + (ny + 1) * k)

    cells = []
    faces = {side: [] for side in
             ("xmin", "xmax", "ymin", "ymax", "zmin", "zmax")}
    for k in range(nz):
        for j in range(ny):
            for i in range(nx):
                cell = len(cells)
                below = [number(i, j, k), number(i + 1, j, k),
                         number(i + 1, j + 1, k), number(i, j + 1, k)]
                cells.append(below + [n + (nx + 1) * (ny + 1)
                                      for n in below])
                for side, at, face in (
                        ("zmin", k == 0, 0), ("zmax", k == nz - 1, 1),
                        ("ymin", j == 0, 2), ("xmax", i == nx - 1, 3),
                        ("ymax", j == ny - 1, 4), ("xmin", i == 0, 5)):
                    if at:
                        faces[side].append([cell, face])
    return {"nodes": [node for layer in nodes for row in layer
                      for node in row], "cells": cells, "faces": faces}


def face_nodes(body, name):
    """Sorted nodes of a named set of faces."""
    return sorted({body["cells"][cell][corner]
                   for cell, face in body["faces"][name]
                   for corner in FACES[face]})


def split_face(body, name, new, inside):
    """Move the faces of `name` whose centre is `inside(x, y, z)` to `new`."""
    keep, moved = [], []
    for cell, face in body["faces"][name]:
        corners = [body["nodes"][body["cells"][cell][c]] for c in FACES[face]]
        centre = [sum(point[d] for point in corners) / 4 for d in range(3)]
        (moved if inside(*centre) else keep).append([cell, face])
    body["faces"][name] = keep
    body["faces"][new] = moved


def nodal_areas(body, name):
    """node -> a quarter of the projected (x, y) area of its faces."""
    areas = {}
    for cell, face in body["faces"][name]:
        corners = [body["cells"][cell][c] for c in FACES[face]]
        points = [body["nodes"][n] for n in corners]
        twice = sum(points[i][0] * points[(i + 1) % 4][1]
                    - points[(i + 1) % 4][0] * points[i][1]
                    for i in range(4))
        for node in corners:
            areas[node] = areas.get(node, 0.0) + abs(twice) / 8
    return areas


class Places:
    """Finds points by their coordinates, up to a tolerance."""

    def __init__(self, points, tolerance):
        self.tolerance = tolerance
        self.index = {self._key(point): number
                      for number, point in enumerate(points)}

    def _key(self, point):
        return tuple(round(x / self.tolerance) for x in point)

    def find(self, point):
        """Number of the point that is there, or None."""
        key = self._key(point)
        for shift in itertools.product((0, -1, 1), repeat=3):
            number = self.index.get(tuple(map(sum, zip(key, shift))))
            if number is not None:
                return number
        return None
