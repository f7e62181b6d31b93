# SPDX-License-Identifier: LGPL-2.1-or-later
"""Labels that a reader understands, with symbols and dimensions, for keys of
tables, fields and summary.json. Abut has no units of its own: the dimension in
brackets says what the unit is made of."""
import re

# Key: words, symbol, dimension.
LABELS = {
    # Fields and columns of tables.
    "displacement": ("displacement", "u", "length"),
    "pressure": ("contact pressure", "p", "force/area"),
    "traction": ("traction", "t", "force/area"),
    "arc": ("length along the contact line", "s", "length"),
    "von_mises_stress": ("von Mises stress", r"\sigma_v", "force/area"),
    "time": ("time", "t", "time"),
    "load_step": ("load step", "", ""),
    "steps": ("linear systems", "", ""),
    "setups": ("set-ups", "", ""),
    "setup_seconds": ("set-up", "", "s"),
    "krylov_seconds": ("iterations", "", "s"),
    "detection_seconds": ("search", "", "s"),
    "seconds": ("time", "", "s"),
    "bucket_size": ("bucket size / median facet size", "", ""),
    "penalty": (r"penalty", r"\epsilon", ""),
    # Results.
    "contact_force": ("contact force", "F", "force"),
    "largest_contact_force": ("largest contact force", "", "force"),
    "contact_impulse": ("impulse of contact", "", "force·time"),
    "first_contact_time": ("first contact", "", "time"),
    "last_contact_time": ("last contact", "", "time"),
    "n_touches": ("touches", "", ""),
    "max_penetration": ("largest penetration", r"\delta", "length"),
    "allowed_penetration": ("allowed penetration", "", "length"),
    "max_complementarity": ("error of the complementarity condition", "", ""),
    "active": ("points in contact", "", ""),
    "constraints": ("contact points", "", ""),
    "lambda": ("Lagrange multiplier", r"\lambda", ""),
    "velocity": ("velocity", "v", "length/time"),
    "momentum": ("momentum", "", "force·time"),
    "friction_force": ("friction force", "", "force"),
    "friction_over_normal": ("friction / normal force", "", ""),
    "n_slipping": ("points that slip", "", ""),
    "dissipation": ("energy dissipated by friction", "", "force·length"),
    "energy": ("energy", "E", "force·length"),
    "kinetic_energy": ("kinetic energy", "", "force·length"),
    "strain_energy": ("strain energy", "", "force·length"),
    "contact_energy": ("energy of contact", "", "force·length"),
    "dissipated_energy": ("dissipated energy", "", "force·length"),
    "external_work": ("work of the loads", "W", "force·length"),
    "initial_energy": ("initial energy", "", "force·length"),
    "energy_balance": ("balance of energy", "", "force·length"),
    "energy_gain": ("part of the energy gained by the scheme", "", ""),
    "energy_loss": ("part of the energy lost", "", ""),
    "energy_lost_in_impacts": ("energy lost in impacts", "", "force·length"),
    "l2_error": ("error, L2 norm", "", ""),
    "h1_error": ("error, H1 seminorm", "", ""),
    "energy_norm_error": ("error, energy norm", "", "(force·length)^(1/2)"),
    "nodal_error": ("largest nodal error", "", "length"),
    "energy_error": ("error of the energy", "", "force·length"),
    "estimate": ("estimated error", r"\eta",
                 "(force·length)^(1/2)"),
    "relative_estimate": ("estimated error / solution, energy norm", "", ""),
    "estimated_error": ("estimated relative error", "", ""),
    "target_error": ("target of the relative error", "", ""),
    "effectivity": ("estimated / true error", "", ""),
    "energy_order": ("order of convergence of the energy", "", ""),
    "dofs": ("unknowns", "N", ""),
    "cells": ("cells", "", ""),
    "nodes": ("nodes of the secondary surface", "", ""),
    "facets": ("facets of the primary surface", "", ""),
    "candidates": ("candidates", "", ""),
    "contact_elements": ("nodes with a partner", "", ""),
    "pairs": ("pairs of facets found by the search", "", ""),
    "pairs_with_area": ("pairs of facets with common area", "", ""),
    "common_area": ("common area", "", "area"),
    "uncovered_area": ("area without partner", "", "area"),
    "smallest_gap": ("smallest gap", "", "length"),
    "largest_gap": ("largest gap", "", "length"),
    "initial_overlaps": ("nodes that overlap", "", ""),
    "largest_overlap": ("largest overlap", "", "length"),
    "ns_per_node": ("search time per node", "", "ns"),
    "bytes_per_facet": ("memory per facet", "", "byte"),
    # Of bodies, points and obstacles, without the number.
    "reaction": ("reaction of the supports", "", "force"),
    "moved": ("mean displacement", "", "length"),
    "rotated": ("mean rotation", "", "radian"),
    "node": ("nearest node", "", "length"),
    "force": ("contact force", "", "force"),
    # Effort.
    "method": ("enforcement of contact", "", ""),
    "discretisation": ("discretisation of contact", "", ""),
    "linear_solver": ("linear solver", "", ""),
    "load_steps": ("load steps", "", ""),
    "load_steps_cut_back": ("load steps cut back", "", ""),
    "time_steps": ("time steps", "", ""),
    "linear_systems": ("linear systems", "", ""),
    "nonlinear_iterations": ("active set and Newton iterations", "", ""),
    "linearisations": ("linearisations", "", ""),
    "linear_iterations": ("iterations of the linear solver", "", ""),
    "matvecs": ("matrix-vector products", "", ""),
    "searches": ("searches", "", ""),
    "search_reuses": ("searches reused", "", ""),
    "fallback_steps": ("single changes of the active set", "", ""),
    "stable_time_step": ("largest stable time step", "", "time"),
    "wall_seconds": ("wall time", "", "s"),
    "processor_seconds": ("processor time", "", "s"),
    "peak_memory_mb": ("peak memory", "", "MiB"),
    # Measures of the examination.
    "imbalance": ("forces out of balance / contact forces", "", ""),
    "work_error": ("works that contradict the energy", "", ""),
    "largest_strain": ("largest strain", "", ""),
    "mean_strain": ("mean strain of a body", "", ""),
    "largest_rotation": ("largest rotation", "", "radian"),
    "mean_rotation": ("mean rotation of a body", "", "radian"),
    "condition": ("condition number of the preconditioned matrix", "", ""),
    "negative_curvature": ("curvature of the energy, negative where unstable",
                           "", ""),
    "shear_locking": ("strain energy of shear in elements that cannot bend",
                      "", ""),
    "volumetric_locking": ("strain energy of volume change within cells", "",
                           ""),
    "linear_stiffness_error": ("strain energy that linear simplices lack", "",
                               ""),
}

# Values of constraints and masses, which are no directions.
LISTS = ("contact_force", "lambda", "displacement")

# Of pair N, behind pair_N_, in the order of pages.
PAIR = {
    "force": ("force on the secondary surface", "", "force"),
    "primary_force": ("force on the primary surface", "", "force"),
    "moment": ("moment on the secondary surface about the origin", "",
               "force·length"),
    "pressure": ("largest pressure", "", "force/area"),
    "least_pressure": ("least pressure in contact", "", "force/area"),
    "largest_tension": ("largest tension", "", "force/area"),
    "contact_area": ("contact area", "", "area"),
    "covered_area": ("area with a partner opposite", "", "area"),
    "area": ("area of the secondary surface", "", "area"),
    "penetration": ("largest penetration", "", "length"),
    "penetration_by_facet": ("penetration / size of a facet", "", ""),
    "between_rows": ("depth of the other side between contact points", "",
                     "length"),
    "held_inside": ("depth of nodes fixed inside the other side", "", "length"),
    "slip": ("largest slip of a closed point", "", "length"),
    "gap_error": ("largest error of a gap", "", "length"),
    "turn": ("mean rotation of the normals in contact", "", "radian"),
    "turned_force": ("force with rotated normals", "", "force"),
    "oscillation": ("part of the pressure that alternates between nodes", "",
                    ""),
    "normal_force": ("normal force", "", "force"),
    "friction": ("friction on the secondary surface", "", "force"),
    "friction_force": ("sum of tangential forces", "", "force"),
    "friction_ratio": ("friction / normal force", "", ""),
    "traction": ("largest tangential traction", "", "force/area"),
    "dissipation": ("energy dissipated in the last step", "", "force·length"),
    "rows": ("contact points", "", ""),
    "active": ("of these closed", "", ""),
    "slipping": ("of these slipping", "", ""),
    "prescribed_nodes": ("nodes with prescribed normal displacement", "", ""),
    "prescribed_share": ("share of their force", "", ""),
    "shared_stick_share": ("share of nodes in two contacts", "", ""),
    "initial_gap_work": ("work on initial gaps", "", "force·length"),
    "load_error": ("force of loads that cells do not resolve", "", ""),
    "friction_error": ("friction that facets do not resolve", "", ""),
    "support_error": ("prescribed displacement that facets do not resolve", "", ""),
    "transfer_error": ("uniform pressure transferred to wrong nodes", "", ""),
}


def entry(key):
    """Words, symbol and dimension of a key, `pair_1_force[1]`, too."""
    name, bracket, index = key.partition("[")
    part = re.fullmatch(r"(pair|point|body|obstacle)_(\d+)_?(.*)", name)
    rest = part[3] or "displacement" if part else name
    text, symbol, dimension = (PAIR if part and part[1] == "pair" else LABELS
                               ).get(rest, (rest.replace("_", " "), "", ""))
    if part:
        text += f" of {part[1]} {part[2]}"
    if name in LISTS and bracket:
        text += f", entry {int(index.rstrip(']')) + 1}"
    elif bracket and index.rstrip("]") in ("0", "1", "2"):
        text += f" in {'xyz'[int(index.rstrip(']'))]}"
    return text, symbol, dimension


def words(key):
    """The words alone: 'contact force', 'displacement of point 1 in x'."""
    return entry(key)[0]


def label(key):
    """'contact pressure $p$ [force/area]'."""
    text, symbol, dimension = entry(key)
    if symbol:
        text += f" ${symbol}$"
    return f"{text} [{dimension}]" if dimension else text
