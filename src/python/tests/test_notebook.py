"""docs/nhsym.ipynb and those of docs/notebooks run, and show what is stored in them."""
import copy
import json
import pathlib
import re

import pytest

import nhsym
from notebook import run

DOCS = pathlib.Path(nhsym.__file__).resolve().parents[3] / "docs"
PATHS = [DOCS / "nhsym.ipynb"] + sorted((DOCS / "notebooks").glob("*.ipynb"))


@pytest.fixture(params=PATHS, ids=lambda path: path.stem)
def stored(request):
    return json.loads(request.param.read_text(encoding="utf-8"))


def test_there_is_a_gallery():
    assert {path.stem for path in PATHS} >= {"nhsym", "student", "robot", "paper", "benchmark", "classification", "data"}


def test_it_is_a_notebook(stored):
    assert stored["nbformat"] == 4 and all({"cell_type", "source", "metadata"} <= set(cell) for cell in stored["cells"])
    assert sum(cell["cell_type"] == "code" for cell in stored["cells"]) >= 2


def test_its_cells_show_what_is_stored(stored, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    again = run(copy.deepcopy(stored))
    figures = 0
    for before, after in zip(stored["cells"], again["cells"]):
        kinds, now = ([sorted(output.get("data", output)) for output in cell.get("outputs", [])] for cell in (before, after))
        assert kinds == now
        figures += sum("image/svg+xml" in kind for kind in kinds)
        words = [re.sub(r"[-\d.e+]*\d", "#", "".join(line for output in cell.get("outputs", []) for line in output.get("text", output.get("data", {}).get("text/plain", []))))
                 for cell in (before, after)]
        assert words[0] == words[1]
    assert figures >= 1 or "plot(" not in json.dumps(stored)


def test_a_failing_cell_is_reported():
    with pytest.raises(ZeroDivisionError):
        run({"cells": [{"cell_type": "code", "source": ["1/0"], "metadata": {}}]})
