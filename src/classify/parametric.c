/* The equations of motion as series at a point, at values of the parameters (parametric.h).
 *
 *      look          how the equations depend on the parameters, and what they are divided by
 *      choose        a point modulo a prime: coordinates, other parameters, functions
 *      value         at one lambda: coordinates and Q Gamma as series (ring up to the order)
 *      interpolate   value after value of lambda: Q Gamma = sum_j lambda^j G_j (parametric_interpolate.c)
 *      at            the series of Q Gamma at any lambda, as a problem for the count
 *
 * Q = (denominator of M)^n det M times the other denominators: with it no coefficient divides by a function of
 * lambda. */
#include <flint/nmod_mat.h>
#include <string.h>

#include "base/progress.h"
#include "classify/parametric_internal.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_factors = 16, most_degree = 12, largest_series = 20000, most_parameters = 3000 };

/* ---- what depends on the parameter, and how ---- */

/* Does e depend on one of the parameters? */
static bool depends(const nh_parametric *f, nh_ex e)
{
    const nh_jet_equations *x = f->counter.equations;
    bool any = false;
    for (size_t k = 0; k < f->parameters; k++) any |= nh_depends(x->dag, e, x->model->parameter[f->parameter[k]]);
    return any;
}

/* The place of a denominator in the list; it is added where it is not there. */
static size_t factor_of(nh_parametric *f, nh_ex base)
{
    for (size_t i = 0; i < f->factors; i++)
        if (f->factor[i] == base) return i;
    if (f->factors == most_factors) {
        f->obstacle = "equations that are divided by too many functions of the parameter";
        return 0;
    }
    f->factor[f->factors] = base;
    return f->factors++;
}

void nh_parametric_denominators(nh_parametric *f, size_t n, const nh_ex *e, size_t *power)
{
    nh_dag *d = f->counter.equations->dag;
    NH_LIST(product);
    for (size_t k = 0; k < n && !f->obstacle; k++) {
        size_t count = nh_products_in(d, e[k], &product);
        for (size_t i = 0; i < count && !f->obstacle; i++)
            for (size_t j = 0; j < nh_arity(d, product[i]); j++) {
                double x = nh_num_value(nh_number_of(d, nh_exponent_of(d, product[i], j)));
                nh_ex base = nh_child(d, product[i], j);
                if (x >= 0 || !depends(f, base)) continue;
                size_t at = factor_of(f, base);
                if (power[at] < (size_t)-x) power[at] = (size_t)-x;
            }
    }
}

bool nh_parametric_rational(nh_dag *d, nh_ex e, nh_ex symbol)
{
    NH_LIST(node);
    bool rational = true;
    size_t count = nh_functions_in(d, e, &node);
    for (size_t i = 0; i < count && rational; i++) rational = !nh_depends(d, node[i], symbol);
    count = nh_products_in(d, e, &node);
    for (size_t i = 0; i < count && rational; i++)
        for (size_t j = 0; j < nh_arity(d, node[i]) && rational; j++) {
            nh_ex exponent = nh_exponent_of(d, node[i], j);
            bool whole = nh_kind_of(d, exponent) == NH_NUMBER && nh_number_of(d, exponent).q == 1;
            rational =
                whole ? true : !nh_depends(d, nh_child(d, node[i], j), symbol) && !nh_depends(d, exponent, symbol);
        }
    return rational;
}

/* Does a parameter occur inside a function or root, where the equations are not rational in it? */
static bool inside_functions(const nh_parametric *f)
{
    const nh_jet_point *p = f->counter.equations->point;
    for (size_t k = 0; k < p->kernels; k++)
        if (depends(f, p->kernel[k].key)) return true;
    return false;
}

bool nh_parametric_depends(const nh_parametric *f, size_t n, const nh_ex *e)
{
    bool any = false;
    for (size_t i = 0; i < n; i++) any |= depends(f, e[i]);
    return any;
}

static bool among(const nh_parametric *f, size_t n, const nh_ex *e, nh_ex symbol)
{
    for (size_t i = 0; i < n; i++)
        if (nh_depends(f->counter.equations->dag, e[i], symbol)) return true;
    return false;
}

const char *const nh_parametric_constant = "the equations do not depend on the parameter";

static bool in_equations(const nh_parametric *f, nh_ex symbol)
{
    const nh_jet_equations *x = f->counter.equations;
    return among(f, x->m, x->rho, symbol) || among(f, x->n * x->n, x->M, symbol) || among(f, x->n, x->A, symbol);
}

/* A density that is a function of a cyclic angle alone does not depend on it: its logarithm has a constant
 * derivative. */
static bool is_kept(const nh_parametric *f, size_t k)
{
    const nh_jet_equations *x = f->counter.equations;
    if (in_equations(f, x->coordinate[k])) return true;
    bool angle = k >= x->time && x->model->system->coordinate[k - x->time].type == NH_ANGLE;
    return !f->shape && !(f->linear && angle);
}

/* The coordinates of the series are those of the file in systems without constraints, and of the shape alone where
 * there are as many velocities as coordinates left. */
static bool plain(const nh_parametric *f)
{
    return f->linear || f->counter.equations->n == f->counter.equations->m ||
           (f->shape && f->kept <= f->counter.equations->n);
}

/* Obstacles; and of each denominator its power in M, and what A and rho have beyond that. */
static void look(nh_parametric *f)
{
    const nh_jet_equations *x = f->counter.equations;
    size_t of_rest[most_factors] = {0};
    bool constant = true;
    for (size_t k = 0; k < f->parameters; k++) constant &= !in_equations(f, x->model->parameter[f->parameter[k]]);
    if (inside_functions(f)) f->obstacle = "the parameter occurs inside of a function or a root";
    else if (!plain(f) && nh_parametric_depends(f, x->m, x->rho))
        f->obstacle = "the constraints depend on the parameter";
    else if (constant) f->obstacle = nh_parametric_constant;
    if (f->obstacle) return;
    nh_parametric_denominators(f, x->n * x->n, x->M, f->of_mass);
    nh_parametric_denominators(f, x->n, x->A, f->of_rest);
    nh_parametric_denominators(f, x->m, x->rho, of_rest);
    for (size_t i = 0; i < f->factors; i++) { /* adj(q M) q A is already free of the denominators of M */
        size_t more = f->of_rest[i] > f->of_mass[i] ? f->of_rest[i] - f->of_mass[i] : 0;
        f->of_rest[i] = more > of_rest[i] ? more : of_rest[i];
    }
}

void nh_parametric_open(nh_parametric *f, const nh_model *model, size_t parameters, const size_t *parameter, bool shape,
                        const nh_linear_family *linear, const nh_count_question *question)
{
    *f = (nh_parametric){.parameters = parameters, .shape = shape, .linear = linear};
    memcpy(f->parameter, parameter, parameters * sizeof *parameter);
    nh_counter_open(&f->counter, model, question, false);
    nh_jet_equations *x = f->counter.equations;
    f->index = nh_alloc_array(x->coordinates + 1, sizeof *f->index);
    f->factor = nh_alloc_array(most_factors, sizeof *f->factor);
    f->of_mass = nh_alloc_array(most_factors, sizeof *f->of_mass);
    f->of_rest = nh_alloc_array(most_factors, sizeof *f->of_rest);
    if (linear && linear->coefficient) {
        nh_parametric_linear_open(f);
        return;
    }
    f->obstacle = x->obstacle;
    for (size_t k = 0; k < x->coordinates; k++)
        if (is_kept(f, k)) f->index[f->kept++] = k;
    if (!f->obstacle) look(f);
}

void nh_parametric_close(nh_parametric *f)
{
    nh_counter_close(&f->counter);
    nh_free(f->entry);
    nh_free(f->of_rest);
    nh_free(f->of_mass);
    nh_free(f->factor);
    nh_free(f->index);
}

/* ---- points ---- */

bool nh_parametric_choose(nh_parametric *f, nh_prime field, uint64_t seed)
{
    nh_jet_equations *x = f->counter.equations;
    nh_adapted_frame_free(f->counter.frame);
    f->counter.frame = NULL;
    nh_jet_equations_choose(x, field, seed);
    if (f->linear && f->linear->coefficient) return true;
    return nh_count_take_known(&f->counter) && (plain(f) || (f->counter.frame = nh_adapted_frame_create(x)) != NULL);
}

size_t nh_parametric_kept(const nh_parametric *f) { return plain(f) ? f->kept : f->counter.frame->kept; }
size_t nh_parametric_step(const nh_parametric *f)
{
    const nh_adapted_frame *frame = f->counter.frame;
    return f->linear ? f->linear->step : plain(f) ? 1 : frame ? frame->step : 0;
}

/* ---- series at one value ---- */

void nh_parametric_determinant(const nh_jet_ring *r, size_t n, nh_residue *M, nh_residue *out)
{
    nh_residue *inverse = nh_alloc_array(2 * r->size, sizeof *inverse), *ratio = inverse + r->size;
    nh_jet_constant(r, 1, out);
    for (size_t k = 0; k < n; k++) {
        size_t pivot = k;
        while (pivot < n && !M[(pivot * n + k) * r->size]) pivot++;
        if (pivot == n) {
            memset(out, 0, r->size * sizeof *out);
            break;
        }
        for (size_t z = 0; z < n * r->size && pivot != k; z++) {
            nh_residue other = M[k * n * r->size + z];
            M[k * n * r->size + z] = M[pivot * n * r->size + z];
            M[pivot * n * r->size + z] = nh_residue_negative(r->field, other);
        }
        const nh_residue *at = M + (k * n + k) * r->size;
        nh_jet_mul(r, out, at, ratio);
        memcpy(out, ratio, r->size * sizeof *out);
        nh_jet_power(r, at, (nh_residue)(r->field.p - 1), nh_residue_inverse(r->field, at[0]), inverse);
        for (size_t i = k + 1; i < n; i++) {
            nh_jet_mul(r, M + (i * n + k) * r->size, inverse, ratio);
            for (size_t j = k; j < n; j++)
                nh_jet_sub_product(r, M + (i * n + j) * r->size, ratio, M + (k * n + j) * r->size);
        }
    }
    nh_free(inverse);
}

void nh_parametric_times(const nh_jet_ring *r, nh_residue *sum, const nh_residue *factor, nh_residue *work)
{
    nh_jet_mul(r, sum, factor, work);
    memcpy(sum, work, r->size * sizeof *sum);
}

void nh_parametric_set(nh_parametric *f)
{
    const nh_jet_equations *x = f->counter.equations;
    for (size_t k = 0; k < f->parameters; k++) x->at[x->coordinates + f->parameter[k]] = f->value[k];
}

/* Q = (denominator of M)^n det M (the other denominators) */
static bool multiplier(nh_parametric *f, const nh_jet_ring *r, const nh_residue *coordinate, nh_residue *out)
{
    nh_jet_equations *x = f->counter.equations;
    nh_residue *M = nh_alloc_array((x->n * x->n + 2) * r->size, sizeof *M), *value = M + x->n * x->n * r->size,
               *work = value + r->size;
    nh_jet_eval *v = nh_jet_equations_eval(x, r, coordinate);
    bool good = nh_jet_eval_all(v, x->n * x->n, x->M, M);
    if (good) nh_parametric_determinant(r, x->n, M, out);
    for (size_t i = 0; i < f->factors && good; i++) {
        good = nh_jet_eval_all(v, 1, &f->factor[i], value);
        for (size_t k = 0; k < f->of_mass[i] * x->n + f->of_rest[i] && good; k++)
            nh_parametric_times(r, out, value, work);
    }
    nh_jet_eval_free(v);
    nh_free(M);
    return good;
}

bool nh_parametric_singular(nh_parametric *f, nh_prime field)
{
    enum { points = 3, attempts = 60 };
    bool linear = f->linear && f->linear->coefficient;
    size_t variables = linear ? f->kept : 0, *one = nh_alloc_array(variables + 1, sizeof *one), zeros = 0;
    for (size_t k = 0; k < variables; k++) one[k] = 1;
    nh_jet_ring *r = nh_jet_ring_create(field, variables, one, 1);
    nh_residue *Q = nh_alloc_array(r->size, sizeof *Q);
    bool regular = false;
    for (uint64_t seed = 0; seed < attempts && zeros < points && !regular && !f->obstacle; seed++) {
        if (!nh_parametric_choose(f, field, seed)) continue;
        nh_parametric_set(f);
        if (linear ? !nh_parametric_linear_multiplier(f, r, Q) : !multiplier(f, r, f->counter.equations->at, Q))
            continue;
        zeros += !Q[0];
        regular = Q[0];
    }
    nh_free(Q);
    nh_free(one);
    nh_jet_ring_free(r);
    return zeros == points;
}

/* Do the fields span the directions of all coordinates that are kept? */
static bool spanned(const nh_parametric *f, const nh_jet_ring *r, const nh_residue *field)
{
    const nh_jet_equations *x = f->counter.equations;
    if (f->linear) return true;
    nmod_mat_t m;
    nmod_mat_init(m, (slong)x->fields, (slong)f->kept, r->field.p);
    for (size_t i = 0; i < x->fields; i++)
        for (size_t j = 0; j < f->kept; j++)
            nmod_mat_entry(m, i, j) = field[(i * x->coordinates + f->index[j]) * r->size];
    bool all = nmod_mat_rank(m) == (slong)f->kept;
    nmod_mat_clear(m);
    return all;
}

/* The series of the coordinates themselves; those that are left out keep their values. */
static bool plain_series(nh_parametric *f, const nh_jet_ring *r, nh_residue *coordinate, nh_residue *field)
{
    nh_jet_equations *x = f->counter.equations;
    size_t e = r->size;
    memset(coordinate, 0, x->coordinates * e * sizeof *coordinate);
    for (size_t k = 0; k < x->coordinates; k++) coordinate[k * e] = x->at[k];
    for (size_t j = 0; j < f->kept; j++) coordinate[f->index[j] * e + r->up[j * e]] = 1;
    nh_residue *all = nh_alloc_array(x->fields * x->coordinates * e + 1, sizeof *all);
    bool good = nh_jet_equations_fields(x, r, coordinate, all) && spanned(f, r, all);
    for (size_t i = 0; i < x->fields && good; i++)
        for (size_t j = 0; j < f->kept; j++)
            memcpy(field + (i * f->kept + j) * e, all + (i * x->coordinates + f->index[j]) * e, e * sizeof *field);
    nh_free(all);
    return good;
}

bool nh_parametric_motion(nh_parametric *f, const nh_jet_ring *r, nh_residue *coordinate, nh_residue *out)
{
    nh_jet_equations *x = f->counter.equations;
    size_t rates_at = (1 + x->fields * nh_parametric_kept(f)) * r->size;
    size_t length = rates_at + x->n * nh_jet_equations_monomials(x->n) * r->size;
    nh_parametric_set(f);
    bool good = plain(f) ? plain_series(f, r, coordinate, out + r->size)
                         : nh_adapted_frame_series(f->counter.frame, r, coordinate, out + r->size);
    good = good && multiplier(f, r, coordinate, out) && out[0] &&
           nh_jet_equations_accelerations(x, r, coordinate, out + rates_at);
    nh_residue *work = nh_alloc_array(r->size, sizeof *work);
    for (size_t k = r->size; k < length && good; k += r->size) nh_parametric_times(r, out + k, out, work);
    nh_free(work);
    f->counter.work += (double)r->pairs[r->size] * (x->products + (double)length / (double)r->size);
    return good;
}

bool nh_parametric_value(nh_parametric *f, nh_parametric_series *s, nh_residue *out)
{
    return f->linear ? nh_parametric_linear_value(f, s, out) : nh_parametric_motion(f, s->ring, s->coordinate, out);
}

/* ---- creation ---- */

/* Every term of Gamma changes the parity of |alpha|. */
static bool has_parity(const nh_parametric *f, const nh_parametric_series *s)
{
    size_t n = f->counter.equations->n, count = nh_jet_equations_monomials(n), e = s->ring->size;
    bool split = f->counter.equations->fields == n;
    for (size_t j = 0; j < (s->degree + 1) * (s->second + 1); j++)
        for (size_t l = 0; l < n; l++)
            for (size_t i = 0; i < n && split; i++)
                split = nh_jet_is_zero(s->ring, s->coefficient + j * s->length + s->rates_at + (l * count + 1 + i) * e);
    return split;
}

nh_parametric_series *nh_parametric_series_create(nh_parametric *f, size_t order, bool *regular)
{
    nh_jet_equations *x = f->counter.equations;
    size_t kept = nh_parametric_kept(f), *one = nh_alloc_array(kept + 1, sizeof *one);
    for (size_t k = 0; k < kept; k++) one[k] = plain(f) ? 1 : f->counter.frame->weight[k];
    size_t size = nh_jet_ring_size(kept, one, order, largest_series);
    *regular = true;
    if (size == SIZE_MAX) {
        nh_free(one);
        return NULL;
    }
    nh_parametric_series *s = nh_alloc(sizeof *s);
    s->ring = nh_jet_ring_create(x->point->field, kept, one, order);
    nh_free(one);
    s->fields_at = size;
    s->rates_at = size + x->fields * kept * size;
    s->length = f->linear ? nh_parametric_linear_length(f, s->ring)
                          : s->rates_at + x->n * nh_jet_equations_monomials(x->n) * size;
    s->coordinate = nh_alloc_array((x->coordinates + 1) * size, sizeof *s->coordinate);
    *regular = nh_parametric_interpolate(f, s);
    if (*regular) {
        s->split = !f->linear && has_parity(f, s);
        if (s->degree <= most_degree && s->second <= most_degree) return s;
        f->obstacle = "equations of a degree in the parameter that is too high";
    }
    nh_parametric_series_free(s);
    return NULL;
}

void nh_parametric_series_free(nh_parametric_series *s)
{
    if (!s) return;
    nh_jet_ring_free(s->ring);
    nh_free(s->coordinate);
    nh_free(s->coefficient);
    nh_free(s);
}

/* ---- use ---- */

void nh_parametric_at(const nh_parametric_series *s, nh_residue lambda, bool infinite, nh_residue *values)
{
    nh_prime p = s->ring->field;
    memcpy(values, s->coefficient + s->degree * s->length, s->length * sizeof *values);
    for (size_t j = s->degree; j-- > 0 && !infinite;)
        for (size_t z = 0; z < s->length; z++)
            values[z] = nh_residue_add(p, nh_residue_mul(p, values[z], lambda), s->coefficient[j * s->length + z]);
}

nh_graded_problem nh_parametric_problem(const nh_parametric *f, const nh_parametric_series *s, const nh_residue *values,
                                        size_t degree, nh_parity parity)
{
    const nh_jet_equations *x = f->counter.equations;
    return (nh_graded_problem){.ring = s->ring,
                               .n = x->n,
                               .fields = x->fields,
                               .field = values + s->fields_at,
                               .rate = values + s->rates_at,
                               .degree = degree,
                               .parity = parity,
                               .most_parameters = most_parameters,
                               .most_work = f->counter.q->work - f->counter.work};
}
