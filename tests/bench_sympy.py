"""The Chaplygin sleigh by SymPy and SciPy: Lagrange's equations derived, compiled to Python, integrated.

The constraint y' cos(phi) = x' sin(phi) enters with a multiplier, which LagrangesMethod eliminates.  The motion runs to T = 10 at a
relative tolerance of 1e-10 and its end is compared with the closed form phi = 2 k atan(tanh(omega0 t / (2 k))).
"""
from math import atan, tanh
from time import perf_counter

import sympy as sp
from scipy.integrate import solve_ivp
from sympy.physics.mechanics import LagrangesMethod, dynamicsymbols

begin = perf_counter()
m, a, k = sp.symbols("m a k")
phi, x, y = q = dynamicsymbols("phi x y")
phi1, x1, y1 = v = dynamicsymbols("phi x y", 1)
J = m * a**2 * (k**2 - 1)
L = m / 2 * ((x1 - a * phi1 * sp.sin(phi)) ** 2 + (y1 + a * phi1 * sp.cos(phi)) ** 2) + J / 2 * phi1**2
method = LagrangesMethod(L, q, nonhol_coneqs=[y1 * sp.cos(phi) - x1 * sp.sin(phi)])
method.form_lagranges_equations()
equations = list(method.rhs()[:6])

plain = sp.symbols("phi0 x0 y0 phi1 x1 y1")
equations = [e.subs(dict(zip(v, plain[3:]))).subs(dict(zip(q, plain[:3]))) for e in equations]
rate = sp.lambdify(plain, [e.subs({m: 2, a: 1, k: 2}) for e in equations], "math")
derived = perf_counter()
motion = solve_ivp(lambda time, z: rate(*z), (0, 10), [0, 0, 0, 2, 0, 0], method="DOP853", rtol=1e-10, atol=1e-13)
moved = perf_counter()
error = abs(motion.y[0, -1] - 2 * 2 * atan(tanh(2 * 10 / (2 * 2))))
assert motion.success and error < 1e-8, (motion.message, error)
print(f"phi(10) = {motion.y[0, -1]:.12f}, off by {error:.1e}; {motion.nfev} evaluations")
print(f"{1e3 * (derived - begin):.1f} {1e3 * (moved - derived):.2f} {error:.1e}")  # ms of the derivation and of the motion
