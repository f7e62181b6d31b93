// SPDX-License-Identifier: LGPL-2.1-or-later

#include "contact_traction.h"
#include "shim/cell_quadrature.h"
#include "shim/values_by_element.h"

#include <abut/dealii/distribute.h>
#include <abut/dealii/versions.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace abut::app
{
  namespace
  {
    using Dofs = std::vector<dealii::types::global_dof_index>;

    template <int dim> class Recovery
    {
    public:
      Recovery(const dealii::Mapping<dim> &mapping,
               const dealii::DoFHandler<dim> &dof_handler,
               const std::set<dealii::types::boundary_id> &contact)
          : mapping(mapping),
            dof_handler(dof_handler),
            contact(contact),
            owned(dof_handler.locally_owned_dofs()),
            communicator(versions::communicator(dof_handler))
      {
        relevant = dealii::DoFTools::extract_locally_relevant_dofs(dof_handler);
      }

      /** Integrals of @p of_value at the shape functions over the contact
       * boundary. */
      la::Vector weights(const dealii::AffineConstraints<double> &hanging,
                         const Materials<dim> &materials,
                         const std::function<double(double)> &of_value) const
      {
        const auto points_of = shim::face_values(
            mapping, dof_handler, shim::face_mass_rule<dim>,
            dealii::update_values | dealii::update_quadrature_points
                | dealii::update_JxW_values);
        la::Vector open = open_vector();
        dealii::Vector<double> local;
        for_each_face(
            [&](const auto &cell, const unsigned int f, const Dofs &dofs)
            {
              dealii::FEFaceValues<dim> &points = points_of.of(cell);
              points.reinit(cell, f);
              const Material<dim> &material =
                  *materials.at(cell->material_id());
              local.reinit(dofs.size());
              for (unsigned int i = 0; i < dofs.size(); ++i)
                for (unsigned int q = 0; q < points.n_quadrature_points; ++q)
                  local[i] += of_value(points.shape_value(i, q)) * points.JxW(q)
                              * material.measure(points.quadrature_point(q));
              versions::distribute_local_to_global(hanging, local, dofs, open);
            });
        return close(open);
      }

      /** Where @p known is 0 put the mean of the known values of the same
       * component on the facets around. */
      void fill(const la::Vector &known, la::Vector &values) const
      {
        const la::Vector is_known = ghosted(known);
        const la::Vector here = ghosted(values);
        la::Vector open_sum = open_vector();
        la::Vector open_count = open_vector();
        for_each_face(
            [&](const auto &cell, const unsigned int f, const Dofs &dofs)
            {
              const auto &fe = cell->get_fe();
              std::vector<double> sum(dim, 0.);
              std::vector<unsigned int> count(dim, 0);
              for (unsigned int i = 0; i < dofs.size(); ++i)
                if (shim::has_node_on_face(fe, i, f) && is_known(dofs[i]) > 0.)
                {
                  const auto c = fe.system_to_component_index(i).first;
                  sum[c] += here(dofs[i]);
                  ++count[c];
                }
              for (unsigned int i = 0; i < dofs.size(); ++i)
              {
                const auto c = fe.system_to_component_index(i).first;
                if (!shim::has_node_on_face(fe, i, f) || is_known(dofs[i]) > 0.
                    || count[c] == 0)
                  continue;
                open_sum(dofs[i]) += sum[c] / count[c];
                open_count(dofs[i]) += 1.;
              }
            });
        const la::Vector sum = close(open_sum);
        const la::Vector count = close(open_count);
        double *value = la::data(values);
        for (int i = 0; i < la::n_owned(values); ++i)
          if (la::data(count)[i] > 0.)
            value[i] = la::data(sum)[i] / la::data(count)[i];
        values.compress(dealii::VectorOperation::insert);
      }

      la::Vector ghosted(const la::Vector &values) const
      {
        la::Vector result(owned, relevant, communicator);
        result = values;
        return result;
      }

      la::Vector vector() const
      {
        return la::Vector(owned, communicator);
      }

    private:
      using Cell = typename dealii::DoFHandler<dim>::active_cell_iterator;

      /** Contact faces of this rank's cells. */
      void for_each_face(const std::function<void(const Cell &, unsigned int,
                                                  const Dofs &)> &act) const
      {
        Dofs dofs;
        for (const auto &cell : dof_handler.active_cell_iterators())
        {
          if (!cell->is_locally_owned() || !cell->at_boundary())
            continue;
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary()
                && contact.count(cell->face(f)->boundary_id()) > 0)
            {
              shim::get_dofs(cell, dofs);
              act(cell, f, dofs);
            }
        }
      }

      /** A vector that takes contributions to unknowns of other ranks. */
      la::Vector open_vector() const
      {
        la::Vector open;
        open.reinit(owned, relevant, communicator, true);
        return open;
      }

      la::Vector close(la::Vector &open) const
      {
        open.compress(dealii::VectorOperation::add);
        la::Vector result = vector();
        result = open;
        return result;
      }

      const dealii::Mapping<dim> &mapping;
      const dealii::DoFHandler<dim> &dof_handler;
      const std::set<dealii::types::boundary_id> &contact;
      const dealii::IndexSet &owned;
      dealii::IndexSet relevant;
      const MPI_Comm communicator;
    };

    /** Least share of the integral of |phi| for a force per area. It is 4/9 at
     * corners of quadratic quadrilaterals, 0 at corners of straight quadratic
     * triangles, and some hundredths of curved ones. */
    const double nothing = 0.1;
  } // namespace

  template <int dim>
  la::Vector
  contact_traction(const dealii::Mapping<dim> &mapping,
                   const dealii::DoFHandler<dim> &dof_handler,
                   const dealii::AffineConstraints<double> &constraints,
                   const dealii::AffineConstraints<double> &hanging,
                   const Materials<dim> &materials,
                   const std::set<dealii::types::boundary_id> &contact,
                   const la::Vector &force, const la::Vector *status)
  {
    const Recovery<dim> recovery(mapping, dof_handler, contact);
    const la::Vector weights = recovery.weights(
        hanging, materials, [](const double phi) { return phi; });
    const la::Vector magnitudes = recovery.weights(
        hanging, materials, [](const double phi) { return std::abs(phi); });
    la::Vector traction = recovery.vector();
    la::Vector known = recovery.vector();
    const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
    for (int i = 0; i < la::n_owned(traction); ++i)
    {
      const bool is_free = !constraints.is_constrained(owned.nth_index_in_set(
          static_cast<dealii::types::global_dof_index>(i)));
      const bool is_open = status != nullptr && la::data(*status)[i] == 0.;
      if (la::data(weights)[i] <= nothing * la::data(magnitudes)[i]
          || !(is_free || is_open))
        continue;
      la::data(known)[i] = 1.;
      if (is_free)
        la::data(traction)[i] = la::data(force)[i] / la::data(weights)[i];
    }
    known.compress(dealii::VectorOperation::insert);
    traction.compress(dealii::VectorOperation::insert);
    recovery.fill(known, traction);
    hanging.distribute(traction);
    return recovery.ghosted(traction);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template la::Vector contact_traction<dim>(                                   \
      const dealii::Mapping<dim> &, const dealii::DoFHandler<dim> &,           \
      const dealii::AffineConstraints<double> &,                               \
      const dealii::AffineConstraints<double> &, const Materials<dim> &,       \
      const std::set<dealii::types::boundary_id> &, const la::Vector &,        \
      const la::Vector *);
  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
} // namespace abut::app
