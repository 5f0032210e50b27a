#include "integrals/crossings.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "integrals/exact_points.h"
#include "system/sample.h"

enum { lines = 16, wanted = 6, steps_out = 31, grid = 2 * steps_out + 1, halvings = 80, bits = 192 };
static const double first_step = 0.08, ratio = 1.25; /* in half widths of the box: out to 0.08 * 1.25^30 = 65 of them */
static const double depth[NH_CROSSING_DEPTHS] = {1.0 / (1 << 12), 1.0 / (1 << 24), 1.0 / (1LL << 36)};

/* One line z = origin + s direction, and the walls' functions along it. */
typedef struct {
    const nh_model *o;
    const nh_walls *walls;
    size_t explicit_width, found[NH_MOST_WALLS];
    nh_tape *tape;      /* per wall: g, then its derivatives by (t, q, w) */
    nh_tape_work *work;
    nh_ball *ball;
    nh_ex *rate;        /* Gamma: 1, rho, a */
    double *origin, *direction, *z, *out, *half;
    nh_arena *arena;
    nh_crossings list;
} finder;

/* The functions of all walls at s into f, their derivatives along the line into slope; false where they are not
 * finite or there is no point. */
static bool at(finder *x, double s, double *f, double *slope)
{
    for (size_t j = 0; j < x->explicit_width; j++) x->z[j] = x->origin[j] + s * x->direction[j];
    if (!nh_chart_complete(x->o->chart, x->z)) return false;
    nh_tape_eval(x->tape, x->work, x->z, x->out);
    for (size_t i = 0; i < x->walls->count; i++) {
        const double *g = x->out + i * (1 + x->explicit_width);
        f[i] = g[0];
        slope[i] = 0;
        for (size_t j = 0; j < x->explicit_width; j++) slope[i] += g[1 + j] * x->direction[j];
    }
    return true;
}

/* Where wall i's function (or its slope) changes its sign between a and b; false when it does so at a pole. */
static bool halve(finder *x, size_t i, bool of_slope, double a, double b, double *where)
{
    double f[NH_MOST_WALLS], slope[NH_MOST_WALLS], fa = 0, fb = 0, largest;
    for (int k = 0; k < 2; k++) {
        if (!at(x, k ? b : a, f, slope)) return false;
        *(k ? &fb : &fa) = of_slope ? slope[i] : f[i];
    }
    largest = fmax(fabs(fa), fabs(fb));
    for (int k = 0; k < halvings; k++) {
        double middle = a + (b - a) / 2;
        if (middle == a || middle == b) break;
        if (!at(x, middle, f, slope)) return false;
        double value = of_slope ? slope[i] : f[i];
        bool left = value * fa > 0;
        *(left ? &a : &b) = middle;
        *(left ? &fa : &fb) = value;
    }
    *where = a + (b - a) / 2;
    return fmax(fabs(fa), fabs(fb)) < 1e-4 * largest;
}

/* ---- do motions arrive there? ---- */

typedef struct {
    double speed, strength; /* Gamma(g)/|grad g|, max |Gamma|, both in units of the box */
} passage;

static bool passage_at(finder *x, nh_ex g, double *z, passage *p)
{
    double along = 0, size = 0, radius;
    p->strength = 0;
    if (!nh_exact_at(x->o, x->ball, z)) return false;
    for (size_t j = 0; j < x->explicit_width; j++) {
        double slope, rate;
        if (!nh_ball_value(x->ball, nh_diff(x->o->dag, g, x->o->chart->symbol[j]), &slope, &radius)) return false;
        if (!nh_ball_value(x->ball, x->rate[j], &rate, &radius)) return false;
        along += slope * rate;
        size += pow(slope * x->half[j], 2);
        p->strength = fmax(p->strength, fabs(rate) / x->half[j]);
    }
    p->speed = along / sqrt(size);
    return size > 0 && isfinite(p->speed);
}

/* From one side at least motions arrive. */
static bool is_reached(finder *x, nh_crossing *c)
{
    passage far[2], near[2];
    for (int side = 0; side < 2; side++) {
        if (!passage_at(x, c->wall, c->point[side][1], &far[side])
            || !passage_at(x, c->wall, c->point[side][2], &near[side])) return false;
        bool stops = !(fabs(near[side].speed) > fabs(far[side].speed) / 2);
        bool diverges = near[side].strength * depth[2] > far[side].strength * depth[1] / 2;
        if (stops || diverges) return false;
    }
    return near[1].speed < 0 || (c->touches ? near[0].speed < 0 : near[0].speed > 0);
}

static void keep(finder *x, size_t i, double s, bool touches)
{
    double f[NH_MOST_WALLS], slope[NH_MOST_WALLS];
    nh_crossing c = {.wall = x->walls->e[i], .touches = touches};
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++) {
            if (!at(x, s + (side ? depth[k] : -depth[k]), f, slope)) return;
            int to = touches ? side : f[i] > 0;
            c.point[to][k] = nh_arena_alloc(x->arena, x->o->width * sizeof(double));
            memcpy(c.point[to][k], x->z, x->o->width * sizeof(double));
        }
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++)
            if (!c.point[side][k]) return; /* the function has one sign so near to where it seemed to change it */
    if (!is_reached(x, &c)) return;
    x->list.item[x->list.count++] = c;
    x->found[i]++;
}

/* ---- along one line ---- */

static void look_between(finder *x, size_t i, const double *s, const double *f, const double *slope)
{
    double where, value[NH_MOST_WALLS], ignored[NH_MOST_WALLS];
    if (x->found[i] == wanted || !isfinite(f[0]) || !isfinite(f[1])) return;
    if (f[0] * f[1] < 0) {
        if (halve(x, i, false, s[0], s[1], &where)) keep(x, i, where, false);
    } else if (slope[0] * slope[1] < 0 && halve(x, i, true, s[0], s[1], &where) && at(x, where, value, ignored)) {
        if (fabs(value[i]) < 1e-9 * fmax(fabs(f[0]), fabs(f[1]))) keep(x, i, where, true);
    }
}

static double grid_point(size_t k)
{
    if (k == steps_out) return 0;
    return k > steps_out ? first_step * pow(ratio, (double)(k - steps_out - 1))
        : -first_step * pow(ratio, (double)(steps_out - 1 - k));
}

static void follow(finder *x)
{
    size_t n = x->walls->count;
    double f[2][NH_MOST_WALLS], slope[2][NH_MOST_WALLS], s[2] = {0, 0};
    bool before = false;
    for (size_t k = 0; k < grid; k++) {
        s[1] = grid_point(k);
        bool here = at(x, s[1], f[1], slope[1]);
        for (size_t i = 0; i < n && here && before; i++)
            look_between(x, i, s, (double[]){f[0][i], f[1][i]}, (double[]){slope[0][i], slope[1][i]});
        before = here;
        s[0] = s[1];
        memcpy(f[0], f[1], n * sizeof **f);
        memcpy(slope[0], slope[1], n * sizeof **slope);
    }
}

static void create(finder *x)
{
    const nh_model *o = x->o;
    size_t width = x->explicit_width, n = x->walls->count, k = 0;
    nh_ex *e = nh_alloc_array(n * (1 + width) + 1, sizeof *e);
    for (size_t i = 0; i < n; i++) {
        e[k++] = x->walls->e[i];
        for (size_t j = 0; j < width; j++) e[k++] = nh_diff(o->dag, x->walls->e[i], o->chart->symbol[j]);
    }
    x->tape = nh_model_tape(o, k, e);
    x->work = nh_tape_work_create(x->tape);
    x->out = nh_alloc_array(k + 1, sizeof *x->out);
    nh_free(e);
    x->rate = nh_alloc_array(width, sizeof *x->rate);
    x->rate[0] = nh_int(o->dag, 1);
    memcpy(x->rate + 1, o->rho, o->m * sizeof *x->rate);
    memcpy(x->rate + 1 + o->m, o->a, o->n * sizeof *x->rate);
    x->ball = nh_ball_create(o->dag, bits);
    nh_exact_parameters(o, x->ball);
    x->z = nh_alloc_array(4 * o->width, sizeof *x->z);
    x->origin = x->z + o->width;
    x->direction = x->origin + o->width;
    x->half = x->direction + o->width;
    for (size_t j = 0; j < width; j++) x->half[j] = (o->chart->high[j] - o->chart->low[j]) / 2;
}

static void clear(finder *x)
{
    nh_free(x->z);
    nh_ball_free(x->ball);
    nh_free(x->rate);
    nh_free(x->out);
    nh_tape_work_free(x->work);
    nh_tape_free(x->tape);
}

nh_crossings nh_crossings_find(const nh_model *o, const nh_walls *walls, uint64_t *state, nh_arena *arena)
{
    finder x = {.o = o, .walls = walls, .explicit_width = o->width - o->chart->implicit, .arena = arena};
    if (walls->count == 0) return x.list;
    create(&x);
    x.list.item = nh_arena_alloc(arena, walls->count * wanted * sizeof *x.list.item);
    for (size_t line = 0; line < lines; line++) {
        for (size_t j = 0; j < o->width; j++) {
            bool free = j < x.explicit_width;
            x.origin[j] = o->chart->low[j] + (o->chart->high[j] - o->chart->low[j]) * nh_random(state);
            x.direction[j] = free ? x.half[j] * (2 * nh_random(state) - 1) : 0;
            x.z[j] = x.origin[j];
        }
        follow(&x);
    }
    clear(&x);
    return x.list;
}
