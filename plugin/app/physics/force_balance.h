// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_FORCE_BALANCE_H
#define ABUT_APP_FORCE_BALANCE_H

/** @file
 * Where a few rigid coordinates must be for the forces on them to vanish.
 */

#include <cstddef>
#include <vector>

namespace abut::app
{
  /** Finds the place x of n coordinates where the forces on them are in
   * balance, r(x) = 0. To know r costs a contact problem each time; so little
   * else is asked for, and what the last places have told is kept: the
   * stiffness -dr/dx is that of inertia, a diagonal which is known, and that of
   * contact, which comes of differences: at first of one more place for each
   * coordinate, then of all places that are visited (Broyden, Math. Comp. 19,
   * 1965). One coordinate alone is enclosed between places that it is driven
   * to from both sides (secants, else halves).
   *
   * A machine over numbers: put what acts at place() into take(), go where
   * place() is then, until it says that there is balance. The same numbers on
   * all ranks give the same answers on all. */
  class ForceBalance
  {
  public:
    /** What acts at a place, by coordinate. */
    struct Forces
    {
      std::vector<double> rest;      ///< r, all of them together
      std::vector<double> contact;   ///< that of contact
      std::vector<double> size;      ///< what the rest is compared with, >= 0
      std::vector<double> round_off; ///< a rest that is none, >= 0
      /** How far to go where nothing resists, with a sign; 0: nothing is known
       * to be in the way. */
      std::vector<double> way;
      double probe = 0.; ///< small beside what contact is deformed by, > 0
      /** How much contact may change of itself by the digits that the places
       * of bodies have, as a way of the obstacle, >= 0. */
      double digits = 0.;
    };

    enum class Answer
    {
      balanced, ///< at place()
      move,     ///< ask again at place()
      loose,    ///< nothing resists the force on coordinate loose()
      stuck     ///< the rest does not fall any more, or too many places
    };

    /** Begin at @p place. @p inertia [n] >= 0: derivative of the forces of
     * inertia. A rest of @p tolerance times its size is balanced. */
    void begin(const std::vector<double> &place,
               const std::vector<double> &inertia, double tolerance);

    const std::vector<double> &place() const
    {
      return place_;
    }

    /** Take what acts at place(). */
    Answer take(const Forces &forces);

    /** There is no answer at place(): go back half the way to the last one that
     * had one. */
    Answer refuse();

    /** Whether a stiffness of contact is known. */
    bool knows_stiffness() const
    {
      return !stiffness_.empty();
    }

    /** How far a change of the other forces drives it against the stiffness
     * that is known; 0 without. */
    std::vector<double> way_under(const std::vector<double> &change) const;

    /** Forget the stiffness of contact. */
    void forget();

    std::size_t loose() const
    {
      return loose_;
    }

    /** Largest rest by its size at the last place that was taken. */
    double error() const
    {
      return error_;
    }

    /** Places taken or refused since begin(). */
    unsigned int n_places() const
    {
      return n_places_;
    }

    /** What a checkpoint keeps between two searches. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &stiffness_;
    }

  private:
    struct Visit
    {
      std::vector<double> place;
      Forces forces;
      double norm = 0.; ///< largest rest
    };

    std::size_t n() const
    {
      return place_.size();
    }
    /** @param excuse a rest for the digits of places */
    double error_of(const Forces &forces, bool excuse) const;
    Visit visit(const Forces &forces) const;
    double stiffness(std::size_t i, std::size_t j) const;
    bool touches(const Forces &forces) const;
    Answer go_on(const Forces &forces);
    Answer bracket(const Forces &forces);
    Answer step_from_base();
    Answer begin_probes();
    Answer take_probe(const Forces &forces);
    void learn(const std::vector<double> &from, const Forces &before,
               const std::vector<double> &to, const Forces &now);
    /** Solve K d = r for the coordinates with @p wanted; false: singular at
     * loose_. */
    bool solve(std::vector<bool> wanted, const std::vector<double> &rest,
               std::vector<double> &way);

    std::vector<double> stiffness_; ///< [n * n] of contact; empty: not known
    std::vector<double> place_, inertia_;
    double tolerance_ = 0., error_ = 0.;
    unsigned int n_places_ = 0, n_halved_ = 0;
    std::size_t loose_ = 0, probed_ = 0;
    bool probes_ = false, is_fresh_ = false;
    bool has_base_ = false, has_below_ = false, has_above_ = false;
    Visit base_;          ///< the best place, or the last one of one coordinate
    Visit below_, above_; ///< of one coordinate: driven up, and down
  };
} // namespace abut::app

#endif
