#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The pictures of doc/contact-search.md from the tables of search_bench: search.svg, time
against facets, and search_bucket.svg, time against bucket size. Needs Matplotlib.

    tests/bench/search_pictures.py FOLDER
"""
import csv
import pathlib
import sys

import pictures

style = pictures.style
# These find candidates, not the nearest facet.
CANDIDATES_ONLY = {"nanoflann", "FCL", "Bullet"}
CHOSEN = 0.35  # where sizes chosen by the program are drawn


def table(file):
    with open(file, encoding="utf-8") as lines:
        return list(csv.DictReader(lines))


def column(rows, name):
    return [float(row[name]) for row in rows]


def peers(folder):
    rows = [row for row in table(folder / "search.csv")
            if row["task"] == "nearest" and row["program"] != "all pairs"
            and row["program"] not in CANDIDATES_ONLY]
    figure, axes = style.figure(style.PAGE, 0.42, columns=2, sharey=True)
    for axis, scene in zip(axes[0], ("flat", "graded")):
        for i, program in enumerate(dict.fromkeys(r["program"] for r in rows)):
            mine = [row for row in rows
                    if row["program"] == program and row["scene"] == scene]
            axis.plot(column(mine, "facets"), column(mine, "total"),
                      label=program, **style.curve_style(i))
        axis.set_xscale("log")
        axis.set_yscale("log")
        style.logarithmic(axis.xaxis)
        style.logarithmic(axis.yaxis)
        axis.set_title(f"{scene} surfaces, nearest facet", y=0.9)
        axis.set_xlabel("facets")
    axes[0, 0].set_ylabel("build and query [ns per node]")
    style.legend_above(figure, axes[0, 0].get_legend_handles_labels()[0], 4)
    style.letters(axes.flat)
    pictures.save(figure, folder / "search.svg")


def bucket_sizes(folder):
    rows = table(folder / "search_bucket.csv")
    figure, axes = style.figure(style.PAGE, 0.42, columns=2)
    for axis, kind in zip(axes[0], ("uniform", "adaptive")):
        for i, scene in enumerate(dict.fromkeys(row["scene"] for row in rows)):
            mine = [row for row in rows if row["scene"] == scene]
            given = [row for row in mine if float(row["bucket_size"]) > 0]
            chosen = [row for row in mine if float(row["bucket_size"]) == 0]
            axis.plot(column(given, "bucket_size"), column(given, kind),
                      label=scene, **style.curve_style(i))
            axis.plot([CHOSEN] * len(chosen), column(chosen, kind), "o",
                      color=style.COLOURS[i], fillstyle="none", markersize=6)
        axis.set_xscale("log")
        axis.set_yscale("log")
        style.logarithmic(axis.xaxis)
        style.logarithmic(axis.yaxis)
        axis.set_xlabel("bucket size / median facet size (rings: chosen)")
        axis.set_ylabel(f"{kind} buckets [ns per node]")
        style.legend(axis)
    style.letters(axes.flat)
    pictures.save(figure, folder / "search_bucket.svg")


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    peers(folder)
    bucket_sizes(folder)


if __name__ == "__main__":
    main()
