// SPDX-License-Identifier: LGPL-2.1-or-later
#include "condensed_matrix.h"

#include "elimination.h"

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  void CondensedMatrix::reinit(const Stiffness &stiffness,
                               const PointOperator &rows)
  {
    stiffness_ = stiffness;
    rows_ = &rows;
    row_values_.assign(rows.n_rows(), 0.);
    expanded_.reinit(rows.owned(), rows.communicator());
    condensate_ = {};
    pivot_rows_.clear();
    has_springs_ = has_pivots_ = false;
  }

  void CondensedMatrix::set(const Condensate &condensate)
  {
    condensate_ = condensate;
    pivot_rows_.clear();
    unsigned int has[2] = {0, 0};
    for (int i = 0; i < rows_->n_rows(); ++i)
    {
      if (condensate_.pivot[i] != Condensate::none)
        pivot_rows_.push_back(i);
      has[0] |= condensate_.stiffness[i] != 0.;
    }
    for (const double spring : condensate_.spring)
      has[0] |= spring != 0.;
    has[1] = pivot_rows_.empty() ? 0 : 1;
    MPI::max(has, rows_->communicator(), has);
    has_springs_ = has[0] != 0;
    has_pivots_ = has[1] != 0;
  }

  void CondensedMatrix::zero_pivots(la::Vector &vector) const
  {
    double *const values = la::data(vector);
    for (const int i : pivot_rows_)
      values[rows_->column(condensate_.pivot[i])] = 0.;
  }

  template <typename Function>
  void CondensedMatrix::for_each_pivot(const Function &function) const
  {
    const RowBlocks &blocks = condensate_.blocks;
    for (int block = 0; block < blocks.n_blocks(); ++block)
      for (int r = 0, k = blocks.size(block); r < k; ++r)
        if (condensate_.pivot[blocks.first[block] + r] != Condensate::none)
          function(blocks.first[block] + r, blocks.first[block], k,
                   blocks.at[block] + std::int64_t(r) * k);
  }

  void CondensedMatrix::expand(la::Vector &u) const
  {
    if (!has_pivots_)
      return;
    zero_pivots(u);
    rows_->times(u, row_values_.data());
    double *const values = la::data(u);
    if (has_blocks())
    {
      for_each_pivot(
          [&](const int i, const int first, const int k, const std::int64_t at)
          {
            double sum = 0.;
            for (int c = 0; c < k; ++c)
              sum += condensate_.trial[at + c] * row_values_[first + c];
            values[rows_->column(condensate_.pivot[i])] = -sum;
          });
      return;
    }
    for (const int i : pivot_rows_)
    {
      const std::int64_t e = condensate_.pivot[i];
      values[rows_->column(e)] = -row_values_[i] / rows_->coefficient(e);
    }
  }

  void CondensedMatrix::restrict(la::Vector &f) const
  {
    if (!has_pivots_)
      return;
    const double *const values = la::data(f);
    std::fill(row_values_.begin(), row_values_.end(), 0.);
    if (has_blocks())
      for_each_pivot(
          [&](const int i, const int first, const int k, const std::int64_t at)
          {
            const double force = values[rows_->column(condensate_.pivot[i])];
            for (int c = 0; c < k; ++c)
              row_values_[first + c] -= condensate_.test[at + c] * force;
          });
    else
      for (const int i : pivot_rows_)
      {
        const std::int64_t e = condensate_.pivot[i];
        row_values_[i] = -values[rows_->column(e)] / rows_->coefficient(e);
      }
    rows_->add_transposed(row_values_.data(), f);
    zero_pivots(f);
  }

  void CondensedMatrix::multiply_whole(la::Vector &dst,
                                       const la::Vector &src) const
  {
    stiffness_.vmult(dst, src);
    if (!has_springs_)
      return;
    rows_->times(src, row_values_.data());
    apply_springs(row_values_);
    rows_->add_transposed(row_values_.data(), dst);
  }

  void CondensedMatrix::vmult(la::Vector &dst, const la::Vector &src) const
  {
    if (!has_pivots_)
    {
      multiply_whole(dst, src);
      return;
    }
    expanded_ = src;
    expand(expanded_);
    multiply_whole(dst, expanded_);
    restrict(dst);
  }

  void CondensedMatrix::apply_springs(std::vector<double> &row_values) const
  {
    if (!has_blocks())
    {
      for (int i = 0; i < rows_->n_rows(); ++i)
        row_values[i] *= condensate_.stiffness[i];
      return;
    }
    const RowBlocks &blocks = condensate_.blocks;
    for (int block = 0; block < blocks.n_blocks(); ++block)
    {
      const int k = blocks.size(block);
      double *const value = &row_values[blocks.first[block]];
      const double *const spring = &condensate_.spring[blocks.at[block]];
      double result[ABUT_CONDENSE_COMPONENTS] = {};
      for (int r = 0; r < k; ++r)
        for (int c = 0; c < k; ++c)
          result[r] += spring[r * k + c] * value[c];
      std::copy_n(result, k, value);
    }
  }

  template <typename Visit>
  void CondensedMatrix::visit_spring(const int row, const int other,
                                     const double stiffness,
                                     const Visit &visit) const
  {
    std::vector<dealii::types::global_dof_index> columns;
    rows_->get_columns(other, columns);
    std::vector<double> values(columns.size());
    for (auto e = rows_->begin(row); e < rows_->end(row); ++e)
    {
      for (auto f = rows_->begin(other); f < rows_->end(other); ++f)
        values[f - rows_->begin(other)] =
            stiffness * rows_->coefficient(e) * rows_->coefficient(f);
      visit(rows_->global_column(rows_->column(e)), columns, values);
    }
  }

  template <typename Visit>
  void CondensedMatrix::for_each_spring(const Visit &visit) const
  {
    if (!has_blocks())
      for (int i = 0; i < rows_->n_rows(); ++i)
        if (condensate_.stiffness[i] != 0.)
          visit_spring(i, i, condensate_.stiffness[i], visit);
    const RowBlocks &blocks = condensate_.blocks;
    for (int block = 0; has_blocks() && block < blocks.n_blocks(); ++block)
      for (int r = 0, k = blocks.size(block); r < k; ++r)
        for (int c = 0; c < k; ++c)
        {
          const double spring =
              condensate_.spring[blocks.at[block] + r * k + c];
          if (spring != 0.)
            visit_spring(blocks.first[block] + r, blocks.first[block] + c,
                         spring, visit);
        }
  }

  MatrixLines CondensedMatrix::springs() const
  {
    MatrixLines result;
    for_each_spring([&](const auto row, const auto &columns, const auto &values)
                    { result.add(row, columns, values); });
    return result;
  }

  void CondensedMatrix::for_each_term(const VisitLine &visit) const
  {
    if (has_springs_)
      for_each_spring(visit);
    if (has_springs_ && has_pivots_)
    {
      KeptMatrix whole;
      whole.set(stiffness_.matrix());
      whole.add(springs());
      for_each_elimination_term(whole.matrix(), *rows_, condensate_, visit);
    }
    else if (has_pivots_)
      for_each_elimination_term(stiffness_.matrix(), *rows_, condensate_,
                                visit);
  }

  void CondensedMatrix::eliminate(KeptMatrix &whole) const
  {
    MatrixLines terms;
    for_each_elimination_term(
        whole.matrix(), *rows_, condensate_,
        [&](const auto row, const auto &columns, const auto &values)
        { terms.add(row, columns, values); });
    whole.add(terms);
    const std::vector<double> diagonal =
        la::diagonal(la::local_rows(stiffness_.matrix()));
    const la::LocalRows lines = la::local_rows(whole.matrix());
    for (const int i : pivot_rows_)
    {
      const int line = rows_->column(condensate_.pivot[i]);
      for (int k = lines.start[line]; k < lines.start[line + 1]; ++k)
        lines.value[k] = lines.column[k] == line ? diagonal[line] : 0.;
    }
  }

  void CondensedMatrix::assemble(KeptMatrix &result) const
  {
    result.set(stiffness_.matrix());
    if (has_springs_)
      result.add(springs());
    if (has_pivots_)
      eliminate(result);
  }
} // namespace abut::solve
