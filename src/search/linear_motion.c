/* A stage of the search, for linear equations: where the equations of motion are, for all coordinates or for some that
 * depend on no others,
 *
 *     z' = A z + b,     z = (q, w) of one block, A of numbers or parameters, b a sum of functions of t whose
 *                       derivatives are finitely many functions (powers, exponentials, waves and their products),
 *
 * each left eigenvector l A = lambda l gives exp(-lambda t) (l . z + c) as a current, with c such a sum, too (of t
 * times these functions where the drive is in resonance), and powers of t where A is defective. A's blocks are solved
 * one by one, so that many coordinates are no more trouble than few; the rates of a block of two are formulas, those
 * of larger ones as numbers that are then named, and the vectors from the null space of z times the waves of one rate,
 * as everywhere.
 *
 * Where a rate has no name, what a pair of eigenvectors gives together needs none: the quadratic forms that A leaves
 * invariant come first, exactly and for all parameters (exact/invariant_forms.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/budget.h"
#include "base/linalg.h"
#include "base/progress.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "graph/terms.h"
#include "exact/ball_matrix.h"
#include "exact/invariant_forms.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/num.h"
#include "integrals/recognise.h"
#include "search/linear_motion_internal.h"
#include "search/naming.h"

enum {
    longest = 2000,  /* symbols of an equation of motion */
    most_close = 24, /* largest block in which rates that are equal are computed with so many bits, */
    bits = 512,
    most_powers = 6,  /* of t, in one block of Jordan's */
    most_letters = 12 /* largest block in which rates without a name may still be roots (integrals/letters.h) */
};
/* As parts of the largest rate: a smaller rate is zero, a double eigenvalue that rounding splits by its square root; */
static const double defective = 1e-5;
static const double equal = 1e-6; /* two rates as near as this are equal, */
static const double split = 1e-2; /* and as near as this perhaps */

typedef nh_linear_motion_block linear;

/* ---- the matrix ---- */

/* The first variable of the block of variable i. */
static size_t root(linear *l, size_t i)
{
    while (l->block[i] != i) i = l->block[i];
    return i;
}

static void join(linear *l, size_t i, size_t j)
{
    size_t a = root(l, i), b = root(l, j);
    l->block[a > b ? a : b] = a > b ? b : a;
}

/* Variables i and j are in one block where A_ij is not 0. */
static void find_blocks(linear *l)
{
    for (size_t i = 0; i < l->size; i++) l->block[i] = i;
    for (size_t i = 0; i < l->size; i++)
        for (size_t j = 0; j < l->size; j++)
            if (!nh_is_zero(l->x->r->question->model->dag, l->entry[i + j * l->size])) join(l, i, j);
}

/* Row i of A; false when z_i' is not linear, or depends on t otherwise. */
static bool row(linear *l, size_t i, nh_ex rate)
{
    const nh_model *model = l->x->r->question->model;
    nh_ex b = rate, zero = nh_int(model->dag, 0);
    if (nh_complexity(model->dag, rate) > longest) return false;
    for (size_t j = 0; j < l->size; j++) {
        if (!nh_depends(model->dag, rate, l->z[j])) continue;
        nh_ex slope = nh_simplify_short(model->dag, nh_diff(model->dag, rate, l->z[j]), 0);
        if (!nh_model_is_constant(model, slope)) return false;
        l->entry[i + j * l->size] = slope;
        b = nh_substitute(model->dag, b, 1, &l->z[j], &zero);
    }
    l->b[i] = b;
    return true;
}

/* z = (q, w): A and b from rho and a; false where some row is not linear. */
static bool read_matrix(linear *l)
{
    const nh_model *model = l->x->r->question->model;
    if (model->chart->implicit) return false;
    for (size_t i = 0; i < l->size; i++) l->z[i] = model->chart->symbol[1 + i];
    for (size_t i = 0; i < l->size; i++)
        if (!row(l, i, i < model->m ? model->rho[i] : model->a[i - model->m])) return false;
    return nh_linear_motion_drives(l);
}

/* ---- rates ---- */

/* Are two of the rates so close that rounding may have split one? */
static bool nearly_equal(size_t n, const double *re, const double *im)
{
    double largest = 0, least = HUGE_VAL;
    for (size_t k = 0; k < n; k++) {
        largest = fmax(largest, hypot(re[k], im[k]));
        for (size_t j = 0; j < k; j++) least = fmin(least, hypot(re[j] - re[k], im[j] - im[k]));
    }
    return least < split * largest;
}

/* Eigenvalues of the block, as it is at this model's parameters. */
static bool eigenvalues(const linear *l, const nh_model *model, double *re, double *im)
{
    size_t n = l->count;
    nh_ex *e = nh_alloc_array(n * n + 1, sizeof *e);
    double *A = nh_alloc_array(n * n + 1, sizeof *A);
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) e[i + j * n] = l->entry[l->of[i] + l->of[j] * l->size];
    nh_tape_constants(model->dag, n * n, e, model->system->parameters, model->parameter, model->parameter_value, A);
    bool good = nh_eigen(n, A, re, im, NULL);
    if (good && n <= most_close && nearly_equal(n, re, im)) {
        nh_ball *ball = nh_ball_create(model->dag, bits);
        for (size_t k = 0; k < model->system->parameters; k++)
            nh_ball_set_expression(ball, model->parameter[k],
                                   nh_number(model->dag, nh_num_decimal(model->parameter_value[k])));
        nh_ball_eigenvalues(ball, n, e, re, im); /* or those of doubles stay */
        nh_ball_free(ball);
    }
    nh_free(A);
    nh_free(e);
    return good;
}

static bool follow(const nh_model *changed, double near, double *value, void *context)
{
    const linear *l = context;
    double *re = nh_alloc_array(2 * l->count + 1, sizeof *re), *im = re + l->count, best = HUGE_VAL;
    bool good = eigenvalues(l, changed, re, im);
    for (size_t i = 0; i < l->count && good; i++) {
        double v = l->turns ? im[i] : re[i];
        if (fabs(v - near) >= best) continue;
        best = fabs(v - near);
        *value = v;
    }
    nh_free(re);
    return good && best < 0.5 * fabs(near);
}

static nh_ex named(linear *l, double value, bool turns)
{
    const nh_analysis *r = l->x->r;
    nh_dag *d = r->question->model->dag;
    if (value == 0) return nh_int(d, 0);
    l->turns = turns;
    nh_ex e = nh_name_value(r->question->model, value, follow, l, r->question->options.recognise,
                            (uint64_t)r->question->options.seed);
    return e ? e : nh_real(d, value);
}

/* ---- the stages of one block ---- */

/* The variables of the block and its driving functions, times functions of t. */
static void stage(linear *l, const char *name, size_t functions, const nh_ex *function)
{
    nh_analysis *r = l->x->r;
    size_t terms = l->count + l->drives;
    nh_ex *term = nh_arena_alloc(r->arena, terms * sizeof *term),
          *copy = nh_arena_alloc(r->arena, (functions + 1) * sizeof *copy);
    nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *all = nh_arena_alloc(r->arena, sizeof *all);
    for (size_t i = 0; i < l->count; i++) term[i] = l->z[l->of[i]];
    for (size_t k = 0; k < l->drives; k++) term[l->count + k] = l->drive[k];
    memcpy(copy, function, functions * sizeof *copy);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = terms, .term = term};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = functions, .term = copy};
    all[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    if (!nh_stage_solver_done(l->x)) nh_stage_solver_stage(l->x, name, 1, all);
}

bool nh_linear_motion_velocity(const linear *l, size_t i, size_t *j)
{
    nh_dag *d = l->x->r->question->model->dag;
    size_t n = 0;
    for (size_t k = 0; k < l->size; k++) {
        nh_ex e = l->entry[i + k * l->size];
        if (nh_is_zero(d, e)) continue;
        n += k >= l->places && nh_is_number(d, e, 1) ? 1 : 2;
        *j = k;
    }
    return n == 1;
}

/* q'' = B q: the coordinates of the block, and in the same places their velocities; 0 where it is not so. */
static size_t second_order(const linear *l, size_t *q, size_t *w)
{
    const nh_model *model = l->x->r->question->model;
    size_t n = 0;
    bool is = l->drives == 1;
    for (size_t k = 0; k < l->count && is; k++) {
        size_t i = l->of[k];
        is = nh_is_zero(model->dag, l->b[i]);
        if (i < l->places) {
            q[n] = i;
            is = is && nh_linear_motion_velocity(l, i, &w[n++]);
        }
        for (size_t j = l->places; j < l->size && i >= l->places; j++)
            is = is && nh_is_zero(model->dag, l->entry[i + j * l->size]);
    }
    return is && 2 * n == l->count ? n : 0;
}

/* With q'' = B q and u B = -s^2 u: u . (q' cos(s t) + s q sin(s t)) is conserved, and with u B = s^2 u u . (q' - s q)
 * exp(s t).  The current a quarter of a period later is a function of it and of the invariant forms.  This needs half
 * as many terms as the general form, and an eighth of the work for numbers without a name. */
static bool wave_of_second_order(linear *l, nh_ex s, bool turns, const char *name)
{
    nh_analysis *r = l->x->r;
    nh_dag *d = r->question->model->dag;
    size_t *q = nh_alloc_array(2 * l->count + 1, sizeof *q), *w = q + l->count, n = second_order(l, q, w);
    nh_ex *term = nh_arena_alloc(r->arena, (n + 1) * sizeof *term), angle = nh_mul(d, s, r->question->system->t);
    for (size_t k = 0; k < n; k++) {
        nh_ex place = nh_mul(d, s, l->z[q[k]]), velocity = l->z[w[k]];
        term[k] = turns ? nh_add(d, nh_mul(d, velocity, nh_call(d, NH_COS, angle)),
                                 nh_mul(d, place, nh_call(d, NH_SIN, angle)))
                        : nh_mul(d, nh_sub(d, velocity, place), nh_call(d, NH_EXP, angle));
    }
    nh_family *all = nh_arena_alloc(r->arena, sizeof *all);
    *all = (nh_family){.kind = NH_TERMS, .terms = n, .term = term};
    if (n) nh_stage_solver_stage(l->x, name, 1, all);
    nh_free(q);
    return n > 0;
}

/* ---- quadratic forms of one block ---- */

static void sort_simplest_first(const nh_dag *d, size_t n, nh_ex *e)
{
    for (size_t i = 1; i < n; i++) {
        nh_ex one = e[i];
        size_t j = i;
        for (; j > 0 && nh_complexity_order(d, e[j - 1], one) > 0; j--) e[j] = e[j - 1];
        e[j] = one;
    }
}

/* exp(c t) times the quadratic forms that A~ leaves invariant but for this factor; z~ = (w, q), and 1 where there is a
   constant force. */
static void forms_with_rate(linear *l, size_t n, const nh_ex *z, const nh_ex *A, nh_ex c)
{
    nh_analysis *r = l->x->r;
    nh_dag *d = r->question->model->dag;
    nh_progress("quadratic forms that linear motion leaves invariant", nh_budget_part());
    nh_invariant_question q = {d, n, r->question->system->parameters, z, A, c, r->question->model->parameter};
    nh_invariant_forms found = nh_invariant_forms_of(r->arena, &q);
    nh_ex factor = nh_call(d, NH_EXP, nh_mul(d, c, r->question->system->t));
    for (size_t k = 0; k < found.count; k++) found.form[k] = nh_mul(d, factor, found.form[k]);
    sort_simplest_first(d, found.count, found.form);
    nh_stage_solver_certify_each(l->x, found.count, found.form, "quadratic forms that linear motion leaves invariant");
    l->forms += found.count;
}

/* Velocities come first, in which forms are to be simple. */
static void quadratic_forms(linear *l)
{
    const nh_model *model = l->x->r->question->model;
    nh_dag *d = model->dag;
    size_t n = l->count, *of = nh_alloc_array(n + 1, sizeof *of), at = 0;
    bool constant_force = false;
    for (int positions = 0; positions < 2; positions++)
        for (size_t i = 0; i < n; i++)
            if ((l->of[i] < l->places) == (positions == 1)) of[at++] = l->of[i];
    for (size_t i = 0; i < n; i++) constant_force |= !nh_is_zero(d, l->b[of[i]]);
    size_t all = n + constant_force;
    nh_ex *z = nh_alloc_array(all + 1, sizeof *z), *A = nh_alloc_array(all * all + 1, sizeof *A), trace = nh_int(d, 0);
    for (size_t i = 0; i < all * all; i++) A[i] = nh_int(d, 0);
    for (size_t i = 0; i < n; i++) {
        z[i] = l->z[of[i]];
        for (size_t j = 0; j < n; j++) A[i * all + j] = l->entry[of[i] + of[j] * l->size];
        if (constant_force) A[i * all + n] = l->b[of[i]];
        trace = nh_add(d, trace, A[i * all + i]);
    }
    if (constant_force) z[n] = nh_int(d, 1);
    forms_with_rate(l, all, z, A, nh_int(d, 0));
    nh_ex c = nh_simplify_short(d, nh_mul(d, nh_ratio(d, -2, (int64_t)n), trace), 0);
    if (!nh_is_zero(d, c) && !nh_stage_solver_done(l->x)) forms_with_rate(l, all, z, A, c);
    nh_free(A);
    nh_free(z);
    nh_free(of);
}

/* Has every rate of the block a name? */
static bool all_named(linear *l, const double *re, const double *im)
{
    nh_dag *d = l->x->r->question->model->dag;
    bool all = true;
    for (size_t k = 0; k < l->count && all; k++)
        if (im[k] >= 0) all = nh_is_short(d, named(l, re[k], false)) && nh_is_short(d, named(l, im[k], true));
    return all;
}

static void forms_if_unnamed(linear *l, const double *re, const double *im)
{
    if (!l->forms && l->drives == 1 && !nh_stage_solver_done(l->x) && !all_named(l, re, im)) quadratic_forms(l);
}

/* ---- the whole block ---- */

/* How often this rate occurs in the block; earlier occurrences are included. */
static size_t multiplicity(const linear *l, const double *re, const double *im, size_t k, double near, bool *old)
{
    size_t count = 0;
    *old = im[k] < 0;
    for (size_t j = 0; j < l->count; j++) {
        bool same = hypot(re[j] - re[k], im[j] - im[k]) <= near;
        count += same;
        *old |= same && j < k;
    }
    return count;
}

/* Waves, the sine first, times powers of t below `times`, these one after another; their number. */
static size_t with_powers(linear *l, size_t times, size_t count, const nh_ex *wave, nh_ex *out)
{
    nh_dag *d = l->x->r->question->model->dag;
    size_t n = 0;
    for (size_t k = 0; k < times && k < most_powers; k++) {
        nh_ex power = nh_powi(d, l->x->r->question->system->t, (int64_t)k);
        for (size_t i = count; i > 0; i--) out[n++] = nh_mul(d, wave[i - 1], power);
    }
    return n;
}

/* The rates of the block; a rate that differs from zero by rounding is set to zero.  Returns the largest, or false. */
static bool rates(const linear *l, double *re, double *im, double *largest)
{
    bool good = eigenvalues(l, l->x->r->question->model, re, im);
    *largest = 0;
    for (size_t k = 0; k < l->count && good; k++) *largest = fmax(*largest, hypot(re[k], im[k]));
    for (size_t k = 0; k < l->count && good; k++) {
        if (fabs(re[k]) <= equal * fabs(im[k])) re[k] = 0;
        if (fabs(im[k]) <= equal * fabs(re[k])) im[k] = 0;
    }
    return good;
}

/* Those of the rate 0, which occurs so often. */
static void polynomials(linear *l, size_t times)
{
    nh_ex one = nh_int(l->x->r->question->model->dag, 1), f[2 * most_powers];
    size_t n = with_powers(l, times, 1, &one, f);
    if (nh_linear_motion_solutions(l, n, f) == times) return;
    if (n < 3) n = with_powers(l, 3, 1, &one, f);
    stage(l, "states with linear equations, times powers of t", n, f);
}

/* The currents of one rate. */
static void solve_rate(linear *l, double re, double im, size_t times, bool formulas)
{
    static const char *const name = "states with linear equations, times exponentials and waves in t";
    nh_dag *d = l->x->r->question->model->dag;
    nh_ex wave[2], decay = formulas ? 0 : named(l, re, false), turn = formulas ? 0 : named(l, im, true);
    bool many = l->forms && l->count > most_letters && (re == 0 || im == 0);
    if (many && wave_of_second_order(l, im != 0 ? turn : decay, im != 0, name)) return;
    size_t count = formulas ? nh_linear_motion_waves_of_two(l, im != 0, wave)
                            : nh_linear_motion_waves(d, l->x->r->question->system->t, decay, turn, wave);
    nh_ex f[2 * most_powers];
    if (nh_linear_motion_solutions(l, with_powers(l, times, count, wave, f), f) == times * count) return;
    stage(l, name, count, wave);
}

/* Each rate once, with its conjugate; of two values that differ by rounding the first is taken. */
static void solve_block(linear *l)
{
    size_t n = l->count, done = 0;
    double *re = nh_alloc_array(2 * n + 1, sizeof *re), *im = re + n, largest;
    bool good = rates(l, re, im, &largest), formulas = n == 2;
    size_t null = 0;
    for (size_t k = 0; k < n && good; k++) null += hypot(re[k], im[k]) <= defective * largest;
    if (null) polynomials(l, null);
    nh_complex_pair pair;
    if (good && !null && nh_linear_motion_complex_pair(l, &pair)) nh_complex_pair_search(l->x, &pair);
    l->forms = 0;
    if (good && !formulas) forms_if_unnamed(l, re, im);
    for (size_t k = 0; k < n && good && !nh_stage_solver_done(l->x); k++) {
        bool old;
        size_t times = multiplicity(l, re, im, k, equal * largest, &old);
        if (old || hypot(re[k], im[k]) <= defective * largest || (formulas && done++)) continue;
        solve_rate(l, re[k], im[k], times, formulas && !null);
    }
    nh_free(re);
}

nh_linear_motion_block nh_linear_motion_create(nh_stage_solver *solver, size_t size, size_t places)
{
    return (linear){.x = solver,
                    .size = size,
                    .places = places,
                    .z = nh_alloc_array(size + 1, sizeof(nh_ex)),
                    .b = nh_alloc_array(size + 1, sizeof(nh_ex)),
                    .entry = nh_alloc_array(size * size + 1, sizeof(nh_ex)),
                    .block = nh_alloc_array(size + 1, sizeof(size_t)),
                    .of = nh_alloc_array(size + 1, sizeof(size_t))};
}

void nh_linear_motion_clear(linear *l)
{
    nh_free(l->of);
    nh_free(l->block);
    nh_free(l->entry);
    nh_free(l->b);
    nh_free(l->z);
}

static linear linear_of(nh_stage_solver *solver, bool *is)
{
    const nh_model *model = solver->r->question->model;
    linear l = nh_linear_motion_create(solver, model->m + model->n, model->m);
    *is = read_matrix(&l);
    return l;
}

static void take_block(linear *l, size_t first)
{
    l->count = 0;
    for (size_t i = 0; i < l->size; i++)
        if (root(l, i) == first) l->of[l->count++] = i;
}

void nh_linear_motion_solve(linear *l)
{
    find_blocks(l);
    for (size_t first = 0; first < l->size && !nh_stage_solver_done(l->x); first++) {
        take_block(l, first);
        if (l->count) solve_block(l);
    }
}

bool nh_linear_motion_is(nh_stage_solver *solver)
{
    bool is;
    linear l = linear_of(solver, &is);
    nh_linear_motion_clear(&l);
    return is;
}

void nh_linear_motion_search(nh_stage_solver *solver)
{
    bool is;
    linear l = linear_of(solver, &is);
    if (is) nh_linear_motion_solve(&l);
    nh_linear_motion_clear(&l);
}
