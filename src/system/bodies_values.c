/* bodies_values: the numbers and expressions of `bodies:`, `joints:`, `wheels:` and `gravity:`. */
#include <string.h>

#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "system/bodies_tree.h"

typedef nh_system_reader reader;

static const char *const axis_names[] = {"x", "y", "z", "-x", "-y", "-z"};

/* ---- expressions ---- */

/* The first of t (unless it may occur), the coordinates and the velocities that e contains, or false. */
static bool moving(const nh_system *system, nh_ex e, bool time, nh_ex *out)
{
    *out = system->t;
    if (!time && nh_depends(system->dag, e, system->t)) return true;
    for (size_t i = 0; i < 2 * system->coordinates; i++) {
        const nh_coordinate *c = &system->coordinate[i / 2];
        *out = i % 2 ? c->v : c->q;
        if (nh_depends(system->dag, e, *out)) return true;
    }
    return false;
}

static bool fixed(reader *r, const nh_deck_node *node, const char *what, bool time, nh_ex *out)
{
    const nh_system *system = r->system;
    nh_ex varies;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, what, r->error)) return false;
    if (!nh_system_read_expression(system, r->deck, node, 0, NH_NO_QUASI, 0, NULL, NULL, out, r->error)) return false;
    if (!moving(system, *out, time, &varies)) return true;
    nh_deck_fail(r->deck, node, 0, r->error, "%s must be constant, but `%s` varies", what,
                 nh_name_of(system->dag, varies));
    return nh_error_hint(r->error, time ? "use only numbers, parameters and t" : "use only numbers and parameters");
}

bool nh_system_constant(reader *r, const nh_deck_node *node, const char *what, nh_ex *out)
{
    return fixed(r, node, what, false, out);
}

bool nh_system_function_of_time(reader *r, const nh_deck_node *node, const char *what, nh_ex *out)
{
    return fixed(r, node, what, true, out);
}

static bool constant_of(reader *r, const nh_deck_node *map, const char *key, const char *what, int64_t fallback,
                        nh_ex *out)
{
    const nh_deck_node *node = nh_deck_get(map, key);
    *out = nh_int(r->system->dag, fallback);
    return !node || nh_system_constant(r, node, what, out);
}

bool nh_system_vector(reader *r, const nh_deck_node *list, const char *what, nh_ex out[3])
{
    if (!nh_deck_is(r->deck, list, NH_DECK_LIST, what, r->error)) return false;
    if (list->count != 3)
        return nh_deck_fail(r->deck, list, 0, r->error, "%s has three components, not %zu", what, list->count);
    for (int i = 0; i < 3; i++)
        if (!nh_system_constant(r, list->item[i], what, &out[i])) return false;
    return true;
}

static bool vector_of(reader *r, const nh_deck_node *map, const char *key, const char *what, nh_ex out[3])
{
    const nh_deck_node *node = nh_deck_get(map, key);
    for (int i = 0; i < 3; i++) out[i] = nh_int(r->system->dag, 0);
    return !node || nh_system_vector(r, node, what, out);
}

static void unit_vector(nh_dag *d, int axis, nh_ex out[3])
{
    for (int i = 0; i < 3; i++) out[i] = nh_int(d, i != axis % 3 ? 0 : axis < 3 ? 1 : -1);
}

/* x, y, z, -x, -y, -z, or [a, b, c] divided by its length. */
static bool direction(reader *r, const nh_deck_node *node, const char *what, nh_ex out[3])
{
    nh_dag *d = r->system->dag;
    if (node->kind != NH_DECK_LIST) {
        long axis = nh_system_word(r, node, what, 6, axis_names);
        if (axis >= 0) unit_vector(d, (int)axis, out);
        if (axis < 0 && !r->error->hint[0])
            nh_error_hint(r->error, "any other direction is a list of three components: [1, 0, 1]");
        return axis >= 0;
    }
    if (!nh_system_vector(r, node, what, out)) return false;
    nh_ex square = nh_tidy(d, nh_dot(d, out, out));
    if (nh_is_zero(d, square)) return nh_deck_fail(r->deck, node, 0, r->error, "a direction cannot be zero");
    nh_ex length = nh_sqrt(d, square);
    for (int i = 0; i < 3; i++) out[i] = nh_div(d, out[i], length);
    return true;
}

static bool direction_of(reader *r, const nh_deck_node *map, const char *key, const char *what, int fallback,
                         nh_ex out[3])
{
    const nh_deck_node *node = nh_deck_get(map, key);
    unit_vector(r->system->dag, fallback, out);
    return !node || direction(r, node, what, out);
}

/* One turn {z: angle} after the other, each about the axes as the ones before left them. */
static bool turn(reader *r, const nh_deck_node *map, nh_pose *a)
{
    nh_dag *d = r->system->dag;
    if (!nh_deck_is(r->deck, map, NH_DECK_MAP, "a turn {z: angle}", r->error) ||
        !nh_deck_only(r->deck, map, axis_names, 6, r->error))
        return false;
    for (size_t i = 0; i < map->count; i++) {
        nh_ex angle, axis[3];
        unit_vector(d, (int)nh_system_word(r, map->key[i], "an axis", 6, axis_names), axis);
        if (!nh_system_constant(r, map->item[i], "the angle of a rotation", &angle)) return false;
        nh_pose step = nh_pose_turn(d, axis, angle);
        *a = nh_pose_product(d, a, &step);
    }
    return true;
}

static bool rotation_of(reader *r, const nh_deck_node *item, nh_pose *a)
{
    const nh_deck_node *node = nh_deck_get(item, "rotation");
    *a = nh_pose_identity(r->system->dag);
    if (!node) return true;
    if (node->kind != NH_DECK_LIST) return turn(r, node, a);
    for (size_t i = 0; i < node->count; i++)
        if (!turn(r, node->item[i], a)) return false;
    return true;
}

/* ---- bodies ---- */

/* A number (the same about every axis), three principal moments, or a symmetric matrix; in the axes that `rotation`
   gives. */
static bool inertia_of(reader *r, const nh_deck_node *item, nh_ex I[9])
{
    nh_dag *d = r->system->dag;
    const nh_deck_node *node = nh_deck_get(item, "inertia");
    nh_pose turned;
    for (int i = 0; i < 9; i++) I[i] = nh_int(d, 0);
    if (!node) return true;
    bool matrix = node->kind == NH_DECK_LIST && node->count == 3 && node->item[0]->kind == NH_DECK_LIST;
    if (matrix) {
        for (int i = 0; i < 3; i++)
            if (!nh_system_vector(r, node->item[i], "a row of the inertia", I + 3 * i)) return false;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < i; j++)
                if (!nh_is_zero(d, nh_tidy(d, nh_sub(d, I[3 * i + j], I[3 * j + i]))))
                    return nh_deck_fail(
                        r->deck, node->item[i]->item[j], 0, r->error,
                        "an inertia matrix is symmetric, but row %d, column %d differs from row %d, column %d", i + 1,
                        j + 1, j + 1, i + 1);
    } else {
        nh_ex moment[3];
        if (node->kind != NH_DECK_LIST && !nh_system_constant(r, node, "the inertia", &moment[0])) return false;
        if (node->kind == NH_DECK_LIST && !nh_system_vector(r, node, "the inertia", moment)) return false;
        for (int i = 0; i < 3; i++) I[4 * i] = moment[node->kind == NH_DECK_LIST ? i : 0];
    }
    if (!rotation_of(r, item, &turned)) return false;
    nh_inertia c = {.m = nh_int(d, 0), .h = {nh_int(d, 0), nh_int(d, 0), nh_int(d, 0)}};
    memcpy(c.I, I, sizeof c.I);
    c = nh_inertia_outwards(d, &turned, &c);
    memcpy(I, c.I, sizeof c.I);
    return true;
}

static bool not_negative(reader *r, const nh_deck_node *map, const char *key, const char *what, nh_ex e)
{
    double value = nh_system_number(r->system, e);
    return value >= 0 || nh_deck_fail(r->deck, nh_deck_get(map, key), 0, r->error,
                                      "%s cannot be negative, but it is %.10g here", what, value);
}

static bool body_values(reader *r, nh_body *b)
{
    return constant_of(r, b->node, "mass", "the mass of a body", 0, &b->mass) &&
           not_negative(r, b->node, "mass", "the mass of a body", b->mass) &&
           vector_of(r, b->node, "center", "the centre of mass", b->center) && inertia_of(r, b->node, b->inertia);
}

/* ---- joints ---- */

/* Three letters, neighbours different: turns about these axes, one after the other. */
static bool euler_axes(reader *r, const nh_deck_node *item, int axis[3])
{
    const nh_deck_node *node = nh_deck_get(item, "angles");
    const char *text = "zyx";
    if (node && !nh_deck_is(r->deck, node, NH_DECK_SCALAR, "angles", r->error)) return false;
    if (node) text = node->text;
    bool good = strlen(text) == 3 && strspn(text, "xyz") == 3 && text[0] != text[1] && text[1] != text[2];
    for (int i = 0; i < 3 && good; i++) axis[i] = text[i] - 'x';
    if (good) return true;
    nh_deck_fail(r->deck, node, 0, r->error, "`%s` are not three axes, each different from the one before", text);
    return nh_error_hint(
        r->error,
        "for example zyx (the default; singular where the second angle is pi/2), zxz (singular where it is 0), or "
        "none: an orientation, which is nowhere singular");
}

static bool axes_of_joint(reader *r, const nh_joint *j, nh_screw *s)
{
    nh_dag *d = r->system->dag;
    int axis[3] = {2, 1, 0};
    const nh_deck_node *given = nh_deck_get(j->node, "axis"), *axes = nh_deck_get(j->node, "axes");
    switch (j->kind) {
    case NH_JOINT_SCHOENFLIES: /* along x, y, z, about the axis */
        for (int k = 0; k < 3; k++) unit_vector(d, k, s[k].axis);
        return direction_of(r, j->node, "axis", "an axis", 2, s[3].axis);
    case NH_JOINT_TRANSLATING_SCREW: /* as a planar joint, whose turn advances along the normal */
    case NH_JOINT_PLANAR: {          /* normal z: along x, along y, about z; and so on in turn */
        long normal = given ? nh_system_word(r, given, "the normal of a plane", 3, axis_names) : 2;
        if (normal < 0 && !r->error->hint[0])
            nh_error_hint(r->error, "any other plane is reached by a `rotation` of the joint");
        for (int k = 0; k < 3 && normal >= 0; k++) unit_vector(d, (int)(normal + 1 + k) % 3, s[k].axis);
        return normal >= 0;
    }
    case NH_JOINT_TRANSLATION:
        for (size_t k = 0; k < j->screws; k++)
            if (!direction(r, axes->item[k], "an axis", s[k].axis)) return false;
        return true;
    case NH_JOINT_SPHERICAL:
    case NH_JOINT_FREE: {
        if (j->orientation >= 0) axis[0] = 0, axis[2] = 2;
        else if (!euler_axes(r, j->node, axis)) return false;
        for (size_t k = 0; k < j->screws; k++) unit_vector(d, k + 3 < j->screws ? (int)k : axis[k % 3], s[k].axis);
        if (j->orientation >= 0) return true;
        bool same = axis[0] == axis[2];
        s[j->screws - 2].low = same ? 0.4 : -1.2; /* away from the pole */
        s[j->screws - 2].high = same ? 2.7 : 1.2;
        return true;
    }
    default:
        for (size_t k = 0; k < j->screws; k++)
            if (!direction_of(r, j->node, "axis", "an axis", 2, s[k].axis)) return false;
        return true;
    }
}

/* The displacement where the file gives an expression for it. */
static bool value_of(reader *r, const nh_deck_node *node, nh_ex *out)
{
    const nh_system *system = r->system;
    if (!nh_deck_is(r->deck, node, NH_DECK_SCALAR, "an expression", r->error)) return false;
    if (!nh_system_read_expression(system, r->deck, node, 0, NH_NO_QUASI, 0, NULL, NULL, out, r->error)) return false;
    for (size_t i = 0; i < system->coordinates; i++) {
        if (!nh_depends(system->dag, *out, system->coordinate[i].v)) continue;
        nh_deck_fail(r->deck, node, 0, r->error, "the velocity `%s` cannot be used here",
                     nh_name_of(system->dag, system->coordinate[i].v));
        return nh_error_hint(r->error, "a displacement is an expression in coordinates and t; a condition on "
                                       "velocities stands under `constraints:`");
    }
    return true;
}

static bool joint_values(reader *r, nh_joint *j)
{
    nh_system *system = r->system;
    nh_screw *screw = &system->chain->screw[j->first];
    nh_ex shift[3], pitch;
    const nh_deck_node *values = nh_deck_get(j->node, "values");
    if (!vector_of(r, j->node, "at", "a position", shift) || !rotation_of(r, j->node, &j->placement)) return false;
    memcpy(j->placement.p, shift, sizeof shift);
    if (!constant_of(r, j->node, "pitch", "a pitch", 0, &pitch) || !axes_of_joint(r, j, screw)) return false;
    for (size_t k = 0; k < j->screws; k++) {
        screw[k].turns = nh_joint_turns(j, k);
        screw[k].pitch = pitch;
        if (j->orientation >= 0 && k + 3 >= j->screws) {
            const nh_orientation *o = &system->orientation[j->orientation];
            size_t axis = k + 3 - j->screws;
            screw[k].oriented = true;
            screw[k].matrix = axis ? NULL : o->matrix;
            screw[k].s = nh_int(system->dag, 0);
            screw[k].rate = o->body[axis];
            screw[k].framed = o->framed_body[axis];
            continue;
        }
        if (!values)
            system->coordinate[screw[k].coordinate].counted |= screw[k].turns && !nh_is_zero(system->dag, pitch);
        if (values && !value_of(r, values->item[k], &screw[k].s)) return false;
        if (!values) screw[k].s = system->coordinate[screw[k].coordinate].q;
    }
    return true;
}

/* ---- wheels ---- */

static bool wheel_values(reader *r, const nh_deck_node *item, nh_wheel *w)
{
    static const char *const keys[] = {"name", "type", "body", "at", "axis", "axle", "radius", "on", "normal", "doc"};
    static const char *const types[] = {"knife-edge", "rolling", "ball"};
    const char *doc; /* text for readers of the file */
    if (!nh_deck_is(r->deck, item, NH_DECK_MAP, "a wheel {type: ..., body: ...}", r->error)) return false;
    if (!nh_deck_only(r->deck, item, keys, sizeof keys / sizeof *keys, r->error)) return false;
    const nh_deck_node *type = nh_deck_get(item, "type"), *normal = nh_deck_get(item, "normal");
    if (!type) return nh_deck_fail(r->deck, item, 0, r->error, "this wheel has no `type`: knife-edge, rolling or ball");
    long kind = nh_system_word(r, type, "a type of wheel", 3, types),
         body = nh_system_body_word(r, item, "body", NH_NOBODY);
    if (kind < 0 || body == NH_NOBODY) return false;
    if (body == NH_GROUND)
        return nh_deck_fail(r->deck, nh_deck_get(item, "body"), 0, r->error,
                            "a wheel belongs to a body, not to the ground");
    *w = (nh_wheel){.kind = kind ? NH_WHEEL_ROLLING : NH_WHEEL_KNIFE_EDGE,
                    .ball = kind == 2,
                    .body = (size_t)body,
                    .normal = 2,
                    .node = item};
    w->on = nh_system_body_word(r, item, "on", NH_GROUND);
    if (w->on == NH_NOBODY) return false;
    if (w->on == body)
        return nh_deck_fail(r->deck, nh_deck_get(item, "on"), 0, r->error, "a wheel cannot roll on its own body");
    static const char *const needed[3][2] = {{"axis", NULL}, {"axle", "radius"}, {"radius", NULL}},
                             *const foreign[3][2] = {{"axle", "radius"}, {"axis", NULL}, {"axis", "axle"}};
    for (int i = 0; i < 2; i++) {
        const char *need = needed[kind][i], *other = foreign[kind][i];
        if (other && nh_deck_get(item, other))
            return nh_deck_fail(r->deck, nh_deck_get(item, other), 0, r->error, "a wheel of type %s has no `%s`",
                                types[kind], other);
        if (!need || nh_deck_get(item, need)) continue;
        nh_deck_fail(r->deck, item, 0, r->error, "a wheel of type %s needs `%s`", types[kind], need);
        return nh_error_hint(r->error,
                             kind == 0   ? "`axis: y` is the normal of the blade: the blade does not slide along it"
                             : kind == 1 ? "for example `axle: y, radius: 0.3`: the axis of rotation and the radius"
                                         : "`radius: 0.3`");
    }
    if (normal) w->normal = (int)nh_system_word(r, normal, "the normal of a surface", 3, axis_names);
    if (w->normal < 0 || !nh_system_text_of(r, item, "doc", "", &doc) ||
        !nh_system_text_of(r, item, "name", NULL, &w->name))
        return false;
    return vector_of(r, item, "at", "a position", w->at) &&
           direction_of(r, item, kind ? "axle" : "axis", kind ? "an axle" : "an axis", 1, w->axis) &&
           constant_of(r, item, "radius", "a radius", 0, &w->radius) &&
           not_negative(r, item, "radius", "a radius", w->radius);
}

/* "wheel of cart"; "wheel 2 of cart" where several wheels of the body have no name. */
static void name_wheels(reader *r)
{
    nh_chain *c = r->system->chain;
    for (size_t body = 0; body < c->bodies; body++) {
        size_t all = 0, number = 0;
        for (size_t i = 0; i < c->wheels; i++) all += c->wheel[i].body == body && !c->wheel[i].name;
        for (size_t i = 0; i < c->wheels; i++) {
            nh_wheel *w = &c->wheel[i];
            if (w->body != body || w->name) continue;
            const char *of = c->body[body].name, *kind = w->ball                       ? "ball"
                                                         : w->kind == NH_WHEEL_ROLLING ? "wheel"
                                                                                       : "blade";
            w->name = all == 1 ? nh_arena_printf(r->system->arena, "%s of %s", kind, of)
                               : nh_arena_printf(r->system->arena, "%s %zu of %s", kind, ++number, of);
        }
    }
}

static bool read_wheels(reader *r)
{
    const nh_deck_node *list;
    size_t n;
    nh_chain *c = r->system->chain;
    if (!nh_system_list_of(r, r->root, "wheels", &list, &n)) return false;
    c->wheel = nh_system_take(r, n, sizeof *c->wheel);
    for (size_t i = 0; i < n; i++) {
        if (!wheel_values(r, list->item[i], &c->wheel[i])) return false;
        c->wheels = i + 1;
    }
    name_wheels(r);
    return true;
}

/* ---- all of it ---- */

/* A single number is the acceleration downwards, along -z. */
static bool read_gravity(reader *r)
{
    nh_dag *d = r->system->dag;
    const nh_deck_node *node = nh_deck_get(r->root, "gravity");
    nh_ex *g = r->system->chain->gravity;
    for (int i = 0; i < 3; i++) g[i] = nh_int(d, 0);
    if (!node) return true;
    if (node->kind == NH_DECK_LIST) return nh_system_vector(r, node, "gravity", g);
    if (!nh_system_constant(r, node, "gravity", &g[2])) return false;
    g[2] = nh_neg(d, g[2]);
    return true;
}

bool nh_system_read_chain(reader *r)
{
    nh_system *system = r->system;
    nh_chain *c = system->chain;
    if (!c) return true;
    for (size_t i = 0; i < c->bodies; i++)
        if (!body_values(r, &c->body[i])) return false;
    for (size_t i = 0; i < c->joints; i++)
        if (!joint_values(r, &c->joint[i])) return false;
    if (!read_gravity(r) || !read_wheels(r)) return false;
    nh_ex *q = nh_system_take(r, 2 * system->coordinates, sizeof *q), *v = q + system->coordinates;
    for (size_t i = 0; i < system->coordinates; i++) {
        q[i] = system->coordinate[i].q;
        v[i] = system->coordinate[i].v;
    }
    nh_chain_build(
        c, &(nh_chain_scope){
               .dag = system->dag, .arena = system->arena, .t = system->t, .m = system->coordinates, .q = q, .v = v});
    return true;
}
