/* crossings: how a crossing is found, and when it is kept.
 *
 *     follow          along a line or a step of a motion: g changes its sign between two places (Brent's method), or
 *                     its slope does where g touches 0
 *     keep            six points of (t, q, w, u), at the distances 2^-12, 2^-24, 2^-36 on both sides:
 *
 *                         x----------x------x--|--x------x----------x         g = 0 at |
 *                      point[0][0]    [1]   [2]  [1][2]   [1]   point[1][0]
 *     is_reached      do motions arrive: does Gamma(g)/|grad g| keep its sign and size towards the wall?
 *     is_open_to      does a way lead there from the sampling box?
 *
 * First come motions, then lines in the chart, then lines in (t, q, v). */
#include "integrals/crossings.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/diff.h"
#include "integrals/exact_points.h"
#include "integrals/open_way.h"
#include "integrals/projected_points.h"
#include "system/sample.h"

enum {
    lines = 48,
    least_lines = 16,
    motions = 12,
    motion_steps = 240,
    wanted = 2,
    least_wanted = 6,
    most_wanted = 32,
    tries = 4, /* of one part of a wall; of a wall */
    steps_out = 31,
    grid = 2 * steps_out + 1,
    most_steps = 200,
    bits = 192
};
static const double long_rates = 2e4; /* instructions */
/* in half widths of the box: the lines reach 0.08 * 1.25^30 = 65 of them */
static const double first_step = 0.08, ratio = 1.25, digits = 4e-16;
static const double depth[NH_CROSSING_DEPTHS] = {1.0 / (1 << 12), 1.0 / (1 << 24), 1.0 / (1LL << 36)};

/* One line, and the walls' functions along it: z = origin + s direction, or the same for (t, q, v), with v projected
 * onto the constraints. */
typedef struct {
    const nh_model *o;
    const nh_walls *walls;
    size_t explicit_width, found[NH_MOST_WALLS], tried[NH_MOST_WALLS], most; /* most crossings of a wall */
    uint64_t key[NH_MOST_WALLS][most_wanted]; /* of the crossings found: which part of the wall */
    nh_tape *tape; /* per wall: g, then its derivatives by (t, q, w); then what divides walls into parts */
    nh_tape_work *work;
    nh_ball *ball;
    nh_ex *rate;    /* Gamma: 1, rho, a */
    nh_tape *rates; /* the same */
    nh_tape_work *rates_work;
    double *origin, *direction, *z, *out, *half, *middle, *passing;
    nh_projector *projector; /* NULL: lines in the chart */
    double *position;        /* t, q, v */
    nh_open_way *way;
    double *begin; /* a state of the box; NULL: the line is a part of a motion that began there */
    nh_arena *arena;
    nh_crossings list;
} finder;

/* The point z of the line at s; false where there is none. */
static bool point_at(finder *x, double s, bool exact)
{
    size_t m = x->o->m;
    if (!x->projector) {
        for (size_t j = 0; j < x->explicit_width; j++) x->z[j] = x->origin[j] + s * x->direction[j];
        return nh_chart_complete(x->o->chart, x->z);
    }
    for (size_t j = 0; j < 1 + 2 * m; j++) x->position[j] = x->origin[j] + s * x->direction[j];
    return exact ? nh_projected_exact_point(x->projector, x->position, x->position + 1 + m, x->z)
                 : nh_projected_point(x->projector, x->position, x->position + 1 + m, x->z);
}

/* Writes the functions of all walls at z to f, and their derivatives along the line to slope; 0 where these depend on
 * the change of the velocities along the line, which is unknown. */
static void evaluate(finder *x, double *f, double *slope)
{
    size_t known = x->projector ? 1 + x->o->m : x->explicit_width;
    nh_tape_eval(x->tape, x->work, x->z, x->out);
    for (size_t i = 0; i < x->walls->count; i++) {
        const double *g = x->out + i * (1 + x->explicit_width);
        bool complete = true;
        f[i] = g[0];
        slope[i] = 0;
        for (size_t j = 0; j < known; j++) slope[i] += g[1 + j] * x->direction[j];
        for (size_t j = known; j < x->explicit_width; j++) complete &= g[1 + j] == 0;
        if (!complete) slope[i] = 0;
    }
}

/* Both at s. */
static bool at(finder *x, double s, double *f, double *slope)
{
    if (!point_at(x, s, false)) return false;
    evaluate(x, f, slope);
    return true;
}

/* A wall's function, or its slope, along the line. */
typedef struct {
    finder *x;
    size_t wall;
    bool of_slope, failed;
} quantity;

static double value_of(double s, void *context)
{
    quantity *q = context;
    double f[NH_MOST_WALLS], slope[NH_MOST_WALLS];
    q->failed = q->failed || !at(q->x, s, f, slope);
    return q->failed ? 0 : q->of_slope ? slope[q->wall] : f[q->wall]; /* 0 ends the search */
}

/* Where it changes its sign between a and b; false when it does so at a pole. */
static bool find_change(quantity *q, double a, double b, double *where)
{
    double largest = fmax(fabs(value_of(a, q)), fabs(value_of(b, q)));
    gsl_function function = {value_of, q};
    gsl_root_fsolver *solver = nh_memory_got(gsl_root_fsolver_alloc(gsl_root_fsolver_brent));
    bool good = !q->failed && gsl_root_fsolver_set(solver, &function, a, b) == GSL_SUCCESS, more = good;
    for (int k = 0; k < most_steps && more && good; k++) {
        good = gsl_root_fsolver_iterate(solver) == GSL_SUCCESS && !q->failed;
        double low = gsl_root_fsolver_x_lower(solver), high = gsl_root_fsolver_x_upper(solver);
        more = high - low > digits * fmax(fabs(low), fabs(high));
    }
    *where = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return good && fabs(value_of(*where, q)) < 1e-4 * largest;
}

/* ---- do motions arrive there? ---- */

typedef struct {
    double speed, strength; /* Gamma(g)/|grad g|, max |Gamma|, both in units of the box */
} passage;

/* From the derivatives of g and the components of Gamma. */
static bool passage_of(const finder *x, const double *slope, const double *rate, passage *p)
{
    double along = 0, size = 0;
    p->strength = 0;
    for (size_t j = 0; j < x->explicit_width; j++) {
        along += slope[j] * rate[j];
        size += pow(slope[j] * x->half[j], 2);
        p->strength = fmax(p->strength, fabs(rate[j]) / x->half[j]);
    }
    p->speed = along / sqrt(size);
    return size > 0 && isfinite(p->speed);
}

/* The same at z, by ball arithmetic. */
static bool passage_at(finder *x, nh_ex g, double *z, passage *p)
{
    double radius, *slope = x->passing, *rate = slope + x->explicit_width;
    if (!nh_exact_at(x->o, x->ball, z)) return false;
    for (size_t j = 0; j < x->explicit_width; j++) {
        if (!nh_ball_value(x->ball, nh_diff(x->o->dag, g, x->o->chart->symbol[j]), &slope[j], &radius)) return false;
        if (!nh_ball_value(x->ball, x->rate[j], &rate[j], &radius)) return false;
    }
    return passage_of(x, slope, rate, p);
}

/* Motions come to rest before they arrive, or the equations have a pole there; from the distances k - 1 and k. */
static bool ends(passage far, passage near, size_t k, double slower, double stronger)
{
    return !(fabs(near.speed) > slower * fabs(far.speed)) ||
           near.strength * depth[k] > stronger * far.strength * depth[k - 1];
}

/* Motions begin in the user's interval for t, and go on from there. */
static bool is_before(const nh_system *system, const double *z)
{
    for (size_t i = 0; i < system->intervals; i++)
        if (system->interval[i].symbol == system->t && z[0] < system->interval[i].low) return true;
    return false;
}

/* Do motions arrive from at least one side? */
static bool is_reached(finder *x, nh_crossing *c)
{
    passage far[2], near[2];
    if (is_before(x->o->system, c->point[0][0])) return false;
    for (int side = 0; side < 2; side++) {
        if (!passage_at(x, c->wall, c->point[side][1], &far[side]) ||
            !passage_at(x, c->wall, c->point[side][2], &near[side]))
            return false;
        if (ends(far[side], near[side], 2, 0.5, 0.5)) return false;
    }
    return near[1].speed < 0 || (c->touches ? near[0].speed < 0 : near[0].speed > 0);
}

/* In doubles, from all distances and by a wide margin: do motions not arrive from one side?  Where digits cancel the
 * largest distance does not agree with the others. */
static bool is_clearly_unreached(finder *x, size_t i, double s)
{
    double f[NH_MOST_WALLS], slope[NH_MOST_WALLS];
    passage p[NH_CROSSING_DEPTHS];
    bool unreached = false;
    for (int side = 0; side < 2 && !unreached; side++) {
        unreached = true;
        for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++) {
            if (!point_at(x, s + (side ? depth[k] : -depth[k]), false)) return false;
            evaluate(x, f, slope);
            nh_tape_eval(x->rates, x->rates_work, x->z, x->passing);
            if (!passage_of(x, x->out + i * (1 + x->explicit_width) + 1, x->passing, &p[k])) return false;
            unreached &= k == 0 || ends(p[k - 1], p[k], k, 0.125, 0.75);
        }
    }
    return unreached;
}

/* Which part of wall i is it: the signs of the other walls and of what divides walls, and how far from the box. */
static uint64_t part_of(finder *x, size_t i, double s)
{
    size_t n = x->walls->count, step = 1 + x->explicit_width;
    uint64_t key = 0;
    double away = 0;
    if (!point_at(x, s, false)) return 0;
    nh_tape_eval(x->tape, x->work, x->z, x->out);
    for (size_t j = 0; j < n; j++) key |= (uint64_t)(j != i && x->out[j * step] > 0) << j;
    for (size_t j = 0; j < x->walls->parts; j++) key |= (uint64_t)(x->out[n * step + j] > 0) << (n + j);
    for (size_t j = 0; j < x->explicit_width; j++)
        away = fmax(away, fabs(x->z[j] - x->middle[j]) / fmax(x->half[j], DBL_MIN));
    return key | (uint64_t)(away > 2 ? 1 + (away > 8) : 0) << (NH_MOST_WALLS + NH_MOST_WALL_PARTS);
}

/* Are more crossings of this part of the wall wanted?  Of each as many as of the others. */
static bool is_wanted(const finder *x, size_t i, uint64_t key)
{
    size_t same = 0;
    for (size_t k = 0; k < x->found[i]; k++) same += x->key[i][k] == key;
    return same < wanted && x->found[i] < x->most && x->tried[i] < tries * x->most;
}

/* Does the straight way from the box to this state cross no wall at which motions do not arrive, and no pole of L? */
static bool is_open_to(finder *x, const double *to)
{
    enum { places = 32 };
    finder w = *x; /* with a line of its own */
    size_t n = x->explicit_width, width = x->o->width;
    double f[2][NH_MOST_WALLS], slope[NH_MOST_WALLS], where;
    bool open = nh_open_way_leads(x->way, x->begin, to), before = false;
    w.projector = NULL;
    w.origin = x->begin;
    w.z = nh_alloc_array(2 * width, sizeof *w.z);
    w.direction = w.z + width;
    for (size_t j = 0; j < width; j++) w.direction[j] = j < n ? to[j] - x->begin[j] : 0, w.z[j] = x->begin[j];
    for (int k = 0; k < places && open; k++) { /* not up to the wall itself */
        bool here = at(&w, (double)k / places, f[k % 2], slope);
        for (size_t i = 0; i < x->walls->count && here && before && open; i++)
            if (f[0][i] * f[1][i] < 0 &&
                find_change(&(quantity){&w, i, false, false}, (double)(k - 1) / places, (double)k / places, &where))
                open = !is_clearly_unreached(&w, i, where);
        before = here;
    }
    nh_free(w.z);
    return open;
}

/* Keeps the change of sign of wall i at s: points at all depths on both sides, if the place is wanted and motions
 * reach it. */
static void keep(finder *x, size_t i, double s, bool touches)
{
    uint64_t key = part_of(x, i, s);
    if (!is_wanted(x, i, key)) return;
    x->tried[i]++;
    if (is_clearly_unreached(x, i, s)) return;
    double f[NH_MOST_WALLS], slope[NH_MOST_WALLS];
    nh_crossing c = {.wall = x->walls->e[i], .touches = touches};
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++) {
            if (!point_at(x, s + (side ? depth[k] : -depth[k]), true)) return;
            evaluate(x, f, slope);
            int to = touches ? side : f[i] > 0;
            c.point[to][k] = nh_arena_alloc(x->arena, x->o->width * sizeof(double));
            memcpy(c.point[to][k], x->z, x->o->width * sizeof(double));
        }
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++)
            if (!c.point[side][k]) return; /* nearer to the supposed change the function has one sign */
    if (!is_reached(x, &c) || (x->begin && !is_open_to(x, c.point[0][0]))) return;
    x->list.item[x->list.count++] = c;
    x->key[i][x->found[i]++] = key;
}

/* ---- along one line ---- */

static void look_between(finder *x, size_t i, const double *s, const double *f, const double *slope)
{
    double where, value[NH_MOST_WALLS], ignored[NH_MOST_WALLS];
    if (x->found[i] == x->most || !isfinite(f[0]) || !isfinite(f[1])) return;
    if (f[0] * f[1] < 0) {
        if (find_change(&(quantity){x, i, false, false}, s[0], s[1], &where)) keep(x, i, where, false);
    } else if (slope[0] * slope[1] < 0 && find_change(&(quantity){x, i, true, false}, s[0], s[1], &where) &&
               at(x, where, value, ignored)) {
        if (fabs(value[i]) < 1e-9 * fmax(fabs(f[0]), fabs(f[1]))) keep(x, i, where, true);
    }
}

/* Place k of a line: 0 in the middle, to both sides in a geometric sequence. */
static double grid_point(size_t k)
{
    if (k == steps_out) return 0;
    return k > steps_out ? first_step * pow(ratio, (double)(k - steps_out - 1))
                         : -first_step * pow(ratio, (double)(steps_out - 1 - k));
}

/* Looks for crossings at the places s of the line, in ascending order. */
static void follow(finder *x, size_t count, const double *place)
{
    size_t n = x->walls->count;
    double f[2][NH_MOST_WALLS], slope[2][NH_MOST_WALLS], s[2] = {0, 0};
    bool before = false;
    for (size_t k = 0; k < count; k++) {
        s[1] = place[k];
        bool here = at(x, s[1], f[1], slope[1]);
        for (size_t i = 0; i < n && here && before; i++)
            look_between(x, i, s, (double[]){f[0][i], f[1][i]}, (double[]){slope[0][i], slope[1][i]});
        before = here;
        s[0] = s[1];
        memcpy(f[0], f[1], n * sizeof **f);
        memcpy(slope[0], slope[1], n * sizeof **slope);
    }
}

/* All grid places of the line. */
static void follow_line(finder *x)
{
    double place[grid];
    for (size_t k = 0; k < grid; k++) place[k] = grid_point(k);
    follow(x, grid, place);
}

/* ---- along a motion ---- */

/* The rates at x->origin, into x->passing; the time in which no state changes by more than a part of its way so far,
 * or of the box. */
static double time_of_step(finder *x, const double *begin)
{
    static const double part = 0.15;
    double time = INFINITY;
    if (!point_at(x, 0, false)) return NAN;
    nh_tape_eval(x->rates, x->rates_work, x->z, x->passing);
    for (size_t j = 0; j < x->explicit_width; j++) {
        double way = fmax(x->half[j], fabs(x->origin[j] - begin[j]));
        if (!isfinite(x->passing[j])) return NAN;
        if (x->passing[j] != 0) time = fmin(time, part * way / fabs(x->passing[j]));
    }
    return time;
}

/* By the midpoint rule, which is enough to see where motions go.  Every step is a short line. */
static void follow_motion(finder *x, double way)
{
    size_t n = x->explicit_width;
    double *begin = nh_alloc_array(2 * n, sizeof *begin), *here = begin + n;
    memcpy(begin, x->origin, n * sizeof *begin);
    for (int k = 0; k < motion_steps; k++) {
        memset(x->direction, 0, x->o->width * sizeof *x->direction);
        double time = way * time_of_step(x, begin);
        if (!isfinite(time)) break;
        memcpy(here, x->origin, n * sizeof *here);
        for (size_t j = 0; j < n; j++) x->origin[j] += time / 2 * x->passing[j];
        if (!point_at(x, 0, false)) break;
        nh_tape_eval(x->rates, x->rates_work, x->z, x->passing);
        for (size_t j = 0; j < n; j++) x->direction[j] = time * x->passing[j];
        memcpy(x->origin, here, n * sizeof *here);
        follow(x, 2, (double[]){0, 1});
        bool finite = true;
        for (size_t j = 0; j < n; j++) finite &= isfinite(x->origin[j] += x->direction[j]);
        if (!finite) break;
        for (size_t j = n; j < x->o->width; j++) x->origin[j] = x->z[j]; /* where implicit velocities are sought */
    }
    nh_free(begin);
}

/* One tape per wall of g and its derivatives by (t, q, w), and one of Gamma. */
static void create(finder *x)
{
    const nh_model *model = x->o;
    size_t width = x->explicit_width, n = x->walls->count, k = 0;
    nh_ex *e = nh_alloc_array(n * (1 + width) + x->walls->parts + 1, sizeof *e);
    for (size_t i = 0; i < n; i++) {
        e[k++] = x->walls->e[i];
        for (size_t j = 0; j < width; j++) e[k++] = nh_diff(model->dag, x->walls->e[i], model->chart->symbol[j]);
    }
    for (size_t i = 0; i < x->walls->parts; i++) e[k++] = x->walls->part[i];
    x->tape = nh_model_tape(model, k, e);
    x->work = nh_tape_work_create(x->tape);
    x->out = nh_alloc_array(k + 1, sizeof *x->out);
    nh_free(e);
    x->rate = nh_alloc_array(width, sizeof *x->rate);
    x->rate[0] = nh_int(model->dag, 1);
    memcpy(x->rate + 1, model->rho, model->m * sizeof *x->rate);
    memcpy(x->rate + 1 + model->m, model->a, model->n * sizeof *x->rate);
    x->rates = nh_model_tape(model, width, x->rate);
    x->rates_work = nh_tape_work_create(x->rates);
    x->passing = nh_alloc_array(2 * width, sizeof *x->passing);
    x->ball = nh_ball_create(model->dag, bits);
    nh_exact_parameters(model, x->ball);
    size_t room = model->width > 1 + 2 * model->m ? model->width : 1 + 2 * model->m;
    x->z = nh_alloc_array(6 * room, sizeof *x->z);
    x->origin = x->z + room;
    x->direction = x->origin + room;
    x->half = x->direction + room;
    x->position = x->half + room;
    x->middle = x->position + room;
    for (size_t j = 0; j < width; j++) x->half[j] = (model->chart->high[j] - model->chart->low[j]) / 2;
    for (size_t j = 0; j < width; j++) x->middle[j] = (model->chart->high[j] + model->chart->low[j]) / 2;
}

static void clear(finder *x)
{
    nh_free(x->z);
    nh_ball_free(x->ball);
    nh_free(x->passing);
    nh_tape_work_free(x->rates_work);
    nh_tape_free(x->rates);
    nh_free(x->rate);
    nh_free(x->out);
    nh_tape_work_free(x->work);
    nh_tape_free(x->tape);
}

/* A line through the chart's box.  `wide`: through a place far from it, by the distance of the box from zero. */
static void draw_in_chart(finder *x, bool wide, uint64_t *state)
{
    static const double farthest = 32;
    const nh_chart *c = x->o->chart;
    double far = wide ? pow(farthest, nh_random(state)) : 0;
    for (size_t j = 0; j < x->o->width; j++) {
        bool free = j < x->explicit_width;
        x->origin[j] = c->low[j] + (c->high[j] - c->low[j]) * nh_random(state);
        if (x->begin) x->begin[j] = x->origin[j];
        double scale = free ? wide ? far * fmax(x->half[j], fabs(x->middle[j])) : x->half[j] : 0;
        if (wide) x->origin[j] += scale * (2 * nh_random(state) - 1);
        x->direction[j] = scale * (2 * nh_random(state) - 1);
        x->z[j] = x->origin[j];
    }
}

/* One through the box of t, q and v. */
static void draw_in_velocities(finder *x, uint64_t *state)
{
    const nh_system *system = x->o->system;
    for (size_t j = 0; j < 1 + 2 * x->o->m; j++) {
        double low, high;
        const nh_coordinate *c = j ? &system->coordinate[(j - 1) % x->o->m] : NULL;
        nh_chart_range(x->o->chart, !c ? system->t : j <= x->o->m ? c->q : c->v, &low, &high);
        x->origin[j] = low + (high - low) * nh_random(state);
        x->direction[j] = (high - low) / 2 * (2 * nh_random(state) - 1);
    }
}

nh_crossings nh_crossings_find(const nh_model *model, const nh_walls *walls, uint64_t *state, nh_arena *arena)
{
    finder x = {.o = model, .walls = walls, .explicit_width = model->width - model->chart->implicit, .arena = arena};
    if (walls->count == 0) return x.list;
    gsl_set_error_handler_off();
    create(&x);
    x.way = nh_open_way_create(model);
    x.list.item = nh_arena_alloc(arena, 2 * walls->count * most_wanted * sizeof *x.list.item);
    /* of long equations fewer: every crossing costs many of their evaluations */
    double part = fmin(1, long_rates / (double)(1 + nh_tape_length(x.rates)));
    size_t few = (size_t)fmax(lines * part, least_lines);
    x.most = (size_t)fmax(most_wanted * part, least_wanted);
    for (size_t motion = 0; motion < (size_t)(2 * motions * part); motion++) {
        draw_in_chart(&x, false, state);
        follow_motion(&x, motion % 2 ? 1 : -1);
    }
    x.begin = nh_arena_alloc(arena, model->width * sizeof *x.begin);
    for (size_t line = 0; line < few; line++) {
        draw_in_chart(&x, line % 2, state);
        follow_line(&x);
    }
    x.projector = nh_projector_create(model, x.ball);
    memset(x.found, 0, sizeof x.found);
    memset(x.tried, 0, sizeof x.tried);
    for (size_t line = 0; line < lines && x.projector; line++) {
        draw_in_chart(&x, false, state);
        draw_in_velocities(&x, state);
        follow_line(&x);
    }
    nh_projector_free(x.projector);
    nh_open_way_free(x.way);
    clear(&x);
    return x.list;
}
