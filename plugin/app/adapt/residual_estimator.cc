// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One pass over cells and faces by MeshWorker::mesh_loop. A face between two
// ranks is integrated on both, each adding the half of its own cell, so that
// nothing has to be sent but the sum.

#include "residual_estimator.h"
#include "shim/cell_quadrature.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/meshworker/mesh_loop.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace abut::app
{
  template <int dim, int n_components>
  double ResidualTerms<dim, n_components>::contact_term(
      const dealii::FEFaceValues<dim> &, const dealii::types::boundary_id,
      const double) const
  {
    return 0.;
  }

  template <int dim, int n_components>
  double ResidualTerms<dim, n_components>::measure(
      const dealii::FEFaceValuesBase<dim> &, const unsigned int) const
  {
    return 1.;
  }

  namespace
  {
    /** Contributions to eta_K^2 by active cell index. */
    using Contributions = std::vector<std::pair<unsigned int, double>>;

    constexpr unsigned int whole_face = dealii::numbers::invalid_unsigned_int;

    template <int dim, int n_components> struct Scratch
    {
      static dealii::UpdateFlags face_flags()
      {
        return dealii::update_values | dealii::update_gradients
               | dealii::update_quadrature_points
               | dealii::update_normal_vectors | dealii::update_JxW_values;
      }

      Scratch(const dealii::Mapping<dim> &mapping,
              const dealii::FiniteElement<dim> &fe)
          : quadrature(shim::face_gauss(fe, fe.degree + 1)),
            cell(mapping, fe, shim::gauss(fe, fe.degree + 1),
                 dealii::update_values | dealii::update_gradients
                     | dealii::update_hessians
                     | dealii::update_quadrature_points
                     | dealii::update_JxW_values),
            face(mapping, fe, quadrature, face_flags()),
            other_face(mapping, fe, quadrature, face_flags()),
            other_subface(mapping, fe, quadrature, face_flags()),
            flux(quadrature.size()),
            other_flux(quadrature.size()),
            stiffness(quadrature.size()),
            other_stiffness(quadrature.size())
      {
      }

      Scratch(const Scratch &other)
          : Scratch(other.cell.get_mapping(), other.cell.get_fe())
      {
      }

      dealii::Quadrature<dim - 1> quadrature;
      dealii::FEValues<dim> cell;
      dealii::FEFaceValues<dim> face;
      dealii::FEFaceValues<dim> other_face;
      dealii::FESubfaceValues<dim> other_subface;
      std::vector<dealii::Tensor<1, n_components>> flux;
      std::vector<dealii::Tensor<1, n_components>> other_flux;
      std::vector<double> stiffness;
      std::vector<double> other_stiffness;
    };

    template <int dim, int n_components> class Estimator
    {
    public:
      using Terms = ResidualTerms<dim, n_components>;
      using Cell = typename Terms::Cell;
      using Workspace = Scratch<dim, n_components>;

      explicit Estimator(const Terms &terms) : terms(terms)
      {
      }

      void on_cell(const Cell &cell, Workspace &scratch,
                   Contributions &out) const
      {
        if (terms.is_held(cell))
          return;
        scratch.cell.reinit(cell);
        const double h = side(cell);
        out.emplace_back(cell->active_cell_index(),
                         h * h * terms.interior(scratch.cell));
      }

      /** Jump over a face; @p cell is never the coarser of the two. */
      void on_face(const Cell &cell, const unsigned int f, const Cell &neighbor,
                   const unsigned int neighbor_f, const unsigned int subface,
                   Workspace &scratch, Contributions &out) const
      {
        scratch.face.reinit(cell, f);
        terms.fluxes(scratch.face, scratch.flux, scratch.stiffness);
        const dealii::FEFaceValuesBase<dim> *other = &scratch.other_face;
        if (subface == whole_face)
          scratch.other_face.reinit(neighbor, neighbor_f);
        else
        {
          scratch.other_subface.reinit(neighbor, neighbor_f, subface);
          other = &scratch.other_subface;
        }
        terms.fluxes(*other, scratch.other_flux, scratch.other_stiffness);

        double sum = 0;
        for (unsigned int q = 0; q < scratch.face.n_quadrature_points; ++q)
          sum += (scratch.flux[q] + scratch.other_flux[q]).norm_square()
                 / std::max(scratch.stiffness[q], scratch.other_stiffness[q])
                 * scratch.face.JxW(q) * terms.measure(scratch.face, q);
        for (const Cell &side_cell : {cell, neighbor})
          if (side_cell->is_locally_owned())
            out.emplace_back(side_cell->active_cell_index(),
                             0.5 * side(side_cell) * sum);
      }

      void on_boundary(const Cell &cell, const unsigned int f,
                       Workspace &scratch, Contributions &out) const
      {
        const auto id = cell->face(f)->boundary_id();
        const auto &points = scratch.face;
        scratch.face.reinit(cell, f);
        terms.fluxes(points, scratch.flux, scratch.stiffness);
        terms.boundary_residual(points, id, scratch.flux);
        double sum = 0;
        for (unsigned int q = 0; q < points.n_quadrature_points; ++q)
          sum += scratch.flux[q].norm_square() / scratch.stiffness[q]
                 * points.JxW(q) * terms.measure(points, q);
        const double h = side(cell);
        out.emplace_back(cell->active_cell_index(),
                         h * sum + terms.contact_term(points, id, h));
      }

    private:
      /** Side of the cube with the cell's diameter. */
      static double side(const Cell &cell)
      {
        return cell->diameter() / std::sqrt(double(dim));
      }

      const Terms &terms;
    };
  } // namespace

  template <int dim, int n_components>
  double estimate_residual(const dealii::Mapping<dim> &mapping,
                           const dealii::DoFHandler<dim> &dof_handler,
                           const ResidualTerms<dim, n_components> &terms,
                           dealii::Vector<float> &squared)
  {
    using Workspace = Scratch<dim, n_components>;
    using Cell = typename ResidualTerms<dim, n_components>::Cell;
    const Estimator<dim, n_components> estimator(terms);
    squared.reinit(dof_handler.get_triangulation().n_active_cells());

    const auto cell_worker =
        [&](const Cell &cell, Workspace &scratch, Contributions &out)
    { estimator.on_cell(cell, scratch, out); };
    const auto boundary_worker = [&](const Cell &cell, const unsigned int f,
                                     Workspace &scratch, Contributions &out)
    { estimator.on_boundary(cell, f, scratch, out); };
    // mesh_loop comes to a face with hanging nodes from its finer side.
    const auto face_worker = [&](const Cell &cell, const unsigned int f,
                                 const unsigned int, const Cell &neighbor,
                                 const unsigned int neighbor_f,
                                 const unsigned int subface, Workspace &scratch,
                                 Contributions &out) {
      estimator.on_face(cell, f, neighbor, neighbor_f, subface, scratch, out);
    };
    double sum = 0;
    std::set<unsigned int> unknown;
    const auto copier = [&](const Contributions &contributions)
    {
      for (const auto &[cell, value] : contributions)
      {
        // Where a cell is turned inside out its material has no stress.
        if (std::isnan(value))
        {
          unknown.insert(cell);
          continue;
        }
        squared[cell] += float(value);
        sum += value;
      }
    };

    dealii::MeshWorker::mesh_loop(
        dof_handler.begin_active(), dof_handler.end(), cell_worker, copier,
        Workspace(mapping, dof_handler.get_fe()), Contributions(),
        dealii::MeshWorker::assemble_own_cells
            | dealii::MeshWorker::assemble_own_interior_faces_once
            | dealii::MeshWorker::assemble_ghost_faces_both
            | dealii::MeshWorker::assemble_boundary_faces,
        boundary_worker, face_worker);
    const float largest = dealii::Utilities::MPI::max(
        squared.size() > 0 ? *std::max_element(squared.begin(), squared.end())
                           : 0.f,
        versions::communicator(dof_handler));
    for (const unsigned int cell : unknown)
    {
      sum += largest - squared[cell];
      squared[cell] = largest;
    }
    return std::sqrt(
        dealii::Utilities::MPI::sum(sum, versions::communicator(dof_handler)));
  }

#define ABUT_INSTANTIATE(dim, n_components)                                    \
  template class ResidualTerms<dim, n_components>;                             \
  template double estimate_residual<dim, n_components>(                        \
      const dealii::Mapping<dim> &, const dealii::DoFHandler<dim> &,           \
      const ResidualTerms<dim, n_components> &, dealii::Vector<float> &);
  ABUT_INSTANTIATE(2, 1)
  ABUT_INSTANTIATE(3, 1)
  ABUT_INSTANTIATE(2, 2)
  ABUT_INSTANTIATE(3, 3)
#undef ABUT_INSTANTIATE
} // namespace abut::app
