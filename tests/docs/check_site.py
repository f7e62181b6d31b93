#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Checks the built site without a network: links and pictures within it exist, with
their anchors, and nothing is loaded from elsewhere; but pages of headers, which are
Doxygen's. Where a browser is installed
(chromium), it opens each page with formulas: all are set, none with an error.

    tests/docs/check_site.py build/release/site"""
import html.parser
import pathlib
import shutil
import subprocess
import sys
import urllib.parse


class Page(html.parser.HTMLParser):
    """Anchors, links and loaded files of a page."""

    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loaded, self.formulas = set(), [], [], 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        of = dict(attributes)
        self.anchors.add(of.get("id"))
        self.formulas += "math" in (of.get("class") or "").split()
        if tag == "a" and of.get("href"):
            self.links.append(of["href"])
        elif tag == "link" and of.get("rel") != "canonical":
            self.loaded.append(of.get("href"))
        elif of.get("src"):
            self.loaded.append(of["src"])


def faults_of_links(pages, folder):
    for path, page in pages.items():
        for link in page.links + page.loaded:
            parts = urllib.parse.urlsplit(link)
            if parts.scheme or parts.netloc:
                if link in page.loaded and parts.scheme != "data":
                    yield f"{path}: loads {link}"
                continue
            target = (path.parent / urllib.parse.unquote(parts.path)).resolve() \
                if parts.path else path
            if not target.exists():
                yield f"{path}: no file for {link}"
            elif parts.fragment and target in pages and \
                    urllib.parse.unquote(parts.fragment) not in pages[target].anchors:
                yield f"{path}: no anchor for {link}"


def faults_of_formulas(pages, browser):
    for path, page in pages.items():
        if page.formulas == 0:
            continue
        shown = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-gpu",
             "--virtual-time-budget=5000", "--dump-dom", path.as_uri()],
            check=True, text=True, timeout=120, stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL).stdout
        found = shown.count('class="katex"')
        if found < page.formulas or "katex-error" in shown:
            yield f"{path}: {found} of {page.formulas} formulas are set"


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    folder = pathlib.Path(sys.argv[1]).resolve()
    pages = {path: Page(path.read_text(encoding="utf-8"))
             for path in sorted(folder.rglob("*.html"))
             if path.relative_to(folder).parts[0] not in ("_static", "headers")}
    faults = list(faults_of_links(pages, folder))
    browser = shutil.which("chromium")
    if browser:
        faults += faults_of_formulas(pages, browser)
    print(*faults, sep="\n", end="\n" if faults else "")
    print(f"{len(pages)} pages, {sum(len(page.links) for page in pages.values())}"
          f" links, {sum(page.formulas for page in pages.values())} formulas"
          + ("" if browser else " (not looked at: no browser)"))
    return 1 if faults or len(pages) < 20 else 0


if __name__ == "__main__":
    sys.exit(main())
