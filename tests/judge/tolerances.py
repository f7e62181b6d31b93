# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the scene itself asks for: limits follow where it asks for less than by
default."""
from thresholds import THRESHOLDS, Threshold


def of_balance(scene, summary, large=False):
    """Limit of balances of forces, or None where a target error sets the
    tolerances. large: of large strain."""
    if scene.number("Refinement/Target error", 0.) > 0:
        return None
    if not summary.get("linear_iterations"):
        least = THRESHOLDS["balance, direct"]
        # of large strain the error of displacements, in the energy norm, and
        # of multipliers that are updated
        newton = scene.number("Time stepping/Newton tolerance", 1e-8)
        return (Threshold(max(least.value, 100 * newton), least.reason)
                if large else least)
    least = THRESHOLDS["balance, iterative"]
    asked = scene.number("Method/Final linear tolerance", 1e-10) / 1e-10
    return Threshold(min(1., least.value * max(1., asked)), least.reason)


def of_energy(scene, summary, large=False):
    """The same of works: errors of forces times displacements, of large strain
    those of parts of the displacement, which cancel in the whole."""
    balance = of_balance(scene, summary, large)
    if balance is None:
        return None
    least = THRESHOLDS["energy"]
    return Threshold(max(least.value, (10 if large else 1) * balance.value),
                     least.reason)


def of_gaps(scene, summary, length):
    """Penetration, or gap under pressure, that the law or the scene leaves
    open. Interior methods end with a product of pressure and gap: where
    pressures are a hundredth of the pressure scale, gaps are a hundred times
    as large."""
    law = summary.get("allowed_penetration") or 0.
    if summary.get("method") in ("barrier", "interior point"):
        law += 100 * length * scene.number("Method/Barrier end", 1e-8)
    return law + length * scene.number("Method/Gap tolerance", 1e-6)
