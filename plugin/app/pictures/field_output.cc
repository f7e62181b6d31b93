// SPDX-License-Identifier: LGPL-2.1-or-later

#include "field_output.h"

#include "app/input/collective.h"
#include "app/restart/disk.h"
#include "shim/by_element.h"
#include "shim/cell_quadrature.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/data_out_base.h>
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/data_out_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace abut::app
{
  namespace
  {
    /** Faces of this rank's cells at the boundaries of given ids. */
    template <int dim> class FaceOutput : public dealii::DataOutFaces<dim>
    {
    public:
      using Face = typename dealii::DataOutFaces<dim>::FaceDescriptor;

      explicit FaceOutput(const std::set<dealii::types::boundary_id> &ids)
          : ids(ids)
      {
      }

      Face first_face() override
      {
        return find(this->triangulation->begin_active(), 0);
      }

      Face next_face(const Face &face) override
      {
        return find(
            Cell(this->triangulation, face.first->level(), face.first->index()),
            face.second + 1);
      }

    private:
      using Cell = typename dealii::Triangulation<dim>::active_cell_iterator;

      /** The first chosen face from @p f of @p cell on. (What deal.II's own
       * functions return for a rank without faces differs from version to
       * version.) */
      Face find(Cell cell, unsigned int f) const
      {
        for (; cell != this->triangulation->end(); ++cell, f = 0)
          if (cell->is_locally_owned())
            for (; f < cell->n_faces(); ++f)
              if (cell->face(f)->at_boundary()
                  && ids.count(cell->face(f)->boundary_id()) > 0)
                return {cell, f};
        return {this->triangulation->end(), 0};
      }

      const std::set<dealii::types::boundary_id> &ids;
    };

    /** Output whose names of fields can be asked for. */
    template <typename Base> class NamedOutput : public Base
    {
    public:
      using Base::Base;
      using Base::get_dataset_names;
    };

    /** The size of the smallest cell as a part of its distance from the origin,
     * 1 at the most. Collective. */
    template <int dim>
    double smallest_size(const dealii::Triangulation<dim> &triangulation)
    {
      double size = 1.;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          size = std::min(size, cell->diameter() / cell->center().norm());
      return dealii::Utilities::MPI::min(size,
                                         versions::communicator(triangulation));
    }

    /** For each field of @p output 1 if it has infinite numbers on any rank.
     * Collective. */
    template <typename Output>
    std::vector<int> fields_beyond(const Output &output, const MPI_Comm comm)
    {
      std::vector<int> beyond(output.get_dataset_names().size(), 0);
      for (const auto &patch : output.get_patches())
        for (std::size_t field = 0; field < beyond.size(); ++field)
          for (unsigned int q = 0; q < patch.data.size(1); ++q)
            if (std::isinf(patch.data(field, q)))
              beyond[field] = 1;
      std::vector<int> anywhere(beyond.size());
      dealii::Utilities::MPI::max(beyond, comm, anywhere);
      return anywhere;
    }

    /** The part of this rank in a file of all: the first one has the head, the
     * last one the end, and each its pieces. */
    std::string part_of_rank(const std::string &whole, const unsigned int rank,
                             const unsigned int n_ranks)
    {
      static const std::string end_of_piece = "</Piece>\n";
      const std::size_t begin = rank == 0 ? 0 : whole.find("<Piece"),
                        end = whole.rfind(end_of_piece);
      if (begin == std::string::npos || end == std::string::npos)
        return "";
      return rank + 1 == n_ranks
                 ? whole.substr(begin)
                 : whole.substr(begin, end + end_of_piece.size() - begin);
    }

    /** One file of all ranks, written one after the other: what fails on one
     * fails on all, which files of MPI do not promise. Collective. */
    void write_in_turns(const std::filesystem::path &file,
                        const std::string &whole, const MPI_Comm communicator)
    {
      namespace MPI = dealii::Utilities::MPI;
      const unsigned int n_ranks = MPI::n_mpi_processes(communicator),
                         rank = MPI::this_mpi_process(communicator);
      for (unsigned int turn = 0; turn < n_ranks; ++turn)
        collective(communicator,
                   [&]
                   {
                     if (rank == turn)
                       write_file(file, part_of_rank(whole, rank, n_ranks),
                                  turn > 0);
                   });
    }
  } // namespace

  FieldSeries::FieldSeries(std::filesystem::path folder, std::string name,
                           MPI_Comm communicator)
      : folder(std::move(folder)),
        name(std::move(name)),
        communicator(communicator)
  {
  }

  template <int dim, typename Output>
  void FieldSeries::add_fields(const double time, const Fields<dim> &fields,
                               Output &output) const
  {
    dealii::DataOutBase::VtkFlags flags;
    flags.time = time;
    flags.cycle = static_cast<unsigned int>(records.size());
    // Lines are drawn straight, in pieces: deal.II 9.6 knows no curved ones.
    const int cell_dim = fields.faces.empty() ? dim : dim - 1;
    // Quadratic triangles and tetrahedra are cells of VTK of their own.
    const auto fes = shim::elements(fields.dof_handler);
    flags.write_higher_order_cells =
        cell_dim > 1
        && std::all_of(fes.begin(), fes.end(),
                       [](const auto *fe)
                       { return fe->degree > 1 && !shim::is_simplex(*fe); });
    // The smallest files would take longer to pack than the fields to solve
    // for; these are about a quarter larger. (The enumeration has another name
    // in later versions of deal.II.)
    flags.compression_level = decltype(flags.compression_level)::best_speed;
    output.set_flags(flags);
    output.attach_dof_handler(fields.dof_handler);

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
      output.add_data_vector(fields.dof_handler, *values,
                             std::vector<std::string>(n_components, label),
                             interpretation);
    for (const auto &[label, dof_handler, values] : fields.others)
      output.add_data_vector(*dof_handler, *values, label);
    for (const auto &[label, values] : fields.cells)
      output.add_data_vector(*values, label, Output::type_cell_data);
    for (const auto &[values, postprocessor] : fields.derived)
      output.add_data_vector(fields.dof_handler, *values, *postprocessor);
  }

  template <int dim, typename Output>
  void FieldSeries::append(const double time, const Fields<dim> &fields,
                           const Output &output)
  {
    for (const auto &[label, values] : fields.nodal)
      written.add_field(label, values->linfty_norm());
    const std::vector<std::string> names = output.get_dataset_names();
    const std::vector<int> beyond = fields_beyond(output, communicator);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (beyond[i] == 1)
        written.add_field(names[i], std::numeric_limits<double>::infinity());

    const unsigned int step = static_cast<unsigned int>(records.size());
    const std::string stem =
        name + "_" + dealii::Utilities::int_to_string(step, 4);
    std::ostringstream whole;
    output.write_vtu(whole);
    write_in_turns(folder / (stem + ".0.vtu"), whole.str(), communicator);
    records.emplace_back(time, stem + ".pvtu");

    collective(communicator,
               [&]()
               {
                 if (dealii::Utilities::MPI::this_mpi_process(communicator) > 0)
                   return;
                 std::ostringstream pvtu, pvd;
                 output.write_pvtu_record(pvtu, {stem + ".0.vtu"});
                 write_file(folder / (stem + ".pvtu"), pvtu.str());
                 dealii::DataOutBase::write_pvd_record(pvd, records);
                 replace_on_disk(folder / (name + ".pvd"), pvd.str());
               });
  }

  template <int dim>
  void FieldSeries::write(const double time, const Fields<dim> &fields)
  {
    const unsigned int degree =
        fields.dof_handler.get_fe_collection().max_degree();
    if (!fields.faces.empty())
    {
      NamedOutput<FaceOutput<dim>> output(fields.faces);
      add_fields(time, fields, output);
      output.build_patches(fields.mapping, degree);
      append(time, fields, output);
      return;
    }
    // Faces are of the same mesh.
    written.add_mesh(smallest_size(fields.dof_handler.get_triangulation()));
    NamedOutput<dealii::DataOut<dim>> output;
    add_fields(time, fields, output);
    output.build_patches(fields.mapping, degree,
                         degree > 1 ? dealii::DataOut<dim>::curved_inner_cells
                                    : dealii::DataOut<dim>::no_curved_cells);
    append(time, fields, output);
  }

  template void FieldSeries::write<2>(double, const Fields<2> &);
  template void FieldSeries::write<3>(double, const Fields<3> &);
} // namespace abut::app
