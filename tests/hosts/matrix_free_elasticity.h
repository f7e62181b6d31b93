// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_TESTS_MATRIX_FREE_ELASTICITY_H
#define ABUT_TESTS_MATRIX_FREE_ELASTICITY_H

/** @file
 * Linear elasticity in the style of step-37: a stiffness that is never
 * assembled, and geometric multigrid for it. */

#include <abut/dealii/host_operator.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/base/subscriptor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>
#include <deal.II/matrix_free/tools.h>
#include <deal.II/multigrid/mg_coarse.h>
#include <deal.II/multigrid/mg_matrix.h>
#include <deal.II/multigrid/mg_smoother.h>
#include <deal.II/multigrid/mg_transfer_matrix_free.h>
#include <deal.II/multigrid/multigrid.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace abut::hosts
{
  using LevelVector = dealii::LinearAlgebra::distributed::Vector<double>;

  /** First of the values of this rank. */
  template <class V> auto *own_values(V &vector)
  {
    if constexpr (std::is_same<std::remove_const_t<V>, abut::la::Vector>::value)
      return abut::la::data(vector);
    else
      return vector.begin();
  }

  /** Lame's coefficients of a material. */
  struct Lame
  {
    double lambda, mu;
  };

  /** Stiffness of the active mesh or of one level of multigrid. */
  template <int dim> class ElasticStiffness : public dealii::Subscriptor
  {
  public:
    /** @p materials by material id. Nothing is constrained yet. */
    void
    reinit(const dealii::Mapping<dim> &mapping,
           const dealii::DoFHandler<dim> &dof_handler,
           const std::vector<Lame> &materials,
           const unsigned int level = dealii::numbers::invalid_unsigned_int)
    {
      typename dealii::MatrixFree<dim>::AdditionalData data;
      data.tasks_parallel_scheme = data.none;
      data.mapping_update_flags =
          dealii::update_gradients | dealii::update_JxW_values;
      data.mg_level = level;
      cells_.reinit(mapping, dof_handler, dealii::AffineConstraints<double>(),
                    dealii::QGauss<1>(dof_handler.get_fe().degree + 1), data);
      set_coefficients(materials);
      cells_.initialize_dof_vector(source_);
      result_.reinit(source_);
      diagonal_.reinit(source_);
      dealii::MatrixFreeTools::compute_diagonal(
          cells_, diagonal_, &ElasticStiffness::multiply_cells, this);
    }

    /** Take out of vmult() what has the mark 1; the others have 0. */
    void constrain(const LevelVector &marks)
    {
      constrained_.clear();
      for (unsigned int i = 0; i < marks.locally_owned_size(); ++i)
        if (marks.local_element(i) > 0.5)
          constrained_.push_back(i);
    }

    /** The product without constraints. */
    template <class V> void multiply(V &dst, const V &src) const
    {
      std::copy_n(own_values(src), src.locally_owned_size(), source_.begin());
      multiply_source();
      std::copy_n(result_.begin(), result_.locally_owned_size(),
                  own_values(dst));
    }

    /** The product with the diagonal alone in rows and columns of constrained
     * unknowns: the spectrum of Jacobi's iteration then lies within that
     * without constraints, whichever unknowns these are. */
    template <class V> void vmult(V &dst, const V &src) const
    {
      std::copy_n(own_values(src), src.locally_owned_size(), source_.begin());
      set_zero(source_);
      multiply_source();
      for (const unsigned int i : constrained_)
        result_.local_element(i) =
            diagonal_.local_element(i) * own_values(src)[i];
      std::copy_n(result_.begin(), result_.locally_owned_size(),
                  own_values(dst));
    }

    void Tvmult(LevelVector &dst, const LevelVector &src) const
    {
      vmult(dst, src);
    }

    void set_zero(LevelVector &vector) const
    {
      for (const unsigned int i : constrained_)
        vector.local_element(i) = 0.;
    }

    const LevelVector &diagonal() const
    {
      return diagonal_;
    }

    /** Required by PreconditionChebyshev. */
    LevelVector::size_type m() const
    {
      return diagonal_.size();
    }

    double el(const LevelVector::size_type i,
              const LevelVector::size_type) const
    {
      return diagonal_(i);
    }

  private:
    using Cells = dealii::FEEvaluation<dim, -1, 0, dim>;
    using Lanes = dealii::VectorizedArray<double>;

    void set_coefficients(const std::vector<Lame> &materials)
    {
      lambda_.resize(cells_.n_cell_batches(), Lanes(1.));
      mu_ = lambda_;
      for (unsigned int b = 0; b < cells_.n_cell_batches(); ++b)
        for (unsigned int v = 0; v < cells_.n_active_entries_per_cell_batch(b);
             ++v)
        {
          const Lame &material =
              materials.at(cells_.get_cell_iterator(b, v)->material_id());
          lambda_[b][v] = material.lambda;
          mu_[b][v] = material.mu;
        }
    }

    void multiply_source() const
    {
      const auto multiply = [this](const auto &, LevelVector &dst,
                                   const LevelVector &src,
                                   const std::pair<unsigned, unsigned> &range)
      {
        Cells cells(cells_);
        for (unsigned int b = range.first; b < range.second; ++b)
        {
          cells.reinit(b);
          cells.read_dof_values(src);
          multiply_cells(cells);
          cells.distribute_local_to_global(dst);
        }
      };
      cells_.template cell_loop<LevelVector, LevelVector>(multiply, result_,
                                                          source_, true);
    }

    /** From displacements of one batch of cells to forces. */
    void multiply_cells(Cells &cells) const
    {
      const unsigned int b = cells.get_current_cell_index();
      cells.evaluate(dealii::EvaluationFlags::gradients);
      for (unsigned int q = 0; q < cells.n_q_points; ++q)
      {
        dealii::SymmetricTensor<2, dim, Lanes> stress =
            cells.get_symmetric_gradient(q);
        const Lanes pressure = lambda_[b] * trace(stress);
        stress *= 2. * mu_[b];
        for (unsigned int d = 0; d < dim; ++d)
          stress[d][d] += pressure;
        cells.submit_symmetric_gradient(stress, q);
      }
      cells.integrate(dealii::EvaluationFlags::gradients);
    }

    dealii::MatrixFree<dim> cells_;
    dealii::AlignedVector<Lanes> lambda_, mu_;
    LevelVector diagonal_;
    std::vector<unsigned int> constrained_;
    mutable LevelVector source_, result_;
  };

  template <int dim>
  using ElasticLevels = dealii::MGLevelObject<ElasticStiffness<dim>>;

  /** Transfer between the unknowns that are not constrained. */
  template <int dim>
  class ElasticTransfer : public dealii::MGTransferMatrixFree<dim, double>
  {
  public:
    explicit ElasticTransfer(const ElasticLevels<dim> &levels) : levels_(levels)
    {
    }

    void prolongate_and_add(const unsigned int level, LevelVector &dst,
                            const LevelVector &src) const override
    {
      LevelVector coarse(src), change;
      change.reinit(dst);
      levels_[level - 1].set_zero(coarse);
      Base::prolongate_and_add(level, change, coarse);
      levels_[level].set_zero(change);
      dst += change;
    }

    void restrict_and_add(const unsigned int level, LevelVector &dst,
                          const LevelVector &src) const override
    {
      LevelVector fine(src), change;
      change.reinit(dst);
      levels_[level].set_zero(fine);
      Base::restrict_and_add(level, change, fine);
      levels_[level - 1].set_zero(change);
      dst += change;
    }

  private:
    using Base = dealii::MGTransferMatrixFree<dim, double>;

    const ElasticLevels<dim> &levels_;
  };

  /** One V-cycle of geometric multigrid with Chebyshev's smoother. */
  template <int dim> class ElasticCycle
  {
  public:
    /** @p fixed as in constrain(). */
    ElasticCycle(const dealii::Mapping<dim> &mapping,
                 const dealii::DoFHandler<dim> &dof_handler,
                 const std::vector<Lame> &materials, const LevelVector &fixed)
        : dof_handler_(dof_handler),
          levels_(0, dof_handler.get_triangulation().n_global_levels() - 1),
          transfer_(levels_)
    {
      for (unsigned int l = 0; l <= levels_.max_level(); ++l)
        levels_[l].reinit(mapping, dof_handler, materials, l);
      transfer_.build(dof_handler);
      constrain(fixed);
      make_smoothers();
      matrix_.initialize(levels_);
      coarse_.initialize(smoother_);
      multigrid_ = std::make_unique<dealii::Multigrid<LevelVector>>(
          matrix_, coarse_, transfer_, smoother_, smoother_);
      cycle_ = std::make_unique<Cycle>(dof_handler, *multigrid_, transfer_);
    }

    void vmult(LevelVector &dst, const LevelVector &src) const
    {
      cycle_->vmult(dst, src);
    }

    /** Take out unknowns of the active mesh that have the mark 1, and those of
     * the levels at the same nodes. Collective. */
    void constrain(const LevelVector &marks)
    {
      dealii::MGLevelObject<LevelVector> of_levels(0, levels_.max_level());
      transfer_.interpolate_to_mg(dof_handler_, of_levels, marks);
      for (unsigned int l = 0; l <= levels_.max_level(); ++l)
        levels_[l].constrain(of_levels[l]);
    }

  private:
    using Chebyshev =
        dealii::PreconditionChebyshev<ElasticStiffness<dim>, LevelVector>;
    using Cycle =
        dealii::PreconditionMG<dim, LevelVector, ElasticTransfer<dim>>;

    /** On the coarsest level as many iterations as solve, for blocks of few
     * cells; a body that floats does no harm. */
    void make_smoothers()
    {
      dealii::MGLevelObject<typename Chebyshev::AdditionalData> data(
          0, levels_.max_level());
      for (unsigned int l = 0; l <= levels_.max_level(); ++l)
      {
        const LevelVector &diagonal = levels_[l].diagonal();
        data[l].preconditioner =
            std::make_shared<dealii::DiagonalMatrix<LevelVector>>();
        data[l].preconditioner->reinit(diagonal);
        for (double &d : data[l].preconditioner->get_vector())
          d = 1. / d;
        data[l].smoothing_range = l == 0 ? 1000. : 15.;
        data[l].degree = l == 0 ? 100 : 4;
        data[l].eig_cg_n_iterations = 12;
      }
      smoother_.initialize(levels_, data);
      // Before anything is held: what bounds the spectrum now does so for
      // whatever is held later.
      for (unsigned int l = 0; l <= levels_.max_level(); ++l)
        smoother_[l].estimate_eigenvalues(levels_[l].diagonal());
    }

    const dealii::DoFHandler<dim> &dof_handler_;
    ElasticLevels<dim> levels_;
    ElasticTransfer<dim> transfer_;
    dealii::mg::Matrix<LevelVector> matrix_;
    dealii::mg::SmootherRelaxation<Chebyshev, LevelVector> smoother_;
    dealii::MGCoarseGridApplySmoother<LevelVector> coarse_;
    std::unique_ptr<dealii::Multigrid<LevelVector>> multigrid_;
    std::unique_ptr<Cycle> cycle_;
  };

  /** What contact is given. */
  template <int dim> class ElasticOperator : public HostOperator
  {
  public:
    /** On a mesh without hanging nodes; constraints are but prescribed
     * displacements. */
    ElasticOperator(const dealii::Mapping<dim> &mapping,
                    const dealii::DoFHandler<dim> &dof_handler,
                    const dealii::AffineConstraints<double> &constraints,
                    const std::vector<Lame> &materials,
                    const bool heeds_holding)
        : heeds_holding_(heeds_holding)
    {
      // Vectors of both kinds have the owned unknowns in the same order.
      const dealii::IndexSet &owned = dof_handler.locally_owned_dofs();
      AssertThrow(owned.is_contiguous(), dealii::ExcNotImplemented());
      AssertThrow(!dof_handler.get_triangulation().has_hanging_nodes(),
                  dealii::ExcNotImplemented());
      stiffness_.reinit(mapping, dof_handler, materials);
      source_.reinit(stiffness_.diagonal());
      result_.reinit(source_);
      fixed_.reinit(source_);
      for (const auto i : owned)
        fixed_(i) = constraints.is_constrained(i) ? 1. : 0.;
      stiffness_.constrain(fixed_);
      cycle_ = std::make_unique<ElasticCycle<dim>>(mapping, dof_handler,
                                                   materials, fixed_);
    }

    void vmult(la::Vector &dst, const la::Vector &src) const override
    {
      stiffness_.vmult(dst, src);
    }

    void diagonal(la::Vector &result) const override
    {
      copy(stiffness_.diagonal(), result);
    }

    void precondition(la::Vector &dst, const la::Vector &src) const override
    {
      if (held_)
      {
        LevelVector marks(fixed_);
        for (unsigned int i = 0; i < held_->size(); ++i)
          if ((*held_)[i] != 0)
            marks.local_element(i) = 1.;
        cycle_->constrain(marks);
        held_.reset();
      }
      copy(src, source_);
      cycle_->vmult(result_, source_);
      copy(result_, dst);
    }

    /** Only noted, because levels are marked together with other ranks: these
     * must have noted theirs, too, when precondition() is called. */
    void constrain(const std::vector<std::uint8_t> &held) override
    {
      if (heeds_holding_)
        held_ = held;
    }

    /** The product without constraints. */
    void multiply(la::Vector &dst, const la::Vector &src) const
    {
      stiffness_.multiply(dst, src);
    }

  private:
    template <class From, class To> static void copy(const From &from, To &to)
    {
      std::copy_n(own_values(from), from.locally_owned_size(), own_values(to));
    }

    ElasticStiffness<dim> stiffness_;
    LevelVector fixed_;
    std::unique_ptr<ElasticCycle<dim>> cycle_;
    const bool heeds_holding_;
    mutable std::optional<std::vector<std::uint8_t>> held_;
    mutable LevelVector source_, result_;
  };
} // namespace abut::hosts

#endif
