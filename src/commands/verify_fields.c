/* verify_fields: is this field a symmetry of the constraint, or of the equations of motion? */
#include "commands/verify_internal.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"

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
    const char *name = nh_system_state_name(v->system, nh_arena_strndup(v->arena, typed + begin, n));
    long index = nh_system_coordinate(v->system, name);
    bool is_time = !strcmp(name, "Z0") || !strcmp(name, "t");
    nh_ex *to = is_time ? &g->time : index >= 0 ? &g->space[index] : NULL;
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
    return nh_verification_read(v, "--field", typed, right, end - right, to, error) &&
           nh_analysis_file_to_chart(v->model, *to, to, error);
}

/* Solves Z^s = zeta^i R^s_i + rho^s Z^0 for zeta, from n rows of R: those of the free coordinates, or by least squares
 * for quasi-velocities. */
static bool solve_zeta(nh_verification *v, nh_ex time, const nh_ex *space, nh_ex *zeta, nh_error *error)
{
    const nh_model *model = v->model;
    nh_dag *d = model->dag;
    size_t n = model->n, m = model->m;
    nh_ex *rest = nh_arena_alloc(v->arena, (m + 1) * sizeof *rest);
    for (size_t s = 0; s < m; s++) rest[s] = nh_sub(d, space[s], nh_mul(d, model->rho[s], time));
    if (!model->chart->quasi) {
        for (size_t i = 0; i < n; i++) zeta[i] = rest[model->chart->free[i]];
        return true;
    }
    nh_ex *N = nh_arena_alloc(v->arena, (n * n + 1) * sizeof *N);
    for (size_t i = 0; i < n; i++) {
        zeta[i] = nh_int(d, 0);
        for (size_t j = 0; j < n; j++) N[i * n + j] = nh_int(d, 0);
        for (size_t s = 0; s < m; s++) {
            zeta[i] = nh_add(d, zeta[i], nh_mul(d, model->R[s * n + i], rest[s]));
            for (size_t j = 0; j < n; j++)
                N[i * n + j] = nh_add(d, N[i * n + j], nh_mul(d, model->R[s * n + i], model->R[s * n + j]));
        }
    }
    for (size_t i = 0; i < n * n; i++) N[i] = nh_simplify(d, N[i]);
    nh_lu *lu = nh_lu_create(d, n, N, nh_chart_pivot_score, model->chart, NULL);
    if (!lu)
        return nh_fail(error, NH_NUMERIC, "", "the chart %s degenerates on the sampling domain", model->chart->name);
    nh_lu_solve(lu, zeta, zeta);
    nh_lu_free(lu);
    for (size_t i = 0; i < n; i++) zeta[i] = nh_simplify(d, zeta[i]);
    return true;
}

/* i_Z phi^a = nu^a_s (Z^s - rho^s Z^0), which vanish iff Z lies in the canonical distribution. */
static void outside(nh_verification *v, const given *g)
{
    const nh_model *model = v->model;
    nh_dag *d = model->dag;
    v->form = nh_arena_alloc(v->arena, (model->k + 1) * sizeof *v->form);
    for (size_t a = 0; a < model->k; a++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t s = 0; s < model->m; s++)
            sum = nh_add(
                d, sum,
                nh_mul(d, model->nu[a * model->m + s], nh_sub(d, g->space[s], nh_mul(d, model->rho[s], g->time))));
        v->form[a] = nh_simplify(d, sum);
    }
}

/* The expression that has to vanish, as --equations writes it, and its number in [CechMusilova2014]. */
static void name_condition(nh_verification *v, size_t number, const char *in_chart, const char *in_quasi, size_t j)
{
    const nh_model *model = v->model;
    const nh_chart *c = model->chart;
    const char *w = nh_name_of(model->dag, c->w[j]), *q = c->quasi ? w : v->system->coordinate[c->free[j]].name;
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
    const nh_model *model = v->model;
    nh_dag *d = model->dag;
    size_t n = 0;
    if (k < model->k) {
        for (size_t s = 0; s < model->m; s++) {
            term[n++] = nh_mul(d, model->nu[k * model->m + s], g->space[s]);
            term[n++] = nh_neg(d, nh_product(d, 3, (nh_ex[]){model->nu[k * model->m + s], model->rho[s], g->time}));
        }
        v->equation = nh_arena_printf(v->arena, "i_{Z} \\form^{%zu}", k + 1);
        v->equation_number = 6;
    } else if (k == model->k) {
        term[n++] = nh_model_X0(model, v->current);
        for (size_t i = 0; i < model->n; i++) term[n++] = nh_mul(d, model->A[i], g->zeta[i]);
        name_condition(v, 17, "\\frac{\\dcp Phi}{\\d t} + \\bar{A}_{l} zeta^{l}", "X_{0}(Phi) + A_{l} zeta^{l}", 0);
    } else if (k <= model->k + model->n) {
        size_t j = k - model->k - 1;
        term[n++] = nh_model_Y(model, j, v->current);
        for (size_t i = 0; i < model->n; i++) term[n++] = nh_neg(d, nh_mul(d, model->M[i * model->n + j], g->zeta[i]));
        name_condition(v, 19, "\\frac{\\p Phi}{\\p #} + \\bar{B}_{l,@} zeta^{l}", "Y_{@}(Phi) - M_{l,@} zeta^{l}", j);
    } else {
        size_t j = k - model->k - 1 - model->n;
        term[n++] = nh_model_X(model, j, v->current);
        term[n++] = nh_neg(d, nh_mul(d, model->A[j], g->time));
        for (size_t i = 0; i < model->n; i++) {
            term[n++] = nh_mul(d, nh_model_G(model)[i * model->n + j], g->zeta[i]);
            term[n++] = nh_mul(d, model->M[i * model->n + j], g->W[i]);
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
    nh_model *model = v->model;
    nh_points *points = nh_verification_points(model, options, error);
    if (!points) return false;
    size_t total = model->k + 1 + (g->has_W ? 2 : 1) * model->n;
    nh_ex *term = nh_arena_alloc(v->arena, (2 * (model->m + model->n) + 4) * sizeof *term);
    v->conserved = true;
    v->proof = (nh_proof){.proved = true, .all_parameters = true, .digits = INFINITY};
    for (size_t k = 0; k < total && v->conserved; k++) {
        size_t n = condition(v, g, k, term);
        nh_proof proof = nh_prove_zero(model, n, term, true, options);
        v->conserved = nh_verification_vanishes(v, points, n, term, &proof, options);
        v->outside |= !v->conserved && k < model->k;
        v->proof = nh_proof_both(model, v->proof, proof);
    }
    nh_points_free(points);
    return true;
}

/* "Z0=..; x=..", where components that are not named vanish; or "Gamma/Lbar". */
static bool read_field(nh_verification *v, const char *text, given *g, nh_error *error)
{
    const nh_model *model = v->model;
    *g = (given){.time = nh_int(model->dag, 0),
                 .space = nh_arena_alloc(v->arena, (model->m + 1) * sizeof(nh_ex)),
                 .zeta = nh_arena_alloc(v->arena, (model->n + 1) * sizeof(nh_ex)),
                 .W = nh_arena_alloc(v->arena, (model->n + 1) * sizeof(nh_ex))};
    bool good = true; /* node 0 is the number 0 */
    if (!strchr(text, '=') && (strstr(text, "Gamma") || strstr(text, "Z("))) {
        nh_field z = {g->time, g->space, g->W};
        g->has_W = good = nh_verification_read_field(v, text, &z, error);
        g->time = z.time;
        return good;
    }
    for (const char *p = text; good && *p;) {
        size_t length = nh_text_entry(p, ",;");
        good = component(v, text, (size_t)(p - text), (size_t)(p - text) + length, g, error);
        p += length + (p[length] != 0);
    }
    return good;
}

nh_verification *nh_verification_ask_field(nh_verification_question asked, nh_error *error)
{
    const nh_options *options = asked.options;
    nh_verification *v = nh_verification_start(asked, error);
    if (!v) return NULL;
    nh_model *model = v->model;
    given g;
    bool good = read_field(v, asked.text, &g, error) && solve_zeta(v, g.time, g.space, g.zeta, error);
    if (good) {
        v->current = nh_simplify(model->dag, nh_symmetry_current(model, g.time, g.zeta));
        outside(v, &g);
        good = check_field(v, &g, options, error) && (!v->conserved || nh_verification_describe(v, options, error));
    }
    return nh_verification_complete(v, good, error);
}

nh_verification *nh_verification_of_field(nh_system *system, nh_chart_choice chart, const char *text,
                                          const nh_options *options, nh_error *error)
{
    return nh_verification_ask_field((nh_verification_question){system, chart, text, options, NULL}, error);
}

/* ---- symmetries of the equations of motion ---- */

/* The part of Z(e) along time and coordinates. */
static nh_ex along_places(const nh_model *model, const given *g, nh_ex e)
{
    nh_dag *d = model->dag;
    nh_ex sum = nh_mul(d, g->time, nh_diff(d, e, model->system->t));
    for (size_t s = 0; s < model->m; s++)
        sum = nh_add(d, sum, nh_mul(d, g->space[s], nh_diff(d, e, model->system->coordinate[s].q)));
    return sum;
}

/* W from [Gamma,Z]^s = f rho^s, where the user gave none: R^s_i W^i = Gamma(Z^s) - Z_q(rho^s) - f rho^s, with
   Gamma(Z^s) and f = Gamma(Z^0). */
static bool prolong(nh_verification *v, given *g, nh_error *error)
{
    const nh_model *model = v->model;
    nh_dag *d = model->dag;
    nh_ex *rest = nh_arena_alloc(v->arena, (model->m + 1) * sizeof *rest);
    if (g->has_W) return true;
    for (size_t s = 0; s < model->m; s++) {
        rest[s] = nh_sub(d, nh_model_gamma(model, g->space[s]), along_places(model, g, model->rho[s]));
        rest[s] = nh_sub(d, rest[s], nh_mul(d, v->factor, model->rho[s]));
    }
    if (!solve_zeta(v, nh_int(d, 0), rest, g->W, error)) return false;
    for (size_t i = 0; i < model->n; i++) g->W[i] = nh_simplify(d, g->W[i]);
    return true;
}

/* [Gamma,Z] - f Gamma along coordinate k, or velocity k - m: three terms. */
static void motion_condition(nh_verification *v, const given *g, size_t k, nh_ex term[3])
{
    const nh_model *model = v->model;
    nh_field Z = {g->time, g->space, g->W};
    bool place = k < model->m;
    nh_ex own = place ? g->space[k] : g->W[k - model->m], motion = place ? model->rho[k] : model->a[k - model->m];
    term[0] = nh_model_gamma(model, own);
    term[1] = nh_neg(model->dag, nh_model_along(model, &Z, motion));
    term[2] = nh_neg(model->dag, nh_mul(model->dag, v->factor, motion));
    v->equation_number = 0;
    const char *along = place ? v->system->coordinate[k].name : nh_name_of(model->dag, model->chart->w[k - model->m]);
    v->equation = nh_arena_printf(v->arena, "[Gamma,Z]^{<%s>} - f Gamma^{<%s>}", along, along);
}

/* Z(Phi) of the currents that the system file knows. */
static void make_currents(nh_verification *v, const given *g)
{
    const nh_system *system = v->system;
    nh_field Z = {g->time, g->space, g->W};
    nh_error ignored;
    v->make = nh_arena_alloc(v->arena, (system->currents + 1) * sizeof *v->make);
    for (size_t i = 0; i < system->currents; i++) {
        nh_ex phi;
        nh_error_clear(&ignored);
        if (!nh_analysis_file_to_chart(v->model, system->current[i].value, &phi, &ignored)) continue;
        v->make[v->made++] = (nh_named){.name = system->current[i].name,
                                        .value = nh_simplify(v->model->dag, nh_model_along(v->model, &Z, phi))};
    }
}

nh_verification *nh_verification_ask_motions(nh_verification_question asked, nh_error *error)
{
    const nh_options *options = asked.options;
    nh_verification *v = nh_verification_start(asked, error);
    if (!v) return NULL;
    nh_model *model = v->model;
    given g;
    bool good = read_field(v, asked.text, &g, error);
    v->of_equations = true;
    v->factor = good ? nh_simplify(model->dag, nh_model_gamma(model, g.time)) : 0;
    good = good && prolong(v, &g, error);
    nh_points *points = good ? nh_verification_points(model, options, error) : NULL;
    good = points != NULL;
    v->conserved = true;
    v->proof = (nh_proof){.proved = true, .all_parameters = true, .digits = INFINITY};
    for (size_t k = 0; k < model->m + model->n && good && v->conserved; k++) {
        nh_ex term[3];
        motion_condition(v, &g, k, term);
        nh_proof proof = nh_prove_zero(model, 3, term, true, options);
        v->conserved = nh_verification_vanishes(v, points, 3, term, &proof, options);
        v->proof = nh_proof_both(model, v->proof, proof);
    }
    nh_points_free(points);
    if (good && v->conserved) make_currents(v, &g);
    return nh_verification_complete(v, good, error);
}

nh_verification *nh_verification_of_motions(nh_system *system, nh_chart_choice chart, const char *text,
                                            const nh_options *options, nh_error *error)
{
    return nh_verification_ask_motions((nh_verification_question){system, chart, text, options, NULL}, error);
}
