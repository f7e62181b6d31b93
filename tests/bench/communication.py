#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Bytes and messages that ranks send about contact surfaces.

Finds the pairs of a scene (`abut check`, nothing is solved) on growing meshes
and numbers of ranks, and writes a table: for the rank that has most, its own
facets, the facets of other ranks of which it has a copy, what it sent to single
ranks, and what it received from all of them. Counts do not depend on the
machine, so that any number of ranks can be run on any number of cores.

    tests/bench/communication.py build/release/abut prm/two-blocks-3d.prm \
        --levels 2 3 4 --ranks 1 2 4 8 16

Below the table are the factors of the model

    ghosts = a n + b sqrt(n),    n: own facets of the rank that has most,

over the runs on eight ranks and more, whose parts have a rim all around: the
facets near those of the rank are as many as its own, times the ratio of the two
sides' densities; those along the rim are as many as the root.
"""
import math
import re

import measured

RANKS_WITH_RIMS = 8
KEYS = ["dofs", "pair_1_facets", "facets_on_rank", "ghost_facets_on_rank",
        "communicated_messages", "communicated_bytes", "gathered_bytes"]


def numbers(text, key):
    """The numbers behind a key of the printed summary."""
    match = re.search(rf"^\s*{key}\s+(.*)$", text, re.MULTILINE)
    return [float(n) for n in re.findall(r"[-+.\de]+", match.group(1))]


def run(arguments, level, ranks):
    printed = measured.call(
        arguments.abut, ["check"], arguments.scene,
        [f"Refinement/Level={level}", "Refinement/Nested iteration=false",
         *arguments.set], ranks)
    return {key: numbers(printed, key) for key in KEYS}


def fit(points):
    """a and b of y = a n + b sqrt(n) by least squares of relative differences,
    and the largest of these."""
    # Rows (n, sqrt(n)) / y of an overdetermined system with ones.
    rows = [(n / y, math.sqrt(n) / y) for n, y in points]
    aa, ab, bb = (sum(r[i] * r[j] for r in rows)
                  for i, j in ((0, 0), (0, 1), (1, 1)))
    a1, b1 = (sum(r[i] for r in rows) for i in (0, 1))
    determinant = aa * bb - ab * ab
    a, b = (a1 * bb - b1 * ab) / determinant, (b1 * aa - a1 * ab) / determinant
    return a, b, max(abs(a * r[0] + b * r[1] - 1) for r in rows)


def main():
    parser = measured.options(__doc__)
    parser.add_argument("scene")
    parser.add_argument("--levels", type=int, nargs="+", default=[2, 3, 4])
    parser.add_argument("--ranks", type=int, nargs="+",
                        default=[1, 2, 4, 8, 16])
    measured.add_set(parser)
    arguments = parser.parse_args()
    measured.head(["level", "ranks", "unknowns", "facets", "most own",
                   "ghosts there at most", "ghosts / sqrt(own)", "messages",
                   "kB sent", "bytes per ghost", "kB gathered"])
    points = []
    for level in arguments.levels:
        for ranks in arguments.ranks:
            r = run(arguments, level, ranks)
            own, ghosts = r["facets_on_rank"][1], r["ghost_facets_on_rank"][1]
            sent = r["communicated_bytes"][0]
            measured.row([
                level, ranks, f"{r['dofs'][0]:.0f}",
                f"{sum(r['pair_1_facets']):.0f}", f"{own:.0f}", f"{ghosts:.0f}",
                f"{ghosts / math.sqrt(max(own, 1)):.1f}",
                f"{r['communicated_messages'][0]:.0f}", f"{sent / 1e3:.1f}",
                f"{sent / max(ghosts, 1):.0f}",
                f"{r['gathered_bytes'][0] / 1e3:.1f}"])
            if ranks >= RANKS_WITH_RIMS and own > 0:
                points.append((own, ghosts))
    if len(points) > 2:
        a, b, error = fit(points)
        print(f"\nghosts = {a:.2f} n + {b:.0f} sqrt(n), within "
              f"{100 * error:.0f} %")


if __name__ == "__main__":
    main()
