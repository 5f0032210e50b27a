#include "absence/darboux_internal.h"
#include "absence/rational_value.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/num.h"

/* ---- is it a homogeneous potential? ---- */

/* Inertia: all second derivatives by velocities are numbers; what is linear in the velocities vanishes. */
static const char *read_inertia(nh_darboux_work *w, nh_ex L)
{
    nh_dag *dag = w->dag;
    nh_ex zero[NH_DARBOUX_MOST];
    for (size_t i = 0; i < w->n; i++) zero[i] = nh_int(dag, 0);
    for (size_t i = 0; i < w->n; i++) {
        nh_ex momentum = nh_diff(dag, L, w->v[i]);
        for (size_t j = 0; j < w->n; j++)
            if (!nh_rational_value_of(dag, nh_simplify_short(dag, nh_diff(dag, momentum, w->v[j]), 0),
                                      fmpq_mat_entry(w->inertia, (slong)i, (slong)j)))
                return "the inertia is not constant and rational";
        if (nh_normal_is_zero(dag, nh_substitute(dag, momentum, w->n, w->v, zero), 0) != NH_ZERO)
            return "the Lagrangian has terms linear in the velocities";
    }
    w->potential = nh_neg(dag, nh_substitute(dag, L, w->n, w->v, zero));
    return fmpq_mat_inv(w->inverse, w->inertia) ? NULL : "a velocity has no inertia";
}

/* sum q dV/dq */
static nh_ex euler(const nh_darboux_work *w, nh_ex V)
{
    nh_ex sum = nh_int(w->dag, 0);
    for (size_t i = 0; i < w->n; i++) sum = nh_add(w->dag, sum, nh_mul(w->dag, w->q[i], nh_diff(w->dag, V, w->q[i])));
    return sum;
}

/* W = q V' is homogeneous of degree k iff q W' = k W; then V is W/k and a constant. */
static bool degree_by_euler(nh_darboux_work *w, nh_num *k)
{
    nh_dag *dag = w->dag;
    nh_ex W = nh_simplify(dag, euler(w, w->potential)), second = euler(w, W);
    if (nh_normal_is_zero(dag, W, 0) == NH_ZERO) {
        *k = nh_num_int(0);
        return true;
    }
    nh_ex ratio = nh_simplify(dag, nh_div(dag, second, W));
    if (nh_kind_of(dag, ratio) != NH_NUMBER || nh_is_zero(dag, ratio)) return false;
    if (nh_normal_is_zero(dag, nh_sub(dag, second, nh_mul(dag, ratio, W)), 0) != NH_ZERO) return false;
    *k = nh_number_of(dag, ratio);
    w->potential = nh_div(dag, W, ratio);
    return true;
}

static const char *read_degree(nh_darboux_work *w)
{
    enum { silent = 2, most_degree = 100 };
    nh_num k;
    if (!nh_darboux_degree(w->dag, w->n, w->q, &w->potential, &k) && !degree_by_euler(w, &k))
        return "the potential is not homogeneous";
    if (!nh_num_short(k) || k.q != 1 || k.p > most_degree || k.p < -most_degree)
        return "the potential is not homogeneous of a whole degree";
    w->out->degree = (long)k.p;
    if (k.p == 0) return "the potential is constant on lines through the origin";
    return k.p == silent || k.p == -silent ? "the theorem says nothing of potentials of degree 2 and -2" : NULL;
}

static const char *read_system(nh_darboux_work *w, const nh_closed_shape *shape)
{
    const nh_system *system = shape->model->system;
    if (system->constraints) return "there are constraints";
    if (system->has_forces) return "there are forces besides those of a potential";
    if (w->n < 2 || w->n > NH_DARBOUX_MOST) return "there are not two to twelve coordinates";
    nh_ex L = nh_system_values(system, w->dag, system->lagrangian);
    if (nh_depends(w->dag, L, system->t) || system->driven) return "the Lagrangian depends on the time";
    for (size_t i = 0; i < system->parameters; i++)
        if (system->parameter[i].input && nh_depends(w->dag, system->lagrangian, system->parameter[i].symbol))
            return "the Lagrangian contains an input, which may change with time";
    const char *obstacle = read_inertia(w, L);
    if (!obstacle && !nh_darboux_algebraic(w->dag, w->n, w->q, w->potential, &w->out->roots))
        obstacle = "the potential contains more than powers and roots of the coordinates";
    if (!obstacle) obstacle = read_degree(w);
    return obstacle;
}

/* ---- lines ---- */

static void try_whole(nh_darboux_work *w, const long *c)
{
    nh_ex value[NH_DARBOUX_MOST];
    for (size_t i = 0; i < w->n; i++) value[i] = nh_int(w->dag, c[i]);
    nh_darboux_try(w, value, NULL);
}

/* Coordinates 0, 1, -1, of which the first is not negative; of many coordinates at most two are not 0. */
static void try_simple_lines(nh_darboux_work *w)
{
    enum { digits = 3, few = 4 };
    long c[NH_DARBOUX_MOST] = {0};
    if (w->n <= few) {
        size_t all = 1;
        for (size_t i = 0; i < w->n; i++) all *= digits;
        for (size_t turn = 1; turn < all; turn++) {
            size_t rest = turn;
            long first = 0;
            for (size_t i = 0; i < w->n; i++, rest /= digits) {
                c[i] = (long)(rest % digits) - (rest % digits == 2 ? digits : 0);
                if (!first) first = c[i];
            }
            if (first > 0) try_whole(w, c);
        }
        return;
    }
    for (size_t i = 0; i < w->n; i++) {
        c[i] = 1;
        try_whole(w, c);
        for (size_t j = i + 1; j < w->n; j++) {
            for (c[j] = 1; c[j] >= -1; c[j] -= 2) try_whole(w, c);
            c[j] = 0;
        }
        c[i] = 0;
    }
}

static void find_lines(nh_darboux_work *w)
{
    for (size_t i = 0; i < w->n; i++) w->slope[i] = nh_diff(w->dag, w->potential, w->q[i]);
    for (size_t i = 0; i < w->n * w->n; i++) w->second[i] = nh_diff(w->dag, w->slope[i / w->n], w->q[i % w->n]);
    w->plane = nh_darboux_plane(w);
    if (!w->plane) {
        nh_darboux_triangle(w);
        try_simple_lines(w);
    }
    nh_darboux *out = w->out;
    if (out->refuted) return;
    out->obstacle = !out->points     ? "no straight motion was found"
                    : out->undecided ? "eigenvalues on straight motions were not decided, and the others are allowed"
                                     : "all eigenvalues on the straight motions that were found are allowed";
}

nh_darboux *nh_darboux_of(nh_arena *arena, const nh_closed_shape *shape)
{
    const nh_system *system = shape->model->system;
    nh_darboux *out = nh_arena_alloc(arena, sizeof *out);
    nh_darboux_work w = {.arena = arena, .dag = shape->model->dag, .n = system->coordinates, .out = out};
    *out = (nh_darboux){.coordinates = w.n, .generic = true};
    for (size_t i = 0; i < system->parameters; i++)
        out->generic &= !nh_depends(w.dag, system->lagrangian, system->parameter[i].symbol);
    for (size_t i = 0; i < w.n && i < NH_DARBOUX_MOST; i++) {
        w.q[i] = system->coordinate[i].q;
        w.v[i] = system->coordinate[i].v;
    }
    slong n = w.n <= NH_DARBOUX_MOST ? (slong)w.n : 0;
    fmpq_mat_init(w.inertia, n, n);
    fmpq_mat_init(w.inverse, n, n);
    out->obstacle = read_system(&w, shape);
    out->applies = !out->obstacle;
    if (out->applies) find_lines(&w);
    if (out->refuted && !out->generic) out->generic = nh_darboux_generic(&w, system);
    fmpq_mat_clear(w.inertia);
    fmpq_mat_clear(w.inverse);
    return out;
}
