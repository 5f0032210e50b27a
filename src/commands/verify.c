#include "commands/verify.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "graph/diff.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "integrals/independence.h"
#include "search/branch.h"
#include "search/theory.h"
#include "problem/time_scale.h"

enum { test_points = 256, generic_points = 24 };

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
    nh_model *other = v->conserved ? nh_branch_other(v->model, options) : NULL;
    nh_ex phi;
    if (other && nh_analysis_file_to_chart(other, e, &phi, &ignored))
        v->on_both = nh_branch_conserves(other, phi, &v->proof, options);
    nh_model_free(other);
}

static nh_verification *start(nh_system *system, nh_chart_choice chart, const nh_options *options, nh_error *error)
{
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
    *v = (nh_verification){.arena = arena, .system = system, .model = model};
    name_branches(v);
    return v;
}

/* The verdict; for a run that was ended neither "yes" nor "no" is known. */
static nh_verification *complete(nh_verification *v, bool good, nh_error *error)
{
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

static const double rounding = 64 * DBL_EPSILON;

/* Finds the point where |e| / sum of |terms| is largest.  A value that is no more than rounding of what cancels within
 * the terms is taken relative to that. */
static bool worst_point(nh_verification *v, const nh_points *points, size_t n, const nh_ex *term, double *residual)
{
    size_t count = points->count, worst = count;
    double *value = nh_alloc_array((n + 1) * count + 1, sizeof *value), most = 0, rate = 0;
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
        if (!isfinite(r) || r <= most) continue;
        most = r;
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

/* Is it constant on the submanifold?  All derivatives vanish there, by normal form; or wherever it is smooth, however
 * it is written. */
static bool is_constant(const nh_model *o, const nh_points *generic, nh_ex phi, const nh_options *options)
{
    nh_independence kind;
    bool proved = true;
    for (size_t j = 0; j < 1 + o->m + o->n && proved; j++)
        proved = nh_normal_is_zero(o->dag, nh_diff(o->dag, phi, o->chart->symbol[j]), (size_t)options->proof_terms) ==
                 NH_ZERO;
    if (proved) return true;
    nh_independence_test(o, generic, 1, &phi, options->sure, options->doubt, &kind, NULL);
    return kind == NH_CONSTANT;
}

/* The symmetry of a conserved quantity, and whether it is trivial. */
static bool describe(nh_verification *v, const nh_options *options, nh_error *error)
{
    nh_points *generic = nh_points_create(v->model, generic_points, 1, (uint64_t)options->seed + 8, error);
    if (!generic) return false;
    nh_error ignored;
    nh_error_clear(&ignored);
    v->trivial = is_constant(v->model, generic, v->current, options);
    v->has_symmetry = nh_symmetry_of(v->model, generic, v->current, options->same, &v->symmetry, &ignored);
    nh_points_free(generic);
    return true;
}

/* It is conserved wherever it is smooth.  Also along whole motions, which end at walls where they have an impulse? */
static void delimit(nh_verification *v, const nh_options *options)
{
    nh_terrain terrain = nh_terrain_of(v->model, options, v->arena);
    double digits = v->proof.proved && !v->proof.sided ? 0 : v->proof.digits / 2;
    nh_region region = nh_region_of(v->model, &terrain, v->current, digits, options, v->arena);
    if (v->proof.sided && region.count) region = nh_region_of_pairs(v->model);
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

static bool examine(nh_verification *v, const nh_options *options, nh_error *error)
{
    nh_points *points = nh_points_create(v->model, test_points, 1.2, (uint64_t)options->seed + 7, error);
    if (!points || !is_real_somewhere(v, points, error)) {
        nh_points_free(points);
        return false;
    }
    size_t n = 1 + v->model->m + v->model->n;
    nh_ex *term = nh_arena_alloc(v->arena, n * sizeof *term);
    nh_rate_terms(v->model, v->current, term);
    v->proof = nh_prove_zero(v->model, n, term, true, options);
    bool found = worst_point(v, points, n, term, &v->residual);
    v->conserved = accepts(&v->proof, v->residual, options);
    v->has_counterexample = found && !v->conserved;
    if (v->conserved) delimit(v, options);
    nh_points_free(points);
    return !v->conserved || describe(v, options, error);
}

nh_verification *nh_verification_of_current(nh_system *system, nh_chart_choice chart, const char *text,
                                            const nh_options *options, nh_error *error)
{
    nh_verification *v = start(system, chart, options, error);
    nh_ex e;
    if (!v) return NULL;
    bool good = nh_system_expression_text(system, "--current", text, 0, NULL, &e, error) &&
                nh_analysis_file_to_chart(v->model, e, &v->current, error);
    if (good) {
        v->current = nh_simplify(v->model->dag, v->current);
        good = examine(v, options, error);
        if (good) ask_other_branch(v, e, options);
    }
    return complete(v, good, error);
}

/* ---- fields ---- */

/* The components that the user gave: along t, the coordinates and, optionally, the velocities of the chart. */
typedef struct {
    nh_ex time, *space, *zeta, *W;
    bool has_W;
} given;

/* One "name=expression" between semicolons: typed[begin .. end). */
static bool component(nh_verification *v, const char *typed, size_t begin, size_t end, given *g, nh_error *error)
{
    while (begin < end && typed[begin] == ' ') begin++;
    if (begin == end) return true;
    const char *equal = memchr(typed + begin, '=', end - begin);
    size_t right = equal ? (size_t)(equal - typed) + 1 : end, n = right - 1 - begin;
    if (!equal)
        return nh_deck_fail_typed("--field", typed, begin, error,
                                  "a component `name=expression` was expected, found `%.*s`", (int)(end - begin),
                                  typed + begin);
    while (n && typed[begin + n - 1] == ' ') n--;
    char *name = nh_arena_strndup(v->arena, typed + begin, n);
    long index = nh_system_coordinate(v->system, name);
    bool is_time = !strcmp(name, "Z0") || !strcmp(name, "t");
    nh_ex e, *to = is_time ? &g->time : index >= 0 ? &g->space[index] : NULL;
    for (size_t i = 0; i < v->model->n && !to; i++)
        if (!strcmp(name, nh_name_of(v->model->dag, v->model->chart->w[i]))) {
            to = &g->W[i];
            g->has_W = true;
        }
    if (!to) {
        nh_deck_fail_typed("--field", typed, begin, error,
                           "`%s` is neither Z0 nor a coordinate nor a velocity of the chart", name);
        return nh_error_hint(
            error,
            "the components along time (Z0) and along the coordinates determine the field; omitted components are 0");
    }
    return nh_system_expression_part(v->system, "--field", typed, right, end - right, 0, NULL, &e, error) &&
           nh_analysis_file_to_chart(v->model, e, to, error);
}

/* Solves Z^s = zeta^i R^s_i + rho^s Z^0 for zeta, from n rows of R: those of the free coordinates, or by least squares
 * for quasi-velocities. */
static bool solve_zeta(nh_verification *v, nh_ex time, const nh_ex *space, nh_ex *zeta, nh_error *error)
{
    const nh_model *o = v->model;
    nh_dag *d = o->dag;
    size_t n = o->n, m = o->m;
    nh_ex *rest = nh_arena_alloc(v->arena, (m + 1) * sizeof *rest);
    for (size_t s = 0; s < m; s++) rest[s] = nh_sub(d, space[s], nh_mul(d, o->rho[s], time));
    if (!o->chart->quasi) {
        for (size_t i = 0; i < n; i++) zeta[i] = rest[o->chart->free[i]];
        return true;
    }
    nh_ex *N = nh_arena_alloc(v->arena, (n * n + 1) * sizeof *N);
    for (size_t i = 0; i < n; i++) {
        zeta[i] = nh_int(d, 0);
        for (size_t j = 0; j < n; j++) N[i * n + j] = nh_int(d, 0);
        for (size_t s = 0; s < m; s++) {
            zeta[i] = nh_add(d, zeta[i], nh_mul(d, o->R[s * n + i], rest[s]));
            for (size_t j = 0; j < n; j++)
                N[i * n + j] = nh_add(d, N[i * n + j], nh_mul(d, o->R[s * n + i], o->R[s * n + j]));
        }
    }
    for (size_t i = 0; i < n * n; i++) N[i] = nh_simplify(d, N[i]);
    nh_lu *lu = nh_lu_create(d, n, N, nh_chart_pivot_score, o->chart, NULL);
    if (!lu) return nh_fail(error, NH_NUMERIC, "", "the chart %s degenerates on the sampling domain", o->chart->name);
    nh_lu_solve(lu, zeta, zeta);
    nh_lu_free(lu);
    for (size_t i = 0; i < n; i++) zeta[i] = nh_simplify(d, zeta[i]);
    return true;
}

/* i_Z phi^a = nu^a_s (Z^s - rho^s Z^0), which vanish iff Z lies in the canonical distribution. */
static void outside(nh_verification *v, const given *g)
{
    const nh_model *o = v->model;
    nh_dag *d = o->dag;
    v->form = nh_arena_alloc(v->arena, (o->k + 1) * sizeof *v->form);
    for (size_t a = 0; a < o->k; a++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t s = 0; s < o->m; s++)
            sum = nh_add(d, sum, nh_mul(d, o->nu[a * o->m + s], nh_sub(d, g->space[s], nh_mul(d, o->rho[s], g->time))));
        v->form[a] = nh_simplify(d, sum);
    }
}

/* The expression that has to vanish, as --equations writes it, and its number in [CechMusilova2014]. */
static void name_condition(nh_verification *v, size_t number, const char *in_chart, const char *in_quasi, size_t j)
{
    const nh_model *o = v->model;
    const nh_chart *c = o->chart;
    const char *w = nh_name_of(o->dag, c->w[j]), *q = c->quasi ? w : v->system->coordinate[c->free[j]].name;
    nh_text label;
    nh_text_init(&label);
    for (const char *at = c->quasi ? in_quasi : in_chart; *at; at++) {
        if (*at == '@') nh_text_addf(&label, "<%s>", q);
        else if (*at == '#') nh_text_addf(&label, "<%s>", w);
        else nh_text_add_n(&label, at, 1);
    }
    v->equation = nh_arena_printf(v->arena, "%s", nh_text_string(&label));
    v->equation_number = number;
    nh_text_clear(&label);
}

/* The terms of the k-th condition: Z in the canonical distribution (as many as constraints), (N0), (NY) (n); (NX) (n)
 * only determines W and is checked only when the user gave W. */
static size_t condition(nh_verification *v, const given *g, size_t k, nh_ex *term)
{
    const nh_model *o = v->model;
    nh_dag *d = o->dag;
    size_t n = 0;
    if (k < o->k) {
        for (size_t s = 0; s < o->m; s++) {
            term[n++] = nh_mul(d, o->nu[k * o->m + s], g->space[s]);
            term[n++] = nh_neg(d, nh_product(d, 3, (nh_ex[]){o->nu[k * o->m + s], o->rho[s], g->time}));
        }
        v->equation = nh_arena_printf(v->arena, "i_{Z} \\form^{%zu}", k + 1);
        v->equation_number = 6;
    } else if (k == o->k) {
        term[n++] = nh_model_X0(o, v->current);
        for (size_t i = 0; i < o->n; i++) term[n++] = nh_mul(d, o->A[i], g->zeta[i]);
        name_condition(v, 17, "\\frac{\\dcp Phi}{\\d t} + \\bar{A}_{l} zeta^{l}", "X_{0}(Phi) + A_{l} zeta^{l}", 0);
    } else if (k <= o->k + o->n) {
        size_t j = k - o->k - 1;
        term[n++] = nh_model_Y(o, j, v->current);
        for (size_t i = 0; i < o->n; i++) term[n++] = nh_neg(d, nh_mul(d, o->M[i * o->n + j], g->zeta[i]));
        name_condition(v, 19, "\\frac{\\p Phi}{\\p #} + \\bar{B}_{l,@} zeta^{l}", "Y_{@}(Phi) - M_{l,@} zeta^{l}", j);
    } else {
        size_t j = k - o->k - 1 - o->n;
        term[n++] = nh_model_X(o, j, v->current);
        term[n++] = nh_neg(d, nh_mul(d, o->A[j], g->time));
        for (size_t i = 0; i < o->n; i++) {
            term[n++] = nh_mul(d, nh_model_G(o)[i * o->n + j], g->zeta[i]);
            term[n++] = nh_mul(d, o->M[i * o->n + j], g->W[i]);
        }
        name_condition(v, 18,
                       "\\frac{\\pc Phi}{\\p @} - \\bar{A}_{@} Z^{0} + G_{l,@} zeta^{l} - "
                       "\\bar{B}_{l,@} \\tilde{Z}^{l}",
                       "X_{@}(Phi) - A_{@} Z^{0} + G_{l,@} zeta^{l} + M_{l,@} W^{l}", j);
    }
    return n;
}

static bool check_field(nh_verification *v, const given *g, const nh_options *options, nh_error *error)
{
    const nh_model *o = v->model;
    nh_points *points = nh_points_create(o, test_points, 1.2, (uint64_t)options->seed + 7, error);
    if (!points) return false;
    size_t total = o->k + 1 + (g->has_W ? 2 : 1) * o->n;
    nh_ex *term = nh_arena_alloc(v->arena, (2 * (o->m + o->n) + 4) * sizeof *term);
    v->conserved = true;
    v->proof = (nh_proof){.proved = true, .all_parameters = true, .digits = INFINITY};
    for (size_t k = 0; k < total && v->conserved; k++) {
        size_t n = condition(v, g, k, term);
        nh_proof proof = nh_prove_zero(o, n, term, true, options);
        double residual;
        bool found = worst_point(v, points, n, term, &residual);
        v->residual = fmax(v->residual, residual);
        v->conserved = accepts(&proof, residual, options);
        v->outside |= !v->conserved && k < o->k;
        v->has_counterexample = found && !v->conserved;
        v->proof = nh_proof_both(o, v->proof, proof);
    }
    nh_points_free(points);
    return true;
}

/* "Z0=..; x=.."; components that are not named vanish. */
static bool read_field(nh_verification *v, const char *text, given *g, nh_error *error)
{
    const nh_model *o = v->model;
    *g = (given){.time = nh_int(o->dag, 0),
                 .space = nh_arena_alloc(v->arena, (o->m + 1) * sizeof(nh_ex)),
                 .zeta = nh_arena_alloc(v->arena, (o->n + 1) * sizeof(nh_ex)),
                 .W = nh_arena_alloc(v->arena, (o->n + 1) * sizeof(nh_ex))};
    bool good = true; /* node 0 is the number 0 */
    for (const char *p = text; good && *p;) {
        size_t length = nh_text_entry(p, ",;");
        good = component(v, text, (size_t)(p - text), (size_t)(p - text) + length, g, error);
        p += length + (p[length] != 0);
    }
    return good;
}

nh_verification *nh_verification_of_field(nh_system *system, nh_chart_choice chart, const char *text,
                                          const nh_options *options, nh_error *error)
{
    nh_verification *v = start(system, chart, options, error);
    if (!v) return NULL;
    nh_model *o = v->model;
    given g;
    bool good = read_field(v, text, &g, error) && solve_zeta(v, g.time, g.space, g.zeta, error);
    if (good) {
        v->current = nh_simplify(o->dag, nh_symmetry_current(o, g.time, g.zeta));
        outside(v, &g);
        good = check_field(v, &g, options, error) && (!v->conserved || describe(v, options, error));
    }
    return complete(v, good, error);
}

/* ---- symmetries of the equations of motion ---- */

/* The part of Z(e) along time and coordinates. */
static nh_ex along_places(const nh_model *o, const given *g, nh_ex e)
{
    nh_dag *d = o->dag;
    nh_ex sum = nh_mul(d, g->time, nh_diff(d, e, o->system->t));
    for (size_t s = 0; s < o->m; s++)
        sum = nh_add(d, sum, nh_mul(d, g->space[s], nh_diff(d, e, o->system->coordinate[s].q)));
    return sum;
}

/* W from [Gamma,Z]^s = f rho^s, where the user gave none: R^s_i W^i = Gamma(Z^s) - Z_q(rho^s) - f rho^s, with
   Gamma(Z^s) and f = Gamma(Z^0). */
static bool prolong(nh_verification *v, given *g, nh_error *error)
{
    const nh_model *o = v->model;
    nh_dag *d = o->dag;
    nh_ex *rest = nh_arena_alloc(v->arena, (o->m + 1) * sizeof *rest);
    if (g->has_W) return true;
    for (size_t s = 0; s < o->m; s++) {
        rest[s] = nh_sub(d, nh_model_gamma(o, g->space[s]), along_places(o, g, o->rho[s]));
        rest[s] = nh_sub(d, rest[s], nh_mul(d, v->factor, o->rho[s]));
    }
    if (!solve_zeta(v, nh_int(d, 0), rest, g->W, error)) return false;
    for (size_t i = 0; i < o->n; i++) g->W[i] = nh_simplify(d, g->W[i]);
    return true;
}

/* [Gamma,Z] - f Gamma along coordinate k, or velocity k - m: three terms. */
static void motion_condition(nh_verification *v, const given *g, size_t k, nh_ex term[3])
{
    const nh_model *o = v->model;
    nh_field Z = {g->time, g->space, g->W};
    bool place = k < o->m;
    nh_ex own = place ? g->space[k] : g->W[k - o->m], motion = place ? o->rho[k] : o->a[k - o->m];
    term[0] = nh_model_gamma(o, own);
    term[1] = nh_neg(o->dag, nh_model_along(o, &Z, motion));
    term[2] = nh_neg(o->dag, nh_mul(o->dag, v->factor, motion));
    v->equation_number = 0;
    const char *along = place ? v->system->coordinate[k].name : nh_name_of(o->dag, o->chart->w[k - o->m]);
    v->equation = nh_arena_printf(v->arena, "[Gamma,Z]^{<%s>} - f Gamma^{<%s>}", along, along);
}

/* Z(Phi) of the currents that the system file knows. */
static void make_currents(nh_verification *v, const given *g)
{
    const nh_system *y = v->system;
    nh_field Z = {g->time, g->space, g->W};
    nh_error ignored;
    v->make = nh_arena_alloc(v->arena, (y->currents + 1) * sizeof *v->make);
    for (size_t i = 0; i < y->currents; i++) {
        nh_ex phi;
        nh_error_clear(&ignored);
        if (!nh_analysis_file_to_chart(v->model, y->current[i].value, &phi, &ignored)) continue;
        v->make[v->made++] = (nh_named){.name = y->current[i].name,
                                        .value = nh_simplify(v->model->dag, nh_model_along(v->model, &Z, phi))};
    }
}

nh_verification *nh_verification_of_motions(nh_system *system, nh_chart_choice chart, const char *text,
                                            const nh_options *options, nh_error *error)
{
    nh_verification *v = start(system, chart, options, error);
    if (!v) return NULL;
    nh_model *o = v->model;
    given g;
    bool good = read_field(v, text, &g, error);
    v->of_equations = true;
    v->factor = good ? nh_simplify(o->dag, nh_model_gamma(o, g.time)) : 0;
    good = good && prolong(v, &g, error);
    nh_points *points = good ? nh_points_create(o, test_points, 1.2, (uint64_t)options->seed + 7, error) : NULL;
    good = points != NULL;
    v->conserved = true;
    v->proof = (nh_proof){.proved = true, .all_parameters = true, .digits = INFINITY};
    for (size_t k = 0; k < o->m + o->n && good && v->conserved; k++) {
        nh_ex term[3];
        double residual;
        motion_condition(v, &g, k, term);
        nh_proof proof = nh_prove_zero(o, 3, term, true, options);
        bool found = worst_point(v, points, 3, term, &residual);
        v->residual = fmax(v->residual, residual);
        v->conserved = accepts(&proof, residual, options);
        v->has_counterexample = found && !v->conserved;
        v->proof = nh_proof_both(o, v->proof, proof);
    }
    nh_points_free(points);
    if (good && v->conserved) make_currents(v, &g);
    return complete(v, good, error);
}

void nh_verification_write_out(nh_verification *v, const nh_options *options)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    if (v->model->chart->quasi && v->system->constraints)
        v->other = nh_model_create(
            v->system, nh_chart_create(v->system, NH_CHART_COORDINATES, (uint64_t)options->seed, &ignored), &ignored);
    v->theory = nh_theory_of(v->arena, v->model, v->other, 1, options);
    if (!v->has_symmetry || v->trivial) return;
    nh_theory_add(v->arena, v->theory, "Phi", &v->symmetry);
    nh_named_current *current = nh_arena_alloc(v->arena, sizeof *current);
    *current = (nh_named_current){.name = "Phi", .phi = v->symmetry.phi};
    if (v->conserved && v->proof.proved) nh_theory_space(v->arena, v->theory, 1, current, 0, options);
}
