/* explicit_motion_rates: du/ds = Gamma(u)/Gamma(s) = A u + B, integrated. [docs/method.md, (13a)]
 *
 *     read_equation    r = own/speed with the solved states put in; A and B where it is linear in u
 *     integrate        int f ds: squares out of roots, |u| = side u, antiderivative, signs put back
 *     solve_linear     u = (C + int mu B ds)/mu, mu = exp(-int A ds) */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "exact/walls.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/named_function.h"
#include "graph/node.h"
#include "search/explicit_motion_internal.h"

/* |u| and sign(u) of functions u of s, which are side u and side wherever u has one sign. */
typedef struct {
    nh_explicit_curve *curve;
    nh_wall_sides sides;
} pieces;

static nh_ex side_on_curve(void *pieces_, nh_ex u)
{
    pieces *p = pieces_;
    return nh_depends(p->curve->d, u, p->curve->s) ? nh_walls_side(&p->sides, u) : 0;
}

static nh_ex with_sides(pieces *p, nh_ex e) { return nh_walls_piece(p->curve->d, e, side_on_curve, p); }

/* sqrt(u^2 v) as |u| sqrt(v), with functions u of s: on each side of u = 0 that can be integrated. */
static nh_ex squares_out(const nh_explicit_curve *c, nh_ex f)
{
    nh_dag *d = c->d;
    NH_LIST(base);
    nh_ex outside, inside;
    size_t n = nh_radicands_in(d, f, &base);
    for (size_t i = 0; i < n; i++) {
        if (!nh_depends(d, base[i], c->s) || nh_explicit_too_long(c, base[i])) continue;
        bool square = nh_square_split(d, nh_simplify_short(d, base[i], 0), &outside, &inside);
        if (!square || !nh_depends(d, outside, c->s)) continue;
        f = nh_substitute_root(d, f, base[i], nh_mul(d, nh_call(d, NH_ABS, outside), nh_sqrt(d, inside)));
    }
    return f;
}

/* Is it real at all points?  An elliptic integral can leave the real numbers where its amplitude goes on. */
static bool is_real(const nh_explicit_curve *c, nh_ex F)
{
    nh_ex here = nh_explicit_at_points(c, F);
    double *value = nh_alloc_array(c->points->count + 1, sizeof *value);
    bool real = true;
    nh_points_evaluate(c->points, c->o, 1, &here, value);
    for (size_t p = 0; p < c->points->count; p++) real &= isfinite(value[p]);
    nh_free(value);
    return real;
}

static int sign_on_sides(void *context, nh_ex e)
{
    const pieces *p = context;
    return nh_explicit_sign(p->curve, nh_walls_signs(&p->sides, e));
}

static int most_on_sides(void *context, nh_ex e)
{
    const pieces *p = context;
    return nh_explicit_mostly(p->curve, nh_walls_signs(&p->sides, e));
}

typedef struct {
    nh_dag *d;
    nh_ex f, root, sign;
} elliptic_sign;

static nh_ex with_sign(void *elliptic_sign_, nh_ex call)
{
    const elliptic_sign *x = elliptic_sign_;
    bool integral = nh_is_incomplete_elliptic(nh_function_of(x->d, call)) && !nh_depends(x->d, x->f, call);
    return integral && !nh_depends(x->d, call, x->root) ? nh_mul(x->d, x->sign, call) : 0;
}

/* Elliptic integrals of the root of a radicand, with its sign where it does not stand in them; those in f are there
 * already. */
static nh_ex with_sign_of_root(nh_dag *d, nh_ex f, nh_ex F, nh_ex root)
{
    return nh_substitute_calls(d, F, with_sign, &(elliptic_sign){d, f, root, nh_call(d, NH_SIGN, root)});
}

/* int f ds, in which roots are written as such; its constant may be another one on either side of a zero of u. */
static bool integrate(nh_explicit_curve *c, nh_ex f, nh_ex *F)
{
    nh_dag *d = c->d;
    const nh_explicit_motion *m = c->m;
    if (nh_explicit_has_integral(c, f)) return false;
    nh_ex own = 0; /* the root in f */
    size_t roots = 0;
    for (size_t i = m->roots; i-- > 0;) {
        nh_ex root = nh_sqrt(d, c->radicand[i]);
        if (nh_depends(d, f, m->root[i].symbol) && nh_depends(d, root, c->s)) own = m->root[i].symbol, roots++;
        f = nh_substitute(d, f, 1, &m->root[i].symbol, &root);
    }
    f = squares_out(c, f);
    pieces p = {.curve = c, .sides.dag = d};
    nh_ex piece = with_sides(&p, f), *constant = nh_alloc_array(c->symbols + NH_MOST_SIDES, sizeof *constant);
    memcpy(constant, c->symbol, c->symbols * sizeof *constant);
    memcpy(constant + c->symbols, p.sides.symbol, p.sides.count * sizeof *constant);
    nh_integration in = {.dag = d,
                         .x = c->s,
                         .constants = c->symbols + p.sides.count,
                         .constant = constant,
                         .max_terms = (size_t)c->options->proof_terms,
                         .elliptic = roots <= 1,
                         .sign = sign_on_sides,
                         .mostly = most_on_sides,
                         .context = &p};
    /* amplitudes of elliptic integrals as they are, else those that jump */
    bool found = false;
    for (int within = 0; within < 2 && !found; within++) {
        in.within_half_turn = within;
        if (!nh_antiderivative(&in, piece, F)) break;
        for (size_t i = m->roots; i-- > 0;)
            *F = nh_substitute_root(d, *F, with_sides(&p, c->radicand[i]), m->root[i].symbol);
        *F = nh_walls_signs(&p.sides, roots ? with_sign_of_root(d, f, *F, own) : *F);
        found = !nh_named_function_has_elliptic(d, *F) || is_real(c, *F);
    }
    nh_free(constant);
    return found;
}

/* A name for int f ds, which is 0 where the motion starts. */
static bool name_integral(nh_explicit_curve *c, nh_ex f, nh_ex *F)
{
    nh_explicit_motion *m = c->m;
    f = nh_explicit_simple(c, f);
    if (m->integrals == c->most_named || nh_explicit_too_long(c, f)) return false;
    *F = nh_symbol_fresh(c->d, nh_arena_printf(c->arena, "J%zu", m->integrals + 1));
    nh_diff_rule(c->d, *F, c->s, f);
    m->integral[m->integrals++] = (nh_motion_integral){*F, f};
    return true;
}

/* du/ds = A u + B */
static bool solve_linear(nh_explicit_curve *c, size_t u, nh_ex A, nh_ex B, bool named)
{
    nh_dag *d = c->d;
    nh_ex I = nh_int(d, 0), G, mu;
    size_t before = c->m->integrals;
    if (!nh_is_zero(d, A) && !integrate(c, A, &I) && !(named && name_integral(c, A, &I))) return false;
    mu = nh_antiderivative_factor(c->d, I);
    if (!integrate(c, nh_mul(d, mu, B), &G) && !(named && name_integral(c, nh_mul(d, mu, B), &G))) {
        c->m->integrals = before;
        return false;
    }
    nh_ex constant = nh_explicit_constant(c, nh_sub(d, nh_mul(d, mu, c->m->state[u]), G), true);
    nh_explicit_settle(c, u, nh_explicit_simple(c, nh_div(d, nh_add(d, constant, G), mu)));
    return true;
}

/* Does own/speed depend on more than one unsolved state?  Yes, if several of them occur in one of the two alone. */
static bool depends_on_many(const nh_explicit_curve *c, nh_ex own, nh_ex speed)
{
    enum { few = 3 }; /* some may go when it is simplified, which takes long */
    size_t count = 0;
    for (size_t i = 0; i < c->m->states && count <= few; i++) {
        if (c->solved[i] || i == c->m->parameter) continue;
        count += nh_depends(c->d, own, c->m->state[i]) != nh_depends(c->d, speed, c->m->state[i]);
    }
    return count > few;
}

static void read_equation(nh_explicit_curve *c, size_t u, nh_ex speed)
{
    nh_ex own = nh_explicit_along(c, c->rate[u]), k[3];
    nh_explicit_equation *q = &c->equation[u], before = *q;
    if (before.made && before.own == own && before.speed == speed) { /* what was solved does not stand in it */
        q->read = true;
        return;
    }
    *q = (nh_explicit_equation){.read = true, .made = true, .state = u, .own = own, .speed = speed};
    if (nh_explicit_too_long(c, own) || depends_on_many(c, own, speed)) return;
    q->r = nh_explicit_split_roots(c, nh_explicit_simple(c, nh_div(c->d, own, speed)));
    size_t last = u, n = nh_explicit_unknowns(c, q->r, &last);
    q->linear =
        n <= 1 && last == u && !nh_explicit_too_long(c, q->r) && nh_explicit_degree(c, q->r, c->m->state[u], k) <= 1;
    if (!q->linear) return;
    q->refused = before.refused && before.r == q->r;
    q->length = nh_complexity(c->d, q->r);
    q->A = k[1];
    q->B = k[0];
}

/* Of the states that are not solved; `named`: also those that were refused. */
static size_t equations(nh_explicit_curve *c, bool named, nh_explicit_equation *out)
{
    nh_ex speed = nh_explicit_along(c, c->rate[c->m->parameter]);
    size_t count = 0;
    if (nh_explicit_too_long(c, speed)) return 0;
    for (size_t u = 0; u < c->m->states; u++) {
        if (c->solved[u]) continue;
        if (!c->equation[u].read) read_equation(c, u, speed);
        if (c->equation[u].linear && (named || !c->equation[u].refused)) out[count++] = c->equation[u];
    }
    return count;
}

static int by_length(const void *left, const void *right)
{
    const nh_explicit_equation *a = left, *b = right;
    return a->length != b->length ? (a->length < b->length ? -1 : 1) : a->state < b->state ? -1 : a->state > b->state;
}

/* The time first, along combined coordinates: it makes the other states known that a current gives with it. */
static int time_first(const void *left, const void *right)
{
    const nh_explicit_equation *a = left, *b = right;
    return !a->state != !b->state ? (a->state ? 1 : -1) : by_length(left, right);
}

/* The shortest first. */
bool nh_explicit_solve_rate(nh_explicit_curve *c, bool named)
{
    nh_explicit_equation *list = nh_alloc_array(c->m->states + 1, sizeof *list);
    size_t count = equations(c, named, list);
    bool solved = false;
    qsort(list, count, sizeof *list, c->combined ? time_first : by_length);
    for (size_t i = 0; i < count && !solved && nh_explicit_room(c); i++) {
        size_t u = list[i].state;
        solved = solve_linear(c, u, list[i].A, list[i].B, named);
        if (!solved) c->equation[u].refused = true;
    }
    nh_free(list);
    return solved;
}
