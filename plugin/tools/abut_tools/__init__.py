# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures and reports of runs of the program `abut`."""
