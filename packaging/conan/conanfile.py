# SPDX-License-Identifier: MIT
import os
import re

from conan import ConanFile
from conan.tools.files import copy, load


class Shadowmath(ConanFile):
    name = "shadowmath"
    description = "The mathematics of shadow maps, as C++17 headers on GLM"
    license = "MIT"
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    @property
    def _checkout(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self._checkout, "include", "shadowmath", "version.hpp"))
        self.version = ".".join(re.findall(r"_VERSION_\w+ (\d+)", text))

    def export_sources(self):
        copy(self, "include/*", self._checkout, self.export_sources_folder)
        copy(self, "LICENSE", self._checkout, self.export_sources_folder)

    def requirements(self):
        self.requires("glm/[>=0.9.9.8]", transitive_headers=True)

    def package(self):
        copy(self, "include/*", self.source_folder, self.package_folder)
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_id(self):
        self.info.clear()

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "shadowmath")
        self.cpp_info.set_property("cmake_target_name", "shadowmath::shadowmath")
        self.cpp_info.set_property("pkg_config_name", "shadowmath")
