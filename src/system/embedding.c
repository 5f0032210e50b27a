#include "system/embedding.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/text.h"
#include "exact/ball.h"
#include "exact/generic_value.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "system/domain.h"
#include "system/embedding_internal.h"
#include "system/levels.h"
#include "system/sample.h"

const double nh_chart_least_pivot = 0.02;

enum { probe_count = 24, newton_steps = 40 };

/* ---- the sampling box ---- */

/* ---- the parts that both kinds of chart share ---- */

nh_chart *nh_embedding_new(nh_system *system, const char *name, size_t n, size_t implicit)
{
    nh_arena *arena = nh_arena_create();
    nh_chart *c = nh_arena_alloc(arena, sizeof *c);
    size_t m = system->coordinates, width = 1 + m + n + implicit;
    *c = (nh_chart){.system = system, .arena = arena, .n = n, .implicit = implicit, .width = width, .pivot = 1};
    c->name = nh_arena_strdup(arena, name);
    c->w = nh_arena_alloc(arena, (n + 1) * sizeof *c->w);
    c->rho = nh_arena_alloc(arena, (m + 1) * sizeof *c->rho);
    c->u = nh_arena_alloc(arena, (implicit + 1) * sizeof *c->u);
    c->residual = nh_arena_alloc(arena, (implicit + 1) * sizeof *c->residual);
    c->dependent = nh_arena_alloc(arena, (system->constraints + 1) * sizeof *c->dependent);
    c->root_of = nh_arena_alloc(arena, (system->constraints + 1) * sizeof *c->root_of);
    c->free = nh_arena_alloc(arena, (n + 1) * sizeof *c->free);
    c->symbol = nh_arena_alloc(arena, width * sizeof *c->symbol);
    c->low = nh_arena_alloc(arena, width * sizeof *c->low);
    c->high = nh_arena_alloc(arena, width * sizeof *c->high);
    c->probe = nh_arena_alloc(arena, probe_count * width * sizeof *c->probe);
    return c;
}

void nh_embedding_symbols(nh_chart *c)
{
    const nh_system *system = c->system;
    size_t k = 0;
    c->symbol[k++] = system->t;
    for (size_t i = 0; i < system->coordinates; i++) c->symbol[k++] = system->coordinate[i].q;
    for (size_t i = 0; i < c->n; i++) c->symbol[k++] = c->w[i];
    for (size_t i = 0; i < c->implicit; i++) c->symbol[k++] = c->u[i];
    for (size_t i = 0; i < c->width; i++) nh_domain_range(system, c->symbol[i], &c->low[i], &c->high[i]);
}

void nh_chart_range(const nh_chart *c, nh_ex symbol, double *low, double *high)
{
    nh_domain_range(c->system, symbol, low, high);
}

double nh_chart_symbol_unit(const nh_system *system, nh_ex symbol)
{
    double unit = 1;
    for (size_t k = 0; k < system->intervals; k++)
        if (system->interval[k].symbol == symbol) unit = (system->interval[k].high - system->interval[k].low) / 2;
    return unit > 0 && isfinite(unit) ? unit : 1;
}

double nh_chart_unit(const nh_system *system, size_t i)
{
    return nh_chart_symbol_unit(system, system->coordinate[i].q);
}

void nh_chart_slopes(const nh_chart *c, double *factor)
{
    const nh_system *system = c->system;
    size_t m = system->coordinates;
    for (size_t j = 0; j < c->n; j++) {
        size_t own = m;
        for (size_t i = 0; i < m && !c->quasi; i++)
            if (c->w[j] == system->coordinate[i].v) own = i;
        for (size_t i = 0; i < m; i++)
            factor[i * c->n + j] = own < m ? nh_chart_unit(system, own) / nh_chart_unit(system, i) : 1;
    }
}

void nh_chart_free(nh_chart *chart)
{
    if (!chart) return;
    nh_tape_free(chart->newton);
    nh_arena_free(chart->arena);
}

nh_ex nh_chart_compose(const nh_chart *c, nh_ex e)
{
    const nh_system *system = c->system;
    nh_ex *v = nh_alloc_array(system->coordinates + 1, sizeof *v);
    for (size_t i = 0; i < system->coordinates; i++) v[i] = system->coordinate[i].v;
    e = nh_substitute(system->dag, e, system->coordinates, v, c->rho);
    nh_free(v);
    return e;
}

nh_ex nh_chart_constraint(const nh_chart *c, size_t a)
{
    const nh_constraint *f = &c->system->constraint[a];
    return nh_sub(c->system->dag, f->lhs, f->rhs);
}

bool nh_chart_complete(const nh_chart *c, double *z)
{
    size_t k = c->implicit;
    if (!k) return true;
    double *u = z + c->width - k, *out = nh_alloc_array(k + k * k, sizeof *out), *jacobian = out + k;
    nh_tape_work *work = nh_tape_work_create(c->newton);
    double last = INFINITY, speed = 0;
    bool good = false;
    for (double *w = u - c->n; w < u; w++) speed = fmax(speed, fabs(*w));
    for (int step = 0; step < newton_steps && !good; step++) {
        double size = 0, norm = 0, largest = speed;
        nh_tape_eval(c->newton, work, z, out);
        for (size_t i = 0; i < k; i++) norm = fmax(norm, fabs(out[i]));
        if (!isfinite(norm) || !nh_solve(k, jacobian, 1, out, NULL)) break;
        for (size_t i = 0; i < k; i++) {
            largest = fmax(largest, fabs(u[i]));
            size = fmax(size, fabs(out[i]));
            u[i] -= out[i];
        }
        bool stays = size >= 0.5 * last; /* as of a velocity that is zero up to rounding of the others */
        good = size <= 4e-16 * largest || (stays && size < 1e-13 * fmax(largest, 1e-2));
        last = size;
    }
    nh_tape_work_free(work);
    nh_free(out);
    return good;
}

/* ---- least pivot over the probes ---- */

static const double rounding = 1e-13;

bool nh_embedding_vanishes(const nh_system *system, size_t width, const nh_ex *symbol, size_t points,
                           const double *point, nh_ex e)
{
    enum { bits = 512, tried = 3, digits = 100 };
    if (nh_declared_has_table(system->dag)) return true; /* balls do not know tables: doubles decide, which see zero */
    nh_ball *ball = nh_ball_create(system->dag, bits);
    bool zero = true;
    for (size_t i = 0; i < system->parameters; i++)
        nh_ball_set_expression(ball, system->parameter[i].symbol,
                               nh_number(system->dag, nh_num_decimal(system->parameter[i].value)));
    for (size_t p = 0; p < points && p < tried && zero; p++) {
        double size;
        for (size_t j = 0; j < width; j++) nh_ball_set_double(ball, symbol[j], point[p * width + j]);
        zero = !nh_ball_log10_bound(ball, e, &size) || size < -digits;
    }
    nh_ball_free(ball);
    return zero;
}

/* Implicit velocities are known as doubles only: they cannot be evaluated with more digits. */
static bool vanishes(const nh_chart *c, nh_ex e)
{
    return c->implicit || nh_embedding_vanishes(c->system, c->width, c->symbol, c->probes, c->probe, e);
}

double nh_embedding_score(void *context, nh_ex e)
{
    const nh_chart *c = context;
    const nh_ex *symbols;
    const double *values;
    nh_system_bindings(c->system, &symbols, &values);
    nh_tape *tape = nh_tape_create(c->system->dag, c->width, c->symbol, 1, &e, c->system->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < c->probes; i++) {
        double x;
        nh_tape_eval(tape, work, c->probe + i * c->width, &x);
        if (!isfinite(x)) continue;
        least = fmin(least, fabs(x));
        most = fmax(most, fabs(x));
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    if (!isfinite(least) || (most < rounding && vanishes(c, e))) return 0;
    return least + 1e-12 * most;
}

double nh_embedding_score_at_start(void *context, nh_ex e)
{
    static const double last_choice = 1e-6;
    const nh_chart *c = context;
    const nh_system *system = c->system;
    double least = nh_embedding_score(context, e), value = 0, size = 0;
    if (!system->start || least == 0) return least;
    const nh_ex *symbols;
    const double *values;
    nh_ex *in = nh_alloc_array(1 + 2 * system->coordinates, sizeof *in);
    in[0] = system->t;
    for (size_t i = 0; i < system->coordinates; i++)
        in[1 + i] = system->coordinate[i].q, in[1 + system->coordinates + i] = system->coordinate[i].v;
    nh_system_bindings(system, &symbols, &values);
    nh_tape *tape =
        nh_tape_create(system->dag, 1 + 2 * system->coordinates, in, 1, &e, system->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, system->start, &value);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(in);
    size = isfinite(value) ? fabs(value) : 0;
    return size > last_choice * least ? fmin(least, size) : last_choice * least;
}

double nh_chart_pivot_score(void *chart, nh_ex e) { return nh_embedding_score(chart, e); }

/* ---- the user's quasi-velocities ---- */

static void probes_of_quasi(nh_chart *c, uint64_t seed)
{
    nh_sampler *sampler = nh_sampler_create(c->width, c->low, c->high, seed);
    for (c->probes = 0; c->probes < probe_count; c->probes++) nh_sampler_next(sampler, c->probe + c->probes * c->width);
    nh_sampler_free(sampler);
}

/* |f| relative to sum_j |df/dv_j v_j| + |f - sum_j df/dv_j v_j|, the terms that the constraint f = 0 balances, on the
 * image of the chart. */
static double off_constraint(const nh_chart *c, size_t a, nh_ex f)
{
    const nh_system *system = c->system;
    nh_dag *d = system->dag;
    const nh_ex *symbols;
    const double *values;
    nh_system_bindings(system, &symbols, &values);
    nh_ex out[2] = {f, nh_int(d, 0)}, rest = f;
    for (size_t j = 0; j < system->coordinates; j++) {
        nh_ex slope = nh_chart_compose(c, nh_diff(d, nh_chart_constraint(c, a), system->coordinate[j].v));
        rest = nh_sub(d, rest, nh_mul(d, slope, c->rho[j]));
        out[1] = nh_add(d, out[1], nh_call(d, NH_ABS, nh_mul(d, slope, c->rho[j])));
    }
    out[1] = nh_add(d, out[1], nh_call(d, NH_ABS, rest));
    nh_tape *tape = nh_tape_create(d, c->width, c->symbol, 2, out, system->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    double worst = 0, value[2];
    for (size_t i = 0; i < c->probes; i++) {
        nh_tape_eval(tape, work, c->probe + i * c->width, value);
        if (isfinite(value[0]) && value[0] != 0) worst = fmax(worst, fabs(value[0]) / value[1]);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return worst;
}

/* Do the constraints hold on the image of the chart? */
static bool chart_satisfies(const nh_chart *c, nh_error *error)
{
    static const double allowed = 1e-10;
    const nh_system *system = c->system;
    for (size_t a = 0; a < system->constraints; a++) {
        nh_ex f = nh_chart_compose(c, nh_chart_constraint(c, a));
        if (nh_normal_is_zero(system->dag, f, 0) == NH_ZERO) continue;
        double worst = off_constraint(c, a, f);
        if (worst < allowed) continue;
        nh_deck_fail(
            system->deck, system->constraint[a].node, 0, error,
            "the velocities' map does not satisfy this constraint (off by %.2g of its terms at a sample point)", worst);
        return nh_error_hint(error, "substitute the map into the constraint: it must vanish for all quasi-velocities");
    }
    return true;
}

/* Divide count elements, every stride-th of a, by the largest of them. */
static void divide_by_largest(size_t count, size_t stride, double *a)
{
    double most = 0;
    for (size_t i = 0; i < count; i++) most = fmax(most, fabs(a[i * stride]));
    for (size_t i = 0; i < count && most > 0; i++) a[i * stride] /= most;
}

size_t nh_embedding_rank(size_t m, size_t n, double *a)
{
    static const double tolerance = 1e-10;
    size_t rank = 0, small = m < n ? m : n;
    double *s = nh_alloc_array(small + 1, sizeof *s);
    for (size_t i = 0; i < m; i++) divide_by_largest(n, m, a + i);
    for (size_t j = 0; j < n; j++) divide_by_largest(m, 1, a + j * m);
    if (nh_all_finite(m * n, a) && nh_svd(m, n, a, s, NULL, NULL))
        while (rank < small && s[rank] > tolerance * s[0]) rank++;
    nh_free(s);
    return rank;
}

/* The shortest column beside the longest. */
static double evenness(size_t m, size_t n, const double *a)
{
    double least = INFINITY, most = 0;
    for (size_t j = 0; j < n; j++) {
        double length = 0;
        for (size_t i = 0; i < m; i++) length = fmax(length, fabs(a[i + j * m]));
        least = fmin(least, length);
        most = fmax(most, length);
    }
    return most > 0 ? least / most : 0;
}

/* The rank of d rho/dw: exact, or else (*exact is false) by numbers, *usable: the largest one over the probes, without
 * what doubles cannot tell from dependence; *even: how alike in size the columns are, at best. */
static size_t rank_of_map(const nh_chart *c, double *even, size_t *usable, bool *exact)
{
    nh_dag *d = c->system->dag;
    size_t m = c->system->coordinates, n = c->n, best = 0;
    const nh_ex *symbols;
    const double *values;
    nh_system_bindings(c->system, &symbols, &values);
    nh_ex *R = nh_alloc_array(m * n, sizeof *R);
    for (size_t i = 0; i < m * n; i++) R[i] = nh_diff(d, c->rho[i % m], c->w[i / m]);
    nh_tape *tape = nh_tape_create(d, c->width, c->symbol, m * n, R, c->system->parameters, symbols, values);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *a = nh_alloc_array(m * n, sizeof *a);
    for (size_t p = 0; p < c->probes; p++) {
        nh_tape_eval(tape, work, c->probe + p * c->width, a);
        *even = fmax(*even, evenness(m, n, a));
        size_t rank = nh_embedding_rank(m, n, a);
        if (rank > best) best = rank;
    }
    for (size_t i = 0; i < m * n; i++) R[i] = nh_system_values(c->system, d, R[i]);
    size_t rank = 0;
    *exact = nh_generic_rank(d, n, m, R, &rank); /* columns of d rho/dw as rows */
    nh_free(a);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(R);
    *usable = best;
    return *exact ? rank : best;
}

static bool velocities_independent(const nh_chart *c, nh_error *error)
{
    static const double least_even = 1e-10;
    double even = 0;
    bool exact;
    size_t usable, rank = rank_of_map(c, &even, &usable, &exact);
    if (usable == c->n && even > least_even) return true;
    const nh_deck *deck = c->system->deck;
    const nh_deck_node *node = nh_deck_get(nh_deck_root(deck), "velocities");
    if (rank == c->n && usable < c->n) {
        nh_deck_fail(deck, node, 0, error,
                     "the quasi-velocities hardly differ: in double precision the map reaches %zu dimensions, not %zu",
                     usable, c->n);
        return nh_error_hint(error, "choose quasi-velocities that move the system in clearly different directions");
    }
    if (rank == c->n) {
        nh_deck_fail(deck, node, 0, error,
                     "the quasi-velocities differ too much in size: by the map one is %.0e times as fast as another",
                     1 / even);
        return nh_error_hint(error, "give them units in which they are of similar size");
    }
    nh_deck_fail(deck, node, 0, error,
                 "the velocities' map reaches a space of velocities of dimension %zu with %zu quasi-velocities%s", rank,
                 c->n, exact ? "" : " (by numbers)");
    return nh_error_hint(error, "the quasi-velocities must be independent: each must add a direction of motion");
}

static nh_chart *quasi_chart(nh_system *system, uint64_t seed, nh_error *error)
{
    nh_text name;
    nh_text_init(&name);
    nh_text_add(&name, "quasi-velocities (");
    for (size_t i = 0; i < system->quasi; i++)
        nh_text_addf(&name, "%s%s", i ? ", " : "", nh_name_of(system->dag, system->quasi_velocity[i]));
    nh_text_add(&name, ")");
    nh_chart *c = nh_embedding_new(system, nh_text_string(&name), system->quasi, 0);
    nh_text_clear(&name);
    c->quasi = true;
    memcpy(c->w, system->quasi_velocity, system->quasi * sizeof *c->w);
    memcpy(c->rho, system->quasi_map, system->coordinates * sizeof *c->rho);
    c->framed = system->quasi_framed;
    nh_embedding_symbols(c);
    probes_of_quasi(c, seed);
    if (nh_embedding_ranks(system, seed, error) && chart_satisfies(c, error) && velocities_independent(c, error))
        return c;
    nh_chart_free(c);
    return NULL;
}

nh_chart *nh_chart_create(nh_system *system, nh_chart_choice choice, uint64_t seed, nh_error *error)
{
    if (choice == NH_CHART_QUASI && !system->quasi) {
        nh_fail(error, NH_USAGE, "", "%s defines no quasi-velocities", system->name);
        nh_error_hint(error, "add `velocities:` to the system file");
        return NULL;
    }
    bool quasi = system->quasi && choice != NH_CHART_COORDINATES;
    nh_chart *chart = quasi ? quasi_chart(system, seed, error) : nh_embedding_coordinates(system, seed, error);
    if (!chart || nh_levels_check(system, seed, error)) return chart;
    nh_chart_free(chart);
    return NULL;
}

/* ---- back from coordinate velocities ---- */

/* On a level, a velocity may be that of one coordinate times a function of position: then no other coordinates are
 * used.  Cyclic ones are used last. */
static void choose_rows(const nh_chart *c, const nh_ex *R, bool *used)
{
    const nh_system *system = c->system;
    size_t found = 0, m = system->coordinates;
    for (size_t k = 0; k < m; k++) used[k] = false;
    for (size_t i = 0; i < c->n && system->levels; i++) {
        size_t best = m;
        for (size_t k = 0; k < m; k++) {
            bool own = !nh_is_zero(system->dag, R[k * c->n + i]);
            for (size_t j = 0; j < c->n && own; j++) own = j == i || nh_is_zero(system->dag, R[k * c->n + j]);
            if (own && (best == m || nh_depends(system->dag, system->lagrangian, system->coordinate[k].q))) best = k;
        }
        if (best < m) used[best] = true, found++;
    }
    for (size_t k = 0; k < m && found < c->n; k++) used[k] = true;
}

/* Where each velocity of the chart is a rate along the frame. */
static bool inverse_along_frame(const nh_chart *c, nh_ex *out)
{
    const nh_system *system = c->system;
    size_t found = 0;
    for (size_t i = 0; i < c->n && c->framed; i++)
        for (size_t a = 0; a < system->coordinates; a++) {
            if (c->framed[a] != c->w[i]) continue;
            const nh_orientation *o = nh_orientation_of(system, a);
            out[i] = o ? o->rate[a - o->first] : system->coordinate[a].v;
            found++;
            break;
        }
    return c->n && found == c->n;
}

bool nh_chart_inverse(const nh_chart *c, nh_ex *out)
{
    const nh_system *system = c->system;
    nh_dag *d = system->dag;
    size_t n = c->n, m = system->coordinates;
    if (!c->quasi) {
        memcpy(out, c->w, n * sizeof *out);
        return true;
    }
    if (inverse_along_frame(c, out)) return true;
    nh_ex *R = nh_alloc_array(m * n + n * n + n + 1, sizeof *R), *N = R + m * n, *b = N + n * n;
    nh_ex *zero = nh_alloc_array(n + 1, sizeof *zero);
    bool affine = true, *used = nh_alloc_array(m + 1, sizeof *used);
    for (size_t k = 0; k < m; k++)
        for (size_t i = 0; i < n; i++) {
            R[k * n + i] = nh_diff(d, c->rho[k], c->w[i]);
            for (size_t j = 0; j < n; j++) affine &= !nh_depends(d, R[k * n + i], c->w[j]);
        }
    choose_rows(c, R, used);
    for (size_t i = 0; i < n && affine; i++) {
        b[i] = nh_int(d, 0);
        for (size_t j = 0; j < n; j++) N[i * n + j] = nh_int(d, 0);
        for (size_t k = 0; k < m; k++) {
            if (!used[k]) continue;
            nh_ex rest = nh_sub(d, system->coordinate[k].v, nh_substitute(d, c->rho[k], n, c->w, zero));
            b[i] = nh_add(d, b[i], nh_mul(d, R[k * n + i], rest));
            for (size_t j = 0; j < n; j++)
                N[i * n + j] = nh_add(d, N[i * n + j], nh_mul(d, R[k * n + i], R[k * n + j]));
        }
    }
    nh_lu *lu = NULL;
    if (affine) {
        for (size_t i = 0; i < n * n; i++) N[i] = nh_simplify(d, N[i]);
        lu = nh_lu_create(d, n, N, nh_embedding_score, (void *)c, NULL);
    }
    if (lu) {
        nh_lu_solve(lu, b, out);
        for (size_t i = 0; i < n; i++) out[i] = nh_simplify(d, out[i]);
    }
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(used);
    nh_free(zero);
    nh_free(R);
    return good;
}
