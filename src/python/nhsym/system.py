"""Systems: by name, from a file, from text, or built in Python."""
from __future__ import annotations

import itertools
import os
import threading
from typing import Any, Dict, Mapping, Optional, Tuple, Union

import numpy

from ._arguments import explained, explains_arguments, no_attribute, pairs_of, unfit
from ._library import Comparison, ErrorRecord, InputError, UsageError, error_of, library, taken
from ._questions import MOST, Code, Problem, Rates, axis_of, bytes_of, drive, file_text, input_texts, list_text, name_of, of_analysis, pairs_text, positive, robot_text, times_until
from ._types import Expression, Expressions, Input, Names, Numbers, Pairs, Progress
from .analysis import Analysis
from .formula import text_of
from .motion import Benchmark, Linearization, Simulation
from .results import Classification, Reduction, Verification, array_of, arrays_of, columns


@explained
def system(source: Union[str, os.PathLike], *, wheels: Any = None, base: Optional[str] = None, set: Optional[Pairs] = None, velocities: Optional[str] = None,
           analysis: Union[None, bool, str, os.PathLike] = None, options: Optional[Pairs] = None) -> System:
    """A system by its name, from a file, or from a text.

    Parameters
    ----------
    source : str or path
        A name ("sleigh"), a file (a path, or a name that ends in .yaml or .urdf), or a text of several lines.
    wheels : list or mapping, optional
        Of a robot description: links that roll, ["left", "right"], or with radii, {"left": 0.1}.
    base : str, optional
        Of a robot description: "fixed", "planar", "floating" or "free".
    set : mapping or str, optional
        Values of parameters, {"m": 2}.
    velocities : str, optional
        "auto", "quasi" or "coordinates".
    analysis : str, path or False, optional
        An analysis file, or its text; False for none.
    options : mapping or str, optional
        Numerical options (docs/options.md), {"seed": 3}.

    Returns
    -------
    System

    Examples
    --------
    >>> nhsym.system("sleigh", set={"m": 3})
    <System sleigh: coordinates phi, x, y; m = 3, a = 1, k = 2>
    """
    settings = dict(set=set, velocities=velocities, analysis=analysis, options=options)
    if wheels or base:
        return System(_question={"system": os.path.basename(os.fspath(source)), "system_text": robot_text(source, wheels, base)}, **settings)
    if isinstance(source, os.PathLike):
        path = os.fspath(source)
        return System(_question={"system": path if "/" in path else "./" + path}, **settings)
    if not isinstance(source, str):
        raise UsageError("a system is a name, a path or a text, found %r" % (source,), "nhsym.System(..) builds one in Python")
    if "\n" in source:
        return System(_question={"system_text": source}, **settings)
    return System(_question={"system": source}, **settings)


@explained
def systems() -> Dict[str, str]:
    """The systems that `system` knows by name, the shipped ones and those on NHSYM_PATH.

    Returns
    -------
    dict
        {name: title}

    Examples
    --------
    >>> nhsym.systems()["sleigh"]
    'Chaplygin sleigh'
    """
    error = ErrorRecord()
    lines = taken(library().nh_systems(error))
    if lines is None:
        raise error_of(error)
    return {name: title.strip() for name, _, title in (line.partition(" ") for line in lines.splitlines())}


@explains_arguments
class System:
    """A mechanical system and the questions about it.

    Expressions are texts in the language of system files, or SymPy expressions in which coordinates are functions of t
    and velocities their derivatives.

    Parameters
    ----------
    coordinates : iterable or mapping
        Names, or types by names: {"phi": "angle", "x": "length"}.
    lagrangian : expression
        In t, coordinates, velocities (x') and parameters.
    parameters : mapping
        {name: value}
    constraints : expression or list
        Equations, "y'*cos(phi) = x'*sin(phi)", or what is 0.
    forces : mapping
        {coordinate: force}
    definitions : mapping
        {name: expression}, names that may stand in the others.
    quasi_velocities : mapping, optional
        {"names": ["v"], "map": {"x'": "v*cos(phi)"}}
    domain : mapping, optional
        Where states are sampled: {"x": [-1, 1]}.
    name, title : str
        For messages and pages.
    set, velocities, analysis, options
        As for `system`.
    **more
        Other keys of system files.

    Examples
    --------
    >>> skate = nhsym.System(coordinates={"phi": "angle", "x": "length", "y": "length"}, parameters={"m": 2, "J": 0.5},
    ...                      lagrangian="m/2*(x'^2 + y'^2) + J/2*phi'^2", constraints=["y'*cos(phi) = x'*sin(phi)"])
    >>> skate.verify("J*phi'")
    <Verification: holds, proved>
    """

    def __init__(self, coordinates: Any = None, lagrangian: Optional[Expression] = None, parameters: Any = (), constraints: Expressions = (), forces: Any = (),
                 definitions: Any = (), quasi_velocities: Any = None, domain: Any = None, name: str = "system", title: Optional[str] = None, *,
                 set: Optional[Pairs] = None, velocities: Optional[str] = None, analysis: Union[None, bool, str, os.PathLike] = None,
                 options: Optional[Pairs] = None, _question: Any = None, **more: Any) -> None:
        if _question is None:
            if coordinates is None:
                raise UsageError("a system needs coordinates", 'nhsym.System(coordinates=["x"], lagrangian="x\'^2/2"), or nhsym.system("sleigh") for one by name')
            text = file_text(name, coordinates, lagrangian, parameters, constraints, forces, definitions, quasi_velocities, domain, title, more)
            _question = {"system": name, "system_text": text}
        self._question = dict(_question, **{key: value for key, value in dict(set=pairs_text("set", set), velocities=velocities, options=pairs_text("options", options)).items() if value is not None},
                              **of_analysis(analysis))
        self._lock = threading.Lock()
        self.problem = Problem(self._question)

    @property
    def name(self) -> str:
        """As the file says it."""
        return self.problem.name

    @property
    def coordinates(self) -> Tuple[str, ...]:
        """Their names, in the order of the file."""
        return self.problem.coordinates

    @property
    def parameters(self) -> Dict[str, float]:
        """Their values, {name: value}."""
        return dict(self.problem.parameters)

    @property
    def text(self) -> str:
        """The system file of one that was built here."""
        if "system_text" in self._question:
            return self._question["system_text"]
        raise InputError("the text of a shipped system is in its file", "nhsym show %s" % self.name)

    def scan(self, over: Mapping[Any, Any], number: Any) -> Dict[str, numpy.ndarray]:
        """Numbers at every point of a grid of values of parameters.

        Parameters
        ----------
        over : mapping
            Values of parameters, {"k": [1, 2, 3]} or {"k": "1:3:21"} (lowest, highest, how many).
        number : callable, or mapping of names to callables
            What is asked of the system at each point.

        Returns
        -------
        dict of arrays
            A row per point; the columns are the parameters and `number`, or its names.

        Examples
        --------
        >>> table = nhsym.system("double_pendulum").scan({"g": "-1:1:2"}, lambda pendulum: pendulum.linearize().verdict)
        >>> list(table["g"]), list(table["number"])
        ([-1.0, 1.0], ['unstable', 'marginal'])
        """
        axes = {name_of(key): axis_of(name_of(key), values) for key, values in pairs_of("over", over, 'give {"k": [1, 2]} or {"k": "1:2:11"}')}
        asked = number if hasattr(number, "items") else {"number": number}
        if not all(callable(function) for function in asked.values()):
            raise unfit("number", number, "give a function of the system, lambda system: system.analyze().independent, or several by name")
        rows = []
        for point in itertools.product(*axes.values()):
            there = self.set(dict(zip(axes, point)))
            rows.append({**{name: there.parameters[name] for name in axes}, **{name: function(there) for name, function in asked.items()}})
        return columns(rows, [*axes, *asked])

    def set(self, values: Any = (), /, **parameters: Expression) -> System:
        """The same system with other values of parameters.

        Parameters
        ----------
        values : mapping, optional
            {name or symbol: value}
        **parameters
            name=value

        Returns
        -------
        System

        Examples
        --------
        >>> nhsym.system("sleigh").set(k=3).parameters["k"]
        3.0
        """
        given = {name_of(key): value for key, value in pairs_of("values", values or {}, "set(k=3), or set({k: 3})")}
        return self._with({"set": ", ".join(filter(None, [self._question.get("set"), pairs_text("set", {**given, **parameters})]))})

    def _with(self, question):
        other = object.__new__(System)
        other._question = dict(self._question, **question)
        other._lock = threading.Lock()
        other.problem = Problem(other._question)
        return other

    def _ask(self, settings, inputs=()):
        """The problem of a question about this system."""
        given = {key: value for key, value in settings.items() if value is not None}
        for key in ("until", "step", "accuracy"):
            if key in given:
                given[key] = positive(key, given[key])
        if "options" in given:
            given["options"] = ", ".join(filter(None, [self._question.get("options"), pairs_text("options", given["options"])]))
        return drive(Problem(dict(self._question, **given)), inputs) if given or inputs else self.problem

    # ---- questions ----

    def analyze(self, accuracy: Optional[float] = None, until: Optional[float] = None, options: Optional[Pairs] = None, progress: Optional[Progress] = None,
                *, absence: bool = False) -> Analysis:
        """Currents and their symmetries.

        Parameters
        ----------
        accuracy : float, optional
            The largest allowed error of motions.
        until : float, optional
            The end of motions; left out: that of the files, or 10.
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.
        absence : bool
            All motions, levels and methods for the question whether there is any other integral, not only the cheap ones.

        Returns
        -------
        Analysis

        Examples
        --------
        >>> nhsym.system("damped_oscillator").analyze()
        <Analysis of damped_oscillator: FOUND, 2 independent currents of at most 2, search complete>
        """
        if absence:
            options = ", ".join(filter(None, [pairs_text("options", options), "absence=1"]))
        p = self._ask(dict(accuracy=accuracy, until=until, options=options))
        return p.call(lambda error: library().nh_analyze(p.address, error), progress, lambda a: Analysis(a, p))

    def verify(self, current: Optional[Expression] = None, field: Any = None, options: Optional[Pairs] = None, progress: Optional[Progress] = None) -> Verification:
        """Is a function conserved, or a field a symmetry?

        Parameters
        ----------
        current : expression
            Is it conserved?
        field : mapping or str
            Is it a symmetry?  {"Z0": 1, "x": "x'"}, or "Z0=1; x=x'".
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.

        Returns
        -------
        Verification
            True where it holds.

        Examples
        --------
        >>> bool(nhsym.system("sleigh").verify("m*v"))
        False
        >>> nhsym.system("free_particle").verify(field={"y": 1})
        <Verification: holds, proved>
        """
        if (current is None) == (field is None):
            raise UsageError("verify what?", 'verify("m*x\'"), or verify(field={"x": 1})')
        p = self._ask(dict(options=options))
        parts = [] if field is None or isinstance(field, str) else pairs_of("field", field, """give components, {"x": 1}, or a text, "Z0=1; x=x'\"""")
        text = bytes_of(text_of(current) if field is None else field if isinstance(field, str) else "; ".join("%s=%s" % (name_of(k), text_of(e)) for k, e in parts))
        ask = library().nh_verify_current if field is None else library().nh_verify_field
        return p.call(lambda error: ask(p.address, text, error), progress, lambda a: Verification(a, p))

    def simulate(self, initial: Optional[Pairs] = None, until: Optional[float] = None, step: Optional[float] = None, accuracy: Optional[float] = None,
                 method: Optional[str] = None, watch: Optional[Expressions] = None, options: Optional[Pairs] = None, progress: Optional[Progress] = None,
                 events: Optional[Names] = None, section: Optional[Expression] = None, project: bool = False,
                 inputs: Optional[Mapping[Any, Input]] = None) -> Simulation:
        """A motion.

        Parameters
        ----------
        initial : mapping or str, optional
            A state, {"phi": 0, "omega": 2}; left out: one on the constraints.
        until : float, optional
            The end of motions; left out: that of the files, or 10.
        step : float, optional
            Between rows of the table; left out: a hundredth of the time.
        accuracy : float, optional
            The largest allowed error of motions.
        method : str, optional
            An integrator that `nhsym explain methods` lists; left out: the one that suits.
        watch : list or mapping, optional
            Columns besides the time: ["y"], or {"T": "m/2*v^2"}.
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.
        events : list of str, optional
            Zeros that are recorded, or end the motion: ["y = 0, falling, stop"].
        section : expression, optional
            A Poincare section, "x", whose points are `Simulation.section_table`.
        project : bool
            An initial state that violates the constraints is moved onto them.
        inputs : mapping, optional
            Parameters as functions of time: {"u": "sin(t)"}, an expression of t and the other parameters; times and
            values, {"u": ([0, 1, 2], [0, 5, 5])}, the broken line, constant before and after; or a function of Python,
            which is evaluated at 1000 times until the end, between which it is a broken line.

        Returns
        -------
        Simulation

        Examples
        --------
        >>> motion = nhsym.system("sleigh").simulate(initial={"omega": 2}, until=5)
        >>> list(motion.table)[:4], len(motion["t"])
        (['t', 'phi', 'x', 'y'], 101)
        """
        p = self._ask(dict(initial=pairs_text("initial", initial), until=until, step=step, accuracy=accuracy, method=method, watch=list_text("watch", watch), options=options, project=project or None),
                      input_texts(inputs or {}, lambda name: times_until(name, until, initial)))
        events, section = bytes_of(list_text("events", events, "; ")), bytes_of(section if section is None else text_of(section))
        return p.call(lambda error: library().nh_simulate_zeros(p.address, events, section, error), progress, lambda a: Simulation(a, p))

    def reduce(self, initial: Optional[Pairs] = None, until: Optional[float] = None, accuracy: Optional[float] = None, options: Optional[Pairs] = None, progress: Optional[Progress] = None) -> Reduction:
        """The symmetry group and the reduced equations.

        Parameters
        ----------
        initial : mapping or str, optional
            A state, {"phi": 0, "omega": 2}; left out: one on the constraints.
        until : float, optional
            The end of motions; left out: that of the files, or 10.
        accuracy : float, optional
            The largest allowed error of motions.
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.

        Returns
        -------
        Reduction

        Examples
        --------
        >>> nhsym.system("knife_edge").reduce().group.dimension > 0
        True
        """
        p = self._ask(dict(initial=pairs_text("initial", initial), until=until, accuracy=accuracy, options=options))
        return p.call(lambda error: library().nh_reduce(p.address, error), progress, lambda a: Reduction(a, p))

    def classify(self, over: Names, shape: bool = False, options: Optional[Pairs] = None, progress: Optional[Progress] = None) -> Classification:
        """The values of parameters at which there are more conservation laws.

        Parameters
        ----------
        over : str or list
            Parameters.
        shape : bool
            Only currents whose coefficients do not depend on cyclic coordinates.
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.

        Returns
        -------
        Classification

        Examples
        --------
        >>> plane = nhsym.System(coordinates=["x", "y"], parameters={"k": 3}, lagrangian="(x'^2 + y'^2)/2 - (x^2 + k*y^2)/2")
        >>> 1.0 in plane.classify("k", options={"degree": 2}).table["value"]
        True
        """
        p = self._ask(dict(options=options))
        return p.call(lambda error: library().nh_classify_over(p.address, bytes_of(list_text("over", over)), bool(shape), error), progress, lambda a: Classification(a, p))

    def benchmark(self, seconds: Optional[float] = None, initial: Optional[Pairs] = None, until: Optional[float] = None, options: Optional[Pairs] = None, progress: Optional[Progress] = None,
                  method: Optional[Names] = None, robustness: bool = False, over: Optional[Pairs] = None, project: bool = False) -> Benchmark:
        """Integrators compared on one motion.

        Parameters
        ----------
        seconds : float, optional
            For the measurements; left out: 5.
        initial : mapping or str, optional
            A state, {"phi": 0, "omega": 2}; left out: one on the constraints.
        until : float, optional
            The end of motions; left out: that of the files, or 10.
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.
        method : str or list, optional
            Only these, which `nhsym explain methods` lists.
        robustness : bool
            Also maps of where methods fail.
        over : mapping or str, optional
            One such map, over one or two ranges: {"a": "1e-9:1"}.
        project : bool
            An initial state that violates the constraints is moved onto them.

        Returns
        -------
        Benchmark

        Examples
        --------
        >>> comparison = nhsym.system("damped_oscillator").benchmark(0.1, method="rk8pd", initial={"x": 1}, until=1)
        >>> len(comparison.table["error"]) > 2
        True
        """
        p = self._ask(dict(initial=pairs_text("initial", initial), until=until, options=options, project=project or None))
        words = [bytes_of(list_text("method", method)), bytes_of(pairs_text("over", over))]
        asked = Comparison(0 if seconds is None else positive("seconds", seconds), words[0], bool(robustness), words[1])
        return p.call(lambda error: library().nh_benchmark_methods(p.address, asked, error), progress, lambda a: Benchmark(a, p))

    def linearize(self, at: Optional[Pairs] = None, over: Optional[Pairs] = None, project: bool = False, options: Optional[Pairs] = None, progress: Optional[Progress] = None) -> Linearization:
        """The linear equations of motion at a state, or along a family of states.

        Parameters
        ----------
        at : mapping or str, optional
            The state, {"x'": 5}; what is left out is 0, or follows from the constraints.
        over : mapping or str, optional
            Values of a parameter, a coordinate or a velocity: {"x'": "0:10:101"}.
        project : bool
            Positions and velocities that violate the constraints are moved onto them.
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.

        Returns
        -------
        Linearization

        Examples
        --------
        >>> nhsym.system("double_pendulum").linearize({"p": "pi", "q": "pi"}).verdict
        'unstable'
        """
        p = self._ask(dict(initial=pairs_text("at", at), options=options, project=project or None))
        over = bytes_of(pairs_text("over", over))
        return p.call(lambda error: library().nh_linearize(p.address, over, error), progress, lambda a: Linearization(a, p))

    # ---- functions in other languages ----

    def export(self, to: str, folder: Union[None, str, os.PathLike] = None, of: Optional[Names] = None, input: Optional[Names] = None,
               name: Optional[str] = None, options: Optional[Pairs] = None, progress: Optional[Progress] = None) -> Any:
        """Equations, currents and reductions as code that needs no nhsym.

        Parameters
        ----------
        to : str
            "c", "python", "sympy", "matlab", "js", "latex" or "json".
        folder : str or path, optional
            Where the files are written.
        of : str or list, optional
            Parts, ["equations", "currents"]; left out: all.
        input : str or list, optional
            Parameters that a controller changes, ["u"].
        name : str, optional
            What all names begin with.
        options : mapping or str, optional
            Numerical options (docs/options.md), {"seed": 3}.
        progress : callable, optional
            progress(doing, part) is called now and then; part is None where it is not known.

        Returns
        -------
        str, or list of paths
            The text; with `folder` the paths of the files.

        Examples
        --------
        >>> code = nhsym.system("damped_oscillator").export("python", of="equations")
        >>> "def accelerations(" in code
        True
        """
        if not isinstance(to, str):
            raise unfit("to", to, "give a language: c, python, sympy, matlab, js, latex or json")
        p = self._ask(dict(options=options))
        words = [bytes_of(word) for word in (to, list_text("of", of), list_text("input", input), None if name is None else text_of(name))]
        code = p.call(lambda error: library().nh_export_functions(p.address, *words, error), progress, lambda a: Code(a))
        return code.text if folder is None else code.write(folder)

    # ---- equations of motion on arrays ----

    _written: Any = None  # the equations that were asked for last, and their inputs

    def _rates(self, inputs, t):
        def times(name):
            at = numpy.unique(array_of("t", t))
            if len(at) > MOST:
                raise UsageError("the input %s is a function of Python, and there are %d times; %d are allowed" % (name, len(at), MOST), "write it as an expression of t or as a table")
            return at
        given = input_texts(inputs or {}, times)
        if self._written is None or self._written[0] != given:
            self._written = given, Rates(drive(Problem(self._question), given) if given else self.problem)
        return self._written[1]

    def accelerations(self, q: Numbers, v: Numbers, t: Numbers = 0.0, inputs: Optional[Mapping[Any, Input]] = None) -> numpy.ndarray:
        """The accelerations of all coordinates, by the equations of motion.

        Parameters
        ----------
        q, v : array of shape (m,), (m, count), ..
            Positions and velocities that satisfy the constraints, one row per coordinate.
        t : float or array
            Times, of the other axes' shape.
        inputs : mapping, optional
            Parameters as functions of time, as for `simulate`; a function of Python is evaluated at the times t.

        Returns
        -------
        array
            Of the shape of q; nan where they are not determined.

        Examples
        --------
        >>> nhsym.system("sleigh").accelerations([0, 0, 0], [2, 0, 0])
        array([0., 4., 0.])
        """
        m = len(self.coordinates)
        q, v, t, count, shape = arrays_of(q, v, t, m)
        out = numpy.empty((m, count))
        with self._lock:
            rates = self._rates(inputs, 0.0 if t is None else t)
            library().nh_rates_at(rates.address, count, None if t is None else t.ctypes.data, q.ctypes.data, v.ctypes.data, out.ctypes.data)
        return out.reshape((m,) + shape)

    def right_hand_side(self, t: Numbers, y: Numbers, inputs: Optional[Mapping[Any, Input]] = None) -> numpy.ndarray:
        """y' of y = (positions, velocities), as scipy.integrate.solve_ivp takes it, also vectorized.

        Parameters
        ----------
        t : float or array
            Times.
        y : array of shape (2 m,), (2 m, count), ..
            Positions, then velocities.
        inputs : mapping, optional
            As for `accelerations`.

        Returns
        -------
        array
            Of the shape of y.

        Examples
        --------
        >>> nhsym.system("sleigh").right_hand_side(0, [0, 0, 0, 2, 0, 0])
        array([2., 0., 0., 0., 4., 0.])
        """
        y = array_of("y", y)
        m = len(self.coordinates)
        if y.ndim == 0 or y.shape[0] != 2 * m:
            raise UsageError("y has the shape %s" % (y.shape,), "give %d positions, then as many velocities" % m)
        return numpy.concatenate([y[m:], self.accelerations(y[:m], y[m:], t, inputs)])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        if name in ("code", "to_c", "codegen", "generate_code"):
            raise AttributeError("there is no `%s` here; did you mean `export(\"c\")`?" % name)
        raise no_attribute(self, name, [word for word in dir(self) if not word.startswith("_")])

    def __repr__(self) -> str:
        return "<System %s: coordinates %s; %s>" % (self.name, ", ".join(self.coordinates), ", ".join("%s = %g" % p for p in self.parameters.items()))
