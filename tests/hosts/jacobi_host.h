// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_JACOBI_HOST_H
#define ABUT_TESTS_JACOBI_HOST_H

#include <abut/dealii/host_operator.h>

namespace abut::tests
{
  /** A matrix that is not shown, with Jacobi's preconditioner. */
  class JacobiHost : public HostOperator
  {
  public:
    explicit JacobiHost(const la::Matrix &matrix) : matrix_(matrix)
    {
    }

    void vmult(la::Vector &dst, const la::Vector &src) const override
    {
      matrix_.vmult(dst, src);
    }

    void diagonal(la::Vector &result) const override
    {
      const std::vector<double> values = la::diagonal(la::local_rows(matrix_));
      for (std::size_t i = 0; i < values.size(); ++i)
        la::data(result)[i] = values[i];
    }

    void precondition(la::Vector &dst, const la::Vector &src) const override
    {
      const std::vector<double> values = la::diagonal(la::local_rows(matrix_));
      for (std::size_t i = 0; i < values.size(); ++i)
        la::data(dst)[i] = la::data(src)[i] / values[i];
    }

  private:
    const la::Matrix &matrix_;
  };
} // namespace abut::tests

#endif
