#include "integrals/region.h"

#include <math.h>
#include <string.h>

#include "base/text.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "integrals/exact_points.h"
#include "integrals/prove.h"

enum { seed_offset = 505 };

/* ---- the list of sides ---- */

static void put(nh_region *r, nh_ex wall, nh_region_kind kind)
{
    for (size_t i = 0; i < r->count; i++)
        if (r->wall[i] == wall) return;
    r->unseen |= r->count == NH_MOST_WALLS;
    if (r->count == NH_MOST_WALLS) return;
    r->wall[r->count] = wall;
    r->kind[r->count++] = kind;
}

static void put_side(nh_region *r, nh_ex wall, int sign) { put(r, wall, sign > 0 ? NH_REGION_ABOVE : NH_REGION_BELOW); }

/* The sides on which products of paired roots have their signs (geometry/model.h). */
static void put_pairs(nh_region *r, const nh_model *model)
{
    for (size_t k = 0; k < model->pairs; k++) put_side(r, model->pair[k].product, model->pair[k].sign);
}

/* 1 where it holds above the wall only, -1: below it only, 0: neither, or there is no such wall. */
static int side_of(const nh_region *r, nh_ex wall)
{
    for (size_t i = 0; i < r->count; i++)
        if (r->wall[i] == wall) return (r->kind[i] == NH_REGION_ABOVE) - (r->kind[i] == NH_REGION_BELOW);
    return 0;
}

/* ---- pieces ---- */

typedef struct {
    const nh_model *o;
    const nh_region *region; /* the side of a wall on which it lies */
    nh_region *chosen;       /* the side on which the first probe of the chart lies, and where it is noted (or NULL) */
} sides;

static nh_ex number_or_none(const sides *s, int sign) { return sign ? nh_int(s->o->dag, sign) : 0; }

static nh_ex sign_in_region(void *sides_, nh_ex u)
{
    const sides *s = sides_;
    int sign = side_of(s->region, u);
    return number_or_none(s, sign ? sign : -side_of(s->region, nh_neg(s->o->dag, u)));
}

static nh_ex sign_at_probe(void *sides_, nh_ex u)
{
    const sides *s = sides_;
    int sign = nh_model_sign_at_probe(s->o, u);
    if (sign && s->chosen) put_side(s->chosen, u, sign);
    return number_or_none(s, sign);
}

nh_ex nh_region_piece(const nh_model *model, const nh_region *region, nh_ex e)
{
    return nh_walls_piece(model->dag, e, sign_in_region, &(sides){.o = model, .region = region});
}

nh_ex nh_region_piece_at_probe(const nh_model *model, nh_ex e, nh_region *chosen)
{
    return nh_walls_piece(model->dag, e, sign_at_probe, &(sides){.o = model, .chosen = chosen});
}

nh_ex nh_region_roots_at_probe(const nh_model *model, nh_ex e, nh_region *chosen)
{
    nh_dag *d = model->dag;
    NH_LIST(base);
    nh_ex outside, inside, before = e;
    sides s = {.o = model, .chosen = chosen};
    e = nh_model_paired_roots(model, e);
    if (e != before && chosen) put_pairs(chosen, model);
    size_t n = model->chart->probes ? nh_radicands_in(d, e, &base) : 0;
    for (size_t i = 0; i < n; i++) {
        bool square = nh_square_split(d, nh_simplify_short(d, base[i], 0), &outside, &inside);
        nh_ex sign = square && nh_kind_of(d, outside) != NH_NUMBER ? sign_at_probe(&s, outside) : 0;
        if (sign) e = nh_substitute_root(d, e, base[i], nh_product(d, 3, (nh_ex[]){sign, outside, nh_sqrt(d, inside)}));
    }
    return e;
}

int nh_region_sign_at_probe(const nh_model *model, nh_ex u, nh_region *chosen)
{
    int sign = nh_model_sign_at_probe(model, u);
    nh_ex wall = nh_model_without_constants(model, u);
    if (sign && chosen && !nh_model_sign_everywhere(model, u))
        put_side(chosen, wall, nh_model_sign_at_probe(model, wall));
    return sign;
}

bool nh_region_has_probe(const nh_model *model, const nh_region *region)
{
    bool has = model->chart->probes > 0;
    for (size_t i = 0; i < region->count && has; i++) {
        int wanted = side_of(region, region->wall[i]);
        has =
            region->kind[i] != NH_REGION_PARTS && (!wanted || nh_model_sign_at_probe(model, region->wall[i]) == wanted);
    }
    return has;
}

/* ---- impulses ---- */

enum { most_directions = 64 };

/* rho^s, which must not jump, and I_s R^s_i, which must vanish; their sizes. */
typedef struct {
    double rho[most_directions], impulse[most_directions], speed, size;
} passage;

/* The mid-point of e's ball. */
static bool value_of(nh_ball *ball, nh_ex e, double *value)
{
    double radius;
    return nh_ball_value(ball, e, value, &radius);
}

/* L, p and rho at one point, and of the wall g: dg/dt along the motion and dg/dq. */
typedef struct {
    double L, p[most_directions], rho[most_directions], rate, slope[most_directions];
} motion_at;

static bool side_at(const nh_model *model, nh_ball *ball, nh_ex g, double *z, motion_at *s)
{
    if (!nh_exact_at(model, ball, z) || !value_of(ball, model->Lbar, &s->L) ||
        !value_of(ball, nh_diff(model->dag, g, model->chart->symbol[0]), &s->rate))
        return false;
    for (size_t i = 0; i < model->m; i++) {
        if (!value_of(ball, model->p[i], &s->p[i]) || !value_of(ball, model->rho[i], &s->rho[i]) ||
            !value_of(ball, nh_diff(model->dag, g, model->chart->symbol[1 + i]), &s->slope[i]))
            return false;
        s->rate += s->slope[i] * s->rho[i];
    }
    return true;
}

/* The values at one distance from the wall. */
static bool passage_at(const nh_model *model, nh_ball *ball, const nh_crossing *c, size_t depth, passage *out)
{
    motion_at below, above;
    *out = (passage){0};
    if (!side_at(model, ball, c->wall, c->point[0][depth], &below) ||
        !side_at(model, ball, c->wall, c->point[1][depth], &above))
        return false;
    for (size_t s = 0; s < model->m; s++) {
        out->rho[s] = above.rho[s] - below.rho[s];
        out->speed = fmax(out->speed, fabs(above.rho[s]));
    }
    for (size_t i = 0; i < model->n; i++)
        for (size_t s = 0; s < model->m; s++) {
            double R;
            if (!value_of(ball, model->R[s * model->n + i], &R)) return false;
            out->impulse[i] += R * ((above.p[s] - below.p[s]) * above.rate - (above.L - below.L) * above.slope[s]);
            out->size = fmax(out->size, fabs(R) * fmax(fabs(above.p[s] * above.rate), fabs(above.L * above.slope[s])));
        }
    return true;
}

/* Does the value neither fall towards the wall nor count as rounding? */
static bool stays(size_t n, const double *far, const double *near, double size)
{
    static const double rounding = 1e-8;
    double most[2] = {0, 0};
    for (size_t i = 0; i < n; i++) most[0] = fmax(most[0], fabs(far[i])), most[1] = fmax(most[1], fabs(near[i]));
    return most[1] > most[0] / 2 && most[1] > rounding * size;
}

/* Is it a function of (t, q), and no cut?  At a cut L is one of the branches of a function that continues. */
static bool may_kick(const nh_model *model, const nh_walls *walls, nh_ex g)
{
    for (size_t i = 0; i < walls->count; i++)
        if (walls->e[i] == g && walls->cut[i]) return false;
    for (size_t j = 1 + model->m; j < model->width; j++)
        if (nh_depends(model->dag, g, model->chart->symbol[j])) return false;
    return model->m <= most_directions;
}

/* Walls at which I_s R^s_i or [rho^s] stays, from one distance to the next nearer one. */
static void find_impulses(const nh_model *model, const nh_options *options, nh_terrain *t)
{
    nh_ball *ball = nh_ball_create(model->dag, (long)options->bits);
    nh_exact_parameters(model, ball);
    for (size_t k = 0; k < t->crossings.count; k++) {
        const nh_crossing *c = &t->crossings.item[k];
        passage far, near;
        bool known = !may_kick(model, &t->walls, c->wall);
        for (size_t i = 0; i < t->impulses; i++) known |= t->impulse[i] == c->wall;
        if (known || !passage_at(model, ball, c, 1, &far) || !passage_at(model, ball, c, 2, &near)) continue;
        if (stays(model->n, far.impulse, near.impulse, near.size) || stays(model->m, far.rho, near.rho, near.speed))
            t->impulse[t->impulses++] = c->wall;
    }
    nh_ball_free(ball);
}

nh_terrain nh_terrain_of(const nh_model *model, const nh_options *options, nh_arena *arena)
{
    nh_terrain out = {0};
    uint64_t state = (uint64_t)options->seed + seed_offset;
    nh_walls_add(&out.walls, model->dag, model->Lbar);
    nh_walls_add(&out.walls, model->dag, model->E);
    for (size_t s = 0; s < model->m; s++) {
        nh_walls_add(&out.walls, model->dag, model->rho[s]);
        if (model->system->has_forces)
            nh_walls_add(&out.walls, model->dag, nh_model_compose(model, model->system->force[s]));
    }
    for (size_t i = 0; i < model->chart->implicit; i++) nh_walls_add(&out.walls, model->dag, model->chart->residual[i]);
    out.crossings = nh_crossings_find(model, &out.walls, &state, arena);
    find_impulses(model, options, &out);
    out.end = nh_branch_end_of(model, options, arena);
    return out;
}

/* The walls of phi that the equations of motion do not have. */
static nh_crossings own_crossings(const nh_model *model, const nh_terrain *terrain, nh_ex phi,
                                  const nh_options *options, nh_arena *arena, bool *unseen)
{
    nh_walls all = terrain->walls, own = {0};
    uint64_t state = (uint64_t)options->seed + 2 * seed_offset;
    nh_walls_add(&all, model->dag, phi);
    *unseen = all.left_out;
    /* ends of roots are not crossed; the lines show that */
    for (size_t i = terrain->walls.count; i < all.count; i++) own.e[own.count++] = all.e[i];
    return nh_crossings_find(model, &own, &state, arena);
}

/* ---- one crossing ---- */

typedef struct {
    const nh_model *o;
    nh_ball *ball;
    const nh_branch_end *end;
    nh_ex phi, beyond, *term; /* beyond: phi on the other branch of the chart's velocities */
    size_t terms, failing;
    double digits;
    nh_ex fails[NH_MOST_WALLS]; /* the walls at which it failed on both sides */
} judge;

/* Does Phi jump: is the difference of its values on the two sides the same nearer to the wall, and no rounding, while
 * Phi stays finite?  It grows where the digits of the points are too few, as those of y'/x' at x' = y' = 0.  `over`:
 * on the second side lies the other branch. */
static bool jumps(judge *j, const nh_crossing *c, bool over)
{
    static const double rounding = 1e-8, growth = 1.3;
    double value[2][NH_CROSSING_DEPTHS], radius, size = 0;
    for (int side = 0; side < 2; side++)
        for (size_t k = 0; k < NH_CROSSING_DEPTHS; k++) {
            if (!nh_exact_at(j->o, j->ball, c->point[side][k]) ||
                !nh_ball_value(j->ball, side && over ? j->beyond : j->phi, &value[side][k], &radius))
                return false;
            size = fmax(size, fabs(value[side][k]));
        }
    double near = fabs(value[1][2] - value[0][2]), far = fabs(value[1][1] - value[0][1]);
    for (int side = 0; side < 2; side++)
        if (fabs(value[side][2]) > growth * fabs(value[side][1]) + rounding * size) return false; /* a pole */
    return near > far / 2 && near < 2 * growth * far && near > rounding * size;
}

/* Does Gamma(Phi) vanish on this side?  1, 0, or -1 where it cannot be evaluated. */
static int holds(judge *j, double *z)
{
    double ratio, mid, radius, size;
    bool zero = true;
    if (!nh_exact_at(j->o, j->ball, z)) return -1;
    if (nh_ball_relative_sum(j->ball, j->terms, j->term, &ratio)) return -ratio >= j->digits;
    if (!nh_ball_value(j->ball, j->phi, &size, &radius)) return -1;
    /* terms that are 0 up to rounding, as those of y' (x - |x|), are small beside Phi */
    double least = fabs(size) * pow(10, -j->digits);
    for (size_t i = 0; i < j->terms && zero; i++) {
        if (!nh_ball_value(j->ball, j->term[i], &mid, &radius)) return -1;
        zero = fabs(mid) + radius <= least;
    }
    return zero ? 1 : -1;
}

/* ---- all of them ---- */

/* What was seen at the crossings of one wall. */
typedef struct {
    /* counts: Gamma(Phi) failed below and held above; the other way; it failed on neither side, and Phi jumped */
    bool below, above, jump;
} seen;

/* One crossing: below and above are 1, 0 or -1 (`holds`). */
static void look(judge *j, const nh_crossing *c, seen *s)
{
    int below = j->digits > 0 ? holds(j, c->point[0][0]) : 1, above = j->digits > 0 ? holds(j, c->point[1][0]) : 1;
    if (below == 0 && above == 0 && j->failing < NH_MOST_WALLS && !(j->failing && j->fails[j->failing - 1] == c->wall))
        j->fails[j->failing++] = c->wall;
    s->below |= below == 0 && above == 1;
    s->above |= above == 0 && below == 1;
    /* where Phi is zero to the last digit, its rate says nothing */
    s->jump |= below != 0 && above != 0 && (below == 1 || above == 1) &&
               jumps(j, c, nh_branch_end_is_at(j->o, j->end, j->ball, c));
}

/* A wall of an impulse stays one. */
static void note(nh_region *r, nh_ex wall, const seen *s, bool touches)
{
    bool one = s->below != s->above && !touches;
    if (one) put_side(r, wall, s->below ? 1 : -1);
    else if (s->below || s->above) put(r, wall, NH_REGION_PARTS);
    else if (s->jump) put(r, wall, NH_REGION_APART);
}

/* Joins the crossings of one wall, which may lie apart in the list. */
static void look_at_all(judge *j, const nh_crossings *c, nh_region *out)
{
    for (size_t i = 0; i < c->count; i++) {
        bool first = true, touches = false;
        seen s = {0};
        for (size_t k = 0; k < i; k++) first &= c->item[k].wall != c->item[i].wall;
        for (size_t k = i; k < c->count && first; k++) {
            if (c->item[k].wall != c->item[i].wall) continue;
            touches |= c->item[k].touches;
            look(j, &c->item[k], &s);
        }
        note(out, c->item[i].wall, &s, touches);
    }
}

/* At the end of the chart's branch: the other branch has phi with its own velocity. */
static void look_at_the_end(judge *j, nh_region *out)
{
    seen s = {0};
    for (size_t i = 0; i < j->end->crossings.count; i++) s.jump |= jumps(j, &j->end->crossings.item[i], true);
    note(out, j->end->wall, &s, false);
}

static nh_ex inside_of_absolute(void *dag, nh_ex call)
{
    return nh_function_of(dag, call) == NH_ABS ? nh_child(dag, call, 0) : 0;
}

/* Is it continuous for any real values: entire, where each |u| in it is u? */
static bool is_continuous(const nh_model *model, nh_ex e)
{
    for (nh_ex next; (next = nh_substitute_calls(model->dag, e, inside_of_absolute, model->dag)) != e;) e = next;
    return nh_is_entire(model->dag, e, model->width, model->chart->symbol);
}

/* Then motions have no impulses, and what is constant on all sides of walls is so across them, seen or not. */
static bool passes_all_walls(const nh_model *model, nh_ex phi)
{
    bool all = is_continuous(model, model->Lbar) && is_continuous(model, phi);
    for (size_t s = 0; s < model->m && all; s++) all = is_continuous(model, model->rho[s]);
    return all;
}

nh_region nh_region_of(const nh_model *model, const nh_terrain *terrain, nh_ex phi, double digits, bool sided,
                       const nh_options *options, nh_arena *arena)
{
    nh_region out = {0};
    nh_crossings own = own_crossings(model, terrain, phi, options, arena, &out.unseen);
    if (out.unseen && digits == 0) out.unseen = !passes_all_walls(model, phi);
    if (own.count + terrain->crossings.count + terrain->end.crossings.count == 0) return out;
    judge j = {.o = model,
               .ball = nh_ball_create(model->dag, (long)options->bits),
               .end = &terrain->end,
               .phi = phi,
               .beyond = nh_branch_end_beyond(model, &terrain->end, phi),
               .terms = 1 + model->m + model->n,
               .digits = digits};
    j.term = nh_alloc_array(j.terms, sizeof *j.term);
    nh_rate_terms(model, phi, j.term);
    nh_exact_parameters(model, j.ball);
    for (size_t i = 0; i < terrain->impulses; i++) put(&out, terrain->impulse[i], NH_REGION_IMPULSE);
    look_at_all(&j, &terrain->crossings, &out);
    look_at_all(&j, &own, &out);
    /* Far from the sampling box it fails on both sides of a wall, and no other wall ends it: another sheet of this wall
     * does. */
    if (j.failing && !out.count) put(&out, j.fails[0], NH_REGION_PARTS);
    look_at_the_end(&j, &out);
    nh_free(j.term);
    nh_ball_free(j.ball);
    if (sided && out.count) put_pairs(memset(&out, 0, sizeof out), model);
    return out;
}

nh_region nh_region_open(const nh_model *model, const nh_terrain *terrain, nh_ex phi, const nh_options *options,
                         nh_arena *arena)
{
    nh_region out = {0};
    nh_walls walls = {0};
    nh_crossings own = own_crossings(model, terrain, phi, options, arena, &out.unseen);
    nh_walls_add(&walls, model->dag, phi);
    for (size_t i = 0; i < walls.count; i++) {
        bool judged = walls.edge[i];
        for (size_t k = 0; k < own.count; k++) judged |= own.item[k].wall == walls.e[i];
        for (size_t k = 0; k < terrain->crossings.count; k++) judged |= terrain->crossings.item[k].wall == walls.e[i];
        if (!judged) put(&out, walls.e[i], NH_REGION_PARTS);
    }
    return out;
}

/* ---- in words ---- */

/* The wall c (x - root) of one symbol and numbers. */
static bool is_level(nh_dag *d, nh_ex wall, nh_ex *symbol, nh_ex *root, bool *rising)
{
    nh_ex zero = nh_int(d, 0);
    NH_LIST(all);
    if (nh_symbols_in(d, wall, &all) != 1) return false;
    *symbol = all[0];
    nh_ex slope = nh_diff(d, wall, *symbol), rest = nh_substitute(d, wall, 1, symbol, &zero);
    if (nh_kind_of(d, slope) != NH_NUMBER || nh_kind_of(d, rest) != NH_NUMBER) return false;
    *rising = nh_num_value(nh_number_of(d, slope)) > 0;
    *root = nh_neg(d, nh_div(d, rest, slope));
    return true;
}

/* "x - 2*y > 0", "t < 2" */
static void condition(nh_dag *d, nh_ex wall, int sign, nh_text *out)
{
    nh_ex symbol, root;
    bool rising, level = is_level(d, wall, &symbol, &root, &rising);
    if (level && !rising) sign = -sign;
    nh_print(d, level ? symbol : wall, out);
    nh_text_add(out, sign > 0 ? " > " : sign < 0 ? " < " : " = ");
    nh_print(d, level ? root : nh_int(d, 0), out);
}

/* Is it said by another condition on the same symbol, as x < 1 by x < 1/2? */
static bool is_implied(nh_dag *d, const nh_region *r, size_t i)
{
    nh_ex symbol, root, other, at;
    bool rising, rises;
    if (!is_level(d, r->wall[i], &symbol, &root, &rising) || nh_kind_of(d, root) != NH_NUMBER) return false;
    bool upwards = (r->kind[i] == NH_REGION_ABOVE) == rising;
    for (size_t k = 0; k < r->count; k++) {
        bool sided = r->kind[k] == NH_REGION_ABOVE || r->kind[k] == NH_REGION_BELOW;
        if (k == i || !sided || !is_level(d, r->wall[k], &other, &at, &rises) || other != symbol) continue;
        if (upwards != ((r->kind[k] == NH_REGION_ABOVE) == rises)) continue;
        nh_ex gap = upwards ? nh_sub(d, at, root) : nh_sub(d, root, at);
        double by = nh_kind_of(d, gap) == NH_NUMBER ? nh_num_value(nh_number_of(d, gap)) : 0;
        if (by > 0 || (by == 0 && k < i)) return true;
    }
    return false;
}

bool nh_region_to_the_end(const nh_region *r)
{
    bool all = true;
    for (size_t i = 0; i < r->count; i++) all &= r->kind[i] == NH_REGION_IMPULSE;
    return all && !r->unseen;
}

const char *nh_region_text(nh_dag *d, const nh_region *r, nh_arena *arena)
{
    if (r->count == 0 && !r->unseen) return NULL;
    nh_text text;
    nh_text_init(&text);
    const char *between = "";
    for (size_t i = 0; i < r->count; i++) {
        if (r->kind[i] != NH_REGION_ABOVE && r->kind[i] != NH_REGION_BELOW) continue;
        if (is_implied(d, r, i)) continue;
        nh_text_addf(&text, "%s", *between ? " and " : "for ");
        condition(d, r->wall[i], r->kind[i] == NH_REGION_ABOVE ? 1 : -1, &text);
        between = ", ";
    }
    for (size_t i = 0; i < r->count; i++) {
        if (r->kind[i] == NH_REGION_ABOVE || r->kind[i] == NH_REGION_BELOW) continue;
        nh_text_addf(&text, "%s%s", between,
                     r->kind[i] == NH_REGION_PARTS ? "in some parts that end at " : "on each side of ");
        condition(d, r->wall[i], 0, &text);
        nh_text_add(&text, r->kind[i] == NH_REGION_APART     ? ", where it jumps"
                           : r->kind[i] == NH_REGION_IMPULSE ? ", where the motion has an impulse"
                                                             : "");
        between = ", ";
    }
    if (r->unseen) nh_text_addf(&text, "%son one side of each %swall", between, r->count ? "further " : "");
    const char *out = nh_arena_strdup(arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}
