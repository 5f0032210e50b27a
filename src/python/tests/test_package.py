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


def test_the_sdist_holds_what_it_is_built_from(built):
    with tarfile.open(next(built.glob("nhsym-*.tar.gz"))) as sdist:
        names = {pathlib.PurePath(name).name for name in sdist.getnames()}
    assert {"pyproject.toml", "README.md"} | {path.name for path in (TOP / "src/python/nhsym").glob("*.py")} <= names


def test_the_wheel_works_elsewhere(built, tmp_path):
    with zipfile.ZipFile(next(built.glob("nhsym-*.whl"))) as wheel:
        assert {"nhsym/" + path.name for path in (TOP / "src/python/nhsym").glob("*.py")} <= set(wheel.namelist())
        wheel.extractall(tmp_path)
    code = "import nhsym; print(nhsym.__file__, nhsym.system('sleigh').verify('m*v^2 + m*a^2*k^2*omega^2').proved)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, cwd=tmp_path, env=dict(os.environ, PYTHONPATH=str(tmp_path)))
    assert run.stdout.split() == [str(tmp_path / "nhsym" / "__init__.py"), "True"], run.stderr
