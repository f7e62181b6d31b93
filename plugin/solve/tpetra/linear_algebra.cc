/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/dealii/linear_algebra.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>

#include <algorithm>

namespace abut::la
{
  namespace
  {
    /** Tpetra numbers owned columns first and in the order of the rows when
     * every diagonal entry is present. All loops over rows rely on that. */
    template <typename TpetraMatrix>
    bool has_owned_columns_first(const TpetraMatrix &tpetra)
    {
      const auto &rows = *tpetra.getRowMap();
      const auto &columns = *tpetra.getColMap();
      const int n = static_cast<int>(rows.getLocalNumElements());
      if (static_cast<int>(columns.getLocalNumElements()) < n)
        return false;
      for (int i = 0; i < n; ++i)
        if (rows.getGlobalElement(i) != columns.getGlobalElement(i))
          return false;
      return true;
    }
  } // namespace

  LocalRows local_rows(const Matrix &matrix)
  {
    const auto &tpetra = matrix.trilinos_matrix();
    AssertThrow(tpetra.getCrsGraph()->isFillComplete(),
                dealii::ExcMessage("The matrix must be compressed before "
                                   "its rows are read."));
    const auto local = tpetra.getLocalMatrixHost();
    LocalRows rows;
    rows.n_rows = static_cast<int>(tpetra.getLocalNumRows());
    rows.n_columns = static_cast<int>(tpetra.getLocalNumCols());
    const auto *const start = local.graph.row_map.data();
    rows.copied_start =
        start == nullptr
            ? std::make_shared<const std::vector<int>>(rows.n_rows + 1, 0)
            : std::make_shared<const std::vector<int>>(start,
                                                       start + rows.n_rows + 1);
    rows.start = rows.copied_start->data();
    rows.column = local.graph.entries.data();
    rows.value = local.values.data();
    AssertThrow(has_owned_columns_first(tpetra),
                dealii::ExcMessage("The matrix lacks diagonal entries: build "
                                   "its pattern with them."));
    return rows;
  }

  std::vector<double> gather(const Matrix &matrix, const Vector &owned)
  {
    const auto &tpetra = matrix.trilinos_matrix();
    const auto importer = tpetra.getCrsGraph()->getImporter();
    if (importer.is_null())
      return std::vector<double>(data(owned), data(owned) + n_owned(owned));
    using TpetraVector =
        std::decay_t<decltype(std::declval<Vector &>().trilinos_vector())>;
    TpetraVector columns(tpetra.getColMap(), false);
    columns.doImport(owned.trilinos_vector(), *importer, Tpetra::INSERT);
    const auto values = columns.getData();
    return std::vector<double>(values.begin(), values.end());
  }

  void copy(const Matrix &from, Matrix &to)
  {
    // After deal.II's copy_from() compress() takes columns for the domain, and
    // its reinit() does not compress what was compressed before.
    to = Matrix();
    to.reinit(from);
    const LocalRows rows = local_rows(from);
    std::copy_n(rows.value, rows.start[rows.n_rows], local_rows(to).value);
  }

  Matrix sum(const Matrix &first, const Matrix &second)
  {
    Matrix result;
    copy(first, result);
    result.add(1., second);
    return result;
  }

  dealii::types::global_dof_index global_column(const Matrix &matrix,
                                                const int column)
  {
    return static_cast<dealii::types::global_dof_index>(
        matrix.trilinos_matrix().getColMap()->getGlobalElement(column));
  }
} // namespace abut::la
