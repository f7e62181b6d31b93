/* SPDX-License-Identifier: LGPL-2.1-or-later */
#include <abut/status.h>

const char *
abut_status_text(abut_status status)
{
  switch (status)
  {
#define ABUT_STATUS_CASE(name, code, text)                                     \
  case ABUT_##name:                                                            \
    return text;
    ABUT_STATUS_LIST(ABUT_STATUS_CASE)
#undef ABUT_STATUS_CASE
  }
  return "unknown status";
}
