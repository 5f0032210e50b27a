#include "problem/drawing.h"

#include <ctype.h>
#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"

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

/* ---- coordinates, as the kinetic energy has them ---- */

enum { longest = 2000 }; /* what is longer is neither c f nor compared */

/* m_ij = d2L/dv_i dv_j. */
static nh_ex mass(const drawing *w, size_t i, size_t j)
{
    const nh_coordinate *c = w->s->coordinate;
    return nh_diff(w->s->dag, nh_diff(w->s->dag, w->s->lagrangian, c[i].v), c[j].v);
}

/* Is it free of t, positions and velocities? */
static bool constant(const drawing *w, nh_ex e)
{
    for (size_t i = 0; i < w->s->coordinates; i++)
        if (nh_depends(w->s->dag, e, w->s->coordinate[i].q) || nh_depends(w->s->dag, e, w->s->coordinate[i].v))
            return false;
    return !nh_depends(w->s->dag, e, w->s->t);
}

/* c with m_ij = c f for a constant c that is not 0: the value of m_ij where `from` is `to`, and f is 1; 0: there is
 * none. */
static nh_ex multiple(const drawing *w, size_t i, size_t j, nh_ex f, nh_ex from, nh_ex to)
{
    nh_dag *d = w->s->dag;
    nh_ex m = mass(w, i, j), c = nh_simplify_short(d, nh_substitute(d, m, 1, &from, &to), longest);
    bool is = nh_complexity_within(d, m, longest) && constant(w, c) && !nh_is_zero(d, c) &&
              nh_normal_is_zero(d, nh_sub(d, m, nh_mul(d, c, f)), 0) == NH_ZERO;
    return is ? c : nh_int(d, 0);
}

/* An angle: declared, or L is the same after a full turn and not free of it. */
static bool turns(const drawing *w, size_t i)
{
    nh_dag *d = w->s->dag;
    const nh_coordinate *c = &w->s->coordinate[i];
    nh_ex after = nh_add(d, c->q, nh_mul(d, nh_int(d, 2), nh_pi(d)));
    nh_ex change = nh_sub(d, nh_substitute(d, w->s->lagrangian, 1, &c->q, &after), w->s->lagrangian);
    return c->type == NH_ANGLE ||
           (c->type == NH_PLAIN && nh_depends(d, w->s->lagrangian, c->q) && nh_complexity_within(d, change, longest) &&
            nh_normal_is_zero(d, change, 0) == NH_ZERO);
}

/* Where gravity points, on the axis from which an angle is measured: 1 to the angle 0, -1 to pi, 0 across or nowhere:
 * the sign of L(0) - L(pi), at rest, wherever the other coordinates are. */
static int gravity(const drawing *w, size_t angle)
{
    enum { places = 3 };
    nh_dag *d = w->s->dag;
    size_t m = w->s->coordinates;
    nh_ex *from = nh_arena_alloc(w->arena, (2 * m + 1) * sizeof *from);
    nh_ex *to = nh_arena_alloc(w->arena, (2 * m + 1) * sizeof *to);
    int sum = 0;
    for (int k = 1; k <= places; k++) {
        double value[2];
        for (int side = 0; side < 2; side++) {
            for (size_t i = 0; i < m; i++) {
                from[i] = w->s->coordinate[i].q;
                from[m + i] = w->s->coordinate[i].v;
                to[i] = nh_int(d, k);
                to[m + i] = nh_int(d, 0);
            }
            from[2 * m] = w->s->t;
            to[2 * m] = nh_int(d, 0);
            to[angle] = side ? nh_pi(d) : nh_int(d, 0);
            value[side] = nh_system_number(w->s, nh_substitute(d, w->s->lagrangian, 2 * m + 1, from, to));
        }
        sum += value[0] > value[1] ? 1 : value[0] < value[1] ? -1 : 0;
    }
    return sum == places ? 1 : sum == -places ? -1 : 0;
}

/* The direction at an angle: from the vertical where gravity points along it, else from the x axis (or, where `hanging`
 * is the custom, from below). */
static void direction(const drawing *w, size_t angle, bool hanging, nh_ex out[2])
{
    nh_dag *d = w->s->dag;
    int down = gravity(w, angle);
    nh_ex q = w->s->coordinate[angle].q, c = nh_call(d, NH_COS, q), s = nh_call(d, NH_SIN, q);
    bool upright = down || hanging;
    out[0] = upright ? s : c;
    out[1] = !upright ? s : down < 0 ? c : nh_neg(d, c);
}

/* Polar coordinates r and angle i, m_ii = c r^2, m_rr constant; of a sphere with k, m_kk = c r^2 sin(i)^2, too: a
 * point.  Its name, or NULL: they are not. */
static const char *polar(drawing *w, size_t r, size_t i, bool *used)
{
    nh_dag *d = w->s->dag;
    const nh_coordinate *q = w->s->coordinate;
    nh_ex one = nh_int(d, 1), square = nh_powi(d, q[r].q, 2), c = multiple(w, i, i, square, q[r].q, one);
    if (nh_is_zero(d, c) || !constant(w, mass(w, r, r)) || !nh_is_zero(d, nh_simplify(d, mass(w, r, i)))) return NULL;
    used[r] = used[i] = true;
    nh_ex u[2], end[3];
    for (size_t k = 0; k < w->s->coordinates; k++) {
        nh_ex sine = nh_call(d, NH_SIN, q[i].q), round = nh_mul(d, c, nh_powi(d, nh_mul(d, q[r].q, sine), 2));
        if (used[k] || nh_normal_is_zero(d, nh_sub(d, mass(w, k, k), round), 0) != NH_ZERO) continue;
        used[k] = true;
        nh_ex across = nh_mul(d, q[r].q, sine), height = nh_mul(d, q[r].q, nh_call(d, NH_COS, q[i].q));
        const nh_ex p[3] = {nh_mul(d, across, nh_call(d, NH_COS, q[k].q)),
                            nh_mul(d, across, nh_call(d, NH_SIN, q[k].q)),
                            gravity(w, i) > 0 ? nh_neg(d, height) : height};
        const char *name = nh_arena_printf(w->arena, "(%s, %s, %s)", q[r].name, q[i].name, q[k].name);
        nh_pose pose = nh_pose_shift(d, p);
        nh_ex none = nh_int(d, 0);
        *draw(w, NH_SHAPE_BALL) = nh_shape_solid(NH_SHAPE_BALL, name, &pose, &none);
        nh_shape *line = draw(w, NH_SHAPE_ROD);
        for (size_t a = 0; a < 3; a++) line->value[a] = none, line->value[3 + a] = p[a];
        return name;
    }
    direction(w, i, false, u);
    for (size_t a = 0; a < 2; a++) end[a] = nh_mul(d, q[r].q, u[a]);
    const nh_ex zero[2] = {nh_int(d, 0), nh_int(d, 0)};
    segment(w, zero, end);
    return point(w, end[0], end[1])->name = nh_arena_printf(w->arena, "(%s, %s)", q[r].name, q[i].name);
}

static const char *polar_points(drawing *w)
{
    size_t m = w->s->coordinates;
    bool *used = nh_arena_alloc(w->arena, m * sizeof *used);
    memset(used, 0, m * sizeof *used);
    const char *words = NULL;
    for (size_t r = 0; r < m; r++)
        for (size_t i = 0; i < m && !used[r] && w->s->coordinate[r].type != NH_ANGLE; i++) {
            const char *name = i == r || used[i] || w->s->coordinate[i].type == NH_LENGTH ? NULL : polar(w, r, i, used);
            if (!name) continue;
            words = words ? nh_arena_printf(w->arena, "%s, %s", words, name) : name;
        }
    return words ? nh_arena_printf(w->arena, "%s in polar coordinates", words) : NULL;
}

/* Pendulums one at the end of the other, by their angles from the vertical: m_ij = c_ij cos(q_i - q_j), on the
 * ground or on a cart at x, m_xj = c_xj cos(q_j).  Of point masses c_jn/c_nn = l_j/l_n for the last one, n, and
 * c_nn/c_xn = l_n. */
static const char *pendulums(drawing *w, size_t cart, size_t n, const size_t *angle)
{
    nh_dag *d = w->s->dag;
    const nh_coordinate *q = w->s->coordinate;
    bool on_cart = cart < w->s->coordinates;
    size_t last = angle[n - 1];
    nh_ex *length = nh_arena_alloc(w->arena, n * sizeof *length), zero = nh_int(d, 0), at[2] = {zero, zero};
    if (n < 2 && !on_cart) return NULL;
    nh_ex unit =
        on_cart ? multiple(w, cart, last, nh_call(d, NH_COS, q[last].q), q[last].q, zero) : mass(w, last, last);
    for (size_t i = 0; i < n; i++) {
        if (!constant(w, mass(w, angle[i], angle[i]))) return NULL;
        for (size_t j = 0; j < i; j++) {
            nh_ex f = nh_call(d, NH_COS, nh_sub(d, q[angle[i]].q, q[angle[j]].q));
            if (nh_is_zero(d, length[j] = multiple(w, angle[i], angle[j], f, q[angle[i]].q, q[angle[j]].q)))
                return NULL;
        }
        nh_ex f = nh_call(d, NH_COS, q[angle[i]].q);
        if (on_cart && nh_is_zero(d, multiple(w, cart, angle[i], f, q[angle[i]].q, zero))) return NULL;
    }
    length[n - 1] = mass(w, last, last); /* the loop left those of the last one's row */
    if (on_cart) point(w, at[0] = q[cart].q, zero);
    for (size_t i = 0; i < n; i++) {
        nh_ex u[2], end[2], l = nh_simplify(d, nh_div(d, length[i], unit));
        direction(w, angle[i], true, u);
        for (size_t a = 0; a < 2; a++) end[a] = nh_add(d, at[a], nh_mul(d, l, u[a]));
        segment(w, at, end);
        memcpy(at, end, sizeof at);
    }
    point(w, at[0], at[1]);
    return on_cart ? nh_arena_printf(w->arena, "%s along a line, with pendulums", q[cart].name)
                   : "pendulums one at the end of the other; the last has length 1";
}

/* ---- coordinates, as their types say ---- */

/* x1 and y1, but not x1 and x2: the same number at the end of different names. */
static bool pair(const char *a, const char *b)
{
    size_t i = strlen(a), j = strlen(b);
    while (i > 1 && isdigit((unsigned char)a[i - 1])) i--;
    while (j > 1 && isdigit((unsigned char)b[j - 1])) j--;
    return a[i] && !strcmp(a + i, b + j) && (i != j || strncmp(a, b, i));
}

/* Points x1, y1, x2, y2, ...; false when the lengths do not come in pairs. */
static bool several_points(drawing *w, size_t lengths, const size_t *length)
{
    const nh_coordinate *c = w->s->coordinate;
    if (lengths < 4 || lengths % 2) return false;
    for (size_t i = 0; i < lengths; i += 2)
        if (!pair(c[length[i]].name, c[length[i + 1]].name)) return false;
    for (size_t i = 0; i < lengths; i += 2)
        point(w, c[length[i]].q, c[length[i + 1]].q)->name =
            nh_arena_printf(w->arena, "(%s, %s)", c[length[i]].name, c[length[i + 1]].name);
    return true;
}

/* Hands of dials side by side, or at a point of the line. */
static void dials(drawing *w, size_t angles, const size_t *angle, const nh_ex *at_point)
{
    enum { apart = 3 };
    nh_dag *d = w->s->dag;
    for (size_t i = 0; i < angles; i++) {
        nh_ex at[2] = {at_point ? *at_point : nh_int(d, (int64_t)(apart * i)), nh_int(d, 0)}, u[2], end[2];
        direction(w, angle[i], true, u);
        for (size_t a = 0; a < 2; a++) end[a] = nh_add(d, at[a], u[a]);
        segment(w, at, end);
    }
}

static const char *from_coordinates(drawing *w)
{
    const nh_system *system = w->s;
    const nh_coordinate *c = system->coordinate;
    size_t *length = nh_arena_alloc(w->arena, (system->coordinates + 1) * sizeof *length), lengths = 0;
    size_t *angle = nh_arena_alloc(w->arena, (system->coordinates + 1) * sizeof *angle), angles = 0;
    const char *words = polar_points(w);
    if (words) return words;
    for (size_t i = 0; i < system->coordinates; i++)
        if (turns(w, i)) angle[angles++] = i;
        else length[lengths++] = i;
    if (angles && lengths < 2 && (words = pendulums(w, lengths ? length[0] : system->coordinates, angles, angle)))
        return words;
    if (lengths == 0) {
        dials(w, angles, angle, NULL);
        return angles == 1 ? "the angle as a hand" : "each angle as the hand of a separate dial, in order";
    }
    if (lengths == 1) {
        point(w, c[length[0]].q, nh_int(system->dag, 0));
        dials(w, angles, angle, &c[length[0]].q);
        return nh_arena_printf(w->arena, "%s along a line%s", c[length[0]].name,
                               angles ? ", each angle as a hand there" : "");
    }
    if (several_points(w, lengths, length)) return "each pair of coordinates as a point";
    nh_shape *p = draw(w, angles ? NH_SHAPE_ARROW : NH_SHAPE_POINT);
    p->value[0] = c[length[0]].q;
    p->value[1] = c[length[1]].q;
    if (angles) p->value[2] = c[angle[0]].q;
    return nh_arena_printf(w->arena, "%s to the right and %s up%s%s", c[length[0]].name, c[length[1]].name,
                           angles ? ", with the heading " : "", angles ? c[angle[0]].name : "");
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
