// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_NODE_MAP_H
#define ABUT_SOLVE_NODE_MAP_H

#include <deal.II/base/types.h>

#include <cstddef>
#include <vector>

namespace abut::solve
{
  /** The unknowns of nodes: unknown k of node l is a sum of factors times free
   * unknowns of the matrix, and a constant. Supports, hanging nodes and
   * prescribed values are put in here, once per node, and nowhere else. The
   * kind of these unknowns does not matter. Rigid obstacles have none: where
   * forces put them is found outside of the contact problem. */
  class NodeMap
  {
  public:
    using Index = dealii::types::global_dof_index;

    /** Factor times a free unknown. */
    struct Term
    {
      Index unknown;
      double factor;
    };

    /** No nodes yet; each will have @p dimension unknowns. */
    explicit NodeMap(const unsigned int dimension = 1) : dimension_(dimension)
    {
    }

    /** Unknown k of node l is number @p first + l * @p dimension + k itself. */
    static NodeMap numbered(const Index first, const unsigned int dimension = 1)
    {
      NodeMap map(dimension);
      map.is_numbered_ = true;
      map.first_ = first;
      return map;
    }

    /** Append the next unknown: of the last node, or the first of a new one. */
    template <typename Terms>
    void append(const Terms &terms, const double constant)
    {
      for (const Term &term : terms)
        terms_.push_back(term);
      start_.push_back(terms_.size());
      constant_.push_back(constant);
    }

    unsigned int dimension() const
    {
      return dimension_;
    }

    /** Call function(unknown, factor) for the terms of an unknown of a node. */
    template <typename Function>
    void for_each_term(const std::size_t node, const unsigned int component,
                       const Function &function) const
    {
      const std::size_t n = node * dimension_ + component;
      if (is_numbered_)
        function(first_ + n, 1.);
      else
        for (std::size_t t = start_[n]; t < start_[n + 1]; ++t)
          function(terms_[t].unknown, terms_[t].factor);
    }

    /** The constant of an unknown of a node. */
    double constant(const std::size_t node, const unsigned int component) const
    {
      return is_numbered_ ? 0. : constant_[node * dimension_ + component];
    }

    /** Prescribe another value. */
    void set_constant(const std::size_t node, const unsigned int component,
                      const double value)
    {
      constant_[node * dimension_ + component] = value;
    }

    /** Whether an unknown of a node is this free one alone. */
    bool is_itself(const std::size_t node, const unsigned int component,
                   const Index unknown) const
    {
      const std::size_t n = node * dimension_ + component;
      return is_numbered_ ? unknown == first_ + n
                          : start_[n + 1] == start_[n] + 1
                                && terms_[start_[n]].unknown == unknown;
    }

  private:
    unsigned int dimension_;
    bool is_numbered_ = false;
    Index first_ = 0;                      ///< if numbered
    std::vector<std::size_t> start_ = {0}; ///< [unknowns of nodes + 1]
    std::vector<Term> terms_;              ///< [start_.back()]
    std::vector<double> constant_;         ///< [unknowns of nodes]
  };
} // namespace abut::solve

#endif
