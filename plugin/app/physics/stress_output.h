// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_STRESS_OUTPUT_H
#define ABUT_APP_STRESS_OUTPUT_H

/** @file
 * Stresses of elastic bodies: as fields of output files, and at nodes.
 */

#include "cell_volume.h"

#include <abut/dealii/linear_algebra.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <string>
#include <vector>

namespace abut::app
{
  /** From a displacement the fields `stress` (tensor), `von_mises_stress` and,
   * in two dimensions, `stress_out_of_plane`, each cell by itself: what
   * jumps from cell to cell is shown as it is. */
  template <int dim>
  class StressPostprocessor : public dealii::DataPostprocessor<dim>
  {
  public:
    /** @p materials, at the displacement, must outlive this object. */
    explicit StressPostprocessor(const CellMaterials<dim> &materials);

    std::vector<std::string> get_names() const override;

    std::vector<
        dealii::DataComponentInterpretation::DataComponentInterpretation>
    get_data_component_interpretation() const override;

    dealii::UpdateFlags get_needed_update_flags() const override;

    void evaluate_vector_field(
        const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>> &results) const override;

  private:
    const CellMaterials<dim> &materials;
  };

  /** Stress at the nodes of a scalar Lagrange element on the same mesh: the
   * mean of the stresses of the cells around a node, weighted by their
   * volume. Bodies that share no node do not mix.
   *
   * @param displacement ghosted, belongs to @p dof_handler
   * @param scalar unknowns of the result, of elements of degree 1
   * @return with ghosts: the components xx, yy, (zz,) then xy (, xz, yz), then
   * in two dimensions the one out of plane, and von Mises' equivalent stress
   * last, of the mean stress.
   *
   * Collective. One pass over the cells. */
  template <int dim>
  std::vector<la::Vector>
  nodal_stress(const dealii::Mapping<dim> &mapping,
               const dealii::DoFHandler<dim> &dof_handler,
               const la::Vector &displacement, const Materials<dim> &materials,
               const dealii::DoFHandler<dim> &scalar);
} // namespace abut::app

#endif
