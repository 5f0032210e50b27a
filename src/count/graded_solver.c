/* Solves the linear system Gamma(Phi) = 0 weight by weight: sparse elimination of the symbol, component by component,
 * and a dense echelon form for the conditions on the parameters. */
#include "count/graded_solver_internal.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "exact/residue_matrix.h"
#include "exact/row_sum.h"

enum { spare_rows = 8, no_alpha = -1 };

/* One term of Gamma: `series` times d/dz_index (derivative) or d/dw^index, which adds the exponent `shift` to alpha. */
typedef struct nh_graded_term {
    bool derivative;
    size_t index;
    const nh_residue *series;
    int *alpha;             /* per target monomial beta: the alpha that it comes from, or no_alpha */
} term;

/* ---- monomials in the velocities ---- */

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
    if (wanted == UINT64_MAX) return no_alpha;
    for (size_t a = 0; a < s->alphas; a++) {
        bool same = true;
        for (size_t i = 0; i < n && same; i++) same = s->alpha[a * n + i] == e[i];
        if (same) return (int)a;
    }
    return no_alpha;
}

/* The index of alpha = beta - shift. */
static void add_term(nh_graded_system *s, bool derivative, size_t index, const nh_residue *series, const int *shift)
{
    size_t n = s->p->n;
    if (nh_jet_is_zero(s->r, series)) return;
    term *t = &s->t[s->terms++];
    *t = (term){derivative, index, series, nh_arena_alloc(s->arena, (s->betas + 1) * sizeof *t->alpha)};
    int *e = nh_alloc_array(n + 1, sizeof *e);
    for (size_t b = 0; b < s->betas; b++) {
        for (size_t i = 0; i < n; i++) e[i] = s->beta[b * n + i] - shift[i];
        t->alpha[b] = nh_graded_find_alpha(s, e);
    }
    nh_free(e);
}

void nh_graded_list_terms(nh_graded_system *s)
{
    const nh_graded_problem *p = s->p;
    size_t n = p->n, m = s->r->variables, e = s->r->size, count = 1 + n + n * (n + 1) / 2;
    int *shift = nh_alloc_array(n + 1, sizeof *shift);
    s->t = nh_arena_alloc(s->arena, (p->fields * m + n * count + 1) * sizeof *s->t);
    for (size_t i = 0; i < p->fields; i++) {
        memset(shift, 0, (n + 1) * sizeof *shift);
        if (i < n) shift[i] = 1;
        for (size_t k = 0; k < m; k++) add_term(s, true, k, p->field + (i * m + k) * e, shift);
    }
    for (size_t l = 0; l < n; l++)
        for (size_t mu = 0, i = 0, j = 0; mu < count; mu++) {
            memset(shift, 0, (n + 1) * sizeof *shift);
            shift[l]--;
            if (mu > 0 && mu <= n) shift[mu - 1]++;
            if (mu > n) {
                shift[i]++;
                shift[j]++;
                if (++j == n) j = ++i;
            }
            add_term(s, false, l, p->rate + (l * count + mu) * e, shift);
        }
    nh_free(shift);
}

/* ---- rows ---- */

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

/* ---- the equations of weight k ---- */

void nh_graded_sum_add(nh_graded_sum *sum, nh_residue factor, const nh_residue *row)
{
    nh_grow(&sum->factor, &sum->factors, sum->count + 1, sizeof *sum->factor);
    nh_grow(&sum->row, &sum->rows, sum->count + 1, sizeof *sum->row);
    sum->factor[sum->count] = factor;
    sum->row[sum->count++] = row;
}

/* The products of a term at the exponents of one weight, without those that are 0, the same for all beta: `value` times
 * the coefficient of `exponent`. */
typedef struct {
    uint32_t exponent;
    nh_residue value;
} product;

typedef struct {
    size_t count, capacity, *start; /* start[i x (exponents + 1) + e]: first product of term i and the e-th exponent */
    product *item;
} products;

/* False: it has exponents beyond weight k + 1, which the coordinates do not have. */
static bool list_products_of(nh_graded_system *s, const term *t, size_t e, products *out)
{
    const nh_jet_ring *r = s->r;
    size_t m = r->variables, last = r->first[s->k + 2];
    for (size_t z = r->pairs[e]; z < r->pairs[e + 1]; z++) {
        nh_residue v = t->series[r->left[z]];
        if (!v) continue;
        uint32_t u = t->derivative ? r->up[t->index * r->size + r->right[z]] : r->right[z];
        if (u == UINT32_MAX || u >= last) return false;
        if (t->derivative) v = nh_residue_mul(s->f, v, r->exponent[u * m + t->index]);
        nh_grow(&out->item, &out->capacity, out->count + 1, sizeof *out->item);
        out->item[out->count++] = (product){u, v};
    }
    return true;
}

static void list_products(nh_graded_system *s, size_t from, size_t exponents, products *out)
{
    out->start = nh_alloc_array(s->terms * (exponents + 1) + 1, sizeof *out->start);
    s->work += (double)s->terms * (double)(s->r->pairs[from + exponents] - s->r->pairs[from]);
    for (size_t i = 0; i < s->terms && !s->over; i++) {
        size_t *start = out->start + i * (exponents + 1);
        start[0] = out->count;
        for (size_t e = 0; e < exponents && !s->over; e++) {
            s->over |= !list_products_of(s, &s->t[i], from + e, out);
            start[e + 1] = out->count;
        }
    }
}

/* The equation of beta and the e-th exponent of the weight: its known part, and its entries of the symbol. */
static void equation(nh_graded_system *s, size_t beta, const size_t *start, const products *all, size_t number,
                     nh_graded_sum *sum)
{
    size_t n = s->p->n, exponents = s->r->first[s->k + 1] - s->r->first[s->k];
    sum->count = 0;
    for (size_t i = 0; i < s->terms; i++) {
        const term *t = &s->t[i];
        const size_t *from = start + i * (exponents + 1);
        if (t->alpha[beta] == no_alpha) continue;
        size_t a = (size_t)t->alpha[beta];
        nh_residue power = t->derivative ? 1 : s->alpha[a * n + t->index];
        s->work += (double)(from[1] - from[0]) + 1;
        for (size_t z = from[0]; z < from[1] && power; z++) {
            size_t u = all->item[z].exponent;
            nh_residue v = power == 1 ? all->item[z].value : nh_residue_mul(s->f, all->item[z].value, power);
            if (u >= s->first) {
                nh_grow(&s->symbol, &s->capacity, s->entries + 1, sizeof *s->symbol);
                s->symbol[s->entries++] = (nh_graded_entry){(uint32_t)(a * s->unknowns_of + (u - s->first)), v};
            } else {
                nh_graded_sum_add(sum, v, nh_graded_row(s, a, u));
                s->work += (double)s->N;
            }
        }
    }
    if (s->extensions) nh_graded_extend(s, beta, s->r->first[s->k] + number % exponents, sum);
    nh_row_sum_add(s->f, s->N, s->known + number * s->N, sum->count, sum->factor, sum->row);
}

static void equations(nh_graded_system *s)
{
    const nh_jet_ring *r = s->r;
    size_t from = r->first[s->k], to = r->first[s->k + 1], count = to - from;
    products all = {0};
    s->first = to;
    s->unknowns_of = r->first[s->k + 2] - to;
    s->equations = s->betas * count;
    s->entries = 0;
    s->known = nh_alloc_array(s->equations * s->N + 1, sizeof *s->known);
    s->start = nh_alloc_array(s->equations + 1, sizeof *s->start);
    list_products(s, from, count, &all);
    nh_graded_sum sum = {0};
    for (size_t q = 0; q < s->equations && !s->over && !nh_late() && s->work < s->p->most_work; q++) {
        s->start[q] = s->entries;
        equation(s, q / count, all.start + q % count, &all, q, &sum);
    }
    s->over |= s->work >= s->p->most_work || nh_late();
    s->start[s->equations] = s->entries;
    nh_free(sum.row);
    nh_free(sum.factor);
    nh_free(all.start);
    nh_free(all.item);
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
    for (size_t q = 0; q < u->rank; q++)
        u->factor[q] = nh_residue_negative(s->f, x[u->columns - 1 - u->pivot[q]]);
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
    equations(s);
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
