// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_NODAL_OBSTACLE_ROWS_H
#define ABUT_SHIM_NODAL_OBSTACLE_ROWS_H

#include "nodal_candidates.h"
#include "row_source.h"

#include <abut/dealii/contact_assembler.h>

namespace abut::shim
{
  /** A membrane above, below or between obstacles: one point with a single
   * node per support point and obstacle. Nodes are the owned unknowns. */
  template <int dim> class NodalObstacleRows : public RowSource
  {
  public:
    /** All references must outlive this object. Collective. */
    NodalObstacleRows(const dealii::Mapping<dim> &mapping,
                      const dealii::DoFHandler<dim> &dof_handler,
                      const dealii::AffineConstraints<double> &constraints,
                      const Obstacle<dim> &obstacle);

    int dimension() const override
    {
      return 1;
    }
    Change find(const la::Vector &displacement, abut_points *points) override;
    void filter(const std::vector<std::uint8_t> &keep) override;
    const solve::NodeMap &nodes() const override
    {
      return nodes_;
    }
    std::uint64_t mesh_signature() const override;
    std::vector<double> row_pressure(const la::Vector &field) const override;
    la::Vector pressure(const double *row_pressure) const override;
    la::Vector gap(const double *row_gap) const override;
    la::Vector status(const std::uint8_t *row_state) const override;
    std::vector<std::uint8_t> relax(const Tangent &tangent,
                                    const la::Vector &residual,
                                    const std::vector<double> &gap,
                                    unsigned int n_sweeps,
                                    la::Vector &displacement) const override;
    std::vector<FacetPenetration>
    facet_penetrations(const la::Vector &displacement,
                       const std::uint8_t *row_state) override;
    void push_inside(const std::vector<double> &gap, std::vector<double> margin,
                     la::Vector &displacement) const override;

  private:
    int n_rows() const
    {
      return view_.n_points;
    }

    /** The owned unknown of a row. */
    int unknown(const int row) const
    {
      return view_.node[row];
    }

    /** Its dg/du: 1, or -1 below the upper obstacle. */
    double slope(const int row) const
    {
      return view_.coefficient[row];
    }

    bool is_upper(const int row) const
    {
      return slope(row) < 0.;
    }

    void check_obstacles(const std::vector<double> &lower,
                         const std::vector<double> &upper) const;
    void check_prescribed_values() const;
    void append_points(const std::vector<double> &lower,
                       const std::vector<double> &upper, abut_points *points);
    la::Vector nodal_vector() const;
    /** How deep obstacles are in the membrane at @p points with these values;
     * @p height is overwritten by those of the obstacles. Not collective. */
    void find_depth(const std::vector<dealii::Point<dim>> &points,
                    const std::vector<double> &values,
                    std::vector<double> &height, FacetPenetration &found) const;
    /** And how far it is higher there than at these @p nodes. */
    void find_peak(const std::vector<dealii::Point<dim>> &points,
                   const std::vector<double> &values,
                   const std::vector<dealii::Point<dim>> &nodes,
                   FacetPenetration &found) const;

    const dealii::Mapping<dim> &mapping_;
    const dealii::DoFHandler<dim> &dof_handler_;
    const dealii::AffineConstraints<double> &constraints_;
    const Obstacle<dim> obstacle_;
    const MPI_Comm communicator_;
    NodalCandidates<dim> candidates_;
    solve::NodeMap nodes_;
    abut_points_view view_ = {}; ///< of the points of the last find()
  };
} // namespace abut::shim

#endif
