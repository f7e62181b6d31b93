/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/version.h>

int
abut_version(void)
{
  return ABUT_VERSION_NUMBER(ABUT_VERSION_MAJOR, ABUT_VERSION_MINOR,
                             ABUT_VERSION_PATCH);
}
