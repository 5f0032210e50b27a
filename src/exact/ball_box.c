#include "exact/ball_box.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/memory.h"
#include "base/progress.h"
#include "exact/ball_internal.h"
#include "exact/ball_series.h"
#include "graph/num.h"

enum { bits = 128, first_m = 12, last_m = 36, step_m = 8, most_parts = 4, most_places = 40000 };
static const double slack = 1e-12; /* more than rounding of the bounds themselves */

typedef struct {
    const nh_dag *dag;
    const nh_box_equations *e;
    const nh_box_functions *f;
    nh_ball *ball;
    size_t m, nodes;                                          /* per variable */
    double low[NH_BOX_VARIABLES], high[NH_BOX_VARIABLES];     /* of a part of the box */
    arb_ptr table[NH_BOX_VARIABLES], slope[NH_BOX_VARIABLES]; /* nodes x (K + 1): T_k, and its derivative along s_j */
    arb_ptr place[NH_BOX_VARIABLES];                          /* nodes */
    arb_ptr value;                                            /* coefficients of the equations at a place */
    double *worst;                                            /* solutions x equations: of |R_b| at the nodes */
    bool fine;
} box;

static size_t columns(const box *x) { return x->f->degree + 1; }
static size_t functions(const box *x) { return x->f->count * x->e->functions; }
static size_t power(size_t base, size_t exponent)
{
    size_t out = 1;
    while (exponent--) out *= base;
    return out;
}

/* ---- the nodes ---- */

/* Computes T_k(u) and their derivatives by s_j; u = (2 s - low - high)/(high - low) with the decimals of the box. */
static void fill_row(const box *x, size_t j, arb_srcptr s, arb_ptr T, arb_ptr D)
{
    arb_t a, b, u, scale;
    arb_init(a), arb_init(b), arb_init(u), arb_init(scale);
    nh_ball_set_number(x->ball, a, nh_num_decimal(x->f->low[j]));
    nh_ball_set_number(x->ball, b, nh_num_decimal(x->f->high[j]));
    arb_sub(scale, b, a, bits);
    arb_ui_div(scale, 2, scale, bits);
    arb_add(u, a, b, bits);
    arb_mul_2exp_si(u, u, -1);
    arb_sub(u, s, u, bits);
    arb_mul(u, u, scale, bits);
    arb_one(T);
    arb_zero(D);
    for (size_t k = 1; k < columns(x); k++) {
        if (k == 1) {
            arb_set(T + 1, u);
            arb_set(D + 1, scale);
            continue;
        }
        arb_mul(T + k, u, T + k - 1, bits); /* T_k = 2 u T_k-1 - T_k-2 */
        arb_mul_2exp_si(T + k, T + k, 1);
        arb_sub(T + k, T + k, T + k - 2, bits);
        arb_mul(D + k, u, D + k - 1, bits); /* T_k' = 2 T_k-1 + 2 u T_k-1' - T_k-2' */
        arb_addmul(D + k, scale, T + k - 1, bits);
        arb_mul_2exp_si(D + k, D + k, 1);
        arb_sub(D + k, D + k, D + k - 2, bits);
    }
    arb_clear(a), arb_clear(b), arb_clear(u), arb_clear(scale);
}

static void make_tables(box *x)
{
    for (size_t j = 0; j < x->e->variables; j++) {
        x->place[j] = _arb_vec_init((slong)x->nodes);
        x->table[j] = _arb_vec_init((slong)(x->nodes * columns(x)));
        x->slope[j] = _arb_vec_init((slong)(x->nodes * columns(x)));
        for (size_t i = 0; i < x->nodes; i++) {
            arb_ptr s = x->place[j] + i;
            arb_t half;
            arb_init(half);
            arb_set_ui(s, 2 * i + 1);
            arb_div_ui(s, s, 2 * x->nodes, bits);
            arb_cos_pi(s, s, bits);
            arb_set_d(half, (x->high[j] - x->low[j]) / 2);
            arb_mul(s, s, half, bits);
            arb_set_d(half, (x->high[j] + x->low[j]) / 2);
            arb_add(s, s, half, bits);
            arb_clear(half);
            fill_row(x, j, s, x->table[j] + i * columns(x), x->slope[j] + i * columns(x));
        }
    }
}

static void drop_tables(box *x)
{
    for (size_t j = 0; j < x->e->variables; j++) {
        _arb_vec_clear(x->place[j], (slong)x->nodes);
        _arb_vec_clear(x->table[j], (slong)(x->nodes * columns(x)));
        _arb_vec_clear(x->slope[j], (slong)(x->nodes * columns(x)));
    }
}

/* ---- R_b there ---- */

/* Evaluates the residuals at one place from f_a and its derivatives: functions x (1 + variables). */
static void residuals(box *x, arb_srcptr f)
{
    size_t r = x->e->variables, F = x->e->functions, n = functions(x);
    arb_t sum;
    arb_init(sum);
    for (size_t i = 0; i < x->e->equations * F * (r + 1) && x->fine; i++) {
        size_t ba = i / (r + 1), j = i % (r + 1);
        x->fine = nh_ball_eval(x->ball, j ? x->e->along[ba * r + j - 1] : x->e->plain[ba], x->value + i);
    }
    for (size_t k = 0; k < x->f->count && x->fine; k++)
        for (size_t b = 0; b < x->e->equations; b++) {
            arb_zero(sum);
            for (size_t a = 0; a < F; a++)
                for (size_t j = 0; j <= r; j++)
                    arb_addmul(sum, x->value + (b * F + a) * (r + 1) + j, f + j * n + k * F + a, bits);
            double *worst = &x->worst[k * x->e->equations + b];
            *worst = fmax(*worst, nh_ball_upper(sum));
        }
    arb_clear(sum);
}

/* c: (1 + at) x functions x columns^(r - at), the sums over the first `at` variables, then those with the derivative
 * along each of these; the next variable takes its values. */
static void descend(box *x, size_t at, arb_srcptr c)
{
    size_t r = x->e->variables, K = columns(x), n = functions(x), block = power(K, r - at - (at < r));
    if (at == r) {
        residuals(x, c);
        return;
    }
    size_t size = (at + 2) * n * block;
    arb_ptr next = _arb_vec_init((slong)size);
    for (size_t i = 0; i < x->nodes && x->fine && !nh_late(); i++) {
        nh_ball_set_arb(x->ball, x->e->variable[at], x->place[at] + i);
        _arb_vec_zero(next, (slong)size);
        for (size_t v = 0; v < at + 2; v++) {
            arb_srcptr row = (v == at + 1 ? x->slope[at] : x->table[at]) + i * K,
                       from = c + (v == at + 1 ? 0 : v) * n * block * K;
            for (size_t f = 0; f < n; f++)
                for (size_t k = 0; k < K; k++)
                    for (size_t z = 0; z < block; z++) {
                        arb_srcptr term = from + (f * K + k) * block + z;
                        if (!arb_is_zero(term)) arb_addmul(next + (v * n + f) * block + z, term, row + k, bits);
                    }
        }
        descend(x, at + 1, next);
    }
    _arb_vec_clear(next, (slong)size);
}

static void at_nodes(box *x)
{
    size_t r = x->e->variables, K = columns(x), n = functions(x), cube = power(K, r);
    arb_ptr c = _arb_vec_init((slong)(n * cube));
    for (size_t f = 0; f < n; f++)
        for (size_t i = 0; i < x->f->terms; i++) {
            size_t at = 0;
            for (size_t j = 0; j < r; j++) at = at * K + x->f->index[i * r + j];
            arb_set_d(c + f * cube + at, x->f->coefficient[f * x->f->terms + i]);
        }
    make_tables(x);
    descend(x, 0, c);
    drop_tables(x);
    _arb_vec_clear(c, (slong)(n * cube));
}

/* ---- between them ---- */

/* Lebesgue's constant of n Chebyshev nodes is at most this. */
static double lebesgue(size_t n) { return 1 + 2 / M_PI * log((double)n) + slack; }

/* Bounds |A - A~| on this part for each coefficient. */
static bool interpolation(box *x, double *off)
{
    size_t r = x->e->variables, n = x->e->equations * x->e->functions;
    double *bound = nh_alloc_array(n * (r + 1), sizeof *bound);
    bool fine = true;
    for (size_t j = 0; j < r; j++) nh_ball_set_between(x->ball, x->e->variable[j], x->low[j], x->high[j]);
    memset(off, 0, n * (r + 1) * sizeof *off);
    for (size_t j = 0; j < r && fine; j++) {
        double h = (x->high[j] - x->low[j]) / 2,
               factor = pow(lebesgue(x->m + 1), (double)j) * 2 * pow(h / 2 * (1 + slack), (double)x->m + 1);
        nh_ball_series *s = nh_ball_series_create(x->dag, x->ball, x->e->variable[j], 0, NULL);
        fine = nh_ball_series_term(s, n, x->e->plain, x->m + 1, bound) &&
               nh_ball_series_term(s, n * r, x->e->along, x->m + 1, bound + n);
        for (size_t i = 0; i < n * (r + 1) && fine; i++) off[i] += factor * bound[i] * (1 + slack);
        nh_ball_series_free(s);
    }
    nh_free(bound);
    return fine;
}

/* Bounds of |f_a| and its derivatives on the box: sums of |c|, |c| k^2 over the half width. */
static void sizes(const box *x, size_t f, double *out)
{
    size_t r = x->e->variables;
    for (size_t j = 0; j <= r; j++) out[j] = 0;
    for (size_t i = 0; i < x->f->terms; i++) {
        double c = fabs(x->f->coefficient[f * x->f->terms + i]) * (1 + slack);
        out[0] += c;
        for (size_t j = 0; j < r; j++) {
            double k = x->f->index[i * r + j];
            out[1 + j] += c * k * k * 2 / (x->f->high[j] - x->f->low[j]);
        }
    }
}

/* The part of the bound of sum_b |R_b| for solution k that comes from |A - A~|. */
static double between(const box *x, const double *off, size_t k)
{
    size_t r = x->e->variables, F = x->e->functions, n = x->e->equations * F;
    double sum = 0, size[NH_BOX_VARIABLES + 1];
    for (size_t a = 0; a < F; a++) {
        sizes(x, k * F + a, size);
        for (size_t b = 0; b < x->e->equations; b++) {
            sum += off[b * F + a] * size[0];
            for (size_t j = 0; j < r; j++) sum += off[n + (b * F + a) * r + j] * size[1 + j];
        }
    }
    return (1 + pow(lebesgue(x->nodes), (double)r)) * sum;
}

/* ---- parts of the box ---- */

/* Chooses m such that the error between the nodes is small against `wanted`, and computes |A - A~|. */
static bool choose(box *x, double wanted, double *off)
{
    static const double small = 0.05;
    for (x->m = first_m; x->m <= last_m; x->m += step_m) {
        x->nodes = x->f->degree + x->m + 1;
        if (!interpolation(x, off)) return false;
        bool fine = true;
        for (size_t k = 0; k < x->f->count && fine; k++) fine = between(x, off, k) <= small * wanted;
        if (fine) return true;
    }
    return false;
}

static bool part(box *x, double wanted, double *off, double *out)
{
    size_t r = x->e->variables, E = x->e->equations;
    if (!choose(x, wanted, off)) return false;
    memset(x->worst, 0, x->f->count * E * sizeof *x->worst);
    at_nodes(x);
    for (size_t k = 0; k < x->f->count; k++) {
        double sum = 0;
        for (size_t b = 0; b < E; b++) sum += x->worst[k * E + b];
        sum = (pow(lebesgue(x->nodes), (double)r) * sum + between(x, off, k)) * (1 + slack);
        out[k] = fmax(out[k], sum);
        x->fine &= out[k] <= wanted;
    }
    return x->fine && !nh_late();
}

/* Bounds the residuals on each of parts^r equal parts of the box. */
static bool divided(box *x, size_t parts, double wanted, double *off, double *out)
{
    size_t r = x->e->variables, all = power(parts, r);
    memset(out, 0, x->f->count * sizeof *out);
    if ((double)all * pow((double)(x->f->degree + first_m + 1), (double)r) > most_places) return false;
    for (size_t p = 0; p < all; p++) {
        for (size_t j = 0, rest = p; j < r; j++, rest /= parts) {
            double width = (x->f->high[j] - x->f->low[j]) / (double)parts;
            x->low[j] = x->f->low[j] + width * (double)(rest % parts);
            x->high[j] = rest % parts + 1 == parts ? x->f->high[j] : x->f->low[j] + width * (double)(rest % parts + 1);
        }
        if (!part(x, wanted, off, out)) return false;
    }
    return true;
}

bool nh_ball_box_bound(const nh_dag *dag, const nh_box_equations *equations, const nh_box_functions *f, double wanted,
                       double *out)
{
    size_t n = equations->equations * equations->functions * (equations->variables + 1);
    box x = {.dag = dag,
             .e = equations,
             .f = f,
             .ball = nh_ball_create(dag, bits),
             .value = _arb_vec_init((slong)n),
             .worst = nh_alloc_array(f->count * equations->equations + 1, sizeof *x.worst)};
    double *off = nh_alloc_array(n + 1, sizeof *off);
    bool found = false;
    for (size_t parts = 1; parts <= most_parts && !found; parts *= 2) {
        x.fine = true;
        found = divided(&x, parts, wanted, off, out);
    }
    nh_free(off);
    nh_free(x.worst);
    _arb_vec_clear(x.value, (slong)n);
    nh_ball_free(x.ball);
    return found;
}
