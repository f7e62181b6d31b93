// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MASS_ROW_H
#define ABUT_APP_MASS_ROW_H

#include <abut/time.h>

#include <deal.II/base/parameter_handler.h>

#include <cstdint>
#include <string>
#include <vector>

namespace abut::app
{
  /** What a row of masses is made of. */
  struct MassRow
  {
    /** Directions in which each mass moves: those along the plane, then its
     * height. With one, the row stands on the plane; else it lies above it. */
    unsigned int dimension = 1;
    std::size_t n = 1;      /**< masses */
    double mass = 1;        /**< of each; of a bar: of each element */
    double spring = 0;      /**< between neighbours, along the row */
    double wall_spring = 0; /**< from the last mass to a wall */
    /** A bar of linear elements: the masses are its nodes. */
    bool is_bar = false;
    /** Of a bar: the end far from the plane, one element behind the last node,
     * does not move. */
    bool fixed_end = false;
  };

  /** Declare the parameters of section `Masses` that all rows have.
   * @param spring stiffness between neighbours by default */
  void declare_row(dealii::ParameterHandler &prm, const std::string &spring);

  /** Matrices of masses that move, dense; unknown d of mass i is number
   * i * dimension + d. */
  struct MassSystem
  {
    MassSystem(const MassRow &row);

    std::size_t size() const
    {
      return n * dimension;
    }

    /** Let the mass be what a scheme is made for. Returns why it cannot be
     * so; empty if it is. */
    std::string use_mass(abut_time_mass kind, abut_mass_rule rule);

    unsigned int dimension;
    std::size_t n;
    bool is_bar;
    std::vector<double> stiffness, mass; /**< [size^2] */
    /** [n] of each mass's row before anything is handed on: what loads act on.
     */
    std::vector<double> share;
    std::vector<std::size_t> candidates; /**< masses that the plane may stop */
    std::vector<std::uint8_t> massless;  /**< [size] */

  private:
    void lump();
    std::string hand_on(abut_mass_rule rule);
  };
} // namespace abut::app

#endif
