# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tools of the program `abut` in Python: python3 abut_tools TOOL WORDS."""
import importlib.util
import os
import pathlib
import sys
import tempfile

LACKS_PACKAGES = 120  # the program takes the next Python


def main():
    if not all(importlib.util.find_spec(name)
               for name in ("numpy", "matplotlib")):
        return LACKS_PACKAGES
    sys.path[0] = str(pathlib.Path(__file__).resolve().parent.parent)
    from abut_tools.errors import InputError
    with tempfile.TemporaryDirectory(prefix="abut-tools-") as scratch:
        # Matplotlib warns where it cannot keep what it knows of fonts.
        if not os.access(os.path.expanduser("~"), os.W_OK):
            os.environ.setdefault("MPLCONFIGDIR", scratch)
        try:
            name, *words = sys.argv[1:]
            tool = importlib.import_module(f"abut_tools.{name}")
            return tool.main(words)
        except InputError as error:
            print(f"abut: error: {error}", file=sys.stderr)
            return 2


if __name__ == "__main__":
    sys.exit(main())
