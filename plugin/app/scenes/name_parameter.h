// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_APP_NAME_PARAMETER_H
#define ABUT_APP_NAME_PARAMETER_H

#include "app/input/dealii_message.h"
#include "app/input/input_error.h"
#include "contact_model.h"

#include <functional>

namespace abut::app
{
  /** The error with the parameter to blame. */
  template <int dim>
  InputError input_error(const ContactModel<dim> &model,
                         const MessageError &error)
  {
    Message message = error.message();
    message.text = dealii_message(error);
    return InputError(model.parameter_of(message), message);
  }

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
      throw input_error(model, error);
    }
    catch (const ObstacleError &error)
    {
      throw input_error(model, error);
    }
  }
} // namespace abut::app

#endif
