// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nodal_means.h"

#include <abut/dealii/versions.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe.h>

namespace abut::app
{
  template <int dim>
  NodalMeans<dim>::NodalMeans(const dealii::DoFHandler<dim> &scalar,
                              const unsigned int n_components)
      : scalar(scalar),
        relevant(dealii::DoFTools::extract_locally_relevant_dofs(scalar)),
        sums(n_components + 1)
  {
    for (la::Vector &sum : sums)
      sum.reinit(scalar.locally_owned_dofs(), relevant,
                 versions::communicator(scalar), true);
  }

  template <int dim>
  void NodalMeans<dim>::add(const dealii::types::global_dof_index node,
                            const double volume,
                            const std::vector<double> &values)
  {
    for (std::size_t c = 0; c < values.size(); ++c)
      sums[c](node) += volume * values[c];
    sums.back()(node) += volume;
  }

  template <int dim> std::vector<la::Vector> NodalMeans<dim>::means()
  {
    std::vector<la::Vector> result(sums.size());
    for (std::size_t c = 0; c < sums.size(); ++c)
    {
      sums[c].compress(dealii::VectorOperation::add);
      result[c].reinit(scalar.locally_owned_dofs(),
                       versions::communicator(scalar));
      result[c] = sums[c];
    }
    const double *const volume = la::data(result.back());
    for (std::size_t c = 0; c + 1 < result.size(); ++c)
      for (int i = 0; i < la::n_owned(result[c]); ++i)
        la::data(result[c])[i] /= volume[i];
    result.pop_back();
    return result;
  }

  template <int dim>
  la::Vector NodalMeans<dim>::ghosted(const la::Vector &field) const
  {
    la::Vector result(scalar.locally_owned_dofs(), relevant,
                      versions::communicator(scalar));
    result = field;
    return result;
  }

  template class NodalMeans<2>;
  template class NodalMeans<3>;
} // namespace abut::app
