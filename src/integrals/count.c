/* The count: points modulo primes, weights, series of growing order until the number of integrals is met or does not change. */
#include "integrals/count_internal.h"

#include <string.h>

#include "base/progress.h"
#include "expr/diff.h"

enum { most_points = 200, most_parameters = 3000, largest_series = 20000, steps_beyond = 1 };

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
static bool totals(nh_counter *c, const nh_jet_ring *ring, const nh_residue *field, const nh_residue *rate, size_t degree, size_t *total, size_t *injective_at,
                   nh_differentials *d)
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
        if (good) nh_count_solutions_differ(g, ring->field, d);
        nh_graded_count_clear(g);
    }
    return good;
}

/* Both at the same random velocities. */
static void start_differentials(const nh_counter *c, nh_prime f, nh_differentials *all, nh_differentials *known)
{
    size_t n = c->equations->n;
    uint64_t random = 31337;
    nh_residue *w = nh_alloc_array(n + 1, sizeof *w);
    for (size_t i = 0; i < n; i++) w[i] = nh_residue_random(f, &random);
    *all = *known = (nh_differentials){.n = n, .kept = c->frame->kept, .w = w};
}

static void end_differentials(nh_differentials *all, nh_differentials *known)
{
    nh_free(all->w);
    nh_free(all->row);
    nh_free(known->row);
}

typedef enum { COUNTED, UNLUCKY, TOO_MUCH } outcome;

/* One degree at one order. */
static outcome count_at(nh_counter *c, size_t degree, size_t order, nh_count_row *out)
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
        nh_differentials all, known;
        start_differentials(c, ring->field, &all, &known);
        result = totals(c, ring, field, rate, degree, total, &from, &all) ? COUNTED : TOO_MUCH;
        if (result == COUNTED && !(nh_count_products(c, ring, coordinate, degree, out) && nh_count_known_differ(c, ring, coordinate, &known) && nh_count_known_differ(c, ring, coordinate, &all))) result = UNLUCKY;
        out->rank = nh_count_rank(&all, ring->field);
        out->known_rank = nh_count_rank(&known, ring->field);
        out->functions = from <= order && out->rank == out->known_rank;
        end_differentials(&all, &known);
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
static outcome count_degree(nh_counter *c, size_t degree, nh_count_row *out)
{
    enum { first_beyond = 2 };
    size_t step = c->frame->step;
    nh_count_row row = {0};
    bool any = false;
    for (size_t order = degree * step + first_beyond; c->work < c->q->work && !nh_late(); order += step + 1) {
        outcome o = count_at(c, degree, order, &row);
        if (o == UNLUCKY) return o;
        if (o == TOO_MUCH) break;
        *out = row;
        any = row.bounded;
        if (row.complete || row.functions || row.settled) break;
    }
    return any ? COUNTED : TOO_MUCH;
}

/* ---- points ---- */

static bool regular_point(nh_counter *c, size_t attempt)
{
    nh_jet_equations *x = c->equations;
    nh_adapted_frame_free(c->frame);
    c->frame = NULL;
    nh_jet_equations_choose(x, nh_prime_at(attempt % 16), 1 + attempt);
    return nh_count_take_known(c) && (c->frame = nh_adapted_frame_create(x)) != NULL;
}

static void degrees(nh_counter *c, nh_count *out)
{
    size_t last = c->q->degree ? c->q->degree : NH_COUNT_HIGHEST_DEGREE, attempt = 0;
    while (attempt < most_points && !c->equations->obstacle && !regular_point(c, attempt)) attempt++;
    if (!c->frame || c->equations->obstacle) {
        out->obstacle = c->equations->obstacle ? c->equations->obstacle : "no regular point was found modulo a prime";
        return;
    }
    while (out->rows < last && !nh_late()) {
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

/* Is it a function of time, the coordinates, the velocities and the parameters alone? */
static bool is_current(const nh_jet_equations *x, nh_ex e)
{
    enum { most = 256 };
    nh_ex symbol[most];
    size_t n = nh_symbols_in(x->dag, e, symbol, most);
    bool good = n < most;
    for (size_t i = 0; i < n && good; i++) {
        good = symbol[i] == x->model->system->t;
        for (size_t k = 0; k < x->coordinates && !good; k++) good = symbol[i] == x->coordinate[k];
        for (size_t k = 0; k < x->n && !good; k++) good = symbol[i] == x->w[k];
        for (size_t k = 0; k < x->model->system->parameters && !good; k++) good = symbol[i] == x->model->parameter[k];
    }
    return good;
}

/* Those that can be followed; what one of them stumbles over is no obstacle for the equations. */
static void register_known(nh_counter *c)
{
    nh_jet_equations *x = c->equations;
    for (size_t k = 0; k < c->q->known; k++) {
        nh_ex e = c->q->current[k];
        size_t kernels = x->point->kernels;
        bool good = is_current(x, e) && nh_jet_equations_take(x, false, &e) && (x->point->kernels == kernels || !nh_jet_equations_related(x, nh_prime_at(0)));
        nh_ex *slope = c->slope + c->known * x->n;
        for (size_t i = 0; i < x->n && good; i++) {
            slope[i] = nh_diff(x->dag, e, x->w[i]);
            good = nh_jet_equations_take(x, false, &slope[i]);
        }
        if (good) c->current[c->known++] = e;
        else x->obstacle = x->point->obstacle = NULL, x->point->kernels = kernels;
    }
}

nh_count nh_count_integrals(const nh_model *model, const nh_count_question *question)
{
    nh_count out = {.generic = question->generic};
    nh_counter c = {.q = question, .equations = nh_jet_equations_create(model, question->time, question->generic)};
    out.time = c.equations->time;
    c.current = nh_alloc_array(question->known + 1, sizeof *c.current);
    c.degree = nh_alloc_array(question->known + 1, sizeof *c.degree);
    c.failed = nh_alloc_array(question->known + 1, sizeof *c.failed);
    c.slope = nh_alloc_array(question->known * model->n + 1, sizeof *c.slope);
    if (!c.equations->obstacle && nh_jet_equations_related(c.equations, nh_prime_at(0))) c.equations->obstacle = "functions that may be related to each other";
    if (!c.equations->obstacle) register_known(&c);
    if (c.equations->obstacle) out.obstacle = c.equations->obstacle;
    else degrees(&c, &out);
    out.work = c.work;
    nh_adapted_frame_free(c.frame);
    nh_jet_equations_free(c.equations);
    nh_free(c.slope);
    nh_free(c.failed);
    nh_free(c.degree);
    nh_free(c.current);
    return out;
}
