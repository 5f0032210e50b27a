/* dimension: see dimension.h. */
#include "system/system_internal.h"

#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "system/units.h"

enum { longest_term = 80 };

typedef enum { UNSEEN, WANTED, UNKNOWN, NUMBER, KNOWN } knowledge;

typedef struct {
    unsigned char known; /* what is known of a unit */
    nh_unit unit;
} value;

typedef struct {
    nh_system *s;
    value *of; /* per node of the graph */
    nh_text *fault;
} checker;

static const nh_unit none = {.scale = 1};

/* ---- symbols ---- */

static nh_unit unit_of_coordinate(const nh_coordinate *c)
{
    nh_unit metre = {.power = {[NH_UNIT_METRE] = 1}, .scale = NAN};
    return *c->unit ? nh_unit_of(c->unit) : c->type == NH_LENGTH ? metre : none;
}

static bool has_unit(const nh_coordinate *c) { return *c->unit || c->type != NH_PLAIN; }

/* The unit of time is the second, unless some unit of the file contains another unit of time: then it is not known. */
static nh_unit unit_of_time(const nh_system *system)
{
    nh_unit second = {.power = {[NH_UNIT_SECOND] = 1}, .scale = 1};
    bool clock = false;
    for (size_t i = 0; i < system->parameters; i++) clock = clock || nh_unit_of(system->parameter[i].unit).clock;
    for (size_t i = 0; i < system->coordinates; i++) clock = clock || nh_unit_of(system->coordinate[i].unit).clock;
    if (clock) second.scale = NAN;
    return second;
}

static value value_of_symbol(const nh_system *system, nh_ex e)
{
    nh_unit time = unit_of_time(system);
    if (e == system->t) return (value){KNOWN, time};
    for (size_t i = 0; i < system->parameters; i++)
        if (e == system->parameter[i].symbol && *system->parameter[i].unit)
            return (value){KNOWN, nh_unit_of(system->parameter[i].unit)};
    for (size_t i = 0; i < system->coordinates; i++) {
        const nh_coordinate *c = &system->coordinate[i];
        if (!has_unit(c)) continue;
        if (e == c->q) return (value){KNOWN, unit_of_coordinate(c)};
        if (e == c->v) return (value){KNOWN, nh_unit_product(unit_of_coordinate(c), time, -1)};
    }
    return (value){UNKNOWN, none};
}

/* ---- expressions ---- */

static void put_term(checker *k, nh_ex e)
{
    char *text = nh_print_short(k->s->dag, e, longest_term);
    if (text) nh_text_addf(k->fault, "`%s`", text);
    else nh_text_add(k->fault, "a long term");
    nh_free(text);
}

/* Reports the first fault of an expression only: a later one may follow from it. */
static void tell(checker *k, nh_ex a, nh_unit first, nh_ex b, nh_unit second)
{
    if (k->fault->length) return;
    put_term(k, a);
    nh_text_add(k->fault, " has the unit ");
    nh_unit_print(first, k->fault);
    nh_text_add(k->fault, ", and ");
    put_term(k, b);
    nh_text_add(k->fault, " has ");
    nh_unit_print(second, k->fault);
}

static void want_none(checker *k, nh_ex e, const char *as)
{
    value v = k->of[e];
    if (v.known != KNOWN || nh_unit_equal(v.unit, none) || k->fault->length) return;
    put_term(k, e);
    nh_text_addf(k->fault, ", %s, has the unit ", as);
    nh_unit_print(v.unit, k->fault);
}

/* Compares terms that must have one unit; returns their unit, where one of them has one. */
static value of_terms(checker *k, nh_ex e, size_t n)
{
    value all = {NUMBER, none};
    nh_ex first = e;
    for (size_t i = 0; i < n; i++) {
        nh_ex term = nh_child(k->s->dag, e, i);
        value v = k->of[term];
        if (v.known == NUMBER) continue;
        if (v.known == KNOWN && all.known == KNOWN && !nh_unit_equal(v.unit, all.unit))
            tell(k, first, all.unit, term, v.unit);
        if (v.known == KNOWN && (all.known != KNOWN || isnan(all.unit.scale))) all = v, first = term;
        else if (all.known == NUMBER) all.known = UNKNOWN;
    }
    return all;
}

static value of_product(checker *k, nh_ex e)
{
    value all = {NUMBER, none};
    for (size_t i = 0, n = nh_arity(k->s->dag, e); i < n; i++) {
        nh_ex power = nh_exponent_of(k->s->dag, e, i);
        value v = k->of[nh_child(k->s->dag, e, i)];
        if (nh_kind_of(k->s->dag, power) != NH_NUMBER) {
            want_none(k, power, "an exponent");
            bool free = v.known == KNOWN && !nh_unit_equal(v.unit, none);
            v = (value){free ? UNKNOWN : v.known, none};
        }
        if (v.known == NUMBER) continue;
        if (v.known == UNKNOWN || all.known == UNKNOWN) all.known = UNKNOWN;
        else all = (value){KNOWN, nh_unit_product(all.unit, v.unit, nh_num_value(nh_number_of(k->s->dag, power)))};
    }
    return all;
}

static value of_function(checker *k, nh_ex e)
{
    nh_function f = nh_function_of(k->s->dag, e);
    if (f == NH_PI) return (value){NUMBER, none};
    if (f == NH_ABS) return k->of[nh_child(k->s->dag, e, 0)];
    if (nh_is_named_function(f)) return (value){UNKNOWN, none};
    if (f == NH_ATAN2) of_terms(k, e, 2);
    else if (f != NH_SIGN && f != NH_LOG)
        want_none(k, nh_child(k->s->dag, e, 0), "the argument of a function"); /* log(r): its derivatives have units */
    return (value){KNOWN, none};
}

static value value_of(checker *k, nh_ex e)
{
    switch (nh_kind_of(k->s->dag, e)) {
    case NH_NUMBER: return (value){NUMBER, none};
    case NH_SYMBOL: return value_of_symbol(k->s, e);
    case NH_SUM: return of_terms(k, e, nh_arity(k->s->dag, e));
    case NH_PRODUCT: return of_product(k, e);
    default: return of_function(k, e);
    }
}

/* A node comes after its children in the graph: one pass down for the required units, and one up for the units
 * found. */
static value check(checker *k, nh_ex root)
{
    nh_dag *d = k->s->dag;
    if (k->of[root].known == UNSEEN) k->of[root].known = WANTED;
    for (nh_ex e = root + 1; e-- > 0;) {
        if (k->of[e].known != WANTED || nh_kind_of(d, e) <= NH_SYMBOL) continue;
        for (size_t i = 0, n = nh_arity(d, e); i < n; i++) {
            nh_ex child = nh_child(d, e, i);
            if (k->of[child].known == UNSEEN) k->of[child].known = WANTED;
            if (nh_kind_of(d, e) != NH_PRODUCT) continue;
            nh_ex power = nh_exponent_of(d, e, i);
            if (k->of[power].known == UNSEEN) k->of[power].known = WANTED;
        }
    }
    for (nh_ex e = 0; e <= root; e++)
        if (k->of[e].known == WANTED) k->of[e] = value_of(k, e);
    return k->of[root];
}

/* ---- the parts of a file ---- */

static void add(checker *k, const nh_deck_node *node, const char *part, const char **note, size_t *count)
{
    if (k->fault->length)
        note[(*count)++] = nh_arena_printf(k->s->arena,
                                           "%s:%zu: units in %s do not agree: %s; numbers count without a unit: write "
                                           "one that has a unit as a parameter",
                                           nh_deck_name(node->deck), node->line, part, nh_text_string(k->fault));
    nh_text_clear(k->fault);
    nh_text_init(k->fault);
}

static void check_constraint(checker *k, const nh_constraint *c)
{
    nh_ex left = c->position ? c->level : c->lhs, right = c->position ? c->level : c->rhs;
    value a = check(k, left), b = check(k, right);
    if (a.known == KNOWN && b.known == KNOWN && !nh_unit_equal(a.unit, b.unit)) tell(k, left, a.unit, right, b.unit);
}

/* A generalized force times its coordinate is an energy. */
static void check_force(checker *k, size_t i, value energy)
{
    const nh_coordinate *c = &k->s->coordinate[i];
    value force = check(k, k->s->force[i]);
    if (force.known != KNOWN || energy.known != KNOWN || !has_unit(c)) return;
    nh_unit wanted = nh_unit_product(energy.unit, unit_of_coordinate(c), -1);
    if (nh_unit_equal(force.unit, wanted) || k->fault->length) return;
    put_term(k, k->s->force[i]);
    nh_text_add(k->fault, " has the unit ");
    nh_unit_print(force.unit, k->fault);
    nh_text_add(k->fault, ", and the Lagrangian by the coordinate ");
    nh_unit_print(wanted, k->fault);
}

static bool any_unit(const nh_system *system)
{
    for (size_t i = 0; i < system->parameters; i++)
        if (*system->parameter[i].unit) return true;
    for (size_t i = 0; i < system->coordinates; i++)
        if (*system->coordinate[i].unit) return true;
    return false;
}

size_t nh_dimension_check(nh_system *system, const char ***out)
{
    size_t count = 0;
    const nh_deck_node *root = nh_deck_root(system->deck), *lagrangian = nh_deck_get(root, "lagrangian"),
                       *forces = nh_deck_get(root, "forces");
    if (!forces) forces = nh_deck_get(root, "dissipation");
    const char **note = *out =
        nh_arena_alloc(system->arena, (system->constraints + system->coordinates + 2) * sizeof *note);
    if (system->chain || !lagrangian || !any_unit(system)) return 0;
    nh_text fault;
    nh_text_init(&fault);
    checker k = {system, nh_alloc_array(nh_dag_size(system->dag), sizeof *k.of), &fault};
    value energy = check(&k, system->lagrangian);
    bool good = !fault.length;
    add(&k, lagrangian, "the Lagrangian", note, &count);
    for (size_t i = 0; i < system->constraints; i++) {
        check_constraint(&k, &system->constraint[i]);
        add(&k, system->constraint[i].node, "a constraint", note, &count);
    }
    for (size_t i = 0; good && system->has_forces && i < system->coordinates; i++) {
        check_force(&k, i, energy);
        add(&k, forces, nh_arena_printf(system->arena, "the force on %s", system->coordinate[i].name), note, &count);
    }
    nh_free(k.of);
    nh_text_clear(&fault);
    return count;
}
