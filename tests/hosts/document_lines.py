# SPDX-License-Identifier: LGPL-2.1-or-later
"""Write the C++ lines of doc/your-program.md as a file that compiles: each block
in a function of its own, whose parameters are what the text takes for granted,
or by itself where it is a class.

    document_lines.py your-program.md OUTPUT
"""
import pathlib
import re
import sys

HEAD = """#include <deal.II/distributed/tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <iostream>
@INCLUDES@
using namespace dealii;
namespace la = abut::la;

template <int dim> struct YourObstacle : Function<dim>
{
};

template <int dim>
void loop(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler,
          const AffineConstraints<double> &constraints, la::Vector &u,
          la::Matrix &K, la::Vector &R, la::Vector &du,
          const std::function<void(const la::Vector &)> &assemble)
{
  enum { ball, block_top };
@0@
}

void linear(const la::Matrix &K, const la::Vector &f,
            const AffineConstraints<double> &constraints, const la::Vector &u,
            la::Vector &R)
{
@1@
}

template <int dim> void wall_beside(abut::ContactPair<dim> &pair)
{
@2@
}

template <int dim>
void newton(const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler,
            const AffineConstraints<double> &constraints, la::Vector &u,
            la::Matrix &K, abut::ContactAssembler<dim> &contact)
{
  const auto assemble_residual = [](const la::Vector &, la::Vector &) {};
  const auto assemble_tangent = [](const la::Vector &) {};
@3@
}

template <int dim>
void pieces(abut::ContactAssembler<dim> &contact, la::Vector &u, la::Matrix &K,
            la::Vector &R, la::Vector &F, la::Vector &step,
            const double tolerance)
{
  const auto assemble =
      [](const la::Vector &, const la::Matrix &, const la::Vector &) {};
  const auto assemble_residual = [](const la::Vector &, la::Vector &) {};
  const auto norm = [](const la::Vector &a, const la::Vector &b)
  { return a.l2_norm() - b.l2_norm(); };
@4@
}

@5@

template <int dim>
void without_matrix(abut::ContactAssembler<dim> &contact, YourOperator &K,
                    la::Vector &R, la::Vector &du, abut::HostProblem &problem)
{
@6@
}

template <int dim>
void save_run(const IndexSet &owned, const IndexSet &relevant,
              const MPI_Comm communicator,
              parallel::distributed::Triangulation<dim> &triangulation,
              const DoFHandler<dim> &dof_handler,
              abut::ContactAssembler<dim> &contact, const la::Vector &u)
{
@7@
}

template <int dim>
void load_run(parallel::distributed::Triangulation<dim> &triangulation,
              const Mapping<dim> &mapping, const DoFHandler<dim> &dof_handler,
              const AffineConstraints<double> &constraints,
              abut::ContactAssembler<dim> &contact, la::Vector &u,
              const std::function<void()> &prepare)
{
@8@
}

template <int dim>
void loaded(ParameterHandler &prm, abut::ContactPair<dim> &pair,
            const abut_obstacle_shape &wall)
{
@9@
}

template <int dim> void membrane(abut::ContactAssembler<dim> &contact)
{
@10@
}
"""
TAIL = """
template void loop(const Mapping<2> &, const DoFHandler<2> &,
                   const AffineConstraints<double> &, la::Vector &,
                   la::Matrix &, la::Vector &, la::Vector &,
                   const std::function<void(const la::Vector &)> &);
template void wall_beside(abut::ContactPair<2> &);
template void newton(const Mapping<3> &, const DoFHandler<3> &,
                     const AffineConstraints<double> &, la::Vector &,
                     la::Matrix &, abut::ContactAssembler<3> &);
template void pieces(abut::ContactAssembler<2> &, la::Vector &, la::Matrix &,
                     la::Vector &, la::Vector &, la::Vector &, double);
template void without_matrix(abut::ContactAssembler<3> &, YourOperator &,
                             la::Vector &, la::Vector &, abut::HostProblem &);
template void save_run(const IndexSet &, const IndexSet &, MPI_Comm,
                       parallel::distributed::Triangulation<2> &,
                       const DoFHandler<2> &, abut::ContactAssembler<2> &,
                       const la::Vector &);
template void load_run(parallel::distributed::Triangulation<2> &,
                       const Mapping<2> &, const DoFHandler<2> &,
                       const AffineConstraints<double> &,
                       abut::ContactAssembler<2> &, la::Vector &,
                       const std::function<void()> &);
template void loaded(ParameterHandler &, abut::ContactPair<3> &,
                     const abut_obstacle_shape &);
template void membrane(abut::ContactAssembler<2> &);
"""


def main():
    source, output = map(pathlib.Path, sys.argv[1:])
    blocks = re.findall(r"```cpp \{show\}\n(.*?)```", source.read_text(), re.DOTALL)
    if len(blocks) != len(re.findall(r"@\d+@", HEAD)):
        sys.exit(f"{len(blocks)} blocks of C++ lines in {source}")
    include = re.compile(r"^#include.*\n", re.MULTILINE)
    text = HEAD.replace("@INCLUDES@", "".join(
        line for block in blocks for line in include.findall(block)))
    for number, block in enumerate(blocks):
        block = include.sub("", block)
        text = text.replace(f"@{number}@", block)
    output.write_text(text + TAIL)


if __name__ == "__main__":
    main()
