// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_POINT_MASS_PICTURES_H
#define ABUT_APP_POINT_MASS_PICTURES_H

#include "app/report/report.h"
#include "point_mass_model.h"

#include <filesystem>

namespace abut::app
{
  /** Pictures of a point-mass scene, in @p folder:
   * `penalty` - displacement and contact force over the penalty (one mass, one
   * row); `energy` - energy over displacement for each of @p penalties (the
   * same); `lagrangian` - contours of the Lagrangian with its saddle point
   * (the same); `path` - contours of the energy, the constraints and the
   * displacements of the outer steps (two masses).
   * @p options are those of the scene's method. Rank 0 acts. */
  void draw_point_mass(const PointMassModel &model,
                       const abut_strategy_options &options,
                       const PointMassSolution &solution,
                       const std::vector<double> &penalties,
                       const std::filesystem::path &folder, Report &report);
} // namespace abut::app

#endif
