// SPDX-License-Identifier: LGPL-2.1-or-later
#include "residual_check.h"

#include "short_text.h"

#include <abut/dealii/contact_pair.h>

#include <deal.II/dofs/dof_tools.h>

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Next to displacements that are prescribed in one component: their mean
     * in the cells around each free unknown, and the number of these cells;
     * unknowns in cells with hanging nodes are marked. */
    struct Neighbours
    {
      la::Vector value, count, hanging;
    };

    template <int dim>
    Neighbours neighbours(const ContactHost<dim> &host,
                          const la::Vector &ghosted, const la::Vector &empty,
                          const unsigned int axis)
    {
      const auto &constraints = host.constraints();
      Neighbours result = {empty, empty, empty};
      std::vector<dealii::types::global_dof_index> dofs;
      for (const auto &cell : host.dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        const auto &fe = cell->get_fe();
        dofs.resize(fe.n_dofs_per_cell());
        cell->get_dof_indices(dofs);
        double sum = 0.;
        unsigned int n = 0;
        bool hangs = false;
        for (unsigned int k = 0; k < dofs.size(); ++k)
          if (constraints.is_constrained(dofs[k]))
          {
            const auto *entries = constraints.get_constraint_entries(dofs[k]);
            if (entries != nullptr && !entries->empty())
              hangs = true;
            else if (fe.is_primitive(k)
                     && fe.system_to_component_index(k).first == axis)
            {
              sum += ghosted(dofs[k]);
              ++n;
            }
          }
        for (const auto dof : dofs)
        {
          if (constraints.is_constrained(dof))
            continue;
          if (n > 0)
          {
            result.value(dof) += sum / n;
            result.count(dof) += 1.;
          }
          if (hangs)
            result.hanging(dof) += 1.;
        }
      }
      for (la::Vector *vector : {&result.value, &result.count, &result.hanging})
        vector->compress(dealii::VectorOperation::add);
      return result;
    }

    /** 1 at free unknowns of one component. */
    template <int dim>
    la::Vector translation(const ContactHost<dim> &host,
                           const la::Vector &empty, const unsigned int axis)
    {
      la::Vector result(empty);
      const unsigned int n = host.dof_handler().get_fe().n_components();
      dealii::ComponentMask mask(n, false);
      mask.set(axis, true);
      for (const auto dof :
           dealii::DoFTools::extract_dofs(host.dof_handler(), mask))
        if (host.owned().is_element(dof)
            && !host.constraints().is_constrained(dof))
          result(dof) = 1.;
      result.compress(dealii::VectorOperation::insert);
      return result;
    }
  } // namespace

  template <int dim> void ResidualCheck<dim>::clear(const bool is_new_mesh)
  {
    has_prescribed_ = has_prescribed_ && !is_new_mesh;
    finding_ = Message();
    lost_ = 0.;
    residual_ = start_ = la::Vector();
  }

  template <int dim>
  void ResidualCheck<dim>::begin(const solve::Stiffness &matrix,
                                 const la::Vector &residual,
                                 const la::Vector &displacement)
  {
    clear();
    residual_ = residual;
    start_ = displacement;
    if (!has_prescribed_)
      find_lost(matrix, residual, displacement);
  }

  template <int dim>
  void ResidualCheck<dim>::compare(const solve::Stiffness &matrix,
                                   const la::Vector &residual,
                                   const la::Vector &displacement,
                                   const double round_off)
  {
    if (residual_.size() == 0)
      return;
    la::Vector change(residual), way(displacement), expected(residual);
    change -= residual_;
    way -= start_;
    residual_ = start_ = la::Vector();
    host_.constraints().set_zero(change);
    host_.constraints().set_zero(way);
    matrix.vmult(expected, way);
    host_.constraints().set_zero(expected);
    const double size = expected.l2_norm();
    constexpr double same = 1e-6, visible = 1e-3, significant = 1e4;
    if (!(size > significant * round_off))
      return;
    // Forces of a linear problem that is not the matrix's are a multiple of
    // the expected ones; others are nonlinear, and only their sign is known.
    const double factor = (change * expected) / (size * size);
    const double work = (change * way) / (expected * way);
    change.add(-factor, expected);
    const bool is_multiple = change.l2_norm() <= same * size + round_off;
    const std::string text =
        "The residual R changes by " + three_digits(is_multiple ? factor : work)
        + " times K du in a step du"
        + (is_multiple ? "" : ", as far as it does work on du")
        + ", where K is its derivative. "
        + (std::abs(factor) < same
               ? "Assemble R at the displacement after each step."
               : "Check that R is internal minus external forces, and of the "
                 "same stiffness as K.");
    const Message::Numbers numbers = {
        {"change of R by K du", is_multiple ? factor : work}};
    if (is_multiple && factor < same)
      throw ContactError(coded(ABUT_FAILURE_UNBALANCED, text, numbers));
    if (work < 0. || (is_multiple && std::abs(factor - 1.) > visible))
    {
      finding_ = text;
      finding_.numbers = numbers;
    }
  }

  template <int dim>
  void ResidualCheck<dim>::find_lost(const solve::Stiffness &matrix,
                                     const la::Vector &residual,
                                     const la::Vector &displacement)
  {
    const auto &constraints = host_.constraints();
    double largest = 0.;
    for (const auto &line : constraints.get_lines())
      if (line.entries.empty() && host_.owned().is_element(line.index))
        largest = std::max(largest, std::abs(displacement(line.index)));
    const MPI_Comm communicator = matrix.communicator();
    largest = MPI::max(largest, communicator);
    if (largest == 0. || host_.dof_handler().get_fe().n_components() < dim)
      return;
    // K of a body that moves as one is 0 with all columns, so the product
    // without those that are eliminated is minus what they have.
    la::Vector ghosted(
        host_.owned(),
        dealii::DoFTools::extract_locally_relevant_dofs(host_.dof_handler()),
        communicator);
    ghosted = displacement;
    la::Vector forces(residual), product(residual), free(displacement);
    constraints.set_zero(free);
    matrix.vmult(product, free);
    forces -= product; // those of prescribed displacements, and loads
    const std::vector<double> &diagonal = matrix.diagonal();
    std::vector<double> expected(diagonal.size(), 0.);
    bool is_elastic = true;
    for (unsigned int axis = 0; axis < dim; ++axis)
    {
      const Neighbours near =
          neighbours(host_, ghosted, matrix.make_vector(), axis);
      matrix.vmult(product, translation(host_, matrix.make_vector(), axis));
      constraints.set_zero(product);
      for (std::size_t k = 0; k < expected.size(); ++k)
      {
        constexpr double round_off = 1e-8;
        const double n = la::data(near.count)[k];
        if (n > 0.)
          expected[k] -= la::data(near.value)[k] / n * la::data(product)[k];
        else if (la::data(near.hanging)[k] == 0.
                 && std::abs(la::data(product)[k]) > round_off * diagonal[k])
          is_elastic = false; // inertia, or springs
      }
    }
    double sums[2] = {0., 0.}, scale = 0.;
    for (std::size_t k = 0; k < expected.size(); ++k)
    {
      if (expected[k] == 0.)
        continue;
      scale = std::max(scale, diagonal[k] * largest);
      sums[0] += expected[k] * expected[k];
      sums[1] += la::data(forces)[k] * la::data(forces)[k];
    }
    MPI::sum(sums, communicator, sums);
    constexpr double nothing = 1e-2, round_off = 1e-10;
    if (MPI::min(int(is_elastic), communicator) == 1
        && std::sqrt(sums[0]) > round_off * MPI::max(scale, communicator)
        && sums[1] < nothing * nothing * sums[0])
      lost_ = largest;
    has_prescribed_ = lost_ == 0.;
  }

  template class ResidualCheck<2>;
  template class ResidualCheck<3>;
} // namespace abut::shim
