// SPDX-License-Identifier: LGPL-2.1-or-later
#include "multigrid.h"

#include "algebraic_multigrid.h"

#include <algorithm>
#include <utility>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
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
    void set_rigid_motions(const la::Matrix &matrix, const NearNullSpace &space,
                           AggregationOptions &options)
    {
      const unsigned int dim = space.n_components;
      const bool rotates =
          MPI::max(space.point.empty() ? 0u : 1u, matrix.get_mpi_communicator())
          > 0;
      options.n_modes = dim + (rotates ? dim * (dim - 1) / 2 : 0);
      const std::size_t n = space.component.size();
      options.modes.assign(options.n_modes * n, 0.);
      for (std::size_t i = 0; i < n; ++i)
        if (space.component[i] < dim)
          options.modes[space.component[i] * n + i] = 1.;
      if (!rotates)
        return;
      const auto x = relative_positions(space, matrix.get_mpi_communicator());
      for (std::size_t i = 0; i < n; ++i)
        for (unsigned int a = 0, mode = dim; a < dim; ++a)
          for (unsigned int b = a + 1; b < dim; ++b, ++mode)
          {
            if (space.component[i] == a)
              options.modes[mode * n + i] = -x[i][b];
            if (space.component[i] == b)
              options.modes[mode * n + i] = x[i][a];
          }
    }

    /** Takes the couplings between different bodies out of a matrix and, when
     * this goes, puts them back. */
    class DecoupledBodies
    {
    public:
      DecoupledBodies(const la::Matrix &matrix, const NearNullSpace &space)
          : rows_(la::local_rows(matrix))
      {
        const MPI_Comm communicator = matrix.get_mpi_communicator();
        // ML restricts again on kept aggregates on one rank only.
        if (space.n_bodies == 1 || MPI::n_mpi_processes(communicator) > 1)
          return;
        la::Vector body(la::owned_rows(matrix), communicator);
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

      DecoupledBodies(const DecoupledBodies &) = delete;
      DecoupledBodies &operator=(const DecoupledBodies &) = delete;

      ~DecoupledBodies()
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
    void build_by_bodies(const la::Matrix &matrix, AggregationOptions &options,
                         const NearNullSpace &space,
                         AlgebraicMultigrid &multigrid)
    {
      // Below this part of the diagonal entries count as none.
      constexpr double nothing = 1e-12;
      {
        const DecoupledBodies apart(matrix, space);
        options.keeps_aggregates = apart.any();
        if (options.keeps_aggregates)
          options.threshold = nothing;
        multigrid.build(matrix, options);
      }
      if (options.keeps_aggregates)
        multigrid.restrict();
    }
  } // namespace

  std::unique_ptr<Multigrid> make_multigrid(const la::Matrix &matrix,
                                            const SolverParameters &parameters,
                                            const NearNullSpace &space,
                                            const bool slides)
  {
    AggregationOptions options;
    options.smoother_sweeps = parameters.smoother_sweeps;
    // All components of neighbouring nodes are coupled about as strongly, and
    // aggregates of single unknowns need a third fewer iterations than those
    // of whole nodes.
    if (space.n_components > 1)
      set_rigid_motions(matrix, space, options);
    else
      options.threshold = parameters.aggregation_threshold;
    auto multigrid = make_algebraic_multigrid();
    if (space.n_components > 1 && slides)
      build_by_bodies(matrix, options, space, *multigrid);
    else
      multigrid->build(matrix, options);
    return multigrid;
  }
} // namespace abut::solve
