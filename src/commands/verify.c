#include "commands/verify_internal.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/show.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "integrals/exact_points.h"
#include "integrals/fitted.h"
#include "integrals/independence.h"
#include "search/search.h"
#include "search/theory.h"
#include "problem/time_scale.h"

enum { generic_points = 24 };

static void name_branches(nh_verification *v)
{
    const nh_chart *c = v->model->chart;
    if (!c->branch) return;
    char *here = nh_chart_branch_name(c, c->branch), *there = nh_chart_branch_name(c, -c->branch);
    v->branch = nh_arena_strdup(v->arena, here);
    v->other_branch = nh_arena_strdup(v->arena, there);
    nh_free(here);
    nh_free(there);
}

/* Is the expression, as the user wrote it, conserved on the other branch? */
static void ask_other_branch(nh_verification *v, nh_ex e, const nh_options *options)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_model *other = nh_branch_other(v->model, options);
    nh_ex phi;
    if (other && nh_analysis_file_to_chart(other, e, &phi, &ignored)) {
        if (v->conserved) v->on_both = nh_branch_conserves(other, phi, &v->proof, options);
        else if (!v->region) v->on_other = nh_prove_current(other, phi, true, options).proved;
    }
    nh_model_free(other);
}

nh_verification *nh_verification_start(nh_verification_question asked, nh_error *error)
{
    nh_system *system = asked.system;
    nh_chart_choice chart = asked.chart;
    const nh_options *options = asked.options;
    nh_progress("the equations of motion", -1);
    nh_model *model = nh_model_create(system, nh_chart_create(system, chart, (uint64_t)options->seed, error), error);
    if (model && nh_time_scale_set(system, model) != 1) {
        nh_model_free(model);
        model = nh_model_create(system, nh_chart_create(system, chart, (uint64_t)options->seed, error), error);
    }
    if (!model) {
        nh_system_free(system);
        return NULL;
    }
    nh_arena *arena = nh_arena_create();
    nh_verification *v = nh_arena_alloc(arena, sizeof *v);
    *v = (nh_verification){
        .arena = arena, .options = options, .request = asked.request, .system = system, .model = model};
    name_branches(v);
    return v;
}

nh_verification *nh_verification_complete(nh_verification *v, bool good, nh_error *error)
{
    v->options = NULL;
    v->request = NULL;
    if (good && nh_interrupted()) good = nh_fail_ended(error, "before this was decided");
    if (good) return v;
    nh_verification_free(v);
    return NULL;
}

void nh_verification_free(nh_verification *v)
{
    if (!v) return;
    nh_model_free(v->other);
    nh_model_free(v->model);
    nh_system_free(v->system);
    nh_arena_free(v->arena);
}

/* ---- the worst point of an expression that should vanish ---- */

static const double rounding = 64 * DBL_EPSILON, fit_rounding = 1e-12;

nh_points *nh_verification_points(nh_model *model, const nh_options *options, nh_error *error)
{
    enum { test_points = 256 };
    return nh_points_create(model, test_points, 1.2, (uint64_t)options->seed + 7, error);
}

/* A value that is no more than rounding of what cancels within the terms is taken relative to that.  Of points that
 * are equally bad up to rounding, the first. */
static bool worst_point(nh_verification *v, const nh_points *points, size_t n, const nh_ex *term, double *residual)
{
    static const double clearly = 1.001;
    size_t count = points->count, worst = count;
    double *value = nh_alloc_array((n + 1) * count + 1, sizeof *value), most = 0, rate = 0, there = 0;
    nh_ex within = nh_int(v->model->dag, 0);
    for (size_t j = 0; j < n; j++) within = nh_add(v->model->dag, within, nh_terms_uncancelled(v->model->dag, term[j]));
    nh_points_evaluate(points, v->model, n, term, value);
    nh_points_evaluate(points, v->model, 1, &within, value + n * count);
    for (size_t p = 0; p < count; p++) {
        double sum = 0, size = 0;
        for (size_t j = 0; j < n; j++) {
            sum += value[j * count + p];
            size += fabs(value[j * count + p]);
        }
        if (fabs(sum) <= rounding * value[n * count + p]) size = value[n * count + p];
        double r = size > 0 ? fabs(sum) / size : 0;
        if (!isfinite(r) || r == 0) continue;
        most = fmax(most, r);
        if (r <= clearly * there) continue;
        there = r;
        worst = p;
        rate = sum;
    }
    nh_free(value);
    *residual = most;
    if (worst == count) return false;
    if (!v->counterexample) v->counterexample = nh_arena_alloc(v->arena, v->model->width * sizeof(double));
    for (size_t j = 0; j < v->model->width; j++) v->counterexample[j] = points->column[j][worst];
    v->rate = rate;
    return true;
}

static bool accepts(const nh_proof *proof, double residual, const nh_options *options)
{
    enum { double_digits = 12 };
    double enough = proof->rounded && options->digits > double_digits ? double_digits : options->digits;
    return proof->proved || (proof->digits >= enough && residual <= options->heldout);
}

/* Is the sum of exact terms certainly not zero at a point, with as many digits as that takes?  Sets v->counterexample
 * and v->rate. */
static bool excludes_zero(nh_verification *v, const nh_points *points, size_t n, const nh_ex *term)
{
    enum { least_bits = 256, most_bits = 1 << 14, tried = 3 };
    const nh_model *model = v->model;
    nh_ex sum = nh_int(model->dag, 0);
    for (size_t j = 0; j < n; j++) sum = nh_add(model->dag, sum, term[j]);
    sum = nh_model_values(model, sum);
    if (!nh_is_exact(model->dag, sum) || nh_declared_unspecified(model->dag)) return false;
    double *z = nh_arena_alloc(v->arena, model->width * sizeof *z), radius;
    bool excluded = false;
    for (long bits = least_bits; bits <= most_bits && !excluded && !nh_interrupted(); bits *= 4) {
        nh_ball *ball = nh_ball_create(model->dag, bits);
        nh_exact_parameters(model, ball);
        for (size_t p = 0; p < points->count && p < tried && !excluded; p++) {
            for (size_t j = 0; j < model->width; j++) z[j] = points->column[j][p];
            excluded = nh_exact_at(model, ball, z) && nh_ball_excludes_zero(ball, sum);
        }
        if (excluded && !nh_ball_value(ball, sum, &v->rate, &radius)) v->rate = NAN;
        nh_ball_free(ball);
    }
    if (excluded) v->counterexample = z;
    return excluded;
}

bool nh_verification_vanishes(nh_verification *v, const nh_points *points, size_t n, const nh_ex *term,
                              const nh_proof *proof, const nh_options *options)
{
    double residual;
    bool found = worst_point(v, points, n, term, &residual), vanishes = accepts(proof, residual, options);
    v->residual = fmax(v->residual, residual);
    if (nh_fitted_is(v->model)) { /* of a table doubles are all that there is */
        v->fitted = true;
        vanishes = residual <= fit_rounding;
        v->has_counterexample = found && !vanishes;
        return vanishes;
    }
    bool asked = vanishes ? !proof->proved : !found; /* doubles cannot tell */
    if (asked && excludes_zero(v, points, n, term)) found = true, vanishes = false;
    v->has_counterexample = found && !vanishes;
    return vanishes;
}

/* Is it constant on the submanifold?  All derivatives vanish there, by normal form; or wherever it is smooth, however
 * it is written. */
static bool is_constant(const nh_verification *v, const nh_points *generic, const nh_options *options)
{
    const nh_model *model = v->model;
    nh_independence kind;
    nh_ex phi = v->current, slope = 0;
    bool proved = true;
    for (size_t j = 0; j < 1 + model->m + model->n && proved; j++) {
        slope = nh_diff(model->dag, phi, model->chart->symbol[j]);
        proved = nh_normal_is_zero(model->dag, slope, (size_t)options->proof_terms) == NH_ZERO;
    }
    if (proved) return true;
    nh_verification own = *v; /* v keeps its counterexample */
    nh_independence_test(model, generic, 1, &phi, NULL, options->sure, options->doubt, &kind, NULL);
    return kind == NH_CONSTANT && !excludes_zero(&own, generic, 1, &slope);
}

bool nh_verification_describe(nh_verification *v, const nh_options *options, nh_error *error)
{
    nh_points *generic = nh_points_create(v->model, generic_points, 1, (uint64_t)options->seed + 8, error);
    if (!generic) return false;
    nh_error ignored;
    nh_error_clear(&ignored);
    v->trivial = is_constant(v, generic, options);
    v->has_symmetry = nh_symmetry_of(v->model, generic, v->current, options->same, &v->symmetry, &ignored);
    nh_points_free(generic);
    return true;
}

/* It is conserved wherever it is smooth.  Also along whole motions, which end at walls where they have an impulse? */
static void delimit(nh_verification *v, const nh_options *options)
{
    nh_terrain terrain = nh_terrain_of(v->model, options, v->arena);
    double digits = v->proof.proved && !v->proof.sided ? 0 : v->proof.digits / 2;
    nh_region region = nh_region_of(v->model, &terrain, v->current, digits, v->proof.sided, options, v->arena);
    v->region = nh_region_text(v->model->dag, &region, v->arena);
    v->conserved = nh_region_to_the_end(&region);
}

/* What is real nowhere is neither conserved nor not. */
static bool is_real_somewhere(const nh_verification *v, const nh_points *points, nh_error *error)
{
    double *value = nh_alloc_array(points->count + 1, sizeof *value);
    bool some = false;
    nh_points_evaluate(points, v->model, 1, &v->current, value);
    for (size_t p = 0; p < points->count && !some; p++) some = isfinite(value[p]);
    nh_free(value);
    if (some) return true;
    nh_fail(error, NH_NUMERIC, "--current", "it has no real value at any of %zu states of the domain", points->count);
    return nh_error_hint(error, "is a sign below a root right?  Where it is real elsewhere, give such a `domain`");
}

bool nh_verification_decide(nh_verification *v, const nh_options *options, nh_error *error)
{
    nh_points *points = nh_verification_points(v->model, options, error);
    if (!points || !is_real_somewhere(v, points, error)) {
        nh_points_free(points);
        return false;
    }
    size_t n = 1 + v->model->m + v->model->n;
    nh_ex *term = nh_arena_alloc(v->arena, n * sizeof *term);
    nh_rate_terms(v->model, v->current, term);
    v->proof = nh_prove_current(v->model, v->current, true, options);
    v->conserved = nh_verification_vanishes(v, points, n, term, &v->proof, options);
    if (v->fitted) v->proof.digits = -log10(fmax(v->residual, DBL_EPSILON));
    else if (v->conserved) delimit(v, options);
    nh_points_free(points);
    return true;
}

nh_verification *nh_verification_ask_current(nh_verification_question asked, nh_error *error)
{
    const nh_options *options = asked.options;
    nh_verification *v = nh_verification_start(asked, error);
    nh_ex e;
    if (!v) return NULL;
    bool good = nh_verification_read(v, "--current", asked.text, 0, strlen(asked.text), &e, error) &&
                nh_analysis_file_to_chart(v->model, e, &v->current, error);
    if (good) {
        v->current = nh_simplify(v->model->dag, v->current);
        good =
            nh_verification_decide(v, options, error) && (!v->conserved || nh_verification_describe(v, options, error));
        if (good) ask_other_branch(v, e, options);
    }
    return nh_verification_complete(v, good, error);
}

nh_verification *nh_verification_of_current(nh_system *system, nh_chart_choice chart, const char *text,
                                            const nh_options *options, nh_error *error)
{
    return nh_verification_ask_current((nh_verification_question){system, chart, text, options, NULL}, error);
}

nh_verification *nh_verification_create(const nh_request *q, nh_error *error)
{
    nh_system *system = nh_system_read(q->system_path, q->settings, q->setting, error); /* the verification's own */
    nh_verification_question asked = {system, q->chart, q->current ? q->current : q->field, &q->options, q};
    if (!system) return NULL;
    if (q->current) return nh_verification_ask_current(asked, error);
    bool of_motions = q->of && !strcmp(q->of, "equations");
    return (of_motions ? nh_verification_ask_motions : nh_verification_ask_field)(asked, error);
}

void nh_verification_write_out(nh_verification *v, const nh_options *options)
{
    v->other = nh_shown_other(v->model, options);
    v->theory = nh_theory_of(v->arena, v->model, v->other, 1, options);
    if (!v->has_symmetry || v->trivial) return;
    nh_theory_add(v->arena, v->theory, "Phi", &v->symmetry);
    nh_named_current *current = nh_arena_alloc(v->arena, sizeof *current);
    *current = (nh_named_current){.name = "Phi", .phi = v->symmetry.phi};
    if (v->conserved && v->proof.proved) nh_theory_space(v->arena, v->theory, 1, current, 0, options);
}
