# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pieces of HTML for the page of a run. Each number is a <data> element that
says where it is from, each sentence of a run a <span> that does: a test compares
them with the files.

    data-of   file#/path in a JSON file (RFC 6901), file:column:row of a table,
              file: for the size of a file in bytes
    data-is   what was made of it: "value"; "share", the first by the second;
              "error", the relative difference of the first from the second;
              "difference", without a reference that could divide
"""
import html
import math

from . import labels

STYLE = """
:root { --ink: #1b1f24; --soft: #5b6470; --line: #d5d9de; --pale: #f5f6f8;
  --good: #00734f; --warn: #8a5a00; --bad: #b23a00; --cool: #0072b2; }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 68rem; padding: 0 1.25rem 3rem; color: var(--ink);
  font: 15px/1.5 system-ui, "Segoe UI", "DejaVu Sans", sans-serif; background: #fff; }
h1 { font-size: 1.45rem; margin: 0; line-height: 1.3; }
h2 { font-size: 1.15rem; margin: 2.4rem 0 .6rem; padding-bottom: .25rem;
  border-bottom: 2px solid var(--line); }
h3 { font-size: 1rem; margin: 1.4rem 0 .4rem; }
p { margin: .4rem 0 .7rem; max-width: 46rem; }
code, pre { font: .87em/1.45 ui-monospace, "DejaVu Sans Mono", monospace; }
code { overflow-wrap: break-word; } p code, td code { overflow-wrap: anywhere; }
pre { background: var(--pale); border: 1px solid var(--line); border-radius: 4px;
  padding: .6rem .8rem; overflow-x: auto; white-space: pre-wrap; overflow-wrap: anywhere; }
.banner { margin: 1.25rem 0 0; padding: 1rem 1.2rem; border: 1px solid var(--line);
  border-left: .5rem solid var(--tone); border-radius: 4px; background: var(--pale); }
.banner .verdict { color: var(--tone); font-weight: 700; font-size: 1.5rem;
  letter-spacing: .02em; line-height: 1.3; }
.banner .reason { margin: .1rem 0 .5rem; max-width: none; }
.good { --tone: var(--good); } .warn { --tone: var(--warn); } .bad { --tone: var(--bad); }
.cool { --tone: var(--cool); }
.facts { display: flex; flex-wrap: wrap; gap: .5rem 2rem; margin: .8rem 0 .2rem; padding: 0; }
.facts div { min-width: 5rem; }
.facts dt { color: var(--soft); font-size: .8rem; } .facts dd { margin: 0; font-weight: 600; }
.message { margin: .5rem 0; padding: .5rem .8rem; border-left: .25rem solid var(--tone);
  background: var(--pale); max-width: none; overflow-wrap: anywhere; }
.message .cure { color: var(--soft); font-size: .9em; }
nav { margin: .8rem 0 0; font-size: .9rem; } nav a { margin-right: 1rem; white-space: nowrap; }
a { color: var(--cool); }
.scroll { overflow-x: auto; margin: .5rem 0 1rem; }
table { border-collapse: collapse; font-size: .9rem; }
caption { text-align: left; color: var(--soft); font-size: .9em; padding-bottom: .3rem; }
th, td { text-align: left; vertical-align: top; padding: .28rem .9rem .28rem 0;
  border-bottom: 1px solid var(--line); }
th { font-weight: 600; } thead th { border-bottom: 1.5px solid var(--soft); vertical-align: bottom; }
tbody th { font-weight: 400; }
td.n, th.n { text-align: right; font-variant-numeric: tabular-nums; white-space: nowrap; }
.unit { color: var(--soft); font-weight: 400; font-size: .9em; }
.soft { color: var(--soft); }
.ok::before, .near::before, .over::before { content: ""; display: inline-block; width: .7em;
  height: .7em; margin-right: .4em; border-radius: 50%; background: var(--tone); }
.ok { --tone: var(--good); } .near { --tone: #e69f00; } .over { --tone: var(--bad); }
.near::before { border-radius: 0; } .over::before { border-radius: 0; transform: rotate(45deg); }
figure { margin: .8rem 0 1.2rem; } figure svg, figure img { max-width: 100%; height: auto; }
figcaption { color: var(--soft); font-size: .9rem; max-width: 46rem; }
.side { display: flex; flex-wrap: wrap; gap: 0 2.5rem; align-items: flex-start; }
.side > figure { flex: 0 1 28rem; } .side > div { flex: 1 1 22rem; min-width: 0; }
.bar { display: inline-block; height: .75em; background: var(--cool); vertical-align: baseline;
  min-width: 1px; }
.bars { width: 14rem; } details { margin: .6rem 0; } summary { cursor: pointer; color: var(--cool); }
@media (max-width: 40rem) {
  body { padding: 0 .8rem 2rem; font-size: 14px; } .banner { padding: .8rem .9rem; }
  .banner .verdict { font-size: 1.25rem; } .facts { gap: .4rem 1.3rem; } .bars { width: 5rem; }
  th, td { padding-right: .6rem; } }
@media print {
  @page { size: A4; margin: 15mm 14mm; }
  body { max-width: none; padding: 0; font-size: 9.5pt; } nav, details:not([open]), .folded { display: none; }
  figure, tr, .message, .banner { break-inside: avoid; } h2, h3 { break-after: avoid; }
  .banner, .message, .bar, .ok::before, .near::before, .over::before {
    print-color-adjust: exact; -webkit-print-color-adjust: exact; }
  .scroll { overflow: visible; } table { font-size: 8.5pt; } a { color: inherit; text-decoration: none; } }
"""


def escape(text):
    return html.escape(str(text), quote=True)


def short(value, digits=6):
    """A number without digits that nobody reads: 9.39369, 1.5e-17."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, int):
        return str(value)
    if not math.isfinite(value):
        return "not finite"
    text = f"{value:.{digits}g}"
    if "e" not in text:
        return text
    mantissa, power = text.split("e")
    return f"{mantissa}e{int(power)}"


def pointer(*keys):
    """The path of a member of a JSON file."""
    return "".join("/" + str(key).replace("~", "~0").replace("/", "~1")
                   for key in keys)


def number(value, of, is_="value", digits=6, unit=""):
    """A number of the files `of`, a text or several."""
    if value is None:
        return '<span class="soft">–</span>'
    sources = of if isinstance(of, str) else " | ".join(of)
    text = (f'<data value="{escape(repr(value))}" data-is="{is_}" '
            f'data-of="{escape(sources)}">{escape(short(value, digits))}</data>')
    return f"{text}&nbsp;{escape(unit)}" if unit else text


def values(value, of, **more):
    """A number or the numbers of a vector."""
    if isinstance(value, list):
        return ", ".join(number(each, f"{of}/{i}", **more)
                         for i, each in enumerate(value))
    return number(value, of, **more)


def quoted(text, of, tag="span"):
    """A text of the run."""
    return f'<{tag} data-text="{escape(of)}">{escape(text)}</{tag}>'


def table(head, rows, caption="", numeric=()):
    """A table of cells that are HTML; columns `numeric` stand at the right. The
    first column names the row."""
    def cell(tag, content, column, more=""):
        kind = ' class="n"' if column in numeric else ""
        return f"<{tag}{kind}{more}>{content}</{tag}>"
    lines = ['<div class="scroll"><table>']
    if caption:
        lines.append(f"<caption>{caption}</caption>")
    if head:
        lines.append("<thead><tr>" + "".join(
            cell("th", content, i, ' scope="col"')
            for i, content in enumerate(head)) + "</tr></thead>")
    lines.append("<tbody>")
    for row in rows:
        lines.append("<tr>" + "".join(
            cell("th" if i == 0 else "td", content, i,
                 ' scope="row"' if i == 0 else "")
            for i, content in enumerate(row)) + "</tr>")
    lines.append("</tbody></table></div>")
    return "\n".join(lines)


def labelled(key, table=None):
    """Words and dimension of a key, of pairs without pair_N_ in labels.PAIR."""
    text, _, dimension = table[key] if table and key in table \
        else labels.entry(key)
    return escape(text) + (f' <span class="unit">[{escape(dimension)}]</span>'
                           if dimension else "")


def details(summary, content):
    return f"<details><summary>{summary}</summary>\n{content}\n</details>"


def figure(picture, caption, label):
    """A picture, SVG or <img>, with its text for those who do not see it."""
    return (f'<figure role="group" aria-label="{escape(label)}">{picture}'
            f"<figcaption>{caption}</figcaption></figure>")


def page(title, parts):
    """The page; `parts` are pairs of a heading (or "") and HTML."""
    listed = [(f"part-{i}", heading) for i, (heading, _) in enumerate(parts)
              if heading]
    links = " ".join(f'<a href="#{name}">{escape(heading)}</a>'
                     for name, heading in listed)
    body = []
    for i, (heading, content) in enumerate(parts):
        if heading:
            folded = content.startswith("<details")
            body.append(f'<section id="part-{i}"{" class=folded" * folded}><h2>{escape(heading)}</h2>'
                        f"\n{content}\n</section>")
        else:
            body.append(f"{content}\n<nav>{links}</nav>")
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n"
            "<body>\n" + "\n".join(body) + "\n</body>\n</html>\n")
