/* action_check: whether a group can be divided out, and if not, the field, the bracket or the point that prevents
 * it. */
#include <math.h>
#include <string.h>

#include "reduction/action.h"
#include "reduction/subspace.h"

static const char *field_text(const nh_kinetic *k, const nh_generator *g, nh_text *out)
{
    if (g->name) nh_text_addf(out, "%s = ", g->name);
    nh_generator_text(k, g, out);
    return nh_text_string(out);
}

static void place_text(const nh_kinetic *k, const double *q, nh_text *out)
{
    for (size_t s = 0; s < k->m; s++) nh_text_addf(out, "%s%s = %.4g", s ? ", " : "", k->name[s], q[s]);
}

static bool not_invariant(const nh_action *g, size_t a, nh_error *error)
{
    nh_text t;
    nh_text_init(&t);
    const nh_generator *x = &g->generator[a];
    const nh_condition *worst = !x->metric.holds        ? &x->metric
                                : !x->potential.holds   ? &x->potential
                                : !x->constraints.holds ? &x->constraints
                                                        : &x->forces;
    const char *what = worst == &x->metric        ? "kinetic energy"
                       : worst == &x->potential   ? "potential"
                       : worst == &x->constraints ? "constraint distribution"
                                                  : "law of force";
    nh_fail(error, NH_INPUT, "", "%s is not a symmetry: it does not leave the %s invariant (relative residual %.2g)",
            field_text(g->kinetic, x, &t), what, worst->residual);
    nh_text_clear(&t);
    return nh_error_hint(error, "nhsym reduce without --group lists all symmetries");
}

static bool not_closed(const nh_action *g, nh_error *error)
{
    const nh_kinetic *k = g->kinetic;
    nh_text a, b, c;
    nh_text_init(&a), nh_text_init(&b), nh_text_init(&c);
    nh_generator bracket = {.component = nh_arena_alloc(k->arena, k->m * sizeof(nh_ex))};
    nh_field_bracket(k, g->generator[g->worst[0]].component, g->generator[g->worst[1]].component, bracket.component);
    nh_fail(error, NH_INPUT, "",
            "these fields do not span a Lie algebra: [%s, %s] = %s is not a linear combination of them (relative "
            "residual %.2g)",
            field_text(k, &g->generator[g->worst[0]], &a), field_text(k, &g->generator[g->worst[1]], &b),
            field_text(k, &bracket, &c), g->closure);
    nh_text_clear(&a), nh_text_clear(&b), nh_text_clear(&c);
    return nh_error_hint(error, "add the bracket to the list, or remove one of the two fields");
}

/* Does sum_a c[a] e_a = 0 hold everywhere?  True with one such c, whose last nonzero coefficient is 1.  Components are
 * compared in units of the coordinates' sizes, and fields in units of their own: a field that is small relative to
 * another one is not zero. */
static bool dependent(const nh_action *g, double small, double *c)
{
    enum { most_places = 16 };
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m, d = g->d, places = k->places < most_places ? k->places : most_places, rows = places * m;
    double *all = nh_alloc_array(rows * d + m * d + d * d + m + d + 1, sizeof *all), *E = all + rows * d,
           *null = E + m * d, *unit = null + d * d, *size = unit + m;
    nh_kinetic_sizes(k, places, unit);
    for (size_t p = 0; p < places; p++) {
        nh_action_values(g, k->place + p * m, E);
        for (size_t i = 0; i < m * d; i++) all[i / m * rows + p * m + i % m] = E[i] / unit[i % m];
    }
    for (size_t a = 0; a < d; a++) {
        size[a] = nh_largest(rows, all + a * rows);
        if (size[a] == 0) size[a] = 1;
        for (size_t i = 0; i < rows; i++) all[a * rows + i] /= size[a];
    }
    size_t n = nh_kernel(rows, d, all, small, null, NULL, NULL), last = d;
    if (n) nh_column_echelon(d, n, small, null);
    for (size_t a = 0; a < d && n; a++)
        if (fabs(null[a]) > small) last = a;
    for (size_t a = 0; a < d && n; a++)
        c[a] = fabs(null[a]) > small ? null[a] / size[a] / (null[last] / size[last]) : 0;
    nh_free(all);
    return n > 0;
}

/* "d/dx", "2 (field 1) - (field 3)": the fields whose sum vanishes. */
static bool not_independent(const nh_action *g, const double *c, nh_error *error)
{
    nh_text t, sum;
    nh_text_init(&t), nh_text_init(&sum);
    size_t last = 0, terms = 0;
    for (size_t a = 0; a < g->d; a++)
        if (c[a] != 0) last = a, terms++;
    for (size_t a = 0; a < last; a++)
        if (c[a] != 0) nh_text_addf(&sum, "%s%.4g times field %zu", nh_text_string(&sum)[0] ? " + " : "", -c[a], a + 1);
    if (terms == 1) nh_fail(error, NH_INPUT, "", "field %zu is zero everywhere: it generates nothing", last + 1);
    else
        nh_fail(error, NH_INPUT, "", "these fields are not independent: field %zu, %s, is %s", last + 1,
                field_text(g->kinetic, &g->generator[last], &t), nh_text_string(&sum));
    nh_text_clear(&t), nh_text_clear(&sum);
    return nh_error_hint(error, "remove field %zu", last + 1);
}

static bool not_free(const nh_action *g, const double *q, size_t rank, nh_error *error)
{
    nh_text t;
    nh_text_init(&t);
    place_text(g->kinetic, q, &t);
    nh_fail(error, NH_INPUT, "", "the action is not free: %zu field%s, but an orbit of dimension %zu at %s", g->d,
            g->d == 1 ? "" : "s", rank, nh_text_string(&t));
    nh_text_clear(&t);
    return nh_error_hint(error, rank < g->orbit ? "choose an initial state that is not fixed by the fields, or reduce "
                                                  "by a subgroup with independent generators there"
                                                : "reduce by a subgroup with independent generators everywhere");
}

bool nh_action_check(const nh_action *g, const nh_options *options, nh_error *error)
{
    double *c = nh_alloc_array(g->d + 1, sizeof *c);
    const double *q = g->kinetic->place + g->least_place * g->kinetic->m;
    bool same = g->d && dependent(g, options->group, c), good = true;
    for (size_t a = 0; a < g->d && good; a++)
        if (!g->generator[a].invariant) good = not_invariant(g, a, error);
    if (good && same) good = not_independent(g, c, error);
    if (good && !g->closes) good = not_closed(g, error);
    if (good && !g->free) good = not_free(g, q, nh_action_orbit_at(g, q, options), error);
    nh_free(c);
    return good;
}

bool nh_action_check_at(const nh_action *g, const double *q, const nh_options *options, nh_error *error)
{
    size_t rank = g->d ? nh_action_orbit_at(g, q, options) : 0;
    return rank >= g->orbit || not_free(g, q, rank, error);
}
