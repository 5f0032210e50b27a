#include "reduction/joint.h"

#include <math.h>

#include "base/memory.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "system/sample.h"

struct nh_joint_rates {
    const nh_system *system;
    size_t n;
    nh_twist B[NH_MOST_SCREWS];
    nh_lu *lu; /* of B^T B */
};

size_t nh_joint_basis(nh_dag *d, const nh_chain *c, const nh_joint *j, nh_twist basis[NH_MOST_SCREWS])
{
    bool euler = j->kind == NH_JOINT_SPHERICAL || j->kind == NH_JOINT_FREE;
    for (size_t k = 0; k < j->screws; k++) {
        basis[k] = nh_screw_twist(d, &c->screw[j->first + k]);
        if (!euler || k + 3 < j->screws) continue;
        for (size_t i = 0; i < 3; i++) {
            basis[k].v[i] = nh_int(d, 0);
            basis[k].w[i] = nh_int(d, i == k + 3 - j->screws);
        }
    }
    return j->screws;
}

nh_pose nh_joint_pose(nh_dag *d, const nh_chain *c, const nh_joint *j)
{
    nh_pose a = nh_pose_identity(d);
    for (size_t k = 0; k < j->screws; k++) {
        nh_pose step = nh_screw_pose(d, &c->screw[j->first + k]);
        a = nh_pose_product(d, &a, &step);
    }
    return a;
}

nh_pose nh_joint_at_rest(const nh_system *system, const nh_pose *pose)
{
    nh_dag *d = system->dag;
    size_t n = system->coordinates + 1;
    nh_ex *from = nh_alloc_array(2 * n, sizeof *from), *zero = from + n;
    nh_pose out = *pose;
    for (size_t i = 0; i < n; i++)
        from[i] = i < system->coordinates ? system->coordinate[i].q : system->t, zero[i] = nh_int(d, 0);
    for (int i = 0; i < 9; i++) out.R[i] = nh_substitute(d, out.R[i], n, from, zero);
    for (int i = 0; i < 3; i++) out.p[i] = nh_substitute(d, out.p[i], n, from, zero);
    nh_free(from);
    return out;
}

/* The size of a pivot at one place.  Pivots that vanish identically were removed before; a small one is not zero. */
static double score(void *context, nh_ex e)
{
    enum { most = 128 };
    const nh_system *system = context;
    const nh_ex *symbols;
    const double *values;
    double point[most + 1], x = 0;
    uint64_t seed = 3;
    size_t m = system->coordinates < most ? system->coordinates : most;
    nh_ex in[most];
    for (size_t i = 0; i < m; i++) in[i] = system->coordinate[i].q, point[i] = 0.3 + nh_random(&seed);
    nh_system_bindings(system, &symbols, &values);
    nh_tape *tape = nh_tape_create(system->dag, m, in, 1, &e, system->parameters, symbols, values);
    nh_tape_work *scratch = nh_tape_work_create(tape);
    nh_tape_eval(tape, scratch, point, &x);
    nh_tape_work_free(scratch);
    nh_tape_free(tape);
    return isfinite(x) ? fabs(x) : 0;
}

nh_joint_rates *nh_joint_rates_create(const nh_system *system, const nh_joint *j)
{
    nh_dag *d = system->dag;
    size_t n = j->screws;
    nh_ex N[NH_MOST_SCREWS * NH_MOST_SCREWS];
    nh_pose behind = nh_pose_identity(d);
    nh_joint_rates *r = nh_alloc(sizeof *r);
    r->system = system;
    r->n = n;
    for (size_t k = n; k-- > 0;) {
        const nh_screw *s = &system->chain->screw[j->first + k];
        nh_twist own = nh_screw_twist(d, s);
        nh_pose step = nh_screw_pose(d, s);
        r->B[k] = nh_twist_inwards(d, &behind, &own);
        behind = nh_pose_product(d, &step, &behind);
    }
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < n; l++)
            N[k * n + l] = nh_simplify(d, nh_add(d, nh_dot(d, r->B[k].v, r->B[l].v), nh_dot(d, r->B[k].w, r->B[l].w)));
    r->lu = nh_lu_create(d, n, N, score, (void *)system, NULL);
    if (r->lu) return r;
    nh_free(r);
    return NULL;
}

void nh_joint_rates_free(nh_joint_rates *r)
{
    if (!r) return;
    nh_lu_free(r->lu);
    nh_free(r);
}

void nh_joint_rates_of(const nh_joint_rates *r, const nh_twist *xi, nh_ex *rate)
{
    nh_dag *d = r->system->dag;
    for (size_t k = 0; k < r->n; k++)
        rate[k] = nh_simplify(d, nh_add(d, nh_dot(d, r->B[k].v, xi->v), nh_dot(d, r->B[k].w, xi->w)));
    nh_lu_solve(r->lu, rate, rate);
    for (size_t k = 0; k < r->n; k++) rate[k] = nh_simplify(d, rate[k]);
}
