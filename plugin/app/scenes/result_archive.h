// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RESULT_ARCHIVE_H
#define ABUT_APP_RESULT_ARCHIVE_H

/** @file
 * Results of a run in checkpoints.
 */

#include "app/restart/archive.h"
#include "contact_result.h"

#include <boost/serialization/binary_object.hpp>

#include <type_traits>

namespace abut
{
  template <class Archive>
  void serialize(Archive &archive, LinearReport &r, unsigned int)
  {
    archive &r.n_systems &r.n_iterations &r.n_matvecs &r.n_setups;
    archive &r.condition &r.setup_seconds &r.solve_seconds;
    archive &r.tolerance &r.method;
  }

  template <class Archive>
  void serialize(Archive &archive, DetectionReport &r, unsigned int)
  {
    archive &r.searches &r.reuses &r.rebuilds &r.refits &r.gatherings;
    archive &r.seconds &r.gained &r.lost &r.exchanged;
  }
} // namespace abut

namespace abut::app
{
  template <class Archive>
  void serialize(Archive &archive, ErrorNorms &norms, unsigned int)
  {
    archive &norms.l2 &norms.h1_seminorm &norms.largest_node;
    archive &norms.energy;
  }

  template <class Archive>
  void serialize(Archive &archive, ContactResult &r, unsigned int)
  {
    static_assert(std::is_trivially_copyable_v<abut_progress>,
                  "written as it stands in memory");
    archive &r.load_step &r.time &r.level &r.steps &r.linearisations;
    archive &r.linear;
    archive &boost::serialization::make_binary_object(&r.progress,
                                                      sizeof(r.progress));
    archive &r.cells &r.dofs &r.rows &r.active;
    archive &r.energy &r.force &r.penetration;
    archive &r.dissipation &r.friction_force &r.detection;
    archive &r.late_force &r.stick_force;
    archive &r.errors &r.estimate &r.error_parts &r.seconds;
  }
} // namespace abut::app

#endif
