// SPDX-License-Identifier: LGPL-2.1-or-later
#include "multigrid.h"

#include <deal.II/lac/trilinos_precondition.h>

#include <Epetra_MultiVector.h>
#include <Teuchos_ParameterList.hpp>

#include <utility>

namespace abut::solve
{
  using dealii::TrilinosWrappers::PreconditionAMG;
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    class AlgebraicMultigrid : public Multigrid
    {
    public:
      void vmult(la::Vector &dst, const la::Vector &src) const override
      {
        amg.vmult(dst, src);
      }

      PreconditionAMG amg;
    };

    /** Positions about their centre, as parts of the largest distance. */
    std::vector<dealii::Tensor<1, 3>>
    relative_positions(const NearNullSpace &space, const MPI_Comm communicator)
    {
      double sum[4] = {0., 0., 0., 0.}; // of positions, and how many
      for (const dealii::Point<3> &point : space.point)
      {
        for (unsigned int d = 0; d < 3; ++d)
          sum[d] += point[d];
        sum[3] += 1.;
      }
      MPI::sum(sum, communicator, sum);
      const dealii::Point<3> centre(sum[0] / sum[3], sum[1] / sum[3],
                                    sum[2] / sum[3]);
      std::vector<dealii::Tensor<1, 3>> result;
      double size = 0.;
      for (const dealii::Point<3> &point : space.point)
      {
        result.push_back(point - centre);
        size = std::max(size, result.back().norm());
      }
      size = MPI::max(size, communicator);
      for (dealii::Tensor<1, 3> &x : result)
        x /= size > 0. ? size : 1.;
      return result;
    }

    /** Translations along all axes and, if it is known where unknowns sit,
     * rotations in all planes of two axes. One centre does for all bodies:
     * aggregates are parts of bodies, on which rotations about different
     * centres differ by translations. */
    Epetra_MultiVector rigid_motions(const la::Matrix &matrix,
                                     const NearNullSpace &space)
    {
      const unsigned int dim = space.n_components;
      const bool rotates =
          MPI::max(space.point.empty() ? 0u : 1u, matrix.get_mpi_communicator())
          > 0;
      const unsigned int n_rotations = rotates ? dim * (dim - 1) / 2 : 0;
      Epetra_MultiVector modes(matrix.trilinos_matrix().DomainMap(),
                               static_cast<int>(dim + n_rotations));
      for (std::size_t i = 0; i < space.component.size(); ++i)
        if (space.component[i] < dim)
          modes[space.component[i]][i] = 1.;
      if (!rotates)
        return modes;
      const auto x = relative_positions(space, matrix.get_mpi_communicator());
      for (std::size_t i = 0; i < space.component.size(); ++i)
        for (unsigned int a = 0, mode = dim; a < dim; ++a)
          for (unsigned int b = a + 1; b < dim; ++b, ++mode)
          {
            if (space.component[i] == a)
              modes[mode][i] = -x[i][b];
            if (space.component[i] == b)
              modes[mode][i] = x[i][a];
          }
      return modes;
    }

    /** Takes the couplings between different bodies out of a matrix and, when
     * this goes, puts them back. */
    class Apart
    {
    public:
      Apart(const la::Matrix &matrix, const NearNullSpace &space)
          : rows_(la::local_rows(matrix))
      {
        const MPI_Comm communicator = matrix.get_mpi_communicator();
        // ML restricts anew on kept aggregates on one rank only.
        if (space.n_bodies == 1 || MPI::n_mpi_processes(communicator) > 1)
          return;
        la::Vector body(matrix.locally_owned_range_indices(), communicator);
        std::copy(space.body.begin(), space.body.end(), la::data(body));
        const std::vector<double> body_of = la::gather(matrix, body);
        for (int i = 0; i < rows_.n_rows; ++i)
          for (int e = rows_.start[i]; e < rows_.start[i + 1]; ++e)
            if (body_of[rows_.column[e]] != body_of[i] && rows_.value[e] != 0.)
            {
              taken_.emplace_back(e, rows_.value[e]);
              rows_.value[e] = 0.;
            }
        any_ = !taken_.empty();
      }

      Apart(const Apart &) = delete;
      Apart &operator=(const Apart &) = delete;

      ~Apart()
      {
        for (const auto &[entry, value] : taken_)
          rows_.value[entry] = value;
      }

      /** Whether there are any. */
      bool any() const
      {
        return any_;
      }

    private:
      la::LocalRows rows_;
      std::vector<std::pair<int, double>> taken_;
      bool any_ = false;
    };

    /** Aggregates of each body for itself, on which then the whole matrix is
     * restricted: coarse functions that move both sides of a contact at once
     * could not let them slide on each other. */
    void initialize_by_bodies(const la::Matrix &matrix,
                              Teuchos::ParameterList &list,
                              const NearNullSpace &space,
                              PreconditionAMG &multigrid)
    {
      // Below this part of the diagonal entries count as none.
      constexpr double nothing = 1e-12;
      bool coupled = false;
      {
        const Apart apart(matrix, space);
        coupled = apart.any();
        if (coupled)
        {
          list.set("aggregation: threshold", nothing);
          list.set("reuse: enable", true);
        }
        multigrid.initialize(matrix, list);
      }
      if (coupled)
        multigrid.reinit();
    }
  } // namespace

  std::unique_ptr<Multigrid> make_multigrid(const la::Matrix &matrix,
                                            const SolverParameters &parameters,
                                            const NearNullSpace &space,
                                            const bool slides)
  {
    PreconditionAMG::AdditionalData data;
    data.elliptic = true;
    data.aggregation_threshold = parameters.aggregation_threshold;
    data.smoother_sweeps = parameters.smoother_sweeps;
    auto multigrid = std::make_unique<AlgebraicMultigrid>();
    if (space.n_components == 1)
    {
      multigrid->amg.initialize(matrix, data);
      return multigrid;
    }

    // All components of neighbouring nodes are coupled about as strongly, and
    // aggregates of single unknowns need a third fewer iterations than those
    // of whole nodes.
    data.aggregation_threshold = 0.;
    Teuchos::ParameterList list;
    std::unique_ptr<Epetra_MultiVector> unused;
    data.set_parameters(list, unused, matrix);
    Epetra_MultiVector modes = rigid_motions(matrix, space);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", modes.NumVectors());
    list.set("null space: vectors", modes.Values());
    if (slides)
      initialize_by_bodies(matrix, list, space, multigrid->amg);
    else
      multigrid->amg.initialize(matrix, list);
    return multigrid;
  }
} // namespace abut::solve
