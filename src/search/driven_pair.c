/* A stage of the search, for two states with linear equations and a drive:
 *
 *     z1' = a z1 + b z2 + g1(t),   z2' = c z1 + d z2 + g2(t),   l = (c, lambda - a):  l A = lambda l
 *     exp(-lambda t) l . z - int exp(-lambda t) l . g dt
 *
 * for both lambda; with lambda = h +- i s the real and the imaginary part of it.  The integral is exact, in resonance
 * too, where the functions of t that an ansatz needs are nearly dependent on a short interval. */
#include "exact/normal.h"
#include "search/stage_solver.h"

/* f . z - int f . g dt; false where the integral has no closed form. */
static bool keep(nh_stage_solver *x, const nh_driven_pair *p, const nh_ex f[2], size_t *found)
{
    const nh_model *o = x->r->model;
    nh_dag *d = o->dag;
    nh_ex drive = nh_add(d, nh_mul(d, f[0], p->drive[0]), nh_mul(d, f[1], p->drive[1])), F;
    nh_ex state = nh_add(d, nh_mul(d, f[0], p->state[0]), nh_mul(d, f[1], p->state[1]));
    if (!nh_stage_solver_integral(x, o->system->t, nh_simplify_short(d, drive, 0), false, &F)) return false;
    *found += nh_stage_solver_certify(x, nh_sub(d, state, F), "two states with linear equations and a drive");
    return true;
}

/* exp(-h t) (cos(s t) u + sin(s t) v), or with v and -u in their places. */
static nh_ex turned(nh_dag *d, nh_ex decay, nh_ex angle, nh_ex u, nh_ex v)
{
    return nh_mul(d, decay,
                  nh_add(d, nh_mul(d, nh_call(d, NH_COS, angle), u), nh_mul(d, nh_call(d, NH_SIN, angle), v)));
}

size_t nh_driven_pair_search(nh_stage_solver *x, const nh_driven_pair *p)
{
    nh_dag *d = x->r->model->dag;
    nh_ex t = x->r->system->t, zero = nh_int(d, 0);
    size_t found = 0;
    if (p->turns) {
        nh_ex decay = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, p->half, t))), angle = nh_mul(d, p->apart, t);
        nh_ex u[2] = {p->c, nh_sub(d, p->half, p->a)}, v[2] = {zero, p->apart}, f[2];
        for (int part = 0; part < 2 && !nh_stage_solver_done(x); part++) {
            for (size_t i = 0; i < 2; i++)
                f[i] = part ? turned(d, decay, angle, v[i], nh_neg(d, u[i])) : turned(d, decay, angle, u[i], v[i]);
            if (!keep(x, p, f, &found)) break;
        }
        return found;
    }
    for (int side = -1; side <= 1 && !nh_stage_solver_done(x); side += 2) {
        nh_ex lambda = nh_add(d, p->half, nh_mul(d, nh_int(d, side), p->apart));
        nh_ex decay = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, lambda, t)));
        nh_ex f[2] = {nh_mul(d, decay, p->c), nh_mul(d, decay, nh_sub(d, lambda, p->a))};
        if (!keep(x, p, f, &found)) break;
    }
    return found;
}
