// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_GEOMETRIC_MULTIGRID_H
#define ABUT_SOLVE_GEOMETRIC_MULTIGRID_H

#include "multigrid.h"

#include <abut/multigrid.h>

namespace abut::solve
{
  /** V-cycles over the meshes that a mesh was refined from, see
   * abut/multigrid.h, with some unknowns held. On one rank. */
  class GeometricMultigrid : public Multigrid
  {
  public:
    /** A copy of @p matrix is made; hold() comes next. */
    GeometricMultigrid(const la::Matrix &matrix, const MeshHierarchy &meshes);

    /** [owned] nonzero where an unknown is held, and what is added to the
     * diagonal; empty: nothing. Costs what is near the changes. */
    void hold(const std::vector<std::uint8_t> &held,
              const std::vector<double> &added);

    void vmult(la::Vector &dst, const la::Vector &src) const override;

  private:
    struct Destroy
    {
      void operator()(abut_context *object) const
      {
        abut_context_destroy(&object);
      }
      void operator()(abut_multigrid *object) const
      {
        abut_multigrid_destroy(&object);
      }
    };

    void check(abut_status status) const;

    std::unique_ptr<abut_context, Destroy> context_;
    std::unique_ptr<abut_multigrid, Destroy> multigrid_;
  };

  /** Why a system cannot have geometric multigrid, as the end of a sentence;
   * empty: it can. Collective. */
  std::string why_not_geometric(const la::Matrix &matrix,
                                const NearNullSpace &space);

  /** What multigrid is used, in words: the geometric one if it was asked for
   * and nothing is @p missing. */
  std::string multigrid_name(const SolverParameters &parameters,
                             const std::string &missing);
} // namespace abut::solve

#endif
