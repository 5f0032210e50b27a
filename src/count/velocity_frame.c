/* Factors of velocities from the diagonal of the inertia. */
#include "count/velocity_frame.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/terms.h"

enum { largest_form = 2000 };

/* e with its sums divided by the common factor of their terms, which stands before them. */
static nh_ex factored(nh_dag *d, nh_ex e)
{
    nh_ex out = e;
    for (size_t k = 0; nh_kind_of(d, e) == NH_PRODUCT && k < nh_arity(d, e); k++) {
        nh_ex base = nh_child(d, e, k), x = nh_exponent_of(d, e, k);
        if (nh_kind_of(d, base) == NH_SUM)
            out = nh_mul(d, nh_div(d, out, nh_pow(d, base, x)), nh_pow(d, factored(d, base), x));
    }
    if (nh_kind_of(d, e) != NH_SUM) return out;
    nh_ex common = nh_terms_common(d, e);
    return nh_is_number(d, common, 1) ? e : nh_mul(d, common, nh_simplify_short(d, nh_div(d, e, common), largest_form));
}

/* The root of the part of e that is a square of functions of the coordinates. */
static nh_ex root_of(nh_jet_equations *x, nh_ex e)
{
    nh_dag *d = x->dag;
    nh_ex root = nh_int(d, 1), simple = factored(d, nh_simplify_short(d, e, largest_form));
    if (nh_kind_of(d, simple) != NH_PRODUCT) return root;
    for (size_t k = 0; k < nh_arity(d, simple); k++) {
        nh_ex base = nh_child(d, simple, k), exponent = nh_exponent_of(d, simple, k);
        if (nh_kind_of(d, exponent) != NH_NUMBER) continue;
        nh_num power = nh_number_of(d, exponent);
        bool position = false;
        for (size_t j = 0; j < x->coordinates; j++) position |= nh_depends(d, base, x->coordinate[j]);
        if (position && nh_num_short(power) && power.q == 1 && power.p % 2 == 0)
            root = nh_mul(d, root, nh_powi(d, base, power.p / 2));
    }
    return root;
}

nh_velocity_frame nh_velocity_frame_of(nh_jet_equations *x)
{
    nh_velocity_frame f = {.n = x->n, .trivial = true};
    f.shown = nh_alloc_array(x->n + 1, sizeof *f.shown);
    f.value = nh_alloc_array(x->n + 1, sizeof *f.value);
    for (size_t i = 0; i < x->n; i++) {
        size_t kernels = x->point->kernels;
        f.shown[i] = f.value[i] = root_of(x, x->model->M[i * x->n + i]);
        if (!nh_jet_equations_take(x, true, &f.value[i])) {
            x->obstacle = x->point->obstacle = NULL;
            x->point->kernels = kernels;
            f.shown[i] = f.value[i] = nh_int(x->dag, 1);
        }
        f.trivial &= f.shown[i] == nh_int(x->dag, 1);
    }
    return f;
}

void nh_velocity_frame_clear(nh_velocity_frame *f)
{
    nh_free(f->shown);
    nh_free(f->value);
}

nh_ex nh_velocity_frame_monomial(const nh_velocity_frame *f, const nh_jet_equations *x, const uint8_t *alpha)
{
    nh_ex e = nh_int(x->dag, 1);
    for (size_t i = 0; i < f->n; i++)
        e = nh_mul(x->dag, e, nh_powi(x->dag, nh_mul(x->dag, f->shown[i], x->w[i]), alpha[i]));
    return e;
}

/* 1/f_i */
static bool reciprocals(const nh_velocity_frame *f, nh_jet_equations *x, const nh_jet_ring *ring,
                        const nh_residue *coordinate, nh_residue *out)
{
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    nh_residue *series = nh_alloc_array(ring->size, sizeof *series);
    bool good = true;
    for (size_t i = 0; i < f->n && good; i++) {
        good = nh_jet_eval_all(v, 1, &f->value[i], series) && series[0];
        if (good)
            nh_jet_power(ring, series, nh_residue_sub(ring->field, 0, 1), nh_residue_inverse(ring->field, series[0]),
                         out + i * ring->size);
    }
    nh_free(series);
    nh_jet_eval_free(v);
    return good;
}

bool nh_velocity_frame_apply(const nh_velocity_frame *f, nh_jet_equations *x, const nh_jet_ring *ring,
                             const nh_residue *coordinate, nh_graded_count *g, double *work)
{
    size_t N = g->total[g->order], size = ring->size;
    if (f->trivial || !N) return true;
    nh_residue *inverse = nh_alloc_array(f->n * size + 1, sizeof *inverse),
               *factor = nh_alloc_array(size, sizeof *factor), *a = nh_alloc_array(size, sizeof *a),
               *b = nh_alloc_array(size, sizeof *b);
    bool good = reciprocals(f, x, ring, coordinate, inverse);
    for (size_t alpha = 0; alpha < g->alphas && good; alpha++) {
        nh_jet_constant(ring, 1, factor);
        for (size_t i = 0; i < f->n; i++)
            for (size_t k = 0; k < g->alpha[alpha * f->n + i] && f->shown[i] != nh_int(x->dag, 1); k++) {
                nh_jet_mul(ring, factor, inverse + i * size, a);
                memcpy(factor, a, size * sizeof *a);
            }
        if (nh_jet_is_constant(ring, factor)) continue;
        for (size_t s = 0; s < N; s++) {
            nh_residue *c = g->series + alpha * size * N + s;
            for (size_t e = 0; e < size; e++) a[e] = c[e * N];
            nh_jet_mul(ring, a, factor, b);
            for (size_t e = 0; e < size; e++) c[e * N] = b[e];
        }
        *work += (double)N * (double)ring->pairs[size];
    }
    nh_free(b);
    nh_free(a);
    nh_free(factor);
    nh_free(inverse);
    return good;
}
