// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_UNSUPPORTED_BODIES_H
#define ABUT_SOLVE_UNSUPPORTED_BODIES_H

#include "free_bodies.h"
#include "local_elimination.h"
#include "point_operator.h"

#include <abut/dealii/coded.h>

#include <abut/dealii/contact_examination.h>

#include <string>

namespace abut::solve
{
  /** Rigid motions of bodies that a stiffness does not resist, and whether
   * constraint rows do. A system with such a motion left has no solution, or
   * many; iterations and factorisations then fail without an explanation, or
   * not at all. */
  class UnsupportedBodies
  {
  public:
    /** A combination of the motions that K leaves free: a coefficient for
     * each. */
    using Combination = std::vector<double>;

    /** Loads do no work along a motion if it is less, as a part of the sum of
     * their magnitudes times the largest displacement; pressures count as 0
     * likewise. */
    static constexpr double no_work = 1e-10;

    /** Find the motions that K leaves free, unless they are known for this K on
     * this mesh, see find_free_bodies(). Collective. */
    void reinit(const Stiffness &stiffness, const PointOperator &rows,
                const NearNullSpace &space);

    /** Whether K leaves no motion free. */
    bool empty() const
    {
      return bodies_.motions.empty();
    }

    /** Number of motions that K leaves free. */
    unsigned int size() const
    {
      return static_cast<unsigned int>(bodies_.motions.size());
    }

    /** Gaps are known to some 1e-12 of the displacement, energies to the
     * square of it. */
    static constexpr double free_gap = 1e-14;

    /** Combinations of motions that no row with @p resists nonzero resists:
     * the mean square of the changes of their gaps is at most @p tolerance, for
     * displacements of 1. Collective. */
    std::vector<Combination>
    free_motions(const PointOperator &rows,
                 const std::vector<std::uint8_t> &resists,
                 double tolerance = free_gap) const;

    /** Rows that resist a motion. */
    struct Resisting
    {
      std::vector<std::uint8_t> now;    ///< [rows] constraints and springs
      std::vector<std::uint8_t> sticks; ///< [rows] if nothing slipped
      bool has_friction = false;
    };

    /** The rows that resist in the state of a @p request; points that are not
     * open are what would stick. Not collective. */
    static Resisting resisting(const PointOperator &rows,
                               const LocalElimination &local,
                               const abut_request &request,
                               const std::vector<double> &row_stiffness);

    /** [rows] change of the gaps with a motion. */
    std::vector<double> gap_change(const Combination &combination) const;

    /** Add a motion to a displacement. */
    void add(const Combination &combination, la::Vector &displacement) const;

    /** [motions] work of @p forces. Collective. */
    std::vector<double> work(const la::Vector &forces) const;

    /** Motions among these along which @p residual does more work than a
     * @p tolerance. Collective. */
    std::vector<Combination>
    along_which_works(const std::vector<Combination> &motions,
                      const la::Vector &residual, double tolerance) const;

    /** [motions x motions] products of motions and [motions] of motions with a
     * displacement, integrated over the bodies. Collective. */
    void project(const la::Vector &displacement, std::vector<double> &products,
                 std::vector<double> &right) const;

    /** Solve products c = right. */
    static std::vector<double> divide(const std::vector<double> &products,
                                      const std::vector<double> &right);

    /** The rigid part of a displacement, of each body with a free motion.
     * Collective. */
    std::vector<BodyMotion> rigid_part(const la::Vector &displacement) const;

    /** Volume that belongs to an unknown, or 1. */
    double share(const int i) const
    {
      return space_.share.empty() ? 1. : space_.share[i];
    }

    /** Size of the smallest body with a free motion: half its diameter. */
    double smallest_radius() const;

    /** [bodies] the same motion of each body. */
    std::vector<RigidMotion> of_bodies(const Combination &combination) const;

    /** The body that takes part most in a motion, from 0. */
    unsigned int body(const Combination &combination) const;

    /** The body and its motion, as "body 1 can rotate about (0, 1)". */
    std::string describe(const Combination &combination) const;

    /** The bodies that take part in motions, as "body 1 and body 2". */
    std::string names(const std::vector<Combination> &motions) const;

    /** Throw the message, with the body that the motion is of. */
    [[noreturn]] void throw_failure(const Combination &free,
                                    Message message) const;

    /** Throw SolverFailure F12: the first of these motions is free in the
     * presence of @p n_rows rows. */
    [[noreturn]] void fail(const std::vector<Combination> &free, double n_rows,
                           const std::string &which,
                           const std::string &or_else) const;
    /** The same for rows in contact. */
    [[noreturn]] void fail_in_contact(const std::vector<Combination> &free,
                                      double n_rows) const;
    /** The same, the first motion in the direction in which loads drive it, and
     * stopped by no gap of @p rows: if it opens gaps, a sign is likely to be
     * wrong. Collective. */
    [[noreturn]] void fail_driven(const std::vector<Combination> &free,
                                  const PointOperator &rows,
                                  double n_rows) const;
    /** The same F42: friction is too weak. */
    [[noreturn]] void fail_slipping(const Combination &free) const;

    /** Throw SolverFailure if rows with @p resists nonzero leave a motion
     * free: the message names the body and the motion. O(rows) for each motion
     * that K leaves free. Collective. */
    void check(const PointOperator &rows,
               const std::vector<std::uint8_t> &resists) const;

    /** The same with what constraints and springs of a @p request resist, for
     * rows with @p row_stiffness; if it has friction, points that are not open
     * are what would stick. Collective. */
    void check(const PointOperator &rows, const LocalElimination &local,
               const abut_request &request,
               const std::vector<double> &row_stiffness) const;

  private:
    std::string name(unsigned int body) const;

    NearNullSpace space_;
    FreeBodies bodies_;
    /** [motions][rows] change of the gaps with each motion. */
    std::vector<std::vector<double>> gap_;
  };

  /** Number of rows with @p resists nonzero. Collective. */
  double n_resisting(const PointOperator &rows,
                     const std::vector<std::uint8_t> &resists);
} // namespace abut::solve

#endif
