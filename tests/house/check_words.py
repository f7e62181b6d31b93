#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""The lint of words finds what it must find, with file and line, and nothing
else: not in the middle of other words, not where an exception stands, and in
strings only where they are texts of several words. Its lists can be read, and
each exception has a reason."""
import importlib.machinery
import importlib.util
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CI = ROOT / ".ci"

LIST = r"""
[phrase]
\b[Aa]new\b => again
\b(?:tells?|told)\b => report
[opening]
What\b => a noun
[identifier]
ten_times => force_sum_factor
take(?:_mutable)? => checked_vector
[text]
\bbeside\b => relative to
"""

# Texts for users, in one literal or several, and strings that are none.
TEXTS = r'''const char *a = "the gap is told "  // told
                  "beside\nthe force. What is new";
const char *b = "beside", c = 'x'; f("told" + x + "an edge beside it");
g(R"(abut --help is
   told)");
'''
TEXTS_FOUND = [(1, "told"), (2, "What"), (2, "beside"), (3, "beside"), (5, "told")]

SOURCE = r'''// SPDX-License-Identifier: LGPL-2.1-or-later
// What begins a file.
/** Made anew, and made
 * anew. What is
 * told here; renewed, What. */
const char *const text = "told anew: take // told";
const char quote = '"'; int take(int ten_times_more); ///< tells
double take_mutable(double x); /* ten_times is code */
int ten_times = take(1);
'''

FOUND = [(2, "What", "a noun"), (3, "anew", "again"), (4, "What", "a noun"),
         (4, "anew", "again"), (5, "told", "report"), (7, "take", "checked_vector"),
         (7, "tells", "report"), (8, "take_mutable", "checked_vector"),
         (9, "take", "checked_vector"), (9, "ten_times", "force_sum_factor")]

# Phrases of the list, and comments that have them or are like them.
BAD = ("made anew", "a number that is none", "the status tells it", "the undeformed bodies",
       "at the present places", "solve it by what can do that", "those of there",
       "the facet in work", "Of the last search", "What holds", "Those of a row",
       "loose bodies", "of floating bodies", "the message says so", "points asked for",
       "a solver that knows nothing of it")
GOOD = ("there is none", "renewed", "floating point", "the presentation",
        "as they are; of the last search", "a sum of those", "whatever it is",
        "deformed bodies", "a workpiece")


def load():
    loader = importlib.machinery.SourceFileLoader("words", str(CI / "words"))
    spec = importlib.util.spec_from_loader("words", loader)
    module = importlib.util.module_from_spec(spec)
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


def main():
    words = load()
    faults = []

    def expect(what, found, wanted):
        if found != wanted:
            faults.append(f"{what}: found {found} instead of {wanted}")

    rules = words.read_list(LIST)
    found = sorted((SOURCE.count("\n", 0, place) + 1, word, use)
                   for place, word, use in words.findings(SOURCE, rules))
    expect("a source", found, FOUND)
    found = sorted((TEXTS.count("\n", 0, place) + 1, word)
                   for place, word, use in words.text_findings(TEXTS, rules))
    expect("texts", found, TEXTS_FOUND)
    long = 'f("' + " ".join(["word"] * 36) + '. A short one.");'
    expect("a long sentence", [use for _, _, use in words.text_findings(long, rules)],
           ["shorter sentences: this one has 36 words"])
    texts = {"a.h": "// anew\n", "b.h": "// anew\n"}
    exceptions = words.read_exceptions("# none\na.h | anew | a quotation\n"
                                       "b.h | told | a quotation\n")
    expect("exceptions", words.lint(texts, rules, exceptions),
           ["b.h:1: anew: use again",
            ".ci/words.exceptions: b.h | told: is not there any more"])
    for text, read in (("anew => again", words.read_list),
                       ("[phrase]\nanew", words.read_list),
                       ("a.h | anew", words.read_exceptions),
                       ("a.h | anew | ", words.read_exceptions)):
        try:
            read(text)
            faults.append(f"read without an error: {text}")
        except ValueError:
            pass
    rules = words.read_list((CI / "words.list").read_text(encoding="utf-8"))
    words.read_exceptions((CI / "words.exceptions").read_text(encoding="utf-8"))
    for text, wanted in [(text, True) for text in BAD] + [(text, False) for text in GOOD]:
        expect(text, any(words.findings(f"/* {text}. */", rules)), wanted)
    n_sources = len(words.sources(ROOT))
    if n_sources < 300:
        faults.append(f"only {n_sources} sources are read")
    print("\n".join(faults) if faults else f"{n_sources} sources are read")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
