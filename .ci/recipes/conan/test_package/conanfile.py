# SPDX-License-Identifier: MIT
# Copyright (c) 2026 the bch authors

"""Builds and runs a program that uses the package: the project's example of it."""

from pathlib import Path

from conan import ConanFile
from conan.tools.build import can_run
from conan.tools.cmake import CMake, cmake_layout


class TestBch(ConanFile):
    settings = "os", "compiler", "build_type", "arch"
    generators = "CMakeDeps", "CMakeToolchain"

    def requirements(self):
        self.requires(self.tested_reference_str)

    def layout(self):
        cmake_layout(self)

    def build(self):
        cmake = CMake(self)
        cmake.configure(build_script_folder=str(Path(self.recipe_folder).parents[3] / "tests/examples/kernel_consumer"))
        cmake.build()

    def test(self):
        if can_run(self):
            self.run(str(Path(self.build_folder) / "footprints"), env="conanrun")
