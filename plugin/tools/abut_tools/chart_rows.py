# SPDX-License-Identifier: LGPL-2.1-or-later
"""The results of the runs of a chart."""
import math
from dataclasses import dataclass

NAN = math.nan


@dataclass
class ChartRow:
    """One setting of the scene: a point of a curve. Unknown numbers are
    NaN."""
    curve: int
    value: str       # along the axis
    x: float = NAN   # as a number, or the axis quantity
    ended: str = ""  # ok, unusable, refused, failed, out of time
    reason: str = ""
    code: int = 0
    quantity: float = NAN
    error: float = NAN
    time: float = NAN  # median of the repeats, as are the next two
    processor_seconds: float = NAN
    wall_seconds: float = NAN
    fastest: float = NAN  # of time
    slowest: float = NAN
    repeats: int = 0
    matvecs: float = NAN
    linear_iterations: float = NAN
    nonlinear_iterations: float = NAN
    dofs: float = NAN
    constraints: float = NAN
    active: float = NAN
    peak_memory_mb: float = NAN
    time_front: bool = False  # no other run has less error in less time
    work_front: bool = False  # likewise with matrix-vector products
    key: str = ""             # of its folder in `runs`

    @property
    def ok(self):
        return self.ended == "ok"


def pareto_front(points):
    """Which of the points (cost, error) no other one beats: none has both at
    most as large and one of them smaller. Points with NaN are beaten.
    O(n log n)."""
    order = sorted((point, i) for i, point in enumerate(points)
                   if not any(map(math.isnan, point)))
    front, last = [False] * len(points), None
    for point, i in order:
        if last is None or point[1] < last[1] or point == last:
            front[i], last = True, point
    return front


def mark_fronts(rows):
    """Set time_front and work_front, among the rows that are ok. Errors are
    compared in two digits: less does not tell methods from each other."""
    for cost, front in (("time", "time_front"), ("matvecs", "work_front")):
        points = [(getattr(row, cost), float(f"{row.error:.1e}")
                   if row.ok else NAN) for row in rows]
        for row, mark in zip(rows, pareto_front(points)):
            setattr(row, front, mark)


def cheapest(rows, target):
    """The row of least time whose error is at most the target; None if there
    is none."""
    return min((row for row in rows if row.ok and row.error <= target
                and not math.isnan(row.time)),
               key=lambda row: row.time, default=None)


def is_as_fast(row, best):
    """Whether a row was, in its fastest repeat, not slower than the best one
    was in its slowest: the two are not told apart."""
    return row.fastest <= best.slowest
