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
 * and has to be less than the tolerance times the largest |u|_K on the way,
 * which means the same on any mesh, and where u comes back to 0. Where d . K d
 * is not positive, as in a material that softens or in a snap through, energies
 * are no measure: there forces out of balance have to be less than the
 * tolerance times the forces. A program may require more of the balance of
 * forces (SolverEvents::excess): forces of contact may be small compared with
 * those that have set the energy.
 *
 * Prescribed values that have changed since the last solve are not put into u
 * at once, which would fold the first layer of cells: they are a part of the
 * first linearised increment, K du = -R with du = the change there.
 *
 * Everything is in this header: programs that load Abut can use it, too.
 */

#include <abut/dealii/contact_assembler.h>
#include <abut/dealii/contact_loop.h>
#include <abut/dealii/contact_solver_types.h>
#include <abut/dealii/partner_words.h>
#include <abut/dealii/solver_words.h>
#include <abut/dealii/step_scales.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace abut
{
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
     * solve or of ContactState::set_pressure(). Prescribed values come into
     * @p u at once if the problem is linear, else with the first increment.
     * Where it does not converge, @p u is the last iterate and the result has
     * the cause; exceptions are those of detect() and of the host's functions.
     * Collective. */
    NewtonResult solve(la::Vector &u)
    {
      result_ = NewtonResult();
      largest_ = 0.;
      // Points that move are linear in nothing.
      linear_ = problem_.linear && !contact_.points_move();
      allocate(u);
      if (linear_)
        constraints_.distribute(u);
      const la::Vector start(u);
      bool is_searched = false;
      do
      {
        try
        {
          search_and_iterate(u, is_searched);
          break;
        }
        catch (const SolverFailure &failure)
        {
          stop(NewtonReason::linear_solve, failure.message());
          is_searched = moves_farther(failure.message().failure, start, u);
        }
      } while (is_searched);
      enter(SolvePhase::end);
      return result_;
    }

    /** The same for a displacement of any other type. */
    template <typename V,
              typename = std::enable_if_t<la::internal::is_host_vector<V>>>
    NewtonResult solve(V &u)
    {
      la::Vector own = contact_.copy_of(la::VectorView(u));
      const NewtonResult result = solve(own);
      la::copy(own, u);
      return result;
    }

  private:
    void search_and_iterate(la::Vector &u, bool is_searched)
    {
      do
      {
        enter(SolvePhase::detect);
        if (!std::exchange(is_searched, false))
          contact_.detect(goal(u));
        ++result_.n_searches;
        relax(u);
        enter(SolvePhase::solve);
        const bool has_answer = iterate_with_gaps(u);
        enter(SolvePhase::check);
        if (!has_answer || is_refused(u))
          break;
      } while (misses_nodes(u));
    }

    /** iterate() until no row presses where surfaces are apart. */
    bool iterate_with_gaps(la::Vector &u)
    {
      bool has_answer = iterate(u);
      while (has_answer && contact_.raise_gaps(goal(u)))
        try
        {
          has_answer = iterate(u) || (contact_.limit_raises(u) && resume(u));
        }
        catch (const SolverFailure &)
        {
          if (!contact_.limit_raises(u))
            throw;
          has_answer = resume(u);
        }
      return has_answer;
    }

    bool resume(la::Vector &u)
    {
      result_.reason = NewtonReason::converged;
      return iterate(u);
    }

    /** Whether bodies without supports that nothing stops may meet others
     * farther away: then there is a search already, and @p u the start. */
    bool moves_farther(const abut_failure why, const la::Vector &start,
                       la::Vector &u)
    {
      if (why != ABUT_FAILURE_FLOATING_BODY && why != ABUT_FAILURE_FREE_SLIDING)
        return false;
      enter(SolvePhase::detect);
      if (!contact_.search_farther(goal(start)))
        return false;
      u = start;
      result_.reason = NewtonReason::converged;
      result_.explanation = Message();
      return true;
    }

    /** A linear problem has u in it from the start, and needs no more than
     * its forces. */
    void allocate(const la::Vector &u)
    {
      residual_.reinit(u, true);
      if (linear_)
        return;
      for (la::Vector *vector : {&increment_, &step_, &product_, &forces_,
                                 &trial_, &goal_, &change_})
        vector->reinit(u, true);
    }

    /** @p u with the prescribed values of now: contact needs no more of it, as
     * the free unknowns are the same. */
    const la::Vector &goal(const la::Vector &u)
    {
      if (linear_)
        return u;
      goal_ = u;
      constraints_.distribute(goal_);
      return goal_;
    }

    void enter(const SolvePhase phase) const
    {
      if (events_.phase)
        events_.phase(phase);
    }

    bool stop(const NewtonReason reason, const Message &explanation)
    {
      result_.reason = reason;
      result_.explanation = explanation;
      return false;
    }

    /** Programs that load Abut have no table of codes: the text is without. */
    bool stop(const NewtonReason reason, const std::string &text,
              const abut_failure failure)
    {
      Message explanation(text);
      explanation.failure = failure;
      return stop(reason, explanation);
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
      if (linear_)
      {
        contact_.relax(problem_.tangent(u), residual_,
                       parameters_.relaxation_sweeps, u);
        constraints_.distribute(u);
        return;
      }
      add_prescribed_change(u);
      trial_ = goal_;
      contact_.relax(problem_.tangent(u), residual_,
                     parameters_.relaxation_sweeps, trial_);
      constraints_.distribute(trial_);
      trial_ -= goal_;
      u += trial_;
    }

    /** Make residual_, which is that at @p u, the one of the linear model in
     * which only the prescribed values have moved, to goal_. The tangent has no
     * columns of theirs: they are a difference quotient of the host's residual,
     * over a distance that is small for any material. */
    void add_prescribed_change(const la::Vector &u)
    {
      constexpr double way = 1e-6, round_off = 1e-14;
      change_ = 0.;
      step_ = goal(u);
      step_ -= u;
      const double length = step_.linfty_norm();
      const double largest = std::max(goal_.linfty_norm(), u.linfty_norm());
      has_change_ = length > round_off * largest;
      if (!has_change_)
        return;
      const double part = std::min(1., way * largest / length);
      trial_ = u;
      trial_.add(part, step_);
      product_ = residual_;
      find_residual(trial_);
      change_ = residual_;
      change_ -= product_;
      change_ *= 1. / part;
      residual_ = product_;
      residual_ += change_;
    }

    /** false: stopped without an answer. */
    bool iterate(la::Vector &u)
    {
      return linear_ ? solve_linear(u) : solve_nonlinear(u);
    }

    /** A linear problem is its own linearisation. */
    bool solve_linear(la::Vector &u)
    {
      const Tangent tangent = contact_.copy_of(problem_.tangent(u));
      ++result_.n_steps;
      if (!problem_.residual_is_cheap)
        find_residual(u);
      return solve_linearised(tangent, u) && is_balanced(u);
    }

    /** Whether the host's forces at the end of a linear problem agree with its
     * matrix. */
    bool is_balanced(const la::Vector &u)
    {
      if (parameters_.useless_imbalance == 0.)
        return true;
      find_residual(u);
      const double part = contact_.checks().imbalance(residual_);
      if (part <= parameters_.useless_imbalance)
        return true;
      return stop(NewtonReason::unbalanced,
                  "The residual at the answer is " + three_digits(part)
                      + " of the load: the tangent is not its derivative. "
                        "Check the sign of the residual (internal minus "
                        "external forces), that the problem is linear, and "
                        "that no large penalty causes round-off.",
                  ABUT_FAILURE_UNBALANCED);
    }

    /** Newton's method. */
    bool solve_nonlinear(la::Vector &u)
    {
      result_.explanation = Message();
      find_residual(u);
      set_linear_tolerance(1e-2);
      last_excess_ = std::numeric_limits<double>::infinity();
      watch_ = Watch();
      watch_.may_begin = contact_.points_move();
      for (unsigned int step = 0; step < parameters_.max_steps; ++step)
      {
        const Tangent tangent = contact_.copy_of(problem_.tangent(u));
        ++result_.n_steps;
        add_prescribed_change(u);
        if (!std::isfinite(residual_.l2_norm()))
          return stop_not_finite();
        if (!take_step(tangent, u))
        {
          if (!go_back(u))
            return false;
          continue;
        }
        if (result_.error > parameters_.tolerance)
        {
          if (watch_.left == 1)
            go_back(u);
          else if (watch_.left > 1)
            --watch_.left;
          continue;
        }
        contact_.follow(goal(u));
        if (is_settled(u) || step + 1 == parameters_.max_steps)
          return true;
      }
      return stop_astray(
          NewtonReason::step_limit,
          "Newton's method has not converged after "
              + std::to_string(parameters_.max_steps)
              + " linearisations, the estimated relative error is "
              + three_digits(result_.error)
              + ". Use smaller load steps, or check that the tangent "
                "is the derivative of the residual.",
          u);
    }

    /** Linearise at @p u and go towards the solution of that; false: there is
     * no such solution, or no way. */
    bool take_step(const Tangent &tangent, la::Vector &u)
    {
      try
      {
        contact_.linearise(goal_, linear_tolerance_);
        trial_ = u;
        return solve_linearised(tangent, trial_) && move(tangent, u);
      }
      catch (const SolverFailure &)
      {
        if (watch_.left == 0)
          throw;
        return false;
      }
    }

    /** Whether forces are in balance at @p u, where the displacement has come
     * to its tolerance, or another step does not help. Energies may be set by
     * other forces than those of contact. */
    bool is_settled(const la::Vector &u)
    {
      if (!events_.excess)
        return true;
      const double before =
          std::exchange(last_excess_, events_.excess(u, residual_));
      if (last_excess_ <= 1. || !(last_excess_ < 0.5 * before))
        return true;
      set_linear_tolerance(std::min(linear_tolerance_, 0.1 / last_excess_));
      return false;
    }

    /** Forces of the linearisation whose residual_ is that at step_. */
    void linear_residual(const Tangent &tangent, const la::Vector &u,
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
    bool solve_linearised(const Tangent &tangent, la::Vector &u)
    {
      const bool is_direct = linear_ && problem_.residual_is_cheap;
      if (!is_direct)
        step_ = u;
      bool is_first = true;
      iterate_contact<dim>(
          contact_, tangent, u,
          [&](const la::Vector &present, la::Vector &forces)
          {
            if (is_direct)
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
      const IterationReport report = contact_.iteration();
      if (report.reason != ABUT_REASON_CONVERGED)
        return stop(NewtonReason::contact,
                    "The contact iteration ended without an answer after "
                        + std::to_string(report.progress.step)
                        + " steps: " + report.explanation,
                    report.failure);
      return true;
    }

    bool is_refused(const la::Vector &u)
    {
      if (!events_.refuse)
        return false;
      const Message why = events_.refuse(u, result_.n_searches);
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

    /** A displacement of the free unknowns and the forces K v of it. */
    struct Energy
    {
      double norm = 0.;  ///< root of |v . K v|
      double force = 0.; ///< |K v|
      /** Whether v . K v is more than what cancels: of a positive definite
       * matrix of condition k the cosine of v and K v is at least 2 / sqrt(k).
       */
      bool is_positive = true;
    };

    Energy energy(const Tangent &tangent, const la::Vector &u)
    {
      constexpr double least_cosine = 1e-7;
      increment_ = u;
      constraints_.set_zero(increment_);
      tangent.vmult(product_, increment_);
      const double product = product_ * increment_;
      Energy result;
      result.norm = std::sqrt(std::abs(product));
      result.force = product_.l2_norm();
      result.is_positive =
          product >= least_cosine * result.force * increment_.l2_norm();
      return result;
    }

    StepScales measure(const Tangent &tangent, const la::Vector &u)
    {
      StepScales scales;
      scales.before = {imbalance(), defect_};
      scales.has_change = has_change_;
      if (has_change_)
      {
        product_ -= change_;
        scales.squares[0] = product_ * product_;
        scales.squares[1] = product_ * change_;
        scales.squares[2] = change_ * change_;
      }
      const Energy step = energy(tangent, step_), end = energy(tangent, trial_),
                   start = energy(tangent, u);
      scales.length = step.norm;
      scales.energy = largest_ = std::max({end.norm, start.norm, largest_});
      scales.force = std::max(
          {scales.before.residual, forces_.l2_norm(), end.force, start.force});
      scales.is_positive = step.is_positive;
      find_round_off(tangent, scales);
      return scales;
    }

    /** Bodies that small forces move far, as across a clearance, have hardly
     * more energy than round-off. */
    void find_round_off(const Tangent &tangent, StepScales &scales)
    {
      constexpr double round_off = 1e-14;
      const ForceSize size = contact_.checks().size_of_forces(tangent, trial_);
      scales.round_off = {round_off * size.norm, round_off * size.energy};
    }

    /** The forces of contact at @p u and how far pressures and gaps are from
     * the law there. Points that do not move have the same forces everywhere,
     * and no defect once their problem is solved: computed @p at_start alone.
     */
    void find_contact(const la::Vector &u, const bool at_start)
    {
      if (contact_.points_move())
        defect_ = contact_.evaluate(goal(u), forces_);
      else if (at_start)
      {
        forces_ = 0.;
        contact_.results().add_forces(forces_);
      }
      else
        return;
      constraints_.set_zero(forces_);
    }

    /** Go from @p u towards trial_ as far as the residual falls, estimate the
     * error there, and set the next linear tolerance. */
    bool move(const Tangent &tangent, la::Vector &u)
    {
      find_contact(u, true);
      step_ = trial_;
      step_ -= u;
      const StepScales scales = measure(tangent, u);
      result_.n_negative_steps += !scales.is_positive;

      double part = 1.;
      for (unsigned int halving = 0;; ++halving)
      {
        evaluate_trial();
        if (is_lower(scales, part)
            || scales.is_at_end(rest(), parameters_.tolerance))
          break;
        part = halving < parameters_.max_halvings ? part / 2. : 0.;
        if (part == 0.)
          break;
        trial_ = u;
        trial_.add(part, step_);
      }
      if (takes_whole_step(scales, part, u))
        part = 1.;
      else if (part == 0.)
        return give_up(scales, u);
      u = trial_;
      estimate(scales, part);
      if (events_.moved)
        events_.moved({result_.n_steps, part, scales.before.residual,
                       result_.residual, result_.error});
      return true;
    }

    /** Steps that are taken as a whole although they do not lower the residual:
     * along constraints that turn, each step leaves them by its square, and
     * the next one comes back (the watchdog of Chamberlain et al., Math.
     * Program. Study 16, 1982). */
    struct Watch
    {
      bool may_begin = false;
      unsigned int left = 0; ///< such steps that may follow; 0: no watch
      double goal = 0.;      ///< what the residual has to be less than
      la::Vector start;      ///< where to go back to
    };

    /** Take the whole step where a @p part is too small, if it may lead to a
     * lower residual later. */
    bool takes_whole_step(const StepScales &scales, const double part,
                          const la::Vector &u)
    {
      constexpr double small_part = 0.25;
      constexpr unsigned int most_steps = 5;
      if (part > 0. && watch_.left > 0
          && (scales.is_at_end(rest(), parameters_.tolerance)
              || scales.sum(rest()) < watch_.goal))
      {
        watch_.left = 0;
        watch_.may_begin = true;
      }
      if (part > small_part || (watch_.left == 0 && !watch_.may_begin))
        return false;
      trial_ = u;
      trial_ += step_;
      evaluate_trial();
      if (!std::isfinite(result_.residual))
      {
        trial_ = u;
        trial_.add(part, step_);
        evaluate_trial();
        return false;
      }
      if (std::exchange(watch_.may_begin, false))
      {
        watch_.left = most_steps;
        watch_.start = u;
        watch_.goal = scales.sum(scales.before);
      }
      return true;
    }

    /** End a watch that has not led anywhere. Returns whether there was one. */
    bool go_back(la::Vector &u)
    {
      if (watch_.left == 0)
        return false;
      watch_.left = 0;
      result_.reason = NewtonReason::converged;
      result_.explanation = Message();
      u = watch_.start;
      find_residual(u);
      return true;
    }

    /** Forces and defect at the last trial. */
    StepRest rest() const
    {
      return {result_.residual, defect_};
    }

    void evaluate_trial()
    {
      find_residual(trial_);
      find_contact(trial_, false);
      result_.residual = imbalance();
    }

    /** Whether this part of a step lowers forces out of balance and the error
     * of the law enough. */
    bool is_lower(const StepScales &scales, const double part) const
    {
      return scales.sum(rest())
             <= (1. - 1e-3 * part) * scales.sum(scales.to_lower(part));
    }

    /** The error after this part of a step, and the linear tolerance that the
     * next one deserves. */
    void estimate(const StepScales &scales, const double part)
    {
      const double ratio =
          scales.before.residual > 0.
              ? std::min(1., result_.residual / scales.before.residual)
              : 0.;
      if (scales.is_positive)
      {
        const double error =
            (1. - part) * scales.length + part * scales.length * ratio;
        result_.error = scales.energy > 0. ? error / scales.energy : 0.;
      }
      else
      {
        result_.error = 1. - part + result_.residual / scales.force;
        if (result_.error <= parameters_.tolerance)
          result_.explanation =
              "Forces are in balance, but the tangent is not positive along "
              "the last increment: the equilibrium may be unstable.";
      }
      if (scales.energy > 0.)
        result_.error = std::max(result_.error, defect_ / scales.energy);
      if (part == 1. && scales.is_round_off(rest()))
        result_.error = std::min(result_.error, parameters_.tolerance);
      if (has_change_ && part < 1.) // prescribed values are not there yet
        result_.error = std::max(result_.error, 1. - part);
      // No more than the end of the iteration needs.
      const double enough =
          result_.error > 0. ? 0.1 * parameters_.tolerance / result_.error : 1.;
      set_linear_tolerance(std::min(1e-2, std::max(0.1 * ratio, enough)));
    }

    bool stop_not_finite()
    {
      return stop(NewtonReason::not_finite,
                  "The residual is not finite, even after "
                      + std::to_string(parameters_.max_halvings)
                      + " halvings of the step. Use smaller load steps.",
                  ABUT_FAILURE_NOT_FINITE);
    }

    bool give_up(const StepScales &scales, const la::Vector &u)
    {
      if (!std::isfinite(result_.residual))
        return stop_not_finite();
      return stop_astray(NewtonReason::line_search,
                         line_search_in_words(scales, rest()), u);
    }

    /** Stop without an answer, with what may be behind it. */
    bool stop_astray(const NewtonReason reason, const std::string &seen,
                     const la::Vector &u)
    {
      const std::string jumps = in_words(contact_.checks().partner_changes());
      return stop(reason,
                  seen
                      + negative_steps_in_words(result_.n_negative_steps,
                                                result_.n_steps)
                      + sliding_in_words(contact_.checks().step_motion(goal(u)))
                      + jumps,
                  jumps.empty() ? ABUT_FAILURE_NEWTON : ABUT_FAILURE_PARTNERS);
    }

    /** Whether to search again on the deformed bodies. */
    bool misses_nodes(const la::Vector &u)
    {
      if (parameters_.max_searches == 0)
        return false;
      const double length = contact_.length_scale(u);
      if (length == 0.)
        return false;
      const std::vector<Penetration<dim>> missed =
          contact_.checks().penetrations(u, parameters_.missed_depth * length);
      if (missed.empty())
        return false;
      if (events_.missed)
        events_.missed(missed.size());
      if (result_.n_searches < parameters_.max_searches)
        return true;
      return stop(NewtonReason::missed_nodes,
                  missed_in_words(missed, result_.n_searches));
    }

    ContactAssembler<dim> &contact_;
    const dealii::AffineConstraints<double> &constraints_;
    const HostProblem problem_;
    const NewtonParameters parameters_;
    const SolverEvents events_;
    NewtonResult result_;
    bool linear_ = false; ///< the problem is its own linearisation
    double largest_ = 0.; ///< energy norm of displacements since the start
    Watch watch_;
    la::Vector residual_, increment_, step_, product_, forces_, trial_;
    la::Vector goal_;    ///< current displacement with prescribed values
    la::Vector change_;  ///< of the residual by prescribed values, linearised
    double defect_ = 0.; ///< of the law at the last trial, where points move
    bool has_change_ = false; ///< whether they differ from the present ones
    double linear_tolerance_ = 1e-2;
    double last_excess_ = 0.; ///< of forces out of balance, when last computed
  };
} // namespace abut

#endif
