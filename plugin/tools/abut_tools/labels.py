# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels that a reader understands, with symbols and dimensions, for keys of
tables, fields and summary.json. Abut has no units of its own: the dimension in
brackets says what the unit is made of."""

# Key: words, symbol, dimension.
LABELS = {
    "displacement": ("displacement", "u", "length"),
    "pressure": ("contact pressure", "p", "force/area"),
    "friction": ("tangential traction", "q", "force/area"),
    "gap": ("gap", "g", "length"),
    "slip": ("slip of the step", "s", "length"),
    "traction": ("traction", "t", "force/area"),
    "arc": ("length along the contact line", "s", "length"),
    "x": ("position", "x", "length"),
    "y": ("position", "y", "length"),
    "z": ("position", "z", "length"),
    "von_mises_stress": ("von Mises stress", r"\sigma_v", "force/area"),
    "time": ("time", "t", "time"),
    "dofs": ("degrees of freedom", "N", ""),
    "l2_error": ("error in the $L^2$ norm", "", ""),
    "h1_error": ("error in the $H^1$ seminorm", "", ""),
    "energy_norm_error": ("error in the energy norm", "", ""),
    "estimate": ("estimated error in the energy norm", r"\eta", ""),
    "energy": ("energy", "E", "force·length"),
    "kinetic_energy": ("kinetic", "", "force·length"),
    "strain_energy": ("strain", "", "force·length"),
    "contact_energy": ("contact", "", "force·length"),
    "dissipated_energy": ("dissipated", "", "force·length"),
    "external_work": ("external work", "W", "force·length"),
    "energy_balance": ("balance", "", "force·length"),
    "contact_force": ("contact force", "F", "force"),
    "largest_pressure": ("largest pressure", "p_{max}", "force/area"),
    "max_penetration": ("largest penetration", r"\delta", "length"),
    "wall_seconds": ("wall time", "", "s"),
    "processor_seconds": ("processor time", "", "s"),
    "peak_memory_mb": ("peak memory", "", "MiB"),
    "linear_systems": ("linear systems", "", ""),
    "linear_iterations": ("iterations of the linear solver", "", ""),
    "nonlinear_iterations": ("active set and Newton iterations", "", ""),
    "matvecs": ("matrix-vector products", "", ""),
    "penalty": (r"penalty", r"\epsilon", ""),
    "bucket_size": ("bucket size / median facet size", "", ""),
    "ns_per_node": ("search time per node", "", "ns"),
}


def words(key):
    """The words alone: 'contact pressure'; of a key that is not listed, the key
    with blanks."""
    return LABELS[key][0] if key in LABELS else key.replace("_", " ")


def label(key, with_unit=True):
    """'contact pressure $p$ [force/area]'."""
    text, symbol, unit = LABELS.get(key, (key.replace("_", " "), "", ""))
    if symbol:
        text += f" ${symbol}$"
    if unit and with_unit:
        text += f" [{unit}]"
    return text
