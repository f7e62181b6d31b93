# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the VTU files that deal.II writes."""
import base64
import struct
import xml.etree.ElementTree
import zlib

KINDS = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt8": "B",
         "Int64": "q", "UInt64": "Q", "UInt32": "I"}


def decode(array):
    """Numbers of a DataArray: text, or compressed blocks after a header of
    their number, two sizes and the packed sizes."""
    if array.get("format") == "ascii":
        kind = float if array.get("type").startswith("Float") else int
        return [kind(word) for word in array.text.split()]
    text = array.text.strip()
    n_blocks, = struct.unpack("<I", base64.b64decode(text[:8])[:4])
    header = (4 * (3 + n_blocks) + 2) // 3 * 4
    sizes = struct.unpack_from(f"<{3 + n_blocks}I",
                               base64.b64decode(text[:header]))[3:]
    packed = base64.b64decode(text[header:])
    data, start = b"", 0
    for size in sizes:
        data += zlib.decompress(packed[start:start + size])
        start += size
    kind = KINDS[array.get("type")]
    return struct.unpack(f"<{len(data) // struct.calcsize(kind)}{kind}", data)


class Piece:
    """What one rank has written: points, and fields by name."""

    def __init__(self, element):
        points = decode(element.find("Points/DataArray"))
        self.points = list(zip(points[::3], points[1::3], points[2::3]))
        cells = {a.get("Name"): decode(a)
                 for a in element.findall("Cells/DataArray")}
        starts = [0, *cells["offsets"]]
        self.cells = [cells["connectivity"][a:b]
                      for a, b in zip(starts, starts[1:])]
        self.types = cells["types"]
        self.fields = {a.get("Name"): decode(a)
                       for a in element.findall("PointData/DataArray")}


def pieces(path):
    """The pieces of a file, in the order of ranks."""
    tree = xml.etree.ElementTree.parse(path)
    return [Piece(element) for element in tree.iter("Piece")
            if int(element.get("NumberOfPoints")) > 0]
