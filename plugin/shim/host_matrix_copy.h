// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_HOST_MATRIX_COPY_H
#define ABUT_SHIM_HOST_MATRIX_COPY_H

#include <abut/dealii/host_matrix.h>

#include <deal.II/lac/affine_constraints.h>

#include <set>
#include <string>
#include <vector>

namespace abut::shim
{
  /** Throw, on all ranks, if one of them names a row, invalid_dof_index: none;
   * the first of them. Collective.
   * @param name of what has the row, in messages
   * @param what the row has, after which its number follows */
  void refuse_row(dealii::types::global_dof_index row, const std::string &name,
                  const std::string &what, MPI_Comm communicator);

  /** Throw, on all ranks, if one has entries of rows of others that it has not
   * sent. Collective.
   * @param name of the matrix in messages */
  void check_sent(const la::Matrix &matrix, const std::string &name,
                  MPI_Comm communicator);

  /** Throw, on all ranks, if all rows that @p constraints do not have are zero:
   * nothing was assembled. Ends at the first value that is not zero.
   * Collective.
   * @param name of the matrix in messages */
  void check_assembled(const la::Matrix &matrix,
                       const dealii::AffineConstraints<double> &constraints,
                       const std::string &name, MPI_Comm communicator);

  /** Throw, on all ranks, if a value of @p matrix is not finite, naming the
   * first row with one, and if a diagonal entry is missing. One pass over the
   * entries. Collective.
   * @param name of the matrix in messages */
  void check_values(const la::Matrix &matrix, const std::string &name,
                    MPI_Comm communicator);

  /** Throw, on all ranks, if a row that @p constraints eliminate has more than
   * its diagonal entry, naming the first one: the matrix was assembled without
   * them. O(eliminated rows). Collective.
   * @param name of the matrix in messages */
  void check_eliminated(const la::Matrix &matrix,
                        const dealii::AffineConstraints<double> &constraints,
                        const std::string &name, MPI_Comm communicator);

  /** Rows of this rank that @p constraints do not have and that are nothing but
   * their diagonal; none of a matrix that is diagonal on all ranks. O(rows).
   * Collective. */
  std::set<dealii::types::global_dof_index>
  lone_rows(const la::Matrix &matrix,
            const dealii::AffineConstraints<double> &constraints,
            MPI_Comm communicator);

  /** Throw, on all ranks, if one of them names a row that only matrices of
   * other constraints have, invalid_dof_index: none. Collective. */
  void refuse_lone_row(dealii::types::global_dof_index row,
                       const std::string &name, MPI_Comm communicator);

  /** A matrix of Abut's type with the values of a host's, whose pattern is kept
   * while the host's is the same. */
  class HostMatrixCopy
  {
  public:
    /** The matrix with the values of now; it stays at its address. Unknowns
     * @p owned that @p host does not have, those after its last one, get a
     * diagonal entry. One pass over the entries where the pattern is as before.
     * Throws dealii::ExceptionBase, on all ranks, for rows without a diagonal
     * entry and for values that are not finite. Collective.
     * @param name of the matrix in messages */
    const la::Matrix &copy(const la::HostMatrix &host, const std::string &name,
                           const dealii::IndexSet &owned,
                           MPI_Comm communicator);

    /** Forget the pattern and the values. */
    void clear();

  private:
    void build(const la::HostMatrix &host, const std::string &name,
               const dealii::IndexSet &owned, MPI_Comm communicator);
    /** Give unknowns that the host does not have the mean of the others'
     * diagonal. */
    void fill_rest(const la::LocalRows &rows) const;

    la::Matrix matrix_;
    int n_host_rows_ = 0;
    std::vector<std::size_t> start_; ///< the host's pattern
    std::vector<la::HostMatrix::Index> column_;
    std::vector<int> place_; ///< of each of its entries in matrix_
  };
} // namespace abut::shim

#endif
