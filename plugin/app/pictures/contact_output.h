// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_CONTACT_OUTPUT_H
#define ABUT_APP_CONTACT_OUTPUT_H

/** @file
 * Fields of contact boundaries for output files of faces.
 */

#include <abut/dealii/linear_algebra.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/numerics/data_postprocessor.h>

#include <functional>
#include <string>
#include <vector>

namespace abut::app
{
  /** From nodal vectors along the surface normal, such as p n, their
   * signed length: on the nodal normals the length is exact, while the normal
   * of a facet only tells the sign. For faces. */
  template <int dim>
  class SignedLength : public dealii::DataPostprocessorScalar<dim>
  {
  public:
    /** @param name of the field
     * @param outward the sign of vectors that point out of the body, 1 or -1
     */
    SignedLength(const std::string &name, double outward);

    void evaluate_vector_field(
        const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>> &results) const override;

  private:
    const double outward;
  };

  /** From tractions on the body, the pressure, which is what is along the
   * normal of a facet, the friction, the length of the rest, or the length of
   * all. For faces. */
  template <int dim>
  class TractionPart : public dealii::DataPostprocessorScalar<dim>
  {
  public:
    enum class Part
    {
      pressure,
      friction,
      all
    };

    TractionPart(const std::string &name, Part part);

    void evaluate_vector_field(
        const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>> &results) const override;

  private:
    const Part part;
  };

  /** From a field that is the same number in all components that number. */
  template <int dim>
  class FirstComponent : public dealii::DataPostprocessorScalar<dim>
  {
  public:
    explicit FirstComponent(const std::string &name);

    void evaluate_vector_field(
        const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>> &results) const override;
  };

  /** A number by boundary id, such as what its user calls it. For faces. */
  template <int dim>
  class NumberOfBoundary : public dealii::DataPostprocessorScalar<dim>
  {
  public:
    using Number = std::function<double(dealii::types::boundary_id)>;

    NumberOfBoundary(const std::string &name, Number number);

    void evaluate_vector_field(
        const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>> &results) const override;

  private:
    const Number number;
  };

  /** The gap, which is the same in all components of @p gap, with 1 in the
   * second component where a node has a row and 0 where @p status says that it
   * has none. All owned, without ghosts. */
  template <int dim>
  la::Vector mark_rows(const dealii::DoFHandler<dim> &dof_handler,
                       const la::Vector &gap, const la::Vector &status);

  /** From a field of mark_rows(), the gap; NaN, which viewers leave out, where
   * a node has no row, or a hanging node a parent without one: nothing is known
   * there, and 0 would mean that surfaces touch. */
  template <int dim>
  class GapOfRows : public dealii::DataPostprocessorScalar<dim>
  {
  public:
    explicit GapOfRows(const std::string &name);

    void evaluate_vector_field(
        const dealii::DataPostprocessorInputs::Vector<dim> &inputs,
        std::vector<dealii::Vector<double>> &results) const override;
  };

  /** What GapOfRows says of one node. */
  double gap_of_row(double gap, double presence);
} // namespace abut::app

#endif
