// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MEMBRANE_REPORT_H
#define ABUT_APP_MEMBRANE_REPORT_H

#include "membrane_model.h"

#include <optional>

namespace abut::app
{
  /** What a run of the scene `obstacle` tells at its end. Made when it is
   * needed; all functions are collective. */
  template <int dim> class MembraneReport
  {
  public:
    explicit MembraneReport(const MembraneModel<dim> &model);

    /** `nodal.csv`. */
    void write_nodal_values() const;

    /** The time of the run beside that of linear solves with the same matrix,
     * which is assembled anew for each. */
    void compare_with_linear_solves(Membrane<dim> &problem) const;

    void result(bool converged) const;

    /** What was modelled, and what could have been left out. */
    void model_lines() const;

  private:
    double counted_seconds() const;
    std::optional<double> relative_error() const;
    /** Exact values, and how far from them. */
    void report_errors(const ContactResult &last) const;
    /** How the membrane has moved. */
    void report_motion() const;
    /** Largest part of the mesh on one rank. */
    void report_shares() const;

    const MembraneModel<dim> &model;
    const ContactRunState<dim> &run;
    const ObstacleParameters &parameters;
    const Membrane<dim> &membrane;
    const ContactAssembler<dim> &contact;
    const std::vector<ContactResult> &levels;
    const la::Vector &u;
    const MPI_Comm communicator;
    Report &report;
  };
} // namespace abut::app

#endif
