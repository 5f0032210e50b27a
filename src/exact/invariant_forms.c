/* A^T S + S A + c S = 0 for a symmetric S over the field of the parameters (invariant_forms.h): exact elimination.
 *
 *      unknowns     S_00  S_01  S_02 | S_11  S_12 | S_22         n (n + 1)/2, row by row above the diagonal
 *      equations    (A^T S + S A + c S)_ij, i <= j               as many, each of at most 2 n + 1 unknowns
 *
 * Equation after equation: unknowns that are solved are replaced, and the last that remains is solved for. Those that
 * are never solved for are the free ones; each of them at 1, the others at 0, is one form of the basis. */
#include "exact/invariant_forms.h"

#include <string.h>

#include "base/budget.h"
#include "exact/relation_internal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"

/* A linear combination of unknowns: its nonzero entries, in ascending order. */
typedef struct {
    size_t count;
    size_t *unknown;
    const nh_quotient **factor;
} combination;

typedef struct {
    const nh_invariant_question *q;
    nh_relation_question relation;
    nh_quotient_field *field;
    nh_arena *arena, *scratch;
    size_t unknowns;     /* S_ij, i <= j, row by row */
    combination *solved; /* per solved unknown: its value in terms of those before it */
    bool *is_solved;
    const nh_quotient **sum; /* per unknown: its coefficient in the present equation */
    const nh_quotient *minus;
} problem;

static bool fine(const problem *p) { return nh_quotient_field_state_of(p->field) == NH_FIELD_FINE; }

/* A_ij; NULL: it is 0. */
static const nh_quotient *entry(const problem *p, size_t i, size_t j)
{
    const nh_quotient *a = p->relation.value[i * p->q->n + j];
    return nh_quotient_is_zero(p->field, a) ? NULL : a;
}

/* The place of S_ij = S_ji among the unknowns. */
static size_t unknown_at(const problem *p, size_t i, size_t j)
{
    size_t a = i < j ? i : j, b = i < j ? j : i;
    return a * p->q->n - a * (a + 1) / 2 + b;
}

/* ---- one equation ---- */

/* The equation's coefficient of an unknown += factor. */
static void add(problem *p, size_t unknown, const nh_quotient *factor)
{
    const nh_quotient *old = p->sum[unknown];
    const nh_quotient *new = old ? nh_quotient_add(p->field, old, factor) : factor;
    p->sum[unknown] = nh_quotient_is_zero(p->field, new) ? NULL : new;
}

/* (A^T S + S A + c S)_ij */
static void set_equation(problem *p, size_t i, size_t j)
{
    size_t n = p->q->n;
    const nh_quotient *c = p->relation.value[n * n], *a;
    for (size_t k = 0; k < n; k++) {
        if ((a = entry(p, k, i))) add(p, unknown_at(p, k, j), a);
        if ((a = entry(p, k, j))) add(p, unknown_at(p, i, k), a);
    }
    if (!nh_quotient_is_zero(p->field, c)) add(p, unknown_at(p, i, j), c);
}

/* Replaces solved unknowns by their values; returns the index of the last free unknown, or the number of unknowns. */
static size_t reduce(problem *p, size_t last)
{
    size_t highest = p->unknowns;
    for (size_t u = last + 1; u-- > 0 && fine(p);) {
        const nh_quotient *factor = p->sum[u];
        if (!factor) continue;
        if (!p->is_solved[u]) {
            if (highest == p->unknowns) highest = u;
            continue;
        }
        const combination *s = &p->solved[u];
        p->sum[u] = NULL;
        for (size_t k = 0; k < s->count; k++) add(p, s->unknown[k], nh_quotient_mul(p->field, factor, s->factor[k]));
    }
    return highest;
}

/* Writes the coefficients of the unknowns before `unknown`, times `factor`, and clears the sum. */
static void keep(problem *p, size_t unknown, const nh_quotient *factor)
{
    combination *s = &p->solved[unknown];
    s->count = 0;
    for (size_t u = 0; u < unknown; u++) s->count += p->sum[u] != NULL;
    s->unknown = nh_arena_alloc(p->scratch, (s->count + 1) * sizeof *s->unknown);
    s->factor = nh_arena_alloc(p->scratch, (s->count + 1) * sizeof *s->factor);
    for (size_t u = 0, k = 0; u < unknown; u++) {
        if (!p->sum[u]) continue;
        s->unknown[k] = u;
        s->factor[k++] = factor ? nh_quotient_mul(p->field, p->sum[u], factor) : p->sum[u];
        p->sum[u] = NULL;
    }
    p->sum[unknown] = NULL;
    p->is_solved[unknown] = true;
}

/* Solves each equation for the last of its unknowns: the forms are then simplest in the first ones. */
static void eliminate(problem *p)
{
    size_t n = p->q->n;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n && fine(p); j++) {
            set_equation(p, i, j);
            size_t u = reduce(p, p->unknowns - 1);
            if (u < p->unknowns && fine(p))
                keep(p, u, nh_quotient_mul(p->field, p->minus, nh_quotient_inv(p->field, p->sum[u])));
        }
    /* it was solved in terms of an unknown that was free then */
    for (size_t u = 0; u < p->unknowns && fine(p); u++) {
        if (!p->is_solved[u]) continue;
        const combination *s = &p->solved[u];
        for (size_t k = 0; k < s->count; k++) p->sum[s->unknown[k]] = s->factor[k];
        if (u) reduce(p, u - 1);
        keep(p, u, NULL);
    }
}

/* ---- the basis ---- */

/* The entries of S where the unknown `one` is 1 and the other free ones are 0. */
static combination vector_of(const problem *p, size_t one)
{
    combination v = {.unknown = nh_arena_alloc(p->scratch, p->unknowns * sizeof *v.unknown),
                     .factor = nh_arena_alloc(p->scratch, p->unknowns * sizeof *v.factor)};
    for (size_t u = 0; u < p->unknowns; u++) {
        const nh_quotient *value = u == one ? nh_quotient_number(p->field, nh_num_int(1)) : NULL;
        for (size_t k = 0; k < (p->is_solved[u] ? p->solved[u].count : 0); k++)
            if (p->solved[u].unknown[k] == one) value = p->solved[u].factor[k];
        if (!value) continue;
        v.unknown[v.count] = u;
        v.factor[v.count++] = value;
    }
    return v;
}

/* a - b into out, unless that is NULL; returns the number of entries. */
static size_t subtract(const problem *p, const combination *a, const combination *b, combination *out)
{
    size_t i = 0, j = 0, count = 0;
    while (i < a->count || j < b->count) {
        bool first = j == b->count || (i < a->count && a->unknown[i] <= b->unknown[j]),
             second = i == a->count || (j < b->count && b->unknown[j] <= a->unknown[i]);
        size_t u = first ? a->unknown[i] : b->unknown[j];
        if (!(first && second && nh_quotient_equal(p->field, a->factor[i], b->factor[j]))) {
            if (out) {
                const nh_quotient *less = second ? nh_quotient_mul(p->field, p->minus, b->factor[j]) : NULL;
                out->unknown[count] = u;
                out->factor[count] = !first ? less
                                     : less ? nh_quotient_add(p->field, a->factor[i], less)
                                            : a->factor[i];
            }
            count++;
        }
        i += first;
        j += second;
    }
    if (out) out->count = count;
    return count;
}

/* Subtracts another vector from a where the difference has fewer entries: powers of A for a chain fill the matrix, and
 * their differences are bands. */
static void shorten(problem *p, size_t dimension, combination *v, size_t a)
{
    size_t best = dimension, fewest = v[a].count;
    for (size_t b = 0; b < dimension; b++) {
        size_t count = b == a ? fewest : subtract(p, &v[a], &v[b], NULL);
        if (count >= fewest) continue;
        fewest = count;
        best = b;
    }
    if (best == dimension) return;
    combination shorter = {.unknown = nh_arena_alloc(p->scratch, (fewest + 1) * sizeof *shorter.unknown),
                           .factor = nh_arena_alloc(p->scratch, (fewest + 1) * sizeof *shorter.factor)};
    subtract(p, &v[a], &v[best], &shorter);
    v[a] = shorter;
}

static void shorten_all(problem *p, size_t dimension, combination *v)
{
    static const double most = 2e8; /* entries that are compared in one round */
    double entries = 0;
    for (size_t a = 0; a < dimension; a++) entries += (double)v[a].count;
    if (entries * (double)dimension > most) return;
    nh_work_add(NH_WORK_VALUE, entries * (double)dimension);
    for (size_t a = dimension; a-- > 0 && fine(p);) shorten(p, dimension, v, a);
}

/* ---- forms ---- */

/* Terms with the same coefficient up to a rational factor. */
typedef struct {
    nh_ex coefficient, sum;
} bunch;

static void put(nh_dag *d, bunch *list, size_t *count, nh_ex coefficient, nh_ex term)
{
    nh_num number = nh_num_int(1);
    if (nh_kind_of(d, coefficient) == NH_NUMBER) number = nh_number_of(d, coefficient);
    else if (nh_kind_of(d, coefficient) == NH_PRODUCT) number = nh_constant_of(d, coefficient);
    nh_ex rest = nh_div(d, coefficient, nh_number(d, number));
    size_t at = 0;
    while (at < *count && list[at].coefficient != rest) at++;
    if (at == *count) list[(*count)++] = (bunch){rest, nh_int(d, 0)};
    list[at].sum = nh_add(d, list[at].sum, nh_mul(d, nh_number(d, number), term));
}

/* Neighbours are often equal: an expression that was converted is not converted again. */
typedef struct {
    const nh_quotient *value;
    nh_ex written;
} written;

enum { most_written = 16 };

static bool write_factor(problem *p, const nh_quotient *value, written *memory, size_t *used, nh_ex *out)
{
    for (size_t k = 0; k < *used && k < most_written; k++)
        if (nh_quotient_equal(p->field, memory[k].value, value)) {
            *out = memory[k].written;
            return true;
        }
    if (!nh_relation_question_emit(&p->relation, value, out)) return false;
    memory[(*used)++ % most_written] = (written){value, *out};
    return true;
}

/* z.S z of the entries v of S, primitive, terms with one coefficient together. */
static bool write_form(problem *p, const combination *v, nh_ex *out)
{
    nh_dag *d = p->q->dag;
    size_t n = p->q->n, bunches = 0, at = 0, used = 0;
    written memory[most_written];
    bunch *list = nh_alloc_array(v->count + 1, sizeof *list);
    bool good = v->count && nh_relation_make_primitive(p->field, v->count, v->factor);
    for (size_t i = 0; i < n && good; i++)
        for (size_t j = i; j < n && good && at < v->count; j++) {
            nh_ex coefficient;
            if (v->unknown[at] != unknown_at(p, i, j)) continue;
            good = write_factor(p, v->factor[at++], memory, &used, &coefficient);
            if (!good) break;
            nh_ex term = nh_mul(d, nh_int(d, i == j ? 1 : 2), nh_mul(d, p->q->z[i], p->q->z[j]));
            put(d, list, &bunches, coefficient, term);
        }
    *out = nh_int(d, 0);
    for (size_t k = 0; k < bunches; k++) *out = nh_add(d, *out, nh_mul(d, list[k].coefficient, list[k].sum));
    nh_free(list);
    return good;
}

static void write_forms(problem *p, nh_invariant_forms *out)
{
    size_t dimension = 0;
    for (size_t u = 0; u < p->unknowns; u++) dimension += !p->is_solved[u];
    combination *v = nh_alloc_array(dimension + 1, sizeof *v);
    dimension = 0;
    for (size_t u = 0; u < p->unknowns && fine(p); u++)
        if (!p->is_solved[u]) v[dimension++] = vector_of(p, u);
    shorten_all(p, dimension, v);
    out->form = nh_arena_alloc(p->arena, (dimension + 1) * sizeof *out->form);
    for (size_t k = 0; k < dimension && fine(p); k++) out->count += write_form(p, &v[k], &out->form[out->count]);
    nh_free(v);
}

/* ---- the whole ---- */

static bool read_question(problem *p)
{
    const nh_invariant_question *q = p->q;
    size_t n = q->n;
    nh_ex *e = nh_alloc_array(n * n + 1, sizeof *e);
    memcpy(e, q->A, n * n * sizeof *e);
    e[n * n] = q->c;
    /* a common denominator does not matter: the equations are homogeneous in A and c */
    nh_relation_question_init(&p->relation, q->dag, n * n + 1, q->parameters, q->parameter, 0);
    bool good = nh_relation_question_read(&p->relation, e);
    nh_free(e);
    p->field = p->relation.form.field;
    return good;
}

nh_invariant_forms nh_invariant_forms_of(nh_arena *arena, const nh_invariant_question *q)
{
    problem p = {.q = q, .arena = arena, .scratch = nh_arena_create(), .unknowns = q->n * (q->n + 1) / 2};
    nh_invariant_forms out = {0};
    if (read_question(&p)) {
        p.minus = nh_quotient_number(p.field, nh_num_int(-1));
        p.solved = nh_alloc_array(p.unknowns + 1, sizeof *p.solved);
        p.is_solved = nh_alloc_array(p.unknowns + 1, sizeof *p.is_solved);
        p.sum = nh_alloc_array(p.unknowns + 1, sizeof *p.sum);
        eliminate(&p);
        if (fine(&p)) write_forms(&p, &out);
        if (!fine(&p)) out.obstacle = "the coefficients become too long";
    } else {
        out.obstacle = "the coefficients are not exact, or too long";
    }
    nh_free(p.sum);
    nh_free(p.is_solved);
    nh_free(p.solved);
    nh_relation_question_clear(&p.relation);
    nh_arena_free(p.scratch);
    return out;
}
