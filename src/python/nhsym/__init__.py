"""Symmetries and conservation laws of mechanical systems with constraints.

    import nhsym
    sleigh = nhsym.system("sleigh")
    for current in sleigh.analyze().currents:
        print(current.name, current.formula, "proved" if current.proved else "checked")

The package calls the library libnhsym (nhsym.h); docs/python.md describes it.
"""
try:
    import numpy as _  # noqa: F401: first, so that what is missing is said by name
except ImportError as reason:
    raise ImportError("nhsym needs NumPy, which this Python does not have: %s\nhint: install it (Debian: apt-get install python3-numpy; else: python3 -m pip install numpy)"
                      % reason) from None

from ._arguments import ArgumentError
from ._library import Error, InputError, LimitError, NumericalError, UsageError, library_version
from ._calls import Interrupted
from .formula import Formula
from .results import Classification, Record, Reduction, Result, Verification
from .analysis import Analysis, Current
from .motion import Benchmark, Linearization, Picture, Simulation, Table
from .system import System, system, systems

__version__ = "0.2.0"
__all__ = ["Analysis", "ArgumentError", "Benchmark", "Classification", "Current", "Error", "Formula", "InputError", "Interrupted", "LimitError", "Linearization", "NumericalError", "Picture",
           "Record", "Reduction", "Result", "Simulation", "System", "Table", "UsageError", "Verification", "library_version", "system", "systems"]
