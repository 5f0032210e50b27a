"""Every public name says what it takes and returns, in hints and in words, and its examples run."""
import doctest
import functools
import inspect
import typing

import pytest

import nhsym


def members(kind):
    """Public methods and properties that a class of the package defines."""
    for name, member in vars(kind).items():
        if not name.startswith("_") and (inspect.isfunction(member) or isinstance(member, (property, functools.cached_property))):
            yield "%s.%s" % (kind.__name__, name), member


def public():
    for name in nhsym.__all__:
        thing = getattr(nhsym, name)
        yield name, thing
        if inspect.isclass(thing):
            yield from members(thing)


def function_of(thing):
    if inspect.isclass(thing):
        return vars(thing).get("__init__")
    return thing.fget if isinstance(thing, property) else thing.func if isinstance(thing, functools.cached_property) else thing


THINGS = dict(public())


def test_nothing_is_forgotten():
    assert len(THINGS) > 80 and {"System.simulate", "Simulation.plot", "Current.formula", "system", "Error"} <= set(THINGS)
    shown = {name for name, thing in vars(nhsym).items() if not name.startswith("_") and getattr(thing, "__module__", "").startswith("nhsym")}
    assert shown == set(nhsym.__all__)


@pytest.mark.parametrize("name", THINGS)
def test_it_has_hints(name):
    function = function_of(THINGS[name])
    if function is None:
        return  # an exception that is made as its parent
    hints = function.__annotations__
    for p in inspect.signature(function).parameters.values():
        assert p.name in hints or p.name in ("self", "cls"), p.name
    assert "return" in hints
    module = inspect.getmodule(inspect.unwrap(function))
    assert typing.get_type_hints(inspect.unwrap(function), vars(module))  # the names in them exist


@pytest.mark.parametrize("name", THINGS)
def test_it_has_words(name):
    thing = THINGS[name]
    words = inspect.cleandoc(thing.__doc__)
    assert words.split("\n")[0].endswith((".", "?"))
    if isinstance(thing, (property, functools.cached_property)):
        return
    assert "\nExamples\n--------\n>>> " in words
    function = function_of(thing)
    asked = [p for p in inspect.signature(function).parameters if p not in ("self", "_question")] if function else []
    if inspect.isclass(thing):
        return
    assert not asked or "\nParameters\n----------\n" in words
    for p in asked:
        assert any(p in line.split(" :")[0].replace("*", "").split(", ") for line in words.split("\n")), p
    assert ("\nReturns\n-------\n" in words) == (inspect.unwrap(function).__annotations__["return"] != "None")


def test_the_examples_run(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    runner, said = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS), []
    for name, thing in THINGS.items():
        test = doctest.DocTestParser().get_doctest(thing.__doc__, {"nhsym": nhsym}, name, None, 0)
        runner.run(test, out=said.append)
    assert not runner.failures and runner.tries > 60, "".join(said)
