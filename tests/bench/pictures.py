# SPDX-License-Identifier: LGPL-2.1-or-later
"""The style of `abut draw` for pictures of benches and documents. Needs
Matplotlib."""
import argparse
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plugin/tools"))
from abut_tools import style  # noqa: E402
from abut_tools.run_folder import read_table  # noqa: E402


def run(abut, scene, folder, table, *settings):
    """Columns of a table that a run of a shipped scene writes."""
    words = [word for setting in ("Output/Pictures=false", *settings)
             for word in ("--set", setting)]
    subprocess.run([abut, "run", ROOT / "prm" / scene, "--quiet", "--output",
                    folder, *words], check=True, stderr=subprocess.DEVNULL)
    return read_table(folder / table)


def bare(axes, x, y):
    """Axes of a drawing."""
    axes.set_aspect("equal")
    axes.set_xlim(*x)
    axes.set_ylim(*y)
    axes.axis("off")


def main(document, draw):
    """Write the SVG files of the pictures that draw(abut, folder) makes in a
    folder for itself."""
    arguments = argparse.ArgumentParser(description=document)
    arguments.add_argument("abut", type=pathlib.Path)
    arguments.add_argument("--folder", type=pathlib.Path,
                           default=ROOT / "doc/pictures")
    arguments = arguments.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        for svg, _ in draw(arguments.abut, pathlib.Path(folder)):
            (arguments.folder / svg.name).write_bytes(svg.read_bytes())
            print(arguments.folder / svg.name)


def save(figure, picture):
    """Write the figure as the SVG file `picture`, and as PNG beside it."""
    picture = pathlib.Path(picture)
    style.save(figure, picture.parent, picture.stem)
