// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BOUNDARY_EXPRESSIONS_H
#define ABUT_APP_BOUNDARY_EXPRESSIONS_H

/** @file
 * Boundary values of a scene file: formulas by boundary id.
 */

#include "boundary_names.h"
#include "expression.h"

#include <deal.II/base/types.h>
#include <deal.II/fe/component_mask.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** A function on a part of the boundary and its components that count. */
  template <int dim> struct BoundaryCondition
  {
    const Expression<dim> *function;
    dealii::ComponentMask components;
    /** The function, which throws InputError where it is not finite. */
    const dealii::Function<dim> *checked = nullptr;
  };

  /** A list such as `0: 0; 1, 3: x^2; *: sin(pi*y)`: what stands for an id
   * itself wins over `*`, which means all other ids of the mesh; ids may be
   * names. Empty: none.
   * The components of a vector are separated by commas, `0: x, y; 1: 0, 5`,
   * and the word `free` stands for one without condition, `2: 0, free`. */
  template <int dim> class BoundaryExpressions
  {
  public:
    /** Read the list; throws InputError that names @p parameter.
     * @param may_be_free whether the word `free` is allowed */
    BoundaryExpressions(const std::string &text, const std::string &parameter,
                        unsigned int n_components = 1,
                        bool may_be_free = false);

    /** Conditions by id; they live as long as this object. Throws InputError
     * for a word that is not among @p existing, with those that are, and for
     * an id that several words mean.
     * @param without ids that `*` does not mean (those of other conditions) */
    std::map<dealii::types::boundary_id, BoundaryCondition<dim>>
    conditions(const BoundaryNames &existing,
               const std::set<dealii::types::boundary_id> &without = {}) const;

    /** The functions of conditions(), as deal.II's
     * interpolate_boundary_values() wants them; they throw InputError where
     * they are not finite. */
    std::map<dealii::types::boundary_id, const dealii::Function<dim> *>
    functions(const BoundaryNames &existing,
              const std::set<dealii::types::boundary_id> &without = {}) const;

    /** Time of all formulas. */
    void set_time(double time);

    /** Whether any formula depends on time. */
    bool depends_on_time() const;

    /** Whether no formula has variables. */
    bool is_constant() const;

    /** Ids that the list names themselves, not by `*`. Throws InputError for
     * words that are not among @p existing. */
    std::set<dealii::types::boundary_id>
    named(const BoundaryNames &existing) const;

    bool empty() const
    {
      return entries.empty();
    }

  private:
    struct Entry
    {
      bool others;                    /**< `*` */
      std::vector<std::string> words; /**< ids and names */
      std::unique_ptr<Expression<dim>> expression;
      dealii::ComponentMask components;
      std::unique_ptr<CheckedExpression<dim>> checked;
    };
    void set_formulas(Entry &entry, const std::string &text,
                      unsigned int n_components, bool may_be_free) const;

    std::string parameter;
    std::vector<Entry> entries;
  };

  /** Boundary ids `0, 2`, or `*` for all; throws InputError that
   * names @p parameter for what is not one or is not among @p existing. */
  std::set<dealii::types::boundary_id>
  parse_boundary_ids(const std::string &text, const std::string &parameter,
                     const BoundaryNames &existing);
} // namespace abut::app

#endif
