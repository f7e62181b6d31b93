// SPDX-License-Identifier: LGPL-2.1-or-later
#include "nitsche_rows.h"

#include "surface_stress.h"

namespace abut::shim
{
  using dealii::ExcMessage;

  template <int dim>
  void NitscheRows<dim>::find(const SurfaceRows<dim> *const surfaces,
                              const int rows, const double theta)
  {
    AssertThrow(
        surfaces != nullptr,
        ExcMessage("Method/Enforcement = nitsche is for elastic bodies, "
                   "not for membranes. Use lagrange."));
    AssertThrow(traction_ != nullptr,
                ExcMessage("Method/Enforcement = nitsche needs the stress of "
                           "the bodies: call set_surface_traction() first."));
    const PairHost<dim> &host = surfaces->set().host();
    const solve::NodeMap nodes =
        find_stress(surfaces->points(), *traction_, points_.get());
    abut_points_view view;
    check(host.context, abut_points_get(points_.get(), &view));
    terms_.stress = solve::PointOperator(host.dof_handler.locally_owned_dofs(),
                                         view, nodes, host.communicator);
    terms_.theta = theta;
    terms_.compliance.assign(rows, 0.);
    terms_.present.assign(rows, 0.);
  }

  template <int dim>
  void NitscheRows<dim>::set_penalty(const double penalty,
                                     const std::vector<double> &stiffness)
  {
    for (std::size_t i = 0; i < terms_.compliance.size(); ++i)
      terms_.compliance[i] = 1. / (penalty * stiffness[i]);
  }

  template <int dim>
  const double *NitscheRows<dim>::law_gap(const std::vector<double> &gap)
  {
    gap_.resize(gap.size());
    for (std::size_t i = 0; i < gap.size(); ++i)
      gap_[i] = gap[i] + terms_.compliance[i] * terms_.present[i];
    return gap_.data();
  }

  template class NitscheRows<2>;
  template class NitscheRows<3>;
} // namespace abut::shim
