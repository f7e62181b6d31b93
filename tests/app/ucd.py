# SPDX-License-Identifier: LGPL-2.1-or-later
"""Mesh files in the format UCD."""
import math


def ucd(nodes, items):
    """Text of a file: nodes of two or three coordinates, and cells and sides
    (id, kind, *nodes), counted from 1."""
    lines = [f"{len(nodes)} {len(items)} 0 0 0"]
    lines += [f"{k} {x:.17g} {y:.17g} {z[0] if z else 0.:.17g}"
              for k, (x, y, *z) in enumerate(nodes, 1)]
    lines += [f"{k} {' '.join(map(str, item))}"
              for k, item in enumerate(items, 1)]
    return "\n".join(lines) + "\n"


def ucd_volume(text):
    """Volume of the hexahedra of such a file, by 2 x 2 x 2 Gauss points."""
    first, *lines = (line.split() for line in text.splitlines())
    n_nodes = int(first[0])
    place = {line[0]: [float(x) for x in line[1:]] for line in lines[:n_nodes]}
    signs = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    corners = [(x, y, z) for z in (-1, 1) for x, y in signs]
    gauss = [[c / math.sqrt(3.) for c in corner] for corner in corners]
    volume = 0.
    for line in lines[n_nodes:]:
        if line[2] != "hex":
            continue
        for at in gauss:
            rows = [[sum(corner[d] * place[node][k] / 8. * math.prod(
                1. + corner[e] * at[e] for e in range(3) if e != d)
                         for corner, node in zip(corners, line[3:]))
                     for k in range(3)] for d in range(3)]
            (a, b, c), (d, e, f), (g, h, i) = rows
            volume += abs(a * (e * i - f * h) - b * (d * i - f * g)
                          + c * (d * h - e * g))
    return volume
