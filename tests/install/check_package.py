#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Make the Debian package and look into it: files, links, and dependencies,
which must name the packages of all shared libraries that are needed."""
import argparse
import pathlib
import shutil
import subprocess
import sys

from installed import Failure, passed, require, run


DEBUG_FILES = ("libabut.g.so", "libabut_plugin.g.so")


def debug_build(folder):
    """What a build in Debug mode is for the package: a folder with libraries
    and a script that installs them."""
    folder.mkdir()
    script = ""
    for name in DEBUG_FILES:
        (folder / name).write_text("a library in Debug mode\n")
        script += ('file(INSTALL DESTINATION "${CMAKE_INSTALL_PREFIX}/lib" '
                   f'TYPE FILE FILES "{folder / name}")\n')
    (folder / "cmake_install.cmake").write_text(script)
    return folder


def make(arguments, folder):
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    debug = debug_build(folder / "debug")
    run(arguments.cpack, "-G", "DEB", "-B", folder, "--config",
        pathlib.Path(arguments.build) / "CPackConfig.cmake",
        "-D", f"CPACK_ABUT_DEBUG_BUILD={debug}")
    packages = list(folder.glob("*.deb"))
    require(len(packages) == 1, f"packages: {packages}")
    return packages[0]


def check_fields(package):
    def field(name):
        return run("dpkg-deb", "--field", package, name).stdout.strip()

    require(field("Package") == "abut", field("Package"))
    require(field("Version") == "0.1.0", field("Version"))
    require(field("Architecture") == run(
        "dpkg", "--print-architecture").stdout.strip(), "architecture")
    for word in ("libdeal.ii-dev", "mpi-default-bin", "python3-matplotlib"):
        require(word in field("Recommends"), field("Recommends"))
    depends = {word.split()[0] for word in field("Depends").split(",")}
    print("Depends:", field("Depends"))
    return depends


def owner(library):
    """Package of a shared library, as the machine has it."""
    for path in (library, "/usr" + library, str(pathlib.Path(library).resolve())):
        result = subprocess.run(["dpkg", "-S", path], capture_output=True,
                                text=True, check=False)
        if result.returncode == 0:
            return result.stdout.split(":")[0]
    raise Failure(f"no package has {library}")


def check_depends(depends, unpacked):
    """All that the linker wants for program and library is named."""
    for name in ("bin/abut", "lib/libabut.so.0.1.0"):
        binary = unpacked / "usr" / name
        needed = [line.split("[")[1].rstrip("]") for line in
                  run("readelf", "-d", binary).stdout.splitlines()
                  if "(NEEDED)" in line]
        paths = {line.split()[0]: line.split()[2]
                 for line in run("ldd", binary).stdout.splitlines()
                 if "=>" in line}
        for library in needed:
            package = owner(paths[library])
            require(package in depends, f"{library} is in {package}")
        require("RUNPATH" in run("readelf", "-d", binary).stdout, "no RUNPATH")
        text = run("readelf", "-d", binary).stdout
        require("build" not in text.split("RUNPATH")[1].split("\n")[0], text)


def check_content(unpacked):
    for name in ("bin/abut", "lib/libabut.so", "lib/libabut_plugin.so",
                 *("lib/" + library for library in DEBUG_FILES),
                 "lib/libabut_core.so.0.1", "lib/pkgconfig/abut_core.pc",
                 "lib/cmake/Abut/AbutConfig.cmake",
                 "include/abut/dealii/load_plugin.h",
                 "share/abut/prm/step-41.prm", "share/doc/abut/copyright",
                 "share/abut/tools/abut_tools/__main__.py"):
        require((unpacked / "usr" / name).exists(), f"{name} is missing")
    folders = {str(path.parent.relative_to(unpacked / "usr"))
               for path in unpacked.rglob("*") if not path.is_dir()}
    for folder in folders:
        require(folder in ("bin", "lib", "lib/cmake/Abut", "lib/pkgconfig")
                or folder.startswith(("include/abut", "share/abut/prm",
                                      "share/abut/tools", "share/doc/abut")),
                folder)
    output = run(unpacked / "usr/bin/abut", "--version").stdout
    require(output.startswith("abut 0.1.0"), output)


def check_paths(unpacked, build):
    """No file names a folder of the build, and all may read all of them."""
    folder = str(pathlib.Path(build).resolve())
    for path in unpacked.rglob("*"):
        if path.is_symlink():
            continue
        mode = path.stat().st_mode & 0o777
        expected = 0o755 if path.is_dir() or path.parent.name == "bin" else 0o644
        require(mode == expected, f"{path} has mode {mode:o}")
        require(path.is_dir() or folder.encode() not in path.read_bytes(),
                f"{path} names {folder}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("cpack", "build", "scratch"):
        parser.add_argument("--" + name, required=True)
    arguments = parser.parse_args()
    folder = pathlib.Path(arguments.scratch) / "package"

    def checks():
        package = make(arguments, folder)
        depends = check_fields(package)
        unpacked = folder / "unpacked"
        run("dpkg-deb", "--extract", package, unpacked)
        check_content(unpacked)
        check_paths(unpacked, arguments.build)
        check_depends(depends, unpacked)

    return passed(checks)


if __name__ == "__main__":
    sys.exit(main())
