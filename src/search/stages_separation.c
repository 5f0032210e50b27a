/* Stages for separable systems, for polynomial potentials, and for coefficients that depend on time. */
#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "search/stages_internal.h"

/* Integrals from separation of variables (Euler's two centres, Liouville's systems): squares of velocities with
 * coefficients of higher degree in the positions, the energy and the system's functions with lower ones. */
void nh_stage_separation(nh_family_list *s)
{
    nh_expr_set l = {0}, e = {0}, q = nh_expr_set_positions(s, false, false), f = nh_expr_set_functions(s, false);
    bool few = s->w->positions <= 2;
    if (s->w->positions > 3 || s->w->waves) return;
    nh_expr_set_put_all(&l, s->o->n, s->o->chart->w);
    nh_expr_set v = nh_expr_set_squares(s, &l);
    nh_expr_set_put(&e, s->o->E);
    nh_expr_set_put_all(&e, f.n, f.e);
    nh_family_list_add(
        s, nh_family_list_product(
               s, 2, (nh_family[]){nh_family_list_terms(s, &v), nh_family_list_polynomial(s, &q, few ? 4 : 2)}));
    nh_family_list_add(s, nh_family_list_product(
                              s, 2, (nh_family[]){nh_family_list_terms(s, &e), nh_family_list_polynomial(s, &q, 2)}));
    nh_family_list_add(s, nh_family_list_polynomial(s, &q, 4));
}

/* ---- functions of one coordinate ---- */

static bool of_one(const nh_family_list *s, nh_ex e, nh_ex q)
{
    for (size_t i = 0; i < s->w->positions; i++)
        if (nh_depends(s->o->dag, e, s->w->position[i]) != (s->w->position[i] == q)) return false;
    return !nh_depends(s->o->dag, e, s->o->system->t);
}

static bool is_one_of(size_t n, const nh_ex *list, nh_ex e)
{
    for (size_t i = 0; i < n; i++)
        if (list[i] == e) return true;
    return false;
}

/* f is finite on the sampling interval of q, ends included. */
static bool tame(const nh_family_list *s, nh_ex f, nh_ex q)
{
    enum { places = 33 };
    static const double most = 100;
    const nh_model *o = s->o;
    double low, high, value;
    nh_chart_range(o->chart, q, &low, &high);
    nh_tape *tape = nh_tape_create(o->dag, 1, &q, 1, &f, o->system->parameters, o->parameter, o->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = true;
    for (int i = 0; i < places && good; i++) {
        double at = low + (high - low) * i / (places - 1);
        nh_tape_eval(tape, work, &at, &value);
        good = fabs(value) < most;
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return good;
}

static void put_tame(const nh_family_list *s, nh_expr_set *l, nh_ex f, nh_ex q)
{
    if (tame(s, f, q)) nh_expr_set_put(l, f);
}

/* What coefficients of squares may be: q, q^2; sin 2q, cos 2q, 1/sin^2 q, 1/cos^2 q; the system's functions. */
static void put_coefficients(const nh_family_list *s, nh_ex q, nh_expr_set *l)
{
    nh_dag *d = s->o->dag;
    if (is_one_of(s->w->waves, s->w->wave, q)) {
        nh_ex twice = nh_mul(d, nh_int(d, 2), q);
        nh_expr_set_put(l, nh_call(d, NH_COS, twice));
        nh_expr_set_put(l, nh_call(d, NH_SIN, twice));
        put_tame(s, l, nh_powi(d, nh_call(d, NH_SIN, q), -2), q);
        put_tame(s, l, nh_powi(d, nh_call(d, NH_COS, q), -2), q);
    } else {
        nh_expr_set_put(l, q);
        nh_expr_set_put(l, nh_powi(d, q, 2));
    }
    for (size_t i = 0; i < s->w->atoms; i++)
        if (of_one(s, s->w->atom[i], q)) put_tame(s, l, s->w->atom[i], q);
}

static nh_expr_set coefficients(const nh_family_list *s)
{
    nh_expr_set c = {0};
    nh_expr_set_put(&c, nh_int(s->o->dag, 1));
    for (size_t i = 0; i < s->w->lengths; i++) put_coefficients(s, s->w->length[i], &c);
    for (size_t i = 0; i < s->w->waves; i++) put_coefficients(s, s->w->wave[i], &c);
    return c;
}

/* What separation of variables gives in orthogonal coordinates: alone, because among all products of momenta these few
   are nearly dependent. */
void nh_stage_separated(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set pp = {0}, c = {0};
    if (s->o->k || s->w->frames == 0) return;
    for (size_t i = 0; i < s->o->m; i++)
        for (size_t j = 0; j < i; j++)
            if (!nh_is_zero(d, s->o->M[i * s->o->n + j])) return;
    c = coefficients(s);
    for (size_t i = 0; i < s->o->m; i++) nh_expr_set_put(&pp, nh_powi(d, s->o->p[i], 2));
    nh_expr_set_put(&pp, s->o->E);
    nh_family_list_product_of_sets(s, &pp, &c);
    nh_family_list_add(s, nh_family_list_terms(s, &c));
}

/* sin q, cos q; else q and the system's functions with their derivatives (cosh, sinh). */
static void put_factors(const nh_family_list *s, nh_ex q, nh_expr_set *l)
{
    nh_dag *d = s->o->dag;
    if (is_one_of(s->w->waves, s->w->wave, q)) {
        nh_expr_set_put(l, nh_call(d, NH_COS, q));
        nh_expr_set_put(l, nh_call(d, NH_SIN, q));
        return;
    }
    for (size_t i = 0; i < s->w->atoms; i++) {
        if (!of_one(s, s->w->atom[i], q)) continue;
        put_tame(s, l, s->w->atom[i], q);
        put_tame(s, l, nh_simplify(d, nh_diff(d, s->w->atom[i], q)), q);
    }
}

nh_expr_set nh_expr_set_one_coordinate(const nh_family_list *s)
{
    enum { most_each = 7 };
    nh_dag *d = s->o->dag;
    nh_expr_set all = {0};
    nh_expr_set_put(&all, nh_int(d, 1));
    for (size_t i = 0; i < s->w->positions; i++) {
        nh_expr_set own = {0};
        put_factors(s, s->w->position[i], &own);
        size_t n = all.n;
        for (size_t j = 0; j < own.n && j < most_each; j++)
            for (size_t k = 0; k < n; k++) nh_expr_set_put(&all, nh_mul(d, all.e[k], own.e[j]));
    }
    return all;
}

/* Parabolic coordinates are r cos^2(q/2), r sin^2(q/2): integrals that separate in them are quadratic in the frame
 * times lengths and half angles. */
void nh_stage_half_angles(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set half = {0}, f = {0}, l = nh_expr_set_lengths(s, false, false), ll = nh_expr_set_lengths(s, true, false);
    if (s->w->waves != 1 || s->w->frames != s->o->n || s->o->k) return;
    for (int k = 1; k <= 3; k += 2) {
        nh_ex angle = nh_mul(d, nh_ratio(d, k, 2), s->w->wave[0]);
        nh_expr_set_put(&half, nh_call(d, NH_COS, angle));
        nh_expr_set_put(&half, nh_call(d, NH_SIN, angle));
    }
    nh_expr_set_put_all(&f, s->w->frames, s->w->frame);
    nh_expr_set ff = nh_expr_set_squares(s, &f);
    nh_family_list_add(s,
                       nh_family_list_product(s, 3,
                                              (nh_family[]){nh_family_list_terms(s, &ff), nh_family_list_terms(s, &l),
                                                            nh_family_list_terms(s, &half)}));
    nh_family_list_product_of_sets(s, &ll, &half);
}

/* Functions count as two velocities, as in the energy. */
void nh_stage_cubic(nh_family_list *s)
{
    nh_dag *d = s->o->dag;
    nh_expr_set v = {0}, cubes = {0}, q = nh_expr_set_positions(s, false, false), f = nh_expr_set_functions(s, false);
    bool few = s->w->positions <= 2;
    if (s->w->positions > 3 || s->w->waves || s->o->n < 2 || f.n == 0) return;
    nh_expr_set_put_all(&v, s->o->n, s->o->chart->w);
    nh_expr_set vv = nh_expr_set_squares(s, &v);
    for (size_t i = 0; i < vv.n; i++)
        for (size_t j = 0; j < v.n; j++) nh_expr_set_put(&cubes, nh_mul(d, vv.e[i], v.e[j]));
    nh_family_list_add(
        s, nh_family_list_product(s, 2,
                                  (nh_family[]){nh_family_list_terms(s, &cubes), nh_family_list_polynomial(s, &q, 1)}));
    nh_family_list_add(s, nh_family_list_product(s, 3,
                                                 (nh_family[]){nh_family_list_terms(s, &v), nh_family_list_terms(s, &f),
                                                               nh_family_list_polynomial(s, &q, few ? 2 : 1)}));
}

/* ---- polynomial potentials ---- */

/* The degree of the potential, as a polynomial in the coordinates; 0 when it is none, or of a degree above six. */
static size_t degree_of_potential(const nh_family_list *s)
{
    enum { highest = 6, longest = 200 };
    const nh_model *o = s->o;
    nh_dag *d = o->dag;
    nh_ex *to = nh_arena_alloc(s->arena, (2 * o->m + 1) * sizeof *to),
          *from = nh_arena_alloc(s->arena, (2 * o->m + 1) * sizeof *from), scale = nh_symbol_fresh(d, "s");
    for (size_t i = 0; i < o->m; i++) {
        from[i] = o->system->coordinate[i].q;
        from[o->m + i] = o->system->coordinate[i].v;
        to[i] = nh_mul(d, scale, from[i]);
        to[o->m + i] = nh_int(d, 0);
    }
    nh_ex V = nh_substitute(d, o->system->lagrangian, 2 * o->m, from, to);
    if (nh_complexity(d, V) > longest) return 0;
    for (size_t degree = 0; degree <= highest; degree++) {
        V = nh_simplify(d, nh_diff(d, V, scale));
        if (nh_is_zero(d, V)) return degree;
    }
    return 0;
}

/* All products of e[i..n-1] of exactly this degree, times `so_far`. */
static void monomials(nh_dag *d, size_t n, const nh_ex *e, size_t degree, nh_ex so_far, nh_ex *out, size_t *count,
                      size_t most)
{
    if (*count >= most) return;
    if (degree == 0 || n == 0) {
        if (degree == 0) out[(*count)++] = so_far;
        return;
    }
    for (size_t k = 0; k <= degree; k++)
        monomials(d, n - 1, e + 1, degree - k, nh_mul(d, so_far, nh_powi(d, e[0], (int64_t)k)), out, count, most);
}

/* With weight d for velocities and 2 for positions the energy of a potential of degree d has weight 2d; integrals of
 * degree four in the velocities have 4d.  Lower weights are needed where the potential has lower terms. */
void nh_stage_homogeneous(nh_family_list *s)
{
    enum { highest = 4, most = 900 };
    const nh_model *o = s->o;
    size_t degree = o->k || s->w->frames || s->w->waves || s->w->atoms ? 0 : degree_of_potential(s), count = 0;
    if (degree < 3 || o->m > 3) return;
    nh_ex *term = nh_arena_alloc(s->arena, (most + 1) * sizeof *term),
          *part = nh_arena_alloc(s->arena, (most + 1) * sizeof *part);
    for (size_t of_v = 0; of_v <= highest; of_v++)
        for (size_t of_q = 0; 2 * of_q + degree * of_v <= degree * highest; of_q++) {
            size_t n = 0;
            monomials(o->dag, o->n, o->chart->w, of_v, nh_int(o->dag, 1), part, &n, most);
            for (size_t i = 0; i < n; i++)
                monomials(o->dag, s->w->positions, s->w->position, of_q, part[i], term, &count, most);
        }
    if (count < most) nh_family_list_add(s, (nh_family){.kind = NH_TERMS, .terms = count, .term = term});
}

