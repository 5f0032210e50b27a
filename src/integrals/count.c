/* The count: points modulo primes, weights, series of growing order until the number of integrals is met or does not change. */
#include "integrals/count.h"

#include <flint/nmod_mat.h>
#include <string.h>

enum { most_points = 200, most_parameters = 3000, most_products = 3000, largest_series = 20000, spare_columns = 8, steps_beyond = 1, most_failures = 40 };

/* One point: everything that does not depend on degree and order. */
typedef struct {
    const nh_count_question *q;
    nh_jet_equations *equations;
    nh_adapted_frame *frame;
    size_t known, *degree;   /* polynomial currents of positive degree */
    size_t *failed;          /* at how many points they could not be evaluated */
    nh_ex *current;
    double work;
} counter;

/* ---- known integrals ---- */

/* Values along the line w = a + s b for s = 0 .. count - 1, as differences: the degree is the last that is not zero. */
static bool line_degree(counter *c, const nh_jet_ring *ring, const nh_residue *coordinate, nh_ex e, size_t *degree)
{
    enum { values = NH_COUNT_HIGHEST_DEGREE + 4 };
    nh_jet_equations *x = c->equations;
    nh_residue y[values], *w = nh_alloc_array(2 * x->n + 1, sizeof *w), *series = nh_alloc_array(ring->size, sizeof *series);
    uint64_t random = 4711;
    bool good = true;
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    for (size_t i = 0; i < 2 * x->n; i++) w[i] = nh_residue_random(ring->field, &random);
    for (size_t s = 0; s < values && good; s++) {
        nh_jet_equations_velocities(x, v, ring, w);
        good = nh_jet_eval_all(v, 1, &e, series);
        y[s] = series[0];
        for (size_t i = 0; i < x->n; i++) w[i] = nh_residue_add(ring->field, w[i], w[x->n + i]);
    }
    *degree = 0;
    for (size_t k = 1; k < values && good; k++) {
        for (size_t s = values - 1; s >= k; s--) y[s] = nh_residue_sub(ring->field, y[s], y[s - 1]);
        for (size_t s = k; s < values; s++)
            if (y[s]) *degree = k;
    }
    nh_jet_eval_free(v);
    nh_free(series);
    nh_free(w);
    return good;
}

/* What is polynomial, with its degree.  A current that cannot be evaluated makes the point a bad one, and one that never can is left out. */
static bool take_known(counter *c)
{
    nh_jet_equations *x = c->equations;
    size_t *one = nh_alloc_array(x->coordinates + 1, sizeof *one);
    for (size_t k = 0; k < x->coordinates; k++) one[k] = 1;
    nh_jet_ring *ring = nh_jet_ring_create(x->point->field, x->coordinates, one, 0);
    bool good = true;
    size_t kept = 0;
    for (size_t k = 0; k < c->known && good; k++) {
        size_t degree;
        good = line_degree(c, ring, x->at, c->current[k], &degree);
        bool hopeless = !good && ++c->failed[k] > most_failures;
        good |= hopeless;
        if (hopeless || (good && (degree == 0 || degree > NH_COUNT_HIGHEST_DEGREE))) continue;
        c->failed[kept] = c->failed[k];
        c->current[kept] = c->current[k];
        c->degree[kept++] = degree;
        if (!good) { /* the rest as it is */
            for (k++; k < c->known; k++) c->failed[kept] = c->failed[k], c->current[kept++] = c->current[k];
        }
    }
    c->known = kept;
    nh_jet_ring_free(ring);
    nh_free(one);
    return good;
}

/* Exponents of all products up to a degree, the empty one first: `known` numbers each; 0 when they are too many. */
static size_t list_products(const counter *c, size_t degree, uint8_t *out)
{
    uint8_t *e = nh_alloc(c->known + 1);
    size_t count = 0;
    for (bool more = true; more && count <= most_products;) {
        if (out) memcpy(out + count * c->known, e, c->known);
        count++;
        size_t i = 0, sum = 0;
        for (size_t k = 0; k < c->known; k++) sum += e[k] * c->degree[k];
        while (i < c->known && sum + c->degree[i] > degree) sum -= e[i] * c->degree[i], e[i++] = 0;
        more = i < c->known;
        if (more) e[i]++;
    }
    nh_free(e);
    return count <= most_products ? count : 0;
}

/* All products at one choice of velocities, each from one that came before by a factor. */
static void multiply_products(const nh_jet_ring *ring, size_t known, size_t count, const uint8_t *exponent, const nh_residue *phi, nh_residue *out)
{
    uint8_t *less = nh_alloc(known + 1);
    nh_jet_constant(ring, 1, out);
    for (size_t p = 1; p < count; p++) {
        size_t k = 0, before = p;
        while (!exponent[p * known + k]) k++;
        memcpy(less, exponent + p * known, known);
        less[k]--;
        while (before-- > 0 && memcmp(exponent + before * known, less, known) != 0) {}
        nh_jet_mul(ring, out + before * ring->size, phi + k * ring->size, out + p * ring->size);
    }
    nh_free(less);
}

/* The rank of the products modulo the prime: each column is a random combination of their Taylor coefficients at random velocities. */
static bool rank_of_products(counter *c, const nh_jet_ring *ring, const nh_residue *coordinate, size_t degree, size_t *rank)
{
    nh_jet_equations *x = c->equations;
    size_t count = list_products(c, degree, NULL), columns = count + spare_columns;
    *rank = 1;
    if (!count || !c->known) return true;
    uint8_t *exponent = nh_alloc(count * c->known + 1);
    list_products(c, degree, exponent);
    nh_residue *phi = nh_alloc_array(c->known * ring->size, sizeof *phi), *product = nh_alloc_array(count * ring->size, sizeof *product), *w = nh_alloc_array(x->n + 1, sizeof *w);
    uint64_t random = 1234567 + degree;
    nh_jet_eval *v = nh_jet_equations_eval(x, ring, coordinate);
    nmod_mat_t rows;
    nmod_mat_init(rows, (slong)count, (slong)columns, ring->field.p);
    bool good = true;
    for (size_t j = 0; j < columns && good; j++) {
        for (size_t i = 0; i < x->n; i++) w[i] = nh_residue_random(ring->field, &random);
        nh_jet_equations_velocities(x, v, ring, w);
        good = nh_jet_eval_all(v, c->known, c->current, phi);
        if (good) multiply_products(ring, c->known, count, exponent, phi, product);
        for (size_t e = 0; e < ring->size; e++) {
            nh_residue factor = nh_residue_random(ring->field, &random);
            for (size_t p = 0; p < count; p++)
                nmod_mat_entry(rows, p, j) = nh_residue_add(ring->field, (nh_residue)nmod_mat_entry(rows, p, j), nh_residue_mul(ring->field, factor, product[p * ring->size + e]));
        }
        c->work += (double)count * (double)ring->pairs[ring->size];
    }
    *rank = (size_t)nmod_mat_rank(rows);
    nmod_mat_clear(rows);
    nh_jet_eval_free(v);
    nh_free(w);
    nh_free(product);
    nh_free(phi);
    nh_free(exponent);
    return good;
}

/* ---- the number ---- */

/* Every term of Gamma changes the parity of |alpha|: no X_0, and no rates linear in the velocities. */
static bool has_parity(const nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *rate)
{
    size_t n = x->n, count = nh_jet_equations_monomials(n);
    if (x->fields > n) return false;
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < n; i++)
            if (!nh_jet_is_zero(ring, rate + (l * count + 1 + i) * ring->size)) return false;
    return true;
}

/* N for each order, the sum over both parities where they separate; injective_at: the larger.  False: beyond the limits. */
static bool totals(counter *c, const nh_jet_ring *ring, const nh_residue *field, const nh_residue *rate, size_t degree, size_t *total, size_t *injective_at)
{
    nh_jet_equations *x = c->equations;
    bool split = has_parity(x, ring, rate), good = true;
    memset(total, 0, (ring->order + 1) * sizeof *total);
    *injective_at = 0;
    for (int part = 0; part < (split ? 2 : 1) && good; part++) {
        nh_graded_problem p = {.ring = ring, .n = x->n, .fields = x->fields, .field = field, .rate = rate, .degree = degree, .most_parameters = most_parameters,
                               .parity = !split ? NH_ALL_DEGREES : part ? NH_ODD_DEGREES : NH_EVEN_DEGREES, .most_work = c->q->work - c->work};
        nh_graded_count *g = nh_graded_solve(&p);
        good = g->solved;
        if (!g->injective) *injective_at = SIZE_MAX;
        else if (*injective_at < g->injective_at) *injective_at = g->injective_at;
        c->work += g->work;
        for (size_t k = 0; k <= ring->order; k++) total[k] += g->total[k];
        nh_graded_count_clear(g);
    }
    return good;
}

typedef enum { COUNTED, UNLUCKY, TOO_MUCH } outcome;

/* One degree at one order. */
static outcome count_at(counter *c, size_t degree, size_t order, nh_count_row *out)
{
    nh_jet_equations *x = c->equations;
    nh_adapted_frame *f = c->frame;
    size_t size = nh_jet_ring_size(f->kept, f->weight, order, largest_series);
    if (size == SIZE_MAX) return TOO_MUCH;
    nh_jet_ring *ring = nh_jet_ring_create(x->point->field, f->kept, f->weight, order);
    nh_residue *coordinate = nh_alloc_array(f->all * size + 1, sizeof *coordinate), *field = nh_alloc_array(x->fields * f->kept * size + 1, sizeof *field);
    nh_residue *rate = nh_alloc_array(x->n * nh_jet_equations_monomials(x->n) * size + 1, sizeof *rate);
    size_t *total = nh_alloc_array(order + 1, sizeof *total), from;
    outcome result = UNLUCKY;
    c->work += (double)ring->pairs[size] * (double)nh_dag_size(x->dag);
    if (nh_adapted_frame_series(f, ring, coordinate, field) && nh_jet_equations_accelerations(x, ring, coordinate, rate)) {
        result = totals(c, ring, field, rate, degree, total, &from) ? COUNTED : TOO_MUCH;
        if (result == COUNTED && !rank_of_products(c, ring, coordinate, degree, &out->known)) result = UNLUCKY;
        out->degree = degree;
        out->order = order;
        out->bound = total[order];
        out->complete = from <= order && out->bound == out->known;
        out->bounded = from <= order;
        size_t same = order;
        while (same > 0 && total[same - 1] == total[order]) same--;
        if (out->bounded && same < from) same = from;
        out->settled = out->bounded && order - same >= f->step + steps_beyond;
    }
    nh_free(total);
    nh_free(rate);
    nh_free(field);
    nh_free(coordinate);
    nh_jet_ring_free(ring);
    return result;
}

/* Orders grow until all are known, or the number does not change. */
static outcome count_degree(counter *c, size_t degree, nh_count_row *out)
{
    enum { first_beyond = 2 };
    size_t step = c->frame->step;
    nh_count_row row = {0};
    bool any = false;
    for (size_t order = degree * step + first_beyond; c->work < c->q->work; order += step + 1) {
        outcome o = count_at(c, degree, order, &row);
        if (o == UNLUCKY) return o;
        if (o == TOO_MUCH) break;
        *out = row;
        any = row.bounded;
        if (row.complete || row.settled) break;
    }
    return any ? COUNTED : TOO_MUCH;
}

/* ---- points ---- */

static bool regular_point(counter *c, size_t attempt)
{
    nh_jet_equations *x = c->equations;
    nh_adapted_frame_free(c->frame);
    c->frame = NULL;
    nh_jet_equations_choose(x, nh_prime_at(attempt % 16), 1 + attempt);
    return take_known(c) && (c->frame = nh_adapted_frame_create(x)) != NULL;
}

static void degrees(counter *c, nh_count *out)
{
    size_t last = c->q->degree ? c->q->degree : NH_COUNT_HIGHEST_DEGREE, attempt = 0;
    while (attempt < most_points && !c->equations->obstacle && !regular_point(c, attempt)) attempt++;
    if (!c->frame || c->equations->obstacle) {
        out->obstacle = c->equations->obstacle ? c->equations->obstacle : "no regular point was found modulo a prime";
        return;
    }
    while (out->rows < last) {
        outcome o = count_degree(c, out->rows + 1, &out->row[out->rows]);
        if (o == UNLUCKY && !c->equations->obstacle) {
            do attempt++;
            while (attempt < most_points && !regular_point(c, attempt));
            if (attempt < most_points) continue;
        }
        if (o != COUNTED) {
            out->end = c->equations->obstacle ? c->equations->obstacle : o == UNLUCKY ? "no regular point was found modulo a prime" : "work";
            break;
        }
        out->rows++;
    }
    if (out->rows == 0) out->obstacle = c->equations->obstacle ? c->equations->obstacle : "the series are too long";
    out->step = c->frame ? c->frame->step : 0;
    out->leaf = c->frame ? c->frame->all - c->frame->kept : 0;
    out->prime = c->equations->point->field.p;
}

/* Is it a function of the coordinates, the velocities and the parameters alone? */
static bool is_current(const nh_jet_equations *x, nh_ex e)
{
    enum { most = 256 };
    nh_ex symbol[most];
    size_t n = nh_symbols_in(x->dag, e, symbol, most);
    bool good = n < most;
    for (size_t i = 0; i < n && good; i++) {
        good = false;
        for (size_t k = 0; k < x->coordinates && !good; k++) good = symbol[i] == x->coordinate[k];
        for (size_t k = 0; k < x->n && !good; k++) good = symbol[i] == x->w[k];
        for (size_t k = 0; k < x->model->system->parameters && !good; k++) good = symbol[i] == x->model->parameter[k];
    }
    return good;
}

/* Those that can be followed; what one of them stumbles over is no obstacle for the equations. */
static void register_known(counter *c)
{
    nh_jet_equations *x = c->equations;
    for (size_t k = 0; k < c->q->known; k++) {
        nh_ex e = c->q->current[k];
        size_t kernels = x->point->kernels;
        bool good = is_current(x, e) && nh_jet_equations_take(x, &e) && (x->point->kernels == kernels || !nh_jet_equations_related(x, nh_prime_at(0)));
        if (good) c->current[c->known++] = e;
        else x->obstacle = x->point->obstacle = NULL, x->point->kernels = kernels;
    }
}

nh_count nh_count_integrals(const nh_model *model, const nh_count_question *question)
{
    nh_count out = {.generic = question->generic};
    counter c = {.q = question, .equations = nh_jet_equations_create(model, question->time, question->generic)};
    out.time = c.equations->time;
    c.current = nh_alloc_array(question->known + 1, sizeof *c.current);
    c.degree = nh_alloc_array(question->known + 1, sizeof *c.degree);
    c.failed = nh_alloc_array(question->known + 1, sizeof *c.failed);
    if (!c.equations->obstacle && nh_jet_equations_related(c.equations, nh_prime_at(0))) c.equations->obstacle = "functions that may be related to each other";
    if (!c.equations->obstacle) register_known(&c);
    if (c.equations->obstacle) out.obstacle = c.equations->obstacle;
    else degrees(&c, &out);
    nh_adapted_frame_free(c.frame);
    nh_jet_equations_free(c.equations);
    nh_free(c.failed);
    nh_free(c.degree);
    nh_free(c.current);
    return out;
}
