// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_HOST_OPERATOR_H
#define ABUT_DEALII_HOST_OPERATOR_H

#include <abut/dealii/linear_algebra.h>

#include <cstdint>
#include <vector>

namespace abut
{
  /** The tangent K of a host that has no matrix, or has a preconditioner that
   * is better than Abut's: what ContactAssembler::solve() needs of K to solve
   * by conjugate gradients (FGMRES where K or friction is not symmetric).
   *
   * K is that of the unconstrained system with what AffineConstraints eliminate
   * taken out: rows and columns of such unknowns are zero but for a positive
   * diagonal. Vectors have no ghosts. All functions but hold() are collective;
   * vectors in and out are never the same. */
  class HostOperator
  {
  public:
    virtual ~HostOperator() = default;

    /** dst = K src. */
    virtual void vmult(la::Vector &dst, const la::Vector &src) const = 0;

    /** The diagonal of K, positive: penalties and tolerances are multiples of
     * it. Asked for once for each linearisation; solve() throws
     * std::invalid_argument if it is not positive, or not that of a product
     * with a unit vector. */
    virtual void diagonal(la::Vector &result) const = 0;

    /** dst = about K^-1 src, as one multigrid cycle: linear, the same from call
     * to call, symmetric and positive definite if K is. */
    virtual void precondition(la::Vector &dst, const la::Vector &src) const = 0;

    /** Before each linear system: @p held [owned] is nonzero where contact
     * holds an unknown by itself, as on membranes and at obstacles across an
     * axis. What precondition() does to it is cut off in any case; one that
     * holds it on its coarser levels, too, needs fewer iterations. By default
     * nothing is done. Not collective. */
    virtual void hold(const std::vector<std::uint8_t> &held)
    {
      static_cast<void>(held);
    }
  };

  /** K of a linearised step: the host's matrix or, where it has none, its
   * HostOperator, either of which is one without being told so. Refers to it,
   * and is copied freely. */
  class Tangent
  {
  public:
    /** A matrix, which must stay where it is. */
    Tangent(const la::Matrix &matrix) : matrix_(&matrix)
    {
    }

    /** Not one that is gone when it is needed. */
    Tangent(const la::Matrix &&) = delete;

    /** No matrix. */
    Tangent(HostOperator &host) : host_(&host)
    {
    }

    /** Whether it is a matrix. */
    bool has_matrix() const
    {
      return matrix_ != nullptr;
    }

    /** Only if it is one. */
    const la::Matrix &matrix() const
    {
      return *matrix_;
    }

    /** Only if it is none. */
    HostOperator &host() const
    {
      return *host_;
    }

    /** dst = K src. Collective. */
    void vmult(la::Vector &dst, const la::Vector &src) const
    {
      if (has_matrix())
        matrix_->vmult(dst, src);
      else
        host_->vmult(dst, src);
    }

  protected:
    /** None. */
    Tangent() = default;

  private:
    const la::Matrix *matrix_ = nullptr;
    HostOperator *host_ = nullptr;
  };
} // namespace abut

#endif
