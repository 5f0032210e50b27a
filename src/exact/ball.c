#include "exact/ball.h"

#include <math.h>

#include "base/budget.h"
#include "base/memory.h"
#include "base/progress.h"
#include "evaluate/named_value.h"
#include "exact/ball_internal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/num_long.h"

enum { deepest = 3000 }; /* depth of nesting that the stack bears */

/* One node's value: present when its epoch is the ball's. */
typedef struct {
    uint32_t epoch;
    bool finite, initialised;
    arb_t value;
} memo;

typedef struct {
    nh_ex symbol;
    arb_t value;
} setting;

struct nh_ball {
    const nh_dag *dag; /* borrowed */
    long bits;
    uint32_t epoch;
    int depth;
    memo *of; /* one per node */
    size_t capacity;
    setting *set;
    size_t sets, set_capacity;
};

nh_ball *nh_ball_create(const nh_dag *dag, long bits)
{
    nh_ball *ball = nh_alloc(sizeof *ball);
    ball->dag = dag;
    ball->bits = bits;
    ball->epoch = 1;
    return ball;
}

void nh_ball_free(nh_ball *ball)
{
    if (!ball) return;
    for (size_t i = 0; i < ball->capacity; i++)
        if (ball->of[i].initialised) arb_clear(ball->of[i].value);
    for (size_t i = 0; i < ball->sets; i++) arb_clear(ball->set[i].value);
    nh_free(ball->of);
    nh_free(ball->set);
    nh_free(ball);
}

/* ---- symbols ---- */

static setting *find_setting(nh_ball *ball, nh_ex symbol)
{
    for (size_t i = 0; i < ball->sets; i++)
        if (ball->set[i].symbol == symbol) return &ball->set[i];
    return NULL;
}

/* Where a symbol's value is stored; forgets everything that has been evaluated. */
static arb_ptr place(nh_ball *ball, nh_ex symbol)
{
    ball->epoch++;
    setting *s = find_setting(ball, symbol);
    if (s) return s->value;
    nh_grow(&ball->set, &ball->set_capacity, ball->sets + 1, sizeof *ball->set);
    s = &ball->set[ball->sets++];
    s->symbol = symbol;
    arb_init(s->value);
    return s->value;
}

static void set_ratio(arb_t out, int64_t p, int64_t q, long bits)
{
    arb_set_si(out, p);
    if (q != 1) arb_div_si(out, out, q, bits);
}

void nh_ball_set_ratio(nh_ball *ball, nh_ex symbol, int64_t p, int64_t q)
{
    set_ratio(place(ball, symbol), p, q, ball->bits);
}

void nh_ball_set_double(nh_ball *ball, nh_ex symbol, double value) { arb_set_d(place(ball, symbol), value); }

void nh_ball_set_between(nh_ball *ball, nh_ex symbol, double low, double high)
{
    arf_t a, b;
    arf_init(a);
    arf_init(b);
    arf_set_d(a, low);
    arf_set_d(b, high);
    arb_set_interval_arf(place(ball, symbol), a, b, ball->bits);
    arf_clear(b);
    arf_clear(a);
}

void nh_ball_set_arb(nh_ball *ball, nh_ex symbol, const arb_t value) { arb_set(place(ball, symbol), value); }

/* ---- nodes ---- */

static bool eval(nh_ball *ball, nh_ex e, arb_t out);

static void set_long(arb_t out, nh_num c, long bits)
{
    mpq_t v;
    fmpq_t ratio;
    mpq_init(v);
    fmpq_init(ratio);
    nh_num_get_mpq(v, c);
    fmpz_set_mpz(fmpq_numref(ratio), mpq_numref(v));
    fmpz_set_mpz(fmpq_denref(ratio), mpq_denref(v));
    arb_set_fmpq(out, ratio, bits);
    fmpq_clear(ratio);
    mpq_clear(v);
}

void nh_ball_set_number(const nh_ball *ball, arb_t out, nh_num c)
{
    if (nh_num_short(c)) set_ratio(out, c.p, c.q, ball->bits);
    else if (nh_num_exact(c)) set_long(out, c, ball->bits);
    else arb_set_d(out, c.d);
}

static bool eval_symbol(nh_ball *ball, nh_ex e, arb_t out)
{
    const setting *s = find_setting(ball, e);
    if (s) arb_set(out, s->value);
    return s != NULL;
}

static bool eval_sum(nh_ball *ball, nh_ex e, arb_t out)
{
    arb_t term, c;
    arb_init(term);
    arb_init(c);
    bool fine = true;
    nh_ball_set_number(ball, out, nh_constant_of(ball->dag, e));
    for (size_t i = 0; i < nh_arity(ball->dag, e) && fine; i++) {
        fine = eval(ball, nh_child(ball->dag, e, i), term);
        nh_ball_set_number(ball, c, nh_coefficient_of(ball->dag, e, i));
        if (fine) arb_addmul(out, c, term, ball->bits);
    }
    arb_clear(term);
    arb_clear(c);
    return fine;
}

/* base^exponent in place; whole and half powers have better bounds than exp(x log b). */
static bool eval_power(nh_ball *ball, arb_t base, nh_ex exponent)
{
    bool numeric = nh_kind_of(ball->dag, exponent) == NH_NUMBER;
    nh_num x = numeric ? nh_number_of(ball->dag, exponent) : nh_num_int(0);
    if (numeric && x.q == 1) {
        fmpz_t n;
        fmpz_init(n);
        fmpz_set_d(n, (double)(x.p >> 32)); /* exponent in halves: doubles hold 53 bits exactly */
        fmpz_mul_2exp(n, n, 32);
        fmpz_add_ui(n, n, (ulong)(x.p & 0xffffffff));
        arb_pow_fmpz(base, base, n, ball->bits);
        fmpz_clear(n);
        return true;
    }
    if (numeric && x.q == 2 && (x.p == 1 || x.p == -1)) {
        if (x.p > 0) arb_sqrt(base, base, ball->bits);
        else arb_rsqrt(base, base, ball->bits);
        return true;
    }
    arb_t power;
    arb_init(power);
    bool fine = eval(ball, exponent, power);
    if (fine) arb_pow(base, base, power, ball->bits);
    arb_clear(power);
    return fine;
}

static bool eval_product(nh_ball *ball, nh_ex e, arb_t out)
{
    arb_t factor;
    arb_init(factor);
    bool fine = true;
    nh_ball_set_number(ball, out, nh_constant_of(ball->dag, e));
    for (size_t i = 0; i < nh_arity(ball->dag, e) && fine; i++) {
        fine =
            eval(ball, nh_child(ball->dag, e, i), factor) && eval_power(ball, factor, nh_exponent_of(ball->dag, e, i));
        if (fine) arb_mul(out, out, factor, ball->bits);
    }
    arb_clear(factor);
    return fine;
}

typedef void unary(arb_t out, const arb_t a, slong bits);

static void absolute(arb_t out, const arb_t a, slong bits)
{
    (void)bits;
    arb_abs(out, a);
}

static void sign(arb_t out, const arb_t a, slong bits)
{
    (void)bits;
    arb_sgn(out, a);
}

static bool eval_named(nh_ball *ball, nh_ex e, arb_t out)
{
    size_t n = nh_arity(ball->dag, e);
    bool fine = true;
    arb_ptr argument = _arb_vec_init((slong)n);
    for (size_t i = 0; i < n && fine; i++) fine = eval(ball, nh_child(ball->dag, e, i), argument + i);
    if (fine) nh_named_value_ball(nh_function_of(ball->dag, e), argument, out, ball->bits);
    _arb_vec_clear(argument, (slong)n);
    return fine;
}

static bool eval_function(nh_ball *ball, nh_ex e, arb_t out)
{
    static unary *const table[NH_FUNCTION_COUNT] = {
        [NH_SIN] = arb_sin,   [NH_COS] = arb_cos,     [NH_TAN] = arb_tan,     [NH_ASIN] = arb_asin,
        [NH_ACOS] = arb_acos, [NH_ATAN] = arb_atan,   [NH_SINH] = arb_sinh,   [NH_COSH] = arb_cosh,
        [NH_TANH] = arb_tanh, [NH_ASINH] = arb_asinh, [NH_ACOSH] = arb_acosh, [NH_ATANH] = arb_atanh,
        [NH_EXP] = arb_exp,   [NH_LOG] = arb_log,     [NH_ABS] = absolute,    [NH_SIGN] = sign};
    nh_function f = nh_function_of(ball->dag, e);
    if (f == NH_PI) {
        arb_const_pi(out, ball->bits);
        return true;
    }
    if (nh_is_named_function(f)) return eval_named(ball, e, out);
    arb_t b;
    arb_init(b);
    bool fine = eval(ball, nh_child(ball->dag, e, 0), out);
    if (f == NH_ATAN2) {
        fine = fine && eval(ball, nh_child(ball->dag, e, 1), b);
        if (fine) arb_atan2(out, out, b, ball->bits);
    } else if (fine) {
        table[f](out, out, ball->bits);
    }
    arb_clear(b);
    return fine;
}

double nh_ball_products(long bits)
{
    static const double more = 3;
    return ((double)bits / 64 + more) * ((double)bits / 64 + more);
}

static bool eval_node(nh_ball *ball, nh_ex e, arb_t out)
{
    enum { function = 20 }; /* cost in products */
    double each = nh_kind_of(ball->dag, e) == NH_FUNCTION ? function : (double)nh_arity(ball->dag, e) + 1;
    nh_work_add(NH_WORK_BALL, each * nh_ball_products(ball->bits));
    switch (nh_kind_of(ball->dag, e)) {
    case NH_NUMBER: nh_ball_set_number(ball, out, nh_number_of(ball->dag, e)); return true;
    case NH_SYMBOL: return eval_symbol(ball, e, out);
    case NH_SUM: return eval_sum(ball, e, out);
    case NH_PRODUCT: return eval_product(ball, e, out);
    default: return eval_function(ball, e, out);
    }
}

/* The value of e into `out`; false when it is not finite. */
static bool eval(nh_ball *ball, nh_ex e, arb_t out)
{
    if (e >= ball->capacity) {
        size_t old = ball->capacity;
        nh_grow(&ball->of, &ball->capacity, nh_dag_size(ball->dag), sizeof *ball->of);
        for (size_t i = old; i < ball->capacity; i++) ball->of[i] = (memo){.epoch = 0};
    }
    if (ball->of[e].epoch != ball->epoch) {
        if (ball->depth > deepest || nh_interrupted()) return false;
        ball->depth++;
        bool finite = eval_node(ball, e, out) && arb_is_finite(out);
        ball->depth--;
        memo *m = &ball->of[e]; /* the graph does not grow here, so the table has not moved */
        if (!m->initialised) arb_init(m->value);
        m->initialised = true;
        m->epoch = ball->epoch;
        m->finite = finite;
        arb_set(m->value, out);
    } else {
        arb_set(out, ball->of[e].value);
    }
    return ball->of[e].finite;
}

bool nh_ball_eval(nh_ball *ball, nh_ex e, arb_t out) { return eval(ball, e, out); }

long nh_ball_bits(const nh_ball *ball) { return ball->bits; }

/* ---- asking ---- */

static void set_to(nh_ball *ball, nh_ex symbol, nh_ex value, bool middle)
{
    arb_t v;
    arb_init(v);
    if (!eval(ball, value, v)) arb_indeterminate(v);
    if (middle) arb_get_mid_arb(v, v);
    arb_set(place(ball, symbol), v);
    arb_clear(v);
}

void nh_ball_set_expression(nh_ball *ball, nh_ex symbol, nh_ex value) { set_to(ball, symbol, value, false); }

void nh_ball_set_middle(nh_ball *ball, nh_ex symbol, nh_ex value) { set_to(ball, symbol, value, true); }

/* A double, and an upper bound for its distance from any point of the ball. */
static void round_ball(const arb_t v, double *mid, double *radius)
{
    arf_t far;
    arb_t distance;
    arf_init(far);
    arb_init(distance);
    *mid = arf_get_d(arb_midref(v), ARF_RND_NEAR);
    arb_set_d(distance, *mid);
    arb_sub(distance, distance, v, 64);
    arb_get_abs_ubound_arf(far, distance, 64);
    *radius = arf_get_d(far, ARF_RND_UP);
    arf_clear(far);
    arb_clear(distance);
}

bool nh_ball_value(nh_ball *ball, nh_ex e, double *mid, double *radius)
{
    arb_t v;
    arb_init(v);
    bool fine = eval(ball, e, v);
    if (fine) round_ball(v, mid, radius);
    fine = fine && isfinite(*mid) && isfinite(*radius);
    arb_clear(v);
    return fine;
}

bool nh_ball_excludes_zero(nh_ball *ball, nh_ex e)
{
    arb_t v;
    arb_init(v);
    bool excluded = eval(ball, e, v) && arb_is_finite(v) && !arb_contains_zero(v);
    arb_clear(v);
    return excluded;
}

/* log10 of a magnitude of any size: 2^(exponent-1) <= |x| < 2^exponent */
static double log10_of(const arf_t x)
{
    arf_t mantissa;
    fmpz_t exponent;
    if (arf_is_zero(x)) return -INFINITY;
    arf_init(mantissa);
    fmpz_init(exponent);
    arf_frexp(mantissa, exponent, x);
    double value = log10(fabs(arf_get_d(mantissa, ARF_RND_NEAR))) + fmpz_get_d(exponent) * log10(2);
    arf_clear(mantissa);
    fmpz_clear(exponent);
    return value;
}

double nh_ball_upper(const arb_t v)
{
    mag_t bound;
    mag_init(bound);
    arb_get_mag(bound, v);
    double out = mag_get_d(bound);
    mag_clear(bound);
    return out;
}

double nh_ball_log10_upper(const arb_t v)
{
    arf_t bound;
    arf_init(bound);
    arb_get_abs_ubound_arf(bound, v, 64);
    double value = log10_of(bound);
    arf_clear(bound);
    return value;
}

double nh_ball_log10_lower(const arb_t v)
{
    arf_t bound;
    arf_init(bound);
    arb_get_abs_lbound_arf(bound, v, 64);
    double value = log10_of(bound);
    arf_clear(bound);
    return value;
}

bool nh_ball_log10_bound(nh_ball *ball, nh_ex e, double *log10_bound)
{
    arb_t v;
    arb_init(v);
    bool fine = eval(ball, e, v);
    if (fine) *log10_bound = nh_ball_log10_upper(v);
    arb_clear(v);
    return fine;
}

bool nh_ball_relative_sum(nh_ball *ball, size_t n, const nh_ex *term, double *log10_ratio)
{
    arb_t sum, v;
    double largest = -INFINITY;
    bool fine = true;
    arb_init(sum);
    arb_init(v);
    for (size_t i = 0; i < n && fine; i++) {
        fine = eval(ball, term[i], v);
        if (!fine) break;
        arb_add(sum, sum, v, ball->bits);
        double size = nh_ball_log10_lower(v);
        if (size > largest) largest = size;
    }
    fine = fine && isfinite(largest);
    if (fine) *log10_ratio = nh_ball_log10_upper(sum) - largest;
    arb_clear(sum);
    arb_clear(v);
    return fine;
}
