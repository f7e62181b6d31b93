// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_SOLID_OUTPUT_H
#define ABUT_APP_SOLID_OUTPUT_H

#include "app/pictures/contact_line.h"
#include "app/pictures/field_output.h"

#include <abut/dealii/linear_algebra.h>

#include <vector>

namespace abut::app
{
  template <int dim> class SolidModel;

  /** Nodal fields of contact boundaries, ghosted; empty without pairs. */
  struct ContactFields
  {
    la::Vector traction; ///< force per area on either side
    la::Vector normal;   ///< the part of it that is of pressures
    la::Vector along;    ///< the rest, friction; empty if not told apart
    la::Vector pressure; ///< p n on the secondary side
    la::Vector row_gap;  ///< of mark_rows()
    la::Vector status;   ///< in all components
    la::Vector slip;     ///< of the step, on the secondary side
  };

  /** Fields and contact boundaries of the scene `solid`. */
  template <int dim> class SolidOutput
  {
  public:
    /** Of this model, which must outlive it and know its run. */
    explicit SolidOutput(const SolidModel<dim> &model);

    /** The present solution into the next file of the series, if the scene asks
     * for fields. Collective. */
    void write_fields();

    /** What numbers the files of fields so far were made of. */
    NarrowNumbers written_numbers() const
    {
      NarrowNumbers numbers = series.numbers();
      numbers.add(contact_series.numbers());
      return numbers;
    }

    /** Files of the end: tables of pairs; where pictures are drawn, fields of
     * the present solution unless they are there, and surfaces of obstacles.
     * Collective. */
    void finish();

    /** Surfaces of obstacles near the bodies, which have moved by up to
     * @p motion, as obstacles.vtu. Collective. */
    void write_obstacle_surfaces(double motion) const;

    /** Displacement and forces at all nodes of the present mesh as nodal.csv.
     * Collective. */
    void write_nodal_values() const;

    /** What a checkpoint keeps. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &series &contact_series;
    }

  private:
    double time() const;
    void write_present();
    void write_contact(const la::Vector &displacement);
    /** Tables pair_N.csv, in 2D. */
    void write_lines(const ContactFields &contact_values) const;
    void write_closed_forms() const;
    /** Values along the contact boundary of a pair, on rank 0. */
    std::vector<ContactLine> lines_of(const ContactPair<dim> &pair,
                                      const ContactFields &fields) const;

    const SolidModel<dim> &model;
    FieldSeries series, contact_series;
  };
} // namespace abut::app

#endif
