// SPDX-License-Identifier: LGPL-2.1-or-later
// Checks of the problem and of its answer, but for examine().
#include "contact_problem.h"

#include "solve/unsupported_bodies.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    template <int dim> class PresentChecks : public ContactChecks<dim>
    {
    public:
      explicit PresentChecks(ContactProblem<dim> &problem) : i(problem)
      {
      }

      std::vector<PairCheck> pairs() const override
      {
        return i.surfaces == nullptr ? std::vector<PairCheck>()
                                     : i.surfaces->points().checks();
      }

      void supports(const Tangent &tangent,
                    const la::VectorView &given_residual) const override
      {
        i.check_rows("supports()");
        const solve::Stiffness stiffness =
            i.host.stiffness("supports()", tangent);
        if (i.surfaces == nullptr)
          return;
        solve::UnsupportedBodies unsupported;
        unsupported.reinit(stiffness, i.rows.coefficients, i.near_null_space());
        const std::vector<std::uint8_t> all(i.rows.coefficients.n_rows(), 1);
        auto free = unsupported.free_motions(i.rows.coefficients, all);
        if (given_residual)
        {
          const la::Vector &residual =
              i.host.vector("supports()", "residual", given_residual);
          free = unsupported.along_which_works(free, residual,
                                               solve::UnsupportedBodies::no_work
                                                   * residual.l1_norm());
        }
        if (!free.empty())
          unsupported.fail(free, solve::n_resisting(i.rows.coefficients, all),
                           "contact rows, open or not", "or tie it");
        if (given_residual && i.is_started)
          check_closed(unsupported,
                       i.host.vector("supports()", "residual", given_residual));
      }

      std::vector<Penetration<dim>>
      penetrations(const la::VectorView &given_displacement,
                   const double tolerance) const override
      {
        const la::Vector &displacement =
            i.given("penetrations()", "displacement", given_displacement);
        if (i.surfaces == nullptr)
          return {};
        return shim::penetrations(i.surfaces->points(), displacement,
                                  tolerance);
      }

      ContactExamination examine(const la::VectorView &displacement,
                                 const la::VectorView &residual,
                                 const bool allow_large_strain) const override
      {
        return shim::examine(i, displacement, residual, allow_large_strain);
      }

      double missed_depth(const la::VectorView &given_displacement,
                          dealii::Vector<float> &depth) const override
      {
        const la::Vector &displacement =
            i.given("missed_depth()", "displacement", given_displacement);
        depth.reinit(i.host.dof_handler().get_triangulation().n_active_cells());
        // Peaks that are more than this part of what bodies are deformed by.
        constexpr double visible_peak = 0.1;
        const double least_peak =
            visible_peak * i.scales.deformation(displacement);
        double largest = 0.;
        for (const FacetPenetration &found :
             i.source->facet_penetrations(displacement, i.row_states().data()))
          if (found.is_missed || found.peak > least_peak)
          {
            const double here = found.is_missed ? found.depth : found.peak;
            depth(found.cell) =
                std::max(depth(found.cell), static_cast<float>(here));
            largest = std::max(largest, here);
          }
        return MPI::max(largest, i.communicator);
      }

      std::vector<double>
      transfer_errors(const la::VectorView &given_displacement) const override
      {
        const la::Vector &displacement =
            i.given("transfer_errors()", "displacement", given_displacement);
        return i.surfaces == nullptr
                   ? std::vector<double>()
                   : shim::transfer_errors(i.surfaces->points(), displacement);
      }

      std::vector<StepMotion>
      step_motion(const la::VectorView &given_displacement) const override
      {
        const la::Vector &displacement =
            i.given("step_motion()", "displacement", given_displacement);
        if (i.surfaces == nullptr)
          return {};
        const std::vector<std::uint8_t> states = i.row_states();
        return shim::step_motion(i.surfaces->points(), displacement,
                                 states.data());
      }

      PartnerChanges partner_changes() const override
      {
        PartnerChanges result = i.moving.changes();
        for (std::uint64_t *count : {&result.lost, &result.jumped})
          *count = MPI::sum(*count, i.communicator);
        return result;
      }

      double imbalance(const la::VectorView &given_residual,
                       const double least) const override
      {
        const auto [rest, size] = balance(given_residual, least);
        return size > 0. ? rest / size : 0.;
      }

      double imbalance(const la::VectorView &residual) const override
      {
        const double tolerance = i.input.method.options.final_linear_tolerance;
        if (!i.is_started
            || (i.input.is_nitsche() && i.input.method.nitsche_theta != 0.))
          return 0.;
        const auto [rest, size] =
            balance(residual, i.scales.smallest_residual / tolerance);
        return rest <= i.scales.round_off() || size == 0. ? 0. : rest / size;
      }

      ForceSize
      size_of_forces(const Tangent &tangent,
                     const la::VectorView &given_displacement) const override
      {
        i.host.check_mesh("size_of_forces()");
        if (!tangent.has_matrix())
          return {};
        // One of Abut's type is that of a solve, which has examined it.
        const solve::Stiffness stiffness =
            tangent.other() == nullptr
                ? solve::Stiffness(tangent.matrix())
                : i.host.stiffness("size_of_forces()", tangent);
        la::Vector free(i.host.vector("size_of_forces()", "displacement",
                                      given_displacement));
        if (i.moves())
          add_round_off_of_positions(free);
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

    private:
      /** The same for points that are closed where an iteration has ended:
       * whether loads rotate a body about them. */
      void check_closed(const solve::UnsupportedBodies &unsupported,
                        const la::Vector &residual) const
      {
        constexpr double small_gaps = 1e-2, visible_work = 1e-2;
        const solve::PointOperator &rows = i.rows.coefficients;
        std::vector<std::uint8_t> resists(rows.n_rows());
        for (int row = 0; row < rows.n_rows(); ++row)
          resists[row] = rows.bilateral()[row] != 0
                         || i.request.state[row] == ABUT_STATE_CLOSED;
        const auto weak = unsupported.along_which_works(
            unsupported.free_motions(rows, resists, small_gaps), residual,
            visible_work * residual.l1_norm());
        if (weak.empty())
          return;
        const double n = solve::n_resisting(rows, resists);
        std::ostringstream text;
        text << "Bodies without supports: " << unsupported.describe(weak[0])
             << ", and the loads push it there. The " << n
             << (n == 1. ? " point in contact hardly resists"
                         : " points in contact hardly resist")
             << " this motion. Support the body in "
                "that direction, or let the loads pass through the contact.";
        unsupported.throw_failure(weak[0],
                                  coded(ABUT_FAILURE_FLOATING_BODY, text.str(),
                                        {{"points in contact", n}}));
      }

      /** Norms of what is out of balance, and of the contact forces or @p
       * least.
       */
      std::pair<double, double> balance(const la::VectorView &given_residual,
                                        const double least) const
      {
        const la::Vector &residual =
            i.given("imbalance()", "residual", given_residual);
        la::Vector contact(residual);
        contact = 0.;
        i.add_forces(contact);
        const double size = std::max(contact.l2_norm(), least);
        contact -= residual;
        return {contact.l2_norm(), size};
      }

      /** Add the part of the coordinates that stands for the round-off of gaps
       * and strains at points that move. */
      void add_round_off_of_positions(la::Vector &displacement) const
      {
        // Round-off of displacements counts a hundred times in forces; that of
        // positions cancels but for a facet, a tenth of a body.
        constexpr double part = 1e-3;
        const auto &point = i.near_null_space().point;
        for (std::size_t k = 0; k < point.size(); ++k)
          la::data(displacement)[k] =
              std::abs(la::data(displacement)[k])
              + part * dealii::Tensor<1, 3>(point[k]).norm();
      }

      ContactProblem<dim> &i;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContactChecks<dim>> make_checks(ContactProblem<dim> &problem)
  {
    return std::make_unique<PresentChecks<dim>>(problem);
  }

  template std::unique_ptr<ContactChecks<2>> make_checks(ContactProblem<2> &);
  template std::unique_ptr<ContactChecks<3>> make_checks(ContactProblem<3> &);
} // namespace abut::shim
