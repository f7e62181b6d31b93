// SPDX-License-Identifier: LGPL-2.1-or-later
#include "unsupported_bodies.h"

#include "rigid_motion_words.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/solver_parameters.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** A motion is free if its energy is below this part of what its
     * displacements would cost one by one: far below a support at one node,
     * far above round-off. */
    constexpr double free_energy = 1e-11;

    /** Part of its modes that a sum of them moves at the least, squared. */
    constexpr double no_motion = 1e-13;

    /** Gaps are known to some 1e-12 of the displacement, energies to the
     * square of it. */
    constexpr double free_gap = 1e-14;

    /** Springs of points that slip count as 0 below this part of the surface's
     * own stiffness. */
    constexpr double no_spring = 1e-9;

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

    /** Eigenvectors of a symmetric n x n matrix with eigenvalues that are no
     * more than @p bound away from 0. Less than that is no round-off but a
     * material that softens, which resists, if badly. */
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

  void UnsupportedBodies::reinit(const Stiffness &stiffness,
                                 const PointOperator &rows,
                                 const NearNullSpace &space)
  {
    motions_.clear();
    gap_.clear();
    if (space.n_components == 1)
      return;
    space_ = space;
    const std::vector<double> diagonal = stiffness.diagonal();
    const MPI_Comm communicator = stiffness.communicator();
    Motions motions(space, communicator);
    motions.couple(stiffness, diagonal);
    const unsigned int n = n_modes_ = motions.n_modes();
    center_ = motions.centers();
    radius_ = motions.radii();
    if (supports_suffice(motions, space, communicator))
      return;

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
        motions_.push_back({b, motion, la::Vector()});
      }
    }

    for (Motion &motion : motions_)
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
      gap_.emplace_back(rows.n_rows());
      rows.times(mode, gap_.back().data());
    }
  }

  bool UnsupportedBodies::are_supported(const NearNullSpace &space,
                                        const MPI_Comm communicator)
  {
    return space.n_components == 1
           || supports_suffice(Motions(space, communicator), space,
                               communicator);
  }

  std::vector<double>
  UnsupportedBodies::gap_change(const Combination &combination) const
  {
    std::vector<double> result(gap_.empty() ? 0 : gap_[0].size(), 0.);
    for (std::size_t k = 0; k < gap_.size(); ++k)
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] += combination[k] * gap_[k][i];
    return result;
  }

  void UnsupportedBodies::add(const Combination &combination,
                              la::Vector &displacement) const
  {
    for (std::size_t k = 0; k < motions_.size(); ++k)
      displacement.add(combination[k], motions_[k].displacement);
  }

  std::vector<double> UnsupportedBodies::work(const la::Vector &forces) const
  {
    std::vector<double> result;
    for (const Motion &motion : motions_)
      result.push_back(motion.displacement * forces);
    return result;
  }

  std::vector<UnsupportedBodies::Combination>
  UnsupportedBodies::along_which_works(const std::vector<Combination> &motions,
                                       const la::Vector &residual,
                                       const double tolerance) const
  {
    std::vector<Combination> result;
    if (motions.empty())
      return result;
    const std::vector<double> each = work(residual);
    for (const Combination &motion : motions)
      if (std::abs(std::inner_product(motion.begin(), motion.end(),
                                      each.begin(), 0.))
          > tolerance)
        result.push_back(motion);
    return result;
  }

  void UnsupportedBodies::project(const la::Vector &displacement,
                                  std::vector<double> &products,
                                  std::vector<double> &right) const
  {
    const std::size_t n = motions_.size();
    std::vector<double> sums(n * n + n, 0.);
    for (std::size_t j = 0; j < n; ++j)
    {
      const double *const own = la::data(motions_[j].displacement);
      for (int i = 0; i < la::n_owned(displacement); ++i)
      {
        if (own[i] == 0.)
          continue;
        const double moved = own[i] * share(i);
        for (std::size_t k = 0; k < n; ++k)
          sums[j * n + k] += moved * la::data(motions_[k].displacement)[i];
        sums[n * n + j] += moved * la::data(displacement)[i];
      }
    }
    MPI::sum(sums, displacement.get_mpi_communicator(), sums);
    products.assign(sums.begin(), sums.begin() + n * n);
    right.assign(sums.begin() + n * n, sums.end());
  }

  std::vector<double>
  UnsupportedBodies::divide(const std::vector<double> &products,
                            const std::vector<double> &right)
  {
    const std::size_t n = right.size();
    dealii::FullMatrix<double> inverse(n, n);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        inverse(j, k) = products[j * n + k];
    inverse.gauss_jordan();
    std::vector<double> result(n, 0.);
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < n; ++k)
        result[j] += inverse(j, k) * right[k];
    return result;
  }

  std::vector<BodyMotion>
  UnsupportedBodies::rigid_part(const la::Vector &displacement) const
  {
    if (empty())
      return {};
    std::vector<double> products, right;
    project(displacement, products, right);
    const std::vector<RigidMotion> motions = of_bodies(divide(products, right));
    std::set<unsigned int> bodies;
    for (const Motion &motion : motions_)
      bodies.insert(motion.body);
    std::vector<BodyMotion> result;
    for (const unsigned int body : bodies)
    {
      const RigidMotion &motion = motions[body];
      BodyMotion moved;
      moved.body = body;
      moved.rotation = motion.rotation;
      moved.translation =
          motion.translation
          + cross_product_3d(motion.rotation,
                             dealii::Tensor<1, 3>(center_[body]));
      moved.text = name(body) + " has "
                   + rigid_displacement_in_words(
                       space_.n_components, moved.translation, moved.rotation,
                       center_[body], radius_[body]);
      result.push_back(std::move(moved));
    }
    return result;
  }

  std::string UnsupportedBodies::name(const unsigned int body) const
  {
    return body < space_.names.size() ? space_.names[body]
                                      : "body " + std::to_string(body + 1);
  }

  double UnsupportedBodies::smallest_radius() const
  {
    double result = 0.;
    for (const Motion &motion : motions_)
      result = result > 0. ? std::min(result, radius_[motion.body])
                           : radius_[motion.body];
    return result;
  }

  std::vector<RigidMotion>
  UnsupportedBodies::of_bodies(const Combination &combination) const
  {
    std::vector<RigidMotion> result(space_.n_bodies);
    const unsigned int dim = space_.n_components;
    const unsigned int n_rotations = n_modes_ - dim;
    for (std::size_t k = 0; k < motions_.size(); ++k)
    {
      const Motion &motion = motions_[k];
      dealii::Tensor<1, 3> translation, rotation;
      for (unsigned int d = 0; d < dim; ++d)
        translation[d] = combination[k] * motion.coefficient[d];
      for (unsigned int r = 0; r < n_rotations; ++r)
        rotation[n_rotations == 1 ? 2 : r] =
            combination[k] * motion.coefficient[dim + r] / radius_[motion.body];
      // From the centre of the body to the origin.
      RigidMotion &sum = result[motion.body];
      sum.rotation += rotation;
      sum.translation += translation;
      if (n_rotations > 0)
        sum.translation -= cross_product_3d(
            rotation, dealii::Tensor<1, 3>(center_[motion.body]));
    }
    return result;
  }

  unsigned int UnsupportedBodies::body(const Combination &combination) const
  {
    std::vector<double> weight(space_.n_bodies, 0.);
    for (std::size_t k = 0; k < motions_.size(); ++k)
      weight[motions_[k].body] += combination[k] * combination[k];
    return static_cast<unsigned int>(
        std::max_element(weight.begin(), weight.end()) - weight.begin());
  }

  std::string UnsupportedBodies::describe(const Combination &combination) const
  {
    const unsigned int which = body(combination);
    std::vector<double> mode(n_modes_, 0.);
    for (std::size_t k = 0; k < motions_.size(); ++k)
      if (motions_[k].body == which)
        for (unsigned int m = 0; m < n_modes_; ++m)
          mode[m] += combination[k] * motions_[k].coefficient[m];
    return name(which) + " can "
           + rigid_motion_in_words(space_.n_components, mode, center_[which],
                                   radius_[which]);
  }

  void UnsupportedBodies::check(const PointOperator &rows,
                                const std::vector<std::uint8_t> &resists) const
  {
    const auto free = free_motions(rows, resists);
    if (!free.empty())
      fail_in_contact(free, n_resisting(rows, resists));
  }

  void UnsupportedBodies::check(const PointOperator &rows,
                                const LocalElimination &local,
                                const abut_request &request,
                                const std::vector<double> &row_stiffness) const
  {
    const Resisting resisting_rows =
        resisting(rows, local, request, row_stiffness);
    const auto free = free_motions(rows, resisting_rows.now);
    if (free.empty())
      return;
    if (resisting_rows.has_friction
        && free_motions(rows, resisting_rows.sticks).empty())
      fail_slipping(free[0]);
    fail_in_contact(free, n_resisting(rows, resisting_rows.now));
  }

  UnsupportedBodies::Resisting UnsupportedBodies::resisting(
      const PointOperator &rows, const LocalElimination &local,
      const abut_request &request, const std::vector<double> &row_stiffness)
  {
    Resisting result;
    result.now = local.resisting();
    result.sticks = result.now;
    result.has_friction = !local.blocks().empty();
    for (int i = 0; i < rows.n_rows() && result.has_friction; ++i)
    {
      result.sticks[i] = request.state[i] != ABUT_STATE_OPEN;
      // The springs of slipping points vanish at the solution, but for
      // round-off.
      if (rows.is_tangent(i) && !local.is_held(i)
          && local.spring()[i] <= no_spring * rows.weight(i) * row_stiffness[i])
        result.now[i] = 0;
    }
    return result;
  }

  std::vector<UnsupportedBodies::Combination> UnsupportedBodies::free_motions(
      const PointOperator &rows, const std::vector<std::uint8_t> &resists) const
  {
    const unsigned int n = size();
    if (n == 0)
      return {};
    // Energies of unit springs on the rows, then their weight.
    std::vector<double> sums(n * n + 1, 0.);
    for (int i = 0; i < rows.n_rows(); ++i)
    {
      if (!resists[i])
        continue;
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          sums[j * n + k] += rows.weight(i) * gap_[j][i] * gap_[k][i];
      sums[n * n] += rows.weight(i);
    }
    MPI::sum(sums, rows.communicator(), sums);
    const double weight = sums[n * n];
    for (unsigned int k = 0; weight > 0. && k < n * n; ++k)
      sums[k] /= weight;
    return null_space(n, sums.data(), free_gap);
  }

  double n_resisting(const PointOperator &rows,
                     const std::vector<std::uint8_t> &resists)
  {
    return MPI::sum(
        static_cast<double>(resists.size()
                            - std::count(resists.begin(), resists.end(), 0)),
        rows.communicator());
  }

  void UnsupportedBodies::fail_in_contact(const std::vector<Combination> &free,
                                          const double n_rows) const
  {
    fail(free, n_rows, "points in contact",
         "tie it, or start with the bodies in contact: a smaller initial gap, "
         "or a prescribed displacement instead of a force");
  }

  void UnsupportedBodies::fail_driven(const std::vector<Combination> &free,
                                      const PointOperator &rows,
                                      const double n_rows) const
  {
    constexpr double parallel = 1e-6;
    const std::vector<double> change = gap_change(free[0]);
    double opening = 0.;
    for (int i = 0; i < rows.n_rows(); ++i)
      opening += !rows.is_tangent(i) && change[i] > parallel;
    opening = MPI::sum(opening, rows.communicator());
    if (opening == 0.)
      fail_in_contact(free, n_rows);
    std::ostringstream text;
    text << "Bodies without supports: " << describe(free[0])
         << ", and the loads push it there. This motion opens " << opening
         << (opening == 1. ? " gap" : " gaps")
         << ", closes none and meets no support. Check the signs of the "
            "loads and of the radius, formula or normal of the other "
            "surface, or support the body in that direction.";
    throw_failure(free[0], coded(ABUT_FAILURE_FLOATING_BODY, text.str()));
  }

  void UnsupportedBodies::fail_slipping(const Combination &free) const
  {
    throw_failure(free,
                  coded(ABUT_FAILURE_FREE_SLIDING,
                        "Friction does not carry the bodies: " + describe(free)
                            + " once its contacts slip. Support the body "
                              "in that direction, load it less along the "
                              "surface, or give the pair a larger "
                              "coefficient of friction."));
  }

  void UnsupportedBodies::fail(const std::vector<Combination> &free,
                               const double n_rows, const std::string &which,
                               const std::string &or_else) const
  {
    std::ostringstream text;
    text << "Bodies without supports: " << describe(free[0]);
    if (free.size() > 1)
      text << ", and " << free.size() - 1 << " more such motion"
           << (free.size() > 2 ? "s" : "") << " meet";
    text << (free.size() > 1 ? "" : ", which meets")
         << " no resistance from supports or from the " << n_rows << ' '
         << which
         << ". Support the body in that direction (frictionless contact "
            "constrains the normal only), "
         << or_else << '.';
    throw_failure(free[0], coded(ABUT_FAILURE_FLOATING_BODY, text.str()));
  }

  void UnsupportedBodies::throw_failure(const Combination &free,
                                        Message message) const
  {
    message.body = static_cast<int>(body(free));
    throw SolverFailure(message);
  }
} // namespace abut::solve
