// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_CONTACT_HOST_H
#define ABUT_SHIM_CONTACT_HOST_H

#include "host_matrix_copy.h"
#include "solve/stiffness.h"

#include <abut/dealii/host_operator.h>
#include <abut/dealii/vertex_origin.h>

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/lac/affine_constraints.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::shim
{
  /** The host's mesh and unknowns, and its vectors and matrices, of whatever
   * type, as ones of Abut's types. */
  template <int dim> class ContactHost
  {
  public:
    explicit ContactHost(const MPI_Comm communicator)
        : communicator_(communicator)
    {
    }

    /** Another mesh, or others of its data, which must outlive their use. */
    void reinit(const dealii::Mapping<dim> &mapping,
                const dealii::DoFHandler<dim> &dof_handler,
                const dealii::AffineConstraints<double> &constraints);

    /** For the mesh of the next reinit(). */
    void set_vertex_origins(std::vector<VertexOrigin> origins)
    {
      next_origins_ = std::move(origins);
    }

    const std::vector<VertexOrigin> &vertex_origins() const
    {
      return vertex_origins_;
    }

    const dealii::Mapping<dim> &mapping() const
    {
      return *mapping_;
    }

    const dealii::DoFHandler<dim> &dof_handler() const
    {
      return *dof_handler_;
    }

    const dealii::AffineConstraints<double> &constraints() const
    {
      return *constraints_;
    }

    const dealii::IndexSet &owned() const
    {
      return dof_handler_->locally_owned_dofs();
    }

    /** Throw, with the name of the @p call, unless there was a reinit() and
     * the unknowns are as many as they were in it. */
    void check_mesh(const std::string &call) const;
    /** The same, but without reinit() there is nothing to throw about. */
    void check_unchanged(const std::string &call) const;

    /** Throw, on all ranks, if a vertex of the mesh, moved by the mapping, is
     * not where it was in reinit(), or if unknowns have other numbers. One pass
     * over vertices and cells. Collective. */
    void check_places(const std::string &call) const;

    /** The argument of a host in a @p call: the vector itself, or its view's
     * copy. Throws, on all ranks, if it is not one of the present unknowns.
     * Collective. */
    const la::Vector &vector(const std::string &call, const std::string &what,
                             const la::VectorView &given) const;
    la::Vector &mutable_vector(const std::string &call, const std::string &what,
                               const la::MutableVectorView &given) const;
    /** The same of a residual. Throws, on all ranks, for values that are not
     * finite, for forces on unknowns that constraints eliminate and, if it
     * @p is_first of an iteration, for values that were not sent to their
     * ranks. Collective. */
    const la::Vector &residual(const std::string &call,
                               const la::VectorView &given,
                               bool is_first) const;

    /** A matrix of another type is copied, to the one of the present step.
     * Throws, on all ranks, if it is not one of the present unknowns.
     * Collective. */
    solve::Stiffness stiffness(const std::string &call,
                               const Tangent &tangent) const
    {
      return stiffness(call, tangent, copied_);
    }

    /** The same of a @p tangent that is constant since the last call, unless
     * @p is_new: a matrix of Abut's type is then neither checked nor looked at
     * again. Collective. */
    solve::Stiffness constant_stiffness(const std::string &call,
                                        const Tangent &tangent, bool is_new);

    /** Let penalties be multiples of this one. Collective. */
    void set_reference(const std::string &call, const Tangent &tangent)
    {
      reference_ = stiffness(call, tangent, copied_reference_);
    }

    const std::optional<solve::Stiffness> &reference() const
    {
      return reference_;
    }

    /** The matrix that penalties are multiples of. */
    solve::Stiffness reference_or(const solve::Stiffness &present) const
    {
      return reference_.value_or(present);
    }

  private:
    /** Throw if @p what is not of the present unknowns. */
    void check_size(const std::string &call, const std::string &what,
                    dealii::types::global_dof_index size) const;
    /** Throw, on all ranks, if a free unknown with nothing but free ones of its
     * component around it has no force on others: translations would need a
     * force, so that it is eliminated. Unknowns of other fields than a
     * displacement may be alone. Collective. */
    void check_coupled(const la::Matrix &matrix, const std::string &name) const;
    /** Unknowns of the displacement if they come before all others, else 0. */
    dealii::types::global_dof_index displacement_block() const;
    /** Where vertices of the mesh are by the mapping. */
    std::vector<dealii::Point<dim>> vertices() const;
    std::vector<dealii::types::global_dof_index> boundary_unknowns() const;
    solve::Stiffness stiffness(const std::string &call, const Tangent &tangent,
                               HostMatrixCopy &copy) const;

    const MPI_Comm communicator_;
    const dealii::Mapping<dim> *mapping_ = nullptr;
    const dealii::DoFHandler<dim> *dof_handler_ = nullptr;
    const dealii::AffineConstraints<double> *constraints_ = nullptr;
    std::vector<VertexOrigin> vertex_origins_, next_origins_;
    dealii::types::global_dof_index n_unknowns_ = 0; ///< in reinit()
    std::vector<dealii::Point<dim>> vertices_;       ///< in reinit()
    /** Numbers of unknowns of cells at the boundary, in reinit(). */
    std::vector<dealii::types::global_dof_index> boundary_unknowns_;
    std::optional<solve::Stiffness> reference_; ///< none: the present one
    /** Copies of matrices of other types: the present one, and reference. */
    mutable HostMatrixCopy copied_;
    HostMatrixCopy copied_reference_;
    std::optional<solve::Stiffness> constant_; ///< none: not known
  };
} // namespace abut::shim

#endif
