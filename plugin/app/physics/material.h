// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_MATERIAL_H
#define ABUT_APP_MATERIAL_H

/** @file
 * What bodies are made of, in the plane, around an axis and in space.
 */

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/base/types.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace abut::app
{
  template <int dim> class NodalPlaces;

  /** What a two-dimensional model says of the third direction. Axisymmetric
   * models have radius x >= 0 and axis x = 0. */
  enum class PlaneModel
  {
    strain,      /**< no strain along z */
    stress,      /**< no stress along z */
    axisymmetric /**< hoop strain u_x / x */
  };

  /** Stress at a point, positive in tension: force per area of the deformed
   * body (Cauchy's), where that differs. */
  template <int dim> struct Stress
  {
    dealii::SymmetricTensor<2, dim> tensor;
    /** Normal stress along z, or around the axis; 0 in three dimensions. */
    double out_of_plane = 0.;

    /** sqrt(3/2 s:s) with the deviator s of all three directions. */
    double von_mises() const;
  };

  /** Force per area of the undeformed body: tensor[i][j] is component i of the
   * force on an area that had its normal along j (first Piola and Kirchhoff).
   * Of small strain the same as Stress. */
  template <int dim> struct NominalStress
  {
    dealii::Tensor<2, dim> tensor;
    double out_of_plane = 0.; ///< as in Stress
  };

  /** Which change of volume stress follows from. */
  enum class VolumeChange
  {
    of_point, /**< that of the point */
    of_cell   /**< the mean of its cell, see CellVolume */
  };

  template <int dim> class CellVolume;

  /** The displacement at the quadrature points of a cell. */
  template <int dim> struct CellState
  {
    std::vector<dealii::Tensor<1, dim>> value;
    std::vector<dealii::Tensor<2, dim>> gradient; ///< du_i/dx_j
  };

  /** A material. All that the program knows of stress and stiffness goes
   * through these functions. The state at a point is the gradient[i][j] =
   * du_i/dx_j of the displacement, and for axisymmetric bodies its value and
   * the point, too; x is where the point is in the undeformed body. What is not
   * a state of any body, as one turned inside out, has stress and energy nan.
   *
   * Where cell_volume() is not null, what is asked of a point is answered as if
   * its cell deformed evenly; the answer for a point of a cell that does not is
   * that of in_cell(). */
  template <int dim> class Material
  {
  public:
    /** @p plane is without meaning in three dimensions. */
    explicit Material(const PlaneModel plane) : plane(plane)
    {
    }

    virtual ~Material() = default;

    /** Whether stress is linear in the displacement, so that the tangent is the
     * same for all states. */
    virtual bool is_linear() const = 0;

    /** Stress of a state. */
    virtual Stress<dim> stress(const dealii::Tensor<2, dim> &gradient,
                               const dealii::Tensor<1, dim> &displacement,
                               const dealii::Point<dim> &point) const = 0;

    /** The same by undeformed area: the derivative of energy() by the
     * gradient. */
    virtual NominalStress<dim>
    nominal_stress(const dealii::Tensor<2, dim> &gradient,
                   const dealii::Tensor<1, dim> &displacement,
                   const dealii::Point<dim> &point) const = 0;

    /** Stored energy per undeformed volume. */
    virtual double energy(const dealii::Tensor<2, dim> &gradient,
                          const dealii::Tensor<1, dim> &displacement,
                          const dealii::Point<dim> &point) const = 0;

    /** Change of the nominal stress of a state per change of its gradient and
     * displacement. */
    virtual NominalStress<dim>
    tangent(const dealii::Tensor<2, dim> &gradient,
            const dealii::Tensor<1, dim> &displacement,
            const dealii::Point<dim> &point,
            const dealii::Tensor<2, dim> &gradient_change,
            const dealii::Tensor<1, dim> &displacement_change) const = 0;

    /** Divergence of the nominal stress, a force per volume; hessian[i][j][k] =
     * d^2 u_i / dx_j dx_k. Not on the axis of an axisymmetric body. From
     * tangent(), where a material knows no faster way. */
    virtual dealii::Tensor<1, dim>
    stress_divergence(const dealii::Tensor<3, dim> &hessian,
                      const dealii::Tensor<2, dim> &gradient,
                      const dealii::Tensor<1, dim> &displacement,
                      const dealii::Point<dim> &point) const;

    /** Derivative of cell_forces() by the values of a cell. From tangent(),
     * where a material knows no faster way.
     * @param values of one component, with values, gradients, points and JxW
     * @param fe system of dim such components, which numbers the rows
     * @param state not looked at if is_linear() */
    virtual void cell_tangent(const dealii::FEValues<dim> &values,
                              const dealii::FiniteElement<dim> &fe,
                              const CellState<dim> &state,
                              dealii::FullMatrix<double> &result) const;

    /** What there is to know of the mean change of volume of a cell, if stress
     * follows from that; else null. */
    virtual const CellVolume<dim> *cell_volume() const
    {
      return nullptr;
    }

    /** The material as the points of a cell in a state have it; this one where
     * stress follows from the change of volume of the point, and to be kept no
     * longer than it. */
    std::shared_ptr<const Material> in_cell(const dealii::FEValues<dim> &values,
                                            const CellState<dim> &state) const;

    /** Internal forces of a cell, int nominal stress : grad phi; arguments as
     * above. */
    void cell_forces(const dealii::FEValues<dim> &values,
                     const dealii::FiniteElement<dim> &fe,
                     const CellState<dim> &state,
                     dealii::Vector<double> &forces) const;

    /** Of the size of |stress| / |strain|, whatever the strain. */
    virtual double stiffness() const = 0;

    /** Mean stress by volume change, added to that of the shear: what locking
     * pays for. */
    virtual double dilation_stiffness() const = 0;

    /** Of small strain, -1 < nu < 1/2. */
    virtual double poisson_ratio() const = 0;

    /** Relative change of volume, or its logarithm: what dilation_stiffness()
     * goes with. */
    virtual double dilation(const dealii::Tensor<2, dim> &gradient,
                            const dealii::Tensor<1, dim> &displacement,
                            const dealii::Point<dim> &point) const;

    /** Least length of a line as a part of its undeformed one down to which the
     * material may be used; 0: all. */
    virtual double least_stretch() const
    {
      return 0.;
    }

    /** Whether volumes are those of rings. */
    bool is_axisymmetric() const
    {
      return dim == 2 && plane == PlaneModel::axisymmetric;
    }

    /** What a volume or an area of the mesh is multiplied by: 2 pi x for
     * axisymmetric bodies, else 1. */
    double measure(const dealii::Point<dim> &point) const;

    /** u_x / x of axisymmetric bodies, whose limit on the axis is du_x/dx; 0
     * for others. */
    double hoop_strain(const dealii::Tensor<2, dim> &gradient,
                       const dealii::Tensor<1, dim> &displacement,
                       const dealii::Point<dim> &point) const;

    const PlaneModel plane;

  protected:
    /** Add to the tangent of a cell what follows from a change of its mean
     * volume, if stress does; @p state also if is_linear(). */
    void add_volume_stiffness(const dealii::FEValues<dim> &values,
                              const dealii::FiniteElement<dim> &fe,
                              const CellState<dim> &state,
                              dealii::FullMatrix<double> &result) const;

    /** Changes of the nominal stress at a point by each entry of the gradient,
     * and by the radial displacement of axisymmetric bodies. */
    struct Moduli
    {
      /** By the change that a shape function of one component makes. */
      NominalStress<dim> change(unsigned int component,
                                const dealii::Tensor<1, dim> &shape_gradient,
                                double shape_value) const;

      std::array<std::array<NominalStress<dim>, dim>, dim> of_gradient;
      NominalStress<dim> of_radius;
      bool has_radius = false;
    };

    /** From tangent(), where a material knows no faster way. */
    virtual Moduli moduli(const dealii::Tensor<2, dim> &gradient,
                          const dealii::Tensor<1, dim> &displacement,
                          const dealii::Point<dim> &point) const;

    /** From the @p change of the nominal stress by a gradient and a
     * displacement. */
    template <typename Change> Moduli moduli_by(const Change &change) const
    {
      Moduli result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
        {
          dealii::Tensor<2, dim> one;
          one[i][j] = 1.;
          result.of_gradient[i][j] = change(one, dealii::Tensor<1, dim>());
        }
      result.has_radius = is_axisymmetric();
      if (result.has_radius)
      {
        dealii::Tensor<1, dim> one;
        one[0] = 1.;
        result.of_radius = change(dealii::Tensor<2, dim>(), one);
      }
      return result;
    }

  private:
    /** Add what a stress at point @p q of a volume does to all nodes. */
    void add_nodal_forces(const dealii::FEValues<dim> &values,
                          const NodalPlaces<dim> &places,
                          const NominalStress<dim> &stress, unsigned int q,
                          double volume, dealii::Vector<double> &forces) const;

    /** What a stress at point @p q does to a node, per volume. */
    dealii::Tensor<1, dim> nodal_force(const dealii::FEValues<dim> &values,
                                       const NominalStress<dim> &stress,
                                       unsigned int node, unsigned int q) const;
  };

  /** The materials of a mesh by material id of its cells. */
  template <int dim>
  using Materials = std::map<dealii::types::material_id,
                             std::shared_ptr<const Material<dim>>>;
} // namespace abut::app

#endif
