// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_POINT_OPERATOR_H
#define ABUT_SOLVE_POINT_OPERATOR_H

#include "node_map.h"

#include <abut/dealii/linear_algebra.h>
#include <abut/points.h>

#include <deal.II/base/partitioner.h>

#include <memory>
#include <vector>

namespace abut::solve
{
  /** The contact points of all ranks as an operator B = dg/du over free
   * unknowns, with a row for each component of a point: made once from the
   * points and the map of their nodes, which are not needed any more for
   * anything but numbers and weights. A row is stored on one rank; its columns
   * may be unknowns of any rank, which are imported and exported point to
   * point.
   *
   * Columns are numbered locally: first the owned unknowns in their order,
   * then the ghosts, those columns that other ranks own. */
  class PointOperator
  {
  public:
    /** No points. */
    PointOperator() = default;

    /** Take the points of this rank, whose arrays must outlive this object,
     * with what @p nodes makes of their nodes. @p owned must be a contiguous
     * range. Collective. */
    PointOperator(const dealii::IndexSet &owned, const abut_points_view &points,
                  const NodeMap &nodes, MPI_Comm communicator);

    /** Rows on this rank. */
    int n_rows() const
    {
      return points_.n_components;
    }

    /** Owned unknowns. */
    int n_owned() const
    {
      return n_owned_;
    }

    /** Owned unknowns and ghosts. */
    int n_columns() const
    {
      return n_owned_ + static_cast<int>(partitioner_->n_ghost_indices());
    }

    /** Take other constants of the same nodes. */
    void renew_constants(const NodeMap &nodes);

    /** First entry of @p row; end(row) is past its last one. */
    std::int64_t begin(const int row) const
    {
      return starts()[row];
    }

    /** See begin(). */
    std::int64_t end(const int row) const
    {
      return starts()[row + 1];
    }

    /** Local column of an entry. */
    int column(const std::int64_t entry) const
    {
      return columns()[entry];
    }

    /** Value of an entry. */
    double coefficient(const std::int64_t entry) const
    {
      return coefficients()[entry];
    }

    /** Replace @p columns by the unknowns of a row, ascending. */
    void
    get_columns(int row,
                std::vector<dealii::types::global_dof_index> &columns) const;

    /** [rows] global numbers. */
    const std::int64_t *ids() const
    {
      return points_.component_id;
    }

    /** [rows] weights. */
    const double *weights() const
    {
      return points_.component_weight;
    }

    /** Weight of a row. */
    double weight(const int row) const
    {
      return points_.component_weight[row];
    }

    /** [rows] nonzero: an equality. */
    const std::uint8_t *bilateral() const
    {
      return points_.bilateral;
    }

    /** Whether a row is a tangent of a point of contact. */
    bool is_tangent(const int row) const
    {
      return !is_tangent_.empty() && is_tangent_[row] != 0;
    }

    /** Whether points on this rank have tangents. */
    bool has_tangents() const
    {
      return !is_tangent_.empty();
    }

    /** [rows] gap at displacement 0, prescribed values put in. */
    const double *initial_gap() const
    {
      return initial_gap_.empty() ? points_.gap : initial_gap_.data();
    }

    /** Global number of a local column. */
    dealii::types::global_dof_index global_column(int column) const;

    /** Owned unknowns. */
    const dealii::IndexSet &owned() const
    {
      return partitioner_->locally_owned_range();
    }

    /** Columns that other ranks own. */
    const dealii::IndexSet &ghosts() const
    {
      return partitioner_->ghost_indices();
    }

    /** Communicator of all ranks. */
    MPI_Comm communicator() const
    {
      return partitioner_->get_mpi_communicator();
    }

    /** Values of the owned unknowns and ghosts, [n_columns]. The array is
     * overwritten by the next call of any function that communicates; on one
     * rank it is the vector's own. Collective. */
    const double *import(const la::Vector &vector) const;

    /** result = B u, [n_rows]. Collective. */
    void times(const la::Vector &u, double *result) const;

    /** The gap g0 + B u, [n_rows]. Collective. */
    void gap(const la::Vector &u, double *result) const;

    /** force += B^T factor with @p factor [n_rows]. Collective. */
    void add_transposed(const double *factor, la::Vector &force) const;

    /** sum_j B_ij^2 d_j of each row for a vector d. Collective. */
    std::vector<double> squares(const la::Vector &d) const;

    /** d_j += sum_i factor_i B_ij^2: the diagonal of B^T diag(factor) B.
     * Collective. */
    void add_squares(const double *factor, la::Vector &d) const;

    /** d_j += number of rows with @p wanted nonzero that have unknown j.
     * Collective. */
    void add_counts(const std::uint8_t *wanted, la::Vector &d) const;

    /** d_j += number of groups of neighbouring rows that have unknown j in a
     * row with @p wanted nonzero; @p first has the first row of each group, and
     * the number of rows at its end. Collective. */
    void add_group_counts(const std::uint8_t *wanted,
                          const std::vector<int> &first, la::Vector &d) const;

  private:
    template <typename Function>
    void add_entries(const double *factor, const Function &function,
                     la::Vector &vector) const;

    const std::int64_t *starts() const
    {
      return is_shared_ ? points_.start : start_.data();
    }

    const int *columns() const
    {
      return is_shared_ ? points_.node : column_.data();
    }

    const double *coefficients() const
    {
      return is_shared_ ? points_.coefficient : coefficient_.data();
    }

    /** Whether there are no other ranks. */
    bool is_alone() const
    {
      return partitioner_->n_mpi_processes() == 1;
    }

    std::vector<dealii::types::global_dof_index> expand(const NodeMap &nodes);
    /** Rows that are the points as they are, of nodes with one unknown, need no
     * arrays of their own. */
    void share_with_points();
    double initial_gap(int point, int row, const NodeMap &nodes) const;
    void mark_tangents();
    void clear_ghosts() const;
    void export_values(la::Vector &vector) const;

    abut_points_view points_ = {};
    int n_owned_ = 0;
    /** Whether the first three arrays are the points'. */
    bool is_shared_ = false;
    std::vector<std::int64_t> start_ = {0}; ///< [rows + 1]
    std::vector<int> column_;
    std::vector<double> coefficient_;
    std::vector<double> initial_gap_;      ///< [rows]; empty: the points' own
    std::vector<std::uint8_t> is_tangent_; ///< [rows]; empty: none
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner_ =
        std::make_shared<dealii::Utilities::MPI::Partitioner>();
    mutable std::vector<double> values_; ///< [n_columns] with other ranks
    mutable std::vector<double> buffer_; ///< values on their way
  };

  /** [rows] nonzero: the operator of these points has a column in the row. Not
   * collective. */
  std::vector<std::uint8_t> rows_with_columns(const abut_points_view &points,
                                              const NodeMap &nodes);
} // namespace abut::solve

#endif
