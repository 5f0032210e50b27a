/* explicit_motion: the order of the steps along one curve, again and again until none can be taken.
 *
 *     first     a current that is linear in its only unsolved state
 *     second    quadratic, whose root is a constant
 *     rate      du/ds = A u + B, integrated in closed form
 *     second    quadratic, with a root R(s) as a symbol of its own
 *     first, second    with two unsolved states
 *     rate      with names J for integrals without closed form
 *
 *     values    value[i] of a solved state:  s, C1, C2, ..  R1, ..  J1, ..  and states that are not solved
 *                  |  settle: a state that is solved is put into all others
 *                  v
 *               conclude: constants are certified, formulas compared with the states and differentiated */
#include "search/explicit_motion.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/exact_points.h"
#include "integrals/fixed.h"
#include "integrals/prove.h"
#include "search/explicit_motion_internal.h"

/* False: no combined coordinates, which were asked for. */
static bool start(nh_explicit_curve *c, const nh_explicit_request *request)
{
    const nh_model *model = c->o;
    nh_dag *d = c->d;
    nh_explicit_motion *m = c->m;
    size_t states = m->states, n = request->currents;
    nh_ex *state = nh_arena_alloc(c->arena, states * sizeof *state);
    memcpy(state, model->chart->symbol, states * sizeof *state);
    m->state = state;
    c->rate = nh_arena_alloc(c->arena, states * sizeof *c->rate);
    c->value = nh_arena_alloc(c->arena, states * sizeof *c->value);
    c->equation = nh_arena_alloc(c->arena, states * sizeof *c->equation);
    c->solved = nh_arena_alloc(c->arena, states * sizeof *c->solved);
    c->current = nh_arena_alloc(c->arena, (n + 1) * sizeof *c->current);
    c->used = nh_arena_alloc(c->arena, (n + 1) * sizeof *c->used);
    c->view = nh_arena_alloc(c->arena, (n + 1) * sizeof *c->view);
    m->constant = nh_arena_alloc(c->arena, most_constants * sizeof *m->constant);
    m->root = nh_arena_alloc(c->arena, most_roots * sizeof *m->root);
    m->integral = nh_arena_alloc(c->arena, most_integrals * sizeof *m->integral);
    for (size_t i = 0; i < states; i++) {
        nh_ex rate = i == 0 ? nh_int(d, 1) : i <= model->m ? model->rho[i - 1] : model->a[i - 1 - model->m];
        c->rate[i] = c->fixed ? nh_fixed_values(model, c->fixed, rate) : rate;
        c->value[i] = nh_int(d, 0);
    }
    if (request->combined) {
        c->combined = nh_combined_coordinates_of(c->arena, model, c->rate);
        if (!c->combined) return false;
        memcpy(c->rate, c->combined->rate, states * sizeof *c->rate);
    }
    c->currents = n;
    c->most_named = request->rival ? request->rival->integrals : most_integrals;
    for (size_t j = 0; j < n; j++) {
        nh_ex e = request->current[j];
        c->current[j] = nh_combined_coordinates_in(c->combined, d, c->fixed ? nh_fixed_values(model, c->fixed, e) : e);
    }
    for (size_t i = 0; i < model->system->parameters && c->symbols < most_symbols - most_constants; i++)
        c->symbol[c->symbols++] = model->parameter[i];
    c->s = state[m->parameter];
    c->solved[m->parameter] = true;
    c->value[m->parameter] = c->s;
    return true;
}

/* Is the formula the state itself, with the constants as functions of the state? */
static bool agrees(const nh_explicit_curve *c, size_t i)
{
    static const double rounding = 1e-6;
    nh_ex pair[2] = {nh_explicit_at_points(c, c->value[i]), nh_explicit_at_points(c, c->m->state[i])};
    size_t count = c->points->count, compared = 0;
    double *value = nh_alloc_array(2 * count + 1, sizeof *value), off = 0, size = 0;
    nh_points_evaluate(c->points, c->o, 2, pair, value);
    for (size_t p = 0; p < count; p++) {
        if (!isfinite(value[p])) continue;
        compared++;
        off = fmax(off, fabs(value[p] - value[count + p]));
        size = fmax(size, fabs(value[count + p]));
    }
    nh_free(value);
    return off <= rounding * size && 2 * compared > count;
}

/* Does du/ds = Gamma(u)/Gamma(s) hold for all known states, with the formulas substituted? */
static bool satisfied(const nh_explicit_curve *c, const bool *known)
{
    const nh_explicit_motion *m = c->m;
    nh_dag *d = c->d;
    nh_ex speed = nh_explicit_along(c, c->rate[m->parameter]);
    bool good = true;
    for (size_t i = 0; i < m->states && good; i++) {
        if (!known[i] || i == m->parameter) continue;
        nh_ex off = nh_sub(d, nh_mul(d, nh_diff(d, c->value[i], c->s), speed), nh_explicit_along(c, c->rate[i]));
        good = nh_explicit_vanishes(c, nh_explicit_simple(c, off));
    }
    return good;
}

static nh_ex one_for_elliptic(void *dag, nh_ex call)
{
    return nh_is_incomplete_elliptic(nh_function_of(dag, call)) ? nh_int(dag, 1) : 0;
}

/* How many quotients in e can be infinite on the curve; in amplitudes they may be. */
static size_t poles(const nh_explicit_curve *c, nh_ex e)
{
    NH_LIST(product);
    NH_LIST(tangent);
    e = nh_substitute_calls(c->d, e, one_for_elliptic, c->d);
    size_t count = 0, n = nh_products_in(c->d, e, &product), f = nh_functions_in(c->d, e, &tangent);
    for (size_t i = 0; i < n; i++)
        for (size_t k = 0; k < nh_arity(c->d, product[i]); k++) {
            nh_ex x = nh_exponent_of(c->d, product[i], k);
            bool below = nh_kind_of(c->d, x) == NH_NUMBER && nh_num_value(nh_number_of(c->d, x)) < 0;
            count += below && nh_depends(c->d, nh_child(c->d, product[i], k), c->s);
        }
    for (size_t i = 0; i < f; i++)
        count += nh_function_of(c->d, tangent[i]) == NH_TAN && nh_depends(c->d, tangent[i], c->s);
    return count;
}

/* A sum solved for one of its terms, (a(t)/sin(t) + C) sin(t), is a(t) + C sin(t): it has no poles of its own. */
static nh_ex without_poles(const nh_explicit_curve *c, nh_ex e)
{
    size_t before = poles(c, e);
    if (before == 0 || nh_explicit_too_long(c, e)) return e;
    nh_ex sum = nh_canonical_sum(c->d, e), tidy = nh_simplify(c->d, sum);
    if (poles(c, tidy) < before && !nh_explicit_too_long(c, tidy)) return tidy;
    return poles(c, sum) < before && !nh_explicit_too_long(c, sum) ? sum : e;
}

/* sign(c u) as sign(u) or -sign(u), for a constant c of parameters. */
static nh_ex plain_sign(void *curve, nh_ex call)
{
    const nh_explicit_curve *c = curve;
    if (nh_function_of(c->d, call) != NH_SIGN) return 0;
    nh_ex u = nh_child(c->d, call, 0), rest = nh_model_without_constants(c->o, u);
    int sign = rest == u ? 0 : nh_model_sign(c->o, nh_div(c->d, u, rest));
    return sign ? nh_mul(c->d, nh_int(c->d, sign), nh_call(c->d, NH_SIGN, rest)) : 0;
}

/* Drops formulas that still depend on unsolved states.  A constant that is not constant, to all digits, makes the whole
 * motion invalid. */
static void conclude(nh_explicit_curve *c)
{
    nh_explicit_motion *m = c->m;
    bool *known = nh_arena_alloc(c->arena, m->states * sizeof *known), constant = true;
    for (size_t j = 0; j < m->constants && constant; j++) {
        nh_ex value = nh_combined_coordinates_out(c->combined, c->d, m->constant[j].value);
        m->constant[j].value = value = nh_substitute_calls(c->d, value, plain_sign, c);
        if (m->constant[j].at_start) continue;
        nh_ex rate = nh_model_gamma(c->o, value);
        constant = nh_is_zero(c->d, rate) || nh_prove_digits(c->o, value, c->options) >= c->options->digits ||
                   nh_explicit_vanishes(c, nh_model_values(c->o, rate));
    }
    m->is_known = known;
    m->value = c->value;
    if (!constant) m->constants = 0;
    if (c->combined) return;
    for (size_t i = 0; i < m->states; i++)
        if (c->solved[i] && c->value[i]) c->value[i] = without_poles(c, c->value[i]);
    for (size_t i = 0; i < m->states; i++) {
        size_t last;
        known[i] = i == m->parameter ||
                   (constant && c->solved[i] && nh_explicit_unknowns(c, c->value[i], &last) == 0 && agrees(c, i));
        m->known += known[i];
    }
    m->proved = constant && satisfied(c, known);
}

void nh_explicit_forms_clear(nh_explicit_forms *forms)
{
    nh_free(forms->form);
    *forms = (nh_explicit_forms){0};
}

nh_explicit_motion *nh_explicit_motion_along(nh_arena *arena, const nh_model *model, const nh_explicit_request *request,
                                             size_t parameter)
{
    enum { pair = 2 };
    nh_explicit_curve c = {.arena = arena,
                           .o = model,
                           .d = model->dag,
                           .points = request->points,
                           .options = request->options,
                           .fixed = request->fixed,
                           .forms = request->forms};
    bool linear = request->linear;
    c.m = nh_arena_alloc(arena, sizeof *c.m);
    *c.m = (nh_explicit_motion){.states = 1 + model->m + model->n, .parameter = parameter, .fixed = request->fixed};
    if (!start(&c, request) || nh_is_zero(c.d, c.rate[parameter])) return NULL;
    bool more = true;
    while (more && !nh_budget_spent())
        more = linear ? nh_explicit_solve_first(&c, 1) || nh_explicit_solve_rate(&c, false)
                      : nh_explicit_solve_first(&c, 1) || nh_explicit_solve_second(&c, 1, true) ||
                            nh_explicit_solve_rate(&c, false) || nh_explicit_solve_second(&c, 1, false) ||
                            nh_explicit_solve_first(&c, pair) || nh_explicit_solve_second(&c, pair, false) ||
                            nh_explicit_solve_rate(&c, true);
    conclude(&c);
    return c.m;
}
