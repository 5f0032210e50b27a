"""Calls whose arguments do not fit: the argument by its name, and the one that was meant."""
import difflib
import functools
import inspect
import os
import sys
from typing import Any, Callable, TypeVar

from ._library import UsageError

Function = TypeVar("Function", bound=Callable[..., Any])
Kind = TypeVar("Kind", bound=type)


class ArgumentError(UsageError, TypeError):
    """A call with an argument that the function does not have, or without one that it needs.

    Examples
    --------
    >>> nhsym.system("sleigh", velocites="quasi")
    Traceback (most recent call last):
    nhsym._arguments.ArgumentError: system has no argument `velocites`
    hint: did you mean `velocities`?
    """


def nearest(word, names):
    """The name that `word` may be a slip of, or None."""
    lower = {name.lower(): name for name in names}
    near = difflib.get_close_matches(str(word).lower(), lower, 1)
    return lower[near[0]] if near else None


def velocity_meant(word, names):
    """x' or x_dot, as it is called here, where xdot or dx is asked for, or None."""
    for name in names:
        of = name[:-1] if name.endswith("'") else name[:-4] if name.endswith("_dot") else None
        if of and word in (of + "_dot", of + "dot", "d" + of, of + "_d", of + "d"):
            return name
    return None


# What other programs call these arguments.
_ELSEWHERE = {"t_end": "until", "tend": "until", "t_final": "until", "tf": "until", "tmax": "until", "t_max": "until", "time": "until", "duration": "until", "t_span": "until",
              "t": "until", "dt": "step", "h": "step", "t_eval": "step",
              "x0": "initial", "y0": "initial", "state": "initial", "initial_state": "initial", "initial_conditions": "initial", "ics": "initial", "solver": "method",
              "integrator": "method", "observe": "watch", "outputs": "watch", "params": "parameters", "values": "parameters", "parameter": "over", "budget": "seconds",
              "L": "lagrangian", "q": "coordinates", "callback": "progress",
              "language": "to", "inputs": "input", "parts": "of", "prefix": "name", "directory": "folder", "path": "folder", "file": "folder", "output": "folder"}


def _unknown(name, function, names):
    near = _ELSEWHERE.get(name) if _ELSEWHERE.get(name) in names else nearest(name, names)
    hint = "did you mean `%s`?" % near if near else "its arguments are " + ", ".join(names) if names else "it takes no arguments"
    if not near and "options" in names:
        hint += "; numerical options stand in options={..}"
    return ArgumentError("%s has no argument `%s`" % (function, name), hint)


def explained(function: Function, called: Any = None) -> Function:
    """`function`, which raises ArgumentError where Python raises TypeError because the arguments do not fit.  A call whose arguments fit costs nothing more."""
    called = called or function.__name__
    signature = inspect.signature(function)
    parameters = [p.replace(annotation=p.empty) for p in signature.parameters.values() if p.name != "self" and not p.name.startswith("_")]
    names = [p.name for p in parameters if p.kind not in (p.VAR_KEYWORD, p.VAR_POSITIONAL)]
    any_name = any(p.kind == p.VAR_KEYWORD for p in parameters)
    usage = "%s(%s)" % (called, ", ".join(str(p) for p in parameters))

    @functools.wraps(function)
    def call(*given, **named):
        try:
            return function(*given, **named)
        except TypeError:
            try:
                signature.bind(*given, **named)
            except TypeError as reason:
                unknown = [name for name in named if name not in signature.parameters and not any_name]
                raise (_unknown(unknown[0], called, names) if unknown else ArgumentError("%s: %s" % (called, reason), usage)) from None
            raise
    return call  # type: ignore[return-value]


def explains_arguments(kind: Kind) -> Kind:
    """A class whose public methods, and whose making and calling, are explained."""
    for name, method in list(vars(kind).items()):
        if inspect.isfunction(method) and (not name.startswith("_") or name in ("__init__", "__call__")):
            setattr(kind, name, explained(method, kind.__name__ if name == "__init__" else None if name != "__call__" else "a " + kind.__name__.lower()))
    return kind


def unfit(name, found, hint):
    """The error of an argument of another kind than the function takes."""
    return UsageError("%s cannot be %s" % (name, repr(found) if len(repr(found)) < 60 else "a " + type(found).__name__), hint)


def entries_of(name, value, hint):
    """Of a list or another iterable, not a text: its entries."""
    try:
        return list(value)
    except TypeError:
        raise unfit(name, value, hint) from None


def pairs_of(name, value, hint):
    """Of a mapping: its pairs."""
    if not hasattr(value, "items"):
        raise unfit(name, value, hint)
    return value.items()


def number_of(name, value):
    """As a float or an int; a text as it is, for the library to judge."""
    if isinstance(value, (int, float, str)) and not isinstance(value, bool):
        return value
    try:
        return float(value)
    except (TypeError, ValueError):
        raise unfit(name, value, "give a number") from None


def outside():
    """The stack level, for a warning of the function that calls, of the line that called the package."""
    frame, level = sys._getframe(1), 1
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == os.path.dirname(__file__):
        frame, level = frame.f_back, level + 1
    return level


def no_attribute(thing, name, names):
    """The AttributeError of an object whose names are these."""
    near = nearest(name, dir(thing))
    return AttributeError("there is no `%s` here%s" % (name, "; did you mean `%s`?" % near if near else ", but " + ", ".join(names)))
