# SPDX-License-Identifier: LGPL-2.1-or-later
"""The time that the rest of a chart will take."""
import math


class ChartClock:
    """Estimates the time left from that of the finished points. A point that is
    still to be made is taken to cost as much more than the one before it on
    its curve as this step has cost on other curves."""

    def __init__(self, n_points):
        self._seconds = [[None] * n for n in n_points]

    def set(self, curve, point, seconds):
        """A point is done; its runs took so long, now or earlier."""
        self._seconds[curve][point] = seconds

    def _growth(self, point):
        """Cost of a point relative to the one before, over the curves that
        have both; else that of the step before; else 1."""
        for k in range(point, 0, -1):
            pairs = [(curve[k - 1], curve[k]) for curve in self._seconds
                     if k < len(curve) and None not in curve[k - 1:k + 1]]
            before = sum(pair[0] for pair in pairs)
            if before > 0:
                return sum(pair[1] for pair in pairs) / before
        return 1

    def left(self):
        """Seconds."""
        first = [curve[0] for curve in self._seconds
                 if curve and curve[0] is not None]
        mean, total = sum(first) / len(first) if first else 0, 0
        for curve in self._seconds:
            expected = mean
            for point, seconds in enumerate(curve):
                if seconds is not None:
                    expected = seconds
                    continue
                expected *= self._growth(point) if point else 1
                total += expected
        return total

    def text(self):
        """"about 3 min left", or "" at the end."""
        left = self.left()
        if left <= 0:
            return ""
        return ("about " + (f"{math.ceil(left)} s" if left < 100 else
                            f"{math.ceil(left / 60)} min") + " left")
