"""An analysis: currents and their symmetries."""
from __future__ import annotations

import collections.abc
import functools
from typing import Any, Dict, List, Optional, Union

import numpy

from ._arguments import explains_arguments
from ._library import AS_LATEX, AS_MATHML, PLAIN, UsageError, library, taken
from ._types import Numbers
from .formula import Formula
from .results import Record, Result, aligned, arrays_of, columns, no_entry, shortened


@explains_arguments
class Current(Record):
    """A conserved quantity.  Called with positions, velocities and times it gives values.

    Attributes
    ----------
    name : str
        "Phi1".
    meaning : str
        "energy", "minus the momentum of x", or "".
    proved, for_all : bool
        Proved exactly; for all values of the parameters.
    independent : bool
        Of the currents before it.
    digits : float
        To which its rate vanishes in ball arithmetic.
    drift : float
        Along the test motion, relative; nan where none was computed.

    Examples
    --------
    >>> momentum = nhsym.system("sleigh").analyze()["Phi2"]
    >>> momentum.proved, momentum([0, 0, 0], [2, 0, 0])
    (True, 8.0)
    """

    def __init__(self, analysis: Analysis, index: int) -> None:
        self._analysis, self._index, self._coordinates = analysis, index, analysis._coordinates
        facts = library().nh_current_describe(analysis._address, index)
        self.name: str = facts.name.decode()
        self.meaning: str = facts.meaning.decode()
        self.proved: bool = facts.proved
        self.for_all: bool = facts.for_all
        self.independent: bool = facts.independent
        self.digits: float = facts.digits
        self.drift: float = facts.drift

    @functools.cached_property
    def _content(self):
        return dict(self._analysis.json["currents"][self._index], formula=self.formula)

    def _written(self, syntax):
        with self._analysis._lock:
            return taken(library().nh_current_formula(self._analysis._address, self._index, syntax))

    @functools.cached_property
    def formula(self) -> Optional[Formula]:
        """In t, coordinates, parameters and the velocities of coordinates; None: too long to be written."""
        text = self._written(PLAIN)
        return None if text is None else Formula(text, self._coordinates)

    def sympy(self, functions: bool = False) -> Any:
        """The formula for SymPy; see `Formula.sympy`.

        Parameters
        ----------
        functions : bool
            Coordinates as functions of t, velocities as their derivatives.

        Returns
        -------
        sympy.Expr

        Examples
        --------
        >>> nhsym.system("sleigh").analyze()["Phi1"].sympy()
        -m*(a**2*k**2*phi'**2 + (x'*cos(phi) + y'*sin(phi))**2)/2
        """
        if self.formula is None:
            raise UsageError("the formula of %s is too long to be written" % self.name, "set the option `written` to more")
        return self.formula.sympy(functions)

    def __call__(self, q: Numbers, v: Numbers, t: Numbers = 0.0) -> Union[float, numpy.ndarray]:
        """Its values.

        Parameters
        ----------
        q, v : array of shape (m,), (m, count), ..
            Positions and velocities, one row per coordinate in the order of `System.coordinates`.
        t : float or array
            Times, of the other axes' shape.

        Returns
        -------
        float or array
            nan where it is not defined.
        """
        q, v, t, count, shape = arrays_of(q, v, t, len(self._coordinates))
        out = numpy.empty(count)
        with self._analysis._lock:
            good = library().nh_current_values(self._analysis._address, self._index, count, None if t is None else t.ctypes.data, q.ctypes.data, v.ctypes.data,
                                               out.ctypes.data)
        if not good:
            raise UsageError("%s cannot be written in the velocities of coordinates" % self.name, "see `expression`, which is in the chart's velocities")
        return out.reshape(shape) if shape else float(out[0])

    def along(self, simulation: Any) -> numpy.ndarray:
        """Its values along a motion.

        Parameters
        ----------
        simulation : Simulation
            A motion of the same system.

        Returns
        -------
        array
            One value per row of the motion.

        Examples
        --------
        >>> sleigh = nhsym.system("sleigh")
        >>> values = sleigh.analyze()["Phi2"].along(sleigh.simulate(initial={"omega": 2}, until=1))
        >>> print("%.6f" % values.mean())
        8.000000
        """
        q, v = simulation.states()
        return self(q, v, simulation.table["t"])

    def _repr_latex_(self) -> Optional[str]:
        latex = self._written(AS_LATEX)
        return "$%s$" % latex if latex else None

    def _repr_html_(self) -> str:
        mathml = self._written(AS_MATHML)
        return '<math xmlns="http://www.w3.org/1998/Math/MathML">%s</math>' % mathml if mathml else "<code>%s</code>" % self.name

    def __repr__(self) -> str:
        return "<%s = %s%s>" % (self.name, self.formula or "(long)", ", " + self.meaning if self.meaning else "")

    def values(self) -> List[Any]:
        """The values of its JSON.

        Returns
        -------
        list

        Examples
        --------
        >>> "Phi1" in nhsym.system("sleigh").analyze()["Phi1"].values()
        True
        """
        return [self[key] for key in self]

    def get(self, key: str, default: Any = None) -> Any:
        """The value of a key of its JSON.

        Parameters
        ----------
        key : str
            The key.
        default : object
            What is returned where there is no such key.

        Returns
        -------
        object

        Examples
        --------
        >>> nhsym.system("sleigh").analyze()["Phi1"].get("nothing", 0)
        0
        """
        return self[key] if key in self else default


# So that pandas.DataFrame(analysis.currents) has a column for each key.
collections.abc.Mapping.register(Current)


@explains_arguments
class Analysis(Result):
    """Currents and their symmetries, and what the JSON has.  `analysis["Phi1"]` and `analysis[0]` are currents.

    Examples
    --------
    >>> analysis = nhsym.system("sleigh").analyze()
    >>> analysis
    <Analysis of sleigh: FOUND, 5 independent currents of at most 5, search complete>
    >>> print(analysis)
    Chaplygin sleigh   m = 2, a = 1, k = 2
    FOUND: 5 independent currents of at most 5 (search complete)
      Phi1 = -m*(a^2*k^2*phi'^2 + (x'*cos(phi) + y'*sin(phi))^2)/2   minus the energy; proved
    ...
    """

    _kind = "analysis"

    @functools.cached_property
    def currents(self) -> List[Current]:
        """All currents that were found."""
        return [Current(self, i) for i in range(library().nh_analysis_currents(self._address))]

    def __getitem__(self, key: Union[str, int]) -> Any:
        """A current by its name or number, or a part of the JSON by its key."""
        if isinstance(key, int):
            if not -len(self.currents) <= key < len(self.currents):
                raise IndexError("there is no current number %d; there are %d, numbered from 0" % (key, len(self.currents)))
            return self.currents[key]
        named = [current for current in self.currents if current.name == key]
        if named or key in self._content:
            return named[0] if named else super().__getitem__(key)
        raise no_entry(key, [current.name for current in self.currents])

    @property
    def verdict(self) -> str:
        """"FOUND", "FITTED", "NONE" or "UNDECIDED"."""
        return library().nh_analysis_verdict(self._address).decode()

    @property
    def search(self) -> str:
        """"complete", "exhausted" or "cut"."""
        return library().nh_analysis_search(self._address).decode()

    @property
    def independent(self) -> int:
        """The number of functionally independent currents."""
        return library().nh_analysis_independent(self._address)

    @property
    def most(self) -> int:
        """The number that exists locally."""
        return library().nh_analysis_most(self._address)

    @property
    def equations(self) -> Dict[str, Formula]:
        """The equations of motion on the constraint submanifold: {velocity: rate}."""
        return {entry["velocity"]: Formula(entry["rate"], self._coordinates) for entry in self.json["reduced_equations"] if entry["rate"]}

    @property
    def table(self) -> Dict[str, numpy.ndarray]:
        """A row per current, as a dict of arrays."""
        rows = [{"name": c.name, "formula": c.formula, "meaning": c.meaning, "proved": c.proved, "for_all": c.for_all, "independent": c.independent,
                 "digits": c.digits, "drift": c.drift} for c in self.currents]
        return columns(rows, ["name", "formula", "meaning", "proved", "for_all", "independent", "digits", "drift"])

    def _repr_latex_(self) -> Optional[str]:
        return aligned((r"\text{%s}" % c.name, c._written(AS_LATEX)) for c in self.currents)

    def __str__(self) -> str:
        lines = self.text.split("\n")[:2]
        for c in self.currents:
            words = [c.meaning] * bool(c.meaning) + ["proved" if c.proved else "checked"]
            lines.append("  %s = %s   %s" % (c.name, c.formula if c.formula and len(c.formula) < 90 else "(long)", "; ".join(words)))
        return shortened(lines + ["The whole report: its attribute `text`; a page: save(\"report.html\")"], "its attribute `text`")

    def __repr__(self) -> str:
        return "<Analysis of %s: %s, %d independent currents of at most %d, search %s>" % (self._problem.name, self.verdict, self.independent, self.most, self.search)
