# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reads the page of a run and compares all that it says with the files of the
run."""
import csv
import html.parser
import json
import math
import re

VOID = {"meta", "img", "br", "hr", "input", "link", "wbr"}
# Digits that are no results: names of things, codes, norms.
NAMES = re.compile(
    r"\b(?:pair|body|obstacle|point|Pair|Body|Obstacle)\s\d+\b|ABUT-F\d+|\bL2\b"
    r"|\bH1\b|where it is not 0\b|at time 0\b")


class Page(html.parser.HTMLParser):
    """Numbers, quoted texts and what else is written on a page."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.stack, self.faults, self.ids = [], [], set()
        self.numbers, self.quotes = [], []  # attributes and text
        self.codes, self.words, self.headings = [], [], []
        self.order = []  # classes and headings in their order
        self.n_pictures = 0
        self.feed(text)
        self.close()
        if self.stack:
            self.faults.append(f"open at the end: {self.stack}")

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        for name, value in attributes.items():
            if name in ("src", "href", "srcset", "action", "xlink:href") and \
                    not value.startswith(("#", "data:")):
                self.faults.append(f"{name} = {value}")
            if not (value or "").startswith("data:") and re.search(
                    r"https?:|//\w|@import", value or ""):
                self.faults.append(f"address in {name} = {value}")
        if tag in ("script", "link", "iframe", "object"):
            self.faults.append(f"<{tag}>")
        if "id" in attributes:
            if attributes["id"] in self.ids and "svg" not in self.stack_tags():
                self.faults.append(f"id {attributes['id']} twice")
            self.ids.add(attributes["id"])
        if tag == "svg" and "svg" not in self.stack_tags() or tag == "img":
            self.n_pictures += 1
        if tag not in VOID:
            self.stack.append((tag, attributes, []))
        self.order += [attributes.get("class", "")]

    def handle_startendtag(self, tag, attributes):
        self.handle_starttag(tag, attributes)
        if tag not in VOID:
            self.handle_endtag(tag)

    def stack_tags(self):
        return [tag for tag, _, _ in self.stack]

    def handle_endtag(self, tag):
        if tag in VOID:
            return
        if not self.stack or self.stack[-1][0] != tag:
            self.faults.append(f"</{tag}> within {self.stack_tags()}")
            return
        _, attributes, text = self.stack.pop()
        text = "".join(text)
        if "data-of" in attributes:
            self.numbers.append((attributes, text))
        elif "data-text" in attributes:
            self.quotes.append((attributes["data-text"], text))
        elif tag == "code":
            self.codes.append(text)
        elif tag == "style":
            if re.search(r"url\(|@import|https?:", text):
                self.faults.append("the style loads something")
        else:
            if tag == "h2":
                self.headings.append(text)
            if "svg" not in self.stack_tags() + [tag] and tag != "title":
                self.words.append(text)

    def handle_data(self, data):
        if self.stack:
            self.stack[-1][2].append(data)


class Files:
    """What the files of the run say."""

    def __init__(self, folder):
        self.folder = folder
        self.json, self.tables = {}, {}

    def look_up(self, of):
        """What stands at a place, see abut_tools/report_page.py."""
        name, mark, path = of.partition("#")
        if mark:
            if name not in self.json:
                self.json[name] = json.loads((self.folder / name).read_text())
            value = self.json[name]
            for key in path.split("/")[1:]:
                key = key.replace("~1", "/").replace("~0", "~")
                value = value[int(key) if isinstance(value, list) else key]
            return value
        name, mark, place = of.partition(":")
        if not mark:
            return (self.folder / name).read_text()
        if not place:
            return (self.folder / name).stat().st_size
        if name not in self.tables:
            with open(self.folder / name, newline="") as file:
                self.tables[name] = list(csv.DictReader(file))
        column, row = place.rsplit(":", 1)
        text = self.tables[name][int(row)][column]
        try:
            return float(text)
        except ValueError:
            return text

    def derived(self, attributes):
        sources = attributes["data-of"].split(" | ")
        kind = attributes["data-is"]
        if kind == "rows":
            with open(self.folder / sources[0]) as file:
                return sum(1 for _ in file) - 1
        found = [self.look_up(source) for source in sources]
        if kind in ("value", "size"):
            return found[0]
        if kind == "sum":
            return sum(found)
        a, b = found
        return {"share": lambda: a / b, "difference": lambda: a - b,
                "error": lambda: abs((a - b) / b)}[kind]()


def significant_digits(text):
    """How many a number was printed with."""
    return max(1, len(re.sub(r"e.*|[-.]", "", text).lstrip("0")))


def faults(text, folder, most_bytes=1_000_000):
    """What is wrong with a page about the run in a folder."""
    page, files = Page(text), Files(folder)
    found = list(page.faults)
    if len(text.encode()) > most_bytes:
        found.append(f"{len(text.encode())} bytes")
    for attributes, shown in page.numbers:
        where = f"{attributes['data-is']} of {attributes['data-of']}"
        try:
            right = files.derived(attributes)
        except (KeyError, IndexError, OSError, ValueError) as error:
            found.append(f"{where}: {error!r}")
            continue
        value = float(attributes["value"])
        if isinstance(right, str) or not math.isclose(value, right,
                                                      rel_tol=1e-14):
            found.append(f"{where}: {value} is not {right}")
        elif math.isfinite(value) and float(
                f"{value:.{significant_digits(shown)}g}") != float(shown):
            found.append(f"{where}: '{shown}' stands for {value}")
    parameters = files.look_up("parameters.json#/parameters") \
        if (folder / "parameters.json").exists() else {}
    for of, shown in page.quotes:
        if of == "files":
            if not (folder / shown).is_file() and shown != folder.name:
                found.append(f"no file {shown}")
        elif files.look_up(of) != shown:
            found.append(f"{of}: '{shown}'")
    for code in page.codes:
        if re.search(r"\d", code) and code not in parameters:
            found.append(f"no parameter {code}")
    columns = {name.replace("_", " ") for file in folder.glob("*.csv")
               for name in file.open().readline().strip().split(",")}
    for words in page.words:
        if words in columns:
            continue
        loose = re.search(r"\d", NAMES.sub("", words))
        if loose:
            found.append(f"a number without a source in '{words[:100]}'")
    return found, page
