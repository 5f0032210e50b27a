/* count: points modulo primes, weights, and series of growing order until the number of integrals reaches the number
 * of known ones or no longer changes. [docs/method.md, sec. 10]
 *
 *     nh_counter_open      equations, known integrals, coordinates that can be left out
 *     first_point          a regular point modulo a prime: adapted frame, degrees of the known integrals
 *     count_degree         for degree 1, 2, ..
 *        count_at             at order r:  N(r) (graded_solver.h),  products of known ones,  ranks of differentials
 *        is_last              known == N: complete;  N stays for step + 1 orders: settled;  else a larger r
 *     nh_count_linear      higher degrees by frequencies, where the equations are linear
 *
 *     outcome       COUNTED; UNLUCKY: another point; TOO_MUCH: limit of work; EXTENDED: again in all coordinates */
#include "count/count_internal.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "count/turned_translations.h"
#include "exact/jet_independent.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"

enum { few_steps = 3, most_parameters = 4000, largest_series = 20000, steps_beyond = 1, many_coordinates = 6 };
/* part of the work for the number of integrals of a degree whose rank is known already */
static const double least_share = 0.25;
static const double more_for_open = 5; /* times the work, for a degree whose bound still falls */

/* ---- the number ---- */

/* Does every term of Gamma change the parity of |alpha|?  So without X_0, and without rates linear in the
 * velocities. */
static bool has_parity(const nh_jet_equations *x, const nh_jet_ring *ring, const nh_residue *rate)
{
    size_t n = x->n, count = nh_jet_equations_monomials(n);
    if (x->fields > n) return false;
    for (size_t l = 0; l < n; l++)
        for (size_t i = 0; i < n; i++)
            if (!nh_jet_is_zero(ring, rate + (l * count + 1 + i) * ring->size)) return false;
    return true;
}

/* The ring of an order, and in it the coordinates, the fields and the rates.  Rings that alone take more than `most`
 * work are not begun: 40 coordinates would take gigabytes. */
nh_count_series *nh_count_series_create(nh_counter *c, size_t order, double most, bool *regular)
{
    nh_jet_equations *x = c->equations;
    nh_adapted_frame *f = c->frame;
    size_t size = nh_jet_ring_size(f->kept, f->weight, order, largest_series);
    *regular = true;
    if (size == SIZE_MAX) return NULL;
    nh_count_series *s = nh_alloc(sizeof *s);
    *s = (nh_count_series){.ring = nh_jet_ring_create(x->point->field, f->kept, f->weight, order)};
    c->work += (double)s->ring->pairs[size] * x->products;
    if (c->work >= most) {
        nh_count_series_free(s);
        return NULL;
    }
    s->coordinate = nh_alloc_array(f->all * size + 1, sizeof *s->coordinate);
    s->field = nh_alloc_array(x->fields * f->kept * size + 1, sizeof *s->field);
    s->rate = nh_alloc_array(x->n * nh_jet_equations_monomials(x->n) * size + 1, sizeof *s->rate);
    *regular = nh_adapted_frame_series(f, s->ring, s->coordinate, s->field) &&
               nh_jet_equations_accelerations(x, s->ring, s->coordinate, s->rate);
    s->split = *regular && has_parity(x, s->ring, s->rate);
    if (*regular) return s;
    nh_count_series_free(s);
    return NULL;
}

void nh_count_series_free(nh_count_series *s)
{
    if (!s) return;
    nh_jet_ring_free(s->ring);
    nh_free(s->rate);
    nh_free(s->field);
    nh_free(s->coordinate);
    nh_free(s);
}

nh_graded_problem nh_count_problem(const nh_counter *c, const nh_count_series *s, size_t degree, nh_parity parity)
{
    return (nh_graded_problem){.ring = s->ring,
                               .n = c->equations->n,
                               .fields = c->equations->fields,
                               .field = s->field,
                               .rate = s->rate,
                               .degree = degree,
                               .parity = parity,
                               .most_parameters = most_parameters,
                               .most_work = c->most - c->work,
                               .threads = c->q->threads};
}

/* N for each order, the sum over both parities where they separate; injective_at: the larger of theirs.  False: beyond
 * the limits. */
static bool totals(nh_counter *c, const nh_count_series *s, size_t degree, nh_graded_state *state[2], size_t *total,
                   size_t *injective_at, nh_differentials *d)
{
    size_t order = s->ring->order;
    bool good = true;
    memset(total, 0, (order + 1) * sizeof *total);
    *injective_at = 0;
    for (int part = 0; part < (s->split ? 2 : 1) && good; part++) {
        nh_graded_problem p = nh_count_problem(c, s, degree,
                                               !s->split ? NH_ALL_DEGREES
                                               : part    ? NH_ODD_DEGREES
                                                         : NH_EVEN_DEGREES);
        size_t from;
        good = nh_count_solve(c, &p, &state[part], total, &from, d);
        if (*injective_at < from) *injective_at = from;
    }
    return good;
}

/* The ranks of both at the same random velocities. */
void nh_count_differentials(const nh_counter *c, nh_differentials *all, nh_differentials *known)
{
    size_t n = c->equations->n;
    uint64_t random = 31337;
    nh_residue *w = nh_alloc_array(n + 1, sizeof *w);
    for (size_t i = 0; i < n; i++) w[i] = nh_residue_random(c->equations->point->field, &random);
    *all = *known = (nh_differentials){.n = n, .kept = c->frame->kept, .w = w};
}

void nh_count_differentials_clear(nh_differentials *all, nh_differentials *known)
{
    nh_free(all->w);
    nh_free(all->row);
    nh_free(known->row);
}

/* EXTENDED: with integrals that are linear in coordinates that were left out. */
typedef enum { COUNTED, UNLUCKY, TOO_MUCH, EXTENDED } outcome;

/* Residues stand for any solutions of the equations of named functions.  If they give more independent functions than
 * the bound allows, the functions themselves are related in ways that other solutions are not. */
static bool shows_too_many(const nh_counter *c, const nh_count_row *row)
{
    bool named = false;
    for (size_t k = 0; k < c->known; k++) named |= c->named[k];
    return named && row->known_rank > c->q->independent;
}

/* What N at the orders 0 .. r says: bound, complete, settled. */
static void read_totals(const nh_counter *c, const size_t *total, size_t from, nh_count_row *out)
{
    size_t order = out->order, same = order;
    out->bound = total[order];
    out->bounded = from <= order;
    out->functions = out->bounded && out->rank == out->known_rank;
    out->complete = out->bounded && out->bound == out->known;
    while (same > 0 && total[same - 1] == total[order]) same--;
    if (out->bounded && same < from) same = from;
    out->reached = same;
    out->settled = out->bounded && order - same >= c->frame->step + steps_beyond;
}

/* Would no higher order be needed if nothing was left out? */
static bool is_enough(const nh_counter *c, const nh_count_row *row)
{
    return row->complete || row->settled || (row->functions && c->q->alone) ||
           (row->functions && c->work > least_share * c->q->work);
}

/* At the end, or when it may be near. */
static bool is_time_for_extensions(const nh_counter *c, const nh_count_row *row)
{
    enum { share = 10 };
    return row->bounded && c->equations->left && !c->unextended && (is_enough(c, row) || share * c->work > c->most);
}

/* Higher orders may show that no integral is linear in what was left out. */
static bool is_last(const nh_counter *c, const nh_count_row *row)
{
    enum { patience = 4 };
    if (c->equations->left && !c->unextended)
        return row->settled && row->order - row->reached >= patience * (c->frame->step + steps_beyond);
    return is_enough(c, row);
}

/* Counts one degree at one order; `state` of both parities is that of the order before. */
static outcome count_at(nh_counter *c, size_t degree, size_t order, nh_graded_state *state[2], nh_count_row *out)
{
    bool regular;
    nh_count_series *s = nh_count_series_create(c, order, c->most, &regular);
    if (!s) return regular ? TOO_MUCH : UNLUCKY;
    size_t *total = nh_alloc_array(order + 1, sizeof *total), from;
    nh_differentials all, known;
    nh_count_differentials(c, &all, &known);
    outcome result = COUNTED;
    if (!totals(c, s, degree, state, total, &from, &all)) result = TOO_MUCH;
    bool products =
        c->q->alone || result != COUNTED || nh_count_products(c, s->ring, s->coordinate, degree, total[order], out);
    if (result == COUNTED && !(products && nh_count_known_differ(c, s->ring, s->coordinate, &known))) result = UNLUCKY;
    nh_count_differentials_append(&all, &known);
    out->rank = nh_count_rank(&all, s->ring->field);
    out->known_rank = nh_count_rank(&known, s->ring->field);
    out->degree = degree;
    out->order = order;
    /* another point is needed, without these currents */
    if (result == COUNTED && shows_too_many(c, out)) c->unnamed = true, result = UNLUCKY;
    read_totals(c, total, from, out);
    if (result == COUNTED && is_time_for_extensions(c, out)) {
        bool extended;
        if (!nh_count_extended(c, s, degree, state, &extended)) result = UNLUCKY;
        else c->unextended = !extended;
    }
    nh_count_differentials_clear(&all, &known);
    nh_free(total);
    nh_count_series_free(s);
    return result;
}

/* The first order.  Series of lower order give no bound where brackets of fields have weights; the order at which a
 * degree reaches its number was observed to grow by step + 1 with the degree. */
static size_t first_order(const nh_counter *c, size_t degree, const nh_count_row *before)
{
    enum { first_beyond = 2 };
    size_t step = c->frame->step, least = degree * step + first_beyond,
           expected = before ? before->reached + step + (step > 1) : 0;
    return least > expected ? least : expected;
}

/* Increases the order until all integrals are known, or the number no longer changes.  `before`: the row of the degree
 * before, or NULL. */
static outcome count_degree(nh_counter *c, size_t degree, const nh_count_row *before, nh_count_row *out)
{
    size_t step = c->frame->step, order = first_order(c, degree, before);
    nh_count_row row = {0};
    nh_graded_state *state[2] = {NULL, NULL};
    outcome o = COUNTED;
    bool any = false;
    c->most = fmax(c->q->work, c->q->first_work);
    c->unextended = false;
    while (c->work < c->most && !nh_late()) {
        o = count_at(c, degree, order, state, &row);
        if (o != COUNTED) break;
        *out = row;
        any = row.bounded;
        if (any) c->most = c->q->work;
        if (is_last(c, &row)) break;
        if (row.bounded && !row.functions && c->q->known) c->most = more_for_open * c->q->work;
        if (!row.bounded) order += step < few_steps ? step + steps_beyond : few_steps;
        else order = (row.settled ? order : row.reached) + step + steps_beyond;
    }
    nh_graded_state_free(state[0]);
    nh_graded_state_free(state[1]);
    if (any && o != UNLUCKY && c->equations->left && !c->unextended) return EXTENDED;
    return o == UNLUCKY ? UNLUCKY : any ? COUNTED : TOO_MUCH;
}

/* ---- points ---- */

bool nh_count_regular_point(nh_counter *c, size_t attempt)
{
    nh_jet_equations *x = c->equations;
    nh_adapted_frame_free(c->frame);
    c->frame = NULL;
    nh_jet_equations_choose(x, nh_jet_point_prime(x->point, attempt % 16), 1 + attempt);
    return nh_count_take_known(c) && (c->frame = nh_adapted_frame_create(x)) != NULL;
}

/* The first regular point; how many were tried before. */
static size_t first_point(nh_counter *c, nh_count *out)
{
    size_t attempt = 0;
    while (attempt < NH_COUNT_POINTS && !c->equations->obstacle && !nh_count_regular_point(c, attempt)) attempt++;
    if (c->equations->obstacle) out->obstacle = c->equations->obstacle;
    else if (!c->frame) out->obstacle = "no regular point was found modulo a prime";
    return attempt;
}

/* Step, weights and leaf of the frame, and the coordinates that were left out. */
static void read_frame(const nh_counter *c, nh_count *out)
{
    if (!c->frame) return;
    out->step = c->frame->step;
    for (size_t j = 0; j < c->frame->kept; j++) out->weights += c->frame->weight[j];
    out->leaf = c->frame->all - c->frame->kept;
    const nh_jet_equations *x = c->equations;
    const char **name = nh_arena_alloc(x->model->arena, (x->left + 1) * sizeof *name);
    for (size_t i = 0; i < x->left; i++) name[i] = nh_name_of(x->dag, x->left_coordinate[i]);
    out->without = x->left;
    out->without_name = name;
}

/* Starts again in all coordinates. */
static void take_every_coordinate(nh_counter *c, const nh_count_question *q, nh_count *out)
{
    const nh_model *model = c->equations->model;
    double work = c->work;
    nh_counter_close(c);
    nh_counter_open(c, model, q, false);
    c->work = work;
    if (c->equations->obstacle) out->obstacle = c->equations->obstacle;
}

/* The numbers of integrals of degree 1, 2, ..; a point that is unlucky is replaced by the next one. */
static void degrees(nh_counter *c, nh_count *out)
{
    size_t last = c->q->degree ? c->q->degree : NH_COUNT_HIGHEST_DEGREE, first = c->q->alone ? last : 1,
           attempt = first_point(c, out);
    if (out->obstacle) return;
    bool linear = !c->q->alone && !c->q->shape, long_series = c->equations->m > many_coordinates;
    if (linear && long_series) nh_count_linear(c, last, out);
    while (first + out->rows <= last && !out->more && !nh_late()) {
        const nh_count_row *before = out->rows ? &out->row[out->rows - 1] : NULL;
        outcome o = count_degree(c, first + out->rows, before, &out->row[out->rows]);
        if (o == EXTENDED) {
            take_every_coordinate(c, c->q, out);
            attempt = out->obstacle ? 0 : first_point(c, out);
            if (out->obstacle) return;
            continue;
        }
        if (o == UNLUCKY && !c->equations->obstacle) {
            do attempt++;
            while (attempt < NH_COUNT_POINTS && !nh_count_regular_point(c, attempt));
            if (attempt < NH_COUNT_POINTS) continue;
        }
        if (o != COUNTED) {
            out->end = c->equations->obstacle ? c->equations->obstacle
                       : o == UNLUCKY         ? "no regular point was found modulo a prime"
                                              : "work";
            break;
        }
        const nh_count_row *row = &out->row[out->rows++];
        out->more = c->q->until_missing && row->degree >= c->q->until_missing && row->degree < last && row->bounded &&
                    !row->functions;
    }
    if (linear && !long_series && out->rows < last && !out->more && c->frame && !c->equations->obstacle && !nh_late())
        nh_count_linear(c, last, out);
    if (out->rows == 0) out->obstacle = c->equations->obstacle ? c->equations->obstacle : "the series are too long";
    read_frame(c, out);
    out->prime = c->equations->point->field.p;
}

/* Is it a function of time, coordinates, velocities and parameters alone? */
static bool is_current(const nh_jet_equations *x, nh_ex e)
{
    NH_LIST(symbol);
    size_t n = nh_symbols_in(x->dag, e, &symbol);
    bool good = true;
    for (size_t i = 0; i < n && good; i++) {
        good = symbol[i] == x->model->system->t;
        for (size_t k = 0; k < x->coordinates && !good; k++) good = symbol[i] == x->coordinate[k];
        for (size_t k = 0; k < x->n && !good; k++) good = symbol[i] == x->w[k];
        for (size_t k = 0; k < x->model->system->parameters && !good; k++) good = symbol[i] == x->model->parameter[k];
    }
    return good;
}

static bool has_named(const nh_dag *dag, nh_ex e)
{
    NH_LIST(call);
    size_t n = nh_functions_in(dag, e, &call);
    bool found = false;
    for (size_t i = 0; i < n && !found; i++) found = nh_is_named_function(nh_function_of(dag, call[i]));
    return found;
}

/* Leaves out coordinates that no known integral depends on. */
static void leave_translations(nh_counter *c)
{
    nh_jet_equations *x = c->equations;
    nh_ex *translated = nh_alloc_array(x->m + 1, sizeof *translated);
    size_t count = nh_turned_translations(x, translated);
    bool free = true;
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < c->q->known && free; k++) free = !nh_depends(x->dag, c->q->current[k], translated[i]);
    if (count && free) nh_jet_equations_leave(x, count, translated);
    nh_free(translated);
}

/* The known integrals that can be followed; an obstacle in one of them is no obstacle for the equations. */
static void register_known(nh_counter *c)
{
    nh_jet_equations *x = c->equations;
    for (size_t k = 0; k < c->q->known; k++) {
        nh_ex e = c->q->current[k];
        size_t kernels = x->point->kernels;
        bool named = has_named(x->dag, e), good = is_current(x, e) && (!named || c->q->independent);
        if (named && good) c->rate[c->known] = nh_model_gamma(x->model, e);
        x->point->solutions = true;
        good = good && nh_jet_equations_take(x, false, &e) &&
               (!named || nh_jet_equations_take(x, false, &c->rate[c->known])) &&
               (x->point->kernels == kernels || !nh_jet_point_related(x->point));
        nh_ex *slope = c->slope + c->known * x->n;
        for (size_t i = 0; i < x->n && good; i++) {
            slope[i] = nh_diff(x->dag, e, x->w[i]);
            good = nh_jet_equations_take(x, false, &slope[i]);
        }
        if (good) {
            c->index[c->known] = k;
            c->named[c->known] = named;
            c->current[c->known++] = e;
        }
        if (!good) { /* the roots of the equations are functions of each other as before */
            x->point->kernels = kernels;
            x->point->obstacle = NULL;
            x->obstacle = nh_jet_point_related(x->point);
        }
    }
}

void nh_counter_open(nh_counter *c, const nh_model *model, const nh_count_question *question, bool turned)
{
    *c = (nh_counter){.q = question,
                      .most = question->work,
                      .equations = nh_jet_equations_create(model, question->time, question->generic)};
    if (question->shape != NH_EVERY_COORDINATE && !c->equations->obstacle) {
        bool more = nh_jet_equations_drop_cyclic(c->equations);
        while (more && question->shape == NH_CLOSED_SHAPE) more = nh_jet_equations_drop_cyclic(c->equations);
    }
    if (!c->equations->obstacle) nh_jet_equations_drop(c->equations, question->idle, question->idle_coordinate);
    if (turned && question->shape == NH_EVERY_COORDINATE && !question->idle && !c->equations->obstacle)
        leave_translations(c);
    c->current = nh_alloc_array(question->known + 1, sizeof *c->current);
    c->degree = nh_alloc_array(question->known + 1, sizeof *c->degree);
    c->index = nh_alloc_array(question->known + 1, sizeof *c->index);
    c->failed = nh_alloc_array(question->known + 1, sizeof *c->failed);
    c->named = nh_alloc_array(question->known + 1, sizeof *c->named);
    c->rate = nh_alloc_array(question->known + 1, sizeof *c->rate);
    c->slope = nh_alloc_array(question->known * model->n + 1, sizeof *c->slope);
    if (!c->equations->obstacle) c->equations->obstacle = nh_jet_point_related(c->equations->point);
    if (!c->equations->obstacle) register_known(c);
}

void nh_counter_close(nh_counter *c)
{
    nh_adapted_frame_free(c->frame);
    nh_jet_equations_free(c->equations);
    nh_free(c->slope);
    nh_free(c->rate);
    nh_free(c->named);
    nh_free(c->failed);
    nh_free(c->index);
    nh_free(c->degree);
    nh_free(c->current);
}

const char *nh_count_where(const nh_model *model)
{
    nh_jet_equations *x = nh_jet_equations_create(model, false, true);
    const char *where = nh_region_text(model->dag, &x->side, model->arena);
    nh_jet_equations_free(x);
    return where;
}

nh_count nh_count_brackets(const nh_model *model, const nh_count_question *question)
{
    nh_count out = {.generic = question->generic};
    nh_counter c;
    nh_counter_open(&c, model, question, true);
    out.time = c.equations->time;
    first_point(&c, &out);
    read_frame(&c, &out);
    nh_counter_close(&c);
    return out;
}

nh_count nh_count_integrals(const nh_model *model, const nh_count_question *question)
{
    nh_count out = {.generic = question->generic};
    nh_counter c;
    nh_counter_open(&c, model, question, true);
    out.time = c.equations->time;
    if (c.equations->obstacle) out.obstacle = c.equations->obstacle;
    else if (!question->timeless || !out.time) degrees(&c, &out);
    out.where = nh_region_text(model->dag, &c.equations->side, model->arena);
    out.work = c.work;
    nh_counter_close(&c);
    return out;
}
