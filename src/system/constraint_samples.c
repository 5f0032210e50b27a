#include "system/constraint_samples.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "exact/generic_value.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "system/domain.h"
#include "system/embedding_internal.h"
#include "system/sample.h"

enum { wanted_probes = 24, most_tries = 400, projection_steps = 60 };
/* largest residual, relative to the velocities, and to the terms of a constraint */
static const double small_step = 1e-14, satisfied = 1e-9;

static void cloud_tape(nh_constraint_samples *c)
{
    nh_system *system = c->system;
    nh_dag *d = system->dag;
    nh_ex *in = nh_alloc_array(c->width, sizeof *in), *out = nh_alloc_array(c->k * (1 + c->m) + 1, sizeof *out);
    in[0] = system->t;
    for (size_t i = 0; i < c->m; i++) {
        in[1 + i] = system->coordinate[i].q;
        in[1 + c->m + i] = system->coordinate[i].v;
    }
    c->entire = true;
    for (size_t a = 0; a < c->k; a++) {
        out[a] = nh_sub(d, system->constraint[a].lhs, system->constraint[a].rhs);
        c->entire = c->entire && nh_is_entire(d, out[a], c->width, in);
        for (size_t i = 0; i < c->m; i++) out[c->k + a + i * c->k] = nh_diff(d, out[a], in[1 + c->m + i]);
    }
    nh_ex *symbol = nh_alloc_array(system->parameters + 1, sizeof *symbol);
    double *value = nh_alloc_array(system->parameters + 1, sizeof *value);
    for (size_t i = 0; i < system->parameters; i++) {
        const nh_parameter *p = &system->parameter[i];
        symbol[i] = p->symbol, value[i] = c->written && p->set ? p->written : p->value;
    }
    c->tape = nh_tape_create(d, c->width, in, c->k * (1 + c->m), out, system->parameters, symbol, value);
    nh_free(value);
    nh_free(symbol);
    c->work = nh_tape_work_create(c->tape);
    c->out = nh_alloc_array(c->k * (1 + c->m) + 1, sizeof *c->out);
    nh_free(in);
    nh_free(out);
}

static bool all_finite(size_t n, const double *x)
{
    for (size_t i = 0; i < n; i++)
        if (!isfinite(x[i])) return false;
    return true;
}

/* The linear equations of one step; each is divided by its largest element, so that the units of the constraints do not
   matter. */
static void put_equations(const nh_constraint_samples *c, double *F, double *right)
{
    size_t k = c->k, m = c->m;
    for (size_t a = 0; a < k; a++) {
        double most = 0;
        for (size_t j = 0; j < m; j++) most = fmax(most, fabs(c->out[k + a + j * k]));
        if (most == 0) most = 1;
        for (size_t j = 0; j < m; j++) F[a + j * k] = c->out[k + a + j * k] / most;
        right[a] = c->out[a] / most;
    }
}

/* Move v onto the constraints by the shortest Gauss-Newton steps. */
static bool project(nh_constraint_samples *c, double *z)
{
    size_t k = c->k, m = c->m, big = m > k ? m : k;
    double *F = nh_alloc_array(k * m + big + 1, sizeof *F), *step = F + k * m;
    bool good = false;
    for (int i = 0; i < projection_steps && !good; i++) {
        nh_tape_eval(c->tape, c->work, z, c->out);
        if (!all_finite(k * (1 + m), c->out)) break;
        memset(step, 0, big * sizeof *step);
        put_equations(c, F, step);
        if (nh_least_squares(k, m, F, 1, step, big, 1e-12) < 0) break;
        good = true;
        for (size_t j = 0; j < m; j++) {
            good = good && fabs(step[j]) <= small_step * fmax(fabs(z[1 + m + j]), c->speed[j]);
            z[1 + m + j] -= step[j];
        }
    }
    nh_tape_eval(c->tape, c->work, z, c->out);
    good = all_finite(k * (1 + m), c->out);
    for (size_t a = 0; a < k && good; a++) {
        double terms = 0;
        for (size_t j = 0; j < m; j++)
            terms = fmax(terms, fabs(c->out[k + a + j * k]) * fmax(fabs(z[1 + m + j]), c->speed[j]));
        good = fabs(c->out[a]) <= satisfied * terms;
    }
    nh_free(F);
    return good;
}

static void measure(nh_constraint_samples *c, const double *z)
{
    nh_tape_eval(c->tape, c->work, z, c->out);
    if (!all_finite(c->k * (1 + c->m), c->out)) return;
    for (size_t a = 0; a < c->k; a++)
        for (size_t j = 0; j < c->m; j++)
            c->size[a] = fmax(c->size[a], fabs(c->out[c->k + a + j * c->k]) * c->speed[j]);
}

static void cloud_fill(nh_constraint_samples *c, uint64_t seed)
{
    double *low = nh_alloc_array(2 * c->width, sizeof *low), *high = low + c->width;
    nh_system *system = c->system;
    c->unit = nh_alloc_array(2 * c->m + c->k + 1, sizeof *c->unit);
    c->speed = c->unit + c->m;
    c->size = c->speed + c->m;
    for (size_t a = 0; a < c->k; a++) c->size[a] = 0;
    nh_domain_range(system, system->t, &low[0], &high[0]);
    for (size_t i = 0; i < c->m; i++) {
        nh_domain_range(system, system->coordinate[i].q, &low[1 + i], &high[1 + i]);
        nh_domain_range(system, system->coordinate[i].v, &low[1 + c->m + i], &high[1 + c->m + i]);
    }
    for (size_t i = 0; i < c->m; i++) {
        double half = (high[1 + c->m + i] - low[1 + c->m + i]) / 2;
        c->unit[i] = nh_chart_unit(system, i);
        c->speed[i] = half > 0 && isfinite(half) ? half : 1;
    }
    nh_sampler *sampler = nh_sampler_create(c->width, low, high, seed);
    c->point = nh_alloc_array(wanted_probes * c->width, sizeof *c->point);
    c->F = nh_alloc_array(wanted_probes * c->k * c->m + 1, sizeof *c->F);
    for (int tries = 0; tries < most_tries && c->count < wanted_probes; tries++) {
        double *z = c->point + c->count * c->width;
        nh_sampler_next(sampler, z);
        measure(c, z);
        if (!project(c, z)) continue;
        memcpy(c->F + c->count * c->k * c->m, c->out + c->k, c->k * c->m * sizeof *c->F);
        c->count++;
    }
    nh_sampler_free(sampler);
    nh_free(low);
}

void nh_constraint_samples_clear(nh_constraint_samples *c)
{
    nh_tape_work_free(c->work);
    nh_tape_free(c->tape);
    nh_free(c->out);
    nh_free(c->point);
    nh_free(c->F);
    nh_free(c->unit);
}

/* ---- ranks ---- */

static const double rounding = 1e-13; /* of the size of a row of df/dv */

/* Is the whole row of df/dv zero?  Then it must not be scaled up from rounding, as a row in small units is. */
static bool row_vanishes(const nh_constraint_samples *c, size_t a)
{
    nh_system *system = c->system;
    if (c->size[a] == 0 || c->size[a] > rounding) return c->size[a] == 0;
    nh_ex *symbol = nh_alloc_array(c->width, sizeof *symbol),
          f = nh_sub(system->dag, system->constraint[a].lhs, system->constraint[a].rhs);
    symbol[0] = system->t;
    for (size_t i = 0; i < c->m; i++)
        symbol[1 + i] = system->coordinate[i].q, symbol[1 + c->m + i] = system->coordinate[i].v;
    bool zero = true;
    for (size_t j = 0; j < c->m && zero; j++)
        zero = nh_embedding_vanishes(system, c->width, symbol, c->count, c->point,
                                     nh_diff(system->dag, f, system->coordinate[j].v));
    nh_free(symbol);
    return zero;
}

/* Row i of df/dv at point p, relative to its size; zero where the constraint is stationary, as x'^2 + y'^2 = 0 is at
   rest. */
static void put_row(const nh_constraint_samples *c, size_t p, size_t i, bool empty, size_t rows, double *a)
{
    const double *F = c->F + p * c->k * c->m;
    double most = 0;
    for (size_t j = 0; j < c->m; j++) most = fmax(most, fabs(F[i + j * c->k]) * c->speed[j]);
    bool zero = empty || most <= rounding * c->size[i];
    for (size_t j = 0; j < c->m; j++) a[i + j * rows] = zero ? 0 : F[i + j * c->k] * c->speed[j] / c->size[i];
}

/* df_a/dv of this velocity; none (index m): f_a at rest.  False: it contains velocities. */
static bool linear_part(const nh_constraint_samples *c, size_t a, size_t velocity, nh_ex *e)
{
    const nh_system *system = c->system;
    nh_ex f = nh_sub(system->dag, system->constraint[a].lhs, system->constraint[a].rhs), zero = nh_int(system->dag, 0);
    if (velocity < c->m) f = nh_diff(system->dag, f, system->coordinate[velocity].v);
    else
        for (size_t j = 0; j < c->m; j++) f = nh_substitute(system->dag, f, 1, &system->coordinate[j].v, &zero);
    *e = nh_system_values(system, system->dag, f);
    for (size_t j = 0; j < c->m; j++)
        if (nh_depends(system->dag, *e, system->coordinate[j].v)) return false;
    return true;
}

bool nh_constraint_samples_rank(const nh_constraint_samples *c, size_t rows, size_t columns, const size_t *column,
                                size_t *rank)
{
    nh_ex *e = nh_alloc_array(rows * columns + 1, sizeof *e);
    bool known = rows && columns && !c->written;
    for (size_t i = 0; i < rows * columns && known; i++)
        known = linear_part(c, i / columns, column ? column[i % columns] : i % columns, &e[i]);
    known = known && nh_generic_rank(c->system->dag, rows, columns, e, rank);
    nh_free(e);
    return known;
}

/* The rank of df/dv, and the first constraint that depends on those before it; false: not known in this way. */
static bool generic_rank_of(const nh_constraint_samples *c, size_t *rank, size_t *redundant)
{
    size_t part = 0;
    *redundant = c->k;
    if (!nh_constraint_samples_rank(c, c->k, c->m, NULL, rank)) return false;
    for (size_t use = 1; use <= c->k && *rank < c->k && *redundant == c->k; use++) {
        if (!nh_constraint_samples_rank(c, use, c->m, NULL, &part)) return false;
        if (part < use) *redundant = use - 1;
    }
    return true;
}

/* Do linear constraints up to a, of which the last one depends on the others, have no common solution at almost all
   positions? */
static bool contradicts(const nh_constraint_samples *c, size_t a)
{
    size_t with = 0, without = 0, *column = nh_alloc_array(c->m + 1, sizeof *column);
    for (size_t j = 0; j <= c->m; j++) column[j] = j;
    bool known = nh_constraint_samples_rank(c, a + 1, c->m, NULL, &without) &&
                 nh_constraint_samples_rank(c, a + 1, c->m + 1, column, &with);
    nh_free(column);
    return known && with > without;
}

/* The rank as the largest one over the points, and the first dependent constraint: by numbers. */
static size_t rank_by_numbers(const nh_constraint_samples *c, size_t *redundant)
{
    size_t best = 0;
    bool *empty = nh_alloc_array(c->k + 1, sizeof *empty);
    double *a = nh_alloc_array(c->k * c->m + 1, sizeof *a);
    *redundant = c->k;
    for (size_t use = 1; use <= c->k; use++) {
        size_t rank = 0;
        empty[use - 1] = row_vanishes(c, use - 1);
        for (size_t p = 0; p < c->count; p++) {
            for (size_t i = 0; i < use; i++) put_row(c, p, i, empty[i], use, a);
            size_t r = nh_embedding_rank(use, c->m, a);
            if (r > rank) rank = r;
        }
        if (rank == best && *redundant == c->k) *redundant = use - 1;
        best = rank;
    }
    nh_free(a);
    nh_free(empty);
    return best;
}

void nh_constraint_samples_init(nh_constraint_samples *c, nh_system *system, size_t constraints, uint64_t seed)
{
    *c = (nh_constraint_samples){.system = system,
                                 .m = system->coordinates,
                                 .k = constraints,
                                 .width = 1 + 2 * system->coordinates,
                                 .seed = seed};
    cloud_tape(c);
    cloud_fill(c, seed);
}

bool nh_constraint_samples_init_written(nh_constraint_samples *c, nh_system *system, uint64_t seed)
{
    bool other = false;
    for (size_t i = 0; i < system->parameters; i++)
        other |= system->parameter[i].set && system->parameter[i].written != system->parameter[i].value;
    if (!other) return false;
    *c = (nh_constraint_samples){.system = system,
                                 .m = system->coordinates,
                                 .k = system->constraints,
                                 .width = 1 + 2 * system->coordinates,
                                 .seed = seed,
                                 .written = true};
    cloud_tape(c);
    cloud_fill(c, seed);
    return true;
}

/* Points at the first constraint that contradicts those before it. */
static bool contradiction(const nh_constraint_samples *c, uint64_t seed, nh_error *error)
{
    const nh_system *system = c->system;
    size_t a = 0;
    for (; a < c->k; a++) {
        nh_constraint_samples part;
        nh_constraint_samples_init(&part, c->system, a + 1, seed);
        size_t points = part.count;
        nh_constraint_samples_clear(&part);
        if (points == 0) break;
    }
    const nh_deck_node *node = system->constraint[a < c->k ? a : 0].node;
    if (a == 0) {
        nh_deck_fail(system->deck, node, 0, error, "no point of the sampling domain satisfies this constraint");
        return nh_error_hint(error, "the constraint contradicts itself, or `domain:` excludes all its solutions");
    }
    nh_deck_fail(system->deck, node, 0, error,
                 "this constraint contradicts those before it: no point of the sampling domain satisfies them all");
    return nh_error_hint(error, "correct one of them; or does `domain:` exclude their common solutions?");
}

bool nh_constraint_samples_check_rank(const nh_constraint_samples *c, uint64_t seed, nh_error *error)
{
    const nh_system *system = c->system;
    if (c->count == 0) return contradiction(c, seed, error);
    size_t redundant, rank;
    bool exact = generic_rank_of(c, &rank, &redundant);
    if (!exact) rank = rank_by_numbers(c, &redundant);
    if (rank < c->k && exact && contradicts(c, redundant)) {
        nh_deck_fail(
            system->deck, system->constraint[redundant].node, 0, error,
            "this constraint contradicts those before it: at almost all positions they have no common solution");
        return nh_error_hint(error, "correct one of them");
    }
    if (rank < c->k) {
        nh_deck_fail(system->deck, system->constraint[redundant].node, 0, error,
                     "this constraint follows from the others: the %zu constraints have rank %zu%s", c->k, rank,
                     exact ? "" : ", by numbers");
        return nh_error_hint(error, system->constraint[redundant].position
                                        ? "as an equation between positions it follows from the other constraints or "
                                          "contradicts them; remove it"
                                        : "it follows from the other constraints; remove it");
    }
    if (c->k < c->m) return true;
    nh_deck_fail(system->deck, system->constraint[0].node, 0, error,
                 "%zu independent constraints on %zu coordinates leave no freedom to move", c->k, c->m);
    return nh_error_hint(error, "a system needs fewer constraints than coordinates");
}
