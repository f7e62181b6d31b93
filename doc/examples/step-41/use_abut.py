# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write step-41 with its active sets replaced by Abut: take the installed
program, remove the functions that run.cc replaces, and add the include, the
member and an argument for the refinement level.

    use_abut.py step-41.cc[.gz] run.cc OUTPUT
"""
import gzip
import pathlib
import re
import sys


def replace(text, old, new):
    if text.count(old) != 1:
        sys.exit(f"This is not the step-41 that we know: '{old}' occurs "
                 f"{text.count(old)} times.")
    return text.replace(old, new)


def remove_function(text, name):
    """Remove ObstacleProblem<dim>::name(), which ends at a brace in its own
    column."""
    pattern = (r"  template <int dim>\n  void ObstacleProblem<dim>::" + name
               + r"\(\)\n  \{\n.*?\n  \}\n")
    text, n = re.subn(pattern, "", text, flags=re.DOTALL)
    if n != 1:
        sys.exit(f"This is not the step-41 that we know: no {name}().")
    return text


def main():
    source, addition, output = map(pathlib.Path, sys.argv[1:])
    data = source.read_bytes()
    text = (gzip.decompress(data) if source.suffix == ".gz" else data).decode()
    for name in ("update_solution_and_constraints", "solve", "run"):
        text = remove_function(text, name)
    text = replace(text, "#include <deal.II/numerics/data_out.h>\n",
                   "#include <deal.II/numerics/data_out.h>\n"
                   "#include <deal.II/fe/mapping_q1.h>\n"
                   "#include <abut/dealii/contact_assembler.h>\n"
                   "#include <iomanip>\n")
    text = replace(text, "    IndexSet                  active_set;\n",
                   "    IndexSet                  active_set;\n"
                   "    unsigned int              level = 7;\n"
                   "    const MappingQ1<dim>      mapping;\n"
                   "    abut::ContactAssembler<dim> contact{MPI_COMM_WORLD};\n\n"
                   "  public:\n"
                   "    void set_level(const unsigned int l) { level = l; }\n"
                   "  private:\n")
    text = replace(text, "refine_global(7)", "refine_global(level)")
    text = replace(text, "      obstacle_problem.run();\n",
                   "      if (argc > 1)\n"
                   "        obstacle_problem.set_level(std::stoi(argv[1]));\n"
                   "      obstacle_problem.run();\n")
    text = replace(text, "\nint main(", "\n" + addition.read_text()
                   + "\nint main(")
    output.write_text(text)


if __name__ == "__main__":
    main()
