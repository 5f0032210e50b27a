"""Questions to the library: the arguments of Python as the texts that it reads."""
import ctypes
import fractions
import json
import os
import pathlib
import re
import tempfile

import numpy

from ._arguments import entries_of, number_of, pairs_of, unfit
from ._calls import Context, Interrupted, free_later
from ._library import ErrorRecord, Question, UsageError, error_of, library, taken
from .formula import text_of
from .results import array_of


def robot_text(source, wheels, base):
    """The text of a file that includes this one and names wheels, ["left", "right"] or {"left": 0.1, "right": None}, and the kind of the base."""
    path = os.path.abspath(os.fspath(source))
    entries = wheels.items() if hasattr(wheels, "items") else [(wheel, None) for wheel in ([wheels] if isinstance(wheels, str) else entries_of("wheels", wheels or (), 'give links, ["left"], or radii, {"left": 0.1}'))]
    content = {"include": path, "wheels": [link if radius is None else {"body": link, "radius": radius} for link, radius in entries], "base": base}
    return "".join("%s: %s\n" % (key, json.dumps(value, ensure_ascii=False)) for key, value in content.items() if value)


# ---- system files ----

def name_of(coordinate):
    """Of a string, a SymPy symbol, a function of t, or its derivative."""
    return text_of(coordinate)


def _named(what, entries, second):
    """A mapping or a list as the maps of a system file: {"x": "angle"}, ["x", {"name": "y"}]."""
    if isinstance(entries, str):
        entries = entries.replace(",", " ").split()
    if hasattr(entries, "items"):
        return [dict({"name": name_of(key)}, **(value if isinstance(value, dict) else {second: value})) for key, value in entries.items()]
    return [dict(entry) if isinstance(entry, dict) else {"name": name_of(entry)} for entry in entries_of(what, entries, 'give names, ["x", "y"], or a mapping')]


def _equations(entries, right="0"):
    entries = [entries] if isinstance(entries, str) or not hasattr(entries, "__iter__") else entries
    if hasattr(entries, "items"):
        return ["%s = %s" % (name_of(key), text_of(value)) for key, value in entries.items()]
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
    return {name_of(key): entries_of("the range of %s" % name_of(key), ends, hint) for key, ends in pairs_of("domain", domain, hint)} if domain else None


def file_text(name, coordinates, lagrangian, parameters, constraints, forces, definitions, velocities, domain, title, more):
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

def pairs_text(what, value):
    """{"m": 2} as "m=2", numbers of any kind as decimals; a string as it is."""
    if value is None or isinstance(value, str):
        return value
    given = pairs_of(what, value, 'give a mapping, {"x": 1}, or a text, "x=1, y=2"')
    return ", ".join("%s=%s" % (name_of(key), entry if isinstance(entry, str) else repr(number_of("%s of %s" % (name_of(key), what), entry))) for key, entry in given)


def list_text(what, value, separator=", "):
    """Names and expressions as "y, T = m/2*v^2"."""
    if value is None or isinstance(value, str):
        return value
    if hasattr(value, "items"):
        return separator.join("%s = %s" % (key, text_of(entry)) for key, entry in value.items())
    if hasattr(value, "free_symbols"):
        return text_of(value)
    return separator.join(text_of(entry) for entry in entries_of(what, value, "give a text or a list of texts"))


def axis_of(name, values):
    """The values of a parameter: "1:2:11", "1, 5/2", or a list."""
    hint = 'give values, [1, 2], or a range, "1:2:11" (lowest, highest, how many)'
    if not isinstance(values, str):
        return [number_of(name, value) for value in entries_of("the values of %s" % name, values, hint)]
    if ":" not in values:
        return [entry.strip() for entry in values.split(",")]
    try:
        low, high, count = (fractions.Fraction(entry.strip()) for entry in values.split(":"))
        steps = range(int(count))
    except (ValueError, ZeroDivisionError):
        raise UsageError("`%s` is no range of values of %s" % (values, name), hint) from None
    if count != len(steps) or count < 2:
        raise UsageError("`%s` is no range of values of %s" % (values, name), hint)
    return [float(low + (high - low) * i / (len(steps) - 1)) for i in steps]


def bytes_of(text):
    return None if text is None else text.encode()


def positive(name, value):
    try:
        number = float(value)
    except (TypeError, ValueError):
        number = 0.0
    if not 0 < number < float("inf"):
        raise UsageError("%s needs a positive number, found %r" % (name, value), "leave it out for the default")
    return number


def of_analysis(analysis):
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


class Rates:
    """nh_rates: the equations of motion of a problem."""

    def __init__(self, problem):
        self.address = problem.call(lambda error: library().nh_rates_create(problem.address, error))

    def __del__(self):
        if getattr(self, "address", None):
            free_later(library().nh_rates_free, self.address)


# ---- inputs over time ----

MOST = 1000  # values of a table: most_corners of src/problem/input.c


def input_texts(inputs, times):
    """Of each input its name, and an expression of t or a table of times and values; times(): where a function of Python is evaluated."""
    hint = 'give {"u": "sin(t)"}, a function of t, or times and values: {"u": ([0, 1, 2], [0, 5, 5])}'
    given = []
    for name, value in pairs_of("inputs", inputs, hint):
        if not isinstance(value, str) and callable(value) and not hasattr(value, "free_symbols"):
            at = times(name_of(name))
            value = (at, [value(float(t)) for t in at])
        if isinstance(value, (tuple, list)):
            value = _table(name_of(name), value, hint)
        given.append((name_of(name), value if isinstance(value, tuple) else text_of(value)))
    return tuple(given)


def times_until(name, until, initial):
    """MOST times, from 0 or an earlier start to the end of a motion."""
    if until is None:
        raise UsageError("the input %s is a function of Python, which needs to know the end of the motion" % name, "give until=.., or an expression of t")
    start = re.search(r"(?:^|[,;])\s*t\s*=\s*([^,;]*)", pairs_text("initial", initial) or "")
    return numpy.linspace(min(0.0, float(number_of("t", start.group(1)))) if start else 0.0, positive("until", until), MOST)


def _table(name, value, hint):
    """Its times and values; a number where there is one time."""
    if len(value) != 2:
        raise unfit("the input %s" % name, value, hint)
    t, u = (array_of("the input %s" % name, part) for part in value)
    if t.shape != u.shape or t.ndim != 1 or not len(t) or not numpy.isfinite([t, u]).all() or (numpy.diff(t) <= 0).any():
        raise UsageError("the input %s is not two rows of numbers, one value for each of the rising times" % name, hint)
    if len(t) > MOST:
        raise UsageError("the input %s has %d values; %d are allowed" % (name, len(t), MOST), "take fewer, or an expression of t")
    return (tuple(t.tolist()), tuple(u.tolist())) if len(t) > 1 else repr(float(u[0]))


def drive(problem, given):
    """Lets the inputs act; a table goes through a file."""
    for name, value in given:
        with tempfile.TemporaryDirectory() as folder:
            text = value
            if isinstance(value, tuple):
                path = os.path.join(folder, "input.csv")
                with open(path, "w", encoding="utf-8") as file:
                    file.writelines(["t,u\n"] + ["%r,%r\n" % row for row in zip(*value)])
                text = path + ":u"
            problem.call(lambda error: library().nh_problem_input(problem.address, name.encode(), text.encode(), error))
    return problem


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
