/* Currents whose coefficients are functions of several variables without closed form: integrals/box_series.h, where the
 * count says that one may be missing. */
#include "search/series_several.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/progress.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/box_series.h"

/* unknowns of a linear problem */
enum { probe_columns = 300, most_columns = 900, probe_columns_in_space = 500, most_columns_in_space = 1400 };
enum { points_in_box = 24, least_degree = 8 };
static const double widest_rate = 1e-9; /* of a certificate */

typedef struct {
    nh_stage_solver *x;
    nh_box_series *series;
    double low[NH_BOX_VARIABLES], high[NH_BOX_VARIABLES]; /* where points are sampled */
    nh_points *points;                                    /* in the box at hand */
    nh_box_functions f;
} problem;

/* A box: its centre, between the ends of the sampled intervals, and its edges as parts of them; how many new currents
 * there are near the centre, and the functions on the best box so far with the bounds of their rates. */
typedef struct {
    double place, part[NH_BOX_VARIABLES];
    size_t count;
    nh_box_functions best;
    double *bound;
} trial;

/* ---- boxes ---- */

/* A short decimal near s, for edges of about this width. */
static double shortened(double s, double width)
{
    double unit = pow(10, 2 - floor(log10(width)));
    return round(s * unit) / unit;
}

/* Of these parts of the sampled intervals, about a place between their ends. */
static void choose_box(const problem *p, double place, const double *part, double *low, double *high)
{
    for (size_t j = 0; j < p->series->equations.variables; j++) {
        double width = p->high[j] - p->low[j], middle = p->low[j] + place * width;
        low[j] = shortened(middle - part[j] * width / 2, width);
        high[j] = shortened(middle + part[j] * width / 2, width);
    }
}

static void take_points(problem *p)
{
    nh_points_free(p->points);
    p->points = nh_box_series_points(p->series, &p->f, points_in_box, (uint64_t)p->x->r->options.seed + 909);
}

/* ---- from functions to currents ---- */

/* Keeps the solutions that are no functions of the currents found. */
static void keep_new(problem *p)
{
    const nh_analysis *r = p->x->r;
    size_t known = r->count, n = known + p->f.count, block = p->series->words * p->f.terms, kept = 0;
    if (!p->points) p->f.count = 0;
    if (p->f.count == 0) return;
    nh_ex *phi = nh_alloc_array(n + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(n + 1, sizeof *kind);
    double *c = nh_arena_alloc(r->arena, p->f.count * block * sizeof *c);
    for (size_t k = 0; k < n; k++)
        phi[k] = k < known ? r->found[k].phi : nh_box_series_expression(p->series, &p->f, k - known);
    nh_independence_test(r->model, p->points, n, phi, NULL, r->options.sure, r->options.doubt, kind, NULL);
    for (size_t k = 0; k < p->f.count; k++)
        if (kind[known + k] == NH_INDEPENDENT)
            memcpy(c + kept++ * block, p->f.coefficient + k * block, block * sizeof *c);
    p->f.coefficient = c;
    p->f.count = kept;
    nh_free(kind);
    nh_free(phi);
}

/* "x' at x = 0, y = 1", where it is the value of one word there. */
static const char *meaning_of(const problem *p, size_t k)
{
    nh_analysis *r = p->x->r;
    size_t alone = nh_box_series_alone(p->series, &p->f, k);
    if (alone == p->series->words) return "";
    nh_text text;
    nh_text_init(&text);
    char *word = nh_print_string(r->model->dag, p->series->word[alone]);
    nh_text_add(&text, word);
    for (size_t j = 0; j < p->series->equations.variables; j++)
        nh_text_addf(&text, "%s%s = %.6g", j ? ", " : " at ",
                     nh_name_of(r->model->dag, p->series->equations.variable[j]), (p->f.low[j] + p->f.high[j]) / 2);
    const char *out = nh_arena_printf(r->arena, "%s", nh_text_string(&text));
    nh_free(word);
    nh_text_clear(&text);
    return out;
}

/* The result's description of solution k.  Words whose function is 0 are left out. */
static nh_series *series_of(const problem *p, size_t k, double bound)
{
    nh_arena *arena = p->x->r->arena;
    size_t r = p->series->equations.variables, terms = p->f.terms, words = p->series->words;
    nh_series *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_series){.variables = r,
                     .degree = p->f.degree,
                     .word = nh_arena_alloc(arena, words * sizeof *s->word),
                     .coefficient = nh_arena_alloc(arena, words * terms * sizeof *s->coefficient),
                     .stride = terms,
                     .index = p->f.index,
                     .bound = bound};
    memcpy(s->variable, p->series->equations.variable, r * sizeof *s->variable);
    memcpy(s->low, p->f.low, sizeof s->low);
    memcpy(s->high, p->f.high, sizeof s->high);
    for (size_t a = 0; a < words; a++) {
        const double *c = p->f.coefficient + (k * words + a) * terms;
        bool any = false;
        for (size_t i = 0; i < terms; i++) any |= c[i] != 0;
        if (!any) continue;
        memcpy(s->coefficient + s->words * terms, c, terms * sizeof *c);
        s->word[s->words++] = p->series->word[a];
    }
    return s;
}

static size_t keep(problem *p, const double *bound)
{
    nh_analysis *r = p->x->r;
    nh_current_checker *bench = p->x->bench;
    size_t added = 0;
    nh_points_free(bench->generic); /* points in the box are generic too, and the series have values there */
    bench->generic = p->points;
    p->points = NULL;
    for (size_t k = 0; k < p->f.count && r->independent < r->local_maximum; k++) {
        nh_ex phi = nh_box_series_expression(p->series, &p->f, k);
        added += nh_currents_add_series(bench, phi, series_of(p, k, bound[k]), -log10(bound[k]), meaning_of(p, k));
    }
    return added;
}

/* ---- the search ---- */

/* In three variables a series of as many terms has a lower degree: its box has to be smaller. */
static bool in_space(const problem *p) { return p->series->equations.variables > 2; }
static size_t degree_of(const problem *p, bool probing)
{
    size_t columns = probing       ? in_space(p) ? probe_columns_in_space : probe_columns
                     : in_space(p) ? most_columns_in_space
                                   : most_columns;
    size_t degree = nh_box_series_degree(p->series, columns), most = (size_t)p->x->r->options.series_degree;
    return degree < most ? degree : most;
}

static void solve(problem *p, const trial *t, bool probing)
{
    double low[NH_BOX_VARIABLES], high[NH_BOX_VARIABLES];
    choose_box(p, t->place, t->part, low, high);
    p->f = nh_box_series_solve(p->series, low, high, degree_of(p, probing), p->x->r->arena);
    if (!p->f.count) return;
    take_points(p);
    keep_new(p);
}

/* Is there anything new?  A small box shows it with little work. */
static bool probe(problem *p, trial *t)
{
    static const double part = 0.1, part_in_space = 0.02;
    for (size_t j = 0; j < NH_BOX_VARIABLES; j++) t->part[j] = in_space(p) ? part_in_space : part;
    solve(p, t, true);
    t->count = p->f.count;
    return t->count > 0;
}

/* Do as many currents as before have bounds on this box?  Then it is the best so far. */
static bool reaches(problem *p, trial *t)
{
    nh_analysis *r = p->x->r;
    solve(p, t, false);
    if (p->f.count < t->count) return false;
    double *bound = nh_arena_alloc(r->arena, p->f.count * sizeof *bound);
    if (!nh_ball_box_bound(r->model->dag, &p->series->equations, &p->f, widest_rate, bound)) return false;
    t->best = p->f;
    t->bound = bound;
    return true;
}

static const double parts[] = {1.04, 0.8, 0.6, 0.45, 0.35, 0.25, 0.18, 0.13, 0.1};

/* Number of the widest box on which `reaches` holds: the first one, or one found by bisection. */
static size_t widest(problem *p, trial *t)
{
    size_t narrow = sizeof parts / sizeof *parts, wide = 0;
    for (size_t at = 0; wide < narrow && !nh_late(); at = (wide + narrow) / 2) {
        for (size_t j = 0; j < NH_BOX_VARIABLES; j++) t->part[j] = parts[at];
        if (reaches(p, t)) narrow = at;
        else wide = at + 1;
    }
    return narrow;
}

/* Tries to lengthen each edge alone: to the whole interval, or by a factor of two. */
static void widen(problem *p, trial *t, size_t at)
{
    for (size_t j = 0; j < NH_BOX_VARIABLES; j++) t->part[j] = parts[at];
    for (size_t j = 0; at > 0 && j < p->series->equations.variables && !nh_late(); j++) {
        t->part[j] = parts[0];
        if (reaches(p, t)) continue;
        t->part[j] = fmin(2 * parts[at], 1);
        if (2 * parts[at] >= 1 || !reaches(p, t)) t->part[j] = parts[at];
    }
}

static size_t extend(problem *p, trial *t, size_t *columns)
{
    size_t at = widest(p, t);
    if (!t->best.count) return 0;
    widen(p, t, at);
    p->f = t->best;
    *columns = p->series->words * p->f.terms;
    take_points(p);
    return keep(p, t->bound);
}

static const char *name_of(const problem *p)
{
    nh_analysis *r = p->x->r;
    const nh_box_equations *e = &p->series->equations;
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text, "degree %zu in the velocities with coefficients that are series in ", p->series->degree);
    for (size_t j = 0; j < e->variables; j++)
        nh_text_addf(&text, "%s%s",
                     j == 0                 ? ""
                     : j + 1 < e->variables ? ", "
                                            : " and ",
                     nh_name_of(r->model->dag, e->variable[j]));
    const char *out = nh_arena_printf(r->arena, "%s", nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* Searches for functions of these variables. */
static bool search_in(nh_stage_solver *x, size_t degree, size_t variables, const nh_ex *variable)
{
    static const double places[] = {0.5, 0.3, 0.7};
    const nh_model *o = x->r->model;
    problem p = {.x = x, .series = nh_box_series_create(o, variables, variable, degree, x->r->arena)};
    if (!p.series || degree_of(&p, false) < least_degree) return false;
    double start = nh_clock();
    for (size_t j = 0; j < variables; j++)
        for (size_t s = 0; s < o->width; s++) {
            if (o->chart->symbol[s] != variable[j]) continue;
            p.low[j] = o->chart->low[s];
            p.high[j] = o->chart->high[s];
        }
    for (size_t j = 0; j < variables; j++)
        if (!(p.high[j] > p.low[j])) return false;
    nh_stage_record *note = nh_stage_solver_note(x, name_of(&p));
    note->sectors = 1;
    note->columns = p.series->words; /* as long as only the small box was tried */
    trial t = {0};
    for (size_t i = 0; i < sizeof places / sizeof *places && !note->dimension; i++) {
        t.place = places[i];
        if (probe(&p, &t)) note->dimension = t.count;
    }
    if (note->dimension) {
        note->found = extend(&p, &t, &note->columns);
        note->undecided = note->found == 0;
    }
    nh_points_free(p.points);
    note->seconds = nh_clock() - start;
    return note->found > 0;
}

static bool contains(size_t n, const nh_ex *list, nh_ex e)
{
    for (size_t i = 0; i < n; i++)
        if (list[i] == e) return true;
    return false;
}

bool nh_series_in_several(nh_stage_solver *x, const nh_completeness *c)
{
    const nh_model *o = x->r->model;
    nh_ex variable[NH_BOX_VARIABLES];
    if (!c->counted || !c->missing_at || !c->missing || !c->settled || o->chart->implicit || nh_counted_has_walls(o))
        return false;
    nh_ex t = o->system->t;
    size_t n = nh_box_series_shape(o, variable), shape = n;
    if (n < NH_BOX_VARIABLES && c->count.time && !contains(n, variable, t)) variable[n++] = t;
    if (n > NH_BOX_VARIABLES) return false;
    if (n > 1 && search_in(x, c->missing_at, n, variable)) return true;
    size_t all = shape;
    for (size_t s = 0; s < o->m; s++) {
        nh_ex q = o->system->coordinate[s].q;
        if (contains(n, variable, q)) continue;
        if (n == NH_BOX_VARIABLES) return false;
        variable[n++] = q;
        all++;
    }
    return all > shape && search_in(x, c->missing_at, n, variable);
}
