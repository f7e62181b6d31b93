// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_DEALII_HOST_OPERATOR_H
#define ABUT_DEALII_HOST_OPERATOR_H

#include <abut/dealii/host_matrix.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace abut
{
  /** The tangent K of a host that has no matrix, or has a preconditioner that
   * is better than Abut's: what ContactAssembler::solve() needs of K to solve
   * by conjugate gradients (FGMRES where K or friction is not symmetric).
   *
   * K is that of the unconstrained system with what AffineConstraints eliminate
   * taken out: rows and columns of such unknowns are zero but for a positive
   * diagonal. Vectors have no ghosts. All functions but constrain() are
   * collective; vectors in and out are never the same. */
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
     * axis. Its part of the result of precondition() is set to zero in any
     * case; one that holds it on its coarser levels, too, needs fewer
     * iterations. By default nothing is done. Not collective. */
    virtual void constrain(const std::vector<std::uint8_t> &held)
    {
      static_cast<void>(held);
    }
  };

  /** The same from functions of vectors of another type, which are copied, such
   * as LinearAlgebra::distributed::Vector<double>. */
  template <typename V> class HostOperatorOf : public HostOperator
  {
  public:
    /** dst and src. */
    using Product = std::function<void(V &dst, const V &src)>;

    /** @p like is a vector of the owned unknowns. */
    HostOperatorOf(const V &like, Product vmult,
                   std::function<void(V &)> diagonal, Product precondition)
        : dst_(like),
          src_(like),
          vmult_(std::move(vmult)),
          diagonal_(std::move(diagonal)),
          precondition_(std::move(precondition))
    {
    }

    void vmult(la::Vector &dst, const la::Vector &src) const override
    {
      apply(vmult_, dst, src);
    }

    void diagonal(la::Vector &result) const override
    {
      diagonal_(dst_);
      la::copy(dst_, result);
    }

    void precondition(la::Vector &dst, const la::Vector &src) const override
    {
      apply(precondition_, dst, src);
    }

  private:
    void apply(const Product &product, la::Vector &dst,
               const la::Vector &src) const
    {
      la::copy(src, src_);
      product(dst_, src_);
      la::copy(dst_, dst);
    }

    mutable V dst_, src_;
    Product vmult_;
    std::function<void(V &)> diagonal_;
    Product precondition_;
  };

  /** K of a linearised step: the host's matrix or, where it has none, its
   * HostOperator, either of which converts to it. Refers to it, and is copied
   * freely. */
  class Tangent
  {
  public:
    /** A matrix, which must stay where it is. */
    Tangent(const la::Matrix &matrix) : matrix_(&matrix)
    {
    }

    /** A matrix of another type, of which Abut makes a copy. It must stay where
     * it is. */
    template <typename M,
              typename = std::enable_if_t<la::internal::is_host_matrix<M>>>
    Tangent(const M &matrix)
        : other_(std::make_shared<la::HostMatrixOf<M>>(matrix))
    {
    }

    /** Not one that is gone when it is needed. */
    Tangent(const la::Matrix &&) = delete;

    /** The matrix that contact terms are added to. */
    explicit Tangent(const la::MatrixTarget &matrix)
        : matrix_(matrix.native()), other_(matrix.host())
    {
    }

    /** No matrix. */
    Tangent(HostOperator &host) : host_(&host)
    {
    }

    /** Whether it is a matrix. */
    bool has_matrix() const
    {
      return host_ == nullptr;
    }

    /** Only if it is one of Abut's type. */
    const la::Matrix &matrix() const
    {
      return *matrix_;
    }

    /** A matrix of another type, else null. */
    const la::HostMatrix *other() const
    {
      return other_.get();
    }

    /** Only if it is no matrix. */
    HostOperator &host() const
    {
      return *host_;
    }

    /** dst = K src; of a matrix of another type see
     * ContactAssembler::copy_of(). Collective. */
    void vmult(la::Vector &dst, const la::Vector &src) const
    {
      Assert(other_ == nullptr, dealii::ExcInternalError());
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
    std::shared_ptr<const la::HostMatrix> other_;
    HostOperator *host_ = nullptr;
  };
} // namespace abut

#endif
