/* urdf: links and joints of a robot description as the bodies and joints of a system file.  See urdf.h. */
#include "system/urdf.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/parse.h"
#include "system/urdf_internal.h"

typedef enum { FIXED, REVOLUTE, CONTINUOUS, PRISMATIC, PLANAR, FLOATING, SPHERICAL, BALL, KINDS } joint_kind;

typedef struct {
    const nh_xml *element;
    joint_kind kind;
    char *name, *parent, *child; /* as in system files */
    const nh_deck_node *axis;    /* its words; NULL: x, the default */
    double direction[3];
    const char *mimics; /* the name that the file gives, or NULL */
    const nh_xml *mimic;
    double factor, offset; /* its coordinate is factor times that of the joint that it follows, plus offset */
    double damping;
    nh_urdf_pose origin;
} joint;

typedef struct {
    nh_urdf_reader u;
    const nh_xml *robot;
    nh_deck_node *root, *bodies, *joints, *parameters, *forces, *rims;
    size_t count, links;
    joint *joint;
    const nh_xml **link;
    /* names of the links in the file; the last one is that of a root that is named only as a parent, or NULL */
    const char **written;
    char **own; /* as in system files */
} reader;

static bool has_coordinate(const joint *j)
{
    return (j->kind == REVOLUTE || j->kind == CONTINUOUS || j->kind == PRISMATIC) && !j->mimics;
}

/* Has the joint several coordinates, with names NAME_x and the like? */
static bool has_many(const joint *j) { return j->kind >= PLANAR; }
/* Would a name, or those of several coordinates that begin with it, be one of the joint's? */
static bool collides(const joint *j, const char *name, bool many)
{
    if (!has_coordinate(j) && !has_many(j)) return false;
    if (many == has_many(j)) return !strcmp(j->name, name);
    return many ? nh_urdf_is_part(j->name, name) : nh_urdf_is_part(name, j->name);
}

/* A name for a parameter, or for the coordinates of joint `own`, that no other coordinate has. */
static char *free_name(reader *r, char *name, size_t own)
{
    bool many = own < r->count && has_many(&r->joint[own]);
    nh_arena *arena = r->u.deck->arena;
    if (!many && (nh_is_reserved(name) || !strcmp(name, "g")))
        return free_name(r, nh_arena_printf(arena, "%s_joint", name), own);
    for (size_t i = 0; i < r->count; i++)
        if (i != own && collides(&r->joint[i], name, many))
            return free_name(r, nh_arena_printf(arena, "%s_", name), own);
    return name;
}

/* ---- links ---- */

/* A parameter with the value of an attribute. */
static void parameter(reader *r, const char *name, const nh_xml_attribute *value, const char *unit, const char *doc)
{
    nh_deck *deck = r->u.deck;
    nh_deck_node *p = nh_deck_new(deck, NH_DECK_MAP, value->begin, value->end);
    const char *text = value->value + strspn(value->value, " \t\n\r+");
    nh_deck_put(deck, p, "name", nh_deck_word(deck, name, value->begin, value->end));
    const char *word = nh_arena_strndup(deck->arena, text, strcspn(text, " \t\n\r"));
    nh_deck_put(deck, p, "value", nh_deck_word(deck, word, value->begin, value->end));
    if (unit) nh_deck_put(deck, p, "unit", nh_deck_word(deck, unit, value->begin, value->end));
    nh_deck_put(deck, p, "doc", nh_deck_word(deck, doc, value->begin, value->end));
    nh_deck_append(deck, r->parameters, p);
}

static bool read_link(reader *r, size_t index)
{
    nh_deck *deck = r->u.deck;
    const nh_xml *link = r->link[index];
    const char *ignored = "visual collision contact sensor self_collision_checking collision_checking material verbose";
    if (!nh_urdf_only(&r->u, link, "name type", "inertial", ignored)) return false;
    const nh_xml_attribute *name = nh_xml_get(link, "name");
    const nh_xml *inertial = nh_xml_child(link, "inertial", NULL);
    const nh_xml *second = inertial ? nh_xml_child(link, "inertial", inertial) : NULL;
    if (second) return nh_urdf_fail(&r->u, second->begin, "the link `%s` has a second <inertial>", name->value);
    nh_deck_node *body = nh_deck_new(deck, NH_DECK_MAP, link->begin, link->end);
    char *own = r->own[index];
    double mass = 0;
    nh_deck_put(deck, body, "name", nh_deck_word(deck, own, name->begin, name->end));
    if (inertial && !nh_urdf_inertial(&r->u, inertial, body, &mass)) return false;
    if (mass > 0) {
        const nh_xml_attribute *value = nh_xml_get(nh_xml_child(inertial, "mass", NULL), "value");
        const char *word = free_name(r, nh_arena_printf(deck->arena, "mass_%s", own), r->count);
        parameter(r, word, value, "kg", nh_arena_printf(deck->arena, "mass of %s", name->value));
        nh_deck_put(deck, body, "mass", nh_deck_word(deck, word, value->begin, value->end));
    }
    nh_deck_append(deck, r->bodies, body);
    return true;
}

/* ---- joints ---- */

static bool kind_of(reader *r, const nh_xml *element, joint_kind *out)
{
    static const char *const names[KINDS] = {"fixed",  "revolute", "continuous", "prismatic",
                                             "planar", "floating", "spherical",  "ball"};
    const nh_xml_attribute *type = nh_urdf_need(&r->u, element, "type");
    for (int k = 0; type && k < KINDS; k++)
        if (!strcmp(type->value, names[k])) return *out = (joint_kind)k, true;
    if (!type) return false;
    nh_urdf_fail(&r->u, type->begin,
                 "`%s` is not a type of joint; expected fixed, revolute, continuous, prismatic, planar or floating",
                 type->value);
    const char *near = nh_text_nearest(type->value, names, KINDS);
    return near ? nh_error_hint(r->u.error, "did you mean `%s`?", near) : false;
}

/* The link that <parent> or <child> names. */
static bool link_of(reader *r, const nh_xml *element, const char *key, char **out)
{
    const nh_xml *end = nh_xml_child(element, key, NULL);
    if (!end) {
        nh_urdf_fail(&r->u, element->begin, "this joint has no <%s>", key);
        return nh_error_hint(r->u.error, "write <%s link=\"..\"/>", key);
    }
    const nh_xml_attribute *a = nh_urdf_only(&r->u, end, "link", "", "") ? nh_urdf_need(&r->u, end, "link") : NULL;
    if (!a) return false;
    for (size_t i = 0; i <= r->links; i++)
        if (r->written[i] && !strcmp(r->written[i], a->value)) return *out = r->own[i], true;
    nh_urdf_fail(&r->u, a->begin, "there is no link `%s`", a->value);
    const char *near = nh_text_nearest(a->value, r->written, r->links);
    return near ? nh_error_hint(r->u.error, "did you mean `%s`?", near)
                : nh_error_hint(r->u.error, "every link is an element <link name=\"..\">");
}

static bool axis_of(reader *r, joint *j)
{
    const nh_xml *axis = nh_xml_child(j->element, "axis", NULL);
    j->direction[0] = 1;
    if (!axis || j->kind == FIXED || j->kind > PLANAR) return true;
    const nh_xml_attribute *xyz = nh_urdf_only(&r->u, axis, "xyz", "", "") ? nh_urdf_need(&r->u, axis, "xyz") : NULL;
    if (!xyz) return false;
    nh_deck_node *words = nh_deck_new(r->u.deck, NH_DECK_LIST, xyz->begin, xyz->end);
    j->axis = words;
    if (!nh_urdf_numbers(&r->u, xyz, 3, j->direction, words)) return false;
    bool zero = j->direction[0] == 0 && j->direction[1] == 0 && j->direction[2] == 0;
    return !zero || nh_urdf_fail(&r->u, xyz->begin, "an axis cannot be zero");
}

static const char *written_name(const joint *j) { return nh_xml_get(j->element, "name")->value; }

/* <dynamics>, <mimic>. */
static bool manners_of(reader *r, joint *j)
{
    const nh_xml *dynamics = nh_xml_child(j->element, "dynamics", NULL),
                 *mimic = nh_xml_child(j->element, "mimic", NULL);
    double friction;
    if (dynamics) {
        if (!nh_urdf_only(&r->u, dynamics, "damping friction", "", "") ||
            !nh_urdf_number(&r->u, dynamics, "damping", 0, &j->damping) ||
            !nh_urdf_number(&r->u, dynamics, "friction", 0, &friction))
            return false;
        if (friction != 0)
            nh_urdf_note(&r->u, dynamics->begin, "dry friction is left out of the joints", "%s", written_name(j));
        if (j->damping != 0 && has_many(j))
            nh_urdf_note(&r->u, dynamics->begin, "damping is left out of the joints", "%s", written_name(j));
    }
    if (mimic && (j->kind == FIXED || has_many(j)))
        nh_urdf_note(&r->u, mimic->begin, nh_urdf_passed_over, "<mimic> of a %s joint",
                     nh_xml_get(j->element, "type")->value);
    if (!mimic || j->kind == FIXED || has_many(j)) return true;
    const nh_xml_attribute *name =
        nh_urdf_only(&r->u, mimic, "joint multiplier offset", "", "") ? nh_urdf_need(&r->u, mimic, "joint") : NULL;
    j->mimic = mimic;
    j->mimics = name ? name->value : NULL;
    return name && nh_urdf_number(&r->u, mimic, "multiplier", 1, &j->factor) &&
           nh_urdf_number(&r->u, mimic, "offset", 0, &j->offset);
}

static bool read_joint(reader *r, const nh_xml *element, joint *j)
{
    const char *known = "origin parent child axis dynamics mimic",
               *ignored = "calibration limit safety_controller hardwareInterface gear";
    *j = (joint){.element = element, .factor = 1, .name = j->name};
    if (!nh_urdf_only(&r->u, element, "name type", known, ignored) || !kind_of(r, element, &j->kind)) return false;
    return link_of(r, element, "parent", &j->parent) && link_of(r, element, "child", &j->child) && axis_of(r, j) &&
           manners_of(r, j) && nh_urdf_origin(&r->u, element, NULL, NULL, &j->origin);
}

/* ---- joints that follow others ---- */

static joint *named(reader *r, const char *name)
{
    for (size_t i = 0; i < r->count; i++)
        if (!strcmp(nh_xml_get(r->joint[i].element, "name")->value, name)) return &r->joint[i];
    return NULL;
}

/* The joint at the end of <mimic>s and j = factor * end + offset. */
static bool follow(reader *r, const joint *j, joint **end, double *factor, double *offset)
{
    const joint *at = j;
    *factor = 1, *offset = 0;
    for (size_t steps = 0; at->mimics; steps++) {
        const nh_xml_attribute *word = nh_xml_get(at->mimic, "joint");
        *offset += *factor * at->offset;
        *factor *= at->factor;
        joint *next = named(r, at->mimics);
        if (next && next->kind == FIXED) { /* it stays at 0 */
            *end = NULL;
            return true;
        }
        if (!next || has_many(next)) {
            const char **names = nh_arena_alloc(r->u.deck->arena, (r->count + 1) * sizeof *names);
            size_t n = 0;
            for (size_t i = 0; i < r->count; i++)
                if (has_coordinate(&r->joint[i])) names[n++] = nh_xml_get(r->joint[i].element, "name")->value;
            nh_urdf_fail(&r->u, word->begin,
                         next ? "the joint `%s` has not one degree of freedom" : "there is no joint `%s`", at->mimics);
            const char *near = nh_text_nearest(at->mimics, names, n);
            return near ? nh_error_hint(r->u.error, "did you mean `%s`?", near)
                        : nh_error_hint(r->u.error, "a joint follows another revolute, continuous or prismatic one");
        }
        if (steps > r->count)
            return nh_urdf_fail(&r->u, word->begin,
                                "the joints follow each other in a circle: none has a value of its own"),
                   nh_error_hint(r->u.error, "remove <mimic> from one of them");
        at = next;
    }
    *end = (joint *)at;
    return true;
}

/* values: [factor*name + offset] */
static bool put_value(reader *r, const joint *j, nh_deck_node *out)
{
    joint *end;
    double factor, offset;
    char a[32], b[32];
    if (!follow(r, j, &end, &factor, &offset)) return false;
    nh_text_number(factor, a, sizeof a);
    nh_text_number(offset, b, sizeof b);
    const char *text = !end          ? b
                       : offset == 0 ? nh_arena_printf(r->u.deck->arena, "(%s)*%s", a, end->name)
                                     : nh_arena_printf(r->u.deck->arena, "(%s)*%s + (%s)", a, end->name, b);
    nh_deck_node *list = nh_deck_new(r->u.deck, NH_DECK_LIST, j->mimic->begin, j->mimic->end);
    nh_deck_append(r->u.deck, list, nh_deck_word(r->u.deck, text, j->mimic->begin, j->mimic->end));
    nh_deck_put(r->u.deck, out, "values", list);
    return true;
}

/* The damping of a joint that follows another is a force on that one: rates are in the ratio `factor`, powers are
   equal. */
static bool put_damping(reader *r, const joint *j)
{
    nh_deck *deck = r->u.deck;
    const nh_xml *dynamics = nh_xml_child(j->element, "dynamics", NULL);
    joint *end;
    double factor, offset;
    char square[32];
    if (j->damping == 0 || j->kind == FIXED || has_many(j)) return true;
    if (!follow(r, j, &end, &factor, &offset)) return false;
    if (!end) return true;
    const nh_xml_attribute *a = nh_xml_get(dynamics, "damping");
    const char *word = free_name(r, nh_arena_printf(deck->arena, "damping_%s", j->name), r->count);
    parameter(r, word, a, NULL, nh_arena_printf(deck->arena, "damping of %s", written_name(j)));
    nh_text_number(factor * factor, square, sizeof square);
    const char *ratio = factor * factor == 1 ? "" : nh_arena_printf(deck->arena, "%s*", square);
    nh_deck_append(deck, r->forces,
                   nh_deck_word(deck, nh_arena_printf(deck->arena, "%s = -%s%s*%s'", end->name, ratio, word, end->name),
                                a->begin, a->end));
    return true;
}

/* ---- joints as entries ---- */

/* "left-hip, revolute, from -1.57 to 1.57, effort 10": the name where it is another one in the system; limits are
 * notes, not constraints. */
static const char *doc_of(reader *r, const joint *j)
{
    static const char *const keys[] = {"lower", "upper", "effort", "velocity"}, *const words[] = {", from ", " to ",
                                                                                                  ", effort ",
                                                                                                  ", velocity "};
    const nh_xml *limit = nh_xml_child(j->element, "limit", NULL);
    nh_text text;
    nh_text_init(&text);
    if (strcmp(j->name, written_name(j))) nh_text_addf(&text, "%s, ", written_name(j));
    nh_text_add(&text, nh_xml_get(j->element, "type")->value);
    for (int i = 0; i < 4; i++) {
        const nh_xml_attribute *a = nh_xml_get(limit, keys[i]);
        bool half = i == 1 && !nh_xml_get(limit, "lower");
        if (a && (i > 1 || j->kind != CONTINUOUS))
            nh_text_addf(&text, "%s%s", half ? ", from 0 to " : words[i], a->value);
    }
    const char *out = nh_arena_strdup(r->u.deck->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

static nh_deck_node *word_for(reader *r, const joint *j, const char *text)
{
    return nh_deck_word(r->u.deck, text, j->element->begin, j->element->end);
}

static nh_deck_node *vector(reader *r, const joint *j, const double v[3])
{
    nh_deck_node *list = nh_deck_new(r->u.deck, NH_DECK_LIST, j->element->begin, j->element->end);
    for (int i = 0; i < 3; i++) {
        char text[32];
        nh_text_number(v[i], text, sizeof text);
        nh_deck_append(r->u.deck, list, word_for(r, j, text));
    }
    return list;
}

/* A plane whose normal is no axis: two translations, of a body without mass, and a turn. */
static void split_plane(reader *r, const joint *j, nh_deck_node *turn)
{
    nh_deck *deck = r->u.deck;
    const double *a = j->direction;
    int least = fabs(a[0]) <= fabs(a[1]) && fabs(a[0]) <= fabs(a[2]) ? 0 : fabs(a[1]) <= fabs(a[2]) ? 1 : 2;
    double e[3] = {least == 0, least == 1, least == 2};
    double b[3] = {e[1] * a[2] - e[2] * a[1], e[2] * a[0] - e[0] * a[2], e[0] * a[1] - e[1] * a[0]};
    double c[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    char *slide = nh_arena_printf(deck->arena, "%s_slide", j->name);
    static const char *const ends[] = {"x", "y", "a"};
    nh_deck_node *body = nh_deck_new(deck, NH_DECK_MAP, j->element->begin, j->element->end),
                 *axes = nh_deck_new(deck, NH_DECK_LIST, j->element->begin, j->element->end);
    nh_deck_node *moves = nh_deck_new(deck, NH_DECK_MAP, j->element->begin, j->element->end), *list[2];
    for (int i = 0; i < 3; i++) {
        if (i != 1) list[i / 2] = nh_deck_new(deck, NH_DECK_LIST, j->element->begin, j->element->end);
        nh_deck_append(deck, list[i / 2], word_for(r, j, nh_arena_printf(deck->arena, "%s_%s", j->name, ends[i])));
    }
    nh_deck_put(deck, body, "name", word_for(r, j, slide));
    nh_deck_append(deck, r->bodies, body);
    nh_deck_append(deck, axes, vector(r, j, b));
    nh_deck_append(deck, axes, vector(r, j, c));
    nh_deck_put(deck, moves, "type", word_for(r, j, "translation"));
    nh_deck_put(deck, moves, "parent", word_for(r, j, j->parent));
    nh_deck_put(deck, moves, "child", word_for(r, j, slide));
    nh_deck_put(deck, moves, "axes", axes);
    nh_deck_put(deck, moves, "coordinates", list[0]);
    nh_urdf_pose ignored;
    nh_urdf_origin(&r->u, j->element, moves, "at", &ignored);
    nh_deck_append(deck, r->joints, moves);
    nh_deck_put(deck, turn, "type", word_for(r, j, "revolute"));
    nh_deck_put(deck, turn, "parent", word_for(r, j, slide));
    nh_deck_put(deck, turn, "axis", vector(r, j, a));
    nh_deck_put(deck, turn, "coordinates", list[1]);
}

static bool put_joint(reader *r, const joint *j)
{
    static const char *const types[KINDS] = {"fixed",  "revolute", "revolute",  "prismatic",
                                             "planar", "free",     "spherical", "spherical"},
                             *const letters[] = {"x", "y", "z"};
    nh_deck *deck = r->u.deck;
    nh_deck_node *out = nh_deck_new(deck, NH_DECK_MAP, j->element->begin, j->element->end);
    const double *d = j->direction;
    int along = d[1] == 0 && d[2] == 0 ? 0 : d[0] == 0 && d[2] == 0 ? 1 : 2;
    bool plane = j->kind == PLANAR, upright = d[(along + 1) % 3] == 0 && d[(along + 2) % 3] == 0 && d[along] > 0;
    nh_urdf_pose ignored;
    nh_deck_put(
        deck, out, "name",
        nh_deck_word(deck, j->name, nh_xml_get(j->element, "name")->begin, nh_xml_get(j->element, "name")->end));
    nh_deck_put(deck, out, "child", word_for(r, j, j->child));
    if (plane && !upright) {
        split_plane(r, j, out);
    } else {
        nh_deck_put(deck, out, "type", word_for(r, j, types[j->kind]));
        nh_deck_put(deck, out, "parent", word_for(r, j, j->parent));
        nh_urdf_origin(&r->u, j->element, out, "at", &ignored);
        if (plane) nh_deck_put(deck, out, "axis", word_for(r, j, letters[along]));
        else if (j->kind != FIXED && !has_many(j))
            nh_deck_put(deck, out, "axis", j->axis ? j->axis : word_for(r, j, "x"));
    }
    if (j->mimics && !put_value(r, j, out)) return false;
    if (j->kind != FIXED) nh_deck_put(deck, out, "doc", word_for(r, j, doc_of(r, j)));
    nh_deck_append(deck, r->joints, out);
    return put_damping(r, j);
}

/* ---- poses at zero displacements, for circles ---- */

static const joint *carrier(const reader *r, const char *body)
{
    size_t i = 0;
    while (i < r->count && strcmp(r->joint[i].child, body)) i++;
    return i < r->count ? &r->joint[i] : NULL;
}

static bool put_rims(reader *r)
{
    for (size_t i = 0; i < r->links; i++) {
        nh_urdf_pose zero = {.R = {1, 0, 0, 0, 1, 0, 0, 0, 1}};
        const char *own = r->own[i];
        const joint *mine = carrier(r, own), *at = mine;
        for (size_t steps = 0; at && steps <= r->count; steps++, at = carrier(r, at->parent))
            zero = nh_urdf_product(&at->origin, &zero);
        bool turns = mine && (mine->kind == REVOLUTE || mine->kind == CONTINUOUS);
        nh_deck_node *rim =
            nh_urdf_rim(&r->u, r->link[i], turns ? mine->direction : NULL, &zero, mine && mine->kind == CONTINUOUS);
        if (!rim) return false;
        nh_deck_put(r->u.deck, r->rims, own, rim);
    }
    return true;
}

/* ---- all of it ---- */

/* The body of the root that has no element. */
static void put_root(reader *r)
{
    const nh_xml *at = nh_xml_child(r->robot, "joint", NULL);
    while (strcmp(nh_urdf_end(at, "parent"), r->written[r->links])) at = nh_xml_child(r->robot, "joint", at);
    nh_deck_node *body = nh_deck_new(r->u.deck, NH_DECK_MAP, at->begin, at->end);
    nh_deck_put(r->u.deck, body, "name", nh_deck_word(r->u.deck, r->own[r->links], at->begin, at->end));
    nh_deck_append(r->u.deck, r->bodies, body);
    nh_urdf_note(&r->u, nh_xml_child(at, "parent", NULL)->begin,
                 "a frame without mass stands for the link that is missing", "%s", r->written[r->links]);
}

static bool collect(reader *r)
{
    nh_arena *arena = r->u.deck->arena;
    for (const nh_xml *e = r->robot->first; e; e = e->next)
        r->links += !strcmp(e->name, "link"), r->count += !strcmp(e->name, "joint");
    r->link = nh_arena_alloc(arena, (r->links + 1) * sizeof *r->link);
    r->joint = nh_arena_alloc(arena, (r->count + 1) * sizeof *r->joint);
    r->written = nh_arena_alloc(arena, (r->links + 1) * sizeof *r->written);
    r->own = nh_arena_alloc(arena, (r->links + 1) * sizeof *r->own);
    const char **words = nh_arena_alloc(arena, (r->count + 1) * sizeof *words);
    char **names = nh_arena_alloc(arena, (r->count + 1) * sizeof *names);
    size_t n = 0, m = 0;
    for (const nh_xml *e = r->robot->first; e; e = e->next) {
        bool link = !strcmp(e->name, "link");
        if (!link && strcmp(e->name, "joint")) continue;
        const nh_xml_attribute *name = nh_urdf_need(&r->u, e, "name");
        if (!name) return false;
        if (link) r->link[n] = e, r->written[n++] = name->value;
        else r->joint[m].element = e, words[m++] = name->value;
    }
    r->written[n] = nh_urdf_implicit_root(r->robot, r->links, r->written);
    nh_urdf_names(arena, n + (r->written[n] != NULL), r->written, r->own);
    nh_urdf_names(arena, m, words, names);
    for (size_t i = 0; i < m; i++) r->joint[i].name = names[i];
    return true;
}

static bool read_robot(reader *r)
{
    const char *ignored = "material transmission sensor ros2_control plugin mujoco";
    if (!nh_urdf_is_robot(&r->u, r->robot) || !nh_urdf_only(&r->u, r->robot, "name version", "link joint", ignored) ||
        !collect(r))
        return false;
    if (!nh_urdf_fits(&r->u, r->robot, r->links, r->count)) return false;
    for (size_t i = 0; i < r->count; i++)
        if (!read_joint(r, r->joint[i].element, &r->joint[i])) return false;
    if (!nh_urdf_distinct_joints(&r->u, r->robot)) return false;
    for (size_t i = 0; i < r->count; i++)
        if (has_coordinate(&r->joint[i]) || has_many(&r->joint[i]))
            r->joint[i].name = free_name(r, r->joint[i].name, i);
    for (size_t i = 0; i < r->links; i++)
        if (!read_link(r, i)) return false;
    if (r->written[r->links]) put_root(r);
    for (size_t i = 0; i < r->count; i++)
        if (!put_joint(r, &r->joint[i])) return false;
    return put_rims(r);
}

const nh_deck_node *nh_urdf_read(nh_deck *deck, nh_error *error)
{
    reader r = {.u = {.deck = deck, .error = error}, .robot = nh_xml_read(deck, error)};
    if (!r.robot) return NULL;
    nh_deck_node **const list[] = {&r.bodies, &r.joints, &r.parameters, &r.forces};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        *list[i] = nh_deck_new(deck, NH_DECK_LIST, r.robot->begin, r.robot->end);
    r.rims = nh_deck_new(deck, NH_DECK_MAP, r.robot->begin, r.robot->end);
    r.root = nh_deck_new(deck, NH_DECK_MAP, r.robot->begin, r.robot->end);
    nh_xml_attribute gravity = {.name = "g", .value = "9.81", .begin = r.robot->begin, .end = r.robot->end};
    parameter(&r, "g", &gravity, "m/s^2", "acceleration of gravity");
    if (!read_robot(&r)) return NULL;
    const nh_xml_attribute *name = nh_xml_get(r.robot, "name");
    if (name && name->value[0])
        nh_deck_put(deck, r.root, "name",
                    nh_deck_word(deck, nh_urdf_name(deck->arena, name->value), name->begin, name->end));
    nh_deck_put(deck, r.root, "gravity", nh_deck_word(deck, "g", r.robot->begin, r.robot->end));
    static const char *const keys[] = {"bodies", "joints", "parameters", "forces"};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        if ((*list[i])->count || *list[i] != r.forces) nh_deck_put(deck, r.root, keys[i], *list[i]);
    if (r.u.notes) nh_deck_put(deck, r.root, "notes", nh_urdf_notes_list(&r.u));
    nh_deck_put(deck, r.root, NH_URDF_RIMS, r.rims);
    return r.root;
}
