// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_HOST_MATRIX_H
#define ABUT_DEALII_HOST_MATRIX_H

/** @file
 * Matrices of hosts that are not of Abut's type: deal.II's SparseMatrix and
 * BlockSparseMatrix, PETScWrappers::MPI::SparseMatrix and the block matrices of
 * Trilinos and PETSc. Abut copies their values into a matrix of its own, whose
 * pattern it keeps; a type is only known in this header, on the host's side.
 */

#include <abut/dealii/host_vector.h>

#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace abut::la
{
  /** Functions of a host's matrix that Abut needs. */
  class HostMatrix
  {
  public:
    /** Number of a row or column. */
    using Index = dealii::types::global_dof_index;

    virtual ~HostMatrix() = default;

    /** Number of rows on all ranks. */
    virtual Index m() const = 0;

    /** Number of columns. */
    virtual Index n() const = 0;

    /** Rows of this rank. */
    virtual const dealii::IndexSet &rows() const = 0;

    /** Where the entries of rows() are, row by row in the order in which
     * values() goes through them: [rows + 1] their @p start, and their
     * @p column. */
    virtual void pattern(std::vector<std::size_t> &start,
                         std::vector<Index> &column) const = 0;

    /** Findings of values(). */
    struct Pass
    {
      bool fits = true; ///< the pattern is the one given
      Index row = dealii::numbers::invalid_dof_index; ///< with a value that is
                                                      ///< not finite
    };

    /** One pass over the entries of rows(): write entry k to target[place[k]],
     * if they are at the places of @p start and @p column. */
    virtual Pass values(const std::vector<std::size_t> &start,
                        const std::vector<Index> &column,
                        const std::vector<int> &place,
                        double *target) const = 0;

    /** Add values to one row, which may be that of another rank. */
    virtual void add(Index row, const std::vector<Index> &columns,
                     const std::vector<double> &values) const = 0;

    /** To be called after add(). Collective. */
    virtual void compress() const = 0;
  };

  /** @cond */
  namespace internal
  {
    template <typename M>
    using Rows = decltype(std::declval<const M &>().begin(0));
    template <typename M>
    using BlockRows = decltype(std::declval<const M &>().block(0, 0));
    template <typename M>
    using Range =
        decltype(std::declval<const M &>().locally_owned_range_indices());
    template <typename M>
    using Compressible =
        decltype(std::declval<M &>().compress(dealii::VectorOperation::add));
    template <typename M>
    using Empty = decltype(std::declval<const M &>().empty());
    template <typename M> using Sized = decltype(std::declval<const M &>().m());

    template <typename M>
    constexpr bool is_host_matrix =
        !std::is_same<M, Matrix>::value && Has<Sized, M>::value
        && (Has<Rows, M>::value || Has<BlockRows, M>::value);

    /** First row of this rank and the one after its last. */
    template <typename M>
    std::pair<HostMatrix::Index, HostMatrix::Index> row_range(const M &matrix)
    {
      if constexpr (Has<Range, M>::value)
        return la::row_range(matrix);
      else
        return {0, matrix.m()};
    }
  } // namespace internal
  /** @endcond */

  /** A host's matrix of type @p M, which it refers to. */
  template <typename M> class HostMatrixOf : public HostMatrix
  {
  public:
    static_assert(std::is_same<typename M::value_type, double>::value,
                  "Abut takes matrices of double values, real ones.");

    /** For a matrix that must stay where it is. O(rows of blocks). */
    explicit HostMatrixOf(const M &matrix) : matrix_(matrix)
    {
      rows_.set_size(m());
      if (m() == 0)
        return;
      if constexpr (has_blocks)
        for (unsigned int b = 0, first = 0; b < matrix.n_block_rows(); ++b)
        {
          const auto [begin, end] = internal::row_range(matrix.block(b, 0));
          rows_.add_range(first + begin, first + end);
          first += matrix.block(b, 0).m();
        }
      else
      {
        const auto [begin, end] = internal::row_range(matrix);
        rows_.add_range(begin, end);
      }
      rows_.compress();
    }

    Index m() const override
    {
      return is_empty() ? 0 : matrix_.m();
    }

    Index n() const override
    {
      return is_empty() ? 0 : matrix_.n();
    }

    const dealii::IndexSet &rows() const override
    {
      return rows_;
    }

    void pattern(std::vector<std::size_t> &start,
                 std::vector<Index> &column) const override
    {
      start.assign(1, 0);
      column.clear();
      for_each_row(
          [&](const auto &for_each_entry)
          {
            for_each_entry([&](const Index j, double) { column.push_back(j); });
            start.push_back(column.size());
            return true;
          });
    }

    Pass values(const std::vector<std::size_t> &start,
                const std::vector<Index> &column, const std::vector<int> &place,
                double *target) const override
    {
      Pass pass;
      std::size_t row = 0;
      pass.fits = start.size() == rows_.n_elements() + 1;
      if (!pass.fits)
        return pass;
      for_each_row(
          [&](const auto &for_each_entry)
          {
            std::size_t k = start[row];
            const std::size_t end = start[row + 1];
            double zero = 0.;
            for_each_entry(
                [&](const Index j, const double value)
                {
                  pass.fits = pass.fits && k < end && column[k] == j;
                  if (!pass.fits)
                    return;
                  target[place[k]] = value;
                  zero += 0. * value;
                  ++k;
                });
            pass.fits = pass.fits && k == end;
            if (zero != 0. && pass.row == dealii::numbers::invalid_dof_index)
              pass.row = rows_.nth_index_in_set(row);
            ++row;
            return pass.fits;
          });
      return pass;
    }

    void add(const Index row, const std::vector<Index> &columns,
             const std::vector<double> &values) const override
    {
      const_cast<M &>(matrix_).add(row, columns.size(), columns.data(),
                                   values.data(), false);
    }

    void compress() const override
    {
      if constexpr (internal::Has<internal::Compressible, M>::value)
        const_cast<M &>(matrix_).compress(dealii::VectorOperation::add);
    }

  private:
    static constexpr bool has_blocks =
        internal::Has<internal::BlockRows, M>::value;

    /** Whether the matrix has no pattern yet. */
    bool is_empty() const
    {
      if constexpr (internal::Has<internal::Empty, M>::value && !has_blocks)
        return matrix_.empty();
      else
        return false;
    }

    /** Entries of a row of one matrix without blocks. */
    template <typename Part, typename Visit>
    static void visit_row(const Part &part, const Index row, const Index first,
                          const Visit &visit)
    {
      const auto end = part.end(row);
      for (auto entry = part.begin(row); entry != end; ++entry)
        visit(first + entry->column(), entry->value());
    }

    /** Calls visit(for_each_entry) for each row of this rank, while it returns
     * true. */
    template <typename Visit> void for_each_row(const Visit &visit) const
    {
      if constexpr (has_blocks)
        for (unsigned int b = 0; b < matrix_.n_block_rows(); ++b)
        {
          const auto [begin, end] = internal::row_range(matrix_.block(b, 0));
          for (Index i = begin; i < end; ++i)
            if (!visit(
                    [&](const auto &entry)
                    {
                      Index first = 0;
                      for (unsigned int c = 0; c < matrix_.n_block_cols(); ++c)
                      {
                        visit_row(matrix_.block(b, c), i, first, entry);
                        first += matrix_.block(b, c).n();
                      }
                    }))
              return;
        }
      else
      {
        const auto [begin, end] = internal::row_range(matrix_);
        for (Index i = begin; i < end; ++i)
          if (!visit([&](const auto &entry)
                     { visit_row(matrix_, i, 0, entry); }))
            return;
      }
    }

    const M &matrix_;
    dealii::IndexSet rows_;
  };

  /** A matrix of a host that contact terms are added to. Refers to it, and is
   * only made as an argument. */
  class MatrixTarget
  {
  public:
    /** Abut's own type. */
    MatrixTarget(Matrix &matrix) : native_(&matrix)
    {
    }

    /** Any other one. */
    template <typename M,
              typename = std::enable_if_t<internal::is_host_matrix<M>>>
    MatrixTarget(M &matrix) : host_(std::make_shared<HostMatrixOf<M>>(matrix))
    {
    }

    /** Number of rows. */
    dealii::types::global_dof_index m() const
    {
      return native_ != nullptr ? native_->m() : host_->m();
    }

    /** The matrix itself where it is of Abut's type, else null. */
    Matrix *native() const
    {
      return native_;
    }

    /** One of another type, else null. */
    std::shared_ptr<const HostMatrix> host() const
    {
      return host_;
    }

    /** Add values to one row, which may be that of another rank. */
    void add(const dealii::types::global_dof_index row,
             const std::vector<dealii::types::global_dof_index> &columns,
             const std::vector<double> &values) const
    {
      if (native_ != nullptr)
        la::add(*native_, row, columns, values);
      else
        host_->add(row, columns, values);
    }

    /** To be called after add(). Collective. */
    void compress() const
    {
      if (native_ != nullptr)
        native_->compress(dealii::VectorOperation::add);
      else
        host_->compress();
    }

  private:
    Matrix *native_ = nullptr;
    std::shared_ptr<HostMatrix> host_;
  };
} // namespace abut::la

#endif
