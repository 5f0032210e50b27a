"""Results as objects: their JSON as attributes, their pages in a notebook, their numbers as arrays."""
from __future__ import annotations

import functools
import html
import json
import os
import threading
from typing import Any, Dict, Iterator, List, Optional, Tuple, Union

import numpy

from ._arguments import explains_arguments, nearest, no_attribute, velocity_meant
from ._calls import free_later
from ._library import CSV, HTML, JSON, LATEX, SVG, TEXT, ErrorRecord, UsageError, error_of, library, taken
from .formula import Formula

# Keys of the JSON documents whose strings are formulas, at whatever depth.
FORMULAS = {"expression", "in_velocities", "lagrangian", "energy", "rate", "constraint", "reaction", "Z0", "zeta", "W", "components", "components_with_gamma",
            "generators", "momentum_map", "equation", "current", "recognised", "metric", "potential"}
SHORT = 12  # lines of what print() shows


def no_entry(key, names):
    near = velocity_meant(key, names) or nearest(key, names)
    return KeyError("there is no `%s`%s" % (key, "; did you mean `%s`?" % near if near else ", but " + ", ".join(names)))


@explains_arguments
class Record:
    """A part of a result: what its JSON has, as attributes and by key.

    Examples
    --------
    >>> constraint = nhsym.system("sleigh").analyze().constraint
    >>> constraint.type, constraint["type"] == constraint.type
    ('linear', True)
    """

    def __init__(self, content: Dict[str, Any], coordinates: Tuple[str, ...] = ()) -> None:
        self._content, self._coordinates = content, coordinates

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            raise no_attribute(self, name, self._content) from None

    def __getitem__(self, key: Any) -> Any:
        return _wrapped(self._content[key], key in FORMULAS, self._coordinates)

    def __iter__(self) -> Iterator[str]:
        return iter(self._content)

    def __len__(self) -> int:
        return len(self._content)

    def __contains__(self, key: object) -> bool:
        return key in self._content

    def keys(self) -> Any:
        """The keys of the JSON.

        Returns
        -------
        view of str

        Examples
        --------
        >>> "type" in nhsym.system("sleigh").analyze().constraint.keys()
        True
        """
        return self._content.keys()

    def items(self) -> List[Tuple[str, Any]]:
        """Keys and values, formulas as `Formula` and objects as `Record`.

        Returns
        -------
        list of (str, value)

        Examples
        --------
        >>> dict(nhsym.system("sleigh").analyze().constraint.items())["type"]
        'linear'
        """
        return [(key, self[key]) for key in self._content]

    def as_dict(self) -> Dict[str, Any]:
        """The JSON as it is.

        Returns
        -------
        dict

        Examples
        --------
        >>> type(nhsym.system("sleigh").analyze().constraint.as_dict())
        <class 'dict'>
        """
        return self._content

    def __dir__(self) -> List[str]:
        return sorted(set(super().__dir__()) | {key for key in self._content if key.isidentifier()})

    def __repr__(self) -> str:
        return "%s(%s)" % (type(self).__name__, ", ".join(self._content))


def _wrapped(value, formula, coordinates):
    if isinstance(value, dict):
        formulas = formula and all(isinstance(entry, (str, list, type(None))) for entry in value.values())
        return {k: _wrapped(v, True, coordinates) for k, v in value.items()} if formulas else Record(value, coordinates)
    if isinstance(value, list):
        return [_wrapped(entry, formula, coordinates) for entry in value]
    return Formula(value, coordinates) if formula and isinstance(value, str) else value


def columns(rows, keys) -> Dict[str, numpy.ndarray]:
    """Rows as a dict of arrays: of truth values where there are only such, of numbers where there are only numbers and gaps (nan)."""
    table = {}
    for key in keys:
        values = [row.get(key) for row in rows]
        truths = values and all(isinstance(value, bool) for value in values)
        numbers = all(value is None or isinstance(value, (int, float)) and not isinstance(value, bool) for value in values)
        table[key] = numpy.array([numpy.nan if v is None else v for v in values], float) if numbers else numpy.array(values, bool if truths else object)
    return table


def array_of(name, value):
    try:
        return numpy.asarray(value, float)
    except (TypeError, ValueError) as reason:
        raise UsageError("%s is not an array of numbers: %s" % (name, reason), "give a list or an array of numbers") from None


def arrays_of(q, v, t, m):
    """States as the library takes them: (m, count) and count times; and the shape of the answer."""
    q, v, t = (array_of(name, value) for name, value in (("q", q), ("v", v), ("t", t)))
    for name, value in (("q", q), ("v", v)):
        if value.ndim == 0 or value.shape[0] != m:
            raise UsageError("%s has the shape %s" % (name, value.shape), "give an array whose first axis has the %d coordinates, in their order" % m)
    try:
        shape = numpy.broadcast_shapes(q.shape[1:], v.shape[1:], t.shape)
    except ValueError:
        raise UsageError("the shapes of q, v and t do not fit: %s, %s and %s" % (q.shape, v.shape, t.shape), "all axes but the first of q and v are those of t") from None
    count = int(numpy.prod(shape))
    flat = [numpy.ascontiguousarray(numpy.broadcast_to(x, (m,) + shape)).reshape(m, count) for x in (q, v)]
    times = numpy.ascontiguousarray(numpy.broadcast_to(t, shape)).reshape(count) if t.ndim or t != 0 else None
    return flat[0], flat[1], times, count, shape


def shortened(lines, rest):
    """At most SHORT lines, the last of which says where the rest is."""
    lines = [line if len(line) <= 120 else line[:117] + "..." for line in lines]
    return "\n".join(lines if len(lines) <= SHORT else lines[:SHORT - 1] + ["... %d more lines: %s" % (len(lines) - SHORT + 1, rest)])


class Page:
    """A page of the program that a notebook shows in a frame of its own."""

    def __init__(self, text: str, name: str, height: int) -> None:
        self.text, self._name, self._height = text, name, height

    def _repr_html_(self) -> str:
        return '<iframe srcdoc="%s" style="width:100%%;height:%dpx;border:1px solid #ccc"></iframe>' % (html.escape(self.text, quote=True), self._height)

    def __repr__(self) -> str:
        return "<Page of %s: %d pixels high>" % (self._name, self._height)


@explains_arguments
class Result(Record):
    """A result of the library.  `text`, `html`, `latex` are the documents of the program; `json` is parsed; `print` shows a dozen lines.

    Examples
    --------
    >>> result = nhsym.system("sleigh").verify("m*v")
    >>> print(result)
    Chaplygin sleigh   m = 2, a = 1, k = 2
    No: this is not conserved.
    <BLANKLINE>
    The question
    ...
    """

    _kind = ""       # of its functions in nhsym.h
    _formats: Tuple[int, ...] = (TEXT, JSON, HTML, LATEX)

    def __init__(self, address: Any, problem: Any) -> None:
        self._address, self._problem, self._lock = address, problem, threading.Lock()
        self._coordinates = problem.coordinates

    def __del__(self) -> None:
        if getattr(self, "_address", None):
            free_later(getattr(library(), "nh_%s_free" % self._kind), self._address)

    def _document(self, form: int) -> str:
        error = ErrorRecord()
        with self._lock:
            text = taken(getattr(library(), "nh_%s_document" % self._kind)(self._address, form, error))
        if text is None:
            raise error_of(error)
        return text

    @functools.cached_property
    def _content(self):
        return json.loads(self._document(JSON))

    @property
    def json(self) -> Dict[str, Any]:
        """The JSON document of the program, parsed."""
        return self._content

    @property
    def text(self) -> str:
        """What the program prints."""
        return self._document(TEXT)

    @property
    def html(self) -> str:
        """The page, complete in itself."""
        return self._document(HTML)

    @property
    def latex(self) -> str:
        """The LaTeX document, or the equations of a reduction."""
        return self._document(LATEX)

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Write a document to a file.

        Parameters
        ----------
        path : str or path
            Its ending says which: the page (.html), the LaTeX document (.tex), the JSON (.json), the text (.txt), the
            table (.csv) or the picture (.svg), where the result has one.

        Examples
        --------
        >>> nhsym.system("sleigh").simulate(until=1).save("motion.csv")
        """
        forms = {".html": HTML, ".tex": LATEX, ".json": JSON, ".txt": TEXT, ".csv": CSV, ".svg": SVG}
        ending = "." + str(path).rpartition(".")[2]
        if ending not in forms:
            raise UsageError("%s: no such kind of file" % path, "the name ends in " + ", ".join(forms))
        text = self._document(forms[ending])
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def live(self, height: int = 900) -> Page:
        """The page in the cell of a notebook, where its sliders, plots and moving picture work.

        Parameters
        ----------
        height : int
            Of the cell, in pixels.

        Returns
        -------
        Page

        Examples
        --------
        >>> nhsym.system("sleigh").simulate(until=1).live()
        <Page of sleigh: 900 pixels high>
        """
        return Page(self.html, self._problem.name, height)

    def _repr_html_(self) -> str:
        if HTML not in self._formats:
            return "<pre>%s</pre>" % html.escape(self.text)
        return self.live(580)._repr_html_()

    def __str__(self) -> str:
        return shortened(self.text.rstrip().split("\n"), "its attribute `text`")

    def __repr__(self) -> str:
        return "<%s of %s>" % (type(self).__name__, self._problem.name)


def aligned(pairs):
    """Equations for a notebook, one to a line."""
    rows = [r"%s &= %s" % pair for pair in pairs if pair[1]]
    return "$$\\begin{aligned} %s \\end{aligned}$$" % r" \\ ".join(rows) if rows else None


# ---- symmetry ----

class Reduction(Result):
    """The symmetry group and the reduced equations: `group`, `stages` and what the JSON has.

    Examples
    --------
    >>> nhsym.system("knife_edge").reduce()
    <Reduction of knife_edge: ...>
    """

    _kind = "reduction"

    @property
    def equations(self) -> List[Dict[str, Formula]]:
        """Of each stage: {shape coordinate or velocity: rate}."""
        return [{e["of"]: Formula(e["rate"], self._coordinates) for e in stage.get("equations", []) if isinstance(e.get("rate"), str)} for stage in self.json["stages"]]

    @property
    def table(self) -> Dict[str, numpy.ndarray]:
        """A row per stage, as a dict of arrays."""
        return columns(self.json["stages"], ["kind", "group", "agreement_with_full", "speedup"])

    def _repr_latex_(self) -> Optional[str]:
        return aligned((r"\frac{d}{dt}\,%s" % (Formula(of).latex or of), rate.latex) for stage in self.equations[:1] for of, rate in stage.items())

    def __repr__(self) -> str:
        return "<Reduction of %s: group %s, %d stages>" % (self._problem.name, self.json["group"]["name"], len(self.json["stages"]))


class Verification(Result):
    """Of a current or a field: true where it is conserved, or a symmetry; `counterexample` and what the JSON has.

    Examples
    --------
    >>> nhsym.system("sleigh").verify("m*(v^2 + a^2*k^2*omega^2)")
    <Verification: holds, proved>
    """

    _kind = "verification"
    _formats = (TEXT, JSON, HTML)

    def __bool__(self) -> bool:
        return library().nh_verification_holds(self._address)

    @property
    def holds(self) -> bool:
        """As `bool(..)`."""
        return bool(self)

    @property
    def proved(self) -> bool:
        """It holds, exactly."""
        return library().nh_verification_proved(self._address)

    def __repr__(self) -> str:
        return "<Verification: %s>" % (("holds, proved" if self.proved else "holds") if self else "does not hold")


class Classification(Result):
    """Special values of parameters: `special`, `degenerate`, `table` and what the JSON has.

    Examples
    --------
    >>> plane = nhsym.System(coordinates=["x", "y"], parameters={"k": 3}, lagrangian="(x'^2 + y'^2)/2 - (x^2 + k*y^2)/2")
    >>> "k = 1" in plane.classify("k", options={"degree": 2}).table["where"]
    True
    """

    _kind = "classified"
    _formats = (TEXT, JSON, HTML, LATEX)

    @property
    def table(self) -> Dict[str, numpy.ndarray]:
        """A row per special value, and per real value of a root, as a dict of arrays."""
        rows = []
        for entry in self.json["special"]:
            where = entry["where"]
            words = ", ".join("%s = %s" % pair for pair in where.items()) if isinstance(where, dict) else str(where)
            rows += [dict(entry, where=words, value=real) for real in entry.get("real_values") or [None]]
        return columns(rows, ["where", "value", "dimension", "from_degree", "proved"])

    def __repr__(self) -> str:
        return "<Classification of %s over %s: %d special values>" % (self._problem.name, ", ".join(self.json["over"]), len(self.json["special"]))
