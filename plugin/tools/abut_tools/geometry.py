# SPDX-License-Identifier: LGPL-2.1-or-later
"""Triangles, edges and outlines of meshes, and values between points. Files of
fields have the points of each cell for themselves."""
import collections

import numpy

from .vtu import Mesh

# Of VTK's cell types: the corners in the order around the cell, and triangles
# of their points.
QUAD, TRIANGLE, LINE = (9, 70), (5, 22, 69), (3, 21, 68)
HEXAHEDRON, TETRAHEDRON = (12, 25, 29, 72), (10, 24, 71)
FACES = {
    HEXAHEDRON: ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
                 (2, 3, 7, 6), (3, 0, 4, 7)),
    TETRAHEDRON: ((0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2))}


def kinds(mesh):
    """Groups of cells of one type and number of points: the type, and an array
    of point numbers."""
    groups = collections.defaultdict(list)
    for kind, cell in zip(mesh.types, mesh.cells):
        groups[int(kind), len(cell)].append(cell)
    return [(kind, numpy.array(cells))
            for (kind, _), cells in sorted(groups.items())]


def triangles(mesh):
    """Triangles of a plane mesh; quadratic cells are cut at their nodes."""
    parts = []
    for kind, cells in kinds(mesh):
        n = cells.shape[1]
        if kind in QUAD:
            corners = ([(0, 4, 8, 7), (4, 1, 5, 8), (8, 5, 2, 6), (7, 8, 6, 3)]
                       if n == 9 else [(0, 1, 2, 3)])
            # Along the diagonal from the first corner.
            pattern = [part for a, b, c, d in corners
                       for part in ((a, b, c), (a, c, d))]
        elif kind in TRIANGLE:
            pattern = ([(0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5)] if n == 6
                       else [(0, 1, 2)])
        else:
            continue
        parts.append(cells[:, pattern].reshape(-1, 3))
    return numpy.concatenate(parts) if parts else numpy.zeros((0, 3), int)


def fine_triangles(mesh, points, values, most=20000):
    """Points, values and triangles that follow fields of quadrilaterals, which
    are not linear on triangles: coarse cells are cut into parts, not more than
    `most` in all."""
    parts = max(1, min(8, int((most / max(1, len(mesh.cells))) ** 0.5)))
    line = numpy.linspace(0, 1, parts + 1)
    s, r = (grid.ravel() for grid in numpy.meshgrid(line, line))
    first = (numpy.arange(parts) + (parts + 1) * numpy.arange(parts)[:, None])
    first = first.ravel()
    pattern = numpy.concatenate([
        numpy.stack([first, first + 1, first + parts + 2], axis=1),
        numpy.stack([first, first + parts + 2, first + parts + 1], axis=1)])
    all_points, all_values, all_triangles, start = [], [], [], 0
    for kind, cells in kinds(mesh):
        if kind in QUAD and parts > 1:
            weights = _shape_functions(s, r, cells.shape[1])
            all_points.append(numpy.einsum("qn,cnd->cqd", weights,
                                           points[cells]).reshape(-1, 2))
            all_values.append((values[cells] @ weights.T).ravel())
            corners = (pattern[None] + len(s) * numpy.arange(len(cells))
                       [:, None, None]).reshape(-1, 3)
        else:
            corners = triangles(Mesh(mesh.points, list(cells),
                                     [kind] * len(cells), {}, {}))
            all_points.append(points)
            all_values.append(values)
        all_triangles.append(corners + start)
        start += len(all_points[-1])
    return (numpy.concatenate(all_points), numpy.concatenate(all_values),
            numpy.concatenate(all_triangles))


def _shape_functions(s, r, n_nodes):
    """At points of the unit square, of quadrilaterals of 4 or 9 nodes."""
    if n_nodes == 4:
        return numpy.stack([(1 - s) * (1 - r), s * (1 - r), s * r, (1 - s) * r],
                           axis=1)

    def of(x):
        return ((1 - x) * (1 - 2 * x), x * (2 * x - 1), 4 * x * (1 - x))

    a, b = of(s), of(r)
    return numpy.stack([a[i] * b[j] for i, j in (
        (0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (1, 2), (2, 1), (0, 2), (2, 2))],
        axis=1)


def edges(mesh, points=None, least=0.0):
    """Edges of a plane mesh, each as its two or three points in a row; of
    edges with two the middle is the second end. Without cells that have an edge
    below the length `least` between `points`."""
    parts = []
    for kind, cells in kinds(mesh):
        n = cells.shape[1]
        if kind in QUAD:
            pattern = ([(0, 4, 1), (1, 5, 2), (2, 6, 3), (3, 7, 0)] if n == 9
                       else [(i, (i + 1) % 4, (i + 1) % 4) for i in range(4)])
        elif kind in TRIANGLE:
            pattern = ([(0, 3, 1), (1, 4, 2), (2, 5, 0)] if n == 6 else
                       [(i, (i + 1) % 3, (i + 1) % 3) for i in range(3)])
        else:
            continue
        part = cells[:, pattern]
        if least > 0.0:
            spans = points[part[:, :, 2]] - points[part[:, :, 0]]
            part = part[numpy.linalg.norm(spans, axis=2).min(axis=1) >= least]
        parts.append(part.reshape(-1, 3))
    return numpy.concatenate(parts) if parts else numpy.zeros((0, 3), int)


def merged(mesh, separate=None):
    """For each point the number of the node that it is, points at one place
    being one node; `separate`: a number for each point that tells nodes apart,
    such as the body."""
    size = numpy.ptp(mesh.points, axis=0).max() or 1.0
    keys = numpy.round(mesh.points / (1e-6 * size)).astype(numpy.int64)
    if separate is not None:
        keys = numpy.column_stack([keys, numpy.round(separate)])
    return numpy.unique(keys, axis=0, return_inverse=True)[1].reshape(-1)


def bodies_of_points(mesh):
    """The body of each point, from the field of the cells; 1 without it."""
    result = numpy.ones(len(mesh.points))
    if "body" in mesh.cell_fields:
        for cell, body in zip(mesh.cells, mesh.cell_fields["body"]):
            result[cell] = body
    elif "body" in mesh.fields:
        result = mesh.fields["body"]
    return result


def outline(mesh):
    """The edges of a plane mesh at its boundary; where a long edge meets two
    short ones, all three are inside."""
    all_edges = edges(mesh)
    node = merged(mesh, bodies_of_points(mesh))
    ends = numpy.sort(node[all_edges[:, [0, 2]]], axis=1)
    _, first, counts = numpy.unique(ends, axis=0, return_index=True,
                                    return_counts=True)
    first = first[counts == 1]
    once = {tuple(ends[i]): i for i in first}
    neighbours = collections.defaultdict(set)
    for a, b in once:
        neighbours[a].add(b)
        neighbours[b].add(a)
    inside = set()
    place = {n: p for n, p in zip(node, mesh.points)}
    for a, b in once:
        for h in neighbours[a] & neighbours[b]:
            middle = 0.5 * (place[a] + place[b])
            if (numpy.linalg.norm(place[h] - middle)
                    < 0.25 * numpy.linalg.norm(place[a] - place[b])):
                inside |= {(a, b), tuple(sorted((a, h))), tuple(sorted((b, h)))}
    return all_edges[sorted(i for pair, i in once.items()
                            if pair not in inside)]


def surface(mesh):
    """The faces of a mesh in space at its boundary, corners only: arrays of
    point numbers, triangles and quadrilaterals."""
    node = merged(mesh, bodies_of_points(mesh))
    found = {}
    counts = collections.Counter()
    for kind, cells in kinds(mesh):
        for of, faces in FACES.items():
            if kind in of:
                for face in faces:
                    for corners in cells[:, face]:
                        key = tuple(sorted(node[corners]))
                        counts[key] += 1
                        found[key] = corners
    return [corners for key, corners in found.items() if counts[key] == 1]


def cut(mesh, height):
    """Points and fields of a mesh in space, as a plane mesh of triangles where
    the plane z = height cuts it. Cells are taken as tetrahedra."""
    simplices = []
    for kind, cells in kinds(mesh):
        if kind in TETRAHEDRON:
            simplices.append(cells[:, :4])
        elif kind in HEXAHEDRON:
            pattern = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6),
                       (0, 4, 5, 6), (0, 5, 1, 6))
            simplices.append(cells[:, pattern].reshape(-1, 4))
    simplices = numpy.concatenate(simplices)
    z = mesh.points[:, 2] - height
    size = numpy.ptp(mesh.points[:, 2]) or 1.0
    z = numpy.where(abs(z) < 1e-6 * size, 1e-9 * size, z)
    above = z[simplices] > 0
    simplices = simplices[above.any(axis=1) & ~above.all(axis=1)]
    ends, corners = [], []
    for simplex in simplices:
        up = [p for p in simplex if z[p] > 0]
        down = [p for p in simplex if z[p] <= 0]
        pairs = [(a, b) for a in up for b in down]
        if len(up) == 2:
            pairs = [pairs[0], pairs[1], pairs[3], pairs[2]]
        start = len(ends)
        ends += pairs
        corners += [(start, start + i, start + i + 1)
                    for i in range(1, len(pairs) - 1)]
    ends = numpy.array(ends).reshape(-1, 2)
    weight = (z[ends[:, 0]] / (z[ends[:, 0]] - z[ends[:, 1]]))

    def between(values):
        w = weight.reshape(-1, *[1] * (values.ndim - 1))
        return (1 - w) * values[ends[:, 0]] + w * values[ends[:, 1]]

    return Mesh(between(mesh.points), list(numpy.array(corners)),
                numpy.full(len(corners), 5),
                {name: between(field) for name, field in mesh.fields.items()},
                {})


def exaggeration(mesh, displacement):
    """Factor 1, 2 or 5 times a power of ten, at least 1, that makes the largest
    displacement a fortieth to a sixteenth of the size of the bodies."""
    size = numpy.ptp(mesh.points, axis=0).max()
    largest = abs(displacement).max() if len(displacement) else 0.0
    if not 0 < largest <= size / 50:
        return 1.0
    raw = size / largest / 40
    power = 10.0 ** numpy.floor(numpy.log10(raw))
    return max(1.0, next((digit * power for digit in (1.0, 2.0, 5.0)
                          if raw <= digit * power), 10 * power))


def sample(points, corners, values, x, y):
    """Values at the points of a grid, linear on triangles; NaN outside, and the
    largest where triangles share a point. x, y: the coordinates of columns and
    rows, evenly spaced."""
    result = numpy.full((len(y), len(x)), -numpy.inf)
    p, v = points[corners][:, :, :2], values[corners]
    low, high = p.min(axis=1), p.max(axis=1)
    slack = 1e-9 * numpy.array([x[-1] - x[0], y[-1] - y[0]])

    def first_and_last(line, of):
        return (numpy.searchsorted(line, low[:, of] - slack[of]),
                numpy.searchsorted(line, high[:, of] + slack[of]))

    (i0, i1), (j0, j1) = first_and_last(x, 0), first_and_last(y, 1)
    a, ab, ac = p[:, 0], p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]
    area = ab[:, 0] * ac[:, 1] - ab[:, 1] * ac[:, 0]
    good = (i1 > i0) & (j1 > j0) & (area != 0)
    for di in range(int((i1 - i0)[good].max(initial=0))):
        for dj in range(int((j1 - j0)[good].max(initial=0))):
            t = numpy.flatnonzero(good & (i0 + di < i1) & (j0 + dj < j1))
            i, j = i0[t] + di, j0[t] + dj
            d = numpy.column_stack([x[i], y[j]]) - a[t]
            s = (d[:, 0] * ac[t, 1] - d[:, 1] * ac[t, 0]) / area[t]
            r = (ab[t, 0] * d[:, 1] - ab[t, 1] * d[:, 0]) / area[t]
            inside = (s >= -1e-8) & (r >= -1e-8) & (s + r <= 1 + 1e-8)
            value = v[t, 0] + s * (v[t, 1] - v[t, 0]) + r * (v[t, 2] - v[t, 0])
            numpy.maximum.at(result, (j[inside], i[inside]), value[inside])
    return numpy.where(numpy.isinf(result), numpy.nan, result)
