# SPDX-License-Identifier: LGPL-2.1-or-later
"""`abut draw`: pictures of a run."""
import pathlib
import sys

from . import (draw_bodies, draw_curves, draw_membrane, draw_point_mass,
               draw_search, style)
from .errors import InputError, Words, warn
from .run_folder import RunFolder
from .run_store import make_output_folder


def pictures(run, width):
    """Name and figure of each picture of a run, made one after the other."""
    if run.kind == "point mass":
        yield from draw_point_mass.pictures(run, width)
        return
    if run.kind == "obstacle":
        yield from draw_membrane.pictures(run, width)
    elif run.kind == "solid":
        yield from draw_bodies.pictures(run, width)
    elif run.kind == "search":
        yield from draw_search.pictures(run, width)
        return
    for name, draw in (("motion", draw_curves.over_time),
                       ("convergence", draw_curves.convergence)):
        figure = draw(run, width)
        if figure is not None:
            yield name, figure
            return


def main(words):
    parser = Words("draw")
    parser.add_argument("folder")
    parser.add_argument("--output", type=pathlib.Path)
    parser.add_argument("--width", type=int, default=style.PAGE,
                        choices=(style.COLUMN, style.PAGE))
    parser.add_argument("--picture", action="append", metavar="NAME")
    parser.add_argument("--quiet", action="store_true")
    arguments = parser.parse_args(words)
    run = RunFolder(arguments.folder)
    folder = arguments.output or run.path
    make_output_folder(folder)
    if not run.is_finished:
        warn("the run did not come to its end: pictures are of what it wrote.")
    wanted, drawn = arguments.picture, []
    for name, figure in pictures(run, arguments.width):
        if wanted is None or name in wanted:
            paths = style.save(figure, folder, name)
            drawn.append(name)
            if not arguments.quiet:
                print(*paths)
        else:
            style.pyplot.close(figure)
    missing = [name for name in wanted or () if name not in drawn]
    if missing:
        raise InputError(f"--picture: this run has no picture "
                         f"'{missing[0]}'.")
    if not drawn:
        print("abut: error: nothing to draw in this folder.", file=sys.stderr)
        return 3
    return 0
