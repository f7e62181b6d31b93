// SPDX-License-Identifier: LGPL-2.1-or-later
#include "inf_sup.h"

#include "solve/condensed_solver.h"
#include "solve/row_stiffness.h"
#include "solve/unsupported_bodies.h"

#include <deal.II/lac/lapack_full_matrix.h>

#include <cmath>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Of the linear solver, and of the eigenvalue. */
    constexpr double linear_tolerance = 1e-10;
    constexpr double eigenvalue_tolerance = 1e-3;

    /** One number per row of this rank. */
    using RowVector = std::vector<double>;

    /** The operator T (K + T^T T)^-1 T^T on vectors over rows. */
    class ScaledSchur
    {
    public:
      ScaledSchur(const la::Matrix &stiffness, const PointOperator &rows,
                  const SolverParameters &parameters,
                  const NearNullSpace &space)
          : rows_(rows),
            solver_(parameters),
            force_(la::owned_rows(stiffness), stiffness.get_mpi_communicator()),
            answer_(force_),
            factor_(rows_.n_rows(), 0.)
      {
        solver_.set_near_null_space(space);
        solver_.reinit(stiffness, rows, row_stiffness(stiffness, rows));
        Condensate springs;
        springs.pivot.assign(rows_.n_rows(), Condensate::none);
        springs.stiffness.assign(rows_.n_rows(), 0.);
        std::vector<std::uint8_t> resists(rows_.n_rows());
        for (int i = 0; i < rows_.n_rows(); ++i)
          if (rows_.begin(i) < rows_.end(i))
          {
            springs.stiffness[i] = rows_.weight(i) * solver_.row_stiffness()[i];
            factor_[i] = std::sqrt(springs.stiffness[i]);
            resists[i] = 1;
          }
        UnsupportedBodies floating;
        floating.reinit(stiffness, rows_, space);
        floating.check(rows_, resists);
        solver_.prepare(springs);
      }

      /** A vector without structure, 0 where rows do not count. The same for
       * all partitions. */
      RowVector start(const std::int64_t *id) const
      {
        RowVector result(factor_.size(), 0.);
        for (std::size_t i = 0; i < result.size(); ++i)
          if (factor_[i] > 0.)
            result[i] = std::sin(12.9898 * static_cast<double>(id[i]) + 1.);
        return result;
      }

      RowVector apply(const RowVector &vector)
      {
        RowVector result(vector);
        for (std::size_t i = 0; i < result.size(); ++i)
          result[i] *= factor_[i];
        force_ = 0.;
        rows_.add_transposed(result.data(), force_);
        solver_.solve(force_, linear_tolerance * force_.l2_norm(), answer_);
        rows_.times(answer_, result.data());
        for (std::size_t i = 0; i < result.size(); ++i)
          result[i] *= factor_[i];
        return result;
      }

      double product(const RowVector &a, const RowVector &b) const
      {
        double sum = 0.;
        for (std::size_t i = 0; i < a.size(); ++i)
          sum += a[i] * b[i];
        return MPI::sum(sum, rows_.communicator());
      }

      unsigned int n_rows() const
      {
        unsigned int n = 0;
        for (const double factor : factor_)
          n += factor > 0.;
        return MPI::sum(n, rows_.communicator());
      }

    private:
      const PointOperator &rows_;
      CondensedSolver solver_;
      la::Vector force_, answer_;
      RowVector factor_; ///< sqrt(w s)
    };

    void add(RowVector &a, const double factor, const RowVector &b)
    {
      for (std::size_t i = 0; i < a.size(); ++i)
        a[i] += factor * b[i];
    }

    /** Lanczos' tridiagonal matrix. */
    struct Tridiagonal
    {
      std::vector<double> diagonal, beside;

      /** Smallest eigenvalue, and the last component of its unit vector. */
      std::pair<double, double> smallest() const
      {
        const unsigned int n = diagonal.size();
        dealii::LAPACKFullMatrix<double> matrix(n, n);
        for (unsigned int i = 0; i < n; ++i)
        {
          matrix.set(i, i, diagonal[i]);
          if (i + 1 < n)
          {
            matrix.set(i, i + 1, beside[i]);
            matrix.set(i + 1, i, beside[i]);
          }
        }
        dealii::Vector<double> values;
        dealii::FullMatrix<double> vectors;
        matrix.compute_eigenvalues_symmetric(-1., 2., 0., values, vectors);
        return {values[0], vectors(n - 1, 0)};
      }
    };

    double smallest_eigenvalue(ScaledSchur &schur, RowVector vector,
                               unsigned int &n_solves)
    {
      const unsigned int n = schur.n_rows();
      std::vector<RowVector> basis;
      Tridiagonal lanczos;
      double norm = std::sqrt(schur.product(vector, vector));
      double value = 0.;
      while (basis.size() < n)
      {
        for (double &x : vector)
          x /= norm;
        basis.push_back(vector);
        vector = schur.apply(basis.back());
        ++n_solves;
        lanczos.diagonal.push_back(schur.product(vector, basis.back()));
        // Twice is enough (Parlett, The symmetric eigenvalue problem, 1980).
        for (int sweep = 0; sweep < 2; ++sweep)
          for (const RowVector &other : basis)
            add(vector, -schur.product(vector, other), other);
        norm = std::sqrt(schur.product(vector, vector));
        const auto [theta, last] = lanczos.smallest();
        value = theta;
        if (norm <= 1e-9
            || norm * std::abs(last)
                   <= eigenvalue_tolerance * std::max(theta, 1e-6))
          break;
        lanczos.beside.push_back(norm);
      }
      return value;
    }
  } // namespace

  InfSup inf_sup_constant(const la::Matrix &stiffness,
                          const PointOperator &rows,
                          const SolverParameters &parameters,
                          const NearNullSpace &space)
  {
    InfSup result;
    ScaledSchur schur(stiffness, rows, parameters, space);
    if (schur.n_rows() == 0)
      return result;
    const double value =
        smallest_eigenvalue(schur, schur.start(rows.ids()), result.n_solves);
    result.constant = std::sqrt(std::max(0., value) / (1. - value));
    return result;
  }
} // namespace abut::solve
