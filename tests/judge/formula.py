# SPDX-License-Identifier: LGPL-2.1-or-later
"""Formulas of scene files, read by the judge itself."""
import math
import re


def split(text, separator):
    """Parts at a separator outside of parentheses, without blanks around."""
    parts, depth, start = [], 0, 0
    for i, c in enumerate(text):
        depth += (c == "(") - (c == ")")
        if c == separator and depth == 0:
            parts.append(text[start:i].strip())
            start = i + 1
    parts.append(text[start:].strip())
    return parts if text.strip() else []


def _choices(text):
    """if(a, b, c) as Python has it, which looks at one branch only."""
    found = re.search(r"\bif\s*\(", text)
    if not found:
        return text
    depth, end = 1, found.end()
    while depth > 0:
        depth += (text[end] == "(") - (text[end] == ")")
        end += 1
    condition, yes, no = (_choices(part) for part in
                          split(text[found.end():end - 1], ","))
    return (f"{text[:found.start()]}(({yes}) if ({condition}) else ({no}))"
            f"{_choices(text[end:])}")


def _ternary(text):
    """a ? b : c as Python has it, the innermost parentheses first."""
    depth, start, colon = 0, -1, 0
    for i, c in enumerate(text):
        depth += (c == "(") - (c == ")")
        if depth > 0:
            continue
        if c == "?" and start < 0:
            start = i
        elif c == "?":
            colon += 1
        elif c == ":" and colon > 0:
            colon -= 1
        elif c == ":" and start >= 0:
            return (f"(({_ternary(text[start + 1:i])}) if "
                    f"({_ternary(text[:start])}) else "
                    f"({_ternary(text[i + 1:])}))")
    return _inside(text)


def _inside(text):
    """The same in what stands in parentheses, at commas."""
    result, depth, begin = "", 0, 0
    for i, c in enumerate(text):
        if c == "(" and depth == 0:
            begin = i + 1
        depth += (c == "(") - (c == ")")
        if c == ")" and depth == 0:
            parts = split(text[begin:i], ",") if "?" in text[begin:i] else [
                text[begin:i]]
            result += "(" + ", ".join(map(_ternary, parts)) + ")"
        elif depth == 0:
            result += c
    return result


def _domain(function):
    """A function that answers nan outside of its domain."""
    def guarded(*values):
        try:
            return function(*values)
        except (ValueError, OverflowError):
            return math.nan
    return guarded


_NAMES = {name: _domain(getattr(math, name)) for name in (
    "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh",
    "tanh", "exp", "sqrt", "pow", "log2", "log10", "log")}
_NAMES.update({
    "ln": _NAMES["log"], "abs": abs, "min": min, "max": max,
    "floor": math.floor, "ceil": math.ceil, "rint": round, "int": round,
    "sign": lambda x: (x > 0) - (x < 0), "pi": math.pi, "_pi": math.pi,
    "_e": math.e, "erfc": math.erfc, "__builtins__": {}})


class Formula:
    """A formula in x, y, z and t."""

    def __init__(self, text):
        self.text = text
        words = _choices(text)
        words = _ternary(words) if "?" in words else words
        words = words.replace("^", "**")
        words = words.replace("&&", " and ").replace("||", " or ")
        words = " ".join(words.replace("\\\n", " ").split())
        try:
            self.function = eval(  # the judge's own translation of a scene
                f"lambda x, y, z, t: ({words})", dict(_NAMES))
        except SyntaxError as error:
            raise ValueError(f"the formula '{text}' cannot be read") from error

    def __call__(self, point, time=0.):
        try:
            value = self.function(point[0], point[1],
                                  point[2] if len(point) > 2 else 0., time)
            return float(value)
        except (ZeroDivisionError, OverflowError, TypeError):
            return math.nan

    def is_zero(self):
        """Whether it is the number 0."""
        try:
            return float(self.text) == 0.
        except ValueError:
            return False


def numbers(text):
    """Numbers separated by commas or blanks."""
    return [float(word) for word in text.replace(",", " ").split()]
