/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_VERSION_H
#define ABUT_VERSION_H

/** @file
 * The version of these headers. Programs and libraries fit together when the
 * first two numbers agree.
 */

/** Major, minor and patch number. */
#define ABUT_VERSION "0.1.0"

#endif
