// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_ROW_SOURCE_H
#define ABUT_SHIM_ROW_SOURCE_H

#include "point_number.h"
#include "solve/gap_line.h"
#include "solve/node_map.h"

#include <abut/dealii/host_operator.h>
#include <abut/points.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace abut::shim
{
  /** A facet, or a cell of a membrane, that an obstacle is in. */
  struct FacetPenetration
  {
    std::size_t pair = 0;  ///< 0 of membranes
    unsigned int cell = 0; ///< index of the active cell
    double depth = 0.;     ///< of the deepest sample, length > 0
    double size = 0.;      ///< of the facet, length; 0 of membranes
    /** The part of it that the nodes do not see: gaps at zero displacement are
     * that much smaller there than at all nodes of the facet or cell. */
    double peak = 0.;
    bool is_missed = true;            ///< there is no contact at all
    std::array<double, 3> place = {}; ///< of that sample, where it is now
  };

  /** Entries of a row of a matrix, by unknowns. */
  struct MatrixLine
  {
    dealii::types::global_dof_index row = 0;
    std::vector<dealii::types::global_dof_index> column;
    std::vector<double> value;
  };

  /** A way to make contact points from a DoFHandler, and to bring what is known
   * of their components, the rows of the linear systems, back to its unknowns.
   * All else in the assembler deals with points and rows only. */
  class RowSource
  {
  public:
    virtual ~RowSource() = default;

    /** Difference from the find() before. */
    enum class Change
    {
      none,
      constants, ///< prescribed values in nodes() alone
      points
    };

    /** Unknowns of a node. */
    virtual int dimension() const = 0;

    /** Replace @p points, which must outlive their use here, by those for the
     * bodies displaced by @p displacement (owned entries). Points that would be
     * the same are left as they are, filter() and all. Throws on all ranks; the
     * next call makes them again then. Collective. */
    virtual Change find(const la::Vector &displacement,
                        abut_points *points) = 0;

    /** Mark with 0 the rows that are no constraints although they have
     * unknowns: contacts with friction, or beside such, that another one of the
     * same node and direction keeps from closing. Tangents stay with their
     * normal, also without unknowns: friction there is a force on supports. Not
     * collective. */
    virtual void drop_needless(std::vector<std::uint8_t> &) const
    {
    }

    /** Keep those rows only; see abut_points_filter(). */
    virtual void filter(const std::vector<std::uint8_t> &keep) = 0;

    /** Whether points move with the bodies: find() makes those at its
     * displacement, with gaps that are right there. */
    virtual bool moves() const
    {
      return false;
    }

    /** Minus the second derivatives of the gaps of this rank's points, times
     * their weights and @p row_pressure [rows]: what the force of these
     * pressures changes with the unknowns because points move, as a residual
     * sees it. Without pressures (null) the same places with any values. Equal
     * places add up. */
    virtual std::vector<MatrixLine> geometric_lines(const double *) const
    {
      return {};
    }

    /** The rows of nodes but for tangents; of those with @p wanted nonzero with
     * what their gaps change by because directions and coefficients do where
     * points are made. */
    virtual std::vector<solve::GapLine>
    gap_lines(const std::vector<std::uint8_t> &) const
    {
      return {};
    }

    /** The unknowns of the points' nodes. */
    virtual const solve::NodeMap &nodes() const = 0;

    /** A number that is the same for the same points: where it is equal,
     * numbers of rows are those of the same points. Never 0. Collective. */
    virtual std::uint64_t mesh_signature() const = 0;

    /** The rows whose points have no number that lasts. */
    virtual std::vector<PlacedRow> placed_rows() const
    {
      return {};
    }

    /** Points with friction, in the order of their rows. */
    struct FrictionalPoints
    {
      bool any = false;                     ///< on any rank
      std::vector<std::int32_t> first;      ///< row of the normal
      std::vector<std::uint8_t> n_tangents; ///< rows behind it
      std::vector<double> coefficient, cap; ///< mu, and largest traction
      /** [tangents] what supports leave of them, see abut_tangent */
      std::vector<std::uint8_t> tangent;
      /** Points, by their place in these lists, and normals of other contacts
       * of the same node. */
      std::vector<std::int32_t> rival_point, rival_row;
    };

    /** Friction of the present points. Throws on all ranks. Collective. */
    virtual FrictionalPoints friction() const
    {
      return {};
    }

    /** Reference of the slips of tangents. */
    struct SlipReference
    {
      std::vector<double> value; ///< [rows] empty: 0
      /** [rows] nonzero: the slip is minus the value, whatever the unknowns. */
      std::vector<std::uint8_t> is_prescribed;

      /** From the rows' values to slips, in place. */
      void subtract_from(std::vector<double> &gap) const
      {
        for (std::size_t row = 0; row < value.size(); ++row)
          gap[row] = (is_prescribed[row] != 0 ? 0. : gap[row]) - value[row];
      }
    };

    /** The values of tangents at the displacement of the last commit(),
     * prescribed values as they were then (empty: 0), and what obstacles have
     * moved since; 0 in other rows. Collective. */
    virtual SlipReference slip_reference(const la::Vector &)
    {
      return {};
    }

    /** Pressure of each row from a field as pressure() makes it; may be
     * negative. Collective. */
    virtual std::vector<double> row_pressure(const la::Vector &field) const = 0;

    /** The field of pressures that the host sees, from [rows] values.
     * Collective. */
    virtual la::Vector pressure(const double *row_pressure) const = 0;

    /** The field of slips, from [rows] values that are 0 but at tangents.
     * Collective. */
    virtual la::Vector slip(const double *row_slip) const
    {
      return pressure(row_slip);
    }

    /** The field of gaps, 0 where there is no row. Collective. */
    virtual la::Vector gap(const double *row_gap) const = 0;

    /** The field of states, -1 where there is no row; @p row_state may be
     * null (nothing solved yet). Collective. */
    virtual la::Vector status(const std::uint8_t *row_state) const = 0;

    /** Improve the start by projected relaxation, if these rows allow it:
     * changes @p displacement and returns the states of the rows, or returns
     * nothing and changes nothing, as rows over several unknowns, which are not
     * relaxed one by one. Rows that do need a matrix. Collective. */
    virtual std::vector<std::uint8_t> relax(const Tangent &, const la::Vector &,
                                            const std::vector<double> &,
                                            unsigned int, la::Vector &) const
    {
      return {};
    }

    /** Where obstacles are in the deformed surface of this rank, by samples
     * between its nodes; @p row_state may be null. Throws on all ranks.
     * Collective. */
    virtual std::vector<FacetPenetration>
    facet_penetrations(const la::Vector &displacement,
                       const std::uint8_t *row_state) = 0;

    /** Open every gap to at least @p margin, as far as that can be done by
     * moving the nodes of the rows; @p margin [rows], length > 0, @p gap at
     * @p displacement. Collective. */
    virtual void push_inside(const std::vector<double> &gap,
                             std::vector<double> margin,
                             la::Vector &displacement) const = 0;
  };
} // namespace abut::shim

#endif
