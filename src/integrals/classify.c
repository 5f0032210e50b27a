/* Special values of one parameter: chi at two points modulo several primes, lifted, and every root counted. */
#include "integrals/classify.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"

enum { least_primes = 4, most_points = 60, steps_beyond = 1, first_beyond = 2, root_primes = 40 };

typedef struct {
    const nh_classify_question *q;
    nh_count_question count;
    nh_parametric family;
    nh_classification *out;
} search;

/* At which value the equations are taken. */
typedef enum { ANY_VALUE, ROOT, INFINITE } value_kind;
typedef struct {
    value_kind kind;
    const nh_special_factor *root;
} place;

typedef enum { DONE, TOO_MUCH } outcome;

/* ---- points ---- */

/* Series at another regular point modulo this prime.  NULL: too long, or none is found. */
static nh_parametric_series *series_at(search *s, size_t prime, uint64_t seed, size_t order)
{
    nh_parametric_series *x = NULL;
    bool regular = false;
    for (uint64_t attempt = 0; attempt < most_points && !regular && !s->family.obstacle && !nh_late(); attempt++)
        if (nh_parametric_choose(&s->family, prime, seed + 1000 * attempt))
            x = nh_parametric_series_create(&s->family, order, &regular);
    return x;
}

/* ---- how many integrals at one value ---- */

/* The residue of the value modulo this prime; false: it has none. */
static bool residue_of(const place *p, nh_prime f, nh_residue *out)
{
    uint64_t random = f.p;
    *out = nh_residue_random(f, &random);
    return p->kind != ROOT || nh_special_root(p->root, f, out);
}

/* N for each order, as in the count of one system. */
static bool totals(search *s, const nh_parametric_series *x, const nh_residue *values, size_t degree, size_t *total,
                   nh_classify_number *out)
{
    nh_parametric *f = &s->family;
    size_t order = x->ring->order, from = 0, n = f->counter.equations->n;
    bool good = true;
    uint64_t random = 31337;
    nh_differentials d = {.n = n, .kept = x->ring->variables, .w = nh_alloc_array(n + 1, sizeof(nh_residue))};
    for (size_t i = 0; i < n; i++) d.w[i] = nh_residue_random(x->ring->field, &random);
    memset(total, 0, (order + 1) * sizeof *total);
    for (int part = 0; part < (x->split ? 2 : 1) && good; part++) {
        nh_graded_problem p = nh_parametric_problem(f, x, values, degree, !x->split ? NH_ALL_DEGREES : part
                                                    ? NH_ODD_DEGREES : NH_EVEN_DEGREES);
        nh_graded_count *g = nh_graded_solve(&p);
        good = g->solved;
        if (!g->injective) from = SIZE_MAX;
        else if (from < g->injective_at) from = g->injective_at;
        f->counter.work += g->work;
        for (size_t k = 0; k <= order; k++) total[k] += g->total[k];
        if (good) nh_count_solutions_differ(g, x->ring->field, &d);
        nh_graded_count_clear(g);
    }
    size_t same = order, step = nh_parametric_step(f);
    while (same > 0 && total[same - 1] == total[order]) same--;
    bool bounded = good && from <= order;
    if (bounded && same < from) same = from;
    *out = (nh_classify_number){.bound = total[order], .order = order, .rank = nh_count_rank(&d, x->ring->field),
                                .counted = good, .bounded = bounded,
                                .settled = bounded && order - same >= step + steps_beyond};
    nh_free(d.row);
    nh_free(d.w);
    return good;
}

/* Orders grow until the number is the least that it can be, or does not change. `known`: for almost all values, of
 * which products are independent. */
static outcome count(search *s, size_t degree, const place *p, size_t least, size_t *known, nh_classify_number *out)
{
    size_t step = 1, prime = 0;
    nh_residue lambda;
    while (prime < root_primes && !residue_of(p, nh_prime_at(prime), &lambda)) prime++;
    if (prime == root_primes) return TOO_MUCH;
    s->family.counter.work = 0;
    for (size_t order = degree + first_beyond; s->family.counter.work < s->count.work
         && !nh_late(); order += step + 1) {
        nh_parametric_series *x = series_at(s, prime, 7 + degree, order);
        if (!x) break;
        if (step != nh_parametric_step(&s->family)) { /* only now it is known */
            step = nh_parametric_step(&s->family);
            order = degree * step - step + first_beyond - 1;
            nh_parametric_series_free(x);
            continue;
        }
        size_t *total = nh_alloc_array(order + 1, sizeof *total);
        nh_residue *values = nh_alloc_array(x->length, sizeof *values);
        nh_count_row row = {0};
        nh_classify_number number;
        nh_parametric_at(x, lambda, p->kind == INFINITE, values);
        bool good = totals(s, x, values, degree, total, &number);
        if (good && known && nh_count_products(&s->family.counter, x->ring, x->coordinate, degree, &row))
            least = *known = row.known;
        nh_free(values);
        nh_free(total);
        nh_parametric_series_free(x);
        if (!good) break;
        *out = number;
        if (number.bounded && (number.bound == least || number.settled)) break;
    }
    return out->bounded ? DONE : TOO_MUCH;
}

/* ---- roots of chi ---- */

/* chi and Q at one point. */
static bool roots_at(search *s, const nh_classify_row *row, size_t degree, size_t prime, uint64_t seed,
                     nh_residue_polynomial *chi, nh_residue_polynomial *Q, nh_classify_row *out)
{
    nh_parametric_series *x = series_at(s, prime, seed, row->number.order);
    if (!x) return false;
    nh_sparse_pencil pencil = {0};
    nh_parametric_variable variable;
    nh_parity parity = !x->split ? NH_ALL_DEGREES : degree % 2 ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
    bool good = nh_parametric_pencil(&s->family, x, degree, parity, s->q->unknowns, &pencil, &variable)
        && nh_staircase(&pencil, x->ring->field, chi);
    if (good) nh_parametric_back(&variable, x->ring->field, chi);
    if (good) {
        Q->degree = x->degree;
        Q->coefficient = nh_alloc_array(x->degree + 1, sizeof *Q->coefficient);
        for (size_t j = 0; j <= x->degree; j++) Q->coefficient[j] = x->coefficient[j * x->length];
        while (Q->degree > 0 && !Q->coefficient[Q->degree]) Q->degree--;
        s->out->limit = Q->degree == x->degree;
        out->unknowns = pencil.columns;
        out->power = pencil.degree;
    }
    nh_free(pencil.entry);
    nh_parametric_series_free(x);
    return good;
}

/* Modulo one prime, at two points. */
static bool roots_modulo(search *s, size_t degree, size_t prime, nh_classify_row *row, nh_special_roots *out)
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
        place p = {ROOT, &v->polynomial};
        nh_classify_number *n = &v->number[degree];
        bool counted = count(s, degree, &p, row->number.bound, NULL, n) == DONE, more = counted
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
        good = roots_modulo(s, degree, prime, row, &roots);
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

static void run(search *s)
{
    nh_classification *c = s->out;
    while (c->rows < s->q->degree && !nh_late()) {
        nh_classify_row row = {0};
        size_t degree = c->rows + 1;
        place any = {.kind = ANY_VALUE}, infinite = {.kind = INFINITE};
        nh_progress("integrals for almost all values", -1);
        bool good = count(s, degree, &any, 0, &row.known, &row.number) == DONE;
        nh_progress("where the equations for integrals lose rank", -1);
        good = good && find_values(s, degree, &row) && !nh_late();
        /* the other parity was looked at one degree lower */
        if (c->rows) row.height = fmin(row.height, c->row[c->rows - 1].height);
        if (!good) {
            c->end = s->family.obstacle ? s->family.obstacle : nh_late() ? "time" : row.number.bounded ? "unknowns"
                : "work";
            break;
        }
        c->row[c->rows++] = row;
        count_values(s, degree);
        if (c->limit) count(s, degree, &infinite, row.number.bound, NULL, &c->row[degree - 1].infinite);
    }
    if (s->family.obstacle && !c->rows) c->obstacle = s->family.obstacle;
    c->step = nh_parametric_step(&s->family);
}

nh_classification *nh_classify(const nh_model *model, const nh_classify_question *q)
{
    nh_classification *out = nh_alloc(sizeof *out);
    search s = {.q = q, .out = out, .count = {.generic = true, .degree = q->degree, .work = q->work, .known = q->known,
                                              .current = q->current}};
    nh_parametric_open(&s.family, model, q->parameter, q->shape, &s.count);
    if (s.family.obstacle) out->obstacle = s.family.obstacle;
    else run(&s);
    nh_parametric_close(&s.family);
    return out;
}

void nh_classification_free(nh_classification *c)
{
    if (!c) return;
    for (size_t k = 0; k < c->values; k++) nh_free(c->value[k].polynomial.coefficient);
    nh_free(c->value);
    nh_free(c);
}
