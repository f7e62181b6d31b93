/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_DEALII_SOLVER_PARAMETERS_H
#define ABUT_DEALII_SOLVER_PARAMETERS_H

#include <abut/dealii/coded.h>

#include <deal.II/base/parameter_handler.h>

#include <algorithm>
#include <stdexcept>
#include <string>

namespace abut
{
  /** How linear systems are solved: section `Solver` of a parameter file. */
  struct SolverParameters
  {
    /** Kind of linear solver. */
    enum class Linear
    {
      automatic, /**< direct for small systems, else iterative */
      iterative, /**< CG (or FGMRES for saddle points) with ML */
      direct,    /**< Amesos: MUMPS if built in, KLU for small systems */
      geometric  /**< CG with multigrid over the meshes that the mesh was
                      refined from; iterative where there are none */
    };

    Linear linear = Linear::automatic; /**< which one */
    /** Iterations after which an iterative solve is given up. */
    unsigned int max_iterations = 1000;
    /** Unknowns up to which `auto` takes the direct solver; 0: 500 for scalar
     * fields, 20000 in the plane, 3000 in space. */
    unsigned int direct_limit = 0;
    /** ML: connections weaker than this are dropped in coarsening. */
    double aggregation_threshold = 1e-3;
    /** ML: degree of the Chebyshev smoother. */
    unsigned int smoother_sweeps = 2;
    /** Saddle point: augmentation of the leading block as a multiple of the
     * local stiffness. */
    double augmentation = 3.;
    /** Whether contact springs that are beyond multigrid are filtered: solved
     * directly on the unknowns that they act on. */
    bool contact_filter = true;

    /** Whether a system of @p n_unknowns of a field with @p n_components is to
     * be factorised. */
    bool is_direct(unsigned long long n_unknowns,
                   unsigned int n_components) const;

    /** Declare the parameters of section `Solver`. */
    static void declare_parameters(dealii::ParameterHandler &prm);

    /** Read them. */
    void parse_parameters(dealii::ParameterHandler &prm);
  };

  /** A linear system could not be solved: the message has the cause and the
   * remedy. Thrown on all ranks. */
  class SolverFailure : public MessageError
  {
  public:
    using MessageError::MessageError;
  };

  /** Cost of linear solves. */
  struct LinearReport
  {
    unsigned int n_systems = 0;    /**< matrices with one right-hand side, or
                                        two (interior point) */
    unsigned int n_iterations = 0; /**< of the Krylov method */
    unsigned int n_matvecs = 0;    /**< products with the matrix */
    unsigned int n_setups = 0;     /**< preconditioners or factorisations */
    /** Largest condition number of a preconditioned matrix that conjugate
     * gradients have met, by Lanczos' estimate from below; 0: none. */
    double condition = 0.;
    double setup_seconds = 0.; /**< time for these */
    double solve_seconds = 0.; /**< time for the rest */
    double tolerance = 0.;     /**< relative, of the last system */
    std::string method;        /**< of the last system, in words */

    /** Add the cost of another solve. */
    LinearReport &operator+=(const LinearReport &other)
    {
      n_systems += other.n_systems;
      n_iterations += other.n_iterations;
      n_matvecs += other.n_matvecs;
      n_setups += other.n_setups;
      condition = std::max(condition, other.condition);
      setup_seconds += other.setup_seconds;
      solve_seconds += other.solve_seconds;
      if (other.n_systems > 0)
        tolerance = other.tolerance;
      if (!other.method.empty())
        method = other.method;
      return *this;
    }
  };
} // namespace abut

#endif
