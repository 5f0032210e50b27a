#include "document/perspective.h"

#include <math.h>

#include "base/memory.h"

static double number(const nh_time_series *c, size_t s, size_t j, size_t i)
{
    const nh_line *line = nh_time_series_shape(c, s, j);
    return line->value[i * line->stride];
}

/* The direction against gravity; the third axis where there is none. */
static int upwards(const nh_time_series *c)
{
    const nh_chain *chain = c->model->system->chain;
    for (int e = 0; chain && e < 2; e++)
        if (!nh_is_zero(c->model->dag, chain->gravity[e])) return e;
    return 2;
}

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void nh_view_cross(const double a[3], const double b[3], double out[3])
{
    for (size_t j = 0; j < 3; j++) out[j] = a[(j + 1) % 3] * b[(j + 2) % 3] - a[(j + 2) % 3] * b[(j + 1) % 3];
}

static void normalise(double a[3])
{
    double length = sqrt(dot(a, a));
    for (size_t j = 0; j < 3 && length > 0; j++) a[j] /= length;
}

/* The view is from the front, from above and a little from the right; the light comes from above the eye and its
 * left. */
static void directions(nh_view *v)
{
    static const double beside = 0.35 * 0.92, before = 0.94 * 0.92, above = 0.4, lamp_up = 0.8, lamp_right = -0.4;
    static const int across[3] = {1, 0, 0}, along[3] = {2, 2, 1};
    double up[3] = {0, 0, 0};
    up[v->up] = 1;
    v->towards[across[v->up]] = beside;
    v->towards[along[v->up]] = v->up == 2 ? -before : before;
    v->towards[v->up] = above;
    normalise(v->towards);
    nh_view_cross(up, v->towards, v->right);
    normalise(v->right);
    nh_view_cross(v->towards, v->right, v->top);
    for (size_t j = 0; j < 3; j++) v->light[j] = v->towards[j] + lamp_up * up[j] + lamp_right * v->right[j];
    normalise(v->light);
}

/* The radius of a ball around all of the body. */
static double reach(const nh_time_series *c, size_t s, size_t i)
{
    double a, b;
    switch (c->shape[s].kind) {
    case NH_SHAPE_BALL: return number(c, s, 3, i);
    case NH_SHAPE_CYLINDER: return hypot(number(c, s, 3, i), number(c, s, 4, i) / 2);
    case NH_SHAPE_BOX:
        a = number(c, s, 3, i), b = number(c, s, 4, i);
        return hypot(hypot(a, b), number(c, s, 5, i)) / 2;
    default: return 0;
    }
}

/* The points of a shape at a time, and the radius about each: one point, or the two ends of a rod.  A shape in the
 * plane lies on the ground. */
static size_t places(const nh_time_series *c, size_t s, size_t i, double point[2][3], double *radius)
{
    nh_shape_kind kind = c->shape[s].kind;
    size_t n = kind == NH_SHAPE_ROD ? 2 : 1;
    *radius = reach(c, s, i);
    for (size_t e = 0; e < n; e++)
        for (size_t j = 0; j < 3; j++) {
            point[e][j] = j < 2 || nh_shape_in_space(kind) ? number(c, s, 3 * e + j, i) : 0;
            if (!isfinite(point[e][j])) return 0;
        }
    return isfinite(*radius) ? n : 0;
}

typedef struct {
    double low[3], high[3];
} box;

static const box nothing = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void widen(box *b, const double p[3], double r)
{
    for (size_t j = 0; j < 3; j++) {
        b->low[j] = fmin(b->low[j], p[j] - r);
        b->high[j] = fmax(b->high[j], p[j] + r);
    }
}

static double half_diagonal(const box *b)
{
    return hypot(hypot(b->high[0] - b->low[0], b->high[1] - b->low[1]), b->high[2] - b->low[2]) / 2;
}

/* What the picture contains: the whole motion; or it follows the bodies.  Returns the radius about the target. */
static double targets(nh_view *v)
{
    static const double far = 5, around = 2.2; /* in radii of the bodies together */
    box all = nothing;
    double own = 0, whole;
    for (size_t i = 0; i < v->count; i++) {
        box now = nothing;
        double p[2][3], r, *middle = v->middle + 3 * i;
        for (size_t s = 0; s < v->course->shapes; s++)
            for (size_t n = v->course->shape[s].flat ? 0 : places(v->course, s, i, p, &r); n-- > 0;)
                widen(&now, p[n], r);
        bool any = now.high[0] >= now.low[0];
        for (size_t j = 0; j < 3; j++) middle[j] = any ? (now.low[j] + now.high[j]) / 2 : i ? middle[(long)j - 3] : 0;
        if (!any) continue;
        own = fmax(own, half_diagonal(&now));
        widen(&all, now.low, 0);
        widen(&all, now.high, 0);
    }
    v->floor = all.low[v->up];
    whole = half_diagonal(&all);
    if (whole > far * own && own > 0) return around * own;
    for (size_t i = 0; i < 3 * v->count && isfinite(whole); i++) v->middle[i] = (all.low[i % 3] + all.high[i % 3]) / 2;
    return whole > 0 && isfinite(whole) ? whole : 1;
}

void nh_view_see(const nh_view *v, size_t i, const double point[3], double out[4])
{
    static const double nearest = 8; /* nothing is seen from nearer than 1/8 of the distance */
    double q[3];
    for (size_t j = 0; j < 3; j++) q[j] = point[j] - v->middle[3 * i + j];
    out[2] = dot(q, v->towards);
    out[3] = v->scale * v->distance / fmax(v->distance - out[2], v->distance / nearest);
    out[0] = v->x + out[3] * dot(q, v->right);
    out[1] = v->y - out[3] * dot(q, v->top);
}

/* As large as there is room for. */
static void fill(nh_view *v)
{
    static const double across = 0.92, upright = 0.88, most = 3, raised = 0.48;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < v->count; i++)
        for (size_t s = 0; s < v->course->shapes; s++) {
            double p[2][3], r, q[4];
            for (size_t n = v->course->shape[s].flat ? 0 : places(v->course, s, i, p, &r); n-- > 0;) {
                nh_view_see(v, i, p[n], q);
                for (size_t j = 0; j < 2; j++) {
                    low[j] = fmin(low[j], q[j] - r * q[3]);
                    high[j] = fmax(high[j], q[j] + r * q[3]);
                }
            }
        }
    if (!(high[0] >= low[0])) return;
    double room =
        fmin(most, fmin(across * v->wide / fmax(1, high[0] - low[0]), upright * v->high / fmax(1, high[1] - low[1])));
    v->x = v->wide / 2 - room * ((low[0] + high[0]) / 2 - v->x);
    v->y = raised * v->high - room * ((low[1] + high[1]) / 2 - v->y);
    v->scale *= room;
}

nh_view *nh_view_create(const nh_time_series *c, size_t count, double wide, double high)
{
    static const double away = 4, upright = 0.95, squares = 1.5, smallest = 3, dot_of_page = 5, page = 640;
    bool any = false;
    for (size_t s = 0; s < c->shapes; s++) any |= nh_shape_in_space(c->shape[s].kind);
    if (!any || !count) return NULL;
    nh_view *v = nh_alloc(sizeof *v);
    *v = (nh_view){.course = c,
                   .wide = wide,
                   .high = high,
                   .up = upwards(c),
                   .ambient = 0.55,
                   .direct = 0.45,
                   .white = 0.35,
                   .solid = 0.86,
                   .faint = 0.35,
                   .behind = 0.22,
                   .x = wide / 2,
                   .y = high / 2,
                   .dot = fmax(smallest, dot_of_page * wide / page),
                   .count = count,
                   .middle = nh_alloc_array(3 * count, sizeof *v->middle)};
    directions(v);
    double radius = targets(v);
    v->distance = away * radius;
    v->scale = upright * high / 2 / radius;
    fill(v);
    double power = pow(10, floor(log10(radius / squares))), many = radius / squares / power;
    v->pitch = power * (many >= 5 ? 5 : many >= 2 ? 2 : 1);
    return v;
}

void nh_view_free(nh_view *v)
{
    if (!v) return;
    nh_free(v->middle);
    nh_free(v);
}
