#include "search/grid.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/node.h"
#include "motion/trajectory.h"
#include "base/progress.h"
#include "base/text.h"
#include "system/table.h"
#include "search/search.h"
#include "system/sample.h"
#include "system/sample_grid.h"

static const double edge = 1e-9; /* how far a state may lie outside of the domain, relative to its width */
enum { per_motion = 8, most_rounds = 12, most_tries = 40 };

/* ---- points of a file ---- */

static size_t column_of(const nh_table *t, const char *name)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    return nh_table_column(t, name, &ignored);
}

/* The names of the columns of a file of points. */
static const char *heading_of(nh_arena *arena, const nh_model *model)
{
    const char *out = "t";
    for (size_t i = 0; i < model->m; i++)
        out = nh_arena_printf(arena, "%s, %s", out, model->system->coordinate[i].name);
    for (size_t i = 0; i < model->m && !model->chart->quasi; i++)
        out = nh_arena_printf(arena, "%s, %s", out, nh_name_of(model->dag, model->system->coordinate[i].v));
    for (size_t i = 0; i < model->n && model->chart->quasi; i++)
        out = nh_arena_printf(arena, "%s, %s", out, nh_name_of(model->dag, model->chart->w[i]));
    return out;
}

/* The column of every variable, t.columns for a missing t; false with a message. */
static bool find_columns(nh_arena *arena, const nh_model *model, const nh_table *t, bool velocities, size_t *column,
                         nh_error *error)
{
    size_t m = model->m, width = 1 + m + (velocities ? m : model->n);
    column[0] = column_of(t, "t");
    for (size_t i = 1; i < width; i++) {
        const nh_coordinate *q = model->system->coordinate;
        const char *name =
            i <= m ? q[i - 1].name : nh_name_of(model->dag, velocities ? q[i - 1 - m].v : model->chart->w[i - 1 - m]);
        if ((column[i] = nh_table_column(t, name, error)) < t->columns) continue;
        snprintf(error->where, sizeof error->where, "%s:%zu", t->path, t->heading);
        return nh_error_hint(error, "its first line names a column for each coordinate and velocity: %s",
                             heading_of(arena, model));
    }
    return true;
}

static bool read_points(nh_arena *arena, const nh_model *model, nh_grid *grid, nh_error *error)
{
    nh_table *t = nh_table_read(arena, grid->path, error);
    if (!t) return false;
    size_t m = model->m, n = model->n, *column = nh_arena_alloc(arena, (1 + 2 * m) * sizeof *column);
    grid->velocities = model->chart->implicit > 0;
    for (size_t i = 0; i < n && !grid->velocities; i++)
        grid->velocities = column_of(t, nh_name_of(model->dag, model->chart->w[i])) == t->columns;
    if (!find_columns(arena, model, t, grid->velocities, column, error)) return false;
    size_t width = 1 + m + (grid->velocities ? m : n);
    grid->rows = t->rows;
    grid->row = nh_arena_alloc(arena, t->rows * width * sizeof *grid->row);
    for (size_t p = 0; p < t->rows; p++)
        for (size_t i = 0; i < width; i++) {
            double *to = &grid->row[p * width + i];
            if (i == 0 && column[0] == t->columns) *to = 0;
            else if (!nh_table_number(arena, t, p, column[i], to, error)) return false;
        }
    return true;
}

bool nh_grid_choose(nh_arena *arena, const nh_model *model, const char *word, nh_grid *grid, nh_error *error)
{
    if (!word) return true;
    if (!nh_sample_grid_kind(word, &grid->kind, error)) return false;
    grid->path = nh_arena_strdup(arena, word);
    return grid->kind != NH_GRID_FILE || read_points(arena, model, grid, error);
}

/* ---- one set of points ---- */

typedef struct {
    nh_analysis *r; /* NULL: nothing is reported */
    const nh_options *options;
    const nh_grid *grid;
    const nh_model *model;
    const nh_ansatz *ansatz; /* NULL: there is none yet */
    bool all;                /* it may depend on all variables */
    size_t dimension;        /* of tensor and sparse grids */
    size_t *variable;        /* which of (t, q, w) these are */
    uint64_t seed;
    size_t outside; /* states of motions beyond the domain */
} maker;

/* The variables of (t, q, w) on which the equations or the ansatz depend. */
static void find_variables(maker *k)
{
    const nh_ansatz *ansatz = k->ansatz;
    const nh_model *o = k->model;
    for (size_t j = 0; j < 1 + o->m + o->n; j++) {
        nh_ex symbol = o->chart->symbol[j];
        bool occurs = k->all;
        for (size_t s = 0; s < o->m && !occurs; s++) occurs = nh_depends(o->dag, o->rho[s], symbol);
        for (size_t i = 0; i < o->n && !occurs; i++) occurs = nh_depends(o->dag, o->a[i], symbol);
        for (size_t f = 0; ansatz && f < ansatz->factors && !occurs; f++)
            occurs = nh_depends(o->dag, ansatz->factor[f], symbol);
        if (occurs) k->variable[k->dimension++] = j;
    }
}

/* Nodes in [-1, 1]^width as points of the box. */
static nh_points *in_box(const maker *k, size_t count, bool velocities, const double *low, const double *high,
                         double *node)
{
    size_t width = velocities ? 1 + 2 * k->model->m : k->model->width;
    for (size_t p = 0; p < count; p++)
        for (size_t j = 0; j < width; j++)
            node[p * width + j] = low[j] + (high[j] - low[j]) * (1 + node[p * width + j]) / 2;
    nh_points *points = nh_points_given(k->model, count, velocities, node);
    nh_free(node);
    return points;
}

static nh_points *nodes(const maker *k, size_t level)
{
    const nh_model *o = k->model;
    nh_grid_kind kind = k->grid->kind;
    bool velocities = kind == NH_GRID_HALTON && nh_points_natural(o);
    size_t width = velocities ? 1 + 2 * o->m : o->width;
    size_t count = kind == NH_GRID_HALTON ? level : nh_sample_grid_count(kind, k->dimension, level);
    double *box = nh_alloc_array(2 * width, sizeof *box);
    nh_points_box(o, velocities, box, box + width);
    double *node = nh_sample_halton(width, count, k->seed);
    if (kind != NH_GRID_HALTON) {
        double *own = nh_sample_grid_nodes(kind, k->dimension, level);
        for (size_t p = 0; p < count; p++)
            for (size_t d = 0; d < k->dimension; d++) node[p * width + k->variable[d]] = own[p * k->dimension + d];
        nh_free(own);
    }
    nh_points *points = in_box(k, count, velocities, box, box + width, node);
    nh_free(box);
    return points;
}

/* Sobol points at the beginning of the domain's times, and their velocities (m x count). */
static nh_points *starts(const maker *k, size_t count, uint64_t seed, double **velocity, nh_error *error)
{
    const nh_model *o = k->model;
    nh_points *any = nh_points_create(o, count, 1, seed, error);
    double *row = nh_alloc_array(count * o->width, sizeof *row);
    for (size_t p = 0; any && p < count; p++)
        for (size_t j = 0; j < o->width; j++) row[p * o->width + j] = j ? any->column[j][p] : o->chart->low[0];
    nh_points *start = any ? nh_points_given(o, count, false, row) : NULL;
    nh_points_free(any);
    nh_free(row);
    *velocity = start ? nh_alloc_array(start->count * o->m + 1, sizeof **velocity) : NULL;
    if (start) nh_points_evaluate(start, o, o->m, o->rho, *velocity);
    return start;
}

/* The states of one motion from point p of `start`, appended to row (of (t, q, w)) where they lie in the domain. */
static size_t states(maker *k, const nh_points *start, const double *velocity, size_t p, size_t room, double *row)
{
    const nh_model *o = k->model;
    const nh_chart *c = o->chart;
    size_t m = o->m, width = o->width, kept = 0;
    nh_error ignored;
    nh_error_clear(&ignored);
    double *z = nh_alloc_array(2 * m + per_motion, sizeof *z), *times = z + 2 * m;
    nh_state state = {.t = c->low[0], .q = z, .v = z + m};
    for (size_t s = 0; s < m; s++) z[s] = start->column[1 + s][p], z[m + s] = velocity[s * start->count + p];
    for (size_t i = 0; i < per_motion; i++)
        times[i] = c->low[0] + (c->high[0] - c->low[0]) * (double)i / (per_motion - 1);
    nh_trajectory_request request = {.model = o,
                                     .initial = &state,
                                     .count = per_motion,
                                     .times = times,
                                     .options = k->options,
                                     .n = width,
                                     .e = c->symbol};
    nh_trajectory *motion = nh_trajectory_create(&request, &ignored);
    for (size_t i = 0; motion && i < motion->motion->count && kept < room; i++) {
        const double *at = motion->value + i * width;
        bool inside = true;
        for (size_t j = 0; j < width; j++) {
            double slack = edge * (c->high[j] - c->low[j]);
            inside &= at[j] >= c->low[j] - slack && at[j] <= c->high[j] + slack;
        }
        if (inside) memcpy(row + kept++ * width, at, width * sizeof *row);
        else k->outside++;
    }
    nh_trajectory_free(motion);
    nh_free(z);
    return kept;
}

static nh_points *along_motions(maker *k, size_t count, nh_error *error)
{
    size_t width = k->model->width, rows = 0, most = most_tries * (count / per_motion + 1);
    double *row = nh_alloc_array(count * width + 1, sizeof *row);
    size_t batch = count / per_motion + 2, first = 0;
    k->outside = 0;
    for (; rows < count && first < most && !nh_late(); first += batch) {
        double *velocity;
        nh_points *start = starts(k, batch, k->seed + first, &velocity, error);
        if (!start) break;
        for (size_t p = 0; p < start->count && rows < count; p++)
            rows += states(k, start, velocity, p, count - rows, row + rows * width);
        nh_points_free(start);
        nh_free(velocity);
    }
    nh_points *points = nh_points_given(k->model, rows, false, row);
    nh_free(row);
    return points;
}

/* The points for a level: the number of nodes or the level of a tensor or sparse grid, the number of points else. */
static nh_points *make(maker *k, size_t level, nh_error *error)
{
    const nh_grid *grid = k->grid;
    switch (grid->kind) {
    case NH_GRID_SOBOL: return nh_points_cover(k->model, level, k->seed, error);
    case NH_GRID_MOTION: return along_motions(k, level, error);
    case NH_GRID_FILE: return nh_points_given(k->model, level, grid->velocities, grid->row);
    default: return nodes(k, level);
    }
}

/* Leaves out the points at which a factor of the ansatz, or its rate, is not finite: nodes may lie where a column ends,
 * at zero velocities or in the middle of the domain. */
static void drop_ends(const maker *k, const nh_ansatz *ansatz, nh_points *p)
{
    size_t n = ansatz ? ansatz->factors : 0, kept = 0;
    nh_ex *e = nh_alloc_array(2 * n + 1, sizeof *e);
    double *value = nh_alloc_array(2 * n * p->count + 1, sizeof *value);
    for (size_t f = 0; f < n; f++) e[f] = ansatz->factor[f], e[n + f] = nh_model_gamma(k->model, ansatz->factor[f]);
    nh_points_evaluate(p, k->model, 2 * n, e, value);
    for (size_t i = 0; i < p->count; i++) {
        bool finite = true;
        for (size_t f = 0; f < 2 * n; f++) finite &= isfinite(value[f * p->count + i]);
        if (!finite) continue;
        for (size_t j = 0; j < p->width; j++) p->column[j][kept] = p->column[j][i];
        p->weight[kept++] = p->weight[i];
    }
    p->not_finite += p->count - kept;
    p->count = kept;
    nh_free(value);
    nh_free(e);
}

/* ---- numbers of points ---- */

static bool has_levels(const maker *k) { return k->grid->kind == NH_GRID_TENSOR || k->grid->kind == NH_GRID_SPARSE; }

static size_t count_of(const maker *k, size_t level)
{
    return has_levels(k) ? nh_sample_grid_count(k->grid->kind, k->dimension, level) : level;
}

/* The least level with at least so many points. */
static size_t level_for(const maker *k, size_t count)
{
    if (!has_levels(k)) return count;
    size_t level = k->grid->kind == NH_GRID_TENSOR;
    while (count_of(k, level) < count) level++;
    return level;
}

/* An error at the user's number, with the one to write. */
static bool refuse(const maker *k, size_t wanted, const char *why, size_t needed, nh_error *error)
{
    const nh_analysis_question *q = k->r->question;
    const nh_deck_node *node = q->samples_in_file ? nh_deck_get(nh_deck_root(q->analysis->deck), "samples") : NULL;
    char number[32];
    snprintf(number, sizeof number, "%zu", wanted);
    k->r->grid.needed = needed;
    if (node) nh_deck_fail(q->analysis->deck, node, 0, error, "%s", why);
    else nh_deck_fail_typed("--samples", number, 0, error, "%s", why);
    return nh_error_hint(error, node ? "write samples: %zu" : "write --samples %zu", needed);
}

static bool refuse_variables(const maker *k, nh_error *error)
{
    const nh_deck *deck = k->grid->in_file ? k->r->question->analysis->deck : NULL;
    const nh_deck_node *node = deck ? nh_deck_get(nh_deck_root(deck), "grid") : NULL;
    nh_text why;
    nh_text_init(&why);
    nh_text_addf(&why, "a tensor grid has at most %d variables, here are %zu:", NH_GRID_MOST_TENSOR, k->dimension);
    for (size_t d = 0; d < k->dimension; d++)
        nh_text_addf(&why, "%s %s", d ? "," : "", nh_name_of(k->model->dag, k->model->chart->symbol[k->variable[d]]));
    if (node) nh_deck_fail(deck, node, 0, error, "%s", nh_text_string(&why));
    else nh_deck_fail_typed("--grid", "tensor", 0, error, "%s", nh_text_string(&why));
    nh_text_clear(&why);
    return nh_error_hint(error, node ? "write grid: sparse" : "write --grid sparse");
}

/* Is `wanted` a number that the grid can have, and the ansatz can use? */
static bool possible(const maker *k, size_t columns, size_t wanted, nh_error *error)
{
    size_t least = columns + NH_GRID_SPARE, level = level_for(k, wanted), count = count_of(k, level);
    nh_arena *arena = k->r->arena;
    if (k->grid->kind == NH_GRID_FILE && k->grid->rows < (wanted > least ? wanted : least)) {
        if (wanted > k->grid->rows)
            return refuse(k, wanted, nh_arena_printf(arena, "%s has %zu points", k->grid->path, k->grid->rows),
                          k->grid->rows, error);
        nh_fail(error, NH_INPUT, k->grid->path, "%zu points are too few: the ansatz has %zu columns", k->grid->rows,
                columns);
        return nh_error_hint(error, "%zu points are enough", least);
    }
    if (!wanted) return true;
    if (wanted < least)
        return refuse(k, wanted,
                      nh_arena_printf(arena, "%zu points are too few: the ansatz has %zu columns", wanted, columns),
                      count_of(k, level_for(k, least)), error);
    if (count == wanted) return true;
    return refuse(k, wanted,
                  nh_arena_printf(arena, "a %s grid in %zu variables has %zu or %zu points, not %zu",
                                  nh_sample_grid_word(k->grid->kind), k->dimension, count_of(k, level - 1), count,
                                  wanted),
                  count, error);
}

/* ---- the null space ---- */

/* The next number of points to try. */
static size_t next_level(const maker *k, size_t level)
{
    if (has_levels(k)) return level + 1;
    size_t twice = 2 * level;
    return k->grid->kind == NH_GRID_FILE && twice > k->grid->rows ? k->grid->rows : twice;
}

/* How many points lie on which branch: of a chart on one root of a quadratic constraint all; of implicit velocities by
 * the sign of each. */
static void count_branches(nh_analysis *r, const nh_model *o, const nh_points *p)
{
    const nh_chart *c = o->chart;
    nh_grid_report *g = &r->grid;
    size_t first = 1 + o->m + o->n;
    g->branches = 0;
    if (c->branch) {
        char *name = nh_chart_branch_name(c, c->branch), *other = nh_chart_branch_name(c, -c->branch);
        g->branch[g->branches++] = (nh_grid_branch){nh_arena_strdup(r->arena, name), p->count};
        g->branch[g->branches++] = (nh_grid_branch){nh_arena_strdup(r->arena, other), 0};
        nh_free(name), nh_free(other);
    }
    for (size_t i = 0; i < c->implicit && g->branches + 2 <= NH_GRID_MOST_BRANCHES; i++) {
        const char *name = nh_name_of(o->dag, c->u[i]);
        size_t above = 0;
        for (size_t k = 0; k < p->count; k++) above += p->column[first + i][k] > 0;
        g->branch[g->branches++] = (nh_grid_branch){nh_arena_printf(r->arena, "%s > 0", name), above};
        g->branch[g->branches++] = (nh_grid_branch){nh_arena_printf(r->arena, "%s < 0", name), p->count - above};
    }
}

/* The grid of the largest problem that was solved. */
static void report(const maker *k, const nh_points *p)
{
    nh_grid_report *g = &k->r->grid;
    if (p->count < g->used) return;
    g->used = p->count;
    g->variables = has_levels(k) ? k->dimension : 0;
    g->not_finite = p->not_finite, g->not_solved = p->not_solved, g->degenerate = p->degenerate;
    g->outside = k->outside;
    count_branches(k->r, k->model, p);
}

typedef struct {
    nh_grid_solver *solve;
    void *context;
    size_t columns;
    const nh_nullspace *sure; /* on Sobol points, or NULL: they are these */
} judge;

/* The null space on a level, or NULL where the level has too few points or sees too little. */
static nh_nullspace *try_level(maker *k, const judge *j, size_t level, nh_points **points, nh_error *error)
{
    nh_points *p = make(k, level, error);
    if (p && k->grid->kind != NH_GRID_SOBOL) drop_ends(k, k->ansatz, p);
    bool enough = p && p->count >= j->columns + NH_GRID_SPARE;
    nh_nullspace *s = enough ? j->solve(j->context, p, error) : NULL;
    if (s && j->sure && s->likely > j->sure->likely) {
        nh_nullspace_free(s);
        s = NULL;
    }
    if (s) *points = p;
    else nh_points_free(p);
    return s;
}

static nh_nullspace *search(maker *k, const judge *j, size_t wanted, size_t usual, nh_points **points, nh_error *error)
{
    size_t first = level_for(k, wanted ? wanted : usual), level = first;
    if (k->grid->kind == NH_GRID_FILE && !wanted) first = level = k->grid->rows;
    nh_nullspace *s = NULL;
    for (int round = 0; !s && round < most_rounds && count_of(k, level) < SIZE_MAX && !nh_late(); round++) {
        s = try_level(k, j, level, points, error);
        if (s || error->code != NH_OK) break;
        size_t next = next_level(k, level);
        if (next == level) break;
        level = next;
    }
    if (s && (!wanted || level == first)) return s;
    if (error->code == NH_OK && s)
        refuse(k, wanted,
               nh_arena_printf(k->r->arena,
                               "these %zu points do not determine the ansatz: it has null vectors on them "
                               "that fail elsewhere",
                               wanted),
               count_of(k, level), error);
    else if (error->code == NH_OK) {
        nh_fail(error, NH_NUMERIC, "", "no %s grid of %zu points or fewer determines the ansatz",
                nh_sample_grid_word(k->grid->kind), count_of(k, level));
        nh_error_hint(error, "take the grid `sobol`, or another domain");
    }
    if (s) nh_points_free(*points);
    nh_nullspace_free(s);
    *points = NULL;
    return NULL;
}

/* Can it be that? */
static bool allowed(const maker *k, size_t columns, size_t wanted, nh_error *error)
{
    if (k->grid->kind == NH_GRID_TENSOR && k->dimension > NH_GRID_MOST_TENSOR) return refuse_variables(k, error);
    return possible(k, columns, wanted, error);
}

static maker maker_of(nh_analysis *result, const nh_ansatz *ansatz, uint64_t seed)
{
    const nh_analysis_question *q = result->question;
    maker k = {.r = result,
               .options = &q->options,
               .grid = &q->grid,
               .model = q->model,
               .ansatz = ansatz,
               .all = !ansatz,
               .seed = seed};
    k.variable = nh_arena_alloc(result->arena, (1 + 2 * k.model->m) * sizeof *k.variable);
    if (has_levels(&k)) find_variables(&k);
    return k;
}

bool nh_grid_possible(nh_analysis *result, const nh_ansatz *ansatz, size_t columns, size_t wanted, nh_error *error)
{
    maker k = maker_of(result, ansatz, 0);
    return allowed(&k, columns, wanted, error);
}

nh_nullspace *nh_grid_solve(nh_analysis *result, const nh_ansatz *ansatz, size_t columns, size_t wanted, size_t usual,
                            uint64_t seed, nh_grid_solver *solve, void *context, nh_points **points, nh_error *error)
{
    maker k = maker_of(result, ansatz, seed);
    *points = NULL;
    if (!allowed(&k, columns, wanted, error)) return NULL;
    judge j = {.solve = solve, .context = context, .columns = columns};
    nh_nullspace *sure = NULL;
    if (k.grid->kind != NH_GRID_SOBOL) {
        nh_points *p = nh_points_cover(k.model, usual, seed + 1, error);
        j.sure = sure = p ? solve(context, p, error) : NULL;
        nh_points_free(p);
        if (!sure) return NULL;
    }
    nh_nullspace *s = search(&k, &j, wanted, usual, points, error);
    nh_nullspace_free(sure);
    if (s) report(&k, *points);
    return s;
}

nh_points *nh_grid_points(const nh_model *model, const nh_options *options, const nh_grid *grid, size_t count,
                          uint64_t seed, nh_error *error)
{
    maker k = {.options = options, .grid = grid, .model = model, .seed = seed};
    k.variable = nh_alloc_array(1 + 2 * model->m, sizeof *k.variable);
    if (has_levels(&k)) find_variables(&k);
    bool many = grid->kind == NH_GRID_TENSOR && k.dimension > NH_GRID_MOST_TENSOR && !refuse_variables(&k, error);
    size_t level = grid->kind == NH_GRID_FILE ? grid->rows : many ? 0 : level_for(&k, count);
    nh_points *p = many || count_of(&k, level) == SIZE_MAX ? NULL : make(&k, level, error);
    nh_free(k.variable);
    if (p && p->count) return p;
    nh_points_free(p);
    return NULL;
}
