# SPDX-License-Identifier: LGPL-2.1-or-later
"""The word that a user may have meant: the nearest one by the edit distance of
Damerau and Levenshtein, as include/abut/dealii/nearest_word.h has it."""


def edit_distance(one, other):
    """Insertions, deletions, replacements and exchanges of neighbours that
    make one word of the other."""
    before, row = [], list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        two_before, before, row = before, row, [i]
        for j, next_letter in enumerate(other, 1):
            row.append(min(before[j] + 1, row[j - 1] + 1,
                           before[j - 1] + (letter != next_letter)))
            if (i > 1 and j > 1 and letter == other[j - 2]
                    and one[i - 2] == next_letter):
                row[j] = min(row[j], two_before[j - 2] + 1)
    return row[-1]


def distance(wanted, word):
    result = edit_distance(wanted, word)
    # "lagrang multiplier" for "lagrange": the first words are near.
    if " " in wanted:
        result = min(result, 1 + edit_distance(wanted.split(" ")[0],
                                               word.split(" ")[0]))
    # "interior" for "interior point": one begins with the other.
    if len(wanted) > 2 and (word.startswith(wanted) or wanted.startswith(word)):
        result = min(result, 1)
    return result


def nearest_word(wanted, words):
    """The nearest word, capitals and small letters alike; "" if none is
    near."""
    near = [(distance(wanted.lower(), word.lower()), word) for word in words]
    near = [(steps, word) for steps, word in near
            if steps <= 1 + max(len(wanted), len(word)) // 3]
    return min(near, key=lambda entry: entry[0])[1] if near else ""


def did_you_mean(wanted, words):
    """" Did you mean 'x'?" with the nearest word, or ""."""
    nearest = nearest_word(wanted, words)
    return f" Did you mean '{nearest}'?" if nearest else ""
