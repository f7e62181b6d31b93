/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_STRATEGY_OPTIONS_H
#define ABUT_STRATEGY_OPTIONS_H

#include "base/context.h"

#include <abut/strategy.h>

/* Legal ranges; call is the public function to name in the message. */
abut_status abut_strategy_check_options(abut_context *context,
                                        const abut_strategy_options *options,
                                        const char *call);

#endif
