/* invariant_level: a system on a level of integrals that are affine in the velocities (`levels:`, --on).
 *
 * A motion of the system that begins on an invariant level P = c stays there by itself. So the system with the further
 * constraint P = c has the same motions there, and its multiplier vanishes, which nh_model_create proves: otherwise P =
 * c is no invariant level.
 *
 * The velocities are chosen anew. Where all constraints are linear they are coefficients of fields X_i without
 * denominators, in which the integrals on the level stay polynomials with simple coefficients: with b_i = dP(X_i) and a
 * pivot b_s,
 *
 *     b_s X_i - b_i X_s     for i /= s with b_i /= 0,          X_i     where b_i = 0
 *
 * from d/dq^s on, or from the velocities of the file where it has constraints. */
#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "system/system_internal.h"

typedef struct {
    nh_system *s;
    size_t n;
    nh_ex *field;        /* n x coordinates */
    const char **origin; /* names of the velocities from which they were made */
} basis;

/* ---- the fields ---- */

static nh_ex slope(const nh_system *system, nh_ex f, size_t i)
{
    return nh_simplify(system->dag, nh_diff(system->dag, f, system->coordinate[i].v));
}

static bool has_coordinates(const nh_system *system, nh_ex e)
{
    bool any = nh_depends(system->dag, e, system->t);
    for (size_t i = 0; i < system->coordinates; i++) any |= nh_depends(system->dag, e, system->coordinate[i].q);
    return any;
}

/* Constant ones first; then the one along a cyclic coordinate, which is an entry of the diagonal of the mass matrix for
 * its momentum. */
static size_t pivot_of(const basis *b, const nh_ex *entry)
{
    const nh_system *s = b->s;
    size_t best = b->n;
    int least = 3;
    for (size_t i = 0; i < b->n; i++) {
        if (nh_is_zero(s->dag, entry[i])) continue;
        bool cyclic = false;
        for (size_t j = 0; j < s->coordinates; j++)
            cyclic |= !nh_is_zero(s->dag, b->field[i * s->coordinates + j]) &&
                      !nh_depends(s->dag, s->lagrangian, s->coordinate[j].q);
        int cost = !has_coordinates(s, entry[i]) ? 0 : cyclic ? 1 : 2;
        if (cost < least) least = cost, best = i;
    }
    return best;
}

/* False: f contains no velocity of these fields. */
static bool restrict_to(basis *b, nh_ex f)
{
    nh_system *s = b->s;
    nh_dag *d = s->dag;
    size_t m = s->coordinates, kept = 0;
    nh_ex *entry = nh_arena_alloc(s->arena, (b->n + 1) * sizeof *entry);
    for (size_t i = 0; i < b->n; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t j = 0; j < m; j++) sum = nh_add(d, sum, nh_mul(d, slope(s, f, j), b->field[i * m + j]));
        entry[i] = nh_simplify(d, sum);
    }
    size_t pivot = pivot_of(b, entry);
    if (pivot == b->n) return false;
    nh_ex at = entry[pivot], *of = nh_arena_alloc(s->arena, m * sizeof *of);
    memcpy(of, b->field + pivot * m, m * sizeof *of);
    bool divided = !has_coordinates(s, at);
    for (size_t i = 0; i < b->n; i++) {
        if (i == pivot) continue;
        bool zero = nh_is_zero(d, entry[i]);
        nh_ex ratio = divided ? nh_div(d, entry[i], at) : entry[i];
        for (size_t j = 0; j < m; j++) {
            nh_ex own = b->field[i * m + j], scaled = divided || zero ? own : nh_mul(d, at, own);
            b->field[kept * m + j] = zero ? own : nh_simplify(d, nh_sub(d, scaled, nh_mul(d, ratio, of[j])));
        }
        b->origin[kept++] = b->origin[i];
    }
    b->n = kept;
    return true;
}

/* ---- constraints ---- */

/* Is f affine in the velocities, or linear? */
static bool is_affine(const nh_system *system, nh_ex f, bool *linear)
{
    nh_dag *d = system->dag;
    nh_ex rest = f;
    for (size_t i = 0; i < system->coordinates; i++) {
        nh_ex a = slope(system, f, i);
        for (size_t j = 0; j < system->coordinates; j++)
            if (nh_depends(d, a, system->coordinate[j].v)) return false;
        rest = nh_sub(d, rest, nh_mul(d, a, system->coordinate[i].v));
    }
    *linear = nh_is_zero(d, nh_simplify(d, rest));
    return true;
}

/* Fields that the first `given` constraints allow; false: they are not linear. */
static bool begin(basis *b, nh_system *system, size_t given)
{
    nh_dag *d = system->dag;
    size_t m = system->coordinates;
    bool mapped = given && system->quasi, linear = true;
    *b = (basis){.s = system, .n = mapped ? system->quasi : m};
    b->field = nh_arena_alloc(system->arena, (m * m + 1) * sizeof *b->field);
    b->origin = nh_arena_alloc(system->arena, (m + 1) * sizeof *b->origin);
    for (size_t i = 0; i < b->n; i++)
        b->origin[i] = mapped ? nh_name_of(d, system->quasi_velocity[i]) : system->coordinate[i].name;
    for (size_t i = 0; i < b->n; i++)
        for (size_t j = 0; j < m; j++)
            b->field[i * m + j] =
                mapped ? nh_diff(d, system->quasi_map[j], system->quasi_velocity[i]) : nh_int(d, i == j);
    for (size_t j = 0; mapped && j < m && linear; j++) {
        nh_ex rest = system->quasi_map[j];
        for (size_t i = 0; i < b->n; i++)
            rest = nh_sub(d, rest, nh_mul(d, b->field[i * m + j], system->quasi_velocity[i]));
        linear = nh_is_zero(d, nh_simplify(d, rest));
    }
    for (size_t a = 0; !mapped && a < given && linear; a++) {
        nh_ex f = nh_sub(d, system->constraint[a].lhs, system->constraint[a].rhs);
        linear = is_affine(system, f, &linear) && linear && restrict_to(b, f);
    }
    return linear;
}

/* v_x for what began as the velocity x. */
static const char *name_of(const basis *b, size_t i)
{
    nh_system *s = b->s;
    const char *name = nh_arena_printf(s->arena, "v_%s", b->origin[i]);
    nh_ex taken;
    while (nh_symbol_find(s->dag, name, &taken)) name = nh_arena_printf(s->arena, "%s_", name);
    return name;
}

static void take_velocities(const basis *b)
{
    nh_system *system = b->s;
    size_t m = system->coordinates;
    system->quasi = b->n;
    system->quasi_velocity = nh_arena_alloc(system->arena, (b->n + 1) * sizeof *system->quasi_velocity);
    system->quasi_map = nh_arena_alloc(system->arena, (m + 1) * sizeof *system->quasi_map);
    for (size_t i = 0; i < b->n; i++) system->quasi_velocity[i] = nh_symbol(system->dag, name_of(b, i));
    for (size_t j = 0; j < m; j++) {
        nh_ex sum = nh_int(system->dag, 0);
        for (size_t i = 0; i < b->n; i++)
            sum = nh_add(system->dag, sum, nh_mul(system->dag, b->field[i * m + j], system->quasi_velocity[i]));
        system->quasi_map[j] = sum;
    }
}

/* ---- reading ---- */

/* "p_phi" is dL/dphi'. */
static nh_named *momenta(nh_system_reader *r, size_t *count)
{
    nh_system *system = r->system;
    nh_named *p = nh_system_take(r, system->coordinates, sizeof *p);
    nh_ex taken;
    for (size_t i = 0; i < system->coordinates; i++) {
        const char *name = nh_arena_printf(system->arena, "p_%s", system->coordinate[i].name);
        if (nh_symbol_find(system->dag, name, &taken)) continue;
        p[(*count)++] = (nh_named){
            .name = name, .text = name, .value = nh_diff(system->dag, system->lagrangian, system->coordinate[i].v)};
    }
    return p;
}

static bool read_level(nh_system_reader *r, const nh_deck_node *node, size_t count, const nh_named *momentum,
                       bool *linear)
{
    nh_system *system = r->system;
    nh_constraint *c = &system->constraint[system->constraints];
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "a level `... = ...`", r->error)) return false;
    *c = (nh_constraint){.text = node->text, .node = node};
    if (!nh_system_read_expression(system, r->deck, node, 0, NH_NO_QUASI, count, momentum, &c->lhs, &c->rhs, r->error))
        return false;
    nh_ex f = nh_sub(system->dag, c->lhs, c->rhs);
    bool moving = false, own;
    for (size_t j = 0; j < system->coordinates; j++) moving |= !nh_is_zero(system->dag, slope(system, f, j));
    if (!moving || !is_affine(system, f, &own)) {
        nh_deck_fail(r->deck, node, 0, r->error,
                     moving ? "this level is not linear in the velocities" : "this level contains no velocity");
        return nh_error_hint(
            r->error, "write it as a momentum or another integral linear in the velocities, for example `p_%s = 0`",
            system->coordinate[0].name);
    }
    *linear &= own;
    system->constraints++;
    system->levels++;
    return true;
}

bool nh_system_read_levels(nh_system_reader *r)
{
    const nh_deck_node *list;
    nh_system *system = r->system;
    size_t n, given = system->constraints, count = 0;
    if (!nh_system_list_of(r, r->root, "levels", &list, &n)) return false;
    if (!n) return true;
    basis b;
    bool linear = begin(&b, system, given);
    nh_constraint *all = nh_system_take(r, given + n, sizeof *all);
    memcpy(all, system->constraint, given * sizeof *all);
    system->constraint = all;
    const nh_named *momentum = momenta(r, &count);
    for (size_t i = 0; i < n; i++)
        if (!read_level(r, list->item[i], count, momentum, &linear)) return false;
    for (size_t a = given; a < system->constraints && linear; a++)
        linear = restrict_to(&b, nh_sub(system->dag, system->constraint[a].lhs, system->constraint[a].rhs));
    system->dependents = system->quasi = 0;
    if (linear) take_velocities(&b);
    return true;
}

bool nh_system_refuse_level(const nh_system *system, size_t level, bool proved, nh_error *error)
{
    const nh_constraint *c = &system->constraint[system->constraints - system->levels + level];
    nh_deck_fail(system->deck, c->node, 0, error,
                 proved ? "motions leave this level: it is not one of an integral"
                        : "whether motions stay on this level was not decided");
    for (size_t i = 0; i < system->coordinates; i++)
        if (!nh_depends(system->dag, system->lagrangian, system->coordinate[i].q))
            return nh_error_hint(error, "%s does not occur in the Lagrangian: `p_%s` may be constant",
                                 system->coordinate[i].name, system->coordinate[i].name);
    return nh_error_hint(error, "`nhsym analyze` without this level lists what is conserved");
}
