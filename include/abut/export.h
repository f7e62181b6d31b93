/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_EXPORT_H
#define ABUT_EXPORT_H

/** @file
 * Marks the functions that the shared library exports. The library is built
 * with hidden symbols, so that a function without this mark stays inside.
 */

#if defined(__GNUC__) || defined(__clang__)
#define ABUT_API __attribute__((visibility("default")))
#else
#define ABUT_API
#endif

#endif
