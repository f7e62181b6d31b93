// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_result.h"

namespace abut::app
{
  std::map<std::string, double> result_row(const ContactResult &s)
  {
    std::map<std::string, double> row = {
        {"level", s.level},
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
        {"penetration", s.penetration},
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
