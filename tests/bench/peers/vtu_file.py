# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields at points of a VTU file as deal.II writes it (inline binary data,
compressed by zlib or not)."""
import base64
import struct
import xml.etree.ElementTree
import zlib

KINDS = {"Float32": "f", "Float64": "d", "Int32": "i", "UInt32": "I",
         "UInt64": "Q", "Int64": "q", "UInt8": "B", "Int8": "b"}


def _inflate(text):
    """Header (base64 by itself), then blocks (base64 together)."""
    text = "".join(text.split())
    count = struct.unpack("<I", base64.b64decode(text[:8])[:4])[0]
    head = 4 * ((4 * (3 + count) + 2) // 3)
    sizes = struct.unpack(f"<{3 + count}I",
                          base64.b64decode(text[:head])[:4 * (3 + count)])[3:]
    data, whole, at = base64.b64decode(text[head:]), b"", 0
    for size in sizes:
        whole += zlib.decompress(data[at:at + size])
        at += size
    return whole


def _numbers(array):
    """The rows of a DataArray."""
    width = int(array.get("NumberOfComponents", "1"))
    if array.get("format") == "ascii":
        values = [float(word) for word in array.text.split()]
    else:
        data = _inflate(array.text)
        letter = KINDS[array.get("type")]
        values = struct.unpack(f"<{len(data) // struct.calcsize(letter)}"
                               f"{letter}", data)
    return [values[i:i + width] for i in range(0, len(values), width)]


def read(path):
    """Points, and name -> rows."""
    root = xml.etree.ElementTree.parse(path).getroot()
    points, fields = [], {}
    for piece in root.iter("Piece"):
        points += _numbers(piece.find("Points").find("DataArray"))
        data = piece.find("PointData")
        for array in data.findall("DataArray"):
            fields.setdefault(array.get("Name"), []).extend(_numbers(array))
    return points, fields
