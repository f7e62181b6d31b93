// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MEMBRANE_H
#define ABUT_APP_MEMBRANE_H

#include "discrete_problem.h"

#include <optional>

namespace abut::app
{
  /** Data of a membrane; functions must outlive it. */
  template <int dim> struct MembraneData
  {
    const dealii::Function<dim> *conductivity = nullptr; ///< k
    const dealii::Function<dim> *load = nullptr;         ///< f
    bool constant_conductivity = false; ///< k is the same everywhere
    bool constant_load = false;         ///< f is the same everywhere
    bool constant_dirichlet = false;    ///< so are prescribed displacements
    bool constant_neumann = false;      ///< and fluxes
    BoundaryFunctions<dim> dirichlet;
    BoundaryFunctions<dim> neumann;
  };

  /** The discrete membrane -div(k grad u) = f without obstacle: unknowns,
   * constraints, stiffness matrix, load vector. */
  template <int dim> class Membrane : public LinearProblem<dim>
  {
  public:
    Membrane(dealii::Triangulation<dim> &triangulation, unsigned int degree);

    /** Number unknowns, build constraints and the matrix's pattern for the
     * present mesh. Collective. */
    void setup(const MembraneData<dim> &data);

    /** Compute stiffness and load. Throws InputError for values of k and f
     * that are not legal. Collective. */
    void assemble(const MembraneData<dim> &data);

    /** @name What moves
     * Stiffness and load by themselves, in place of assemble(), and over all
     * unknowns as well. @{ */
    /** Constraints with the values that are prescribed at the present time.
     * Collective. */
    void prescribe(const MembraneData<dim> &data);

    /** Compute the stiffness on the present mesh; throws as assemble().
     * Collective. */
    void assemble_stiffness(const MembraneData<dim> &data);

    /** Compute the load of the present time; throws as assemble(). Needs the
     * stiffness. Collective. */
    void assemble_load(const MembraneData<dim> &data);

    la::Vector stiffness_times(const la::Vector &u) const override;
    /** @} */

    /** Force of loads and fluxes that their points miss or add, see LoadError;
     * none where there is no formula with variables. Collective. */
    std::optional<double> load_error(const MembraneData<dim> &data) const;

    /** The same of prescribed displacements, see nodal_error(). */
    std::optional<double> support_error(const MembraneData<dim> &data) const;

    /** Energy with the data of the last assemble(). Collective. */
    double energy(const la::Vector &u) const override;

    NodalForces nodal_forces(const la::Vector &u) const override;

  private:
    using Prescribe = typename DiscreteProblem<dim>::Prescribe;

    Prescribe dirichlet_values(const MembraneData<dim> &data) const;
    /** Loads at prescribed unknowns, 0 at others. */
    la::Vector loads_at_supports() const;

    /** What cells at supports add to the product of the matrix with the free
     * part of @p u. Collective. */
    la::Vector forces_of_supports(const la::Vector &u) const;

    MembraneData<dim> assembled;
  };
} // namespace abut::app

#endif
