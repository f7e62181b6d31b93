# SPDX-License-Identifier: LGPL-2.1-or-later
"""What the tests of an installed tree share."""
import os
import pathlib
import subprocess

C_FLAGS = ["-std=c11", "-Wall", "-Wextra", "-Wpedantic", "-Wshadow",
           "-Wconversion", "-Wmissing-prototypes", "-Werror"]


class Failure(Exception):
    """A test that failed."""


def require(condition, message):
    if not condition:
        raise Failure(message)


def passed(checks):
    """Exit code of a test: 1 and a line if the checks, a function, fail."""
    try:
        checks()
    except Failure as failure:
        print(f"FAILED: {failure}")
        return 1
    return 0


def run(*command, code=0, **options):
    """Run a command; fail unless it ends with the code."""
    words = [str(word) for word in command]
    result = subprocess.run(words, capture_output=True, text=True, check=False,
                            **options)
    require(code is None or result.returncode == code,
            f"{' '.join(words)}: exit code {result.returncode}\n"
            f"{result.stdout}{result.stderr}")
    return result


class Tree:
    """An installed tree, used as a user would: nothing points to the build."""

    def __init__(self, prefix, library_folder):
        self.prefix = pathlib.Path(prefix)
        self.libraries = self.prefix / library_folder
        self.environment = {key: value for key, value in os.environ.items()
                            if key != "LD_LIBRARY_PATH"}
        self.environment["PKG_CONFIG_PATH"] = str(self.libraries / "pkgconfig")

    @property
    def abut(self):
        return self.prefix / "bin" / "abut"

    def run(self, *command, **options):
        return run(*command, env=self.environment, **options)

    def pkg_config(self, *words):
        return self.run("pkg-config", *words).stdout.split()

    def compile_c(self, source, program, *flags):
        self.run("cc", *C_FLAGS, *self.pkg_config("--cflags", "abut_core"),
                 source, "-o", program, *flags)
