/* jet_equations: the equations of motion as power series, coefficients in the velocities by differentiation.
 *
 *     x->rho (m), M (n x n), A (n), coefficient (monomials x n)      expressions, registered at the jet point
 *     fields           b = rho(w = 0), R_i = rho(e_i) - b: series along the coordinates
 *     accelerations    M a = A solved for each monomial of w: n x monomials series
 *     along            a motion: each round of q' = rho, M v' = A gives one term more */
#include "count/jet_equations.h"

#include <string.h>

#include "exact/kernel.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/exact_points.h"

enum { largest_form = 2000, most_nodes = 4000 };

/* ---- expressions ---- */

size_t nh_jet_equations_monomials(size_t n) { return 1 + n + n * (n + 1) / 2; }

/* The index of w^i w^j, i <= j. */
static size_t quadratic(size_t n, size_t i, size_t j) { return 1 + n + i * n - i * (i - 1) / 2 - i + j; }

static nh_ex canonical(nh_jet_equations *x, nh_ex e)
{
    nh_region *side = x->complete ? NULL : &x->side;
    e = nh_region_roots_at_probe(x->model, nh_region_piece_at_probe(x->model, e, side), side);
    e = nh_canonical(x->dag, x->generic ? e : nh_model_values(x->model, e), largest_form);
    nh_ex without = nh_region_roots_at_probe(x->model, e, side);
    return without == e ? e : nh_canonical(x->dag, without, largest_form);
}

static bool has_velocity(const nh_jet_equations *x, nh_ex e)
{
    for (size_t i = 0; i < x->n; i++)
        if (nh_depends(x->dag, e, x->w[i])) return true;
    return false;
}

/* Roots and functions of the velocities, and what is divided by them, are not polynomial in them. */
static bool has_velocities_inside(const nh_jet_equations *x, nh_ex e)
{
    NH_LIST(node);
    size_t n = nh_functions_in(x->dag, e, &node);
    bool found = false;
    for (size_t i = 0; i < n && !found; i++) found = has_velocity(x, node[i]);
    n = nh_products_in(x->dag, e, &node);
    for (size_t k = 0; k < n && !found; k++)
        for (size_t f = 0; f < nh_arity(x->dag, node[k]) && !found; f++) {
            nh_ex power = nh_exponent_of(x->dag, node[k], f);
            bool whole = nh_kind_of(x->dag, power) == NH_NUMBER && nh_number_of(x->dag, power).q == 1 &&
                         nh_num_value(nh_number_of(x->dag, power)) > 0;
            found = (!whole && has_velocity(x, nh_child(x->dag, node[k], f))) || has_velocity(x, power);
        }
    return found;
}

bool nh_jet_equations_take(nh_jet_equations *x, bool polynomial, nh_ex *e)
{
    *e = canonical(x, *e);
    if (!nh_jet_point_register(x->point, 1, e)) x->obstacle = x->point->obstacle;
    else if (polynomial && has_velocities_inside(x, *e))
        x->obstacle = "functions that are not polynomial in the velocities";
    return !x->obstacle;
}

static nh_ex *take(nh_jet_equations *x, size_t n, const nh_ex *e)
{
    nh_ex *own = nh_arena_alloc(x->arena, (n + 1) * sizeof *own);
    for (size_t i = 0; i < n; i++) {
        own[i] = e[i];
        if (!x->obstacle) nh_jet_equations_take(x, true, &own[i]);
    }
    return own;
}

static bool depends_on_time(const nh_jet_equations *x)
{
    nh_ex t = x->model->system->t;
    bool found = false;
    for (size_t i = 0; i < x->m && !found; i++) found = nh_depends(x->dag, x->rho[i], t);
    for (size_t i = 0; i < x->n * x->n && !found; i++) found = nh_depends(x->dag, x->M[i], t);
    for (size_t i = 0; i < x->n && !found; i++) found = nh_depends(x->dag, x->A[i], t);
    return found;
}

/* Has rho a part without velocities? */
static bool affine(nh_jet_equations *x)
{
    nh_ex *zero = nh_alloc_array(x->n + 1, sizeof *zero);
    bool found = false;
    for (size_t i = 0; i < x->n; i++) zero[i] = nh_int(x->dag, 0);
    for (size_t s = 0; s < x->m && !found; s++)
        found = !nh_is_zero(x->dag, nh_substitute(x->dag, x->rho[s], x->n, x->w, zero));
    nh_free(zero);
    return found;
}

/* For the roots that are functions of others. */
static int sign_at_probe(void *equations, nh_ex e)
{
    nh_jet_equations *x = equations;
    return nh_region_sign_at_probe(x->model, e, &x->side);
}

static nh_jet_point *new_point(nh_jet_equations *x)
{
    nh_jet_point *point = nh_jet_point_create(x->dag);
    point->sign = sign_at_probe;
    point->context = x;
    return point;
}

/* The factors of the distinct products and functions in expressions. */
typedef struct {
    size_t count;
    nh_ex node[most_nodes];
    double fixed, moving; /* without velocities, which are computed once; with velocities */
} factors;

static void count_factors(const nh_jet_equations *x, size_t n, const nh_ex *e, factors *f)
{
    NH_LIST(found);
    for (size_t i = 0; i < n; i++)
        for (int functions = 0; functions < 2; functions++) {
            size_t count = functions ? nh_functions_in(x->dag, e[i], &found) : nh_products_in(x->dag, e[i], &found);
            for (size_t j = 0; j < count && f->count < most_nodes; j++) {
                bool old = false;
                for (size_t k = 0; k < f->count && !old; k++) old = f->node[k] == found[j];
                if (old) continue;
                f->node[f->count++] = found[j];
                *(has_velocity(x, found[j]) ? &f->moving : &f->fixed) +=
                    functions ? 1 : (double)nh_arity(x->dag, found[j]);
            }
        }
}

/* The cost of the equations: a product of series per factor, for those with velocities at each choice of these, and the
 * solution for the accelerations. */
static double products(const nh_jet_equations *x)
{
    double n = (double)x->n, monomials = (double)nh_jet_equations_monomials(x->n);
    factors *f = nh_alloc(sizeof *f);
    count_factors(x, x->m, x->rho, f);
    count_factors(x, x->n * x->n, x->M, f);
    count_factors(x, x->n * nh_jet_equations_monomials(x->n), x->coefficient, f);
    double out = f->fixed + (n + 2) * f->moving + n * n * (n + monomials);
    nh_free(f);
    return out;
}

/* A = sum over the monomials mu = 1, w^i, w^i w^j of coefficients times mu, if it is such a polynomial. */
static void find_coefficients(nh_jet_equations *x)
{
    nh_dag *d = x->dag;
    size_t n = x->n;
    nh_ex *zero = nh_alloc_array(n + 1, sizeof *zero), half = nh_ratio(d, 1, 2);
    nh_ex *c = x->coefficient = nh_arena_alloc(x->arena, (n * nh_jet_equations_monomials(n) + 1) * sizeof *c);
    for (size_t i = 0; i < n; i++) zero[i] = nh_int(d, 0);
    for (size_t l = 0; l < n; l++) {
        nh_ex A = x->A[l];
        c[l] = nh_canonical(d, nh_substitute(d, A, n, x->w, zero), largest_form);
        for (size_t i = 0; i < n; i++) {
            nh_ex slope = nh_diff(d, A, x->w[i]);
            c[(1 + i) * n + l] = nh_canonical(d, nh_substitute(d, slope, n, x->w, zero), largest_form);
            for (size_t j = i; j < n; j++) {
                nh_ex e = nh_substitute(d, nh_diff(d, slope, x->w[j]), n, x->w, zero);
                c[quadratic(n, i, j) * n + l] = nh_canonical(d, i == j ? nh_mul(d, half, e) : e, largest_form);
            }
        }
    }
    nh_free(zero);
}

nh_jet_equations *nh_jet_equations_create(const nh_model *model, bool time, bool generic)
{
    nh_arena *arena = nh_arena_create();
    nh_jet_equations *x = nh_arena_alloc(arena, sizeof *x);
    *x = (nh_jet_equations){.model = model,
                            .dag = model->dag,
                            .arena = arena,
                            .generic = generic,
                            .n = model->n,
                            .m = model->m,
                            .w = model->chart->w};
    x->point = new_point(x);
    if (model->chart->implicit) x->obstacle = "velocities that are given implicitly";
    x->rho = take(x, model->m, model->rho);
    x->M = take(x, model->n * model->n, model->M);
    x->A = take(x, model->n, model->A);
    if (!x->obstacle) find_coefficients(x);
    if (!x->obstacle &&
        !nh_jet_point_register(x->point, model->n * nh_jet_equations_monomials(model->n), x->coefficient))
        x->obstacle = x->point->obstacle;
    x->complete = true;
    x->products = x->obstacle ? 0 : products(x);
    x->time = time || depends_on_time(x);
    x->coordinates = model->m + x->time;
    x->coordinate = model->chart->symbol + !x->time; /* t, q */
    x->fields = model->n + (x->time || (!x->obstacle && affine(x)));
    x->at = nh_arena_alloc(arena, (x->coordinates + model->system->parameters + 2) * sizeof *x->at);
    return x;
}

static bool occurs(const nh_jet_equations *x, size_t n, const nh_ex *e, nh_ex symbol)
{
    bool found = false;
    for (size_t i = 0; i < n && !found; i++) found = nh_depends(x->dag, e[i], symbol);
    return found;
}

bool nh_jet_equations_is_cyclic(const nh_jet_equations *x, nh_ex q)
{
    return !occurs(x, x->m, x->rho, q) && !occurs(x, x->n * x->n, x->M, q) && !occurs(x, x->n, x->A, q);
}

/* Functions that only equations contained which were dropped are functions of no coordinate that is left. */
static void register_again(nh_jet_equations *x)
{
    nh_jet_point_free(x->point);
    x->point = new_point(x);
    if (!nh_jet_point_register(x->point, x->m, x->rho) || !nh_jet_point_register(x->point, x->n * x->n, x->M) ||
        !nh_jet_point_register(x->point, x->n, x->A) ||
        !nh_jet_point_register(x->point, x->n * nh_jet_equations_monomials(x->n), x->coefficient) ||
        !nh_jet_point_register(x->point, x->left, x->left_rate))
        x->obstacle = x->point->obstacle;
    x->products = products(x);
}

/* Drops coordinates of the list; `rates`: their rates are kept beside. */
static void without(nh_jet_equations *x, size_t count, const nh_ex *list, bool rates)
{
    nh_ex *coordinate = nh_arena_alloc(x->arena, (x->coordinates + 1) * sizeof *coordinate),
          *rho = nh_arena_alloc(x->arena, (x->m + 1) * sizeof *rho),
          *left = nh_arena_alloc(x->arena, (2 * count + 1) * sizeof *left), *left_rate = left + count;
    size_t kept = 0;
    if (x->time) coordinate[0] = x->coordinate[0];
    for (size_t s = 0; s < x->m; s++) {
        nh_ex q = x->coordinate[x->time + s];
        bool dropped = false;
        for (size_t i = 0; i < count; i++) dropped |= list[i] == q;
        if (dropped && rates) left[x->left] = q, left_rate[x->left++] = x->rho[s];
        if (dropped) continue;
        coordinate[x->time + kept] = q;
        rho[kept++] = x->rho[s];
    }
    bool some = kept < x->m;
    if (rates) x->left_coordinate = left, x->left_rate = left_rate;
    x->coordinate = coordinate;
    x->rho = rho;
    x->m = kept;
    x->coordinates = kept + x->time;
    if (some && !rates) register_again(x);
}

void nh_jet_equations_drop(nh_jet_equations *x, size_t count, const nh_ex *list) { without(x, count, list, false); }

/* Equations that contain a coordinate without depending on it are shorter without it. */
static nh_ex *settled(nh_jet_equations *x, size_t n, const nh_ex *e, nh_ex q)
{
    nh_ex *own = nh_arena_alloc(x->arena, (n + 1) * sizeof *own), zero = nh_int(x->dag, 0);
    for (size_t i = 0; i < n; i++) {
        own[i] = e[i];
        if (nh_depends(x->dag, e[i], q) && nh_normal_is_zero(x->dag, nh_diff(x->dag, e[i], q), 0) == NH_ZERO)
            own[i] = nh_canonical(x->dag, nh_substitute(x->dag, e[i], 1, &q, &zero), largest_form);
    }
    return own;
}

void nh_jet_equations_leave(nh_jet_equations *x, size_t count, const nh_ex *list)
{
    without(x, count, list, true);
    for (size_t s = 0; s < x->m; s++) {
        nh_ex q = x->coordinate[x->time + s];
        if (!occurs(x, x->left, x->left_rate, q)) continue;
        x->M = settled(x, x->n * x->n, x->M, q);
        x->A = settled(x, x->n, x->A, q);
        x->coefficient = settled(x, x->n * nh_jet_equations_monomials(x->n), x->coefficient, q);
    }
    register_again(x);
}

bool nh_jet_equations_drop_cyclic(nh_jet_equations *x)
{
    nh_ex *cyclic = nh_alloc_array(x->m + 1, sizeof *cyclic);
    size_t count = 0;
    for (size_t s = 0; s < x->m; s++)
        if (nh_jet_equations_is_cyclic(x, x->coordinate[x->time + s])) cyclic[count++] = x->coordinate[x->time + s];
    nh_jet_equations_drop(x, count, cyclic);
    nh_free(cyclic);
    return count > 0;
}

size_t nh_jet_equations_cyclic_rounds(const nh_model *model)
{
    nh_jet_equations *x = nh_jet_equations_create(model, false, false);
    size_t rounds = 0;
    while (!x->obstacle && nh_jet_equations_drop_cyclic(x)) rounds++;
    nh_jet_equations_free(x);
    return rounds;
}

void nh_jet_equations_free(nh_jet_equations *x)
{
    if (!x) return;
    nh_jet_point_free(x->point);
    nh_arena_free(x->arena);
}

void nh_jet_equations_choose(nh_jet_equations *x, nh_prime field, uint64_t seed)
{
    uint64_t random = seed + 12345;
    nh_jet_point_choose(x->point, field, seed);
    for (size_t k = 0; k <= x->coordinates + x->model->system->parameters; k++)
        x->at[k] = nh_residue_random(field, &random);
}

/* ---- values ---- */

static void set_constant(nh_jet_eval *v, const nh_jet_ring *ring, nh_ex symbol, nh_residue c, bool varies)
{
    nh_residue *series = nh_alloc_array(ring->size, sizeof *series);
    series[0] = c;
    nh_jet_eval_set(v, symbol, series, varies);
    nh_free(series);
}

nh_jet_eval *nh_jet_equations_eval(nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *coordinate)
{
    nh_jet_eval *v = nh_jet_eval_create(x->point, ring);
    for (size_t k = 0; k < x->coordinates; k++)
        nh_jet_eval_set(v, x->coordinate[k], coordinate + k * ring->size, false);
    for (size_t k = 0; k < x->model->system->parameters; k++)
        set_constant(v, ring, x->model->parameter[k], x->at[x->coordinates + k], false);
    if (!x->time)
        set_constant(v, ring, x->model->system->t, x->at[x->coordinates + x->model->system->parameters], false);
    for (size_t i = 0; i < x->n; i++) set_constant(v, ring, x->w[i], 0, true);
    return v;
}

void nh_jet_equations_velocities(nh_jet_equations *x, nh_jet_eval *v, const nh_jet_ring *ring, const nh_residue *w)
{
    for (size_t i = 0; i < x->n; i++) set_constant(v, ring, x->w[i], w[i], true);
}

static void random_velocities(nh_jet_equations *x, const nh_jet_ring *ring, nh_residue *w)
{
    uint64_t random = x->point->random + 99;
    for (size_t i = 0; i < x->n; i++) w[i] = nh_residue_random(ring->field, &random);
}

static bool same(const nh_jet_ring *ring, size_t count, const nh_residue *a, const nh_residue *b)
{
    return memcmp(a, b, count * ring->size * sizeof *a) == 0;
}

/* b is at 0 in `part`, then R_1, .. R_n: one series for each of the rates. */
static bool linear_parts(nh_jet_equations *x, nh_jet_eval *v, const nh_jet_ring *ring, size_t rates, const nh_ex *rho,
                         nh_residue *part)
{
    size_t block = rates * ring->size;
    nh_residue minus = (nh_residue)(ring->field.p - 1), *w = nh_alloc_array(x->n + 1, sizeof *w);
    bool good = nh_jet_eval_all(v, rates, rho, part);
    for (size_t i = 0; i < x->n && good; i++) {
        nh_residue *R = part + (1 + i) * block;
        w[i] = 1;
        nh_jet_equations_velocities(x, v, ring, w);
        w[i] = 0;
        good = nh_jet_eval_all(v, rates, rho, R);
        nh_residue_add_multiple(ring->field, block, R, part, minus);
    }
    nh_free(w);
    return good;
}

bool nh_jet_equations_fields(nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *coordinate,
                             nh_residue *out)
{
    size_t block = x->m * ring->size, field = x->coordinates * ring->size;
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    nh_residue *part = nh_alloc_array((x->n + 3) * block, sizeof *part), *expected = part + (x->n + 1) * block,
               *value = expected + block;
    nh_residue *w = nh_alloc_array(x->n + 1, sizeof *w);
    bool good = linear_parts(x, v, ring, x->m, x->rho, part);
    random_velocities(x, ring, w);
    nh_jet_equations_velocities(x, v, ring, w);
    if (good && nh_jet_eval_all(v, x->m, x->rho, value)) {
        memcpy(expected, part, block * sizeof *expected);
        for (size_t i = 0; i < x->n; i++)
            nh_residue_add_multiple(ring->field, block, expected, part + (1 + i) * block, w[i]);
        if (!same(ring, x->m, expected, value)) x->obstacle = "constraints that are not linear in the velocities";
    }
    for (size_t i = 0; i < x->fields; i++) {
        nh_residue *X = out + i * field;
        memset(X, 0, field * sizeof *X);
        memcpy(X + x->time * ring->size, part + (i < x->n ? 1 + i : 0) * block, block * sizeof *X);
        if (i == x->n && x->time) X[0] = 1;
    }
    nh_free(w);
    nh_free(part);
    nh_jet_eval_free(v);
    return good && !x->obstacle;
}

bool nh_jet_equations_left(nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *coordinate, nh_residue *out)
{
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    nh_residue *part = nh_alloc_array((x->n + 1) * x->left * ring->size + 1, sizeof *part);
    bool good = linear_parts(x, v, ring, x->left, x->left_rate, part);
    for (size_t a = 0; a < x->left; a++)
        for (size_t i = 0; i < x->fields; i++)
            memcpy(out + (a * x->fields + i) * ring->size, part + ((i < x->n ? 1 + i : 0) * x->left + a) * ring->size,
                   ring->size * sizeof *out);
    nh_free(part);
    nh_jet_eval_free(v);
    return good;
}

/* ---- accelerations ---- */

/* At random velocities A and M must agree with the polynomials; at the point alone. */
static bool is_polynomial(nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *coordinate,
                          const nh_residue *part, const nh_residue *M)
{
    size_t n = x->n, e = ring->size;
    nh_jet_ring *point = nh_jet_ring_create(ring->field, ring->variables, ring->weight, 0);
    nh_residue *q = nh_alloc_array(x->coordinates + 1, sizeof *q), *w = nh_alloc_array(n + 1, sizeof *w),
               *value = nh_alloc_array(n * n + n + 1, sizeof *value);
    for (size_t k = 0; k < x->coordinates; k++) q[k] = coordinate[k * e];
    nh_jet_eval *v = nh_jet_equations_eval(x, point, q);
    random_velocities(x, point, w);
    nh_jet_equations_velocities(x, v, point, w);
    bool good = nh_jet_eval_all(v, n, x->A, value) && nh_jet_eval_all(v, n * n, x->M, value + n), same_A = true,
         same_M = true;
    for (size_t l = 0; l < n && good; l++) {
        nh_residue sum = part[l * e];
        for (size_t i = 0; i < n; i++) {
            sum = nh_residue_add(ring->field, sum, nh_residue_mul(ring->field, part[((1 + i) * n + l) * e], w[i]));
            for (size_t j = i; j < n; j++)
                sum = nh_residue_add(ring->field, sum,
                                     nh_residue_mul(ring->field, part[(quadratic(n, i, j) * n + l) * e],
                                                    nh_residue_mul(ring->field, w[i], w[j])));
        }
        same_A = same_A && sum == value[l];
    }
    for (size_t i = 0; i < n * n && good; i++) same_M = same_M && value[n + i] == M[i * e];
    if (!same_A) x->obstacle = "forces or inertia that are not polynomial in the velocities of degree two";
    else if (!same_M) x->obstacle = "a kinetic energy that is not quadratic in the velocities";
    nh_jet_eval_free(v);
    nh_free(value);
    nh_free(w);
    nh_free(q);
    nh_jet_ring_free(point);
    return good && !x->obstacle;
}

bool nh_jet_equations_accelerations(nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *coordinate,
                                    nh_residue *out)
{
    size_t n = x->n, count = nh_jet_equations_monomials(n), e = ring->size;
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    nh_residue *part = nh_alloc_array(count * n * e + 1, sizeof *part), *M = nh_alloc_array(n * n * e + 1, sizeof *M);
    bool good = nh_jet_eval_all(v, n * n, x->M, M) && nh_jet_eval_all(v, count * n, x->coefficient, part) &&
                is_polynomial(x, ring, coordinate, part, M);
    for (size_t l = 0; l < n && good; l++)
        for (size_t mu = 0; mu < count; mu++)
            memcpy(out + (l * count + mu) * e, part + (mu * n + l) * e, e * sizeof *out);
    good = good && nh_jet_solve(ring, n, M, count, out);
    nh_free(M);
    nh_free(part);
    nh_jet_eval_free(v);
    return good;
}

/* ---- motions ---- */

bool nh_jet_equations_along(nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *w, nh_residue *q,
                            nh_residue *v)
{
    size_t n = x->n, size = ring->size, first = x->coordinates - x->m;
    nh_prime field = ring->field;
    nh_residue *M = nh_alloc_array(n * n * size + 1, sizeof *M), *a = nh_alloc_array(n * size + 1, sizeof *a),
               *rho = nh_alloc_array(x->m * size + 1, sizeof *rho);
    bool good = true;
    memset(q, 0, x->coordinates * size * sizeof *q);
    memset(v, 0, n * size * sizeof *v);
    for (size_t k = 0; k < x->coordinates; k++) q[k * size] = x->at[k];
    for (size_t i = 0; i < n; i++) v[i * size] = w[i];
    for (size_t s = 0; s + 1 < size && good; s++) { /* each time one term more is right */
        nh_residue part = nh_residue_inverse(field, s + 1);
        nh_jet_eval *eval = nh_jet_equations_eval(x, ring, q);
        for (size_t i = 0; i < n; i++) nh_jet_eval_set(eval, x->w[i], v + i * size, true);
        good = nh_jet_eval_all(eval, n * n, x->M, M) && nh_jet_eval_all(eval, n, x->A, a) &&
               nh_jet_eval_all(eval, x->m, x->rho, rho) && nh_jet_solve(ring, n, M, 1, a);
        for (size_t k = 0; k < x->coordinates && good; k++)
            q[k * size + s + 1] = k < first ? s == 0 : nh_residue_mul(field, part, rho[(k - first) * size + s]);
        for (size_t i = 0; i < n && good; i++) v[i * size + s + 1] = nh_residue_mul(field, part, a[i * size + s]);
        nh_jet_eval_free(eval);
    }
    nh_free(M);
    nh_free(a);
    nh_free(rho);
    return good;
}
