/* system_read: a system file, key by key. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/parse.h"
#include "system/ordinary.h"
#include "system/system_internal.h"
#include "system/units.h"

typedef nh_system_reader reader;

void *nh_system_take(reader *r, size_t count, size_t size)
{
    return nh_arena_alloc(r->system->arena, (count + 1) * size);
}

/* The list under `key`; an absent key is an empty list. */
bool nh_system_list_of(reader *r, const nh_deck_node *map, const char *key, const nh_deck_node **out, size_t *count)
{
    *out = nh_deck_get(map, key);
    *count = 0;
    if (!*out) return true;
    if (!nh_deck_is(r->deck, *out, NH_DECK_LIST, key, r->error)) return false;
    *count = (*out)->count;
    return true;
}

/* The text under `key`, or the fallback. */
bool nh_system_text_of(reader *r, const nh_deck_node *map, const char *key, const char *fallback, const char **out)
{
    const nh_deck_node *node = nh_deck_get(map, key);
    *out = node ? node->text : fallback;
    return !node || nh_deck_is(r->deck, node, NH_DECK_SCALAR, key, r->error);
}

/* Is `name` free and well formed? */
bool nh_system_new_name(reader *r, const nh_deck_node *node)
{
    const nh_system *system = r->system;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "a name", r->error)) return false;
    const char *name = node->text;
    if (!nh_is_name(name)) {
        nh_deck_fail(r->deck, node, 0, r->error, "`%s` is not a name", name);
        return nh_name_hint(r->error, name);
    }
    if (nh_is_reserved(name)) {
        nh_deck_fail(r->deck, node, 0, r->error, "`%s` has a meaning of its own and cannot be redefined", name);
        return nh_error_hint(r->error, "choose another name, for instance `%s1`", name);
    }
    nh_ex taken;
    size_t function;
    if (nh_symbol_find(system->dag, name, &taken) || nh_declared_find(system->dag, name, &function))
        return nh_deck_fail(r->deck, node, 0, r->error, "`%s` is declared twice", name);
    for (size_t i = 0; i < system->definitions; i++)
        if (!strcmp(system->definition[i].name, name))
            return nh_deck_fail(r->deck, node, 0, r->error, "`%s` is declared twice", name);
    return true;
}

/* The unit of a parameter or coordinate; absent: none. */
static bool read_unit(reader *r, const nh_deck_node *item, const char **out)
{
    nh_unit_fault fault;
    if (!nh_system_text_of(r, item, "unit", "", out)) return false;
    if (nh_is_unit(*out, &fault)) return true;
    nh_deck_fail(r->deck, nh_deck_get(item, "unit"), fault.offset, r->error, "unknown unit `%.*s`", (int)fault.length,
                 *out + fault.offset);
    if (fault.nearest) return nh_error_hint(r->error, "did you mean `%s`?", fault.nearest);
    return nh_error_hint(r->error, "use SI units and units accepted with them, such as m, kg m^2, N/m, rad/s, 1/s, "
                                   "deg; write any other unit under `doc`");
}

static bool read_parameters(reader *r)
{
    static const char *const keys[] = {"name", "value", "unit", "doc", "input"};
    const nh_deck_node *list = nh_deck_get(r->root, "parameters");
    nh_system *system = r->system;
    if (list) list = nh_deck_named(r->deck, "value", list);
    if (list && !nh_deck_is(r->deck, list, NH_DECK_LIST, "parameters", r->error)) return false;
    size_t n = list ? list->count : 0;
    system->parameter = nh_system_take(r, n, sizeof *system->parameter);
    for (size_t i = 0; i < n; i++) {
        const nh_deck_node *item = list->item[i];
        bool name_alone = item->kind == NH_DECK_SCALAR && nh_is_name(item->text);
        if (name_alone) return nh_ordinary_ask_values(r->deck, list, item, r->error);
        if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a parameter {name: ..., value: ...}", r->error)) return false;
        if (!nh_deck_only(r->deck, item, keys, 5, r->error)) return false;
        const nh_deck_node *name = nh_deck_get(item, "name"), *value = nh_deck_get(item, "value");
        if (!name) return nh_deck_fail(r->deck, item, 0, r->error, "this parameter has no `name`");
        if (!nh_system_new_name(r, name)) return false;
        nh_parameter *p = &system->parameter[i];
        *p = (nh_parameter){.name = name->text};
        if (!read_unit(r, item, &p->unit) || !nh_system_text_of(r, item, "doc", "", &p->doc) ||
            !nh_system_truth_of(r, item, "input", "an input may change with time: `nhsym export` makes it an argument",
                                &p->input))
            return false;
        if (!value) return nh_deck_fail(r->deck, item, 0, r->error, "the parameter `%s` has no `value`", p->name);
        if (!nh_deck_number(r->deck, value, "the value of a parameter", &p->value, r->error))
            return nh_unit_hint(value->text, r->error);
        p->symbol = nh_symbol(system->dag, p->name);
        system->parameters = i + 1;
    }
    return true;
}

static bool read_type(reader *r, const nh_deck_node *node, nh_coordinate_type *out)
{
    static const char *const names[] = {"angle", "length", "number", "orientation"};
    static const nh_coordinate_type types[] = {NH_ANGLE, NH_LENGTH, NH_PLAIN};
    *out = NH_PLAIN;
    if (!node) return true;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "a type", r->error)) return false;
    for (int i = 0; i < 3; i++) {
        if (strcmp(node->text, names[i])) continue;
        *out = types[i];
        return true;
    }
    nh_deck_fail(r->deck, node, 0, r->error, "unknown type `%s`; expected angle, length, number or orientation",
                 node->text);
    const char *near = nh_text_nearest(node->text, names, 4);
    if (near) return nh_error_hint(r->error, "did you mean `%s`?", near);
    nh_unit_fault fault;
    return nh_is_unit(node->text, &fault)
               ? nh_error_hint(r->error, "a unit stands beside it: {type: length, unit: %s}", node->text)
               : false;
}

static bool read_coordinate(reader *r, const nh_deck_node *item)
{
    static const char *const keys[] = {"name", "type", "doc", "unit"}, *const turn_keys[] = {"name", "type", "doc",
                                                                                             "velocities", "frame"};
    nh_system *system = r->system;
    nh_coordinate *c = &system->coordinate[system->coordinates];
    const nh_deck_node *name = item, *type;
    *c = (nh_coordinate){.unit = "", .doc = "", .type = NH_PLAIN};
    if (item->kind != NH_DECK_SCALAR) {
        if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a coordinate {name: ..., type: ...}", r->error)) return false;
        type = nh_deck_get(item, "type");
        bool turns = type && type->kind == NH_DECK_SCALAR && !strcmp(type->text, "orientation");
        size_t count = turns ? sizeof turn_keys / sizeof *turn_keys : sizeof keys / sizeof *keys;
        if (!nh_deck_only(r->deck, item, turns ? turn_keys : keys, count, r->error)) return false;
        name = nh_deck_get(item, "name");
        if (!name) return nh_deck_fail(r->deck, item, 0, r->error, "this coordinate has no `name`");
        if (!nh_system_text_of(r, item, "doc", "", &c->doc)) return false;
        if (turns) return nh_orientation_declare(r, item, name, c->doc);
        if (!read_type(r, type, &c->type) || !read_unit(r, item, &c->unit)) return false;
    }
    if (!nh_system_new_name(r, name)) return false;
    c->name = name->text;
    c->q = nh_symbol(system->dag, c->name);
    system->coordinates++;
    return true;
}

static bool is_symbol(void *dag, const char *name)
{
    nh_ex any;
    return nh_symbol_find(dag, name, &any);
}

static bool read_coordinates(reader *r)
{
    enum { most_coordinates = 100 };
    const nh_deck_node *list = nh_deck_get(r->root, "coordinates");
    size_t n = list ? list->count : 0;
    nh_system *system = r->system;
    if (list && list->kind != NH_DECK_SCALAR) list = nh_deck_named(r->deck, "type", list);
    else if (!nh_system_list_of(r, r->root, "coordinates", &list, &n)) return false;
    if (n + (system->chain ? system->chain->screws : 0) == 0) {
        nh_deck_fail(r->deck, list ? list : NULL, 0, r->error, "a system needs at least one coordinate");
        if (system->chain)
            return nh_error_hint(r->error, "every joint is fixed: --base floating (or `base: floating`) lets the body "
                                           "that carries all others move");
        const char *lines = list ? NULL : nh_ordinary_declare_all(r->deck, is_symbol, system->dag);
        if (lines) return nh_error_hint(r->error, "%s", lines);
        return nh_error_hint(r->error, "for example: coordinates: [{name: x, type: length}, {name: phi, type: angle}]");
    }
    if (n > most_coordinates) {
        nh_deck_fail(r->deck, list, 0, r->error, "there are %zu coordinates; at most %d are possible", n,
                     most_coordinates);
        return nh_error_hint(
            r->error, "the program inverts matrices of this size symbolically: remove coordinates that do not move");
    }
    size_t most = 3 * n + (system->chain ? system->chain->screws : 0);
    system->coordinate = nh_system_take(r, most, sizeof *system->coordinate);
    system->orientation = nh_system_take(r, most, sizeof *system->orientation);
    for (size_t i = 0; i < n; i++)
        if (!read_coordinate(r, list->item[i])) return false;
    if (!nh_system_read_joint_coordinates(r)) return false;
    if (system->coordinates == 0)
        return nh_deck_fail(r->deck, NULL, 0, r->error,
                            "no joint of this system has a coordinate, and `coordinates:` declares none");
    /* after all coordinates: symbols are printed in the order of declaration */
    for (size_t i = 0; i < system->coordinates; i++)
        system->coordinate[i].v =
            nh_symbol(system->dag, nh_arena_printf(system->arena, "%s'", system->coordinate[i].name));
    nh_orientation_build_all(system);
    return true;
}

/* Reads the names of the quasi-velocities before any expression, so that a message can say where one must not stand. */
static bool read_quasi_names(reader *r)
{
    const nh_deck_node *chart = nh_deck_get(r->root, "velocities"), *list;
    size_t n;
    nh_system *system = r->system;
    if (!chart) return true;
    if (!nh_deck_is(r->deck, chart, NH_DECK_MAP, "velocities {names: [...], map: [...]}", r->error)) return false;
    if (!nh_system_list_of(r, chart, "names", &list, &n)) return false;
    system->quasi_velocity = nh_system_take(r, n, sizeof *system->quasi_velocity);
    for (size_t i = 0; i < n; i++) {
        if (!nh_system_new_name(r, list->item[i])) return false;
        system->quasi_velocity[i] = nh_symbol(system->dag, list->item[i]->text);
        system->quasi = i + 1;
    }
    return true;
}

/* Split "name = expression" at its first `=`, or the map {name: expression}; the name must be the whole left side. */
bool nh_system_assignment_name(reader *r, const nh_deck_node *node, const char *what, const char **name)
{
    if (node->kind == NH_DECK_MAP && node->count == 1) {
        *name = nh_deck_spelled(r->system->arena, node->key[0]->text);
        return nh_deck_is(r->deck, node->item[0], NH_DECK_SCALAR, "an expression", r->error);
    }
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, what, r->error)) return false;
    const char *equal = strchr(node->text, '=');
    if (!equal) return nh_deck_fail(r->deck, node, 0, r->error, "%s was expected, but there is no `=`", what);
    size_t n = (size_t)(equal - node->text);
    while (n && node->text[n - 1] == ' ') n--;
    *name = nh_deck_spelled(r->system->arena, nh_arena_strndup(r->system->arena, node->text, n));
    return true;
}

/* Where the right side stands: in which scalar, and behind how many bytes. */
static size_t right_side(const nh_deck_node **node)
{
    if ((*node)->kind == NH_DECK_MAP) return *node = (*node)->item[0], 0;
    return (size_t)(strchr((*node)->text, '=') - (*node)->text) + 1;
}

/* The right side, as an expression. */
bool nh_system_read_right_side(reader *r, const nh_deck_node *node, unsigned forbid, nh_ex *out)
{
    size_t skip = right_side(&node);
    return nh_system_read_expression(r->system, r->deck, node, skip, forbid, 0, NULL, NULL, out, r->error);
}

/* Does a name occur in the text: that of a point's position, or of a definition that waits? */
static bool waits(const reader *r, const char *text, size_t waiting, const char *const *wait)
{
    static const char word[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789";
    for (size_t n; *text; text += n ? n : 1) {
        n = strspn(text, word);
        if (n && nh_system_is_point(r, text, n)) return true;
        for (size_t i = 0; i < waiting && n; i++)
            if (strlen(wait[i]) == n && !strncmp(text, wait[i], n)) return true;
    }
    return false;
}

static bool read_definition(reader *r, const nh_deck_node *node, const char *name_text)
{
    nh_system *system = r->system;
    nh_named *d = &system->definition[system->definitions];
    bool entry = node->kind == NH_DECK_MAP;
    nh_deck_node name = entry ? *node->key[0] : *node;
    name.text = d->name = name_text;
    if (!nh_system_new_name(r, &name)) return false;
    const nh_deck_node *value = node;
    size_t skip = right_side(&value);
    if (!nh_system_read_written(system, r->deck, value, skip, NULL, &d->value, &d->text, r->error)) return false;
    bool as_written = !entry && d->text >= node->text && d->text <= node->text + strlen(node->text);
    d->text = as_written ? node->text : nh_arena_printf(system->arena, "%s = %s", name_text, d->text);
    nh_named *framed = &system->framed_definition[system->definitions];
    *framed = *d;
    if (system->orientations && !nh_system_read_right_side(r, node, NH_NO_QUASI | NH_FRAMED, &framed->value))
        return false;
    system->definitions++;
    return true;
}

/* Those with positions of points wait for these, which follow from bodies and joints, whose numbers may need the
 * others: `late` reads the first, else the others. */
static bool read_definitions(reader *r, bool late)
{
    const nh_deck_node *list, *points = nh_deck_get(r->root, "points");
    size_t n, waiting = 0;
    nh_system *system = r->system;
    if (!nh_system_list_of(r, r->root, "definitions", &list, &n)) return false;
    const char **wait = nh_system_take(r, n, sizeof *wait);
    const nh_named *fixed = system->definition;
    size_t most = system->definitions + n + 3 * (points ? points->count : 0);
    if (!late) system->definition = nh_system_take(r, most, sizeof *fixed);
    if (!late && system->definitions) memcpy(system->definition, fixed, system->definitions * sizeof *fixed);
    if (!late) system->framed_definition = nh_system_take(r, most, sizeof *fixed);
    if (!late && system->definitions) memcpy(system->framed_definition, fixed, system->definitions * sizeof *fixed);
    for (size_t i = 0; i < n; i++) {
        const char *name;
        if (!nh_system_assignment_name(r, list->item[i], "a definition `name = expression`", &name)) return false;
        const nh_deck_node *value = list->item[i];
        size_t skip = right_side(&value);
        bool waited = system->chain && points && waits(r, value->text + skip, waiting, wait);
        if (waited) wait[waiting++] = name;
        if (waited == late && !read_definition(r, list->item[i], name)) return false;
    }
    return true;
}

static bool read_lagrangian(reader *r)
{
    const nh_deck_node *node = nh_deck_get(r->root, "lagrangian");
    nh_system *system = r->system;
    if (system->chain) {
        system->lagrangian = system->framed_of = nh_sub(system->dag, system->chain->kinetic, system->chain->potential);
        system->framed = nh_sub(system->dag, system->chain->framed, system->chain->potential);
    }
    if (!node && system->chain) return true;
    if (!node) {
        const char *energy[] = {"T", "V", "U"};
        bool given[3] = {false};
        for (size_t i = 0; i < 3 * system->definitions; i++)
            given[i % 3] |= !strcmp(system->definition[i / 3].name, energy[i % 3]);
        nh_deck_fail(r->deck, NULL, 0, r->error, "this system has no `lagrangian`");
        if (given[0] && (given[1] || given[2]))
            return nh_error_hint(r->error, "lagrangian: T%s%s", given[1] ? " - V" : "", given[2] ? " - U" : "");
        return nh_error_hint(r->error, "for example: lagrangian: m/2*x'^2 - m*g*x");
    }
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "the lagrangian", r->error)) return false;
    nh_ex written;
    if (!nh_system_read_expression(system, r->deck, node, 0, NH_NO_QUASI, 0, NULL, NULL, &written, r->error))
        return false;
    system->lagrangian = system->framed_of = system->chain ? nh_add(system->dag, system->lagrangian, written) : written;
    if (!system->orientations) return true;
    unsigned how = NH_NO_QUASI | NH_FRAMED;
    if (!nh_system_read_expression(system, r->deck, node, 0, how, 0, NULL, NULL, &written, r->error)) return false;
    written = nh_orientation_framed(system, written);
    system->framed = system->chain ? nh_add(system->dag, system->framed, written) : written;
    return true;
}

/* f(t, q) = 0 holds along a motion that starts on it iff its time derivative vanishes. */
static void differentiate_position(nh_system *system, nh_constraint *c)
{
    nh_ex f = nh_sub(system->dag, c->lhs, c->rhs), rate = nh_diff(system->dag, f, system->t);
    for (size_t i = 0; i < system->coordinates; i++)
        rate = nh_add(system->dag, rate,
                      nh_mul(system->dag, nh_diff(system->dag, f, system->coordinate[i].q), system->coordinate[i].v));
    c->lhs = rate;
    c->rhs = nh_int(system->dag, 0);
    c->position = true;
    c->level = f;
}

/* The constraint in the symbols of angular velocities. */
static bool read_framed(reader *r, const nh_deck_node *node, nh_constraint *c, bool moving)
{
    nh_system *system = r->system;
    nh_ex lhs = c->lhs, rhs = c->rhs;
    unsigned how = NH_NO_QUASI | NH_FRAMED;
    if (moving && !nh_system_read_expression(system, r->deck, node, 0, how, 0, NULL, &lhs, &rhs, r->error))
        return false;
    c->framed = nh_orientation_framed(system, nh_sub(system->dag, lhs, rhs));
    return true;
}

static bool read_constraints(reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_system *system = r->system;
    if (!nh_system_list_of(r, r->root, "constraints", &list, &n)) return false;
    system->constraint = nh_system_take(r, n + nh_system_most_wheel_constraints(system), sizeof *system->constraint);
    nh_system_add_wheel_constraints(r);
    for (size_t i = 0; i < n; i++) {
        nh_constraint *c = &system->constraint[system->constraints];
        const nh_deck_node *node = list->item[i];
        if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "a constraint `... = ...`", r->error)) return false;
        *c = (nh_constraint){.text = node->text, .node = node};
        if (!nh_system_read_written(system, r->deck, node, 0, &c->lhs, &c->rhs, &c->text, r->error)) return false;
        nh_ex f = nh_sub(system->dag, c->lhs, c->rhs);
        bool moving = false, placed = false;
        for (size_t j = 0; j < system->coordinates; j++) {
            moving |= nh_depends(system->dag, f, system->coordinate[j].v);
            placed |= nh_depends(system->dag, f, system->coordinate[j].q);
        }
        if (!moving && !placed) {
            nh_deck_fail(r->deck, node, 0, r->error, "this constraint contains no coordinate and no velocity");
            return nh_error_hint(r->error, nh_is_zero(system->dag, f)
                                               ? "this equation always holds: remove it"
                                               : "this equation never holds: is a name missing?");
        }
        if (!moving) differentiate_position(system, c);
        if (system->orientations && !read_framed(r, node, c, moving)) return false;
        system->constraints++;
    }
    return true;
}

static bool read_dependent(reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_system *system = r->system;
    if (!nh_system_list_of(r, r->root, "dependent", &list, &n)) return false;
    if (n && n != system->constraints)
        return nh_deck_fail(r->deck, list, 0, r->error,
                            "there must be as many dependent velocities as constraints: %zu, not %zu",
                            system->constraints, n);
    system->dependent = nh_system_take(r, n, sizeof *system->dependent);
    for (size_t i = 0; i < n; i++) {
        const nh_deck_node *node = list->item[i];
        if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "the name of a coordinate", r->error)) return false;
        size_t length = strcspn(node->text, "'");
        long index = nh_system_coordinate(system, nh_arena_strndup(system->arena, node->text, length));
        if (index < 0) {
            nh_deck_fail(r->deck, node, 0, r->error, "`%s` is not a coordinate", node->text);
            return nh_system_hint_coordinates(system, node->text, r->error);
        }
        for (size_t j = 0; j < i; j++)
            if (system->dependent[j] == (size_t)index)
                return nh_deck_fail(r->deck, node, 0, r->error, "`%s` is named twice", node->text);
        system->dependent[i] = (size_t)index;
    }
    system->dependents = n;
    return true;
}

/* What a system without `name` is called: its file, without folder and ending. */
static const char *usual_name(reader *r)
{
    const char *file = nh_deck_name(r->deck), *slash = strrchr(file, '/');
    if (slash) file = slash + 1;
    size_t length = strcspn(file, ".");
    return length && *file != '-' ? nh_arena_printf(r->system->arena, "%.*s", (int)length, file) : "system";
}

static bool read_all(reader *r, size_t settings, const nh_setting *setting)
{
    nh_system *system = r->system;
    if (!nh_deck_is(r->deck, r->root, NH_DECK_MAP, "a system file (name: ..., coordinates: ..., lagrangian: ...)",
                    r->error))
        return false;
    if (!nh_ordinary_only_known(r->deck, r->error)) return false;
    const char *doc; /* text for readers of the file */
    if (!nh_system_text_of(r, r->root, "name", usual_name(r), &system->name) ||
        !nh_system_text_of(r, r->root, "title", system->name, &system->title))
        return false;
    if (!nh_system_text_of(r, r->root, "source", "", &system->source) ||
        !nh_system_text_of(r, r->root, "doc", "", &doc))
        return false;
    system->t = nh_symbol(system->dag, "t");
    if (!read_parameters(r) || !nh_system_apply_settings(r, settings, setting)) return false;
    return nh_system_read_tree(r) && read_coordinates(r) && read_quasi_names(r) &&
           nh_system_read_functions(r, settings, setting) && nh_system_read_tables(r) && read_definitions(r, false) &&
           nh_system_read_chain(r) && nh_system_read_points(r) && read_definitions(r, true) && read_lagrangian(r) &&
           read_constraints(r) && read_dependent(r) && nh_system_read_chart(r) && nh_system_read_forces(r) &&
           nh_system_read_domain(r) && nh_system_read_levels(r) && nh_system_read_symmetry(r) &&
           nh_system_read_drawing(r)
           /* claims about the whole system */
           && (system->levels || (nh_system_read_known(r) && nh_system_read_robustness(r)));
}

/* The deck, or NULL where it could not be completed. */
static nh_deck *whole(nh_deck *deck, nh_error *error)
{
    if (deck && nh_deck_include(deck, nh_ordinary_keys, error) && nh_robot_complete(deck, error)) return deck;
    nh_deck_free(deck);
    return NULL;
}

nh_deck *nh_system_deck(const char *path, nh_error *error) { return whole(nh_deck_read(path, error), error); }

static nh_system *read_deck(nh_deck *deck, size_t settings, const nh_setting *setting, nh_error *error)
{
    if (!deck) return NULL;
    nh_arena *arena = nh_arena_create();
    nh_system *system = nh_arena_alloc(arena, sizeof *system);
    system->arena = arena;
    system->deck = deck;
    system->dag = nh_dag_create();
    reader r = {.system = system, .deck = deck, .root = nh_deck_root(deck), .error = error};
    if (read_all(&r, settings, setting) && nh_system_read_notes(&r)) {
        nh_reach_walls(system);
        return system;
    }
    nh_system_free(system);
    return NULL;
}

nh_system *nh_system_read(const char *path, size_t settings, const nh_setting *setting, nh_error *error)
{
    return read_deck(nh_system_deck(path, error), settings, setting, error);
}

nh_system *nh_system_parse(const char *name, const char *text, size_t settings, const nh_setting *setting,
                           nh_error *error)
{
    return read_deck(whole(nh_deck_parse(name, text, strlen(text), error), error), settings, setting, error);
}
