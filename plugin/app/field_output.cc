// SPDX-License-Identifier: LGPL-2.1-or-later

#include "field_output.h"

#include "collective.h"

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/data_out.h>

#include <fstream>
#include <stdexcept>

namespace abut::app
{
  namespace
  {
    /** A file that is either the old or the new one, whenever the run ends. */
    void replace_file(const std::filesystem::path &path,
                      const std::string &content)
    {
      std::filesystem::path next = path;
      next += ".new";
      std::ofstream out(next, std::ios::binary);
      out << content << std::flush;
      if (!out)
        throw std::runtime_error("the file '" + next.string()
                                 + "' cannot be written");
      out.close();
      std::filesystem::rename(next, path);
    }
  } // namespace

  FieldSeries::FieldSeries(std::filesystem::path folder, std::string name,
                           MPI_Comm communicator)
      : folder(std::move(folder)),
        name(std::move(name)),
        communicator(communicator)
  {
  }

  template <int dim>
  void FieldSeries::write(const double time, const Fields<dim> &fields)
  {
    dealii::DataOut<dim> data_out;
    const unsigned int degree = fields.dof_handler.get_fe().degree;
    dealii::DataOutBase::VtkFlags flags;
    flags.time = time;
    flags.cycle = static_cast<unsigned int>(records.size());
    flags.write_higher_order_cells = degree > 1;
    // The smallest files would take longer to pack than the fields to solve
    // for; these are about a quarter larger. (The enumeration has another name
    // in later versions of deal.II.)
    flags.compression_level = decltype(flags.compression_level)::best_speed;
    data_out.set_flags(flags);
    data_out.attach_dof_handler(fields.dof_handler);

    using Interpretation =
        dealii::DataComponentInterpretation::DataComponentInterpretation;
    const unsigned int n_components =
        fields.dof_handler.get_fe().n_components();
    const std::vector<Interpretation> interpretation(
        n_components,
        n_components == dim
            ? dealii::DataComponentInterpretation::component_is_part_of_vector
            : dealii::DataComponentInterpretation::component_is_scalar);
    for (const auto &[label, values] : fields.nodal)
      data_out.add_data_vector(fields.dof_handler, *values,
                               std::vector<std::string>(n_components, label),
                               interpretation);
    for (const auto &[label, values] : fields.cells)
      data_out.add_data_vector(*values, label,
                               dealii::DataOut<dim>::type_cell_data);
    data_out.build_patches(fields.mapping, degree,
                           degree > 1 ? dealii::DataOut<dim>::curved_inner_cells
                                      : dealii::DataOut<dim>::no_curved_cells);

    const unsigned int step = static_cast<unsigned int>(records.size());
    const std::string file = data_out.write_vtu_with_pvtu_record(
        folder.string() + "/", name, step, communicator, 4, 1);
    records.emplace_back(time, file);

    collective(communicator,
               [this]()
               {
                 if (dealii::Utilities::MPI::this_mpi_process(communicator) > 0)
                   return;
                 std::ostringstream pvd;
                 dealii::DataOutBase::write_pvd_record(pvd, records);
                 replace_file(folder / (name + ".pvd"), pvd.str());
               });
  }

  template void FieldSeries::write<2>(double, const Fields<2> &);
  template void FieldSeries::write<3>(double, const Fields<3> &);
} // namespace abut::app
