// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_table.h"

#include "app/input/collective.h"
#include "app/restart/disk.h"
#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>

#include <iomanip>
#include <sstream>

namespace abut::app
{
  namespace
  {
    constexpr const char *axes[] = {"x", "y", "z"};

    /** The first line. */
    std::string names_of(const std::vector<NodalColumn> &columns,
                         const unsigned int dim,
                         const unsigned int n_components)
    {
      std::string names = n_components > 1 ? "body," : "";
      for (unsigned int d = 0; d < dim; ++d)
        names += axes[d] + std::string(d + 1 < dim ? "," : "");
      for (const NodalColumn &column : columns)
        if (column.is_scalar || n_components == 1)
          names += "," + column.name;
        else
          for (unsigned int c = 0; c < n_components; ++c)
            names += "," + column.name + "_" + axes[c];
      return names + "\n";
    }

    /** The rows of the nodes that this rank owns. */
    template <int dim>
    std::string rows_of(const dealii::Mapping<dim> &mapping,
                        const dealii::DoFHandler<dim> &dof_handler,
                        const std::vector<NodalColumn> &columns)
    {
      const auto nodes_of = shim::cell_values(
          mapping, dof_handler, shim::nodes<dim>,
          dealii::update_quadrature_points, shim::ValuesOf::component);
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      std::vector<bool> seen(owned.n_elements(), false);
      std::vector<dealii::types::global_dof_index> dofs;
      std::ostringstream out;
      out << std::setprecision(17);
      for (const auto &cell : dof_handler.active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const dealii::FiniteElement<dim> &fe = cell->get_fe();
        dealii::FEValues<dim> &nodes = nodes_of.of(cell);
        nodes.reinit(
            static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
                cell));
        shim::get_dofs(cell, dofs);
        for (unsigned int i = 0; i < nodes.n_quadrature_points; ++i)
        {
          const auto first = dofs[fe.component_to_system_index(0, i)];
          if (!owned.is_element(first) || seen[owned.index_within_set(first)])
            continue;
          seen[owned.index_within_set(first)] = true;
          if (fe.n_components() > 1)
            out << cell->material_id() + 1 << ',';
          for (unsigned int d = 0; d < dim; ++d)
            out << (d > 0 ? "," : "") << nodes.quadrature_point(i)[d];
          for (const NodalColumn &column : columns)
            for (unsigned int c = 0;
                 c < (column.is_scalar ? 1u : fe.n_components()); ++c)
              out << ','
                  << column.values(dofs[fe.component_to_system_index(c, i)]);
          out << '\n';
        }
      }
      return out.str();
    }
  } // namespace

  template <int dim>
  void write_nodal_table(const std::filesystem::path &file,
                         const dealii::Mapping<dim> &mapping,
                         const dealii::DoFHandler<dim> &dof_handler,
                         const std::vector<NodalColumn> &columns)
  {
    namespace MPI = dealii::Utilities::MPI;
    const MPI_Comm communicator = versions::communicator(dof_handler);
    const auto all =
        MPI::gather(communicator, rows_of(mapping, dof_handler, columns));
    collective(communicator,
               [&]
               {
                 if (MPI::this_mpi_process(communicator) != 0)
                   return;
                 std::string text = names_of(
                     columns, dim, dof_handler.get_fe().n_components());
                 for (const std::string &part : all)
                   text += part;
                 write_file(file, text);
               });
  }

  template void write_nodal_table<2>(const std::filesystem::path &,
                                     const dealii::Mapping<2> &,
                                     const dealii::DoFHandler<2> &,
                                     const std::vector<NodalColumn> &);
  template void write_nodal_table<3>(const std::filesystem::path &,
                                     const dealii::Mapping<3> &,
                                     const dealii::DoFHandler<3> &,
                                     const std::vector<NodalColumn> &);
} // namespace abut::app
