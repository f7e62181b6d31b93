# SPDX-License-Identifier: LGPL-2.1-or-later
"""Matrices and vectors of complex values do not compile, and the compiler says
why.

    check_refused_types.py compile_commands.json FILE_LIKE_WHICH_TO_COMPILE
"""
import json
import pathlib
import shlex
import subprocess
import sys
import tempfile

SOURCE = """
#include <abut/dealii/host_matrix.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>
void use(const dealii::Vector<VALUE> &u, dealii::SparseMatrix<VALUE> &K)
{
  const abut::la::VectorView view(u);
  const abut::la::MatrixTarget target(K);
}
"""
WORDS = ["Abut takes matrices of double values",
         "Abut takes vectors of double values"]


def compile_with(value, command, folder):
    source = pathlib.Path(folder) / "types.cc"
    source.write_text(SOURCE.replace("VALUE", value))
    words = shlex.split(command["command"])
    compiler = words[:words.index("-o")] + ["-fsyntax-only", str(source)]
    return subprocess.run(compiler, cwd=command["directory"], check=False,
                          capture_output=True, text=True)


def main():
    commands, like = sys.argv[1:]
    command = next(c for c in json.loads(pathlib.Path(commands).read_text())
                   if c["file"].endswith(like))
    with tempfile.TemporaryDirectory(prefix="abut-types-") as folder:
        good = compile_with("double", command, folder)
        assert good.returncode == 0, good.stderr
        for value in ("std::complex<double>", "float"):
            bad = compile_with(value, command, folder)
            assert bad.returncode != 0, value
            for words in WORDS:
                assert words in bad.stderr, f"{value}: {bad.stderr}"


if __name__ == "__main__":
    main()
