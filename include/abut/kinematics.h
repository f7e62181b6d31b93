/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_KINEMATICS_H
#define ABUT_KINEMATICS_H

/** @file
 * Kinematics of contact: the configuration that the points of a pair are made
 * in, and the one that their directions and gaps refer to.
 *
 * reference: small sliding, Hallquist, Goudreau and Benson, Comput. Methods
 * Appl. Mech. Engrg. 51 (1985) 107. updated: as the updated Lagrangian
 * formulation, Bathe, Ramm and Wilson, Int. J. Numer. Meth. Engng 9 (1975) 353.
 * current: Puso and Laursen, Comput. Methods Appl. Mech. Engrg. 193 (2004) 601;
 * Popp, Gitterle, Gee and Wall, Int. J. Numer. Meth. Engng 83 (2010) 1428.
 */

#include <abut/export.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C"
{
#endif

  /** Configuration of the bodies. */
  typedef enum abut_configuration
  {
    ABUT_CONFIGURATION_REFERENCE, /**< the mesh, displacement 0 */
    ABUT_CONFIGURATION_COMMITTED, /**< at the end of the last step */
    ABUT_CONFIGURATION_CURRENT    /**< at the current displacement */
  } abut_configuration;

  /** Kinematics of a pair. */
  typedef enum abut_kinematics
  {
    /** Gaps are linear in the displacement, as they are in the reference
     * configuration. */
    ABUT_KINEMATICS_REFERENCE,
    /** Partners and weights of the reference configuration, directions and
     * gaps of the current one: what reference is for bodies of large strain. */
    ABUT_KINEMATICS_COROTATIONAL,
    /** Gaps are linear from the configuration at the end of the last step. */
    ABUT_KINEMATICS_UPDATED,
    /** Partners, directions and gaps of the current configuration. */
    ABUT_KINEMATICS_CURRENT,
    /** Number of kinematics; not one. */
    ABUT_KINEMATICS_N
  } abut_kinematics;

  /** Properties of a kinematics. */
  typedef struct abut_kinematics_info
  {
    const char *name; /**< "reference" */
    /** Where the surfaces stand when points are made: partners and stencils
     * are found there. Weights are those of the reference configuration. */
    abut_configuration points;
    /** Configuration that directions and gaps refer to. Current: they change at
     * each linearisation, and have derivatives. */
    abut_configuration directions;
    bool bodies_only;       /**< no obstacles, and mortar only */
    bool weighted_obstacle; /**< mortar against obstacles, too */
    bool interior_laws;     /**< barrier and interior point, too */
    bool stress_laws;       /**< Nitsche, too */
  } abut_kinematics_info;

  /** Properties of a kinematics; NULL if there is no such one. */
  ABUT_API const abut_kinematics_info *
  abut_kinematics_get(abut_kinematics kinematics);

#ifdef __cplusplus
}
#endif

#endif
