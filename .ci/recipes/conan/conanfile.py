# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Makes the Conan package of the checkout that this file lies in: conan create .ci/recipes/conan (Conan 2)."""

import re
from pathlib import Path

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy


class Bch(ConanFile):
    name = "bch"
    description = "Collision checks between virtual characters in dense crowds"
    license = "MIT"
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {
        "shared": [True, False],
        "fPIC": [True, False],
        "tasks": ["tbb", "threads", "none"],
        "baked": [True, False],
        "characters": [True, False],
        "c": [True, False],
    }
    default_options = {"shared": False, "fPIC": True, "tasks": "threads", "baked": False, "characters": False, "c": False}

    @property
    def _root(self):
        return Path(self.recipe_folder).parents[2]

    def set_version(self):
        text = (self._root / "layout/include/bch/version.hpp").read_text()
        self.version = ".".join(re.findall(r"define BCH_VERSION_\w+ (\d+)", text))

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "kernel/*", "layout/*"):
            copy(self, pattern, str(self._root), self.export_sources_folder)

    def configure(self):
        if self.options.c:
            self.options.baked = self.options.characters = True

    def requirements(self):
        self.requires("xsimd/8.1.0")
        if self.options.tasks == "tbb":
            self.requires("onetbb/2021.10.0")
        if self.options.baked:
            self.requires("xxhash/0.8.2")
        if self.options.characters:
            self.requires("eigen/3.4.0")

    def validate(self):
        if str(self.settings.compiler) not in ("gcc", "clang"):
            raise ConanInvalidConfiguration(f"compiler: expected gcc or clang, found {self.settings.compiler}")

    def layout(self):
        cmake_layout(self)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["BCH_COMPONENTS"] = ";".join(name for name in ("baked", "characters", "c") if getattr(self.options, name))
        toolchain.cache_variables["BCH_TASKS"] = str(self.options.tasks)
        toolchain.cache_variables["BCH_BUILD_APPS"] = False
        toolchain.cache_variables["BCH_BUILD_TESTS"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        copy(self, "LICENSE", self.source_folder, str(Path(self.package_folder) / "licenses"))
        CMake(self).install()

    def package_info(self):
        self.cpp_info.set_property("cmake_find_mode", "none")  # its own files for CMake are found
        self.cpp_info.builddirs = ["lib/cmake/bch"]
