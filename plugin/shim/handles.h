// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ABUT_SHIM_HANDLES_H
#define ABUT_SHIM_HANDLES_H

#include "shim/core_message.h"

#include <abut/dealii/coded.h>
#include <abut/detect.h>
#include <abut/history.h>
#include <abut/interface.h>
#include <abut/obstacle.h>
#include <abut/points.h>
#include <abut/search.h>
#include <abut/strategy.h>
#include <abut/surface.h>

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
    void operator()(abut_points *object) const
    {
      abut_points_destroy(&object);
    }
    void operator()(abut_history *object) const
    {
      abut_history_destroy(&object);
    }
    void operator()(abut_strategy *object) const
    {
      abut_strategy_destroy(&object);
    }
    void operator()(abut_interface *object) const
    {
      abut_interface_destroy(&object);
    }
    void operator()(abut_surface *object) const
    {
      abut_surface_destroy(&object);
    }
    void operator()(abut_search *object) const
    {
      abut_search_destroy(&object);
    }
    void operator()(abut_pairs *object) const
    {
      abut_pairs_destroy(&object);
    }
    void operator()(abut_detection *object) const
    {
      abut_detection_destroy(&object);
    }
    void operator()(abut_obstacle *object) const
    {
      abut_obstacle_destroy(&object);
    }
  };

  template <typename Object> using Handle = std::unique_ptr<Object, Destroy>;

  /** Throw the core's message when a call failed. */
  inline void check(const abut_context *context, const abut_status status)
  {
    AssertThrow(status == ABUT_SUCCESS,
                dealii::ExcMessage(coded(status == ABUT_INVALID_MESH
                                             ? ABUT_FAILURE_DEGENERATE_FACET
                                             : ABUT_FAILURE_NONE,
                                         message_of(context, status))));
  }

  inline Handle<abut_context> create_context()
  {
    abut_context *context = nullptr;
    check(nullptr, abut_context_create(nullptr, &context));
    return Handle<abut_context>(context);
  }

  /** Points over nodes with @p dimension unknowns each. */
  inline Handle<abut_points> create_points(abut_context *context,
                                           const std::int32_t dimension)
  {
    abut_points *points = nullptr;
    check(context, abut_points_create(context, dimension, &points));
    return Handle<abut_points>(points);
  }

  inline Handle<abut_history> create_history(abut_context *context)
  {
    abut_history *history = nullptr;
    check(context, abut_history_create(context, &history));
    return Handle<abut_history>(history);
  }

  inline Handle<abut_strategy>
  create_strategy(abut_context *context, const abut_strategy_options &options)
  {
    abut_strategy *strategy = nullptr;
    check(context, abut_strategy_create(context, &options, &strategy));
    return Handle<abut_strategy>(strategy);
  }

  inline Handle<abut_surface> create_surface(abut_context *context,
                                             const abut_surface_data &data)
  {
    abut_surface *surface = nullptr;
    check(context, abut_surface_create(context, &data, &surface));
    return Handle<abut_surface>(surface);
  }

  inline Handle<abut_search> create_search(abut_context *context,
                                           abut_surface *surface,
                                           const abut_search_options &options)
  {
    abut_search *search = nullptr;
    check(context, abut_search_create(context, surface, &options, &search));
    return Handle<abut_search>(search);
  }

  inline Handle<abut_pairs> create_pairs(abut_context *context)
  {
    abut_pairs *pairs = nullptr;
    check(context, abut_pairs_create(context, &pairs));
    return Handle<abut_pairs>(pairs);
  }

  inline Handle<abut_detection>
  create_detection(abut_context *context, abut_surface *secondary,
                   abut_surface *primary, const abut_detection_options &options)
  {
    abut_detection *detection = nullptr;
    check(context, abut_detection_create(context, secondary, primary, &options,
                                         &detection));
    return Handle<abut_detection>(detection);
  }
} // namespace abut::shim

#endif
