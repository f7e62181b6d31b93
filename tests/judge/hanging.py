# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hanging nodes: nodes of small cells on an edge or face of a large one.

Their displacements are those of the large cell's edge or face there, but on a
curved hull they are not there themselves: a turn of the body is then not among
the displacements, and moments of nodal forces are out of balance. By how much
is known. With x the place of a node, X what its parents say of it, f the forces
of the material and e all others,

    sum x cross e = sum over hanging nodes (X - x) cross (f - e),

as forces are in balance for all motions of the parents, and those of the
material alone for a turn."""
import itertools

from elements import corners, interpolate, shapes
from material import material_forces
from thresholds import THRESHOLDS
from vectors import add, cross, norm, scale, sub

# Of the length of an edge: how far from its middle a node on it may be.
ASIDE = 0.3


class Part:
    """An edge or face of a cell: its nodes in lexicographic order."""

    def __init__(self, dim, degree, nodes):
        self.dim, self.degree, self.nodes = dim, degree, nodes

    def corners(self):
        return [self.nodes[i] for i in corners(self.dim, self.degree)]

    def places(self):
        """Of the nodes, in the unit square or line."""
        return [tuple(i / self.degree for i in index[::-1])
                for index in itertools.product(range(self.degree + 1),
                                               repeat=self.dim)]


def parts_of(cell, dim):
    """Edges (1) or faces (2) of a cell of more dimensions."""
    n = cell.degree + 1
    for free in itertools.combinations(range(cell.dim), dim):
        held = [d for d in range(cell.dim) if d not in free]
        for sides in itertools.product((0, cell.degree), repeat=len(held)):
            first = sum(side * n**d for side, d in zip(sides, held))
            yield Part(dim, cell.degree, [
                cell.nodes[first + sum(i * n**d for i, d in
                                       zip(index[::-1], free))]
                for index in itertools.product(range(n), repeat=dim)])


class HangingNodes:
    """By their number: parents and weights. What is found are edges and faces
    whose halves and quarters are edges and faces of other cells."""

    def __init__(self, nodes, cells):
        self.nodes = nodes
        self.parents = {}
        dims = range(1, cells[0].dim) if cells else ()
        self.parts = {dim: {frozenset(part.corners()): part for cell in cells
                            for part in parts_of(cell, dim)} for dim in dims}
        self.near = {}
        for a, b in self.parts.get(1, ()):
            self.near.setdefault(a, set()).add(b)
            self.near.setdefault(b, set()).add(a)
        for dim in dims:
            for part in self.parts[dim].values():
                middle = self.middles(part)
                if middle:
                    self.divide(part, middle)

    def middle_of_edge(self, a, b):
        """The node that halves an edge, or None."""
        place = self.nodes.place
        middle = scale(add(place[a], place[b]), 0.5)
        length = norm(sub(place[a], place[b]))
        found = [h for h in self.near[a] & self.near[b]
                 if norm(sub(place[h], middle)) < ASIDE * length]
        return found[0] if len(found) == 1 else None

    def middles(self, part):
        """Nodes at the middles of an edge or face by their place, or None
        where it is not divided."""
        if part.degree == 2:
            at = dict(zip(part.places(), part.nodes))
        else:
            at = dict(zip(part.places(), part.nodes))
            ring = [(0., .5), (1., .5), (.5, 0.), (.5, 1.)]
            if part.dim == 1:
                at[.5,] = self.middle_of_edge(*part.nodes)
            else:
                for place in ring:
                    ends = [at[tuple(float(e) if s == .5 else s for s in place)]
                            for e in (0, 1)]
                    at[place] = self.middle_of_edge(*ends)
                if None in at.values():
                    return None
                found = set.intersection(*(self.near[at[p]] for p in ring))
                at[.5, .5] = found.pop() if len(found) == 1 else None
        return None if None in at.values() else at

    def divide(self, part, at):
        """The nodes of the halves or quarters have the parents of the whole."""
        for low in itertools.product((0., .5), repeat=part.dim):
            own = {at[tuple(s + t for s, t in zip(low, place))]:
                   tuple(s + t for s, t in zip(low, place))
                   for place in itertools.product((0., .5), repeat=part.dim)}
            small = self.parts[part.dim].get(frozenset(own))
            if small is None:
                continue
            ends = [own[node] for node in small.corners()]
            for node, place in zip(small.nodes, small.places()):
                if node in part.nodes:
                    continue
                there = interpolate(shapes(part.dim, 1, place)[0], ends)
                weights = shapes(part.dim, part.degree, there)[0]
                self.parents[node] = list(zip(part.nodes, weights))

    def said(self, values, number, known):
        """What the parents say of a node's value, of which some are known
        already; parents may hang themselves."""
        if number not in self.parents:
            return values[number]
        if number not in known:
            total = scale(values[number], 0.)
            for parent, weight in self.parents[number]:
                if weight != 0.:
                    total = add(total, self.said(values, parent, known), weight)
            known[number] = total
        return known[number]

    def aside(self, values):
        """By hanging node: what its parents say less its own value."""
        known = {}
        return {h: sub(self.said(values, h, known), values[h])
                for h in self.parents}


def missing_moment(ways, inner, outer, bodies, body, n_moments):
    """The sum of the head of this file, of a body; and of magnitudes."""
    total, size = (0.,) * n_moments, 0.
    for h, way in ways.items():
        if bodies[h] == body:
            force = sub(inner[h], outer[h])
            total = add(total, cross(way, force))
            size += norm(way) * norm(force)
    return total, size


def hanging_forces(judge):
    """Where parents say that hanging nodes are less where they are, and the
    forces of the material on these nodes."""
    hanging = HangingNodes(judge.nodes, judge.fields.cells)
    limit = THRESHOLDS["hanging"]
    judge.findings.check(
        "hanging nodes move with their neighbours",
        max(map(norm, hanging.aside(judge.u).values()), default=0.),
        limit.value * judge.largest, limit.reason)
    aside = {h: way for h, way in hanging.aside(judge.nodes.place).items()
             if norm(way) > 1e-14 * judge.nodes.extent}
    return aside, material_forces(judge, aside)
