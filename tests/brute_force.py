"""What `nhsym classify` says of four nonholonomic families that are classified nowhere else, by another way: brute force.

The equations of motion are derived here by hand, with other coordinates; the unknowns are all Taylor coefficients of an
integral in these coordinates, without frames, weights or parameters: numbers only, modulo 2^31 - 1, which is none of
nhsym's primes. The dimension of the solutions' s-jets is read off from two ranks.

    python3 tests/brute_force.py            a table; the exit code is 1 when a number is another one
"""
import itertools
import sys
from fractions import Fraction

import numpy as np

P = 2**31 - 1


def add(p, exponent, c):
    p[exponent] = (p.get(exponent, 0) + c) % P


def times(a, b):
    out = {}
    for (e, x), (f, y) in itertools.product(a.items(), b.items()):
        add(out, tuple(i + j for i, j in zip(e, f)), x * y)
    return out


def monomials(n, degree):
    return [e for e in itertools.product(range(degree + 1), repeat=n) if sum(e) <= degree]


def moved(p, at):
    """The polynomial in powers of q - at."""
    out = {}
    for exponent, c in p.items():
        term = {(0,) * len(at): c}
        for k, power in enumerate(exponent):
            line = {(0,) * len(at): at[k], tuple(int(i == k) for i in range(len(at))): 1}
            for _ in range(power):
                term = times(term, line)
        for e, x in term.items():
            add(out, e, x)
    return out


def rank(a):
    a, row = a.copy() % P, 0
    for column in range(a.shape[1]):
        pivots = np.nonzero(a[row:, column])[0]
        if len(pivots) == 0:
            continue
        a[[row, row + pivots[0]]] = a[[row + pivots[0], row]]
        a[row, column:] = a[row, column:] * pow(int(a[row, column]), P - 2, P) % P
        below = row + 1 + np.nonzero(a[row + 1 :, column])[0]
        a[below, column:] = (a[below, column:] - a[below, column][:, None] * a[row, column:] % P) % P
        row += 1
        if row == a.shape[0]:
            break
    return row


def dimension(terms, degree, order, low, at):
    """Of the s-jets, s = low, of what solves D Gamma(Phi) = 0 up to the order; terms: (coordinate or None, velocity or
    None, powers of both velocities, polynomial): d/dq or d/dw times velocities times polynomial."""
    n, total = len(at), 0
    terms = [(q, w, shift, moved(p, at)) for q, w, shift, p in terms]
    jets = sorted(monomials(n, order), key=lambda e: (-sum(e), e))
    equations = monomials(n, order - 1)
    for parity in (0, 1):
        alphas = [a for a in monomials(2, degree) if sum(a) % 2 == parity]
        if not alphas:
            continue
        columns = {(u, a): i for i, (u, a) in enumerate(itertools.product(jets, alphas))}
        betas = [b for b in monomials(2, degree + 1) if sum(b) % 2 != parity]
        rows = {(b, e): i for i, (b, e) in enumerate(itertools.product(betas, equations))}
        matrix = np.zeros((len(rows), len(columns)), dtype=np.int64)
        for (u, a), column in columns.items():
            for q, w, shift, p in terms:
                factor = u[q] if q is not None else a[w]
                if not factor:
                    continue
                v = tuple(x - (k == q) for k, x in enumerate(u))
                b = tuple(x + s - (i == w) for i, (x, s) in enumerate(zip(a, shift)))
                for e, c in p.items():
                    row = rows.get((b, tuple(x + y for x, y in zip(v, e))))
                    if row is not None:
                        matrix[row, column] = (matrix[row, column] + factor * c) % P
        high = sum(len(alphas) for u in jets if sum(u) > low)
        total += len(columns) - high - rank(matrix) + rank(matrix[:, :high])
    return total


def number(terms, degree):
    """For growing orders, until it does not change over two of them."""
    at, low, before = (3, 5, 7), 2, []
    for order in range(degree + 3, 11):
        before.append(dimension(terms, degree, order, low, at))
        if len(before) > 2 and before[-1] == before[-2] == before[-3]:
            return before[-1]
    return None


def residue(x):
    x = Fraction(x)
    return x.numerator * pow(x.denominator, P - 2, P) % P


def contact(b, c, a=1):
    """z' = y x', V = (a x^2 + b y^2 + c z^2)/2; w = (x', y'):  (1 + y^2) x'' = -a x - c y z - y x' y',  y'' = -b y."""
    a, b, c = residue(a), residue(b), residue(c)
    D = {(0, 0, 0): 1, (0, 2, 0): 1}
    y = {(0, 1, 0): 1}
    return [
        (0, None, (1, 0), D), (2, None, (1, 0), times(D, y)), (1, None, (0, 1), D),
        (None, 0, (0, 0), {(1, 0, 0): -a % P, (0, 1, 1): -c % P}), (None, 0, (1, 1), {(0, 1, 0): P - 1}),
        (None, 1, (0, 0), times(D, {(0, 1, 0): -b % P})),
    ]


def knife(b, c):
    """u = tan(phi/2), w = (phi', v), V = x^3/3 + b x y^2 + c y^3, everything times 2 (1 + u^2)."""
    b, c = residue(b), residue(c)
    D = {(0, 0, 0): 1, (2, 0, 0): 1}
    cosine, sine = {(0, 0, 0): 2, (2, 0, 0): P - 2}, {(1, 0, 0): 4}
    force = times(cosine, {(0, 2, 0): P - 1, (0, 0, 2): -b % P})
    for e, x in times(sine, {(0, 1, 1): -2 * b % P, (0, 0, 2): -3 * c % P}).items():
        add(force, e, x)
    return [(0, None, (1, 0), times(D, D)), (1, None, (0, 1), cosine), (2, None, (0, 1), sine), (None, 1, (0, 0), force)]


def knife_quadratic(b, c, a):
    """The same with V = (a x^2 + b y^2)/2 + c x y."""
    a, b, c = residue(a), residue(b), residue(c)
    D = {(0, 0, 0): 1, (2, 0, 0): 1}
    cosine, sine = {(0, 0, 0): 2, (2, 0, 0): P - 2}, {(1, 0, 0): 4}
    force = times(cosine, {(0, 1, 0): -a % P, (0, 0, 1): -c % P})
    for e, x in times(sine, {(0, 1, 0): -c % P, (0, 0, 1): -b % P}).items():
        add(force, e, x)
    return [(0, None, (1, 0), times(D, D)), (1, None, (0, 1), cosine), (2, None, (0, 1), sine), (None, 1, (0, 0), force)]


def contact_claim(b, c, degree):
    if degree == 1:
        return 2 if b == 0 else 1
    return 5 if b == c == 0 else 4 if b == 0 or c == 4 * b else 3


def contact_three_claim(b, c, degree, a):
    if a == b == c == 0:
        return 5 if degree == 1 else 15
    if degree == 1:
        return 2 if b == 0 or (a == 0 and c in (0, b)) else 1
    if a == 0 and c == b:
        return 6
    return 5 if b == c == 0 else 4 if b == 0 or c == 4 * b or (a == 0 and (c == 0 or 4 * c == b)) else 3


def knife_three_claim(b, c, degree, a):
    if a == b == c == 0:
        return 6 if degree == 1 else 20
    return 2 if degree == 1 else 6 if a == b and c == 0 else 4


FAMILIES = [
    ("a particle with a contact constraint in quadratic potentials", contact, contact_claim,
     [("7/10", "2/5"), (1, 4), ("1/3", "4/3"), (0, 1), (0, 0), (4, 1), (1, 1), (1, 9), ("-2", "-8"), (9, 4), (2, 0)]),
    ("knife edges in cubic potentials", knife, lambda b, c, degree: 2 if degree == 1 else 4,
     [("7/10", "2/5"), (0, 0), (1, 0), ("1/3", 0), (0, 1), (-1, 0), (-3, 0), (1, "1/3"), (0, "1/3"), (16, 0), (2, 5)]),
]


THREE = [
    ("a particle with a contact constraint, three oscillators", contact, contact_three_claim,
     [(3, "7/10", "2/5"), (0, 2, "1/2"), (0, 2, 2), (0, 2, 8), (0, 2, 0), (5, 0, 0), (5, 0, 2), (1, 1, 1), (2, 2, 8),
      (3, 4, 1), (1, 4, 1), (4, 1, 1), (2, 4, 4)]),
    ("knife edges in quadratic potentials", knife_quadratic, knife_three_claim,
     [("3/2", "7/10", "2/5"), (2, 2, 0), (2, 2, 1), (0, 0, 1), (0, 0, 0), (1, 4, 0), (1, 0, 0), (1, 1, 1), (4, 1, 2), (-1, 1, 0)]),
]


def three():
    """Values in the order a, b, c."""
    wrong = 0
    print("\n| family | a | b | c | degree 1 | degree 2 | classify |\n|---|---|---|---|---|---|---|")
    for name, family, claim, values in THREE:
        for a, b, c in values[: 2 if "--few" in sys.argv else None]:
            a, b, c = Fraction(a), Fraction(b), Fraction(c)
            found = [number(family(b, c, a), degree) for degree in (1, 2)]
            said = [claim(b, c, degree, a) for degree in (1, 2)]
            wrong += found != said
            print(f"| {name} | {a} | {b} | {c} | {found[0]} | {found[1]} | {said[0]}, {said[1]} |", flush=True)
    return wrong


def main():
    wrong = 0
    print("| family | b | c | degree 1 | degree 2 | classify |\n|---|---|---|---|---|---|")
    few = "--few" in sys.argv
    for name, family, claim, values in FAMILIES:
        for b, c in values[: 3 if few else None]:
            b, c = Fraction(b), Fraction(c)
            found = [number(family(b, c), degree) for degree in (1, 2)]
            said = [claim(b, c, degree) for degree in (1, 2)]
            wrong += found != said
            print(f"| {name} | {b} | {c} | {found[0]} | {found[1]} | {said[0]}, {said[1]} |", flush=True)
    return wrong + three() > 0


if __name__ == "__main__":
    sys.exit(main())
