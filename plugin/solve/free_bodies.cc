// SPDX-License-Identifier: LGPL-2.1-or-later
#include "free_bodies.h"

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  std::vector<std::vector<double>>
  null_space(const unsigned int n, const double *values, const double bound)
  {
    dealii::LAPACKFullMatrix<double> matrix(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        matrix(i, j) = 0.5 * (values[i * n + j] + values[j * n + i]);
    dealii::Vector<double> eigenvalues;
    dealii::FullMatrix<double> eigenvectors;
    matrix.compute_eigenvalues_symmetric(-bound, bound, 0., eigenvalues,
                                         eigenvectors);
    std::vector<std::vector<double>> result(eigenvalues.size());
    for (unsigned int k = 0; k < eigenvalues.size(); ++k)
      for (unsigned int i = 0; i < n; ++i)
        result[k].push_back(eigenvectors(i, k));
    return result;
  }

  namespace
  {
    /** A motion is free if its energy is below this part of what its
     * displacements would cost one by one: far below a support at one node,
     * far above round-off. */
    constexpr double free_energy = 1e-11;

    /** Part of its modes that a sum of them moves at the least, squared. */
    constexpr double no_motion = 1e-13;

    /** Rigid motions of a body in space. */
    constexpr unsigned int most_modes = 6;

    /** Rigid motions of all bodies at once; each body rotates about its centre,
     * with displacements of about 1 at its rim. */
    class Motions
    {
    public:
      Motions(const NearNullSpace &space, const MPI_Comm communicator)
          : space_(space),
            dim_(space.n_components),
            has_points_(MPI::logical_or(!space.point.empty(), communicator)),
            center_(space.n_bodies),
            radius_(space.n_bodies, 1.)
      {
        if (has_points_)
          find_centers(communicator);
      }

      /** Find the unknowns that are neither prescribed nor follow others. */
      void couple(const Stiffness &stiffness,
                  const std::vector<double> &diagonal)
      {
        is_coupled_.assign(diagonal.size(), 0);
        if (stiffness.has_matrix())
          find_coupled(la::local_rows(stiffness.matrix()));
        else
          find_coupled(stiffness, diagonal);
      }

      const std::vector<dealii::Point<3>> &centers() const
      {
        return center_;
      }

      const std::vector<double> &radii() const
      {
        return radius_;
      }

      unsigned int n_modes() const
      {
        const unsigned int rotations = dim_ == 3 ? 3 : dim_ - 1;
        return dim_ + (has_points_ ? rotations : 0);
      }

      int body(const std::size_t i) const
      {
        return space_.body.empty() ? 0 : space_.body[i];
      }

      /** Displacement of unknown i in a mode; 0 where the unknown is held or
       * follows others. */
      double value(const unsigned int mode, const std::size_t i) const
      {
        return is_coupled_[i] ? displacement(mode, i) : 0.;
      }

      /** The same wherever it is. */
      double displacement(const unsigned int mode, const std::size_t i) const
      {
        const unsigned int component = space_.component[i];
        if (component >= dim_)
          return 0.; // of another field
        if (mode < dim_)
          return component == mode ? 1. : 0.;
        // In the plane about z, in space about the axis mode - dim.
        const unsigned int axis = dim_ == 2 ? 2 : mode - dim_;
        if (component == axis)
          return 0.;
        const unsigned int other = 3 - axis - component;
        const auto x = space_.point[i] - center_[body(i)];
        const double sign = (component + 1) % 3 == axis ? 1. : -1.;
        return sign * x[other] / radius_[body(i)];
      }

    private:
      void find_coupled(const la::LocalRows &rows)
      {
        for (int i = 0; i < rows.n_rows; ++i)
          for (int k = rows.start[i]; k < rows.start[i + 1] && !is_coupled_[i];
               ++k)
            is_coupled_[i] = rows.column[k] != i && rows.value[k] != 0.;
      }

      /** By what others do to an unknown. */
      void find_coupled(const Stiffness &stiffness,
                        const std::vector<double> &diagonal)
      {
        constexpr double round_off = 1e-12;
        const la::Vector x = noise(stiffness, 0);
        la::Vector force(x);
        stiffness.vmult(force, x);
        for (std::size_t i = 0; i < diagonal.size(); ++i)
        {
          const double own = diagonal[i] * la::data(x)[i];
          is_coupled_[i] =
              std::abs(la::data(force)[i] - own) > round_off * std::abs(own);
        }
      }

      void find_centers(const MPI_Comm communicator)
      {
        const std::size_t n = space_.point.size();
        std::vector<double> sums(4 * space_.n_bodies, 0.);
        for (std::size_t i = 0; i < n; ++i)
        {
          for (int d = 0; d < 3; ++d)
            sums[4 * body(i) + d] += space_.point[i][d];
          sums[4 * body(i) + 3] += 1.;
        }
        MPI::sum(sums, communicator, sums);
        for (unsigned int b = 0; b < space_.n_bodies; ++b)
          for (int d = 0; d < 3; ++d)
            center_[b][d] = sums[4 * b + d] / std::max(1., sums[4 * b + 3]);
        std::vector<double> largest(space_.n_bodies, 0.);
        for (std::size_t i = 0; i < n; ++i)
          largest[body(i)] = std::max(
              largest[body(i)], space_.point[i].distance(center_[body(i)]));
        MPI::max(largest, communicator, largest);
        for (unsigned int b = 0; b < space_.n_bodies; ++b)
          radius_[b] = largest[b] > 0. ? largest[b] : 1.;
      }

      const NearNullSpace &space_;
      const unsigned int dim_;
      const bool has_points_; // on any rank: some have no unknowns
      std::vector<dealii::Point<3>> center_;
      std::vector<double> radius_;
      std::vector<std::uint8_t> is_coupled_;
    };

    /** Values of all modes at an unknown, or the forces in them. */
    using Modes = std::array<double, most_modes>;

    void fill(const Motions &motions, const unsigned int mode,
              la::Vector &displacement)
    {
      for (int i = 0; i < la::n_owned(displacement); ++i)
        la::data(displacement)[i] = motions.value(mode, i);
    }

    /** Call visit(unknown, displacements, forces) for each unknown of this
     * rank, in one pass over the matrix. */
    template <typename Visit>
    void for_each_force(const la::Matrix &stiffness, const Motions &motions,
                        la::Vector mode, const Visit &visit)
    {
      const la::LocalRows matrix = la::local_rows(stiffness);
      std::vector<Modes> modes(matrix.n_columns, Modes{});
      for (unsigned int m = 0; m < motions.n_modes(); ++m)
      {
        fill(motions, m, mode);
        const std::vector<double> all = la::gather(stiffness, mode);
        for (std::size_t j = 0; j < all.size(); ++j)
          modes[j][m] = all[j];
      }
      for (int i = 0; i < matrix.n_rows; ++i)
      {
        Modes force = {};
        for (int k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
          for (unsigned int m = 0; m < most_modes; ++m)
            force[m] += matrix.value[k] * modes[matrix.column[k]][m];
        visit(i, modes[i], force);
      }
    }

    /** The same by products. */
    template <typename Visit>
    void for_each_force(const HostOperator &host, const Motions &motions,
                        la::Vector mode, const Visit &visit)
    {
      std::vector<Modes> modes(la::n_owned(mode), Modes{}), forces(modes);
      la::Vector force(mode);
      for (unsigned int m = 0; m < motions.n_modes(); ++m)
      {
        fill(motions, m, mode);
        host.vmult(force, mode);
        for (std::size_t i = 0; i < modes.size(); ++i)
        {
          modes[i][m] = la::data(mode)[i];
          forces[i][m] = la::data(force)[i];
        }
      }
      for (std::size_t i = 0; i < modes.size(); ++i)
        visit(i, modes[i], forces[i]);
    }

    /** Whether prescribed values alone stop all motions of all bodies, and not
     * by nodes that are next to each other only: then stiffness need not be
     * examined. Collective. */
    bool supports_suffice(const Motions &motions, const NearNullSpace &space,
                          const MPI_Comm communicator)
    {
      constexpr double well_held = 1e-4;
      const unsigned int n = motions.n_modes();
      std::vector<double> sums(space.n_bodies * n * n, 0.);
      for (std::size_t i = 0; i < space.prescribed.size(); ++i)
      {
        if (space.prescribed[i] == 0)
          continue;
        double *const sum = &sums[motions.body(i) * n * n];
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int k = 0; k < n; ++k)
            sum[m * n + k] +=
                motions.displacement(m, i) * motions.displacement(k, i);
      }
      MPI::sum(sums, communicator, sums);
      for (unsigned int b = 0; b < space.n_bodies; ++b)
      {
        double *const sum = &sums[b * n * n];
        double trace = 0.;
        for (unsigned int m = 0; m < n; ++m)
          trace += sum[m * n + m];
        for (unsigned int k = 0; k < n * n && trace > 0.; ++k)
          sum[k] /= trace;
        if (!null_space(n, sum, well_held).empty())
          return false;
      }
      return true;
    }
  } // namespace

  FreeBodies find_free_bodies(const Stiffness &stiffness,
                              const NearNullSpace &space)
  {
    if (space.n_components == 1)
      return {};
    FreeBodies result;
    const std::vector<double> &diagonal = stiffness.diagonal();
    const MPI_Comm communicator = stiffness.communicator();
    Motions motions(space, communicator);
    motions.couple(stiffness, diagonal);
    const unsigned int n = result.n_modes = motions.n_modes();
    result.center = motions.centers();
    result.radius = motions.radii();
    if (supports_suffice(motions, space, communicator))
      return result;

    // Per body: energies of pairs of modes, then their products.
    const std::size_t stride = 2 * n * n;
    std::vector<double> sums(space.n_bodies * stride, 0.);
    la::Vector mode = stiffness.make_vector();
    const auto add =
        [&](const std::size_t i, const Modes &own, const Modes &force)
    {
      double *const sum = &sums[motions.body(i) * stride];
      for (unsigned int m = 0; m < n; ++m)
        for (unsigned int k = 0; k < n; ++k)
        {
          sum[m * n + k] += own[k] * force[m];
          sum[n * n + m * n + k] += own[k] * own[m] * diagonal[i];
        }
    };
    if (stiffness.has_matrix())
      for_each_force(stiffness.matrix(), motions, mode, add);
    else
      for_each_force(stiffness.host(), motions, mode, add);
    MPI::sum(sums, communicator, sums);
    for (unsigned int b = 0; b < space.n_bodies; ++b)
    {
      double *const sum = &sums[b * stride];
      double *const gram = sum + n * n;
      std::vector<double> size(n);
      for (unsigned int m = 0; m < n; ++m)
        size[m] = gram[m * n + m];
      const auto scale = [&](double *const matrix)
      {
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int k = 0; k < n; ++k)
            matrix[m * n + k] =
                size[m] > 0. && size[k] > 0.
                    ? matrix[m * n + k] / std::sqrt(size[m] * size[k])
                    : (m == k ? 1. : 0.);
      };
      scale(sum);
      scale(gram);
      // A mode that a body does not have counts as held, and so does a sum of
      // modes that moves nothing: a translation and a rotation are the same
      // for nodes in a row.
      for (const std::vector<double> &nothing : null_space(n, gram, no_motion))
        for (unsigned int m = 0; m < n; ++m)
          for (unsigned int k = 0; k < n; ++k)
            sum[m * n + k] += nothing[m] * nothing[k];
      for (std::vector<double> &motion : null_space(n, sum, free_energy))
      {
        for (unsigned int m = 0; m < n; ++m)
          motion[m] = size[m] > 0. ? motion[m] / std::sqrt(size[m]) : 0.;
        double largest = 0.;
        for (const double c : motion)
          largest = std::max(largest, std::abs(c));
        for (double &c : motion)
          c /= largest;
        result.motions.push_back({b, motion, la::Vector()});
      }
    }

    for (FreeBodies::Motion &motion : result.motions)
    {
      for (int i = 0; i < la::n_owned(mode); ++i)
      {
        double value = 0.;
        if (motions.body(i) == static_cast<int>(motion.body))
          for (unsigned int m = 0; m < n; ++m)
            value += motion.coefficient[m] * motions.value(m, i);
        la::data(mode)[i] = value;
      }
      motion.displacement = mode;
    }
    return result;
  }

  bool are_supported(const NearNullSpace &space, const MPI_Comm communicator)
  {
    return space.n_components == 1
           || supports_suffice(Motions(space, communicator), space,
                               communicator);
  }
} // namespace abut::solve
