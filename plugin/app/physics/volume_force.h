// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_VOLUME_FORCE_H
#define ABUT_APP_VOLUME_FORCE_H

#include "app/input/expression.h"

#include <memory>
#include <string>
#include <vector>

namespace abut::app
{
  /** Force per volume of a body: its weight and a force of its own. */
  template <int dim> class VolumeForce : public dealii::Function<dim>
  {
  public:
    /** @param gravity acceleration; null: no weight. Must outlive this.
     * @param own formulas of the other force, or empty
     * @param parameter name of @p own in messages */
    VolumeForce(double density, const Expression<dim> *gravity,
                const std::string &own, const std::string &parameter);

    /** Whether there is any force. */
    bool is_present() const;

    /** Whether it depends on neither place nor time, by its formulas. */
    bool is_constant() const;

    double value(const dealii::Point<dim> &point,
                 unsigned int component = 0) const override;

    /** Set the time of the own force; gravity has its own. */
    void set_time(double time) override;

    /** Checked values, see Expression::evaluate(). */
    std::vector<double> evaluate(const std::vector<dealii::Point<dim>> &points,
                                 unsigned int component) const;

  private:
    double density;
    const Expression<dim> *gravity;
    std::unique_ptr<Expression<dim>> own;
  };
} // namespace abut::app

#endif
