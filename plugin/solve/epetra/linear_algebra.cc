/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/dealii/linear_algebra.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Import.h>
#include <Epetra_Map.h>
#include <Epetra_Vector.h>

#include <algorithm>
#include <unordered_map>

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

  namespace
  {
    /** One term of a sum: its rows, and its columns in those of the sum. */
    struct Term
    {
      const Epetra_CrsMatrix *matrix;
      std::vector<int> column;
    };

    /** Columns of a sum: those of the first term, then those that others
     * add. */
    Epetra_Map union_of_columns(std::vector<Term> &terms)
    {
      const Epetra_CrsMatrix &first = *terms[0].matrix;
      const int n = first.NumMyCols();
      std::vector<int> ids(first.ColMap().MyGlobalElements(),
                           first.ColMap().MyGlobalElements() + n);
      std::unordered_map<int, int> added;
      for (Term &term : terms)
      {
        const Epetra_Map &columns = term.matrix->ColMap();
        term.column.resize(columns.NumMyElements());
        for (int k = 0; k < columns.NumMyElements(); ++k)
        {
          const int id = columns.GID(k);
          int place = first.LCID(id);
          if (place < 0)
          {
            const auto inserted =
                added.try_emplace(id, static_cast<int>(ids.size()));
            place = inserted.first->second;
            if (inserted.second)
              ids.push_back(id);
          }
          term.column[k] = place;
        }
      }
      return Epetra_Map(-1, static_cast<int>(ids.size()), ids.data(), 0,
                        first.Comm());
    }

    /** Adds up one row after the other. */
    class RowSum
    {
    public:
      explicit RowSum(const int n_columns) : place_(n_columns, -1)
      {
      }

      /** Take row @p i of the sum. */
      void set(const std::vector<Term> &terms, const int i)
      {
        clear();
        for (const Term &term : terms)
          add(term, i);
      }

      std::vector<int> columns;
      std::vector<double> values;

    private:
      void clear()
      {
        for (const int j : columns)
          place_[j] = -1;
        columns.clear();
        values.clear();
      }

      void add(const Term &term, const int row)
      {
        int n = 0;
        int *column = nullptr;
        double *value = nullptr;
        term.matrix->ExtractMyRowView(row, n, value, column);
        for (int k = 0; k < n; ++k)
        {
          const int j = term.column[column[k]];
          if (place_[j] < 0)
          {
            place_[j] = static_cast<int>(columns.size());
            columns.push_back(j);
            values.push_back(0.);
          }
          values[place_[j]] += value[k];
        }
      }

      std::vector<int> place_;
    };

    /** Sum of matrices with the same rows, without room to spare: copies of
     * a matrix that has some overrun their memory in Epetra. */
    Epetra_CrsMatrix sum(const std::vector<const Epetra_CrsMatrix *> &matrices)
    {
      std::vector<Term> terms;
      for (const Epetra_CrsMatrix *matrix : matrices)
        terms.push_back({matrix, {}});
      const Epetra_CrsMatrix &first = *matrices[0];
      const Epetra_Map columns = union_of_columns(terms);
      RowSum row(columns.NumMyElements());
      std::vector<int> n_entries(first.NumMyRows());
      for (int i = 0; i < first.NumMyRows(); ++i)
      {
        row.set(terms, i);
        n_entries[i] = static_cast<int>(row.columns.size());
      }
      Epetra_CrsMatrix result(Copy, first.RowMap(), columns, n_entries.data(),
                              true);
      int status = 0;
      for (int i = 0; i < first.NumMyRows() && status >= 0; ++i)
      {
        row.set(terms, i);
        status = result.InsertMyValues(i, n_entries[i], row.values.data(),
                                       row.columns.data());
      }
      if (status >= 0)
        status = result.FillComplete(first.DomainMap(), first.RangeMap());
      AssertThrow(status >= 0,
                  dealii::ExcMessage("Epetra cannot add matrices."));
      return result;
    }
  } // namespace

  void copy(const Matrix &from, Matrix &to)
  {
    to.copy_from(from);
  }

  Matrix sum(const Matrix &first, const Matrix &second)
  {
    Matrix result;
    result.reinit(sum({&first.trilinos_matrix(), &second.trilinos_matrix()}));
    return result;
  }

  dealii::types::global_dof_index global_column(const Matrix &matrix,
                                                const int column)
  {
    return static_cast<dealii::types::global_dof_index>(
        matrix.trilinos_matrix().GCID64(column));
  }
} // namespace abut::la
