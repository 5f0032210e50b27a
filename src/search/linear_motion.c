/* The ladder's stage for what moves linearly: where the equations of motion are, for all coordinates or for some that
 * depend on no others,
 *
 *     z' = A z + b,     z = (q, w) of one block, A of numbers or parameters, b a sum of functions of t whose
 *                       derivatives are finitely many functions (powers, exponentials, waves and their products),
 *
 * each left eigenvector l A = lambda l gives exp(-lambda t) (l . z + c) as a current, with c such a sum, too (of t
 * times these functions where the drive is in resonance), and lambda = 0, where A is defective, polynomials in t. A's
 * blocks are solved one by one, so that many coordinates are no more trouble than few; the rates of a block of two come
 * as formulas, those of larger ones as numbers that are then named, and the vectors from the null space of z times the
 * waves of one rate, as everywhere. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "integrals/recognise.h"
#include "search/stage_solver.h"
#include "search/naming.h"

enum {
    longest = 2000,  /* symbols of an equation of motion */
    most_drives = 12 /* functions of t in b and its derivatives */
};
/* of the largest rate: a rate below it is zero, whose double eigenvalue is split by the root of rounding */
static const double defective = 1e-5,
                    equal = 1e-6;     /* relatively: one rate, likewise */

typedef struct {
    nh_stage_solver *x;
    size_t size;       /* of z */
    nh_ex *z, *entry;  /* entry[i + j size]: A; 0 (the number) where there is none */
    size_t *block;     /* per variable: the first of its block */
    size_t count, *of; /* of the block at hand: its variables */
    size_t drives;     /* 1 and the functions of t that terms of b and of its derivatives are multiples of */
    nh_ex drive[most_drives];
    bool turns;        /* of the rate that is followed: its imaginary part is meant */
} linear;

/* ---- the matrix ---- */

static bool constant(const nh_model *o, nh_ex e)
{
    for (size_t j = 0; j < o->width; j++)
        if (nh_depends(o->dag, e, o->chart->symbol[j])) return false;
    return true;
}

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

/* The function of t that the term is a constant multiple of. */
static nh_ex function_of_time(nh_dag *d, nh_ex term, nh_ex t)
{
    if (nh_kind_of(d, term) != NH_PRODUCT) return nh_depends(d, term, t) ? term : nh_int(d, 1);
    nh_ex g = nh_int(d, 1);
    for (size_t i = 0; i < nh_arity(d, term); i++) {
        nh_ex factor = nh_pow(d, nh_child(d, term, i), nh_exponent_of(d, term, i));
        if (nh_depends(d, factor, t)) g = nh_mul(d, g, factor);
    }
    return g;
}

static bool add_drive(linear *l, nh_ex term)
{
    nh_dag *d = l->x->r->model->dag;
    nh_ex g = function_of_time(d, term, l->x->r->system->t);
    bool old = nh_is_zero(d, term);
    for (size_t i = 0; i < l->drives && !old; i++) old = g == l->drive[i];
    if (!old && l->drives == most_drives) return false;
    if (!old) l->drive[l->drives++] = g;
    return true;
}

/* The functions of the terms of e that are new, sums below factors multiplied out; false where they are too many. */
static bool add_drives(linear *l, nh_ex e)
{
    nh_ex *part;
    bool fits = true;
    size_t n = nh_terms_of(l->x->r->model->dag, e, &part);
    if (n == 1) fits = add_drive(l, e);
    for (size_t k = 1; k < n && fits; k++) fits = add_drives(l, part[k]);
    nh_free(part);
    return fits;
}

/* b of one row, from which the terms with z are taken, and the derivatives of its functions. */
static bool drive(linear *l, nh_ex b)
{
    const nh_model *o = l->x->r->model;
    size_t first = l->drives;
    bool fits = add_drives(l, nh_simplify_short(o->dag, b, 0));
    for (size_t i = first; i < l->drives && fits; i++)
        fits = add_drives(l, nh_simplify_short(o->dag, nh_diff(o->dag, l->drive[i], o->system->t), 0));
    return fits;
}

/* Row i of A; false when z_i' is not linear, or depends on t otherwise. */
static bool row(linear *l, size_t i, nh_ex rate)
{
    const nh_model *o = l->x->r->model;
    nh_ex b = rate, zero = nh_int(o->dag, 0);
    if (nh_complexity(o->dag, rate) > longest) return false;
    for (size_t j = 0; j < l->size; j++) {
        if (!nh_depends(o->dag, rate, l->z[j])) continue;
        nh_ex slope = nh_simplify_short(o->dag, nh_diff(o->dag, rate, l->z[j]), 0);
        if (!constant(o, slope)) return false;
        l->entry[i + j * l->size] = slope;
        if (!nh_is_zero(o->dag, slope)) join(l, i, j);
        b = nh_substitute(o->dag, b, 1, &l->z[j], &zero);
    }
    return drive(l, b);
}

static bool read_matrix(linear *l)
{
    const nh_model *o = l->x->r->model;
    if (o->chart->implicit) return false;
    l->drive[l->drives++] = nh_int(o->dag, 1);
    for (size_t i = 0; i < l->size; i++) {
        l->block[i] = i;
        l->z[i] = o->chart->symbol[1 + i];
    }
    for (size_t i = 0; i < l->size; i++)
        if (!row(l, i, i < o->m ? o->rho[i] : o->a[i - o->m])) return false;
    return true;
}

/* ---- rates ---- */

/* Eigenvalues of the block, as it is at this model's parameters. */
static bool eigenvalues(const linear *l, const nh_model *o, double *re, double *im)
{
    size_t n = l->count;
    nh_ex *e = nh_alloc_array(n * n + 1, sizeof *e);
    double *A = nh_alloc_array(n * n + 1, sizeof *A);
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < n; i++) e[i + j * n] = l->entry[l->of[i] + l->of[j] * l->size];
    nh_tape_constants(o->dag, n * n, e, o->system->parameters, o->parameter, o->parameter_value, A);
    bool good = nh_eigen(n, A, re, im, NULL);
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
    nh_dag *d = r->model->dag;
    if (value == 0) return nh_int(d, 0);
    l->turns = turns;
    nh_ex e = nh_name_value(r->model, value, follow, l, r->options.recognise, (uint64_t)r->options.seed);
    return e ? e : nh_real(d, value);
}

/* exp(-re t) {cos(im t), sin(im t)}, or without the waves. */
static size_t waves(nh_dag *d, nh_ex t, nh_ex re, nh_ex im, nh_ex *out)
{
    nh_ex decay = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, re, t))), angle = nh_mul(d, im, t);
    out[0] = decay;
    if (nh_is_zero(d, im)) return 1;
    out[0] = nh_mul(d, decay, nh_call(d, NH_COS, angle));
    out[1] = nh_mul(d, decay, nh_call(d, NH_SIN, angle));
    return 2;
}

/* sqrt(e) or -sqrt(e), whichever is written without a root: w for w^2.  Both are rates. */
static nh_ex either_root(nh_dag *d, nh_ex e)
{
    if (nh_kind_of(d, e) != NH_PRODUCT || nh_num_value(nh_constant_of(d, e)) < 0) return nh_sqrt(d, e);
    nh_ex root = nh_sqrt(d, nh_number(d, nh_constant_of(d, e)));
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex exponent = nh_exponent_of(d, e, i);
        nh_num x = nh_kind_of(d, exponent) == NH_NUMBER ? nh_number_of(d, exponent) : nh_num_real(0.5);
        if (!nh_num_short(x) || x.q != 1 || x.p % 2) return nh_sqrt(d, e);
        root = nh_mul(d, root, nh_powi(d, nh_child(d, e, i), x.p / 2));
    }
    return root;
}

/* A block of two: lambda = T/2 +- sqrt(T^2/4 - D) with the trace T and the determinant D. */
static size_t waves_of_two(const linear *l, bool turns, nh_ex *out)
{
    nh_dag *d = l->x->r->model->dag;
    size_t i = l->of[0], j = l->of[1], n = l->size;
    const nh_ex *e = l->entry;
    nh_ex half = nh_mul(d, nh_ratio(d, 1, 2), nh_add(d, e[i + i * n], e[j + j * n]));
    nh_ex D = nh_sub(d, nh_mul(d, e[i + i * n], e[j + j * n]), nh_mul(d, e[i + j * n], e[j + i * n]));
    nh_ex apart = nh_simplify_short(d, nh_sub(d, nh_mul(d, half, half), D), 0), t = l->x->r->system->t;
    if (turns) return waves(d, t, half, either_root(d, nh_neg(d, apart)), out);
    nh_ex s = either_root(d, apart);
    out[0] = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, nh_add(d, half, s), t)));
    out[1] = nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, nh_sub(d, half, s), t)));
    return out[0] == out[1] ? 1 : 2;
}

/* ---- the stages of one block ---- */

/* Its variables and the functions that drive it, once or also times t, times these functions of t. */
static void stage(linear *l, const char *name, bool resonant, size_t functions, const nh_ex *function)
{
    nh_analysis *r = l->x->r;
    size_t terms = l->count + (resonant ? 2 : 1) * l->drives;
    nh_ex *term = nh_arena_alloc(r->arena, terms * sizeof *term),
          *copy = nh_arena_alloc(r->arena, (functions + 1) * sizeof *copy);
    nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *all = nh_arena_alloc(r->arena, sizeof *all);
    for (size_t i = 0; i < l->count; i++) term[i] = l->z[l->of[i]];
    for (size_t k = 0; k < l->drives; k++) {
        term[l->count + k] = l->drive[k];
        if (resonant) term[l->count + l->drives + k] = nh_mul(r->model->dag, r->system->t, l->drive[k]);
    }
    memcpy(copy, function, functions * sizeof *copy);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = terms, .term = term};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = functions, .term = copy};
    all[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    if (!nh_stage_solver_done(l->x)) nh_stage_solver_stage(l->x, name, 1, all);
}

/* Where the drive is no polynomial it may be in resonance. */
static void both_stages(linear *l, const char *name, size_t functions, const nh_ex *function)
{
    const nh_analysis *r = l->x->r;
    size_t before = r->independent;
    stage(l, name, false, functions, function);
    if (l->drives > 1 && r->independent < before + functions) stage(l, name, true, functions, function);
}

static void polynomials(linear *l)
{
    nh_dag *d = l->x->r->model->dag;
    nh_ex t = l->x->r->system->t, f[3] = {nh_int(d, 1), t, nh_mul(d, t, t)};
    stage(l, "what moves linearly, times powers of t", false, 3, f);
}

/* Each rate once, with its conjugate: of two values that differ by rounding the first. */
static void solve_block(linear *l)
{
    size_t n = l->count, done = 0;
    double *re = nh_alloc_array(2 * n + 1, sizeof *re), *im = re + n, largest = 0;
    bool good = eigenvalues(l, l->x->r->model, re, im), null = false, formulas = n == 2;
    for (size_t k = 0; k < n && good; k++) largest = fmax(largest, hypot(re[k], im[k]));
    for (size_t k = 0; k < n && good; k++) null |= hypot(re[k], im[k]) <= defective * largest;
    if (good && null) polynomials(l);
    for (size_t k = 0; k < n && good; k++) {
        if (fabs(re[k]) <= equal * fabs(im[k])) re[k] = 0;
        if (fabs(im[k]) <= equal * fabs(re[k])) im[k] = 0;
        bool old = im[k] < 0 || hypot(re[k], im[k]) <= defective * largest || (formulas && done);
        for (size_t j = 0; j < k && !old; j++)
            old = im[j] >= 0 && hypot(re[j] - re[k], im[j] - im[k]) <= equal * largest;
        if (old || nh_stage_solver_done(l->x)) continue;
        nh_ex wave[2];
        size_t count = formulas && !null ? waves_of_two(l, im[k] != 0, wave)
                                         : waves(l->x->r->model->dag, l->x->r->system->t, named(l, re[k], false),
                                                 named(l, im[k], true), wave);
        both_stages(l, "what moves linearly, times exponentials and waves in t", count, wave);
        done++;
    }
    nh_free(re);
}

void nh_linear_motion_search(nh_stage_solver *x)
{
    const nh_model *o = x->r->model;
    size_t size = o->m + o->n;
    linear l = {.x = x,
                .size = size,
                .z = nh_alloc_array(size + 1, sizeof *l.z),
                .entry = nh_alloc_array(size * size + 1, sizeof *l.entry),
                .block = nh_alloc_array(size + 1, sizeof *l.block),
                .of = nh_alloc_array(size + 1, sizeof *l.of)};
    bool is = read_matrix(&l);
    for (size_t first = 0; first < size && is && !nh_stage_solver_done(x); first++) {
        l.count = 0;
        for (size_t i = 0; i < size; i++)
            if (root(&l, i) == first) l.of[l.count++] = i;
        if (l.count) solve_block(&l);
    }
    nh_free(l.of);
    nh_free(l.block);
    nh_free(l.entry);
    nh_free(l.z);
}
