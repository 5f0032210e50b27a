#include "reduction/measure_conditions.h"

#include <string.h>

#include "base/linalg.h"
#include "exact/generic_value.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"

enum { longest = 3000, most_shape = 6 };

typedef struct {
    nh_arena *arena;
    const nh_slice *s;
    nh_dag *dag;
    size_t n;
    nh_ex *T, *Theta; /* T[(k*n + i)*n + j] */
    nh_measure_conditions *out;
} work;

static nh_ex tidy(const work *w, nh_ex e) { return nh_simplify_short(w->dag, e, longest); }

/* The inverse of K by cofactors, which have no denominators of their own, with each entry as short as possible. */
static bool inverse(const work *w, const nh_ex *K, nh_ex *inv)
{
    size_t n = w->n;
    nh_ex det = tidy(w, nh_solve_determinant(w->dag, n, K)), *minor = nh_alloc_array(n * n + 1, sizeof *minor);
    for (size_t r = 0; r < n; r++)
        for (size_t c = 0; c < n; c++) {
            size_t at = 0;
            for (size_t i = 0; i < n; i++)
                for (size_t j = 0; j < n; j++)
                    if (i != r && j != c) minor[at++] = K[i * n + j];
            nh_ex cofactor = tidy(w, nh_solve_determinant(w->dag, n - 1, minor));
            inv[c * n + r] = tidy(w, nh_div(w->dag, (r + c) % 2 ? nh_neg(w->dag, cofactor) : cofactor, det));
        }
    nh_free(minor);
    return !nh_is_zero(w->dag, det);
}

static nh_ex contracted(const work *w, const nh_ex *inv, const nh_ex *U, size_t k, size_t i, size_t j)
{
    size_t n = w->n;
    nh_ex sum = nh_int(w->dag, 0);
    for (size_t l = 0; l < n; l++)
        if (!nh_is_zero(w->dag, U[(l * n + i) * n + j]))
            sum = nh_add(w->dag, sum, nh_mul(w->dag, inv[k * n + l], U[(l * n + i) * n + j]));
    return tidy(w, sum);
}

/* T^k_ij = (Khat^-1)^kl U_lij at (k n + i) n + j, antisymmetric in i and j, and Theta_j = T^i_ij. */
static bool tensor(work *w, const nh_ex *K, const nh_ex *U)
{
    size_t n = w->n;
    nh_ex *inv = nh_alloc_array(n * n + 1, sizeof *inv), zero = nh_int(w->dag, 0);
    bool good = inverse(w, K, inv);
    for (size_t i = 0; i < n && good; i++)
        for (size_t k = 0; k < n; k++) {
            w->T[(k * n + i) * n + i] = zero;
            for (size_t j = 0; j < i; j++) {
                nh_ex e = contracted(w, inv, U, k, i, j);
                w->T[(k * n + i) * n + j] = e;
                w->T[(k * n + j) * n + i] = nh_neg(w->dag, e);
            }
        }
    for (size_t j = 0; j < n && good; j++) {
        w->Theta[j] = zero;
        for (size_t i = 0; i < n; i++) w->Theta[j] = nh_add(w->dag, w->Theta[j], w->T[(i * n + i) * n + j]);
        w->Theta[j] = tidy(w, w->Theta[j]);
    }
    nh_free(inv);
    return good;
}

static bool same(const nh_parameter_zeros *a, const nh_parameter_zeros *b)
{
    bool equal = a->ways == b->ways;
    for (size_t i = 0; i < a->ways && equal; i++) {
        equal = a->way[i].count == b->way[i].count;
        for (size_t k = 0; k < a->way[i].count && equal; k++)
            equal = a->way[i].polynomial[k] == b->way[i].polynomial[k];
    }
    return equal;
}

/* Adds the condition e = 0, unless it always holds or is in the list. */
static bool demand(work *w, nh_ex e, bool factor)
{
    const nh_system *system = w->s->kinetic->model->system;
    nh_measure_conditions *o = w->out;
    nh_parameter_zeros where;
    const nh_ex *symbol;
    const double *value;
    nh_system_bindings(system, &symbol, &value);
    if (nh_is_zero(w->dag, e)) return true;
    if (!nh_parameter_zeros_find(w->arena, w->dag, e, system->parameters, symbol, &where)) return false;
    if (where.ways == 1 && !where.way[0].count) return true;
    for (size_t i = 0; i < o->count; i++)
        if (same(&o->condition[i].where, &where)) return true;
    o->condition[o->count++] = (nh_measure_condition){factor, where};
    return true;
}

/* d_i Theta_j - d_j Theta_i */
static nh_ex curl(const work *w, size_t i, size_t j)
{
    const nh_ex *x = w->s->x;
    return nh_sub(w->dag, nh_diff(w->dag, w->Theta[j], x[i]), nh_diff(w->dag, w->Theta[i], x[j]));
}

static bool closed(work *w)
{
    bool good = true;
    for (size_t i = 0; i < w->n && good; i++)
        for (size_t j = 0; j < i && good; j++) good = demand(w, tidy(w, curl(w, i, j)), false);
    return good;
}

/* Does the curl of Theta vanish only for exceptional parameters? */
static bool rarely_closed(const work *w)
{
    bool found = false;
    for (size_t i = 0; i < w->n && !found; i++)
        for (size_t j = 0; j < i && !found; j++) {
            nh_ex e = curl(w, i, j);
            found = nh_generic_nonzero(w->dag, 1, &e, w->n, w->s->x);
        }
    return found;
}

static bool simple(work *w)
{
    size_t n = w->n;
    bool good = true;
    for (size_t at = 0; at < n * n * n && good; at++) {
        size_t k = at / (n * n), i = at / n % n, j = at % n;
        nh_ex want = nh_int(w->dag, 0);
        if (j >= i) continue;
        if (k == i) want = nh_add(w->dag, want, w->Theta[j]);
        if (k == j) want = nh_sub(w->dag, want, w->Theta[i]);
        good = demand(w, tidy(w, nh_sub(w->dag, w->T[at], nh_mul(w->dag, nh_ratio(w->dag, 1, (int64_t)n - 1), want))),
                      true);
    }
    return good;
}

/* The conditions in the parameters themselves. */
static void in_all_parameters(work *w, const nh_base_parameters *base)
{
    for (size_t i = 0; i < w->out->count; i++) {
        nh_parameter_zeros *where = &w->out->condition[i].where;
        for (size_t k = 0; k < where->ways; k++)
            for (size_t l = 0; l < where->way[k].count; l++) {
                nh_ex *p = &where->way[k].polynomial[l];
                *p = nh_parameter_zeros_polynomial(
                    w->dag,
                    nh_numerator(w->dag, nh_substitute(w->dag, *p, base->count, base->parameter, base->meaning)));
            }
    }
}

/* The same with fewer parameters. */
static void shorten(work *w, const nh_ex *K, const nh_ex *U)
{
    const nh_system *system = w->s->kinetic->model->system;
    size_t n = w->n, entries = n * n + n * n * n;
    nh_base_parameters base;
    const nh_ex *symbol;
    const double *value;
    nh_ex *entry = nh_alloc_array(entries + 1, sizeof *entry);
    memcpy(entry, K, n * n * sizeof *entry);
    memcpy(entry + n * n, U, n * n * n * sizeof *entry);
    nh_system_bindings(system, &symbol, &value);
    w->out->count = 0;
    if (nh_base_parameters_of(w->arena, w->dag, entries, entry, n, w->s->x, system->parameters, symbol, &base)) {
        w->out->known = tensor(w, entry, entry + n * n) && closed(w) && (n == 2 || simple(w));
        if (w->out->known) in_all_parameters(w, &base);
    }
    nh_free(entry);
}

/* With this parameter zero: are the entries not finite, or is the rank not full? */
static bool degenerate(const work *w, nh_ex parameter, size_t rows, size_t columns, const nh_ex *e)
{
    const nh_kinetic *k = w->s->kinetic;
    nh_ex zero = nh_int(w->dag, 0), *own = nh_alloc_array(rows * columns + 1, sizeof *own);
    double *value = nh_alloc_array(rows * columns + 1, sizeof *value);
    size_t rank;
    for (size_t i = 0; i < rows * columns; i++) own[i] = nh_substitute(w->dag, e[i], 1, &parameter, &zero);
    nh_kinetic_values(k, rows * columns, own, k->place, value);
    bool bad = !nh_all_finite(rows * columns, value) ||
               (nh_kinetic_rank(k, rows, columns, own, &rank) && rank < (rows < columns ? rows : columns));
    nh_free(own);
    nh_free(value);
    return bad;
}

/* A parameter that is zero is no way to a measure where the system ends there: a mass without which the kinetic energy
 * is degenerate, a length without which the constraints are. */
static bool excluded(const work *w, const nh_parameter_zeros_way *way)
{
    const nh_slice *s = w->s;
    nh_ex e = way->count == 1 ? way->polynomial[0] : 0;
    return e && nh_kind_of(w->dag, e) == NH_SYMBOL &&
           (degenerate(w, e, s->m, s->m, s->K) || degenerate(w, e, s->f, s->m, s->omega));
}

/* Does b demand all that a demands? */
static bool contains(const nh_parameter_zeros_way *b, const nh_parameter_zeros_way *a)
{
    size_t found = 0;
    for (size_t i = 0; i < a->count; i++)
        for (size_t k = 0; k < b->count; k++) found += a->polynomial[i] == b->polynomial[k];
    return found == a->count;
}

/* Ways that the system excludes, or that others contain. */
static void leave_out(work *w)
{
    for (size_t i = 0; i < w->out->count; i++) {
        nh_parameter_zeros *where = &w->out->condition[i].where;
        size_t kept = 0;
        bool *keep = nh_alloc_array(where->ways + 1, sizeof *keep);
        for (size_t k = 0; k < where->ways; k++) {
            bool use = !excluded(w, &where->way[k]);
            for (size_t j = 0; j < where->ways && use; j++)
                use = j == k || !contains(&where->way[k], &where->way[j]) ||
                      (k < j && where->way[j].count == where->way[k].count);
            keep[k] = use;
        }
        for (size_t k = 0; k < where->ways; k++)
            if (keep[k]) where->way[kept++] = where->way[k];
        where->ways = kept;
        nh_free(keep);
    }
}

nh_measure_conditions nh_measure_conditions_of(nh_arena *arena, const nh_slice *s, const nh_ex *K, const nh_ex *U)
{
    nh_measure_conditions out = {0};
    size_t n = s->n;
    work w = {.arena = arena, .s = s, .dag = s->dag, .n = n, .out = &out};
    out.condition = nh_arena_alloc(arena, (n * n + n * n * n + 1) * sizeof *out.condition);
    w.T = nh_arena_alloc(arena, (n * n * n + n + 1) * sizeof *w.T);
    w.Theta = w.T + n * n * n;
    bool made = n > 1 && n <= most_shape && tensor(&w, K, U);
    out.known = made && closed(&w) && (n == 2 || simple(&w));
    out.rare = made && !out.known && rarely_closed(&w);
    if (made && !out.known) shorten(&w, K, U);
    if (!out.known) out.count = 0;
    leave_out(&w);
    out.rare &= !out.known;
    for (size_t i = 0; i < out.count; i++)
        if (!nh_parameter_zeros_may_be_positive(s->dag, &out.condition[i].where)) {
            out.never_hamiltonian = true;
            out.never |= !out.condition[i].factor;
        }
    return out;
}
