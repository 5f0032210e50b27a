/* bodies_read: reads the tree of a system file's `bodies:` and `joints:`: names, kinds, parents, coordinates.  No
 * expression is read here: expressions may contain the coordinates of joints, so that these must be known before. */
#include <string.h>

#include "base/text.h"
#include "graph/dag.h"
#include "graph/parse.h"
#include "system/bodies_tree.h"

typedef nh_system_reader reader;

static const char *const kind_names[NH_JOINT_KINDS] = {
#define X(kind, word, screws, turns, letters, keys) word,
    NH_JOINT_TABLE(X)
#undef X
};

static const struct {
    size_t degrees;
    unsigned turns;
    const char *letters;
    unsigned keys;
} kinds[NH_JOINT_KINDS] = {
#define X(kind, word, screws, turns, letters, keys) {screws, turns, letters, keys},
    NH_JOINT_TABLE(X)
#undef X
};

/* ---- words ---- */

long nh_system_word(reader *r, const nh_deck_node *node, const char *what, size_t count, const char *const *words)
{
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, what, r->error)) return -1;
    for (size_t i = 0; i < count; i++)
        if (!strcmp(node->text, words[i])) return (long)i;
    nh_text list;
    nh_text_init(&list);
    for (size_t i = 0; i < count; i++)
        nh_text_addf(&list, "%s%s", i == 0 ? "" : i + 1 == count ? " or " : ", ", words[i]);
    nh_deck_fail(r->deck, node, 0, r->error, "`%s` is not %s; expected %s", node->text, what, nh_text_string(&list));
    nh_text_clear(&list);
    const char *near = nh_text_nearest(node->text, words, count);
    if (near) nh_error_hint(r->error, "did you mean `%s`?", near);
    return -1;
}

long nh_system_body_word(reader *r, const nh_deck_node *map, const char *key, long fallback)
{
    const nh_chain *c = r->system->chain;
    const nh_deck_node *node = nh_deck_get(map, key);
    if (!node && fallback >= NH_GROUND) return fallback;
    if (!node) {
        nh_deck_fail(r->deck, map, 0, r->error, "this entry has no `%s`", key);
        nh_error_hint(r->error, "its value is the name of a body");
        return NH_NOBODY;
    }
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, key, r->error)) return NH_NOBODY;
    if (!strcmp(node->text, "ground")) return NH_GROUND;
    const char **names = nh_system_take(r, c->bodies + 1, sizeof *names);
    for (size_t i = 0; i < c->bodies; i++) {
        names[i] = c->body[i].name;
        if (!strcmp(names[i], node->text)) return (long)i;
    }
    names[c->bodies] = "ground";
    nh_deck_fail(r->deck, node, 0, r->error, "there is no body `%s`", node->text);
    const char *near = nh_text_nearest(node->text, names, c->bodies + 1);
    if (near) nh_error_hint(r->error, "did you mean `%s`?", near);
    return NH_NOBODY;
}

/* ---- bodies ---- */

static bool read_body(reader *r, const nh_deck_node *item, nh_body *b)
{
    static const char *const keys[] = {"name", "mass", "inertia", "center", "rotation", "doc"};
    nh_chain *c = r->system->chain;
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a body {name: ..., mass: ...}", r->error)) return false;
    if (!nh_deck_only(r->deck, item, keys, 6, r->error)) return false;
    const nh_deck_node *name = nh_deck_get(item, "name");
    if (!name) return nh_deck_fail(r->deck, item, 0, r->error, "this body has no `name`");
    if (!nh_deck_is(r->deck, name, NH_DECK_SCALAR, "a name", r->error)) return false;
    if (!nh_is_name(name->text)) {
        nh_deck_fail(r->deck, name, 0, r->error, "`%s` is not a name", name->text);
        return nh_name_hint(r->error, name->text);
    }
    if (!strcmp(name->text, "ground"))
        return nh_deck_fail(r->deck, name, 0, r->error,
                            "`ground` is the fixed frame; choose another name for the body");
    for (size_t i = 0; i < c->bodies; i++)
        if (!strcmp(c->body[i].name, name->text))
            return nh_deck_fail(r->deck, name, 0, r->error, "there are two bodies `%s`", name->text);
    *b = (nh_body){.name = name->text, .joint = SIZE_MAX, .node = item};
    return nh_system_text_of(r, item, "doc", "", &b->doc);
}

static bool read_bodies(reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_chain *c = r->system->chain;
    if (!nh_system_list_of(r, r->root, "bodies", &list, &n)) return false;
    if (n == 0) return nh_deck_fail(r->deck, list, 0, r->error, "this list contains no body");
    c->body = nh_system_take(r, n, sizeof *c->body);
    for (size_t i = 0; i < n; i++) {
        if (!read_body(r, list->item[i], &c->body[i])) return false;
        c->bodies = i + 1;
    }
    return true;
}

/* ---- joints ---- */

static size_t degrees_of(reader *r, const nh_deck_node *item, nh_joint_kind kind)
{
    const nh_deck_node *axes = nh_deck_get(item, "axes");
    if (kind != NH_JOINT_TRANSLATION) return kinds[kind].degrees;
    if (!axes) nh_deck_fail(r->deck, item, 0, r->error, "a joint of type translation needs `axes`");
    if (!axes) nh_error_hint(r->error, "for example: axes: [x, y]");
    if (!axes || !nh_deck_is(r->deck, axes, NH_DECK_LIST, "axes", r->error)) return SIZE_MAX;
    if (axes->count == 2 || axes->count == 3) return axes->count;
    nh_deck_fail(r->deck, axes, 0, r->error, "a joint of type translation has 2 or 3 axes, not %zu", axes->count);
    nh_error_hint(r->error, "a translation along one axis is a joint of type prismatic");
    return SIZE_MAX;
}

static bool carries(reader *r, const nh_deck_node *item, nh_joint *j, size_t index)
{
    nh_chain *c = r->system->chain;
    j->parent = nh_system_body_word(r, item, "parent", NH_GROUND);
    if (j->parent == NH_NOBODY) return false;
    long child = nh_system_body_word(r, item, "child", NH_NOBODY);
    if (child == NH_NOBODY) return false;
    const nh_deck_node *node = nh_deck_get(item, "child");
    if (child == NH_GROUND)
        return nh_deck_fail(r->deck, node, 0, r->error, "the ground cannot be the child of a joint: it does not move");
    j->child = (size_t)child;
    nh_body *b = &c->body[child];
    if (b->joint != SIZE_MAX) {
        nh_deck_fail(r->deck, node, 0, r->error, "`%s` is already the child of the joint `%s`", b->name,
                     c->joint[b->joint].name);
        return nh_error_hint(r->error, "chains must be open: close a loop by an equation under `constraints:`");
    }
    b->joint = index;
    return true;
}

/* Is there a key that has no meaning for this kind of joint? */
static bool fitting_keys(reader *r, const nh_deck_node *item, nh_joint_kind kind)
{
    static const struct {
        const char *key;
        unsigned bit;
    } rule[] = {
        {"axis", NH_JOINT_AXIS}, {"axes", NH_JOINT_AXES}, {"pitch", NH_JOINT_PITCH}, {"angles", NH_JOINT_ANGLES}};
    for (size_t i = 0; i < sizeof rule / sizeof *rule; i++) {
        if (kinds[kind].keys & rule[i].bit || !nh_deck_get(item, rule[i].key)) continue;
        return nh_deck_fail(r->deck, nh_deck_get(item, rule[i].key), 0, r->error, "a joint of type %s has no `%s`",
                            kind_names[kind], rule[i].key);
    }
    if (kinds[kind].keys & NH_JOINT_PITCH && !nh_deck_get(item, "pitch")) {
        nh_deck_fail(r->deck, item, 0, r->error, "a joint of type %s needs a `pitch`", kind_names[kind]);
        return nh_error_hint(r->error, "the pitch is the advance per radian");
    }
    return true;
}

static bool read_joint(reader *r, const nh_deck_node *item, size_t index)
{
    static const char *const keys[] = {"name", "type",  "parent", "child",       "at",     "rotation", "axis",
                                       "axes", "pitch", "angles", "coordinates", "values", "doc"};
    nh_chain *c = r->system->chain;
    nh_joint *j = &c->joint[index];
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a joint {type: ..., parent: ..., child: ...}", r->error)) return false;
    if (!nh_deck_only(r->deck, item, keys, sizeof keys / sizeof *keys, r->error)) return false;
    const nh_deck_node *type = nh_deck_get(item, "type");
    if (!type) {
        nh_deck_fail(r->deck, item, 0, r->error, "this joint has no `type`");
        return nh_error_hint(r->error, "for example: {type: revolute, parent: ground, child: %s}", c->body[0].name);
    }
    long kind = nh_system_word(r, type, "a type of joint", NH_JOINT_KINDS, kind_names);
    if (kind < 0) return false;
    *j = (nh_joint){.kind = (nh_joint_kind)kind, .node = item, .first = c->screws, .orientation = -1};
    if (!fitting_keys(r, item, j->kind) || !carries(r, item, j, index)) return false;
    if (!nh_system_text_of(r, item, "name", c->body[j->child].name, &j->name) ||
        !nh_system_text_of(r, item, "doc", "", &j->doc))
        return false;
    j->screws = degrees_of(r, item, j->kind);
    if (j->screws == SIZE_MAX) return false;
    c->screws += j->screws;
    return true;
}

static bool read_joints(reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_chain *c = r->system->chain;
    if (!nh_system_list_of(r, r->root, "joints", &list, &n)) return false;
    c->joint = nh_system_take(r, n, sizeof *c->joint);
    c->screw = nh_system_take(r, NH_MOST_SCREWS * n, sizeof *c->screw);
    for (size_t i = 0; i < n; i++) {
        if (!read_joint(r, list->item[i], i)) return false;
        c->joints = i + 1;
    }
    for (size_t b = 0; b < c->bodies; b++) {
        if (c->body[b].joint != SIZE_MAX) continue;
        nh_deck_fail(r->deck, c->body[b].node, 0, r->error, "no joint has `%s` as its child", c->body[b].name);
        return nh_error_hint(r->error, "a body that moves freely has a joint: {type: free, child: %s}",
                             c->body[b].name);
    }
    return true;
}

/* Joints in an order in which parents come first. */
static bool sort_joints(reader *r)
{
    nh_chain *c = r->system->chain;
    bool *done = nh_system_take(r, c->bodies, sizeof *done);
    c->order = nh_system_take(r, c->joints, sizeof *c->order);
    for (size_t n = 0; n < c->joints; n++) {
        size_t next = c->joints;
        for (size_t i = 0; i < c->joints && next == c->joints; i++) {
            const nh_joint *j = &c->joint[i];
            if (!done[j->child] && (j->parent == NH_GROUND || done[j->parent])) next = i;
        }
        for (size_t i = 0; i < c->joints && next == c->joints; i++) {
            if (done[c->joint[i].child]) continue;
            nh_deck_fail(r->deck, c->joint[i].node, 0, r->error,
                         "the joints above `%s` form a cycle and never reach the ground",
                         c->body[c->joint[i].child].name);
            return nh_error_hint(r->error, "one joint must have `parent: ground`");
        }
        c->order[n] = next;
        done[c->joint[next].child] = true;
    }
    return true;
}

bool nh_system_read_tree(reader *r)
{
    const nh_deck_node *bodies = nh_deck_get(r->root, "bodies"), *joints = nh_deck_get(r->root, "joints");
    static const char *const others[] = {"gravity", "wheels", "points", "springs", "dampers", "actuators"};
    if (!bodies && joints) return nh_deck_fail(r->deck, joints, 0, r->error, "the file has joints, but no `bodies:`");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        const nh_deck_node *other = nh_deck_get(r->root, others[i]);
        if (bodies || !other) continue;
        nh_deck_fail(r->deck, other, 0, r->error, "`%s` needs `bodies:`, but the file has none", others[i]);
        return i > 2 && nh_error_hint(r->error, "without bodies, a spring is a term -k/2*x^2 of the Lagrangian, a "
                                                "damper stands in `dissipation: c/2*x'^2`, an actuator in `forces:`");
    }
    if (!bodies) return true;
    r->system->chain = nh_system_take(r, 1, sizeof *r->system->chain);
    return read_bodies(r) && read_joints(r) && sort_joints(r);
}

/* ---- coordinates ---- */

/* Default names for the screws of a joint: the joint's name, and a letter when there are several. */
static const char *default_name(reader *r, const nh_joint *j, size_t k)
{
    if (j->screws == 1) return j->name;
    return nh_arena_printf(r->system->arena, "%s_%c", j->name, kinds[j->kind].letters[k]);
}

bool nh_joint_turns(const nh_joint *j, size_t k) { return kinds[j->kind].turns >> k & 1; }

static bool coordinate_of(reader *r, const nh_joint *j, size_t k, const nh_deck_node *name)
{
    nh_system *system = r->system;
    nh_screw *screw = &system->chain->screw[j->first + k];
    if (!nh_deck_is(r->deck, name, NH_DECK_SCALAR, "a name", r->error)) return false;
    long known = nh_system_coordinate(system, name->text);
    for (size_t i = 0; i < j->first + k && known >= 0; i++)
        if (system->chain->screw[i].coordinate == known) {
            nh_deck_fail(r->deck, name, 0, r->error, "`%s` is already the coordinate of another degree of freedom",
                         name->text);
            return nh_error_hint(r->error, "if one joint drives another, write `values: [%s]` for the second joint",
                                 name->text);
        }
    if (known < 0) {
        if (!nh_system_new_name(r, name)) return false;
        known = (long)system->coordinates++;
        system->coordinate[known] = (nh_coordinate){
            .name = name->text, .doc = j->doc, .type = NH_PLAIN, .q = nh_symbol(system->dag, name->text)};
    }
    nh_coordinate *q = &system->coordinate[known];
    if (q->type == NH_PLAIN) q->type = nh_joint_turns(j, k) ? NH_ANGLE : NH_LENGTH;
    screw->coordinate = known;
    return true;
}

/* An orientation instead of three angles: with `angles: none`, or where one name stands for all three. */
static bool turns_by_orientation(reader *r, const nh_joint *j, const nh_deck_node *names, bool *out)
{
    const nh_deck_node *angles = nh_deck_get(j->node, "angles");
    bool none = angles && angles->kind == NH_DECK_SCALAR && !strcmp(angles->text, "none"),
         may = j->kind == NH_JOINT_SPHERICAL || j->kind == NH_JOINT_FREE;
    *out = may && (none || (!angles && names && names->count == j->screws - 2));
    if (!*out || !names || names->count == j->screws - 2) return true;
    nh_deck_fail(r->deck, names, 0, r->error, "with `angles: none` a joint of type %s has %zu name%s, not %zu",
                 kind_names[j->kind], j->screws - 2, j->screws == 3 ? "" : "s", names->count);
    return nh_error_hint(r->error, "one name for the orientation: coordinates: [%s]",
                         j->screws == 3 ? "R" : "x, y, z, R");
}

/* The coordinates of a joint whose last three screws are the turns of an orientation. */
static bool oriented(reader *r, nh_joint *j, const nh_deck_node *names)
{
    nh_system *system = r->system;
    size_t shifts = j->screws - 3;
    nh_deck_node fallback = *j->node;
    fallback.kind = NH_DECK_SCALAR;
    for (size_t k = 0; k < j->screws; k++) system->chain->screw[j->first + k].coordinate = -1;
    for (size_t k = 0; k < shifts; k++) {
        fallback.text = names ? NULL : default_name(r, j, k);
        if (!coordinate_of(r, j, k, names ? names->item[k] : &fallback)) return false;
    }
    fallback.text = shifts ? nh_arena_printf(system->arena, "%s_R", j->name) : j->name;
    const nh_deck_node *name = names ? names->item[shifts] : &fallback;
    if (!nh_deck_is(r->deck, name, NH_DECK_SCALAR, "a name", r->error)) return false;
    nh_orientation *known = nh_orientation_named(system, name->text);
    if (!known && !nh_orientation_declare(r, NULL, name, j->doc)) return false;
    j->orientation = known ? known - system->orientation : (long)system->orientations - 1;
    for (size_t i = 0; i < system->chain->joints; i++)
        if (&system->chain->joint[i] != j && system->chain->joint[i].orientation == j->orientation)
            return nh_deck_fail(r->deck, name, 0, r->error, "`%s` is already the orientation of another joint",
                                name->text);
    return true;
}

static bool coordinates_of(reader *r, nh_joint *j)
{
    const nh_deck_node *names = nh_deck_get(j->node, "coordinates"), *values = nh_deck_get(j->node, "values");
    nh_chain *c = r->system->chain;
    if (names && values)
        return nh_deck_fail(r->deck, values, 0, r->error, "a joint has either `coordinates` or `values`");
    if (names && !nh_deck_is(r->deck, names, NH_DECK_LIST, "coordinates", r->error)) return false;
    if (values && !nh_deck_is(r->deck, values, NH_DECK_LIST, "values", r->error)) return false;
    const nh_deck_node *list = names ? names : values;
    bool turns;
    if (!values && !turns_by_orientation(r, j, names, &turns)) return false;
    if (!values && turns) return oriented(r, j, names);
    if (list && list->count != j->screws)
        return nh_deck_fail(
            r->deck, list, 0, r->error, "a joint of type %s has %zu degree%s of freedom, but %zu %s given here",
            kind_names[j->kind], j->screws, j->screws == 1 ? "" : "s", list->count, list->count == 1 ? "is" : "are");
    for (size_t k = 0; k < j->screws; k++) {
        nh_deck_node fallback = *j->node;
        fallback.kind = NH_DECK_SCALAR;
        fallback.text = names ? NULL : default_name(r, j, k);
        c->screw[j->first + k].coordinate = -1;
        if (!values && !coordinate_of(r, j, k, names ? names->item[k] : &fallback)) return false;
    }
    return true;
}

bool nh_system_read_joint_coordinates(reader *r)
{
    nh_chain *c = r->system->chain;
    for (size_t i = 0; c && i < c->joints; i++)
        if (!coordinates_of(r, &c->joint[i])) return false;
    return true;
}
