"""Results as objects: their JSON as attributes, their pages in a notebook, their numbers as arrays."""
import collections.abc
import functools
import html
import json
import threading
import warnings

import numpy

from ._arguments import explains_arguments, nearest, no_attribute, outside, velocity_meant
from ._calls import free_later
from ._library import AS_LATEX, AS_MATHML, CSV, HTML, JSON, LATEX, PLAIN, SVG, TEXT, ErrorRecord, UsageError, error_of, library, taken
from .formula import Formula

# Keys of the JSON documents whose strings are formulas, at whatever depth.
FORMULAS = {"expression", "in_velocities", "lagrangian", "energy", "rate", "constraint", "reaction", "Z0", "zeta", "W", "components", "components_with_gamma",
            "generators", "momentum_map", "equation", "current", "recognised", "metric", "potential"}


def _no_entry(key, names):
    near = velocity_meant(key, names) or nearest(key, names)
    return KeyError("there is no `%s`%s" % (key, "; did you mean `%s`?" % near if near else ", but " + ", ".join(names)))


@explains_arguments
class Record:
    """A part of a result: what its JSON has, as attributes; as a dict: `record.as_dict()`."""

    def __init__(self, content, coordinates=()):
        self._content, self._coordinates = content, coordinates

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            raise no_attribute(self, name, self._content) from None

    def __getitem__(self, key):
        return _wrapped(self._content[key], key in FORMULAS, self._coordinates)

    def __iter__(self):
        return iter(self._content)

    def __len__(self):
        return len(self._content)

    def __contains__(self, key):
        return key in self._content

    def keys(self):
        return self._content.keys()

    def items(self):
        return [(key, self[key]) for key in self._content]

    def as_dict(self):
        return self._content

    def __dir__(self):
        return sorted(set(super().__dir__()) | {key for key in self._content if key.isidentifier()})

    def __repr__(self):
        return "%s(%s)" % (type(self).__name__, ", ".join(self._content))


def _wrapped(value, formula, coordinates):
    if isinstance(value, dict):
        return Record({k: v for k, v in value.items()}, coordinates) if not formula else {k: _wrapped(v, True, coordinates) for k, v in value.items()}
    if isinstance(value, list):
        return [_wrapped(entry, formula, coordinates) for entry in value]
    return Formula(value, coordinates) if formula and isinstance(value, str) else value


def columns(rows, keys):
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


def _arrays(q, v, t, m):
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


@explains_arguments
class Result(Record):
    """A result of the library.  `text`, `html`, `latex` are the documents of the program; `json` is parsed."""

    _kind = ""       # of its functions in nhsym.h
    _formats = (TEXT, JSON, HTML, LATEX)

    def __init__(self, address, problem):
        self._address, self._problem, self._lock = address, problem, threading.Lock()
        self._coordinates = problem.coordinates

    def __del__(self):
        if getattr(self, "_address", None):
            free_later(getattr(library(), "nh_%s_free" % self._kind), self._address)

    def _document(self, form):
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
    def json(self):
        """The JSON document of the program, parsed."""
        return self._content

    @property
    def text(self):
        """What the program prints."""
        return self._document(TEXT)

    @property
    def html(self):
        """The page, complete in itself."""
        return self._document(HTML)

    @property
    def latex(self):
        """The LaTeX document, or the equations of a reduction."""
        return self._document(LATEX)

    def save(self, path):
        """Write the page (.html), the LaTeX document (.tex), the JSON (.json), the text (.txt), the table (.csv) or the picture (.svg) where it has one."""
        forms = {".html": HTML, ".tex": LATEX, ".json": JSON, ".txt": TEXT, ".csv": CSV, ".svg": SVG}
        ending = "." + str(path).rpartition(".")[2]
        if ending not in forms:
            raise UsageError("%s: no such kind of file" % path, "the name ends in " + ", ".join(forms))
        text = self._document(forms[ending])
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)

    def _repr_html_(self):
        if HTML not in self._formats:
            return "<pre>%s</pre>" % html.escape(self.text)
        return '<iframe srcdoc="%s" style="width:100%%;height:36em;border:1px solid #ccc"></iframe>' % html.escape(self.html, quote=True)

    def __str__(self):
        return self.text

    def __repr__(self):
        return "<%s of %s>" % (type(self).__name__, self._problem.name)


def _aligned(pairs):
    """Equations for a notebook, one to a line."""
    rows = [r"%s &= %s" % pair for pair in pairs if pair[1]]
    return "$$\\begin{aligned} %s \\end{aligned}$$" % r" \\ ".join(rows) if rows else None


# ---- an analysis ----

@explains_arguments
class Current(Record):
    """A conserved quantity: `name`, `meaning`, `formula`, `proved`, `for_all` (parameters), `independent`, `digits`, `drift`, and what its JSON has.
    Called with positions, velocities and times it gives values."""

    def __init__(self, analysis, index):
        self._analysis, self._index, self._coordinates = analysis, index, analysis._coordinates
        facts = library().nh_current_describe(analysis._address, index)
        self.name, self.meaning = facts.name.decode(), facts.meaning.decode()
        self.proved, self.for_all, self.independent = facts.proved, facts.for_all, facts.independent
        self.digits, self.drift = facts.digits, facts.drift

    @functools.cached_property
    def _content(self):
        return dict(self._analysis.json["currents"][self._index], formula=self.formula)

    def _written(self, syntax):
        with self._analysis._lock:
            return taken(library().nh_current_formula(self._analysis._address, self._index, syntax))

    @functools.cached_property
    def formula(self):
        """In t, coordinates, parameters and the velocities of coordinates; None: too long to be written."""
        text = self._written(PLAIN)
        return None if text is None else Formula(text, self._coordinates)

    def sympy(self, functions=False):
        """The formula for SymPy; see Formula.sympy."""
        if self.formula is None:
            raise UsageError("the formula of %s is too long to be written" % self.name, "set the option `written` to more")
        return self.formula.sympy(functions)

    def __call__(self, q, v, t=0.0):
        """Values at positions q and velocities v, one row per coordinate: shapes (m,), (m, count), ..; nan where it is not defined."""
        q, v, t, count, shape = _arrays(q, v, t, len(self._coordinates))
        out = numpy.empty(count)
        with self._analysis._lock:
            good = library().nh_current_values(self._analysis._address, self._index, count, None if t is None else t.ctypes.data, q.ctypes.data, v.ctypes.data,
                                               out.ctypes.data)
        if not good:
            raise UsageError("%s cannot be written in the velocities of coordinates" % self.name, "see `expression`, which is in the chart's velocities")
        return out.reshape(shape) if shape else float(out[0])

    def along(self, simulation):
        """Its values along a motion."""
        q, v = simulation.states()
        return self(q, v, simulation.table["t"])

    def _repr_latex_(self):
        latex = self._written(AS_LATEX)
        return "$%s$" % latex if latex else None

    def _repr_html_(self):
        mathml = self._written(AS_MATHML)
        return '<math xmlns="http://www.w3.org/1998/Math/MathML">%s</math>' % mathml if mathml else "<code>%s</code>" % self.name

    def __repr__(self):
        return "<%s = %s%s>" % (self.name, self.formula or "(long)", ", " + self.meaning if self.meaning else "")

    def values(self):
        return [self[key] for key in self]

    def get(self, key, default=None):
        return self[key] if key in self else default


# So that pandas.DataFrame(analysis.currents) has a column for each key.
collections.abc.Mapping.register(Current)


@explains_arguments
class Analysis(Result):
    """Currents and their symmetries: `currents`, `verdict`, `search`, `independent`, `most`, `equations`, `table`, and what the JSON has."""

    _kind = "analysis"

    @functools.cached_property
    def currents(self):
        return [Current(self, i) for i in range(library().nh_analysis_currents(self._address))]

    def __getitem__(self, key):
        """A current by its name or number, or a part of the JSON by its key."""
        if isinstance(key, int):
            if not -len(self.currents) <= key < len(self.currents):
                raise IndexError("there is no current number %d; there are %d, numbered from 0" % (key, len(self.currents)))
            return self.currents[key]
        named = [current for current in self.currents if current.name == key]
        if named or key in self._content:
            return named[0] if named else super().__getitem__(key)
        raise _no_entry(key, [current.name for current in self.currents])

    @property
    def verdict(self):
        return library().nh_analysis_verdict(self._address).decode()

    @property
    def search(self):
        return library().nh_analysis_search(self._address).decode()

    @property
    def independent(self):
        return library().nh_analysis_independent(self._address)

    @property
    def most(self):
        return library().nh_analysis_most(self._address)

    @property
    def equations(self):
        """The equations of motion on the constraint submanifold: {velocity: rate}."""
        return {entry["velocity"]: Formula(entry["rate"], self._coordinates) for entry in self.json["reduced_equations"] if entry["rate"]}

    @property
    def table(self):
        rows = [{"name": c.name, "formula": c.formula, "meaning": c.meaning, "proved": c.proved, "for_all": c.for_all, "independent": c.independent,
                 "digits": c.digits, "drift": c.drift} for c in self.currents]
        return columns(rows, ["name", "formula", "meaning", "proved", "for_all", "independent", "digits", "drift"])

    def _repr_latex_(self):
        return _aligned((r"\text{%s}" % c.name, c._written(AS_LATEX)) for c in self.currents)

    def __repr__(self):
        return "<Analysis of %s: %s, %d independent currents of at most %d, search %s>" % (self._problem.name, self.verdict, self.independent, self.most, self.search)


# ---- motions ----

@explains_arguments
class Simulation(Result):
    """A motion: `table` is a dict of arrays, time first; `complete`, `warnings` and what the JSON has."""

    _kind = "simulation"
    _formats = (TEXT, JSON, HTML)

    def __init__(self, address, problem):
        super().__init__(address, problem)
        if not self.complete:
            warnings.warn("the motion of %s ended early, at t = %g: %s" % (problem.name, self.table["t"][-1], "; ".join(self.json["warnings"])), RuntimeWarning,
                          stacklevel=outside())

    @functools.cached_property
    def table(self):
        rows, table = library().nh_simulation_rows(self._address), {}
        for i in range(library().nh_simulation_columns(self._address)):
            table[library().nh_simulation_column(self._address, i).decode()] = out = numpy.empty(rows)
            library().nh_simulation_read(self._address, i, out.ctypes.data)
        return table

    def __getitem__(self, key):
        """A column by its name, phi' or, as in a CSV file, phi_dot; or a part of the JSON by its key."""
        for name in (key, key[:-4] + "'" if str(key).endswith("_dot") else key):
            if name in self.table:
                return self.table[name]
        if key in self._content:
            return super().__getitem__(key)
        raise _no_entry(key, self.table)

    @property
    def section_table(self):
        """The points of `simulate(section=..)`, as `table` has the motion."""
        section = self.json["section"]
        return {"t": numpy.array(section["time"]), **{name: numpy.array(column, float) for name, column in section["values"].items()}}

    def states(self):
        """Positions and velocities of all coordinates, two arrays with one row per coordinate."""
        missing = [name for q in self._coordinates for name in (q, q + "'") if name not in self.table]
        if missing:
            raise UsageError("the motion was watched without %s" % ", ".join(missing), "simulate without `watch`, or watch them")
        return tuple(numpy.array([self.table[q + tail] for q in self._coordinates]) for tail in ("", "'"))

    def plot(self, x="t", *y):
        """A picture (SVG) of columns against another; `plot("x", "y")` is a path.  In a notebook it is shown."""
        names = list(self.table)
        for name in (x,) + y:
            if name not in names:
                near = velocity_meant(name, names) or nearest(name, names)
                raise UsageError("there is no column `%s`" % name, "did you mean `%s`?" % near if near else "the columns are " + ", ".join(names))
        y = y or (names[1],)
        return Picture([taken(library().nh_simulation_svg(self._address, names.index(x), names.index(name))) for name in y], ["%s against %s" % (name, x) for name in y])

    def __repr__(self):
        return "<Simulation of %s: %d rows, %s>" % (self._problem.name, len(self.table["t"]), ", ".join(self.table))


@explains_arguments
class Picture:
    """One or more SVG pictures, one below the other."""

    def __init__(self, pictures, words):
        self.pictures, self.words = pictures, words

    def _repr_svg_(self):
        return self.pictures[0] if len(self.pictures) == 1 else None

    def _repr_html_(self):
        return "".join("<div>%s</div>" % picture for picture in self.pictures) if len(self.pictures) > 1 else None

    def __repr__(self):
        return "<Picture of %s>" % ", ".join(self.words)

    def save(self, path):
        """Write the picture; several get numbers: plot.svg, plot-2.svg."""
        stem, dot, ending = str(path).rpartition(".")
        for i, picture in enumerate(self.pictures):
            with open(path if i == 0 else "%s-%d%s%s" % (stem, i + 1, dot, ending), "w", encoding="utf-8") as file:
                file.write(picture)


@explains_arguments
class Benchmark(Result):
    """Integrators compared: `table` has a row per run, with the observed order of methods of fixed steps; `csv` the same as text; `plot()`; and what the JSON has."""

    _kind = "benchmark"

    @property
    def csv(self):
        """A row per run, as --csv writes it."""
        return self._document(CSV)

    def plot(self):
        """A picture (SVG): error against time.  In a notebook it is shown."""
        return Picture([self._document(SVG)], ["error against time"])

    @property
    def table(self):
        keys = ["method", "formulation", "tolerance", "step", "error", "drift", "seconds", "evaluations", "order", "observed_order", "status", "reduced", "front", "note"]
        return columns(self.json["motion"], keys)


@explains_arguments
class Linearization(Result):
    """The linear equations of motion M dw' + C dw + K dx = 0 at a state: `eigenvalues`, `errors`, `M`, `C`, `K`, `A`, `verdict` and what the JSON has; over a family of
    states `table` (a row per value), `changes`, and `at(i)`, the equations at value number i."""

    _kind = "linearized"

    def _of(self, key, row=None):
        return numpy.array((self.json if row is None else self.json["rows"][row])[key], dtype=float)

    def at(self, i):
        """M, C, K, A and the eigenvalues at value number i of a family, by name."""
        row = self.json["rows"][i]
        if "eigenvalues" not in row:
            raise UsageError("there are no linear equations at %s = %r: %s" % (self.json["over"], row["value"], row["why"]), "")
        return dict({key: self._of(key, i) for key in "MCKA"}, eigenvalues=_spectrum(row)[0])

    @property
    def eigenvalues(self):
        """Complex numbers, as often as they occur; of a family an array per value."""
        return _spectrum(self.json)[0] if self.json["over"] is None else [_spectrum(row)[0] for row in self.json["rows"]]

    @property
    def errors(self):
        """Bounds of the errors of `eigenvalues`."""
        return _spectrum(self.json)[1] if self.json["over"] is None else [_spectrum(row)[1] for row in self.json["rows"]]

    @property
    def M(self):
        return self._of("M")

    @property
    def C(self):
        return self._of("C")

    @property
    def K(self):
        return self._of("K")

    @property
    def A(self):
        """The matrix of (dx, dw)'."""
        return self._of("A")

    @property
    def table(self):
        if self.json["over"] is None:
            return columns(self.json["eigenvalues"], ["re", "im", "error", "times"])
        return columns(self.json["rows"], ["value", "verdict", "positive", "why"])

    @property
    def csv(self):
        """A row per eigenvalue, or per value of a family, as --csv writes it."""
        return self._document(CSV)

    def plot(self):
        """A picture (SVG): the eigenvalues in the plane, or over a parameter.  In a notebook it is shown."""
        return Picture([self._document(SVG)], ["eigenvalues"])

    def __repr__(self):
        if self.json["over"] is None:
            return "<Linearization of %s: %s, %d eigenvalues>" % (self._problem.name, self.json["verdict"], len(self.eigenvalues))
        return "<Linearization of %s over %s: %d changes>" % (self._problem.name, self.json["over"], len(self.json["changes"]))


def _spectrum(row):
    """The eigenvalues of a row of the JSON, and bounds of their errors."""
    pairs = [(complex(z["re"], z["im"]), z["error"]) for z in row.get("eigenvalues", []) for _ in range(int(z["times"]))]
    return numpy.array([z for z, _ in pairs], dtype=complex), numpy.array([error for _, error in pairs])


# ---- symmetry ----

class Reduction(Result):
    """The symmetry group and the reduced equations: `group`, `stages` and what the JSON has."""

    _kind = "reduction"

    @property
    def equations(self):
        """Of each stage: {shape coordinate or velocity: rate}."""
        return [{e["of"]: Formula(e["rate"], self._coordinates) for e in stage.get("equations", []) if isinstance(e.get("rate"), str)} for stage in self.json["stages"]]

    @property
    def table(self):
        return columns(self.json["stages"], ["kind", "group", "agreement_with_full", "speedup"])

    def _repr_latex_(self):
        return _aligned((r"\frac{d}{dt}\,%s" % (Formula(of).latex or of), rate.latex) for stage in self.equations[:1] for of, rate in stage.items())

    def __repr__(self):
        return "<Reduction of %s: group %s, %d stages>" % (self._problem.name, self.json["group"]["name"], len(self.json["stages"]))


class Verification(Result):
    """Of a current or a field: true where it is conserved, or a symmetry; `proved`, `counterexample` and what the JSON has."""

    _kind = "verification"
    _formats = (TEXT, JSON, HTML)

    def __bool__(self):
        return library().nh_verification_holds(self._address)

    @property
    def holds(self):
        return bool(self)

    @property
    def proved(self):
        return library().nh_verification_proved(self._address)

    def __repr__(self):
        return "<Verification: %s>" % (("holds, proved" if self.proved else "holds") if self else "does not hold")


class Classification(Result):
    """Special values of parameters: `special`, `degenerate`, `table` (a row per special value, and per real value of a root) and what the JSON has."""

    _kind = "classified"
    _formats = (TEXT, JSON, HTML, LATEX)

    @property
    def table(self):
        rows = []
        for entry in self.json["special"]:
            where = entry["where"]
            words = ", ".join("%s = %s" % pair for pair in where.items()) if isinstance(where, dict) else str(where)
            rows += [dict(entry, where=words, value=real) for real in entry.get("real_values") or [None]]
        return columns(rows, ["where", "value", "dimension", "from_degree", "proved"])

    def __repr__(self):
        return "<Classification of %s over %s: %d special values>" % (self._problem.name, ", ".join(self.json["over"]), len(self.json["special"]))
