#include "geometry/model_internal.h"
#include "graph/dag.h"

#include "graph/diff.h"

/* The orientation to which coordinate a belongs, where the model has a frame; else NULL.  Of an orientation the three
 * coordinates first, first + 1, first + 2 are its parameters s, and its rates are three angular velocities.
 * [docs/method.md, (8b)] */
static const nh_orientation *turned(const nh_model *model, size_t a)
{
    return model->framed ? nh_orientation_of(model->system, a) : NULL;
}

void nh_frame_open(nh_model *model)
{
    const nh_system *system = model->system;
    model->frame_rho = model->rho;
    model->frame_R = model->R;
    model->frame_p = model->p;
    model->framed = model->chart->framed && system->orientations && system->framed_of == system->lagrangian;
    if (!model->framed) return;
    model->frame_rho = model->chart->framed;
    model->frame_R = nh_arena_alloc(model->arena, (model->m * model->n + 1) * sizeof(nh_ex));
    model->frame_p = nh_arena_alloc(model->arena, (model->m + 1) * sizeof(nh_ex));
}

nh_ex nh_frame_rate(const nh_model *model, size_t a)
{
    const nh_orientation *r = turned(model, a);
    return r ? r->framed[a - r->first] : model->system->coordinate[a].v;
}

nh_ex nh_frame_lagrangian(const nh_model *model)
{
    return model->framed ? model->system->framed : model->system->lagrangian;
}

nh_ex nh_frame_compose(const nh_model *model, nh_ex e)
{
    if (!model->framed) return nh_model_compose(model, e);
    nh_ex *rate = nh_alloc_array(model->m + 1, sizeof *rate);
    for (size_t a = 0; a < model->m; a++) rate[a] = nh_frame_rate(model, a);
    e = nh_substitute(model->dag, e, model->m, rate, model->frame_rho);
    nh_free(rate);
    return e;
}

/* A covector of (q), m components c_s, along e_a: e_a^s = map[s][a], so that s' = map (angular velocity). */
nh_ex nh_frame_along(const nh_model *model, size_t a, const nh_ex *c)
{
    const nh_orientation *r = turned(model, a);
    if (!r) return c[a];
    nh_ex sum = nh_int(model->dag, 0);
    for (size_t i = 0; i < 3; i++)
        sum = nh_add(model->dag, sum, nh_mul(model->dag, r->map[3 * i + (a - r->first)], c[r->first + i]));
    return sum;
}

/* Back from the frame to coordinates: beta^k_s = d(rate k)/dv^s, because the rates are linear in v. */
void nh_frame_covector(const nh_model *model, const nh_ex *c, nh_ex *out)
{
    for (size_t s = 0; s < model->m; s++) {
        const nh_orientation *r = turned(model, s);
        out[s] = r ? nh_int(model->dag, 0) : c[s];
        for (size_t k = 0; k < 3 && r; k++) {
            nh_ex slope = nh_diff(model->dag, r->rate[k], model->system->coordinate[s].v);
            out[s] = nh_add(model->dag, out[s], nh_mul(model->dag, slope, c[r->first + k]));
        }
    }
}

/* -C^a_bc p_a x^b y^c: -p.(x cross y) of angular velocities in the body, p.(x cross y) of those in space. */
nh_ex nh_frame_turn(const nh_model *model, const nh_ex *x, size_t x_stride, const nh_ex *y, size_t y_stride)
{
    nh_dag *d = model->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < model->system->orientations && model->framed; i++) {
        const nh_orientation *r = &model->system->orientation[i];
        for (size_t k = 0; k < 3; k++) {
            size_t a = r->first + (k + 1) % 3, b = r->first + (k + 2) % 3;
            nh_ex cross = nh_sub(d, nh_mul(d, x[a * x_stride], y[b * y_stride]),
                                 nh_mul(d, x[b * x_stride], y[a * y_stride])),
                  term = nh_mul(d, model->frame_p[r->first + k], cross);
            sum = r->space ? nh_add(d, sum, term) : nh_sub(d, sum, term);
        }
    }
    return sum;
}

nh_ex nh_frame_slope(const nh_model *model, size_t a, size_t b)
{
    nh_ex f = model->framed ? model->system->constraint[a].framed : nh_chart_constraint(model->chart, a);
    return nh_frame_compose(model, nh_diff(model->dag, f, nh_frame_rate(model, b)));
}

nh_ex nh_frame_turn_along(const nh_model *model, size_t s)
{
    nh_ex zero = nh_int(model->dag, 0), *e = nh_alloc_array(model->m + 1, sizeof *e);
    for (size_t a = 0; a < model->m; a++) e[a] = a == s ? nh_int(model->dag, 1) : zero;
    nh_ex turn = model->framed ? nh_frame_turn(model, e, 1, model->frame_rho, 1) : zero;
    nh_free(e);
    return turn;
}
