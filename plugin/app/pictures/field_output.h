// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FIELD_OUTPUT_H
#define ABUT_APP_FIELD_OUTPUT_H

/** @file
 * Fields over the mesh as VTU/PVTU files and the PVD file that lists them.
 */

#include "narrow_numbers.h"

#include <abut/dealii/linear_algebra.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <mpi.h>

#include <filesystem>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace abut::app
{
  /** What one output file shows. */
  template <int dim> struct Fields
  {
    const dealii::Mapping<dim> &mapping;
    const dealii::DoFHandler<dim> &dof_handler;
    /** Names and ghosted nodal values; a vector-valued element's components
     * become one vector field. */
    std::vector<std::pair<std::string, const la::Vector *>> nodal;
    /** Names and values per active cell. */
    std::vector<std::pair<std::string, const dealii::Vector<float> *>> cells;
    /** Ghosted nodal values and what makes fields of them. */
    std::vector<
        std::pair<const la::Vector *, const dealii::DataPostprocessor<dim> *>>
        derived = {};
    /** Names and ghosted nodal values of scalar unknowns on the same mesh. */
    std::vector<std::tuple<std::string, const dealii::DoFHandler<dim> *,
                           const la::Vector *>>
        others = {};
    /** Boundary ids: show these faces alone, not the cells. Empty: cells. */
    std::set<dealii::types::boundary_id> faces = {};
  };

  /** A series of fields over time or mesh level. The PVD file is written anew
   * with every step, so that a run that is killed leaves usable files. */
  class FieldSeries
  {
  public:
    /** Files are named `<name>_<step>.pvtu` and so on and `<name>.pvd`. */
    FieldSeries(std::filesystem::path folder, std::string name,
                MPI_Comm communicator);

    /** Append a step. Degree 2 and higher is written as Lagrange cells, so
     * that nothing of the solution is lost. Collective; an error of the file
     * system is an exception on all ranks. */
    template <int dim> void write(double time, const Fields<dim> &fields);

    /** What the files so far do not hold. */
    const NarrowNumbers &numbers() const
    {
      return written;
    }

    /** What a checkpoint keeps: the list of files and what is in them. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &records &written;
    }

  private:
    /** Fill in the fields and the flags of the output. */
    template <int dim, typename Output>
    void add_fields(double time, const Fields<dim> &fields,
                    Output &output) const;

    /** Write the files of a step and the list, and remember what numbers they
     * were made of. */
    template <int dim, typename Output>
    void append(double time, const Fields<dim> &fields, const Output &output);

    std::filesystem::path folder;
    std::string name;
    MPI_Comm communicator;
    std::vector<std::pair<double, std::string>> records;
    NarrowNumbers written;
  };
} // namespace abut::app

#endif
