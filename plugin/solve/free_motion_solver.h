// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_FREE_MOTION_SOLVER_H
#define ABUT_SOLVE_FREE_MOTION_SOLVER_H

#include "row_solver.h"
#include "unsupported_bodies.h"

#include <memory>
#include <optional>
#include <string>

namespace abut::solve
{
  /** A solver of rows for bodies that contact alone supports. Where the rows
   * of a request leave rigid motions free, which makes the system singular,
   *
   *   - motions without a resisting row are constrained by springs at as many
   *     unknowns, the others by springs on as many open or slipping rows,
   *   - inertia balances the loads along these motions (M z c with
   *     z.M z c = z.F), so that no spring has a force,
   *   - bodies then move along them: by the least distance in the mean square
   *     if the loads do no work, else as far as an open row allows, and a
   *     little further, so that the active set closes that row.
   *
   * A motion along which loads do work and which no row stops is F12 at once,
   * or F42 at the end of the iteration if friction could stop it. Without
   * begin_iteration() each free motion is F12 or F42. */
  class FreeMotionSolver : public RowSolver
  {
  public:
    explicit FreeMotionSolver(std::unique_ptr<RowSolver> inner);

    void set_near_null_space(const NearNullSpace &space) override;
    void set_bodies(const Stiffness &bodies) override;
    void reinit(const Stiffness &stiffness, const PointOperator &rows,
                const std::vector<double> &row_stiffness) override;
    void renew(const Stiffness &stiffness, const PointOperator &rows,
               const std::vector<double> &row_stiffness) override;
    std::vector<PreconditionerState> state() const override;
    void restore(const std::vector<PreconditionerState> &state) override;
    void begin_iteration(const ContactIteration &iteration) override;
    std::vector<FreeMotion> end_iteration(const abut_request &request) override;
    std::vector<BodyMotion>
    rigid_motions(const la::Vector &displacement) const override;
    LinearReport solve(const la::Vector &residual, const abut_request &request,
                       double smallest_residual,
                       la::Vector &increment) override;

  private:
    using Combination = UnsupportedBodies::Combination;
    using Combinations = std::vector<Combination>;

    /** The motions that the present request leaves free. */
    struct Free
    {
      Combinations motions;
      UnsupportedBodies::Resisting resisting;
      bool slips = false;          ///< friction acts along some of them
      std::vector<double> forces;  ///< [motions] work of the loads
      std::vector<double> springs; ///< [rows] forces of springs, with slips
      bool works = false;          ///< and it is no round-off
      std::vector<double> mass;    ///< [motions x motions]
    };

    const Stiffness &set_stiffness(const Stiffness &stiffness,
                                   const PointOperator &rows,
                                   const std::vector<double> &row_stiffness);
    void fix_uncoupled(const Stiffness &stiffness);
    void find_turning(const Stiffness &stiffness);
    /** The parts of these motions that forces which turn do not resist. */
    Combinations unresisted(const Combinations &motions) const;
    /** Returns whether loads do work along motions without a resisting row,
     * which are an error unless the next iteration may resist them. */
    bool check_uncoupled(const la::Vector &residual);
    Free find_free(const la::Vector &residual,
                   const abut_request &request) const;
    /** Work of the loads along the motions. Collective. */
    void find_work(const la::Vector &residual, Free &free) const;
    void find_mass(Free &free) const;
    /** The motion that the loads drive, 1 at most. */
    Combination driven(const Free &free) const;
    la::Vector balanced(const Free &free, const la::Vector &residual) const;
    LinearReport
    solve_with_springs(const Free &free, const la::Vector &residual,
                       const abut_request &request, double smallest_residual,
                       la::Vector &increment, std::vector<double> &force);
    void find_spring_forces(Free &free) const;
    /** Motions that sticking points leave free, if springs in the place of
     * slipping points work along them. Collective. */
    Free pivots(const Free &free) const;
    /** Solve mass c = right. */
    static std::vector<double> divide_by_mass(const Free &free,
                                              const std::vector<double> &right);
    Combination combine(const Combinations &motions,
                        const std::vector<double> &coefficients) const;
    /** [groups] whether no row of the group is closed. Collective. */
    std::vector<std::uint8_t> groups_apart(const abut_request &request) const;
    /** How far a motion may go until an open row closes, infinite if none
     * does; with @p others rows of pairs without closed rows alone count.
     * Collective. */
    double distance_to_contact(const Combination &motion,
                               const abut_request &request, bool others) const;
    /** How far a motion may go until the slip of a point is reversed, infinite
     * if it is never. Collective. */
    double distance_to_stick(const Combination &motion,
                             const abut_request &request) const;
    void move(const Combination &motion, double distance,
              const abut_request &request, la::Vector &increment) const;
    /** The same until bodies touch: slips of groups without closed rows begin
     * there. Collective. */
    void approach(const Combination &motion, double distance,
                  const abut_request &request, la::Vector &increment) const;
    void advance(const Free &free, const abut_request &request,
                 la::Vector &increment);
    void settle(const Free &free, const abut_request &request,
                la::Vector &increment) const;
    /** Work below which there is none: a part of the load's, and round-off of
     * internal forces, whose work along rigid motions is 0. Collective. */
    double work_tolerance() const;
    /** The parts of these motions that rows resist. */
    Combinations coupled(const Combinations &motions) const;

    std::unique_ptr<RowSolver> inner_;
    NearNullSpace space_;
    UnsupportedBodies unsupported_;
    Combinations uncoupled_;          ///< motions without a resisting row
    std::optional<Stiffness> bodies_; ///< without forces that turn
    std::vector<double> turning_;     ///< [motions x motions] their stiffness
    std::vector<double> diagonal_;
    const PointOperator *rows_ = nullptr;
    std::vector<double> row_stiffness_;
    la::Matrix fixed_; ///< the matrix with springs against uncoupled motions
    Stiffness stiffness_;
    LocalElimination local_;
    ContactIteration iteration_;
    bool has_begun_ = false;
    double no_work_ = 0.;   ///< work_tolerance() of the present solve
    la::Vector moved_;      ///< by this iteration
    Combination slipping_;  ///< motion that friction does not stop; empty: none
    Combinations deferred_; ///< to the next iteration, if contact carries loads
  };
} // namespace abut::solve

#endif
