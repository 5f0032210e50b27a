/* distribution: the type of the constraints by identities of nu, rho and R, their integrability by the growth vector.
 * [docs/method.md, sec. 2, (8) and (8a)]
 *
 *     type      affine, homogeneous, rheonomic: each an identity, by normal form, or by values at probes
 *     growth    of the fields on the smallest space on which they live:
 *
 *         R does not depend on w or t, linear:    R^s_i d/dq^s                       on q          (m)
 *         affine, or with t:                      X_0 at w = 0, and R^s_i d/dq^s     on (t, q)     (1 + m)
 *         nonlinear:                              X_0, X_i, Y_i                      on (t, q, w)  (1 + m + n)
 *
 *     integrals dimension minus the last rank: as many functions of (t, q) are constant */
#include "geometry/distribution.h"

#include "exact/normal.h"
#include "geometry/closure.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "system/embedding.h"

const char *nh_constraint_type_name(nh_constraint_type type)
{
    static const char *const names[] = {"none", "linear", "affine", "nonlinear"};
    return names[type];
}

const char *nh_constraint_integrability(const nh_model *model, const nh_distribution *d)
{
    if (model->k == 0) return "none";
    if (d->positions == model->k) return "holonomic";
    return d->holonomic ? "integrable" : d->integrals ? "partly integrable" : "nonholonomic";
}

/* Zero by normal form, or, where that is undecided, at the probes. */
static bool vanishes(const nh_model *model, nh_ex e)
{
    if (nh_is_zero(model->dag, e) || nh_normal_is_zero(model->dag, e, 0) == NH_ZERO) return true;
    return nh_chart_pivot_score(model->chart, e) == 0;
}

/* nu^a_s x^s */
static nh_ex across(const nh_model *model, size_t a, const nh_ex *x)
{
    nh_ex e = nh_int(model->dag, 0);
    for (size_t s = 0; s < model->m; s++)
        e = nh_add(model->dag, e, nh_mul(model->dag, model->nu[a * model->m + s], x[s]));
    return e;
}

/* Do the allowed velocities at a place form an affine space?  Then the derivatives of the directions R_i are tangent to
 * it. */
static bool is_affine(const nh_model *model)
{
    nh_ex *x = nh_alloc_array(model->m + 1, sizeof *x);
    bool affine = true;
    for (size_t i = 0; i < model->n && affine; i++)
        for (size_t j = 0; j <= i && affine; j++) {
            for (size_t s = 0; s < model->m; s++) x[s] = nh_model_Y(model, j, model->R[s * model->n + i]);
            for (size_t a = 0; a < model->k && affine; a++) affine = vanishes(model, across(model, a, x));
        }
    nh_free(x);
    return affine;
}

/* nu^a_s rho^s = 0 for every a: with a velocity its multiples are allowed. */
static bool is_homogeneous(const nh_model *model)
{
    for (size_t a = 0; a < model->k; a++)
        if (!vanishes(model, across(model, a, model->rho))) return false;
    return true;
}

/* For f(t, q) = 0 the stored constraint is the rate f_t + f_q v; at rest it is f_t. */
static nh_ex time_part(const nh_model *model, size_t a)
{
    const nh_system *system = model->system;
    nh_dag *d = model->dag;
    nh_ex f = nh_chart_constraint(model->chart, a), zero = nh_int(d, 0);
    if (!system->constraint[a].position) return nh_model_compose(model, nh_diff(d, f, system->t));
    for (size_t s = 0; s < model->m; s++) f = nh_substitute(d, f, 1, &system->coordinate[s].v, &zero);
    return f;
}

/* Is df^a/dt not zero on the submanifold, for some a? */
static bool is_rheonomic(const nh_model *model)
{
    for (size_t a = 0; a < model->k; a++)
        if (!vanishes(model, time_part(model, a))) return true;
    return false;
}

/* ---- growth ---- */

static bool any_depends(const nh_model *model, size_t n, const nh_ex *e, size_t symbols, const nh_ex *symbol)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < symbols; j++)
            if (nh_depends(model->dag, e[i], symbol[j])) return true;
    return false;
}

/* The fields X_i on the coordinates. */
static nh_distribution_fields displacements(const nh_model *model)
{
    nh_distribution_fields f = {model->n, model->m, model->chart->symbol + 1,
                                nh_alloc_array(model->n * model->m + 1, sizeof *f.field)};
    for (size_t i = 0; i < model->n; i++)
        for (size_t s = 0; s < model->m; s++) f.field[i * model->m + s] = model->R[s * model->n + i];
    return f;
}

/* X_0 at w = 0, and X_i, on (t, q), for rho affine in w. */
static nh_distribution_fields events(const nh_model *model)
{
    size_t N = 1 + model->m;
    nh_dag *d = model->dag;
    nh_distribution_fields f = {model->n + 1, N, model->chart->symbol,
                                nh_alloc_array((model->n + 1) * N, sizeof *f.field)};
    nh_ex *zero = nh_alloc_array(model->n + 1, sizeof *zero);
    for (size_t i = 0; i <= model->n; i++) {
        zero[i] = nh_int(d, 0);
        f.field[i * N] = nh_int(d, i == 0);
        for (size_t s = 0; s < model->m; s++)
            f.field[i * N + 1 + s] = i ? model->R[s * model->n + i - 1] : model->rho[s];
    }
    for (size_t s = 0; s < model->m; s++)
        f.field[1 + s] = nh_substitute(d, f.field[1 + s], model->n, model->chart->w, zero);
    nh_free(zero);
    return f;
}

/* The growth of these fields, which are freed. */
static nh_growth growth_of(const nh_model *model, nh_distribution_fields f, nh_growth_space space)
{
    nh_growth g = nh_growth_of(model, f.count, f.dimension, f.symbol, f.field, 0);
    g.space = space;
    nh_free(f.field);
    return g;
}

/* X_0, X_i and Y_i on the submanifold; `shift` directions are not counted in the ranks. */
static nh_growth growth_of_states(const nh_model *model, size_t shift)
{
    size_t n = model->n, N = 1 + model->m + n;
    nh_ex *field = nh_alloc_array((2 * n + 1) * N, sizeof *field);
    for (size_t i = 0; i < 2 * n + 1; i++)
        for (size_t j = 0; j < N; j++)
            field[i * N + j] = nh_int(model->dag, (i == 0 && j == 0) || (i > n && j == model->m + i - n));
    for (size_t i = 0; i <= n; i++)
        for (size_t s = 0; s < model->m; s++) field[i * N + 1 + s] = i ? model->R[s * n + i - 1] : model->rho[s];
    nh_growth g = nh_growth_of(model, 2 * n + 1, N, model->chart->symbol, field, shift);
    nh_free(field);
    return g;
}

/* Do the fields R depend on the velocities of the chart, or on t? */
static bool bent(const nh_model *model)
{
    return any_depends(model, model->m * model->n, model->R, model->n + model->chart->implicit,
                       model->chart->symbol + 1 + model->m);
}

static bool timed(const nh_model *model)
{
    return any_depends(model, model->m * model->n, model->R, 1, &model->system->t);
}

nh_distribution_fields nh_distribution_fields_of(const nh_model *model)
{
    if (model->k == 0 || model->chart->implicit || bent(model) || !is_affine(model)) return (nh_distribution_fields){0};
    return is_homogeneous(model) && !is_rheonomic(model) && !timed(model) ? displacements(model) : events(model);
}

/* The smallest space on which the growth can be computed.  Where the chart is nonlinear although the constraints are
 * not, the canonical distribution contains the n directions Y_i, and d/dt when neither velocity at rest nor t has a
 * part in it; they add to every rank alike. */
static nh_growth growth(const nh_model *model, const nh_distribution *out)
{
    bool at_rest = out->type == NH_LINEAR && !out->rheonomic;
    nh_growth g;
    if (out->type == NH_NONLINEAR) g = growth_of_states(model, 0), g.space = NH_ON_STATES;
    else if (bent(model) || (at_rest && timed(model)))
        g = growth_of_states(model, model->n + at_rest), g.space = at_rest ? NH_ON_POSITIONS : NH_ON_EVENTS;
    else
        g = at_rest ? growth_of(model, displacements(model), NH_ON_POSITIONS)
                    : growth_of(model, events(model), NH_ON_EVENTS);
    return g;
}

/* A lower bound of the number of independent functions of (t, q) that are known to be constant: levels of constraints
 * between positions, heights of wheels. */
static size_t known_integrals(const nh_model *model)
{
    const nh_system *system = model->system;
    size_t count = 0;
    nh_ex *level = nh_alloc_array(model->k + 1, sizeof *level);
    for (size_t a = 0; a < model->k; a++)
        if (system->constraint[a].level) level[count++] = system->constraint[a].level;
    size_t known = count ? nh_closure_of(model, 0, NULL, count, level).known : 0;
    nh_free(level);
    return known;
}

nh_distribution nh_distribution_of(const nh_model *model)
{
    nh_distribution out = {.type = NH_UNCONSTRAINED, .growth.proved = true};
    if (model->k == 0) return out;
    out.homogeneous = is_homogeneous(model);
    out.type = !is_affine(model) ? NH_NONLINEAR : out.homogeneous ? NH_LINEAR : NH_AFFINE;
    out.rheonomic = is_rheonomic(model);
    out.growth = growth(model, &out);
    if (!out.growth.cut) out.integrals = out.growth.dimension - out.growth.rank[out.growth.length - 1];
    if (!out.growth.proved && out.integrals && !out.growth.by_numbers && out.growth.space != NH_ON_STATES)
        out.growth.proved = known_integrals(model) == out.integrals;
    out.holonomic = out.type != NH_NONLINEAR && out.integrals == model->k;
    for (size_t a = 0; a < model->k; a++) out.positions += model->system->constraint[a].position;
    out.hidden = out.integrals > out.positions ? out.integrals - out.positions : 0;
    return out;
}
