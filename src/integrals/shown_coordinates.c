#include "integrals/shown_coordinates.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "integrals/total_derivative.h"

/* The place becomes the coordinate along which it has a number as slope. */
static void take(const nh_model *model, nh_ex place, nh_ex *u)
{
    nh_dag *d = model->dag;
    for (size_t s = 0; s < model->m; s++) {
        nh_ex q = model->system->coordinate[s].q, slope = nh_diff(d, place, q);
        if (u[s] != q || nh_kind_of(d, slope) != NH_NUMBER || nh_is_zero(d, slope)) continue;
        u[s] = nh_mul(d, place, nh_powi(d, slope, -1));
        return;
    }
}

/* a b, m x m */
static void multiply(nh_dag *d, size_t m, const nh_ex *a, const nh_ex *b, nh_ex *out)
{
    for (size_t i = 0; i < m * m; i++) {
        out[i] = nh_int(d, 0);
        for (size_t k = 0; k < m; k++) out[i] = nh_add(d, out[i], nh_mul(d, a[i / m * m + k], b[k * m + i % m]));
    }
}

/* J^-1 = 1 + N + N^2 + .., N = 1 - J, which ends where each coordinate is changed by others that are not changed by
 * it. */
static bool invert(nh_dag *d, size_t m, const nh_ex *N, nh_ex *inverse)
{
    nh_ex *power = nh_alloc_array(2 * m * m, sizeof *power), *next = power + m * m;
    bool more = true;
    for (size_t i = 0; i < m * m; i++) power[i] = inverse[i] = nh_int(d, i / m == i % m);
    for (size_t k = 0; k < m && more; k++) {
        multiply(d, m, power, N, next);
        more = false;
        for (size_t i = 0; i < m * m; i++) {
            power[i] = next[i];
            inverse[i] = nh_add(d, inverse[i], next[i]);
            more |= !nh_is_zero(d, next[i]);
        }
    }
    nh_free(power);
    return !more;
}

/* u, and dq^k/du^i in inverse[k m + i].  False: see shown_coordinates.h. */
static bool change(const nh_model *model, size_t places, const nh_ex *place, nh_ex *u, nh_ex *inverse)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    size_t m = model->m;
    nh_ex *N = nh_alloc_array(m * m + 1, sizeof *N);
    bool mixed = false;
    for (size_t s = 0; s < m; s++) u[s] = system->coordinate[s].q;
    for (size_t i = 0; i < places; i++) take(model, place[i], u);
    for (size_t i = 0; i < m * m; i++) {
        N[i] = nh_sub(d, nh_int(d, i / m == i % m), nh_diff(d, u[i / m], system->coordinate[i % m].q));
        mixed |= !nh_is_zero(d, N[i]);
    }
    bool good = mixed && invert(d, m, N, inverse);
    nh_free(N);
    return good;
}

bool nh_shown_coordinates(const nh_model *model, size_t places, const nh_ex *place, nh_ex *u, nh_ex *P)
{
    nh_dag *d = model->dag;
    size_t m = model->m;
    nh_ex *inverse = nh_alloc_array(m * m + 1, sizeof *inverse);
    bool good = change(model, places, place, u, inverse);
    nh_ex L = good ? nh_total_derivative_removed(model) : model->system->lagrangian;
    for (size_t s = 0; s < m && good; s++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t k = 0; k < m; k++)
            sum = nh_add(d, sum, nh_mul(d, nh_diff(d, L, model->system->coordinate[k].v), inverse[k * m + s]));
        P[s] = nh_simplify_short(d, nh_model_compose(model, sum), 0);
    }
    nh_free(inverse);
    return good;
}

size_t nh_shown_components(const nh_model *model, size_t places, const nh_ex *place, size_t most, nh_ex *out)
{
    nh_dag *d = model->dag;
    size_t m = model->m, n = 0;
    nh_ex *u = nh_alloc_array(m * (m + 1) + 1, sizeof *u), *inverse = u + m;
    bool good = change(model, places, place, u, inverse);
    for (size_t i = 0; i < m * m && good; i++) {
        bool before = nh_kind_of(d, inverse[i]) == NH_NUMBER;
        for (size_t j = 0; j < i; j++) before |= inverse[j] == inverse[i];
        if (before || n + m + 2 > most) continue;
        out[n++] = inverse[i];
        out[n++] = nh_mul(d, inverse[i], model->system->t);
        for (size_t j = 0; j < m; j++) out[n++] = nh_mul(d, inverse[i], u[j]);
    }
    nh_free(u);
    return n;
}

/* ---- places ---- */

static bool moves(const nh_model *model, nh_ex e)
{
    bool any = false;
    for (size_t s = 0; s < model->m && !any; s++) any = nh_depends(model->dag, e, model->system->coordinate[s].v);
    for (size_t i = 0; i < model->n && !any; i++) any = nh_depends(model->dag, e, model->chart->w[i]);
    return any;
}

static bool has_position(const nh_model *model, nh_ex e)
{
    bool any = nh_depends(model->dag, e, model->system->t);
    for (size_t s = 0; s < model->m && !any; s++) any = nh_depends(model->dag, e, model->system->coordinate[s].q);
    return any;
}

static bool is_place(const nh_model *model, nh_ex e)
{
    if (nh_kind_of(model->dag, e) != NH_SUM || moves(model, e)) return false;
    bool linear = !has_position(model, nh_diff(model->dag, e, model->system->t)), some = false;
    for (size_t s = 0; s < model->m; s++) {
        nh_ex slope = nh_diff(model->dag, e, model->system->coordinate[s].q);
        linear &= !has_position(model, slope);
        some |= !nh_is_zero(model->dag, slope);
    }
    return some && !linear;
}

size_t nh_shown_places(const nh_model *model, nh_ex out[NH_MOST_PLACES])
{
    const nh_system *system = model->system;
    nh_ex *e = nh_alloc_array(1 + 2 * system->constraints, sizeof *e), *node;
    size_t n = 0, found = 0;
    e[n++] = system->lagrangian;
    for (size_t a = 0; a < system->constraints; a++)
        e[n++] = system->constraint[a].lhs, e[n++] = system->constraint[a].rhs;
    size_t count = nh_nodes_in(model->dag, n, e, &node);
    for (size_t i = 0; i < count && found < NH_MOST_PLACES; i++)
        if (is_place(model, node[i])) out[found++] = node[i];
    nh_free(node);
    nh_free(e);
    return found;
}
