/* robot: see robot.h. */
#include "system/system_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "system/deck_build.h"
#include "system/urdf.h"

enum { height_size = 40 };

typedef struct {
    nh_deck *deck;
    nh_error *error;
    /* of the file; rims: NULL where no robot description takes part */
    const nh_deck_node *root, *bodies, *joints, *rims;
    nh_deck_node *wheels, *notes;
} reader;

static const char *text_of(const nh_deck_node *map, const char *key)
{
    const nh_deck_node *node = nh_deck_get(map, key);
    return node && node->kind == NH_DECK_SCALAR ? node->text : "";
}

/* The entry of a list whose `key` is this word, or NULL. */
static const nh_deck_node *entry(const nh_deck_node *list, const char *key, const char *word)
{
    for (size_t i = 0; list && list->kind == NH_DECK_LIST && i < list->count; i++)
        if (!strcmp(text_of(list->item[i], key), word)) return list->item[i];
    return NULL;
}

static void note(reader *r, const nh_deck_node *place, const char *text)
{
    nh_deck_append(r->deck, r->notes,
                   nh_deck_word_at(r->deck,
                                   nh_arena_printf(r->deck->arena, "%s:%zu: %s", place->deck->name, place->line, text),
                                   place));
}

/* ---- wheels ---- */

/* Values from the robot description and the body's joint, where the entry itself has none. */
static bool fill(reader *r, const nh_deck_node *item, nh_deck_node *wheel, const char *body)
{
    const nh_deck_node *joint = entry(r->joints, "child", body), *rim = nh_deck_get(r->rims, body),
                       *axis = nh_deck_get(joint, "axis"), *place = item;
    bool turns = !strcmp(text_of(joint, "type"), "revolute");
    if (item->kind == NH_DECK_MAP) place = nh_deck_get(item, "body");
    if (!turns && !nh_deck_get(wheel, "axle")) {
        nh_deck_fail(r->deck, place, 0, r->error, "`%s` cannot be a wheel: no joint turns it about an axis", body);
        return nh_error_hint(r->error, "for a ball write {type: ball, body: %s, radius: ..}", body);
    }
    if (!nh_deck_get(wheel, "type")) nh_deck_put(r->deck, wheel, "type", nh_deck_word_at(r->deck, "rolling", place));
    if (!nh_deck_get(wheel, "axle"))
        nh_deck_put(r->deck, wheel, "axle", axis ? axis : nh_deck_word_at(r->deck, "z", place));
    if (!nh_deck_get(wheel, "at") && nh_deck_get(rim, "at") && !nh_deck_get(wheel, "radius"))
        nh_deck_put(r->deck, wheel, "at", nh_deck_get(rim, "at"));
    if (nh_deck_get(wheel, "radius")) return true;
    if (nh_deck_get(rim, "radius")) return nh_deck_put(r->deck, wheel, "radius", nh_deck_get(rim, "radius")), true;
    const char *why = text_of(rim, "why");
    nh_deck_fail(r->deck, place, 0, r->error, "the wheel `%s` needs a radius%s%s", body, *why ? ": " : "", why);
    return nh_error_hint(r->error, "write {body: %s, radius: 0.1} under `wheels:`, or --wheel %s=0.1", body, body);
}

static bool known_body(reader *r, const nh_deck_node *word, const char *body)
{
    const char **names = nh_arena_alloc(r->deck->arena, (r->bodies->count + 1) * sizeof *names);
    for (size_t i = 0; i < r->bodies->count; i++) {
        names[i] = text_of(r->bodies->item[i], "name");
        if (!strcmp(names[i], body)) return true;
    }
    nh_deck_fail(r->deck, word, 0, r->error, "there is no body `%s`", word->text);
    const char *turned = text_of(entry(r->joints, "name", body), "child");
    if (*turned)
        return nh_error_hint(r->error, "the joint `%s` turns the body `%s`: name the body", word->text, turned);
    const char *near = nh_text_nearest(body, names, r->bodies->count);
    return near ? nh_error_hint(r->error, "did you mean `%s`?", near)
                : nh_error_hint(r->error, "a wheel is a body that a joint turns");
}

/* The body of a name, which may be the link's own in the robot description, as in l.wheel for l_wheel. */
static const char *body_of(reader *r, const char *word)
{
    for (size_t i = 0; r->rims && i < r->rims->count; i++)
        if (!strcmp(text_of(r->rims->item[i], "written"), word)) return r->rims->key[i]->text;
    const char *converted = nh_urdf_name(r->deck->arena, word);
    return entry(r->bodies, "name", word) || !entry(r->bodies, "name", converted) ? word : converted;
}

/* An entry that is only a name, or of a body with a circle; others stay as they are. */
static bool read_wheel(reader *r, const nh_deck_node *item)
{
    const nh_deck_node *word = item->kind == NH_DECK_SCALAR ? item : nh_deck_get(item, "body");
    const char *type = text_of(item, "type");
    bool short_form = item->kind == NH_DECK_SCALAR ||
                      (word && word->kind == NH_DECK_SCALAR && r->rims && (!*type || !strcmp(type, "rolling")));
    if (!short_form) return nh_deck_append(r->deck, r->wheels, item), true;
    const char *body = body_of(r, word->text);
    nh_deck_node *wheel =
        item->kind == NH_DECK_MAP ? nh_deck_copy(r->deck, item, "body") : nh_deck_new_at(r->deck, NH_DECK_MAP, item);
    nh_deck_put(r->deck, wheel, "body", nh_deck_word_at(r->deck, body, word));
    nh_deck_append(r->deck, r->wheels, wheel);
    return known_body(r, word, body) && fill(r, item, wheel, body);
}

/* ---- the joint that carries the root ---- */

/* The height of the root's origin at which the first wheel touches the plane z = 0. */
static bool height_of(reader *r, char out[height_size])
{
    double height = NAN;
    for (size_t i = 0; i < r->wheels->count && isnan(height); i++) {
        const nh_deck_node *rim = nh_deck_get(r->rims, text_of(r->wheels->item[i], "body"));
        double radius, centre;
        if (!nh_text_to_number(text_of(r->wheels->item[i], "radius"), &radius) ||
            !nh_text_to_number(text_of(rim, "height"), &centre))
            continue;
        height = radius - centre;
    }
    snprintf(out, height_size, "%.12g", height);
    return !isnan(height) && strtod(out, NULL) != 0;
}

/* x, y, heading, unless another joint has one of these names. */
static void put_coordinates(reader *r, nh_deck_node *joint, size_t count, const char *const *names,
                            const nh_deck_node *place)
{
    const nh_deck_node *parameters = nh_deck_get(r->root, "parameters");
    nh_deck_node *list = nh_deck_new_at(r->deck, NH_DECK_LIST, place);
    for (size_t i = 0; i < count; i++) {
        if (entry(r->joints, "name", names[i]) || entry(parameters, "name", names[i])) return;
        nh_deck_append(r->deck, list, nh_deck_word_at(r->deck, names[i], place));
    }
    nh_deck_put(r->deck, joint, "coordinates", list);
}

/* The only body that no joint carries. */
static const nh_deck_node *root_body(reader *r, size_t *count)
{
    const nh_deck_node *found = NULL;
    *count = 0;
    for (size_t i = 0; i < r->bodies->count; i++) {
        if (entry(r->joints, "child", text_of(r->bodies->item[i], "name"))) continue;
        if (++*count == 1) found = nh_deck_get(r->bodies->item[i], "name");
        else if (*count == 2 && found)
            nh_deck_fail(r->deck, nh_deck_get(r->bodies->item[i], "name"), 0, r->error,
                         "no joint has `%s` as its child, and none has `%s`", text_of(r->bodies->item[i], "name"),
                         found->text);
    }
    if (*count > 1) nh_error_hint(r->error, "one body carries all others: connect them by joints");
    return *count == 1 ? found : NULL;
}

static bool base_type(reader *r, const nh_deck_node *base, const nh_deck_node *body, const char **out)
{
    static const char *const words[] = {"fixed", "planar", "floating", "free"};
    bool rolls = r->wheels->count > 0 && strcmp(body->text, "world");
    *out = base ? base->text : rolls ? "planar" : "fixed";
    if (base && !nh_deck_is(r->deck, base, NH_DECK_SCALAR, "base", r->error)) return false;
    for (int i = 0; i < 4; i++)
        if (!strcmp(*out, words[i])) return true;
    nh_deck_fail(r->deck, base, 0, r->error, "`%s` is not a kind of base; expected fixed, planar, floating or free",
                 *out);
    const char *near = nh_text_nearest(*out, words, 4);
    return near ? nh_error_hint(r->error, "did you mean `%s`?", near) : false;
}

/* Links that could roll, and none is named. */
static const char *idle_wheels(reader *r)
{
    const char *list = NULL;
    for (size_t i = 0; r->rims && !r->wheels->count && i < r->rims->count; i++)
        if (*text_of(r->rims->item[i], "like"))
            list = list ? nh_arena_printf(r->deck->arena, "%s,%s", list, r->rims->key[i]->text) : r->rims->key[i]->text;
    return list;
}

/* Who gives neither wheels nor a base may not have thought of them. */
static void note_fixed(reader *r, const nh_deck_node *body)
{
    const char *idle = idle_wheels(r);
    if (idle)
        note(r, body,
             nh_arena_printf(r->deck->arena,
                             "`%s` is fixed to the ground, and links that look like wheels turn in the air: "
                             "--wheel %s lets them roll",
                             body->text, idle));
    else if (strcmp(body->text, "world"))
        note(r, body,
             nh_arena_printf(r->deck->arena, "`%s` is fixed to the ground: --base floating or planar lets it move",
                             body->text));
}

/* A joint `base` between the ground and the root; NULL where it is not needed. */
static bool base_joint(reader *r, const nh_deck_node *base, const nh_deck_node **out)
{
    static const char *const plane[] = {"x", "y", "heading"}, *const space[] = {"x", "y", "z", "yaw", "pitch", "roll"},
                             *const turned[] = {"x", "y", "z", "R"};
    size_t roots;
    const char *type;
    char height[height_size];
    const nh_deck_node *body = root_body(r, &roots);
    if (roots == 0 && base)
        return nh_deck_fail(r->deck, base, 0, r->error, "`base` has nothing to carry: every body has a joint");
    if (!body) return roots < 2;
    if (!base_type(r, base, body, &type)) return false;
    if (!base && !strcmp(type, "fixed")) note_fixed(r, body);
    nh_deck_node *joint = nh_deck_new_at(r->deck, NH_DECK_MAP, body);
    const char *kind = !strcmp(type, "floating") ? "free" : type;
    const char *name = "base";
    while (entry(r->joints, "name", name)) name = nh_arena_printf(r->deck->arena, "%s_joint", name);
    nh_deck_put(r->deck, joint, "name", nh_deck_word_at(r->deck, name, body));
    nh_deck_put(r->deck, joint, "type", nh_deck_word_at(r->deck, kind, body));
    nh_deck_put(r->deck, joint, "child", body);
    if (!strcmp(kind, "planar") && height_of(r, height)) {
        nh_deck_node *at = nh_deck_new_at(r->deck, NH_DECK_LIST, body);
        for (int i = 0; i < 3; i++) nh_deck_append(r->deck, at, nh_deck_word_at(r->deck, i == 2 ? height : "0", body));
        nh_deck_put(r->deck, joint, "at", at);
    }
    if (!strcmp(kind, "planar")) put_coordinates(r, joint, 3, plane, body);
    bool angles = !strcmp(type, "floating");
    if (!strcmp(kind, "free")) put_coordinates(r, joint, angles ? 6 : 4, angles ? space : turned, body);
    if (!strcmp(kind, "free") && !angles) nh_deck_put(r->deck, joint, "angles", nh_deck_word_at(r->deck, "none", body));
    *out = joint;
    return true;
}

/* ---- the whole file ---- */

static nh_deck_node *list_under(reader *r, const char *key)
{
    const nh_deck_node *node = nh_deck_get(r->root, key);
    return node && node->kind == NH_DECK_LIST ? nh_deck_copy(r->deck, node, NULL)
                                              : nh_deck_new_at(r->deck, NH_DECK_LIST, r->root);
}

bool nh_robot_complete(nh_deck *deck, nh_error *error)
{
    static const char *const made[] = {"wheels", "joints", "notes", "base", NH_URDF_RIMS};
    reader r = {.deck = deck, .error = error, .root = deck->root};
    const nh_deck_node *base = nh_deck_get(r.root, "base"), *wheels = nh_deck_get(r.root, "wheels"), *carrying = NULL;
    r.bodies = nh_deck_get(r.root, "bodies");
    r.joints = nh_deck_get(r.root, "joints");
    r.rims = nh_deck_get(r.root, NH_URDF_RIMS);
    if (base && !r.bodies) return nh_deck_fail(deck, base, 0, error, "`base` needs `bodies:`, but the file has none");
    if (!r.bodies || r.bodies->kind != NH_DECK_LIST || (wheels && wheels->kind != NH_DECK_LIST) ||
        (r.joints && r.joints->kind != NH_DECK_LIST))
        return true;
    r.wheels = nh_deck_new_at(deck, NH_DECK_LIST, wheels ? wheels : r.root);
    r.notes = list_under(&r, "notes");
    for (size_t i = 0; wheels && i < wheels->count; i++)
        if (!read_wheel(&r, wheels->item[i])) return false;
    if ((base || r.rims) && !base_joint(&r, base, &carrying)) return false;
    nh_deck_node *root = nh_deck_copy(deck, r.root, NULL), *joints = list_under(&r, "joints");
    for (size_t i = 0; i < sizeof made / sizeof *made; i++) root = nh_deck_copy(deck, root, made[i]);
    if (carrying) nh_deck_append(deck, joints, carrying);
    if (r.joints || carrying) nh_deck_put(deck, root, "joints", joints);
    if (wheels) nh_deck_put(deck, root, "wheels", r.wheels);
    if (r.notes->count) nh_deck_put(deck, root, "notes", r.notes);
    deck->root = root;
    return true;
}
