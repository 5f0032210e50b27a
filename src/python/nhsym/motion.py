"""Motions, their pictures, and what belongs to one state: tables of numbers."""
from __future__ import annotations

import base64
import csv
import functools
import html
import os
import re
import warnings
from typing import Any, Dict, List, Optional, Tuple, Union

import numpy

from ._arguments import explains_arguments, nearest, outside, velocity_meant
from ._library import CSV, JSON, HTML, SVG, TEXT, UsageError, library, taken
from .results import Result, columns, no_entry, shortened


# ---- columns ----

class Table(dict):
    """Columns by the names of a CSV file, {"phi_dot": array}.  Those of the language are understood, too: `table["phi'"]`.

    Examples
    --------
    >>> table = nhsym.system("sleigh").simulate(initial={"omega": 2}, until=1).table
    >>> list(table)[:5], table["phi'"] is table["phi_dot"]
    (['t', 'phi', 'x', 'y', 'phi_dot'], True)
    """

    def __init__(self, arrays: List[numpy.ndarray], names: List[str], plain: List[str]) -> None:
        super().__init__(zip(plain, arrays))
        self._plain = dict(zip(reversed(names), reversed(plain)))  # the first of two columns with one name

    def _key(self, key: Any) -> Any:
        return key if super().__contains__(key) else self._plain.get(key, key)

    def __missing__(self, key: Any) -> numpy.ndarray:
        if self._key(key) == key:
            raise no_entry(key, list(self))
        return self[self._key(key)]

    def __contains__(self, key: object) -> bool:
        return super().__contains__(self._key(key))

    def get(self, key: Any, default: Any = None) -> Any:
        """The column of this name.

        Parameters
        ----------
        key : str
            phi_dot, or phi'.
        default : object
            What is returned where there is no such column.

        Returns
        -------
        array or object

        Examples
        --------
        >>> nhsym.system("sleigh").simulate(until=1).table.get("nothing") is None
        True
        """
        return super().get(self._key(key), default)


def plain_names(names, header):
    """As a CSV file has them: of letters, digits and underscores, all different; header() is its first line, which is read where the names are more than coordinates and velocities."""
    plain = [re.sub("_?'", "_dot", name) for name in names]
    if all(re.fullmatch(r"[^\W\d]\w*", name) for name in plain) and len(set(plain)) == len(plain):
        return plain
    return next(csv.reader([header()]))


# ---- pictures ----

@explains_arguments
class Picture:
    """One or more SVG pictures, one below the other.  A notebook shows them, and so do the files that nbconvert makes of it.

    Examples
    --------
    >>> nhsym.system("sleigh").simulate(initial={"omega": 2}, until=5).plot("x", "y").save("path.svg")
    """

    def __init__(self, pictures: List[str], words: List[str]) -> None:
        self.pictures, self.words = pictures, words

    def _repr_svg_(self) -> Optional[str]:
        return self.pictures[0] if len(self.pictures) == 1 else None

    def _repr_html_(self) -> str:
        """As images, which are not part of the page: whoever cleans pages of foreign elements leaves them."""
        return "".join('<div><img alt="%s" src="data:image/svg+xml;base64,%s"></div>' % (html.escape(words, quote=True), base64.b64encode(picture.encode()).decode())
                       for picture, words in zip(self.pictures, self.words))

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> Dict[str, str]:
        forms = {"text/plain": repr(self), "text/html": self._repr_html_(), "image/svg+xml": self._repr_svg_()}
        return {kind: form for kind, form in forms.items() if form and (not include or kind in include) and kind not in (exclude or ())}

    def __repr__(self) -> str:
        return "<Picture of %s>" % ", ".join(self.words)

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Write the picture; several get numbers: plot.svg, plot-2.svg.

        Parameters
        ----------
        path : str or path
            A name that ends in .svg.

        Examples
        --------
        >>> nhsym.system("sleigh").simulate(until=1).plot("t", "x", "y").save("plot.svg")
        """
        stem, dot, ending = str(path).rpartition(".")
        for i, picture in enumerate(self.pictures):
            with open(path if i == 0 else "%s-%d%s%s" % (stem, i + 1, dot, ending), "w", encoding="utf-8") as file:
                file.write(picture)


def _axes(ax):
    """Of Matplotlib: the given ones, or new ones for True."""
    if ax is not True:
        if not hasattr(ax, "plot"):
            raise UsageError("ax cannot be %r" % (ax,), "give axes of Matplotlib, or True for new ones")
        return ax
    try:
        from matplotlib import pyplot
    except ImportError:
        raise UsageError("ax=True needs Matplotlib, which this Python does not have",
                         "install it (Debian: apt-get install python3-matplotlib; else: python3 -m pip install matplotlib), or leave `ax` out for a picture in SVG") from None
    return pyplot.subplots()[1]


# ---- motions ----

@explains_arguments
class Simulation(Result):
    """A motion: `table` is a dict of arrays, time first; `complete`, `warnings` and what the JSON has.  `motion["phi_dot"]` is a column.

    Examples
    --------
    >>> motion = nhsym.system("sleigh").simulate(initial={"omega": 2}, until=5)
    >>> print("%.4f %.4f" % (motion["phi"][-1], motion["phi_dot"][-1]))
    3.1146 0.0270
    """

    _kind = "simulation"
    _formats = (TEXT, JSON, HTML)

    def __init__(self, address: Any, problem: Any) -> None:
        super().__init__(address, problem)
        if not self.complete:
            warnings.warn("the motion of %s ended early, at t = %g: %s" % (problem.name, self.table["t"][-1], "; ".join(self.json["warnings"])), RuntimeWarning,
                          stacklevel=outside())

    @functools.cached_property
    def _names(self):
        """As the library has them: phi'."""
        return [library().nh_simulation_column(self._address, i).decode() for i in range(library().nh_simulation_columns(self._address))]

    @functools.cached_property
    def table(self) -> Table:
        """The columns as a dict of arrays; their names are those of a CSV file."""
        arrays = [numpy.empty(library().nh_simulation_rows(self._address)) for _ in self._names]
        for i, out in enumerate(arrays):
            library().nh_simulation_read(self._address, i, out.ctypes.data)
        return Table(arrays, self._names, plain_names(self._names, lambda: self._document(CSV).split("\n", 1)[0]))

    def __getitem__(self, key: str) -> Any:
        """A column by its name, phi_dot as in a CSV file or phi'; or a part of the JSON by its key."""
        if key in self.table:
            return self.table[key]
        if key in self._content:
            return super().__getitem__(key)
        raise no_entry(key, list(self.table))

    @property
    def section_table(self) -> Table:
        """The points of `simulate(section=..)`, as `table` has the motion."""
        section = self.json["section"]
        names = ["t"] + list(section["values"])
        return Table([numpy.array(section["time"])] + [numpy.array(column, float) for column in section["values"].values()], names, [re.sub("_?'", "_dot", name) for name in names])

    def states(self) -> Tuple[numpy.ndarray, numpy.ndarray]:
        """Positions and velocities of all coordinates.

        Returns
        -------
        q, v : array of shape (m, rows)

        Examples
        --------
        >>> q, v = nhsym.system("sleigh").simulate(until=1, step=0.1).states()
        >>> q.shape
        (3, 11)
        """
        missing = [name for q in self._coordinates for name in (q, q + "'") if name not in self.table]
        if missing:
            raise UsageError("the motion was watched without %s" % ", ".join(missing), "simulate without `watch`, or watch them")
        q, v = (numpy.array([self.table[q + tail] for q in self._coordinates]) for tail in ("", "'"))
        return q, v

    def plot(self, x: str = "t", *y: str, ax: Any = None) -> Any:
        """A picture of columns against another.

        Parameters
        ----------
        x, *y : str
            Columns; `plot("x", "y")` is a path, `plot()` the first coordinate over time.
        ax : matplotlib.axes.Axes or True, optional
            Draw with Matplotlib, into these axes or, with True, into new ones.

        Returns
        -------
        Picture
            In SVG, which a notebook shows; with `ax` the axes.

        Examples
        --------
        >>> nhsym.system("sleigh").simulate(initial={"omega": 2}, until=5).plot("x", "y")
        <Picture of y against x>
        """
        names = list(self.table)
        for name in (x,) + y:
            if name not in self.table:
                near = velocity_meant(name, names) or nearest(name, names)
                raise UsageError("there is no column `%s`" % name, "did you mean `%s`?" % near if near else "the columns are " + ", ".join(names))
        y = y or (names[1],)
        if ax is not None:
            ax = _axes(ax)
            for name in y:
                ax.plot(self.table[x], self.table[name], label=name)
            ax.set_xlabel(x)
            ax.set_ylabel(", ".join(y))
            return ax
        index = lambda name: names.index(self.table._key(name))
        return Picture([taken(library().nh_simulation_svg(self._address, index(x), index(name))) for name in y], ["%s against %s" % (name, x) for name in y])

    def __str__(self) -> str:
        t, most = self.table["t"], 6
        lines = ["Motion of %s: t = %g to %g, %d rows; %s, tolerance %g" % (self._problem.name, t[0], t[-1], len(t), self.json["method"], self.json["tolerance"])]
        lines += ["Warning: " + words for words in self.json["warnings"][:2]]
        width = max(len(name) for name in self.table)
        lines.append("%-*s  %12s  %12s  %12s  %12s" % (width, "column", "first", "last", "least", "greatest"))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", RuntimeWarning)  # a column without numbers
            for name, column in list(self.table.items())[1:most + 1]:
                lines.append("%-*s  %12.6g  %12.6g  %12.6g  %12.6g" % (width, name, column[0], column[-1], numpy.nanmin(column), numpy.nanmax(column)))
        if len(self.table) > most + 1:
            lines.append("and " + ", ".join(list(self.table)[most + 1:]))
        return shortened(lines + ["All rows: its attribute `table`; `text` is the CSV"], "its attribute `table`")

    def __repr__(self) -> str:
        return "<Simulation of %s: %d rows, %s>" % (self._problem.name, len(self.table["t"]), ", ".join(self.table))


# ---- integrators compared ----

@explains_arguments
class Benchmark(Result):
    """Integrators compared: `table`, `csv`, `plot()` and what the JSON has.

    Examples
    --------
    >>> nhsym.system("free_particle").benchmark(0.1, method="rk8pd", initial={"x'": 1}, until=1)
    <Benchmark of free_particle>
    """

    _kind = "benchmark"

    @property
    def csv(self) -> str:
        """A row per run, as --csv writes it."""
        return self._document(CSV)

    def plot(self, ax: Any = None) -> Any:
        """A picture: seconds and evaluations against error.

        Parameters
        ----------
        ax : matplotlib.axes.Axes or True, optional
            Draw with Matplotlib, into these axes or, with True, into new ones.

        Returns
        -------
        Picture
            In SVG, which a notebook shows; with `ax` the axes.

        Examples
        --------
        >>> nhsym.system("free_particle").benchmark(0.1, method="rk8pd", initial={"x'": 1}, until=1).plot()
        <Picture of work against error>
        """
        if ax is None:
            return Picture([self._document(SVG)], ["work against error"])
        ax, table = _axes(ax), self.table
        for method in dict.fromkeys(table["method"]):
            runs = table["method"] == method
            ax.plot(table["seconds"][runs], table["error"][runs], "o-", label=method)
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.set_xlabel("time, s")
        ax.set_ylabel("error")
        ax.legend()
        return ax

    @property
    def table(self) -> Dict[str, numpy.ndarray]:
        """A row per run, with the observed order of methods of fixed steps, as a dict of arrays."""
        keys = ["method", "formulation", "tolerance", "step", "error", "drift", "seconds", "evaluations", "order", "observed_order", "status", "reduced", "front", "note",
                "seconds_low", "seconds_high", "repeats", "floor", "below_floor", "front_evaluations"]
        return columns(self.json["motion"], keys)


# ---- linear equations ----

@explains_arguments
class Linearization(Result):
    """The linear equations of motion M dw' + C dw + K dx = 0 at a state, or along a family of states; `verdict` and what the JSON has.

    Examples
    --------
    >>> nhsym.system("double_pendulum").linearize({"p": "pi", "q": "pi"})
    <Linearization of double_pendulum: unstable, 4 eigenvalues>
    """

    _kind = "linearized"

    def _of(self, key, row=None):
        return numpy.array((self.json if row is None else self.json["rows"][row])[key], dtype=float)

    def at(self, i: int) -> Dict[str, numpy.ndarray]:
        """The linear equations at one value of a family.

        Parameters
        ----------
        i : int
            The number of the value, from 0.

        Returns
        -------
        dict
            M, C, K, A and the eigenvalues, by name.

        Examples
        --------
        >>> family = nhsym.system("double_pendulum").linearize(over={"g": "1:9:3"})
        >>> family.at(1)["eigenvalues"].real.max() < 1e-9
        True
        """
        row = self.json["rows"][i]
        if "eigenvalues" not in row:
            raise UsageError("there are no linear equations at %s = %r: %s" % (self.json["over"], row["value"], row["why"]), "")
        return dict({key: self._of(key, i) for key in "MCKA"}, eigenvalues=_spectrum(row)[0])

    @property
    def eigenvalues(self) -> Any:
        """Complex numbers, as often as they occur; of a family an array per value."""
        return _spectrum(self.json)[0] if self.json["over"] is None else [_spectrum(row)[0] for row in self.json["rows"]]

    @property
    def errors(self) -> Any:
        """Bounds of the errors of `eigenvalues`."""
        return _spectrum(self.json)[1] if self.json["over"] is None else [_spectrum(row)[1] for row in self.json["rows"]]

    @property
    def M(self) -> numpy.ndarray:
        """Of the accelerations."""
        return self._of("M")

    @property
    def C(self) -> numpy.ndarray:
        """Of the velocities."""
        return self._of("C")

    @property
    def K(self) -> numpy.ndarray:
        """Of the positions."""
        return self._of("K")

    @property
    def A(self) -> numpy.ndarray:
        """The matrix of (dx, dw)'."""
        return self._of("A")

    @property
    def table(self) -> Dict[str, numpy.ndarray]:
        """A row per eigenvalue, or per value of a family, as a dict of arrays."""
        if self.json["over"] is None:
            return columns(self.json["eigenvalues"], ["re", "im", "error", "times"])
        return columns(self.json["rows"], ["value", "verdict", "positive", "why"])

    @property
    def csv(self) -> str:
        """A row per eigenvalue, or per value of a family, as --csv writes it."""
        return self._document(CSV)

    def plot(self, ax: Any = None) -> Any:
        """A picture: the eigenvalues in the plane, or over a parameter.

        Parameters
        ----------
        ax : matplotlib.axes.Axes or True, optional
            Draw with Matplotlib, into these axes or, with True, into new ones: real parts against imaginary parts, or
            of a family real parts over the parameter.

        Returns
        -------
        Picture
            In SVG, which a notebook shows; with `ax` the axes.

        Examples
        --------
        >>> nhsym.system("double_pendulum").linearize().plot()
        <Picture of eigenvalues>
        """
        if ax is None:
            return Picture([self._document(SVG)], ["eigenvalues"])
        ax, over = _axes(ax), self.json["over"]
        if over is None:
            ax.plot(self.eigenvalues.real, self.eigenvalues.imag, "x")
        else:
            points = [(row["value"], z.real) for row, values in zip(self.json["rows"], self.eigenvalues) for z in values]
            ax.plot([value for value, _ in points], [real for _, real in points], ".")
        ax.set_xlabel("real part" if over is None else over)
        ax.set_ylabel("imaginary part" if over is None else "real part")
        return ax

    def __repr__(self) -> str:
        if self.json["over"] is None:
            return "<Linearization of %s: %s, %d eigenvalues>" % (self._problem.name, self.json["verdict"], len(self.eigenvalues))
        return "<Linearization of %s over %s: %d changes>" % (self._problem.name, self.json["over"], len(self.json["changes"]))


def _spectrum(row):
    """The eigenvalues of a row of the JSON, and bounds of their errors."""
    pairs = [(complex(z["re"], z["im"]), z["error"]) for z in row.get("eigenvalues", []) for _ in range(int(z["times"]))]
    return numpy.array([z for z, _ in pairs], dtype=complex), numpy.array([error for _, error in pairs])
