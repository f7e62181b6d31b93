// SPDX-License-Identifier: LGPL-2.1-or-later
// Results of a contact solve, as numbers and as nodal fields.
#include "contact_implementation.h"

#include <algorithm>
#include <cmath>

namespace abut
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    /** At all unknowns, from pressures by row; as many as @p like has.
     * Collective. */
    template <int dim>
    la::Vector forces_of(const shim::SurfaceRows<dim> &surfaces,
                         const std::vector<double> &pressures,
                         const la::Vector &like)
    {
      la::Vector result(like);
      result = 0.;
      surfaces.fields().find_forces(pressures, result);
      return result;
    }
  } // namespace

  template <int dim> double ContactAssembler<dim>::contact_force() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("contact_force()");
    double force = 0.;
    for (int row = 0; row < i.coefficients.n_rows(); ++row)
      if (i.surfaces == nullptr)
        force += i.coefficients.weights()[row] * i.row_pressure(row)
                 * i.coefficients.coefficient(i.coefficients.begin(row));
      else if (i.coefficients.bilateral()[row] == 0
               && !i.coefficients.is_tangent(row))
        force += i.coefficients.weights()[row] * i.row_pressure(row);
    return MPI::sum(force, i.communicator);
  }

  template <int dim>
  std::vector<StepMotion> ContactAssembler<dim>::step_motion(
      const la::VectorView &given_displacement) const
  {
    Implementation &i = *implementation;
    i.check_rows("step_motion()");
    const la::Vector &displacement =
        i.host.vector("step_motion()", "displacement", given_displacement);
    if (i.surfaces == nullptr)
      return {};
    const std::vector<std::uint8_t> states = i.row_states();
    return shim::step_motion(i.surfaces->points(), displacement, states.data());
  }

  template <int dim>
  PartnerChanges ContactAssembler<dim>::partner_changes() const
  {
    PartnerChanges result = implementation->moving.changes();
    for (std::uint64_t *count : {&result.lost, &result.jumped})
      *count = MPI::sum(*count, implementation->communicator);
    return result;
  }

  template <int dim>
  typename ContactAssembler<dim>::PointCount
  ContactAssembler<dim>::point_count() const
  {
    const Implementation &i = *implementation;
    return i.surfaces == nullptr
               ? PointCount()
               : PointCount{i.surfaces->n_finds(), i.surfaces->n_kept()};
  }

  template <int dim>
  DetectionReport ContactAssembler<dim>::detection_report() const
  {
    const Implementation &i = *implementation;
    DetectionReport result = i.detection;
    for (std::uint64_t *count :
         {&result.searches, &result.reuses, &result.rebuilds, &result.refits,
          &result.gatherings})
      *count = MPI::max(*count, i.communicator);
    result.seconds = MPI::max(result.seconds, i.communicator);
    if (i.surfaces != nullptr && i.has_rows)
      i.elements.compare(i.surfaces->points().contact_elements(), result,
                         i.communicator);
    return result;
  }

  template <int dim> double ContactAssembler<dim>::complementarity() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("complementarity()");
    double sums[2] = {0., 0.};
    for (int row = 0; row < i.coefficients.n_rows(); ++row)
    {
      if (i.coefficients.is_tangent(row))
        continue;
      const double p = i.row_pressure(row);
      sums[0] += i.coefficients.weights()[row] * std::abs(p * i.gap[row]);
      sums[1] += i.coefficients.weights()[row] * std::abs(p);
    }
    MPI::sum(sums, i.communicator, sums);
    return sums[1] > 0. ? sums[0] / sums[1] : 0.;
  }

  template <int dim> double ContactAssembler<dim>::complementarity_error() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("complementarity_error()");
    double sum = 0.;
    for (int row = 0; row < i.coefficients.n_rows() && i.is_started; ++row)
    {
      const double s = i.stiffness[row];
      // Points that stick must not slip, and the forces of points that slip are
      // exact.
      const bool sticks = i.coefficients.is_tangent(row)
                          && i.request.state[row] == ABUT_STATE_CLOSED;
      const double residual =
          i.coefficients.bilateral()[row] != 0 || sticks ? i.gap[row]
          : i.coefficients.is_tangent(row)
              ? i.law_defect(row, i.gap[row])
              : std::min(i.gap[row], i.row_pressure(row) / s);
      sum += i.coefficients.weights()[row] * s * residual * residual;
    }
    return std::sqrt(MPI::sum(sum, i.communicator));
  }

  template <int dim> double ContactAssembler<dim>::allowed_penetration() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("allowed_penetration()");
    const abut_law *law = i.method.options.law;
    // Multipliers shared by the nodes close gaps of points in the mean only;
    // what is left of them is a penalty.
    const bool is_closed =
        abut_law_updates_multipliers(law)
        && (i.surfaces == nullptr || !i.surfaces->set().has_points());
    if (!i.is_started || !abut_law_has_penalty(law) || is_closed)
      return 0.;
    const double penalty = progress().penalty;
    double largest = 0.;
    for (int row = 0; row < i.coefficients.n_rows(); ++row)
      if (i.coefficients.bilateral()[row] == 0
          && !i.coefficients.is_tangent(row))
        largest = std::max(largest,
                           i.row_pressure(row) / (penalty * i.stiffness[row]));
    return MPI::max(largest, i.communicator)
           + i.method.options.allowed_penetration
                 * i.method.options.length_scale;
  }

  template <int dim>
  void ContactAssembler<dim>::add_forces_on_supports(
      const la::MutableVectorView &given_forces) const
  {
    const Implementation &i = *implementation;
    i.check_rows("add_forces_on_supports()");
    la::Vector &forces = i.host.mutable_vector("add_forces_on_supports()",
                                               "force", given_forces);
    if (i.surfaces == nullptr)
      return;
    const la::Vector all = forces_of(*i.surfaces, i.row_pressures(), forces);
    const dealii::IndexSet &owned = i.host.owned();
    for (const auto &line : i.host.constraints().get_lines())
      if (owned.is_element(line.index))
        forces(line.index) += all(line.index);
    forces.compress(dealii::VectorOperation::add);
  }

  template <int dim>
  void ContactAssembler<dim>::add_pressure_forces(
      const la::MutableVectorView &given_forces) const
  {
    const Implementation &i = *implementation;
    i.check_rows("add_pressure_forces()");
    la::Vector &forces =
        i.host.mutable_vector("add_pressure_forces()", "force", given_forces);
    if (i.surfaces == nullptr)
      return;
    std::vector<double> pressures = i.row_pressures();
    for (int row = 0; row < i.coefficients.n_rows(); ++row)
      if (i.coefficients.is_tangent(row))
        pressures[row] = 0.;
    forces += forces_of(*i.surfaces, pressures, forces);
  }

  template <int dim> double ContactAssembler<dim>::penetration() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("penetration()");
    double largest = 0.;
    for (int row = 0; row < i.coefficients.n_rows(); ++row)
      if (!i.coefficients.is_tangent(row))
        largest = std::max(largest, i.coefficients.bilateral()[row] != 0
                                        ? std::abs(i.gap[row])
                                        : -i.gap[row]);
    return MPI::max(largest, i.communicator);
  }

  template <int dim> la::Vector ContactAssembler<dim>::pressure() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("pressure()");
    return i.present_source().pressure(i.row_pressures().data());
  }

  template <int dim> la::Vector ContactAssembler<dim>::gap() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("gap()");
    return i.present_source().gap(i.gap.data());
  }

  template <int dim> la::Vector ContactAssembler<dim>::slip() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("slip()");
    // The field has p n - tau, by the numbers of the rows.
    std::vector<double> values(i.coefficients.n_rows(), 0.);
    const std::vector<std::uint8_t> states = i.row_states();
    for (int row = 0; row < i.coefficients.n_rows(); ++row)
      if (i.coefficients.is_tangent(row) && states[row] != ABUT_STATE_OPEN)
        values[row] = -i.gap[row];
    return i.present_source().pressure(values.data());
  }

  template <int dim> la::Vector ContactAssembler<dim>::status() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("status()");
    return i.present_source().status(i.row_states().data());
  }

  template <int dim>
  double ContactAssembler<dim>::imbalance(const la::VectorView &given_residual,
                                          const double least) const
  {
    const Implementation &i = *implementation;
    i.check_rows("imbalance()");
    const la::Vector &residual =
        i.host.vector("imbalance()", "residual", given_residual);
    la::Vector contact(residual);
    contact = 0.;
    i.add_forces(contact);
    const double size = std::max(contact.l2_norm(), least);
    contact -= residual;
    return size > 0. ? contact.l2_norm() / size : 0.;
  }

  template <int dim>
  double ContactAssembler<dim>::imbalance(const la::VectorView &residual) const
  {
    const Implementation &i = *implementation;
    const double tolerance = i.method.options.final_linear_tolerance;
    if (!i.is_started || (i.is_nitsche() && i.method.nitsche_theta != 0.))
      return 0.;
    return imbalance(residual, i.smallest_residual / tolerance);
  }

  template <int dim>
  ForceSize ContactAssembler<dim>::size_of_forces(
      const Tangent &tangent, const la::VectorView &given_displacement) const
  {
    const Implementation &i = *implementation;
    i.host.check_mesh("size_of_forces()");
    if (!tangent.has_matrix())
      return {};
    // One of Abut's type is that of a solve, which has examined it.
    const solve::Stiffness stiffness =
        tangent.other() == nullptr
            ? solve::Stiffness(tangent.matrix())
            : i.host.stiffness("size_of_forces()", tangent);
    la::Vector free(
        i.host.vector("size_of_forces()", "displacement", given_displacement));
    if (i.moves())
      i.add_round_off_of_positions(free);
    i.host.constraints().set_zero(free);
    const la::LocalRows rows = la::local_rows(stiffness.matrix());
    const std::vector<double> u = la::gather(stiffness.matrix(), free);
    double sums[2] = {0., 0.};
    for (int row = 0; row < rows.n_rows; ++row)
    {
      double force = 0.;
      for (int k = rows.start[row]; k < rows.start[row + 1]; ++k)
        force += std::abs(rows.value[k] * u[rows.column[k]]);
      sums[0] += force * force;
      sums[1] += force * std::abs(u[row]);
    }
    dealii::Utilities::MPI::sum(sums, i.communicator, sums);
    return {std::sqrt(sums[0]), std::sqrt(sums[1])};
  }

  template <int dim>
  std::vector<PairCheck> ContactAssembler<dim>::pair_checks() const
  {
    const auto *surfaces = implementation->surfaces;
    return surfaces == nullptr ? std::vector<PairCheck>()
                               : surfaces->points().checks();
  }

  template <int dim>
  std::vector<PairResult<dim>> ContactAssembler<dim>::pair_results() const
  {
    const Implementation &i = *implementation;
    i.host.check_unchanged("pair_results()");
    if (i.surfaces == nullptr)
      return {};
    const std::vector<double> pressure = i.row_pressures();
    const std::vector<std::uint8_t> state = i.row_states();
    return i.surfaces->examination().results(pressure.data(), i.gap.data(),
                                             state.data());
  }

  template <int dim>
  std::vector<double> ContactAssembler<dim>::transfer_errors(
      const la::VectorView &given_displacement) const
  {
    const Implementation &i = *implementation;
    i.check_rows("transfer_errors()");
    const la::Vector &displacement =
        i.host.vector("transfer_errors()", "displacement", given_displacement);
    return i.surfaces == nullptr
               ? std::vector<double>()
               : shim::transfer_errors(i.surfaces->points(), displacement);
  }

  template <int dim>
  std::vector<Penetration<dim>> ContactAssembler<dim>::check_penetration(
      const la::VectorView &given_displacement, const double tolerance)
  {
    Implementation &i = *implementation;
    i.check_rows("check_penetration()");
    const la::Vector &displacement = i.host.vector(
        "check_penetration()", "displacement", given_displacement);
    if (i.surfaces == nullptr)
      return {};
    return shim::penetrations(i.surfaces->points(), displacement, tolerance);
  }

#define ABUT_INSTANTIATE(dim)                                                  \
  template std::vector<StepMotion> ContactAssembler<dim>::step_motion(         \
      const la::VectorView &) const;                                           \
  template DetectionReport ContactAssembler<dim>::detection_report() const;    \
  template PartnerChanges ContactAssembler<dim>::partner_changes() const;      \
  template typename ContactAssembler<dim>::PointCount                          \
  ContactAssembler<dim>::point_count() const;                                  \
  template double ContactAssembler<dim>::contact_force() const;                \
  template double ContactAssembler<dim>::imbalance(const la::VectorView &)     \
      const;                                                                   \
  template ForceSize ContactAssembler<dim>::size_of_forces(                    \
      const Tangent &, const la::VectorView &) const;                          \
  template double ContactAssembler<dim>::complementarity() const;              \
  template double ContactAssembler<dim>::complementarity_error() const;        \
  template double ContactAssembler<dim>::allowed_penetration() const;          \
  template void ContactAssembler<dim>::add_forces_on_supports(                 \
      const la::MutableVectorView &) const;                                    \
  template void ContactAssembler<dim>::add_pressure_forces(                    \
      const la::MutableVectorView &) const;                                    \
  template double ContactAssembler<dim>::penetration() const;                  \
  template double ContactAssembler<dim>::imbalance(const la::VectorView &,     \
                                                   double) const;              \
  template la::Vector ContactAssembler<dim>::pressure() const;                 \
  template la::Vector ContactAssembler<dim>::gap() const;                      \
  template la::Vector ContactAssembler<dim>::slip() const;                     \
  template la::Vector ContactAssembler<dim>::status() const;                   \
  template std::vector<PairCheck> ContactAssembler<dim>::pair_checks() const;  \
  template std::vector<PairResult<dim>> ContactAssembler<dim>::pair_results()  \
      const;                                                                   \
  template std::vector<double> ContactAssembler<dim>::transfer_errors(         \
      const la::VectorView &) const;                                           \
  template std::vector<Penetration<dim>>                                       \
  ContactAssembler<dim>::check_penetration(const la::VectorView &, double);

  ABUT_INSTANTIATE(2)
  ABUT_INSTANTIATE(3)
} // namespace abut
