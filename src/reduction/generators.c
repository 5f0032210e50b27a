#include "reduction/generators.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "expr/normal.h"
#include "expr/relation.h"
#include "noether/recognise.h"
#include "reduction/generator_fit.h"
#include "reduction/joint_fields.h"
#include "reduction/relative.h"

enum { most_columns = 420 };

/* ---- one vector ---- */

/* The coefficients of one vector again, from its own terms alone: a large library is badly conditioned, a few terms are not. */
static void refit(nh_generator_fit *s, size_t r)
{
    nh_generator_fit t = {.k = s->k, .options = s->options, .m = s->m};
    double *v = s->vector + r * s->n, most = 0;
    size_t *index = nh_alloc_array(s->n + 1, sizeof *index);
    nh_error ignored = {0};
    for (size_t j = 0; j < s->n; j++)
        if (v[j] != 0) index[t.n++] = j;
    nh_library_pick(&t.l, &s->l, t.n, index);
    nh_generator_fit_scale(&t);
    if (nh_generator_fit_solve(&t, &ignored) && t.d > 0) {
        size_t *order = nh_library_order(&t.l), pivot = order[t.n - 1], use = 0;
        nh_relative_echelon(t.n, t.d, order, t.size, t.vector); /* another generator may live on the same terms: the one that has the most complex term is meant */
        for (size_t c = 0; c < t.d; c++)
            if (fabs(t.vector[pivot + c * t.n]) > fabs(t.vector[pivot + use * t.n])) use = c;
        const double *u = t.vector + use * t.n;
        for (size_t i = 0; i < t.n; i++) most = fmax(most, fabs(u[i]) * t.size[i]);
        for (size_t i = 0; i < t.n; i++) v[index[i]] = fabs(u[i]) * t.size[i] > s->options->same * most ? u[i] : 0;
        nh_free(order);
    }
    nh_generator_fit_clear(&t);
    nh_free(index);
}

/* The simplest term, of the last coordinate, gets the coefficient 1. */
static void normalise(nh_generator_fit *s, const size_t *order, size_t r)
{
    double *v = s->vector + r * s->n, unit = 0, complexity = INFINITY;
    for (size_t at = 0; at < s->n; at++) {
        size_t j = order[at];
        if (v[j] == 0 || s->l.complexity[j] > complexity) continue;
        complexity = s->l.complexity[j];
        unit = v[j];
    }
    for (size_t j = 0; j < s->n && unit != 0; j++) v[j] /= unit;
}

/* ---- exact coefficients ---- */

static bool rational(nh_generator_fit *s, size_t r, nh_ex *coefficient)
{
    enum { largest_denominator = 1000 };
    nh_num x;
    bool all = true;
    for (size_t j = 0; j < s->n; j++) {
        double value = s->vector[j + r * s->n];
        if (value == 0) coefficient[j] = nh_int(s->k->dag, 0);
        else if (nh_recognise_ratio(value, largest_denominator, s->options->same, &x)) coefficient[j] = nh_number(s->k->dag, x);
        else all = nh_recognise_number(s->k->dag, value, s->options->recognise, &coefficient[j]) && all;
        if (value != 0 && !all) coefficient[j] = nh_real(s->k->dag, value);
    }
    return all;
}

static void assemble(const nh_generator_fit *s, const nh_ex *coefficient, nh_ex *component)
{
    nh_dag *d = s->k->dag;
    for (size_t i = 0; i < s->m; i++) component[i] = nh_int(d, 0);
    for (size_t j = 0; j < s->n; j++)
        for (size_t i = 0; i < s->m && !nh_is_zero(d, coefficient[j]); i++)
            component[i] = nh_add(d, component[i], nh_mul(d, coefficient[j], nh_library_component(&s->l, d, j, i)));
    for (size_t i = 0; i < s->m && s->l.whole; i++) component[i] = nh_simplify(d, component[i]);
}

/* Coefficients in Q(parameters): the conditions of each term, told apart by symbols of their own, must cancel identically. */
static bool parametric(nh_generator_fit *s, size_t r, nh_ex *coefficient)
{
    const nh_kinetic *k = s->k;
    nh_dag *d = k->dag;
    size_t m = s->m, total = m * (m + 1) / 2 + 1 + k->f, terms = 0, *index = nh_alloc_array(s->n + 1, sizeof *index);
    nh_ex *mark = nh_alloc_array(2 * total, sizeof *mark), *equation = mark + total, *e = nh_alloc_array(2 * s->n + m + 1, sizeof *e), *found = e + s->n, *field = found + s->n;
    for (size_t i = 0; i < total; i++) mark[i] = nh_symbol_fresh(d, "mark");
    for (size_t j = 0; j < s->n; j++) {
        if (s->vector[j + r * s->n] == 0) continue;
        for (size_t i = 0; i < m; i++) field[i] = nh_library_component(&s->l, d, j, i);
        size_t n = nh_invariance_equations(k, field, equation) + 1 + k->f;
        e[terms] = nh_int(d, 0);
        for (size_t i = 0; i < n; i++) e[terms] = nh_add(d, e[terms], nh_mul(d, mark[i], equation[i]));
        index[terms++] = j;
    }
    bool good = nh_relation_find(d, terms, e, k->model->system->parameters, k->model->parameter, (size_t)s->options->proof_terms, found) == NH_RELATION_UNIQUE;
    nh_ex unit = 0;
    for (size_t i = 0; i < terms && good; i++)
        if (s->vector[index[i] + r * s->n] == 1) unit = found[i];
    good = good && unit && !nh_is_zero(d, unit);
    for (size_t j = 0; j < s->n && good; j++) coefficient[j] = nh_int(d, 0);
    for (size_t i = 0; i < terms && good; i++) coefficient[index[i]] = nh_simplify(d, nh_div(d, found[i], unit));
    nh_free(index);
    nh_free(mark);
    nh_free(e);
    return good;
}

static void make_generators(nh_generator_fit *s, nh_generators *out)
{
    const nh_kinetic *k = s->k;
    nh_ex *coefficient = nh_alloc_array(s->n + s->m + 1, sizeof *coefficient), *component = coefficient + s->n;
    size_t *order = nh_library_order(&s->l);
    nh_relative_echelon(s->n, s->d, order, s->size, s->vector);
    out->generator = nh_arena_alloc(k->arena, (s->d + 1) * sizeof *out->generator);
    out->count = 0;
    for (size_t r = s->d; r-- > 0;) { /* the pivots came from the most complex down */
        refit(s, r);
        normalise(s, order, r);
        if (!rational(s, r, coefficient)) parametric(s, r, coefficient);
        assemble(s, coefficient, component);
        nh_generator *g = &out->generator[out->count];
        nh_generator_init(g, k, NULL, component, s->options);
        out->count += g->invariant;
    }
    nh_free(order);
    nh_free(coefficient);
}

static size_t for_all_parameters(const nh_generators *found)
{
    size_t n = 0;
    for (size_t a = 0; a < found->count; a++) {
        const nh_generator *g = &found->generator[a];
        n += g->metric.all_parameters && g->potential.all_parameters && g->constraints.all_parameters;
    }
    return n;
}

/* The generators that one library has, taken when they are more than were known, or as many and more of them hold for all parameters; *good is false with a
 * message after a breakdown. */
static bool one_library(nh_generators *out, const nh_kinetic *k, const nh_jets *jets, int level, const nh_joint_fields *joints, const nh_options *options, nh_error *error, bool *good)
{
    nh_generator_fit s = {.k = k, .options = options, .m = k->m};
    nh_generators found = {.level = level};
    nh_library_init(&s.l, k, jets, level, most_columns);
    if (joints->count) nh_library_put_before(&s.l, k, joints->count, joints->component);
    found.columns = s.n = s.l.count;
    nh_generator_fit_scale(&s);
    *good = s.n == 0 || nh_generator_fit_solve(&s, error);
    if (*good && s.d) make_generators(&s, &found);
    found.last_null = s.last_null;
    found.first_other = s.first_other;
    nh_generator_fit_clear(&s);
    bool more = *good && (found.count > out->count || !out->level || (found.count == out->count && for_all_parameters(&found) > for_all_parameters(out)));
    if (more) *out = found;
    return more;
}

static bool complete(const nh_generators *found, const nh_jets *jets) { return jets && found->count >= jets->dimension; }

bool nh_generators_find(nh_generators *out, const nh_kinetic *k, const nh_jets *jets, const nh_options *options, nh_error *error)
{
    *out = (nh_generators){0};
    nh_joint_fields joints = {0};
    bool good = true, enough = false;
    for (int level = 1; level <= NH_LIBRARY_LEVELS && good && !enough && !(out->level && (nh_budget_spent() || nh_late())); level++) {
        bool more = one_library(out, k, jets, level, &joints, options, error, &good);
        enough = complete(out, jets) || (!more && !jets);
        if (level > 1 || (enough && for_all_parameters(out) == out->count) || !good || !k->model->system->chain) continue;
        nh_joint_fields_init(&joints, k->model->system); /* simple fields are found without them */
        one_library(out, k, jets, level, &joints, options, error, &good);
        enough = complete(out, jets);
    }
    nh_joint_fields_clear(&joints);
    return good;
}
