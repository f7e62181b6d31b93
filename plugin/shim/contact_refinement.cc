// SPDX-License-Identifier: LGPL-2.1-or-later
#include "by_element.h"
#include "cell_quadrature.h"

#include <abut/dealii/contact_refinement.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe.h>
#include <deal.II/numerics/rtree.h>

#include <algorithm>
#include <cmath>

namespace abut
{
  namespace MPI = dealii::Utilities::MPI;

  template <int dim>
  unsigned int
  flag_contact_border(const dealii::DoFHandler<dim> &dof_handler,
                      const la::Vector &status,
                      const std::set<dealii::types::boundary_id> &secondary)
  {
    std::vector<dealii::types::global_dof_index> dofs;
    const auto has_border = [&](const auto &cell, const unsigned int f)
    {
      if (!cell->face(f)->at_boundary()
          || secondary.count(cell->face(f)->boundary_id()) == 0)
        return false;
      const auto &fe = cell->get_fe();
      bool has[3] = {false, false, false}; // open, stick, slip
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (shim::has_node_on_face(fe, i, f)
            && fe.system_to_component_index(i).first == 0)
          if (const int s = static_cast<int>(std::lround(status(dofs[i])));
              s >= 0 && s <= 2)
            has[s] = true;
      return has[0] + has[1] + has[2] > 1;
    };
    unsigned int count = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
    {
      if (!cell->is_locally_owned() || !cell->at_boundary())
        continue;
      shim::get_dofs(cell, dofs);
      for (const unsigned int f : cell->face_indices())
        if (has_border(cell, f))
        {
          count += cell->refine_flag_set() ? 0 : 1;
          cell->clear_coarsen_flag();
          cell->set_refine_flag();
          break;
        }
    }
    return count;
  }

  namespace
  {
    /** A contact face somewhere. */
    template <int dim> struct Face
    {
      dealii::Point<dim> center;
      double size = 0.; /**< diameter after refinement as flagged */
      unsigned int rank = 0;
      unsigned int cell = 0; /**< active cell index on that rank */

      template <typename Archive> void serialize(Archive &archive, unsigned int)
      {
        archive &center &size &rank &cell;
      }
    };

    template <int dim>
    std::vector<Face<dim>>
    gather_faces(const dealii::Triangulation<dim> &mesh,
                 const std::set<dealii::types::boundary_id> &ids,
                 const MPI_Comm communicator)
    {
      std::vector<Face<dim>> mine;
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary()
                && ids.count(cell->face(f)->boundary_id()) > 0)
              mine.push_back({cell->face(f)->center(),
                              cell->face(f)->diameter()
                                  * (cell->refine_flag_set()    ? 0.5
                                     : cell->coarsen_flag_set() ? 2.
                                                                : 1.),
                              MPI::this_mpi_process(communicator),
                              cell->active_cell_index()});
      std::vector<Face<dim>> all;
      for (auto &part : MPI::all_gather(communicator, mine))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }

    /** Add to @p cells those of this rank among @p coarse that a nearby face
     * of @p fine shows to be too large. */
    template <int dim>
    void find_too_large(const std::vector<Face<dim>> &fine,
                        const std::vector<Face<dim>> &coarse,
                        const double limit, const unsigned int rank,
                        std::set<unsigned int> &cells)
    {
      using Entry = std::pair<dealii::Point<dim>, unsigned int>;
      std::vector<Entry> centers;
      for (unsigned int i = 0; i < coarse.size(); ++i)
        centers.emplace_back(coarse[i].center, i);
      const auto tree = dealii::pack_rtree(centers);
      std::vector<Entry> nearest;
      for (const Face<dim> &face : fine)
      {
        nearest.clear();
        tree.query(boost::geometry::index::nearest(face.center, 1),
                   std::back_inserter(nearest));
        if (nearest.empty())
          return;
        const Face<dim> &other = coarse[nearest.front().second];
        const double apart = face.center.distance(other.center);
        if (other.rank == rank && other.size > limit * face.size
            && apart < 0.5 * face.size + other.size)
          cells.insert(other.cell);
      }
    }
  } // namespace

  template <int dim>
  unsigned int limit_size_ratio(dealii::Triangulation<dim> &mesh,
                                const std::vector<ContactSides> &pairs,
                                const double limit)
  {
    const MPI_Comm communicator = versions::communicator(mesh);
    const unsigned int rank = MPI::this_mpi_process(communicator);
    // Rounding must not refine what is just at the limit.
    const double bound = limit * (1. + 1e-6);
    unsigned int total = 0;
    for (unsigned int count = 1; count > 0; total += count)
    {
      std::set<unsigned int> cells;
      for (const auto &[secondary, primary] : pairs)
      {
        const auto one = gather_faces<dim>(mesh, secondary, communicator);
        const auto other = gather_faces<dim>(mesh, primary, communicator);
        find_too_large(one, other, bound, rank, cells);
        find_too_large(other, one, bound, rank, cells);
      }
      count = 0;
      for (const auto &cell : mesh.active_cell_iterators())
        if (cell->is_locally_owned()
            && cells.count(cell->active_cell_index()) > 0
            && !cell->refine_flag_set())
        {
          // Cells that are not coarsened are as large as before; look again.
          if (cell->coarsen_flag_set())
            cell->clear_coarsen_flag();
          else
            cell->set_refine_flag();
          ++count;
        }
      count = MPI::sum(count, communicator);
    }
    return total;
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template unsigned int flag_contact_border<dim>(                              \
      const dealii::DoFHandler<dim> &, const la::Vector &,                     \
      const std::set<dealii::types::boundary_id> &);                           \
  template unsigned int limit_size_ratio<dim>(                                 \
      dealii::Triangulation<dim> &, const std::vector<ContactSides> &,         \
      double);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut
