# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh files in the format UCD."""


def ucd(nodes, items):
    """Text of a file: nodes of two or three coordinates, and cells and sides
    (id, kind, *nodes), counted from 1."""
    lines = [f"{len(nodes)} {len(items)} 0 0 0"]
    lines += [f"{k} {x:.17g} {y:.17g} {z[0] if z else 0.:.17g}"
              for k, (x, y, *z) in enumerate(nodes, 1)]
    lines += [f"{k} {' '.join(map(str, item))}"
              for k, item in enumerate(items, 1)]
    return "\n".join(lines) + "\n"
