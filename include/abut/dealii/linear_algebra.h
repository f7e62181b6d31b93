/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_DEALII_LINEAR_ALGEBRA_H
#define ABUT_DEALII_LINEAR_ALGEBRA_H

/** @file
 * The one place that names linear-algebra types. Everything else uses
 * la::Matrix and la::Vector, which are of the Trilinos stack that deal.II's
 * TrilinosWrappers are made of: Epetra, or Tpetra where Trilinos has no Epetra.
 * Their differences are in plugin/solve/epetra and plugin/solve/tpetra. */

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

/** Linear-algebra types and the little that depends on their inside. */
namespace abut::la
{
  /** Distributed sparse matrix, rows by owned unknowns. */
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /** Distributed vector, with or without ghost entries. */
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /** The rows of a matrix on this rank as compressed rows. Columns are
   * local: column < n_rows is the owned unknown of that number, larger
   * ones are ghosts in the order of gather(). Valid while the matrix lives
   * and its pattern does not change. */
  struct LocalRows
  {
    int n_rows = 0;              /**< rows on this rank */
    int n_columns = 0;           /**< rows and ghosts */
    const int *start = nullptr;  /**< [n_rows + 1] */
    const int *column = nullptr; /**< [start[n_rows]] */
    double *value = nullptr;     /**< [start[n_rows]] */
    /** The array of start, where the matrix has numbers of another width. */
    std::shared_ptr<const std::vector<int>> copied_start;
  };

  /** View of the rows on this rank; the matrix must have been compressed.
   * O(n_rows) because the order of columns is checked. */
  LocalRows local_rows(const Matrix &matrix);

  /** Copy of the owned entries and the ghosts that the rows of @p matrix
   * on this rank touch, in the order of LocalRows. Collective. */
  std::vector<double> gather(const Matrix &matrix, const Vector &owned);

  /** Global number of a local column. */
  dealii::types::global_dof_index global_column(const Matrix &matrix,
                                                int column);

  /** Rows of this rank. (Of a Tpetra matrix deal.II 9.8 has a wrong set where
   * a rank has none.) */
  template <typename M> dealii::IndexSet owned_rows(const M &matrix)
  {
    return matrix.local_size() == 0 ? dealii::IndexSet(matrix.m())
                                    : matrix.locally_owned_range_indices();
  }

  /** First row of this rank and the one after its last. (Of a Tpetra matrix
   * deal.II 9.8 has local numbers in local_range().) */
  template <typename M>
  std::pair<dealii::types::global_dof_index, dealii::types::global_dof_index>
  row_range(const M &matrix)
  {
    const dealii::IndexSet rows = owned_rows(matrix);
    if (rows.n_elements() == 0)
      return {0, 0};
    const auto first = rows.nth_index_in_set(0);
    return {first, first + rows.n_elements()};
  }

  /** One after the last row of each rank, ascending: what owns a row is the
   * first rank with an end beyond it. Collective. */
  std::vector<dealii::types::global_dof_index> row_ends(const Matrix &matrix);

  /** Diagonal of the rows on this rank, [n_rows]. */
  std::vector<double> diagonal(const LocalRows &rows);

  /** Copy of a matrix: the pattern, too. Collective. */
  void copy(const Matrix &from, Matrix &to);

  /** Add values to one row, which may be that of another rank: then the matrix
   * must be compressed. */
  inline void add(Matrix &matrix, const dealii::types::global_dof_index row,
                  const std::vector<dealii::types::global_dof_index> &columns,
                  const std::vector<double> &values)
  {
    matrix.add(row, columns.size(), columns.data(), values.data(), false);
  }

  /** Sum of two matrices with the same rows on each rank, the first of which
   * has all diagonal entries. Where the second is empty this is no more than
   * a copy. Collective. */
  Matrix sum(const Matrix &first, const Matrix &second);

  /** Numbers from 0 for @p n things on this rank, those of lower ranks coming
   * first. Collective. */
  dealii::IndexSet number(dealii::types::global_dof_index n,
                          MPI_Comm communicator);

  /** A square matrix with rows and columns @p owned, from lines that may be
   * in the rows @p ghosts of other ranks too: @p for_each_line(visit) must
   * call visit(row, columns, values) for each, with vectors of numbers and
   * values, the same both times that it is called; equal places add up.
   * Collective. */
  template <typename ForEachLine>
  Matrix assemble(const dealii::IndexSet &owned, const dealii::IndexSet &ghosts,
                  const MPI_Comm communicator, const ForEachLine &for_each_line)
  {
    using Index = dealii::types::global_dof_index;
    using Indices = std::vector<Index>;
    dealii::IndexSet touched = owned;
    touched.add_indices(ghosts);
    dealii::DynamicSparsityPattern pattern(owned.size(), owned.size(), touched);
    for_each_line(
        [&](const Index row, const Indices &columns,
            const std::vector<double> &)
        { pattern.add_entries(row, columns.begin(), columns.end()); });
    dealii::SparsityTools::distribute_sparsity_pattern(pattern, owned,
                                                       communicator, touched);
    Matrix matrix;
    matrix.reinit(owned, owned, pattern, communicator);
    for_each_line([&](const Index row, const Indices &columns,
                      const std::vector<double> &values)
                  { add(matrix, row, columns, values); });
    matrix.compress(dealii::VectorOperation::add);
    return matrix;
  }

  /** @cond */
  namespace internal
  {
    /** Whether a type has what an expression with it needs. */
    template <template <typename> class Expression, typename T, typename = void>
    struct Has : std::false_type
    {
    };
    template <template <typename> class Expression, typename T>
    struct Has<Expression, T, std::void_t<Expression<T>>> : std::true_type
    {
    };

    template <typename V>
    using Pointer = std::enable_if_t<
        std::is_pointer<decltype(std::declval<const V &>().begin())>::value>;

    template <typename V> auto *first_entry(V &vector)
    {
      if constexpr (Has<Pointer, V>::value)
        return vector.begin();
      else if constexpr (std::is_const<V>::value)
        return vector.trilinos_vector().getData().getRawPtr();
      else
        return vector.trilinos_vector().getDataNonConst().getRawPtr();
    }
  } // namespace internal
  /** @endcond */

  /** The owned entries of a vector without ghosts. */
  inline double *data(Vector &vector)
  {
    return internal::first_entry(vector);
  }

  /** The owned entries of a vector without ghosts. */
  inline const double *data(const Vector &vector)
  {
    return internal::first_entry(vector);
  }

  /** Number of owned entries. */
  inline int n_owned(const Vector &vector)
  {
    return static_cast<int>(vector.locally_owned_size());
  }
} // namespace abut::la

#endif
