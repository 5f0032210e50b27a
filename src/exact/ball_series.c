/* Taylor series with rigorous bounds (ball_series.h): every node of the graph once, as a polynomial of balls.
 *
 *       centre - half        centre        centre + half
 *       |----|----|----|----|--+--|----|----|----|----|     terms a_0 .. a_(N-1): balls about the centre
 *                                                           a_N: about each of the pieces, as an interval
 *                                                           |R| <= the largest |a_N| half^N
 *
 * Variables that are defined by others are series, too: a root by the root of its square's series with the sign that
 * it has in the ball, an integral by the integral of its rate's series. On a piece that is not at the centre an
 * integral is enclosed by its value at the piece before, plus the rate on the piece times the distance. */
#include "exact/ball_series.h"

#include <math.h>

#include "base/memory.h"
#include "exact/ball_internal.h"
#include "exact/ball_series_internal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"

/* Pieces of the interval on either side of the centre, and of a step of a move: balls around short pieces are small.
 * beyond: terms after the degree that are bounded at the centre, where balls are points; only the term after them is
 * bounded on pieces.  Then the terms of a step, and the bits of bounds. */
enum { pieces = 4, pieces_of_step = 2, beyond = 4, far = 20, few_bits = 64 };

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
    slong terms;                /* number of terms of the series at present */
    arb_t from, interval;       /* a place, and a ball that contains everything from it to the next place */
    arb_ptr at_from, at_centre; /* per defined symbol: the value of an integral at the place */
    size_t nodes, used;
    memo *of;   /* per node */
    nh_ex *use; /* the nodes that are known */
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
    s->at_centre = _arb_vec_init((slong)defined);
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
    _arb_vec_clear(s->at_centre, (slong)s->defined);
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

/* Depends e on the variable, or on a symbol that is defined? */
static bool moves(const nh_ball_series *s, nh_ex e)
{
    bool any = nh_depends(s->dag, e, s->variable);
    for (size_t i = 0; i < s->defined && !any; i++) any = nh_depends(s->dag, e, s->define[i].symbol);
    return any;
}

/* The integral of f: its value at the place, plus f on the interval times the distance. */
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

/* The root of f with the sign that the symbol has in the ball. */
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

/* base^x in place. */
static bool power(nh_ball_series *s, arb_poly_t base, nh_ex exponent)
{
    if (nh_kind_of(s->dag, exponent) == NH_NUMBER) {
        nh_num x = nh_number_of(s->dag, exponent);
        bool halves = x.q == 1 || x.q == 2;
        if (halves && nh_ball_series_half_power(base, x.p, 2 / x.q, s->terms, s->bits)) return true;
    }
    arb_poly_t x;
    arb_poly_init(x);
    bool fine = eval(s, exponent, x);
    if (fine) nh_ball_series_power(base, x, s->terms, s->bits);
    arb_poly_clear(x);
    return fine;
}

/* A sum with its coefficients, or a product with its exponents. */
static bool eval_terms(nh_ball_series *s, nh_ex e, bool product, arb_poly_t out)
{
    arb_poly_t term;
    arb_t c;
    arb_poly_init(term);
    arb_init(c);
    bool fine = true;
    nh_ball_set_number(s->ball, c, nh_constant_of(s->dag, e));
    arb_poly_set_coeff_arb(out, 0, c);
    for (size_t i = 0; i < nh_arity(s->dag, e) && fine; i++) {
        fine = eval(s, nh_child(s->dag, e, i), term) && (!product || power(s, term, nh_exponent_of(s->dag, e, i)));
        if (fine && product) {
            arb_poly_mullow(out, out, term, s->terms, s->bits);
        } else if (fine) {
            nh_ball_set_number(s->ball, c, nh_coefficient_of(s->dag, e, i));
            arb_poly_scalar_mul(term, term, c, s->bits);
            arb_poly_add(out, out, term, s->bits);
        }
    }
    arb_clear(c);
    arb_poly_clear(term);
    return fine;
}

/* A function of its argument's series. */
static bool eval_function(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    nh_function f = nh_function_of(s->dag, e);
    if (!eval(s, nh_child(s->dag, e, 0), out)) return false;
    if (f != NH_ATAN2) return nh_ball_series_function(f, out, s->terms, s->bits);
    arb_poly_t other;
    arb_poly_init(other);
    bool fine = eval(s, nh_child(s->dag, e, 1), other) && nh_ball_series_angle(out, other, s->terms, s->bits);
    arb_poly_clear(other);
    return fine;
}

/* Keeps a series if all its coefficients are finite; otherwise nothing. */
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
    case NH_SUM: return eval_terms(s, e, false, out);
    case NH_PRODUCT: return eval_terms(s, e, true, out);
    default: return eval_function(s, e, out);
    }
}

/* The series of one node, up to the present length, in `out`; false where it does not exist. */
static bool eval(nh_ball_series *s, nh_ex e, arb_poly_t out)
{
    if (e >= s->nodes) return false;
    memo *m = &s->of[e];
    if (!m->known) {
        m->known = true; /* the table does not move meanwhile */
        s->use[s->used++] = e;
        arb_poly_init(m->value);
        m->fine = eval_node(s, e, m->value) && all_finite(m->value);
    }
    arb_poly_set(out, m->value);
    return m->fine;
}

/* ---- asking ---- */

/* The coefficient as a double, and a bound of its error. */
static double rounded(const nh_ball_series *s, const arb_poly_t p, slong k, double *off)
{
    arb_t c, d;
    arb_init(c);
    arb_init(d);
    arb_poly_get_coeff_arb(c, p, k);
    double out = arf_get_d(arb_midref(c), ARF_RND_NEAR);
    arb_set_d(d, out);
    arb_sub(c, c, d, s->bits);
    *off = nh_ball_upper(c);
    arb_clear(d);
    arb_clear(c);
    return out;
}

/* The terms of each e about the centre, and a bound, at the distance half, of the terms left out and of rounding. */
static bool take_terms(nh_ball_series *s, size_t count, const nh_ex *e, size_t degree, double half, double *coefficient,
                       double *bound)
{
    arb_poly_t p;
    arb_poly_init(p);
    s->terms = (slong)degree + beyond;
    bool fine = true;
    for (size_t i = 0; i < count && fine; i++) {
        fine = eval(s, e[i], p);
        bound[i] = 0;
        for (size_t k = 0; k < degree + beyond && fine; k++) {
            double off, value = rounded(s, p, (slong)k, &off);
            if (k < degree) coefficient[i * degree + k] = value;
            else off += fabs(value);
            bound[i] += off * pow(half, (double)k);
        }
    }
    forget(s);
    arb_poly_clear(p);
    return fine;
}

/* Sets the variable to its centre, and the integrals to their values there. */
static bool stand_at_centre(nh_ball_series *s, arb_t centre)
{
    bool fine = nh_ball_eval(s->ball, s->variable, centre);
    for (size_t i = 0; i < s->defined; i++)
        if (s->define[i].integral) fine = fine && nh_ball_eval(s->ball, s->define[i].symbol, s->at_centre + i);
    arb_set(s->from, centre);
    arb_set(s->interval, centre);
    _arb_vec_set(s->at_from, s->at_centre, (slong)s->defined);
    return fine;
}

/* The integrals at the next place, at distance w. */
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

/* The largest |a_N| of each e on one side of the centre; for a bound few bits suffice. */
static bool largest_last(nh_ball_series *s, size_t count, const nh_ex *e, const arb_t centre, slong degree, int parts,
                         double reach, arb_ptr largest)
{
    arb_poly_t p;
    arb_t w, end, last;
    arb_poly_init(p);
    arb_init(w), arb_init(end), arb_init(last);
    arb_set_d(w, reach / parts);
    arb_set(s->from, centre);
    _arb_vec_set(s->at_from, s->at_centre, (slong)s->defined);
    s->terms = degree + 1;
    long all_bits = s->bits;
    s->bits = few_bits;
    bool fine = true;
    for (int i = 0; i < parts && fine; i++) {
        arb_add(end, s->from, w, s->bits);
        arb_union(s->interval, s->from, end, s->bits);
        for (size_t j = 0; j < count && fine; j++) {
            fine = eval(s, e[j], p);
            arb_poly_get_coeff_arb(last, p, degree);
            arb_abs(last, last);
            arb_max(largest + j, largest + j, last, s->bits);
        }
        fine = fine && go_on(s, w);
        forget(s);
    }
    s->bits = all_bits;
    arb_clear(last), arb_clear(end), arb_clear(w);
    arb_poly_clear(p);
    return fine;
}

bool nh_ball_series_take(nh_ball_series *s, size_t count, const nh_ex *e, size_t degree, double half,
                         double *coefficient, double *bound)
{
    static const double upwards = 1 + 1e-12; /* doubles below are rounded to nearest */
    slong all = (slong)degree + beyond;
    arb_t centre;
    arb_init(centre);
    arb_ptr last = _arb_vec_init((slong)count);
    bool fine = stand_at_centre(s, centre) && take_terms(s, count, e, degree, half, coefficient, bound);
    for (int side = -1; side <= 1 && fine; side += 2)
        fine = largest_last(s, count, e, centre, all, pieces, side * (upwards * half), last);
    for (size_t i = 0; i < count && fine; i++) {
        bound[i] = upwards * (bound[i] + nh_ball_upper(last + i) * pow(half, (double)all));
        fine = isfinite(bound[i]);
    }
    _arb_vec_clear(last, (slong)count);
    arb_clear(centre);
    return fine;
}

/* The symbols' values at a distance from the centre: the terms there, and a bound of the last one on the interval
 * between. */
static bool values_at(nh_ball_series *s, const nh_ex *symbol, const arb_t centre, const arb_t distance, double reach,
                      arb_ptr out)
{
    arb_poly_t p;
    arb_t power;
    arb_poly_init(p);
    arb_init(power);
    arb_ptr last = _arb_vec_init((slong)s->defined);
    s->terms = far;
    bool fine = true;
    for (size_t i = 0; i < s->defined && fine; i++) {
        fine = eval(s, symbol[i], p);
        arb_poly_evaluate(out + i, p, distance, s->bits);
    }
    forget(s);
    fine = fine && largest_last(s, s->defined, symbol, centre, far, pieces_of_step, reach, last);
    arb_pow_ui(power, distance, far, s->bits);
    for (size_t i = 0; i < s->defined && fine; i++) {
        arb_mul(last + i, last + i, power, s->bits);
        arb_add_error(out + i, last + i);
        fine = arb_is_finite(out + i);
    }
    _arb_vec_clear(last, (slong)s->defined);
    arb_clear(power);
    arb_poly_clear(p);
    return fine;
}

/* Moves the variable to a place so near that the terms there fall quickly. */
static bool step_to(nh_ball_series *s, const arb_t to)
{
    static const double upwards = 1 + 1e-12;
    arb_t centre, distance;
    arb_init(centre), arb_init(distance);
    arb_ptr value = _arb_vec_init((slong)s->defined);
    nh_ex *symbol = nh_alloc_array(s->defined + 1, sizeof *symbol);
    for (size_t i = 0; i < s->defined; i++) symbol[i] = s->define[i].symbol;
    bool fine = stand_at_centre(s, centre);
    arb_sub(distance, to, centre, s->bits);
    double reach = upwards * arf_get_d(arb_midref(distance), ARF_RND_NEAR);
    fine = fine && values_at(s, symbol, centre, distance, reach, value);
    if (fine) nh_ball_set_arb(s->ball, s->variable, to);
    for (size_t i = 0; i < s->defined && fine; i++) nh_ball_set_arb(s->ball, symbol[i], value + i);
    nh_free(symbol);
    _arb_vec_clear(value, (slong)s->defined);
    arb_clear(distance), arb_clear(centre);
    return fine;
}

bool nh_ball_series_move(nh_ball_series *s, double to, double step)
{
    enum { most_steps = 1000 };
    static const double rounding = 1e-9;
    arb_t from, end, place;
    arb_init(from), arb_init(end), arb_init(place);
    bool fine = nh_ball_eval(s->ball, s->variable, from);
    arb_set_d(end, to);
    double count = fine ? ceil(fabs(to - arf_get_d(arb_midref(from), ARF_RND_NEAR)) / step - rounding) : 0;
    int steps = (int)fmax(1, fmin(count, most_steps));
    for (int i = 1; i <= steps && fine; i++) {
        arb_sub(place, end, from, s->bits);
        arb_mul_si(place, place, i, s->bits);
        arb_div_si(place, place, steps, s->bits);
        arb_add(place, place, from, s->bits);
        arb_get_mid_arb(place, place);
        fine = step_to(s, i < steps ? place : end);
    }
    arb_clear(place), arb_clear(end), arb_clear(from);
    return fine;
}
