// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_PAIR_MEASURES_H
#define ABUT_DEALII_PAIR_MEASURES_H

#include <abut/dealii/contact_pair.h>

#include <type_traits>
#include <variant>
#include <vector>

namespace abut
{
  /** How the ranks' parts of a quantity are put together. */
  enum class Reduction
  {
    sum,     /**< of all ranks */
    maximum, /**< over ranks */
    minimum  /**< over ranks */
  };

  /** Pairs that a quantity is reported of. */
  enum class ReportedOf
  {
    all_pairs, /**< with or without friction */
    friction,  /**< pairs with friction */
    none       /**< other quantities are made of it */
  };

  /** A quantity of a pair: how ranks put it together, and how reports name
   * it. */
  template <int dim> struct PairMeasure
  {
    template <typename T> using Member = T PairResult<dim>::*; ///< its place
    using Number = dealii::types::global_dof_index;            ///< a count
    using Vector = dealii::Tensor<1, dim>;                     ///< a force
    using Moment = dealii::Tensor<1, 3>;                       ///< about 0

    const char *name; ///< in summary.json behind pair_N_
    std::conditional_t<
        dim == 3, std::variant<Member<double>, Member<Number>, Member<Vector>>,
        std::variant<Member<double>, Member<Number>, Member<Vector>,
                     Member<Moment>>>
        value;           ///< member of PairResult
    Reduction reduction; ///< over ranks
    ReportedOf reported; ///< in summary.json
    const char *unit;    ///< "force", "" of a number
    const char *text;    ///< a part of a sentence
  };

  /** All quantities of a pair that ranks put together, in the order of
   * reports. A new one is a member of PairResult, a line of this table, and
   * the place that measures it. */
  template <int dim> const std::vector<PairMeasure<dim>> &pair_measures();
} // namespace abut

#endif
