/* construct_rates: eigenvalues of the derivative along a cyclic coordinate on the space of solutions.
 * [docs/method.md, sec. 10, "Construction"]
 *
 *     rates_at      short series of all solutions; for each cyclic y the matrix A of d/dy (solution_matrix.h)
 *                   A = 0: y is idle;   minimal polynomial without square factors: y is pure;   factors: x - lambda,
 *                   x^2 + omega^2 of the characteristic polynomial, modulo the prime
 *     ask           the same at the parameters' values and with random residues for them
 *     name          omega^2 = short fraction times a monomial in the atoms, at both: a formula
 *     put_number    else a short fraction, or the root of one */
#include "count/construct_rates.h"

#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "count/scaling.h"
#include "graph/dag.h"
#include "graph/num.h"

enum { beyond_degree = 3, most_points = 20, most_coefficients = 4000, most_solutions = 120, most_squares = 64 };

/* ---- eigenvalues ---- */

/* omega^2 or -lambda^2 of integrals along coordinates, modulo a prime. */
typedef struct {
    nh_prime field;
    size_t count;
    nh_ex coordinate[most_squares];
    nh_residue square[most_squares], lambda[most_squares]; /* lambda: 0 where it is no residue */
} squares;

/* Once for each coordinate and eigenvalue. */
static void put_square(squares *out, nh_ex coordinate, nh_residue square, nh_residue lambda)
{
    for (size_t i = 0; i < out->count; i++)
        if (out->coordinate[i] == coordinate && out->square[i] == square && out->lambda[i] == lambda) return;
    if (out->count == most_squares) return;
    out->coordinate[out->count] = coordinate;
    out->square[out->count] = square;
    out->lambda[out->count++] = lambda;
}

/* Reads the factors x - lambda, and x^2 + omega^2.  No prime here has a root of -1, so that x^2 + omega^2 has no linear
 * factors where omega^2 is a square modulo p, and otherwise the two with lambda^2 = -omega^2. */
static void read_eigenvalues(const nmod_mat_t A, nh_ex coordinate, squares *out)
{
    nmod_poly_t characteristic;
    nmod_poly_factor_t parts;
    nmod_poly_init(characteristic, out->field.p);
    nmod_poly_factor_init(parts);
    nmod_mat_charpoly(characteristic, A);
    nmod_poly_factor(parts, characteristic);
    for (slong i = 0; i < parts->num; i++) {
        const nmod_poly_struct *f = parts->p + i;
        slong degree = nmod_poly_degree(f);
        nh_residue last = (nh_residue)nmod_poly_get_coeff_ui(f, 0), lambda = nh_residue_negative(out->field, last);
        nh_residue square = degree == 1 ? nh_residue_mul(out->field, last, lambda) : last; /* -lambda^2, omega^2 */
        bool wave = degree == 2 && !nmod_poly_get_coeff_ui(f, 1);
        if (last && (degree == 1 || wave)) put_square(out, coordinate, square, wave ? 0 : lambda);
    }
    nmod_poly_factor_clear(parts);
    nmod_poly_clear(characteristic);
}

/* Has A's minimal polynomial no square factor? */
static bool is_diagonalizable(const nmod_mat_t A)
{
    nmod_poly_t minimal;
    nmod_poly_init(minimal, A->mod.n);
    nmod_mat_minpoly(minimal, A);
    bool simple = nmod_poly_is_squarefree(minimal);
    nmod_poly_clear(minimal);
    return simple;
}

/* ---- a point ---- */

/* What is so of all solutions along a cyclic coordinate. */
typedef struct {
    bool idle, pure; /* none depends on it; none has a power of it */
} trait;

/* Reads the rates along coordinate k.  False where the series are too short. */
static bool rates_of(const nh_counter *c, const nh_count_series *s, const nh_graded_count *g, size_t k, trait *of,
                     nh_construct_rates *out, squares *seen)
{
    const nh_jet_ring *ring = s->ring;
    size_t N = g->total[g->order];
    nh_residue *along = nh_alloc_array(c->frame->all * ring->size, sizeof *along),
               *value = nh_alloc_array(N * N + 1, sizeof *value);
    nmod_mat_t A;
    nmod_mat_init(A, (slong)N, (slong)N, ring->field.p);
    nh_jet_constant(ring, 1, along + k * ring->size);
    bool closed = !N || nh_solution_matrix(c, s, g, along, NULL, value, &out->work);
    for (size_t i = 0; i < N; i++)
        for (size_t j = 0; j < N; j++) nmod_mat_entry(A, i, j) = value[i * N + j];
    of->idle &= closed && nmod_mat_is_zero(A);
    of->pure &= closed && (!N || is_diagonalizable(A));
    seen->field = ring->field;
    if (closed) read_eigenvalues(A, c->equations->coordinate[k], seen);
    nmod_mat_clear(A);
    nh_free(value);
    nh_free(along);
    return closed;
}

/* False: another point is needed.  `closed`: series of this order tell all solutions apart. */
static bool rates_at(nh_counter *c, size_t degree, size_t order, bool *closed, nh_construct_rates *out, squares *seen)
{
    const nh_adapted_frame *f = c->frame;
    bool regular = true;
    *closed = true;
    if (f->kept != f->all || nh_jet_ring_size(f->kept, f->weight, order, most_coefficients) == SIZE_MAX) return true;
    nh_count_series *s = nh_count_series_create(c, order, c->q->work, &regular);
    size_t coordinates = c->equations->coordinates, part = 0, parts = !s ? 0 : s->split ? 2 : 1;
    trait *of = nh_alloc_array(coordinates + 1, sizeof *of);
    bool all = parts > 0;
    for (size_t k = 0; k < coordinates; k++)
        of[k].idle = of[k].pure = nh_jet_equations_is_cyclic(c->equations, c->equations->coordinate[k]);
    for (; part < parts && !nh_late(); part++) {
        nh_parity parity = !s->split ? NH_ALL_DEGREES : part ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
        nh_graded_problem p = nh_count_problem(c, s, degree, parity);
        p.keep = true;
        nh_graded_count *g = nh_graded_solve(&p);
        out->work += g->work;
        bool few = g->solved && g->total[g->order] <= most_solutions;
        for (size_t k = 0; k < c->equations->coordinates && few; k++)
            if (nh_jet_equations_is_cyclic(c->equations, c->equations->coordinate[k]))
                *closed &= rates_of(c, s, g, k, &of[k], out, seen);
        all &= few;
        nh_graded_count_clear(g);
    }
    out->idle = out->pure = 0;
    for (size_t k = 0; k < coordinates && all && part == parts; k++) {
        if (of[k].idle && out->idle < NH_MOST_CONSTRUCT_RATES)
            out->idle_coordinate[out->idle++] = c->equations->coordinate[k];
        if (of[k].pure && out->pure < NH_MOST_CONSTRUCT_RATES)
            out->pure_coordinate[out->pure++] = c->equations->coordinate[k];
    }
    nh_free(of);
    nh_count_series_free(s);
    return s || regular;
}

/* At the first regular point. */
static void rates_somewhere(nh_counter *c, size_t degree, nh_construct_rates *out, squares *seen)
{
    bool some = false, done = false, closed = false;
    for (size_t k = 0; k < c->equations->coordinates && !c->equations->obstacle; k++)
        some |= nh_jet_equations_is_cyclic(c->equations, c->equations->coordinate[k]);
    for (size_t point = 0; some && !done && point < most_points && !c->equations->obstacle && !nh_late(); point++) {
        if (!nh_count_regular_point(c, point)) continue;
        size_t order = (degree + beyond_degree) * c->frame->step, more = (degree + 1) * c->frame->step;
        done = rates_at(c, degree, order, &closed, out, seen);
        if (done && !closed && out->work < c->q->work) done = rates_at(c, degree, order + more, &closed, out, seen);
    }
}

/* ---- rates ---- */

/* Longer fractions are often none: two residues of 2^31 are near to one another by chance. */
enum { longest_rate = 1000, longest_square = 20000, longest_multiple = 64 };
enum { most_atoms = 12, most_factors = 3 };

/* A question, and what its answer is at a place: the squares, and the residues of the atoms. */
typedef struct {
    nh_construct_rates rates;
    squares seen;
    nh_residue atom[most_atoms];
} answer;

typedef struct {
    nh_dag *dag;
    size_t atoms;
    const nh_ex *atom;
    answer given, generic; /* at the parameters' values, and for indeterminates */
    int power[most_atoms]; /* of the monomial at hand */
} naming;

/* The short fraction that a residue stands for; false: it is none. */
static bool fraction(nh_residue value, int64_t longest, nh_prime field, nh_num *out)
{
    int64_t top, bottom;
    bool found = nh_residue_fraction(field, value, longest, &top, &bottom);
    if (found) *out = nh_num_ratio(top, bottom);
    return found;
}

static nh_residue residue_of(nh_prime field, nh_num a)
{
    return nh_residue_mul(field, nh_residue_of(field, a.p), nh_residue_inverse(field, nh_residue_of(field, a.q)));
}

/* sqrt(p/q) = sqrt(p q)/q, with the square factors taken out of the root. */
static nh_num root_of(nh_num square, int64_t *radicand)
{
    int64_t p = llround(sqrt((double)square.p)), q = llround(sqrt((double)square.q));
    int64_t rest = square.p * square.q, out = 1;
    *radicand = 1;
    if (p * p == square.p && q * q == square.q) return nh_num_ratio(p, q);
    for (int64_t i = 2; i * i <= rest; i++)
        while (rest % (i * i) == 0) {
            rest /= i * i;
            out *= i;
        }
    *radicand = rest;
    return nh_num_ratio(out, square.q);
}

/* Once for each coordinate and rate. */
static void put(nh_construct_rates *out, nh_construct_rate r)
{
    for (size_t i = 0; i < out->count; i++) {
        const nh_construct_rate *o = &out->item[i];
        if (o->coordinate == r.coordinate && o->wave == r.wave && o->unit == r.unit && o->rate.p == r.rate.p &&
            o->rate.q == r.rate.q)
            return;
    }
    if (out->count < NH_MOST_CONSTRUCT_RATES) out->item[out->count++] = r;
}

/* Adds the rate with omega^2 = multiple prod_i a_i^power_i; whole powers stand outside of the root.  The residue of a
 * rational lambda gives its sign; an irrational lambda and its conjugate -lambda are both rates. */
static void put_root(naming *x, size_t at, nh_num multiple)
{
    nh_prime field = x->given.seen.field;
    nh_construct_rate r = {.coordinate = x->given.seen.coordinate[at], .wave = multiple.p > 0};
    nh_ex factor = nh_int(x->dag, 1), under = factor;
    nh_residue value = 1;
    int64_t radicand;
    multiple.p = r.wave ? multiple.p : -multiple.p;
    r.rate = root_of(multiple, &radicand);
    for (size_t i = 0; i < x->atoms; i++) {
        nh_residue a = x->given.atom[i];
        if (x->power[i] < 0) a = nh_residue_inverse(field, a);
        value = nh_residue_mul(field, value, nh_residue_power(field, a, (uint64_t)abs(x->power[i] / 2)));
        factor = nh_mul(x->dag, factor, nh_powi(x->dag, x->atom[i], x->power[i] / 2));
        under = nh_mul(x->dag, under, nh_powi(x->dag, x->atom[i], x->power[i] % 2));
    }
    under = nh_mul(x->dag, under, nh_int(x->dag, radicand));
    r.root = under != nh_int(x->dag, 1);
    r.unit = nh_mul(x->dag, factor, nh_pow(x->dag, under, nh_ratio(x->dag, 1, 2)));
    bool other =
        !r.wave && !r.root && nh_residue_mul(field, value, residue_of(field, r.rate)) != x->given.seen.lambda[at];
    if (!other) put(&x->given.rates, r);
    r.rate.p = -r.rate.p;
    if (!r.wave && (other || r.root)) put(&x->given.rates, r);
}

/* Multiplies the monomial, with these residues, by powers of `factors` more atoms: is a short multiple of it omega^2,
 * for indeterminates and at the parameters' values? */
static bool name(naming *x, size_t at, size_t from, size_t factors, nh_residue given, nh_residue generic)
{
    static const int power[] = {1, -1, 2, -2};
    const squares *s = &x->given.seen, *g = &x->generic.seen;
    nh_num multiple;
    for (size_t i = 0; i < g->count && !factors; i++) {
        if (g->coordinate[i] != s->coordinate[at]) continue;
        nh_residue ratio = nh_residue_mul(g->field, g->square[i], nh_residue_inverse(g->field, generic));
        if (!fraction(ratio, longest_multiple, g->field, &multiple)) continue;
        if (nh_residue_mul(s->field, residue_of(s->field, multiple), given) != s->square[at]) continue;
        put_root(x, at, multiple);
        return true;
    }
    for (size_t i = from; i < x->atoms && factors; i++)
        for (size_t k = 0; k < sizeof power / sizeof *power; k++) {
            nh_residue a = x->given.atom[i], b = x->generic.atom[i];
            if (power[k] < 0) {
                a = nh_residue_inverse(s->field, a);
                b = nh_residue_inverse(g->field, b);
            }
            a = nh_residue_mul(s->field, given, nh_residue_power(s->field, a, (uint64_t)abs(power[k])));
            b = nh_residue_mul(g->field, generic, nh_residue_power(g->field, b, (uint64_t)abs(power[k])));
            x->power[i] = power[k];
            if (name(x, at, i + 1, factors - 1, a, b)) return true;
            x->power[i] = 0;
        }
    return false;
}

/* As numbers. */
static void put_number(naming *x, size_t at)
{
    const squares *s = &x->given.seen;
    nh_num value;
    memset(x->power, 0, sizeof x->power);
    if (s->lambda[at] && fraction(s->lambda[at], longest_rate, s->field, &value))
        put_root(x, at, nh_num_ratio(-value.p * value.p, value.q * value.q));
    else if (fraction(s->square[at], longest_square, s->field, &value)) put_root(x, at, value);
}

/* The residues of the atoms at the point of the equations.  False: one of them is 0. */
static bool residues(const naming *x, nh_jet_equations *e, const nh_ex *taken, nh_residue *out)
{
    size_t one = 1;
    nh_jet_ring *point = nh_jet_ring_create(e->point->field, 1, &one, 0);
    nh_jet_eval *v = nh_jet_equations_eval(e, point, e->at);
    bool good = nh_jet_eval_all(v, x->atoms, taken, out);
    for (size_t i = 0; i < x->atoms && good; i++) good = out[i] != 0;
    nh_jet_eval_free(v);
    nh_jet_ring_free(point);
    return good;
}

/* False: the rates cannot be compared with the atoms. */
static bool ask(const naming *x, const nh_model *model, const nh_count_question *q, answer *out)
{
    nh_ex taken[most_atoms];
    nh_counter c;
    bool good = true;
    nh_counter_open(&c, model, q, false);
    for (size_t i = 0; i < x->atoms && good; i++) {
        taken[i] = x->atom[i];
        good = !c.equations->obstacle && nh_jet_equations_take(c.equations, true, &taken[i]);
    }
    if (!good) { /* their obstacle is none of the equations' */
        nh_counter_close(&c);
        nh_counter_open(&c, model, q, false);
    }
    rates_somewhere(&c, q->degree, &out->rates, &out->seen);
    good = good && out->seen.count && c.equations->point->field.p == out->seen.field.p &&
           residues(x, c.equations, taken, out->atom);
    nh_counter_close(&c);
    return good;
}

nh_construct_rates nh_construct_rates_of(const nh_model *model, size_t degree, bool time, size_t atoms,
                                         const nh_ex *atom, double work)
{
    nh_count_question q = {.time = time, .degree = degree, .work = work};
    naming x = {.dag = model->dag, .atoms = atoms < most_atoms ? atoms : most_atoms, .atom = atom};
    bool named = ask(&x, model, &q, &x.given);
    q.generic = true;
    named = named && x.atoms && x.given.rates.work < work && ask(&x, model, &q, &x.generic);
    x.given.rates.work += x.generic.rates.work;
    for (size_t at = 0; at < x.given.seen.count; at++) {
        bool found = false;
        memset(x.power, 0, sizeof x.power);
        for (size_t factors = 0; factors <= most_factors && named && !found; factors++)
            found = name(&x, at, 0, factors, 1, 1);
        if (!found) put_number(&x, at);
    }
    return x.given.rates;
}

nh_ex nh_construct_rate_argument(nh_dag *d, const nh_construct_rate *r)
{
    return nh_product(d, 3, (nh_ex[]){nh_number(d, r->rate), r->unit, r->coordinate});
}
