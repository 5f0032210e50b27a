"""Chains of pendula from rest, by `nhsym simulate` and by SciPy's DOP853 on the exported equations, in one run.

    make && python3 tests/bench_special.py [most links]

Prints for each chain: the error at the end relative to the largest state, evaluations and seconds of both, and the ratio of the times (SciPy's by its motion
alone, without the start of the interpreter; that of nhsym likewise).  It needs SciPy and the program build/nhsym.
"""
import importlib.util
import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy as np
from scipy.integrate import solve_ivp

program = pathlib.Path(__file__).resolve().parent.parent / "build" / "nhsym"
tolerance, end = 1e-9, 0.5


def system(n):
    text = "name: chain\ncoordinates: [" + ", ".join(f"{{name: q{i}, type: angle}}" for i in range(n)) + "]\nlagrangian: 0"
    for i in range(n):
        text += f" + {n - i}*(q{i}'^2/2 + 9.81*cos(q{i}))"
        text += "".join(f" + {n - i}*q{i}'*q{j}'*cos(q{i} - q{j})" for j in range(i))
    return text + "\n"


def rates_of(folder, path):
    subprocess.run([program, "export", path, "--to", "python", "--of", "submanifold", "-o", folder, "-q"], check=True)
    spec = importlib.util.spec_from_file_location("chain", folder / "chain.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.rates


def by_nhsym(path, initial):
    out = subprocess.run([program, "simulate", path, "--initial", initial, "--until", str(end), "--step", str(end), "--tolerance", str(tolerance),
                          "--json", "-"], check=True, capture_output=True, text=True).stdout
    return json.loads(out)


print("links start        error  evaluations (SciPy)  seconds (SciPy)    ratio")
for n in range(2, int(sys.argv[1]) + 1 if len(sys.argv) > 1 else 7):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        path = folder / "chain.yaml"
        path.write_text(system(n))
        rates = rates_of(folder, path)
        for start in ("pi/2", "1", "0.1"):
            runs = [by_nhsym(path, ", ".join(f"q{i}={start}" for i in range(n))) for _ in range(3)]
            state = np.array(list(runs[0]["states"].values()))
            fine = solve_ivp(rates, (0, end), state[:, 0], method="DOP853", rtol=1e-13, atol=1e-13)
            begin = time.perf_counter()
            plain = solve_ivp(rates, (0, end), state[:, 0], method="DOP853", rtol=tolerance, atol=tolerance)
            scipy = time.perf_counter() - begin
            own = min(run["stats"]["seconds"] for run in runs)
            error = np.max(np.abs(state[:, -1] - fine.y[:, -1])) / np.max(np.abs(fine.y))
            print(f"{n:5d} {start:10s} {error:8.1e} {runs[0]['stats']['evaluations']:8d} ({plain.nfev:5d})  "
                  f"{own:10.5f} ({scipy:7.4f}) {scipy / own:8.1f}", flush=True)
