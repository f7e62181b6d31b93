// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_RESULT_ROW_H
#define ABUT_APP_RESULT_ROW_H

#include <map>
#include <string>

namespace abut::app
{
  /** The columns of levels.csv that all scenes with contact have, from the
   * results @p s of one mesh or load step (ObstacleLevel, SolidState). */
  template <typename State>
  std::map<std::string, double> result_row(const State &s)
  {
    std::map<std::string, double> row = {
        {"cells", double(s.cells)},
        {"dofs", double(s.dofs)},
        {"constraints", double(s.rows)},
        {"active", double(s.active)},
        {"steps", s.steps},
        {"linear_iterations", s.linear.n_iterations},
        {"matvecs", s.linear.n_matvecs},
        {"setups", s.linear.n_setups},
        {"energy", s.energy},
        {"contact_force", s.force},
        {"setup_seconds", s.linear.setup_seconds},
        {"krylov_seconds", s.linear.solve_seconds},
        {"seconds", s.seconds}};
    if (s.errors)
    {
      row["l2_error"] = s.errors->l2;
      row["h1_error"] = s.errors->h1_seminorm;
    }
    if (s.estimate)
      row["estimate"] = *s.estimate;
    if (s.error_parts)
      row["estimated_error"] = s.error_parts->total();
    return row;
  }
} // namespace abut::app

#endif
