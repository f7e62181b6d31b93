# SPDX-License-Identifier: LGPL-2.1-or-later
"""No two types of one namespace have one name: the linker takes the functions
of one of them for both, such as destructors that nobody wrote, and no compiler
sees it.

    check_names.py --source .
"""
import argparse
import collections
import pathlib
import re
import sys

NAMESPACE = re.compile(r"\s*(?:inline )?namespace\s*([\w:]*)\s*$")
TYPE = re.compile(r"\s*(?:class|struct|union)\s+(\w+)\s*(?:final\s*)?(?::(?!:)[^;]*)?$")
NOT_CODE = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])*\'|//.*')


def types(text, file):
    """Names of the types that a file defines, with their namespaces; of unnamed
    ones with the file."""
    depth, namespaces = 0, []  # the latter with the depth that they are at
    for line in text.split("\n"):
        line = NOT_CODE.sub("", line)
        if found := NAMESPACE.match(line):
            namespaces.append((depth, found[1] or file))
        found = TYPE.match(line)
        if found and namespaces and depth == len(namespaces):
            yield "::".join([name for _, name in namespaces] + [found[1]])
        depth += line.count("{") - line.count("}")
        while namespaces and depth < namespaces[-1][0] + 1 and "}" in line:
            namespaces.pop()


def twice(texts):
    """Names of types that are defined in several files, with these."""
    files = collections.defaultdict(set)
    for file, text in texts.items():
        for name in types(text, file):
            files[name].add(file)
    return {name: of for name, of in files.items() if len(of) > 1}


def try_itself():
    """Finds what it looks for, and nothing else."""
    one = "namespace a\n{\n  struct B\n  {\n    struct C\n    {\n    };\n  };\n} // namespace a\n"
    other = "namespace a\n{\n  class B : public D\n  {\n  };\n}\n"
    unnamed = "namespace a\n{\n  namespace\n  {\n    class B\n    {\n    };\n  }\n}\n"
    declared = "namespace a\n{\n  class B;\n  struct C\n  {\n  };\n}\n"
    elsewhere = other.replace("namespace a", "namespace e")
    return (twice({"1": one, "2": other}) == {"a::B": {"1", "2"}} and
            not twice({"1": one, "2": unnamed, "3": declared, "4": unnamed,
                       "5": elsewhere}))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--source", type=pathlib.Path, default=".")
    source = parser.parse_args().source
    texts = {str(path.relative_to(source)): path.read_text(encoding="utf-8")
             for folder in ("include", "plugin")
             for path in (source / folder).rglob("*")
             if path.suffix in (".h", ".cc")}
    found = twice(texts)
    for name, files in sorted(found.items()):
        print(f"{name} is defined in {' and '.join(sorted(files))}")
    names = {name for file, text in texts.items() for name in types(text, file)}
    if not try_itself() or len(names) < 100:
        print("the check does not find what it looks for")
        return 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
