#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Symbols of the libraries: the C library exports what the headers mark with
ABUT_API and nothing else; the library for deal.II the same and namespace abut;
the plugin its one entry."""
import argparse
import pathlib
import re
import subprocess
import sys


def exported(library):
    """Symbols that a library defines, readable; weak ones, too."""
    text = subprocess.run(["nm", "-DC", "--defined-only", library],
                          capture_output=True, text=True, check=True).stdout
    return {line.split(maxsplit=2)[2] for line in text.splitlines()}


def declared(folder):
    """Names that headers mark with ABUT_API, but those of entries that others
    define: plugins and users' laws."""
    names = set()
    for header in pathlib.Path(folder).glob("*.h"):
        if header.name in ("plugin.h", "user_law.h", "export.h"):
            continue
        text = re.sub(r"/\*.*?\*/", "", header.read_text(), flags=re.DOTALL)
        for declaration in re.findall(r"\bABUT_API\b([^;]*);", text):
            names.add(re.search(r"\b(abut_\w+)\s*\(", declaration).group(1))
    return names


IN_NAMESPACE = re.compile(
    r"^(?:typeinfo (?:name )?for |vtable for |VTT for |guard variable for "
    r"|non-virtual thunk to )?(?:[\w:<>*&, ]* )?abut::")


def compare(name, found, expected):
    for symbol in sorted(found - expected):
        print(f"FAILED: {name} exports {symbol}, which no header declares")
    for symbol in sorted(expected - found):
        print(f"FAILED: {name} does not export {symbol}")
    return found == expected


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("library", "core", "plugin", "headers"):
        parser.add_argument("--" + name, required=True)
    arguments = parser.parse_args()
    c_names = declared(arguments.headers)
    print(f"{len(c_names)} functions are declared")
    good = len(c_names) > 50
    good &= compare("the C library", exported(arguments.core), c_names)
    library = exported(arguments.library)
    in_namespace = {name for name in library if IN_NAMESPACE.match(name)}
    print(f"{len(in_namespace)} symbols in namespace abut")
    good &= compare("the library", library - in_namespace, c_names)
    inside = sorted(name for name in in_namespace
                    if re.search(r"abut::(shim|solve|app|internal)::"
                                 r"|::Implementation::|anonymous", name))
    for name in inside:
        print(f"FAILED: the library exports {name}, which is inside")
    good &= not inside
    good &= compare("the plugin", exported(arguments.plugin),
                    {"abut_plugin_query"})
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
