# SPDX-License-Identifier: LGPL-2.1-or-later
"""The manual as a site: `cmake --build build/release --target site`. All it needs is
in Debian, and the pages need no network: formulas are set by KaTeX, which is copied
beside them."""
import os
import re

from docutils import nodes
from pygments import lexer, token

project = "Abut"
author = "The Abut authors"
copyright = author
version = release = os.environ.get("ABUT_VERSION", "")
html_title = f"Abut {version}".strip()

extensions = ["myst_parser", "sphinx.ext.mathjax", "sphinx_copybutton",
              "sphinx_inline_tabs", "sphinxcontrib.bibtex"]
source_suffix = {".md": "markdown"}
# Trees of contents are no reading matter in the repository; index.md is.
root_doc = "contents"
exclude_patterns = ["examples"]
nitpicky = True

myst_enable_extensions = ["colon_fence", "dollarmath", "amsmath", "html_image"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
# The notebook links to sources; pages of the site do not have them.
suppress_warnings = ["download.not_readable"]

bibtex_bibfiles = ["references.bib"]
bibtex_reference_style = "author_year"
bibtex_default_style = "plain"

katex = os.environ.get("ABUT_KATEX", "/usr/share/javascript/katex")
mathjax_path = "katex.min.js"
mathjax_options = {"defer": "defer"}
html_theme = "furo"
html_static_path = ["site", katex]
html_css_files = ["katex.min.css", "abut.css"]
html_js_files = [("contrib/auto-render.js", {"defer": "defer"}),
                 ("formulas.js", {"defer": "defer"})]
html_copy_source = False
html_show_sphinx = False
copybutton_prompt_text = "$ "


class Parameters(lexer.RegexLexer):
    """Parameter files of deal.II."""
    name = "prm"
    tokens = {"root": [
        (r"#.*$", token.Comment),
        (r"^(\s*)(subsection)( .*?)$",
         lexer.bygroups(token.Text, token.Keyword, token.Name.Namespace)),
        (r"^(\s*)(end)[ \t]*$", lexer.bygroups(token.Text, token.Keyword)),
        (r"^(\s*)(set)( [^=\n]*)(=)([^#\n]*)",
         lexer.bygroups(token.Text, token.Keyword, token.Name.Attribute,
                        token.Operator, token.String)),
        (r".|\n", token.Text)]}


def from_repository(app, docname, source):
    """Pages are written for readers of the repository, too: formulas are blocks of
    math, and links may leave the folder of documents, where they are names of files
    in the site."""
    text = re.sub(r"^```math\n(.*?)^```$", r"$$\n\1$$", source[0], flags=re.M | re.S)
    source[0] = re.sub(r"\[([^\]]+)\]\((?:\.\./)+(?:(?:include|plugin|tests|prm)/[^)]*|CONTRIBUTING\.md)\)",
                       r"`\1`", text)


def complete_lists(app, doctree, docname):
    """docutils 0.19 does not open the list of a citation that is the first child."""
    for citation in list(doctree.findall(nodes.citation)):
        if citation.parent.index(citation) == 0:
            citation.parent.insert(0, nodes.comment())


def setup(app):
    app.add_lexer("prm", Parameters)
    app.connect("doctree-resolved", complete_lists)
    app.connect("source-read", from_repository)
