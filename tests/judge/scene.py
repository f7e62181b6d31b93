# SPDX-License-Identifier: LGPL-2.1-or-later
"""A scene file as the judge reads it: values by section and name."""
import functools
import pathlib
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]


@functools.cache
def old_names():
    """Patterns of names and `name = word` that have changed, with the new
    ones, as the reference lists them."""
    text = (ROOT / "doc/parameters.md").read_text(encoding="utf-8")
    table = text.split("\n## Old names\n")[1].split("\n## ")[0]
    return [(re.compile(re.escape(old).replace(r"\*", r"(\d+)")), new)
            for old, new in re.findall(r"\| `(.*?)` \| `(.*?)` \|", table)]


def renamed(text):
    """A name, or `name = word`, as it is today."""
    for old, new in old_names():
        found = old.fullmatch(text)
        if found:
            return new.replace("*", found[1]) if found.groups() else new
    return text


class Scene:
    """Values of a .prm file, by `Section/Name`."""

    def __init__(self, path, overrides=()):
        self.path = path
        self.values = {}
        self._read(path.read_text(encoding="utf-8"))
        for text in overrides:
            name, _, value = text.partition("=")
            self._set(self._key(name), value.strip())

    @staticmethod
    def _key(name):
        return "/".join(part.strip() for part in name.split("/"))

    def _read(self, text):
        sections = []
        text = "\n".join(line.split("#")[0] for line in text.split("\n"))
        for line in re.sub(r"\\\s*\n", " ", text).split("\n"):
            words = line.split(None, 1)
            if not words:
                continue
            if words[0] == "subsection":
                sections.append(words[1].strip())
            elif words[0] == "end":
                sections.pop()
            elif words[0] == "set":
                name, _, value = words[1].partition("=")
                self._set("/".join([*sections, name.strip()]), value.strip())

    def _set(self, name, value):
        name = renamed(name)
        self.values[name] = renamed(f"{name} = {value}").removeprefix(
            f"{name} = ")

    def get(self, name, default=""):
        return self.values.get(name, default)

    def number(self, name, default):
        """A number; words such as `none` and `auto` are 0."""
        value = self.get(name, str(default))
        return 0. if re.fullmatch("auto|none|never|infinite", value) else float(
            value)

    def flag(self, name, default=False):
        return self.get(name, "true" if default else "false").lower() in (
            "true", "yes", "on")

    def text(self):
        """The scene as a file that abut reads."""
        lines = []
        for name, value in self.values.items():
            *sections, last = name.split("/")
            lines += [f"subsection {section}" for section in sections]
            lines.append(f"set {last} = {value}")
            lines += ["end"] * len(sections)
        return "\n".join(lines) + "\n"
