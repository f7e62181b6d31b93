// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_STIFFNESS_H
#define ABUT_SOLVE_STIFFNESS_H

#include <abut/dealii/host_operator.h>
#include <abut/dealii/linear_algebra.h>

#include <deal.II/base/index_set.h>

#include <memory>
#include <optional>
#include <vector>

namespace abut::solve
{
  /** A tangent with its unknowns, as solvers of rows get it. */
  class Stiffness : public Tangent
  {
  public:
    /** None. */
    Stiffness() = default;

    /** A matrix converts to it. */
    Stiffness(const la::Matrix &matrix);

    /** That of the unknowns @p owned. */
    Stiffness(const Tangent &tangent, const dealii::IndexSet &owned,
              MPI_Comm communicator);

    MPI_Comm communicator() const
    {
      return communicator_;
    }

    /** A vector of zeros. Collective. */
    la::Vector make_vector() const;

    /** [owned] diagonal of K. Collective the first time. */
    const std::vector<double> &diagonal() const;

    /** Whether x.K y = y.K x for two vectors without structure. One pass over
     * the rows of a matrix, two products of a host, the first time.
     * Collective. */
    bool is_symmetric() const;

    /** The same for copies: of the same values, for data that are found
     * once. */
    std::shared_ptr<const void> values() const
    {
      return found_;
    }

  private:
    /** Data that are found at the first request, common to copies. */
    struct Found
    {
      std::optional<std::vector<double>> diagonal;
      std::optional<bool> is_symmetric;
    };

    std::shared_ptr<Found> found_ = std::make_shared<Found>();
    dealii::IndexSet owned_;
    MPI_Comm communicator_ = MPI_COMM_NULL;
  };

  /** A vector of numbers in [-1, 1) without structure, the same ones for any
   * ranks; @p series 0 and 1 have others. Collective. */
  la::Vector noise(const Stiffness &stiffness, unsigned int series);
} // namespace abut::solve

#endif
