// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_SOLVER_TYPES_H
#define ABUT_DEALII_CONTACT_SOLVER_TYPES_H

/** @file
 * What goes into a ContactSolver and what comes out.
 */

#include <abut/dealii/contact_assembler.h>

#include <functional>
#include <memory>
#include <string>

namespace abut
{
  /** Functions of the host that ContactSolver needs. The functions are called
   * on all ranks. For `nitsche`, whose bodies must be linear elastic, give the
   * ContactAssembler their traction, see
   * ContactAssembler::set_surface_traction(). */
  struct HostProblem
  {
    /** Internal minus external forces at u, without contact. u has no ghosts
     * and satisfies the constraints, but for prescribed values of a nonlinear
     * problem that are on their way from those of the last load step: take them
     * from u. Rows that the constraints eliminate are zero. The history of the
     * material (plastic strain) must be that of the last load step: u may be a
     * trial. */
    std::function<void(const la::Vector &u, la::Vector &residual)> residual;

    /** Its derivative by u, whose rows and columns that the constraints
     * eliminate are diagonal: a matrix, or a HostOperator. It must stay as it
     * is until the next call. */
    std::function<Tangent(const la::Vector &u)> tangent;

    /** Whether the tangent is the same for all u and until the next reinit():
     * it is requested once for each solve() then, and preconditioners are kept.
     */
    bool linear = false;

    /** Linear problems: whether the residual costs no more than a product with
     * the tangent. It is then requested before each linear system, which leaves
     * the least round-off, and not only once. */
    bool residual_is_cheap = false;

    /** Called after each linear system with its cost; may be empty. */
    std::function<void(const LinearReport &cost)> monitor;
  };

  /** A HostProblem of functions of another type of vector, V: @p residual(u, R)
   * and @p tangent(u), which returns a matrix by reference or a HostOperator.
   * @p like is a vector of the unknowns. */
  template <typename V, typename Residual, typename TangentOf>
  HostProblem host_problem(const V &like, const Residual &residual,
                           const TangentOf &tangent)
  {
    const auto u = std::make_shared<V>(like),
               forces = std::make_shared<V>(like);
    HostProblem problem;
    problem.residual = [=](const la::Vector &at, la::Vector &result)
    {
      la::copy(at, *u);
      *forces = 0.;
      residual(*u, *forces);
      la::copy(*forces, result);
    };
    problem.tangent = [=](const la::Vector &at) -> Tangent
    {
      la::copy(at, *u);
      return tangent(*u);
    };
    return problem;
  }

  /** The next action of ContactSolver. */
  enum class SolvePhase
  {
    detect, /**< find the rows, and a start */
    solve,  /**< linearisations and their contact problems */
    check,  /**< look whether the answer may be used */
    end     /**< return */
  };

  /** A step of Newton's method that was taken. */
  struct NewtonStep
  {
    unsigned int number = 0; ///< of the linearisation, from 1
    double part = 1.;        ///< of the way to the linearisation's solution
    /** Norm of the forces that are not balanced before it, in the linear model
     * with the contact forces of its solution. */
    double before = 0.;
    double residual = 0.; ///< the same after it
    double error = 0.;    ///< as in NewtonResult
  };

  /** Functions of a program that ContactSolver calls at work. All may be empty;
   * all are called on all ranks, and may throw there. */
  struct SolverEvents
  {
    /** A phase begins: for clocks. */
    std::function<void(SolvePhase phase)> phase;

    /** There was a linear system, which moved the displacement; the assembler
     * has had its update(). */
    std::function<void(const LinearReport &cost, const la::Vector &increment)>
        stepped;

    /** A step of a nonlinear problem was taken. */
    std::function<void(const NewtonStep &step)> moved;

    /** Nonlinear problems whose displacement @p u has reached its tolerance:
     * forces out of balance, with this residual, as a multiple of the
     * tolerance. Above 1 Newton's method goes on while it falls; the assembler
     * has followed @p u. Empty: the tolerance alone ends it. */
    std::function<double(const la::Vector &u, const la::Vector &residual)>
        excess;

    /** Look at a converged answer: a text that is not empty is the reason why
     * it must not be used. @p search counts calls of detect() so far, from 1.
     */
    std::function<Message(const la::Vector &u, unsigned int search)> refuse;

    /** So many nodes have penetrated without a row. */
    std::function<void(std::size_t n_nodes)> missed;
  };

  /** Settings of ContactSolver; all are free of units. */
  struct NewtonParameters
  {
    /** Error in the energy norm relative to the displacement, > 0. For linear
     * problems only the tolerances of the method count. */
    double tolerance = 1e-6;
    /** Relative tolerance of linear systems, > 0; 0: chosen for each step. */
    double linear_tolerance = 0.;
    /** Linearisations after which it is given up, > 0. */
    unsigned int max_steps = 50;
    /** Times that a step may be halved. */
    unsigned int max_halvings = 8;
    /** Sweeps of ContactAssembler::relax() after each detect(); 0: none.
     * `barrier` needs at least 1. */
    unsigned int relaxation_sweeps = 0;
    /** Searches on the deformed bodies for nodes without a row; 0: none. */
    unsigned int max_searches = 5;
    /** Depth that counts there, relative to ContactAssembler::length_scale().
     */
    double missed_depth = 1e-3;
    /** Residual at the answer of a linear problem that is too much for it, as a
     * part of the load; 0: not requested. */
    double useless_imbalance = 0.1;
  };

  /** Why ContactSolver stopped. */
  enum class NewtonReason
  {
    converged,    /**< the estimated error is below the tolerance */
    contact,      /**< the contact of a linearisation found no end */
    linear_solve, /**< a linear system could not be solved */
    line_search,  /**< no step lowers the residual */
    step_limit,   /**< max_steps reached */
    missed_nodes, /**< nodes penetrate without a row after all searches */
    refused,      /**< by SolverEvents::refuse */
    not_finite,   /**< the host's residual is not a number */
    unbalanced    /**< the residual of a linear problem is far from 0 in the
                       end: it does not belong to the tangent */
  };

  /** Result of ContactSolver::solve() and its cost. The same on all ranks. */
  struct NewtonResult
  {
    NewtonReason reason = NewtonReason::converged; /**< why it stopped */
    /** The remedy, and the known failure that was found; its code is in front
     * of the text of linear solves alone. */
    Message explanation;
    unsigned int n_steps = 0;     /**< linearisations */
    unsigned int n_systems = 0;   /**< linear systems */
    unsigned int n_residuals = 0; /**< calls of HostProblem::residual */
    unsigned int n_searches = 0;  /**< calls of detect() */
    double residual = 0.; /**< norm of the forces that are not balanced */
    double error = 0.;    /**< estimated, in the energy norm, relative; of a
                               linear problem 0; after a step of no positive
                               energy the forces that are not balanced as a part
                               of the forces */
    /** Steps d with d . K d not positive: the tangent was indefinite there.
     * Where the last one is, an equilibrium that was found may be unstable, and
     * explanation reports it. */
    unsigned int n_negative_steps = 0;
    LinearReport linear; /**< cost of the linear systems */

    /** Whether there is an answer. */
    bool converged() const
    {
      return reason == NewtonReason::converged;
    }
  };
} // namespace abut

#endif
