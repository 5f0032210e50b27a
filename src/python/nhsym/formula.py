"""Formulas: the language of system files, to SymPy and back."""
from __future__ import annotations

import functools
import html
import re
from typing import Any, Iterable, Optional, Tuple

from . import _functions
from ._arguments import explains_arguments
from ._library import AS_LATEX, AS_MATHML, UsageError, library, taken

FUNCTIONS = ("sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "exp", "log", "sqrt", "abs", "sign")


@explains_arguments
class Formula(str):
    """A formula as text, in the language of system files.  It is a str, shown typeset in a notebook.

    Parameters
    ----------
    text : str
        "J*phi'^2/2"
    coordinates : iterable of str
        The names that `sympy(functions=True)` makes functions of t.

    Examples
    --------
    >>> print(nhsym.Formula("x'/2").latex)
    \\frac{\\dot{x}}{2}
    """

    coordinates: Tuple[str, ...] = ()

    def __new__(cls, text: str, coordinates: Iterable[str] = ()) -> Formula:
        self = super().__new__(cls, text)
        self.coordinates = tuple(coordinates)
        return self

    @property
    def latex(self) -> Optional[str]:
        """LaTeX, without $; None where the text is no formula."""
        return taken(library().nh_formula_typeset(self.encode(), AS_LATEX))

    @property
    def mathml(self) -> Optional[str]:
        """MathML; None where the text is no formula."""
        inside = taken(library().nh_formula_typeset(self.encode(), AS_MATHML))
        return None if inside is None else '<math xmlns="http://www.w3.org/1998/Math/MathML">%s</math>' % inside

    def _repr_latex_(self):
        return "$%s$" % self.latex if self.latex else None

    def _repr_html_(self):
        return self.mathml or "<code>%s</code>" % html.escape(self)

    def sympy(self, functions: bool = False) -> Any:
        """As a SymPy expression.

        Parameters
        ----------
        functions : bool
            Coordinates as functions of t and velocities as their derivatives, as sympy.physics.mechanics has them;
            otherwise velocities are symbols named as here, Symbol("phi'").

        Returns
        -------
        sympy.Expr
            An equation becomes Eq.

        Examples
        --------
        >>> nhsym.Formula("J*phi'^2/2", ["phi"]).sympy(functions=True)
        J*Derivative(phi(t), t)**2/2
        """
        return _Reader(self, functions).equation()


# ---- to SymPy ----

_token = re.compile(r"\s*(?:((?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)|([A-Za-z_]\w*'*)|(.))", re.DOTALL)


class _Reader:
    """Recursive descent, sums and products as a whole: long ones are no deeper than short ones."""

    def __init__(self, formula, functions):
        import sympy
        self.sympy, self.formula, self.functions, self.at = sympy, formula, functions, 0
        self.coordinates = getattr(formula, "coordinates", ())
        self.tokens = [match.groups() for match in _token.finditer(formula) if any(match.groups())]
        self.names = {}

    def equation(self):
        left = self.sum()
        if self.take("="):
            left = self.sympy.Eq(left, self.sum())
        if self.at < len(self.tokens):
            self.refuse()
        return left

    def refuse(self):
        found = "".join(filter(None, self.tokens[self.at])) if self.at < len(self.tokens) else "the end"
        raise UsageError("`%s` is not a formula of system files: found %s" % (self.formula, found), "docs/formats.md has the language; `^` is the power")

    def take(self, sign):
        if self.at < len(self.tokens) and self.tokens[self.at][2] == sign:
            self.at += 1
            return True
        return False

    def demand(self, sign):
        if not self.take(sign):
            self.refuse()

    def sum(self):
        terms = [self.product()]
        while True:
            if self.take("+"):
                terms.append(self.product())
            elif self.take("-"):
                terms.append(-self.product())
            else:
                return terms[0] if len(terms) == 1 else self.sympy.Add(*terms)

    def product(self):
        factors = [self.signed()]
        while True:
            if self.take("*"):
                factors.append(self.signed())
            elif self.take("/"):
                factors.append(1 / self.signed())
            else:
                return factors[0] if len(factors) == 1 else self.sympy.Mul(*factors)

    def signed(self):
        if self.take("-"):
            return -self.signed()
        if self.take("+"):
            return self.signed()
        base = self.atom()
        return base**self.signed() if self.take("^") else base

    def atom(self):
        if self.take("("):
            inside = self.sum()
            self.demand(")")
            return inside
        if self.at == len(self.tokens):
            self.refuse()
        number, name, _ = self.tokens[self.at]
        if number is None and name is None:
            self.refuse()
        self.at += 1
        if number is not None:
            return self.sympy.Rational(number) if re.search("[.eE]", number) else self.sympy.Integer(number)
        return self.call(name) if self.take("(") else self.named(name)

    def call(self, name):
        if name not in FUNCTIONS and name not in _functions.named():
            self.at -= 2
            self.refuse()
        given = [self.sum()]
        while self.take(","):
            given.append(self.sum())
        self.demand(")")
        if name in FUNCTIONS:
            return getattr(self.sympy, {"abs": "Abs"}.get(name, name))(*given)
        try:
            return _functions.named()[name](*given)
        except TypeError:
            raise UsageError("`%s` does not take %d arguments" % (name, len(given)), "`nhsym explain functions` lists them") from None

    def named(self, name):
        if name not in self.names:
            self.names[name] = self.symbol(name)
        return self.names[name]

    def symbol(self, name):
        if name == "pi":
            return self.sympy.pi
        plain = name.rstrip("'")
        if not self.functions or plain not in self.coordinates:
            return self.sympy.Symbol(name)
        t = self.sympy.Symbol("t")
        function = self.sympy.Function(plain)(t)
        return function if plain == name else self.sympy.Derivative(function, (t, len(name) - len(plain)))


# ---- from SymPy ----

@functools.lru_cache(maxsize=None)
def _printer():
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):
        def _print_Derivative(self, e):
            if len(e.variables) != 1 or str(e.variables[0]) != "t" or not e.expr.is_Function:
                raise UsageError("%s is not a velocity" % e, "write derivatives of coordinates by t, once")
            return e.expr.func.__name__ + "'"

        def _print_Function(self, e):
            name = e.func.__name__
            if e.is_Function and name not in FUNCTIONS and len(e.args) == 1 and str(e.args[0]) == "t":
                return name
            name = {"Abs": "abs"}.get(name, name)
            if name not in FUNCTIONS:
                text = _functions.written(e, self._print)
                if text:
                    return text
                from sympy import cos
                again = e.rewrite(cos)
                if again.has(type(e)):
                    raise UsageError("system files have no function `%s`" % name, "they have " + ", ".join(FUNCTIONS[:-1]))
                return "(%s)" % self._print(again)
            return "%s(%s)" % (name, ", ".join(self._print(a) for a in e.args))

        _print_Abs = _print_hyper = _print_Function
        _print_sec = _print_csc = _print_cot = _print_Function

        def _print_Exp1(self, e):
            return "exp(1)"

        def _print_Float(self, e):
            return repr(float(e))

        def _print_Relational(self, e):
            if e.rel_op != "==":
                raise UsageError("%s is an inequality" % e, "constraints are equations")
            return "%s = %s" % (self._print(e.lhs), self._print(e.rhs))

    return Printer({"order": "none"})


def _of_sympy(expression):
    import sympy
    from sympy.core.function import AppliedUndef
    expression = sympy.sympify(expression)
    known = (sympy.Symbol, sympy.Rational, sympy.Float, sympy.Add, sympy.Mul, sympy.Pow, sympy.Function, AppliedUndef, sympy.Derivative, sympy.core.relational.Relational)
    for part in _functions.parts(expression):
        number = part in (sympy.pi, sympy.E) if isinstance(part, sympy.Expr) else False
        if not isinstance(part, known + (sympy.Tuple,)) and not number:
            raise UsageError("%s cannot be written in a system file: %s is a %s" % (expression, part, type(part).__name__),
                             "expressions have numbers, symbols, functions of t, their derivatives by t, sums, products, powers and " + ", ".join(FUNCTIONS[:-1]))
    return _printer().doprint(expression).replace("**", "^")


def text_of(expression: Any) -> str:
    """A string as it is; a number or a SymPy expression in the language of system files."""
    if isinstance(expression, str):
        return str(expression)
    if isinstance(expression, bool) or expression is None:
        raise UsageError("an expression is needed, found %r" % (expression,), "give a string, a number or a SymPy expression")
    if isinstance(expression, (int, float)):
        return repr(expression)
    if hasattr(expression, "free_symbols") or hasattr(expression, "_sympy_"):
        return _of_sympy(expression)
    return str(expression)  # numbers of numpy, fractions
