// SPDX-License-Identifier: LGPL-2.1-or-later
#include "host_checks.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  void check_diagonal(const Stiffness &stiffness,
                      const std::vector<double> &diagonal)
  {
    // The first on any rank that is wrong.
    const la::Vector like = stiffness.make_vector();
    double first = INFINITY;
    for (std::size_t i = diagonal.size(); i-- > 0;)
      if (!(diagonal[i] > 0. && std::isfinite(diagonal[i])))
        first = static_cast<double>(like.local_range().first + i);
    first = MPI::min(first, stiffness.communicator());
    if (std::isfinite(first))
    {
      std::ostringstream text;
      text << "HostOperator::diagonal() must be positive and finite, for "
              "constrained unknowns as well; it is not at unknown "
           << first << '.';
      throw std::invalid_argument(text.str());
    }
  }

  void check_entry(const Stiffness &stiffness,
                   const std::vector<double> &diagonal,
                   const PointOperator &rows)
  {
    // Use the first unknown of a row on the first rank that has one.
    constexpr double round_off = 1e-9;
    double first = INFINITY;
    for (int i = 0; i < rows.n_rows() && std::isinf(first); ++i)
      for (auto e = rows.begin(i); e < rows.end(i); ++e)
        if (rows.column(e) < rows.n_owned())
        {
          first = static_cast<double>(rows.global_column(rows.column(e)));
          break;
        }
    first = MPI::min(first, rows.communicator());
    if (std::isinf(first))
      return;
    const auto unknown = static_cast<dealii::types::global_dof_index>(first);
    la::Vector unit = stiffness.make_vector(), force(unit);
    const bool is_here = rows.owned().is_element(unknown);
    const std::size_t i = is_here ? rows.owned().index_within_set(unknown) : 0;
    if (is_here)
      la::data(unit)[i] = 1.;
    stiffness.vmult(force, unit);
    double both[2] = {is_here ? diagonal[i] : 0.,
                      is_here ? la::data(force)[i] : 0.};
    MPI::sum(both, rows.communicator(), both);
    if (std::abs(both[0] - both[1]) <= round_off * std::abs(both[0]))
      return;
    std::ostringstream text;
    text << "HostOperator::diagonal() has " << both[0] << " at unknown "
         << unknown << ", where vmult() of its unit vector gives " << both[1]
         << ": penalties and tolerances are multiples of the diagonal.";
    throw std::invalid_argument(text.str());
  }

  namespace
  {
    /** Throw unless forces by noise on one kind of unknowns are 0 on the other.
     */
    void check_apart(const Stiffness &stiffness,
                     const std::vector<double> &diagonal,
                     const CommonArray<std::uint8_t> &prescribed,
                     const bool from_prescribed, const std::string &what)
    {
      constexpr double round_off = 1e-9;
      la::Vector displacement = noise(stiffness, 0), force(displacement);
      const auto moves = [&](const std::size_t i) {
        return (!prescribed.empty() && prescribed[i] != 0) == from_prescribed;
      };
      for (std::size_t i = 0; i < diagonal.size(); ++i)
        if (!moves(i))
          la::data(displacement)[i] = 0.;
      stiffness.vmult(force, displacement);
      double largest = 0.;
      for (std::size_t i = 0; i < diagonal.size(); ++i)
        if (!moves(i))
          largest =
              std::max(largest, std::abs(la::data(force)[i]) / diagonal[i]);
      if (MPI::max(largest, stiffness.communicator()) > round_off)
        throw std::invalid_argument("HostOperator::vmult() " + what
                                    + ". Leave no more than the diagonal in "
                                      "rows and columns of unknowns "
                                      "that the constraints eliminate.");
    }
  } // namespace

  void check_prescribed(const Stiffness &stiffness,
                        const std::vector<double> &diagonal,
                        const CommonArray<std::uint8_t> &prescribed)
  {
    check_apart(
        stiffness, diagonal, prescribed, true,
        "couples forces on free unknowns to displacements of prescribed ones");
    check_apart(
        stiffness, diagonal, prescribed, false,
        "couples forces on prescribed unknowns to displacements of free ones");
  }

  std::string faults(const Stiffness &stiffness, const bool is_symmetric)
  {
    constexpr double round_off = 1e-8;
    const la::Vector x = noise(stiffness, 0), y = noise(stiffness, 1);
    la::Vector mx(x), my(y), again(x);
    const HostOperator &host = stiffness.host();
    host.precondition(mx, x);
    host.precondition(my, y);
    host.precondition(again, x);
    const double size = x.l2_norm() * my.l2_norm();
    const double forth = x * my, back = y * mx, energy = x * mx;
    again -= mx;
    std::ostringstream text;
    if (!std::isfinite(size))
      text << " precondition() gives values that are not finite.";
    else if (again.l2_norm() > round_off * mx.l2_norm())
      text << " precondition() gives different results for the same vector.";
    else if (std::abs(forth - back) > round_off * size)
      text << " precondition() is not symmetric: x.My = " << forth
           << ", y.Mx = " << back << " for two vectors without structure.";
    else if (energy <= 0.)
      text << " precondition() is not positive: x.Mx = " << energy << '.';
    if (!is_symmetric)
      text << " vmult() is not symmetric.";
    return text.str();
  }
} // namespace abut::solve
