// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_REPORT_H
#define ABUT_APP_SOLID_REPORT_H

#include "solid_model.h"

#include <optional>
#include <string>
#include <utility>

namespace abut::app
{
  /** What a run of the scene `solid` tells: the summary and what was modelled.
   * Made when it is needed; all functions are collective. */
  template <int dim> class SolidReport
  {
  public:
    explicit SolidReport(const SolidModel<dim> &model);

    /** What is known before the first solve. */
    void check() const;

    void result(bool converged) const;

    /** What was modelled, and what could have been left out. */
    void model_lines() const;

  private:
    void report_checks() const;
    /** Resultants of loads, so that a wrong sign shows before a run. */
    void report_loads() const;
    void report_points() const;
    la::Vector reactions() const;
    void report_reactions() const;
    bool is_curved(unsigned int number) const;
    void examine_zone(unsigned int number, const PairResult<dim> &result) const;
    void examine_pair(unsigned int number, const PairResult<dim> &result,
                      double facet) const;
    void report_exceptions(const std::string &key,
                           const PairResult<dim> &pair) const;
    void report_transfer() const;
    void report_numerics() const;
    void report_locking() const;
    void report_stability() const;
    void hold_whole_nodes(std::vector<std::uint8_t> &at_rest) const;
    /** Part of the energy that elements take away, -1: not known. */
    double report_cell_locking() const;
    double report_linear_simplices() const;
    /** Returns the largest imbalance of forces and of moments of a pair. */
    std::pair<double, double> report_pairs() const;
    /** "body 2 on body 1". */
    std::string sides_of(const ContactPair<dim> &pair) const;
    /** What angles of coarse facets do to pressures. */
    void report_chords() const;
    void report_friction() const;
    void examine_friction_data(std::size_t p) const;
    void examine_late(std::size_t pair, double late, double normal) const;
    void report_contact() const;
    /** What it took to find out who touches whom, and what changed. */
    void report_detection() const;
    /** Obstacles that forces move. */
    void report_driven() const;
    std::optional<double> relative_error() const;
    /** What single ranks have and had to say. */
    void report_shares() const;
    void explain_pairs() const;
    void explain_friction() const;

    const SolidModel<dim> &model;
    const ContactRunState<dim> &run;
    const SolidParameters &parameters;
    const Elasticity<dim> &elasticity;
    const Bodies<dim> &bodies;
    const SolidPairs<dim> &pairs;
    const ContactAssembler<dim> &contact;
    const MethodParameters &method;
    const la::Vector &u;
    const MPI_Comm communicator;
    Report &report;
  };
} // namespace abut::app

#endif
