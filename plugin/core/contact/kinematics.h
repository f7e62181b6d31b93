/* SPDX-License-Identifier: LGPL-2.1-or-later */
#ifndef ABUT_CONTACT_KINEMATICS_H
#define ABUT_CONTACT_KINEMATICS_H

#include <abut/kinematics.h>

/* Entry of a kinematics; NULL if there is no such one. */
const abut_kinematics_info *abut_kinematics_get(abut_kinematics kinematics);

#endif
