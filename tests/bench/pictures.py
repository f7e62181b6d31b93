# SPDX-License-Identifier: LGPL-2.1-or-later
"""Runs and drawings for the pictures of documents, in the style of `abut draw`. Needs
Matplotlib."""
import argparse
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plugin/tools"))
from matplotlib.collections import PolyCollection  # noqa: E402

from abut_tools import style  # noqa: E402
from abut_tools.run_folder import RunFolder  # noqa: E402


def run(abut, scene, folder, *settings, check=True):
    """A run of a scene, of prm/ or with its path."""
    scene = ROOT / "prm" / scene
    words = [word for setting in ("Output/Pictures=false", *settings)
             for word in ("--set", setting)]
    subprocess.run([pathlib.Path(abut).resolve(), "run", scene, "--quiet", "--output",
                    folder, *words],
                   cwd=scene.parent, check=check)
    return RunFolder(folder)


def bare(axes, x, y):
    """Axes of a drawing."""
    axes.set_aspect("equal")
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.axis("off")


def arrow(axes, begin, end, colour=style.BLACK, kind="->", linewidth=0.9, shrink=0,
          head=8):
    """An arrow; `shrink` points are left out at its ends."""
    axes.annotate("", end, begin, arrowprops={
        "arrowstyle": kind, "color": colour, "linewidth": linewidth,
        "shrinkA": shrink, "shrinkB": shrink, "mutation_scale": head})


def field(axes, polygons, values, linewidth, text, **more):
    """Polygons with colours for values."""
    shown = PolyCollection(polygons, array=values, cmap=style.FIELD_MAP,
                           edgecolors="#00000060", linewidths=linewidth, rasterized=True)
    axes.add_collection(shown)
    axes.get_figure().colorbar(shown, ax=axes, label=text, **more)


def parser(document):
    """The words of a script that makes pictures."""
    result = argparse.ArgumentParser(description=document)
    result.add_argument("abut", type=pathlib.Path)
    result.add_argument("--folder", type=pathlib.Path, default=ROOT / "doc/pictures")
    return result


def write(arguments, draw):
    """Write the SVG files that draw(abut, folder) makes in a folder for itself."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        draw(arguments.abut, folder)
        for svg in folder.glob("*.svg"):
            (arguments.folder / svg.name).write_bytes(svg.read_bytes())
            print(arguments.folder / svg.name)


def main(document, draw):
    write(parser(document).parse_args(), draw)


def save(figure, picture):
    """Write the figure as the SVG file `picture`, and as PNG beside it."""
    picture = pathlib.Path(picture)
    style.save(figure, picture.parent, picture.stem)
