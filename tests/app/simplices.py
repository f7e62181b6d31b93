# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of triangles and tetrahedra as text of gmsh's formats 2.2 and 4.1:
boxes cut into simplices, with seeded random shifts of their inner vertices."""
import itertools
import math
import random


# Types of degree 2 by number of corners, and the edges in their order.
KINDS = {2: 8, 3: 9, 4: 11}
EDGES = ((0, 1), (1, 2), (2, 0), (3, 0), (3, 2), (3, 1))


def mean(a, b):
    return tuple((x + y) / 2 for x, y in zip(a, b))


class Mesh:
    """Vertices, cells and boundary faces with ids."""

    def __init__(self, dim, vertices, cells, id_of):
        """id_of: boundary id by the vertices of a face."""
        self.dim = dim
        self.vertices = vertices
        self.cells = cells
        count = {}
        for cell in cells:
            for face in itertools.combinations(cell, dim):
                count.setdefault(tuple(sorted(face)), []).append(face)
        self.faces = [(id_of([vertices[v] for v in same[0]]), same[0])
                      for same in count.values() if len(same) == 1]

    def mapped(self, change):
        self.vertices = [tuple(change(*vertex)) for vertex in self.vertices]
        return self

    def curved(self, change, bend=True):
        """Gmsh's format 2.2 with cells of degree 2 after a map, with middle
        nodes where the map puts them, or in the middle of straight edges."""
        places = [tuple(change(*vertex)) for vertex in self.vertices]
        number = {}

        def middle(a, b):
            edge = tuple(sorted((a, b)))
            if edge not in number:
                number[edge] = len(places)
                places.append(
                    tuple(change(*mean(self.vertices[a], self.vertices[b])))
                    if bend else mean(places[a], places[b]))
            return number[edge]
        elements = [(KINDS[len(nodes)], id_, list(nodes)
                     + [middle(nodes[i], nodes[j])
                        for i, j in EDGES[:3 * len(nodes) - 6 or 1]])
                    for id_, nodes in [*self.faces,
                                       *((1, cell) for cell in self.cells)]]
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes",
                 str(len(places))]
        lines += ["%d %.17g %.17g %.17g" % ((v + 1,) + x
                                            + (0.,) * (3 - self.dim))
                  for v, x in enumerate(places)]
        lines += ["$EndNodes", "$Elements", str(len(elements))]
        lines += [" ".join(map(str, (k, kind, 2, id_, id_,
                                     *(v + 1 for v in nodes))))
                  for k, (kind, id_, nodes) in enumerate(elements, 1)]
        return "\n".join(lines + ["$EndElements", ""])

    def right_handed(self):
        """Order the vertices of cells so that volumes are positive."""
        for cell in self.cells:
            if measure([self.vertices[v] for v in cell]) < 0:
                cell[-1], cell[-2] = cell[-2], cell[-1]

    def gmsh(self, version="2.2"):
        return self.gmsh2() if version == "2.2" else self.gmsh4()

    def places(self):
        return [tuple(vertex) + (0.,) * (3 - self.dim)
                for vertex in self.vertices]

    def gmsh2(self):
        lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes",
                 str(len(self.vertices))]
        lines += ["%d %.17g %.17g %.17g" % ((v + 1,) + x)
                  for v, x in enumerate(self.places())]
        lines += ["$EndNodes", "$Elements",
                  str(len(self.faces) + len(self.cells))]
        elements = [(self.dim - 1, id_, face) for id_, face in self.faces]
        elements += [(2 * self.dim - 2, 1, cell) for cell in self.cells]
        for number, (kind, id_, vertices) in enumerate(elements, 1):
            lines.append(" ".join(map(str, (number, kind, 2, id_, id_)
                                      + tuple(v + 1 for v in vertices))))
        return "\n".join(lines + ["$EndElements", ""])

    def gmsh4(self):
        """One entity for each boundary id, one for the cells."""
        ids = sorted({id_ for id_, _ in self.faces})
        low = [min(x[d] for x in self.places()) for d in range(3)]
        high = [max(x[d] for x in self.places()) for d in range(3)]
        box = " ".join("%.17g" % x for x in low + high)
        counts = [0] * 4
        counts[self.dim - 1], counts[self.dim] = len(ids), 1
        lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$Entities",
                 " ".join(map(str, counts))]
        # Numbers of entities and of groups begin with 1: id 0 is of no group.
        lines += [f"{id_ + 1} {box} " + (f"1 {id_} 0" if id_ else "0 0")
                  for id_ in ids]
        lines += [f"1 {box} 1 1 0", "$EndEntities", "$Nodes"]
        n = len(self.vertices)
        lines += [f"1 {n} 1 {n}", f"{self.dim} 1 0 {n}"]
        lines += [str(v + 1) for v in range(n)]
        lines += ["%.17g %.17g %.17g" % x for x in self.places()]
        total = len(self.faces) + len(self.cells)
        lines += ["$EndNodes", "$Elements", f"{len(ids) + 1} {total} 1 {total}"]
        number = 0
        blocks = [(self.dim - 1, id_ + 1, self.dim - 1,
                   [face for other, face in self.faces if other == id_])
                  for id_ in ids] + [(self.dim, 1, 2 * self.dim - 2,
                                      self.cells)]
        for dim, entity, kind, elements in blocks:
            lines.append(f"{dim} {entity} {kind} {len(elements)}")
            for vertices in elements:
                number += 1
                lines.append(" ".join(map(str, (number,) + tuple(
                    v + 1 for v in vertices))))
        return "\n".join(lines + ["$EndElements", ""])


def measure(corners):
    """Area or volume of a simplex, signed."""
    edges = [[x - y for x, y in zip(corner, corners[0])]
             for corner in corners[1:]]
    return determinant(edges) / math.factorial(len(edges))


def determinant(m):
    if len(m) == 1:
        return m[0][0]
    return sum((-1) ** j * m[0][j]
               * determinant([row[:j] + row[j + 1:] for row in m[1:]])
               for j in range(len(m)))


def box(repetitions, low, high, shift=0., seed=1):
    """A box cut into dim! simplices a cube. Ids 2 d and 2 d + 1 are the ends
    in direction d. Inner vertices, and those inside of sides within these, are
    shifted by chance, by up to the part `shift` of a cube."""
    dim = len(repetitions)
    chance = random.Random(seed)
    step = [(b - a) / n for a, b, n in zip(low, high, repetitions)]
    strides = [1]
    for n in repetitions:
        strides.append(strides[-1] * (n + 1))
    vertices = []
    for index in itertools.product(*(range(n + 1)
                                     for n in reversed(repetitions))):
        index = index[::-1]
        vertices.append(tuple(
            a + h * (i + (shift * chance.uniform(-1, 1) if 0 < i < n else 0))
            for a, h, i, n in zip(low, step, index, repetitions)))
    cells = []
    for index in itertools.product(*(range(n) for n in repetitions)):
        for order in itertools.permutations(range(dim)):
            corner = list(index)
            cell = [sum(i * s for i, s in zip(corner, strides))]
            for d in order:
                corner[d] += 1
                cell.append(sum(i * s for i, s in zip(corner, strides)))
            cells.append(cell)

    def id_of(corners):
        for d in range(dim):
            for side, end in enumerate((low[d], high[d])):
                if all(abs(x[d] - end) < 1e-9 * (high[d] - low[d])
                       for x in corners):
                    return 2 * d + side
        raise ValueError("a face inside")
    mesh = Mesh(dim, vertices, cells, id_of)
    mesh.right_handed()
    return mesh
