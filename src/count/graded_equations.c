/* graded_equations: the equations of one weight: a known part, in terms of the parameters, and the entries of the
 * symbol.
 *
 *     coefficient of w^beta z^e in Gamma(Phi), weight of e = k          [docs/method.md, (29)]
 *
 *     series times d/dz_j of c_alpha,  alpha = beta - 1_i         weight of the coefficient of c_alpha: k + 1 at most
 *     series times d/dw^l of w^alpha,  alpha = beta + 1_l - mu                                         k at most
 *
 *     weight k + 1: an entry of the symbol      lower: a known row times a residue, added up (exact/row_sum.h) */
#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "count/graded_solver_internal.h"
#include "exact/row_sum.h"

enum { no_alpha = -1 };

/* One term of Gamma: `series` times d/dz_index (derivative) or d/dw^index, which adds the exponent `shift` to alpha. */
typedef struct nh_graded_term {
    bool derivative;
    size_t index;
    const nh_residue *series;
    int *alpha; /* per target monomial beta: the alpha that it comes from, or no_alpha */
} term;

/* ---- the terms of Gamma ---- */

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

/* ---- parts ---- */

size_t nh_graded_parts(double products)
{
    static const double least = 2e5; /* some 0.1 milliseconds: a thread is begun several times in it */
    double parts = floor(products / least);
    return parts < 1 ? 1 : parts < NH_GRADED_PARTS ? (size_t)parts : NH_GRADED_PARTS;
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

/* start[i x (exponents + 1) + e]: first product of term i and the e-th exponent; unknowns: how many of its products are
 * with coefficients of weight k + 1 */
typedef struct {
    size_t exponents, count, capacity, *start, *unknowns;
    product *item;
} products;

/* False: it has exponents beyond weight k + 1, which the coordinates do not have. */
static bool list_products_of(nh_graded_system *s, const term *t, size_t e, products *out, size_t *unknowns)
{
    const nh_jet_ring *r = s->r;
    size_t m = r->variables, last = r->first[s->k + 2];
    for (size_t z = r->pairs[e]; z < r->pairs[e + 1]; z++) {
        nh_residue v = t->series[r->left[z]];
        if (!v) continue;
        uint32_t u = t->derivative ? r->up[t->index * r->size + r->right[z]] : r->right[z];
        if (u == UINT32_MAX || u >= last) return false;
        if (t->derivative) v = nh_residue_mul(s->f, v, r->exponent[u * m + t->index]);
        *unknowns += u >= s->first;
        nh_grow(&out->item, &out->capacity, out->count + 1, sizeof *out->item);
        out->item[out->count++] = (product){u, v};
    }
    return true;
}

static products list_products(nh_graded_system *s, size_t from, size_t exponents)
{
    size_t places = s->terms * (exponents + 1) + 1;
    products out = {.exponents = exponents,
                    .start = nh_alloc_array(places, sizeof *out.start),
                    .unknowns = nh_alloc_array(places, sizeof *out.unknowns)};
    s->work += (double)s->terms * (double)(s->r->pairs[from + exponents] - s->r->pairs[from]);
    for (size_t i = 0; i < s->terms && !s->over; i++) {
        size_t *start = out.start + i * (exponents + 1);
        start[0] = out.count;
        for (size_t e = 0; e < exponents && !s->over; e++) {
            s->over |= !list_products_of(s, &s->t[i], from + e, &out, out.unknowns + i * (exponents + 1) + e);
            start[e + 1] = out.count;
        }
    }
    return out;
}

static void products_clear(products *all)
{
    nh_free(all->start);
    nh_free(all->unknowns);
    nh_free(all->item);
}

/* Makes room for the entries of the symbol: those of equation q are start[q] .. start[q + 1] - 1. */
static void count_entries(nh_graded_system *s, const products *all)
{
    s->start = nh_alloc_array(s->equations + 1, sizeof *s->start);
    for (size_t q = 0; q < s->equations; q++) {
        size_t beta = q / all->exponents, e = q % all->exponents, n = 0;
        for (size_t i = 0; i < s->terms; i++)
            if (s->t[i].alpha[beta] != no_alpha) n += all->unknowns[i * (all->exponents + 1) + e];
        s->start[q + 1] = s->start[q] + n;
    }
    s->symbol = nh_alloc_array(s->start[s->equations] + 1, sizeof *s->symbol);
}

/* The equation of beta and the e-th exponent of the weight: its known part, and its entries of the symbol. */
static void equation(const nh_graded_system *s, const products *all, size_t q, nh_graded_sum *sum)
{
    size_t n = s->p->n, beta = q / all->exponents, e = q % all->exponents;
    nh_graded_entry *entry = s->symbol + s->start[q];
    sum->count = 0;
    for (size_t i = 0; i < s->terms; i++) {
        const term *t = &s->t[i];
        const size_t *from = all->start + i * (all->exponents + 1) + e;
        if (t->alpha[beta] == no_alpha) continue;
        size_t a = (size_t)t->alpha[beta];
        nh_residue power = t->derivative ? 1 : s->alpha[a * n + t->index];
        sum->work += (double)(from[1] - from[0]) + 1;
        for (size_t z = from[0]; z < from[1] && power; z++) {
            size_t u = all->item[z].exponent;
            nh_residue v = power == 1 ? all->item[z].value : nh_residue_mul(s->f, all->item[z].value, power);
            if (u >= s->first) {
                *entry++ = (nh_graded_entry){(uint32_t)(a * s->unknowns_of + (u - s->first)), v};
            } else {
                nh_graded_sum_add(sum, v, nh_graded_row(s, a, u));
                sum->work += (double)s->N;
            }
        }
    }
    if (s->extensions) nh_graded_extend(s, beta, s->r->first[s->k] + e, sum);
    nh_row_sum_add(s->f, s->N, s->known + q * s->N, sum->count, sum->factor, sum->row);
}

typedef struct {
    const nh_graded_system *s;
    const products *all;
    const size_t *from; /* the first equation of each part, and the end */
    double *work;       /* of each part */
} equation_parts;

static void write_equations(size_t part, void *context)
{
    equation_parts *x = context;
    nh_graded_sum sum = {0};
    for (size_t q = x->from[part]; q < x->from[part + 1]; q++) {
        if (nh_late() || x->s->work + sum.work >= x->s->p->most_work) break;
        equation(x->s, x->all, q, &sum);
    }
    x->work[part] = sum.work;
    nh_free(sum.row);
    nh_free(sum.factor);
}

void nh_graded_equations(nh_graded_system *s)
{
    const nh_jet_ring *r = s->r;
    size_t from = r->first[s->k], to = r->first[s->k + 1], first[NH_GRADED_PARTS + 1];
    double work[NH_GRADED_PARTS] = {0};
    s->first = to;
    s->unknowns_of = r->first[s->k + 2] - to;
    s->equations = s->betas * (to - from);
    s->known = nh_alloc_array(s->equations * s->N + 1, sizeof *s->known);
    products all = list_products(s, from, to - from);
    count_entries(s, &all);
    size_t parts = nh_graded_parts((double)s->betas * (double)all.count * (double)s->N);
    for (size_t i = 0; i <= parts; i++) first[i] = s->equations * i / parts;
    if (!s->over) nh_parallel(parts, s->p->threads, write_equations, &(equation_parts){s, &all, first, work});
    for (size_t i = 0; i < parts; i++) s->work += work[i];
    s->over |= s->work >= s->p->most_work || nh_late();
    products_clear(&all);
}
