"""The named functions of the language (`nhsym explain functions`) in SymPy: its own where it has them; else functions of these names, which can be differentiated,
evaluated by mpmath (`evalf`) and lambdified."""
import functools

PRIME = "_prime"  # bessel_j_prime(n, x) is the derivative of bessel_j(n, x) by x


def _of_sympy(sp):
    """name: (the function, its derivative by the last argument), in functions that SymPy has."""
    def gauss(s, p, c, x):
        s = sp.sympify(s)
        root = sp.sqrt(s**2 / 4 - p)
        return sp.hyper((s / 2 + root, s / 2 - root), (c,), x)

    def bessel(f, last, next):
        return f, lambda n, x: (last * f(n - 1, x) + next * f(n + 1, x)) / 2

    ratio = lambda a, b: sp.sympify(a) / b
    return {
        "legendre_p": (sp.legendre, lambda n, x: n * (x * sp.legendre(n, x) - sp.legendre(n - 1, x)) / (x**2 - 1)),
        "hyp2f1": (lambda a, b, c, x: sp.hyper((a, b), (c,), x), lambda a, b, c, x: ratio(a * b, c) * sp.hyper((a + 1, b + 1), (c + 1,), x)),
        "gauss_f": (gauss, lambda s, p, c, x: ratio(p, c) * gauss(s + 2, p + s + 1, c + 1, x)),
        "hyp1f1": (lambda a, b, x: sp.hyper((a,), (b,), x), lambda a, b, x: ratio(a, b) * sp.hyper((a + 1,), (b + 1,), x)),
        "bessel_j": bessel(sp.besselj, 1, -1), "bessel_y": bessel(sp.bessely, 1, -1), "bessel_i": bessel(sp.besseli, 1, 1), "bessel_k": bessel(sp.besselk, -1, -1),
        "airy_ai": (sp.airyai, sp.airyaiprime), "airy_bi": (sp.airybi, sp.airybiprime),
        "elliptic_k": (sp.elliptic_k, None), "elliptic_e": (sp.elliptic_e, None), "elliptic_f": (sp.elliptic_f, None),
        "elliptic_einc": (sp.elliptic_e, None), "elliptic_pi": (sp.elliptic_pi, None)}


# ---- functions that SymPy has not ----

def _riemann(a, b, c, x, first):
    """y and y' of (1 + x^2)^2 y'' = (a + b x + c x^2) y with y(0), y'(0) = first, by Taylor series, each within 0.3 of the distance to i and -i."""
    import mpmath as mp
    y, v, z = mp.mpf(first[0]), mp.mpf(first[1]), mp.mpf(0)
    while z != x:
        e, step = 1 + z * z, x - z
        reach = mp.mpf("0.3") * mp.sqrt(e)
        last = abs(step) <= reach
        h = step if last else mp.sign(step) * reach
        u = [y, v]
        for k in range(int(mp.mp.prec / 1.5) + 10):
            s = (a + (b + c * z) * z - (4 * z * z + 2 * e) * k * (k - 1)) * u[k] - 4 * e * z * (k + 1) * k * u[k + 1]
            s += (b + 2 * c * z - 4 * z * (k - 1) * (k - 2)) * u[k - 1] if k > 0 else 0
            s += (c - (k - 2) * (k - 3)) * u[k - 2] if k > 1 else 0
            u.append(s / (e * e * (k + 2) * (k + 1)))
        y, v = mp.polyval(u[::-1], h), mp.polyval([k * u[k] for k in range(len(u) - 1, 0, -1)], h)
        z = x if last else z + h
    return y, v


def _legendre_q(n, x):
    import mpmath as mp
    return mp.re(mp.legenq(n, 0, x, type=2 if abs(x) < 1 else 3))


def _legendre_q_prime(n, x):
    return n * (x * _legendre_q(n, x) - _legendre_q(n - 1, x)) / (x * x - 1)


def _tricomi(a, b, x):
    import mpmath as mp
    return mp.hyperu(a, b, x)


def _of_mpmath():
    """name: (arguments, the value, that of the derivative, the second derivative in terms of the arguments, the function and its derivative)."""
    return {
        "riemann_c": (4, lambda *z: _riemann(*z, (1, 0))[0], lambda *z: _riemann(*z, (1, 0))[1], lambda f, g, a, b, c, x: (a + b * x + c * x**2) * f / (1 + x**2)**2),
        "riemann_s": (4, lambda *z: _riemann(*z, (0, 1))[0], lambda *z: _riemann(*z, (0, 1))[1], lambda f, g, a, b, c, x: (a + b * x + c * x**2) * f / (1 + x**2)**2),
        "legendre_q": (2, _legendre_q, _legendre_q_prime, lambda f, g, n, x: (2 * x * g - n * (n + 1) * f) / (1 - x**2)),
        "hyperu": (3, _tricomi, lambda a, b, x: -a * _tricomi(a + 1, b + 1, x), lambda f, g, a, b, x: (a * f - (b - x) * g) / x)}


def _function(sp, name, arguments, value, rate):
    """The class of SymPy functions of this name; rate(arguments): the derivative by the last one."""
    def evaluated(self, prec):
        import mpmath
        numbers = [argument._to_mpmath(prec + 20) for argument in self.args if argument.is_number]
        if len(numbers) < arguments:
            return None
        with mpmath.workprec(prec + 20):
            return sp.Float(value(*numbers), precision=prec)

    def differentiated(self, index=1):
        if index != arguments:
            raise sp.core.function.ArgumentIndexError(self, index)
        return rate(*self.args)

    def at_numbers(*given):
        import mpmath
        import numpy
        return numpy.vectorize(lambda *z: float(value(*map(mpmath.mpf, map(float, z)))))(*given)
    return type(name, (sp.Function,), {"nargs": arguments, "_eval_evalf": evaluated, "fdiff": differentiated, "_imp_": staticmethod(at_numbers),
                                       "__module__": __name__, "is_real": None})


@functools.lru_cache(maxsize=None)
def named():
    """{name: function of SymPy expressions}, derivatives among them."""
    import sympy as sp
    table = {}
    for name, (f, g) in _of_sympy(sp).items():
        table[name] = f
        if g:
            table[name + PRIME] = g
    for name, (arguments, value, slope, second) in _of_mpmath().items():
        pair = {}
        pair[0] = _function(sp, name, arguments, value, lambda *z, pair=pair: pair[1](*z))
        pair[1] = _function(sp, name + PRIME, arguments, slope, lambda *z, pair=pair, second=second: second(pair[0](*z), pair[1](*z), *z))
        table[name], table[name + PRIME] = pair[0], pair[1]
    return table


def __getattr__(name):
    """The functions that SymPy has not, where pickle looks for them."""
    if name.startswith("_") or name not in named():
        raise AttributeError(name)
    return named()[name]


# ---- back ----

ALIKE = {"besselj": "bessel_j", "bessely": "bessel_y", "besseli": "bessel_i", "besselk": "bessel_k", "airyai": "airy_ai", "airybi": "airy_bi",
         "airyaiprime": "airy_ai_prime", "airybiprime": "airy_bi_prime", "legendre": "legendre_p",
         "elliptic_k": "elliptic_k", "elliptic_f": "elliptic_f", "elliptic_pi": "elliptic_pi"}


def _hyper(e):
    """The name and the arguments here of hyper(..): 2F1 with roots in its parameters by their sum and product, which are real where they are conjugate."""
    above, below, x = e.ap, e.bq, e.argument
    if (len(above), len(below)) == (1, 1):
        return "hyp1f1", (above[0], below[0], x)
    if (len(above), len(below)) != (2, 1):
        return None
    if all(a.is_rational_function() if a.free_symbols else a.is_real for a in above):
        return "hyp2f1", (above[0], above[1], below[0], x)
    from sympy import expand
    return "gauss_f", (expand(above[0] + above[1]), expand(above[0] * above[1]), below[0], x)


def parts(expression):
    """What a SymPy expression consists of, as it will be written."""
    import sympy
    rest = [expression]
    while rest:
        part = rest.pop()
        yield part
        as_here = _hyper(part) if isinstance(part, sympy.hyper) else None
        rest += as_here[1] if as_here else getattr(part, "args", ())


def written(e, print_):
    """The text of a call of SymPy's function in the language of system files, or None."""
    name = e.func.__name__
    if name == "hyper":
        as_here = _hyper(e)
        return as_here and "%s(%s)" % (as_here[0], ", ".join(map(print_, as_here[1])))
    if name == "elliptic_e":
        name = "elliptic_einc" if len(e.args) == 2 else "elliptic_e"
    elif name in ALIKE or type(e).__module__ == __name__:
        name = ALIKE.get(name, name)
    else:
        return None
    return "%s(%s)" % (name, ", ".join(map(print_, e.args)))
