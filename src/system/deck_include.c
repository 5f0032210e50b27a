/* deck_include: one file that builds on another. */
#include <string.h>

#include "system/deck_internal.h"
#include "base/files.h"

enum { deepest = 16 };

static const nh_deck_node *merged(nh_arena *arena, const char *key, const nh_deck_node *base, const nh_deck_node *own);

/* Do two entries {name: x} of a list have the same x? */
static const char *name_of(const nh_deck_node *item)
{
    const nh_deck_node *name = nh_deck_get(item, "name");
    return name && name->kind == NH_DECK_SCALAR ? name->text : NULL;
}

static void put_item(nh_deck_node *list, const nh_deck_node *item)
{
    const char *name = name_of(item);
    for (size_t i = 0; name && i < list->count; i++) {
        const char *other = name_of(list->item[i]);
        if (!other || strcmp(name, other)) continue;
        list->item[i] = item;
        return;
    }
    list->item[list->count++] = item;
}

static void put_entry(nh_arena *arena, nh_deck_node *map, const nh_deck_node *key, const nh_deck_node *value)
{
    for (size_t i = 0; i < map->count; i++) {
        if (strcmp(map->key[i]->text, key->text)) continue;
        map->key[i] = key;
        map->item[i] = merged(arena, key->text, map->item[i], value);
        return;
    }
    map->key[map->count] = key;
    map->item[map->count++] = value;
}

static bool all_named(const nh_deck_node *list)
{
    bool all = list->kind == NH_DECK_LIST;
    for (size_t i = 0; i < list->count && all; i++) all = name_of(list->item[i]) != NULL;
    return all;
}

/* An entry `x: 1` or `x: {...}` as {name: x, KEY: 1} or {name: x, ...}, with its place in the file. */
static const nh_deck_node *named_item(nh_arena *arena, const char *short_for, const nh_deck_node *key,
                                      const nh_deck_node *value)
{
    bool whole = value->kind == NH_DECK_MAP;
    size_t count = whole ? value->count : 1;
    nh_deck_node *node = nh_arena_alloc(arena, sizeof *node), *word = nh_arena_alloc(arena, 2 * sizeof *word);
    *node = *value;
    node->kind = NH_DECK_MAP;
    node->count = 0;
    node->item = nh_arena_alloc(arena, (count + 1) * sizeof *node->item);
    node->key = nh_arena_alloc(arena, (count + 1) * sizeof *node->key);
    word[0] = word[1] = *key;
    word[0].text = "name";
    word[1].text = short_for;
    put_entry(arena, node, &word[0], key);
    for (size_t i = 0; i < count; i++)
        put_entry(arena, node, whole ? value->key[i] : &word[1], whole ? value->item[i] : value);
    return node;
}

/* [x: 1, ..] is what YAML reads as a list of maps of one entry: {x: 1} is an entry of {x: 1, ..}. */
static bool is_entry(const char *short_for, const nh_deck_node *item)
{
    return item->kind == NH_DECK_MAP && item->count == 1 && strcmp(item->key[0]->text, "name") &&
           strcmp(item->key[0]->text, short_for);
}

static const nh_deck_node *listed(nh_arena *arena, const char *short_for, const nh_deck_node *from)
{
    if (from->kind == NH_DECK_SCALAR) return from;
    nh_deck_node *list = nh_arena_alloc(arena, sizeof *list);
    *list = *from;
    list->kind = NH_DECK_LIST;
    list->key = NULL;
    list->item = nh_arena_alloc(arena, (from->count + 1) * sizeof *list->item);
    for (size_t i = 0; i < from->count; i++) {
        const nh_deck_node *item = from->item[i], *entry = from->kind == NH_DECK_MAP ? from : item;
        bool whole = from->kind == NH_DECK_LIST && !is_entry(short_for, item);
        size_t k = entry == from ? i : 0;
        list->item[i] = whole ? item : named_item(arena, short_for, entry->key[k], entry->item[k]);
    }
    return list;
}

const nh_deck_node *nh_deck_named(nh_deck *deck, const char *short_for, const nh_deck_node *node)
{
    return listed(deck->arena, short_for, node);
}

static const nh_deck_node *merged(nh_arena *arena, const char *key, const nh_deck_node *base, const nh_deck_node *own)
{
    const char *short_for = key && !strcmp(key, "coordinates") ? "type" : "value";
    if (all_named(base)) own = listed(arena, short_for, own);
    else if (all_named(own)) base = listed(arena, short_for, base);
    if (base->kind != own->kind || own->kind == NH_DECK_SCALAR) return own;
    nh_deck_node *node = nh_arena_alloc(arena, sizeof *node);
    *node = *own;
    node->count = 0;
    node->item = nh_arena_alloc(arena, (base->count + own->count + 1) * sizeof *node->item);
    node->key =
        own->kind == NH_DECK_MAP ? nh_arena_alloc(arena, (base->count + own->count + 1) * sizeof *node->key) : NULL;
    for (int pass = 0; pass < 2; pass++) {
        const nh_deck_node *from = pass ? own : base;
        for (size_t i = 0; i < from->count; i++) {
            if (node->key) put_entry(arena, node, from->key[i], from->item[i]);
            else if (pass) put_item(node, from->item[i]);
            else node->item[node->count++] = from->item[i];
        }
    }
    return node;
}

static const nh_deck_node *without(nh_arena *arena, const nh_deck_node *map, const char *key)
{
    nh_deck_node *node = nh_arena_alloc(arena, sizeof *node);
    *node = *map;
    node->item = nh_arena_alloc(arena, (map->count + 1) * sizeof *node->item);
    node->key = nh_arena_alloc(arena, (map->count + 1) * sizeof *node->key);
    node->count = 0;
    for (size_t i = 0; i < map->count; i++) {
        if (!strcmp(map->key[i]->text, key)) continue;
        node->key[node->count] = map->key[i];
        node->item[node->count++] = map->item[i];
    }
    return node;
}

/* A file may name any other, which may be secret: messages quote only what is called a file for us. */
static bool is_shown(const char *path)
{
    static const char *const ending[] = {".yaml", ".yml", ".urdf", ".xml", ".xacro"};
    const char *dot = strrchr(path, '.');
    bool shown = false;
    for (size_t i = 0; i < sizeof ending / sizeof *ending && dot; i++) shown |= !strcmp(dot, ending[i]);
    return shown;
}

const char *nh_deck_beside(nh_deck *deck, const nh_deck_node *node)
{
    const char *name = node->deck ? node->deck->name : deck->name, *slash = strrchr(name, '/');
    int folder = slash && node->text[0] != '/' ? (int)(slash - name) + 1 : 0;
    return nh_arena_printf(deck->arena, "%.*s%s", folder, name, node->text);
}

static bool include(nh_deck *deck, int depth, nh_deck_prepare *prepare, nh_error *error)
{
    if (prepare && !prepare(deck, error)) return false;
    /* a robot description is a file like others */
    if (!nh_deck_rename(deck, deck->root, "urdf", "include", error)) return false;
    const nh_deck_node *node = nh_deck_get(deck->root, "include");
    if (!node) return true;
    if (!nh_deck_is(deck, node, NH_DECK_SCALAR, "the name of a file", error)) return false;
    if (depth > deepest)
        return nh_deck_fail(deck, node, 0, error,
                            "files include each other more than %d deep: does one include itself?", deepest);
    const char *path = nh_deck_beside(deck, node);
    size_t length;
    nh_error unreadable;
    nh_error_clear(&unreadable);
    char *text = nh_files_read(path, NH_DECK_SIZE_LIMIT, &length, &unreadable);
    if (!text && !strstr(unreadable.what, "cannot be opened")) return *error = unreadable, false;
    if (!text) { /* the message points at the word that asks for it */
        nh_deck_fail(deck, node, 0, error, "the file `%s` cannot be opened", path);
        return nh_error_hint(error,
                             "the name of an included file is relative to the folder of the file that includes it");
    }
    bool hidden = !is_shown(path);
    deck->included = nh_deck_parse(path, text, length, error);
    nh_free(text);
    if (!deck->included && hidden) return nh_deck_fail_hidden(path, error);
    if (deck->included) deck->included->hidden = hidden;
    if (!deck->included || !include(deck->included, depth + 1, prepare, error)) return false;
    if (!nh_deck_is(deck->included, deck->included->root, NH_DECK_MAP, "an included file (name: ..., ...)", error))
        return false;
    deck->root = merged(deck->arena, NULL, deck->included->root, without(deck->arena, deck->root, "include"));
    return true;
}

bool nh_deck_include(nh_deck *deck, nh_deck_prepare *prepare, nh_error *error)
{
    return include(deck, 1, prepare, error);
}

bool nh_deck_rename(nh_deck *deck, const nh_deck_node *map, const char *old, const char *key, nh_error *error)
{
    for (size_t i = 0; map && map->kind == NH_DECK_MAP && i < map->count; i++) {
        if (strcmp(map->key[i]->text, old)) continue;
        if (nh_deck_get(map, key)) {
            nh_deck_fail(deck, map->key[i], 0, error, "`%s` and `%s` are two names of one key", old, key);
            return nh_error_hint(error, "keep `%s`; `%s` is its old name", key, old);
        }
        nh_deck_node *renamed = nh_arena_alloc(deck->arena, sizeof *renamed);
        *renamed = *map->key[i];
        renamed->text = key;
        map->key[i] = renamed;
    }
    return true;
}
