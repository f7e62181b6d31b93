// SPDX-License-Identifier: LGPL-2.1-or-later
// Results of a contact solve, as numbers and as nodal fields.
#include "contact_problem.h"

#include <algorithm>
#include <cmath>

namespace abut::shim
{
  namespace MPI = dealii::Utilities::MPI;

  namespace
  {
    template <int dim> class PresentResults : public ContactResults<dim>
    {
    public:
      explicit PresentResults(const ContactProblem<dim> &problem) : i(problem)
      {
      }

      ContactMeasures measures() const override
      {
        i.host.check_unchanged("measures()");
        ContactMeasures result;
        result.n_rows = i.rows.n_rows;
        result.n_own_rows = i.rows.coefficients.n_rows();
        const abut_progress progress = i.progress();
        result.n_active = progress.n_active;
        const double penalty = penalty_of(progress);
        // Force, sums of p g and p, squares of residuals; penetrations.
        double sums[4] = {0., 0., 0., 0.}, largest[2] = {0., 0.};
        for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
          measure(row, penalty, sums, largest);
        MPI::sum(sums, i.communicator, sums);
        MPI::max(largest, i.communicator, largest);
        result.force = sums[0];
        result.complementarity = sums[2] > 0. ? sums[1] / sums[2] : 0.;
        result.complementarity_error = std::sqrt(sums[3]);
        result.penetration = largest[0];
        if (penalty > 0.)
          result.allowed_penetration =
              largest[1]
              + i.input.method.options.allowed_penetration
                    * i.input.method.options.length_scale;
        return result;
      }

      std::vector<PairResult<dim>> pairs() const override
      {
        return pairs_at(nullptr);
      }

      std::vector<PairResult<dim>>
      pairs(const la::VectorView &displacement) const override
      {
        return pairs_at(&i.given("pairs()", "displacement", displacement));
      }

      la::Vector pressure() const override
      {
        i.host.check_unchanged("pressure()");
        return i.present_source().pressure(i.row_pressures().data());
      }

      la::Vector gap() const override
      {
        i.host.check_unchanged("gap()");
        return i.present_source().gap(i.rows.gap.data());
      }

      la::Vector slip() const override
      {
        i.host.check_unchanged("slip()");
        // The field has p n - tau, by the numbers of the rows.
        std::vector<double> values(i.rows.coefficients.n_rows(), 0.);
        const std::vector<std::uint8_t> states = i.row_states();
        for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
          if (i.rows.coefficients.is_tangent(row)
              && states[row] != ABUT_STATE_OPEN)
            values[row] = -i.rows.gap[row];
        return i.present_source().slip(values.data());
      }

      la::Vector status() const override
      {
        i.host.check_unchanged("status()");
        return i.present_source().status(i.row_states().data());
      }

      void add_forces(const la::MutableVectorView &given,
                      const ForcePart part) const override
      {
        i.check_rows("add_forces()");
        la::Vector &forces =
            i.host.mutable_vector("add_forces()", "force", given);
        if (part == ForcePart::at_free)
        {
          i.add_forces_of_law(forces);
          return;
        }
        if (i.surfaces == nullptr)
          return;
        std::vector<double> pressures = i.row_pressures();
        for (int row = 0; row < i.rows.coefficients.n_rows(); ++row)
          if (part == ForcePart::of_pressures
              && i.rows.coefficients.is_tangent(row))
            pressures[row] = 0.;
        la::Vector all(forces);
        all = 0.;
        i.surfaces->fields().find_forces(pressures, all);
        if (part == ForcePart::of_pressures)
        {
          forces += all;
          return;
        }
        const dealii::IndexSet &owned = i.host.owned();
        for (const auto &line : i.host.constraints().get_lines())
          if (owned.is_element(line.index))
            forces(line.index) += all(line.index);
        forces.compress(dealii::VectorOperation::add);
      }

      dealii::IndexSet candidate_nodes() const override
      {
        i.check_rows("candidate_nodes()");
        const dealii::IndexSet &owned = i.host.owned();
        la::Vector count(owned, i.communicator);
        const std::vector<std::uint8_t> all(i.rows.coefficients.n_rows(), 1);
        i.rows.coefficients.add_counts(all.data(), count);
        dealii::IndexSet result(owned.size());
        for (int k = 0; k < la::n_owned(count); ++k)
          if (la::data(count)[k] > 0.)
            result.add_index(owned.nth_index_in_set(k));
        result.compress();
        return result;
      }

      ContactEffort effort() const override
      {
        ContactEffort result{i.system.report,
                             i.surface_search.detection,
                             {},
                             i.surface_search.sent_before};
        for (std::uint64_t *count :
             {&result.detection.searches, &result.detection.reuses,
              &result.detection.rebuilds, &result.detection.refits,
              &result.detection.gatherings})
          *count = MPI::max(*count, i.communicator);
        result.detection.seconds =
            MPI::max(result.detection.seconds, i.communicator);
        if (i.surfaces != nullptr)
          result.points = {i.surfaces->n_finds(), i.surfaces->n_kept()};
        if (i.surfaces != nullptr && i.rows.are_found)
          i.surface_search.elements.compare(
              i.surfaces->points().contact_elements(), result.detection,
              i.communicator);
        CommunicationReport &sent = result.communication;
        sent.messages += i.history.sent().messages;
        sent.bytes += i.history.sent().bytes;
        if (i.surface_search.exchange == nullptr)
          return result;
        const CommunicationReport now =
            i.surface_search.exchange->communication();
        sent.messages += now.messages;
        sent.bytes += now.bytes;
        sent.gathered_bytes += now.gathered_bytes;
        sent.own_facets = now.own_facets;
        sent.ghost_facets = now.ghost_facets;
        return result;
      }

    private:
      /** Null: moments are those of the last examine(). */
      std::vector<PairResult<dim>>
      pairs_at(const la::Vector *displacement) const
      {
        i.host.check_unchanged("pairs()");
        if (i.surfaces == nullptr)
          return {};
        const std::vector<double> pressures = i.row_pressures();
        const std::vector<std::uint8_t> states = i.row_states();
        return i.surfaces->examination().results(
            displacement, pressures.data(), i.rows.gap.data(), states.data(),
            late_force(pressures, states));
      }

      /** By which pressures let bodies into each other; 0: by none. */
      double penalty_of(const abut_progress &progress) const
      {
        const abut_law *law = i.input.method.options.law;
        // Multipliers shared by the nodes close gaps of points in the mean
        // only; what is left of them is a penalty.
        const bool is_closed =
            abut_law_updates_multipliers(law)
            && (i.surfaces == nullptr || !i.surfaces->set().has_points());
        return !i.is_started || !abut_law_has_penalty(law) || is_closed
                   ? 0.
                   : progress.penalty;
      }

      /** [pairs] this rank's part of PairResult::late_force. */
      std::vector<double>
      late_force(const std::vector<double> &pressure,
                 const std::vector<std::uint8_t> &state) const
      {
        std::vector<double> result(i.input.pairs.size(), 0.);
        const std::vector<int> pair = i.surfaces->points().row_pairs();
        for (const std::int32_t row : i.rows.late)
          if (i.is_started && state[row] == ABUT_STATE_SLIP)
            result[pair[row]] +=
                i.rows.coefficients.weight(row) * pressure[row];
        return result;
      }

      /** Add one row. */
      void measure(const int row, const double penalty, double (&sums)[4],
                   double (&largest)[2]) const
      {
        const auto &rows = i.rows.coefficients;
        const bool is_tie = rows.bilateral()[row] != 0,
                   is_tangent = rows.is_tangent(row);
        const double p = i.row_pressure(row), g = i.rows.gap[row],
                     weight = rows.weights()[row];
        if (i.surfaces == nullptr)
          sums[0] += weight * p * rows.coefficient(rows.begin(row));
        else if (!is_tie && !is_tangent)
          sums[0] += weight * p;
        if (i.is_started)
        {
          // Points that stick must not slip, and the forces of points that slip
          // are exact.
          const double s = i.scales.stiffness[row];
          const bool sticks =
              is_tangent && i.request.state[row] == ABUT_STATE_CLOSED;
          const double residual = is_tie || sticks ? g
                                  : is_tangent     ? i.law_defect(row, g)
                                                   : std::min(g, p / s);
          sums[3] += weight * s * residual * residual;
        }
        if (is_tangent)
          return;
        sums[1] += weight * std::abs(p * g);
        sums[2] += weight * std::abs(p);
        largest[0] = std::max(largest[0], is_tie ? std::abs(g) : -g);
        if (penalty > 0. && !is_tie)
          largest[1] =
              std::max(largest[1], p / (penalty * i.scales.stiffness[row]));
      }

      const ContactProblem<dim> &i;
    };
  } // namespace

  template <int dim>
  std::unique_ptr<ContactResults<dim>>
  make_results(const ContactProblem<dim> &problem)
  {
    return std::make_unique<PresentResults<dim>>(problem);
  }

  template std::unique_ptr<ContactResults<2>>
  make_results(const ContactProblem<2> &);
  template std::unique_ptr<ContactResults<3>>
  make_results(const ContactProblem<3> &);
} // namespace abut::shim
