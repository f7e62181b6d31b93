// SPDX-License-Identifier: LGPL-2.1-or-later
#include "unsupported_bodies.h"

#include "kept_parts.h"
#include "rigid_motion_words.h"

#include <abut/dealii/coded.h>
#include <abut/dealii/solver_parameters.h>

#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <sstream>

namespace abut::solve
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** Springs of points that slip count as 0 below this part of the surface's
     * own stiffness. */
    constexpr double no_spring = 1e-9;
  } // namespace

  void UnsupportedBodies::reinit(const Stiffness &stiffness,
                                 const PointOperator &rows,
                                 const NearNullSpace &space)
  {
    space_ = space;
    // The same for other rows.
    KeptParts &kept = *space.kept;
    if (kept.bodies_of != stiffness.values())
    {
      kept.bodies = find_free_bodies(stiffness, space);
      kept.bodies_of = stiffness.values();
    }
    bodies_ = kept.bodies;
    gap_.clear();
    for (const FreeBodies::Motion &motion : bodies_.motions)
    {
      gap_.emplace_back(rows.n_rows());
      rows.times(motion.displacement, gap_.back().data());
    }
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
    for (std::size_t k = 0; k < bodies_.motions.size(); ++k)
      displacement.add(combination[k], bodies_.motions[k].displacement);
  }

  std::vector<double> UnsupportedBodies::work(const la::Vector &forces) const
  {
    std::vector<double> result;
    for (const FreeBodies::Motion &motion : bodies_.motions)
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
    const std::size_t n = bodies_.motions.size();
    std::vector<double> sums(n * n + n, 0.);
    for (std::size_t j = 0; j < n; ++j)
    {
      const double *const own = la::data(bodies_.motions[j].displacement);
      for (int i = 0; i < la::n_owned(displacement); ++i)
      {
        if (own[i] == 0.)
          continue;
        const double moved = own[i] * share(i);
        for (std::size_t k = 0; k < n; ++k)
          sums[j * n + k] +=
              moved * la::data(bodies_.motions[k].displacement)[i];
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
    for (const FreeBodies::Motion &motion : bodies_.motions)
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
                             dealii::Tensor<1, 3>(bodies_.center[body]));
      moved.text = name(body) + " has "
                   + rigid_displacement_in_words(
                       space_.n_components, moved.translation, moved.rotation,
                       bodies_.center[body], bodies_.radius[body]);
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
    for (const FreeBodies::Motion &motion : bodies_.motions)
      result = result > 0. ? std::min(result, bodies_.radius[motion.body])
                           : bodies_.radius[motion.body];
    return result;
  }

  std::vector<RigidMotion>
  UnsupportedBodies::of_bodies(const Combination &combination) const
  {
    std::vector<RigidMotion> result(space_.n_bodies);
    const unsigned int dim = space_.n_components;
    const unsigned int n_rotations = bodies_.n_modes - dim;
    for (std::size_t k = 0; k < bodies_.motions.size(); ++k)
    {
      const FreeBodies::Motion &motion = bodies_.motions[k];
      dealii::Tensor<1, 3> translation, rotation;
      for (unsigned int d = 0; d < dim; ++d)
        translation[d] = combination[k] * motion.coefficient[d];
      for (unsigned int r = 0; r < n_rotations; ++r)
        rotation[n_rotations == 1 ? 2 : r] = combination[k]
                                             * motion.coefficient[dim + r]
                                             / bodies_.radius[motion.body];
      // From the centre of the body to the origin.
      RigidMotion &sum = result[motion.body];
      sum.rotation += rotation;
      sum.translation += translation;
      if (n_rotations > 0)
        sum.translation -= cross_product_3d(
            rotation, dealii::Tensor<1, 3>(bodies_.center[motion.body]));
    }
    return result;
  }

  unsigned int UnsupportedBodies::body(const Combination &combination) const
  {
    std::vector<double> weight(space_.n_bodies, 0.);
    for (std::size_t k = 0; k < bodies_.motions.size(); ++k)
      weight[bodies_.motions[k].body] += combination[k] * combination[k];
    return static_cast<unsigned int>(
        std::max_element(weight.begin(), weight.end()) - weight.begin());
  }

  std::string UnsupportedBodies::describe(const Combination &combination) const
  {
    const unsigned int which = body(combination);
    std::vector<double> mode(bodies_.n_modes, 0.);
    for (std::size_t k = 0; k < bodies_.motions.size(); ++k)
      if (bodies_.motions[k].body == which)
        for (unsigned int m = 0; m < bodies_.n_modes; ++m)
          mode[m] += combination[k] * bodies_.motions[k].coefficient[m];
    return name(which) + " can "
           + rigid_motion_in_words(space_.n_components, mode,
                                   bodies_.center[which],
                                   bodies_.radius[which]);
  }

  std::string
  UnsupportedBodies::names(const std::vector<Combination> &motions) const
  {
    constexpr double visible = 1e-6;
    std::set<unsigned int> bodies;
    for (const Combination &motion : motions)
      for (std::size_t k = 0; k < bodies_.motions.size(); ++k)
        if (std::abs(motion[k]) > visible)
          bodies.insert(bodies_.motions[k].body);
    std::string text;
    for (const unsigned int which : bodies)
      text += (text.empty() ? "" : " and ") + name(which);
    return text;
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

  std::vector<UnsupportedBodies::Combination>
  UnsupportedBodies::free_motions(const PointOperator &rows,
                                  const std::vector<std::uint8_t> &resists,
                                  const double tolerance) const
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
    return null_space(n, sums.data(), tolerance);
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
           << (free.size() > 2 ? "s" : "") << " of " << names(free) << " meet";
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
