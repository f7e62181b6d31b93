// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_EXPRESSION_H
#define ABUT_APP_EXPRESSION_H

/** @file
 * Formulas of a scene file as deal.II functions.
 */

#include <deal.II/base/function.h>
#include <deal.II/base/function_parser.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** A formula in the coordinates x, y (and z in 3D) and the time t, with the
   * constant pi, the functions of muParser and `if(condition, then, else)`.
   * Components are separated by commas or semicolons.
   *
   * A component without variables is evaluated once, at construction; then
   * value_list() only fills, since parsed formulas cost about 0.1 us per point
   * and a million points are a noticeable part of a solve.
   *
   * Gradients are symmetric differences of the formula (with a step of 1e-5
   * times the length of set_length() or the coordinate, whichever is larger);
   * give a formula of the gradient where more is needed (ExactSolution). */
  template <int dim> class Expression : public dealii::Function<dim>
  {
  public:
    /** @param text the formula(s)
     * @param parameter full name of the parameter that it came from
     * @param constants names of values that it may contain, in addition to pi
     *
     * Throws InputError that names the parameter and quotes the formula and
     * the parser's message with its position. Not collective. */
    Expression(const std::string &text, const std::string &parameter,
               unsigned int n_components = 1,
               const std::map<std::string, double> &constants = {});

    double value(const dealii::Point<dim> &point,
                 unsigned int component = 0) const override;

    void value_list(const std::vector<dealii::Point<dim>> &points,
                    std::vector<double> &values,
                    unsigned int component = 0) const override;

    dealii::Tensor<1, dim> gradient(const dealii::Point<dim> &point,
                                    unsigned int component = 0) const override;

    void set_time(double time) override;

    /** Size of what the formula is about, half its extent: differences take
     * steps in proportion to it. 1 until it is set. */
    void set_length(double half_extent);

    /** Values at many points, checked: throws InputError that names parameter
     * and point at the first value that is not finite. Not collective (wrap
     * in collective() where ranks hold different points). */
    std::vector<double> evaluate(const std::vector<dealii::Point<dim>> &points,
                                 unsigned int component = 0) const;

    /** Whether the component depends on neither place nor time. */
    bool is_constant(unsigned int component = 0) const;

    /** Whether no component depends on place or time. */
    bool is_wholly_constant() const;

    /** Whether it is 0 everywhere and at all times, by its formula. */
    bool is_zero(unsigned int component = 0) const;

    /** Whether any component contains the variable t. */
    bool depends_on_time() const;

    const std::string &text() const;
    const std::string &parameter() const;

  private:
    struct Component
    {
      bool constant;
      double value; /**< if constant */
    };
    std::string formula;
    std::string parameter_name;
    std::vector<Component> components;
    bool uses_time;
    double length = 1.;
    /** Parser of all components; absent when all are constant. */
    std::unique_ptr<dealii::FunctionParser<dim>> parser;
  };

  /** Throw InputError if @p value, that the function given by @p parameter has
   * at @p point, is infinite or not a number. */
  template <int dim>
  void check_finite(double value, const dealii::Point<dim> &point,
                    const std::string &parameter,
                    const std::string &formula = "");

  /** An Expression whose values are checked by check_finite(), for functions of
   * deal.II that take a function and would pass such values on. */
  template <int dim> class CheckedExpression : public dealii::Function<dim>
  {
  public:
    /** @param expression which must live as long as this object */
    explicit CheckedExpression(const Expression<dim> &expression);

    double value(const dealii::Point<dim> &point,
                 unsigned int component = 0) const override;

  private:
    const Expression<dim> &expression;
  };

  /** Fill @p values with those of @p function at @p points and check them by
   * check_finite(). */
  template <int dim>
  void checked_values(const dealii::Function<dim> &function,
                      const std::vector<dealii::Point<dim>> &points,
                      const std::string &parameter,
                      std::vector<double> &values);

  /** Names in a formula: words that start with a letter or underscore and are
   * not the exponent of a number. */
  std::set<std::string> names_in(const std::string &formula);

  /** Text split at each @p separator outside parentheses, blanks around the
   * parts removed; empty parts are kept, an empty text has none. */
  std::vector<std::string> split_list(const std::string &text, char separator);
} // namespace abut::app

#endif
