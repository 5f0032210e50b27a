/* Closed forms of the infinitesimal symmetries (generators.h; docs/method.md, sec. 8):
 *
 *      level 1, 2, ..      a library of functions for the components              library.c
 *      null vectors         conditions at sample points, relative to the values    generator_fit.c
 *      refit                each vector on its own terms only
 *      coefficients         rationals; else an exact relation over the parameters; else simple forms of the numbers
 *      check                each field by itself: metric, potential, constraints, forces       invariance.c
 *      until there are as many as the jets say; where some are missing, fields of earlier levels and brackets are added
 *
 * Where vectors hold to rounding only, as with a small coupling, the exact relations among the conditions on all
 * fields of the library give the combinations that are symmetries. */
#include "reduction/generators.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "integrals/fixed.h"
#include "integrals/recognise.h"
#include "reduction/generator_fit.h"
#include "reduction/joint.h"
#include "reduction/relative.h"
#include "reduction/section.h"

enum { most_columns = 420 };

/* ---- one vector ---- */

/* Fits the coefficients of one vector again with its own terms only: a large library is badly conditioned, a few terms
 * are not. */
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
        /* another generator may consist of the same terms: the one that contains the most complex term is meant */
        nh_relative_echelon(t.n, t.d, order, t.size, t.vector);
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

/* Coefficients as rationals, or as recognised numbers; false: one of them stays a decimal. */
static bool rational(nh_generator_fit *s, size_t r, nh_ex *coefficient)
{
    enum { largest_denominator = 1000 };
    nh_num x;
    bool all = true;
    for (size_t j = 0; j < s->n; j++) {
        double value = s->vector[j + r * s->n];
        if (value == 0) coefficient[j] = nh_int(s->k->dag, 0);
        else if (nh_recognise_ratio(value, largest_denominator, s->options->same, &x))
            coefficient[j] = nh_number(s->k->dag, x);
        else all = nh_recognise_number(s->k->dag, value, s->options->recognise, &coefficient[j]) && all;
        if (value != 0 && !all) coefficient[j] = nh_real(s->k->dag, value);
    }
    return all;
}

/* component^i = sum_k c_k b_k over the columns of coordinate i. */
static void assemble(const nh_generator_fit *s, const nh_ex *coefficient, nh_ex *component)
{
    nh_dag *d = s->k->dag;
    for (size_t i = 0; i < s->m; i++) component[i] = nh_int(d, 0);
    for (size_t j = 0; j < s->n; j++)
        for (size_t i = 0; i < s->m && !nh_is_zero(d, coefficient[j]); i++)
            component[i] = nh_add(d, component[i], nh_mul(d, coefficient[j], nh_library_component(&s->l, d, j, i)));
    for (size_t i = 0; i < s->m && s->l.whole; i++) component[i] = nh_simplify(d, component[i]);
}

/* The conditions on column j, each with its mark. by_terms: xi(V_i)/V_i of the potential's terms instead of xi(V):
 * where each vanishes the sum does, and roots of different distances are not multiplied. */
static nh_ex conditions(const nh_generator_fit *s, size_t j, bool by_terms, const nh_ex *mark, nh_ex *field,
                        nh_ex *equation)
{
    const nh_kinetic *k = s->k;
    nh_dag *d = k->dag;
    nh_ex V = nh_invariance_sum(k);
    for (size_t i = 0; i < s->m; i++) field[i] = nh_library_component(&s->l, d, j, i);
    size_t n, of_metric = nh_invariance_equations(k, field, equation, &n);
    if (by_terms) equation[of_metric] = nh_int(d, 0);
    nh_ex sum = nh_section_marked(d, n, mark, equation);
    for (size_t i = 0; i < nh_arity(d, V) && by_terms; i++) {
        nh_ex term = nh_child(d, V, i);
        sum = nh_add(d, sum, nh_mul(d, mark[n + i], nh_div(d, nh_field_along(k, field, term), term)));
    }
    return sum;
}

/* The exact relation among the fields of one vector; index: their columns. */
static nh_fixed related(const nh_generator_fit *s, size_t r, bool by_terms, size_t *terms, size_t *index, double *like,
                        nh_ex *found)
{
    const nh_kinetic *k = s->k;
    size_t m = s->m, total = m * (m + 1) / 2 + 1 + k->f + m, marks = total + nh_arity(k->dag, nh_invariance_sum(k));
    nh_ex *e = nh_alloc_array(s->n + m + total + marks + 1, sizeof *e), *field = e + s->n, *equation = field + m,
          *mark = equation + total;
    nh_section_marks(k->dag, marks, mark);
    *terms = 0;
    for (size_t j = 0; j < s->n; j++) {
        if (s->vector[j + r * s->n] == 0) continue;
        like[*terms] = s->vector[j + r * s->n];
        e[*terms] = conditions(s, j, by_terms, mark, field, equation);
        index[(*terms)++] = j;
    }
    nh_fixed how = nh_fixed_relation(k->model, *terms, e, like, s->options, found);
    nh_free(e);
    return how;
}

/* Coefficients in Q(parameters): the conditions must cancel identically. */
static bool parametric(nh_generator_fit *s, size_t r, nh_ex *coefficient, const nh_ex **fixed)
{
    nh_dag *d = s->k->dag;
    size_t terms, *index = nh_alloc_array(s->n + 1, sizeof *index);
    nh_ex *found = nh_alloc_array(s->n + 1, sizeof *found), unit = 0;
    double *like = nh_alloc_array(s->n + 1, sizeof *like);
    nh_fixed how = related(s, r, false, &terms, index, like, found);
    if (how.too_large && nh_kind_of(d, nh_invariance_sum(s->k)) == NH_SUM)
        how = related(s, r, true, &terms, index, like, found);
    bool good = how.found && !how.too_large;
    for (size_t i = 0; i < terms && good; i++)
        if (like[i] == 1) unit = found[i];
    good = good && unit && !nh_is_zero(d, unit);
    for (size_t j = 0; j < s->n && good; j++) coefficient[j] = nh_int(d, 0);
    for (size_t i = 0; i < terms && good; i++) coefficient[index[i]] = nh_simplify(d, nh_div(d, found[i], unit));
    *fixed = how.fixed;
    nh_free(like);
    nh_free(found);
    nh_free(index);
    return good;
}

/* With rational numbers where these hold for all parameters, else with an exact relation; without one, with simple
 * forms of the numbers. */
static void make_generator(nh_generator_fit *s, size_t r, nh_ex *coefficient, nh_ex *component, nh_generator *out)
{
    const nh_ex *fixed;
    nh_generator related;
    rational(s, r, coefficient);
    assemble(s, coefficient, component);
    nh_generator_init(out, s->k, NULL, component, s->options);
    if (nh_generator_proof(s->k, out).all_parameters || !parametric(s, r, coefficient, &fixed)) return;
    assemble(s, coefficient, component);
    for (size_t i = 0; i < s->m && fixed; i++) component[i] = nh_fixed_values(s->k->model, fixed, component[i]);
    nh_generator_init(&related, s->k, NULL, component, s->options);
    if (related.invariant) *out = related;
}

/* Where vectors are symmetries to rounding only: all exact combinations of the library's fields, on whatever
 * coordinates they depend, or, of a large library, of those vectors.  `candidate`: d x m components of these. */
static void combine(nh_generator_fit *s, const nh_ex *candidate, nh_generators *out)
{
    enum { most = 100 };
    const nh_kinetic *k = s->k;
    nh_dag *dag = k->dag;
    nh_library l;
    nh_library_init(&l, k, NULL, out->level, 2, most);
    bool whole = l.count < most;
    size_t m = s->m, n = whole ? l.count : s->d, equations = m * (m + 1) / 2 + 1 + k->f + m, rows = 0, found = 0;
    nh_ex *e = nh_alloc_array(n * (equations + m) + equations + m + 1, sizeof *e), *field = e + n * equations,
          *equation = field + n * m, *component = equation + equations;
    nh_generators all = *out;
    if (!whole) memcpy(field, candidate, n * m * sizeof *field);
    for (size_t r = 0; r < n; r++) {
        for (size_t i = 0; i < m && whole; i++) field[r * m + i] = nh_library_component(&l, dag, r, i);
        nh_invariance_equations(k, field + r * m, equation, &rows);
        memcpy(e + r * rows, equation, rows * sizeof *e);
    }
    nh_ex *c = nh_section_relations(k, n, rows, e, s->options, &all.count);
    all.generator = nh_arena_alloc(k->arena, (all.count + 1) * sizeof *all.generator);
    for (size_t j = 0; j < all.count && c; j++) {
        for (size_t i = 0; i < m; i++) {
            component[i] = nh_int(dag, 0);
            for (size_t r = 0; r < n; r++)
                component[i] = nh_add(dag, component[i], nh_mul(dag, c[j * n + r], field[r * m + i]));
            component[i] = nh_simplify(dag, component[i]);
        }
        nh_generator_init(&all.generator[found], k, NULL, component, s->options);
        found += all.generator[found].invariant;
    }
    all.count = found;
    if (found > out->count) *out = all;
    nh_library_clear(&l);
    nh_free(e);
}

/* `wanted`: as many as there are. */
static void make_generators(nh_generator_fit *s, size_t wanted, nh_generators *out)
{
    const nh_kinetic *k = s->k;
    nh_ex *coefficient = nh_alloc_array(s->n + s->m + s->d * s->m + 1, sizeof *coefficient),
          *component = coefficient + s->n, *candidate = component + s->m;
    size_t *order = nh_library_order(&s->l);
    nh_relative_echelon(s->n, s->d, order, s->size, s->vector);
    out->generator = nh_arena_alloc(k->arena, (s->d + 1) * sizeof *out->generator);
    out->count = 0;
    for (size_t r = s->d; r-- > 0;) { /* the pivots come in order from the most complex one */
        refit(s, r);
        normalise(s, order, r);
        make_generator(s, r, coefficient, component, &out->generator[out->count]);
        memcpy(candidate + r * s->m, component, s->m * sizeof *component);
        out->count += out->generator[out->count].invariant;
    }
    if (out->count < s->d && out->count < wanted) combine(s, candidate, out);
    nh_free(order);
    nh_free(coefficient);
}

/* How many of the fields hold for all parameters. */
static size_t for_all_parameters(const nh_kinetic *k, const nh_generators *found)
{
    size_t n = 0;
    for (size_t a = 0; a < found->count; a++) {
        n += nh_generator_proof(k, &found->generator[a]).all_parameters;
    }
    return n;
}

/* Of one library: `good` is false with a message after a breakdown; `more`: its generators were taken; `full`: it has
 * no room for more columns. */
typedef struct {
    bool good, more, full;
} outcome;

/* Takes the generators of one library when they are more than the known ones, or as many and more of them hold for all
 * parameters. */
static outcome one_library(nh_generators *out, const nh_kinetic *k, const nh_jets *jets, int level, size_t together,
                           const nh_joint_fields *joints, const nh_options *options, nh_error *error)
{
    outcome o = {0};
    nh_generator_fit s = {.k = k, .options = options, .m = k->m};
    nh_generators found = {.level = level};
    nh_library_init(&s.l, k, jets, level, together, most_columns);
    o.full = s.l.count >= most_columns;
    if (joints->count) nh_library_put_before(&s.l, k, joints->count, joints->component);
    found.columns = s.n = s.l.count;
    nh_generator_fit_scale(&s);
    o.good = s.n == 0 || nh_generator_fit_solve(&s, error);
    if (o.good && s.d) make_generators(&s, jets ? jets->dimension : s.d, &found);
    found.last_null = s.last_null;
    found.first_other = s.first_other;
    nh_generator_fit_clear(&s);
    o.more = o.good && (found.count > out->count || !out->level ||
                        (found.count == out->count && for_all_parameters(k, &found) > for_all_parameters(k, out)));
    if (o.more) *out = found;
    return o;
}

/* Are there as many fields as the jets count? */
static bool complete(const nh_generators *found, const nh_jets *jets)
{
    return jets && found->count >= jets->dimension;
}

/* d/dq of the coordinates that neither the kinetic energy nor the potential nor the constraints contain: they need no
 * fit, which very different units may make inaccurate.  Taken where they are more than were found. */
static void cyclic(nh_generators *out, const nh_kinetic *k, const nh_options *options)
{
    nh_generators found = *out;
    nh_ex *component = nh_alloc_array(k->m + 1, sizeof *component);
    found.generator = nh_arena_alloc(k->arena, (k->m + 1) * sizeof *found.generator);
    found.count = 0;
    for (size_t j = 0; j < k->m; j++) {
        for (size_t i = 0; i < k->m; i++) component[i] = nh_int(k->dag, i == j);
        nh_generator_init(&found.generator[found.count], k, NULL, component, options);
        const nh_generator *g = &found.generator[found.count];
        found.count += g->invariant && nh_generator_proof(k, g).proved;
    }
    if (found.count > out->count) *out = found;
    nh_free(component);
}

/* Adds a symmetry that is no combination of the others, known exactly. */
static void add_independent(nh_generators *out, const nh_kinetic *k, const nh_generator *g, const nh_options *options)
{
    size_t n = out->count, m = k->m, relations = 1;
    nh_ex *e = nh_alloc_array((n + 1) * m + 1, sizeof *e);
    for (size_t a = 0; a < n; a++) memcpy(e + a * m, out->generator[a].component, m * sizeof *e);
    memcpy(e + n * m, g->component, m * sizeof *e);
    bool known = nh_section_relations(k, n + 1, m, e, options, &relations) != NULL;
    nh_free(e);
    if (!known || relations) return;
    nh_generator *all = nh_arena_alloc(k->arena, (n + 1) * sizeof *all);
    memcpy(all, out->generator, n * sizeof *all);
    all[n] = *g;
    out->generator = all;
    out->count++;
}

/* Where some are missing: those that other libraries gave, and brackets, which are symmetries, too. */
static void close_up(nh_generators *out, size_t wanted, const nh_kinetic *k, const nh_generators *other, size_t others,
                     const nh_options *options)
{
    nh_ex *bracket = nh_alloc_array(k->m + 1, sizeof *bracket);
    nh_generator g;
    for (size_t i = 0; i < others; i++)
        for (size_t a = 0; a < other[i].count && out->count < wanted; a++)
            add_independent(out, k, &other[i].generator[a], options);
    for (size_t b = 1; b < out->count && out->count < wanted && !nh_late(); b++)
        for (size_t a = 0; a < b && out->count < wanted; a++) {
            nh_field_bracket(k, out->generator[a].component, out->generator[b].component, bracket);
            nh_generator_init(&g, k, NULL, bracket, options);
            if (g.invariant && nh_generator_proof(k, &g).proved) add_independent(out, k, &g, options);
        }
    nh_free(bracket);
}

bool nh_generators_find(nh_generators *out, const nh_kinetic *k, const nh_jets *jets, const nh_options *options,
                        nh_error *error)
{
    *out = (nh_generators){0};
    nh_joint_fields joints = {0};
    nh_generators other[2 * NH_LIBRARY_LEVELS + 1];
    size_t others = 0;
    bool good = true, enough = false;
    for (int level = 1;
         level <= NH_LIBRARY_LEVELS && good && !enough && !(out->level && (nh_budget_spent() || nh_late())); level++) {
        bool more = false, full = false; /* more products would find no room */
        for (size_t together = level == 1 ? 1 : 2; together <= (jets ? 3 : 2) && good && !enough && !full; together++) {
            nh_generators before = *out;
            outcome o = one_library(out, k, jets, level, together, &joints, options, error);
            if (o.more && before.count) other[others++] = before;
            more |= o.more;
            full = o.full;
            good = o.good;
            enough = complete(out, jets);
        }
        enough |= !more && !jets;
        if (level > 1 || (enough && for_all_parameters(k, out) == out->count) || !good || !k->model->system->chain)
            continue;
        nh_joint_fields_init(&joints, k->model->system); /* simple fields are found without these */
        good = one_library(out, k, jets, level, 3, &joints, options, error).good;
        enough = complete(out, jets);
    }
    if (good && jets && !complete(out, jets)) close_up(out, jets->dimension, k, other, others, options);
    if (good && out->count < k->m && !complete(out, jets)) cyclic(out, k, options);
    nh_joint_fields_clear(&joints);
    return good;
}
