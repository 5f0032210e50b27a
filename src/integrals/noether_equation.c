/* noether_equation: from zeta to the equation. [docs/method.md, sec. 4, "Proof"]
 *
 *     find_tau      zeta^i = (function of t, q) - tau w^i
 *     component     xi^s = R^s_i (zeta^i + tau w^i) + tau rho^s(w = 0)
 *     G             Phi - xi^s p_s + tau (p_s v^s - L) at w = 0
 *     the sum       work_along + (dxi^s/dt) p_s + tau dL/dt + (xi^s - tau v^s) Q_s + dG/dt */
#include "integrals/noether_equation.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "graph/node.h"

enum { longest = 3000 };

static bool has_velocities(const nh_model *model, nh_ex e)
{
    bool any = false;
    for (size_t i = 0; i < model->n; i++) any |= nh_depends(model->dag, e, model->chart->w[i]);
    for (size_t a = 0; a < model->chart->implicit; a++) any |= nh_depends(model->dag, e, model->chart->u[a]);
    for (size_t s = 0; s < model->m; s++) any |= nh_depends(model->dag, e, model->system->coordinate[s].v);
    return any;
}

/* e_t + v^s e_s */
static nh_ex rate(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    const nh_coordinate *coordinate = model->system->coordinate;
    nh_ex sum = nh_diff(d, e, model->system->t);
    for (size_t s = 0; s < model->m; s++)
        sum = nh_add(d, sum, nh_mul(d, coordinate[s].v, nh_diff(d, e, coordinate[s].q)));
    return sum;
}

static nh_ex without_velocities(const nh_model *model, nh_ex e)
{
    nh_ex *zero = nh_alloc_array(model->n + 1, sizeof *zero);
    for (size_t i = 0; i < model->n; i++) zero[i] = nh_int(model->dag, 0);
    e = nh_substitute(model->dag, e, model->n, model->chart->w, zero);
    nh_free(zero);
    return e;
}

/* zeta^i + tau w^i does not depend on velocities; false: there is no such number. */
static bool find_tau(const nh_model *model, const nh_ex *zeta, nh_ex *tau)
{
    nh_dag *d = model->dag;
    *tau = model->n ? nh_neg(d, nh_diff(d, zeta[0], model->chart->w[0])) : nh_int(d, 0);
    return nh_kind_of(d, *tau) == NH_NUMBER;
}

/* xi^s = R^s_i (zeta^i + tau w^i) + tau rho^s(w = 0), where rho is affine in w. */
static nh_ex component(const nh_model *model, size_t s, const nh_ex *zeta, nh_ex tau)
{
    nh_dag *d = model->dag;
    nh_ex sum = nh_is_zero(d, tau) ? tau : nh_mul(d, tau, without_velocities(model, model->rho[s]));
    for (size_t i = 0; i < model->n; i++) {
        nh_ex own = nh_add(d, zeta[i], nh_mul(d, tau, model->chart->w[i]));
        sum = nh_add(d, sum, nh_mul(d, model->R[s * model->n + i], own));
    }
    return nh_simplify_short(d, sum, 0);
}

/* xi^s dL/dq^s, with components that are equal outside of their sum: forces between bodies cancel in it as they are
 * written, also where all are displaced by t. */
static nh_ex work_along(const nh_model *model, const nh_ex *xi)
{
    nh_dag *d = model->dag;
    nh_ex work = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++) {
        nh_ex sum = nh_int(d, 0);
        size_t first = 0;
        while (xi[first] != xi[s]) first++;
        if (first < s) continue;
        for (size_t r = s; r < model->m; r++)
            if (xi[r] == xi[s])
                sum = nh_add(d, sum, nh_diff(d, model->system->lagrangian, model->system->coordinate[r].q));
        work = nh_add(d, work, nh_mul(d, xi[s], sum));
    }
    return work;
}

bool nh_noether_equation(const nh_model *model, nh_ex phi, const nh_ex *zeta, nh_ex *out)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    nh_ex L = system->lagrangian, tau = 0, *xi = nh_alloc_array(2 * model->m + 1, sizeof *xi), *along = xi + model->m;
    bool good = !model->chart->implicit && nh_complexity_within(d, L, longest) && find_tau(model, zeta, &tau);
    nh_ex P = good ? nh_mul(d, tau, L) : 0;
    for (size_t s = 0; s < model->m && good; s++) {
        xi[s] = component(model, s, zeta, tau);
        along[s] = nh_sub(d, xi[s], nh_mul(d, tau, system->coordinate[s].v));
        P = nh_add(d, P, nh_mul(d, along[s], nh_diff(d, L, system->coordinate[s].v)));
        good = !has_velocities(model, xi[s]);
        for (size_t i = 0; i < model->n; i++) good &= !has_velocities(model, model->R[s * model->n + i]);
    }
    if (good) {
        nh_ex G = nh_simplify_short(d, without_velocities(model, nh_sub(d, phi, nh_model_compose(model, P))), 0);
        *out = nh_add(d, rate(model, G), nh_mul(d, tau, nh_diff(d, L, system->t)));
        *out = nh_add(d, *out, work_along(model, xi));
        for (size_t s = 0; s < model->m; s++) {
            *out = nh_add(d, *out, nh_mul(d, rate(model, xi[s]), nh_diff(d, L, system->coordinate[s].v)));
            if (system->has_forces) *out = nh_add(d, *out, nh_mul(d, along[s], system->force[s]));
        }
    }
    nh_free(xi);
    return good;
}
