"""Is there any other integral?  By numbers, without the program: monodromy of the full variational equations in complex time.

Each system is written here by hand, with its multiplier, as a field on a space of phases.  A motion of one coordinate is followed in
complex time around loops of its curve, with the variational equations of all coordinates (Gragg's midpoint rule, extrapolated); the
sheets of the curve are found on the way.  A and B run through the loops' matrices on the two normal directions.  For squares of
elements of infinite order trace(A^2 B^2 A^-2 B^-2) = 2 where the identity component of the group is solvable; of all pairs the one is
shown where it differs from 2 most, relative to what is rounded: 1e-13 times the fourth power of the entries.

    python3 tests/numerical_monodromy.py [WORD]     the table, or its rows with this word; the exit code is 1 when a number is another
                                                     one than is expected: 2 for controls, elsewhere a thousand roundings from 2
"""
import itertools
import sys

import numpy as np
import sympy as sp

ORDERS = (2, 4, 6, 8, 10, 12, 14, 16)
STEP, TURNS, MOST, SAME = 0.1, 24, 40, 1e-7
SURE, LEAK = 1e3, 1e-6  # so many roundings are far; as much of the other directions is none


class System:
    """A field on letters; `moving` runs along the curve, all letters of `normal` rest at 0; `start` solves the levels for the others."""

    def __init__(self, letters, field, moving, normal, start, singular, parameters):
        self.letters, self.moving, self.normal = letters, letters.index(moving), [letters.index(n) for n in normal]
        field = [sp.sympify(f).subs(parameters) for f in field]
        jacobian = sp.Matrix(field).jacobian(letters)
        self.field, self.jacobian = sp.lambdify([letters], field, "numpy"), sp.lambdify([letters], jacobian.tolist(), "numpy")
        self.start = sp.lambdify([moving], [sp.sympify(s).subs(parameters) for s in start], "numpy")
        numerator = sp.Poly(sp.numer(sp.together(sp.sympify(singular).subs(parameters))), moving)
        self.singular = np.unique(np.round(np.roots([complex(c) for c in numerator.all_coeffs()]), 12))

    def rate(self, state, direction):
        """d/ds of letters and variations, where the moving letter has this rate."""
        n = len(self.letters)
        x = state[:n]
        f = np.array(self.field(x), dtype=complex)
        factor = direction / f[self.moving]
        j = np.array(self.jacobian(x), dtype=complex)
        return np.concatenate([f, (j @ state[n:].reshape(n, n)).ravel()]) * factor


def step(rate, state, s, h):
    """Midpoint rules with 2, 4, .. parts, extrapolated in h^2."""
    table = []
    for k, parts in enumerate(ORDERS):
        d, before, now = h / parts, state, state + h / parts * rate(s, state)
        for i in range(1, parts):
            before, now = now, before + 2 * d * rate(s + i * d, now)
        row = [0.5 * (now + before + d * rate(s + h, now))]
        for j in range(k):
            row.append(row[j] + (row[j] - table[k - 1][j]) / ((parts / ORDERS[k - j - 1]) ** 2 - 1))
        table.append(row)
    return table[-1][-1]


def along(system, state, path, slope, distance):
    """From s = 0 to 1; steps are small where a singular point is near."""
    s = 0.0
    while s < 1:
        h = min(1 - s, STEP * 2 * distance(path(s)) / abs(slope(s)))
        state = step(lambda at, v: system.rate(v, slope(at)), state, s, h)
        s += h
    return state


def lasso(system, state, base, point):
    """To a singular point, once around it, and back."""
    distance = lambda y: np.min(np.abs(system.singular - y))
    others = np.abs(system.singular - point)
    radius = min([0.4 * o for o in others if o > 1e-9] + [0.5 * abs(point - base)])
    edge = point + radius * (base - point) / abs(base - point)
    around = 2j * np.pi
    state = along(system, state, lambda s: base + s * (edge - base), lambda s: edge - base, distance)
    state = along(system, state, lambda s: point + (edge - point) * np.exp(around * s), lambda s: around * (edge - point) * np.exp(around * s), distance)
    return along(system, state, lambda s: edge + s * (base - edge), lambda s: base - edge, distance)


def base_point(singular):
    """From here the straight lines to singular points are far from the others."""

    def clear(b):
        worst = min(abs(b - s) for s in singular)
        for p, o in itertools.permutations(singular, 2):
            u = min(max(((o - b) * np.conj(p - b)).real / abs(p - b) ** 2, 0), 1)
            worst = min(worst, abs(b + u * (p - b) - o))
        return worst

    size = 1.2 * max(1, max(abs(singular)))
    grid = [size * complex(a, b) / 9 for a in range(-9, 10) for b in range(-9, 10)]
    return max(grid, key=clear) + 0.00713 + 0.00329j


def loops(system):
    """Matrices of the group of the curve on the normal directions, from a spanning tree of its sheets."""
    n, base = len(system.letters), base_point(system.singular)
    start = np.array(system.start(base), dtype=complex)
    sheets, tree, generators, k = [start], [np.eye(n, dtype=complex)], [], 0
    while k < len(sheets):
        for point in system.singular:
            end = lasso(system, np.concatenate([sheets[k], np.eye(n, dtype=complex).ravel()]), base, point)
            matrix = end[n:].reshape(n, n) @ tree[k]
            found = [i for i, s in enumerate(sheets) if np.max(np.abs(s - end[:n])) < SAME * (1 + np.max(np.abs(s)))]
            if found:
                generators.append(np.linalg.solve(tree[found[0]], matrix))
            else:
                sheets.append(end[:n])
                tree.append(matrix)
        k += 1
        if k > 16:
            raise ValueError("the curve does not close")
    rest = [i for i in range(n) if i not in system.normal]
    scale = max(np.max(np.abs(g)) for g in generators)
    leak = max(np.max(np.abs(g[np.ix_(system.normal, rest)])) for g in generators) / scale
    return [g[np.ix_(system.normal, system.normal)] for g in generators], leak


def unit(a):
    return a / np.sqrt(a[0, 0] * a[1, 1] - a[0, 1] * a[1, 0])


def inverse(a):
    return np.array([[a[1, 1], -a[0, 1]], [-a[1, 0], a[0, 0]]])


def is_finite(a):
    """Is a power of it, up to the 24th, a multiple of 1?"""
    power = np.eye(2)
    for _ in range(TURNS):
        power = power @ a
        size = np.max(np.abs(power))
        if size > 1e6:
            return False
        if np.max(np.abs(power - power[0, 0] * np.eye(2))) < 1e-5 * size:
            return True
    return False


def furthest(generators):
    """Of pairs of elements of infinite order: their number, and |trace of the commutator of squares - 2| with its rounding where they differ most."""
    generators = [unit(g) for g in generators]
    size = lambda g: np.max(np.abs(g))
    elements, most, count = [], (0.0, 1.0), 0
    for g in sorted(generators + [a @ b for a, b in itertools.permutations(generators, 2)], key=size):
        if len(elements) < MOST and not is_finite(g) and all(min(size(g - e), size(g + e)) > 1e-6 for e in elements):
            elements.append(g)
    for a, b in itertools.combinations(elements, 2):
        a2, b2, rounding = a @ a, b @ b, 1e-13 * (size(a) * size(b)) ** 4
        far, count = abs(np.trace(a2 @ b2 @ inverse(a2) @ inverse(b2)) - 2), count + 1
        if far / rounding > most[0] / most[1]:
            most = far, rounding
    return count, *most


# ---- systems ----

x, y, z, u, v, w, g1, g2, g3, k, h = sp.symbols("x y z u v w g1 g2 g3 k h")
R = sp.Rational


def constrained(V, form, level=R(1, 7), others=1, **parameters):
    """A particle of mass 1 in space, with a multiplier of form . (x', y', z') = 0; y moves, x = 0."""
    q, p = sp.Matrix([x, y, z]), sp.Matrix([u, v, w])
    a, force = sp.Matrix(form), -sp.Matrix([sp.diff(V, c) for c in (x, y, z)])
    drift = (p.T * a.jacobian(q).T * p)[0]
    multiplier = -((a.T * force)[0] + drift) / (a.T * a)[0]
    rest = {x: 0, z: 0, u: 0, w: 0}
    kinetic = sp.together(2 * (level - V.subs(rest)))
    singular = sp.numer(kinetic) * sp.denom(kinetic) * sp.numer(sp.together((a.T * a)[0].subs(rest))) * others
    names = {sp.Symbol(n): value for n, value in parameters.items()}
    return System([x, y, z, u, v, w], list(p) + list(force + multiplier * a), y, [x, u], [0, y, 0, 0, sp.sqrt(kinetic), 0], singular, names)


def suslov(V, one, two, level=R(1, 3)):
    """w_3 = 0 in a potential of the vertical (g1, g2, g3); w_1 = 0 and g2 = 0 rest, g3 moves."""
    d = [sp.diff(V, c) for c in (g1, g2, g3)]
    field = [(g2 * d[2] - g3 * d[1]) / one, (g3 * d[0] - g1 * d[2]) / two, -v * g3, u * g3, g1 * v - g2 * u]
    plane = V.subs({g2: 0})
    kinetic = 2 * (level - plane) / two
    start = [0, sp.sqrt(kinetic.subs(g1, sp.sqrt(1 - g3**2))), sp.sqrt(1 - g3**2), 0, g3]
    return System([u, v, g1, g2, g3], field, g3, [u, g2], start, (1 - g3**2) * (level - plane), {})


def henon_heiles(b, eps):
    return (x**2 + b * y**2) / 2 + x**2 * y + eps * y**3


POTENTIALS = {"Henon-Heiles": henon_heiles(1, -R(1, 3)), "KdV": henon_heiles(1, 2), "Sawada-Kotera": henon_heiles(1, R(1, 3)), "Kaup-Kupershmidt": henon_heiles(16, R(16, 3))}


def rows():
    for name, V in POTENTIALS.items():
        for value in (1, R(1, 2)):
            yield f"{name} with z' = k y x'", f"k = {value}", constrained(V, [-k * y, 0, 1], k=value), True
        if name != "Henon-Heiles":
            yield f"{name} with z' = k y x'", "k = 0, control", constrained(V, [-k * y, 0, 1], k=0), False
    for name, V in POTENTIALS.items():
        yield f"{name} with z' = y^2 x'", "", constrained(V, [-y**2, 0, 1]), True
    for name, V in POTENTIALS.items():
        yield f"{name} with z' = x y'", "", constrained(V, [0, -x, 1]), name == "Henon-Heiles"
    for name, V, free in (("1:6:1", x**4 + 6 * x**2 * y**2 + y**4, 0), ("1:6:8", x**4 + 6 * x**2 * y**2 + 8 * y**4, 0), ("1:12:16", x**4 + 12 * x**2 * y**2 + 16 * y**4, 0), ("(x^2 + y^2)^2", (x**2 + y**2) ** 2, 0)):
        yield f"quartic {name} with z' = y x'", "", constrained(V, [-y, 0, 1]), True
        yield f"quartic {name} with z' = y x'", "k = 0, control", constrained(V, [0, 0, 1]), False
    yield "oscillators with z' = y x'", "control", constrained((x**2 + 4 * y**2) / 2, [-y, 0, 1]), False
    yield "Suslov, g3", "1:1, control", suslov(g3, 1, 1), False
    yield "Suslov, g3", "2:1", suslov(g3, 2, 1), True
    yield "Suslov, g3", "3:2", suslov(g3, 3, 2), True


def main():
    word, wrong = sys.argv[1] if len(sys.argv) > 1 else "", 0
    print("| system | | pairs | abs(trace - 2) | rounding | other directions |\n|---|---|---|---|---|---|")
    for name, what, system, far in rows():
        if word not in name + what:
            continue
        generators, leak = loops(system)
        pairs, most, rounding = furthest(generators)
        good = (most > SURE * rounding if far else most < rounding) and leak < LEAK
        wrong += not good
        print(f"| {name} | {what} | {pairs} | {most:.0e} | {rounding:.0e} | {leak:.0e} |{'' if good else ' not as expected'}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
