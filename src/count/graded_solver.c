/* graded_solver: Gamma(Phi) = 0 weight by weight: sparse elimination of the symbol, component by component, and a
 * dense echelon form for the conditions on the parameters. [docs/method.md, sec. 10, "The algorithm"]
 *
 *     c_alpha at z^e     is a row: its entries are factors of the parameters p_1 .. p_N that are free so far
 *
 *                             p_1  p_2  ..  p_N
 *         row(alpha, e)   [    1    0   ..   0   ]      weight of e at most k: known
 *                         [    3    7   ..   0   ]
 *
 *     weight k:   equations (beta, e)     sum of known rows  +  symbol . (rows of weight k + 1)  =  0
 *                 symbol leaves free      -> new parameters                              graded_symbol.c
 *                 symbol cannot solve     -> conditions on p, in echelon form, used when few parameters survive
 *     N(k + 1) = parameters - conditions */
#include "count/graded_solver_internal.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "exact/residue_matrix.h"
#include "exact/row_sum.h"

enum { spare_rows = 8 };

/* ---- monomials in the velocities ---- */

/* All exponents of w with a sum up to the degree, of this parity (-1: of both); their number. */
static size_t monomials(size_t n, size_t degree, int parity, uint8_t *out)
{
    uint8_t *e = nh_alloc(n + 1);
    size_t count = 0;
    for (bool more = true; more;) {
        size_t sum = 0;
        for (size_t i = 0; i < n; i++) sum += e[i];
        if (sum <= degree && (parity < 0 || (int)(sum % 2) == parity)) {
            if (out) memcpy(out + count * n, e, n);
            count++;
        }
        size_t i = 0;
        while (i < n && (sum >= degree || e[i] == degree)) sum -= e[i], e[i++] = 0;
        more = i < n;
        if (more) e[i]++;
    }
    nh_free(e);
    return count;
}

/* A number for these exponents; UINT64_MAX: they are out of range. */
static uint64_t code(size_t n, size_t degree, const int *e)
{
    uint64_t c = 0;
    for (size_t i = 0; i < n; i++) {
        if (e[i] < 0 || e[i] > (int)degree) return UINT64_MAX;
        c = c * (degree + 2) + (uint64_t)e[i];
    }
    return c;
}

int nh_graded_find_alpha(const nh_graded_system *s, const int *e)
{
    size_t n = s->p->n;
    uint64_t wanted = code(n, s->p->degree, e);
    if (wanted == UINT64_MAX) return -1;
    for (size_t a = 0; a < s->alphas; a++) {
        bool same = true;
        for (size_t i = 0; i < n && same; i++) same = s->alpha[a * n + i] == e[i];
        if (same) return (int)a;
    }
    return -1;
}

/* ---- rows ---- */

/* Twice the room for parameters, up to the limit. */
static void more_room(nh_graded_system *s)
{
    size_t rows = s->alphas * s->r->size, all = rows + s->extensions, old = s->stride;
    if (s->N < old) return;
    size_t stride = old ? 2 * old : 64;
    if (stride > s->p->most_parameters) stride = s->p->most_parameters;
    if (stride <= s->N) {
        s->over = true;
        return;
    }
    nh_residue *wider = nh_alloc_array(all * stride, sizeof *wider),
               *conditions = nh_alloc_array(s->conditions * stride + 1, sizeof *conditions);
    for (size_t i = 0; old && i < all; i++) /* coefficients of higher weights are zero so far and take no memory */
        if (i >= rows || i % s->r->size < s->r->first[s->k + 2])
            memcpy(wider + i * stride, s->row + i * old, s->N * sizeof *wider);
    for (size_t i = 0; old && i < s->conditions; i++)
        memcpy(conditions + i * stride, s->condition + i * old, s->reached * sizeof *conditions);
    nh_free(s->row);
    nh_free(s->condition);
    s->row = wider;
    s->condition = conditions;
    s->stride = stride;
}

void nh_graded_parameter(nh_graded_system *s, size_t alpha, size_t exponent)
{
    more_room(s);
    if (!s->over) nh_graded_row(s, alpha, exponent)[s->N++] = 1;
}

/* ---- conditions on the parameters ---- */

static bool is_last(const nh_graded_system *s) { return s->k + 1 >= s->r->order; }

/* Writes the new conditions into out, as few random combinations of them as can have their rank (fewer conditions only
 * leave more parameters); returns how many. */
static size_t compress(nh_graded_system *s, nh_residue *out)
{
    size_t columns = s->before, wanted = columns - s->conditions + spare_rows;
    for (size_t q = 0; q < s->fresh_count; q++) /* the latest parameters first: they are eliminated */
        for (size_t j = 0; j < columns / 2; j++) {
            nh_residue *row = s->fresh[q], kept = row[j];
            row[j] = row[columns - 1 - j];
            row[columns - 1 - j] = kept;
        }
    if (s->fresh_count <= wanted) {
        for (size_t q = 0; q < s->fresh_count; q++) memcpy(out + q * columns, s->fresh[q], columns * sizeof *out);
        return s->fresh_count;
    }
    uint64_t state = s->k + 1;
    nh_residue *mix = nh_alloc_array(wanted * s->fresh_count, sizeof *mix);
    for (size_t i = 0; i < wanted * s->fresh_count; i++) mix[i] = nh_residue_random(s->f, &state);
    memset(out, 0, wanted * columns * sizeof *out);
    for (size_t i = 0; i < wanted; i++)
        nh_row_sum_add(s->f, columns, out + i * columns, s->fresh_count, mix + i * s->fresh_count,
                       (const nh_residue *const *)s->fresh);
    nh_free(mix);
    s->work += (double)wanted * (double)s->fresh_count * (double)columns;
    return wanted;
}

size_t nh_graded_coefficients_left(const nh_graded_system *s, uint32_t *out)
{
    size_t last = s->r->first[s->k + 2], m = s->r->variables, count = 0;
    bool jets = is_last(s) && !s->p->keep;
    if (jets && out) out[count] = 0;
    count += jets;
    for (size_t k = 0; k < m && jets; k++) {
        uint32_t e = s->r->up[k * s->r->size];
        if (e >= s->r->size) continue;
        if (out) out[count] = e;
        count++;
    }
    for (size_t e = 0; e < last && !jets && out; e++) out[e] = (uint32_t)e;
    return jets ? count : last;
}

/* The row without the parameters that are pivots, for which the conditions stand. */
typedef struct {
    size_t columns, rank, kept, among;
    const size_t *pivot, *from;
    const nh_residue **condition;
    nh_residue *factor;
} substitution;

static void substitute_in(const nh_graded_system *s, const substitution *u, nh_residue *x)
{
    for (size_t q = 0; q < u->rank; q++) u->factor[q] = nh_residue_negative(s->f, x[u->columns - 1 - u->pivot[q]]);
    for (size_t j = 0; j < u->kept; j++) x[j] = x[u->from[j]];
    memset(x + u->kept, 0, (s->N - u->kept) * sizeof *x);
    nh_row_sum_add(s->f, u->among, x, u->rank, u->factor, u->condition);
}

/* Eliminates the parameters that are pivots: each coefficient keeps its entries at the others, plus what its entries at
 * the pivots contribute.  Echelon form in the parameters, the latest first. */
static void substitute(nh_graded_system *s, const nh_residue *echelon, size_t rank, const size_t *pivots)
{
    size_t columns = s->reached, kept = 0, among = 0, left = nh_graded_coefficients_left(s, NULL),
           *from = nh_alloc_array(s->N + 1, sizeof *from);
    uint32_t *exponent = nh_alloc_array(left + 1, sizeof *exponent);
    bool *gone = nh_alloc_array(s->N + 1, sizeof *gone);
    nh_graded_coefficients_left(s, exponent);
    for (size_t q = 0; q < rank; q++) gone[columns - 1 - pivots[q]] = true;
    for (size_t j = 0; j < s->N; j++) {
        if (!gone[j]) from[kept++] = j;
        if (j + 1 == columns) among = kept;
    }
    nh_residue *condition = nh_alloc_array(rank * among + 1, sizeof *condition),
               *factor = nh_alloc_array(rank + 1, sizeof *factor);
    const nh_residue **row = nh_alloc_array(rank + 1, sizeof *row);
    for (size_t q = 0; q < rank; q++) {
        row[q] = condition + q * among;
        for (size_t j = 0; j < among; j++) condition[q * among + j] = echelon[q * columns + columns - 1 - from[j]];
    }
    substitution u = {columns, rank, kept, among, pivots, from, row, factor};
    for (size_t a = 0; a < s->alphas; a++)
        for (size_t i = 0; i < left; i++) substitute_in(s, &u, nh_graded_row(s, a, exponent[i]));
    for (size_t i = 0; i < s->extensions; i++) substitute_in(s, &u, nh_graded_extension(s, i));
    s->work += (double)s->alphas * (double)left * (double)rank * (double)(among + 1);
    s->N = kept;
    nh_free(row);
    nh_free(factor);
    nh_free(condition);
    nh_free(gone);
    nh_free(exponent);
    nh_free(from);
}

/* Does the limit of work allow it? */
static bool may_substitute(nh_graded_system *s, size_t rank)
{
    double left = (double)nh_graded_coefficients_left(s, NULL),
           work = (double)s->alphas * left * (double)rank * (double)(s->reached - rank + 1);
    s->planned = fmax(s->planned, s->work + work);
    s->over |= s->planned > s->p->most_work;
    return !s->over;
}

/* Brings all conditions to echelon form.  Before the end they are substituted only where few parameters survive, and
 * always in a long series, which has few of them. */
static void use_conditions(nh_graded_system *s)
{
    size_t columns = s->before;
    if (!s->fresh_count || !columns) return;
    double rows = (double)s->conditions + fmin((double)s->fresh_count, (double)(columns - s->conditions + spare_rows));
    s->planned = fmax(s->planned, s->work + rows * (double)columns * (double)columns);
    s->over |= s->planned > s->p->most_work;
    if (s->over) return;
    nh_residue *all = nh_alloc_array((s->conditions + s->fresh_count + 1) * columns, sizeof *all);
    for (size_t q = 0; q < s->conditions; q++)
        for (size_t j = 0; j < s->reached; j++) all[q * columns + columns - 1 - j] = s->condition[q * s->stride + j];
    size_t count = s->conditions + compress(s, all + s->conditions * columns),
           *pivot = nh_alloc_array(columns + 1, sizeof *pivot);
    size_t rank = nh_residue_matrix_echelon(s->f, count, columns, columns, all, pivot);
    s->work += (double)count * (double)columns * (double)rank;
    s->reached = columns;
    if (!is_last(s) && (s->p->keep || s->extensions || 4 * (s->N - rank) <= s->N) && may_substitute(s, rank)) {
        substitute(s, all, rank, pivot);
        s->conditions = 0;
    } else {
        nh_free(s->condition);
        s->condition = nh_alloc_array(rank * s->stride + 1, sizeof *s->condition);
        for (size_t q = 0; q < rank; q++)
            for (size_t j = 0; j < columns; j++) s->condition[q * s->stride + columns - 1 - j] = all[q * columns + j];
        s->conditions = rank;
    }
    nh_free(pivot);
    nh_free(all);
}

/* ---- weight by weight ---- */

void nh_graded_solve_weight(nh_graded_system *s, nh_graded_count *out)
{
    s->before = s->N;
    nh_graded_equations(s);
    s->fresh = NULL;
    size_t before = s->N;
    if (!s->over) nh_graded_solve_symbol(s);
    s->over |= nh_late();
    bool fresh = s->N > before;
    out->most = s->N > out->most ? s->N : out->most;
    if (!s->over) use_conditions(s);
    if (fresh) out->injective = false;
    else if (!out->injective) out->injective = true, out->injective_at = s->k + 1;
    out->total[s->k + 1] = s->N - s->conditions;
    nh_free(s->fresh);
    nh_free(s->known);
    nh_free(s->start);
    nh_free(s->symbol);
}

/* The given solutions become the parameters. */
static void start_from(nh_graded_system *s)
{
    enum { room = 16 };
    const nh_graded_problem *p = s->p;
    s->N = p->from;
    s->stride = s->N + room;
    s->row = nh_alloc_array(s->alphas * s->r->size * s->stride, sizeof *s->row);
    for (size_t a = 0; a < s->alphas; a++)
        for (size_t e = 0; e < p->from_size; e++)
            memcpy(nh_graded_row(s, a, e), p->from_series + (a * p->from_size + e) * p->from, p->from * sizeof *s->row);
}

void nh_graded_start(nh_graded_system *s)
{
    const nh_graded_problem *p = s->p;
    int own = p->parity == NH_ALL_DEGREES ? -1 : p->parity == NH_ODD_DEGREES, other = own < 0 ? -1 : 1 - own;
    s->alphas = monomials(p->n, p->degree, own, NULL);
    s->alpha = nh_arena_alloc(s->arena, s->alphas * p->n + 1);
    monomials(p->n, p->degree, own, s->alpha);
    s->betas = monomials(p->n, p->degree + 1, other, NULL);
    s->beta = nh_arena_alloc(s->arena, s->betas * p->n + 1);
    monomials(p->n, p->degree + 1, other, s->beta);
    nh_graded_list_terms(s);
    if (p->from) start_from(s);
    nh_graded_extensions_start(s);
    for (size_t a = 0; a < s->alphas && !s->over && !p->from; a++) nh_graded_parameter(s, a, 0);
}

static void keep_series(nh_graded_system *s, nh_graded_count *out)
{
    size_t rows = s->alphas * s->r->size;
    out->series = nh_arena_alloc(out->arena, rows * s->N * sizeof *out->series + 1);
    for (size_t i = 0; i < rows; i++)
        memcpy(out->series + i * s->N, s->row + i * s->stride, s->N * sizeof *out->series);
}

void nh_graded_substitute_all(nh_graded_system *s)
{
    if (!s->conditions || !may_substitute(s, s->conditions)) return;
    size_t *pivot = nh_alloc_array(s->conditions, sizeof *pivot);
    nh_residue *all = nh_alloc_array(s->conditions * s->reached, sizeof *all);
    for (size_t q = 0; q < s->conditions; q++) {
        for (size_t j = 0; j < s->reached; j++)
            all[q * s->reached + s->reached - 1 - j] = s->condition[q * s->stride + j];
        while (!all[q * s->reached + pivot[q]]) pivot[q]++;
    }
    substitute(s, all, s->conditions, pivot);
    nh_free(all);
    nh_free(pivot);
    s->conditions = 0;
}

void nh_graded_finish(nh_graded_system *s, nh_graded_count *out)
{
    size_t m = s->r->variables;
    s->k = out->order ? out->order - 1 : 0;
    nh_graded_substitute_all(s);
    if (s->over) return;
    out->alphas = s->alphas;
    uint8_t *alpha = nh_arena_alloc(out->arena, s->alphas * s->p->n + 1);
    memcpy(alpha, s->alpha, s->alphas * s->p->n);
    out->alpha = alpha;
    out->jet = nh_arena_alloc(out->arena, s->alphas * (1 + m) * s->N * sizeof *out->jet + 1);
    for (size_t a = 0; a < s->alphas; a++)
        for (size_t k = 0; k <= m; k++) {
            size_t e = k ? s->r->up[(k - 1) * s->r->size] : 0;
            if (e < s->r->size)
                memcpy(out->jet + (a * (1 + m) + k) * s->N, nh_graded_row(s, a, e), s->N * sizeof *out->jet);
        }
    if (s->p->keep) keep_series(s, out);
}
