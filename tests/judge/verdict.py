# SPDX-License-Identifier: LGPL-2.1-or-later
"""The judge's findings."""


class CannotJudge(Exception):
    """There is nothing to judge, and why."""


class Wrong(Exception):
    """What was written contradicts itself so that nothing more can be read."""


def says(summary, *words):
    """Whether the run warns of something with one of the words."""
    return any(word in text for text in summary["warnings"] for word in words)


class Findings:
    """Checks in the order in which they were made."""

    def __init__(self):
        self.rows = []  # name, value, limit, fine, reason
        self.left = []  # what was not judged, and why

    def check(self, name, value, limit, reason):
        """A value that must not be above its limit; NaN fails."""
        self.rows.append((name, value, limit, value <= limit, reason))

    def require(self, name, condition, reason):
        """A condition without a number."""
        self.rows.append((name, 0. if condition else 1., 0., condition, reason))

    def leave(self, name, reason):
        self.left.append((name, reason))

    @property
    def wrong(self):
        return [row for row in self.rows if not row[3]]

    def print(self):
        width = max([len(row[0]) for row in self.rows] + [5])
        for name, value, limit, fine, reason in self.rows:
            print(f"{'ok   ' if fine else 'WRONG'} {name:{width}} {value:12.4e}"
                  f" <= {limit:10.4e}  {reason}")
        for name, reason in self.left:
            print(f"not judged: {name}: {reason}")
