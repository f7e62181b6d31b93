/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/dealii/linear_algebra.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Vector.h>

#include <algorithm>

namespace abut::la
{
  LocalRows local_rows(const Matrix &matrix)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    LocalRows rows;
    int *start = nullptr;
    int *column = nullptr;
    const int status = epetra.ExtractCrsDataPointers(start, column, rows.value);
    AssertThrow(status == 0,
                dealii::ExcMessage("The matrix must be compressed before "
                                   "its rows are read."));
    rows.start = start;
    rows.column = column;
    rows.n_rows = epetra.NumMyRows();
    rows.n_columns = epetra.NumMyCols();

    // Epetra numbers owned columns first and in the order of the rows when
    // every diagonal entry is present. All loops here rely on that.
    const int *const row_ids = epetra.RowMap().MyGlobalElements();
    const int *const column_ids = epetra.ColMap().MyGlobalElements();
    AssertThrow(rows.n_columns >= rows.n_rows
                    && std::equal(row_ids, row_ids + rows.n_rows, column_ids),
                dealii::ExcMessage("The matrix lacks diagonal entries: build "
                                   "its pattern with them."));
    return rows;
  }

  std::vector<double> gather(const Matrix &matrix, const Vector &owned)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    std::vector<double> values(epetra.NumMyCols());
    if (epetra.Importer() == nullptr)
    {
      std::copy(owned.begin(), owned.end(), values.begin());
      return values;
    }
    Epetra_Vector columns(View, epetra.ColMap(), values.data());
    const int status =
        columns.Import(owned.trilinos_vector(), *epetra.Importer(), Insert);
    AssertThrow(status == 0, dealii::ExcMessage("Epetra import failed."));
    return values;
  }

  dealii::types::global_dof_index global_column(const Matrix &matrix,
                                                const int column)
  {
    return static_cast<dealii::types::global_dof_index>(
        matrix.trilinos_matrix().GCID64(column));
  }

  std::vector<double> diagonal(const LocalRows &rows)
  {
    std::vector<double> result(rows.n_rows, 0.);
    for (int i = 0; i < rows.n_rows; ++i)
      for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        if (rows.column[k] == i)
          result[i] = rows.value[k];
    return result;
  }
} // namespace abut::la
