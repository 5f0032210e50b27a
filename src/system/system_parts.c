/* system_parts: the optional parts of a system file: velocities, forces, domain, known currents. */
#include <string.h>

#include "base/text.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/declared.h"
#include "graph/name.h"
#include "graph/node.h"
#include "system/system_internal.h"

/* As many as degrees of freedom? */
static bool count_quasi(nh_system_reader *r, const nh_deck_node *chart)
{
    const nh_system *system = r->system;
    const nh_deck_node *list = nh_deck_get(chart, "names");
    if (system->constraints > system->coordinates) return true; /* the ranks decide */
    size_t left = system->coordinates - system->constraints;
    if (system->quasi == left) return true;
    nh_deck_fail(
        r->deck, list ? list : chart, 0, r->error,
        "there must be as many velocities as degrees of freedom: %zu, not %zu (coordinates: %zu, constraints: %zu)",
        left, system->quasi, system->coordinates, system->constraints);
    return system->quasi < left
               ? nh_error_hint(r->error, "list every constraint under `constraints:`, and every velocity here")
               : false;
}

/* Which coordinate's velocity is on the left side "x'"? */
static long velocity_on_left(nh_system_reader *r, const nh_deck_node *node, const char *name)
{
    const nh_system *system = r->system;
    const char *own = nh_system_state_name(system, name);
    for (size_t i = 0; i < system->coordinates; i++)
        if (!strcmp(own, nh_name_of(system->dag, system->coordinate[i].v))) return (long)i;
    nh_deck_fail(r->deck, node, 0, r->error, "`%s` is not the velocity of a coordinate", name);
    if (nh_system_coordinate(system, name) >= 0) nh_error_hint(r->error, "write `%s' = ...`", name);
    return -1;
}

/* The same, or the angular velocity of an orientation, which then is framed. */
static long rate_on_left(nh_system_reader *r, const nh_deck_node *node, const char *name, bool *framed)
{
    const nh_system *system = r->system;
    for (size_t i = 0; i < 3 * system->orientations; i++) {
        const nh_orientation *o = &system->orientation[i / 3];
        if (!strcmp(name, o->word[i % 3])) return framed[o->first + i % 3] = true, (long)(o->first + i % 3);
    }
    return velocity_on_left(r, node, name);
}

/* Of each orientation the map gives the angular velocities, or the velocities of its coordinates. */
static bool map_framed(nh_system_reader *r, const nh_deck_node *map, const bool *framed)
{
    nh_system *system = r->system;
    bool all = true;
    for (size_t i = 0; i < system->orientations; i++) {
        const nh_orientation *o = &system->orientation[i];
        const bool *f = framed + o->first;
        if (f[0] != f[1] || f[0] != f[2])
            return nh_deck_fail(r->deck, map, 0, r->error, "the velocities' map has to give %s, %s and %s", o->word[0],
                                o->word[1], o->word[2]);
        all &= f[0];
    }
    if (!all) {
        bool any = false;
        for (size_t i = 0; i < system->coordinates; i++) any |= framed[i];
        return !any || nh_deck_fail(r->deck, map, 0, r->error,
                                    "the velocities' map gives the angular velocities of some orientations, and "
                                    "coordinates' velocities of others: give the same of all");
    }
    system->quasi_framed = nh_system_take(r, system->coordinates, sizeof *system->quasi_framed);
    memcpy(system->quasi_framed, system->quasi_map, system->coordinates * sizeof *system->quasi_framed);
    nh_orientation_map(system, system->quasi_framed, system->quasi_map);
    return true;
}

bool nh_system_read_chart(nh_system_reader *r)
{
    static const char *const keys[] = {"names", "map"};
    const nh_deck_node *chart = nh_deck_get(r->root, "velocities"), *map;
    nh_system *system = r->system;
    size_t n;
    if (!chart) return !system->orientations || nh_orientation_velocities(r);
    if (!nh_deck_only(r->deck, chart, keys, 2, r->error) || !count_quasi(r, chart)) return false;
    if (!nh_system_list_of(r, chart, "map", &map, &n)) return false;
    system->quasi_map = nh_system_take(r, system->coordinates, sizeof *system->quasi_map);
    bool *given = nh_system_take(r, system->coordinates, sizeof *given),
         *framed = nh_system_take(r, system->coordinates, 1);
    for (size_t i = 0; i < n; i++) {
        const char *name;
        if (!nh_system_assignment_name(r, map->item[i], "a line `x' = ...` of the velocities' map", &name))
            return false;
        long index = rate_on_left(r, map->item[i], name, framed);
        if (index < 0) return false;
        if (given[index]) return nh_deck_fail(r->deck, map->item[i], 0, r->error, "`%s` is given twice", name);
        given[index] = true;
        if (!nh_system_read_right_side(r, map->item[i], NH_NO_VELOCITIES, &system->quasi_map[index])) return false;
        for (size_t j = 0; j < system->coordinates; j++) /* through a definition */
            if (nh_depends(system->dag, system->quasi_map[index], system->coordinate[j].v))
                return nh_deck_fail(r->deck, map->item[i], 0, r->error,
                                    "the velocity `%s` is not allowed here; a definition contains it",
                                    nh_name_of(system->dag, system->coordinate[j].v));
    }
    for (size_t i = 0; i < system->coordinates; i++)
        if (!given[i])
            return nh_deck_fail(r->deck, map ? map : chart, 0, r->error,
                                "the velocities' map does not say what `%s'` is", system->coordinate[i].name);
    return !system->orientations || map_framed(r, map, framed);
}

/* A torque along an angular velocity w: its power is torque w = torque dw/dv^s v^s. */
static void add_torque(nh_system *system, nh_ex w, nh_ex torque)
{
    for (size_t i = 0; i < system->coordinates; i++)
        system->force[i] = nh_add(system->dag, system->force[i],
                                  nh_mul(system->dag, torque, nh_diff(system->dag, w, system->coordinate[i].v)));
    system->has_forces = true;
}

bool nh_system_read_forces(nh_system_reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_system *system = r->system;
    system->force = nh_system_take(r, system->coordinates, sizeof *system->force);
    for (size_t i = 0; i < system->coordinates; i++) system->force[i] = nh_int(system->dag, 0);
    if (!nh_system_read_elements(r) || !nh_system_list_of(r, r->root, "forces", &list, &n)) return false;
    for (size_t i = 0; i < n; i++) {
        const char *name;
        nh_ex value;
        if (!nh_system_assignment_name(r, list->item[i], "a force `coordinate = expression`", &name)) return false;
        long index = nh_system_coordinate(system, name);
        bool turns;
        nh_ex rate;
        if (index < 0 && nh_orientation_word(system, name, false, &turns, &rate) && turns) {
            if (!nh_system_read_right_side(r, list->item[i], NH_NO_QUASI, &value)) return false;
            add_torque(system, rate, value);
            continue;
        }
        if (index < 0) {
            nh_deck_fail(r->deck, list->item[i], 0, r->error, "`%s` is not a coordinate", name);
            return nh_system_hint_coordinates(system, name, r->error);
        }
        if (!nh_system_read_right_side(r, list->item[i], NH_NO_QUASI, &value)) return false;
        system->force[index] = nh_add(system->dag, system->force[index], value);
        system->has_forces = true;
    }
    return true;
}

bool nh_system_read_notes(nh_system_reader *r)
{
    const nh_deck_node *list;
    const char **more, *of_wheels[2];
    size_t n, found = nh_dimension_check(r->system, &more), wheels = nh_wheel_checks(r->system, of_wheels);
    if (!nh_system_list_of(r, r->root, "notes", &list, &n)) return false;
    r->system->note = nh_system_take(r, n + r->notes + found + wheels + 1, sizeof *r->system->note);
    for (size_t i = 0; i < n; i++) r->system->note[r->system->notes++] = list->item[i]->text;
    const char *open = nh_declared_unspecified(r->system->dag);
    if (open)
        r->system->note[r->system->notes++] =
            nh_arena_printf(r->system->arena,
                            "a function has no value (%s): what is proved holds for all such functions, completeness "
                            "for almost all; samples and motions take a stand-in",
                            open);
    for (size_t i = 0; i < r->notes; i++) r->system->note[r->system->notes++] = r->note[i];
    for (size_t i = 0; i < found; i++) r->system->note[r->system->notes++] = more[i];
    for (size_t i = 0; i < wheels; i++) r->system->note[r->system->notes++] = of_wheels[i];
    return true;
}

size_t nh_system_state_names(const nh_system *system, const char **names)
{
    size_t n = 0;
    names[n++] = "t";
    for (size_t i = 0; i < system->coordinates; i++) {
        names[n++] = system->coordinate[i].name;
        names[n++] = nh_name_of(system->dag, system->coordinate[i].v);
    }
    for (size_t i = 0; i < system->quasi; i++) {
        const char *name = nh_name_of(system->dag, system->quasi_velocity[i]);
        if (!system->orientations || !strchr(name, '\''))
            names[n++] = name; /* beside angular velocities: listed already */
    }
    return n;
}

/* Are the words before, middle and after next to each other? */
static bool consists_of(const char *word, const char *before, const char *middle, size_t length, const char *after)
{
    size_t n = strlen(before);
    return !strncmp(word, before, n) && !strncmp(word + n, middle, length) && !strcmp(word + n + length, after);
}

const char *nh_system_velocity_meant(const nh_system *system, const char *word, const char *near)
{
    static const char *const around[][2] = {{"", "dot"},  {"", "_dot"}, {"dot", ""}, {"dot_", ""}, {"d", ""},
                                            {"d", "/dt"}, {"d", "_dt"}, {"v", ""},   {"v_", ""},   {"", "d"}};
    static const char digits[] = "0123456789";
    const char *same = NULL; /* the coordinate that ends in the digits after v */
    size_t alike = 0;
    for (size_t i = 0; i < system->coordinates; i++) {
        const char *q = system->coordinate[i].name;
        size_t stem = strlen(q);
        if (!system->coordinate[i].v) continue; /* velocities have no names yet */
        for (size_t k = 0; k < sizeof around / sizeof *around; k++)
            if (consists_of(word, around[k][0], q, stem, around[k][1]) && !(near && *word == 'v' && *near == 'v'))
                return q;
        while (stem && strchr(digits, q[stem - 1])) stem--;
        const char *number = q + stem;
        if (!*number) continue;
        if (consists_of(word, "", q, stem, nh_arena_printf(system->arena, "dot%s", number)) ||
            consists_of(word, "", q, stem, nh_arena_printf(system->arena, "_dot%s", number)))
            return q;
        if (*word != 'v' || strcmp(word + 1, number)) continue;
        same = q;
        alike++;
    }
    return alike == 1 && !(near && *near == 'v') ? same : NULL;
}

/* The nearest of the names, or all of them; "its parameters are m, g". */
static bool hint_names(const nh_system *system, const char *what, size_t n, const char *const *names, const char *word,
                       nh_error *error)
{
    const char *near = nh_text_nearest(word, names, n), *all = "";
    if (near) return nh_error_hint(error, "did you mean `%s`?", near);
    for (size_t i = 0; i < n; i++) all = nh_arena_printf(system->arena, "%s%s%s", all, i ? ", " : "", names[i]);
    return nh_error_hint(error, n > 1 ? "%ss are %.150s" : "%s is %.150s", what, all);
}

bool nh_system_hint_coordinates(const nh_system *system, const char *word, nh_error *error)
{
    const char **names = nh_arena_alloc(system->arena, (system->coordinates + 1) * sizeof *names);
    for (size_t i = 0; i < system->coordinates; i++) names[i] = system->coordinate[i].name;
    return hint_names(system, "the coordinate", system->coordinates, names, word, error);
}

bool nh_system_hint_parameters(const nh_system *system, const char *word, nh_error *error)
{
    const char **names = nh_arena_alloc(system->arena, (system->parameters + 1) * sizeof *names);
    for (size_t i = 0; i < system->parameters; i++) names[i] = system->parameter[i].name;
    if (!system->parameters) return nh_error_hint(error, "it has none");
    return hint_names(system, "its parameter", system->parameters, names, word, error);
}

static bool box_symbol(nh_system_reader *r, const nh_deck_node *key, nh_ex *out)
{
    nh_system *system = r->system;
    const char **names = nh_system_take(r, 2 * system->coordinates + system->quasi + 1, sizeof *names);
    size_t n = nh_system_state_names(system, names);
    const char *own = nh_system_state_name(system, key->text);
    for (size_t i = 0; i < n; i++)
        if (!strcmp(names[i], own)) return nh_symbol_find(system->dag, own, out);
    nh_deck_fail(r->deck, key, 0, r->error, "`%s` is not a coordinate, a velocity or t", key->text);
    const char *near = nh_text_nearest(key->text, names, n), *q = nh_system_velocity_meant(system, key->text, near);
    if (q) return nh_error_hint(r->error, NH_VELOCITY_IS_WRITTEN, q, q);
    return near ? nh_error_hint(r->error, "did you mean `%s`?", near)
                : nh_system_hint_coordinates(system, key->text, r->error);
}

bool nh_system_read_domain(nh_system_reader *r)
{
    const nh_deck_node *map = nh_deck_get(r->root, "domain");
    nh_system *system = r->system;
    size_t screws = system->chain ? system->chain->screws : 0;
    system->interval = nh_system_take(r, (map ? map->count : 0) + screws, sizeof *system->interval);
    for (size_t k = 0; k < screws; k++) { /* first, so that later intervals of the user replace these */
        const nh_screw *screw = &system->chain->screw[k];
        if (screw->coordinate < 0 || screw->low == screw->high) continue;
        system->interval[system->intervals++] =
            (nh_interval){system->coordinate[screw->coordinate].q, screw->low, screw->high};
    }
    if (!map) return true;
    if (!nh_deck_is(r->deck, map, NH_DECK_MAP, "a domain {x: [low, high], ...}", r->error)) return false;
    for (size_t i = 0; i < map->count; i++) {
        double range[2];
        nh_interval *box = &system->interval[system->intervals];
        if (!box_symbol(r, map->key[i], &box->symbol)) return false;
        if (!nh_deck_range(r->deck, map->item[i], map->key[i]->text, range, r->error)) return false;
        box->low = range[0];
        box->high = range[1];
        system->intervals++;
    }
    return true;
}

static bool read_field(nh_system_reader *r, const nh_deck_node *map, nh_ex *component)
{
    nh_system *system = r->system;
    if (!nh_deck_is(r->deck, map, NH_DECK_MAP, "a field {coordinate: component, ...}", r->error)) return false;
    for (size_t i = 0; i < system->coordinates; i++) component[i] = nh_int(system->dag, 0);
    for (size_t i = 0; i < map->count; i++) {
        long index = nh_system_coordinate(system, map->key[i]->text);
        if (index < 0) {
            nh_deck_fail(r->deck, map->key[i], 0, r->error, "`%s` is not a coordinate", map->key[i]->text);
            return nh_system_hint_coordinates(system, map->key[i]->text, r->error);
        }
        if (!nh_deck_is(r->deck, map->item[i], NH_DECK_SCALAR, "an expression", r->error)) return false;
        if (!nh_system_read_expression(system, r->deck, map->item[i], 0, NH_NO_VELOCITIES | NH_NO_QUASI, 0, NULL, NULL,
                                       &component[index], r->error))
            return false;
    }
    return true;
}

/* symmetry: generators of a group, each a map from coordinates to components. */
bool nh_system_read_symmetry(nh_system_reader *r)
{
    nh_system *system = r->system;
    const nh_deck_node *list;
    size_t n;
    if (!nh_system_list_of(r, r->root, "symmetry", &list, &n)) return false;
    system->symmetry = nh_system_take(r, n * system->coordinates, sizeof *system->symmetry);
    for (size_t i = 0; i < n; i++)
        if (!read_field(r, list->item[i], system->symmetry + i * system->coordinates)) return false;
    system->symmetries = n;
    return true;
}

static bool shape_expression(void *context, const nh_deck_node *node, nh_ex *out)
{
    nh_system_reader *r = context;
    return nh_system_read_expression(r->system, r->deck, node, 0, NH_NO_VELOCITIES | NH_NO_QUASI, 0, NULL, NULL, out,
                                     r->error);
}

bool nh_system_read_drawing(nh_system_reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_system *system = r->system;
    if (!nh_system_list_of(r, r->root, "draw", &list, &n)) return false;
    system->shape = nh_system_take(r, n, sizeof *system->shape);
    for (size_t i = 0; i < n; i++)
        if (!nh_shape_read(r->deck, list->item[i], system->dag, shape_expression, r, &system->shape[i], r->error))
            return false;
    system->shapes = n;
    return true;
}

bool nh_system_truth_of(nh_system_reader *r, const nh_deck_node *map, const char *key, const char *meaning, bool *out)
{
    const nh_deck_node *node = nh_deck_get(map, key);
    *out = node && node->kind == NH_DECK_SCALAR && node->plain && !strcmp(node->text, "true");
    if (!node || *out || (node->kind == NH_DECK_SCALAR && node->plain && !strcmp(node->text, "false"))) return true;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, key, r->error)) return false;
    nh_deck_fail(r->deck, node, 0, r->error, "`%s` must be true or false, found `%s`", key, node->text);
    return nh_error_hint(r->error, "%s", meaning);
}

/* A formula that holds for almost all values may have none at an exact value, as z'/w at w = 0: it is left out
   there. */
static bool read_named_list(nh_system_reader *r, const nh_deck_node *known, const char *key, nh_named **out,
                            size_t *count)
{
    static const char *const keys[] = {"name", "expr", "doc", "symbol", "out_of_reach", "unwatched"};
    const nh_deck_node *list;
    size_t n;
    if (!nh_system_list_of(r, known, key, &list, &n)) return false;
    *out = nh_system_take(r, n, sizeof **out);
    for (size_t i = 0; i < n; i++) {
        const nh_deck_node *item = list->item[i];
        nh_named *named = &(*out)[*count];
        if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "an entry {name: ..., expr: ...}", r->error)) return false;
        if (!nh_deck_only(r->deck, item, keys, sizeof keys / sizeof *keys, r->error)) return false;
        const nh_deck_node *expr = nh_deck_get(item, "expr");
        if (!expr) return nh_deck_fail(r->deck, item, 0, r->error, "this entry has no `expr`");
        *named = (nh_named){.text = expr->text};
        if (!nh_system_text_of(r, item, "name", "", &named->name)) return false;
        if (!nh_system_text_of(r, item, "doc", "", &named->doc)) return false;
        if (!nh_system_text_of(r, item, "symbol", NULL, &named->symbol)) return false;
        if (named->symbol && !nh_is_name(named->symbol))
            return nh_deck_fail(r->deck, nh_deck_get(item, "symbol"), 0, r->error,
                                "`%s` is no symbol: letters, digits and _, as in Phi_2", named->symbol);
        if (!nh_system_text_of(r, item, "out_of_reach", NULL, &named->out_of_reach)) return false;
        if (!nh_system_truth_of(r, item, "unwatched", "a current without a column in `simulate` and `benchmark`",
                                &named->unwatched))
            return false;
        bool undefined;
        if (nh_system_read_defined(r->system, r->deck, expr, &named->value, &undefined, r->error)) ++*count;
        else if (!r->exact || !undefined) return false;
        else nh_error_clear(r->error);
    }
    return true;
}

bool nh_system_read_known(nh_system_reader *r)
{
    static const char *const keys[] = {"currents", "not_conserved", "motions"};
    const nh_deck_node *known = nh_deck_get(r->root, "known");
    nh_system *system = r->system;
    if (!known) return true;
    if (!nh_deck_is(r->deck, known, NH_DECK_MAP, "known", r->error)) return false;
    return nh_deck_only(r->deck, known, keys, 3, r->error) &&
           read_named_list(r, known, "currents", &system->current, &system->currents) &&
           read_named_list(r, known, "not_conserved", &system->trap, &system->not_conserved) &&
           nh_system_check_motions(r, known);
}
