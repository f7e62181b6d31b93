# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the example elasto-plastic so that Abut is linked to it instead of
loaded when it runs; its argument PLUGIN is then ignored.

    link_when_built.py elasto_plastic.cc OUTPUT
"""
import pathlib
import sys

EDITS = [
    ("#include <abut/dealii/load_plugin.h>",
     "#include <abut/dealii/registry.h>"),
    ("abut::load_plugin(settings.plugin, registry);",
     "abut::register_all(registry);"),
]


def main():
    source, output = map(pathlib.Path, sys.argv[1:])
    text = source.read_text()
    for old, new in EDITS:
        if text.count(old) != 1:
            sys.exit(f"'{old}' occurs {text.count(old)} times in {source}")
        text = text.replace(old, new)
    output.write_text(text)


if __name__ == "__main__":
    main()
