// SPDX-License-Identifier: LGPL-2.1-or-later
#include "contact_filter.h"

namespace abut::solve
{
  namespace
  {
    /** Q^T A Q in a numbering of the picked unknowns alone. */
    la::Matrix pick(const la::Matrix &matrix, const std::vector<int> &unknowns)
    {
      const MPI_Comm communicator = matrix.get_mpi_communicator();
      const dealii::IndexSet numbers =
          la::number(unknowns.size(), communicator);
      la::Vector number(la::owned_rows(matrix), communicator);
      number = -1.;
      for (std::size_t k = 0; k < unknowns.size(); ++k)
        la::data(number)[unknowns[k]] =
            static_cast<double>(numbers.nth_index_in_set(k));
      const std::vector<double> column = la::gather(matrix, number);
      const la::LocalRows rows = la::local_rows(matrix);
      std::vector<dealii::types::global_dof_index> columns;
      std::vector<double> values;
      return la::assemble(
          numbers, dealii::IndexSet(numbers.size()), communicator,
          [&](const auto &visit)
          {
            for (std::size_t k = 0; k < unknowns.size(); ++k)
            {
              columns.clear();
              values.clear();
              const int i = unknowns[k];
              for (int e = rows.start[i]; e < rows.start[i + 1]; ++e)
                if (column[rows.column[e]] >= 0.)
                {
                  columns.push_back(
                      static_cast<dealii::types::global_dof_index>(
                          column[rows.column[e]]));
                  values.push_back(rows.value[e]);
                }
              visit(numbers.nth_index_in_set(k), columns, values);
            }
          });
    }
  } // namespace

  ContactFilter::ContactFilter(const la::Matrix &matrix,
                               const Multigrid &multigrid,
                               const std::vector<std::uint8_t> &picked)
      : matrix_(matrix), multigrid_(multigrid)
  {
    for (std::size_t i = 0; i < picked.size(); ++i)
      if (picked[i])
        unknowns_.push_back(static_cast<int>(i));
    small_ = std::make_unique<la::Matrix>(pick(matrix, unknowns_));
    direct_ = std::make_unique<DirectSolver>(*small_);
    const MPI_Comm communicator = matrix.get_mpi_communicator();
    for (la::Vector *vector : {&residual_, &correction_})
      vector->reinit(la::owned_rows(matrix), communicator);
    for (la::Vector *vector : {&small_residual_, &small_correction_})
      vector->reinit(la::owned_rows(*small_), communicator);
  }

  void ContactFilter::add_correction(la::Vector &x) const
  {
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
      la::data(small_residual_)[k] = la::data(residual_)[unknowns_[k]];
    direct_->solve(small_correction_, small_residual_);
    for (std::size_t k = 0; k < unknowns_.size(); ++k)
      la::data(x)[unknowns_[k]] += la::data(small_correction_)[k];
  }

  void ContactFilter::vmult(la::Vector &dst, const la::Vector &src) const
  {
    const auto update_residual = [&]()
    {
      matrix_.vmult(residual_, dst);
      residual_.sadd(-1., 1., src);
    };
    dst = 0.;
    residual_ = src;
    add_correction(dst);
    update_residual();
    multigrid_.vmult(correction_, residual_);
    dst.add(1., correction_);
    update_residual();
    add_correction(dst);
  }
} // namespace abut::solve
