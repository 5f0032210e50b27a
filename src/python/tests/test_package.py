"""The wheel and the sdist, built without a network, and the package out of them."""
import os
import pathlib
import subprocess
import sys
import tarfile
import zipfile

import pytest

import nhsym

TOP = pathlib.Path(nhsym.__file__).resolve().parents[3]


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("built")
    run = subprocess.run(["make", "-s", "--no-print-directory", "-C", str(TOP), "SANITIZE=", "BUILD=%s" % folder, "-o", "library", "wheel"], capture_output=True, text=True,
                         env=dict(os.environ, MAKEFLAGS="", PYTHON=sys.executable))
    assert run.returncode == 0, run.stdout + run.stderr
    return folder / "python"


def test_without_numpy_the_package_to_install_is_named():
    code = "import sys; sys.modules['numpy'] = None; import nhsym"
    ended = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert ended.returncode == 1 and "nhsym needs NumPy" in ended.stderr and "python3-numpy" in ended.stderr


def test_the_sdist_holds_what_it_is_built_from(built, tmp_path):
    with tarfile.open(next(built.glob("nhsym-*.tar.gz"))) as sdist:
        sdist.extractall(tmp_path)
    top = next(tmp_path.iterdir())
    names = {path.name for path in top.rglob("*")}
    assert {"pyproject.toml", "setup.py", "README.md", "py.typed"} | {path.name for path in (TOP / "src/python/nhsym").glob("*.py")} <= names
    plan = subprocess.run(["make", "-n", "-C", str(top / "sources"), "SANITIZE=", "library"], capture_output=True, text=True, env=dict(os.environ, MAKEFLAGS=""))
    assert plan.returncode == 0 and plan.stdout.count(" -c src/") == len(list((TOP / "src").glob("*/*.c"))) - len(list((TOP / "src/cli").glob("*.c"))), plan.stderr


def alone(folder, code):
    """What code prints with the package in a folder, in an empty one, without the sources, the built library and the systems."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("NHSYM_")}
    empty = folder / "empty"
    empty.mkdir()
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=empty, env=dict(kept, PYTHONPATH=str(folder)))
    assert run.returncode == 0, run.stderr
    return run.stdout.split()


LOOK = """import nhsym
print(nhsym.__file__, nhsym._library.library()._name, len(nhsym.systems()), nhsym.system("sleigh").verify("m*v^2 + m*a^2*k^2*omega^2").proved)"""


def test_the_wheel_works_elsewhere(built, tmp_path):
    wheel = next(built.glob("nhsym-*.whl"))
    assert "-py3-none-linux_" in wheel.name
    with zipfile.ZipFile(wheel) as inside:
        assert {"nhsym/" + path.name for path in (TOP / "src/python/nhsym").glob("*.py")} | {"nhsym/py.typed"} <= set(inside.namelist())
        inside.extractall(tmp_path)
    file, library, known, proved = alone(tmp_path, LOOK)
    assert (file, library, proved) == (str(tmp_path / "nhsym/__init__.py"), str(tmp_path / "nhsym/lib/libnhsym.so.1"), "True") and int(known) == len(nhsym.systems())
    assert (tmp_path / "nhsym/analyses/sleigh.yaml").exists() and (tmp_path / "nhsym/systems/stress").exists()


def test_pip_installs_the_sources(built, tmp_path):
    """With the library that is built already, as NHSYM_LIBRARY names it."""
    pytest.importorskip("pip")
    run = subprocess.run([sys.executable, "-m", "pip", "install", "-q", "--no-index", "--no-deps", "--no-build-isolation", "--target", str(tmp_path), str(built / "source")],
                         capture_output=True, text=True, env=dict(os.environ, NHSYM_LIBRARY=nhsym._library.library()._name))
    assert run.returncode == 0, run.stdout + run.stderr
    assert alone(tmp_path, LOOK)[1] == str(tmp_path / "nhsym/lib/libnhsym.so.1")
