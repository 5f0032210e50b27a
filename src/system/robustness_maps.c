/* robustness_maps: the robustness maps that a system file names: planes of initial values or parameters in which
 * motions may be hard to compute. */
#include <stdlib.h>
#include <string.h>

#include "system/system_internal.h"

/* {name: value, ...} */
static bool read_numbers(nh_system_reader *r, const nh_deck_node *map, const char *key, size_t *count, nh_setting **out)
{
    const nh_deck_node *node = nh_deck_get(map, key);
    if (!node) return true;
    if (!nh_deck_is(r->deck, node, NH_DECK_MAP, key, r->error)) return false;
    *out = nh_system_take(r, node->count, sizeof **out);
    for (size_t i = 0; i < node->count; i++) {
        (*out)[i] = (nh_setting){.name = node->key[i]->text, .deck = r->deck, .key = node->key[i]};
        if (!nh_deck_number(r->deck, node->item[i], node->key[i]->text, &(*out)[i].value, r->error)) return false;
    }
    *count = node->count;
    return true;
}

static bool read_number(nh_system_reader *r, const nh_deck_node *map, const char *key, double *out)
{
    const nh_deck_node *node = nh_deck_get(map, key);
    if (!node || !nh_deck_number(r->deck, node, key, out, r->error)) return !node;
    return *out > 0 || nh_deck_fail(r->deck, node, 0, r->error, "`%s` must be a number above 0", key);
}

static bool read_one(nh_system_reader *r, const nh_deck_node *item, nh_named_map *out)
{
    static const char *const keys[] = {"name",  "doc",  "over", "initial", "velocities",
                                       "until", "step", "set",  "options"};
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a map {name: ..., over: \"NAME=LOW:HIGH\"}", r->error) ||
        !nh_deck_only(r->deck, item, keys, sizeof keys / sizeof *keys, r->error))
        return false;
    if (!nh_system_text_of(r, item, "name", NULL, &out->name) || !nh_system_text_of(r, item, "doc", "", &out->doc) ||
        !nh_system_text_of(r, item, "over", NULL, &out->over) ||
        !nh_system_text_of(r, item, "initial", NULL, &out->initial) ||
        !nh_system_text_of(r, item, "velocities", NULL, &out->velocities))
        return false;
    if (!out->name || !out->over)
        return nh_deck_fail(r->deck, item, 0, r->error,
                            "a robustness map needs a `name` and the ranges `over` which it goes");
    if (out->velocities && strcmp(out->velocities, "auto") && strcmp(out->velocities, "quasi") &&
        strcmp(out->velocities, "coordinates")) {
        nh_deck_fail(r->deck, nh_deck_get(item, "velocities"), 0, r->error, "unknown velocities `%s`", out->velocities);
        return nh_error_hint(r->error, "expected auto, quasi or coordinates");
    }
    return read_number(r, item, "until", &out->until) && read_number(r, item, "step", &out->step) &&
           read_numbers(r, item, "set", &out->settings, &out->setting) &&
           read_numbers(r, item, "options", &out->options, &out->option);
}

bool nh_system_read_robustness(nh_system_reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_system *system = r->system;
    if (!nh_system_list_of(r, r->root, "robustness", &list, &n)) return false;
    system->robustness_map = nh_system_take(r, n, sizeof *system->robustness_map);
    for (size_t i = 0; i < n; i++)
        if (!read_one(r, list->item[i], &system->robustness_map[i])) return false;
    system->robustness_maps = n;
    return true;
}
