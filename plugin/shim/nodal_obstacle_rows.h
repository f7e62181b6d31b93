// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_NODAL_OBSTACLE_ROWS_H
#define ABUT_SHIM_NODAL_OBSTACLE_ROWS_H

#include "nodal_candidates.h"
#include "row_source.h"

#include <abut/dealii/contact_assembler.h>

namespace abut::shim
{
  /** A membrane above, below or between obstacles: one row with a single
   * coefficient per support point and obstacle. */
  template <int dim> class NodalObstacleRows : public RowSource
  {
  public:
    /** All references must outlive this object. Collective. */
    NodalObstacleRows(const dealii::Mapping<dim> &mapping,
                      const dealii::DoFHandler<dim> &dof_handler,
                      const dealii::AffineConstraints<double> &constraints,
                      const Obstacle<dim> &obstacle);

    void find(const la::Vector &displacement, abut_rows *rows) override;
    std::uint64_t mesh_signature() const override;
    std::vector<double> row_pressure(const la::Vector &field) const override;
    la::Vector pressure(const double *row_pressure) const override;
    la::Vector gap(const double *row_gap) const override;
    la::Vector status(const std::uint8_t *row_state) const override;
    std::vector<std::uint8_t> relax(const la::Matrix &matrix,
                                    const la::Vector &residual,
                                    const std::vector<double> &gap,
                                    unsigned int n_sweeps,
                                    la::Vector &displacement) const override;
    void push_inside(const std::vector<double> &gap, std::vector<double> margin,
                     la::Vector &displacement) const override;

  private:
    /** A row's unknown, as a local number, and which obstacle it is. */
    struct Row
    {
      int unknown;
      bool is_upper;

      /** dg/du. */
      double slope() const
      {
        return is_upper ? -1. : 1.;
      }
    };

    void check_obstacles(const std::vector<double> &lower,
                         const std::vector<double> &upper) const;
    void check_prescribed_values() const;
    void append_rows(const std::vector<double> &lower,
                     const std::vector<double> &upper, abut_rows *rows);
    la::Vector nodal_vector() const;

    const dealii::DoFHandler<dim> &dof_handler_;
    const dealii::AffineConstraints<double> &constraints_;
    const Obstacle<dim> obstacle_;
    const MPI_Comm communicator_;
    NodalCandidates<dim> candidates_;
    std::vector<Row> rows_;
    std::vector<double> initial_gap_; ///< [rows]
  };
} // namespace abut::shim

#endif
