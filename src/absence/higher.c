#include "absence/higher_internal.h"
#include "absence/polynomial_text.h"
#include "absence/rational_value.h"
#include "base/foreign_memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/monomials.h"
#include "graph/node.h"

#include <flint/ulong_extras.h>

enum {
    first_bits = 64,
    last_bits = 4 * first_bits,
    digits = 12,
    usual_exponent = 12,
    before_prime = 1 << 30, /* the first is above it */
    primes = 8,             /* that are tried */
    plane_letters = 4,
    longest_zero = 2000 /* terms of a normal form */
};

typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    const nh_closed_shape *shape;
    const nh_model *model;
    const nh_plane *plane;
    nh_ex u, z, rate[NH_HIGHER_DIRECTIONS]; /* with parameters as symbols */
    bool everything;
    nh_higher_system system;
    nh_higher *out;
} work;

/* ---- the scope ---- */

/* Numbers alone, at the parameters' values? */
static bool constant_inertia(const nh_model *model)
{
    fmpq_t value;
    fmpq_init(value);
    bool good = true;
    for (size_t i = 0; i < model->n * model->n && good; i++)
        good = nh_rational_value_of(model->dag, nh_simplify(model->dag, nh_model_values(model, model->M[i])), value);
    fmpq_clear(value);
    return good;
}

/* A Lagrangian system of two degrees of freedom, all of it in the shape. */
static const char *wrong_system(const nh_closed_shape *shape)
{
    const nh_model *model = shape->model;
    const nh_system *system = model->system;
    if (model->k || system->constraints) return "there are constraints";
    if (system->has_forces) return "there are forces besides those of a potential";
    if (model->m != 2 || shape->count != plane_letters || shape->left)
        return "there are not two coupled degrees of freedom";
    return constant_inertia(model) ? NULL : "the inertia is not constant";
}

static bool vanishes(nh_dag *dag, nh_ex e) { return nh_normal_is_zero(dag, e, longest_zero) == NH_ZERO; }

/* The second derivatives of u and z, without velocities. */
static const char *read_rates(work *w)
{
    const nh_plane *plane = w->plane;
    w->u = plane->y[0];
    w->z = plane->y[2];
    for (size_t d = 0; d < NH_HIGHER_DIRECTIONS; d++) {
        nh_ex velocity = plane->y[2 * d + 1];
        if (!vanishes(w->dag, nh_sub(w->dag, plane->rate[2 * d], velocity)))
            return "the velocities are not the rates of the coordinates";
        nh_ex e = w->rate[d] = nh_simplify(w->dag, plane->rate[2 * d + 1]);
        if (nh_depends(w->dag, e, plane->y[1]) || nh_depends(w->dag, e, plane->y[2 + 1]))
            return "the accelerations depend on the velocities";
        if (!nh_higher_polynomial_of(w->dag, nh_model_values(w->model, e), w->u, w->z, &w->system.rate[d]))
            return "the potential is no polynomial with rational coefficients";
    }
    return NULL;
}

static const char *read_curve(work *w, nh_ex square)
{
    nh_higher_system only; /* for its polynomial */
    nh_higher_system_init(&only);
    const char *obstacle = "the curve is not of genus 1 with one point at infinity";
    if (nh_higher_polynomial_of(w->dag, square, w->u, w->z, &only.rate[0]))
        obstacle = nh_higher_system_complete(&w->system, &only.rate[0]);
    nh_higher_system_clear(&only);
    return obstacle;
}

static const char *read_all(work *w, const nh_normal_equation *equation)
{
    const char *obstacle = wrong_system(w->shape);
    if (!obstacle && (equation->dimension != 2 || w->plane->angle)) obstacle = "the motion is not algebraic";
    if (!obstacle) obstacle = read_rates(w);
    return obstacle ? obstacle : read_curve(w, equation->square);
}

/* ---- all values of the parameters ---- */

/* Does a letter of the shape occur in the inertia? */
static bool varying_inertia(const work *w)
{
    for (size_t i = 0; i < w->model->n * w->model->n; i++) {
        nh_ex entry = nh_simplify(w->dag, w->model->M[i]);
        for (size_t k = 0; k < w->shape->count; k++)
            if (nh_depends(w->dag, entry, w->shape->letter[k])) return true;
    }
    return false;
}

/* With parameters as symbols: is f(u, 0) of degree 2, dg/dz(u, 0) of degree 1, and n the same for all values?
 * 12 (dg/dz)' = n (n + 1) f'' */
static bool same_for_all(const work *w)
{
    enum { twelve = 12 };
    nh_dag *dag = w->dag;
    nh_ex zero = nh_int(dag, 0), slope = nh_diff(dag, w->rate[NH_HIGHER_ACROSS], w->z);
    for (size_t d = 0; d < NH_HIGHER_DIRECTIONS; d++)
        if (!nh_monomials_has_degree(dag, w->rate[d], w->u) || !nh_monomials_has_degree(dag, w->rate[d], w->z))
            return false;
    slope = nh_diff(dag, nh_substitute(dag, slope, 1, &w->z, &zero), w->u);
    nh_ex second = nh_substitute(dag, w->rate[NH_HIGHER_ALONG], 1, &w->z, &zero);
    second = nh_diff(dag, nh_diff(dag, second, w->u), w->u);
    nh_ex N = nh_int(dag, w->system.exponent * (w->system.exponent + 1));
    nh_ex relation = nh_sub(dag, nh_mul(dag, nh_int(dag, twelve), slope), nh_mul(dag, N, second));
    return vanishes(dag, nh_diff(dag, second, w->u)) && vanishes(dag, nh_diff(dag, slope, w->u)) &&
           vanishes(dag, relation) && !varying_inertia(w);
}

/* An exact solution at one value need not remain one; a multiplier off the unit circle is a root of unity on countably
 * many hypersurfaces only, and the logarithm's obstruction vanishes on one. */
static bool is_generic(const work *w, const nh_normal_equation *equation)
{
    const nh_system *system = w->model->system;
    bool parameters = false;
    for (size_t i = 0; i < system->parameters; i++)
        parameters |= nh_depends(w->dag, system->lagrangian, system->parameter[i].symbol);
    if (!parameters) return true;
    return equation->generic && w->plane->generic && w->out->connected == NH_HIGHER_MULTIPLIER && same_for_all(w);
}

/* ---- the group of the first order ---- */

static const char *ball_text(nh_arena *arena, const arb_t x, ulong flags)
{
    char *text = arb_get_str(x, digits, flags);
    const char *out = nh_arena_strdup(arena, text);
    flint_free(text);
    return out;
}

static bool by_multiplier(work *w)
{
    nh_higher *out = w->out;
    acb_t trace;
    arb_t size;
    acb_init(trace);
    arb_init(size);
    bool found = false;
    long most = w->everything ? last_bits : first_bits;
    for (long bits = first_bits; bits <= most && !found; bits *= 2) {
        found = nh_higher_multiplier(&w->system, bits, trace, size);
        out->bits = bits;
    }
    if (found) {
        out->connected = NH_HIGHER_MULTIPLIER;
        out->multiplier = ball_text(w->arena, size, ARB_STR_NO_RADIUS);
        out->trace = nh_arena_printf(w->arena, "%s + %s i", ball_text(w->arena, acb_realref(trace), 0),
                                     ball_text(w->arena, acb_imagref(trace), 0));
    } else {
        out->bits = 0;
    }
    acb_clear(trace);
    arb_clear(size);
    return found;
}

static bool by_solution(work *w)
{
    fmpq_poly_t P;
    fmpq_poly_init(P);
    bool odd, found = nh_higher_solution(&w->system, P, &odd);
    if (found) {
        const char *text = nh_polynomial_text(w->arena, P, nh_name_of(w->dag, w->u));
        if (odd) text = nh_arena_printf(w->arena, "%s*(%s)", nh_name_of(w->dag, w->plane->y[1]), text);
        w->out->solution = text;
        w->out->connected = NH_HIGHER_SOLUTION;
    }
    fmpq_poly_clear(P);
    return found;
}

/* ---- the answer ---- */

static void find_logarithm(work *w)
{
    nh_higher_logarithm found = {0};
    ulong prime = before_prime;
    bool tried = false;
    for (int i = 0; i < primes && !tried; i++) {
        prime = n_nextprime(prime, 1);
        tried = nh_higher_logarithm_find(&w->system, prime, NH_HIGHER_ORDERS, &found);
    }
    w->out->order = found.order;
    w->out->across = found.across;
    w->out->power = found.power;
    w->out->prime = found.order ? prime : 0;
    if (!found.order)
        w->out->obstacle =
            tried ? nh_arena_printf(w->arena, "no logarithm was found up to the variational equation of order %d",
                                    NH_HIGHER_ORDERS)
                  : "the series of higher variational equations are too long";
}

static void decide(work *w, const nh_normal_equation *equation)
{
    nh_higher *out = w->out;
    out->exponent = w->system.exponent;
    if (!w->everything && out->exponent > usual_exponent) {
        out->obstacle = "the series of higher variational equations are long: --absence tries them";
        return;
    }
    find_logarithm(w);
    if (!out->order) return;
    out->refuted = by_solution(w) || by_multiplier(w);
    if (out->refuted) out->generic = is_generic(w, equation);
    else
        out->obstacle = nh_arena_printf(w->arena,
                                        "the variational equation of order %u has a logarithm, but it is not known "
                                        "whether the group of the first one is connected",
                                        out->order);
}

nh_higher *nh_higher_of(nh_arena *arena, const nh_closed_shape *shape, const nh_normal_equation *equation,
                        bool everything)
{
    nh_higher *out = nh_arena_alloc(arena, sizeof *out);
    work w = {.arena = arena,
              .dag = shape->model->dag,
              .shape = shape,
              .model = shape->model,
              .plane = equation->plane,
              .everything = everything,
              .out = out};
    nh_foreign_memory_begin();
    nh_higher_system_init(&w.system);
    *out = (nh_higher){.obstacle = read_all(&w, equation)};
    out->applies = !out->obstacle;
    if (out->applies) decide(&w, equation);
    nh_higher_system_clear(&w.system);
    return out;
}
