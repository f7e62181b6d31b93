// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_PRECONDITIONER_KEEPER_H
#define ABUT_SOLVE_PRECONDITIONER_KEEPER_H

#include <mpi.h>

namespace abut::solve
{
  /** When a preconditioner or factorisation, which costs as much as a solve, is
   * built again, and when it is kept although the matrix has changed: the one
   * policy of all solvers. A factorisation is exact or nothing; multigrid is
   * kept while few contacts change and while it is not slow. */
  class PreconditionerKeeper
  {
  public:
    /** @p slow: less than this part of the digits per iteration that the
     * preconditioner gave when it was new is too little. */
    explicit PreconditionerKeeper(const double slow) : slow_(slow)
    {
    }

    /** One that keeps nothing: for solvers whose matrix changes so much from
     * system to system that a new preconditioner pays each time. */
    static PreconditionerKeeper never()
    {
      PreconditionerKeeper result(1.);
      result.keeps_ = false;
      return result;
    }

    /** Nothing is built, or what is built is of no use. */
    void forget()
    {
      is_built_ = is_kept_ = is_slow_ = false;
    }

    /** It has just been built. */
    void record_build();

    /** It is used for a matrix once more; the next solve may find out that it
     * should not be. */
    void record_reuse()
    {
      is_kept_ = is_built_;
    }

    /** How fast a solve was: decides whether it is kept for the next. */
    void record_speed(double digits, unsigned int n_iterations);

    /** Whether there is a preconditioner at all. */
    bool is_built() const
    {
      return is_built_;
    }

    /** Whether it was built for another matrix than the present one. */
    bool is_kept() const
    {
      return is_kept_;
    }

    /** Whether it is missing or slow, whatever has changed. */
    bool must_build() const
    {
      return !is_built_ || is_slow_ || !keeps_;
    }

    /** Iterations after which a kept preconditioner is given up: one that has
     * become bad is not worth waiting for. */
    unsigned int patience() const
    {
      return 20 + 3 * iterations_when_built_;
    }

    /** Whether an entry counts as changed whose stiffness is @p ratio times
     * that at the last build. */
    static bool is_change(double ratio, bool exact);

    /** Whether @p n_changed of @p n entries of all ranks, this rank's share
     * being given, are too many. Collective. */
    static bool are_too_many(double n_changed, double n, bool exact,
                             MPI_Comm communicator);

    /** Keep and give up as @p other would. */
    void restore(const PreconditionerKeeper &other)
    {
      const double slow = slow_;
      const bool keeps = keeps_;
      *this = other;
      slow_ = slow;
      keeps_ = keeps;
    }

    /** Its data to keep with a preconditioner, by an archive of boost's. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &is_built_ &is_kept_ &is_slow_;
      archive &speed_when_built_ &iterations_when_built_;
    }

  private:
    double slow_;
    bool keeps_ = true;
    bool is_built_ = false, is_kept_ = false, is_slow_ = false;
    double speed_when_built_ = 0.; ///< digits per iteration; 0: not known
    unsigned int iterations_when_built_ = 0;
  };
} // namespace abut::solve

#endif
