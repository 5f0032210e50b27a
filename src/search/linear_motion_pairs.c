/* Linear equations of two states, or of two coordinates: rates as formulas. */
#include "search/linear_motion_internal.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

typedef nh_linear_motion_block linear;

size_t nh_linear_motion_waves(nh_dag *d, nh_ex t, nh_ex re, nh_ex im, nh_ex out[2])
{
    nh_ex decay = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, re, t))), angle = nh_mul(d, im, t);
    out[0] = decay;
    if (nh_is_zero(d, im)) return 1;
    out[0] = nh_mul(d, decay, nh_call(d, NH_COS, angle));
    out[1] = nh_mul(d, decay, nh_call(d, NH_SIN, angle));
    return 2;
}

/* sqrt(e) or -sqrt(e), whichever has no root: w for w^2.  Both are rates. */
static nh_ex either_root(nh_dag *d, nh_ex e)
{
    if (nh_kind_of(d, e) != NH_PRODUCT || nh_num_value(nh_constant_of(d, e)) < 0) return nh_sqrt(d, e);
    nh_ex root = nh_sqrt(d, nh_number(d, nh_constant_of(d, e)));
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex exponent = nh_exponent_of(d, e, i);
        nh_num x = nh_kind_of(d, exponent) == NH_NUMBER ? nh_number_of(d, exponent) : nh_num_real(0.5);
        if (!nh_num_short(x) || x.q != 1 || x.p % 2) return nh_sqrt(d, e);
        root = nh_mul(d, root, nh_powi(d, nh_child(d, e, i), x.p / 2));
    }
    return root;
}

size_t nh_linear_motion_waves_of_two(const linear *l, bool turns, nh_ex out[2])
{
    nh_dag *d = l->x->r->question->model->dag;
    size_t i = l->of[0], j = l->of[1], n = l->size;
    const nh_ex *e = l->entry;
    nh_ex t = l->x->r->question->system->t;
    nh_ex half = nh_mul(d, nh_ratio(d, 1, 2), nh_add(d, e[i + i * n], e[j + j * n]));
    nh_ex D = nh_sub(d, nh_mul(d, e[i + i * n], e[j + j * n]), nh_mul(d, e[i + j * n], e[j + i * n]));
    nh_ex square = nh_simplify_short(d, nh_sub(d, nh_mul(d, half, half), D), 0);
    nh_ex apart = either_root(d, turns ? nh_neg(d, square) : square);
    if (turns) return nh_linear_motion_waves(d, t, half, apart, out);
    out[0] = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, nh_add(d, half, apart), t)));
    out[1] = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, nh_sub(d, half, apart), t)));
    return out[0] == out[1] ? 1 : 2;
}

bool nh_linear_motion_complex_pair(const linear *l, nh_complex_pair *out)
{
    const nh_model *model = l->x->r->question->model;
    size_t n = 0, v[2], q[2];
    bool is = l->count == 4 && l->drives == 1;
    for (size_t k = 0; k < l->count && is; k++) {
        size_t i = l->of[k];
        is = nh_is_zero(model->dag, l->b[i]);
        if (i >= l->places) continue;
        is = is && n < 2 && nh_linear_motion_velocity(l, i, &v[n]);
        if (is) q[n++] = i;
    }
    if (!is || n != 2) return false;
    for (size_t a = 0; a < 2; a++) {
        out->q[a] = l->z[q[a]];
        out->v[a] = l->z[v[a]];
        for (size_t c = 0; c < 2; c++) {
            out->C[a + 2 * c] = l->entry[v[a] + v[c] * l->size];
            out->K[a + 2 * c] = l->entry[v[a] + q[c] * l->size];
        }
    }
    return true;
}
