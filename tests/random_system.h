/* random_system: seeded random mechanical systems, written as system files that know the currents built into them.
 *
 * A system is made in "straight" coordinates Q in which its symmetries are plain: L does not contain some of the Q (cyclic), or only Q0^2 + Q1^2 and
 * invariant velocities (rotation), or not t (energy); the virtual displacements of a symmetry satisfy the constraints (it is horizontal), which
 * themselves need not be invariant.  Then the Q become functions of the coordinates of the file, linear, nonlinear or moving in time, a total time
 * derivative may be added to L, and nothing of this can be seen any more.  Momenta and the energy of the straight Lagrangian remain conserved
 * (Noether's theorem with Chetaev forces: the rate of p_s xi^s is the virtual work of the constraints on xi, which is zero). */
#ifndef NH_TESTS_RANDOM_SYSTEM_H
#define NH_TESTS_RANDOM_SYSTEM_H

#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/print.h"

typedef enum { FREE, HOLONOMIC, LINEAR, AFFINE, RHEONOMIC, NONLINEAR, HOMOGENEOUS, CONSTRAINT_KINDS } constraint_kind;

static const char *const constraint_names[CONSTRAINT_KINDS] = {"none", "holonomic", "linear", "affine", "rheonomic", "nonlinear", "homogeneous"};

enum { MOST_COORDINATES = 4, MOST_PARAMETERS = 4, MOST_ATOMS = 24 };

typedef struct {
    uint64_t state;
    nh_dag *dag;
    size_t m, k, cyclic, parameters;
    bool angle[MOST_COORDINATES], rotation, energy;
    constraint_kind kind;
    const char *name[MOST_COORDINATES];
    nh_ex t, q[MOST_COORDINATES], v[MOST_COORDINATES], Q[MOST_COORDINATES], V[MOST_COORDINATES];
    nh_ex T[MOST_COORDINATES];  /* Q as functions of t and q */
    nh_ex L, gauge, pull;       /* without the gauge term; pull: a uniform force along Q0, 0 without */
    nh_ex lhs[2], rhs[2];       /* constraints */
    char parameter[MOST_PARAMETERS][8];
    double value[MOST_PARAMETERS];
    size_t moves;
} random_system;

/* ---- drawing ---- */

static uint64_t draw_bits(random_system *r)
{
    uint64_t z = (r->state += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

static size_t draw(random_system *r, size_t n) { return (size_t)(draw_bits(r) % n); }

static bool chance(random_system *r, size_t percent) { return draw(r, 100) < percent; }

/* A positive number of two digits, or a parameter. */
static nh_ex positive(random_system *r)
{
    long hundredths = 20 + (long)draw(r, 200);
    if (r->parameters == MOST_PARAMETERS || !chance(r, 25)) return nh_ratio(r->dag, hundredths, 100);
    snprintf(r->parameter[r->parameters], sizeof r->parameter[0], "c%zu", r->parameters + 1);
    r->value[r->parameters] = (double)hundredths / 100;
    return nh_symbol(r->dag, r->parameter[r->parameters++]);
}

static nh_ex number(random_system *r)
{
    nh_ex x = positive(r);
    return chance(r, 40) ? nh_neg(r->dag, x) : x;
}

/* ---- pieces ---- */

static bool in_rotation(const random_system *r, size_t i) { return r->rotation && i < 2; }

/* The number of coordinates that belong to built-in symmetries: the first ones. */
static size_t symmetric(const random_system *r) { return (r->rotation ? 2 : 0) + r->cyclic; }

static bool is_cyclic(const random_system *r, size_t i) { return !in_rotation(r, i) && i < symmetric(r); }

static nh_ex function_of(random_system *r, nh_ex x, bool angle)
{
    nh_dag *d = r->dag;
    size_t k = draw(r, 5);
    if (angle) {
        if (k == 4) x = nh_mul(d, nh_int(d, 2), x);
        return nh_call(d, k % 2 ? NH_SIN : NH_COS, x);
    }
    if (k == 3) return nh_call(d, NH_SIN, nh_mul(d, nh_ratio(d, 1 + (long)draw(r, 4), 2), x));
    return nh_powi(d, x, k == 0 ? 2 : k == 4 ? 3 : 1);
}

/* A function of a position that the symmetries leave as it is; 0 when there is none. */
static nh_ex invariant_atom(random_system *r)
{
    nh_dag *d = r->dag;
    size_t usable[MOST_COORDINATES + 1], n = 0;
    for (size_t i = 0; i < r->m; i++)
        if (!is_cyclic(r, i) && !(in_rotation(r, i) && i == 1)) usable[n++] = i;
    if (n == 0) return 0;
    size_t i = usable[draw(r, n)];
    if (!in_rotation(r, i)) return function_of(r, r->Q[i], r->angle[i]);
    nh_ex square = nh_add(d, nh_powi(d, r->Q[0], 2), nh_powi(d, r->Q[1], 2));
    return chance(r, 30) ? nh_powi(d, square, 2) : square;
}

static nh_ex any_atom(random_system *r)
{
    size_t i = draw(r, r->m);
    return function_of(r, r->Q[i], r->angle[i]);
}

/* 1 + small * atom^2, or a number: positive. */
static nh_ex inertia(random_system *r)
{
    nh_dag *d = r->dag;
    nh_ex c = positive(r), atom = chance(r, 40) ? invariant_atom(r) : 0;
    if (!atom) return c;
    return nh_add(d, c, nh_mul(d, nh_ratio(d, 10 + (long)draw(r, 60), 100), nh_powi(d, atom, 2)));
}

static nh_ex radial(const random_system *r)
{
    return nh_add(r->dag, nh_mul(r->dag, r->Q[0], r->V[0]), nh_mul(r->dag, r->Q[1], r->V[1]));
}

static nh_ex angular(const random_system *r)
{
    return nh_sub(r->dag, nh_mul(r->dag, r->Q[0], r->V[1]), nh_mul(r->dag, r->Q[1], r->V[0]));
}

/* sum_i D_i/2 (V_i + sum_(j > i) c_ij V_j)^2: positive definite. */
static nh_ex kinetic(random_system *r)
{
    nh_dag *d = r->dag;
    nh_ex sum = 0, pair = r->rotation ? inertia(r) : 0;
    for (size_t i = 0; i < r->m; i++) {
        nh_ex form = r->V[i], D = in_rotation(r, i) ? pair : inertia(r);
        for (size_t j = i + 1; j < r->m && !in_rotation(r, i); j++) {
            if (!chance(r, 35)) continue;
            nh_ex c = number(r), atom = chance(r, 50) ? invariant_atom(r) : 0;
            form = nh_add(d, form, nh_mul(d, atom ? nh_mul(d, c, atom) : c, r->V[j]));
        }
        if (r->rotation && i >= 2 && chance(r, 30)) form = nh_add(d, form, nh_mul(d, number(r), chance(r, 50) ? radial(r) : angular(r)));
        sum = nh_add(d, sum, nh_mul(d, nh_mul(d, nh_ratio(d, 1, 2), D), nh_powi(d, form, 2)));
    }
    size_t i = draw(r, r->m);
    if (chance(r, 8) && !in_rotation(r, i)) sum = nh_add(d, sum, nh_mul(d, nh_ratio(d, 1, 10), nh_powi(d, r->V[i], 4)));
    return sum;
}

/* Terms linear in the velocities. */
static nh_ex gyroscopic(random_system *r)
{
    nh_dag *d = r->dag;
    size_t j = draw(r, r->m);
    nh_ex atom = invariant_atom(r);
    if (!atom) return 0;
    return nh_mul(d, nh_mul(d, number(r), atom), in_rotation(r, j) ? angular(r) : r->V[j]);
}

static nh_ex potential(random_system *r)
{
    nh_dag *d = r->dag;
    nh_ex sum = 0;
    size_t terms = 1 + draw(r, 3);
    for (size_t i = 0; i < terms; i++) {
        nh_ex atom = invariant_atom(r), other = chance(r, 40) ? invariant_atom(r) : 0;
        if (atom) sum = nh_add(d, sum, nh_mul(d, number(r), other ? nh_mul(d, atom, other) : atom));
    }
    if (r->energy) return sum;
    nh_ex atom = invariant_atom(r), beat = nh_call(d, NH_COS, nh_mul(d, positive(r), r->t));
    return atom ? nh_add(d, sum, nh_mul(d, nh_mul(d, number(r), beat), atom)) : sum;
}

/* ---- constraints: V_d = ..., for the last coordinates ---- */

/* A velocity that the symmetries' displacements do not have; 0 when there is none. */
static nh_ex horizontal(random_system *r)
{
    size_t n = r->m - r->k, first = symmetric(r);
    if (first < n && !(r->rotation && chance(r, 30))) return r->V[first + draw(r, n - first)];
    return r->rotation ? radial(r) : 0;
}

/* Some horizontal velocities with coefficients that may contain any position. */
static nh_ex linear_form(random_system *r)
{
    nh_dag *d = r->dag;
    nh_ex sum = 0;
    size_t terms = 1 + draw(r, 2);
    for (size_t i = 0; i < terms; i++) {
        nh_ex v = horizontal(r);
        if (v) sum = nh_add(d, sum, nh_mul(d, nh_mul(d, number(r), chance(r, 75) ? any_atom(r) : nh_int(d, 1)), v));
    }
    return sum;
}

static void position_constraint(random_system *r, size_t a, size_t i)
{
    nh_dag *d = r->dag;
    nh_ex atom = invariant_atom(r);
    for (size_t tries = 0; tries < 20 && nh_depends(d, atom, r->Q[i]); tries++) atom = invariant_atom(r);
    if (nh_depends(d, atom, r->Q[i])) atom = 0;
    r->lhs[a] = nh_add(d, r->Q[i], nh_mul(d, number(r), atom));
    r->rhs[a] = nh_ratio(d, (long)draw(r, 60), 100);
}

static void constraint(random_system *r, size_t a)
{
    nh_dag *d = r->dag;
    size_t i = r->m - r->k + a;
    nh_ex V = r->V[i], form = linear_form(r);
    r->lhs[a] = V;
    r->rhs[a] = form;
    switch (r->kind) {
    case HOLONOMIC: position_constraint(r, a, i); break;
    case AFFINE: r->rhs[a] = nh_add(d, form, nh_mul(d, number(r), any_atom(r))); break;
    case RHEONOMIC:
        r->rhs[a] = nh_add(d, nh_mul(d, form, nh_add(d, nh_int(d, 1), r->t)), nh_mul(d, number(r), nh_call(d, NH_SIN, nh_mul(d, positive(r), r->t))));
        break;
    case HOMOGENEOUS: /* V^2 = form^2 + c^2 v^2 */
        r->lhs[a] = nh_powi(d, V, 2);
        r->rhs[a] = nh_add(d, nh_powi(d, form, 2), nh_mul(d, positive(r), nh_powi(d, horizontal(r), 2)));
        break;
    case NONLINEAR: {
        nh_ex v = horizontal(r), c = positive(r);
        size_t which = draw(r, 4);
        if (which == 0) r->rhs[a] = nh_add(d, form, nh_mul(d, c, nh_powi(d, v, 2)));
        else if (which == 1) r->lhs[a] = nh_powi(d, V, 2), r->rhs[a] = nh_add(d, c, nh_powi(d, form, 2));
        else if (which == 2) r->lhs[a] = nh_add(d, V, nh_mul(d, nh_ratio(d, 1, 4), nh_powi(d, V, 3)));
        else r->lhs[a] = nh_add(d, V, nh_mul(d, nh_ratio(d, 3, 10), nh_call(d, NH_SIN, V)));
        break;
    }
    default: break;
    }
}

/* ---- the disguise ---- */

/* Q_i := Q_i + g(Q_j), or + c t. */
static void shear(random_system *r)
{
    nh_dag *d = r->dag;
    size_t i = draw(r, r->m), j = draw(r, r->m);
    if (i == j) {
        if (!chance(r, 50)) return;
        r->moves++;
        r->T[i] = nh_add(d, r->T[i], nh_mul(d, number(r), r->t));
        return;
    }
    nh_ex x = r->T[j], g = nh_mul(d, number(r), x);
    if (r->angle[j] && (!r->angle[i] || chance(r, 40))) g = nh_mul(d, number(r), nh_call(d, NH_SIN, x));
    else if (r->angle[j]) g = chance(r, 50) ? x : nh_neg(d, x);
    else if (chance(r, 40)) g = nh_mul(d, number(r), nh_powi(d, x, 2));
    r->T[i] = nh_add(d, r->T[i], g);
}

static nh_ex disguised(random_system *r, nh_ex e)
{
    nh_dag *d = r->dag;
    nh_ex from[2 * MOST_COORDINATES], to[2 * MOST_COORDINATES];
    for (size_t i = 0; i < r->m; i++) {
        from[i] = r->Q[i];
        to[i] = r->T[i];
        from[r->m + i] = r->V[i];
        to[r->m + i] = nh_add(d, nh_diff(d, r->T[i], r->t), nh_diff_along(d, r->T[i], r->m, r->q, r->v));
    }
    return nh_substitute(d, e, 2 * r->m, from, to);
}

/* ---- the whole ---- */

static void name_coordinates(random_system *r)
{
    static const char *const lengths[] = {"x", "y", "z", "u", "s", "h"}, *const angles[] = {"phi", "theta", "psi", "alpha", "beta", "w"};
    size_t l = draw(r, 3), a = draw(r, 3);
    for (size_t i = 0; i < r->m; i++) {
        char velocity[20];
        r->angle[i] = !in_rotation(r, i) && chance(r, 40);
        r->name[i] = r->angle[i] ? angles[a++ % 6] : lengths[l++ % 6];
        snprintf(velocity, sizeof velocity, "%s'", r->name[i]);
        r->q[i] = r->T[i] = nh_symbol(r->dag, r->name[i]);
        r->v[i] = nh_symbol(r->dag, velocity);
        r->Q[i] = nh_symbol_fresh(r->dag, "Q");
        r->V[i] = nh_symbol_fresh(r->dag, "V");
    }
}

/* What is built in, and whether there is room for it. */
static bool choose_structure(random_system *r)
{
    static const size_t kinds[] = {FREE, FREE, HOLONOMIC, HOLONOMIC, LINEAR, LINEAR, LINEAR, AFFINE, RHEONOMIC, NONLINEAR, NONLINEAR, HOMOGENEOUS};
    size_t wanted = draw(r, 5);
    r->m = 2 + (draw(r, 4) + 1) / 2;
    r->kind = (constraint_kind)kinds[draw(r, sizeof kinds / sizeof *kinds)];
    r->k = r->kind == FREE ? 0 : r->m == 4 && chance(r, 35) ? 2 : 1;
    r->energy = wanted > 0 && chance(r, 50);
    size_t rest = (wanted > 2 ? 2 : wanted > 0 ? 1 : 0) - r->energy;
    r->rotation = rest > 0 && r->m > 2 && chance(r, 30);
    r->cyclic = rest - r->rotation;
    bool work = r->kind == AFFINE || r->kind == RHEONOMIC || r->kind == NONLINEAR;
    bool speeds = symmetric(r) < r->m - r->k || r->rotation;
    if (r->energy && work) return false;
    if (r->kind == HOLONOMIC) return symmetric(r) + r->k <= r->m && r->m > r->k;
    return symmetric(r) + r->k <= r->m && (r->kind == FREE || speeds);
}

static void make_lagrangian(random_system *r)
{
    nh_dag *d = r->dag;
    r->L = nh_sub(d, kinetic(r), potential(r));
    if (chance(r, 25)) r->L = nh_add(d, r->L, gyroscopic(r));
    r->pull = r->cyclic && !r->rotation && !r->angle[0] && chance(r, 20) ? number(r) : 0;
    r->L = nh_add(d, r->L, nh_mul(d, r->pull, r->Q[0]));
    nh_ex F = chance(r, 25) ? nh_mul(d, number(r), nh_mul(d, r->Q[draw(r, r->m)], any_atom(r))) : 0;
    r->gauge = nh_diff_along(d, F, r->m, r->Q, r->V);
    for (size_t a = 0; a < r->k; a++) constraint(r, a);
    for (size_t i = draw(r, 4); i > 0; i--) shear(r);
}

/* Long numbers are rounded to doubles: such a system would be known to 16 digits only. */
static bool is_exact(random_system *r)
{
    bool exact = nh_is_exact(r->dag, disguised(r, nh_add(r->dag, r->L, r->gauge)));
    for (size_t a = 0; a < r->k; a++) exact = exact && nh_is_exact(r->dag, disguised(r, r->lhs[a])) && nh_is_exact(r->dag, disguised(r, r->rhs[a]));
    return exact;
}

/* Free with nh_dag_free(r->dag). */
static random_system random_system_create(uint64_t seed)
{
    for (uint64_t state = seed * 7919 + 2385;;) { /* node 0 of a graph is the number 0: what is absent is 0 */
        random_system r = {.state = state, .dag = nh_dag_create()};
        r.t = nh_symbol(r.dag, "t");
        while (!choose_structure(&r)) {}
        name_coordinates(&r);
        make_lagrangian(&r);
        if (is_exact(&r)) return r;
        state = r.state;
        nh_dag_free(r.dag);
    }
}

static void write_expression(FILE *out, random_system *r, nh_ex e)
{
    char *text = nh_print_string(r->dag, disguised(r, e));
    fputs(text, out);
    nh_free(text);
}

static void write_current(FILE *out, random_system *r, const char *name, nh_ex e)
{
    fprintf(out, "    - {name: %s, expr: \"", name);
    write_expression(out, r, e);
    fputs("\"}\n", out);
}

/* The currents that were built in. */
static void write_known(FILE *out, random_system *r)
{
    nh_dag *d = r->dag;
    if (!r->energy && !r->cyclic && !r->rotation) return;
    fputs("known:\n  currents:\n", out);
    nh_ex p[MOST_COORDINATES], E = nh_neg(d, r->L);
    for (size_t i = 0; i < r->m; i++) {
        p[i] = nh_diff(d, r->L, r->V[i]);
        E = nh_add(d, E, nh_mul(d, p[i], r->V[i]));
    }
    if (r->energy) write_current(out, r, "energy", E);
    if (r->rotation) write_current(out, r, "rotation", nh_sub(d, nh_mul(d, r->Q[0], p[1]), nh_mul(d, r->Q[1], p[0])));
    for (size_t i = 0; i < r->m; i++) {
        char name[40];
        snprintf(name, sizeof name, "momentum%zu", i);
        if (is_cyclic(r, i)) write_current(out, r, name, i == 0 ? nh_sub(d, p[i], nh_mul(d, r->pull, r->t)) : p[i]);
    }
}

static void random_system_write(random_system *r, const char *name, FILE *out)
{
    fprintf(out, "name: %s\ntitle: %s%s%s, %zu cyclic%s%s%s\n", name, constraint_names[r->kind], r->energy ? ", energy" : "", r->rotation ? ", rotation" : "", r->cyclic,
            r->moves ? ", moving" : "", r->gauge ? ", gauge term" : "", r->pull ? ", uniform force" : "");
    if (r->parameters) fputs("parameters:\n", out);
    for (size_t i = 0; i < r->parameters; i++) fprintf(out, "  - {name: %s, value: %.15g}\n", r->parameter[i], r->value[i]);
    fputs("coordinates:\n", out);
    for (size_t i = 0; i < r->m; i++) fprintf(out, "  - {name: %s, type: %s}\n", r->name[i], r->angle[i] ? "angle" : "length");
    fputs("lagrangian: \"", out);
    write_expression(out, r, nh_add(r->dag, r->L, r->gauge));
    fputs("\"\n", out);
    if (r->k) fputs("constraints:\n", out);
    for (size_t a = 0; a < r->k; a++) {
        fputs("  - \"", out);
        write_expression(out, r, r->lhs[a]);
        fputs(" = ", out);
        write_expression(out, r, r->rhs[a]);
        fputs("\"\n", out);
    }
    write_known(out, r);
}

/* What is built in, in words (static). */
static inline const char *random_system_note(const random_system *r)
{
    static char text[120];
    snprintf(text, sizeof text, "%zu coordinates, %zu %s%s%s%s%s%s%s", r->m, r->k, constraint_names[r->kind], r->energy ? ", energy" : "", r->rotation ? ", rotation" : "",
             r->cyclic == 2 ? ", two momenta" : r->cyclic ? ", momentum" : "", r->moves ? ", moving" : "", r->gauge ? ", gauge" : "", r->pull ? ", force" : "");
    return text;
}

#endif
