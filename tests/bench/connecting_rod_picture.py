#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs prm/connecting-rod.prm and draws the deformed bodies with the plane of
symmetry y = 0 in front, displacements 50 times, coloured by von Mises' stress.

    tests/bench/connecting_rod_picture.py build/release/abut picture.svg
"""
import itertools
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/app"))
from vtu import pieces  # noqa: E402

TIMES, SCALE, LARGEST = 50., 7., 250.


def seen(x, y, z):
    """Place in the picture, and the distance to the front."""
    return (SCALE * (x + 0.35 * z), -SCALE * (y + 0.45 * z),
            z - 0.35 * x - 0.45 * y)


def colour(stress):
    part = min(stress / LARGEST, 1.)
    # Blue, white, red.
    low, mid, high = (40, 80, 180), (245, 245, 235), (190, 30, 30)
    a, b, t = ((low, mid, 2 * part) if part < 0.5
               else (mid, high, 2 * part - 1))
    return "#%02x%02x%02x" % tuple(round(p + t * (q - p))
                                   for p, q in zip(a, b))


def facets(piece):
    """Facets of one cell: corners and their mean stress."""
    shift = piece.fields["displacement"]
    points = [tuple(c + TIMES * shift[3 * v + d] for d, c in enumerate(x))
              for v, x in enumerate(piece.points)]
    stress, outside = piece.fields["von_mises_stress"], {}
    for cell in piece.cells:
        for face in itertools.combinations(cell[:4], 3):
            # Nodes of cells are not shared in the file.
            key = tuple(sorted(tuple(round(c, 4) for c in piece.points[v])
                               for v in face))
            outside.setdefault(key, []).append(face)
    for same in outside.values():
        if len(same) == 1:
            yield ([points[v] for v in same[0]],
                   sum(stress[v] for v in same[0]) / 3.)


def main():
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([str(pathlib.Path(sys.argv[1]).resolve()), "run",
                        str(ROOT / "prm/connecting-rod.prm"), "--quiet",
                        "--output", folder], check=True)
        drawn = []
        for piece in pieces(pathlib.Path(folder) / "fields_0000.0.vtu"):
            for corners, stress in facets(piece):
                flat = [seen(*x) for x in corners]
                (ax, ay, _), (bx, by, _), (cx, cy, _) = flat
                if abs((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)) < 1.:
                    continue
                drawn.append((sum(x[2] for x in flat) / 3., flat, stress))
    drawn.sort(key=lambda one: one[0])
    xs = [x[0] for _, flat, _ in drawn for x in flat]
    ys = [x[1] for _, flat, _ in drawn for x in flat]
    left, top = min(xs) - 10, min(ys) - 10
    width, height = max(xs) - left + 10, max(ys) - top + 40
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" '
             f'height="{height:.0f}" font-family="sans-serif" '
             'font-size="13" stroke="#555" stroke-width="0.3">',
             '<rect width="100%" height="100%" fill="white" stroke="none"/>']
    for _, flat, stress in drawn:
        path = " ".join(f"{x - left:.0f},{y - top:.0f}" for x, y, _ in flat)
        lines.append(f'<polygon points="{path}" fill="{colour(stress)}"/>')
    for k in range(20):
        lines.append(f'<rect x="{20 + 10 * k}" y="{height - 28:.0f}" width="10" '
                     f'height="10" stroke="none" '
                     f'fill="{colour(LARGEST * (k + 0.5) / 20)}"/>')
    lines.append(f'<text x="230" y="{height - 18:.0f}" stroke="none">von Mises '
                 f"stress from 0 to {LARGEST:.0f} MPa, displacements "
                 f"{TIMES:.0f} times</text></svg>")
    pathlib.Path(sys.argv[2]).write_text("\n".join(lines) + "\n",
                                         encoding="ascii")


if __name__ == "__main__":
    main()
