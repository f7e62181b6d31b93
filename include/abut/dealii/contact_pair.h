// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_CONTACT_PAIR_H
#define ABUT_DEALII_CONTACT_PAIR_H

/** @file
 * Which surfaces of elastic bodies may touch each other or a rigid obstacle,
 * and what was found there.
 */

#include <abut/dealii/coded.h>
#include <abut/dealii/rigid_obstacle.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>

#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace abut
{
  /** Coulomb friction between the sides of a pair: the traction along the
   * surface is at most rho = min(mu max(p, 0), cap), and where it is that, slip
   * is opposed to it (abut/friction.h). Functions of the position in the
   * reference configuration of the secondary; what else they depend on, such as
   * time, may change from one solve to the next. */
  template <int dim> struct Friction
  {
    /** mu >= 0. */
    std::function<double(const dealii::Point<dim> &)> coefficient;
    /** Largest traction, force per area >= 0; empty: none. */
    std::function<double(const dealii::Point<dim> &)> cap;
  };

  /** Two surfaces, or a surface and a rigid obstacle, or a surface that may
   * touch itself: then both sides have the same boundary ids, and facets that
   * face each other within reach before anything moves are put on different
   * sides (abut/self_contact.h). */
  template <int dim> struct ContactPair
  {
    /** Name in messages and tables. */
    std::string name;

    /** Boundary ids of the secondary surface: the one that carries the rows,
     * usually the softer side. */
    std::set<dealii::types::boundary_id> secondary;

    /** Boundary ids of the primary surface; empty if there is an obstacle. */
    std::set<dealii::types::boundary_id> primary;

    /** Obstacle that the secondary surface may not penetrate instead of a
     * primary surface; or null. */
    std::shared_ptr<const RigidObstacle<dim>> obstacle;

    /** Added to the gap of the geometry, length: > 0 clearance, < 0
     * interference. */
    double gap = 0.;

    /** Whether the gap of the geometry counts. If not, the gap without
     * displacement is @ref gap everywhere: curved surfaces that fit, such as
     * two rings, have none, though the facets of their meshes do. Searches are
     * as always. */
    bool geometric_gap = true;

    /** Friction between the sides; null: none. */
    std::shared_ptr<const Friction<dim>> friction;

    /** With friction: where the obstacle was before the first step, which slips
     * are measured from until the first commit(). None: where it is. */
    std::optional<RigidPose<dim>> first_pose;

    /** The surfaces are glued: no relative displacement in any direction. */
    bool tied = false;

    /** A body floats unless this pair holds it: if no row is closed at the
     * start, the nearest ones are taken to be. */
    bool holds_body = false;

    /** Whether the surfaces may be out of each other's reach: with inertia,
     * bodies fly, and a pair without a point is no error. */
    bool may_be_apart = false;

    /** Distance within which the surfaces are looked for, length; 0: half a
     * facet, or one and a half times the motion since the last search if that
     * is more. */
    double reach = 0.;
  };

  /** Properties of a pair before anything is solved. Global over ranks. */
  struct PairCheck
  {
    std::string name;                  /**< of the pair */
    unsigned int secondary_facets = 0; /**< on all ranks */
    unsigned int primary_facets = 0;   /**< on all ranks; 0: obstacle */
    dealii::types::global_dof_index n_rows = 0; /**< constraint rows */
    double area = 0.;                           /**< of the secondary surface */
    double covered_area = 0.;   /**< part of it that has a partner: the sum of
                                     the weights of the rows */
    double overlap = 0.;        /**< largest initial penetration, length >= 0 */
    double first_overlap = 0.;  /**< the same before anything moves; of an
                                     obstacle that may be apart, where it is
                                     first and without the gap added, and 0 of
                                     others */
    unsigned int n_dropped = 0; /**< nodes without a multiplier: prescribed
                                     along the normal, or taken by another
                                     pair */
    unsigned int n_reversed = 0; /**< nodes that only found facets with a
                                      normal that points the same way */
    double facet_size = 0.;      /**< median of the secondary surface, length */
    double size_ratio = 0.;      /**< median facet size, secondary by primary */
    bool history_by_place = false; /**< points of this pair have no number that
                                        lasts: pressures are taken over from
                                        the nearest old point of the facet */
    std::vector<Message> warnings; /**< with what to do */
  };

  /** Results of a solve on a pair. Global over ranks. */
  template <int dim> struct PairResult
  {
    std::string name;                             /**< of the pair */
    dealii::types::global_dof_index n_rows = 0;   /**< constraint rows */
    dealii::types::global_dof_index n_active = 0; /**< of these in contact */
    double covered_area = 0.; /**< sum of the weights of the rows */
    double contact_area = 0.; /**< of those in contact */
    double penetration = 0.;  /**< largest, length >= 0; of a tie the largest
                                   opening in any direction */
    /** How deep nodes of the primary are in the secondary between rows that
     * hold it, length >= 0, by the last ContactChecks::penetrations(): what the
     * discretisation does not see. Large where the secondary is coarser. At an
     * obstacle: its depth in facets between their nodes, by the last examine().
     */
    double between_rows = 0.;
    /** How deep nodes of the secondary are in the other side that supports
     * hold along the normal and that have no row therefore, length >= 0, by
     * the last ContactChecks::penetrations(): what contact would have to move.
     */
    double held_inside = 0.;
    /** Largest tangential motion of the two sides of a closed row against each
     * other, of bodies, or of the body at an obstacle, length >= 0, by the last
     * examine(). */
    double slip = 0.;
    /** Against obstacles: largest difference of the gap of a closed row from
     * the distance of its node where it is now, length >= 0, by the last
     * examine(): what is lost by gaps that are linear in the displacement. */
    double gap_error = 0.;
    /** Rotation of the normals at rows with pressure since the rows were made,
     * radian, by the last examine(): the mean, weighted with the forces; 0
     * where points move. It is about the part of the forces that is beside
     * their present directions. */
    double rotation = 0.;
    /** The largest of these rotations, radian. */
    double largest_rotation = 0.;
    /** Change of the resultant on the secondary side if the forces had their
     * current directions. */
    dealii::Tensor<1, dim> rotated_force;
    /** Against obstacles: how deep they are in deformed facets without any
     * contact, length >= 0, by the last examine(); @ref between_rows has all
     * facets. */
    double missed_depth = 0.;
    double pressure = 0.; /**< largest */
    /** Part of the tractions that alternates from node to node, by the last
     * examine(): root mean squares, at nodes that are closed with their
     * neighbours up to the second; 0 where there are none. */
    double oscillation = 0.;
    /** Largest tension >= 0, force per area, where the law lets surfaces pull;
     * 0 for ties, whose tractions have any sign. */
    double largest_tension = 0.;
    /** Least pressure of the closed points, negative where they pull; 0 where
     * none is closed and for ties. */
    double least_pressure = 0.;
    /** Resultant contact force on the secondary side. */
    dealii::Tensor<1, dim> secondary_force;
    /** The same on the primary; against an obstacle minus the first. */
    dealii::Tensor<1, dim> primary_force;
    /** Moment about the origin, of the forces on the secondary side at the
     * reference positions (where points move: at the present ones); in 2D the
     * third component alone is not 0. */
    dealii::Tensor<1, 3> secondary_moment;
    /** The same on the primary side. */
    dealii::Tensor<1, 3> primary_moment;
    /** The moment on the secondary side with the forces at the places of the
     * last examine(), those of bodies of large strain, which are in balance
     * there; before the first, @ref secondary_moment. */
    dealii::Tensor<1, 3> present_moment;
    /** The same on the primary side. */
    dealii::Tensor<1, 3> present_primary_moment;
    /** |sum of the forces| / |force|; 0 where there is no force. */
    double force_imbalance = 0.;
    /** |sum of the moments| / (|force| * diameter of the surface); 0 where
     * there is no force. */
    double moment_imbalance = 0.;
    /** The same of the moments at the places of the last examine(). */
    double present_moment_imbalance = 0.;
    /** Work of the contact forces on the gaps that were there before anything
     * moved: the sum of weight, pressure and gap at displacement 0. */
    double initial_gap_work = 0.;
    /** With friction: rows in contact that slip, the rest sticks. */
    dealii::types::global_dof_index n_slipping = 0;
    /** With friction: nodes of the secondary in or beside the contact zone
     * whose displacement along the normal supports prescribe. Their share of
     * the area is their neighbours', and forces on them are reactions, without
     * friction. */
    dealii::types::global_dof_index n_prescribed = 0;
    /** Their unknowns on this rank, with the components of the unit normals out
     * of the secondary: the sum of the products with the reactions, and a
     * minus, is the force along the normals without friction. */
    std::vector<std::pair<dealii::types::global_dof_index, double>>
        prescribed_normal;
    /** With friction: sum of the pressures of points that stick at nodes with
     * another closed contact, as in a corner, force >= 0. Along a common
     * direction only the sum of both is determined, and without slip friction
     * is that of the last accepted step. */
    double shared_stick_force = 0.;
    /** With friction: sum of the pressures, force. */
    double normal_force = 0.;
    /** The part of it at points that slip, and that were open at the last
     * commit() and not as near as the nearest point of the pair, force >= 0.
     * They have the slip of the whole step, also that from before they closed.
     * 0 where all points slip: they do so in any steps. */
    double late_force = 0.;
    /** Sum of the magnitudes of the tractions along the surface, force >= 0. */
    double friction_force = 0.;
    /** Resultant of the tractions along the surface on the secondary side; it
     * is a part of @ref secondary_force. */
    dealii::Tensor<1, dim> secondary_friction;
    /** Energy dissipated by friction since the last commit(), energy >= 0. */
    double dissipation = 0.;
    /** Largest traction, force per area. */
    double traction = 0.;
  };

  /** How far closed rows of a pair go, at a displacement, from where their
   * points were made at the beginning of the step (ABUT_KINEMATICS_UPDATED),
   * or, where partners stay (reference and corotational kinematics, between
   * bodies), from where they were paired. All 0 where points move. Global over
   * ranks. */
  struct StepMotion
  {
    double slip = 0.;  /**< along the surface, of both sides against each other,
                            length >= 0 */
    double facet = 0.; /**< to compare it with: median size of the side with
                            the smaller ones; 0: an obstacle, which has none */
    double rotation = 0.; /**< of facets in contact, or of the obstacle's
                           normal, radian >= 0; updated kinematics only */
    bool stays = false;   /**< from the reference, not from the step */
  };

  /** A point of the secondary that has penetrated without a row. */
  template <int dim> struct Penetration
  {
    std::string pair;         /**< name of the pair */
    dealii::Point<dim> point; /**< current position of the node */
    double depth = 0.;        /**< length > 0 */
    bool on_primary = false;  /**< found by a node of the primary surface that
                                   is in a facet without rows */
    bool same_direction = false; /**< the outward normals of surface and
                                obstacle point the same way there: nothing can
                                touch from this side */
    bool same_side = false; /**< self contact: both parts are on one of the two
                               sides, which does not see itself */
  };

  /** Contact pairs that cannot be solved as they are: the message has the pair
   * and the remedy. Thrown on all ranks. */
  class ContactError : public MessageError
  {
  public:
    using MessageError::MessageError;
  };
} // namespace abut

#endif
