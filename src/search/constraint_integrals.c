#include "search/constraint_integrals.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "integrals/force_potential.h"

enum { generic_count = 24, own_seed = 505 };

static bool only_events(const nh_model *o, nh_ex e)
{
    for (size_t j = 1 + o->m; j < o->width; j++)
        if (nh_depends(o->dag, e, o->chart->symbol[j])) return false;
    return true;
}

/* Functions in the order: the given constraints between positions, then the currents of (t, q); current[i]: which
   current, or r->count. */
static size_t gather(const nh_analysis *r, nh_ex *phi, size_t *current)
{
    const nh_system *y = r->system;
    size_t n = 0;
    for (size_t a = 0; a < y->constraints; a++)
        if (y->constraint[a].position) phi[n] = y->constraint[a].level, current[n++] = r->count;
    for (size_t k = 0; k < r->count; k++)
        if (only_events(r->model, r->found[k].phi)) phi[n] = r->found[k].phi, current[n++] = k;
    return n;
}

void nh_integrals_of_constraints(nh_analysis *r)
{
    size_t most = r->count + r->system->constraints + 1;
    nh_ex *phi = nh_alloc_array(most, sizeof *phi);
    size_t *current = nh_alloc_array(most, sizeof *current), n = r->system->constraints ? gather(r, phi, current) : 0;
    nh_independence *kind = nh_alloc_array(most, sizeof *kind);
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points =
        n ? nh_points_create(r->model, generic_count, 1, (uint64_t)r->options.seed + own_seed, &ignored) : NULL;
    r->integral = nh_arena_alloc(r->arena, most * sizeof *r->integral);
    if (points) nh_independence_test(r->model, points, n, phi, NULL, r->options.sure, r->options.doubt, kind, NULL);
    for (size_t i = 0; i < n && points; i++) {
        if (current[i] == r->count) continue;
        nh_current *f = &r->found[current[i]];
        bool fresh = kind[i] == NH_INDEPENDENT && r->integrals < r->constraint.hidden;
        if (fresh) r->integral[r->integrals++] = current[i];
        if (!f->meaning[0])
            f->meaning = fresh                     ? "integral of the constraints"
                         : r->constraint.positions ? "the constraints between positions"
                                                   : "";
    }
    nh_points_free(points);
    nh_free(kind);
    nh_free(current);
    nh_free(phi);
}

/* ---- a search of its own ---- */

enum { own_stages = 3, most_functions = 60 };

typedef struct {
    size_t events, functions;
    /* t and the coordinates; functions of them that the system shows, sines, cosines */
    nh_ex event[most_functions], function[most_functions];
} alphabet;

static void letter(const nh_model *o, alphabet *a, nh_ex e)
{
    if (!only_events(o, e) || a->functions == most_functions) return;
    for (size_t i = 0; i < a->functions; i++)
        if (a->function[i] == e) return;
    a->function[a->functions++] = e;
}

/* Where a velocity is q^k times something, k > 1: dq/q^k is integrated to q^(1 - k). */
static void powers(const nh_model *o, alphabet *a)
{
    nh_dag *d = o->dag;
    NH_LIST(product);
    for (size_t s = 0; s < o->m; s++) {
        size_t n = nh_products_in(d, o->rho[s], &product);
        for (size_t i = 0; i < n; i++)
            for (size_t k = 0; k < nh_arity(d, product[i]); k++) {
                nh_ex q = nh_child(d, product[i], k), exponent = nh_exponent_of(d, product[i], k);
                if (nh_kind_of(d, q) != NH_SYMBOL || nh_kind_of(d, exponent) != NH_NUMBER) continue;
                nh_num power = nh_number_of(d, exponent);
                if (power.q == 1 && power.p > 1) letter(o, a, nh_powi(d, q, 1 - power.p));
            }
    }
}

/* f = form_s v^s + rate for a constraint f = 0; false: it is not affine in the velocities. */
static bool read_form(const nh_model *o, nh_ex f, nh_ex *form, nh_ex *rate)
{
    nh_dag *d = o->dag;
    nh_ex *v = nh_alloc_array(2 * o->m, sizeof *v), *zero = v + o->m;
    bool affine = true;
    for (size_t s = 0; s < o->m; s++) v[s] = o->system->coordinate[s].v, zero[s] = nh_int(d, 0);
    for (size_t s = 0; s < o->m; s++) form[s] = nh_simplify_short(d, nh_diff(d, f, v[s]), 0);
    for (size_t s = 0; s < o->m; s++)
        for (size_t j = 0; j < o->m; j++) affine &= !nh_depends(d, form[s], v[j]);
    *rate = nh_simplify_short(d, nh_substitute(d, f, o->m, v, zero), 0);
    nh_free(v);
    return affine;
}

/* F with form + rate dt = dF, or 0. */
static nh_ex potential(const nh_stage_solver *x, const nh_ex *form, nh_ex rate)
{
    const nh_model *o = x->r->model;
    nh_dag *d = o->dag;
    nh_ex t = o->system->t, G = nh_int(d, 0),
          F = nh_force_potential_of(o, x->ranges, (size_t)x->r->options.proof_terms, form);
    if (!F) return 0;
    nh_ex rest = nh_simplify_short(d, nh_sub(d, rate, nh_diff(d, F, t)), 0);
    for (size_t s = 0; s < o->m; s++)
        if (nh_depends(d, rest, o->system->coordinate[s].q)) return 0;
    return nh_is_zero(d, rest) || nh_stage_solver_integral(x, t, rest, false, &G) ? nh_add(d, F, G) : 0;
}

/* Constraints that are total derivatives, as they are written or solved for one of the velocities: theta' = (phi' - 1)
 * sin(phi - t) leaves theta + cos(phi - t) constant. */
static void potentials(const nh_stage_solver *x, alphabet *a)
{
    const nh_model *o = x->r->model;
    nh_dag *d = o->dag;
    nh_ex *form = nh_alloc_array(2 * o->m, sizeof *form), *solved = form + o->m, rate;
    for (size_t k = 0; k < o->system->constraints; k++) {
        const nh_constraint *c = &o->system->constraint[k];
        if (c->level && !c->position) letter(o, a, nh_model_compose(o, c->level));
        if (c->position || c->level || !read_form(o, nh_sub(d, c->lhs, c->rhs), form, &rate)) continue;
        nh_ex F = potential(x, form, rate);
        for (size_t s = 0; s < o->m && !F; s++) {
            if (nh_kind_of(d, form[s]) == NH_NUMBER) continue;
            nh_ex factor = nh_powi(d, form[s], -1);
            for (size_t j = 0; j < o->m; j++) solved[j] = nh_simplify_short(d, nh_mul(d, factor, form[j]), 0);
            F = potential(x, solved, nh_simplify_short(d, nh_mul(d, factor, rate), 0));
        }
        if (F) letter(o, a, F);
    }
    nh_free(form);
}

static void letters(const nh_stage_solver *x, alphabet *a)
{
    const nh_model *o = x->r->model;
    nh_dictionary w = x->words;
    for (size_t j = 0; j <= o->m && a->events < most_functions; j++) a->event[a->events++] = o->chart->symbol[j];
    for (size_t i = 0; i < w.atoms; i++) letter(o, a, w.atom[i]);
    for (size_t i = 0; i < w.potentials; i++) letter(o, a, w.potential[i]);
    for (size_t i = 0; i < w.waves; i++) {
        letter(o, a, nh_call(o->dag, NH_COS, w.wave[i]));
        letter(o, a, nh_call(o->dag, NH_SIN, w.wave[i]));
    }
    powers(o, a);
    potentials(x, a);
}

/* Quadratic in the coordinates, and functions; cubic, and coordinates times functions; of degree four, and squares of
   the functions. */
static size_t families_of(const alphabet *a, size_t stage, nh_family *part, nh_family *out)
{
    size_t n = 0;
    part[0] = (nh_family){.kind = NH_POLYNOMIAL, .in = a->event, .in_count = a->events, .degree = stage == 1 ? 1 : 2};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = a->functions, .term = a->function};
    part[2] = (nh_family){.kind = NH_POLYNOMIAL, .in = a->function, .in_count = a->functions, .degree = 2};
    out[n++] = (nh_family){.kind = NH_POLYNOMIAL, .in = a->event, .in_count = a->events, .degree = 2 + stage};
    if (a->functions == 0) return n;
    if (stage == 0) out[n++] = part[1];
    else if (stage == 1) out[n++] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    else out[n++] = part[2];
    return n;
}

void nh_integrals_find(nh_stage_solver *x)
{
    static const char *const names[own_stages] = {"functions of time and positions: quadratic, and the system's own",
                                                  "the same, cubic, and times positions",
                                                  "the same of degree four, and squares of the system's own"};
    size_t before = x->r->independent;
    alphabet *a = nh_alloc(sizeof *a);
    letters(x, a);
    for (size_t i = 0;
         i < own_stages && x->r->independent < before + x->r->constraint.integrals && !nh_stage_solver_done(x); i++) {
        nh_family part[3], family[2];
        size_t families = families_of(a, i, part, family);
        nh_stage_solver_stage(x, names[i], families, family);
    }
    nh_free(a);
}
