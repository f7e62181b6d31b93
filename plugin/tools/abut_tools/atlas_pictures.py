# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of the failure atlas: the failing run and the cured one side by
side."""
import io

from matplotlib import font_manager
from PIL import Image, ImageDraw, ImageFont

from . import draw, style
from .errors import InputError
from .run_folder import RunFolder

DPI = 110     # the page has a picture for each entry
COLOURS = 64  # of such a picture


def first_picture(folder):
    """The first picture of a run as an image, other than that of its effort;
    None where there is nothing to draw."""
    try:
        figure = next(figure for name, figure
                      in draw.pictures(RunFolder(folder), style.COLUMN)
                      if name != "convergence")
    except (InputError, StopIteration):
        return None
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=DPI)
    style.pyplot.close(figure)
    return Image.open(data).convert("RGB")


def draw_pair(folders, titles, path):
    """Draw two runs into a PNG; False where there is nothing to draw."""
    images = [first_picture(folder) for folder in folders]
    drawn = [image for image in images if image]
    if not drawn:
        return False
    images = [image or Image.new("RGB", drawn[0].size, "white")
              for image in images]
    font = ImageFont.truetype(font_manager.findfont("DejaVu Sans"), DPI // 8)
    strip = DPI // 5
    pair = Image.new("RGB", (sum(image.width for image in images),
                             strip + max(image.height for image in images)),
                     "white")
    left = 0
    for letter, title, image in zip("ab", titles, images):
        ImageDraw.Draw(pair).text((left + 4, 2), f"({letter}) {title}", "black",
                                  font)
        pair.paste(image, (left, strip))
        left += image.width
    pair.quantize(COLOURS).save(path, optimize=True)
    return True
