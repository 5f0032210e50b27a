#include "integrals/continued.h"

#include <math.h>

#include "exact/normal.h"
#include "exact/square.h"
#include "system/sample.h"

/* 1 or -1: the sign of a quotient at a point of the box where it has one; 0 where none was found. */
static int sign_in_box(const nh_model *o, nh_ex quotient, uint64_t state)
{
    enum { tries = 20 };
    const nh_chart *c = o->chart;
    nh_tape *tape = nh_model_tape(o, 1, &quotient);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *z = nh_alloc_array(o->width, sizeof *z), value = NAN;
    for (int k = 0; k < tries && !(isfinite(value) && value != 0); k++) {
        for (size_t j = 0; j < o->width; j++) z[j] = c->low[j] + (c->high[j] - c->low[j]) * nh_random(&state);
        if (nh_chart_complete(c, z)) nh_tape_eval(tape, work, z, &value);
    }
    nh_free(z);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return !isfinite(value) || value == 0 ? 0 : value > 0 ? 1 : -1;
}

/* base = outside^2 inside, by its numerator and what stands below it; false where there is no square. */
static bool take_out(nh_dag *d, nh_ex base, nh_ex *outside, nh_ex *inside)
{
    nh_ex out[2], in[2];
    nh_ex top = nh_numerator(d, base);
    if (!nh_square_split(d, nh_simplify_short(d, top, 0), &out[0], &in[0])
        || !nh_square_split(d, nh_simplify_short(d, nh_div(d, top, base), 0), &out[1], &in[1])) return false;
    *outside = nh_div(d, out[0], out[1]);
    *inside = nh_simplify_short(d, nh_div(d, in[0], in[1]), 0);
    return nh_kind_of(d, *outside) != NH_NUMBER;
}

nh_ex nh_continued_roots(const nh_model *o, nh_ex phi, uint64_t seed)
{
    enum { most = 64 };
    nh_dag *d = o->dag;
    nh_ex product[most], outside, inside;
    size_t n = nh_products_in(d, phi, product, most);
    for (size_t i = 0; i < n && i < most; i++)
        for (size_t f = 0; f < nh_arity(d, product[i]); f++) {
            nh_ex base = nh_child(d, product[i], f), x = nh_exponent_of(d, product[i], f);
            bool half = nh_kind_of(d, x) == NH_NUMBER && nh_number_of(d, x).q == 2;
            if (!half || nh_kind_of(d, base) == NH_NUMBER || nh_kind_of(d, base) == NH_SYMBOL) continue;
            if (!take_out(d, base, &outside, &inside)) continue;
            nh_ex root = nh_mul(d, outside, nh_sqrt(d, inside));
            int sign = sign_in_box(o, nh_div(d, root, nh_sqrt(d, base)), seed);
            if (sign) phi = nh_substitute_root(d, phi, base, sign > 0 ? root : nh_neg(d, root));
        }
    return phi;
}

nh_ex nh_continued_arctangents(const nh_model *o, nh_ex phi)
{
    enum { most = 64 };
    nh_dag *d = o->dag;
    nh_ex call[most], by[most];
    size_t n = nh_functions_in(d, phi, call, most), count = 0;
    for (size_t i = 0; i < n && i < most; i++) {
        if (nh_function_of(d, call[i]) != NH_ATAN) continue;
        nh_ex turned = nh_simplify_short(d, nh_div(d, nh_int(d, 1), nh_child(d, call[i], 0)), 0);
        by[count] = nh_neg(d, nh_call(d, NH_ATAN, turned));
        call[count++] = call[i];
    }
    return nh_substitute(d, phi, count, call, by);
}
