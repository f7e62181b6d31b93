// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_METHOD_PARAMETERS_H
#define ABUT_DEALII_METHOD_PARAMETERS_H

/** @file
 * How contact is enforced, as parameters of a deal.II ParameterHandler.
 */

#include <abut/coupling.h>
#include <abut/dealii/coded.h>
#include <abut/strategy.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <optional>
#include <string>

namespace abut
{
  struct UserFriction;
  struct UserLaw;

  /** Linear system in which contact is enforced. */
  enum class System
  {
    automatic,   /**< chosen by law, discretisation and size */
    condensed,   /**< pressures eliminated row by row */
    saddle_point /**< pressures are unknowns of the linear system */
  };

  /** The word of a parameter file for a discretisation, `auto` for none. */
  std::string
  discretisation_name(std::optional<abut_discretisation> discretisation);

  /** Properties of a discretisation. */
  abut_discretisation_info
  discretisation_info(abut_discretisation discretisation);

  /** Why a law (or a tie) is not offered with a discretisation, with what to
   * take instead; empty if it is. */
  Message refusal(const abut_law &law, abut_discretisation discretisation,
                  System system, bool tied);

  /** Properties of a kinematics; of reference if there is none. */
  const abut_kinematics_info &
  kinematics_info(std::optional<abut_kinematics> kinematics);

  struct MethodParameters;

  /** Properties of a pair that a kinematics may refuse. */
  struct KinematicsPair
  {
    bool has_obstacle = false;     ///< a rigid obstacle, not a second body
    bool has_geometric_gap = true; ///< gaps are those of surfaces
    bool has_nodal_weights = true; ///< facets are not quadratic triangles
  };

  /** Why a kinematics is not offered with a method, with what to take instead;
   * empty if it is. Ties have the reference kinematics. */
  std::string kinematics_refusal(abut_kinematics kinematics,
                                 const abut_law &law,
                                 abut_discretisation discretisation,
                                 const KinematicsPair &pair);

  /** Why there is no friction with a method, with what to take instead; empty
   * if there is. */
  std::string friction_refusal(const abut_law &law,
                               abut_discretisation discretisation,
                               const MethodParameters &method, bool tied,
                               bool has_obstacle);

  /** The section `Method` of a parameter file.
   *
   * Call declare_parameters() on a handler, parse the file, then
   * parse_parameters(). Neither is collective. All values are free of units;
   * abut_strategy_options has the unit of each. The scales of length and
   * pressure and the reduction over ranks in @ref options are left at their
   * defaults: they belong to the scene, not to the file. */
  struct MethodParameters
  {
    /** The law and all settings of the outer method. */
    abut_strategy_options options = abut_strategy_defaults();

    /** Whether the file leaves the law to choose (`Enforcement = auto`).
     * parse_parameters() then takes lagrange, or penalty where rows are made at
     * quadrature points; a program with more information on its problem may
     * replace options.law. */
    bool law_is_automatic = false;

    /** Owner of options.law and options.law_parameters if the law is the
     * user's own (abut/user_law.h), else null. */
    std::shared_ptr<const UserLaw> user_law;

    /** Friction law of pairs with friction if it is the user's own, else null:
     * Coulomb's. */
    std::shared_ptr<const UserFriction> user_friction;

    /** Put it, and its parameters, into @p friction. */
    void set_law(abut_strategy_friction &friction) const;

    /** Which linear system is solved. */
    System system = System::automatic;

    /** How contact between two surfaces, or of a surface with a rigid obstacle,
     * is written down as rows; membranes have no choice. None: dual mortar for
     * two surfaces, nodes against rigid obstacles, quadrature points for laws
     * that need the stress; of quadratic triangles mortar, or quadrature points
     * where a law with a penalty follows an obstacle. */
    std::optional<abut_discretisation> discretisation;

    /** The discretisation of a pair: @ref discretisation, or the automatic one
     * for its law, kinematics, and shape.
     * @param has_quadratic_triangles of the secondary surface */
    abut_discretisation discretisation_of(bool has_obstacle,
                                          bool has_quadratic_triangles) const;

    /** Variant of `nitsche`: 1 (symmetric), 0 or -1. */
    double nitsche_theta = 0.;

    /** Degree of mortar multipliers on quadratic facets: 1, or 0 for the
     * degree of the facets; on quadratic triangles always 1. */
    unsigned int multiplier_degree = 0;

    /** Degree of the quadrature on each common part of two facets (or, without
     * @ref segments, on each facet); 0: exact for flat parallelograms. */
    unsigned int quadrature_degree = 0;

    /** As in abut_coupling_options: integrate over the exact common parts of
     * facets. */
    bool segments = true;

    /** Empty: the program's choice, from its bodies; else reference. */
    std::optional<abut_kinematics> kinematics;

    /** Whether the tangent has what forces and gaps of points that move change
     * by because directions and partners do. Without it Newton's method is of
     * first order, or finds no way. */
    bool turning_terms = true;

    /** Whether pairs that are known to fail, with a code ABUT-F.., are solved
     * where they would be refused, to measure how they fail;
     * ContactChecks::examine() then has an error with the code. Not a
     * parameter of the section. */
    bool solve_known_failures = false;

    /** Declare the section `Method` in the present section of @p prm. */
    static void declare_parameters(dealii::ParameterHandler &prm);

    /** Read the section `Method` in the present section of @p prm; throws
     * dealii::ExceptionBase when two values contradict each other, or when the
     * user's own law cannot be loaded. Relative names of its file are looked
     * up in the working folder. */
    void parse_parameters(dealii::ParameterHandler &prm);
  };
} // namespace abut

#endif
