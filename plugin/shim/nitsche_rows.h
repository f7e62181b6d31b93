// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_NITSCHE_ROWS_H
#define ABUT_SHIM_NITSCHE_ROWS_H

#include "solve/nitsche_solver.h"
#include "surface_rows.h"

#include <abut/dealii/surface_traction.h>

namespace abut::shim
{
  /** The bodies' own stress at rows, for laws that need it. */
  template <int dim> class NitscheRows
  {
  public:
    explicit NitscheRows(abut_context *context)
        : points_(create_points(context, 1))
    {
    }

    void set_traction(std::shared_ptr<const SurfaceTraction<dim>> traction)
    {
      traction_ = std::move(traction);
    }

    /** Find the stress at the present rows, @p rows of this rank. Throws
     * without surfaces (null) or traction. Collective. */
    void find(const SurfaceRows<dim> *surfaces, int rows, double theta);

    /** Stress at this displacement. Collective. */
    void move_to(const la::Vector &displacement)
    {
      terms_.stress.gap(displacement, terms_.present.data());
    }

    /** gamma = @p penalty times the stiffness of rows. */
    void set_penalty(double penalty, const std::vector<double> &stiffness);

    /** [rows] gap + stress / gamma; lives until the next call. */
    const double *law_gap(const std::vector<double> &gap);

    const solve::NitscheTerms &terms() const
    {
      return terms_;
    }

  private:
    std::shared_ptr<const SurfaceTraction<dim>> traction_;
    Handle<abut_points> points_;
    solve::NitscheTerms terms_;
    std::vector<double> gap_;
  };
} // namespace abut::shim

#endif
