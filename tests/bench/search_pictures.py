#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of doc/develop/contact-search.md from the tables of search_bench:
search-peers.svg, time against facets, and search-bucket-size.svg, time against bucket
size. Needs Matplotlib.

    tests/bench/search_pictures.py FOLDER
"""
import pathlib
import sys

import pictures
from pictures import style
from abut_tools.run_folder import read_table

# These find candidates, not the nearest facet.
CANDIDATES_ONLY = {"nanoflann", "FCL", "Bullet"}
CHOSEN = 0.35  # where sizes chosen by the program are drawn


def peers(folder):
    table = read_table(folder / "search.csv")
    nearest = table["task"] == "nearest"
    programs = [name for name in dict.fromkeys(table["program"][nearest])
                if name not in CANDIDATES_ONLY and name != "all pairs"]
    figure, axes = style.figure(style.PAGE, 0.42, columns=2, sharey=True)
    for axis, scene in zip(axes[0], ("flat", "graded")):
        for i, program in enumerate(programs):
            mine = (nearest & (table["program"] == program)
                    & (table["scene"] == scene))
            axis.plot(table["facets"][mine], table["total"][mine], label=program,
                      **style.curve_style(i))
        style.logarithmic(axis.xaxis)
        style.logarithmic(axis.yaxis)
        axis.set_title(f"{scene} surfaces, nearest facet", y=0.9)
        axis.set_xlabel("facets")
    axes[0, 0].set_ylabel("build and query [ns per node]")
    style.legend_above(figure, axes[0, 0].get_legend_handles_labels()[0])
    style.letters(axes.flat)
    pictures.save(figure, folder / "search-peers.svg")


def bucket_sizes(folder):
    table = read_table(folder / "search_bucket.csv")
    figure, axes = style.figure(style.PAGE, 0.42, columns=2)
    for axis, kind in zip(axes[0], ("uniform", "adaptive")):
        for i, scene in enumerate(dict.fromkeys(table["scene"])):
            given, chosen = ((table["scene"] == scene) & which for which in (
                table["bucket_size"] > 0, table["bucket_size"] == 0))
            axis.plot(table["bucket_size"][given], table[kind][given],
                      label=scene, **style.curve_style(i))
            axis.plot([CHOSEN] * chosen.sum(), table[kind][chosen], "o",
                      color=style.COLOURS[i], fillstyle="none", markersize=6)
        style.logarithmic(axis.xaxis)
        style.logarithmic(axis.yaxis)
        axis.set_xlabel("bucket size / median facet size (rings: chosen)")
        axis.set_ylabel(f"{kind} buckets [ns per node]")
        style.legend(axis)
    style.letters(axes.flat)
    pictures.save(figure, folder / "search-bucket-size.svg")


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    peers(folder)
    bucket_sizes(folder)


if __name__ == "__main__":
    main()
