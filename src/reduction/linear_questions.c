#include "reduction/linear_questions.h"

#include <string.h>

#include "geometry/distribution.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "reduction/chaplygin.h"
#include "reduction/group.h"

const char *nh_linear_question_name(nh_linear_question question)
{
    static const char *const names[] = {
#define X(name, word) #word,
        NH_LINEAR_QUESTION_TABLE(X)
#undef X
    };
    return names[question];
}

static bool refuse(nh_linear_system *s, const char *obstacle)
{
    if (!s->obstacle) s->obstacle = obstacle;
    return false;
}

/* Room for the coefficients, all zero. */
static nh_ex *coefficients(nh_linear_system *s, nh_dag *d, size_t equations)
{
    nh_linear_family *f = &s->family;
    size_t count = equations * f->unknowns * (f->variables + 1);
    nh_ex *e = nh_arena_alloc(s->arena, (count + 1) * sizeof *e);
    for (size_t i = 0; i < count; i++) e[i] = nh_int(d, 0);
    f->equations[f->levels++] = equations;
    f->coefficient = e;
    return e;
}

static nh_ex *at(const nh_linear_system *s, nh_ex *e, size_t equation, size_t unknown, size_t k)
{
    return e + (equation * s->family.unknowns + unknown) * (s->family.variables + 1) + k;
}

/* ---- symmetries ---- */

typedef struct {
    nh_linear_system *s;
    const nh_kinetic *k;
    nh_ex *e;
    size_t rows;
} writer;

/* sum over l of xi^l d_l F into the next row */
static void along(writer *w, nh_ex F)
{
    for (size_t l = 0; l < w->k->m; l++) *at(w->s, w->e, w->rows, l, w->k->m) = nh_diff(w->k->dag, F, w->k->q[l]);
}

/* factor d_k xi^l into the next row */
static void derivative(writer *w, size_t l, size_t k, nh_ex factor)
{
    nh_ex *e = at(w->s, w->e, w->rows, l, k);
    *e = nh_add(w->k->dag, *e, factor);
}

/* (xi^l d_l omega_s + omega_l d_s xi^l) X^s, and with b what affine constraints add. */
static void constraint_row(writer *w, const nh_ex *omega, nh_ex b, const nh_ex *X, size_t stride)
{
    const nh_kinetic *k = w->k;
    nh_dag *d = k->dag;
    for (size_t l = 0; l < k->m; l++) {
        nh_ex sum = nh_diff(d, b, k->q[l]);
        for (size_t s = 0; s < k->m; s++) {
            sum = nh_add(d, sum, nh_mul(d, nh_diff(d, omega[s], k->q[l]), X[s * stride]));
            derivative(w, l, s, nh_mul(d, omega[l], X[s * stride]));
        }
        *at(w->s, w->e, w->rows, l, k->m) = sum;
    }
    w->rows++;
}

static void metric_rows(writer *w)
{
    const nh_kinetic *k = w->k;
    for (size_t i = 0; i < k->m; i++)
        for (size_t j = 0; j <= i; j++, w->rows++) {
            along(w, k->K[i * k->m + j]);
            for (size_t l = 0; l < k->m; l++) {
                derivative(w, l, i, k->K[l * k->m + j]);
                derivative(w, l, j, k->K[i * k->m + l]);
            }
        }
}

static void constraint_rows(writer *w)
{
    const nh_kinetic *k = w->k;
    const nh_model *model = k->model;
    nh_dag *d = k->dag;
    nh_ex *rest = nh_alloc_array(k->m + model->n + 1, sizeof *rest), *zero = rest + k->m;
    for (size_t i = 0; i < model->n; i++) zero[i] = nh_int(d, 0);
    for (size_t s = 0; s < k->m; s++) rest[s] = nh_substitute(d, model->rho[s], model->n, model->chart->w, zero);
    for (size_t a = 0; a < k->f; a++) {
        for (size_t i = 0; i < model->n; i++)
            constraint_row(w, k->omega + a * k->m, nh_int(d, 0), model->R + i, model->n);
        if (!k->linear) constraint_row(w, k->omega + a * k->m, k->b[a], rest, 1);
    }
    nh_free(rest);
}

static bool holds_for_all(const nh_kinetic *k, const nh_generator *g)
{
    nh_proof proof = nh_generator_proof(k, g);
    return proof.proved && proof.all_parameters;
}

/* Generators that are symmetries for every value. */
static size_t generators_for_all(const nh_kinetic *k, const nh_options *options)
{
    nh_error none = {0};
    nh_group *group = nh_group_find(k, options, &none);
    size_t count = 0;
    for (size_t a = 0; group && a < group->action.d; a++) count += holds_for_all(k, &group->action.generator[a]);
    nh_group_free(group);
    return count;
}

static bool symmetries(nh_linear_system *s, const nh_kinetic *k, const nh_options *options)
{
    size_t m = k->m;
    const nh_model *model = k->model;
    if (!k->quadratic || !k->autonomous || !k->affine || k->forced) return refuse(s, k->obstacle);
    if (model->chart->implicit) return refuse(s, "velocities that are given implicitly");
    s->family.unknowns = s->family.variables = m;
    s->family.variable = k->q;
    s->family.low = 1;
    s->family.n = model->n;
    s->family.mass = model->M;
    writer w = {s, k, coefficients(s, k->dag, m * (m + 1) / 2 + 1 + m + k->f * (model->n + 1)), 0};
    metric_rows(&w);
    along(&w, k->V);
    w.rows++;
    for (size_t i = 0; i < m && k->magnetic; i++, w.rows++) {
        along(&w, k->a[i]);
        for (size_t l = 0; l < m; l++) derivative(&w, l, i, k->a[l]);
    }
    constraint_rows(&w);
    s->family.equations[0] = w.rows;
    s->family.known = generators_for_all(k, options);
    return true;
}

/* ---- hamiltonization ---- */

/* For every l and i < j: K_li d_j f - K_lj d_i f + U_lij f = 0 [BorisovMamaev2008]. */
static void conformal_rows(nh_linear_system *s, const nh_chaplygin *c)
{
    size_t n = c->n, row = 0;
    nh_dag *d = c->dag;
    s->family.unknowns = 1;
    s->family.variables = n;
    s->family.variable = c->slice->x;
    s->family.n = n;
    s->family.mass = c->K;
    nh_ex *e = coefficients(s, d, n * n * (n - 1) / 2);
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = i + 1; j < n; j++, row++) {
                *at(s, e, row, 0, j) = c->K[l * n + i];
                *at(s, e, row, 0, i) = nh_neg(d, c->K[l * n + j]);
                *at(s, e, row, 0, n) = c->U[(l * n + i) * n + j];
            }
}

static bool chaplygin(nh_linear_system *s, const nh_kinetic *k, const nh_action *action)
{
    nh_error none = {0};
    size_t *shape = nh_arena_alloc(k->arena, (k->m + 1) * sizeof *shape), *along_group = shape + (k->m - action->d);
    double *y = nh_arena_alloc(k->arena, (action->d + 1) * sizeof *y);
    nh_slice *slice = nh_arena_alloc(k->arena, sizeof *slice);
    nh_chaplygin *c = nh_arena_alloc(k->arena, sizeof *c);
    nh_slice_choose(action, shape, along_group);
    if (!nh_slice_nice(action, along_group, y)) return refuse(s, "no slice at round numbers is regular");
    nh_slice_init(slice, action, shape, along_group, y);
    for (size_t a = 0; a < action->d; a++)
        if (!holds_for_all(k, &action->generator[a]))
            return refuse(s, "the symmetry group depends on the values of parameters");
    if (!nh_chaplygin_init(c, slice, &none))
        return refuse(s, "the orbits of the group meet the constraint distribution");
    if (!c->plain) return refuse(s, k->obstacle);
    if (c->n < 2) return refuse(s, "every system with one shape coordinate is Hamiltonian");
    conformal_rows(s, c);
    return true;
}

static bool hamiltonization(nh_linear_system *s, const nh_kinetic *k, const nh_options *options)
{
    nh_error none = {0};
    nh_action action;
    if (k->obstacle) return refuse(s, k->obstacle);
    if (!k->f) return refuse(s, "without constraints every system is Hamiltonian");
    nh_group *group = nh_group_find(k, options, &none);
    if (!group) return refuse(s, "the symmetry group was not found");
    size_t d = group->action.d;
    double *t = nh_alloc_array(d * k->f + 1, sizeof *t);
    bool good = d >= k->f && nh_group_chaplygin(group, options, t);
    if (!good) refuse(s, "no group of symmetries makes a Chaplygin system");
    else {
        nh_action_sub(&action, &group->action, k->f, t, options);
        nh_group *part = nh_group_of(k, k->f, action.generator, options);
        s->group = nh_arena_strdup(s->arena, part->name);
        good = chaplygin(s, k, &action);
        nh_group_free(part);
        nh_action_clear(&action);
    }
    nh_free(t);
    nh_group_free(group);
    return good;
}

/* ---- constraints ---- */

enum { most_fields = 120, deepest = 4 };

/* Fields that span D, then brackets of these with the fields of the level before, level by level: as many levels as
 * the growth vector has for almost all values. Where brackets span less in the end they do so at one of these. */
static bool integrability(nh_linear_system *s, const nh_model *model, size_t length)
{
    nh_distribution_fields g = nh_distribution_fields_of(model);
    nh_dag *d = model->dag;
    if (!g.count) return refuse(s, "the velocities are not restricted by constraints that are at most affine");
    nh_ex *field = nh_arena_alloc(s->arena, most_fields * g.dimension * sizeof *field);
    size_t N = g.dimension, count = g.count, from = 0;
    memcpy(field, g.field, count * N * sizeof *field);
    s->family.unknowns = s->family.variables = N;
    s->family.variable = g.symbol;
    for (size_t level = 1; level == 1 || (level < length && level <= deepest); level++) {
        size_t end = count;
        if (count + g.count * (end - from) > most_fields) break;
        for (size_t i = 0; i < g.count; i++)
            for (size_t j = from; j < end; j++)
                if (j >= g.count || j > i)
                    nh_growth_bracket(d, N, g.symbol, field + i * N, field + j * N, field + count++ * N);
        from = end;
        s->family.equations[s->family.levels++] = count;
    }
    nh_free(g.field);
    size_t levels = s->family.levels, equations[NH_LINEAR_MOST_LEVELS];
    if (!levels) return refuse(s, "the constraints leave too many directions");
    memcpy(equations, s->family.equations, sizeof equations);
    nh_ex *e = coefficients(s, d, count);
    memcpy(s->family.equations, equations, sizeof equations);
    s->family.levels = levels;
    for (size_t row = 0; row < equations[levels - 1]; row++)
        for (size_t k = 0; k < N; k++) *at(s, e, row, k, N) = field[row * N + k];
    return true;
}

/* ---- all of them ---- */

static void measure(nh_linear_system *s, const nh_model *model)
{
    s->family.unknowns = s->family.levels = 1;
    s->family.equations[0] = model->n + 1;
}

nh_linear_system *nh_linear_system_create(const nh_model *model, nh_linear_question question, const nh_options *options)
{
    nh_arena *arena = nh_arena_create();
    nh_linear_system *s = nh_arena_alloc(arena, sizeof *s);
    nh_error none = {0};
    *s = (nh_linear_system){.arena = arena, .family = {.step = 1, .known = SIZE_MAX}};
    bool needed = question == NH_OF_SYMMETRIES || question == NH_OF_HAMILTONIZATION;
    s->kinetic = needed ? nh_kinetic_create(model, (uint64_t)options->seed, &none) : NULL;
    if (model->k) {
        nh_distribution d = nh_distribution_of(model);
        s->family.step = d.growth.length ? d.growth.length : 1;
    }
    if (needed && !s->kinetic) refuse(s, "there are too few usable sample points");
    else if (question == NH_OF_SYMMETRIES) symmetries(s, s->kinetic, options);
    else if (question == NH_OF_HAMILTONIZATION) hamiltonization(s, s->kinetic, options);
    else if (question == NH_OF_INTEGRABILITY) integrability(s, model, s->family.step);
    else measure(s, model);
    return s;
}

void nh_linear_system_free(nh_linear_system *s)
{
    if (!s) return;
    nh_kinetic_free(s->kinetic);
    nh_arena_free(s->arena);
}
