#include "search/quadratures.h"

#include <stdlib.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/measure.h"
#include "graph/print.h"
#include "graph/terms.h"
#include "integrals/exact_points.h"
#include "integrals/real_where.h"
#include "search/currents.h"
#include "search/explicit_motion.h"

/* Is the parameter replaced, or does a replaced one depend on it? */
static bool is_needed(const nh_model *o, const nh_ex *fixed, size_t parameter)
{
    for (size_t i = 0; i < o->system->parameters; i++)
        if (nh_fixed_has(o, fixed, i) && (i == parameter || nh_depends(o->dag, fixed[i], o->parameter[parameter])))
            return true;
    return false;
}

/* The parameters that keep their values, where some must: those in functions and exponents of the equations of motion
 * and of the currents, and those that a current needs.  NULL: none. */
static const nh_ex *special_values(const nh_analysis *r)
{
    enum { most = 64 };
    const nh_model *o = r->model;
    size_t n = o->system->parameters;
    bool *fixed = nh_alloc_array(n + 1, sizeof *fixed), any = false;
    for (size_t j = 0; j < o->m + o->n + r->count; j++) {
        const nh_current *f = j < o->m + o->n ? NULL : &r->found[j - o->m - o->n];
        nh_ex e = f ? f->phi : j < o->m ? o->rho[j] : o->a[j - o->m], call[most];
        size_t calls = nh_functions_in(o->dag, e, call, most);
        for (size_t p = 0; p < n; p++) {
            if (f && !f->proof.all_parameters) fixed[p] |= !f->proof.fixed || is_needed(o, f->proof.fixed, p);
            for (size_t i = 0; i < calls && i < most; i++) fixed[p] |= nh_depends(o->dag, call[i], o->parameter[p]);
            any |= fixed[p];
        }
    }
    const nh_ex *list = any ? nh_fixed_those(o, fixed) : NULL;
    nh_free(fixed);
    return list;
}

/* The currents in closed form; `general`: that hold for all values of the parameters. */
static size_t gather(const nh_analysis *r, bool general, nh_ex *current)
{
    size_t n = 0;
    for (size_t k = 0; k < r->count; k++)
        if (!r->found[k].series && (r->found[k].proof.all_parameters || !general)) current[n++] = r->found[k].phi;
    return n;
}

/* Is it better?  More states are; then no integrals without closed form; then no roots; then time as the parameter;
 * then fewer parameters with values. */
static bool better(const nh_explicit_motion *a, const nh_explicit_motion *b)
{
    if (!b || a->known != b->known) return !b || a->known > b->known;
    if (a->integrals != b->integrals) return a->integrals < b->integrals;
    if (a->roots != b->roots) return a->roots < b->roots;
    if (!a->fixed != !b->fixed) return !a->fixed;
    return false;
}

/* ---- the constants of integration as currents ---- */

/* sqrt(u) sqrt(v) as sqrt(u v), also below other roots: integrands are factored, which hides that the states cancel in
 * 1 - C^2. */
static nh_ex joined_roots(nh_dag *d, nh_ex e)
{
    enum { most = 200, passes = 4 };
    nh_ex product[most], by[most], half = nh_ratio(d, 1, 2);
    for (int pass = 0; pass < passes; pass++) {
        size_t n = nh_products_in(d, e, product, most), joined = 0;
        for (size_t i = 0; i < n && i < most; i++) {
            nh_ex radicand = nh_int(d, 1), others = nh_number(d, nh_constant_of(d, product[i]));
            size_t roots = 0;
            for (size_t f = 0; f < nh_arity(d, product[i]); f++) {
                nh_ex base = nh_child(d, product[i], f), x = nh_exponent_of(d, product[i], f);
                bool root = x == half || x == nh_neg(d, half);
                roots += root;
                if (root) radicand = nh_mul(d, radicand, nh_pow(d, base, nh_add(d, x, x)));
                else others = nh_mul(d, others, nh_pow(d, base, x));
            }
            if (roots < 2) continue;
            nh_ex above = nh_simplify_short(d, radicand, 0);
            nh_ex below = nh_simplify_short(d, nh_div(d, nh_int(d, 1), radicand), 0);
            bool over = nh_complexity(d, below) < nh_complexity(d, above);
            product[joined] = product[i];
            by[joined++] = over ? nh_div(d, others, nh_sqrt(d, below)) : nh_mul(d, others, nh_sqrt(d, above));
        }
        if (!joined) return e;
        e = nh_substitute(d, e, joined, product, by);
    }
    return e;
}

static bool split(nh_dag *d, nh_ex e, nh_ex *outside, nh_ex *inside)
{
    nh_ex root;
    e = nh_simplify_short(d, e, 0);
    bool quotient = nh_kind_of(d, e) == NH_SUM && !nh_radicands_in(d, e, &root, 1);
    nh_ex common = nh_kind_of(d, e) == NH_SUM ? nh_terms_common(d, e) : nh_int(d, 1);
    if (!nh_is_number(d, common, 1)) {
        e = nh_mul(d, common, nh_simplify_short(d, nh_div(d, e, common), 0));
        quotient = false;
    }
    return quotient ? nh_square_split_quotient(d, e, outside, inside) : nh_square_split(d, e, outside, inside);
}

/* sqrt(m^2 u) as m sqrt(u), sqrt(x^4 u) as x^2 sqrt(u): if that changes a sign, the root has the other sign everywhere
 * in e; the result is proved anew. */
static nh_ex shorter_roots(const nh_model *o, nh_ex e)
{
    enum { most = 200 };
    nh_dag *d = o->dag;
    nh_ex radicand[most], outside, inside;
    size_t n = nh_radicands_in(d, e, radicand, most);
    for (size_t i = 0; i < n; i++) {
        bool positive = split(d, radicand[i], &outside, &inside) &&
                        (nh_model_is_constant(o, outside) || nh_model_sign(o, outside) > 0);
        if (positive) e = nh_substitute_root(d, e, radicand[i], nh_mul(d, outside, nh_sqrt(d, inside)));
    }
    return e;
}

/* log(c u) as log u, with a positive constant c of parameters: in a current it adds a constant only. */
static nh_ex shorter_logarithms(const nh_analysis *r, nh_ex e)
{
    enum { most = 24 };
    const nh_model *o = r->model;
    nh_dag *d = o->dag;
    nh_ex call[most], by[most];
    size_t n = nh_functions_in(d, e, call, most), logs = 0;
    for (size_t i = 0; i < n && n <= most; i++) {
        nh_ex u = nh_child(d, call[i], 0), c = nh_int(d, 1);
        if (nh_function_of(d, call[i]) != NH_LOG || nh_kind_of(d, u) != NH_PRODUCT) continue;
        c = nh_number(d, nh_constant_of(d, u));
        for (size_t f = 0; f < nh_arity(d, u); f++)
            if (nh_model_is_constant(o, nh_child(d, u, f)) && nh_model_is_constant(o, nh_exponent_of(d, u, f)))
                c = nh_mul(d, c, nh_pow(d, nh_child(d, u, f), nh_exponent_of(d, u, f)));
        nh_ex valued = nh_exact_values(o, c);
        if (nh_kind_of(d, valued) != NH_NUMBER || nh_num_value(nh_number_of(d, valued)) <= 0) continue;
        by[logs] = nh_call(d, NH_LOG, nh_div(d, u, c));
        call[logs++] = call[i];
    }
    return nh_substitute(d, e, logs, call, by);
}

static bool has_roots_of_states(const nh_model *o, nh_ex e)
{
    enum { most = 24 };
    nh_ex radicand[most];
    size_t n = nh_radicands_in(o->dag, e, radicand, most);
    bool found = n == most;
    for (size_t i = 0; i < n && !found; i++) found = !nh_model_is_constant(o, radicand[i]);
    return found;
}

/* atanh(a/sqrt(a^2 + b^2)) as asinh(a/b), where that is not much longer: it keeps its digits where b is small. */
static nh_ex better_area_functions(const nh_model *o, nh_ex e)
{
    enum { most = 24, a_few = 4 };
    nh_dag *d = o->dag;
    nh_ex call[most], outside, inside, one = nh_int(d, 1);
    size_t n = nh_functions_in(d, e, call, most);
    for (size_t i = 0; i < n && n <= most; i++) {
        if (nh_function_of(d, call[i]) != NH_ATANH) continue;
        nh_ex f = nh_child(d, call[i], 0), square = nh_simplify_short(d, nh_powi(d, f, 2), 0);
        nh_ex other = nh_simplify_short(d, nh_div(d, square, nh_sub(d, one, square)), 0);
        if (!nh_square_split(d, other, &outside, &inside)) continue;
        nh_ex u = nh_simplify_short(d, nh_mul(d, outside, nh_sqrt(d, inside)), 0);
        int sign = has_roots_of_states(o, u) ? 0 : nh_model_sign(o, nh_div(d, f, u));
        if (!sign || nh_complexity(d, u) > nh_complexity(d, f) + a_few) continue;
        nh_ex area = nh_mul(d, nh_int(d, sign), nh_call(d, NH_ASINH, u));
        e = nh_substitute(d, e, 1, &call[i], &area);
    }
    return e;
}

typedef struct {
    nh_ex e;
    bool fixed;
    size_t length;
} constant;

/* Sorts currents for all values of the parameters before those for some; short before long. */
static int by_generality(const void *left, const void *right)
{
    const constant *a = left, *b = right;
    if (a->fixed != b->fixed) return a->fixed ? 1 : -1;
    if (a->length != b->length) return a->length < b->length ? -1 : 1;
    return a->e < b->e ? -1 : a->e > b->e;
}

/* sqrt(s^2 R) as s sqrt(R), where sqrt(R) occurs in the equations of motion and the parameters make s positive: the
 * rate then vanishes for both signs of s. */
static nh_ex roots_of_the_equations(const nh_model *o, nh_ex e)
{
    enum { most = 200 };
    nh_dag *d = o->dag;
    nh_ex own[most], theirs[most], half = nh_ratio(d, 1, 2), s, rest;
    size_t roots = nh_radicands_in(d, e, own, most), known = 0;
    for (size_t k = 0; k < o->n; k++) known += nh_radicands_in(d, o->a[k], theirs + known, most - known);
    for (size_t i = 0; i < roots; i++)
        for (size_t j = 0; j < known; j++) {
            nh_ex ratio = nh_simplify_short(d, nh_div(d, own[i], theirs[j]), 0);
            bool parametric = own[i] != theirs[j] && nh_model_is_constant(o, ratio);
            if (!parametric || !nh_square_split(d, ratio, &s, &rest)) continue;
            nh_ex value = nh_exact_values(o, s);
            if (rest != nh_int(d, 1) || nh_kind_of(d, value) != NH_NUMBER) continue;
            if (nh_num_value(nh_number_of(d, value)) < 0) s = nh_neg(d, s);
            e = nh_substitute_root(d, e, own[i], nh_mul(d, s, nh_pow(d, theirs[j], half)));
            break;
        }
    return e;
}

/* sign(u) as u/sqrt(u^2): then it goes into the roots beside it. */
static nh_ex signs_as_roots(nh_dag *d, nh_ex e)
{
    enum { most = 24 };
    nh_ex call[most], by[most];
    size_t n = nh_functions_in(d, e, call, most), signs = 0;
    for (size_t i = 0; i < n && i < most; i++) {
        nh_ex u = nh_child(d, call[i], 0);
        if (nh_function_of(d, call[i]) != NH_SIGN) continue;
        by[signs] = nh_div(d, u, nh_sqrt(d, nh_powi(d, u, 2)));
        call[signs++] = call[i];
    }
    return nh_substitute(d, e, signs, call, by);
}

/* The constant's value in a shorter form.  If this changes the sign of its roots relative to those of the equations of
 * motion, values of parameters may be needed. */
static nh_ex as_current(const nh_analysis *r, nh_ex value, bool general)
{
    const nh_model *o = r->model;
    nh_dag *d = o->dag;
    nh_ex e = shorter_roots(o, nh_simplify_short(d, shorter_logarithms(r, shorter_roots(o, value)), 0));
    nh_ex stable = better_area_functions(o, e);
    if (stable != e && nh_prove_current(o, stable, true, &r->options).all_parameters) e = stable;
    nh_ex joined = shorter_roots(o, joined_roots(d, signs_as_roots(d, e)));
    nh_ex rooted = nh_simplify_short(d, roots_of_the_equations(o, joined), 0);
    if (e == rooted || !general || nh_prove_current(o, e, true, &r->options).all_parameters) return e;
    return nh_prove_current(o, rooted, true, &r->options).all_parameters ? rooted : e;
}

static void harvest(nh_stage_solver *x, size_t count, const nh_explicit_motion *const *tried)
{
    const nh_model *o = x->r->model;
    size_t n = 0, most = 1;
    for (size_t k = 0; k < count; k++) most += tried[k]->constants;
    constant *list = nh_alloc_array(most, sizeof *list);
    for (size_t k = 0; k < count; k++)
        for (size_t j = 0; j < tried[k]->constants; j++) {
            if (!tried[k]->constant[j].integrated || tried[k]->constant[j].at_start) continue;
            nh_ex e = as_current(x->r, tried[k]->constant[j].value, !tried[k]->fixed);
            list[n++] = (constant){e, tried[k]->fixed != NULL, nh_complexity(o->dag, e)};
        }
    qsort(list, n, sizeof *list, by_generality);
    for (size_t j = 0; j < n && !nh_stage_solver_done(x); j++)
        nh_stage_solver_certify(x, list[j].e, "integration of one equation after another");
    nh_free(list);
}

/* ---- the whole ---- */

/* With every state as the parameter; the best one.  NULL where combined coordinates were asked for and there are
   none. */
static const nh_explicit_motion *try_all(nh_stage_solver *x, const nh_explicit_request *request, size_t *count,
                                         const nh_explicit_motion **tried)
{
    const nh_model *o = x->r->model;
    const nh_explicit_motion *best = NULL;
    size_t states = 1 + o->m + o->n;
    for (size_t i = 0; i < states && !nh_budget_spent(); i++) {
        const nh_explicit_motion *m = nh_explicit_motion_along(x->r->arena, o, request, i);
        if (!m && request->combined && i == 0) return NULL;
        if (!m) continue;
        tried[(*count)++] = m;
        if (better(m, best)) best = m;
        /* no other parameter can give a simpler motion */
        if (i == 0 && m->known == states && !m->roots && !m->integrals) break;
    }
    return best;
}

static const char *joined(nh_arena *arena, const char *all, const char *one)
{
    if (!one || (all && strstr(all, one))) return all;
    return all ? nh_arena_printf(arena, "%s, %s", all, one) : one;
}

/* The region in which its constants do not jump, and are real, which may hold for bound motions only; NULL:
 * everywhere. */
static const char *region_of(nh_stage_solver *x, const nh_explicit_motion *m)
{
    const nh_model *o = x->r->model;
    nh_arena *arena = x->r->arena;
    const char *all = NULL;
    for (size_t j = 0; j < m->constants; j++) {
        nh_ex positive[NH_MOST_REAL_WHERE], value = m->constant[j].value;
        size_t n = nh_real_where(o, value, positive);
        all = joined(arena, all, nh_currents_region(x->bench, value, 0, NULL));
        for (size_t i = 0; i < n; i++) {
            char *text = nh_model_is_constant(o, positive[i]) ? NULL : nh_print_string(o->dag, positive[i]);
            if (text) all = joined(arena, all, nh_arena_printf(arena, "where %s > 0", text));
            nh_free(text);
        }
    }
    return all;
}

void nh_quadratures_complete(nh_stage_solver *x)
{
    nh_analysis *r = x->r;
    const nh_model *o = r->model;
    size_t states = 1 + o->m + o->n;
    if (o->chart->implicit) return;
    nh_ex *current = nh_arena_alloc(r->arena, (r->count + 1) * sizeof *current);
    size_t n = gather(r, true, current);
    nh_explicit_request request = {
        .points = x->ranges, .currents = n, .current = current, .linear = true, .options = &r->options};
    bool open = !nh_counted_covers(&x->counted, 1, false);
    for (size_t i = 0; i < states && !nh_budget_spent(); i++) {
        const nh_explicit_motion *m = nh_explicit_motion_along(r->arena, o, &request, i);
        if (!m || (m->known < states && !open)) continue;
        harvest(x, 1, &m);
        if (m->known == states) return;
    }
}

void nh_quadratures_search(nh_stage_solver *x)
{
    nh_analysis *r = x->r;
    const nh_model *o = r->model;
    size_t states = 1 + o->m + o->n, count = 0;
    if (o->chart->implicit || nh_budget_spent()) return;
    nh_progress("integration of one equation after another", nh_budget_part());
    nh_ex *current = nh_arena_alloc(r->arena, (r->count + 1) * sizeof *current),
          *special = nh_arena_alloc(r->arena, (r->count + 1) * sizeof *special);
    nh_explicit_request request = {.points = x->ranges, .current = current, .options = &r->options}, valued = request;
    request.currents = gather(r, true, current);
    valued.current = special;
    valued.currents = gather(r, false, special);
    valued.fixed = special_values(r);
    const nh_explicit_motion **tried = nh_arena_alloc(r->arena, 2 * states * sizeof *tried),
                             *best = try_all(x, &request, &count, tried);
    if (valued.fixed && !(best && best->known == states && !best->integrals)) {
        const nh_explicit_motion *other = try_all(x, &valued, &count, tried);
        if (other && better(other, best)) best = other;
    }
    harvest(x, count, tried);
    /* the formulas of motions in combined coordinates are not shown: their constants are currents */
    request.combined = valued.combined = true;
    count = 0;
    if (!nh_stage_solver_done(x)) try_all(x, &request, &count, tried);
    if (!nh_stage_solver_done(x) && valued.fixed) try_all(x, &valued, &count, tried);
    harvest(x, count, tried);
    if (!best || best->known <= 1) return;
    nh_explicit_motion *m = nh_arena_alloc(r->arena, sizeof *m);
    *m = *best;
    m->region = region_of(x, m);
    r->motion = m;
}
