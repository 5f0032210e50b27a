"""Repeats the proof that y'' = r y has the Galois group SL(2): reads one certificate (a JSON object), prints "SL(2)" or what fails first.
Taken on trust: the degrees of P and the exponents `lowest`, which belong to characteristic 0.   usage: check_certificate.py [FILE]"""
import json, sys
C = json.load(open(sys.argv[1]) if len(sys.argv) > 1 else sys.stdin)
p, poles, num, den = C["prime"], C["poles"], [int(u) for u in C["r_num"]], [int(u) for u in C["r_den"]]
def need(true, why):
    if not true: sys.exit(print(why) or 1)
def trim(a, q=0):                                   # without leading zeros, modulo q if there is one
    a = [u % q for u in a] if q else list(a)
    while a and not a[-1]: a.pop()
    return a
def add(a, b, s=1): return trim([(a[i] if i < len(a) else 0)+s*(b[i] if i < len(b) else 0) for i in range(max(len(a), len(b)))], p)
def mul(a, b): return trim([sum(a[i]*b[n-i] for i in range(max(0, n-len(b)+1), min(n+1, len(a)))) for n in range(len(a)+len(b)-1)] if a and b else [], p)
def der(a, q=0): return trim([i*a[i] for i in range(1, len(a))], q)
def power(a, n): return [1] if n == 0 else mul(a, power(a, n-1))
def at(a, x): return add(mul(at(a[1:], x), [x, 1]), a[:1]) if a else []          # a(x + t)
def over(a, b, n):                                  # n terms of the series a/b
    out, inverse = [], pow(b[0], -1, p)
    for k in range(n): out.append(((a[k] if k < len(a) else 0)-sum(b[i]*out[k-i] for i in range(1, min(k+1, len(b)))))*inverse % p)
    return out
def root(a, s, n):                                  # n terms of the square root s + ..
    out = [s]
    for k in range(1, n): out.append((a[k]-sum(out[i]*out[k-i] for i in range(1, k)))*pow(2*s, -1, p) % p)
    return out
def independent(columns):                           # no combination is 0
    pivots = []
    for c in columns:
        for i, q in pivots: c = add(c, [u*(c[i] if i < len(c) else 0) for u in q], -1)
        if not c: return False
        pivots.append((len(c)-1, [u*pow(c[-1], -1, p) for u in c]))
        pivots.sort(key=lambda q: -q[0])
    return True
def gcd(a, b): return gcd(b, a % b) if b else abs(a)
def common(a, b):                                   # greatest common divisor over the rational numbers
    while b:
        while len(a) >= len(b): a = trim([b[-1]*u-(a[-1]*b[i-len(a)+len(b)] if i >= len(a)-len(b) else 0) for i, u in enumerate(a)][:-1])
        g = 0
        for u in a: g = gcd(g, u)
        a, b = b, [u//g for u in a]
    return a
need(p > 12 and all(p % q for q in range(2, int(p**.5)+2)) and num[-1] and den[-1] % p and len(set(poles)) == len(poles), "prime, or poles")
need(len(common(num, den)) == 1 and len(common(den, der(den))) == len(den)-len(poles), "r is not reduced, or poles meet modulo the prime")
orders = [next(i for i, u in enumerate(at(den, c)+[1]) if u) for c in poles]; o = len(den)-len(num)
need(min(orders+[1]) > 0 and sum(orders) == len(den)-1, "not the poles")
odd = o < 2 and o % 2 or any(n > 2 and n % 2 for n in orders)                     # then no line is invariant
k, half, D, parts = [max(n//2, 1) for n in orders], (p+1)//2, [1], []
for c, n in zip(poles, k): D = mul(D, power([-c, 1], n))
for c, order, n, s in [] if odd else zip(poles, orders, k, C["roots"]):          # theta D at each pole, for both signs
    r = over(at(num, c), at(den, c)[order:], n)
    need(order == 1 or (s*s-(r[0] if order > 2 else 1+4*r[0])) % p == 0 and (order == 2 or s), "a root at the pole %d" % c)
    S, rest = root(r, s, n) if order > 2 else [s*half], over(D, power([-c, 1], n), len(D)-n) if c else D[n:]
    parts.append([mul(at([g*u for u in S[:-1]]+[g*S[-1]+n*half if order > 1 else 1], -c), rest) for g in (1, -1)])
s, r = C.get("root_infinity", 0), over(trim(num[::-1], p), den[::-1], max(1, 2-o//2))
need(odd or o > 1 or s and (s*s-r[0]) % p == 0, "the root at infinity")
parts.append([mul([g*u for u in root(r, s, 1-o//2)[::-1]], D) for g in (1, -1)] if o < 2 and not odd else [[]])
def choices(parts): return [add(T, u) for T in choices(parts[1:]) for u in parts[0][:1+(parts[0][0] != parts[0][-1])]] if parts else [[]]
for T in choices(parts) if C["degrees"] and not odd else []:                     # D den P'' + 2 T den P' + N P = 0, where N D = ..
    N = add(mul(den, add(add(mul(der(T), D), mul(T, der(D)), -1), mul(T, T))), mul(num, mul(D, D)), -1)
    A, B, P = mul(mul(den, D), D), mul([2], mul(mul(den, D), T)), [[0]*j+[1] for j in range(max(C["degrees"])+1)]
    need(independent([add(add(mul(A, der(der(q))), mul(B, der(q))), mul(N, q)) for q in P]), "Riccati's equation has a solution")
for I in C["invariants"]:
    m, x, n = I["m"], next(x for x in range(2718281, p+2718281) if x % p not in poles), I["degree"]+I["m"]+12
    r, up, down = over(at(num, x), at(den, x), n), [1], [1]
    for c, l in zip(poles, I["lowest"]): up, down = (mul(up, power([x-c, 1], l)), down) if l > 0 else (up, mul(down, power([x-c, 1], -l)))
    base, columns = over(up, down, n), []
    for j in range(I["degree"]+1):
        above, a = [], ([0]*j+base)[:n]
        for i in range(m, -1, -1): above, a = a, mul([-pow(m-i+1, -1, p) if i else 1], add(der(a), mul([i+1 if i else 1], mul(r, above)[:n])))
        columns.append(trim(a[:n-m-1]))
    need(independent(columns), "a form of degree %d is invariant" % m)
print("SL(2)")
