#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Language of the manual: sentences of 20 words in the mean on each page, at most 5 %
of them above 35 words, and none of the words that the style excludes. Reads
CONTRIBUTING.md and the pages of doc without generated pages; code, formulas, tables and
headings are no sentences. The guide, which is these pages without reference, has at most
40000 words, with tables and without code. No line of these and of generated pages has a
date, a machine or an attempt. In development notes (doc/develop) only the words are
checked.

    tests/house/check_prose.py [--table]"""
import argparse
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MEAN, LONG, SHARE = 20, 35, 0.05
GUIDE = 40000  # words at most
GENERATED = {"commands", "failures", "parameters"}  # by the program
REFERENCE = GENERATED | {"output", "verification"}  # not a part of the guide

WORDS = [(re.compile(pattern, re.I), use) for pattern, use in (
    (r"\b(?:is|are|was|be) told\b|\btells?\b|\bknows\b|\basks\b",
     "reports, prints, warns, requires"),
    (r"\bsays\b", "reports, prints, states"),
    (r"\bholds?\b|\bheld\b", "constrain, fix, satisfy, keep"),
    (r"\banew\b", "recompute, again"),
    (r"\bbeside\b", "compared with, relative to, next to"),
    (r"\bthere to (?:be|see)\b", "for comparison only"),
    (r"\bundeformed\b|\bpresent places?\b", "reference or current configuration"),
    (r"\brefuse[sd]?\b", "is an error"),
    (r"\bfloating\b|\bloose\b", "body without supports"),
    (r"\bnone is\b|\bis none\b|\bis no number\b", "not finite, does not exist"),
    (r"\bis off by\b", "the error is"),
    (r"(?<![\w.])\.\d", "0.3, not .3"),
)]
DIARY = re.compile(
    r"\b20[2-9]\d-\d\d-\d\d\b|(?<!commit )\b(?=\w*\d)(?=\w*[a-df])[0-9a-f]{7,8}\b"
    r"|\b(?:busy|idle)\b|\b(?:other|slower|same|shared|this|two-core) machine"
    r"|\bother work\b|\bthe day before\b|\bsame day\b|\b(?:also|was|were) tried\b"
    r"|\bnot kept\b|\bno longer\b", re.I)
NOT_TEXT = re.compile(r"^```.*?^```|<!--.*?-->|\]\([^)]*\)", re.M | re.S)
OPENING = re.compile(r"^(?:Of|Those|What)\b(?!.*\?$)")

MASKS = [(re.compile(pattern, flags), use) for pattern, flags, use in (
    (r"^```math$.*?^```$", re.M | re.S, " FORMULA "),
    (r"^```.*?^```$", re.M | re.S, "\n\n"),
    (r"<!--.*?-->", re.S, "\n\n"),
    (r"\{cite:\w+\}`[^`]*`", 0, " CITED "),
    (r"\{\w+\}`[^`]*`", 0, " TERM "),
    (r"`[^`]*`", 0, " CODE "),
    (r"\$[^$\n]+\$", 0, " FORMULA "),
    (r"!\[[^\]]*\]\([^)]*\)", 0, "\n\n"),
    (r"\[([^\]]*)\]\([^)]*\)", 0, r"\1"),
    (r"https?://\S+", 0, "LINK"),
)]


def paragraphs(text):
    for pattern, use in MASKS:
        text = pattern.sub(use, text)
    for part in re.split(r"\n\s*\n|\n(?=\s*(?:[-*]|\d+\.) )", text):
        part = part.strip()
        if part and not part.startswith(("#", "|", "(", ":::")):
            yield re.sub(r"^(?:[-*]|\d+\.|:) +|[*_]{1,2}(?=\w)|(?<=\w)[*_]{1,2}", "",
                         " ".join(part.split()))


def sentences(text):
    for part in paragraphs(text):
        for sentence in re.split(r"(?<=[.!?:])\s+(?=[A-Z(\"])", part):
            words = re.findall(r"[\w'/.-]*\w[\w'/.-]*", sentence)
            if len(words) > 1:
                yield sentence, len(words)


def findings(text):
    for sentence, _ in sentences(text):
        for pattern, use in WORDS:
            found = pattern.search(sentence)
            if found:
                yield f"{found.group()!r}, write: {use}", sentence
        if OPENING.match(sentence):
            yield "a clause in place of a noun", sentence


def diary(text):
    """Lines with a date, a commit, a machine or an attempt."""
    for line in text.split("\n"):
        found = DIARY.search(line)
        if found:
            yield f"{found.group()!r} belongs to doc/develop", line


def pages():
    yield ROOT / "CONTRIBUTING.md"
    for page in sorted((ROOT / "doc").rglob("*.md")):
        name = page.relative_to(ROOT / "doc")
        if name.parts[0] not in ("develop", "examples", "pictures") and \
                str(name)[:-3] not in GENERATED:
            yield page


def notes():
    yield from sorted((ROOT / "doc/develop").glob("*.md"))


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--table", action="store_true",
                           help="print the statistics of each page")
    table = arguments.parse_args().table
    bad, total, guide = 0, 0, 0
    for page in pages():
        text, name = page.read_text(encoding="utf-8"), page.relative_to(ROOT)
        lengths = [n for _, n in sentences(text)]
        if page.stem not in REFERENCE:
            guide += len(re.findall(r"\b[^\W\d_][\w'/.-]*", NOT_TEXT.sub("", text)))
        if not lengths:
            continue
        mean = sum(lengths) / len(lengths)
        share = sum(n > LONG for n in lengths) / len(lengths)
        total += sum(lengths)
        if table:
            print(f"{str(name):40} {len(lengths):5} sentences, mean {mean:4.1f},"
                  f" {100 * share:4.1f} % above {LONG}, {sum(lengths)} words")
        if mean > MEAN or share > SHARE:
            print(f"{name}: mean {mean:.1f} words, {100 * share:.0f} % above {LONG}")
            bad += 1
        for what, sentence in [*findings(text), *diary(text)]:
            print(f"{name}: {what}: {sentence[:150]}")
            bad += 1
    for page in notes():
        for what, sentence in findings(page.read_text(encoding="utf-8")):
            print(f"{page.relative_to(ROOT)}: {what}: {sentence[:150]}")
            bad += 1
    for name in sorted(GENERATED):
        for what, line in diary((ROOT / f"doc/{name}.md").read_text(encoding="utf-8")):
            print(f"doc/{name}.md: {what}: {line[:150]}")
            bad += 1
    print(f"{total} words of prose; the guide has {guide}, with tables, without code and"
          f" numbers, and may have {GUIDE}")
    if guide > GUIDE:
        print("Shorten pages, or refer to the page that has a fact already.")
        bad += 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
