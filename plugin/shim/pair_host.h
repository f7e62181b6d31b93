// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_PAIR_HOST_H
#define ABUT_SHIM_PAIR_HOST_H

#include <abut/dealii/detection_report.h>
#include <abut/dealii/method_parameters.h>
#include <abut/dealii/search_parameters.h>
#include <abut/dealii/versions.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

namespace abut::shim
{
  /** Mesh, unknowns and settings of all pairs. References must outlive the
   * pairs. */
  template <int dim> struct PairHost
  {
    const dealii::Mapping<dim> &mapping;
    const dealii::DoFHandler<dim> &dof_handler;
    const dealii::AffineConstraints<double> &constraints;
    MethodParameters method;
    SearchParameters search;
    bool axisymmetric;
    abut_context *context;
    DetectionReport &detection; ///< the effort is added to it
    MPI_Comm communicator = versions::communicator(dof_handler);
  };
} // namespace abut::shim

#endif
