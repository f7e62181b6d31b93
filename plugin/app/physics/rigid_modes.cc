// SPDX-License-Identifier: LGPL-2.1-or-later
#include "rigid_modes.h"

#include "shim/values_by_element.h"

#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>

namespace abut::app
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Eigenvalues of the Gram matrix below this part of the largest are 0. */
    constexpr double threshold = 1e-8;

    /** The component @p c of all rigid motions at a point, lengths in units of
     * the body's size: translations, then rotations. */
    template <int dim>
    std::vector<double> motions(const dealii::Tensor<1, dim> &x,
                                const unsigned int c, const bool axisymmetric)
    {
      if (axisymmetric)
        return {c == 1 ? 1. : 0.};
      std::vector<double> result;
      for (unsigned int d = 0; d < dim; ++d)
        result.push_back(c == d ? 1. : 0.);
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = i + 1; j < dim; ++j)
          result.push_back(c == i ? -x[j] : c == j ? x[i] : 0.);
      return result;
    }

    template <int dim> struct Box
    {
      dealii::Point<dim> centre;
      double size = 1.;
    };

    template <int dim>
    std::vector<Box<dim>>
    bounding_boxes(const dealii::DoFHandler<dim> &dof_handler,
                   const unsigned int n_bodies, const BodyOfCell<dim> &body_of)
    {
      // Negative minima and maxima in one reduction.
      std::vector<double> bounds(2 * dim * n_bodies, -1e300);
      for (const auto &cell : dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
        {
          const unsigned int body = body_of(cell);
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int d = 0; d < dim; ++d)
            {
              double *own = &bounds[2 * (dim * body + d)];
              own[0] = std::max(own[0], -cell->vertex(v)[d]);
              own[1] = std::max(own[1], cell->vertex(v)[d]);
            }
        }
      MPI::max(bounds, versions::communicator(dof_handler), bounds);
      std::vector<Box<dim>> result(n_bodies);
      for (unsigned int body = 0; body < n_bodies; ++body)
      {
        double squared = 0.;
        for (unsigned int d = 0; d < dim; ++d)
        {
          const double *own = &bounds[2 * (dim * body + d)];
          result[body].centre[d] = 0.5 * (own[1] - own[0]);
          squared += (own[1] + own[0]) * (own[1] + own[0]);
        }
        result[body].size = std::sqrt(squared);
      }
      return result;
    }

    template <int dim>
    RigidFreedom describe(dealii::LAPACKFullMatrix<double> &gram)
    {
      const unsigned int n = gram.m();
      std::vector<bool> holds(n);
      bool any = false;
      double largest = 0.;
      for (unsigned int i = 0; i < n; ++i)
        largest = std::max(largest, gram(i, i));
      for (unsigned int i = 0; i < n; ++i)
      {
        holds[i] = gram(i, i) > threshold * largest && largest > 0.;
        any = any || holds[i];
      }
      RigidFreedom result;
      for (unsigned int d = 0; d < dim; ++d)
        result.translations.push_back(n == 1 ? d == 1 && !holds[0] : !holds[d]);
      if (!any)
      {
        result.n_modes = n;
        result.description = "every rigid motion";
        return result;
      }
      gram.compute_eigenvalues();
      for (unsigned int i = 0; i < n; ++i)
        if (std::abs(gram.eigenvalue(i)) <= threshold * largest)
          ++result.n_modes;
      unsigned int named = 0;
      const char *axes[] = {"x", "y", "z"};
      for (unsigned int d = 0; d < std::min<unsigned int>(dim, n); ++d)
        if (!holds[d])
        {
          result.description +=
              (named++ > 0 ? ", " : "")
              + std::string(n == 1 ? "a translation along the axis"
                                   : "a translation along ")
              + (n == 1 ? "" : axes[d]);
        }
      if (named < result.n_modes)
        result.description += std::string(named > 0 ? ", " : "") + "a rotation";
      return result;
    }
  } // namespace

  template <int dim>
  std::vector<RigidFreedom> rigid_freedom(
      const dealii::Mapping<dim> &mapping,
      const dealii::DoFHandler<dim> &dof_handler, const unsigned int n_bodies,
      const BodyOfCell<dim> &body_of, const PlaneModel plane,
      const std::map<dealii::types::boundary_id, dealii::ComponentMask>
          &supports)
  {
    const bool rings = dim == 2 && plane == PlaneModel::axisymmetric;
    const auto boxes = bounding_boxes(dof_handler, n_bodies, body_of);
    const auto nodes_of = shim::face_values(
        mapping, dof_handler, shim::face_nodes<dim>,
        dealii::update_quadrature_points, shim::ValuesOf::component);
    const std::size_t n =
        motions<dim>(dealii::Tensor<1, dim>(), 0, rings).size();
    std::vector<double> grams(n * n * n_bodies, 0.);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
        {
          const auto held = supports.find(cell->face(f)->boundary_id());
          if (!cell->face(f)->at_boundary() || held == supports.end())
            continue;
          dealii::FEFaceValues<dim> &nodes = nodes_of.of(cell);
          nodes.reinit(
              static_cast<typename dealii::Triangulation<dim>::cell_iterator>(
                  cell),
              f);
          const unsigned int body = body_of(cell);
          for (const dealii::Point<dim> &point : nodes.get_quadrature_points())
            for (unsigned int c = 0; c < dim; ++c)
              if (held->second[c])
              {
                const auto m = motions<dim>(
                    (point - boxes[body].centre) / boxes[body].size, c, rings);
                for (std::size_t i = 0; i < n; ++i)
                  for (std::size_t j = 0; j < n; ++j)
                    grams[(body * n + i) * n + j] += m[i] * m[j];
              }
        }
    MPI::sum(grams, versions::communicator(dof_handler), grams);
    std::vector<RigidFreedom> result;
    for (unsigned int body = 0; body < n_bodies; ++body)
    {
      dealii::LAPACKFullMatrix<double> gram(n, n);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          gram(i, j) = grams[(body * n + i) * n + j];
      result.push_back(describe<dim>(gram));
    }
    return result;
  }

  template std::vector<RigidFreedom> rigid_freedom<2>(
      const dealii::Mapping<2> &, const dealii::DoFHandler<2> &, unsigned int,
      const BodyOfCell<2> &, PlaneModel,
      const std::map<dealii::types::boundary_id, dealii::ComponentMask> &);
  template std::vector<RigidFreedom> rigid_freedom<3>(
      const dealii::Mapping<3> &, const dealii::DoFHandler<3> &, unsigned int,
      const BodyOfCell<3> &, PlaneModel,
      const std::map<dealii::types::boundary_id, dealii::ComponentMask> &);
} // namespace abut::app
