// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_ERROR_TARGET_H
#define ABUT_APP_ERROR_TARGET_H

/** @file
 * When an answer is good enough: `Refinement/Target error`.
 */

#include <string>
#include <vector>

namespace abut::app
{
  /** What `Target error` is the relative error of. */
  enum class TargetQuantity
  {
    energy_norm,  /**< |u - u_h| / |u_h| in the norm of the strain energy */
    contact_force /**< the contact force */
  };

  /** What one mesh tells about its error. All norms are energy norms, with the
   * same unit. */
  struct MeshEvidence
  {
    double residual = 0.; ///< residual estimate of the discretisation
    double law = 0.;      ///< estimate of what the contact law leaves open
    /** |u - u_0|, u_0: the last mesh's solution on this mesh; < 0: there is
     * no last mesh. */
    double change = -1.;
    double last_increment = 0.;  ///< |du| of the last linear system
    double last_tolerance = 0.;  ///< relative, of that system
    double final_tolerance = 0.; ///< that no system is solved below
    double norm = 0.;            ///< |u_h|
    double contact_force = 0.;   ///< unit of its own

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &residual &law &change &last_increment &last_tolerance;
      archive &final_tolerance &norm &contact_force;
    }
  };

  /** Relative errors of the quantity asked for. */
  struct ErrorParts
  {
    double discretisation = 0.;
    double contact = 0.;   ///< by penalty, barrier or multiplier
    double algebraic = 0.; ///< by linear solves that end early

    /** The first two do not see each other, linear solves disturb both. */
    double total() const;

    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &discretisation &contact &algebraic;
    }
  };

  /** Judges a sequence of meshes by three errors, each of which is only made
   * smaller when it matters.
   *
   * Discretisation. Residual estimates are above the error by a factor that
   * depends on the equation, the elements and the shape of cells. Two meshes
   * measure it: where each contains the one before, Galerkin's orthogonality
   * makes |u - u_0|^2 = e_0^2 - e^2, and if errors e are C times the residual
   * estimates r, then C^2 = |u - u_0|^2 / (r_0^2 - r^2). The larger of the
   * last two C counts, times a margin, never more than 1 or less than 1/20; on
   * the first mesh it is 1. Nothing stops before C was measured twice, unless
   * it is not needed. The contact force is extrapolated instead: its error
   * falls like e^2, so that it is the last change times q / (1 - q), q = r^2 /
   * r_0^2.
   *
   * Contact: see ContactMeasures::complementarity_error. In the force it
   * counts squared, being of the order of an energy.
   *
   * Linear systems: what was left of the last increment, and the tolerance
   * below which no system is solved. */
  class ErrorTarget
  {
  public:
    /** What to do with a mesh that has been solved on. */
    enum class Step
    {
      stop,          ///< target met
      refine,        ///< the discretisation decides
      tighten_law,   ///< the contact law decides
      tighten_solver ///< the linear systems decide
    };

    /** @param target relative error > 0 */
    ErrorTarget(double target, TargetQuantity quantity);

    /** Take the results of a mesh. Those of a mesh solved on once more
     * (@p same_mesh) replace what was known of it. */
    void add(const MeshEvidence &evidence, bool same_mesh);

    /** Errors on the last mesh. */
    const ErrorParts &errors() const
    {
      return errors_;
    }

    /** What follows. */
    Step next() const;

    /** Part of the squared estimate whose cells must be refined so that one
     * more mesh meets the target, if that is possible, in
     * [@p smallest, @p largest]. Refining a cell quarters its share. */
    double refine_fraction(double smallest, double largest) const;

    /** Factor > 1 by which the law must be stiffer, sharper or more exact:
     * what it leaves open falls in proportion. */
    double law_factor() const;

    /** Factor > 1 by which linear tolerances must be smaller. */
    double solver_factor() const;

    /** Error divided by the residual estimate, as measured. */
    double calibration() const
    {
      return calibration_;
    }

    /** What a checkpoint keeps. */
    template <class Archive> void serialize(Archive &archive, unsigned int)
    {
      archive &meshes_ &measured_ &calibration_ &errors_;
    }

  private:
    double measured_calibration() const;
    double force_error() const;
    /** Whether the calibration was measured twice, or is not needed. */
    bool is_sure() const;

    const double target_;
    const TargetQuantity quantity_;
    std::vector<MeshEvidence> meshes_;
    std::vector<double> measured_; ///< calibrations by mesh; < 0: none
    double calibration_ = 1.;
    ErrorParts errors_;
  };
} // namespace abut::app

#endif
