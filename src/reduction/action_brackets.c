/* action_brackets: the constants of an action (action.h): numbers propose, exact relations decide. */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/num.h"
#include "integrals/fixed.h"
#include "integrals/recognise.h"
#include "reduction/action.h"
#include "reduction/invariance.h"
#include "reduction/section.h"
#include "reduction/subspace.h"

/* ---- The structure constants of an action as expressions of the parameters ----
 *
 *     [e_a, e_b] + C_ab^k e_k = 0,     C in Q(parameters)
 *
 * They are known in doubles, at the parameters' values.  Where the fields have parameters the numbers are kept only if
 * the relation holds with the parameters as symbols; else it is solved with these. */

typedef struct {
    const nh_kinetic *kinetic;
    size_t d;
    const nh_options *options;
    /* d + 1: [e_a, e_b] and the generators, their components told apart by marks; coefficients */
    nh_ex *field, *relation;
    double *like; /* d + 1: 1 and C_ab */
} work;

/* Do the fields contain parameters? */
static bool parametric(const nh_kinetic *k, size_t d, const nh_generator *generator)
{
    const nh_model *model = k->model;
    for (size_t a = 0; a < d; a++)
        for (size_t s = 0; s < k->m; s++)
            for (size_t i = 0; i < model->system->parameters; i++)
                if (nh_depends(model->dag, generator[a].component[s], model->parameter[i])) return true;
    return false;
}

static nh_ex number(nh_dag *d, double c, const nh_options *options)
{
    nh_num x;
    return nh_recognise_ratio(c, 1000, options->same, &x) ? nh_number(d, x) : nh_real(d, c);
}

/* [e_a, e_b] + C_ab^k e_k with numbers; is it zero for all parameters? */
static bool numbers_hold(const work *w, const nh_ex *constant)
{
    nh_dag *d = w->kinetic->dag;
    nh_ex sum = w->field[0];
    for (size_t k = 0; k < w->d; k++) sum = nh_add(d, sum, nh_mul(d, constant[k], w->field[1 + k]));
    return nh_normal_is_zero(d, sum, (size_t)w->options->proof_terms) == NH_ZERO;
}

/* With parameters as symbols where there is such a relation; otherwise the numbers stay. */
static void with_symbols(const work *w, nh_ex *constant)
{
    nh_dag *d = w->kinetic->dag;
    nh_fixed how = nh_fixed_relation(w->kinetic->model, w->d + 1, w->field, w->like, w->options, w->relation);
    if (!how.found || how.too_large || nh_is_zero(d, w->relation[0])) return;
    for (size_t k = 0; k < w->d; k++) constant[k] = nh_simplify(d, nh_div(d, w->relation[1 + k], w->relation[0]));
}

/* constant: d x d x d, from the numbers c; bracket: d x d x m components of [e_a, e_b]. */
static void find_constants(const nh_kinetic *k, size_t d, const nh_generator *generator, const double *c,
                           const nh_ex *bracket, const nh_options *options, nh_ex *constant)
{
    size_t m = k->m;
    bool symbols = parametric(k, d, generator);
    for (size_t i = 0; i < d * d * d; i++) constant[i] = number(k->dag, c[i], options);
    nh_ex *e = nh_alloc_array(2 * (d + 1) + m + 1, sizeof *e), *mark = e + 2 * (d + 1);
    work w = {k, d, options, e, e + d + 1, nh_alloc_array(d + 1, sizeof *w.like)};
    nh_section_marks(k->dag, symbols ? m : 0, mark);
    for (size_t a = 0; a < d && symbols; a++) e[1 + a] = nh_section_marked(k->dag, m, mark, generator[a].component);
    for (size_t pair = 0; pair < d * d && symbols; pair++) {
        size_t a = pair / d, b = pair % d;
        nh_ex *row = constant + pair * d;
        if (a >= b) continue;
        e[0] = nh_section_marked(k->dag, m, mark, bracket + pair * m);
        w.like[0] = 1;
        for (size_t i = 0; i < d; i++) w.like[1 + i] = c[pair * d + i];
        if (!numbers_hold(&w, row)) with_symbols(&w, row);
        for (size_t i = 0; i < d; i++) constant[(b * d + a) * d + i] = nh_neg(k->dag, row[i]);
    }
    nh_free(w.like);
    nh_free(e);
}

/* ---- action brackets ---- */

static size_t places_of(const nh_kinetic *k) { return k->places < NH_ACTION_PLACES ? k->places : NH_ACTION_PLACES; }

/* Stacks fields at several places, each as one long vector. */
static double *stacked(const nh_kinetic *k, size_t n, const nh_ex *component)
{
    size_t m = k->m, places = places_of(k);
    double *out = nh_alloc_array(places * m * n + 1, sizeof *out),
           *value = nh_alloc_array(places * m * n + 1, sizeof *value);
    nh_kinetic_sample(k, m * n, component, places, value);
    for (size_t p = 0; p < places; p++)
        for (size_t j = 0; j < n; j++) memcpy(out + (j * places + p) * m, value + (p * n + j) * m, m * sizeof *out);
    nh_free(value);
    return out;
}

/* Stacks n fields in units of the coordinates' sizes, each divided by its `size` where that is not NULL; the largest
 * value of each into most. */
static void in_units(const nh_kinetic *k, size_t n, const double *size, double *a, double *most)
{
    size_t m = k->m, long_m = places_of(k) * m;
    double *unit = nh_alloc_array(m + 1, sizeof *unit);
    nh_kinetic_sizes(k, places_of(k), unit);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < long_m; i++) a[i + j * long_m] /= unit[i % m] * (size ? size[j] : 1);
        if (most) most[j] = nh_largest(long_m, a + j * long_m);
    }
    nh_free(unit);
}

/* The generators E and their brackets B, scaled to size one: then the constants do not depend on units, and zero ones
 * can be told from small ones. size[a]: the divisor of e_a; size[d + pair]: that of bracket `pair`. */
static void normalise(const nh_kinetic *k, size_t d, double *E, double *B, double *size)
{
    double *ones = size + d;
    size_t long_m = places_of(k) * k->m;
    in_units(k, d, NULL, E, size);
    for (size_t a = 0; a < d; a++) {
        if (!(size[a] > 0 && isfinite(size[a]))) size[a] = 1;
        for (size_t i = 0; i < long_m; i++) E[i + a * long_m] /= size[a];
    }
    for (size_t pair = 0; pair < d * d; pair++) ones[pair] = size[pair / d] * size[pair % d];
    in_units(k, d * d, ones, B, NULL);
}

/* [e_a, e_b] = c^k e_k by exact relations among the fields (d of them) and their brackets: c[pair * d + k]; outside: of
 * the brackets that are no combinations.  False, and unchanged, where these are not known. */
static bool exact_brackets(const nh_kinetic *k, size_t d, const nh_ex *e, const nh_ex *b, const nh_options *options,
                           double *c, bool *outside)
{
    size_t m = k->m, columns = d + d * (d - 1) / 2, n = 0, found, *pair = nh_alloc_array(columns + 1, sizeof *pair);
    nh_ex *entry = nh_alloc_array(columns * m + 1, sizeof *entry);
    memcpy(entry, e, d * m * sizeof *e);
    for (size_t i = 0; i < d; i++)
        for (size_t j = i + 1; j < d; j++, n++) {
            pair[d + n] = i * d + j;
            memcpy(entry + (d + n) * m, b + (i * d + j) * m, m * sizeof *e);
        }
    const nh_ex *all = nh_section_relations(k, columns, m, entry, options, &found);
    for (size_t p = 0; p < d * d && all; p++) outside[p] = p / d != p % d;
    for (size_t r = 0; r < found && all; r++) {
        const nh_ex *row = all + r * columns;
        size_t last = columns - 1;
        bool inside = true;
        while (nh_is_zero(k->dag, row[last])) last--;
        for (size_t j = d; j < last; j++) inside &= nh_is_zero(k->dag, row[j]);
        if (last < d || !inside) continue;
        size_t p = pair[last], mirrored = p % d * d + p / d;
        outside[p] = outside[mirrored] = false;
        for (size_t j = 0; j < d; j++) {
            c[p * d + j] = -nh_model_number(k->model, row[j]);
            c[mirrored * d + j] = -c[p * d + j];
        }
    }
    nh_free(entry);
    nh_free(pair);
    return all != NULL;
}

/* The fields, and all their brackets. */
static void list_brackets(const nh_action *g, nh_ex *e, nh_ex *b)
{
    const nh_kinetic *k = g->kinetic;
    size_t d = g->d, m = k->m;
    for (size_t a = 0; a < d; a++) memcpy(e + a * m, g->generator[a].component, m * sizeof *e);
    for (size_t i = 0; i < d * d * m; i++) b[i] = nh_int(k->dag, 0);
    for (size_t a = 0; a < d; a++)
        for (size_t c = 0; c < a; c++) {
            nh_field_bracket(k, e + a * m, e + c * m, b + (a * d + c) * m);
            for (size_t s = 0; s < m; s++) b[(c * d + a) * m + s] = nh_neg(k->dag, b[(a * d + c) * m + s]);
        }
}

/* By least squares at the sample points. */
static void numeric_brackets(nh_action *g, const nh_ex *e, const nh_ex *b, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    size_t d = g->d, long_m = places_of(k) * k->m;
    double *E = stacked(k, d, e), *B = stacked(k, d * d, b);
    double *rest = nh_alloc_array(long_m * d * d + d + d * d + 1, sizeof *rest), *unit = rest + long_m * d * d;
    normalise(k, d, E, B, unit);
    bool all = isfinite(nh_coordinates(long_m, d, E, d * d, B, g->algebra.c)); /* one decomposition for all */
    for (size_t i = 0; i < d * d * d && !all; i++) g->algebra.c[i] = 0;        /* some bracket is not finite */
    nh_multiply(long_m, d * d, d, E, g->algebra.c, rest);
    for (size_t i = 0; i < long_m * d * d; i++) rest[i] -= B[i];
    for (size_t pair = 0; pair < d * d; pair++) {
        double off = nh_largest(long_m, rest + pair * long_m), size = nh_largest(long_m, B + pair * long_m);
        off = isfinite(off) && size > 0 ? off / (1e-300 + size) : size > 0 ? INFINITY : 0;
        if (off > g->closure) {
            g->closure = off;
            g->worst[0] = pair / d;
            g->worst[1] = pair % d;
        }
        g->outside[pair] = off > options->group;
    }
    for (size_t i = 0; i < d * d * d; i++) {
        nh_num x;
        double c = g->algebra.c[i];
        bool zero = fabs(c) <= options->group;
        c *= unit[d + i / d] / unit[i % d];
        if (nh_recognise_ratio(c, 1000, options->same, &x)) c = nh_num_value(x);
        g->algebra.c[i] = zero ? 0 : c;
    }
    nh_free(E);
    nh_free(B);
    nh_free(rest);
}

void nh_action_find_constants(nh_action *g, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    size_t d = g->d, m = k->m;
    g->algebra = nh_algebra_create(d);
    g->closure = 0;
    g->closes = true;
    if (!d) return;
    nh_ex *e = nh_alloc_array(d * m + 1, sizeof *e), *b = nh_alloc_array(d * d * m + 1, sizeof *b);
    list_brackets(g, e, b);
    g->outside = nh_arena_alloc(k->arena, d * d * sizeof *g->outside);
    numeric_brackets(g, e, b, options);
    g->exact = d == 1 || exact_brackets(k, d, e, b, options, g->algebra.c, g->outside);
    for (size_t i = 0; i < d * d * d; i++) {
        g->closes &= !g->outside[i / d];
        double c = g->outside[i / d] ? 0 : g->algebra.c[i];
        g->algebra.c[i] = c == 0 ? 0 : -c;
    }
    g->constant = nh_arena_alloc(k->arena, (d * d * d + 1) * sizeof *g->constant);
    find_constants(k, d, g->generator, g->algebra.c, b, options, g->constant);
    nh_free(e);
    nh_free(b);
}
