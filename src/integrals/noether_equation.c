#include "integrals/noether_equation.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/diff.h"
#include "graph/measure.h"

enum { longest = 3000 };

static bool has_velocities(const nh_model *o, nh_ex e)
{
    bool any = false;
    for (size_t i = 0; i < o->n; i++) any |= nh_depends(o->dag, e, o->chart->w[i]);
    for (size_t a = 0; a < o->chart->implicit; a++) any |= nh_depends(o->dag, e, o->chart->u[a]);
    for (size_t s = 0; s < o->m; s++) any |= nh_depends(o->dag, e, o->system->coordinate[s].v);
    return any;
}

/* e_t + v^s e_s */
static nh_ex rate(const nh_model *o, nh_ex e)
{
    nh_dag *d = o->dag;
    const nh_coordinate *coordinate = o->system->coordinate;
    nh_ex sum = nh_diff(d, e, o->system->t);
    for (size_t s = 0; s < o->m; s++) sum = nh_add(d, sum, nh_mul(d, coordinate[s].v, nh_diff(d, e, coordinate[s].q)));
    return sum;
}

static nh_ex without_velocities(const nh_model *o, nh_ex e)
{
    nh_ex *zero = nh_alloc_array(o->n + 1, sizeof *zero);
    for (size_t i = 0; i < o->n; i++) zero[i] = nh_int(o->dag, 0);
    e = nh_substitute(o->dag, e, o->n, o->chart->w, zero);
    nh_free(zero);
    return e;
}

bool nh_noether_equation(const nh_model *o, nh_ex phi, const nh_ex *zeta, nh_ex *out)
{
    nh_dag *d = o->dag;
    const nh_system *y = o->system;
    nh_ex L = y->lagrangian, P = nh_int(d, 0), *xi = nh_alloc_array(o->m + 1, sizeof *xi);
    bool good = !o->chart->implicit && nh_complexity_within(d, L, longest);
    for (size_t s = 0; s < o->m && good; s++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t i = 0; i < o->n; i++) sum = nh_add(d, sum, nh_mul(d, o->R[s * o->n + i], zeta[i]));
        xi[s] = nh_simplify_short(d, sum, 0);
        P = nh_add(d, P, nh_mul(d, xi[s], nh_diff(d, L, y->coordinate[s].v)));
        good = !has_velocities(o, xi[s]);
    }
    if (good) {
        nh_ex G = nh_simplify_short(d, without_velocities(o, nh_sub(d, phi, nh_model_compose(o, P))), 0);
        *out = rate(o, G);
        for (size_t s = 0; s < o->m; s++) {
            nh_ex q = nh_add(d, nh_diff(d, L, y->coordinate[s].q), y->has_forces ? y->force[s] : nh_int(d, 0));
            *out = nh_add(d, *out, nh_mul(d, xi[s], q));
            *out = nh_add(d, *out, nh_mul(d, rate(o, xi[s]), nh_diff(d, L, y->coordinate[s].v)));
        }
    }
    nh_free(xi);
    return good;
}
