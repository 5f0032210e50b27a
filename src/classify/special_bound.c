/* Bounds for the sizes of rows, from the terms of the equations of motion as polynomials. */
#include "classify/special_bound.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "exact/form.h"
#include "graph/function.h"
#include "graph/num.h"

enum { most_variables = 16, most_terms = 2000 };

/* size lambda^power q^at sin(q)^sine cos(q)^cosine w^velocity times d/dq_index (derivative) or d/dw_index; before D is
 * multiplied exponents may be negative. */
typedef struct {
    bool derivative;
    size_t index;
    double size;
    int64_t power, at[most_variables], velocity[most_variables], sine[most_variables], cosine[most_variables];
} term;

typedef struct {
    const nh_parametric *family;
    const nh_jet_equations *x;
    nh_dag *dag;
    size_t terms, capacity;
    term *term;
    double whole; /* D = whole lambda^(power) q^(at) sin(q)^(sine) cos(q)^(cosine) */
    int64_t power, at[most_variables], sine[most_variables], cosine[most_variables];
    int64_t turns[most_variables]; /* the highest degree in sin(q_k) and cos(q_k), of D too */
} bound;

/* ---- terms ---- */

/* The exponents of one kernel: false where it is no coordinate, sine or cosine of one, velocity, or the parameter. */
static bool put_exponent(const bound *b, nh_ex kernel, int64_t exponent, term *t)
{
    const nh_jet_equations *x = b->x;
    if (!exponent) return true;
    if (kernel == x->model->parameter[b->family->parameter[0]]) {
        t->power += exponent;
        return true;
    }
    for (size_t k = 0; k < x->coordinates; k++)
        if (kernel == x->coordinate[k]) {
            t->at[k] += exponent;
            return true;
        } else if (kernel == nh_call(b->dag, NH_SIN, x->coordinate[k])) {
            t->sine[k] += exponent;
            return true;
        } else if (kernel == nh_call(b->dag, NH_COS, x->coordinate[k])) {
            t->cosine[k] += exponent;
            return true;
        }
    for (size_t i = 0; i < x->n; i++)
        if (kernel == x->w[i]) {
            t->velocity[i] += exponent;
            return true;
        }
    return false;
}

static bool add_term(bound *b, const nh_form *form, const nh_pieces *p, const nh_factor *f, size_t i, term t)
{
    bool good = b->terms < most_terms && (!f || f->coefficient[i].q == 1);
    t.size = fabs(nh_num_value(p->constant)) * (f ? fabs(nh_num_value(f->coefficient[i])) : 1);
    for (size_t g = 0; g < p->generators && good; g++) {
        int64_t exponent = p->exponent[g] + (f ? f->exponent[i * p->generators + g] : 0);
        good = put_exponent(b, nh_kernel_power(&form->kernels, g, 1), exponent, &t);
    }
    for (size_t k = 0; k < b->x->n; k++) good &= t.velocity[k] >= 0;
    if (!good) return false;
    nh_grow(&b->term, &b->capacity, b->terms + 1, sizeof *b->term);
    b->term[b->terms++] = t;
    return true;
}

static double common_multiple(double a, int64_t b)
{
    int64_t x = (int64_t)a, y = b;
    while (y) {
        int64_t rest = x % y;
        x = y;
        y = rest;
    }
    return a / (double)x * (double)b;
}

/* The terms of one component; its denominators join D.  False: it is not made of whole numbers and monomials. */
static bool add_component(bound *b, nh_forms *forms, nh_arena *arena, nh_ex e, bool derivative, size_t index)
{
    nh_form form;
    nh_pieces p;
    size_t first = b->terms;
    term blank = {.derivative = derivative, .index = index};
    if (nh_is_zero(b->dag, e)) return true;
    bool good = nh_form_make(forms, e, true, &form) == NH_FIELD_FINE &&
                nh_pieces_make(form.field, arena, form.value, false, &p) && p.factors < 2 &&
                (p.factors == 0 || p.factor[0].power == 1);
    if (good && p.factors == 0) good = add_term(b, &form, &p, NULL, 0, blank);
    for (size_t i = 0; good && p.factors && i < p.factor[0].terms; i++)
        good = add_term(b, &form, &p, &p.factor[0], i, blank);
    good = good && p.constant.q > 0;
    if (good) b->whole = common_multiple(b->whole, p.constant.q);
    good = good && b->whole < 1e15;
    nh_form_clear(&form);
    for (size_t i = first; i < b->terms; i++) {
        const term *t = &b->term[i];
        if (-t->power > b->power) b->power = -t->power;
        for (size_t k = 0; k < b->x->coordinates; k++) {
            if (-t->at[k] > b->at[k]) b->at[k] = -t->at[k];
            if (-t->sine[k] > b->sine[k]) b->sine[k] = -t->sine[k];
            if (-t->cosine[k] > b->cosine[k]) b->cosine[k] = -t->cosine[k];
        }
    }
    return good;
}

/* D Gamma, with derivatives along coordinates of the series only. */
static bool read(bound *b)
{
    const nh_jet_equations *x = b->x;
    const nh_model *model = x->model;
    nh_arena *arena = nh_arena_create();
    nh_forms forms;
    bool good = x->coordinates <= most_variables && x->n <= most_variables && !x->time;
    nh_forms_init(&forms, b->dag, false, most_terms);
    for (size_t j = 0; j < b->family->kept && good; j++)
        good = add_component(b, &forms, arena, model->rho[b->family->index[j]], true, b->family->index[j]);
    for (size_t l = 0; l < x->n && good; l++) good = add_component(b, &forms, arena, model->a[l], false, l);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    for (size_t i = 0; i < b->terms; i++) {
        b->term[i].size *= b->whole;
        b->term[i].power += b->power;
        for (size_t k = 0; k < x->coordinates; k++) {
            term *t = &b->term[i];
            t->at[k] += b->at[k];
            int64_t degree = (t->sine[k] += b->sine[k]) + (t->cosine[k] += b->cosine[k]);
            if (degree > b->turns[k]) b->turns[k] = degree;
            if (b->sine[k] + b->cosine[k] > b->turns[k]) b->turns[k] = b->sine[k] + b->cosine[k];
        }
    }
    return good;
}

/* ---- rows ---- */

/* The next exponents of at most this degree; false behind the last ones. */
static bool next(size_t n, size_t degree, size_t *e)
{
    size_t sum = 0, i = 0;
    for (size_t k = 0; k < n; k++) sum += e[k];
    while (i < n && sum == degree) sum -= e[i], e[i++] = 0;
    if (i < n) e[i]++;
    return i < n;
}

/* The size of sine and cosine where the tangent of half the angle is u. */
static double denominator(int64_t q0)
{
    double u = (double)nh_special_bound_tangent(q0);
    return 1 + u * u;
}

/* The contribution of one term to the row of w^beta and the derivative e. */
static double entry(const bound *b, const term *t, size_t degree, const size_t *beta, const size_t *e,
                    const int64_t *q0)
{
    const nh_jet_equations *x = b->x;
    double size = t->size;
    int64_t sum = 0;
    for (size_t i = 0; i < x->n; i++) {
        int64_t alpha = (int64_t)beta[i] - t->velocity[i] + (!t->derivative && i == t->index);
        if (alpha < 0) return 0;
        sum += alpha;
        if (!t->derivative && i == t->index) size *= (double)alpha;
    }
    if (sum > (int64_t)degree) return 0;
    for (size_t k = 0; k < x->coordinates; k++) {
        double further = 0;
        for (size_t j = 0; j < b->family->kept; j++)
            if (b->family->index[j] == k) further = (double)e[j];
        size *= pow(fabs((double)q0[k]) + further, (double)t->at[k]);
        size *= pow(denominator(q0[k]), (double)b->turns[k]) * pow(1 + (double)(t->sine[k] + t->cosine[k]), further);
    }
    return size;
}

static int descending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x < y) - (x > y);
}

/* The number of bits of the largest rows. */
static double largest(const bound *b, size_t degree, nh_parity parity, size_t order, const int64_t *q0, size_t rank)
{
    size_t n = b->x->n, kept = b->family->kept, rows = 0, capacity = 0, beta[most_variables] = {0};
    double *bits = NULL, sum = 0;
    do {
        size_t of_beta = 0, e[most_variables] = {0};
        for (size_t i = 0; i < n; i++) of_beta += beta[i];
        if (parity != NH_ALL_DEGREES && (of_beta % 2 == 0) == (parity == NH_EVEN_DEGREES)) continue;
        do {
            double size = 0;
            for (size_t k = 0; k < b->terms; k++) size += entry(b, &b->term[k], degree, beta, e, q0);
            nh_grow(&bits, &capacity, rows + 1, sizeof *bits);
            bits[rows++] = size > 1 ? log2(size) : 0;
        } while (next(kept, order - 1, e));
    } while (next(n, degree + 1, beta));
    qsort(bits, rows, sizeof *bits, descending);
    for (size_t i = 0; i < rows && i < rank; i++) sum += bits[i];
    nh_free(bits);
    return sum;
}

int64_t nh_special_bound_tangent(int64_t coordinate) { return coordinate + 1; }

bool nh_special_bound_find(const nh_parametric *family, size_t degree, nh_parity parity, size_t order,
                           const int64_t *q0, size_t rank, nh_special_bound *out)
{
    bound b = {.family = family, .x = family->counter.equations, .dag = family->counter.equations->dag, .whole = 1};
    int64_t power = 0;
    bool good = read(&b);
    if (good) {
        double multiplier = log2(b.whole);
        for (size_t k = 0; k < b.x->coordinates; k++)
            multiplier += (double)b.at[k] * log2(fabs((double)q0[k])) + (double)b.turns[k] * log2(denominator(q0[k]));
        for (size_t i = 0; i < b.terms; i++)
            if (b.term[i].power > power) power = b.term[i].power;
        /* what rounding takes away is less */
        out->bits = (largest(&b, degree, parity, order, q0, rank) + multiplier) * (1 + 1e-9) + 1;
        out->degree = (double)rank * (double)power + (double)b.power;
    }
    nh_free(b.term);
    return good;
}
