/* Special values of one parameter: chi at two points modulo several primes, lifted, and every root counted. */
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "integrals/classify_internal.h"
#include "integrals/linear_pencil.h"

enum { least_primes = 4 };

typedef nh_classify_search search;
typedef nh_classify_place place;

/* ---- roots of chi ---- */

static bool pencil_of(search *s, const nh_parametric_series *x, size_t degree, nh_sparse_pencil *out,
                      nh_parametric_variable *variable)
{
    nh_parity parity = !x->split ? NH_ALL_DEGREES : degree % 2 ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
    *variable = (nh_parametric_variable){0};
    if (s->q->linear) return nh_linear_pencil(&s->family, x, degree, s->q->unknowns, out);
    return nh_parametric_pencil(&s->family, x, degree, parity, s->q->unknowns, out, variable);
}

/* chi and Q at one point. */
static bool roots_at(search *s, const nh_classify_row *row, size_t degree, size_t prime, uint64_t seed,
                     nh_residue_polynomial *chi, nh_residue_polynomial *Q, nh_classify_row *out)
{
    nh_parametric_series *x = nh_classify_series(s, prime, seed, row->number.order);
    if (!x) return false;
    nh_sparse_pencil pencil = {0};
    nh_parametric_variable variable;
    bool good = pencil_of(s, x, degree, &pencil, &variable) && nh_staircase(&pencil, x->ring->field, &s->products, chi);
    if (good) nh_parametric_back(&variable, x->ring->field, chi);
    if (good) {
        Q->degree = x->degree;
        Q->coefficient = nh_alloc_array(x->degree + 1, sizeof *Q->coefficient);
        for (size_t j = 0; j <= x->degree; j++) Q->coefficient[j] = x->coefficient[j * x->length];
        while (Q->degree > 0 && !Q->coefficient[Q->degree]) Q->degree--;
        if (s->out) s->out->limit = !s->q->linear && Q->degree == x->degree;
        out->unknowns = pencil.columns;
        out->power = pencil.degree;
    }
    nh_free(pencil.entry);
    nh_parametric_series_free(x);
    return good;
}

bool nh_classify_roots(search *s, size_t degree, size_t prime, nh_classify_row *row, nh_special_roots *out)
{
    nh_residue_polynomial chi[2] = {{0}}, Q[2] = {{0}};
    bool good = true;
    for (int k = 0; k < 2 && good; k++)
        good = roots_at(s, row, degree, prime, 101 + 10 * (uint64_t)k, &chi[k], &Q[k], row);
    if (good) *out = nh_special_common(nh_prime_at(prime), chi, Q);
    for (int k = 0; k < 2; k++) {
        nh_free(chi[k].coefficient);
        nh_free(Q[k].coefficient);
    }
    return good;
}

/* Residues modulo the primes so far, for those of one degree. */
typedef struct {
    size_t count;
    nh_prime prime[NH_CLASSIFY_MOST_PRIMES];
    nh_residue_polynomial residue[NH_CLASSIFY_MOST_PRIMES];
} residues;

static void clear(residues *r)
{
    for (size_t i = 0; i < r->count; i++) nh_free(r->residue[i].coefficient);
    r->count = 0;
}

/* A prime at which the degree is another is unlucky: the first one, when the second disagrees, otherwise the new
 * one. */
static void add(residues *r, nh_prime prime, nh_residue_polynomial p)
{
    if (r->count == 1 && r->residue[0].degree != p.degree) clear(r);
    if (r->count && r->residue[0].degree != p.degree) {
        nh_free(p.coefficient);
        return;
    }
    r->prime[r->count] = prime;
    r->residue[r->count++] = p;
}

/* (p_1 p_2 .. / norm)^(1/(degree + 1)): every prime divides b f(a, b), which is at most H^(degree + 1) norm, and no
 * zero where a/b is no root of f. */
static double height(const residues *a, const residues *b, size_t degree, double norm)
{
    double logarithm = -log(norm > 1 ? norm : 1);
    for (size_t i = 0; i < a->count; i++) {
        bool both = false;
        for (size_t k = 0; k < b->count; k++) both |= a->prime[i].p == b->prime[k].p;
        if (both) logarithm += log((double)a->prime[i].p);
    }
    return floor(exp(logarithm / (double)(degree + 1)) * (1 - 1e-9));
}

/* ---- values ---- */

static bool same_factor(const nh_special_factor *a, const nh_special_factor *b)
{
    return a->degree == b->degree && !memcmp(a->coefficient, b->coefficient, (a->degree + 1) * sizeof *a->coefficient);
}

static nh_classify_value *value_of(search *s, const nh_special_factor *f)
{
    nh_classification *c = s->out;
    for (size_t k = 0; k < c->values; k++)
        if (same_factor(&c->value[k].polynomial, f)) return &c->value[k];
    nh_grow(&c->value, &c->capacity, c->values + 1, sizeof *c->value);
    nh_classify_value *v = &c->value[c->values++];
    *v = (nh_classify_value){.polynomial = {.degree = f->degree,
                                            .coefficient = nh_alloc_array(f->degree + 1, sizeof *f->coefficient)}};
    memcpy(v->polynomial.coefficient, f->coefficient, (f->degree + 1) * sizeof *f->coefficient);
    return v;
}

static void take_values(search *s, const nh_special_factors *factors, bool degenerate)
{
    for (size_t k = 0; k < factors->factors; k++) value_of(s, &factors->factor[k])->degenerate |= degenerate;
}

/* The integrals of this degree at every value that was found so far. */
static void count_values(search *s, size_t degree)
{
    const nh_classify_row *row = &s->out->row[degree - 1];
    for (size_t k = 0; k < s->out->values && !nh_late(); k++) {
        nh_classify_value *v = &s->out->value[k];
        if (v->degenerate) continue;
        nh_progress("special values", -1);
        place p = {.kind = NH_CLASSIFY_ROOT, .root = &v->polynomial};
        nh_classify_number *n = &v->number[degree];
        bool counted = nh_classify_count(s, degree, &p, row->number.bound, NULL, n), more = counted
            && n->bound > row->number.bound;
        if (more && n->settled && !v->first) v->first = degree;
        if ((!counted || (more && !n->settled)) && !v->open) v->open = degree;
    }
}

/* Modulo more and more primes, until they are numbers. */
static bool find_values(search *s, size_t degree, nh_classify_row *row)
{
    residues excluded = {0}, degenerate = {0};
    bool good = true;
    for (size_t prime = 0; prime < NH_CLASSIFY_MOST_PRIMES && good && !row->lifted; prime++) {
        nh_special_roots roots;
        good = nh_classify_roots(s, degree, prime, row, &roots);
        if (!good) break;
        add(&excluded, nh_prime_at(prime), roots.excluded);
        add(&degenerate, nh_prime_at(prime), roots.degenerate);
        if (excluded.count < least_primes || degenerate.count < least_primes) continue;
        nh_special_factors values = nh_special_lift(excluded.count, excluded.prime, excluded.residue);
        nh_special_factors nothing = nh_special_lift(degenerate.count, degenerate.prime, degenerate.residue);
        row->lifted = values.lifted && nothing.lifted;
        if (row->lifted) {
            take_values(s, &nothing, true);
            take_values(s, &values, false);
            row->height = height(&excluded, &degenerate, excluded.residue[0].degree + degenerate.residue[0].degree,
                                 values.norm * nothing.norm);
        }
        nh_special_factors_clear(&values);
        nh_special_factors_clear(&nothing);
    }
    row->roots = excluded.count ? excluded.residue[0].degree : 0;
    row->primes = excluded.count;
    for (size_t i = 0; i < excluded.count; i++) row->prime[i] = excluded.prime[i].p;
    clear(&excluded);
    clear(&degenerate);
    return good;
}

/* ---- degrees ---- */

static size_t last_degree(const search *s) { return s->q->linear ? s->q->linear->levels : s->q->degree; }

static void run(search *s)
{
    nh_classification *c = s->out;
    while (c->rows < last_degree(s) && !nh_late()) {
        nh_classify_row row = {0};
        size_t degree = c->rows + 1;
        place any = {.kind = NH_CLASSIFY_ANY}, infinite = {.kind = NH_CLASSIFY_INFINITE};
        nh_progress("integrals for almost all values", -1);
        bool good = nh_classify_count(s, degree, &any, 0, &row.known, &row.number);
        nh_progress("where the equations for integrals lose rank", -1);
        s->products = s->q->products;
        good = good && find_values(s, degree, &row) && !nh_late();
        if (s->q->linear && row.number.bound == 0) row.known = 0;
        /* the other parity was looked at one degree lower */
        if (c->rows) row.height = fmin(row.height, c->row[c->rows - 1].height);
        if (!good) {
            c->end = s->family.obstacle ? s->family.obstacle : nh_late() ? "time" : !row.number.bounded ? "work"
                : s->products < 0 ? "staircase" : "unknowns";
            break;
        }
        c->row[c->rows++] = row;
        count_values(s, degree);
        if (c->limit)
            nh_classify_count(s, degree, &infinite, row.number.bound, NULL, &c->row[degree - 1].infinite);
    }
    if (s->family.obstacle && !c->rows) c->obstacle = s->family.obstacle;
    c->step = nh_parametric_step(&s->family);
}

nh_classification *nh_classify(const nh_model *model, const nh_classify_question *q)
{
    nh_classification *out = nh_alloc(sizeof *out);
    search s;
    nh_classify_open(&s, model, q);
    s.out = out;
    if (s.family.obstacle) out->obstacle = s.family.obstacle;
    else run(&s);
    nh_parametric_close(&s.family);
    return out;
}

nh_classification *nh_classification_refused(const char *obstacle)
{
    nh_classification *out = nh_alloc(sizeof *out);
    out->obstacle = obstacle;
    return out;
}

void nh_classification_free(nh_classification *c)
{
    if (!c) return;
    for (size_t k = 0; k < c->values; k++) nh_free(c->value[k].polynomial.coefficient);
    nh_free(c->value);
    nh_free(c);
}
