// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NAME_PARAMETER_H
#define ABUT_APP_NAME_PARAMETER_H

#include "app/input/dealii_message.h"
#include "app/input/input_error.h"
#include "contact_model.h"

#include <functional>

namespace abut::app
{
  /** Do what may find that contact cannot be, and say by which parameter. */
  template <int dim>
  void name_parameter(const ContactModel<dim> &model,
                      const std::function<void()> &action)
  {
    try
    {
      action();
    }
    catch (const ContactError &error)
    {
      throw InputError(model.parameter_of(error.what()), dealii_message(error));
    }
    catch (const ObstacleError &error)
    {
      throw InputError(model.parameter_of(error.what()), dealii_message(error));
    }
  }
} // namespace abut::app

#endif
