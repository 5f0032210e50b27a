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
