"""Formulas to SymPy and back."""
import math
import pathlib
import random
import re

import numpy
import pytest
import sympy

import nhsym
from nhsym.formula import text_of

x, y, k = sympy.symbols("x y k")
t = sympy.Symbol("t")


@pytest.mark.parametrize("text, expected", [
    ("-x^2", -x**2), ("2^3^2", 512), ("x^-1", 1 / x), ("-x^-2/2", -x**-2 / 2), ("1 - -x", 1 + x), ("x/y/2", x / y / 2), (".5*x", x / 2), ("1e-3", sympy.Rational(1, 1000)),
    ("abs(x) + atan2(y, x)", sympy.Abs(x) + sympy.atan2(y, x)), ("sqrt(2)*pi", sympy.sqrt(2) * sympy.pi), ("x = y", sympy.Eq(x, y)), ("x'", sympy.Symbol("x'")),
    ("lambda*E + I*S", sympy.Symbol("lambda") * sympy.Symbol("E") + sympy.Symbol("I") * sympy.Symbol("S"))])
def test_reads_the_language(text, expected):
    assert nhsym.Formula(text).sympy() == expected


@pytest.mark.parametrize("text", ["x +", "(x", "2x", "f(x)", "x)", "sin x", "", "x == y", "x**2"])
def test_refuses_what_is_no_formula(text):
    with pytest.raises(nhsym.UsageError) as error:
        nhsym.Formula(text).sympy()
    assert error.value.hint and "not a formula" in error.value.what


def test_velocities_as_derivatives():
    q = sympy.Function("x")(t)
    assert nhsym.Formula("k*x'^2 + x", ["x"]).sympy(functions=True) == k * q.diff(t)**2 + q


def test_writes_the_language():
    q = sympy.Function("q")(t)
    for expression, text in ((q.diff(t)**2 / 2, "q'^2/2"), (sympy.Abs(x) * sympy.exp(1), "exp(1)*abs(x)"), (sympy.Eq(x, 2 * y), "x = 2*y"), (0.1, "0.1"), ("a + b", "a + b")):
        assert text_of(expression) == text
    assert nhsym.Formula(text_of(sympy.sec(x))).sympy().equals(1 / sympy.cos(x))


@pytest.mark.parametrize("wrong", [sympy.zeta(x), sympy.hyper((1, x), (), y), sympy.Function("q")(t).diff(t, 2), sympy.Function("q")(x).diff(x), x < y, sympy.Integral(x, x), True, sympy.Matrix([x])])
def test_refuses_what_the_language_does_not_have(wrong):
    with pytest.raises(nhsym.UsageError) as error:
        text_of(wrong)
    assert error.value.hint


def random_expression(draw, depth):
    if depth == 0:
        return draw.choice([x, y, k, sympy.Integer(draw.randint(1, 9)), sympy.Rational(draw.randint(1, 9), 7)])
    a, b = random_expression(draw, depth - 1), random_expression(draw, draw.randint(0, depth - 1))
    return draw.choice([a + b, a - b, a * b, a / (3 + b**2), -a, a**2, (4 + a**2)**sympy.Rational(-3, 2), sympy.sin(a), sympy.exp(-a**2), sympy.atan2(a, 2 + b**2), sympy.sqrt(1 + a**2)])


def test_there_and_back_on_expressions_nobody_wrote():
    draw, at, compared = random.Random(5), {x: 0.7, y: -1.3, k: 0.4}, 0
    for _ in range(80):
        expression = random_expression(draw, 4)
        first, again = (complex(e.evalf(30, subs=at)).real for e in (expression, nhsym.Formula(text_of(expression)).sympy()))
        if math.isfinite(first):
            assert again == pytest.approx(first, rel=1e-12, abs=1e-12)
            compared += 1
    assert compared > 60


def test_long_sums_are_read():
    assert nhsym.Formula(" + ".join("a%d*x" % i for i in range(3000))).sympy().args.__len__() == 3000


def test_typesets():
    formula = nhsym.Formula("J*phi'^2/2")
    assert "\\dot" in formula._repr_latex_() and formula._repr_html_().startswith("<math")
    assert nhsym.Formula("no (formula")._repr_latex_() is None and "<code>" in nhsym.Formula("no (formula")._repr_html_()


# The arguments before the last.
NAMED = {"legendre_p": "1/3", "legendre_q": "1/3", "hyp2f1": "1/3, 1/2, 5/4", "gauss_f": "1, 2, 3/2", "riemann_c": "1, 1/2, -3", "riemann_s": "1, 1/2, -3", "hyp1f1": "1/2, 3/2",
         "hyperu": "1/2, 3/2", "bessel_j": "1/3", "bessel_y": "1/3", "bessel_i": "1/3", "bessel_k": "1/3", "airy_ai": "", "airy_bi": "", "elliptic_k": "", "elliptic_e": "",
         "elliptic_f": "1/2", "elliptic_einc": "1/2", "elliptic_pi": "1/3, 1/2"}


def test_named_functions_to_sympy_and_back():
    """The derivative of each, by SymPy, and the derivative's own name, are what the library computes; what is written back is the same text."""
    x = sympy.Symbol("x")
    calls = {name: "%s(%s)" % (name, ", ".join(filter(None, [given, "x"]))) for name, given in NAMED.items()}
    system = nhsym.System(coordinates=["x%d" % i for i in range(len(calls))], domain={"x%d" % i: [0.2, 0.6] for i in range(len(calls))},
                          lagrangian=" + ".join("x%d'^2/2 + %s" % (i, call.replace("x)", "x%d)" % i)) for i, call in enumerate(calls.values())))
    rates = system.accelerations([0.375] * len(calls), [0.0] * len(calls))
    for (name, call), rate in zip(calls.items(), rates):
        expression = nhsym.Formula(call).sympy()
        assert text_of(expression) == call
        derivative = expression.diff(x).subs(x, sympy.Rational(3, 8)).evalf(20)
        assert abs(complex(derivative) - rate) < 1e-14, name
        if not name.startswith("elliptic"):
            prime = nhsym.Formula(call.replace(name, name + "_prime")).sympy().subs(x, sympy.Rational(3, 8)).evalf(20)
            assert abs(complex(prime) - rate) < 1e-14, name
    riemann = nhsym.Formula("riemann_c(1, 2, -3, x)").sympy()
    assert sympy.simplify(riemann.diff(x, 2) * (1 + x**2)**2 - (1 + 2*x - 3*x**2) * riemann) == 0
    assert sympy.lambdify(x, riemann.diff(x))(numpy.array([0.0, 0.25]))[1] == pytest.approx(float(riemann.diff(x).subs(x, 0.25).evalf()))
    with pytest.raises(nhsym.UsageError, match="explain functions"):
        nhsym.Formula("legendre_q(x)").sympy()


def test_no_named_function_of_the_library_is_left_out():
    source = pathlib.Path(__file__).resolve().parents[2] / "graph" / "function.c"
    names = re.findall(r'^ +(?:PAIR|NAMED)\(\w+, "(\w+)"', source.read_text(), re.MULTILINE)
    assert sorted(names) == sorted(NAMED)
