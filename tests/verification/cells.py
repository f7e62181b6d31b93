# SPDX-License-Identifier: LGPL-2.1-or-later
"""Meshes of quadrilaterals and hexahedra as text of gmsh's format 2.2, from
grids of lines."""
import itertools

# Corners of a cube, 4 d + 2 k + i with offsets (i, k, d), in gmsh's order, and
# faces of gmsh's cells.
ORDER = {2: (0, 1, 3, 2), 3: (0, 1, 3, 2, 4, 5, 7, 6)}
FACES = {2: ((0, 1), (1, 2), (2, 3), (3, 0)),
         3: ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5),
             (2, 3, 7, 6), (3, 0, 4, 7))}
KIND = {2: (1, 3), 3: (3, 5)}


class Cells:
    """Places of nodes, cells of node numbers."""

    def __init__(self, dim):
        self.dim = dim
        self.places = []
        self.cells = []
        self._number = {}

    def node(self, place):
        """Number of the node at a place, made if there is none."""
        key = tuple(round(x * 1e9) for x in place)
        if key not in self._number:
            self._number[key] = len(self.places)
            self.places.append(tuple(place))
        return self._number[key]

    def grid(self, *lines, change=None):
        """Add the cells between lines of coordinates in each direction, mapped
        by `change`; nodes at the same place are one."""
        change = change or (lambda *place: place)
        for index in itertools.product(*(range(len(x) - 1) for x in lines)):
            corners = []
            for corner in range(2 ** self.dim):
                corners.append(self.node(change(*(
                    x[i + (corner >> d & 1)]
                    for d, (x, i) in enumerate(zip(lines, index))))))
            self.cells.append([corners[c] for c in ORDER[self.dim]])
        return self

    def faces(self):
        """Node numbers of all faces of one cell only."""
        count = {}
        for cell in self.cells:
            for face in FACES[self.dim]:
                nodes = [cell[v] for v in face]
                count.setdefault(tuple(sorted(nodes)), []).append(nodes)
        return [same[0] for same in count.values() if len(same) == 1]

    def gmsh(self, id_of):
        """The text; id_of: boundary id by the places of a face's nodes."""
        def line(place):
            return "%.17g %.17g %.17g" % (*place, *(0.,) * (3 - self.dim))
        elements = [(KIND[self.dim][0], id_of([self.places[v] for v in face]),
                     face) for face in self.faces()]
        elements += [(KIND[self.dim][1], 1, cell) for cell in self.cells]
        return "\n".join(
            ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$Nodes",
             str(len(self.places)),
             *(f"{v} {line(x)}" for v, x in enumerate(self.places, 1)),
             "$EndNodes", "$Elements", str(len(elements)),
             *(" ".join(map(str, (n, kind, 2, id_, id_,
                                  *(v + 1 for v in nodes))))
               for n, (kind, id_, nodes) in enumerate(elements, 1)),
             "$EndElements", ""])


def steps(low, high, number):
    """Coordinates of so many equal steps."""
    return [low + (high - low) * i / number for i in range(number + 1)]


def sides(*conditions):
    """An id_of: number, from 1 on, of the first condition on a place that all
    nodes of a face meet; 0 for none."""
    def id_of(places):
        for number, condition in enumerate(conditions, 1):
            if all(condition(*place) for place in places):
                return number
        return 0
    return id_of
