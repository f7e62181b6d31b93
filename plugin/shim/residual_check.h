// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_RESIDUAL_CHECK_H
#define ABUT_SHIM_RESIDUAL_CHECK_H

#include "contact_host.h"

#include <abut/dealii/coded.h>

#include <string>

namespace abut::shim
{
  /** Whether the residuals R of an iteration belong to its matrix K: contact
   * alone may drive a body, and then neither loads nor the balance of forces
   * show a wrong R. */
  template <int dim> class ResidualCheck
  {
  public:
    explicit ResidualCheck(const ContactHost<dim> &host) : host_(host)
    {
    }

    /** Forget what was found; on a new mesh or with other constraints, also
     * that prescribed displacements were in R. */
    void clear(bool is_new_mesh = false);

    /** Begin an iteration with its first K and R, at a displacement.
     * Collective. */
    void begin(const solve::Stiffness &matrix, const la::Vector &residual,
               const la::Vector &displacement);

    /** Compare the second R, at a displacement, with the first. Throws
     * ContactError if it changes by a multiple of K du that is not positive.
     * @p round_off: forces that count as 0. Collective. */
    void compare(const solve::Stiffness &matrix, const la::Vector &residual,
                 const la::Vector &displacement, double round_off);

    /** Finding about the two; empty: nothing. */
    const Message &finding() const
    {
      return finding_;
    }

    /** Largest prescribed displacement that R has nothing of; else 0. */
    double lost_displacement() const
    {
      return lost_;
    }

  private:
    void find_lost(const solve::Stiffness &matrix, const la::Vector &residual,
                   const la::Vector &displacement);

    const ContactHost<dim> &host_;
    /** The first ones; empty: not wanted any more. */
    la::Vector residual_, start_;
    Message finding_;
    double lost_ = 0.;
    bool has_prescribed_ = false; ///< seen: R has their forces
  };
} // namespace abut::shim

#endif
