# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Makes the wheel (PEP 517): builds the shared libraries and the program with CMake, and packs them with the modules.

They have their own threads and the C++ library in themselves, so that they need glibc alone. The second library, which reads the files of
others, is built where its packages are there, and needs them; the program has SQLite in itself and reads no files of characters.
BCH_BUILD names a build folder whose libraries and program are taken as they are.
"""

import base64
import hashlib
import os
import platform
import re
import subprocess
import zipfile
from pathlib import Path

here = Path(__file__).resolve().parent
root = here.parents[1]
abi = re.search(r"define BCH_ABI_VERSION (\d+)", (root / "kernel/c_api/include/bch/bch.h").read_text())[1]
version = ".".join(re.findall(r"define BCH_VERSION_\w+ (\d+)", (root / "layout/include/bch/version.hpp").read_text()))
# What pkg-config calls the packages of the second library and of the program.
of_files = ("assimp", "draco", "zlib", "sqlite3", "nlohmann_json")
of_program = ("CLI11", "fmt", "nlohmann_json")

METADATA = f"""\
Metadata-Version: 2.1
Name: bch
Version: {version}
Summary: Collision checks between characters in dense crowds
License: MIT
Classifier: License :: OSI Approved :: MIT License
Classifier: Operating System :: POSIX :: Linux
Classifier: Programming Language :: Python :: 3
Classifier: Typing :: Typed
Requires-Python: >=3.9
Requires-Dist: numpy>=1.21
Description-Content-Type: text/markdown

{(here / "README.md").read_text()}"""


def pkg_config(*arguments):
    """Return what pkg-config prints, or None where it does not find a package."""
    try:
        found = subprocess.run(["pkg-config", *arguments], stdout=subprocess.PIPE, text=True)
    except FileNotFoundError:
        return None
    return None if found.returncode else found.stdout.strip()


def configure(build, settings):
    """Configure the build folder."""
    subprocess.run(["cmake", "-S", root, "-B", build, *(f"-D{name}={value}" for name, value in settings.items())], check=True)


def make(build, targets):
    """Build targets, whose files are given, and return the paths of these."""
    subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target", *targets], check=True)
    return [build / name for name in targets.values()]


def build_all():
    """Build, and return the paths of the shared libraries and of programs."""
    libraries = {"bch_c": f"libbch.so.{abi}"}
    files = {"bch_c_files": f"libbch_files.so.{abi}"}
    program = {"bch": "bch"}
    if "BCH_BUILD" in os.environ:
        build = Path(os.environ["BCH_BUILD"])
        cache = build / "CMakeCache.txt"
        if not cache.exists():
            raise SystemExit(f"BCH_BUILD is {build}: expected a folder in which the project was built, found no CMakeCache.txt")
        has_program = "BCH_BUILD_APPS:BOOL=ON" in cache.read_text()
        return make(build, {**libraries, **files}), make(build, program) if has_program else []
    build = root / "build" / "wheel"
    has_files = pkg_config("--exists", *of_files) is not None
    has_program = pkg_config("--exists", *of_program) is not None
    settings = {
        "CMAKE_BUILD_TYPE": "Release",
        "CMAKE_UNITY_BUILD": "ON",
        "CMAKE_SHARED_LINKER_FLAGS": "-static-libstdc++ -static-libgcc",
        "CMAKE_EXE_LINKER_FLAGS": "-static-libstdc++ -static-libgcc",
        "BCH_TASKS": "threads",
        "BCH_FMT": "fmt::fmt-header-only",
        "BCH_COMPONENTS": "baked;characters;c" + (";import;recordings" if has_files or has_program else ""),
        "BCH_BUILD_APPS": "ON" if has_program else "OFF",
        "BCH_BUILD_TESTS": "OFF",
        "BCH_INSTALL": "OFF",
    }
    sqlite = Path(pkg_config("--variable=libdir", "sqlite3") or ".") / "libsqlite3.a"
    programs = []
    if has_program:
        alone = {"BCH_READERS": "sqlite3", "pkgcfg_lib_sqlite3_sqlite3": sqlite} if sqlite.exists() else {"BCH_READERS": ""}
        configure(build, {**settings, **alone})
        programs = make(build, program)
    if has_files:
        libraries.update(files)
    readers = {"BCH_READERS": "import;sqlite3;hdf5" if has_files else "", "pkgcfg_lib_sqlite3_sqlite3": sqlite.with_suffix(".so")}
    configure(build, {**settings, **readers})
    return make(build, libraries), programs


def stripped(binary):
    """Return the bytes of a library or program without what only debuggers read."""
    to = binary.with_suffix(binary.suffix + ".stripped")
    subprocess.run(["strip", "--strip-unneeded", "-o", to, binary], check=True)
    data = to.read_bytes()
    to.unlink()
    return data


def tag_of(binaries):
    """Return the tag of a wheel for every Python 3: what it has does not depend on Python, but on glibc as new as their newest symbol."""
    minor = max(int(found) for data in binaries for found in re.findall(rb"(?<=\0)GLIBC_2\.(\d+)(?=[\0.])", data))
    return f"py3-none-manylinux_2_{minor}_{platform.machine()}"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Write the wheel into a folder, and return its name."""
    libraries, programs = build_all()
    binaries = {f"bch/{path.name}": stripped(path) for path in libraries}
    binaries.update({f"bch-{version}.data/scripts/{path.name}": stripped(path) for path in programs})  # which pip puts where commands are
    tag = tag_of(binaries.values())
    info = f"bch-{version}.dist-info"
    files = {f"bch/{path.name}": path.read_bytes() for path in sorted((here / "bch").glob("*.py"))}
    files["bch/py.typed"] = b""
    files["bch/abi.txt"] = (root / "kernel/c_api/abi.txt").read_bytes()
    files.update(binaries)
    files[f"{info}/LICENSE"] = (root / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = METADATA.encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: bch\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = ""
    name = f"bch-{version}-{tag}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            member = zipfile.ZipInfo(path)
            member.external_attr = (0o100755 if "/scripts/" in path else 0o100644) << 16
            wheel.writestr(member, data, zipfile.ZIP_DEFLATED)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(data)}\n"
        wheel.writestr(zipfile.ZipInfo(f"{info}/RECORD"), record + f"{info}/RECORD,,\n", zipfile.ZIP_DEFLATED)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Refuse: the package is built from the whole source tree."""
    raise SystemExit("bch: the Python package has no source archive of its own: install it from the project's source tree")
