#include "problem/drawing.h"

#include <ctype.h>
#include <string.h>

#include "problem/solid.h"

typedef struct {
    const nh_system *s;
    nh_arena *arena;
    size_t count, capacity;
    nh_shape *shape;
} drawing;

static nh_shape *draw(drawing *w, nh_shape_kind kind)
{
    if (w->count == w->capacity) {
        nh_shape *more = nh_arena_alloc(w->arena, (2 * w->capacity + 8) * sizeof *more);
        if (w->count) memcpy(more, w->shape, w->count * sizeof *more);
        w->shape = more;
        w->capacity = 2 * w->capacity + 8;
    }
    nh_shape *out = &w->shape[w->count++];
    *out = (nh_shape){.kind = kind};
    return out;
}

static nh_shape *point(drawing *w, nh_ex x, nh_ex y)
{
    nh_shape *p = draw(w, NH_SHAPE_POINT);
    p->value[0] = x;
    p->value[1] = y;
    return p;
}

static nh_shape *segment(drawing *w, const nh_ex from[2], const nh_ex to[2])
{
    nh_shape *p = draw(w, NH_SHAPE_SEGMENT);
    p->value[0] = from[0];
    p->value[1] = from[1];
    p->value[2] = to[0];
    p->value[3] = to[1];
    return p;
}

/* ---- bodies and joints ---- */

static bool moves(const drawing *w, nh_ex e)
{
    for (size_t i = 0; i < w->s->coordinates; i++)
        if (nh_depends(w->s->dag, e, w->s->coordinate[i].q)) return true;
    return false;
}

/* The two axes of the ground's frame that span the picture. */
static const char *choose_view(const drawing *w, int axis[2])
{
    const nh_chain *c = w->s->chain;
    bool any[3] = {false, false, false};
    for (size_t i = 0; i < c->bodies; i++)
        for (int e = 0; e < 3; e++)
            any[e] = any[e] || moves(w, c->body[i].pose.p[e]) || moves(w, c->body[i].position[e]);
    int across = c->wheels || !any[2] ? 2 : !any[1] ? 1 : !any[0] ? 0 : nh_is_zero(w->s->dag, c->gravity[2]) ? 2 : 1;
    axis[0] = across == 0;
    axis[1] = across == 2 ? 1 : 2;
    return across == 2 ? "view along z" : across == 1 ? "view along y" : "view along x";
}

static void seen(const nh_ex p[3], const int axis[2], nh_ex out[2])
{
    out[0] = p[axis[0]];
    out[1] = p[axis[1]];
}

/* Points in the picture, and in space. */
static void rod(drawing *w, const int axis[2], const nh_ex from[3], const nh_ex to[3])
{
    nh_ex start[2], end[2];
    bool same = true;
    for (int e = 0; e < 3; e++) same = same && from[e] == to[e];
    if (same) return;
    nh_shape *p = draw(w, NH_SHAPE_ROD);
    for (int e = 0; e < 3; e++) p->value[e] = from[e], p->value[3 + e] = to[e];
    seen(from, axis, start);
    seen(to, axis, end);
    if (start[0] != end[0] || start[1] != end[1]) segment(w, start, end)->flat = true;
}

/* From the parent's frame to the joint, and from there to the child's frame where the joint slides. */
static void rods(drawing *w, const int axis[2])
{
    const nh_chain *c = w->s->chain;
    for (size_t i = 0; i < c->joints; i++) {
        const nh_joint *j = &c->joint[i];
        nh_ex place[3];
        if (j->parent < 0) continue;
        nh_pose_point(w->s->dag, &c->body[j->parent].pose, j->placement.p, place);
        rod(w, axis, c->body[j->parent].pose.p, place);
        rod(w, axis, place, c->body[j->child].pose.p);
    }
}

/* Masses that carry nothing, at the end of their rods. */
static void ends(drawing *w, const int axis[2])
{
    const nh_chain *c = w->s->chain;
    for (size_t i = 0; i < c->bodies; i++) {
        bool carries = nh_is_zero(w->s->dag, c->body[i].mass);
        for (size_t j = 0; j < c->joints; j++) carries |= c->joint[j].parent == (long)i;
        for (size_t j = 0; j < c->wheels; j++) carries |= c->wheel[j].body == i && c->wheel[j].kind == NH_WHEEL_ROLLING;
        nh_ex to[2];
        seen(c->body[i].position, axis, to);
        if (carries) continue;
        rod(w, axis, c->body[i].pose.p, c->body[i].position);
        nh_shape *p = point(w, to[0], to[1]);
        p->name = c->body[i].name;
        p->flat = true;
    }
}

/* A body that a joint on the ground carries, with its heading where it turns in the picture's plane. */
static void bases(drawing *w, const int axis[2])
{
    const nh_chain *c = w->s->chain;
    for (size_t i = 0; i < c->joints; i++) {
        if (c->joint[i].parent >= 0) continue;
        const nh_pose *pose = &c->body[c->joint[i].child].pose;
        nh_ex cosine = pose->R[3 * axis[0]], sine = pose->R[3 * axis[1]];
        if (!moves(w, pose->p[axis[0]]) && !moves(w, pose->p[axis[1]])) continue;
        nh_shape *p = draw(w, moves(w, sine) ? NH_SHAPE_ARROW : NH_SHAPE_POINT);
        seen(pose->p, axis, p->value);
        p->name = c->body[c->joint[i].child].name;
        p->flat = true;
        if (p->kind == NH_SHAPE_ARROW) p->value[2] = nh_call2(w->s->dag, NH_ATAN2, sine, cosine);
    }
}

/* Seen from above: a wheel heads where it rolls, at a right angle to its axle a: (a_y, -a_x). */
static void wheels(drawing *w, const int axis[2])
{
    const nh_chain *c = w->s->chain;
    nh_dag *d = w->s->dag;
    for (size_t i = 0; i < c->wheels; i++) {
        const nh_wheel *v = &c->wheel[i];
        nh_ex at[3], axle[3];
        if (v->normal != 2) continue;
        nh_pose_point(d, &c->body[v->body].pose, v->at, at);
        if (v->kind != NH_WHEEL_ROLLING) { /* a blade has no size */
            rod(w, axis, c->body[v->body].pose.p, at);
            continue;
        }
        nh_shape *p = draw(w, v->ball ? NH_SHAPE_DISC : NH_SHAPE_WHEEL);
        p->name = v->name;
        p->flat = true;
        p->value[0] = at[0];
        p->value[1] = at[1];
        p->value[v->ball ? 2 : 3] = v->radius;
        if (v->ball) continue;
        nh_rotate(d, c->body[v->body].pose.R, false, v->axis, axle);
        p->value[2] = nh_call2(d, NH_ATAN2, nh_neg(d, axle[0]), axle[1]);
    }
}

/* The shapes of the plane come first, because their colours follow from their numbers. */
static void space_behind(drawing *w)
{
    nh_shape *all = nh_arena_alloc(w->arena, (w->count + 1) * sizeof *all);
    size_t n = 0;
    for (int space = 0; space < 2; space++)
        for (size_t i = 0; i < w->count; i++)
            if (nh_shape_in_space(w->shape[i].kind) == (space == 1)) all[n++] = w->shape[i];
    w->shape = all;
}

static const char *bodies(drawing *w)
{
    int axis[2];
    const char *view = choose_view(w, axis);
    bases(w, axis);
    rods(w, axis);
    ends(w, axis);
    if (axis[0] == 0 && axis[1] == 1) wheels(w, axis);
    if (!w->count) return NULL;
    const nh_chain *c = w->s->chain;
    for (size_t i = 0; i < c->bodies; i++)
        if (!nh_is_zero(w->s->dag, c->body[i].mass)) *draw(w, NH_SHAPE_BALL) = nh_solid_of_body(w->s->dag, c, i);
    space_behind(w);
    return view;
}

/* ---- coordinates ---- */

/* x1 and y1, but not x1 and x2: the same number at the end of different names. */
static bool pair(const char *a, const char *b)
{
    size_t i = strlen(a), j = strlen(b);
    while (i > 1 && isdigit((unsigned char)a[i - 1])) i--;
    while (j > 1 && isdigit((unsigned char)b[j - 1])) j--;
    return a[i] && !strcmp(a + i, b + j) && (i != j || strncmp(a, b, i));
}

/* Points x1, y1, x2, y2, ...; false when the lengths do not come in pairs. */
static bool several_points(drawing *w, size_t lengths, const nh_coordinate *const *length)
{
    if (lengths < 4 || lengths % 2) return false;
    for (size_t i = 0; i < lengths; i += 2)
        if (!pair(length[i]->name, length[i + 1]->name)) return false;
    for (size_t i = 0; i < lengths; i += 2)
        point(w, length[i]->q, length[i + 1]->q)->name =
            nh_arena_printf(w->arena, "(%s, %s)", length[i]->name, length[i + 1]->name);
    return true;
}

static const char *along_line(drawing *w, nh_ex r, const nh_coordinate *angle)
{
    nh_dag *d = w->s->dag;
    if (!angle) {
        point(w, r, nh_int(d, 0));
        return "the coordinate along a line";
    }
    const nh_ex zero[2] = {nh_int(d, 0), nh_int(d, 0)};
    nh_ex at[2] = {nh_mul(d, r, nh_call(d, NH_COS, angle->q)), nh_mul(d, r, nh_call(d, NH_SIN, angle->q))};
    if (at[0] != zero[0] || at[1] != zero[1]) segment(w, zero, at);
    point(w, at[0], at[1]);
    return "length and angle as polar coordinates";
}

/* Pendulum hands that hang down at 0 and turn to the left, on dials side by side. */
static const char *dials(drawing *w)
{
    enum { apart = 3 };
    nh_dag *d = w->s->dag;
    for (size_t i = 0; i < w->s->coordinates; i++) {
        nh_ex at[2] = {nh_int(d, (int64_t)(apart * i)), nh_int(d, 0)}, q = w->s->coordinate[i].q;
        nh_ex end[2] = {nh_add(d, at[0], nh_call(d, NH_SIN, q)), nh_neg(d, nh_call(d, NH_COS, q))};
        segment(w, at, end);
    }
    return w->s->coordinates == 1 ? "the angle as a hand; 0 points down"
                                  : "each angle as the hand of a separate dial, in order; 0 points down";
}

static const char *from_coordinates(drawing *w)
{
    const nh_system *s = w->s;
    const nh_coordinate **length = nh_arena_alloc(w->arena, (s->coordinates + 1) * sizeof *length), *angle = NULL;
    size_t lengths = 0;
    for (size_t i = 0; i < s->coordinates; i++) {
        if (s->coordinate[i].type == NH_ANGLE && !angle) angle = &s->coordinate[i];
        if (s->coordinate[i].type != NH_ANGLE) length[lengths++] = &s->coordinate[i];
    }
    if (lengths == 0) return dials(w);
    if (lengths == 1) return along_line(w, length[0]->q, angle);
    if (several_points(w, lengths, length)) return "each pair of coordinates as a point";
    nh_shape *p = draw(w, angle ? NH_SHAPE_ARROW : NH_SHAPE_POINT);
    p->value[0] = length[0]->q;
    p->value[1] = length[1]->q;
    if (angle) p->value[2] = angle->q;
    return nh_arena_printf(w->arena, "%s and %s as a plane%s%s", length[0]->name, length[1]->name,
                           angle ? ", with the heading " : "", angle ? angle->name : "");
}

const char *nh_drawing_choose(nh_arena *arena, const nh_system *s, size_t *count, const nh_shape **shape)
{
    drawing w = {.s = s, .arena = arena};
    const char *words = s->chain ? bodies(&w) : NULL;
    if (!words) words = from_coordinates(&w);
    *count = w.count;
    *shape = w.shape;
    return words;
}
