/* A stage of the search, for linear equations that the coordinates hide: functions u of the coordinates with
 *
 *     u_i'' = a_ij u_j' + b_ij u_j + c_i(t),        a, b of numbers or parameters,
 *
 * along every motion, as r cos(phi) and r sin(phi) of an oscillator in polar coordinates, or (x^2 - y^2)/2 and x y in
 * parabolic ones.  The u are sums of words, products of one function of each coordinate.  Series along motions, modulo
 * a prime, give all linear relations of the words, their first and second derivatives and functions of t; the largest
 * space of words remains whose second derivatives lie in itself, its first ones and these functions.  What a and b are
 * for all parameters follows from normal forms.  The rest is that of linear_motion.c, with z = (u, u'). */
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "count/jet_equations.h"
#include "exact/normal.h"
#include "exact/residue_matrix.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/fixed.h"
#include "search/linear_motion_internal.h"

enum {
    most_letters = 10, /* of one coordinate */
    most_words = 200,
    most_functions = 12, /* u */
    rows_of_point = 3,   /* so that there are more points than words, which may be constant along motions */
    spare = 12,          /* rows beyond the number of columns, */
    tries = 40,          /* and how many points are tried for each: at half of them a root has no value, */
    most_sets = 4,       /* or at all of them, when it is one of the parameters' residues */
    longest = 3000       /* symbols of u'' */
};

static const double most_products = 4e6; /* of series, at all points: nothing hides in the equations of a long arm */

typedef nh_linear_motion_block linear;

typedef struct {
    const nh_model *o;
    nh_dag *d;
    const nh_dictionary *known; /* the system's functions */
    nh_jet_equations *equations;
    size_t words, drives;
    nh_ex word[most_words], drive[NH_LINEAR_MOTION_DRIVES];
    /* rows of `columns` residues: the coefficients of the words' second derivatives, of the first ones, of the words,
     * of the drives */
    nh_prime field;
    uint64_t parameters; /* the random state from which their residues follow, the same at all points */
    size_t relations, columns;
    nh_residue *relation;
    size_t *pivot; /* per relation: its word in u, which is in no other */
} problem;

/* ---- words ---- */

/* Adds e, once, while there is room. */
static void put(size_t *n, nh_ex *list, size_t most, nh_ex e)
{
    for (size_t i = 0; i < *n; i++)
        if (list[i] == e) return;
    if (*n < most) list[(*n)++] = e;
}

static void put_waves(nh_dag *d, size_t *n, nh_ex *list, size_t most, nh_ex argument, nh_function cosine)
{
    put(n, list, most, nh_call(d, cosine, argument));
    put(n, list, most, nh_call(d, cosine == NH_COS ? NH_SIN : NH_SINH, argument));
}

/* The function calls of the equations of motion. */
static size_t calls_in(const nh_model *model, size_t most, nh_ex *out)
{
    NH_LIST(own);
    const nh_ex *list[] = {model->rho, model->M, model->a};
    size_t n = 0, length[] = {model->m, model->n * model->n, model->n};
    for (size_t part = 0; part < sizeof list / sizeof *list; part++)
        for (size_t k = 0; k < length[part]; k++) {
            size_t found = nh_functions_in(model->dag, list[part][k], &own);
            for (size_t i = 0; i < found; i++) put(&n, out, most, own[i]);
        }
    return n;
}

/* Functions of s with the argument of this call over `parts`: 2 gives sin(s) for cos(2 s + y), exp(s) for exp(2 s). */
static void put_functions(const problem *p, nh_ex s, nh_ex call, int parts, size_t *n, nh_ex *out, size_t most)
{
    nh_dag *d = p->d;
    nh_ex u = nh_child(d, call, 0), slope = nh_diff(d, u, s);
    nh_function f = nh_function_of(d, call);
    bool back = nh_kind_of(d, slope) == NH_NUMBER    ? nh_num_value(nh_number_of(d, slope)) < 0
                : nh_kind_of(d, slope) == NH_PRODUCT ? nh_num_value(nh_constant_of(d, slope)) < 0
                                                     : false;
    if (f == NH_LOG && u == s) put(n, out, most, call);
    if (nh_is_zero(d, slope) || !nh_model_is_constant(p->o, slope)) return;
    nh_ex argument = nh_product(d, 3, (nh_ex[]){nh_ratio(d, 1, parts), slope, s});
    nh_ex forth = back ? nh_neg(d, argument) : argument;
    if (f == NH_SIN || f == NH_COS || f == NH_TAN) put_waves(d, n, out, most, forth, NH_COS);
    if (f == NH_SINH || f == NH_COSH || f == NH_TANH) put_waves(d, n, out, most, forth, NH_COSH);
    if (f == NH_EXP) put(n, out, most, nh_call(d, NH_EXP, argument));
}

/* Does it depend on no other coordinate, nor on t? */
static bool is_of(const problem *p, nh_ex e, nh_ex s)
{
    bool of = nh_depends(p->d, e, s) && !nh_depends(p->d, e, p->o->system->t);
    for (size_t k = 0; k < p->o->m; k++) {
        nh_ex q = p->o->system->coordinate[k].q;
        of = of && (q == s || !nh_depends(p->d, e, q));
    }
    return of;
}

/* s, functions of s that occur in the equations of motion, their derivatives, and the square. */
static size_t letters_of(const problem *p, nh_ex s, bool turns, size_t calls, const nh_ex *call, nh_ex *out)
{
    size_t n = 0;
    put(&n, out, most_letters, s);
    if (turns) put_waves(p->d, &n, out, most_letters, s, NH_COS);
    for (size_t i = 0; i < calls; i++) put_functions(p, s, call[i], 1, &n, out, most_letters);
    put(&n, out, most_letters, nh_powi(p->d, s, 2));
    for (size_t i = 0; i < p->known->atoms; i++) {
        nh_ex f = p->known->atom[i];
        if (!is_of(p, f, s)) continue;
        put(&n, out, most_letters, f);
        put(&n, out, most_letters, nh_simplify_short(p->d, nh_diff(p->d, f, s), 0));
    }
    for (size_t i = 0; i < calls; i++) put_functions(p, s, call[i], 2, &n, out, most_letters);
    return n;
}

/* All products of e and `factors` letters of different variables from number k on, the first `most` of each; false
 * where they are too many.  The last variable, time, is in no word alone: drives are functions of t. */
static bool add_words(problem *p, size_t k, size_t factors, nh_ex e, size_t most, const size_t *letters,
                      const nh_ex *letter)
{
    if (factors == 0 && p->words == most_words) return false;
    if (factors == 0) p->word[p->words++] = e;
    bool room = true;
    for (; k <= p->o->m && factors && room && (k < p->o->m || !nh_is_number(p->d, e, 1)); k++)
        for (size_t i = 0; i < letters[k] && i < most && room; i++)
            room =
                add_words(p, k + 1, factors - 1, nh_mul(p->d, e, letter[k * most_letters + i]), most, letters, letter);
    return room;
}

/* 1, t where it occurs outside of functions, and functions of t. */
static void find_drives(problem *p, size_t calls, const nh_ex *call)
{
    nh_ex t = p->o->system->t;
    put(&p->drives, p->drive, NH_LINEAR_MOTION_DRIVES, nh_int(p->d, 1));
    if (!p->equations->time) return;
    for (int parts = 1; parts <= 2; parts++)
        for (size_t i = 0; i < calls; i++)
            put_functions(p, t, call[i], parts, &p->drives, p->drive, NH_LINEAR_MOTION_DRIVES);
    put(&p->drives, p->drive, NH_LINEAR_MOTION_DRIVES, t);
    put(&p->drives, p->drive, NH_LINEAR_MOTION_DRIVES, nh_powi(p->d, t, 2));
}

/* `timed`: words have functions of t, too, as x cos(w t) + y sin(w t) of a trap that turns. */
static void find_words(problem *p, bool timed)
{
    enum { most_calls = 40, most_factors = 3 };
    static const size_t most_of[most_factors] = {most_letters, 6, 4}; /* letters of a coordinate, the plainest first */
    nh_jet_equations *x = p->equations;
    nh_ex call[most_calls], *letter = nh_alloc_array((p->o->m + 1) * most_letters, sizeof *letter);
    size_t *letters = nh_alloc_array(p->o->m + 1, sizeof *letters), calls = calls_in(p->o, most_calls, call);
    for (size_t k = 0; k < p->o->m; k++) {
        const nh_coordinate *q = &p->o->system->coordinate[k];
        bool turns = q->type == NH_ANGLE || nh_jet_equations_is_cyclic(x, q->q);
        letters[k] = letters_of(p, q->q, turns, calls, call, letter + k * most_letters);
    }
    for (int parts = 1; parts <= 2 && timed; parts++)
        for (size_t i = 0; i < calls; i++)
            put_functions(p, p->o->system->t, call[i], parts, &letters[p->o->m], letter + p->o->m * most_letters,
                          most_letters);
    bool room = true;
    for (size_t factors = 1; factors <= most_factors && room; factors++) {
        size_t before = p->words;
        room = add_words(p, 0, factors, nh_int(p->d, 1), most_of[factors - 1], letters, letter);
        if (!room) p->words = before;
    }
    find_drives(p, calls, call);
    nh_free(letters);
    nh_free(letter);
}

/* ---- relations at points ---- */

/* The words, their derivatives and the drives at a random point, into the first row; into the next ones their
 * derivatives along the motion, over k!, between which the same relations hold.  False: it is singular. */
static bool values_at(problem *p, const nh_ex *taken, uint64_t seed, nh_residue *rows)
{
    enum { order = 2 + rows_of_point - 1 };
    nh_jet_equations *x = p->equations;
    size_t one = 1, all = p->words + p->drives;
    uint64_t random = seed + 1;
    nh_jet_equations_choose(x, p->field, seed);
    uint64_t same = p->parameters;
    for (size_t k = 0; k < p->o->system->parameters; k++)
        x->at[x->coordinates + k] = nh_residue_random(p->field, &same);
    nh_jet_ring *ring = nh_jet_ring_create(p->field, 1, &one, order);
    size_t size = ring->size;
    nh_residue *w = nh_alloc_array(x->n + 1, sizeof *w), *v = nh_alloc_array(x->n * size + 1, sizeof *v),
               *q = nh_alloc_array(x->coordinates * size + 1, sizeof *q),
               *series = nh_alloc_array(all * size + 1, sizeof *series);
    for (size_t i = 0; i < x->n; i++) w[i] = nh_residue_random(p->field, &random);
    bool good = nh_jet_equations_along(x, ring, w, q, v);
    if (good) {
        nh_jet_eval *eval = nh_jet_equations_eval(x, ring, q);
        good = nh_jet_eval_all(eval, all, taken, series);
        nh_jet_eval_free(eval);
    }
    for (size_t k = 0; k < rows_of_point && good; k++) {
        nh_residue *row = rows + k * p->columns;
        for (size_t j = 0; j < p->words; j++) {
            const nh_residue *s = series + j * size + k;
            row[j] = nh_residue_mul(p->field, (k + 2) * (k + 1), s[2]);
            row[p->words + j] = nh_residue_mul(p->field, k + 1, s[1]);
            row[2 * p->words + j] = s[0];
        }
        for (size_t j = 0; j < p->drives; j++) row[3 * p->words + j] = series[(p->words + j) * size + k];
    }
    nh_free(series);
    nh_free(q);
    nh_free(v);
    nh_free(w);
    nh_jet_ring_free(ring);
    return good;
}

/* Words that are combinations of others and of drives, 1 + x^2 beside x^2, would be in relations that say nothing of
 * motions: they are dropped, with their columns. */
static void drop_dependent(problem *p, size_t rows, nh_residue *value)
{
    size_t W = p->words, K = p->drives, n = p->columns, kept = 0, *pivot = nh_alloc_array(W + K + 1, sizeof *pivot);
    nh_residue *own = nh_alloc_array(rows * (K + W) + 1, sizeof *own);
    for (size_t i = 0; i < rows; i++) {
        memcpy(own + i * (K + W), value + i * n + 3 * W, K * sizeof *own);
        memcpy(own + i * (K + W) + K, value + i * n + 2 * W, W * sizeof *own);
    }
    size_t rank = nh_residue_matrix_pivots(p->field, rows, K + W, own, pivot), left = 0, at = 0;
    for (size_t i = 0; i < rank; i++) left += pivot[i] >= K;
    p->columns = 3 * left + K;
    for (size_t i = 0; i < rank; i++)
        if (pivot[i] >= K) pivot[kept++] = pivot[i] - K;
    for (size_t i = 0; i < rows; i++) {
        for (size_t order = 0; order < 3; order++)
            for (size_t j = 0; j < left; j++) value[at++] = value[i * n + order * W + pivot[j]];
        for (size_t k = 0; k < K; k++) value[at++] = value[i * n + 3 * W + k];
    }
    for (size_t j = 0; j < left; j++) p->word[j] = p->word[pivot[j]];
    p->words = left;
    nh_free(own);
    nh_free(pivot);
}

/* The null space of the columns' values, as rows. */
static void null_space(problem *p, size_t rows, nh_residue *value)
{
    size_t n = p->columns, *pivot = nh_alloc_array(n + 1, sizeof *pivot), next = 0;
    size_t rank = nh_residue_matrix_echelon(p->field, rows, n, n, value, pivot);
    p->relation = nh_alloc_array((n - rank) * n + 1, sizeof *p->relation);
    for (size_t j = 0; j < n; j++) {
        if (next < rank && pivot[next] == j) {
            next++;
            continue;
        }
        nh_residue *r = p->relation + p->relations++ * n;
        r[j] = 1;
        for (size_t i = 0; i < next; i++) r[pivot[i]] = nh_residue_negative(p->field, value[i * n + j]);
    }
    nh_free(pivot);
}

/* Rows of values at enough random points, and their null space. */
static bool find_relations(problem *p)
{
    nh_jet_equations *x = p->equations;
    size_t all = p->words + p->drives, rows = 0, n = p->columns = 3 * p->words + p->drives, wanted = n + spare;
    nh_ex *taken = nh_alloc_array(all + 1, sizeof *taken);
    nh_residue *value = nh_alloc_array((wanted + rows_of_point) * n + 1, sizeof *value);
    for (size_t i = 0; i < all && !x->obstacle; i++) {
        taken[i] = i < p->words ? p->word[i] : p->drive[i - p->words];
        nh_jet_equations_take(x, true, &taken[i]);
    }
    bool good = !x->obstacle && x->products * (double)wanted <= most_products;
    if (good) p->field = nh_jet_point_prime(x->point, 0);
    for (p->parameters = 1; rows < wanted && p->parameters <= most_sets && good; p->parameters++) {
        rows = 0;
        for (uint64_t seed = 1; rows < wanted && seed <= tries * (rows + spare) && good && !nh_late(); seed++) {
            rows += values_at(p, taken, seed, value + rows * n) ? rows_of_point : 0;
            good = !x->obstacle;
        }
    }
    good = good && rows >= wanted;
    if (good) drop_dependent(p, rows, value);
    if (good) null_space(p, rows, value);
    nh_work_add(NH_WORK_RESIDUE, (double)rows * (x->products + (double)(n * n) / 4));
    nh_free(value);
    nh_free(taken);
    return good && p->relations;
}

/* ---- the largest closed space ---- */

/* Brings the second derivatives to reduced echelon form; pivot[] are their words.  Relations without any are
 * dropped. */
static void reduce(problem *p)
{
    p->relations = nh_residue_matrix_echelon(p->field, p->relations, p->columns, p->words, p->relation, p->pivot);
}

/* What a combination of words has outside of the span of the u. */
static void outside(const problem *p, const nh_residue *e, nh_residue *out)
{
    memcpy(out, e, p->words * sizeof *out);
    for (size_t i = 0; i < p->relations; i++) {
        nh_residue c = nh_residue_negative(p->field, e[p->pivot[i]]);
        if (c) nh_residue_add_multiple(p->field, p->words, out, p->relation + i * p->columns, c);
    }
}

/* Keeps the combinations of relations in which nothing is outside.  True where all of them are kept. */
static bool close_once(problem *p)
{
    size_t D = p->relations, W = p->words, n = 2 * W + D, *own = nh_alloc_array(n + 1, sizeof *own);
    nh_residue *E = nh_alloc_array(D * n + 1, sizeof *E);
    for (size_t i = 0; i < D; i++) {
        outside(p, p->relation + i * p->columns + W, E + i * n);
        outside(p, p->relation + i * p->columns + 2 * W, E + i * n + W);
        E[i * n + 2 * W + i] = 1;
    }
    size_t rank = nh_residue_matrix_echelon(p->field, D, n, 2 * W, E, own);
    nh_residue *kept = nh_alloc_array((D - rank) * p->columns + 1, sizeof *kept);
    for (size_t i = rank; i < D; i++)
        for (size_t r = 0; r < D; r++) {
            nh_residue c = E[i * n + 2 * W + r];
            const nh_residue *row = p->relation + r * p->columns;
            if (c) nh_residue_add_multiple(p->field, p->columns, kept + (i - rank) * p->columns, row, c);
        }
    nh_free(p->relation);
    p->relation = kept;
    p->relations = D - rank;
    nh_free(E);
    nh_free(own);
    return rank == 0;
}

static bool find_closed(problem *p)
{
    p->pivot = nh_alloc_array(p->columns + 1, sizeof *p->pivot);
    bool closed = false;
    reduce(p);
    while (!closed && p->relations) {
        closed = close_once(p);
        reduce(p);
    }
    return p->relations && p->relations <= most_functions;
}

/* Is a word in the u that is no coordinate?  Otherwise nothing is hidden. */
static bool is_hidden(const problem *p)
{
    bool hidden = false;
    for (size_t i = 0; i < p->relations; i++)
        for (size_t j = 0; j < p->words; j++)
            hidden |= p->relation[i * p->columns + j] && nh_kind_of(p->d, p->word[j]) != NH_SYMBOL;
    return hidden;
}

/* ---- the equations, for all parameters ---- */

/* What stands in a column. */
static nh_ex column(const problem *p, size_t j)
{
    size_t W = p->words;
    if (j >= 3 * W) return p->drive[j - 3 * W];
    nh_ex e = p->word[j % W];
    for (size_t order = 2 - j / W; order; order--) e = nh_simplify_short(p->d, nh_model_gamma(p->o, e), 0);
    return e;
}

/* The coefficients of relation i, which is the only one of the columns that it has; 0 in the others. */
static bool solve_relation(const problem *p, size_t i, const nh_options *options, nh_ex *out)
{
    const nh_residue *r = p->relation + i * p->columns;
    size_t n = 0, *at = nh_alloc_array(p->columns + 1, sizeof *at);
    nh_ex *e = nh_alloc_array(2 * p->columns + 1, sizeof *e), *c = e + p->columns;
    bool good = true;
    for (size_t j = 0; j < p->columns && good; j++) {
        out[j] = nh_int(p->d, 0);
        if (!r[j]) continue;
        e[n] = column(p, j);
        good = nh_complexity(p->d, e[n]) <= longest;
        at[n++] = j;
    }
    good = good && nh_fixed_relation_of_symbols(p->o, n, e, NULL, options, c);
    for (size_t k = 0; k < n && good; k++) out[at[k]] = c[k];
    nh_free(e);
    nh_free(at);
    return good && !nh_is_zero(p->d, out[p->pivot[i]]);
}

/* With c the coefficients of all relations, u_i = sum of c_ij word_j; in the echelon form a combination of the u has
 * the coefficient of u_k at its pivot. */
static void set_equations(const problem *p, const nh_ex *c, linear *l)
{
    nh_dag *d = p->d;
    size_t D = p->relations, W = p->words;
    for (size_t i = 0; i < D; i++) {
        const nh_ex *own = c + i * p->columns;
        l->z[i] = nh_int(d, 0);
        for (size_t j = 0; j < W; j++) l->z[i] = nh_add(d, l->z[i], nh_mul(d, own[j], p->word[j]));
        l->z[D + i] = nh_simplify_short(d, nh_model_gamma(p->o, l->z[i]), 0);
        l->entry[i + (D + i) * l->size] = nh_int(d, 1);
        for (size_t k = 0; k < D; k++) {
            nh_ex unit = nh_neg(d, c[k * p->columns + p->pivot[k]]);
            l->entry[D + i + (D + k) * l->size] = nh_simplify_short(d, nh_div(d, own[W + p->pivot[k]], unit), 0);
            l->entry[D + i + k * l->size] = nh_simplify_short(d, nh_div(d, own[2 * W + p->pivot[k]], unit), 0);
        }
        for (size_t k = 0; k < p->drives; k++)
            l->b[D + i] = nh_sub(d, l->b[D + i], nh_mul(d, own[3 * W + k], p->drive[k]));
    }
}

/* The relations for all parameters, and the search of linear_motion.c for z = (u, u'). */
static void solve(const problem *p, nh_stage_solver *solver)
{
    size_t D = p->relations;
    nh_ex *c = nh_alloc_array(D * p->columns + 1, sizeof *c);
    bool good = true;
    for (size_t i = 0; i < D && good; i++)
        good = solve_relation(p, i, &solver->r->question->options, c + i * p->columns);
    linear l = nh_linear_motion_create(solver, 2 * D, D);
    if (good) set_equations(p, c, &l);
    if (good && nh_linear_motion_drives(&l)) nh_linear_motion_solve(&l);
    nh_linear_motion_clear(&l);
    nh_free(c);
}

/* Searches the currents of such functions.  False where there are none, but may be in words with functions of t. */
static bool search_words(nh_stage_solver *solver, bool timed)
{
    const nh_model *model = solver->r->question->model;
    problem p = {
        .o = model, .d = model->dag, .known = &solver->words, .equations = nh_jet_equations_create(model, false, true)};
    bool autonomous = !p.equations->time;
    if (!p.equations->obstacle) find_words(&p, timed);
    bool found = p.words && find_relations(&p) && find_closed(&p) && is_hidden(&p);
    if (found) solve(&p, solver);
    nh_free(p.pivot);
    nh_free(p.relation);
    nh_jet_equations_free(p.equations);
    return found || autonomous;
}

void nh_linear_motion_functions(nh_stage_solver *solver)
{
    /* all currents of such equations are functions of those that are linear in (u, u'), with functions of t */
    if (solver->r->question->model->chart->implicit || nh_counted_covers(&solver->counted, 1, true)) return;
    nh_progress("linear equations that the coordinates hide", nh_budget_part());
    if (!search_words(solver, false)) search_words(solver, true);
}
