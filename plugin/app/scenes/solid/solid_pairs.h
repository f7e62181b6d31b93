// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_PAIRS_H
#define ABUT_APP_SOLID_PAIRS_H

#include "app/input/boundary_expressions.h"
#include "app/input/expression.h"
#include "app/mesh/bodies.h"
#include "app/pictures/obstacle_output.h"
#include "solid_parameters.h"

#include <abut/dealii/contact_pair.h>
#include <abut/dealii/contact_refinement.h>
#include <abut/dealii/rigid_obstacle.h>

#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace abut::app
{
  /** Whether a pair's coefficient of friction is anything but 0. Throws
   * InputError for a formula that cannot be read. */
  template <int dim> bool is_frictional(const PairParameters &pair);

  /** The contact pairs of a scene `solid` with their obstacles. */
  template <int dim> class SolidPairs
  {
  public:
    /** Make the obstacles and read the formulas; throws InputError. */
    SolidPairs(const SolidParameters &parameters, const RunOptions &options);

    /** Find the boundary ids of the surfaces. Throws InputError for bodies and
     * ids that do not exist, and for a surface on both sides of a pair. */
    void find_surfaces(const Bodies<dim> &bodies);

    /** Half the extent of the bodies, for differences of formulas. */
    void set_length(double length)
    {
      *half_extent = length;
    }

    /** Throw InputError for a secondary surface all of whose nodes supports
     * hold in all directions. */
    void require_free(const Bodies<dim> &bodies,
                      const std::map<dealii::types::boundary_id,
                                     BoundaryCondition<dim>> &supports) const;

    /** Say that pairs with one of these surfaces of a body hold it.
     * @param has_others the body has other parts, which a pair of its surface
     * with itself may hold it by */
    void hold(const std::set<dealii::types::boundary_id> &surface,
              bool has_others);

    /** Say that bodies fly: no pair needs to be in reach. */
    void let_fly();

    /** Secondary surfaces that touch and leave, and primary ones of their own
     * body: those of ties do not. */
    std::set<dealii::types::boundary_id>
    touching(const Bodies<dim> &bodies) const;

    /** What forces have moved the obstacles by, by obstacle, from the next
     * set_time() on. Without, they are where their motions say. */
    void set_driven(std::vector<dealii::Tensor<1, dim>> displacements)
    {
      driven = std::move(displacements);
    }

    /** Time of gaps and obstacles. */
    void set_time(double time);

    /** Refuse motions of obstacles that jump in the step from @p begin to @p
     * end, which no velocity goes with: throws InputError. */
    void refuse_jumps(double begin, double end) const;

    /** Place an obstacle of the pairs as at the present time, but moved by
     * forces by @p displacement; until the next set_time(). */
    void place_obstacle(std::size_t obstacle,
                        const dealii::Tensor<1, dim> &displacement) const;

    /** Pairs with this obstacle need not be in reach before it has come. */
    void let_come(std::size_t obstacle);

    /** The number of the obstacle of a pair, if it has one. */
    std::optional<std::size_t> obstacle_of(std::size_t pair) const
    {
      const unsigned int number = parameters.pairs[pair].obstacle;
      return number > 0 ? std::optional<std::size_t>(number - 1) : std::nullopt;
    }

    /** The pairs at the present time. */
    const std::vector<ContactPair<dim>> &pairs() const
    {
      return all;
    }

    bool empty() const
    {
      return all.empty();
    }

    /** Whether any pair has friction. */
    bool has_friction() const
    {
      return !friction.empty();
    }

    /** Coefficient and cap of a pair, by its index: those with variables. */
    std::vector<const Expression<dim> *>
    varying_friction(std::size_t pair) const;

    /** Boundary ids of all secondary, or of all surfaces. */
    std::set<dealii::types::boundary_id> secondary() const;
    std::set<dealii::types::boundary_id> surfaces() const;

    /** All obstacles at the present time. */
    std::vector<PlacedObstacle<dim>> moved_obstacles() const;

    /** Both sides of the pairs between bodies. */
    std::vector<ContactSides> sides() const;

    /** The parameter that a message about a pair belongs to: the pair's that
     * the message names, or the first's. */
    std::string parameter_of(const Message &message) const;

  private:
    std::shared_ptr<const Friction<dim>>
    make_friction(const PairParameters &pair);

    const SolidParameters &parameters;
    /** Of the bodies, known with their mesh. */
    const std::shared_ptr<double> half_extent = std::make_shared<double>(1.);
    double time = 0.;
    std::vector<std::shared_ptr<RigidObstacle<dim>>> obstacles;
    std::vector<dealii::Tensor<1, dim>> driven; ///< by obstacle, or empty
    std::vector<std::unique_ptr<Expression<dim>>> gaps;
    /** Of the pairs with friction, with the pair's index. */
    std::vector<std::pair<std::size_t, std::shared_ptr<Expression<dim>>>>
        friction;
    std::vector<ContactPair<dim>> all;
  };
} // namespace abut::app

#endif
