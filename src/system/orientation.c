#include "system/orientation.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"

/* ---- matrices ---- */

/* The matrix of x -> s cross x. */
static void cross_matrix(nh_dag *d, const nh_ex s[3], nh_ex out[9])
{
    for (int i = 0; i < 9; i++) out[i] = nh_int(d, 0);
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        out[3 * k + j] = s[i];
        out[3 * j + k] = nh_neg(d, s[i]);
    }
}

void nh_orientation_build(nh_dag *d, nh_orientation *o)
{
    const nh_ex *s = o->q, *v = o->v;
    nh_ex turn[9], square = nh_int(d, 0), one = nh_int(d, 1);
    for (int k = 0; k < 3; k++) {
        square = nh_add(d, square, nh_powi(d, s[k], 2));
        o->framed[k] = nh_symbol_fresh(d, o->word[k]);
    }
    cross_matrix(d, s, turn);
    nh_ex inner = nh_sub(d, one, square), outer = nh_add(d, one, square), over = nh_powi(d, outer, -2),
          two = nh_int(d, 2), quarter = nh_ratio(d, 1, 4);
    nh_ex own[9]; /* F of the body */
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            nh_ex ss = nh_mul(d, s[i], s[j]), same = nh_int(d, i == j), w = turn[3 * i + j];
            nh_ex even = nh_add(d, nh_mul(d, inner, same), nh_mul(d, two, ss)), odd = nh_mul(d, two, w);
            own[3 * i + j] = nh_mul(d, quarter, nh_add(d, even, odd));
            o->map[3 * i + j] = nh_mul(d, quarter, o->space ? nh_sub(d, even, odd) : nh_add(d, even, odd));
            nh_ex twice = nh_sub(d, ss, nh_mul(d, square, same)); /* [s]^2 */
            nh_ex sum = nh_add(d, nh_mul(d, nh_int(d, 8), twice), nh_product(d, 3, (nh_ex[]){nh_int(d, 4), inner, w}));
            o->matrix[3 * i + j] = nh_add(d, same, nh_mul(d, sum, over));
        }
    for (int k = 0; k < 3; k++) { /* w = F^-1 s' = 16 F^T s'/(1 + s.s)^2 */
        o->rate[k] = o->body[k] = nh_int(d, 0);
        for (int i = 0; i < 3; i++) {
            o->rate[k] = nh_add(d, o->rate[k], nh_mul(d, o->map[3 * i + k], v[i]));
            o->body[k] = nh_add(d, o->body[k], nh_mul(d, own[3 * i + k], v[i]));
        }
        o->rate[k] = nh_product(d, 3, (nh_ex[]){nh_int(d, 16), over, o->rate[k]});
        o->body[k] = nh_product(d, 3, (nh_ex[]){nh_int(d, 16), over, o->body[k]});
    }
    for (int k = 0; k < 3; k++) { /* R^T w for components in space */
        o->framed_body[k] = o->space ? nh_int(d, 0) : o->framed[k];
        for (int i = 0; i < 3 && o->space; i++)
            o->framed_body[k] = nh_add(d, o->framed_body[k], nh_mul(d, o->matrix[3 * i + k], o->framed[i]));
    }
}

/* ---- printed formulas ---- */

/* The coefficients c_0 and c_ij of e = c_0 + c_ij R_ij where e is linear in the entries.  They follow from the first
 * terms of (1 + s.s)^2 e = p + d_i s_i + h_ij s_i s_j/2 + .. at s = 0, T = c_xx + c_yy + c_zz:
 *
 *     p = c_0 + T,   d_i = 4 (c_kj - c_jk),   h_ij = 8 (c_ij + c_ji),   h_ii/2 = 2 p - 8 T + 8 c_ii. */
static void coefficients_of(nh_dag *d, const nh_ex s[3], nh_ex e, nh_ex *c0, nh_ex c[9])
{
    nh_ex zero[3] = {nh_int(d, 0), nh_int(d, 0), nh_int(d, 0)}, square = nh_int(d, 1), first[3], half[9], sum = zero[0];
    for (int i = 0; i < 3; i++) square = nh_add(d, square, nh_powi(d, s[i], 2));
    nh_ex F = nh_simplify(d, nh_mul(d, e, nh_powi(d, square, 2))), p = nh_substitute(d, F, 3, s, zero);
    for (int i = 0; i < 3; i++) {
        nh_ex slope = nh_diff(d, F, s[i]);
        first[i] = nh_substitute(d, slope, 3, s, zero);
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = nh_div(d, nh_substitute(d, nh_diff(d, slope, s[j]), 3, s, zero), nh_int(d, 2));
        sum = nh_add(d, sum, half[4 * i]);
    }
    nh_ex T = nh_div(d, nh_sub(d, nh_mul(d, nh_int(d, 6), p), sum), nh_int(d, 16)), eight = nh_int(d, 8);
    *c0 = nh_simplify(d, nh_sub(d, p, T));
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        nh_ex own = nh_add(d, nh_sub(d, half[4 * i], nh_mul(d, nh_int(d, 2), p)), nh_mul(d, eight, T)),
              odd = nh_div(d, first[i], eight), even = nh_div(d, half[3 * j + k], eight);
        c[4 * i] = nh_simplify(d, nh_div(d, own, eight));
        c[3 * k + j] = nh_simplify(d, nh_add(d, even, odd));
        c[3 * j + k] = nh_simplify(d, nh_sub(d, even, odd));
    }
}

/* e by the entries of one orientation, where it is linear in them: that is proved. */
static nh_ex shown_by(nh_dag *d, const nh_orientation *o, nh_ex e)
{
    enum { longest = 4000, terms = 4000 };
    nh_ex c0, c[9];
    bool any = false;
    for (size_t k = 0; k < 3; k++) any |= nh_depends(d, e, o->q[k]);
    if (!any || !nh_complexity_within(d, e, longest)) return e;
    coefficients_of(d, o->q, e, &c0, c);
    nh_ex shown = c0, same = c0;
    for (int k = 0; k < 9; k++) {
        shown = nh_add(d, shown, nh_mul(d, c[k], o->entry_symbol[k]));
        same = nh_add(d, same, nh_mul(d, c[k], o->matrix[k]));
    }
    return nh_normal_is_zero(d, nh_sub(d, e, same), terms) == NH_ZERO ? nh_simplify_short(d, shown, 0) : e;
}

/* The largest parts of e that are linear in the entries. */
typedef struct {
    nh_dag *dag;
    const nh_orientation *orientation;
    size_t parts, visits;
    nh_ex part[64], shown[64];
} parts_of;

static void collect(parts_of *p, nh_ex e)
{
    enum { most_visits = 2000 };
    nh_dag *d = p->dag;
    nh_kind kind = nh_kind_of(d, e);
    bool any = false;
    for (size_t k = 0; k < 3; k++) any |= nh_depends(d, e, p->orientation->q[k]);
    if (!any || p->parts == sizeof p->part / sizeof *p->part || ++p->visits > most_visits || kind == NH_SYMBOL) return;
    nh_ex shown = shown_by(d, p->orientation, e);
    if (shown != e) {
        p->part[p->parts] = e;
        p->shown[p->parts++] = shown;
        return;
    }
    for (size_t i = 0; i < nh_arity(d, e); i++) collect(p, nh_child(d, e, i));
}

nh_ex nh_orientation_in_entries(nh_dag *d, const nh_orientation *o, nh_ex e)
{
    parts_of p = {.dag = d, .orientation = o};
    collect(&p, e);
    return nh_substitute(d, e, p.parts, p.part, p.shown);
}
