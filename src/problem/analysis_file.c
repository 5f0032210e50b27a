#include "problem/analysis_file_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/parse.h"
#include "system/deck_build.h"
#include "system/sample_grid.h"

/* ---- before the system ---- */

static const char *const top_keys[] = {"name",    "system", "set",      "route",  "ansatz",      "unknowns",
                                       "samples", "seed",   "validate", "scene",  "definitions", "velocities",
                                       "title",   "doc",    "figures",  "search", "grid"};
enum { top_key_count = sizeof top_keys / sizeof *top_keys };

/* One of three words. */
bool nh_analysis_file_choice(const nh_deck *deck, const nh_deck_node *node, const char *what, size_t count,
                             const char *const *names, size_t *out, nh_error *error)
{
    char list[200] = "expected ";
    if (!node) return true;
    if (!nh_deck_is(deck, node, NH_DECK_SCALAR, what, error)) return false;
    for (*out = 0; *out < count; ++*out)
        if (!strcmp(node->text, names[*out])) return true;
    nh_deck_fail(deck, node, 0, error, "unknown %s `%s`", what, node->text);
    const char *near = nh_text_nearest(node->text, names, count);
    if (near) return nh_error_hint(error, "did you mean `%s`?", near);
    for (size_t i = 0, end = strlen(list); i < count; i++, end = strlen(list))
        snprintf(list + end, sizeof list - end, "%s%s", i == 0 ? "" : i + 1 < count ? ", " : " or ", names[i]);
    return nh_error_hint(error, "%s", list);
}

static const char *const route_words[] = {"both", "fields", "currents", "both", "symmetry", "current"};
enum { route_word_count = sizeof route_words / sizeof *route_words };

const char *nh_analysis_file_route_word(nh_route route) { return route_words[route]; }

bool nh_analysis_file_route(const char *word, nh_route *route, nh_error *error)
{
    for (size_t i = 0; i < route_word_count; i++) {
        if (strcmp(word, route_words[i])) continue;
        *route = (nh_route)(i % NH_ROUTES);
        return true;
    }
    return nh_error_hint_near(error, word, route_words, NH_ROUTES, "expected both, fields or currents");
}

/* The text under `key`, or the fallback. */
static bool text_of(const nh_deck *deck, const nh_deck_node *map, const char *key, const char *fallback,
                    const char **out, nh_error *error)
{
    const nh_deck_node *node = nh_deck_get(map, key);
    *out = node ? node->text : fallback;
    return !node || nh_deck_is(deck, node, NH_DECK_SCALAR, key, error);
}

static bool read_settings(nh_analysis_file *a, const nh_deck_node *map, nh_error *error)
{
    if (!map) return true;
    if (!nh_deck_is(a->deck, map, NH_DECK_MAP, "set", error)) return false;
    a->setting = nh_arena_alloc(a->arena, (map->count + 1) * sizeof *a->setting);
    for (size_t i = 0; i < map->count; i++) {
        a->setting[i] = (nh_setting){.name = map->key[i]->text, .deck = a->deck, .key = map->key[i]};
        if (strchr(map->key[i]->text, '(') && map->item[i]->kind == NH_DECK_SCALAR) { /* of a function */
            a->setting[i].input = map->item[i]->text;
            continue;
        }
        if (!nh_deck_number(a->deck, map->item[i], "the value of a parameter", &a->setting[i].value, error))
            return false;
    }
    a->settings = map->count;
    return true;
}

/* `grid: tensor`, or `grid: {file: points.csv}`, a path from the folder of the analysis file. */
static bool read_grid(nh_analysis_file *a, const nh_deck_node *node, nh_error *error)
{
    static const char *const keys[] = {"file"};
    nh_grid_kind kind;
    nh_error trouble;
    nh_error_clear(&trouble);
    if (!node) return true;
    const nh_deck_node *word = node;
    if (node->kind == NH_DECK_MAP && (!nh_deck_only(a->deck, node, keys, 1, error))) return false;
    if (node->kind == NH_DECK_MAP) word = nh_deck_get(node, "file");
    if (!word || !nh_deck_is(a->deck, word, NH_DECK_SCALAR, "a grid", error))
        return word || nh_deck_fail(a->deck, node, 0, error, "a grid was expected: sobol, or {file: points.csv}");
    if (!nh_sample_grid_kind(word->text, &kind, &trouble))
        return nh_deck_fail(a->deck, word, 0, error, "%s", trouble.what), nh_error_hint(error, "%s", trouble.hint);
    if (word != node && kind != NH_GRID_FILE) {
        nh_deck_fail(a->deck, word, 0, error, "`%s` is no file of points, whose name ends in .csv", word->text);
        return nh_error_hint(error, "write grid: %s", word->text);
    }
    a->grid = kind == NH_GRID_FILE ? nh_deck_beside(a->deck, word) : word->text;
    return true;
}

static bool read_head(nh_analysis_file *a, nh_error *error)
{
    static const char *const velocities[] = {"auto", "quasi", "coordinates"}, *const searches[] = {"yes", "no"};
    const nh_deck_node *root = nh_deck_root(a->deck), *node;
    size_t index = 0;
    if (!nh_deck_is(a->deck, root, NH_DECK_MAP, "an analysis file (system: ..., ansatz: ...)", error)) return false;
    if (!nh_deck_rename(a->deck, root, "chart", "velocities", error)) return false; /* of earlier versions */
    if (!nh_deck_only(a->deck, root, top_keys, top_key_count, error)) return false;
    const char *remark; /* text for readers of the file */
    if (!text_of(a->deck, root, "name", "analysis", &a->name, error) ||
        !text_of(a->deck, root, "system", NULL, &a->system, error))
        return false;
    if (!text_of(a->deck, root, "title", "", &remark, error) || !text_of(a->deck, root, "doc", "", &remark, error))
        return false;
    if ((node = nh_deck_get(root, "route"))) {
        if (!nh_deck_is(a->deck, node, NH_DECK_SCALAR, "route", error)) return false;
        if (!nh_analysis_file_route(node->text, &a->route, NULL)) {
            nh_deck_fail(a->deck, node, 0, error, "unknown route `%s`", node->text);
            return nh_analysis_file_route(node->text, &a->route, error);
        }
    }
    if (!nh_analysis_file_choice(a->deck, nh_deck_get(root, "velocities"), "velocities", 3, velocities, &index, error))
        return false;
    a->chart = (nh_chart_choice)index;
    index = 0;
    if (!nh_analysis_file_choice(a->deck, nh_deck_get(root, "search"), "search", 2, searches, &index, error))
        return false;
    a->alone = index == 1;
    if (!read_grid(a, nh_deck_get(root, "grid"), error)) return false;
    long whole;
    if ((node = nh_deck_get(root, "samples"))) {
        if (!nh_deck_whole(a->deck, node, "samples", 16, 10000000, &whole, error)) return false;
        a->samples = (double)whole;
        a->has_samples = true;
    }
    if ((node = nh_deck_get(root, "seed"))) {
        if (!nh_deck_whole(a->deck, node, "seed", 0, 1000000000000000, &whole, error)) return false;
        a->seed = (double)whole;
        a->has_seed = true;
    }
    return read_settings(a, nh_deck_get(root, "set"), error);
}

static nh_analysis_file *read_deck(nh_deck *deck, nh_error *error)
{
    if (!deck) return NULL;
    nh_arena *arena = nh_arena_create();
    nh_analysis_file *a = nh_arena_alloc(arena, sizeof *a);
    a->arena = arena;
    a->deck = deck;
    if (read_head(a, error)) return a;
    nh_analysis_file_free(a);
    return NULL;
}

nh_analysis_file *nh_analysis_file_read(const char *path, nh_error *error)
{
    return read_deck(nh_deck_read(path, error), error);
}

nh_analysis_file *nh_analysis_file_start(const char *name, const char *state, nh_code code, nh_error *error)
{
    nh_deck *deck = nh_deck_line(name, state, code, error);
    if (!deck) return NULL;
    const nh_deck_node *map = nh_deck_root(deck);
    nh_deck_node *root = nh_deck_new_at(deck, NH_DECK_MAP, map), *validate = nh_deck_new_at(deck, NH_DECK_MAP, map);
    nh_deck_put(deck, validate, "initial", map);
    nh_deck_put(deck, root, "validate", validate);
    deck->root = root;
    return read_deck(deck, error);
}

void nh_analysis_file_free(nh_analysis_file *analysis)
{
    if (!analysis) return;
    nh_deck_free(analysis->deck);
    nh_arena_free(analysis->arena);
}

/* ---- expressions of the chart ---- */

bool nh_analysis_file_to_chart(const nh_model *model, nh_ex e, nh_ex *out, nh_error *error)
{
    nh_system *system = model->system;
    bool quasi_used = false;
    for (size_t i = 0; i < system->quasi; i++) quasi_used |= nh_depends(system->dag, e, system->quasi_velocity[i]);
    if (quasi_used && !model->chart->quasi) {
        nh_chart *chart = nh_chart_create(system, NH_CHART_QUASI, 1, error);
        if (!chart) return false;
        nh_ex *w = nh_alloc_array(system->quasi + 1, sizeof *w);
        bool good = nh_chart_inverse(chart, w);
        if (good) e = nh_substitute(system->dag, e, system->quasi, system->quasi_velocity, w);
        nh_free(w);
        nh_chart_free(chart);
        if (!good)
            return nh_fail(error, NH_NUMERIC, "",
                           "quasi-velocities that depend nonlinearly on the velocities cannot be used in this chart");
    }
    *out = nh_model_compose(model, e);
    return true;
}

/* ---- after the system: a reader with the names of the analysis ---- */

typedef nh_analysis_file_reader reader;

void *nh_analysis_file_take(reader *r, size_t count, size_t size)
{
    return nh_arena_alloc(r->a->arena, (count + 1) * size);
}

/* nh_analysis_file_to_chart, with a message about the node. */
static bool to_chart(reader *r, const nh_deck_node *node, nh_ex e, nh_ex *out)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    return nh_analysis_file_to_chart(r->model, e, out, &trouble) ||
           nh_deck_fail(r->a->deck, node, 0, r->error, "%s", trouble.what);
}

bool nh_analysis_file_parse(reader *r, const nh_deck_node *node, nh_ex *out)
{
    if (!nh_deck_is(r->a->deck, node, NH_DECK_SCALAR, "an expression", r->error)) return false;
    nh_ex e;
    return nh_system_expression(r->model->system, r->a->deck, node, r->extras, r->extra, &e, r->error) &&
           to_chart(r, node, e, out);
}

/* Is `name`, which stands at `node`, well formed and free? */
static bool name_is_free(reader *r, const nh_deck_node *node, const char *name)
{
    const nh_deck *deck = r->a->deck;
    const nh_system *system = r->model->system;
    nh_ex taken;
    if (!nh_is_name(name)) {
        nh_deck_fail(deck, node, 0, r->error, "`%s` is not a name", name);
        return nh_name_hint(r->error, name);
    }
    if (nh_is_reserved(name)) {
        nh_deck_fail(deck, node, 0, r->error, "`%s` has a meaning of its own and cannot be redefined", name);
        return nh_error_hint(r->error, "choose another name, for instance `%s1`", name);
    }
    for (size_t i = 0; i < r->extras; i++)
        if (!strcmp(r->extra[i].name, name))
            return nh_deck_fail(deck, node, 0, r->error,
                                i < r->own ? "`%s` is defined already: E is the energy, Lbar the constrained Lagrangian"
                                           : "`%s` is declared twice",
                                name);
    size_t function;
    bool used = nh_symbol_find(r->model->dag, name, &taken) || nh_declared_find(r->model->dag, name, &function);
    for (size_t i = 0; i < system->definitions; i++) used |= !strcmp(system->definition[i].name, name);
    return !used || nh_deck_fail(deck, node, 0, r->error, "`%s` is already a name of the system", name);
}

static bool read_unknowns(reader *r)
{
    const nh_deck_node *map = nh_deck_get(r->root, "unknowns");
    if (!map) return true;
    if (!nh_deck_is(r->a->deck, map, NH_DECK_MAP, "unknowns {nu: [low, high]}", r->error)) return false;
    r->a->unknown = nh_analysis_file_take(r, map->count, sizeof *r->a->unknown);
    for (size_t i = 0; i < map->count; i++) {
        double range[2];
        const char *name = map->key[i]->text;
        if (!name_is_free(r, map->key[i], name)) return false;
        if (!nh_deck_range(r->a->deck, map->item[i], name, range, r->error)) return false;
        nh_ex symbol = nh_symbol(r->model->dag, name);
        r->a->unknown[i] = (nh_unknown){symbol, range[0], range[1]};
        r->extra[r->extras++] = (nh_named){.name = name, .value = symbol};
        r->a->unknowns = i + 1;
    }
    return true;
}

/* "name = expression"; a visible name can be used in later expressions. */
static bool read_assignment(reader *r, const nh_deck_node *node, bool visible, nh_named *out)
{
    const nh_deck *deck = r->a->deck;
    const char *what = visible ? "a definition `name = expression`" : "a watched quantity `name = expression`";
    if (!nh_deck_is(deck, node, NH_DECK_SCALAR, what, r->error)) return false;
    const char *equal = strchr(node->text, '=');
    if (!equal) return nh_deck_fail(deck, node, 0, r->error, "%s was expected, but there is no `=`", what);
    size_t n = (size_t)(equal - node->text);
    while (n && node->text[n - 1] == ' ') n--;
    *out = (nh_named){.name = nh_deck_spelled(r->a->arena, nh_arena_strndup(r->a->arena, node->text, n)),
                      .text = equal + 1 + strspn(equal + 1, " ")};
    if (visible ? !name_is_free(r, node, out->name)
                : n == 0 && !nh_deck_fail(deck, node, 0, r->error, "there is no name before the `=`"))
        return false;
    nh_ex e;
    return nh_system_right_side(r->model->system, deck, node, r->extras, r->extra, &e, r->error) &&
           to_chart(r, node, e, &out->value);
}

static bool read_assignments(reader *r, const nh_deck_node *list, const char *what, bool visible, nh_named **out,
                             size_t *count)
{
    if (!list) return true;
    if (!nh_deck_is(r->a->deck, list, NH_DECK_LIST, what, r->error)) return false;
    *out = nh_analysis_file_take(r, list->count, sizeof **out);
    for (size_t i = 0; i < list->count; i++) {
        if (!read_assignment(r, list->item[i], visible, &(*out)[i])) return false;
        for (size_t j = 0; j < i; j++)
            if (!strcmp((*out)[i].name, (*out)[j].name))
                return nh_deck_fail(r->a->deck, list->item[i], 0, r->error, "`%s` is declared twice", (*out)[i].name);
        if (visible) r->extra[r->extras++] = (*out)[i];
        *count = i + 1;
    }
    return true;
}

bool nh_analysis_file_watches(reader *r, const nh_deck_node *list, const char *what, nh_named **out, size_t *count)
{
    return read_assignments(r, list, what, false, out, count);
}

/* ---- the motion ---- */

static bool read_validate(reader *r)
{
    static const char *const keys[] = {"initial", "time", "tolerance"};
    const nh_deck_node *map = nh_deck_get(r->root, "validate"), *node;
    nh_analysis_file *a = r->a;
    size_t m = r->model->m;
    a->initial =
        (nh_state){.q = nh_analysis_file_take(r, m, sizeof(double)), .v = nh_analysis_file_take(r, m, sizeof(double))};
    if (!map) return true;
    if (!nh_deck_is(a->deck, map, NH_DECK_MAP, "validate", r->error) || !nh_deck_only(a->deck, map, keys, 3, r->error))
        return false;
    if ((node = nh_deck_get(map, "time"))) {
        double range[2];
        if (!nh_deck_range(a->deck, node, "the time interval [begin, end]", range, r->error)) return false;
        a->initial.t = range[0];
        a->until = range[1];
        a->has_until = true;
    }
    if ((node = nh_deck_get(map, "tolerance"))) {
        if (!nh_deck_number(a->deck, node, "tolerance", &a->tolerance, r->error)) return false;
        if (!(a->tolerance >= 1e-14 && a->tolerance <= 1e-2))
            return nh_deck_fail(a->deck, node, 0, r->error, "the tolerance must lie between 1e-14 and 1e-2");
        a->has_tolerance = true;
    }
    node = nh_deck_get(map, "initial");
    if (!node) return true;
    return nh_deck_is(a->deck, node, NH_DECK_MAP, "initial {x: 0, ...}", r->error) &&
           nh_analysis_file_read_initial(r, node);
}

static bool shape_expression(void *context, const nh_deck_node *node, nh_ex *out)
{
    return nh_analysis_file_parse(context, node, out);
}

static bool read_drawing(reader *r, const nh_deck_node *list)
{
    nh_analysis_file *a = r->a;
    a->shapes = 0;
    if (!list) return true;
    if (!nh_deck_is(a->deck, list, NH_DECK_LIST, "draw", r->error)) return false;
    a->shape = nh_analysis_file_take(r, list->count, sizeof *a->shape);
    for (size_t i = 0; i < list->count; i++)
        if (!nh_shape_read(a->deck, list->item[i], r->model->dag, shape_expression, r, &a->shape[i], r->error))
            return false;
    a->shapes = list->count;
    return true;
}

static bool read_scene(reader *r)
{
    static const char *const keys[] = {"watch", "draw"};
    const nh_deck_node *map = nh_deck_get(r->root, "scene");
    if (!map) return true;
    if (!nh_deck_is(r->a->deck, map, NH_DECK_MAP, "scene", r->error) ||
        !nh_deck_only(r->a->deck, map, keys, 2, r->error))
        return false;
    return read_assignments(r, nh_deck_get(map, "watch"), "watch", false, &r->a->watch, &r->a->watches) &&
           read_drawing(r, nh_deck_get(map, "draw"));
}

bool nh_analysis_file_resolve(nh_analysis_file *a, const nh_model *model, nh_error *error)
{
    const nh_deck_node *root = nh_deck_root(a->deck), *definitions = nh_deck_get(root, "definitions"),
                       *unknowns = nh_deck_get(root, "unknowns");
    reader r = {.a = a, .model = model, .root = root, .error = error};
    nh_ex taken;
    r.extra = nh_analysis_file_take(&r, 2 + (definitions ? definitions->count : 0) + (unknowns ? unknowns->count : 0),
                                    sizeof *r.extra);
    if (model->M && !nh_symbol_find(model->dag, "E", &taken))
        r.extra[r.extras++] = (nh_named){.name = "E", .value = model->E};
    if (model->M && !nh_symbol_find(model->dag, "Lbar", &taken))
        r.extra[r.extras++] = (nh_named){.name = "Lbar", .value = model->Lbar};
    r.own = r.extras;
    return read_unknowns(&r) &&
           read_assignments(&r, definitions, "definitions", true, &a->definition, &a->definitions) &&
           nh_analysis_file_read_ansatz(&r) && read_validate(&r) && read_scene(&r) && nh_analysis_file_read_figures(&r);
}
