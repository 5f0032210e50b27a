#include "integrals/crossings.h"

#include <math.h>

#include "graph/dag.h"
#include "graph/diff.h"
#include "integrals/exact_points.h"
#include "system/sample.h"

enum { lines = 16, wanted = 6, steps = 40, halvings = 60, bits = 192 };

typedef struct {
    const nh_model *o;
    nh_tape *tape;
    nh_tape_work *work;
    double *origin, *direction, *z;
} line;

static double radicand_at(line *l, double s)
{
    double R = NAN;
    for (size_t j = 0; j < l->o->width; j++) l->z[j] = l->origin[j] + s * l->direction[j];
    nh_tape_eval(l->tape, l->work, l->z, &R);
    return R;
}

/* Where the radicand vanishes along the line; 0: nowhere. */
static double end_of(line *l)
{
    double here = 0, there = 1.0 / steps;
    for (int k = 0; k < steps && radicand_at(l, there) > 0; k++) here = there, there *= 1.5;
    if (!(radicand_at(l, there) <= 0)) return 0;
    for (int k = 0; k < halvings; k++) {
        double middle = here + (there - here) / 2;
        *(radicand_at(l, middle) > 0 ? &here : &there) = middle;
    }
    return here;
}

static bool values(const nh_model *model, nh_ball *ball, nh_ex e, double *const point[NH_CROSSING_DEPTHS],
                   double value[NH_CROSSING_DEPTHS])
{
    double radius;
    for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++)
        if (!nh_exact_at(model, ball, point[k]) || !nh_ball_value(ball, e, &value[k], &radius)) return false;
    return true;
}

/* Is `other` the same number, and not 0, but for a fifth? */
static bool agree(double number, double other)
{
    static const double same = 0.2;
    return number != 0 && fabs(number - other) < same * fabs(number);
}

/* Does the rate of sqrt(R) have a nonzero limit there?  It does not change nearer and nearer to the end. */
static bool passes(const nh_model *model, nh_ball *ball, nh_ex rate, double *const point[NH_CROSSING_DEPTHS],
                   double *limit)
{
    double value[NH_CROSSING_DEPTHS];
    if (!values(model, ball, rate, point, value)) return false;
    *limit = value[NH_CROSSING_DEPTHS - 1];
    return agree(*limit, value[NH_CROSSING_DEPTHS - 2]);
}

static bool take(line *l, nh_ball *ball, nh_ex rate, double s, nh_crossing *c, nh_arena *arena)
{
    static const double distance[NH_CROSSING_DEPTHS] = {1e-4, 1e-7, 1e-10};
    size_t width = l->o->width;
    for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++) {
        c->point[0][k] = c->point[1][k] = nh_arena_alloc(arena, width * sizeof(double));
        for (size_t j = 0; j < width; j++) c->point[0][k][j] = l->origin[j] + s * (1 - distance[k]) * l->direction[j];
    }
    double limit;
    return passes(l->o, ball, rate, c->point[0], &limit);
}

static void draw(line *l, uint64_t *state)
{
    const nh_chart *c = l->o->chart;
    for (size_t j = 0; j < l->o->width; j++) {
        l->origin[j] = c->low[j] + (c->high[j] - c->low[j]) * nh_random(state);
        l->direction[j] = (c->high[j] - c->low[j]) * (2 * nh_random(state) - 1);
    }
}

/* 2 a u + b, or u alone where b = 0.  It has the other sign on the other branch: u is -u - b/a there. */
static void describe(const nh_model *model, nh_branch_end *end)
{
    nh_dag *d = model->dag;
    const nh_chart *c = model->chart;
    const nh_root *r = &c->root_of[0];
    nh_ex linear = nh_mul(d, nh_int(d, c->branch), r->value), slope = nh_diff(d, linear, r->symbol),
          zero = nh_int(d, 0), b = nh_substitute(d, linear, 1, &r->symbol, &zero);
    end->root = r->symbol;
    end->rate = nh_model_gamma(model, nh_sqrt(d, c->radicand));
    end->wall = nh_is_zero(d, b) ? r->symbol : linear;
    end->there = nh_neg(d, nh_add(d, c->rho[r->coordinate], nh_div(d, nh_mul(d, nh_int(d, 2), b), slope)));
}

nh_branch_end nh_branch_end_of(const nh_model *model, const nh_options *options, nh_arena *arena)
{
    nh_branch_end out = {0};
    const nh_chart *c = model->chart;
    if (!c->branch || c->implicit || c->roots == 0) return out;
    uint64_t state = (uint64_t)options->seed + 7919;
    nh_ball *ball = nh_ball_create(model->dag, bits);
    nh_exact_parameters(model, ball);
    line l = {
        .o = model, .tape = nh_model_tape(model, 1, &c->radicand), .z = nh_alloc_array(3 * model->width, sizeof *l.z)};
    l.work = nh_tape_work_create(l.tape);
    l.origin = l.z + model->width;
    l.direction = l.origin + model->width;
    describe(model, &out);
    out.crossings.item = nh_arena_alloc(arena, wanted * sizeof *out.crossings.item);
    for (size_t k = 0; k < lines && out.crossings.count < wanted; k++) {
        nh_crossing *next = &out.crossings.item[out.crossings.count];
        *next = (nh_crossing){.wall = out.wall};
        draw(&l, &state);
        double s = radicand_at(&l, 0) > 0 ? end_of(&l) : 0;
        out.crossings.count += s > 0 && take(&l, ball, out.rate, s, next, arena);
    }
    nh_tape_work_free(l.work);
    nh_tape_free(l.tape);
    nh_free(l.z);
    nh_ball_free(ball);
    return out;
}

bool nh_branch_end_is_at(const nh_model *model, const nh_branch_end *end, nh_ball *ball, const nh_crossing *c)
{
    static const double falls = 1e-3; /* R falls as the square of the distance, which is 2^-12 of the one before */
    double R[NH_CROSSING_DEPTHS], limit[2];
    if (!end->root || !c->touches) return false;
    for (int side = 0; side < 2; side++) {
        if (!values(model, ball, model->chart->radicand, c->point[side], R)) return false;
        for (size_t k = 1; k < NH_CROSSING_DEPTHS; k++)
            if (!(fabs(R[k]) < falls * fabs(R[k - 1]))) return false;
        if (!passes(model, ball, end->rate, c->point[side], &limit[side])) return false;
    }
    return agree(limit[0], limit[1]);
}

nh_ex nh_branch_end_beyond(const nh_model *model, const nh_branch_end *end, nh_ex phi)
{
    if (!end->root) return phi;
    return nh_substitute(model->dag, nh_chart_shown(model->chart, phi), 1, &end->root, &end->there);
}
