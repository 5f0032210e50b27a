/* Residues for the functions in expressions, chosen such that the relations between them hold (jet_point.h).
 *
 * First all expressions are registered: each function notes its kernel (an atom, a radicand, or itself) and the
 * common denominator of the multiples of this atom, so that sin(x/2) and cos(x/3) are functions of one angle x/6.
 * Then, for each prime and seed, a kernel gets its residue when it is first asked for, from a generator that depends
 * on its place in the list only: the order of evaluation does not matter. */
#include "exact/jet_point.h"

#include <flint/ulong_extras.h>
#include <gmp.h>

#include "base/memory.h"
#include "exact/kernel.h"
#include "exact/named_relation.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/dag_internal.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/named_function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/num_long.h"

static const uint64_t most_order = (uint64_t)1 << 40; /* largest common denominator of the multiples of one atom */
static const uint64_t most_unity = (uint64_t)1 << 20; /* the same for pi in angles: few primes have such roots of 1 */

nh_jet_point *nh_jet_point_create(nh_dag *dag)
{
    nh_jet_point *x = nh_alloc(sizeof *x);
    x->dag = dag;
    return x;
}

void nh_jet_point_free(nh_jet_point *x)
{
    if (!x) return;
    nh_free(x->spare.value);
    nh_free(x->spare.state);
    nh_free(x->kernel);
    nh_free(x);
}

/* ---- collecting the kernels ---- */

static nh_jet_kernel *find(nh_jet_point *x, nh_jet_kernel_kind kind, nh_ex key)
{
    for (size_t i = 0; i < x->kernels; i++)
        if (x->kernel[i].kind == kind && x->kernel[i].key == key) return &x->kernel[i];
    return NULL;
}

static bool note(nh_jet_point *x, nh_jet_kernel_kind kind, nh_ex key, uint64_t order)
{
    nh_jet_kernel *k = find(x, kind, key);
    if (!k) {
        nh_grow(&x->kernel, &x->capacity, x->kernels + 1, sizeof *x->kernel);
        k = &x->kernel[x->kernels++];
        *k = (nh_jet_kernel){.kind = kind, .key = key, .order = 1};
    }
    uint64_t finer = order / (uint64_t)nh_gcd((int64_t)k->order, (int64_t)order);
    if (finer > most_order / k->order) x->obstacle = "multiples of one angle or exponent with large denominators";
    else k->order *= finer;
    return !x->obstacle;
}

bool nh_jet_point_is_pi(const nh_jet_point *x, nh_ex e)
{
    return nh_kind_of(x->dag, e) == NH_FUNCTION && nh_function_of(x->dag, e) == NH_PI;
}

static bool note_parts(nh_jet_point *x, nh_jet_kernel_kind kind, nh_ex argument)
{
    nh_parts parts;
    nh_parts_make(x->dag, false, argument, &parts);
    for (size_t i = 0; i < parts.count && !x->obstacle; i++) {
        const nh_part *p = &parts.item[i];
        if (!nh_num_short(p->coefficient))
            x->obstacle = "an angle or exponent that is no rational multiple of its parts";
        else note(x, kind, p->atom, (uint64_t)p->coefficient.q);
        if (!x->obstacle && kind == NH_JET_CIRCLE && nh_jet_point_is_pi(x, p->atom))
            note(x, kind, p->atom, 2); /* so that the root of 1 has i as a power, and sines are cosines */
    }
    nh_free(parts.item);
    return !x->obstacle;
}

/* f, for f and for f' */
static nh_ex base_of(nh_dag *dag, nh_ex e)
{
    nh_ex argument[NH_MOST_ARGUMENTS];
    for (size_t i = 0; i < nh_arity(dag, e); i++) argument[i] = nh_child(dag, e, i);
    return nh_call_any(dag, nh_named_function_base(nh_function_of(dag, e)), argument);
}

static bool note_equation(nh_jet_point *x, nh_jet_kernel_kind kind, nh_ex f, size_t place, nh_ex P, nh_ex Q)
{
    if (!note(x, kind, f, 1)) return false;
    nh_jet_kernel *k = &x->kernel[x->kernels - 1];
    k->P = P;
    k->Q = Q;
    k->place = place;
    return nh_jet_point_register(x, 2, (nh_ex[]){P, Q});
}

/* Reads f' = P + Q f.  False: f has no such equation. */
static bool note_first_order(nh_jet_point *x, nh_ex f)
{
    size_t place;
    nh_ex P, Q;
    if (find(x, NH_JET_FIRST_ORDER, f)) return true;
    if (!nh_named_relation_first_order(x->dag, f, &place, &P, &Q)) return false;
    note_equation(x, NH_JET_FIRST_ORDER, f, place, P, Q);
    return true;
}

/* Splits the right side of f'' = P f' + Q f, which is linear in f and f'. */
static bool note_solution(nh_jet_point *x, nh_ex e)
{
    nh_dag *dag = x->dag;
    nh_ex f = base_of(dag, e), prime, second, zero = nh_int(dag, 0), one = nh_int(dag, 1);
    size_t last = nh_arity(dag, f) - 1;
    if (find(x, NH_JET_SOLUTION, f)) return true;
    prime = nh_named_function_rate(dag, f, last);
    second = nh_named_function_rate(dag, prime, last);
    nh_ex P = nh_substitute(dag, second, 2, (nh_ex[]){f, prime}, (nh_ex[]){zero, one});
    nh_ex Q = nh_substitute(dag, second, 2, (nh_ex[]){f, prime}, (nh_ex[]){one, zero});
    return note_equation(x, NH_JET_SOLUTION, f, last, P, Q);
}

/* asin(u) with its derivative, so that 1/sqrt(1 - u^2) is no other root than that of the equations. */
static bool note_inverse(nh_jet_point *x, nh_ex e)
{
    enum { largest_form = 2000 };
    if (find(x, NH_JET_FREE, e)) return true;
    note(x, NH_JET_FREE, e, 1);
    nh_ex rate = nh_canonical(x->dag, nh_diff_argument(x->dag, e, 0), largest_form);
    x->kernel[x->kernels - 1].P = rate;
    return nh_jet_point_register(x, 1, &rate);
}

/* Registers the kernel of a function call. */
static bool note_function(nh_jet_point *x, nh_ex e)
{
    switch (nh_function_of(x->dag, e)) {
    case NH_SIN:
    case NH_COS:
    case NH_TAN: return note_parts(x, NH_JET_CIRCLE, nh_child(x->dag, e, 0));
    case NH_EXP:
    case NH_SINH:
    case NH_COSH:
    case NH_TANH: return note_parts(x, NH_JET_EXPONENTIAL, nh_child(x->dag, e, 0));
    case NH_ABS:
    case NH_SIGN:
        if (find(x, NH_JET_FREE, e)) return true;
        if (x->pieces++) x->obstacle = "several functions that are defined piece by piece";
        return note(x, NH_JET_FREE, e, 1);
    case NH_ASIN:
    case NH_ACOS:
    case NH_ASINH:
    case NH_ACOSH: return note_inverse(x, e);
    case NH_ATAN:
    case NH_ATANH:
    case NH_LOG:
    case NH_ATAN2:
    case NH_PI: return note(x, NH_JET_FREE, e, 1);
    case NH_UNSPECIFIED: return true; /* its values need no relations */
    case NH_TABLE: x->obstacle = "a table, which has no formula"; return false;
    default:
        if (x->solutions && nh_is_named_function(nh_function_of(x->dag, e)) && note_first_order(x, e))
            return !x->obstacle;
        if (x->solutions && nh_is_named_function(nh_function_of(x->dag, e)) &&
            nh_function_of(x->dag, e) < NH_ELLIPTIC_K)
            return note_solution(x, e);
        x->obstacle = "a function whose power series modulo a prime are not built in (Bessel, Legendre, ... in the "
                      "equations of motion)";
        return false;
    }
}

static bool note_product(nh_jet_point *x, nh_ex e)
{
    for (size_t i = 0; i < nh_arity(x->dag, e) && !x->obstacle; i++) {
        nh_ex exponent = nh_exponent_of(x->dag, e, i);
        nh_exponent_kind kind = nh_exponent_kind_of(x->dag, exponent);
        if (kind == NH_EXPONENT_ROOT)
            note(x, NH_JET_ROOT, nh_child(x->dag, e, i), (uint64_t)nh_number_of(x->dag, exponent).q);
        else if (kind != NH_EXPONENT_WHOLE) x->obstacle = "powers with exponents that are no simple fractions";
    }
    return !x->obstacle;
}

/* ---- angles that are rational multiples of pi ---- */

uint64_t nh_jet_point_unity(const nh_jet_point *x)
{
    for (size_t i = 0; i < x->kernels; i++)
        if (x->kernel[i].kind == NH_JET_CIRCLE && nh_jet_point_is_pi(x, x->kernel[i].key))
            return 2 * x->kernel[i].order;
    return 1;
}

/* Roots of constants lie in the same field as cosines of pi/n, as sqrt(5) = 4 cos(pi/5) - 1 does.  The relation is
 * known for square roots of whole numbers (choose_unity). */
static void check_unity(nh_jet_point *x)
{
    uint64_t unity = nh_jet_point_unity(x);
    if (unity > most_unity) x->obstacle = "multiples of pi with large denominators";
    for (size_t i = 0; i < x->kernels && unity > 4 && !x->obstacle; i++) {
        const nh_jet_kernel *k = &x->kernel[i];
        NH_LIST(symbol);
        if (k->kind != NH_JET_ROOT || nh_symbols_in(x->dag, k->key, &symbol)) continue;
        bool whole = nh_kind_of(x->dag, k->key) == NH_NUMBER && nh_num_short(nh_number_of(x->dag, k->key)) &&
                     nh_number_of(x->dag, k->key).q == 1 && nh_number_of(x->dag, k->key).p > 0;
        if (!whole) x->obstacle = "roots of constants beside angles that are multiples of pi";
    }
}

bool nh_jet_point_register(nh_jet_point *x, size_t n, const nh_ex *e)
{
    nh_ex *node;
    size_t count = nh_nodes_in(x->dag, n, e, &node);
    for (size_t i = 0; i < count && !x->obstacle; i++) {
        nh_kind kind = nh_kind_of(x->dag, node[i]);
        if (kind == NH_FUNCTION) note_function(x, node[i]);
        else if (kind == NH_PRODUCT) note_product(x, node[i]);
        else if (kind == NH_NUMBER && !nh_num_exact(nh_number_of(x->dag, node[i])))
            x->obstacle = "numbers that are not exact";
    }
    nh_free(node);
    check_unity(x);
    return !x->obstacle;
}

/* ---- values ---- */

/* Do the numbers below roots have their roots? */
static bool has_roots(const nh_jet_point *x, nh_prime field)
{
    const nh_jet_point there = {.dag = x->dag, .field = field};
    bool good = true;
    for (size_t i = 0; i < x->kernels && good; i++) {
        nh_residue value, root;
        const nh_jet_kernel *k = &x->kernel[i];
        if (k->kind != NH_JET_ROOT || nh_kind_of(x->dag, k->key) != NH_NUMBER) continue;
        good = nh_jet_point_number(&there, nh_number_of(x->dag, k->key), &value) &&
               nh_residue_root(field, value, k->order, &root);
    }
    return good;
}

nh_prime nh_jet_point_prime(const nh_jet_point *x, size_t index)
{
    enum { most = 3000 };
    uint64_t unity = nh_jet_point_unity(x);
    nh_prime f = nh_prime_next((nh_prime){0}, unity);
    for (size_t tried = 0, found = 0; tried < most && f.p; tried++, f = nh_prime_next(f, unity))
        if (has_roots(x, f) && found++ == index) return f;
    return nh_prime_at(index);
}

void nh_jet_point_choose(nh_jet_point *x, nh_prime field, uint64_t seed)
{
    x->field = field;
    x->random = seed;
    for (size_t i = 0; i < x->kernels; i++) x->kernel[i].chosen = false;
}

bool nh_jet_point_number(const nh_jet_point *x, nh_num a, nh_residue *out)
{
    if (nh_num_short(a)) {
        nh_residue bottom = nh_residue_of(x->field, a.q);
        if (bottom)
            *out = nh_residue_mul(x->field, nh_residue_of(x->field, a.p),
                                  a.q == 1 ? 1 : nh_residue_inverse(x->field, bottom));
        return bottom != 0;
    }
    if (!nh_num_exact(a)) return false;
    mpq_t q;
    mpq_init(q);
    nh_num_get_mpq(q, a);
    nh_residue top = (nh_residue)mpz_fdiv_ui(mpq_numref(q), x->field.p),
               bottom = (nh_residue)mpz_fdiv_ui(mpq_denref(q), x->field.p);
    mpq_clear(q);
    if (bottom) *out = nh_residue_mul(x->field, top, nh_residue_inverse(x->field, bottom));
    return bottom != 0;
}

bool nh_jet_point_vanish(nh_jet_point *x, size_t n, const nh_ex *symbol)
{
    nh_ex *zero = nh_alloc_array(n + 1, sizeof *zero);
    bool good = true;
    for (size_t i = 0; i < n; i++) zero[i] = nh_int(x->dag, 0);
    for (size_t i = 0; i < x->kernels && good; i++) {
        nh_jet_kernel *k = &x->kernel[i];
        nh_ex there = n ? nh_substitute(x->dag, k->key, n, symbol, zero) : k->key;
        if (there == k->key || k->kind == NH_JET_ROOT) continue;
        bool number = nh_kind_of(x->dag, there) == NH_NUMBER;
        good = number && nh_jet_point_number(x, nh_number_of(x->dag, there), &k->value);
        k->chosen = true;
        if (k->kind == NH_JET_FREE) continue; /* such as log(1 + x) = 0 */
        good = good && k->value == 0 && (k->kind == NH_JET_CIRCLE || k->kind == NH_JET_EXPONENTIAL);
        k->value = 1;
        k->sine = 0;
    }
    nh_free(zero);
    return good;
}

/* base^exponent for a base that is not 0 */
static nh_residue signed_power(nh_prime f, nh_residue base, int64_t exponent)
{
    nh_residue r = nh_residue_power(f, base, (uint64_t)(exponent < 0 ? -exponent : exponent));
    return exponent < 0 ? nh_residue_inverse(f, r) : r;
}

/* A random residue that depends on the kernel's place in the list: the same whatever is registered behind it, and
 * whatever is evaluated before. */
static nh_residue draw(const nh_jet_point *x, const nh_jet_kernel *k, unsigned which)
{
    enum { most = 4 };
    uint64_t state = x->random + most * ((uint64_t)(k - x->kernel) + 1) + which;
    state = nh_residue_random(x->field, &state) * (state | 1); /* far from those of other kernels and points */
    return nh_residue_random(x->field, &state);
}

const nh_jet_kernel *nh_jet_point_dependent(nh_jet_point *x, nh_ex radicand)
{
    const nh_jet_kernel *k = find(x, NH_JET_ROOT, radicand);
    return k && k->dependent ? k : NULL;
}

bool nh_jet_point_root(nh_jet_point *x, nh_ex radicand, nh_residue value, nh_num exponent, nh_residue *out)
{
    nh_jet_kernel *k = find(x, NH_JET_ROOT, radicand);
    bool fresh = !k->chosen;
    if (fresh && !nh_residue_root(x->field, value, k->order, &k->value)) return false;
    bool turn = fresh && x->conjugates && k->order % 2 == 0;
    if (turn && draw(x, k, 0) % 2 == 0) k->value = nh_residue_negative(x->field, k->value);
    k->chosen = true;
    *out = signed_power(x->field, k->value, exponent.p * (int64_t)(k->order / (uint64_t)exponent.q));
    return true;
}

/* A rational point of the circle: ((1 - u^2), 2 u)/(1 + u^2). */
static bool random_angle(const nh_jet_point *x, nh_jet_kernel *k, unsigned which)
{
    nh_prime f = x->field;
    nh_residue u = draw(x, k, which), square = nh_residue_mul(f, u, u), bottom = nh_residue_add(f, 1, square);
    if (!bottom) return false;
    nh_residue inverse = nh_residue_inverse(f, bottom);
    k->value = nh_residue_mul(f, nh_residue_sub(f, 1, square), inverse);
    k->sine = nh_residue_mul(f, nh_residue_add(f, u, u), inverse);
    return true;
}

static void turn(nh_prime f, const nh_jet_kernel *k, int64_t times, nh_residue *c, nh_residue *s);

/* The multiple of the angle of k: cosine and sine. */
static void multiple(nh_prime f, const nh_jet_kernel *k, uint64_t times, nh_residue *c, nh_residue *s)
{
    *c = 1;
    *s = 0;
    turn(f, k, (int64_t)times, c, s);
}

/* Is the angle of k, of which `unity` times is a full turn, no full turn any earlier? */
static bool is_primitive(nh_prime f, const nh_jet_kernel *k, uint64_t unity)
{
    n_factor_t factors;
    bool good = true;
    n_factor_init(&factors);
    n_factor(&factors, unity, 1);
    for (int i = 0; i < factors.num && good; i++) {
        nh_residue c, s;
        multiple(f, k, unity / factors.p[i], &c, &s);
        good = c != 1 || s != 0;
    }
    return good;
}

static uint64_t discriminant(uint64_t m) { return m % 4 == 1 ? m : 4 * m; }

bool nh_jet_point_is_in_unity(const nh_jet_point *x, nh_ex radicand)
{
    if (nh_kind_of(x->dag, radicand) != NH_NUMBER) return false;
    nh_num a = nh_number_of(x->dag, radicand);
    return nh_num_short(a) && a.q == 1 && a.p > 1 && n_is_squarefree((uint64_t)a.p) &&
           nh_jet_point_unity(x) % discriminant((uint64_t)a.p) == 0;
}

/* Gauss's sum: sqrt(D) = sum over a of (D/a) cos(2 pi a/D) for the discriminant D > 0 of a quadratic field. */
static bool agrees(nh_jet_point *x, const nh_jet_kernel *k, uint64_t unity, nh_ex radicand)
{
    nh_prime f = x->field;
    uint64_t m = (uint64_t)nh_number_of(x->dag, radicand).p, D = discriminant(m);
    nh_residue sum = 0, root;
    if (!nh_jet_point_is_in_unity(x, radicand)) return true;
    for (uint64_t a = 1; a < D; a++) {
        uint64_t odd = a % 2 ? a : a + D; /* a and D are not both even where the symbol is not 0 */
        nh_residue c, s;
        if (odd % 2 == 0) continue;
        int symbol = n_jacobi((mp_limb_signed_t)D, odd);
        multiple(f, k, unity / D * a, &c, &s);
        if (symbol) sum = symbol > 0 ? nh_residue_add(f, sum, c) : nh_residue_sub(f, sum, c);
    }
    if (!nh_jet_point_root(x, radicand, nh_residue_of(f, (int64_t)m), (nh_num){.p = 1, .q = 2}, &root)) return false;
    return sum == (D == m ? root : nh_residue_add(f, root, root));
}

/* e^(i pi/order) for the kernel of pi: a root of 1 of order 2 order on the circle, and one for which the square roots
 * of numbers have the values that they have. */
static bool choose_unity(nh_jet_point *x, nh_jet_kernel *k)
{
    enum { most_tries = 400 };
    nh_prime f = x->field;
    uint64_t unity = 2 * k->order;
    bool good = false;
    for (unsigned tries = 0; tries < most_tries && !good && (f.p + 1) % unity == 0; tries++) {
        nh_residue c, s;
        if (!random_angle(x, k, tries)) continue;
        multiple(f, k, (f.p + 1) / unity, &c, &s);
        k->value = c;
        k->sine = s;
        multiple(f, k, unity / 4, &c, &s);
        good = s == 1 && is_primitive(f, k, unity); /* i, and not -i: sin(pi/10) = cos(4 pi/10) */
        for (size_t i = 0; i < x->kernels && good; i++)
            if (x->kernel[i].kind == NH_JET_ROOT && x->kernel[i].order % 2 == 0 &&
                nh_kind_of(x->dag, x->kernel[i].key) == NH_NUMBER)
                good = agrees(x, k, unity, x->kernel[i].key);
    }
    return k->chosen = good;
}

/* (c, s) := the angle that is the sum of (c, s) and `times` times that of k. */
static void turn(nh_prime f, const nh_jet_kernel *k, int64_t times, nh_residue *c, nh_residue *s)
{
    nh_residue x = k->value, y = times < 0 ? nh_residue_negative(f, k->sine) : k->sine;
    for (uint64_t n = (uint64_t)(times < 0 ? -times : times); n; n >>= 1) {
        if (n & 1) {
            nh_residue both = nh_residue_sub(f, nh_residue_mul(f, *c, x), nh_residue_mul(f, *s, y));
            *s = nh_residue_add(f, nh_residue_mul(f, *c, y), nh_residue_mul(f, *s, x));
            *c = both;
        }
        nh_residue twice = nh_residue_mul(f, x, y);
        x = nh_residue_sub(f, nh_residue_mul(f, x, x), nh_residue_mul(f, y, y));
        y = nh_residue_add(f, twice, twice);
    }
}

bool nh_jet_point_circle(nh_jet_point *x, nh_ex argument, nh_residue *sine, nh_residue *cosine)
{
    nh_parts parts;
    bool good = true;
    nh_parts_make(x->dag, false, argument, &parts);
    *sine = 0;
    *cosine = 1;
    for (size_t i = 0; i < parts.count && good; i++) {
        nh_jet_kernel *k = find(x, NH_JET_CIRCLE, parts.item[i].atom);
        nh_num c = parts.item[i].coefficient;
        if (!k->chosen) k->chosen = nh_jet_point_is_pi(x, k->key) ? choose_unity(x, k) : random_angle(x, k, 0);
        good = k->chosen;
        if (good) turn(x->field, k, c.p * (int64_t)(k->order / (uint64_t)c.q), cosine, sine);
    }
    nh_free(parts.item);
    return good;
}

bool nh_jet_point_exponential(nh_jet_point *x, nh_ex argument, nh_residue *out)
{
    nh_parts parts;
    nh_parts_make(x->dag, false, argument, &parts);
    *out = 1;
    for (size_t i = 0; i < parts.count; i++) {
        nh_jet_kernel *k = find(x, NH_JET_EXPONENTIAL, parts.item[i].atom);
        nh_num c = parts.item[i].coefficient;
        if (!k->chosen) k->value = draw(x, k, 0), k->chosen = true;
        *out =
            nh_residue_mul(x->field, *out, signed_power(x->field, k->value, c.p * (int64_t)(k->order / (uint64_t)c.q)));
    }
    nh_free(parts.item);
    return true;
}

nh_residue nh_jet_point_free_value(nh_jet_point *x, nh_ex primitive)
{
    nh_jet_kernel *k = find(x, NH_JET_FREE, primitive);
    if (!k->chosen) k->value = draw(x, k, 0), k->chosen = true;
    return k->value;
}

const nh_jet_kernel *nh_jet_point_inverse(nh_jet_point *x, nh_ex e)
{
    nh_function f = nh_kind_of(x->dag, e) == NH_FUNCTION ? nh_function_of(x->dag, e) : NH_PI;
    return f == NH_ASIN || f == NH_ACOS || f == NH_ASINH || f == NH_ACOSH ? find(x, NH_JET_FREE, e) : NULL;
}

const nh_jet_kernel *nh_jet_point_solution(nh_jet_point *x, nh_ex f)
{
    nh_jet_kernel *k = find(x, NH_JET_FIRST_ORDER, f);
    if (!k) k = find(x, NH_JET_SOLUTION, base_of(x->dag, f));
    if (!k->chosen) k->value = draw(x, k, 0), k->sine = draw(x, k, 1), k->chosen = true;
    return k;
}

nh_residue nh_jet_point_derivative(const nh_jet_point *x, int64_t f, int64_t order, nh_residue at)
{
    const uint64_t word[] = {(uint64_t)f, (uint64_t)order, at};
    uint64_t state = x->random;
    for (size_t i = 0; i < sizeof word / sizeof *word; i++) {
        state ^= word[i] + 1;
        state = nh_residue_random(x->field, &state) * (state | 1); /* as in draw() */
    }
    return nh_residue_random(x->field, &state);
}
