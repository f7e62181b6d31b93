/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_SOLVE_ROW_SOLVER_H
#define ABUT_SOLVE_ROW_SOLVER_H

#include "near_null_space.h"
#include "point_operator.h"
#include "preconditioner_state.h"
#include "stiffness.h"

#include <abut/dealii/contact_examination.h>
#include <abut/dealii/linear_algebra.h>
#include <abut/dealii/solver_parameters.h>
#include <abut/strategy.h>

#include <functional>
#include <string>
#include <vector>

namespace abut::solve
{
  /** The iteration that requests belong to. */
  struct ContactIteration
  {
    /** [rows] present gaps, which must live as long as the iteration. */
    const std::vector<double> *gap = nullptr;
    /** [rows] pair of each row, below n_groups; empty: not known. */
    std::vector<int> group;
    std::size_t n_groups = 1;
    /** [n_groups] nonzero: slips of the group begin with the step, not with its
     * first touch; empty: none. */
    std::vector<std::uint8_t> pressed;
    /** Displacement at its start, which must live as long; null: 0. */
    const la::Vector *start = nullptr;
    /** Sum of the magnitudes of the loads at nodes, force >= 0. */
    double load = 0.;
    /** Tolerance of the last linear systems. */
    double linear_tolerance = 0.;
    /** Whether directions of contact forces change with motions and forces by
     * which they do so are not known yet: a motion that nothing resists in this
     * iteration may be resisted in the next one. */
    bool turns = false;
    /** Called where bodies move as rigid bodies until they touch: the [bodies]
     * motions, and the [n_groups] groups without a closed row before that
     * are not pressed, whose slips are measured from there. The same on all
     * ranks. */
    std::function<void(const std::vector<RigidMotion> &motions,
                       const std::vector<std::uint8_t> &is_apart)>
        approach;
  };

  /** A rigid motion of a body along which loads do no work and which nothing
   * resists. */
  struct FreeMotion
  {
    unsigned int body = 0;   ///< from 0
    std::string description; ///< "body 1 can slide along (1, 0)"
  };

  /** One linearised step of a contact problem: find du and dp with
   *
   *     K du - sum_i w_i dp_i B_i^T = -R + sum_i w_i p_i B_i^T
   *     a_i dp_i + b_i B_i du       = -c_i
   *
   * for constraint rows (w, B), a residual R = internal - external forces
   * and the linearised law (a, b, c) of a request of the core. Knows
   * matrices, no geometry and no method. */
  class RowSolver
  {
  public:
    virtual ~RowSolver() = default;

    /** Set the description of the unknowns. Call before reinit(), and again
     * when the mesh changes. Not collective. */
    virtual void set_near_null_space(const NearNullSpace &space) = 0;

    /** The stiffness of the bodies alone, which determines the rigid motions
     * that supports leave, where that of reinit() and renew() has terms of
     * contact forces that turn, too. Called before these. */
    virtual void set_bodies(const Stiffness & /*bodies*/)
    {
    }

    /** Take a stiffness and the rows that go with it, which must outlive the
     * calls to solve(), and what row_stiffness() gives for both. Columns of
     * rows may be unknowns of other ranks. Collective. */
    virtual void reinit(const Stiffness &stiffness, const PointOperator &rows,
                        const std::vector<double> &row_stiffness) = 0;

    /** The same when only the values of the stiffness are new, and not very
     * different: a preconditioner may be kept as long as it is good.
     * Collective. */
    virtual void renew(const Stiffness &stiffness, const PointOperator &rows,
                       const std::vector<double> &row_stiffness) = 0;

    /** States that its preconditioners were built for, for restore(); empty: it
     * keeps none. Not collective. */
    virtual std::vector<PreconditionerState> state() const
    {
      return {};
    }

    /** Build the preconditioners that a solver with the same matrix and rows
     * had when this was its state(). Call after reinit(). Collective. */
    virtual void restore(const std::vector<PreconditionerState> &)
    {
    }

    /** Requests are those of a contact iteration from now on, whose states
     * change. Not collective. */
    virtual void begin_iteration(const ContactIteration &)
    {
    }

    /** The iteration has ended with the states and pressures of @p request.
     * Returns the rigid motions that they do not determine; throws
     * SolverFailure if loads do work along such a motion. Collective. */
    virtual std::vector<FreeMotion> end_iteration(const abut_request &)
    {
      return {};
    }

    /** The rigid part of a displacement, of each body that the stiffness leaves
     * free to move. Collective. */
    virtual std::vector<BodyMotion> rigid_motions(const la::Vector &) const
    {
      return {};
    }

    /** Solve with relative tolerance request.linear_tolerance for the
     * residual on the free unknowns, but not below
     * @p smallest_residual. Writes dp and dg into the request's arrays.
     * Throws when the iteration fails. Collective. */
    virtual LinearReport solve(const la::Vector &residual,
                               const abut_request &request,
                               double smallest_residual,
                               la::Vector &increment) = 0;
  };
} // namespace abut::solve

#endif
