"""Repeats the proof that y'' = r y has the Galois group SL(2): reads one certificate (a JSON object), prints "SL(2)" or what fails first.
Degrees and exponents that are whole numbers up to 1000 leave residues, and are looked for among these; larger ones, and the degrees of P
where infinity is irregular or there are more than 4096 choices of signs, are taken on trust.   usage: check_certificate.py [FILE]"""
import json, sys
C = json.load(open(sys.argv[1]) if len(sys.argv) > 1 else sys.stdin)
MOST = 1000
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
def whole(B, m):                                    # whole numbers that may be m/2 + i sqrt(B), |i| <= m/2
    return [m//2]+[n for i in range(1, m//2+1) for n in range(-MOST, MOST+1) if ((n-m//2)**2-i*i*B) % p == 0]
def roots(B):                                       # square roots modulo p, by Cipolla
    if pow(B, p//2, p) != 1: return [0] if B % p == 0 else []
    a = next(a for a in range(p) if pow(a*a-B, p//2, p) == p-1)
    x, y, u, v, n = 1, 0, a, 1, (p+1)//2
    while n: x, y, u, v, n = (x*u+y*v*(a*a-B)) % p if n % 2 else x, (x*v+y*u) % p if n % 2 else y, (u*u+v*v*(a*a-B)) % p, 2*u*v % p, n//2
    return [x, -x]
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
regular, count = o > 1 and max(orders+[1]) < 3, 1
squares = [1+4*over(at(num, c), at(den, c)[2:], 1)[0] if n == 2 else 1 for c, n in zip(poles, orders)]
infinity = 1+4*num[-1]*pow(den[-1], -1, p) if o == 2 else 1
for q in parts: count *= 1+(q[0] != q[-1])
looked = o > 1 and count <= 4096 and not odd
def degrees(T):                                     # that P may have with this choice
    ends = [((1+s)*half-(T[len(D)-2] if len(T) > len(D)-2 else 0)) % p for s in roots(infinity)] if looked else []
    return C["degrees"]+[k for k in ends if k <= MOST]
for T in choices(parts) if (C["degrees"] or looked) and not odd else []:
    if not degrees(T): continue                     # D den P'' + 2 T den P' + N P = 0, where N D = ..
    N = add(mul(den, add(add(mul(der(T), D), mul(T, der(D)), -1), mul(T, T))), mul(num, mul(D, D)), -1)
    A, B, P = mul(mul(den, D), D), mul([2], mul(mul(den, D), T)), [[0]*j+[1] for j in range(max(degrees(T))+1)]
    need(independent([add(add(mul(A, der(der(q))), mul(B, der(q))), mul(N, q)) for q in P]), "Riccati's equation has a solution")
for m in (4, 6, 8, 12) if regular else (4,):
    least = [min(whole(B, m)) if n == 2 else 0 if n == 1 else n for B, n in zip(squares, orders)]
    top, given = max(whole(infinity, m)) if o > 1 else o, [I for I in C["invariants"] if I["m"] == m]
    need(top < sum(least) or given, "forms of degree %d are left out" % m)
    for I in given: need(all(a <= b for a, b in zip(I["lowest"], least)) and I["degree"] >= top-sum(I["lowest"]), "exponents of a form of degree %d" % m)
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
