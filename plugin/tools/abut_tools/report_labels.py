# SPDX-License-Identifier: LGPL-2.1-or-later
"""Words and dimensions of the keys of summary.json and of columns of tables."""

# Of pair N, behind pair_N_, in the order of the page.
PAIR = {
    "force": ("force on the secondary surface", "force"),
    "primary_force": ("force on the primary surface", "force"),
    "moment": ("moment on the secondary surface about the origin", "moment"),
    "pressure": ("largest pressure", "pressure"),
    "least_pressure": ("least pressure in contact", "pressure"),
    "largest_tension": ("largest tension", "pressure"),
    "contact_area": ("contact area", "area"),
    "covered_area": ("area with a partner opposite", "area"),
    "area": ("area of the secondary surface", "area"),
    "penetration": ("largest penetration", "length"),
    "penetration_by_facet": ("penetration / size of a facet", ""),
    "between_rows": ("depth of the other side between contact points", "length"),
    "held_inside": ("depth of nodes fixed inside the other side", "length"),
    "slip": ("largest slip of a closed point", "length"),
    "gap_error": ("largest error of a gap", "length"),
    "turn": ("mean rotation of the normals in contact", "radian"),
    "turned_force": ("force with rotated normals", "force"),
    "normal_force": ("normal force", "force"),
    "friction": ("friction on the secondary surface", "force"),
    "friction_force": ("sum of tangential forces", "force"),
    "friction_ratio": ("friction / normal force", ""),
    "traction": ("largest tangential traction", "pressure"),
    "dissipation": ("energy dissipated in the last step", "energy"),
    "rows": ("contact points", ""),
    "active": ("of these closed", ""),
    "slipping": ("of these slipping", ""),
    "prescribed_nodes": ("nodes with prescribed normal displacement", ""),
    "prescribed_share": ("share of their force", ""),
    "shared_stick_share": ("share of nodes in two contacts", ""),
    "initial_gap_work": ("work on initial gaps", "energy"),
    "transfer_error": ("uniform pressure transferred to wrong nodes", ""),
}

# Of PAIR, what most readers look for.
MAIN = ("force", "moment", "pressure", "contact_area", "penetration", "slip",
        "normal_force", "friction", "friction_ratio", "active", "slipping")

# Of the whole run, in the order of the page.
RUN = {
    "contact_force": ("contact force", "force"),
    "largest_contact_force": ("largest contact force", "force"),
    "contact_impulse": ("impulse of contact", "impulse"),
    "first_contact_time": ("first contact", "time"),
    "last_contact_time": ("last contact", "time"),
    "n_touches": ("touches", ""),
    "max_penetration": ("largest penetration", "length"),
    "allowed_penetration": ("allowed penetration", "length"),
    "max_complementarity": ("error of the complementarity condition", ""),
    "active": ("points in contact", ""),
    "constraints": ("contact points", ""),
    "lambda": ("Lagrange multiplier", ""),
    "displacement": ("displacement", "length"),
    "velocity": ("velocity", "length/time"),
    "momentum": ("momentum", "impulse"),
    "friction_force": ("friction force", "force"),
    "friction_over_normal": ("friction / normal force", ""),
    "n_slipping": ("points that slip", ""),
    "dissipation": ("energy dissipated by friction", "energy"),
    "energy": ("potential energy", "energy"),
    "kinetic_energy": ("kinetic energy", "energy"),
    "strain_energy": ("strain energy", "energy"),
    "contact_energy": ("energy of contact", "energy"),
    "dissipated_energy": ("dissipated energy", "energy"),
    "external_work": ("work of the loads", "energy"),
    "initial_energy": ("initial energy", "energy"),
    "energy_balance": ("balance of energy", "energy"),
    "energy_gain": ("part of the energy gained by the scheme", ""),
    "energy_loss": ("part of the energy lost", ""),
    "energy_lost_in_impacts": ("energy lost in impacts", "energy"),
    "l2_error": ("error of the displacement, L2 norm", ""),
    "h1_error": ("error of the gradient, L2 norm", ""),
    "energy_norm_error": ("error in the energy norm", ""),
    "nodal_error": ("largest nodal error", "length"),
    "energy_error": ("error of the energy", "energy"),
    "estimate": ("estimated error, energy norm", ""),
    "estimated_error": ("estimated relative error", ""),
    "target_error": ("target of the relative error", ""),
    "effectivity": ("estimated / true error", ""),
    "energy_order": ("order of convergence of the energy", ""),
    "time": ("time reached", "time"),
    "dofs": ("unknowns", ""),
    "cells": ("cells", ""),
    "nodes": ("nodes of the secondary surface", ""),
    "facets": ("facets of the primary surface", ""),
    "candidates": ("candidates", ""),
    "contact_elements": ("nodes with a partner", ""),
    "pairs": ("pairs of facets found by the search", ""),
    "pairs_with_area": ("pairs of facets with common area", ""),
    "common_area": ("common area", "area"),
    "uncovered_area": ("area without partner", "area"),
    "smallest_gap": ("smallest gap", "length"),
    "largest_gap": ("largest gap", "length"),
    "initial_overlaps": ("nodes that overlap", ""),
    "largest_overlap": ("largest overlap", "length"),
    "ns_per_node": ("time of the search per node", "ns"),
    "bytes_per_facet": ("memory per facet", "byte"),
}

# Of the solution.
EFFORT = {
    "method": ("enforcement of contact", ""),
    "discretisation": ("discretisation of contact", ""),
    "linear_solver": ("linear solver", ""),
    "load_steps": ("load steps", ""),
    "load_steps_cut_back": ("load steps cut back", ""),
    "time_steps": ("time steps", ""),
    "nonlinear_iterations": ("active set and Newton iterations", ""),
    "linearisations": ("linearisations", ""),
    "linear_iterations": ("iterations of the linear solver", ""),
    "matvecs": ("matrix-vector products", ""),
    "searches": ("searches", ""),
    "search_reuses": ("searches reused", ""),
    "fallback_steps": ("single changes of the active set", ""),
    "stable_time_step": ("largest stable time step", "time"),
}

# Measures of the examination, with the code of the message that belongs to them
# (doc/failures.md); of pairs without pair_N_.
EXAMINATION = {
    "imbalance": ("forces out of balance / contact forces", "ABUT-F30"),
    "work_error": ("works that contradict the energy", "ABUT-F38"),
    "largest_strain": ("largest strain", "ABUT-F35"),
    "mean_strain": ("mean strain of a body", "ABUT-F35"),
    "condition": ("condition number of the preconditioned matrix", "ABUT-F30"),
    "volumetric_locking": ("strain energy of volume change within cells",
                           "ABUT-F16"),
    "linear_stiffness_error": ("strain energy that linear simplices lack",
                               "ABUT-F16"),
    "penetration": ("", "ABUT-F06"),
    "held_inside": ("", "ABUT-F26"),
    "between_rows": ("", "ABUT-F19, ABUT-F37"),
    "gap_error": ("", "ABUT-F36"),
    "turn": ("", "ABUT-F36"),
    "transfer_error": ("", "ABUT-F03"),
}

COLUMNS = {
    "load_step": "load step", "dofs": "unknowns", "constraints": "points",
    "active": "closed", "steps": "linear systems",
    "linear_iterations": "linear iterations", "matvecs": "products",
    "setups": "set-ups", "contact_force": "contact force",
    "estimated_error": "estimated relative error",
    "energy_norm_error": "error, energy norm", "l2_error": "error, L2",
    "h1_error": "error, H1", "setup_seconds": "set-up [s]",
    "krylov_seconds": "iterations [s]", "seconds": "time [s]",
    "detection_seconds": "search [s]",
}


def unit(dimension):
    return f' <span class="unit">[{dimension}]</span>' if dimension else ""


def label(table, key):
    words, dimension = table.get(key, (key.replace("_", " "), ""))
    return words + unit(dimension)


def column(key):
    return COLUMNS.get(key, key.replace("_", " "))
