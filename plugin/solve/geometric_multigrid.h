// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SOLVE_GEOMETRIC_MULTIGRID_H
#define ABUT_SOLVE_GEOMETRIC_MULTIGRID_H

#include "local_matrix.h"
#include "multigrid.h"
#include "shared_meshes.h"

#include <abut/multigrid.h>

#include <string>

namespace abut::solve
{
  /** V-cycles over the meshes that a mesh was refined from, see
   * abut/multigrid.h, with some unknowns held. All functions but knows() are
   * collective. */
  class GeometricMultigrid : public Multigrid
  {
  public:
    using Index = dealii::types::global_dof_index;

    /** A copy of @p matrix is made; set_constrained() comes next. @p touched
     * are unknowns of other ranks that terms will have in addition to the
     * unknowns of the matrix; owned ones do no harm. */
    GeometricMultigrid(const la::Matrix &matrix, const MeshHierarchy &meshes,
                       const std::vector<Index> &touched = {});

    /** Whether set_matrix() and set_terms() can take a matrix and terms with
     * these unknowns, as far as this rank is concerned. */
    bool knows(const la::Matrix &matrix,
               const std::vector<Index> &touched) const;

    /** Another matrix on the same meshes, copied; set_constrained() comes next.
     */
    void set_matrix(const la::Matrix &matrix);

    /** The same unless it has the same entries as the last one; then what
     * set_constrained() costs is what is near the changes. */
    void renew_matrix(const la::Matrix &matrix);

    /** Set the terms added to the matrix in a few of its rows from the next
     * set_constrained() on, instead of the previous ones; any rank may have any
     * part of it. Closes it. */
    void set_terms(LocalMatrix &terms);

    /** [owned] nonzero where an unknown is held, and what is added to the
     * diagonal; empty: nothing. Costs what is near the changes. */
    void set_constrained(const std::vector<std::uint8_t> &held,
                         const std::vector<double> &added);

    void vmult(la::Vector &dst, const la::Vector &src) const override;

  private:
    struct Destroy
    {
      void operator()(abut_context *object) const
      {
        abut_context_destroy(&object);
      }
      void operator()(abut_multigrid *object) const
      {
        abut_multigrid_destroy(&object);
      }
    };

    void create(const MeshHierarchy &meshes);
    void check(abut_status status) const;

    /** Null on one rank; outlives the hierarchy. */
    std::unique_ptr<SharedMeshes> shared_;
    std::vector<Index> ghosts_;   ///< of the matrix, in their order
    std::int32_t n_rows_ = 0;     ///< with those of copies
    std::uint64_t signature_ = 0; ///< of the matrix
    std::unique_ptr<abut_context, Destroy> context_;
    std::unique_ptr<abut_multigrid, Destroy> multigrid_;
  };

  /** Whether a system of @p n_unknowns of a field with @p n_components gets
   * geometric multigrid if its coarser meshes are known. */
  bool wants_meshes(const SolverParameters &parameters,
                    unsigned long long n_unknowns, unsigned int n_components);

  /** The solver of the systems of a matrix: factors, or iterations with the
   * geometric or the algebraic multigrid. The geometric one is taken where it
   * is requested or is the faster one, until a system takes it too long.
   * `Linear solver = auto` factorises systems that iterations do not solve, and
   * remembers it for the mesh. */
  class SolverChoice
  {
  public:
    explicit SolverChoice(const SolverParameters &parameters)
        : parameters_(parameters)
    {
    }

    /** Choose for a new matrix. @p is_faster: whether the geometric multigrid
     * is to be taken without a request. Collective. */
    void choose(const la::Matrix &matrix, const NearNullSpace &space,
                bool is_faster = true);

    bool is_direct() const;

    bool is_geometric() const
    {
      return !is_direct() && is_wanted_ && missing_.empty();
    }

    /** Iterations for so many digits after which the choice is given up: few of
     * the geometric one, as where cells are long or materials jump within
     * coarse cells. */
    unsigned int patience(double digits) const;

    /** Whether there is another one for systems that this does not solve; the
     * last is a factorisation that is not much too large. */
    bool may_give_up() const;

    /** Take the next one from now on, as these iterations were not enough. */
    void give_up(unsigned int n_iterations);

    /** Name of the preconditioner. */
    std::string preconditioner() const;

    /** @p name of the direct solver, with the reason if it was not the first
     * choice. */
    std::string direct(const std::string &name) const;

  private:
    SolverParameters parameters_;
    unsigned long long n_unknowns_ = 0;
    unsigned int n_components_ = 0;
    std::shared_ptr<KeptParts> kept_; ///< of the mesh
    bool is_wanted_ = false;
    bool is_given_up_ = false;
    std::string missing_; ///< why it is not taken, as the end of a sentence
  };
} // namespace abut::solve

#endif
