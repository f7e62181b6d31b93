// SPDX-License-Identifier: LGPL-2.1-or-later
#include "stiffness.h"

#include <cmath>
#include <cstdint>

namespace abut::solve
{
  namespace
  {
    /** K x and K y, in one pass over the rows. */
    void multiply_both(const la::Matrix &matrix, const la::Vector &x,
                       const la::Vector &y, la::Vector &kx, la::Vector &ky)
    {
      const std::vector<double> all_x = la::gather(matrix, x);
      const std::vector<double> all_y = la::gather(matrix, y);
      const la::LocalRows rows = la::local_rows(matrix);
      for (int i = 0; i < rows.n_rows; ++i)
      {
        double by_x = 0., by_y = 0.;
        for (int k = rows.start[i]; k < rows.start[i + 1]; ++k)
        {
          by_x += rows.value[k] * all_x[rows.column[k]];
          by_y += rows.value[k] * all_y[rows.column[k]];
        }
        la::data(kx)[i] = by_x;
        la::data(ky)[i] = by_y;
      }
    }
  } // namespace

  Stiffness::Stiffness(const la::Matrix &matrix)
      : Tangent(matrix),
        owned_(la::owned_rows(matrix)),
        communicator_(matrix.get_mpi_communicator())
  {
  }

  Stiffness::Stiffness(const Tangent &tangent, const dealii::IndexSet &owned,
                       const MPI_Comm communicator)
      : Tangent(tangent), owned_(owned), communicator_(communicator)
  {
  }

  la::Vector Stiffness::make_vector() const
  {
    return la::Vector(owned_, communicator_);
  }

  const std::vector<double> &Stiffness::diagonal() const
  {
    if (!found_->diagonal && has_matrix())
      found_->diagonal = la::diagonal(la::local_rows(matrix()));
    else if (!found_->diagonal)
    {
      la::Vector result = make_vector();
      host().diagonal(result);
      found_->diagonal.emplace(la::data(result),
                               la::data(result) + la::n_owned(result));
    }
    return *found_->diagonal;
  }

  la::Vector noise(const Stiffness &stiffness, const unsigned int series)
  {
    la::Vector result = stiffness.make_vector();
    const std::uint64_t first = result.local_range().first;
    for (int i = 0; i < la::n_owned(result); ++i)
    {
      std::uint64_t number =
          (2 * (first + i) + series + 1) * 0x9e3779b97f4a7c15ull;
      number = (number ^ (number >> 31)) * 0xbf58476d1ce4e5b9ull;
      la::data(result)[i] = static_cast<double>(number >> 11) * 0x1p-52 - 1.;
    }
    return result;
  }

  bool Stiffness::is_symmetric() const
  {
    if (found_->is_symmetric)
      return *found_->is_symmetric;
    const la::Vector x = noise(*this, 0), y = noise(*this, 1);
    la::Vector kx(x), ky(y);
    if (has_matrix())
      multiply_both(matrix(), x, y, kx, ky);
    else
    {
      vmult(kx, x);
      vmult(ky, y);
    }
    found_->is_symmetric =
        std::abs(x * ky - y * kx) <= 1e-9 * x.l2_norm() * ky.l2_norm();
    return *found_->is_symmetric;
  }
} // namespace abut::solve
