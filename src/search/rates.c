/* rates: the stages with exponentials and waves, exp(-lambda q) f, whose rates lambda are found by pencils.
 * [docs/method.md, (14)]
 *
 *     rates          eigenvalues of the pencil of one base and one variable q, each once
 *     without_driven those that are waves of the driving force are left out
 *     choose_forms   for each rate: as a simple number, as its digits, or with a name in the parameters?
 *     wave_families  base times exp(-re q) {cos(im q), sin(im q)}: a stage like others
 *
 *     variable q                      bases
 *     t                               velocities, harmonics, linear; energy and growing ones where L changes; squares
 *                                     with forces; quadratic, cubic, frame, products, rational
 *     a coordinate                    velocities, harmonics, linear; squares, around one angle, frame, products
 *     log of the invariant density    velocities, harmonics, linear
 *     the potential                   products, linear */
#include <math.h>
#include <stdio.h>

#include "exact/normal.h"
#include "exact/relation_express.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "integrals/dictionary.h"
#include "integrals/pencil.h"
#include "integrals/recognise.h"
#include "search/stage_solver.h"
#include "search/naming.h"
#include "search/stages.h"

/* ---- The rate at which the flow of the equations of motion changes volumes ----
 *
 *     div Gamma = d rho^s/dq^s + d a^i/dw^i
 *
 * in the coordinates and velocities of the chart.  Where it is the rate of a function Q of the coordinates, exp(-Q) is
 * the density of an invariant measure, and products of powers of exp(Q) with other functions are often conserved: of a
 * wheeled cart w exp(k (psi1 + psi2)), in a direction in which no single coordinate grows [BorisovMamaev2008]. */

enum { largest_form = 2000 };

static nh_ex divergence(const nh_model *model)
{
    nh_dag *d = model->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++)
        sum = nh_add(d, sum, nh_diff(d, model->rho[s], model->system->coordinate[s].q));
    for (size_t i = 0; i < model->n; i++) sum = nh_add(d, sum, nh_diff(d, model->a[i], model->chart->w[i]));
    return nh_simplify_short(d, sum, largest_form);
}

/* Q as a sum of coordinates and logarithms of lengths, with coefficients that are functions of the parameters; 0 where
   div Gamma = 0 or no such sum is found.  `max_terms`: of polynomials. */
static nh_ex volume_rate_potential(const nh_model *model, const nh_dictionary *words, size_t max_terms)
{
    nh_dag *d = model->dag;
    nh_ex rate = divergence(model), Q = nh_int(d, 0);
    if (nh_kind_of(d, rate) == NH_NUMBER) return 0;
    size_t n = 0, most = model->m + words->lengths;
    nh_ex *part = nh_alloc_array(most + 1, sizeof *part), *c = nh_alloc_array(most + 1, sizeof *c),
          *e = nh_alloc_array(most + 1, sizeof *e);
    for (size_t s = 0; s < model->m; s++) part[n++] = model->system->coordinate[s].q;
    for (size_t s = 0; s < words->lengths; s++) part[n++] = nh_call(d, NH_LOG, words->length[s]);
    for (size_t j = 0; j < n; j++) e[j] = nh_model_gamma(model, part[j]);
    e[n] = rate;
    bool found = nh_relation_express(d, n + 1, e, model->system->parameters, model->parameter, max_terms, c);
    for (size_t j = 0; j < n && found; j++) Q = nh_add(d, Q, nh_mul(d, c[j], part[j]));
    nh_free(e);
    nh_free(c);
    nh_free(part);
    return found ? Q : 0;
}

/* ---- rates ---- */

enum { most_values = 24, most_rates = 4 };
/* rounding splits a double eigenvalue into two by its square root; their mean is right to rounding */
static const double split_by_rounding = 3e-7;

/* ---- exponentials and waves with unknown rates: exp(-lambda t) f, exp(-lambda q) f ---- */

typedef struct {
    nh_stage_solver *x;
    const nh_ansatz *base;
    nh_ex q; /* t or a coordinate */
    bool periodic, imaginary;
} rate_context;

/* Is (x, y) one of the values again?  That becomes the mean of its occurrences; `seen`: how many there are of each. */
static bool again(double x, double y, size_t count, double *re, double *im, size_t *seen)
{
    for (size_t j = 0; j < count; j++) {
        if (fabs(re[j] - x) + fabs(im[j] - y) >= split_by_rounding * (fabs(re[j]) + fabs(im[j]))) continue;
        seen[j]++;
        re[j] += (x - re[j]) / (double)seen[j];
        im[j] += (y - im[j]) / (double)seen[j];
        return true;
    }
    return false;
}

/* Of the frequencies y + whole numbers and their negatives, all of which are one rate where the base contains whole
 * harmonics, the lowest that is an eigenvalue: with others the base has too few harmonics. */
static double lowest(const nh_pencil *p, double y)
{
    double low = y;
    for (size_t k = 0; k < p->dimension; k++) {
        double other = fabs(p->im[k]), near = split_by_rounding * (other + y);
        bool same = fabs(other - y - round(other - y)) < near || fabs(other + y - round(other + y)) < near;
        if (same && other < low) low = other;
    }
    return low;
}

/* |Im| or Re of the pencil's eigenvalues, each once. */
static size_t rates(const nh_model *model, const rate_context *c, double *re, double *im, size_t most)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    const nh_points *points = c->x->ranges;
    size_t n = c->base->columns, count = 0, *seen = nh_alloc_array(most + 1, sizeof *seen);
    double largest = 0, *A = nh_alloc_array(points->count * n + 1, sizeof *A),
           *B = nh_alloc_array(points->count * n + 1, sizeof *B);
    nh_nullspace_options limits = nh_nullspace_options_from(&c->x->r->question->options);
    if (c->x->fields) nh_field_rows_all(model, c->x->fields, c->base, nh_model_X0(model, c->q), points, A, B);
    else nh_rows_pencil(model, c->base, nh_model_gamma(model, c->q), points, A, B);
    nh_pencil *p = nh_pencil_solve(points->count, n, A, B, &limits, c->x->r->question->options.split, &ignored);
    for (size_t k = 0; p && k < p->dimension; k++) largest = fmax(largest, hypot(p->re[k], p->im[k]));
    for (size_t k = 0; p && k < p->dimension && count < most; k++) {
        double x = p->re[k], y = p->im[k];
        if (y < 0 || p->residual[k] > 1e-7 * hypot(x, y)) continue; /* relative: rates have units */
        if (y < split_by_rounding * fabs(x)) y = 0;
        if (fabs(x) < split_by_rounding * y) x = 0;
        if (c->periodic) y = lowest(p, y);
        if (fabs(x) + fabs(y) < 1e-6 * largest || again(x, y, count, re, im, seen)) continue;
        re[count] = x;
        im[count] = y;
        seen[count++] = 1;
    }
    nh_free(seen);
    nh_pencil_free(p);
    nh_free(B);
    nh_free(A);
    return count;
}

/* Of a periodic coordinate nu is known up to its sign and whole numbers: nu, 1 - nu, 1 + nu, 2 - nu. */
static int folds(const rate_context *c) { return c->imaginary && c->periodic ? 4 : 1; }
static double unfolded(double nu, int fold) { return (fold % 2 ? -nu : nu) + (double)((fold + 1) / 2); }

static bool follow(const nh_model *changed, double near, double *value, void *context)
{
    rate_context *c = context;
    double re[most_values], im[most_values], best = HUGE_VAL;
    size_t n = rates(changed, c, re, im, most_values);
    for (size_t i = 0; i < n; i++)
        for (int fold = 0; fold < folds(c); fold++) {
            double v = c->imaginary ? unfolded(im[i], fold) : re[i];
            if (fabs(v - near) >= best) continue;
            best = fabs(v - near);
            *value = v;
        }
    return n > 0 && best < 0.5 * fabs(near);
}

/* The convergents p/q of a real number differ from it by about 1/q^2.  A much smaller difference means that the number
 * is p/q (1/1000 for an angle in thousandths). */
static nh_ex unusually_near(nh_dag *d, double value, double tolerance)
{
    static const double by_chance = 1e-3;
    nh_num r;
    if (!nh_recognise_ratio(value, INT32_MAX, tolerance, &r)) return 0;
    double q = (double)r.q;
    return fabs(nh_num_value(r) - value) * q * q < by_chance ? nh_number(d, r) : 0;
}

/* The pencil's eigenvalues have as many digits as the gap of its null space leaves, sometimes seven: a simple number
 * near the value is tried before the value itself. */
enum { AS_DIGITS, AS_NUMBERS, NAMED };
static const double few_digits = 1000, /* times the tolerance for recognising numbers */
    negligible = 1e-6;                 /* ratio of one part of a rate to the other */

static nh_ex number_of(const rate_context *c, double value)
{
    nh_dag *d = c->x->r->question->model->dag;
    double exact = c->x->r->question->options.recognise;
    nh_ex e;
    if (nh_recognise_number(d, value, exact, &e) || nh_recognise_number(d, value, few_digits * exact, &e)) return e;
    return unusually_near(d, value, few_digits * exact);
}

/* As an expression of the parameters. */
static nh_ex named(rate_context *c, double value)
{
    const nh_analysis *r = c->x->r;
    double exact = r->question->options.recognise;
    nh_ex e = 0;
    for (int fold = 0; fold < folds(c) && !e; fold++) {
        e = nh_name_value(r->question->model, unfolded(value, fold), follow, c, exact,
                          (uint64_t)r->question->options.seed);
        if (!e)
            e = nh_name_value(r->question->model, unfolded(value, fold), follow, c, few_digits * exact,
                              (uint64_t)r->question->options.seed);
    }
    return e ? e : number_of(c, value);
}

static nh_ex rate_of(rate_context *c, double value, bool imaginary, int how)
{
    c->imaginary = imaginary;
    if (value == 0) return 0; /* node 0 is the number 0 */
    nh_ex e = how == NAMED ? named(c, value) : how == AS_NUMBERS ? number_of(c, value) : 0;
    return e ? e : nh_real(c->x->r->question->model->dag, value);
}

/* The rates of one pencil, with the family that is multiplied by their waves. */
typedef struct {
    rate_context context;
    const nh_family *base;
    bool linear; /* the family is everything of degree one */
    size_t count;
    double re[most_values], im[most_values];
    int how[most_values]; /* the form of the rate */
} waves;

/* exp(-re q) {cos(im q), sin(im q)} for every rate. */
static size_t wave_terms(waves *w, nh_ex *out)
{
    rate_context *c = &w->context;
    nh_dag *d = c->x->r->question->model->dag;
    size_t count = 0;
    for (size_t k = 0; k < w->count; k++) {
        double re = w->re[k], im = w->im[k];
        bool turns = fabs(im) > negligible * fabs(re), decays = fabs(re) > negligible * fabs(im);
        nh_ex rate = decays ? nh_neg(d, rate_of(c, re, false, w->how[k])) : 0;
        nh_ex decay = decays ? nh_call(d, NH_EXP, nh_mul(d, rate, c->q)) : nh_int(d, 1);
        nh_ex angle = turns ? nh_mul(d, rate_of(c, im, true, w->how[k]), c->q) : 0;
        if (!turns) out[count++] = decay;
        else {
            out[count++] = nh_mul(d, decay, nh_call(d, NH_COS, angle));
            out[count++] = nh_mul(d, decay, nh_call(d, NH_SIN, angle));
        }
    }
    return count;
}

/* The base times the waves; the base itself only where it contains all functions of degree one (smooth functions on a
 * small interval are nearly dependent, so that there should be no unnecessary ones). */
static size_t wave_families(waves *w, nh_family *out)
{
    nh_arena *arena = w->context.x->r->arena;
    nh_ex *wave = nh_arena_alloc(arena, 2 * w->count * sizeof *wave);
    nh_family *part = nh_arena_alloc(arena, 2 * sizeof *part);
    part[0] = *w->base;
    part[1] = (nh_family){.kind = NH_TERMS, .terms = wave_terms(w, wave), .term = wave};
    out[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    out[1] = *w->base;
    return w->linear ? 2 : 1;
}

/* How many new currents a rate seems to give in some form, and how far these are from being conserved. */
typedef struct {
    size_t news;
    double worst;
} promise;

static promise promises(waves *w, size_t k, int how)
{
    nh_family family[2];
    promise p;
    w->how[k] = how;
    p.news = nh_stage_solver_news(w->context.x, wave_families(w, family), family, &p.worst);
    return p;
}

/* Are as many as nearly conserved?  A number or an expression that is only close to the rate leaves a residual that its
 * digits do not. */
static bool as_good(promise a, promise b)
{
    static const double rounding = 1e-13, much = 100;
    return a.news > b.news || (a.news == b.news && a.worst <= much * b.worst + rounding);
}

/* Whether the value and what it looks like are the same to rounding. */
static bool plain(const rate_context *c, double value)
{
    nh_ex e;
    return nh_recognise_number(c->x->r->question->model->dag, value, c->x->r->question->options.recognise, &e) ||
           !number_of(c, value);
}

/* Each rate by itself in the form that seems to give most currents; rates that give none are left out. */
static void choose_forms(waves *w)
{
    size_t kept = 0;
    for (size_t k = 0; k < w->count; k++) {
        waves one = *w;
        one.count = 1;
        one.re[0] = w->re[k];
        one.im[0] = w->im[k];
        promise most = promises(&one, 0, AS_NUMBERS);
        int how = AS_NUMBERS;
        if (!plain(&w->context, w->re[k]) || !plain(&w->context, w->im[k])) {
            promise digits = promises(&one, 0, AS_DIGITS);
            if (!as_good(most, digits)) how = AS_DIGITS, most = digits;
        }
        if (!most.news) continue;
        if (as_good(promises(&one, 0, NAMED), most)) how = NAMED;
        w->re[kept] = w->re[k];
        w->im[kept] = w->im[k];
        w->how[kept++] = how;
    }
    w->count = kept;
}

/* Is the function g of t a wave of frequency nu, g'' = -nu^2 g? */
static bool is_wave(const nh_stage_solver *solver, nh_ex g, double nu)
{
    const nh_model *model = solver->r->question->model;
    const nh_points *p = solver->ranges;
    nh_ex t = model->system->t, pair[2] = {g, nh_diff(model->dag, nh_diff(model->dag, g, t), t)};
    double *value = nh_alloc_array(2 * p->count + 1, sizeof *value), rest = 0, size = 0;
    nh_points_evaluate(p, model, 2, pair, value);
    for (size_t i = 0; i < p->count; i++) {
        rest = fmax(rest, fabs(value[p->count + i] + nu * nu * value[i]));
        size = fmax(size, fabs(value[p->count + i]));
    }
    nh_free(value);
    return size > 0 && rest < 1e-7 * size;
}

/* The frequencies of driving forces are waves of the base itself: they give no currents, and are nearly dependent on
 * the others. */
static size_t without_driven(const nh_stage_solver *solver, nh_ex q, size_t n, double *re, double *im)
{
    const nh_model *model = solver->r->question->model;
    size_t kept = 0;
    for (size_t k = 0; k < n; k++) {
        bool driven = false;
        for (size_t i = 0;
             i < solver->words.atoms && q == model->system->t && fabs(re[k]) < 1e-9 * fabs(im[k]) && !driven; i++)
            driven = nh_depends(model->dag, solver->words.atom[i], q) && is_wave(solver, solver->words.atom[i], im[k]);
        re[kept] = re[k];
        im[kept] = im[k];
        kept += !driven;
    }
    return kept;
}

/* Many waves on a short interval are nearly dependent: each is tried alone as well. */
static void one_by_one(waves *w, const char *text)
{
    nh_stage_solver *solver = w->context.x;
    for (size_t k = 0; k < w->count && !nh_stage_solver_done(solver); k++) {
        waves one = *w;
        nh_family family[2];
        one.count = 1;
        one.re[0] = w->re[k];
        one.im[0] = w->im[k];
        one.how[0] = w->how[k];
        wave_families(&one, family); /* the eigenvectors need the first of them only */
        if (nh_stage_solver_promising(solver, 1, family)) nh_stage_solver_stage(solver, text, 1, family);
    }
}

/* Returns whether new currents were found; `linear`: the family is everything of degree one. */
static bool pencil_of(nh_stage_solver *solver, nh_ex q, const char *name, const nh_family *base, bool linear)
{
    nh_analysis *r = solver->r;
    nh_error ignored;
    nh_error_clear(&ignored);
    size_t before = r->list->independent;
    nh_family family[2];
    if (nh_counted_superfluous(&solver->counted, 1, base,
                               nh_depends(r->question->model->dag, q, r->question->model->system->t)))
        return false;
    nh_ansatz *a =
        nh_ansatz_create(r->question->model, solver->ranges, 1, base, solver->ranges->count / 2 - 2, &ignored);
    if (!a) return false;
    waves w = {.context = {.x = solver, .base = a, .q = q}, .base = base, .linear = linear};
    for (size_t i = 0; i < solver->words.waves; i++) w.context.periodic |= solver->words.wave[i] == q;
    w.count = without_driven(solver, q, rates(r->question->model, &w.context, w.re, w.im, most_values), w.re, w.im);
    if (w.count > most_rates) w.count = most_rates;
    choose_forms(&w);
    if (w.count) {
        char text[120];
        snprintf(text, sizeof text, "exponentials and waves in %.60s with rates found by the pencil", name);
        nh_stage_solver_stage(solver, text, wave_families(&w, family), family);
        if (w.count > 1) one_by_one(&w, text);
    }
    nh_ansatz_free(a);
    return r->list->independent > before;
}

static bool pencil_stage(nh_stage_solver *solver, nh_ex q, const char *name, nh_pencil_base base)
{
    nh_analysis *r = solver->r;
    /* elsewhere 1 and q are a pair that rounding splits */
    bool timely = q == r->question->model->system->t && base == NH_PENCIL_LINEAR;
    nh_family family =
        nh_stage_pencil_base(r->arena, r->question->model, &solver->words, timely ? NH_PENCIL_TIME : base);
    return pencil_of(solver, q, name, &family, base == NH_PENCIL_LINEAR);
}

/* Are the equations of motion independent of the coordinate?  (Of time this is not asked: the stage finds out soon.) */
static bool is_cyclic(const nh_stage_solver *solver, nh_ex q)
{
    for (size_t i = 0; i < solver->words.shapes; i++)
        if (solver->words.shape[i] == q) return false;
    return true;
}

/* For a variable the smallest base that gives new currents is enough: larger ones make them more complicated. */
static bool linear_rates(nh_stage_solver *solver, nh_ex q, const char *name)
{
    bool found = false;
    for (nh_pencil_base base = NH_PENCIL_VELOCITIES; base <= NH_PENCIL_LINEAR && !found; base++)
        found = !nh_stage_solver_done(solver) && pencil_stage(solver, q, name, base);
    return found;
}

/* exp(-nu Q) f where volumes grow like exp(Q): the velocities of a body on wheels fall and grow with combinations of
   the wheels' angles. */
static void volume_rate(nh_stage_solver *solver)
{
    const nh_model *model = solver->r->question->model;
    if ((model->k == 0 && !model->system->has_forces) || nh_stage_solver_done(solver)) return;
    nh_ex Q = volume_rate_potential(model, &solver->words, (size_t)solver->r->question->options.proof_terms);
    if (Q && nh_kind_of(model->dag, Q) != NH_SYMBOL) linear_rates(solver, Q, "the logarithm of the invariant density");
}

static void rates_of(nh_stage_solver *solver, nh_ex q, const char *name, size_t bases, const nh_pencil_base *base)
{
    for (size_t i = 0; i < bases && !nh_stage_solver_done(solver); i++) pencil_stage(solver, q, name, base[i]);
}

/* exp(-nu V) f with V the potential: for a thermostat that keeps the speed (f falls as the forces do work): velocities
 * and their products with positions, and where coordinates are curved the momenta. */
static void potential_rate(nh_stage_solver *solver)
{
    const nh_model *model = solver->r->question->model;
    nh_ex *zero = nh_arena_alloc(solver->r->arena, (model->m + 1) * sizeof *zero),
          *v = nh_arena_alloc(solver->r->arena, (model->m + 1) * sizeof *v);
    if (model->k == 0 || nh_stage_solver_done(solver)) return;
    for (size_t s = 0; s < model->m; s++) {
        v[s] = model->system->coordinate[s].v;
        zero[s] = nh_int(model->dag, 0);
    }
    nh_ex V = nh_substitute(model->dag, model->system->lagrangian, model->m, v, zero);
    if (nh_kind_of(model->dag, V) != NH_NUMBER && !nh_depends(model->dag, V, model->system->t))
        rates_of(solver, V, "the potential", 2, (nh_pencil_base[]){NH_PENCIL_PRODUCTS, NH_PENCIL_LINEAR});
}

static void rates_in_time(nh_stage_solver *solver)
{
    static const nh_pencil_base larger[] = {NH_PENCIL_QUADRATIC, NH_PENCIL_CUBIC, NH_PENCIL_FRAME, NH_PENCIL_PRODUCTS};
    const nh_model *model = solver->r->question->model;
    nh_ex t = model->system->t;
    bool found = linear_rates(solver, t, "t"), changes = nh_depends(model->dag, model->Lbar, t);
    if (changes) rates_of(solver, t, "t", 1, (nh_pencil_base[]){NH_PENCIL_ENERGY});
    if (!found && changes) rates_of(solver, t, "t", 1, (nh_pencil_base[]){NH_PENCIL_GROWING});
    if (model->system->has_forces) rates_of(solver, t, "t", 1, (nh_pencil_base[]){NH_PENCIL_SQUARES});
    rates_of(solver, t, "t", sizeof larger / sizeof *larger, larger);
    rates_of(solver, t, "t", 1, (nh_pencil_base[]){NH_PENCIL_RATIONAL});
}

static void rates_along(nh_stage_solver *solver, const nh_coordinate *c)
{
    static const nh_pencil_base larger[] = {NH_PENCIL_FRAME, NH_PENCIL_PRODUCTS};
    const nh_model *model = solver->r->question->model;
    const char *name = nh_name_of(model->dag, c->q);
    bool found = linear_rates(solver, c->q, name);
    if (model->system->has_forces) rates_of(solver, c->q, name, 1, (nh_pencil_base[]){NH_PENCIL_SQUARES});
    if (c->type == NH_ANGLE && solver->words.waves > 1 && !found && !nh_stage_solver_done(solver)) {
        nh_family around = nh_stage_pencil_around(solver->r->arena, model, &solver->words, c->q);
        pencil_of(solver, c->q, name, &around, false);
    }
    if (is_cyclic(solver, c->q)) rates_of(solver, c->q, name, sizeof larger / sizeof *larger, larger);
}

void nh_rates_search(nh_stage_solver *solver)
{
    const nh_model *model = solver->r->question->model;
    rates_in_time(solver);
    for (size_t i = 0; i < model->m; i++) rates_along(solver, &model->system->coordinate[i]);
    volume_rate(solver);
    potential_rate(solver);
}

void nh_rates_of_fields(nh_stage_solver *solver, const nh_family *base)
{
    const nh_model *model = solver->r->question->model;
    if (!nh_stage_solver_done(solver)) pencil_of(solver, model->system->t, "t, of fields", base, false);
    for (size_t i = 0; i < model->m && !nh_stage_solver_done(solver); i++) {
        char name[80];
        nh_ex q = model->system->coordinate[i].q;
        snprintf(name, sizeof name, "%.60s, of fields", nh_name_of(model->dag, q));
        pencil_of(solver, q, name, base, false);
    }
}
