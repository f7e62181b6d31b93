// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ELASTIC_TRACTION_H
#define ABUT_APP_ELASTIC_TRACTION_H

#include "material.h"

#include <abut/dealii/surface_traction.h>

#include <deal.II/fe/mapping.h>

namespace abut::app
{
  /** The traction of linear elastic bodies; both references must outlive it. */
  template <int dim> class ElasticTraction : public SurfaceTraction<dim>
  {
  public:
    ElasticTraction(const dealii::Mapping<dim> &mapping,
                    const Materials<dim> &materials)
        : mapping_(mapping), materials_(materials)
    {
    }

    void
    evaluate(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
             const std::vector<dealii::Point<dim>> &unit_point,
             const std::vector<dealii::Tensor<1, dim>> &normal,
             dealii::FullMatrix<double> &derivative) const override;

  private:
    const dealii::Mapping<dim> &mapping_;
    const Materials<dim> &materials_;
  };
} // namespace abut::app

#endif
