# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run has written: summary, nodes with forces, cells and facets."""
import csv
import json
import math
import pathlib
import sys
import xml.etree.ElementTree

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "app"))
import vtu  # noqa: E402
from elements import in_order  # noqa: E402
from verdict import CannotJudge, Wrong  # noqa: E402

LINE, QUAD, HEX, LAGRANGE_QUAD, LAGRANGE_HEX = 3, 9, 12, 70, 72
SHAPE = {LINE: (1, 1), QUAD: (2, 1), HEX: (3, 1), LAGRANGE_QUAD: (2, 2),
         LAGRANGE_HEX: (3, 2)}


class Nodes:
    """The rows of nodal.csv, found again by their place."""

    def __init__(self, path, dim):
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.reader(file)
            self.names = next(reader, None) or []
            try:
                rows = [[float(word) for word in row] for row in reader]
            except ValueError as error:
                raise Wrong(f"nodal.csv: {error}") from error
        if not rows or any(len(row) != len(self.names) for row in rows):
            raise Wrong("nodal.csv has no rows, or broken ones")
        if not all(math.isfinite(value) for row in rows for value in row):
            raise Wrong("nodal.csv has values that are no numbers")
        self.dim = dim
        self.columns = dict(zip(self.names, map(list, zip(*rows))))
        self.body = [int(b) for b in self.columns.get("body", [1] * len(rows))]
        axes = "xyz"[:dim]
        self.place = list(zip(*(self.columns[a] for a in axes)))
        self.extent = max(max(column) - min(column)
                          for column in zip(*self.place))
        largest = max(abs(x) for place in self.place for x in place)
        # places in other files are 32-bit numbers
        self.tolerance = max(1e-6 * self.extent, 4e-7 * largest)
        self.index = {}
        for i, place in enumerate(self.place):
            self.index.setdefault(self._key(place), []).append(i)

    def __len__(self):
        return len(self.place)

    def _key(self, place):
        return tuple(math.floor(x / (4 * self.tolerance)) for x in place)

    def vector(self, name):
        return list(zip(*(self.columns[f"{name}_{a}"]
                          for a in "xyz"[:self.dim])))

    def find(self, place, body):
        """Number of the node at a place, of a body (None: of any)."""
        ranges = [sorted({math.floor((x + d) / (4 * self.tolerance))
                          for d in (-self.tolerance, self.tolerance)})
                  for x in place]
        keys = [()]
        for values in ranges:
            keys = [key + (value,) for key in keys for value in values]
        for key in keys:
            for i in self.index.get(key, ()):
                if (body is None or self.body[i] == body) and all(
                        abs(a - b) <= self.tolerance
                        for a, b in zip(self.place[i], place)):
                    return i
        raise Wrong(f"the fields have a point at {place} that nodal.csv does "
                    "not have")


class Cell:
    """Nodes in lexicographic order."""

    def __init__(self, dim, degree, nodes, body):
        self.dim, self.degree = dim, degree
        self.nodes, self.body = nodes, body


class Fields:
    """Cells of the last step of a series, with the points' fields."""

    def __init__(self, folder, name, nodes, blank=("gap",)):
        """Fields in blank may have values that are no numbers: gaps do where
        there is no row."""
        self.blank = blank
        self.cells = []  # Cell, with `points` in the same order
        self.worst = 0.  # difference of displacements to nodal.csv
        self.values = {}  # by field: values of each cell's points
        self.numbers = []  # by cell: boundary id, or None
        for piece in self._pieces(folder, name):
            self._read(piece, nodes)

    @staticmethod
    def _pieces(folder, name):
        path = folder / f"{name}.pvd"
        if not path.exists():
            raise CannotJudge(f"{path.name} was not written (Output/Fields)")
        try:
            last = list(xml.etree.ElementTree.parse(path).iter("DataSet"))[-1]
            record = folder / last.get("file")
            for part in xml.etree.ElementTree.parse(record).iter("Piece"):
                yield from vtu.pieces(folder / part.get("Source"))
        except (OSError, ValueError, IndexError, KeyError, TypeError,
                AttributeError, vtu.zlib.error, vtu.struct.error,
                xml.etree.ElementTree.ParseError) as error:
            raise Wrong(f"{name}: cannot be read: {error}") from error

    def _read(self, piece, nodes):
        dim = nodes.dim
        n = len(piece.points)
        for name, values in piece.fields.items():
            if name not in self.blank and not all(map(math.isfinite, values)):
                raise Wrong(f"{name} has values that are no numbers")
        bodies = piece.fields.get("body")
        number = [nodes.find(place[:dim], bodies and int(bodies[i]))
                  for i, place in enumerate(piece.points)]
        displacement = piece.fields["displacement"]
        width = len(displacement) // n
        self._compare(nodes, number, displacement, width)
        ids = piece.fields.get("boundary_id")
        for kind, points in self._shapes(piece, dim, nodes):
            shape_dim, degree = kind
            points = list(points)
            order = (range(len(points)) if shape_dim == 1 else in_order(
                shape_dim, degree, [piece.points[i] for i in points]))
            points = [points[i] for i in order]
            self.cells.append(Cell(shape_dim, degree,
                                   [number[i] for i in points],
                                   nodes.body[number[points[0]]]))
            self.numbers.append(int(ids[points[0]]) if ids else None)
            for name, values in piece.fields.items():
                if len(values) == n:
                    self.values.setdefault(name, []).append(
                        [values[i] for i in points])

    @staticmethod
    def _shapes(piece, dim, nodes):
        """Cells; quadratic lines are written as two straight ones."""
        lines = [points for points, kind in zip(piece.cells, piece.types)
                 if kind == LINE]
        if lines and nodes.degree == 2:
            for a, b in zip(lines[::2], lines[1::2]):
                yield (1, 2), (a[0], a[1], b[1])
            return
        for points, kind in zip(piece.cells, piece.types):
            if kind not in SHAPE:
                raise CannotJudge(f"cells of VTK's type {kind}")
            yield SHAPE[kind], points

    def _compare(self, nodes, number, displacement, width):
        if width == 1:
            mine = nodes.columns["displacement"]
            self.worst = max([self.worst] + [
                abs(mine[i] - v) for i, v in zip(number, displacement)])
            return
        mine = nodes.vector("displacement")
        for k, i in enumerate(number):
            for d in range(nodes.dim):
                self.worst = max(self.worst, abs(
                    mine[i][d] - displacement[width * k + d]))


def read_summary(folder):
    """summary.json of a run that has an answer."""
    path = folder / "summary.json"
    if not path.exists():
        raise CannotJudge("summary.json was not written")
    try:
        summary = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise Wrong(f"summary.json: {error}") from error
    if not summary.get("converged"):
        raise CannotJudge("the run says itself that it has no answer")
    return summary


def read_nodes(folder, dim, degree):
    path = folder / "nodal.csv"
    if not path.exists():
        raise CannotJudge("nodal.csv was not written; run with "
                          "--set 'Output/Nodal values=true'")
    nodes = Nodes(path, dim)
    nodes.degree = degree
    return nodes


def last_row(folder, name):
    """The last row of a table."""
    path = folder / name
    if not path.exists():
        raise CannotJudge(f"{name} was not written")
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    if not rows:
        raise Wrong(f"{name} has no rows")
    return rows[-1]
