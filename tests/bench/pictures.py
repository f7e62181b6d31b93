# SPDX-License-Identifier: LGPL-2.1-or-later
"""The style of `abut draw` for pictures of benches. Needs Matplotlib."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "plugin/tools"))
from abut_tools import style  # noqa: E402, F401


def save(figure, picture):
    """Write the figure as the SVG file `picture`, and as PNG beside it."""
    picture = pathlib.Path(picture)
    style.save(figure, picture.parent, picture.stem)
