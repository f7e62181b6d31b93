# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads VTU and PVTU files: ASCII, base64 and appended (base64 or raw) data,
packed by zlib or not."""
import base64
import pathlib
import xml.etree.ElementTree
import zlib

import numpy

from .errors import InputError

KINDS = {"Int8": "i1", "UInt8": "u1", "Int16": "i2", "UInt16": "u2",
         "Int32": "i4", "UInt32": "u4", "Int64": "i8", "UInt64": "u8",
         "Float32": "f4", "Float64": "f8"}


class Mesh:
    """Points, cells and fields of a file; pieces of ranks are joined."""

    def __init__(self, points, cells, types, fields, cell_fields):
        self.points = points            # n times 3
        self.cells = cells              # arrays of point numbers
        self.types = types              # VTK's numbers of cell types
        self.fields = fields            # by name: a row for each point
        self.cell_fields = cell_fields  # likewise for each cell


def read_mesh(path):
    """The Mesh of a VTU or PVTU file."""
    path = pathlib.Path(path)
    root, _ = _read(path)
    files = [path]
    if root.get("type") == "PUnstructuredGrid":
        # Ranks may share one file.
        files = dict.fromkeys(path.parent / piece.get("Source")
                              for piece in root.iter("Piece"))
    pieces = [piece for file in files for piece in _pieces(file)]
    return _joined(pieces or [Mesh(numpy.zeros((0, 3)), [], numpy.zeros(0), {},
                                   {})])


def _read(path):
    """The XML tree, and the bytes of appended raw data, which are no XML."""
    try:
        data = path.read_bytes()
    except FileNotFoundError as error:
        raise InputError(f"{path} is missing.") from error
    start, end = data.find(b"<AppendedData"), data.rfind(b"</AppendedData>")
    appended = b""
    if 0 <= start < end:
        begin = data.find(b"_", start) + 1
        appended = data[begin:end]
        data = data[:begin] + data[end:]
    try:
        return xml.etree.ElementTree.fromstring(data), appended
    except xml.etree.ElementTree.ParseError as error:
        raise InputError(f"{path} is not complete: {error}.") from error


def _pieces(path):
    root, appended = _read(path)
    arrays = _Arrays(root, appended)
    result = []
    for piece in root.iter("Piece"):
        if int(piece.get("NumberOfPoints")) == 0:
            continue
        try:
            points = arrays.read(piece.find("Points/DataArray"))
            cells = arrays.named(piece.find("Cells"))
            result.append(Mesh(
                points, numpy.split(cells["connectivity"],
                                    cells["offsets"].astype(int)[:-1]),
                cells["types"], arrays.named(piece.find("PointData")),
                arrays.named(piece.find("CellData"))))
        except (ValueError, KeyError, zlib.error) as error:
            raise InputError(f"{path} is not complete: {error}.") from error
    return result


class _Arrays:
    """Decodes the DataArrays of a file."""

    def __init__(self, root, appended):
        order = "<" if root.get("byte_order", "LittleEndian")[0] == "L" else ">"
        self.order = order
        self.head = numpy.dtype(order + KINDS[root.get("header_type",
                                                       "UInt32")])
        self.packed = root.get("compressor") is not None
        element = root.find("AppendedData")
        self.appended = appended
        self.is_base64 = element is not None and \
            element.get("encoding", "base64") == "base64"

    def named(self, element):
        if element is None:
            return {}
        return {array.get("Name"): self.read(array)
                for array in element.findall("DataArray")}

    def read(self, array):
        kind = numpy.dtype(self.order + KINDS[array.get("type")])
        how = array.get("format")
        if how == "ascii":
            values = numpy.array((array.text or "").split(), dtype=kind)
        elif how == "appended":
            data = self.appended[int(array.get("offset")):]
            values = self._decoded(data, self.is_base64, kind)
        else:
            data = (array.text or "").strip().encode()
            values = self._decoded(data, True, kind)
        n = int(array.get("NumberOfComponents") or 1)
        return values.reshape(-1, n) if n > 1 else values

    def _decoded(self, data, is_base64, kind):
        """Numbers after a head: their bytes; or number and size of blocks, of
        the last one, and the sizes that they are packed to."""
        def take(begin, size):  # bytes from a place of the data
            if not is_base64:
                return data[begin:begin + size], begin + size
            end = begin + (size + 2) // 3 * 4
            return base64.b64decode(data[begin:end])[:size], end

        width = self.head.itemsize
        if not data:
            return numpy.zeros(0, kind)
        if not self.packed:
            # Head and numbers are encoded together.
            first, _ = take(0, width)
            size = int(numpy.frombuffer(first, self.head)[0])
            whole, _ = take(0, width + size)
            return numpy.frombuffer(whole[width:], kind)
        first, _ = take(0, width)
        n = int(numpy.frombuffer(first, self.head)[0])
        if n == 0:
            return numpy.zeros(0, kind)
        head, begin = take(0, width * (3 + n))
        sizes = numpy.frombuffer(head, self.head)[3:].astype(int)
        packed, _ = take(begin, int(sizes.sum()))
        ends = numpy.concatenate([[0], numpy.cumsum(sizes)])
        return numpy.frombuffer(b"".join(
            zlib.decompress(packed[a:b]) for a, b in zip(ends, ends[1:])), kind)


def _joined(meshes):
    """One mesh; points of different pieces stay apart."""
    if len(meshes) == 1:
        return meshes[0]
    starts = numpy.cumsum([0] + [len(mesh.points) for mesh in meshes])

    def joined(fields):
        return {name: numpy.concatenate([of[name] for of in fields])
                for name in fields[0]}

    return Mesh(numpy.concatenate([mesh.points for mesh in meshes]),
                [cell + start for mesh, start in zip(meshes, starts)
                 for cell in mesh.cells],
                numpy.concatenate([mesh.types for mesh in meshes]),
                joined([mesh.fields for mesh in meshes]),
                joined([mesh.cell_fields for mesh in meshes]))
