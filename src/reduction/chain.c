/* Symmetries of the kinetic energy of an open chain, joint by joint (the rules and their equations: chain.h).
 *
 *      rule: rows that are linear in the coefficients of a twist a (or c)
 *          null_space      at random states, stacked; in reduced echelon form, whole numbers rounded
 *          with_symbols    the same relation with the parameters as symbols
 *          add_field       the field with E^-1 E' = Ad(E)^-1 a (left) or a (right) of this joint, the others at rest */
#include "reduction/chain.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "exact/relation.h"
#include "exact/solve.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "reduction/joint.h"
#include "system/sample.h"

enum { states = 30, most_basis = NH_MOST_SCREWS };
static const double null_bound = 1e-10; /* threshold of singular values; rows are scaled to size one */

typedef struct {
    const nh_system *system;
    const nh_chain *chain;
    nh_dag *dag;
    nh_wrench *behind; /* per body: momentum of it and of all bodies behind it, in its frame */
    uint64_t seed;
    nh_chain_symmetries *out;
} work;

const char *nh_chain_rule_name(nh_chain_rule rule)
{
    static const char *const names[] = {"first joint", "AP1", "AP2", "extremity"};
    return names[rule];
}

/* ---- a joint and its algebra ---- */

/* [a, b] of twists: (w_a x v_b + v_a x w_b, w_a x w_b). */
static nh_twist bracket(nh_dag *d, const nh_twist *a, const nh_twist *b)
{
    nh_twist out;
    nh_ex x[3], y[3];
    nh_cross(d, a->w, b->v, x);
    nh_cross(d, a->v, b->w, y);
    nh_cross(d, a->w, b->w, out.w);
    for (int i = 0; i < 3; i++) out.v[i] = nh_add(d, x[i], y[i]);
    return out;
}

/* F in the joint's frame. */
static nh_wrench momentum_behind(const work *w, const nh_joint *j)
{
    nh_pose a = nh_joint_pose(w->dag, w->chain, j);
    return nh_wrench_outwards(w->dag, &a, &w->behind[j->child]);
}

/* behind[b]: the momentum of body b and of all behind it, in its frame, from the tips to the ground. */
static void momenta(work *w)
{
    const nh_chain *c = w->chain;
    nh_dag *d = w->dag;
    for (size_t b = 0; b < c->bodies; b++) {
        nh_pose pose;
        nh_twist twist;
        nh_inertia own = nh_body_inertia(d, &c->body[b]);
        nh_chain_frame(c, d, (long)b, 0, &pose, &twist);
        w->behind[b] = nh_inertia_momentum(d, &own, &twist);
    }
    for (size_t i = c->joints; i-- > 0;) {
        const nh_joint *j = &c->joint[c->order[i]];
        if (j->parent == NH_GROUND) continue;
        nh_wrench f = momentum_behind(w, j), *sum = &w->behind[j->parent];
        f = nh_wrench_outwards(d, &j->placement, &f);
        for (int e = 0; e < 3; e++) {
            sum->p[e] = nh_add(d, sum->p[e], f.p[e]);
            sum->L[e] = nh_add(d, sum->L[e], f.L[e]);
        }
    }
}

/* Is no other body behind this one? */
static bool carries_nothing(const nh_chain *c, size_t body)
{
    for (size_t i = 0; i < c->joints; i++)
        if (c->joint[i].parent == (long)body) return false;
    return true;
}

/* ---- null spaces ---- */

/* Expressions and their terms, one after another; at[i] is where those of e[i] begin, at[count] the end. */
static nh_ex *with_terms(nh_dag *dag, size_t count, const nh_ex *e, size_t *at)
{
    nh_ex *all = NULL;
    size_t capacity = 0;
    at[0] = 0;
    for (size_t i = 0; i < count; i++) {
        nh_ex *terms;
        size_t n = nh_terms_of(dag, e[i], &terms);
        at[i + 1] = at[i] + n;
        nh_grow(&all, &capacity, at[i + 1] + 1, sizeof *all);
        memcpy(all + at[i], terms, n * sizeof *all);
        nh_free(terms);
    }
    return all;
}

/* The largest of them without the terms themselves: the rest of terms that cancel is rounding, in any units. */
static double size_at(size_t count, const size_t *at, const double *value)
{
    static const double rounding = 1e-12;
    double size = 0, terms = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t k = at[i]; k < at[i + 1]; k++) {
            if (!isfinite(value[k])) return INFINITY;
            terms = fmax(terms, fabs(value[k]));
            if (k == at[i]) size = fmax(size, fabs(value[k]));
        }
    return size > rounding * terms ? size : 0;
}

/* Rows (n columns each) at random states, scaled to size one, stacked: `rows` x n expressions; the null space as
 * columns of `null` in reduced echelon form.  Returns its dimension. */
static size_t null_space(work *w, size_t rows, size_t n, const nh_ex *e, double *null)
{
    const nh_system *system = w->system;
    size_t m = system->coordinates, width = 1 + 2 * m, total = states * rows,
           *at = nh_alloc_array(rows * n + 1, sizeof *at);
    nh_ex *all = with_terms(system->dag, rows * n, e, at);
    const nh_ex *symbols;
    const double *values;
    nh_ex *in = nh_alloc_array(width, sizeof *in);
    double *point = nh_alloc_array(width + at[rows * n] + total * n + 2 * (total + n) + n * n, sizeof *point),
           *value = point + width, *a = value + at[rows * n];
    double *singular = a + total * n, *vt = singular + total + n;
    in[0] = system->t;
    for (size_t i = 0; i < m; i++) in[1 + i] = system->coordinate[i].q, in[1 + m + i] = system->coordinate[i].v;
    nh_system_bindings(system, &symbols, &values);
    nh_tape *tape = nh_tape_create(system->dag, width, in, at[rows * n], all, system->parameters, symbols, values);
    nh_tape_work *scratch = nh_tape_work_create(tape);
    for (size_t p = 0; p < states; p++) {
        for (size_t i = 0; i < width; i++) point[i] = 2 * nh_random(&w->seed) - 1;
        nh_tape_eval(tape, scratch, point, value);
        double size = size_at(rows * n, at, value);
        for (size_t i = 0; i < rows * n; i++)
            a[p * rows + i / n + total * (i % n)] = isfinite(size) && size > 0 ? value[at[i]] / size : 0;
    }
    size_t dimension = 0;
    if (nh_svd(total, n, a, singular, NULL, vt))
        while (dimension < n && singular[n - 1 - dimension] <= null_bound * sqrt((double)total)) dimension++;
    if (dimension) w->out->last_null = fmax(w->out->last_null, singular[n - dimension]);
    if (dimension < n) w->out->first_other = fmin(w->out->first_other, singular[n - 1 - dimension]);
    for (size_t k = 0; k < dimension; k++)
        for (size_t i = 0; i < n; i++) null[k * n + i] = vt[n - 1 - k + n * i];
    nh_tape_work_free(scratch);
    nh_tape_free(tape);
    nh_free(point);
    nh_free(in);
    nh_free(all);
    nh_free(at);
    return dimension;
}

/* Brings rows to reduced echelon form.  An entry within rounding of a whole number becomes that number. */
static void reduce(size_t rows, size_t n, double *a)
{
    for (size_t r = 0, c = 0; r < rows && c < n; c++) {
        size_t best = r;
        for (size_t i = r; i < rows; i++)
            if (fabs(a[i * n + c]) > fabs(a[best * n + c])) best = i;
        if (fabs(a[best * n + c]) < 1e-8) continue;
        for (size_t j = 0; j < n; j++) {
            double swap = a[best * n + j];
            a[best * n + j] = a[r * n + j];
            a[r * n + j] = swap;
        }
        double pivot = a[r * n + c];
        for (size_t j = 0; j < n; j++) a[r * n + j] /= pivot;
        for (size_t i = 0; i < rows; i++) {
            double factor = i == r ? 0 : a[i * n + c];
            for (size_t j = 0; j < n; j++) a[i * n + j] -= factor * a[r * n + j];
        }
        r++;
    }
    for (size_t i = 0; i < rows * n; i++)
        if (fabs(a[i] - round(a[i])) < 1e-9) a[i] = round(a[i]);
}

/* A null vector's coefficients with the parameters as symbols: the relation among the columns in which it is not zero,
 * which is unique in echelon form.  Without such a relation: the numbers. */
static void with_symbols(const work *w, size_t rows, size_t n, const nh_ex *e, const double *null, nh_ex *out)
{
    nh_dag *d = w->dag;
    const nh_ex *symbols;
    const double *values;
    nh_ex column[most_basis], found[most_basis], mark[6];
    size_t count = 0, index[most_basis], pivot = 0;
    nh_system_bindings(w->system, &symbols, &values);
    for (size_t i = 0; i < rows; i++) mark[i] = nh_symbol_fresh(d, "mark");
    for (size_t c = 0; c < n; c++) {
        out[c] = nh_real(d, null[c]);
        if (null[c] == 0) continue;
        column[count] = nh_int(d, 0);
        for (size_t i = 0; i < rows; i++) column[count] = nh_add(d, column[count], nh_mul(d, mark[i], e[i * n + c]));
        index[count++] = c;
    }
    while (pivot + 1 < count && null[index[pivot]] != 1) pivot++;
    if (nh_relation_find(d, count, column, w->system->parameters, symbols, 0, found) != NH_RELATION_UNIQUE ||
        nh_is_zero(d, found[pivot]))
        return;
    for (size_t i = 0; i < count; i++) out[index[i]] = nh_simplify(d, nh_div(d, found[i], found[pivot]));
}

/* ---- fields ---- */

/* sum_k c_k basis_k. */
static nh_twist combination(nh_dag *d, size_t n, const nh_twist *basis, const nh_ex *coefficient)
{
    nh_twist sum;
    for (int i = 0; i < 3; i++) {
        sum.v[i] = sum.w[i] = nh_int(d, 0);
        for (size_t k = 0; k < n; k++) {
            nh_ex c = coefficient[k];
            sum.v[i] = nh_add(d, sum.v[i], nh_mul(d, c, basis[k].v[i]));
            sum.w[i] = nh_add(d, sum.w[i], nh_mul(d, c, basis[k].w[i]));
        }
    }
    return sum;
}

/* A field from a twist in the joint's frame (left) or in the body's (right). */
static void add_field(work *w, nh_chain_rule rule, size_t joint, const nh_twist *a)
{
    const nh_joint *j = &w->chain->joint[joint];
    nh_ex rate[NH_MOST_SCREWS];
    nh_twist xi = *a;
    nh_pose pose = nh_joint_pose(w->dag, w->chain, j);
    if (rule != NH_CHAIN_EXTREMITY) xi = nh_twist_inwards(w->dag, &pose, a);
    nh_joint_rates *rates = nh_joint_rates_create(w->system, j);
    if (!rates) return;
    nh_joint_rates_of(rates, &xi, rate);
    nh_joint_rates_free(rates);
    nh_chain_field *f = &w->out->field[w->out->fields++];
    *f = (nh_chain_field){.rule = rule, .joint = joint};
    f->component = nh_arena_alloc(w->out->arena, w->system->coordinates * sizeof *f->component);
    for (size_t i = 0; i < w->system->coordinates; i++) f->component[i] = nh_int(w->dag, 0);
    for (size_t k = 0; k < j->screws; k++) f->component[w->chain->screw[j->first + k].coordinate] = rate[k];
    w->out->dimension[joint * NH_CHAIN_RULES + rule]++;
}

static void add_null_space(work *w, nh_chain_rule rule, size_t joint, size_t rows, size_t n, const nh_twist *basis,
                           const nh_ex *e)
{
    double null[most_basis * most_basis];
    size_t dimension = null_space(w, rows, n, e, null);
    reduce(dimension, n, null);
    for (size_t k = 0; k < dimension; k++) {
        nh_ex coefficient[most_basis];
        with_symbols(w, rows, n, e, null + k * n, coefficient);
        nh_twist a = combination(w->dag, n, basis, coefficient);
        add_field(w, rule, joint, &a);
    }
}

/* ---- the rules ---- */

/* |e| at the parameters' values. */
static double size_of(void *context, nh_ex e)
{
    double value = nh_system_number(context, e);
    return isfinite(value) ? fabs(value) : 0;
}

/* The inverse Gram matrix of the basis twists, in the parameters; inverse[l * n + k]. */
static bool dual_basis(const work *w, size_t n, const nh_twist *basis, nh_ex *inverse)
{
    nh_dag *d = w->dag;
    nh_ex gram[most_basis * most_basis];
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < n; l++)
            gram[k * n + l] = nh_add(d, nh_dot(d, basis[k].v, basis[l].v), nh_dot(d, basis[k].w, basis[l].w));
    nh_lu *lu = nh_lu_create(d, n, gram, size_of, (void *)w->system, NULL);
    if (!lu) return false;
    for (size_t l = 0; l < n; l++) {
        for (size_t k = 0; k < n; k++) inverse[l * n + k] = nh_int(d, k == l);
        nh_lu_solve(lu, inverse + l * n, inverse + l * n);
    }
    nh_lu_free(lu);
    return true;
}

/* t less its orthogonal projection on the span of the basis: column c of e (6 x columns). */
static void part_off(const work *w, size_t n, const nh_twist *basis, const nh_ex *inverse, const nh_twist *t,
                     size_t columns, size_t c, nh_ex *e)
{
    nh_dag *d = w->dag;
    nh_twist off = *t;
    for (size_t k = 0; k < n; k++)
        for (size_t l = 0; l < n; l++) {
            nh_ex part = nh_mul(d, nh_neg(d, inverse[k * n + l]),
                                nh_add(d, nh_dot(d, basis[l].v, t->v), nh_dot(d, basis[l].w, t->w)));
            for (int i = 0; i < 3; i++) {
                off.v[i] = nh_add(d, off.v[i], nh_mul(d, part, basis[k].v[i]));
                off.w[i] = nh_add(d, off.w[i], nh_mul(d, part, basis[k].w[i]));
            }
        }
    for (size_t i = 0; i < 3; i++) {
        e[i * columns + c] = off.v[i];
        e[(i + 3) * columns + c] = off.w[i];
    }
}

/* The combinations of n twists, known in the frame in which `pose` is that before the joint, that stay in Lie(Q_i)
 * everywhere: echelon form; local: the twists before the joint.  Returns their number; *whole: all coefficients are
 * whole numbers, whatever the parameters are. */
static size_t staying(work *w, const nh_joint *j, const nh_pose *pose, size_t n, const nh_twist *twist, nh_twist *local,
                      nh_ex *coefficient, bool *whole)
{
    nh_twist basis[most_basis];
    nh_ex e[6 * most_basis];
    nh_ex inverse[most_basis * most_basis];
    double null[most_basis * most_basis];
    size_t m = nh_joint_basis(w->dag, w->chain, j, basis);
    *whole = true;
    if (!dual_basis(w, m, basis, inverse)) return 0;
    for (size_t k = 0; k < n; k++) {
        local[k] = nh_twist_inwards(w->dag, pose, &twist[k]);
        part_off(w, m, basis, inverse, &local[k], n, k, e);
    }
    size_t dimension = null_space(w, 6, n, e, null);
    reduce(dimension, n, null);
    for (size_t k = 0; k < dimension; k++) with_symbols(w, 6, n, e, null + k * n, coefficient + k * n);
    for (size_t i = 0; i < dimension * n; i++)
        *whole &= nh_kind_of(w->dag, coefficient[i]) == NH_NUMBER && nh_number_of(w->dag, coefficient[i]).q == 1;
    return dimension;
}

/* AP1: twists c of space with Ad(P)^-1 c in Lie(Q_i) everywhere, P the pose before the joint.  At rest they are Ad(P0)
 * b with b in Lie(Q_i): first the coefficients of b are looked for, then, unless these are whole numbers, those of the
 * unit twists of space: one of both frames has the axes as they were given. */
static void space_moves(work *w, size_t joint)
{
    const nh_joint *j = &w->chain->joint[joint];
    nh_dag *d = w->dag;
    nh_twist twist[most_basis], local[most_basis], U;
    nh_pose before, rest, since;
    nh_ex coefficient[most_basis * most_basis];
    bool whole;
    size_t n = nh_joint_basis(d, w->chain, j, twist);
    nh_chain_frame(w->chain, d, j->parent, 0, &before, &U);
    before = nh_pose_product(d, &before, &j->placement);
    rest = nh_joint_at_rest(w->system, &before);
    since = nh_pose_between(d, &rest, &before);
    size_t dimension = staying(w, j, &since, n, twist, local, coefficient, &whole);
    if (!whole) {
        for (size_t c = 0; c < 6; c++)
            for (size_t i = 0; i < 3; i++) twist[c].v[i] = nh_int(d, c == i), twist[c].w[i] = nh_int(d, c == 3 + i);
        dimension = staying(w, j, &before, n = 6, twist, local, coefficient, &whole);
    }
    for (size_t k = 0; k < dimension; k++) {
        nh_twist a = combination(d, n, local, coefficient + n * k);
        add_field(w, NH_CHAIN_AP1, joint, &a);
    }
}

/* A basis of the joint's algebra; 0 where its displacement is not a coordinate of its own. */
static size_t own_basis(const work *w, const nh_joint *j, nh_twist *basis)
{
    size_t n = nh_joint_basis(w->dag, w->chain, j, basis);
    for (size_t k = 0; k < n; k++)
        if (w->chain->screw[j->first + k].coordinate < 0) return 0;
    return n;
}

/* Theorem 4.1. */
static void first_joint(work *w, size_t joint)
{
    const nh_joint *j = &w->chain->joint[joint];
    nh_twist basis[most_basis];
    size_t n = j->parent == NH_GROUND ? own_basis(w, j, basis) : 0;
    for (size_t k = 0; k < n; k++) add_field(w, NH_CHAIN_FIRST, joint, &basis[k]);
}

/* The four rules for one joint. */
static void joint_symmetries(work *w, size_t joint)
{
    const nh_chain *c = w->chain;
    const nh_joint *j = &c->joint[joint];
    nh_dag *d = w->dag;
    nh_twist basis[most_basis], U, V;
    nh_pose pose;
    nh_ex e[most_basis];
    size_t n = own_basis(w, j, basis);
    if (n == 0) return;
    first_joint(w, joint);
    space_moves(w, joint);
    nh_chain_frame(c, d, j->parent, 0, &pose, &U);
    U = nh_twist_inwards(d, &j->placement, &U);
    nh_wrench F = momentum_behind(w, j);
    for (size_t k = 0; k < n; k++) {
        nh_twist b = bracket(d, &basis[k], &U);
        e[k] = nh_pairing(d, &b, &F);
    }
    add_null_space(w, NH_CHAIN_AP2, joint, 1, n, basis, e);
    if (!carries_nothing(c, j->child)) return;
    nh_chain_frame(c, d, (long)j->child, 0, &pose, &V);
    for (size_t k = 0; k < n; k++) {
        nh_twist b = bracket(d, &basis[k], &V);
        e[k] = nh_pairing(d, &b, &w->behind[j->child]);
    }
    add_null_space(w, NH_CHAIN_EXTREMITY, joint, 1, n, basis, e);
}

static nh_chain_symmetries *symmetries_create(const nh_system *system)
{
    const nh_chain *c = system->chain;
    nh_arena *arena = nh_arena_create();
    nh_chain_symmetries *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_chain_symmetries){.arena = arena, .joints = c->joints, .first_other = INFINITY};
    out->dimension = nh_arena_alloc(arena, (c->joints * NH_CHAIN_RULES + 1) * sizeof *out->dimension);
    out->field = nh_arena_alloc(arena, (c->joints * NH_CHAIN_RULES * most_basis + 1) * sizeof *out->field);
    return out;
}

nh_chain_symmetries *nh_chain_symmetries_find(const nh_system *system, uint64_t seed, nh_error *error)
{
    const nh_chain *c = system->chain;
    if (!c) {
        nh_fail(error, NH_USAGE, "", "the system %s has no bodies and joints", system->name);
        return NULL;
    }
    nh_chain_symmetries *out = symmetries_create(system);
    work w = {system, c, system->dag, nh_alloc_array(c->bodies + 1, sizeof(nh_wrench)), seed, out};
    momenta(&w);
    for (size_t i = 0; i < c->joints; i++) joint_symmetries(&w, i);
    nh_free(w.behind);
    return out;
}

nh_chain_symmetries *nh_chain_first_joint(const nh_system *system)
{
    if (!system->chain) return NULL;
    work w = {.system = system, .chain = system->chain, .dag = system->dag, .out = symmetries_create(system)};
    for (size_t i = 0; i < w.chain->joints; i++) first_joint(&w, i);
    return w.out;
}

void nh_chain_symmetries_free(nh_chain_symmetries *symmetries)
{
    if (symmetries) nh_arena_free(symmetries->arena);
}
