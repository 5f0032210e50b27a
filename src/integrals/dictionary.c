/* dictionary: one walk over L, forces, constraints and rho, in which every node is visited once.
 *
 *     forces, constraints    walk, with integrals of 1/(b + c q)
 *     L, rho                 walk: forms, atoms, waves
 *     M                      integrals of 1/M, roots of its diagonal and determinant, frame M = L D L^T
 *     dL/dv                  momenta
 *     L at v = 0             terms of the potential, with derivatives by angles
 *     a                      shapes, lengths and waves: the coordinates on which the equations depend */
#include "integrals/dictionary.h"

#include <stdlib.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/shown_coordinates.h"
#include "integrals/total_derivative.h"

enum { least_entries = 24, entries_each = 3, seen_each = 512, least_seen = 4096, longest = 60 };

typedef struct {
    nh_model *o;
    nh_dictionary *out;
    nh_ex lagrangian; /* without total derivatives, whose functions are in no equation */
    /* largest number of entries of each list, and of visited nodes: they grow with the coordinates */
    size_t most, most_seen;
    size_t seen_count, all_waves;
    nh_ex *seen;     /* visited nodes */
    nh_ex *all_wave; /* every coordinate inside a sine or cosine */
    /* in forces and constraints: the integral of 1/(b + c q) is added, too; in the Lagrangian that of 1/(b + c t) */
    bool integrate;
} harvester;

static bool is_in(size_t n, const nh_ex *list, nh_ex e)
{
    for (size_t i = 0; i < n; i++)
        if (list[i] == e) return true;
    return false;
}

/* Adds an expression once, whatever its constant factor is. */
static void add(harvester *h, size_t *n, nh_ex *list, nh_ex e)
{
    nh_dag *d = h->o->dag;
    e = nh_simplify_short(d, nh_model_compose(h->o, e), 0);
    if (nh_kind_of(d, e) == NH_PRODUCT) {
        nh_num c = nh_constant_of(d, e);
        if (!nh_num_is(c, 1)) e = nh_mul(d, e, nh_number(d, nh_num_inv(c)));
    }
    if (nh_kind_of(d, e) == NH_NUMBER || *n == h->most || nh_complexity(d, e) > longest || is_in(*n, list, e)) return;
    list[(*n)++] = e;
}

static bool has_velocity(const nh_model *model, nh_ex e)
{
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(model->dag, e, model->system->coordinate[s].v)) return true;
    for (size_t i = 0; i < model->n; i++)
        if (nh_depends(model->dag, e, model->chart->w[i])) return true;
    return false;
}

static bool has_position(const nh_model *model, nh_ex e)
{
    if (nh_depends(model->dag, e, model->system->t)) return true;
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(model->dag, e, model->system->coordinate[s].q)) return true;
    return false;
}

/* Linear and homogeneous in the velocities? */
static bool is_form(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    nh_ex *v = nh_alloc_array(2 * model->m + model->n + 1, sizeof *v),
          *zero = nh_alloc_array(2 * model->m + model->n + 1, sizeof *zero);
    size_t n = 0;
    bool form = true;
    for (size_t s = 0; s < model->m; s++) v[n++] = model->system->coordinate[s].v;
    for (size_t i = 0; i < model->n && model->chart->quasi; i++) v[n++] = model->chart->w[i];
    for (size_t i = 0; i < n && form; i++) form = !nh_depends(d, e, v[i]) || !has_velocity(model, nh_diff(d, e, v[i]));
    form = form && nh_is_zero(d, nh_substitute(d, e, n, v, zero));
    nh_free(zero);
    nh_free(v);
    return form;
}

/* A momentum is added in whatever form it has, as the energy is. */
static void add_momentum(harvester *h, nh_ex p)
{
    nh_dictionary *out = h->out;
    nh_ex e = nh_model_compose(h->o, p);
    if (nh_complexity(h->o->dag, e) <= longest) add(h, &out->momenta, out->momentum, p);
    else if (out->momenta < h->most && !is_in(out->momenta, out->momentum, e)) out->momentum[out->momenta++] = e;
}

/* A function of position other than a polynomial and a plain sine or cosine of a coordinate. */
static void add_atom(harvester *h, nh_ex e)
{
    nh_dag *d = h->o->dag;
    add(h, &h->out->atoms, h->out->atom, e);
    nh_kind kind = nh_kind_of(d, e);
    bool invertible = kind == NH_PRODUCT || nh_function_of(d, e) == NH_EXP;
    if (invertible) add(h, &h->out->atoms, h->out->atom, nh_powi(d, e, -1));
    bool power = kind == NH_PRODUCT && nh_arity(d, e) == 1 && nh_num_is(nh_constant_of(d, e), 1);
    nh_ex x = power ? nh_exponent_of(d, e, 0) : 0;
    if (!power || nh_kind_of(d, x) != NH_NUMBER || nh_number_of(d, x).q != 1 || llabs(nh_number_of(d, x).p) < 2) return;
    /* the first power as well as a higher one */
    add(h, &h->out->atoms, h->out->atom, nh_powi(d, nh_child(d, e, 0), -1));
}

/* Adds the integral of 1/sqrt(b + c q^2) with it: asinh of the same argument. */
static void add_integral(harvester *h, nh_ex base)
{
    nh_dag *d = h->o->dag;
    for (size_t s = 0; s < h->o->m; s++) {
        nh_ex q = h->o->system->coordinate[s].q, zero = nh_int(d, 0), slope = nh_diff(d, base, q);
        nh_ex c = nh_mul(d, nh_ratio(d, 1, 2), nh_diff(d, slope, q)), b = nh_substitute(d, base, 1, &q, &zero);
        if (nh_is_zero(d, slope) || has_position(h->o, b) || has_position(h->o, c) || nh_is_zero(d, c)) continue;
        if (!nh_is_zero(d, nh_substitute(d, slope, 1, &q, &zero))) continue;
        add(h, &h->out->atoms, h->out->atom, nh_call(d, NH_ASINH, nh_mul(d, q, nh_sqrt(d, nh_div(d, c, b)))));
    }
}

/* The integral of 1/base by a coordinate or t: log(b + c q), atan(q sqrt(c/b)) of b + c q^2 (atanh where c/b < 0). */
static void add_logarithm(harvester *h, nh_ex base, bool of_time_alone)
{
    nh_model *o = h->o;
    nh_dag *d = o->dag;
    for (size_t s = of_time_alone ? o->m : 0; s <= o->m; s++) {
        nh_ex q = s < o->m ? o->system->coordinate[s].q : o->system->t, zero = nh_int(d, 0),
              slope = nh_diff(d, base, q), c = nh_mul(d, nh_ratio(d, 1, 2), nh_diff(d, slope, q));
        nh_ex b = nh_substitute(d, base, 1, &q, &zero), by = 0;
        if (nh_is_zero(d, slope) || has_position(o, b) || has_position(o, c)) continue;
        if (nh_is_zero(d, c)) {
            int sign = nh_model_sign(o, base);
            if (sign) by = nh_call(d, NH_LOG, sign > 0 ? base : nh_neg(d, base));
        } else if (nh_is_zero(d, nh_substitute(d, slope, 1, &q, &zero)) && !nh_is_zero(d, b)) {
            int sign = nh_model_sign(o, nh_div(d, c, b));
            nh_ex scale = nh_div(d, sign < 0 ? nh_neg(d, c) : c, b);
            if (sign) by = nh_call(d, sign > 0 ? NH_ATAN : NH_ATANH, nh_mul(d, q, nh_sqrt(d, scale)));
        }
        if (by) add(h, &h->out->atoms, h->out->atom, by);
    }
}

/* Is the frequency that of a coordinate?  The stages have such waves already.  A force with cos t adds none. */
static bool plain_wave(const nh_model *model, nh_ex e)
{
    nh_function f = nh_function_of(model->dag, e);
    if (f != NH_SIN && f != NH_COS && f != NH_TAN) return false;
    nh_ex angle = nh_child(model->dag, e, 0);
    return nh_kind_of(model->dag, angle) == NH_SYMBOL && angle != model->system->t;
}

/* A coordinate inside of a sine, cosine or tangent. */
static void add_wave(harvester *h, nh_ex e)
{
    nh_function f = nh_function_of(h->o->dag, e);
    if (f != NH_SIN && f != NH_COS && f != NH_TAN) return;
    for (size_t s = 0; s < h->o->m; s++) {
        nh_ex q = h->o->system->coordinate[s].q;
        if (nh_depends(h->o->dag, e, q) && !is_in(h->all_waves, h->all_wave, q)) h->all_wave[h->all_waves++] = q;
    }
}

/* u with e = |u|: of abs(u), and of the root of a square; 0 where e is neither. */
static nh_ex inside_of_absolute(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    if (nh_kind_of(d, e) == NH_FUNCTION) return nh_function_of(d, e) == NH_ABS ? nh_child(d, e, 0) : 0;
    if (nh_kind_of(d, e) != NH_PRODUCT || nh_arity(d, e) != 1 || !nh_num_is(nh_constant_of(d, e), 1)) return 0;
    nh_ex x = nh_exponent_of(d, e, 0), square = nh_simplify_short(d, nh_child(d, e, 0), 0);
    if (nh_kind_of(d, x) != NH_NUMBER || !nh_num_equal(nh_number_of(d, x), nh_num_ratio(1, 2)) ||
        nh_kind_of(d, square) != NH_PRODUCT)
        return 0;
    nh_ex u = nh_int(d, 1);
    for (size_t i = 0; i < nh_arity(d, square); i++) {
        nh_ex power = nh_exponent_of(d, square, i);
        if (nh_kind_of(d, power) != NH_NUMBER || nh_number_of(d, power).q != 1 || nh_number_of(d, power).p % 2)
            return 0;
        u = nh_mul(d, u, nh_powi(d, nh_child(d, square, i), nh_number_of(d, power).p / 2));
    }
    return u;
}

/* Adds with |u| its integrals u |u|/2 and |u|^3/6, and with sign(u) those and |u|: forces that change their direction
 * give such terms in momenta and centres of mass. */
static void add_absolutes(harvester *h, nh_ex e)
{
    nh_dag *d = h->o->dag;
    bool sign = nh_kind_of(d, e) == NH_FUNCTION && nh_function_of(d, e) == NH_SIGN;
    nh_ex u = sign ? nh_child(d, e, 0) : inside_of_absolute(h->o, e);
    if (!u) return;
    nh_ex size = sign ? nh_call(d, NH_ABS, u) : e;
    if (sign) add(h, &h->out->atoms, h->out->atom, size);
    add(h, &h->out->atoms, h->out->atom, nh_mul(d, u, size));
    if (nh_depends(d, u, h->o->system->t)) add(h, &h->out->atoms, h->out->atom, nh_mul(d, nh_powi(d, u, 2), size));
}

/* Sums linear in velocities are forms, functions of position atoms; the children of a product enter with their
 * powers. */
static void walk(harvester *h, nh_ex e)
{
    nh_dag *d = h->o->dag;
    nh_kind kind = nh_kind_of(d, e);
    if (kind == NH_NUMBER || kind == NH_SYMBOL || is_in(h->seen_count, h->seen, e) || h->seen_count == h->most_seen)
        return;
    h->seen[h->seen_count++] = e;
    bool moving = has_velocity(h->o, e), placed = has_position(h->o, e);
    if (kind == NH_SUM && moving && is_form(h->o, e)) add(h, &h->out->forms, h->out->form, e);
    if (kind == NH_FUNCTION && placed) add_wave(h, e);
    if (kind == NH_FUNCTION && placed && !moving && !plain_wave(h->o, e)) {
        add_atom(h, e);
        add_absolutes(h, e);
    }
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex child = nh_child(d, e, i);
        walk(h, child);
        if (kind != NH_PRODUCT) continue;
        nh_ex x = nh_exponent_of(d, e, i);
        bool polynomial = nh_kind_of(d, x) == NH_NUMBER && nh_number_of(d, x).q == 1 && nh_number_of(d, x).p > 0;
        if (polynomial || !has_position(h->o, child) || has_velocity(h->o, child)) continue;
        add_atom(h, nh_pow(d, child, x));
        add_absolutes(h, nh_pow(d, child, x));
        if (nh_is_number(d, x, -1)) add_logarithm(h, child, !h->integrate);
    }
}

/* Does the part that depends on position have even powers only? */
static bool is_square(const nh_model *model, nh_ex product)
{
    nh_dag *d = model->dag;
    for (size_t i = 0; i < nh_arity(d, product); i++) {
        nh_ex x = nh_exponent_of(d, product, i);
        if (has_position(model, nh_child(d, product, i)) &&
            (nh_kind_of(d, x) != NH_NUMBER || nh_number_of(d, x).q != 1 || nh_number_of(d, x).p % 2))
            return false;
    }
    return true;
}

static void add_root(harvester *h, nh_ex e)
{
    nh_model *o = h->o;
    if (nh_kind_of(o->dag, e) != NH_SUM || !has_position(o, e) || has_velocity(o, e)) return;
    nh_ex factored = nh_simplify_short(o->dag, e, 0);
    if (nh_kind_of(o->dag, factored) == NH_PRODUCT && is_square(o, factored)) return; /* there is no root */
    add_atom(h, nh_sqrt(o->dag, e));
    add_integral(h, e);
}

/* Determinant of the mass matrix, of at most three velocities. */
static nh_ex determinant(const nh_model *model)
{
    nh_dag *d = model->dag;
    const nh_ex *M = model->M;
    size_t n = model->n;
    nh_ex det = nh_int(d, 0);
    if (n == 1) return M[0];
    if (n == 2) return nh_sub(d, nh_mul(d, M[0], M[3]), nh_mul(d, M[1], M[2]));
    for (size_t j = 0; j < 3 && n == 3; j++) {
        size_t a = (j + 1) % 3, b = (j + 2) % 3;
        nh_ex minor = nh_sub(d, nh_mul(d, M[3 + a], M[6 + b]), nh_mul(d, M[3 + b], M[6 + a]));
        det = nh_add(d, det, nh_mul(d, M[j], minor));
    }
    return det;
}

/* ---- the frame ---- */

/* The root of the factor of e that depends on position, where it has even powers only: sin(h)^2 -> sin(h). */
static nh_ex even_root(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    nh_ex root = nh_int(d, 1);
    if (nh_kind_of(d, e) != NH_PRODUCT) return root;
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), x = nh_exponent_of(d, e, i);
        if (!has_position(model, base)) continue;
        nh_num power = nh_kind_of(d, x) == NH_NUMBER ? nh_number_of(d, x) : nh_num_int(1);
        if (power.q != 1 || power.p % 2) return nh_int(d, 1);
        root = nh_mul(d, root, nh_powi(d, base, power.p / 2));
    }
    return root;
}

/* The diagonal entry that is shortest, not zero and not done; n: there is none. */
static size_t simplest_pivot(const nh_model *model, const nh_ex *M, const bool *done)
{
    size_t best = model->n, least = SIZE_MAX;
    for (size_t i = 0; i < model->n; i++) {
        size_t size = nh_complexity(model->dag, M[i * model->n + i]);
        if (done[i] || nh_is_zero(model->dag, M[i * model->n + i]) || size >= least) continue;
        least = size;
        best = i;
    }
    return best;
}

/* M = L D L^T with the simplest pivots first. */
static void frame(harvester *h)
{
    enum { most = 5 };
    nh_model *model = h->o;
    nh_dag *d = model->dag;
    size_t n = model->n;
    nh_ex M[most * most];
    bool done[most] = {false}, moving = false;
    if (n > most) return;
    for (size_t i = 0; i < n * n; i++) {
        M[i] = nh_complexity(d, model->M[i]) > 4 * longest ? 0 : nh_simplify(d, model->M[i]);
        moving |= has_position(model, M[i]);
        if (nh_complexity(d, model->M[i]) > 4 * longest || has_velocity(model, M[i])) return;
    }
    if (!moving) return;
    for (size_t step = 0; step < n; step++) {
        size_t p = simplest_pivot(model, M, done);
        if (p == n) break;
        nh_ex form = model->chart->w[p], pivot = M[p * n + p];
        done[p] = true;
        for (size_t j = 0; j < n; j++)
            if (!done[j]) form = nh_add(d, form, nh_mul(d, nh_div(d, M[p * n + j], pivot), model->chart->w[j]));
        add(h, &h->out->frames, h->out->frame, nh_mul(d, even_root(model, pivot), form));
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j < n; j++)
                if (!done[i] && !done[j])
                    M[i * n + j] = nh_simplify_short(
                        d, nh_sub(d, M[i * n + j], nh_div(d, nh_mul(d, M[i * n + p], M[p * n + j]), pivot)), 0);
    }
}

/* Adds the root of the whole and of its factors, numerator and denominator alike: the choice of the independent
 * velocities, which decides whether the mass is 1 + y^2 or 1 + 1/y^2, must not matter. */
static void add_roots_of(harvester *h, nh_ex e)
{
    nh_dag *d = h->o->dag;
    nh_ex numerator = nh_complexity(d, e) <= longest ? nh_numerator(d, e) : e;
    nh_ex each[2] = {e, numerator};
    for (size_t k = 0; k < (numerator == e ? 1 : 2); k++) {
        add_root(h, each[k]);
        for (size_t j = 0; nh_kind_of(d, each[k]) == NH_PRODUCT && j < nh_arity(d, each[k]); j++)
            add_root(h, nh_child(d, each[k], j));
    }
}

/* Roots of the mass matrix' diagonal and of its determinant: densities of invariant measures, and currents with
   them. */
static void add_roots(harvester *h)
{
    nh_model *model = h->o;
    add_roots_of(h, nh_simplify_short(model->dag, determinant(model), 0));
    for (size_t i = 0; i < model->n; i++) {
        nh_ex length =
            nh_powi(model->dag, even_root(model, model->M[i * model->n + i]), -1); /* x'^2/x^2: log x is the length */
        add_roots_of(h, model->M[i * model->n + i]);
        if (has_position(model, length)) add_logarithm(h, length, false);
    }
}

/* One term, and its derivatives by the angles in it. */
static void potential_term(harvester *h, nh_ex term)
{
    nh_dag *d = h->o->dag;
    if (!has_position(h->o, term)) return;
    add(h, &h->out->potentials, h->out->potential, term);
    for (size_t j = 0; j < h->all_waves; j++) {
        nh_ex slope = nh_diff(d, term, h->all_wave[j]);
        if (!nh_is_zero(d, slope)) add(h, &h->out->potentials, h->out->potential, slope);
    }
}

/* Takes sums apart, b*(e1 + e2) and e1*(1 + e2) as well: the form in which L is written must not matter. */
static void potential_terms(harvester *h, nh_ex e, int depth)
{
    nh_dag *d = h->o->dag;
    if (nh_kind_of(d, e) == NH_SUM && depth) {
        for (size_t i = 0; i < nh_arity(d, e); i++) potential_terms(h, nh_child(d, e, i), depth - 1);
        return;
    }
    for (size_t i = 0; nh_kind_of(d, e) == NH_PRODUCT && depth && i < nh_arity(d, e); i++) {
        nh_ex sum = nh_child(d, e, i);
        if (nh_kind_of(d, sum) != NH_SUM || !nh_is_number(d, nh_exponent_of(d, e, i), 1) || !has_position(h->o, sum))
            continue;
        nh_ex factor = nh_div(d, e, sum);
        for (size_t j = 0; j < nh_arity(d, sum); j++)
            potential_terms(h, nh_mul(d, factor, nh_child(d, sum, j)), depth - 1);
        if (!nh_num_is(nh_constant_of(d, sum), 0)) potential_terms(h, factor, depth - 1);
        return;
    }
    potential_term(h, e);
}

/* The additive terms of the potential, and the derivatives of those that contain an angle in a sine or cosine. */
static void potentials(harvester *h)
{
    nh_model *model = h->o;
    nh_dag *d = model->dag;
    nh_ex *zero = nh_alloc_array(model->m + 1, sizeof *zero), *v = nh_alloc_array(model->m + 1, sizeof *v);
    for (size_t s = 0; s < model->m; s++) v[s] = model->system->coordinate[s].v;
    potential_terms(h, nh_substitute(d, h->lagrangian, model->m, v, zero), 3);
    nh_free(v);
    nh_free(zero);
}

/* Coordinates outside of sines and cosines.  `seen`: nodes that were visited already (a shared graph has exponentially
 * many paths). */
static bool plainly(const nh_dag *d, nh_ex e, nh_ex q, bool *seen)
{
    nh_kind kind = nh_kind_of(d, e);
    if (e == q) return true;
    if (kind == NH_NUMBER || kind == NH_SYMBOL || seen[e]) return false;
    seen[e] = true;
    nh_function f = kind == NH_FUNCTION ? nh_function_of(d, e) : NH_PI;
    if (f == NH_SIN || f == NH_COS || f == NH_TAN) return false;
    for (size_t i = 0; i < nh_arity(d, e); i++)
        if (plainly(d, nh_child(d, e, i), q, seen)) return true;
    return false;
}

static bool occurs_plainly(harvester *h, nh_ex e, nh_ex q)
{
    bool *seen = nh_alloc_array((size_t)e + 1, sizeof *seen), result = plainly(h->o->dag, e, q, seen);
    nh_free(seen);
    return result;
}

/* A coordinate on which some a^i depends is a shape; a length where it stands outside of sines, a wave where it is an
 * angle. */
static void shapes(harvester *h)
{
    nh_model *model = h->o;
    /* only angles that occur in the equations of motion: the pencil finds the harmonics of cyclic ones */
    h->out->waves = 0;
    for (size_t s = 0; s < model->m; s++) {
        nh_ex q = model->system->coordinate[s].q;
        bool plain = false, any = false;
        for (size_t i = 0; i < model->n; i++) {
            any |= nh_depends(model->dag, model->a[i], q);
            plain |= any && occurs_plainly(h, model->a[i], q);
        }
        if (any) h->out->shape[h->out->shapes++] = q;
        if (plain) h->out->length[h->out->lengths++] = q;
        bool wave = model->system->coordinate[s].type == NH_ANGLE || is_in(h->all_waves, h->all_wave, q);
        if (wave && any) h->out->wave[h->out->waves++] = q;
    }
}

static size_t larger(size_t a, size_t b) { return a > b ? a : b; }

static nh_ex *take(const harvester *h)
{
    return nh_arena_alloc(h->o->arena, (h->most + h->o->m + h->o->n + 1) * sizeof(nh_ex));
}

nh_dictionary nh_dictionary_of(nh_model *model)
{
    harvester h = {.o = model,
                   .lagrangian = nh_total_derivative_removed(model),
                   .most = larger(least_entries, entries_each * model->m),
                   .most_seen = larger(least_seen, seen_each * model->m)};
    nh_dictionary out = {.velocity = take(&h),
                         .form = take(&h),
                         .atom = take(&h),
                         .potential = take(&h),
                         .momentum = take(&h),
                         .position = take(&h),
                         .place = take(&h),
                         .wave = take(&h),
                         .frame = take(&h),
                         .length = take(&h),
                         .shape = take(&h)};
    h.out = &out;
    h.seen = nh_alloc_array(h.most_seen, sizeof *h.seen);
    h.all_wave = nh_alloc_array(model->m + 1, sizeof *h.all_wave);
    for (size_t i = 0; i < model->n; i++) out.velocity[out.velocities++] = model->chart->w[i];
    for (size_t s = 0; s < model->m; s++) out.position[out.positions++] = model->system->coordinate[s].q;
    h.integrate = true;
    for (size_t s = 0; s < model->m && model->system->has_forces; s++) walk(&h, model->system->force[s]);
    for (size_t a = 0; a < model->k; a++) walk(&h, nh_chart_constraint(model->chart, a));
    h.integrate = false;
    walk(&h, h.lagrangian);
    /* velocities of variable masses: the integral of 1/M */
    for (size_t i = 0; i < model->n; i++) add_logarithm(&h, model->M[i * model->n + i], true);
    for (size_t s = 0; s < model->m; s++) walk(&h, model->rho[s]);
    for (size_t s = 0; s < model->m; s++)
        if (!is_in(out.velocities, out.velocity, model->rho[s])) add(&h, &out.velocities, out.velocity, model->rho[s]);
    for (size_t s = 0; s < model->m; s++)
        add_momentum(&h, nh_diff(model->dag, h.lagrangian, model->system->coordinate[s].v));
    nh_ex place[NH_MOST_PLACES];
    size_t places = nh_shown_places(model, place);
    for (size_t i = 0; i < places; i++) add(&h, &out.places, out.place, place[i]);
    potentials(&h);
    frame(&h);
    add_roots(&h);
    shapes(&h);
    nh_free(h.all_wave);
    nh_free(h.seen);
    return out;
}
