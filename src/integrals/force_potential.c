/* The potential of forces, coordinate by coordinate: U_1 = int Q_1 dq^1, U_2 = int (Q_2 - dU_1/dq^2) dq^2, ... */
#include "integrals/force_potential.h"

#include <math.h>
#include <string.h>

#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "exact/walls.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"

enum { largest_form = 2000 };

typedef struct {
    const nh_model *o;
    const nh_points *points;
    size_t max_terms;
    const nh_ex *force;  /* m */
    nh_wall_sides sides; /* of functions of velocities */
} problem;

static bool has_velocities(const nh_model *model, nh_ex e)
{
    for (size_t s = 0; s < model->m; s++)
        if (nh_depends(model->dag, e, model->system->coordinate[s].v)) return true;
    return false;
}

static nh_ex side_of_velocities(void *problem_, nh_ex u)
{
    problem *p = problem_;
    return has_velocities(p->o, u) ? nh_walls_side(&p->sides, u) : 0;
}

/* |u| = u sign(u); every sign(u) of velocities becomes a symbol. */
static bool fix_signs(problem *p, nh_ex *e)
{
    nh_dag *d = p->o->dag;
    *e = nh_walls_piece(d, *e, side_of_velocities, p);
    /* 1/s = s */
    for (size_t k = 0; k < p->sides.count; k++)
        *e = nh_substitute(d, *e, 1, &(nh_ex){nh_powi(d, p->sides.symbol[k], -1)}, &p->sides.symbol[k]);
    *e = nh_simplify_short(d, *e, largest_form);
    return !p->sides.left_out && !has_velocities(p->o, *e) && !nh_depends(d, *e, p->o->system->t);
}

/* dQ_i/dq^j = dQ_j/dq^i for all pairs? */
static bool is_closed(const problem *p)
{
    nh_dag *d = p->o->dag;
    const nh_coordinate *c = p->o->system->coordinate;
    for (size_t i = 0; i < p->o->m; i++)
        for (size_t j = 0; j < i; j++) {
            nh_ex curl = nh_sub(d, nh_diff(d, p->force[i], c[j].q), nh_diff(d, p->force[j], c[i].q));
            if (!nh_is_zero(d, nh_simplify_short(d, curl, largest_form))) return false;
        }
    return true;
}

/* The sign of e at all points; 0 where it changes, or there are none. */
static int sign_at_points(void *context, nh_ex e)
{
    const problem *p = context;
    if (!p->points) return 0;
    double *value = nh_alloc_array(p->points->count + 1, sizeof *value);
    e = nh_walls_signs(&p->sides, e);
    nh_points_evaluate(p->points, p->o, 1, &e, value);
    int sign = 0;
    bool same = true;
    for (size_t i = 0; i < p->points->count && same; i++) {
        int here = (value[i] > 0) - (value[i] < 0);
        same = here && (i == 0 || here == sign) && isfinite(value[i]);
        sign = here;
    }
    nh_free(value);
    return same ? sign : 0;
}

/* Along the coordinates in the order of `step`: 1, or -1 from the last one. */
static nh_ex integrate(problem *p, int step)
{
    const nh_model *o = p->o;
    nh_dag *d = o->dag;
    size_t parameters = o->system->parameters, n = parameters + p->sides.count;
    nh_ex U = nh_int(d, 0), *constant = nh_alloc_array(n + o->m + 2, sizeof *constant);
    memcpy(constant, o->parameter, parameters * sizeof *constant);
    memcpy(constant + parameters, p->sides.symbol, p->sides.count * sizeof *constant);
    bool found = true;
    for (size_t k = 0; k < o->m && found; k++) {
        size_t i = step > 0 ? k : o->m - 1 - k, constants = n;
        nh_ex q = o->system->coordinate[i].q, F = 0,
              rest = nh_simplify_short(d, nh_sub(d, p->force[i], nh_diff(d, U, q)), largest_form);
        for (size_t j = 0; j < o->m; j++)
            if (j != i) constant[constants++] = o->system->coordinate[j].q;
        constant[constants++] = o->system->t;
        if (nh_is_zero(d, rest)) continue;
        nh_integration in = {.dag = d,
                             .x = q,
                             .constants = constants,
                             .constant = constant,
                             .max_terms = p->max_terms,
                             .sign = sign_at_points,
                             .context = p};
        found = nh_antiderivative(&in, rest, &F);
        if (found) U = nh_add(d, U, F);
    }
    nh_free(constant);
    return found ? nh_walls_signs(&p->sides, U) : 0;
}

/* In the order of the file, or else in the opposite one: one of them may have simpler integrals. */
static nh_ex potential(problem *p)
{
    if (!is_closed(p)) return 0;
    nh_ex U = integrate(p, 1);
    return U ? U : integrate(p, -1);
}

nh_ex nh_force_potential(const nh_model *model, const nh_points *points, size_t max_terms)
{
    if (!model->system->has_forces) return 0;
    problem p = {.o = model, .points = points, .max_terms = max_terms, .sides.dag = model->dag};
    nh_ex *force = nh_alloc_array(model->m + 1, sizeof *force);
    p.force = force;
    bool some = false, position = true;
    for (size_t s = 0; s < model->m && position; s++) {
        force[s] = model->system->force[s];
        position = fix_signs(&p, &force[s]);
        some |= !nh_is_zero(model->dag, force[s]);
    }
    nh_ex U = some && position ? potential(&p) : 0;
    nh_free(force);
    return U;
}

nh_ex nh_force_potential_of(const nh_model *model, const nh_points *points, size_t max_terms, const nh_ex *form)
{
    problem p = {.o = model, .points = points, .max_terms = max_terms, .force = form, .sides.dag = model->dag};
    return potential(&p);
}
