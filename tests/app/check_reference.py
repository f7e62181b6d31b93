# SPDX-License-Identifier: LGPL-2.1-or-later
"""doc/parameters.md is what `abut parameters` prints."""
from program import Program

p = Program()
printed = p.call("parameters").stdout
p.expect("### Method" in printed, "abut parameters prints nothing")
committed = (p.source / "doc/parameters.md").read_text()
p.expect(printed == committed,
         "doc/parameters.md is not current: run\n"
         "  build/release/abut parameters > doc/parameters.md")
p.finish()
