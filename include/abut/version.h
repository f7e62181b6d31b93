/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_VERSION_H
#define ABUT_VERSION_H

/** @file
 * The version of these headers, and of the library that runs. Programs and
 * libraries fit together when the first two numbers agree.
 */

#include <abut/export.h>

#ifdef __cplusplus
extern "C"
{
#endif

/** Major, minor and patch number. */
#define ABUT_VERSION "0.1.0"
#define ABUT_VERSION_MAJOR 0 /**< first number */
#define ABUT_VERSION_MINOR 1 /**< second number */
#define ABUT_VERSION_PATCH 0 /**< third number */

/** A version as one number that grows with it. */
#define ABUT_VERSION_NUMBER(major, minor, patch)                               \
  ((major)*10000 + (minor)*100 + (patch))

  /** ABUT_VERSION_NUMBER of the library that runs, which need not be that of
   * the headers that a program was compiled with. */
  ABUT_API int abut_version(void);

#ifdef __cplusplus
}
#endif

#endif
