/* lift: linear equations for coefficients modulo primes. [docs/method.md, sec. 10, "Construction"]
 *
 *     choose_columns    at fixed residues: how does each c_j change with each parameter?  -> terms times monomials
 *     fractions         prime after prime: the null vector of  rate(term) monomial(parameters)  at random points
 *     gather            c_j = sum of fractions times monomials */
#include "count/lift.h"

#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "count/jet_equations.h"
#include "exact/fraction.h"
#include "exact/jet_independent.h"
#include "exact/residue_matrix.h"
#include "graph/dag.h"
#include "graph/num.h"
#include "integrals/fixed.h"

enum {
    spare = 8,  /* points beyond the number of columns */
    tries = 40, /* points that are tried for each that is needed: at half of them a root has no value */
    most_parameters = 12,
    most_power = 12, /* of a parameter */
    most_primes = 24,
    rows_together = 4 /* products of residues that dense algebra does in the time of one */
};

/* A term times a monomial in the parameters. */
typedef struct {
    size_t term;
    int power[most_parameters];
} column;

typedef struct {
    nh_jet_equations *equations;
    size_t terms, parameters; /* as indeterminates; 0: they have their values */
    nh_ex *term;
    nh_residue *rate; /* of the terms at the point */
    double work, most;
} lifting;

/* ---- rates at a point ---- */

/* Gamma of all terms at a random point.  `parameter`: their residues; NULL: random ones. */
static bool rates(lifting *l, nh_prime field, uint64_t seed, const nh_residue *parameter)
{
    nh_jet_equations *x = l->equations;
    size_t one = 1, n = x->n;
    uint64_t random = seed + 4711;
    nh_jet_equations_choose(x, field, seed);
    for (size_t k = 0; k < l->parameters && parameter; k++) x->at[x->coordinates + k] = parameter[k];
    nh_jet_ring *ring = nh_jet_ring_create(field, 1, &one, 1);
    nh_residue *w = nh_alloc_array(n + 1, sizeof *w), *v = nh_alloc_array(n * ring->size + 1, sizeof *v),
               *q = nh_alloc_array(x->coordinates * ring->size + 1, sizeof *q),
               *series = nh_alloc_array(l->terms * ring->size, sizeof *series);
    for (size_t i = 0; i < n; i++) w[i] = nh_residue_random(field, &random);
    bool good = nh_jet_equations_along(x, ring, w, q, v);
    if (good) {
        nh_jet_eval *eval = nh_jet_equations_eval(x, ring, q);
        for (size_t i = 0; i < n; i++) nh_jet_eval_set(eval, x->w[i], v + i * ring->size, true);
        good = nh_jet_eval_all(eval, l->terms, l->term, series);
        nh_jet_eval_free(eval);
    }
    for (size_t j = 0; j < l->terms && good; j++) l->rate[j] = series[j * ring->size + 1];
    l->work += x->products + (double)l->terms;
    nh_free(w);
    nh_free(v);
    nh_free(q);
    nh_free(series);
    nh_jet_ring_free(ring);
    return good;
}

/* ---- linear equations ---- */

/* A power of the parameters' residues at the point. */
static nh_residue monomial(const lifting *l, nh_prime field, const int *power)
{
    nh_residue out = 1;
    for (size_t k = 0; k < l->parameters; k++) {
        nh_residue p = l->equations->at[l->equations->coordinates + k];
        if (power[k] < 0) p = nh_residue_inverse(field, p);
        out = nh_residue_mul(field, out, nh_residue_power(field, p, (uint64_t)abs(power[k])));
    }
    return out;
}

/* The coefficients of the columns, the first being 1.  False: they are none, or not unique. */
static bool solve(lifting *l, nh_prime field, const nh_residue *parameter, size_t columns, const column *c,
                  nh_residue *out)
{
    size_t rows = columns + spare, row = 0, rank = 0, *pivot = nh_alloc_array(rows, sizeof *pivot);
    double cost = (double)rows * (double)columns * (double)columns / rows_together;
    nh_residue *a = NULL;
    bool good = l->work + cost <= l->most;
    if (good) a = nh_alloc_array(rows * columns, sizeof *a);
    for (uint64_t seed = 1; row < rows && seed <= tries * rows && good && !nh_late(); seed++) {
        good = l->work <= l->most && !l->equations->obstacle;
        if (!good || !rates(l, field, seed, parameter)) continue;
        /* the first column comes last: the others have pivots */
        for (size_t j = 0; j < columns; j++)
            a[row * columns + (j + columns - 1) % columns] =
                nh_residue_mul(field, l->rate[c[j].term], monomial(l, field, c[j].power));
        row++;
    }
    if (good && row == rows) rank = nh_residue_matrix_echelon(field, rows, columns, columns, a, pivot);
    good = rank > 0 && rank + 1 == columns && pivot[rank - 1] == rank - 1;
    out[0] = 1;
    for (size_t j = 1; j < columns && good; j++) out[j] = nh_residue_sub(field, 0, a[(j - 1) * columns + columns - 1]);
    l->work += cost;
    nh_free(a);
    nh_free(pivot);
    return good;
}

/* ---- over the rational numbers ---- */

static bool read_fractions(size_t count, size_t primes, const nh_prime *prime, nh_residue *const *residue, nh_num *out)
{
    nh_residue *own = nh_alloc_array(primes, sizeof *own);
    fmpq_t q;
    fmpq_init(q);
    bool good = true;
    for (size_t j = 0; j < count && good; j++) {
        for (size_t i = 0; i < primes; i++) own[i] = residue[i][j];
        good = nh_fraction_of(primes, prime, own, q) && fmpz_fits_si(fmpq_numref(q)) && fmpz_fits_si(fmpq_denref(q));
        if (good) out[j] = nh_num_ratio(fmpz_get_si(fmpq_numref(q)), fmpz_get_si(fmpq_denref(q)));
    }
    fmpq_clear(q);
    nh_free(own);
    return good;
}

/* Takes one prime after another until all coefficients are fractions. */
static bool fractions(lifting *l, size_t columns, const column *c, nh_num *out)
{
    nh_prime prime[most_primes];
    nh_residue *residue[most_primes];
    size_t primes = 0;
    bool good = true, found = false;
    while (good && !found && primes < most_primes) {
        prime[primes] = nh_jet_point_prime(l->equations->point, primes);
        for (size_t i = 0; i < primes && good; i++) good = prime[i].p != prime[primes].p;
        residue[primes] = nh_alloc_array(columns, sizeof **residue);
        good = good && solve(l, prime[primes], NULL, columns, c, residue[primes]);
        primes++;
        found = good && primes > 1 && read_fractions(columns, primes, prime, residue, out);
    }
    for (size_t i = 0; i < primes; i++) nh_free(residue[i]);
    return found;
}

/* ---- monomials in the parameters ---- */

/* The k with b = 4^k a. */
static bool power_of_four(nh_prime field, nh_residue a, nh_residue b, int *k)
{
    nh_residue up = a, down = b, four = nh_residue_of(field, 4);
    if (!a || !b) {
        *k = 0;
        return a == b;
    }
    for (*k = 0; *k <= most_power; ++*k) {
        if (up == b) return true;
        if (down == a) {
            *k = -*k;
            return true;
        }
        up = nh_residue_mul(field, up, four);
        down = nh_residue_mul(field, down, four);
    }
    return false;
}

/* Residues of the parameters at which the terms have values: roots of parameters have them only at some. */
static bool choose_parameters(lifting *l, nh_prime field, nh_residue *at)
{
    enum { most_choices = 32, places = 16 };
    uint64_t random = 31, seed = 0;
    for (size_t choice = 0; choice < most_choices; choice++) {
        for (size_t k = 0; k < l->parameters; k++) at[k] = nh_residue_random(field, &random);
        for (size_t place = 0; place < places && !l->equations->obstacle; place++)
            if (rates(l, field, ++seed, at)) return true;
    }
    return false;
}

/* Appends the term times all monomials of this degree in the parameters of the list. */
static bool add_monomials(column c, size_t mixed, const size_t *parameter, int degree, column *out, size_t *count,
                          size_t most)
{
    if (degree < 0 || *count == most) return false;
    if (mixed == 1 || degree == 0) {
        for (size_t i = 0; i < mixed; i++) c.power[parameter[i]] = i ? 0 : degree;
        out[(*count)++] = c;
        return true;
    }
    bool good = true;
    for (int own = 0; own <= degree && good; own++) {
        c.power[parameter[0]] = own;
        good = add_monomials(c, mixed - 1, parameter + 1, degree - own, out, count, most);
    }
    return good;
}

/* The columns that integrals for all parameters consist of. */
static bool choose_columns(lifting *l, size_t most, column *out, size_t *count)
{
    size_t terms = l->terms, parameters = l->parameters;
    nh_prime field = nh_jet_point_prime(l->equations->point, 0);
    nh_residue at[most_parameters] = {0}, *base = nh_alloc_array(terms, sizeof *base),
               *scaled = nh_alloc_array((parameters + 1) * terms, sizeof *scaled);
    column *plain = nh_alloc_array(terms, sizeof *plain);
    for (size_t j = 0; j < terms; j++) plain[j].term = j;
    bool good = choose_parameters(l, field, at) && solve(l, field, at, terms, plain, base);
    for (size_t k = 0; k <= parameters && good; k++) { /* the last time all of them */
        nh_residue moved[most_parameters] = {0};
        for (size_t i = 0; i < parameters; i++)
            moved[i] = i == k || k == parameters ? nh_residue_mul(field, nh_residue_of(field, 4), at[i]) : at[i];
        good = solve(l, field, moved, terms, plain, scaled + k * terms);
    }
    *count = 0;
    for (size_t j = 0; j < terms && good; j++) {
        size_t mixed = 0, parameter[most_parameters];
        int degree = 0;
        for (size_t k = 0; k < parameters; k++)
            if (!power_of_four(field, base[j], scaled[k * terms + j], &plain[j].power[k])) parameter[mixed++] = k;
        if (mixed) good = power_of_four(field, base[j], scaled[parameters * terms + j], &degree);
        for (size_t k = 0; k < parameters; k++) {
            bool own = true;
            for (size_t i = 0; i < mixed; i++) own &= parameter[i] != k;
            if (own && mixed) degree -= plain[j].power[k];
        }
        good = good && add_monomials(plain[j], mixed, parameter, degree, out, count, most);
    }
    nh_free(plain);
    nh_free(scaled);
    nh_free(base);
    return good;
}

/* ---- the whole ---- */

/* The coefficient of each term, from those of its columns. */
static void gather(const nh_model *model, size_t terms, size_t columns, const column *c, const nh_num *coefficient,
                   nh_ex *out)
{
    for (size_t j = 0; j < terms; j++) out[j] = nh_int(model->dag, 0);
    for (size_t j = 0; j < columns; j++) {
        nh_ex e = nh_number(model->dag, coefficient[j]);
        for (size_t k = 0; k < model->system->parameters && k < most_parameters; k++)
            if (c[j].power[k]) e = nh_mul(model->dag, e, nh_powi(model->dag, model->parameter[k], c[j].power[k]));
        out[c[j].term] = nh_add(model->dag, out[c[j].term], e);
    }
}

/* One expression from terms with rational coefficients, which residues modulo several primes give; false where they
 * do not. */
static bool lift(const nh_model *model, bool time, bool generic, size_t terms, const nh_ex *term, double most,
                 double *work, nh_ex *out)
{
    enum { times_as_many = 3 }; /* columns as terms */
    lifting l = {.equations = nh_jet_equations_create(model, time, generic), .terms = terms, .most = most};
    nh_jet_equations *x = l.equations;
    size_t room = times_as_many * terms, columns = terms;
    column *c = nh_alloc_array(room, sizeof *c);
    nh_num *coefficient = nh_alloc_array(room, sizeof *coefficient);
    bool good = !x->obstacle;
    l.parameters = generic ? model->system->parameters : 0;
    l.term = nh_alloc_array(terms, sizeof *l.term);
    l.rate = nh_alloc_array(terms, sizeof *l.rate);
    for (size_t j = 0; j < terms && good; j++) {
        l.term[j] = term[j];
        c[j].term = j;
        good = nh_jet_equations_take(x, true, &l.term[j]);
    }
    nh_jet_point_related(x->point); /* for the roots that are functions of others; what is found is only proposed */
    if (generic) good = good && choose_columns(&l, room, c, &columns);
    good = good && fractions(&l, columns, c, coefficient);
    if (good) gather(model, terms, columns, c, coefficient, out);
    *work += l.work;
    nh_free(coefficient);
    nh_free(c);
    nh_free(l.term);
    nh_free(l.rate);
    nh_jet_equations_free(x);
    return good;
}

static nh_ex sum(nh_dag *d, size_t n, const nh_ex *term, const nh_ex *coefficient)
{
    nh_ex *e = nh_alloc_array(n, sizeof *e);
    nh_num *one = nh_alloc_array(n, sizeof *one);
    for (size_t j = 0; j < n; j++) {
        e[j] = nh_mul(d, coefficient[j], term[j]);
        one[j] = nh_num_int(1);
    }
    nh_ex out = nh_linear(d, n, one, e);
    nh_free(one);
    nh_free(e);
    return out;
}

nh_lift_result nh_lift(const nh_model *model, bool time, size_t terms, const nh_ex *term, double most)
{
    nh_lift_result out = {0};
    size_t parameters = model->system->parameters;
    if (terms < 2) return out;
    nh_ex *coefficient = nh_alloc_array(terms, sizeof *coefficient);
    out.general = parameters && parameters <= most_parameters &&
                  lift(model, time, true, terms, term, most, &out.work, coefficient);
    if (out.general || lift(model, time, false, terms, term, most - out.work, &out.work, coefficient))
        out.integral = sum(model->dag, terms, term, coefficient);
    nh_free(coefficient);
    return out;
}

static bool has_time(const nh_model *model, size_t terms, const nh_ex *term)
{
    bool has = false;
    for (size_t j = 0; j < terms; j++) has |= nh_depends(model->dag, term[j], model->system->t);
    for (size_t s = 0; s < model->m; s++) has |= nh_depends(model->dag, model->rho[s], model->system->t);
    for (size_t i = 0; i < model->n; i++) has |= nh_depends(model->dag, model->a[i], model->system->t);
    return has;
}

bool nh_lift_coefficients(const nh_model *model, size_t terms, const nh_ex *term, const double *like, size_t pivot,
                          double most, nh_ex *coefficient)
{
    enum { few = 4 };
    size_t parameters = model->system->parameters;
    if (terms < 2 || parameters > most_parameters) return false;
    nh_ex *turned = nh_alloc_array(terms, sizeof *turned);
    bool found = false, time = has_time(model, terms, term);
    double work = 0;
    for (size_t k = 0; k <= terms && k <= few && !found && work < most; k++) { /* f_0 changes places with another */
        size_t first = k ? k - 1 : pivot;
        memcpy(turned, term, terms * sizeof *turned);
        turned[0] = term[first];
        turned[first] = term[0];
        found = lift(model, time, parameters > 0, terms, turned, most - work, &work, coefficient);
        if (!found) continue;
        nh_ex swapped = coefficient[0];
        coefficient[0] = coefficient[first];
        coefficient[first] = swapped;
        found = nh_fixed_is_like(model, terms, coefficient, like);
    }
    nh_free(turned);
    return found;
}
