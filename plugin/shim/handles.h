// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_HANDLES_H
#define ABUT_SHIM_HANDLES_H

#include <abut/rows.h>
#include <abut/strategy.h>

#include <deal.II/base/exceptions.h>

#include <memory>

namespace abut::shim
{
  /** Destroys an object of the C core. */
  struct Destroy
  {
    void operator()(abut_context *object) const
    {
      abut_context_destroy(&object);
    }
    void operator()(abut_rows *object) const
    {
      abut_rows_destroy(&object);
    }
    void operator()(abut_strategy *object) const
    {
      abut_strategy_destroy(&object);
    }
  };

  template <typename Object> using Handle = std::unique_ptr<Object, Destroy>;

  /** Throw what the core says when a call failed. */
  inline void check(const abut_context *context, const abut_status status)
  {
    AssertThrow(status == ABUT_SUCCESS,
                dealii::ExcMessage(
                    context != nullptr && *abut_context_message(context) != 0
                        ? abut_context_message(context)
                        : abut_status_text(status)));
  }

  inline Handle<abut_context> create_context()
  {
    abut_context *context = nullptr;
    check(nullptr, abut_context_create(nullptr, &context));
    return Handle<abut_context>(context);
  }

  inline Handle<abut_rows> create_rows(abut_context *context)
  {
    abut_rows *rows = nullptr;
    check(context, abut_rows_create(context, &rows));
    return Handle<abut_rows>(rows);
  }

  inline Handle<abut_strategy>
  create_strategy(abut_context *context, const abut_strategy_options &options)
  {
    abut_strategy *strategy = nullptr;
    check(context, abut_strategy_create(context, &options, &strategy));
    return Handle<abut_strategy>(strategy);
  }
} // namespace abut::shim

#endif
