// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_BOUNDARY_EXPRESSIONS_H
#define ABUT_APP_BOUNDARY_EXPRESSIONS_H

/** @file
 * Boundary values of a scene file: formulas by boundary id.
 */

#include "expression.h"

#include <deal.II/base/types.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace abut::app
{
  /** A list such as `0: 0; 1, 3: x^2; *: sin(pi*y)`: what stands for an id
   * itself wins over `*`, which means all other ids of the mesh. Empty: none.
   */
  template <int dim> class BoundaryExpressions
  {
  public:
    /** Read the list; throws InputError that names @p parameter. */
    BoundaryExpressions(const std::string &text, const std::string &parameter,
                        unsigned int n_components = 1);

    /** Functions by id, as deal.II's interpolate_boundary_values() wants them;
     * they live as long as this object. Throws InputError for an id that the
     * mesh does not have, with those that it has.
     * @param without ids that `*` does not mean (those of other conditions) */
    std::map<dealii::types::boundary_id, const dealii::Function<dim> *>
    functions(const dealii::Triangulation<dim> &triangulation,
              const std::set<dealii::types::boundary_id> &without = {}) const;

    /** Time of all formulas. */
    void set_time(double time);

    /** Whether any formula depends on time. */
    bool depends_on_time() const;

    bool empty() const
    {
      return entries.empty();
    }

  private:
    struct Entry
    {
      bool others; /**< `*` */
      std::set<dealii::types::boundary_id> ids;
      std::unique_ptr<Expression<dim>> expression;
    };
    std::string parameter;
    std::vector<Entry> entries;
  };

  /** Boundary ids `0, 2`, or `*` for all of the mesh; throws InputError that
   * names @p parameter for what is not one or what the mesh does not have. */
  template <int dim>
  std::set<dealii::types::boundary_id>
  parse_boundary_ids(const std::string &text, const std::string &parameter,
                     const dealii::Triangulation<dim> &triangulation);
} // namespace abut::app

#endif
