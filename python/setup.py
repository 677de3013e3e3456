"""Wheel of the module: CMake builds the core where the programs are built, setuptools packs it.

OSTEOMILL_BUILD names the build's folder; otherwise it is build/release of the repository, configured by its preset if need be.
OSTEOMILL_MODULES names a folder of extension modules that are built already."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
BUILD = pathlib.Path(os.environ.get("OSTEOMILL_BUILD", REPOSITORY / "build" / "release")).resolve()
SCRATCH = BUILD / "wheel"  # nothing is left among the sources


class BuildWithCMake(build_ext):
    def build_extension(self, extension):
        to = pathlib.Path(self.get_ext_fullpath(extension.name))
        to.parent.mkdir(parents=True, exist_ok=True)
        folder = pathlib.Path(os.environ.get("OSTEOMILL_MODULES") or self.built_modules())
        built = folder / (extension.name.rpartition(".")[2] + sysconfig.get_config_var("EXT_SUFFIX"))
        if not built.exists():
            there = ", ".join(sorted(file.name for file in folder.glob("*.so"))) or "no module"
            sys.exit(f"{built} is missing, the module for this Python ({sys.executable}); {there} is there: use the Python of that")
        shutil.copy(built, to)

    def built_modules(self):
        if not (BUILD / "CMakeCache.txt").exists():
            subprocess.run(["cmake", "--preset", "release", "-B", BUILD, "-DOSTEOMILL_TESTS=OFF"], cwd=REPOSITORY, check=True)
        subprocess.run(["cmake", "--build", BUILD, "--target", "osteomill_python"], check=True)
        return BUILD / "python" / "osteomill"


SCRATCH.mkdir(parents=True, exist_ok=True)
setup(
    version=re.search(r"project\(osteomill VERSION ([\d.]+)", (REPOSITORY / "CMakeLists.txt").read_text())[1],
    ext_modules=[Extension("osteomill._core", sources=[]), Extension("osteomill._render", sources=[]),
                 Extension("osteomill._studies", sources=[])],
    cmdclass={"build_ext": BuildWithCMake},
    options={"build": {"build_base": str(SCRATCH)}, "egg_info": {"egg_base": str(SCRATCH)}},
)
