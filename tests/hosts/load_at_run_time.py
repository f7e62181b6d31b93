# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the example two-bodies so that it loads Abut when it runs, from the
file that ABUT_PLUGIN names, instead of being linked to it.

    load_at_run_time.py two_bodies.cc OUTPUT
"""
import pathlib
import sys

EDITS = [
    ("#include <abut/dealii/contact_assembler.h>",
     "#include <abut/dealii/load_plugin.h>"),
    ("contact(MPI_COMM_WORLD)", "loaded(load()), contact(*loaded)"),
    ("  abut::ContactAssembler<dim> contact;", """
  static std::unique_ptr<abut::ContactAssembler<dim>> load()
  {
    abut::Registry<dim> registry;
    abut::load_plugin(std::getenv("ABUT_PLUGIN"), registry);
    return registry.create("lagrange", MPI_COMM_WORLD);
  }
  std::unique_ptr<abut::ContactAssembler<dim>> loaded;
  abut::ContactAssembler<dim> &contact;"""),
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
