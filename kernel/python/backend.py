# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Makes the wheel (PEP 517): builds the shared libraries with CMake, and packs them with the modules.

The libraries have their own threads and the C++ library in themselves, so that they need glibc alone; what reads the files of others is
built where its packages are there, and needs them. BCH_BUILD names a build folder whose libraries are taken as they are.
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
of_files = {"import": ("assimp", "draco", "zlib"), "recordings": ("sqlite3",)}  # components, and what pkg-config calls their packages

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


def has_packages(names):
    """Whether pkg-config finds all of these."""
    try:
        return subprocess.run(["pkg-config", "--exists", *names]).returncode == 0
    except FileNotFoundError:
        return False


def build_libraries():
    """Build the shared libraries, and return their paths."""
    if "BCH_BUILD" in os.environ:
        build = Path(os.environ["BCH_BUILD"])
        if not (build / "CMakeCache.txt").exists():
            raise SystemExit(f"BCH_BUILD is {build}: expected a folder in which the project was built, found no CMakeCache.txt")
        has_files = True
    else:
        build = root / "build" / "wheel"
        has_files = all(map(has_packages, of_files.values()))
        components = ["baked", "characters", "c", *(of_files if has_files else ())]
        settings = {
            "CMAKE_BUILD_TYPE": "Release",
            "CMAKE_UNITY_BUILD": "ON",
            "CMAKE_SHARED_LINKER_FLAGS": "-static-libstdc++ -static-libgcc",
            "BCH_TASKS": "threads",
            "BCH_COMPONENTS": ";".join(components),
            "BCH_BUILD_APPS": "OFF",
            "BCH_BUILD_TESTS": "OFF",
            "BCH_INSTALL": "OFF",
        }
        subprocess.run(["cmake", "-S", root, "-B", build, *(f"-D{name}={value}" for name, value in settings.items())], check=True)
    targets = {"bch_c": f"libbch.so.{abi}", "bch_c_files": f"libbch_files.so.{abi}"}
    if not has_files:
        del targets["bch_c_files"]
    subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target", *targets], check=True)
    return [build / name for name in targets.values()]


def stripped(library):
    """Return a library's bytes without what only debuggers read."""
    to = library.with_suffix(library.suffix + ".stripped")
    subprocess.run(["strip", "--strip-unneeded", "-o", to, library], check=True)
    data = to.read_bytes()
    to.unlink()
    return data


def tag_of(libraries):
    """Return the tag of a wheel for every Python 3: the libraries do not depend on Python, but on glibc as new as their newest symbol."""
    minor = max(int(found) for data in libraries for found in re.findall(rb"(?<=\0)GLIBC_2\.(\d+)(?=[\0.])", data))
    return f"py3-none-manylinux_2_{minor}_{platform.machine()}"


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Write the wheel into a folder, and return its name."""
    libraries = {f"bch/{path.name}": stripped(path) for path in build_libraries()}
    tag = tag_of(libraries.values())
    info = f"bch-{version}.dist-info"
    files = {f"bch/{path.name}": path.read_bytes() for path in sorted((here / "bch").glob("*.py"))}
    files["bch/py.typed"] = b""
    files["bch/abi.txt"] = (root / "kernel/c_api/abi.txt").read_bytes()
    files.update(libraries)
    files[f"{info}/LICENSE"] = (root / "LICENSE").read_bytes()
    files[f"{info}/METADATA"] = METADATA.encode()
    files[f"{info}/WHEEL"] = f"Wheel-Version: 1.0\nGenerator: bch\nRoot-Is-Purelib: false\nTag: {tag}\n".encode()
    record = ""
    name = f"bch-{version}-{tag}.whl"
    with zipfile.ZipFile(Path(wheel_directory) / name, "w", zipfile.ZIP_DEFLATED) as wheel:
        for path, data in files.items():
            wheel.writestr(zipfile.ZipInfo(path), data, zipfile.ZIP_DEFLATED)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
            record += f"{path},sha256={digest},{len(data)}\n"
        wheel.writestr(zipfile.ZipInfo(f"{info}/RECORD"), record + f"{info}/RECORD,,\n", zipfile.ZIP_DEFLATED)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Refuse: the package is built from the whole source tree."""
    raise SystemExit("bch: the Python package has no source archive of its own: install it from the project's source tree")
