// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_SOLVER_H
#define ABUT_DEALII_CONTACT_SOLVER_H

/** @file
 * The nonlinear iteration for programs that want it: Newton's method for the
 * material with contact in each of its linearisations.
 *
 *     abut::HostProblem problem;
 *     problem.residual = [&](const la::Vector &u, la::Vector &R) { ... };
 *     problem.tangent = [&](const la::Vector &u) -> const la::Matrix & { ... };
 *     abut::ContactSolver<dim> solver(contact, constraints, problem);
 *     const abut::NewtonResult result = solver.solve(u);
 *
 * Each step linearises the host's forces once and solves the contact problem
 * of that linearisation, with its active sets, by products with the one
 * matrix; then the step is shortened until the residual falls. Assembling is
 * thus done once for each linearisation and not for each active set.
 *
 * Linear systems are solved only as accurately as the linearisation deserves,
 *     eta = min(1e-2, |r after the last step| / (10 |r before it|)),
 * (Eisenstat & Walker, SIAM J. Sci. Comput. 17, 1996), and the iteration ends
 * by the energy norm of its error: after a full step d the error is about
 *     |d|_K |r after| / |r before|,    |d|_K^2 = d . K d,
 * and has to be less than the tolerance times |u|_K, which means the same on
 * any mesh.
 *
 * Everything is in this header, so that programs that load Abut at run time
 * can use it as well as those that link it.
 */

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/contact_loop.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <utility>

namespace abut
{
  /** What ContactSolver needs from the host. The functions are called on all
   * ranks. For `nitsche`, whose bodies must be linear elastic, give the
   * ContactAssembler the stress, see ContactAssembler::set_normal_stress(). */
  struct HostProblem
  {
    /** Internal minus external forces at u, without contact. u satisfies the
     * constraints and has no ghosts; rows that the constraints eliminate are
     * zero. What the material has to remember (plastic strain) must be that of
     * the last load step: u may be a trial. */
    std::function<void(const la::Vector &u, la::Vector &residual)> residual;

    /** Its derivative by u, whose rows and columns that the constraints
     * eliminate are diagonal. The matrix must stay as it is until the next
     * call. */
    std::function<const la::Matrix &(const la::Vector &u)> tangent;

    /** Whether the tangent is the same for all u and until the next reinit():
     * it is asked for once for each solve() then, and preconditioners are
     * kept. */
    bool linear = false;

    /** Of a linear problem: whether the residual costs no more than a product
     * with the tangent. It is then asked for before each linear system, which
     * leaves the least round-off, and not only once. */
    bool residual_is_cheap = false;

    /** Called after each linear system with its cost; may be empty. */
    std::function<void(const LinearReport &cost)> monitor;
  };

  /** What ContactSolver is about to do. */
  enum class SolvePhase
  {
    detect, /**< find the rows, and a start */
    solve,  /**< linearisations and their contact problems */
    check,  /**< look whether the answer may be used */
    end     /**< return */
  };

  /** What a program may see of ContactSolver at work, and have a say in. All
   * may be empty; all are called on all ranks, and may throw there. */
  struct SolverEvents
  {
    /** A phase begins: for clocks. */
    std::function<void(SolvePhase phase)> phase;

    /** There was a linear system, which moved the displacement; the assembler
     * has had its update(). */
    std::function<void(const LinearReport &cost, const la::Vector &increment)>
        stepped;

    /** Look at a converged answer: a text that is not empty says why it must
     * not be used. @p search counts calls of detect() so far, from 1. */
    std::function<std::string(const la::Vector &u, unsigned int search)> refuse;

    /** So many nodes have penetrated without a row. */
    std::function<void(std::size_t n_nodes)> missed;
  };

  /** Settings of ContactSolver; all are free of units. */
  struct NewtonParameters
  {
    /** Error in the energy norm relative to the displacement, > 0. Of linear
     * problems the tolerances of the method decide alone. */
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
    /** Depth that counts there, relative to
     * ContactAssembler::length_scale() or, if that is 0, the largest
     * displacement. */
    double missed_depth = 1e-3;
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
    not_finite    /**< the host's residual is not a number */
  };

  /** What ContactSolver::solve() found and what it cost. The same on all
   * ranks. */
  struct NewtonResult
  {
    NewtonReason reason = NewtonReason::converged; /**< why it stopped */
    std::string explanation;      /**< in words, with what to try */
    unsigned int n_steps = 0;     /**< linearisations */
    unsigned int n_systems = 0;   /**< linear systems */
    unsigned int n_residuals = 0; /**< calls of HostProblem::residual */
    unsigned int n_searches = 0;  /**< calls of detect() */
    double residual = 0.; /**< norm of the forces that are not balanced */
    double error = 0.;    /**< estimated, in the energy norm, relative; of a
                               linear problem 0 */
    LinearReport linear;  /**< cost of the linear systems */

    /** Whether there is an answer. */
    bool converged() const
    {
      return reason == NewtonReason::converged;
    }
  };

  /** See the head of this file. Keeps references to the assembler and the
   * constraints and a copy of the rest; cheap to make. */
  template <int dim> class ContactSolver
  {
  public:
    /** @p contact with its parameters and pairs set and reinit() called with
     * @p constraints. Makes it assume a constant matrix. Not collective. */
    ContactSolver(ContactAssembler<dim> &contact,
                  const dealii::AffineConstraints<double> &constraints,
                  HostProblem problem,
                  const NewtonParameters &parameters = NewtonParameters(),
                  SolverEvents events = SolverEvents())
        : contact_(contact),
          constraints_(constraints),
          problem_(std::move(problem)),
          parameters_(parameters),
          events_(std::move(events))
    {
      contact_.assume_constant_matrix(true);
    }

    /** Solve from the displacement @p u and from the pressures of the last
     * solve or of ContactAssembler::set_pressure(). Puts the prescribed values
     * into @p u first. Where it does not converge, @p u is the last iterate
     * and the result says why; exceptions are those of detect() and of the
     * host's functions. Collective. */
    NewtonResult solve(la::Vector &u)
    {
      result_ = NewtonResult();
      constraints_.distribute(u);
      allocate(u);
      try
      {
        do
        {
          enter(SolvePhase::detect);
          contact_.detect(u);
          ++result_.n_searches;
          relax(u);
          enter(SolvePhase::solve);
          const bool has_answer = iterate(u);
          enter(SolvePhase::check);
          if (!has_answer || is_refused(u))
            break;
        } while (misses_nodes(u));
      }
      catch (const SolverFailure &failure)
      {
        stop(NewtonReason::linear_solve, failure.what());
      }
      enter(SolvePhase::end);
      return result_;
    }

  private:
    void allocate(const la::Vector &u)
    {
      for (la::Vector *vector :
           {&residual_, &increment_, &step_, &product_, &forces_, &trial_})
        vector->reinit(u, true);
    }

    void enter(const SolvePhase phase) const
    {
      if (events_.phase)
        events_.phase(phase);
    }

    bool stop(const NewtonReason reason, const std::string &explanation)
    {
      result_.reason = reason;
      result_.explanation = explanation;
      return false;
    }

    void set_linear_tolerance(const double chosen)
    {
      linear_tolerance_ = parameters_.linear_tolerance > 0.
                              ? parameters_.linear_tolerance
                              : chosen;
    }

    void find_residual(const la::Vector &u)
    {
      residual_ = 0.;
      problem_.residual(u, residual_);
      ++result_.n_residuals;
    }

    void relax(la::Vector &u)
    {
      if (parameters_.relaxation_sweeps == 0)
        return;
      find_residual(u);
      contact_.relax(problem_.tangent(u), residual_,
                     parameters_.relaxation_sweeps, u);
      constraints_.distribute(u);
    }

    /** false: stopped without an answer. */
    bool iterate(la::Vector &u)
    {
      return problem_.linear ? solve_linear(u) : solve_nonlinear(u);
    }

    /** A linear problem is its own linearisation. */
    bool solve_linear(la::Vector &u)
    {
      const la::Matrix &tangent = problem_.tangent(u);
      ++result_.n_steps;
      if (!problem_.residual_is_cheap)
        find_residual(u);
      return solve_linearised(tangent, u);
    }

    /** Newton's method. */
    bool solve_nonlinear(la::Vector &u)
    {
      find_residual(u);
      set_linear_tolerance(1e-2);
      for (unsigned int step = 0; step < parameters_.max_steps; ++step)
      {
        const la::Matrix &tangent = problem_.tangent(u);
        ++result_.n_steps;
        contact_.linearise(u, linear_tolerance_);
        trial_ = u;
        if (!solve_linearised(tangent, trial_) || !move(tangent, u))
          return false;
        if (result_.error <= parameters_.tolerance)
          return true;
      }
      return stop(NewtonReason::step_limit,
                  "Newton's method has not converged after "
                      + std::to_string(parameters_.max_steps)
                      + " linearisations, the estimated relative error is "
                      + short_number(result_.error)
                      + ". Use smaller load steps, or check that the tangent "
                        "is the derivative of the residual.");
    }

    /** Forces of the linearisation whose residual_ is that at step_. */
    void linear_residual(const la::Matrix &tangent, const la::Vector &u,
                         la::Vector &forces)
    {
      product_ = u;
      product_ -= step_;
      tangent.vmult(forces, product_);
      forces += residual_;
      constraints_.set_zero(forces);
    }

    void note(const LinearReport &cost, const la::Vector &increment)
    {
      result_.n_systems += cost.n_systems;
      result_.linear += cost;
      if (problem_.monitor)
        problem_.monitor(cost);
      if (events_.stepped)
        events_.stepped(cost, increment);
    }

    /** The contact problem of the linearisation at @p u, which becomes its
     * solution. */
    bool solve_linearised(const la::Matrix &tangent, la::Vector &u)
    {
      step_ = u;
      bool is_first = true;
      iterate_contact<dim>(
          contact_, tangent, u,
          [&](const la::Vector &present, la::Vector &forces)
          {
            if (problem_.linear && problem_.residual_is_cheap)
            {
              find_residual(present);
              forces = residual_;
            }
            else if (std::exchange(is_first, false))
              forces = residual_;
            else
              linear_residual(tangent, present, forces);
          },
          [&](const LinearReport &cost, const la::Vector &increment)
          { note(cost, increment); });
      constraints_.distribute(u);
      if (contact_.reason() != ABUT_REASON_CONVERGED)
        return stop(NewtonReason::contact,
                    "The contact iteration ended without an answer after "
                        + std::to_string(contact_.progress().step)
                        + " steps: " + contact_.explanation());
      return true;
    }

    bool is_refused(const la::Vector &u)
    {
      if (!events_.refuse)
        return false;
      const std::string why = events_.refuse(u, result_.n_searches);
      return !why.empty() && !stop(NewtonReason::refused, why);
    }

    /** Norm of the forces at the free unknowns that neither the body nor
     * contact balances. */
    double imbalance()
    {
      product_ = residual_;
      product_ -= forces_;
      return product_.l2_norm();
    }

    /** Norm by the energy of the free unknowns. */
    double energy_norm(const la::Matrix &tangent, const la::Vector &u)
    {
      increment_ = u;
      constraints_.set_zero(increment_);
      tangent.vmult(product_, increment_);
      return std::sqrt(std::max(0., product_ * increment_));
    }

    /** Go from @p u towards trial_ as far as the residual falls, estimate the
     * error there, and set the next linear tolerance. */
    bool move(const la::Matrix &tangent, la::Vector &u)
    {
      forces_ = 0.;
      contact_.add_contact_forces(forces_);
      constraints_.set_zero(forces_);
      step_ = trial_;
      step_ -= u;
      const double before = imbalance();
      const double length = energy_norm(tangent, step_);
      const double scale =
          std::max(energy_norm(tangent, trial_), energy_norm(tangent, u));
      const double limit = parameters_.tolerance * scale;

      double part = 1.;
      for (unsigned int halving = 0;; ++halving)
      {
        find_residual(trial_);
        result_.residual = imbalance();
        if (result_.residual <= (1. - 1e-3 * part) * before || length <= limit)
          break;
        if (halving == parameters_.max_halvings)
          return give_up(before);
        part /= 2.;
        trial_ = u;
        trial_.add(part, step_);
      }
      u = trial_;
      const double ratio =
          before > 0. ? std::min(1., result_.residual / before) : 0.;
      const double error = (1. - part) * length + part * length * ratio;
      result_.error = scale > 0. ? error / scale : 0.;
      // No more than the end of the iteration needs.
      const double enough = error > 0. ? 0.1 * limit / error : 1.;
      set_linear_tolerance(std::min(1e-2, std::max(0.1 * ratio, enough)));
      return true;
    }

    bool give_up(const double before)
    {
      if (!std::isfinite(result_.residual))
        return stop(NewtonReason::not_finite,
                    "The residual is not a number, even after "
                        + std::to_string(parameters_.max_halvings)
                        + " halvings of the step. Use smaller load steps.");
      return stop(NewtonReason::line_search,
                  "No step lowers the residual, " + short_number(before)
                      + " before and " + short_number(result_.residual)
                      + " after the shortest one tried. Check that the tangent "
                        "is the derivative of the residual, and use smaller "
                        "load steps.");
    }

    /** Whether to search again on the deformed bodies. */
    bool misses_nodes(const la::Vector &u)
    {
      if (parameters_.max_searches == 0)
        return false;
      const double length = contact_.length_scale() > 0.
                                ? contact_.length_scale()
                                : u.linfty_norm();
      if (length == 0.)
        return false;
      const std::size_t n_missed =
          contact_.check_penetration(u, parameters_.missed_depth * length)
              .size();
      if (n_missed == 0)
        return false;
      if (events_.missed)
        events_.missed(n_missed);
      if (result_.n_searches < parameters_.max_searches)
        return true;
      return stop(NewtonReason::missed_nodes,
                  "Nodes keep on penetrating without a constraint after "
                      + std::to_string(result_.n_searches)
                      + " searches: use smaller load steps, or a larger reach "
                        "of the pair.");
    }

    static std::string short_number(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.3g", value);
      return text;
    }

    ContactAssembler<dim> &contact_;
    const dealii::AffineConstraints<double> &constraints_;
    const HostProblem problem_;
    const NewtonParameters parameters_;
    const SolverEvents events_;
    NewtonResult result_;
    la::Vector residual_, increment_, step_, product_, forces_, trial_;
    double linear_tolerance_ = 1e-2;
  };
} // namespace abut

#endif
