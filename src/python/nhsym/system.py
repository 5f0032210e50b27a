"""Systems: by name, from a file, from text, or built in Python."""
import ctypes
import functools
import json
import os
import pathlib
import threading

import numpy

from ._arguments import entries_of, explained, explains_arguments, no_attribute, number_of, pairs_of, unfit
from ._calls import Context, Interrupted, free_later
from ._library import Comparison, ErrorRecord, InputError, Question, UsageError, error_of, library, taken
from .formula import text_of
from .results import Analysis, Benchmark, Classification, Linearization, Reduction, Simulation, Verification, _arrays, array_of


def _robot(source, wheels, base):
    """The text of a file that includes this one and names wheels, ["left", "right"] or {"left": 0.1, "right": None}, and the kind of the base."""
    path = os.path.abspath(os.fspath(source))
    entries = wheels.items() if hasattr(wheels, "items") else [(wheel, None) for wheel in ([wheels] if isinstance(wheels, str) else entries_of("wheels", wheels or (), 'give links, ["left"], or radii, {"left": 0.1}'))]
    content = {"include": path, "wheels": [link if radius is None else {"body": link, "radius": radius} for link, radius in entries], "base": base}
    return "".join("%s: %s\n" % (key, json.dumps(value, ensure_ascii=False)) for key, value in content.items() if value)


@explained
def system(source, *, wheels=None, base=None, set=None, velocities=None, analysis=None, options=None):
    """The system of this name ("sleigh"), of this file (a path, or a name that ends in .yaml or .urdf), or of this text (of several lines).

    Of a robot description: wheels=["left", "right"] or {"left": 0.1} (with radius), base="fixed", "planar" or "floating".

    Settings: set={"m": 2}, velocities="quasi", analysis="file.yaml" (or a text; False: none), options={"seed": 3}."""
    settings = dict(set=set, velocities=velocities, analysis=analysis, options=options)
    if wheels or base:
        return System(_question={"system": os.path.basename(os.fspath(source)), "system_text": _robot(source, wheels, base)}, **settings)
    if isinstance(source, os.PathLike):
        path = os.fspath(source)
        return System(_question={"system": path if "/" in path else "./" + path}, **settings)
    if not isinstance(source, str):
        raise UsageError("a system is a name, a path or a text, found %r" % (source,), "nhsym.System(..) builds one in Python")
    if "\n" in source:
        return System(_question={"system_text": source}, **settings)
    return System(_question={"system": source}, **settings)


@explained
def systems():
    """The systems that `system` knows by name, the shipped ones and those on NHSYM_PATH: {name: title}."""
    error = ErrorRecord()
    lines = taken(library().nh_systems(error))
    if lines is None:
        raise error_of(error)
    return {name: title.strip() for name, _, title in (line.partition(" ") for line in lines.splitlines())}


# ---- system files ----

def _name(coordinate):
    """Of a string, a SymPy symbol, a function of t, or its derivative."""
    return text_of(coordinate)


def _named(what, entries, second):
    """A mapping or a list as the maps of a system file: {"x": "angle"}, ["x", {"name": "y"}]."""
    if isinstance(entries, str):
        entries = entries.replace(",", " ").split()
    if hasattr(entries, "items"):
        return [dict({"name": _name(key)}, **(value if isinstance(value, dict) else {second: value})) for key, value in entries.items()]
    return [dict(entry) if isinstance(entry, dict) else {"name": _name(entry)} for entry in entries_of(what, entries, 'give names, ["x", "y"], or a mapping')]


def _equations(entries, right="0"):
    entries = [entries] if isinstance(entries, str) or not hasattr(entries, "__iter__") else entries
    if hasattr(entries, "items"):
        return ["%s = %s" % (_name(key), text_of(value)) for key, value in entries.items()]
    texts = [text_of(entry) for entry in entries]
    return [text if "=" in text else "%s = %s" % (text, right) for text in texts]


def _velocities(quasi):
    hint = """give {"names": ["u"], "map": {"x'": "2*u"}}"""
    if not quasi:
        return None
    given = dict(pairs_of("quasi_velocities", quasi, hint))
    if set(given) != {"names", "map"}:
        raise unfit("quasi_velocities", quasi, hint)
    return {"names": entries_of("their names", given["names"], hint), "map": _equations(given["map"])}


def _domain(domain):
    hint = 'give {"x": [-1, 1]}'
    return {_name(key): entries_of("the range of %s" % _name(key), ends, hint) for key, ends in pairs_of("domain", domain, hint)} if domain else None


def _file(name, coordinates, lagrangian, parameters, constraints, forces, definitions, velocities, domain, title, more):
    """The text of a system file.  JSON is YAML."""
    content = {"name": name, "title": title, "coordinates": _named("coordinates", coordinates, "type"),
               "parameters": [dict(p, value=number_of("the parameter " + p["name"], p["value"])) if "value" in p else p for p in _named("parameters", parameters, "value")],
               "definitions": _equations(definitions), "lagrangian": None if lagrangian is None else text_of(lagrangian), "constraints": _equations(constraints),
               "velocities": _velocities(velocities), "forces": _equations(forces), "domain": _domain(domain)}
    content.update(more)
    lines = []
    for key, value in content.items():
        if value is None or value == [] or value == {}:
            continue
        if isinstance(value, list):
            lines += ["%s:" % key] + ["  - " + json.dumps(entry, ensure_ascii=False) for entry in value]
        else:
            lines.append("%s: %s" % (key, json.dumps(value, ensure_ascii=False)))
    return "\n".join(lines) + "\n"


# ---- questions ----

def _pairs(what, value):
    """{"m": 2} as "m=2", numbers of any kind as decimals; a string as it is."""
    if value is None or isinstance(value, str):
        return value
    given = pairs_of(what, value, 'give a mapping, {"x": 1}, or a text, "x=1, y=2"')
    return ", ".join("%s=%s" % (_name(key), entry if isinstance(entry, str) else repr(number_of("%s of %s" % (_name(key), what), entry))) for key, entry in given)


def _list(what, value, separator=", "):
    """Names and expressions as "y, T = m/2*v^2"."""
    if value is None or isinstance(value, str):
        return value
    if hasattr(value, "items"):
        return separator.join("%s = %s" % (key, text_of(entry)) for key, entry in value.items())
    if hasattr(value, "free_symbols"):
        return text_of(value)
    return separator.join(text_of(entry) for entry in entries_of(what, value, "give a text or a list of texts"))


def _bytes(text):
    return None if text is None else text.encode()


def _positive(name, value):
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = 0.0
    if not 0 < number < float("inf"):
        raise UsageError("%s needs a positive number, found %r" % (name, value), "leave it out for the default")
    return number


def _of_analysis(analysis):
    if analysis is None:
        return {}
    if analysis is False:
        return {"no_analysis": True}
    if not isinstance(analysis, (str, os.PathLike)):
        raise unfit("analysis", analysis, "give the path of a file, its text, or False for none")
    path = os.fspath(analysis)
    return {"analysis_text": path} if "\n" in path else {"analysis": path}


class Problem:
    """nh_problem with its context: a question whose files have been read."""

    def __init__(self, question):
        self.context = Context()
        record = Question()
        for key, value in question.items():
            setattr(record, key, value.encode() if isinstance(value, str) else value)
        self.address = self.call(lambda error: library().nh_problem_open(self.context.address, record, error))
        self.name = library().nh_problem_name(self.address).decode()
        self.coordinates = tuple(library().nh_problem_coordinate(self.address, i).decode() for i in range(library().nh_problem_coordinates(self.address)))
        self.parameters = dict(self._parameter(i) for i in range(library().nh_problem_parameters(self.address)))

    def _parameter(self, i):
        value = ctypes.c_double()
        return library().nh_problem_parameter(self.address, i, value).decode(), value.value

    def __del__(self):
        if getattr(self, "address", None):
            context = self.context  # which outlives it
            free_later(lambda address, _=context: library().nh_problem_free(address), self.address)

    def call(self, function, progress=None, make=lambda address: address):
        """make(function(error)), or the error as an exception.  An interrupted computation leaves what it has."""
        error = ErrorRecord()
        try:
            address = self.context.call(lambda: function(error), progress)
        except Interrupted as stop:
            stop.partial = make(stop.partial) if stop.partial else None
            raise
        if not address:
            raise error_of(error)
        return make(address)


class Code:
    """nh_export: functions in one language."""

    def __init__(self, address):
        self.address = address

    def __del__(self):
        free_later(library().nh_export_free, self.address)

    def _file(self, number, name=None):
        error = ErrorRecord()
        text = taken(library().nh_export_code(self.address, number, name, error))
        if text is None and error.code:
            raise error_of(error)
        return text

    @property
    def text(self):
        """All in one text."""
        return self._file(0)

    def write(self, folder):
        """The files, in a folder that is made where there is none; their paths."""
        folder, paths, name = pathlib.Path(folder), [], ctypes.c_void_p()
        folder.mkdir(parents=True, exist_ok=True)
        while True:
            text = self._file(len(paths), ctypes.byref(name))
            if text is None:
                return paths
            paths.append(folder / taken(name))
            paths[-1].write_text(text, encoding="utf-8")


@explains_arguments
class System:
    """A mechanical system and the questions about it.

        nhsym.System(coordinates={"phi": "angle", "x": "length", "y": "length"}, parameters={"m": 2, "J": 0.5},
                     lagrangian="m/2*(x'^2 + y'^2) + J/2*phi'^2", constraints=["y'*cos(phi) = x'*sin(phi)"])

    Expressions are strings in the language of system files or SymPy expressions, in which coordinates are functions of t and velocities their derivatives.
    `more`: other keys of system files."""

    def __init__(self, coordinates=None, lagrangian=None, parameters=(), constraints=(), forces=(), definitions=(), quasi_velocities=None, domain=None, name="system",
                 title=None, *, set=None, velocities=None, analysis=None, options=None, _question=None, **more):
        if _question is None:
            if coordinates is None:
                raise UsageError("a system needs coordinates", 'nhsym.System(coordinates=["x"], lagrangian="x\'^2/2"), or nhsym.system("sleigh") for one by name')
            text = _file(name, coordinates, lagrangian, parameters, constraints, forces, definitions, quasi_velocities, domain, title, more)
            _question = {"system": name, "system_text": text}
        self._question = dict(_question, **{key: value for key, value in dict(set=_pairs("set", set), velocities=velocities, options=_pairs("options", options)).items() if value is not None},
                              **_of_analysis(analysis))
        self._lock = threading.Lock()
        self.problem = Problem(self._question)

    def __del__(self):
        if "_rates" in self.__dict__:  # which would be made by asking for it
            free_later(library().nh_rates_free, self._rates)

    @property
    def name(self):
        return self.problem.name

    @property
    def coordinates(self):
        """Their names, in the order of the file."""
        return self.problem.coordinates

    @property
    def parameters(self):
        """{name: value}"""
        return dict(self.problem.parameters)

    @property
    def text(self):
        """The system file."""
        if "system_text" in self._question:
            return self._question["system_text"]
        raise InputError("the text of a shipped system is in its file", "nhsym show %s" % self.name)

    def set(self, values=(), /, **parameters):
        """The same system with other values of parameters: set(k=3), or a mapping from names or symbols."""
        given = {_name(key): value for key, value in pairs_of("values", values or {}, "set(k=3), or set({k: 3})")}
        return self._with({"set": ", ".join(filter(None, [self._question.get("set"), _pairs("set", {**given, **parameters})]))})

    def _with(self, question):
        other = object.__new__(System)
        other._question = dict(self._question, **question)
        other._lock = threading.Lock()
        other.problem = Problem(other._question)
        return other

    def _ask(self, settings):
        """The problem of a question about this system."""
        given = {key: value for key, value in settings.items() if value is not None}
        for key in ("until", "step", "accuracy"):
            if key in given:
                given[key] = _positive(key, given[key])
        if "options" in given:
            given["options"] = ", ".join(filter(None, [self._question.get("options"), _pairs("options", given["options"])]))
        return Problem(dict(self._question, **given)) if given else self.problem

    # ---- questions ----

    def analyze(self, accuracy=None, until=None, options=None, progress=None):
        """Currents and their symmetries.  progress(doing, part) is called now and then, part being None where it is not known."""
        p = self._ask(dict(accuracy=accuracy, until=until, options=options))
        return p.call(lambda error: library().nh_analyze(p.address, error), progress, lambda a: Analysis(a, p))

    def verify(self, current=None, field=None, options=None, progress=None):
        """Is `current` conserved (an expression)?  Is `field` a symmetry ({"Z0": 1, "x": "x'"}, or "Z0=1; x=x'")?"""
        if (current is None) == (field is None):
            raise UsageError("verify what?", 'verify("m*x\'"), or verify(field={"x": 1})')
        p = self._ask(dict(options=options))
        parts = [] if field is None or isinstance(field, str) else pairs_of("field", field, """give components, {"x": 1}, or a text, "Z0=1; x=x'\"""")
        text = _bytes(text_of(current) if field is None else field if isinstance(field, str) else "; ".join("%s=%s" % (_name(k), text_of(e)) for k, e in parts))
        ask = library().nh_verify_current if field is None else library().nh_verify_field
        return p.call(lambda error: ask(p.address, text, error), progress, lambda a: Verification(a, p))

    def simulate(self, initial=None, until=None, step=None, accuracy=None, method=None, watch=None, options=None, progress=None, events=None, section=None,
                 project=False):
        """A motion: initial={"phi": 0, "omega": 2} (left out: a state on the constraints); watch=["y"] or {"T": "m/2*v^2"}; accuracy: the largest allowed error;
        method: an integrator by name, as `nhsym explain methods` lists them; events=["y = 0, falling, stop"]: zeros that are recorded, or end the motion; section="x": a
        Poincare section, whose points are `section_table`; project: an initial state that violates the constraints is moved onto them."""
        p = self._ask(dict(initial=_pairs("initial", initial), until=until, step=step, accuracy=accuracy, method=method, watch=_list("watch", watch), options=options, project=project or None))
        events, section = _bytes(_list("events", events, "; ")), _bytes(section if section is None else text_of(section))
        return p.call(lambda error: library().nh_simulate_zeros(p.address, events, section, error), progress, lambda a: Simulation(a, p))

    def reduce(self, initial=None, until=None, accuracy=None, options=None, progress=None):
        """The symmetry group and the reduced equations."""
        p = self._ask(dict(initial=_pairs("initial", initial), until=until, accuracy=accuracy, options=options))
        return p.call(lambda error: library().nh_reduce(p.address, error), progress, lambda a: Reduction(a, p))

    def classify(self, over, shape=False, options=None, progress=None):
        """The values of the parameter `over` at which there are more conservation laws."""
        p = self._ask(dict(options=options))
        return p.call(lambda error: library().nh_classify_over(p.address, _bytes(_list("over", over)), bool(shape), error), progress, lambda a: Classification(a, p))

    def benchmark(self, seconds=None, initial=None, until=None, options=None, progress=None, method=None, robustness=False, over=None, project=False):
        """Integrators compared on one motion; `seconds` for the measurements (5); method: only these, a name or a list of names that `nhsym explain methods` lists;
        robustness: also maps of where methods fail; over: one such map, over one or two ranges, {"a": "1e-9:1"} or "a=1e-9:1"; project: as for `simulate`."""
        p = self._ask(dict(initial=_pairs("initial", initial), until=until, options=options, project=project or None))
        words = [_bytes(_list("method", method)), _bytes(_pairs("over", over))]
        asked = Comparison(0 if seconds is None else _positive("seconds", seconds), words[0], bool(robustness), words[1])
        return p.call(lambda error: library().nh_benchmark_methods(p.address, asked, error), progress, lambda a: Benchmark(a, p))

    def linearize(self, at=None, over=None, project=False, options=None, progress=None):
        """The linear equations of motion at the state at={"x'": 5} (what is left out is 0, or follows from the constraints), or over="x'=0:10:101", values of a parameter, a
        coordinate or a velocity; project: positions and velocities that violate the constraints are moved onto them."""
        p = self._ask(dict(initial=_pairs("at", at), options=options, project=project or None))
        over = _bytes(_pairs("over", over))
        return p.call(lambda error: library().nh_linearize(p.address, over, error), progress, lambda a: Linearization(a, p))

    # ---- functions in other languages ----

    def export(self, to, folder=None, of=None, input=None, name=None, options=None, progress=None):
        """Equations, currents and reductions as code that needs no nhsym: to="c", "python", "sympy", "matlab", "latex" or "json".  The text; with `folder`, files there,
        whose paths are returned.  of: parts, ["equations", "currents"] (all); input: parameters that a controller changes, ["u"]; name: what all names begin with."""
        if not isinstance(to, str):
            raise unfit("to", to, "give a language: c, python, sympy, matlab, latex or json")
        p = self._ask(dict(options=options))
        words = [_bytes(word) for word in (to, _list("of", of), _list("input", input), None if name is None else text_of(name))]
        code = p.call(lambda error: library().nh_export_functions(p.address, *words, error), progress, lambda a: Code(a))
        return code.text if folder is None else code.write(folder)

    # ---- equations of motion on arrays ----

    @functools.cached_property
    def _rates(self):
        return self.problem.call(lambda error: library().nh_rates_create(self.problem.address, error))

    def accelerations(self, q, v, t=0.0):
        """Of all coordinates, at positions q and velocities v that satisfy the constraints: arrays with one row per coordinate; nan where they are not determined."""
        m = len(self.coordinates)
        q, v, t, count, shape = _arrays(q, v, t, m)
        out = numpy.empty((m, count))
        rates = self._rates
        with self._lock:
            library().nh_rates_at(rates, count, None if t is None else t.ctypes.data, q.ctypes.data, v.ctypes.data, out.ctypes.data)
        return out.reshape((m,) + shape)

    def right_hand_side(self, t, y):
        """y' of y = (positions, velocities), as scipy.integrate.solve_ivp takes it, also vectorized."""
        y = array_of("y", y)
        m = len(self.coordinates)
        if y.ndim == 0 or y.shape[0] != 2 * m:
            raise UsageError("y has the shape %s" % (y.shape,), "give %d positions, then as many velocities" % m)
        return numpy.concatenate([y[m:], self.accelerations(y[:m], y[m:], t)])

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if name in ("code", "to_c", "codegen", "generate_code"):
            raise AttributeError("there is no `%s` here; did you mean `export(\"c\")`?" % name)
        raise no_attribute(self, name, [word for word in dir(self) if not word.startswith("_")])

    def __repr__(self):
        return "<System %s: coordinates %s; %s>" % (self.name, ", ".join(self.coordinates), ", ".join("%s = %g" % p for p in self.parameters.items()))
