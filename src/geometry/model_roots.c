/* Roots whose product is a root of a square. */
#include "geometry/model.h"

#include "exact/normal.h"
#include "exact/square.h"

void nh_model_pair_roots(nh_model *o)
{
    enum { most = 8, most_pairs = most * (most - 1) / 2 };
    nh_dag *d = o->dag;
    NH_LIST(base);
    nh_ex outside, inside;
    size_t n = o->chart->probes ? nh_radicands_in(d, o->system->lagrangian, &base) : 0;
    if (n < 2 || n > most) return;
    nh_paired_root *pair = nh_arena_alloc(o->arena, most_pairs * sizeof *pair);
    for (size_t k = 1; k < n; k++)
        for (size_t i = 0; i < k; i++) {
            nh_ex both = nh_simplify_short(d, nh_mul(d, base[i], base[k]), 0);
            bool square = nh_square_split(d, both, &outside, &inside) && nh_is_number(d, inside, 1);
            int sign = square && nh_kind_of(d, outside) != NH_NUMBER ? nh_model_sign(o, outside) : 0;
            if (sign) pair[o->pairs++] = (nh_paired_root){base[i], base[k], outside, sign};
        }
    o->pair = pair;
}

nh_ex nh_model_paired_roots(const nh_model *o, nh_ex e)
{
    nh_dag *d = o->dag;
    for (size_t k = 0; k < o->pairs; k++) {
        nh_ex product = nh_mul(d, nh_int(d, o->pair[k].sign), o->pair[k].product);
        e = nh_substitute_root(d, e, o->pair[k].second, nh_div(d, product, nh_sqrt(d, o->pair[k].first)));
    }
    return e;
}
