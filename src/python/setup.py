"""Builds the package with its library: `pip install ./src/python` makes libnhsym by the Makefile of the sources and puts it, and the shipped systems, into the wheel.

NHSYM_LIBRARY names a library that is taken as it is.  The sources stand two folders above; an sdist has them in `sources`."""
import os
import pathlib
import shutil
import subprocess
import sys

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel
except ImportError:  # before setuptools 70
    from wheel.bdist_wheel import bdist_wheel

HERE = pathlib.Path(__file__).resolve().parent
SONAME = "libnhsym.so.1"
SOURCES = [folder for folder in (HERE / "sources", *HERE.parents[1:2]) if (folder / "src" / "nhsym.h").exists()]
if not SOURCES:
    sys.exit("the sources of the library are missing: %s lies in none, and has no folder `sources`\n"
             "hint: pip install PATH/src/python, where PATH is the folder of all sources" % HERE)
TOP = SOURCES[0].resolve()


def made():
    """The path of the library, which is built where it is not up to date."""
    given = os.environ.get("NHSYM_LIBRARY")
    if given:
        if not os.path.isfile(given):
            sys.exit("NHSYM_LIBRARY names no file: %s" % given)
        return given
    cores = str(len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1)
    ended = subprocess.run(["make", "-C", str(TOP), "-j", cores, "SANITIZE=", "library"], env=dict(os.environ, MAKEFLAGS=""))
    if ended.returncode:
        sys.exit("the library could not be built: see above\nhint: `make packages` in %s installs on Debian what it needs" % TOP)
    return str(TOP / "build" / SONAME)


class Build(build_py):
    """The modules; in nhsym/lib the library, and in nhsym/systems and nhsym/analyses what it looks for there (src/problem/places.c)."""

    def run(self):
        super().run()
        library = made()
        if getattr(self, "editable_mode", False):
            return  # the package stands in the sources, and finds their build
        package = pathlib.Path(self.build_lib) / "nhsym"
        (package / "lib").mkdir(parents=True, exist_ok=True)
        shutil.copyfile(library, str(package / "lib" / SONAME))
        for folder in ("systems", "analyses"):
            shutil.copytree(str(TOP / folder), str(package / folder), dirs_exist_ok=True, ignore=lambda _, names: [n for n in names if "." in n and not n.endswith(".yaml")])


class OfAMachine(Distribution):
    """What is built is for one kind of machine."""

    def has_ext_modules(self):
        return True


class Wheel(bdist_wheel):
    """For any Python 3: the library is called by ctypes."""

    def get_tag(self):
        return ("py3", "none") + super().get_tag()[2:]


class Sources(sdist):
    """With all that the library is built from, so that a wheel can be built out of it."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        inside = pathlib.Path(base_dir) / "sources"
        inside.mkdir(exist_ok=True)
        for name in ("Makefile", "LICENSE"):
            shutil.copyfile(str(TOP / name), str(inside / name))
        for folder in ("src", "systems", "analyses"):
            shutil.copytree(str(TOP / folder), str(inside / folder), dirs_exist_ok=True,
                            ignore=lambda path, names: {"python", "debian"} & set(names) if pathlib.Path(path) == TOP / "src" else ())


setup(distclass=OfAMachine, cmdclass={"build_py": Build, "bdist_wheel": Wheel, "sdist": Sources})
