#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""run_page.py finds what is wrong with a page: the blocks below a line WRONG, and
no others."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

RUN_PAGE = pathlib.Path(__file__).with_name("run_page.py")
PAGE = """
```prm {check mass.prm}
set Scene = point mass
subsection Constraints
  set B           = -1
  set Initial gap = 1
end
```

```sh {run}
abut run mass.prm --quiet
echo u 1.0000001 end
echo after 0.02 s mesh 1
echo penetration 5.4e-11 or 4.3e-9
echo gap nan
```

```text {output}
u 1 end
after 3.10 s  mesh 1
penetration 0 or 4.3e-9
gap nan
```

WRONG
```text {output}
gap 1
```

WRONG
```text {output}
penetration 0 or 4.2e-9
```

WRONG
```text {output}
after 0.02 s  mesh 2
```

WRONG
```text {output}
v 1 end
```

WRONG
```text {output}
u 1.001 end
```

<!-- expect output/mass/summary.json active 0 0 -->
WRONG
<!-- expect output/mass/summary.json active 1 0 -->
WRONG
<!-- expect output/mess/summary.json active 1 0 -->

```sh {run 2}
abut check no-such-file.prm
```

WRONG
```sh {run}
false
```

WRONG
```sh {run 2}
true
```

WRONG
```prm {check}
set Scene = no such
```

```c {compile}
#include <abut/abut.h>
int n = ABUT_STATE_OPEN;
```

WRONG
```c {compile}
int n = ABUT_STATE_OPEN;
```

```text {show}
anything
```
"""
NO_INTENT = ("```sh\ntrue\n```\n", "```sh {ran}\ntrue\n```\n")


def result(text, abut):
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.md"
        page.write_text(text, encoding="utf-8")
        return subprocess.run([sys.executable, RUN_PAGE, page, "--abut", abut],
                              text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)


def main():
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--abut", required=True)
    abut = arguments.parse_args().abut
    done = result(PAGE, abut)
    found = {int(line) for line in
             re.findall(r"^page\.md:(\d+): \w+ [\d.]+ s: ", done.stdout, re.M)}
    lines = PAGE.split("\n")
    wanted = {n + 2 for n, line in enumerate(lines) if line == "WRONG"}
    print(done.stdout)
    print("found", sorted(found), "wanted", sorted(wanted))
    right = found == wanted and done.returncode == 1
    for text in NO_INTENT:
        right = right and result(text, abut).returncode == 1
    return 0 if right and len(wanted) == 11 else 1


if __name__ == "__main__":
    sys.exit(main())
