# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Makes the wheel: the package and the shared libraries, which are taken from a build of the project."""

import os
import re
import subprocess
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py
from wheel.bdist_wheel import bdist_wheel

root = Path(__file__).resolve().parents[2]
build = Path(os.environ.get("BCH_BUILD", root / "build" / "release"))
abi = re.search(r"define BCH_ABI_VERSION (\d+)", (root / "kernel/c_api/include/bch/bch.h").read_text())[1]
version = ".".join(re.findall(r"define BCH_VERSION_\w+ (\d+)", (root / "layout/include/bch/version.hpp").read_text()))


class WithLibraries(build_py):
    """Builds the shared libraries, and puts them beside the modules without what only debuggers read, and what describes them."""

    def run(self):
        super().run()
        if not (build / "CMakeCache.txt").exists():
            raise SystemExit(f"no build in {build}: run `cmake --workflow --preset build` first, or set BCH_BUILD")
        subprocess.run(["cmake", "--build", build, "--target", "bch_c", "bch_c_files"], check=True)
        for library in (f"libbch.so.{abi}", f"libbch_files.so.{abi}"):
            to = Path(self.build_lib) / "bch" / library
            subprocess.run(["strip", "--strip-unneeded", "-o", to, build / library], check=True)
        self.copy_file(str(root / "kernel/c_api/abi.txt"), str(Path(self.build_lib) / "bch" / "abi.txt"))


class OfPlatform(bdist_wheel):
    """A wheel for every Python 3 of a platform: the libraries do not depend on Python."""

    def finalize_options(self):
        super().finalize_options()
        self.root_is_pure = False

    def get_tag(self):
        return ("py3", "none", super().get_tag()[2])


work = build / "python"
work.mkdir(parents=True, exist_ok=True)
setup(
    version=version,
    cmdclass={"build_py": WithLibraries, "bdist_wheel": OfPlatform},
    options={"build": {"build_base": str(work)}, "egg_info": {"egg_base": str(work)}},
)
