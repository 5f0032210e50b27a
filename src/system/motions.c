/* motions: closed forms of a system's motions, as its file knows them (known: motions:). */
#include <string.h>

#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "system/system_internal.h"

/* start: [p = phi, s = sqrt(v^2 + p^2)], each in the initial state and those before it.  In the motion their names are
   symbols of their own. */
static bool read_start(nh_system_reader *r, const nh_deck_node *item, nh_known_motion *out, nh_named *symbols)
{
    nh_system *system = r->system;
    const nh_deck_node *list;
    size_t n;
    if (!nh_system_list_of(r, item, "start", &list, &n)) return false;
    for (size_t i = 0; i < n; i++) {
        const nh_deck_node *node = list->item[i];
        nh_named *start = &out->start[i];
        if (!nh_system_assignment_name(r, node, "a value at the start `name = expression`", &start->name)) return false;
        nh_deck_node name = *node;
        name.text = start->name;
        if (!nh_system_new_name(r, &name)) return false;
        for (size_t j = 0; j < i; j++)
            if (!strcmp(out->start[j].name, start->name))
                return nh_deck_fail(r->deck, node, 0, r->error, "`%s` is declared twice", start->name);
        if (!nh_system_right_side(system, r->deck, node, i, out->start, &start->value, r->error)) return false;
        symbols[i] = (nh_named){.name = start->name, .value = nh_symbol_fresh(system->dag, start->name)};
        out->symbol[i] = symbols[i].value;
        out->starts = i + 1;
    }
    return true;
}

/* when: equations that the initial state has to satisfy. */
static bool read_conditions(nh_system_reader *r, const nh_deck_node *item, nh_known_motion *out)
{
    nh_system *system = r->system;
    const nh_deck_node *list;
    size_t n;
    if (!nh_system_list_of(r, item, "when", &list, &n)) return false;
    out->condition = nh_system_take(r, n, sizeof *out->condition);
    for (size_t i = 0; i < n; i++) {
        nh_ex left, right;
        if (!nh_deck_is(r->deck, list->item[i], NH_DECK_SCALAR, "a condition `... = ...`", r->error) ||
            !nh_system_read_expression(system, r->deck, list->item[i], 0, 0, out->starts, out->start, &left, &right,
                                       r->error))
            return false;
        out->condition[out->conditions++] = nh_sub(system->dag, left, right);
    }
    return true;
}

/* Does the formula contain a variable other than t?  Which? */
static bool depends_on_state(nh_system_reader *r, nh_ex e, const char **which)
{
    const nh_system *system = r->system;
    const char **names = nh_system_take(r, 2 * system->coordinates + system->quasi + 1, sizeof *names);
    size_t n = nh_system_state_names(system, names);
    for (size_t i = 1; i < n; i++) { /* the first is t */
        nh_ex symbol;
        *which = names[i];
        if (nh_symbol_find(system->dag, names[i], &symbol) && nh_depends(system->dag, e, symbol)) return true;
    }
    return false;
}

/* motion: [phi = ..., y = ...], in t, parameters and the names of `start`. */
static bool read_motion(nh_system_reader *r, const nh_deck_node *item, const nh_named *symbols, nh_known_motion *out)
{
    nh_system *system = r->system;
    const nh_deck_node *list;
    size_t n;
    if (!nh_system_list_of(r, item, "motion", &list, &n)) return false;
    if (!n)
        return nh_deck_fail(r->deck, item, 0, r->error,
                            "a motion needs the key `motion`: its coordinates as functions of time"),
               nh_error_hint(r->error, "for example: motion: [%s = 2*t]", system->coordinate[0].name);
    for (size_t i = 0; i < n; i++) {
        const nh_deck_node *node = list->item[i];
        const char *name, *which;
        nh_ex e;
        if (!nh_system_assignment_name(r, node, "a line `coordinate = expression` of a motion", &name)) return false;
        long index = nh_system_coordinate(system, name);
        if (index < 0) {
            nh_deck_fail(r->deck, node, 0, r->error, "`%s` is not a coordinate", name);
            return nh_error_hint(r->error, "the velocities are the time derivatives of the coordinates");
        }
        if (out->given[index]) return nh_deck_fail(r->deck, node, 0, r->error, "`%s` is given twice", name);
        size_t skip = (size_t)(strchr(node->text, '=') - node->text) + 1;
        if (!nh_system_read_expression(system, r->deck, node, skip, 0, out->starts, symbols, NULL, &e, r->error))
            return false;
        if (depends_on_state(r, e, &which)) {
            nh_deck_fail(r->deck, node, skip, r->error, "a motion is written in t, but this contains `%s`", which);
            return nh_error_hint(r->error, "`start: [%s0 = %s]` names its value at the start",
                                 system->coordinate[0].name, system->coordinate[0].name);
        }
        out->given[index] = true;
        out->value[index] = e;
        out->values++;
    }
    return true;
}

static bool read_one(nh_system_reader *r, const nh_deck_node *item, nh_known_motion *out)
{
    static const char *const keys[] = {"name", "doc", "when", "start", "motion"};
    const char *doc; /* text for readers of the file */
    nh_system *system = r->system;
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a motion {name: ..., motion: [...]}", r->error) ||
        !nh_deck_only(r->deck, item, keys, sizeof keys / sizeof *keys, r->error))
        return false;
    if (!nh_system_text_of(r, item, "name", "closed form", &out->name) || !nh_system_text_of(r, item, "doc", "", &doc))
        return false;
    const nh_deck_node *start = nh_deck_get(item, "start");
    size_t n = start ? start->count : 0;
    nh_named *symbols = nh_system_take(r, n, sizeof *symbols);
    out->start = nh_system_take(r, n, sizeof *out->start);
    out->symbol = nh_system_take(r, n, sizeof *out->symbol);
    out->given = nh_system_take(r, system->coordinates, sizeof *out->given);
    out->value = nh_system_take(r, system->coordinates, sizeof *out->value);
    return read_start(r, item, out, symbols) && read_conditions(r, item, out) && read_motion(r, item, symbols, out);
}

static bool read_all(nh_system_reader *r, const nh_deck_node *known, size_t *count, nh_known_motion **out)
{
    const nh_deck_node *list;
    size_t n;
    *out = NULL;
    *count = 0;
    if (!known || !nh_system_list_of(r, known, "motions", &list, &n)) return !known;
    *out = nh_system_take(r, n, sizeof **out);
    for (*count = 0; *count < n; ++*count)
        if (!read_one(r, list->item[*count], &(*out)[*count])) return false;
    return true;
}

/* The names of a system, in a graph of their own; definitions stand for themselves. */
static nh_system *names_of(const nh_system *system)
{
    nh_arena *arena = nh_arena_create();
    nh_system *n = nh_arena_alloc(arena, sizeof *n);
    *n = (nh_system){.arena = arena,
                     .dag = nh_dag_create(),
                     .name = system->name,
                     .parameters = system->parameters,
                     .coordinates = system->coordinates,
                     .definitions = system->definitions,
                     .quasi = system->quasi};
    n->t = nh_symbol(n->dag, "t");
    nh_declared_names(n->dag, system->dag);
    n->parameter = nh_arena_alloc(arena, (system->parameters + 1) * sizeof *n->parameter);
    n->coordinate = nh_arena_alloc(arena, (system->coordinates + 1) * sizeof *n->coordinate);
    n->definition = nh_arena_alloc(arena, (system->definitions + 1) * sizeof *n->definition);
    n->quasi_velocity = nh_arena_alloc(arena, (system->quasi + 1) * sizeof *n->quasi_velocity);
    for (size_t i = 0; i < system->parameters; i++)
        n->parameter[i] =
            (nh_parameter){.name = system->parameter[i].name, .symbol = nh_symbol(n->dag, system->parameter[i].name)};
    for (size_t i = 0; i < system->coordinates; i++)
        n->coordinate[i] = (nh_coordinate){.name = system->coordinate[i].name,
                                           .q = nh_symbol(n->dag, system->coordinate[i].name),
                                           .v = nh_symbol(n->dag, nh_name_of(system->dag, system->coordinate[i].v))};
    for (size_t i = 0; i < system->definitions; i++)
        n->definition[i] = (nh_named){.name = system->definition[i].name,
                                      .value = nh_symbol_fresh(n->dag, system->definition[i].name)};
    for (size_t i = 0; i < system->quasi; i++)
        n->quasi_velocity[i] = nh_symbol(n->dag, nh_name_of(system->dag, system->quasi_velocity[i]));
    return n;
}

/* Are they well formed?  They are not parsed into the system's graph, where they would change the order in which sums
 * are printed. */
bool nh_system_check_motions(nh_system_reader *r, const nh_deck_node *known)
{
    nh_known_motion *ignored;
    size_t count;
    if (!nh_deck_get(known, "motions")) return true;
    nh_system_reader own = {.system = names_of(r->system), .deck = r->deck, .root = r->root, .error = r->error};
    bool good = read_all(&own, known, &count, &ignored);
    nh_dag_free(own.system->dag);
    nh_arena_free(own.system->arena);
    return good;
}

bool nh_system_motions(nh_system *s, size_t *count, nh_known_motion **out, nh_error *error)
{
    nh_system_reader r = {.system = s, .deck = s->deck, .root = nh_deck_root(s->deck), .error = error};
    return read_all(&r, nh_deck_get(r.root, "known"), count, out);
}
