/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_ABUT_H
#define ABUT_ABUT_H

/** @file
 * Abut's C interface: contact search, constraint rows, contact laws and the
 * methods that enforce them, over plain arrays.
 */

#include <abut/condense.h>
#include <abut/contact_measures.h>
#include <abut/contact_motion.h>
#include <abut/context.h>
#include <abut/coupling.h>
#include <abut/coupling_search.h>
#include <abut/dense_model.h>
#include <abut/detect.h>
#include <abut/export.h>
#include <abut/facet.h>
#include <abut/failure.h>
#include <abut/friction.h>
#include <abut/friction_points.h>
#include <abut/gap_raise.h>
#include <abut/history.h>
#include <abut/interface.h>
#include <abut/kinematics.h>
#include <abut/law.h>
#include <abut/limits.h>
#include <abut/missed_contact.h>
#include <abut/multigrid.h>
#include <abut/obstacle.h>
#include <abut/obstacle_edge.h>
#include <abut/obstacle_facets.h>
#include <abut/obstacle_surface.h>
#include <abut/pair_checks.h>
#include <abut/parts.h>
#include <abut/places.h>
#include <abut/points.h>
#include <abut/projection.h>
#include <abut/search.h>
#include <abut/self_contact.h>
#include <abut/status.h>
#include <abut/strategy.h>
#include <abut/surface.h>
#include <abut/time.h>
#include <abut/version.h>

#endif
