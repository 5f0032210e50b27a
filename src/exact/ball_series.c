#include "exact/ball_series.h"

#include <math.h>

#include "base/memory.h"
#include "exact/ball_internal.h"

enum { pieces = 8 }; /* of the interval, on either side of the centre: balls around short pieces are small */

typedef struct {
    bool known, fine;
    arb_poly_t value;
} memo;

struct nh_ball_series {
    const nh_dag *dag;
    nh_ball *ball;
    nh_ex variable;
    size_t defined;
    const nh_ball_defined *define;
    long bits;
    slong terms;          /* of the series that are computed now */
    arb_t from, interval; /* a place, and a ball around all that follows it until the next */
    arb_ptr at_from;      /* per defined symbol: an integral's value there */
    size_t nodes, used;
    memo *of;   /* per node */
    nh_ex *use; /* those that are known */
};

nh_ball_series *nh_ball_series_create(const nh_dag *dag, nh_ball *ball, nh_ex variable, size_t defined,
                                      const nh_ball_defined *define)
{
    nh_ball_series *s = nh_alloc(sizeof *s);
    *s = (nh_ball_series){.dag = dag,
                          .ball = ball,
                          .variable = variable,
                          .defined = defined,
                          .define = define,
                          .bits = nh_ball_bits(ball),
                          .nodes = nh_dag_size(dag)};
    arb_init(s->from);
    arb_init(s->interval);
    s->at_from = _arb_vec_init((slong)defined);
    s->of = nh_alloc_array(s->nodes + 1, sizeof *s->of);
    s->use = nh_alloc_array(s->nodes + 1, sizeof *s->use);
    for (size_t i = 0; i < s->nodes; i++) s->of[i].known = false;
    return s;
}

static void forget(nh_ball_series *s)
{
    for (size_t i = 0; i < s->used; i++) {
        memo *m = &s->of[s->use[i]];
        arb_poly_clear(m->value);
        m->known = false;
    }
    s->used = 0;
}

void nh_ball_series_free(nh_ball_series *s)
{
    if (!s) return;
    forget(s);
    arb_clear(s->from);
    arb_clear(s->interval);
    _arb_vec_clear(s->at_from, (slong)s->defined);
    nh_free(s->use);
    nh_free(s->of);
    nh_free(s);
}

/* ---- nodes ---- */

static bool eval(nh_ball_series *s, nh_ex e, arb_poly_t out);

static const nh_ball_defined *definition(const nh_ball_series *s, nh_ex e)
{
    for (size_t i = 0; i < s->defined; i++)
        if (s->define[i].symbol == e) return &s->define[i];
    return NULL;
}

static bool moves(const nh_ball_series *s, nh_ex e)
{
    bool any = nh_depends(s->dag, e, s->variable);
    for (size_t i = 0; i < s->defined && !any; i++) any = nh_depends(s->dag, e, s->define[i].symbol);
    return any;
}

/* The integral of f: what it is at the place, and f on the interval times the way. */
static void integrate(const nh_ball_series *s, arb_srcptr at_from, arb_poly_t f)
{
    arb_t first, way;
    arb_init(first);
    arb_init(way);
    arb_poly_get_coeff_arb(first, f, 0);
    arb_sub(way, s->interval, s->from, s->bits);
    arb_mul(first, first, way, s->bits);
    arb_add(first, first, at_from, s->bits);
    arb_poly_integral(f, f, s->bits);
    arb_poly_truncate(f, s->terms);
    arb_poly_set_coeff_arb(f, 0, first);
    arb_clear(way);
    arb_clear(first);
}

/* A root of f with the sign that the symbol has in the ball. */
static bool root(const nh_ball_series *s, nh_ex symbol, arb_poly_t f)
{
    arb_t value;
    arb_init(value);
    bool fine = nh_ball_eval(s->ball, symbol, value) && !arb_contains_zero(value);
    arb_poly_sqrt_series(f, f, s->terms, s->bits);
    if (fine && arb_is_negative(value)) arb_poly_neg(f, f);
    arb_clear(value);
    return fine;
}

static bool eval_symbol(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    const nh_ball_defined *d = definition(s, e);
    if (!d) {
        arb_poly_set_coeff_arb(out, 0, s->interval);
        if (s->terms > 1) arb_poly_set_coeff_si(out, 1, 1);
        return true;
    }
    if (!eval(s, d->of, out)) return false;
    if (!d->integral) return root(s, e, out);
    integrate(s, s->at_from + (d - s->define), out);
    return true;
}

static bool constant(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    arb_t value;
    arb_init(value);
    bool fine = nh_ball_eval(s->ball, e, value);
    arb_poly_set_coeff_arb(out, 0, value);
    arb_clear(value);
    return fine;
}

static bool eval_sum(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    arb_poly_t term;
    arb_t c;
    arb_poly_init(term);
    arb_init(c);
    bool fine = true;
    nh_ball_set_number(s->ball, c, nh_constant_of(s->dag, e));
    arb_poly_set_coeff_arb(out, 0, c);
    for (size_t i = 0; i < nh_arity(s->dag, e) && fine; i++) {
        fine = eval(s, nh_child(s->dag, e, i), term);
        nh_ball_set_number(s->ball, c, nh_coefficient_of(s->dag, e, i));
        arb_poly_scalar_mul(term, term, c, s->bits);
        arb_poly_add(out, out, term, s->bits);
    }
    arb_clear(c);
    arb_poly_clear(term);
    return fine;
}

/* base^x in place; x is a constant. */
static bool power(nh_ball_series *s, arb_poly_t base, nh_ex exponent)
{
    if (moves(s, exponent)) return false;
    bool numeric = nh_kind_of(s->dag, exponent) == NH_NUMBER;
    nh_num x = numeric ? nh_number_of(s->dag, exponent) : nh_num_int(0);
    enum { largest = 1000 };
    if (numeric && x.q == 1 && llabs((long long)x.p) < largest) {
        arb_poly_pow_ui_trunc_binexp(base, base, (ulong)llabs((long long)x.p), s->terms, s->bits);
        if (x.p < 0) arb_poly_inv_series(base, base, s->terms, s->bits);
        return true;
    }
    arb_t value;
    arb_init(value);
    bool fine = nh_ball_eval(s->ball, exponent, value);
    if (fine && numeric && x.q == 2 && llabs((long long)x.p) == 1) {
        if (x.p > 0) arb_poly_sqrt_series(base, base, s->terms, s->bits);
        else arb_poly_rsqrt_series(base, base, s->terms, s->bits);
    } else if (fine) arb_poly_pow_arb_series(base, base, value, s->terms, s->bits);
    arb_clear(value);
    return fine;
}

static bool eval_product(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    arb_poly_t factor;
    arb_t c;
    arb_poly_init(factor);
    arb_init(c);
    bool fine = true;
    nh_ball_set_number(s->ball, c, nh_constant_of(s->dag, e));
    arb_poly_set_coeff_arb(out, 0, c);
    for (size_t i = 0; i < nh_arity(s->dag, e) && fine; i++) {
        fine = eval(s, nh_child(s->dag, e, i), factor) && power(s, factor, nh_exponent_of(s->dag, e, i));
        if (fine) arb_poly_mullow(out, out, factor, s->terms, s->bits);
    }
    arb_clear(c);
    arb_poly_clear(factor);
    return fine;
}

static bool eval_function(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    nh_function f = nh_function_of(s->dag, e);
    if (nh_is_named_function(f) || f == NH_ATAN2 || !eval(s, nh_child(s->dag, e, 0), out)) return false;
    switch (f) {
    case NH_SIN: arb_poly_sin_series(out, out, s->terms, s->bits); return true;
    case NH_COS: arb_poly_cos_series(out, out, s->terms, s->bits); return true;
    case NH_TAN: arb_poly_tan_series(out, out, s->terms, s->bits); return true;
    case NH_ASIN: arb_poly_asin_series(out, out, s->terms, s->bits); return true;
    case NH_ACOS: arb_poly_acos_series(out, out, s->terms, s->bits); return true;
    case NH_ATAN: arb_poly_atan_series(out, out, s->terms, s->bits); return true;
    case NH_SINH: arb_poly_sinh_series(out, out, s->terms, s->bits); return true;
    case NH_COSH: arb_poly_cosh_series(out, out, s->terms, s->bits); return true;
    case NH_EXP: arb_poly_exp_series(out, out, s->terms, s->bits); return true;
    case NH_LOG: arb_poly_log_series(out, out, s->terms, s->bits); return true;
    default: return false;
    }
}

/* Finite in all its coefficients; else nothing. */
static bool all_finite(const arb_poly_t p)
{
    bool fine = true;
    for (slong k = 0; k < arb_poly_length(p) && fine; k++) fine = arb_is_finite(arb_poly_get_coeff_ptr(p, k));
    return fine;
}

static bool eval_node(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    arb_poly_zero(out);
    if (!moves(s, e)) return constant(s, e, out);
    switch (nh_kind_of(s->dag, e)) {
    case NH_SYMBOL: return eval_symbol(s, e, out);
    case NH_SUM: return eval_sum(s, e, out);
    case NH_PRODUCT: return eval_product(s, e, out);
    default: return eval_function(s, e, out);
    }
}

static bool eval(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    if (e >= s->nodes) return false;
    memo *m = &s->of[e];
    if (!m->known) {
        m->known = true; /* the table does not move */
        s->use[s->used++] = e;
        arb_poly_init(m->value);
        m->fine = eval_node(s, e, m->value) && all_finite(m->value);
    }
    arb_poly_set(out, m->value);
    return m->fine;
}

/* ---- asking ---- */

static double upper(const arb_t v)
{
    mag_t bound;
    mag_init(bound);
    arb_get_mag(bound, v);
    double out = mag_get_d(bound);
    mag_clear(bound);
    return out;
}

/* The coefficient as a double, and what it is off by at most. */
static double rounded(const nh_ball_series *s, const arb_poly_t p, slong k, double *off)
{
    arb_t c, d;
    arb_init(c);
    arb_init(d);
    arb_poly_get_coeff_arb(c, p, k);
    double out = arf_get_d(arb_midref(c), ARF_RND_NEAR);
    arb_set_d(d, out);
    arb_sub(c, c, d, s->bits);
    *off = upper(c);
    arb_clear(d);
    arb_clear(c);
    return out;
}

/* The terms about the centre. */
static bool take_terms(nh_ball_series *s, nh_ex e, size_t degree, double half, double *coefficient, double *bound)
{
    arb_poly_t p;
    arb_poly_init(p);
    s->terms = (slong)degree;
    bool fine = eval(s, e, p);
    *bound = 0;
    for (size_t k = 0; k < degree && fine; k++) {
        double off;
        coefficient[k] = rounded(s, p, (slong)k, &off);
        *bound += off * pow(half, (double)k);
    }
    forget(s);
    arb_poly_clear(p);
    return fine;
}

/* From one place to the next, a width w further: the integrals there. */
static bool go_on(nh_ball_series *s, const arb_t w)
{
    arb_poly_t f;
    arb_t first;
    arb_poly_init(f);
    arb_init(first);
    bool fine = true;
    for (size_t i = 0; i < s->defined && fine; i++) {
        if (!s->define[i].integral) continue;
        fine = eval(s, s->define[i].of, f);
        arb_poly_get_coeff_arb(first, f, 0);
        arb_addmul(s->at_from + i, first, w, s->bits);
    }
    arb_add(s->from, s->from, w, s->bits);
    arb_clear(first);
    arb_poly_clear(f);
    return fine;
}

/* The largest |a_N| on one side of the centre. */
static bool largest_last(nh_ball_series *s, nh_ex e, const arb_t centre, size_t degree, double step, double *largest)
{
    arb_poly_t p;
    arb_t w, end, last;
    arb_poly_init(p);
    arb_init(w), arb_init(end), arb_init(last);
    arb_set_d(w, step);
    arb_set(s->from, centre);
    for (size_t i = 0; i < s->defined; i++) arb_zero(s->at_from + i);
    s->terms = (slong)degree + 1;
    bool fine = true;
    for (int i = 0; i < pieces && fine; i++) {
        arb_add(end, s->from, w, s->bits);
        arb_union(s->interval, s->from, end, s->bits);
        fine = eval(s, e, p);
        arb_poly_get_coeff_arb(last, p, (slong)degree);
        *largest = fmax(*largest, upper(last));
        fine = fine && go_on(s, w);
        forget(s);
    }
    arb_clear(last), arb_clear(end), arb_clear(w);
    arb_poly_clear(p);
    return fine;
}

bool nh_ball_series_take(nh_ball_series *s, nh_ex e, size_t degree, double half, double *coefficient, double *bound)
{
    static const double upwards = 1 + 1e-12; /* doubles below are rounded to nearest */
    arb_t centre;
    double last = 0;
    arb_init(centre);
    bool fine = nh_ball_eval(s->ball, s->variable, centre);
    arb_set(s->from, centre);
    arb_set(s->interval, centre);
    for (size_t i = 0; i < s->defined; i++) arb_zero(s->at_from + i);
    fine = fine && take_terms(s, e, degree, half, coefficient, bound);
    for (int side = -1; side <= 1 && fine; side += 2)
        fine = largest_last(s, e, centre, degree, side * (upwards * half / pieces), &last);
    if (fine) *bound = upwards * (*bound + last * pow(half, (double)degree));
    arb_clear(centre);
    return fine && isfinite(*bound);
}
