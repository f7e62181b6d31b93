/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CORE_TIME_SCHEME_H
#define ABUT_CORE_TIME_SCHEME_H

#include <abut/time.h>
#include <stdbool.h>

/* Take a scheme from the caller; INVALID_ARGUMENT if it is NULL, of no known
 * size, or has numbers out of range. */
abut_status abut_time_scheme_copy_in(const abut_time_scheme *given,
                                     abut_time_scheme *scheme);

#endif
