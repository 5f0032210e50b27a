/* Roots whose product is a root of a square. */
#include "geometry/model.h"

#include <float.h>

#include "exact/ball.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/node.h"

/* All pairs of radicands in L are tried: their product, simplified, has to be y^2 (times 1), and y must have one sign
 * at the probes. */
void nh_model_pair_roots(nh_model *model)
{
    enum { most = 8, most_pairs = most * (most - 1) / 2 };
    nh_dag *d = model->dag;
    NH_LIST(base);
    nh_ex outside, inside;
    size_t n = model->chart->probes ? nh_radicands_in(d, model->system->lagrangian, &base) : 0;
    if (n < 2 || n > most) return;
    nh_paired_root *pair = nh_arena_alloc(model->arena, most_pairs * sizeof *pair);
    for (size_t k = 1; k < n; k++)
        for (size_t i = 0; i < k; i++) {
            nh_ex both = nh_simplify_short(d, nh_mul(d, base[i], base[k]), 0);
            bool square = nh_square_split(d, both, &outside, &inside) && nh_is_number(d, inside, 1);
            int sign = square && nh_kind_of(d, outside) != NH_NUMBER ? nh_model_sign(model, outside) : 0;
            if (sign) pair[model->pairs++] = (nh_paired_root){base[i], base[k], outside, sign};
        }
    model->pair = pair;
}

/* The second root of each pair becomes sign y/(the first root): then the normal form knows of one root only. */
nh_ex nh_model_paired_roots(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    for (size_t k = 0; k < model->pairs; k++) {
        nh_ex product = nh_mul(d, nh_int(d, model->pair[k].sign), model->pair[k].product);
        e = nh_substitute_root(d, e, model->pair[k].second, nh_div(d, product, nh_sqrt(d, model->pair[k].first)));
    }
    return e;
}

/* The sign of e by ball arithmetic at the first probe, or with every symbol in [-DBL_MAX/4, DBL_MAX/4]: rigorous
 * where it is not 0. */
static int sign_where(const nh_model *model, nh_ex e, bool everywhere)
{
    enum { bits = 400 };
    const nh_chart *c = model->chart;
    nh_ball *ball = nh_ball_create(model->dag, bits);
    double middle, radius;
    e = nh_model_values(model, e);
    for (size_t k = 0; k < c->width && c->probes; k++)
        if (everywhere) nh_ball_set_between(ball, c->symbol[k], -DBL_MAX / 4, DBL_MAX / 4);
        else nh_ball_set_double(ball, c->symbol[k], c->probe[k]);
    bool known = nh_ball_value(ball, e, &middle, &radius) && (middle > radius || middle < -radius);
    nh_ball_free(ball);
    return !known ? 0 : middle > 0 ? 1 : -1;
}

int nh_model_sign_at_probe(const nh_model *model, nh_ex e) { return sign_where(model, e, false); }
int nh_model_sign_everywhere(const nh_model *model, nh_ex e) { return sign_where(model, e, true); }
