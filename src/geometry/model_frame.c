#include "geometry/model_internal.h"
#include "graph/dag.h"

#include "graph/diff.h"

static const nh_orientation *turned(const nh_model *o, size_t a)
{
    return o->framed ? nh_orientation_of(o->system, a) : NULL;
}

void nh_frame_open(nh_model *o)
{
    const nh_system *y = o->system;
    o->frame_rho = o->rho;
    o->frame_R = o->R;
    o->frame_p = o->p;
    o->framed = o->chart->framed && y->orientations && y->framed_of == y->lagrangian;
    if (!o->framed) return;
    o->frame_rho = o->chart->framed;
    o->frame_R = nh_arena_alloc(o->arena, (o->m * o->n + 1) * sizeof(nh_ex));
    o->frame_p = nh_arena_alloc(o->arena, (o->m + 1) * sizeof(nh_ex));
}

nh_ex nh_frame_rate(const nh_model *o, size_t a)
{
    const nh_orientation *r = turned(o, a);
    return r ? r->framed[a - r->first] : o->system->coordinate[a].v;
}

nh_ex nh_frame_lagrangian(const nh_model *o) { return o->framed ? o->system->framed : o->system->lagrangian; }

nh_ex nh_frame_compose(const nh_model *o, nh_ex e)
{
    if (!o->framed) return nh_model_compose(o, e);
    nh_ex *rate = nh_alloc_array(o->m + 1, sizeof *rate);
    for (size_t a = 0; a < o->m; a++) rate[a] = nh_frame_rate(o, a);
    e = nh_substitute(o->dag, e, o->m, rate, o->frame_rho);
    nh_free(rate);
    return e;
}

nh_ex nh_frame_along(const nh_model *o, size_t a, const nh_ex *c)
{
    const nh_orientation *r = turned(o, a);
    if (!r) return c[a];
    nh_ex sum = nh_int(o->dag, 0);
    for (size_t i = 0; i < 3; i++)
        sum = nh_add(o->dag, sum, nh_mul(o->dag, r->map[3 * i + (a - r->first)], c[r->first + i]));
    return sum;
}

void nh_frame_covector(const nh_model *o, const nh_ex *c, nh_ex *out)
{
    for (size_t s = 0; s < o->m; s++) {
        const nh_orientation *r = turned(o, s);
        out[s] = r ? nh_int(o->dag, 0) : c[s];
        for (size_t k = 0; k < 3 && r; k++) {
            nh_ex slope = nh_diff(o->dag, r->rate[k], o->system->coordinate[s].v);
            out[s] = nh_add(o->dag, out[s], nh_mul(o->dag, slope, c[r->first + k]));
        }
    }
}

/* -C^a_bc p_a x^b y^c: -p.(x cross y) of angular velocities in the body, p.(x cross y) of those in space. */
nh_ex nh_frame_turn(const nh_model *o, const nh_ex *x, size_t x_stride, const nh_ex *y, size_t y_stride)
{
    nh_dag *d = o->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < o->system->orientations && o->framed; i++) {
        const nh_orientation *r = &o->system->orientation[i];
        for (size_t k = 0; k < 3; k++) {
            size_t a = r->first + (k + 1) % 3, b = r->first + (k + 2) % 3;
            nh_ex cross = nh_sub(d, nh_mul(d, x[a * x_stride], y[b * y_stride]),
                                 nh_mul(d, x[b * x_stride], y[a * y_stride])),
                  term = nh_mul(d, o->frame_p[r->first + k], cross);
            sum = r->space ? nh_add(d, sum, term) : nh_sub(d, sum, term);
        }
    }
    return sum;
}

nh_ex nh_frame_slope(const nh_model *o, size_t a, size_t b)
{
    nh_ex f = o->framed ? o->system->constraint[a].framed : nh_chart_constraint(o->chart, a);
    return nh_frame_compose(o, nh_diff(o->dag, f, nh_frame_rate(o, b)));
}

nh_ex nh_frame_turn_along(const nh_model *o, size_t s)
{
    nh_ex zero = nh_int(o->dag, 0), *e = nh_alloc_array(o->m + 1, sizeof *e);
    for (size_t a = 0; a < o->m; a++) e[a] = a == s ? nh_int(o->dag, 1) : zero;
    nh_ex turn = o->framed ? nh_frame_turn(o, e, 1, o->frame_rho, 1) : zero;
    nh_free(e);
    return turn;
}
