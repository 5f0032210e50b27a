/* elements: points of bodies; springs, dampers and actuators along joints, between points and at points.
 *
 * All but forces at a point act along a displacement d(t, q): that of a joint, a coordinate, or the distance of two
 * points.  A spring adds -k (d - rest)^2/2 to the Lagrangian, a damper c d'^2/2 to Rayleigh's function R, whose forces
 * are -dR/dq^s' and an actuator with the force u gives the forces u dd/dq^s.  A force F at
 * a point p gives F . dp/dq^s, a torque T on a body with the angular velocity w gives T . dw/dq^s'. */
#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/print.h"
#include "system/bodies_tree.h"

typedef nh_system_reader reader;

/* ---- points ---- */

static const char *const letters[] = {"x", "y", "z"};

/* The entry of `points:` of this name, or NULL. */
static const nh_deck_node *point_named(const reader *r, const char *name)
{
    const nh_deck_node *list = nh_deck_get(r->root, "points");
    for (size_t i = 0; list && list->kind == NH_DECK_LIST && i < list->count; i++) {
        const nh_deck_node *own = nh_deck_get(list->item[i], "name");
        if (own && own->kind == NH_DECK_SCALAR && !strcmp(own->text, name)) return list->item[i];
    }
    return NULL;
}

bool nh_system_is_point(const nh_system_reader *r, const char *name, size_t length)
{
    if (length < 3 || name[length - 2] != '_' || !strchr("xyz", name[length - 1])) return false;
    return point_named(r, nh_arena_strndup(r->system->arena, name, length - 2)) != NULL;
}

/* A place: a body, or the ground, and a position in its frame. */
typedef struct {
    long body;
    nh_ex at[3];
} place;

static bool place_of_point(reader *r, const nh_deck_node *item, place *p)
{
    const nh_deck_node *at = nh_deck_get(item, "at");
    p->body = nh_system_body_word(r, item, "body", NH_NOBODY);
    if (p->body == NH_NOBODY) return false;
    for (int i = 0; i < 3; i++) p->at[i] = nh_int(r->system->dag, 0);
    return !at || nh_system_vector(r, at, "a position", p->at);
}

static void in_ground(reader *r, const place *p, nh_ex out[3])
{
    const nh_chain *c = r->system->chain;
    memcpy(out, p->at, sizeof p->at);
    if (p->body != NH_GROUND) nh_pose_point(r->system->dag, &c->body[p->body].pose, p->at, out);
}

/* "hand_x = l*cos(a)", for readers; of a long expression the name. */
static const char *as_equation(nh_system *system, const char *name, nh_ex value)
{
    enum { longest = 300 };
    char *shown = nh_print_short(system->dag, value, longest);
    const char *text = shown ? nh_arena_printf(system->arena, "%s = %s", name, shown) : name;
    nh_free(shown);
    return text;
}

/* NAME_x, NAME_y and NAME_z become definitions. */
static bool read_point(reader *r, const nh_deck_node *item)
{
    static const char *const keys[] = {"name", "body", "at", "doc"};
    nh_system *system = r->system;
    place p;
    nh_ex position[3];
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a point {name: ..., body: ..., at: [x, y, z]}", r->error) ||
        !nh_deck_only(r->deck, item, keys, 4, r->error))
        return false;
    const nh_deck_node *name = nh_deck_get(item, "name");
    if (!name) {
        nh_deck_fail(r->deck, item, 0, r->error, "this point has no `name`");
        return nh_error_hint(r->error, "of a point named `hand`, the position is hand_x, hand_y, hand_z");
    }
    if (!nh_deck_is(r->deck, name, NH_DECK_SCALAR, "a name", r->error)) return false;
    for (size_t b = 0; b < system->chain->bodies; b++)
        if (!strcmp(system->chain->body[b].name, name->text))
            return nh_deck_fail(r->deck, name, 0, r->error, "`%s` is the name of a body already", name->text);
    if (!place_of_point(r, item, &p)) return false;
    in_ground(r, &p, position);
    for (int i = 0; i < 3; i++) {
        nh_deck_node component = *name;
        component.text = nh_arena_printf(system->arena, "%s_%s", name->text, letters[i]);
        if (!nh_system_new_name(r, &component)) return false;
        const char *text = as_equation(system, component.text, position[i]);
        system->definition[system->definitions] = system->framed_definition[system->definitions] =
            (nh_named){.name = component.text, .text = text, .value = position[i]};
        system->definitions++;
    }
    return true;
}

bool nh_system_read_points(reader *r)
{
    const nh_deck_node *list;
    size_t n;
    if (!r->system->chain) return true;
    if (!nh_system_list_of(r, r->root, "points", &list, &n)) return false;
    for (size_t i = 0; i < n; i++)
        if (!read_point(r, list->item[i])) return false;
    return true;
}

/* An end or a place of a force: the name of a point, a body (its origin) or `ground`; or [body, x, y, z]. */
static bool read_place(reader *r, const nh_deck_node *node, place *p)
{
    nh_dag *d = r->system->dag;
    for (int i = 0; i < 3; i++) p->at[i] = nh_int(d, 0);
    const nh_deck_node *first = node->kind == NH_DECK_LIST && node->count ? node->item[0] : node, *point = NULL;
    if (node->kind == NH_DECK_SCALAR) point = point_named(r, node->text);
    if (point) return place_of_point(r, point, p);
    if (node->kind == NH_DECK_MAP || first->kind != NH_DECK_SCALAR ||
        (node->kind == NH_DECK_LIST && node->count != 4)) {
        nh_deck_fail(r->deck, node, 0, r->error, "a place was expected: a point, a body, or [body, x, y, z]");
        return nh_error_hint(r->error, "for example [%s, 0, 0, 0.1], or [ground, 0, 0, 2]",
                             r->system->chain->body[0].name);
    }
    nh_deck_node key = {.kind = NH_DECK_SCALAR, .text = "place"}, map = {.kind = NH_DECK_MAP, .count = 1};
    const nh_deck_node *keys[] = {&key}, *items[] = {first};
    map.key = keys;
    map.item = items;
    p->body = nh_system_body_word(r, &map, "place", NH_NOBODY);
    if (p->body == NH_NOBODY && !r->error->hint[0])
        nh_error_hint(r->error, "points are declared: points: [{name: %s, body: %s, at: [0, 0, 1]}]", first->text,
                      r->system->chain->body[0].name);
    for (int i = 0; p->body != NH_NOBODY && node->kind == NH_DECK_LIST && i < 3; i++)
        if (!nh_system_constant(r, node->item[1 + i], "a position", &p->at[i])) return false;
    return p->body != NH_NOBODY;
}

/* ---- displacements ---- */

static bool is_below(const nh_chain *c, long body, long ancestor)
{
    while (body != ancestor && body != NH_GROUND) body = c->joint[c->body[body].joint].parent;
    return body == ancestor;
}

/* Where a place is in the frame of a body nearer to the root. */
static void carry(reader *r, const place *p, long ancestor, nh_ex out[3])
{
    nh_dag *d = r->system->dag;
    const nh_chain *c = r->system->chain;
    memcpy(out, p->at, sizeof p->at);
    for (long b = p->body; b != ancestor;) {
        const nh_joint *j = &c->joint[c->body[b].joint];
        for (size_t k = j->screws; k-- > 0;) {
            nh_pose step = nh_screw_pose(d, &c->screw[j->first + k]);
            nh_pose_point(d, &step, out, out);
        }
        nh_pose_point(d, &j->placement, out, out);
        b = j->parent;
    }
}

/* What an element acts along. */
typedef struct {
    const nh_deck_node *node; /* the element */
    bool distance;
    nh_ex d;      /* the displacement of a joint or coordinate */
    nh_ex square; /* of a distance */
} along;

/* The square of the distance of two places, in the frame of the last body that carries both. */
static bool read_distance(reader *r, const nh_deck_node *node, along *a)
{
    nh_dag *d = r->system->dag;
    place end[2];
    nh_ex from[3], to[3];
    if (!nh_deck_is(r->deck, node, NH_DECK_LIST, "between", r->error)) return false;
    if (node->count != 2) {
        nh_deck_fail(r->deck, node, 0, r->error, "`between` has two places, not %zu", node->count);
        return nh_error_hint(r->error, "for example between: [[%s, 0, 0, 0.1], ground]",
                             r->system->chain->body[0].name);
    }
    if (!read_place(r, node->item[0], &end[0]) || !read_place(r, node->item[1], &end[1])) return false;
    if (end[0].body == end[1].body)
        return nh_deck_fail(r->deck, node, 0, r->error,
                            "both places are fixed to the same body: their distance is constant");
    long common = end[0].body;
    while (!is_below(r->system->chain, end[1].body, common))
        common = r->system->chain->joint[r->system->chain->body[common].joint].parent;
    carry(r, &end[0], common, from);
    carry(r, &end[1], common, to);
    for (int i = 0; i < 3; i++) to[i] = nh_tidy(d, nh_sub(d, to[i], from[i]));
    a->square = nh_tidy(d, nh_dot(d, to, to));
    return a->distance = true;
}

static bool read_joint_word(reader *r, const nh_deck_node *node, along *a)
{
    const nh_chain *c = r->system->chain;
    const char **names = nh_system_take(r, c->joints, sizeof *names);
    for (size_t i = 0; i < c->joints; i++) names[i] = c->joint[i].name;
    long found = nh_system_word(r, node, "a joint", c->joints, names);
    if (found < 0) return false;
    const nh_joint *j = &c->joint[found];
    a->d = j->screws == 1 ? c->screw[j->first].s : 0;
    if (j->screws == 1) return true;
    nh_deck_fail(r->deck, node, 0, r->error, "the joint `%s` has %zu degrees of freedom, not one", j->name, j->screws);
    if (j->screws == 0 || c->screw[j->first].coordinate < 0) return false;
    return nh_error_hint(r->error, "name the coordinate instead: coordinate: %s",
                         r->system->coordinate[c->screw[j->first].coordinate].name);
}

/* One of `joint`, `coordinate` and `between`. */
static bool read_along(reader *r, const nh_deck_node *item, const char *what, along *a)
{
    static const char *const ways[] = {"joint", "coordinate", "between"};
    const nh_deck_node *given[3], *one = NULL;
    *a = (along){.node = item};
    for (int i = 0; i < 3; i++) {
        given[i] = nh_deck_get(item, ways[i]);
        if (one && given[i])
            return nh_deck_fail(r->deck, given[i], 0, r->error, "a %s has one of `joint`, `coordinate` and `between`",
                                what);
        if (given[i]) one = given[i];
    }
    if (!one) {
        nh_deck_fail(r->deck, item, 0, r->error, "this %s has none of `joint`, `coordinate` and `between`", what);
        return nh_error_hint(r->error, "write joint: %s, or between: [[%s, 0, 0, 0.1], ground]",
                             r->system->chain->joint[0].name, r->system->chain->body[0].name);
    }
    if (given[0]) return read_joint_word(r, one, a);
    if (given[2]) return read_distance(r, one, a);
    if (!nh_deck_is(r->deck, one, NH_DECK_SCALAR, "coordinate", r->error)) return false;
    long q = nh_system_coordinate(r->system, one->text);
    if (q < 0) {
        nh_deck_fail(r->deck, one, 0, r->error, "`%s` is not a coordinate", one->text);
        return nh_system_hint_coordinates(r->system, one->text, r->error);
    }
    a->d = r->system->coordinate[q].q;
    return true;
}

static nh_ex displacement(reader *r, const along *a) { return a->distance ? nh_sqrt(r->system->dag, a->square) : a->d; }

/* Are two places at one point where all coordinates and t are 0, where people start? */
static bool coincide_at_zero(reader *r, const along *a)
{
    static const double none = 1e-24; /* the square of a length by rounding */
    nh_system *system = r->system;
    nh_ex *from = nh_system_take(r, 2 * (system->coordinates + 1), sizeof *from), *to = from + system->coordinates + 1;
    if (!a->distance) return false;
    from[system->coordinates] = system->t;
    for (size_t i = 0; i < system->coordinates; i++) from[i] = system->coordinate[i].q;
    for (size_t i = 0; i <= system->coordinates; i++) to[i] = nh_int(system->dag, 0);
    return fabs(nh_system_number(system, nh_substitute(system->dag, a->square, system->coordinates + 1, from, to))) <
           none;
}

/* An element between two points acts along their line, which has no direction where they coincide. */
static void note_if_singular(reader *r, const along *a, const char *what, const char *cure)
{
    if (!coincide_at_zero(r, a)) return;
    const nh_deck_node *n = a->node;
    r->note[r->notes++] =
        nh_arena_printf(r->system->arena,
                        "%s:%zu: where all coordinates are 0, the two places of this %s coincide: its "
                        "force has no direction there%s",
                        nh_deck_name(n->deck), n->line, what, cure);
}

/* ---- elements ---- */

/* An expression in parameters and t. */
static bool read_quantity(reader *r, const nh_deck_node *item, const char *key, const char *what, const char *example,
                          nh_ex *out)
{
    const nh_deck_node *node = nh_deck_get(item, key);
    if (node) return nh_system_function_of_time(r, node, what, out);
    nh_deck_fail(r->deck, item, 0, r->error, "this entry has no `%s`", key);
    return nh_error_hint(r->error, "for example %s: %s", key, example);
}

/* A key that belongs elsewhere; `with`: where this key stands beside it, NULL: where `between` does not. */
static bool no_other_word(reader *r, const nh_deck_node *item, const char *key, const char *with, const char *cure)
{
    const nh_deck_node *node = nh_deck_get(item, key);
    if (!node || (with ? !nh_deck_get(item, with) : nh_deck_get(item, "between") != NULL)) return true;
    nh_deck_fail(r->deck, node, 0, r->error, "`%s` has no meaning here", key);
    return nh_error_hint(r->error, "%s", cure);
}

/* k (d - rest)^2/2; with the rest length 0 between points this is a polynomial of their positions. */
static bool read_spring(reader *r, const nh_deck_node *item)
{
    static const char *const of_joint[] = {"joint", "coordinate", "stiffness", "rest", "name", "doc"},
                             *const of_points[] = {"between", "stiffness", "length", "name", "doc"};
    nh_system *system = r->system;
    nh_dag *d = system->dag;
    along a;
    nh_ex k, rest = nh_int(d, 0), square;
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a spring {joint: ..., stiffness: ...}", r->error)) return false;
    if (!no_other_word(r, item, "rest", "between", "the length at rest of a spring between places is its `length`") ||
        !no_other_word(r, item, "length", NULL, "the place of rest of a spring along a joint is its `rest`") ||
        !no_other_word(r, item, "damping", "damping",
                       "a damper is an entry of its own: dampers: [{joint: .., damping: ..}]"))
        return false;
    if (nh_deck_get(item, "between") ? !nh_deck_only(r->deck, item, of_points, 5, r->error)
                                     : !nh_deck_only(r->deck, item, of_joint, 6, r->error))
        return false;
    if (!read_along(r, item, "spring", &a) || !read_quantity(r, item, "stiffness", "a stiffness", "100", &k))
        return false;
    const nh_deck_node *at = nh_deck_get(item, a.distance ? "length" : "rest");
    if (at && !nh_system_function_of_time(r, at, a.distance ? "a length" : "the place of rest", &rest)) return false;
    if (a.distance && nh_is_zero(d, rest)) square = a.square;
    else square = nh_powi(d, nh_sub(d, displacement(r, &a), rest), 2);
    if (a.distance && !nh_is_zero(d, rest)) note_if_singular(r, &a, "spring", "; with length: 0 it vanishes there");
    nh_ex energy = nh_mul(d, nh_ratio(d, 1, 2), nh_mul(d, k, square));
    system->lagrangian = system->framed_of = nh_sub(d, system->lagrangian, energy);
    if (system->orientations) system->framed = nh_sub(d, system->framed, energy);
    return true;
}

static nh_ex rate(const nh_system *system, nh_ex e)
{
    nh_ex sum = nh_diff(system->dag, e, system->t);
    for (size_t i = 0; i < system->coordinates; i++)
        sum = nh_add(system->dag, sum,
                     nh_mul(system->dag, nh_diff(system->dag, e, system->coordinate[i].q), system->coordinate[i].v));
    return sum;
}

static bool read_damper(reader *r, const nh_deck_node *item)
{
    static const char *const keys[] = {"joint", "coordinate", "between", "damping", "name", "doc"};
    nh_dag *d = r->system->dag;
    along a;
    nh_ex c;
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a damper {joint: ..., damping: ...}", r->error) ||
        !nh_deck_only(r->deck, item, keys, 6, r->error) || !read_along(r, item, "damper", &a) ||
        !read_quantity(r, item, "damping", "a damping", "0.5", &c))
        return false;
    note_if_singular(r, &a, "damper", "");
    nh_ex square = a.distance ? nh_div(d, nh_powi(d, rate(r->system, a.square), 2), nh_mul(d, nh_int(d, 4), a.square))
                              : nh_powi(d, rate(r->system, a.d), 2);
    r->dissipation = nh_add(d, r->dissipation, nh_mul(d, nh_ratio(d, 1, 2), nh_mul(d, c, square)));
    return true;
}

static bool read_force(reader *r, const nh_deck_node *node, nh_ex *out)
{
    return nh_deck_is(r->deck, node, NH_DECK_SCALAR, "a force", r->error) &&
           nh_system_read_expression(r->system, r->deck, node, 0, NH_NO_QUASI, 0, NULL, NULL, out, r->error);
}

/* Three components along the axes of the ground, or of the body under `in`; in the ground's axes afterwards. */
static bool read_components(reader *r, const nh_deck_node *item, const nh_deck_node *node, nh_ex out[3])
{
    long body = nh_system_body_word(r, item, "in", NH_GROUND);
    if (body == NH_NOBODY) return false;
    if (node->kind != NH_DECK_LIST || node->count != 3) {
        nh_deck_fail(r->deck, node, 0, r->error, "three components were expected here");
        return nh_error_hint(r->error,
                             "for example [0, 0, %s], along x, y and z of the ground, or of the body under `in`",
                             node->kind == NH_DECK_SCALAR ? node->text : "u");
    }
    for (int i = 0; i < 3; i++)
        if (!read_force(r, node->item[i], &out[i])) return false;
    if (body != NH_GROUND) nh_rotate(r->system->dag, r->system->chain->body[body].pose.R, false, out, out);
    return true;
}

static void push(reader *r, size_t i, nh_ex force)
{
    nh_system *system = r->system;
    if (nh_is_zero(system->dag, force)) return;
    system->force[i] = nh_add(system->dag, system->force[i], force);
    system->has_forces = true;
}

/* {point: hand, force: [a, b, c]} */
static bool read_point_force(reader *r, const nh_deck_node *item)
{
    nh_system *system = r->system;
    const nh_deck_node *force = nh_deck_get(item, "force");
    place p;
    nh_ex F[3], position[3], slope[3];
    if (!read_place(r, nh_deck_get(item, "point"), &p) || !read_components(r, item, force, F)) return false;
    in_ground(r, &p, position);
    for (size_t i = 0; i < system->coordinates; i++) {
        for (int k = 0; k < 3; k++) slope[k] = nh_diff(system->dag, position[k], system->coordinate[i].q);
        push(r, i, nh_dot(system->dag, F, slope));
    }
    return true;
}

/* {body: hull, torque: [a, b, c]} */
static bool read_torque(reader *r, const nh_deck_node *item)
{
    nh_system *system = r->system;
    const nh_deck_node *torque = nh_deck_get(item, "torque");
    nh_pose pose;
    nh_twist twist;
    nh_ex T[3], slope[3];
    long body = nh_system_body_word(r, item, "body", NH_NOBODY);
    if (body == NH_NOBODY) return false;
    if (body == NH_GROUND)
        return nh_deck_fail(r->deck, nh_deck_get(item, "body"), 0, r->error, "no torque turns the ground");
    if (!torque) {
        nh_deck_fail(r->deck, item, 0, r->error, "this entry has no `torque`");
        return nh_error_hint(r->error, "for example torque: [0, 0, u]");
    }
    if (!read_components(r, item, torque, T)) return false;
    nh_chain_frame(system->chain, system->dag, body, 0, &pose, &twist);
    nh_rotate(system->dag, system->chain->body[body].pose.R, true, T, T);
    for (size_t i = 0; i < system->coordinates; i++) {
        for (int k = 0; k < 3; k++) slope[k] = nh_diff(system->dag, twist.w[k], system->coordinate[i].v);
        push(r, i, nh_dot(system->dag, T, slope));
    }
    return true;
}

static bool read_actuator(reader *r, const nh_deck_node *item)
{
    static const char *const of_joint[] = {"joint", "coordinate", "between", "force", "name", "doc"},
                             *const of_point[] = {"point", "force", "in", "name", "doc"},
                             *const of_body[] = {"body", "torque", "in", "name", "doc"};
    nh_system *system = r->system;
    along a;
    nh_ex u, d;
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "an actuator {joint: ..., force: ...}", r->error)) return false;
    if (nh_deck_get(item, "body")) return nh_deck_only(r->deck, item, of_body, 5, r->error) && read_torque(r, item);
    bool point = nh_deck_get(item, "point") != NULL;
    if (point ? !nh_deck_only(r->deck, item, of_point, 5, r->error)
              : !nh_deck_only(r->deck, item, of_joint, 6, r->error))
        return false;
    const nh_deck_node *force = nh_deck_get(item, "force");
    if (!force) {
        nh_deck_fail(r->deck, item, 0, r->error, "this actuator has no `force`");
        return nh_error_hint(r->error, point ? "for example force: [0, 0, u]" : "for example force: u");
    }
    if (point) return read_point_force(r, item);
    if (!read_along(r, item, "actuator", &a) || !read_force(r, force, &u)) return false;
    note_if_singular(r, &a, "actuator", "");
    d = displacement(r, &a);
    bool moves = false;
    for (size_t i = 0; i < system->coordinates; i++)
        moves |= !nh_is_zero(system->dag, nh_diff(system->dag, d, system->coordinate[i].q));
    if (!moves)
        return nh_deck_fail(r->deck, item, 0, r->error, "no coordinate moves this joint: a force cannot act on it");
    for (size_t i = 0; i < system->coordinates; i++)
        push(r, i, nh_mul(system->dag, u, nh_diff(system->dag, d, system->coordinate[i].q)));
    return true;
}

/* Rayleigh's function of the file. */
static bool read_dissipation(reader *r)
{
    const nh_deck_node *node = nh_deck_get(r->root, "dissipation");
    nh_system *system = r->system;
    bool moves = false;
    if (!node) return true;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "the dissipation", r->error) ||
        !nh_system_read_expression(system, r->deck, node, 0, NH_NO_QUASI, 0, NULL, NULL, &r->dissipation, r->error))
        return false;
    for (size_t i = 0; i < system->coordinates; i++)
        moves |= nh_depends(system->dag, r->dissipation, system->coordinate[i].v);
    if (moves || nh_is_zero(system->dag, r->dissipation)) return true;
    nh_deck_fail(r->deck, node, 0, r->error, "this dissipation contains no velocity: it gives no force");
    return nh_error_hint(r->error, "for example dissipation: c/2*%s'^2, with the force -c*%s'",
                         system->coordinate[0].name, system->coordinate[0].name);
}

bool nh_system_read_elements(reader *r)
{
    static const char *const keys[] = {"springs", "dampers", "actuators"};
    static bool (*const read[])(reader *, const nh_deck_node *) = {read_spring, read_damper, read_actuator};
    nh_system *system = r->system;
    const nh_deck_node *list[3];
    size_t count[3];
    r->dissipation = nh_int(system->dag, 0);
    for (int k = 0; k < 3; k++)
        if (!nh_system_list_of(r, r->root, keys[k], &list[k], &count[k])) return false;
    r->note = nh_system_take(r, count[0] + count[1] + count[2], sizeof *r->note);
    if (!read_dissipation(r)) return false;
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < count[k]; i++)
            if (!read[k](r, list[k]->item[i])) return false;
    for (size_t i = 0; i < system->coordinates; i++)
        push(r, i, nh_neg(system->dag, nh_diff(system->dag, r->dissipation, system->coordinate[i].v)));
    return true;
}
