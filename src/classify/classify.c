/* Special values of one parameter: chi is computed at two points modulo several primes and lifted to the rationals;
 * integrals are counted at every root. */
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "classify/classify_internal.h"
#include "classify/linear_pencil.h"
#include "classify/special_bound.h"

enum { least_primes = 4 };

typedef nh_classify_search search;
typedef nh_classify_place place;

/* ---- roots of chi ---- */

static nh_parity parity_of(const nh_parametric_series *x, size_t degree)
{
    return !x->split ? NH_ALL_DEGREES : degree % 2 ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
}

static bool pencil_of(search *s, const nh_parametric_series *x, size_t degree, nh_sparse_pencil *out,
                      nh_parametric_variable *variable)
{
    *variable = (nh_parametric_variable){0};
    if (s->q->linear) return nh_linear_pencil(&s->family, x, degree, s->q->unknowns, out);
    return nh_parametric_pencil(&s->family, x, degree, parity_of(x, degree), s->q->unknowns, out, variable);
}

/* chi and Q at the point of these series, which are freed. */
static bool roots_of(search *s, size_t degree, nh_parametric_series *x, nh_residue_polynomial *chi,
                     nh_residue_polynomial *Q, nh_classify_row *out)
{
    if (!x) return false;
    nh_sparse_pencil pencil = {0};
    nh_parametric_variable variable;
    bool good = pencil_of(s, x, degree, &pencil, &variable) &&
                nh_staircase(&pencil, x->ring->field, &s->products, chi, &out->nullity);
    if (good) nh_parametric_back(&variable, x->ring->field, chi);
    if (good) {
        Q->degree = x->degree;
        Q->coefficient = nh_alloc_array(x->degree + 1, sizeof *Q->coefficient);
        for (size_t j = 0; j <= x->degree; j++) Q->coefficient[j] = x->coefficient[j * x->length];
        while (Q->degree > 0 && !Q->coefficient[Q->degree]) Q->degree--;
        if (s->out) s->out->limit = !s->q->linear && Q->degree == x->degree;
        out->unknowns = pencil.columns;
        out->power = pencil.degree;
        out->split = x->split;
    }
    nh_free(pencil.entry);
    nh_parametric_series_free(x);
    return good;
}

bool nh_classify_roots(search *s, size_t degree, size_t prime, nh_classify_row *row, nh_special_roots *out)
{
    nh_residue_polynomial chi[2] = {{0}}, Q[2] = {{0}};
    size_t nullity = 0;
    bool good = true;
    for (int k = 0; k < 2 && good; k++) {
        nh_parametric_series *x =
            nh_classify_series(s, nh_classify_prime(s, prime), 101 + 10 * (uint64_t)k, row->number.order);
        good = roots_of(s, degree, x, &chi[k], &Q[k], row);
        if (row->nullity > nullity) nullity = row->nullity;
    }
    row->nullity = nullity;
    if (good) *out = nh_special_common(nh_classify_prime(s, prime), chi, Q);
    for (int k = 0; k < 2; k++) {
        nh_free(chi[k].coefficient);
        nh_free(Q[k].coefficient);
    }
    return good;
}

/* Residues modulo the primes so far: one list for each degree and nullity. */
typedef struct {
    size_t count, nullity;
    nh_prime prime[NH_CLASSIFY_MOST_PRIMES];
    nh_residue_polynomial residue[NH_CLASSIFY_MOST_PRIMES];
} residues;

static void clear(residues *r)
{
    for (size_t i = 0; i < r->count; i++) nh_free(r->residue[i].coefficient);
    r->count = 0;
}

/* A prime at which the degree or the nullity differs is unlucky: the first one, when the second disagrees with it,
 * otherwise the new one. */
static void add(residues *r, nh_prime prime, nh_residue_polynomial p, size_t nullity)
{
    bool other = r->count && (r->residue[0].degree != p.degree || r->nullity != nullity);
    if (r->count == 1 && other) clear(r);
    else if (other) {
        nh_free(p.coefficient);
        return;
    }
    r->nullity = nullity;
    r->prime[r->count] = prime;
    r->residue[r->count++] = p;
}

/* Modulo these primes the roots of both are numbers. */
static bool in_both(const residues *a, const residues *b, size_t i)
{
    bool both = false;
    for (size_t k = 0; k < b->count; k++) both |= a->prime[i].p == b->prime[k].p;
    return both;
}

/* (p_1 p_2 .. / norm)^(1/(degree + 1)): every prime divides b f(a, b), which is at most H^(degree + 1) norm, and no
 * zero where a/b is no root of f. */
static double height(const residues *a, const residues *b, size_t degree, double norm)
{
    double logarithm = -log(norm > 1 ? norm : 1);
    for (size_t i = 0; i < a->count; i++)
        if (in_both(a, b, i)) logarithm += log((double)a->prime[i].p);
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
    *v = (nh_classify_value){
        .polynomial = {.degree = f->degree, .coefficient = nh_alloc_array(f->degree + 1, sizeof *f->coefficient)}};
    memcpy(v->polynomial.coefficient, f->coefficient, (f->degree + 1) * sizeof *f->coefficient);
    return v;
}

static void take_values(search *s, const nh_special_factors *factors, bool degenerate)
{
    for (size_t k = 0; k < factors->factors; k++) value_of(s, &factors->factor[k])->degenerate |= degenerate;
}

/* Counts the integrals of this degree at every value that was found so far. */
static void count_values(search *s, size_t degree)
{
    const nh_classify_row *row = &s->out->row[degree - 1];
    for (size_t k = 0; k < s->out->values && !nh_late(); k++) {
        nh_classify_value *v = &s->out->value[k];
        if (v->degenerate) continue;
        nh_progress("special values", -1);
        place p = {.kind = NH_CLASSIFY_ROOT, .root = &v->polynomial};
        nh_classify_number *n = &v->number[degree];
        bool counted = nh_classify_count(s, degree, &p, row->number.bound, NULL, n),
             more = counted && n->bound > row->number.bound;
        if ((more || !counted) && !v->first && !v->open) v->degenerate = nh_classify_singular(s, &p);
        if (v->degenerate) continue;
        if (more && n->settled && !v->first) v->first = degree;
        if ((!counted || (more && !n->settled)) && !v->open) v->open = degree;
    }
}

/* ---- every number ---- */

enum { coordinates_tried = 27, least_coordinate = 1, choices = 3, unlucky = 20 };

/* The tangent of half the angle is a whole number. */
static void choose_angle(nh_jet_point *point, nh_ex coordinate, int64_t q0)
{
    nh_prime f = point->field;
    nh_residue u = nh_residue_of(f, nh_special_bound_tangent(q0)), square = nh_residue_mul(f, u, u);
    nh_residue inverse = nh_residue_inverse(f, nh_residue_add(f, 1, square));
    for (size_t i = 0; i < point->kernels; i++) {
        nh_jet_kernel *k = &point->kernel[i];
        if (k->kind != NH_JET_CIRCLE || k->key != coordinate || k->order != 1) continue;
        k->value = nh_residue_mul(f, nh_residue_sub(f, 1, square), inverse);
        k->sine = nh_residue_mul(f, nh_residue_add(f, u, u), inverse);
        k->chosen = true;
    }
}

/* Searches whole coordinates at which the nullity modulo a prime is that of the random points, and bounds the length of
 * special values. */
static bool bound_at(search *s, size_t degree, const nh_classify_row *row, int64_t *q0, nh_special_bound *out)
{
    nh_jet_equations *x = s->family.counter.equations;
    bool found = false;
    for (size_t trial = 0; trial < coordinates_tried && !found && !nh_late(); trial++) {
        bool regular = nh_parametric_choose(&s->family, nh_classify_prime(s, 0), trial) && !s->family.counter.frame;
        for (size_t k = 0, rest = trial; k < x->coordinates; k++, rest /= choices) {
            q0[k] = least_coordinate + (int64_t)(rest % choices);
            x->at[k] = (nh_residue)q0[k];
            choose_angle(x->point, x->coordinate[k], q0[k]);
        }
        nh_residue_polynomial chi = {0}, Q = {0};
        nh_classify_row here = {0};
        nh_parametric_series *series =
            regular ? nh_parametric_series_create(&s->family, row->number.order, &regular) : NULL;
        nh_parity parity = series ? parity_of(series, degree) : NH_ALL_DEGREES;
        found = roots_of(s, degree, series, &chi, &Q, &here) && here.nullity == row->nullity;
        if (found && !nh_special_bound_find(&s->family, degree, parity, row->number.order, q0,
                                            here.unknowns - here.nullity, out)) {
            found = false;
            trial = coordinates_tried;
        }
        nh_free(chi.coefficient);
        nh_free(Q.coefficient);
    }
    return found;
}

/* The numbers for both parities add up to the number of integrals; degree - 1 has the other parity. */
static bool is_number(const search *s, size_t degree, const nh_classify_row *row)
{
    size_t other = !row->split ? 0 : degree == 1 ? 1 : s->out->row[degree - 2].nullity;
    return row->nullity + other == row->number.bound;
}

/* A special value that is no root of F, the product of the values, has a primitive polynomial g that divides a minor:
 * its leading coefficient and Mahler's measure are below 2^bits. Every prime divides lc(g) Res(g, F), which is below
 * 2^(bits (1 + deg F)) |F|_1^deg g. */
static void exclude_all(search *s, size_t degree, const residues *excluded, const residues *degenerate,
                        const nh_special_factors *values, const nh_special_factors *nothing, nh_classify_row *row)
{
    nh_jet_equations *x = s->family.counter.equations;
    nh_special_bound bound;
    int64_t *q0 = nh_alloc_array(x->coordinates + 1, sizeof *q0);
    double left = s->products;
    bool known = !s->q->linear && !s->q->two && is_number(s, degree, row) && bound_at(s, degree, row, q0, &bound);
    nh_free(q0);
    if (!known) return;
    double roots = (double)(excluded->residue[0].degree + degenerate->residue[0].degree), have = 0;
    double need = bound.bits * (1 + roots) + bound.degree * log2(values->norm * nothing->norm);
    row->bits = bound.bits;
    row->theorem_primes = (size_t)(need / 30) + 1; /* each has more than 30 bits */
    size_t most = row->theorem_primes <= s->q->theorem ? row->theorem_primes + unlucky : 0;
    for (size_t prime = 0; prime < most && have <= need && !nh_late(); prime++) {
        nh_special_roots found;
        nh_classify_row here = *row;
        s->products = s->q->products;
        if (!nh_classify_roots(s, degree, prime, &here, &found)) break;
        if (here.nullity == row->nullity && nh_special_agrees(values, nh_classify_prime(s, prime), &found.excluded) &&
            nh_special_agrees(nothing, nh_classify_prime(s, prime), &found.degenerate))
            have += log2((double)nh_classify_prime(s, prime).p);
        nh_special_roots_clear(&found);
    }
    s->products = left;
    row->theorem = have > need && (degree == 1 || !row->split || s->out->row[degree - 2].theorem);
}

/* Takes more primes until the values are known as rational or algebraic numbers. */
static bool find_values(search *s, size_t degree, nh_classify_row *row)
{
    residues excluded = {0}, degenerate = {0};
    bool good = true;
    for (size_t prime = 0; prime < NH_CLASSIFY_MOST_PRIMES && good && !row->lifted; prime++) {
        nh_special_roots roots;
        good = nh_classify_roots(s, degree, prime, row, &roots);
        if (!good) break;
        add(&excluded, nh_classify_prime(s, prime), roots.excluded, row->nullity);
        add(&degenerate, nh_classify_prime(s, prime), roots.degenerate, row->nullity);
        if (excluded.count < least_primes || degenerate.count < least_primes) continue;
        nh_special_factors values = nh_special_lift(excluded.count, excluded.prime, excluded.residue);
        nh_special_factors nothing = nh_special_lift(degenerate.count, degenerate.prime, degenerate.residue);
        row->lifted = values.lifted && nothing.lifted;
        if (row->lifted) {
            take_values(s, &nothing, true);
            take_values(s, &values, false);
            size_t roots_known = excluded.residue[0].degree + degenerate.residue[0].degree;
            row->height = height(&excluded, &degenerate, roots_known, values.norm * nothing.norm);
            row->nullity = excluded.nullity;
            exclude_all(s, degree, &excluded, &degenerate, &values, &nothing, row);
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
        /* the other parity was examined one degree lower */
        if (c->rows) row.height = fmin(row.height, c->row[c->rows - 1].height);
        if (!good) {
            c->end = s->family.obstacle    ? s->family.obstacle
                     : nh_late()           ? "time"
                     : !row.number.bounded ? "work"
                     : s->products < 0     ? "staircase"
                                           : "unknowns";
            break;
        }
        c->row[c->rows++] = row;
        count_values(s, degree);
        if (c->limit) nh_classify_count(s, degree, &infinite, row.number.bound, NULL, &c->row[degree - 1].infinite);
    }
    if (c->rows < last_degree(s) && !c->end) c->end = "time";
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
