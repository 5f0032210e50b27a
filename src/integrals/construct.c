/* Solutions as long series, recognised in the span of words. */
#include "integrals/construct.h"

#include <flint/nmod_mat.h>
#include <string.h>

#include "base/progress.h"
#include "integrals/closed_words.h"
#include "integrals/count_internal.h"
#include "integrals/velocity_frame.h"

enum { spare = 24, spare_few = 2, beyond_degree = 4, most_order = 120, most_points = 60, most_coefficients = 20000 };

/* One attempt: a point, the words and the solutions as series there. */
typedef struct {
    nh_counter *counter;
    nh_known_motions_words *words;
    const nh_velocity_frame *frame; /* solutions are recognised in it */
    nh_count_series *series;
    nh_residue *word;        /* words x size */
    nh_prime field;
    size_t size;             /* coefficients of a series */
    size_t kept, *chosen;    /* words that are linearly independent, cheapest first */
    size_t *position;        /* as many coefficients that determine a combination of them */
    nmod_mat_t echelon;      /* kept x size: 1 at its position, 0 at the others */
    nmod_mat_t inverse;      /* kept x kept: of the words' values at the positions */
} attempt;

/* ---- words ---- */

static void set_row(nmod_mat_t m, size_t row, size_t n, const nh_residue *x)
{
    for (size_t j = 0; j < n; j++) nmod_mat_entry(m, row, j) = x[j];
}

/* Pivots of an echelon form. */
static size_t pivots(const nmod_mat_t m, size_t rank, size_t *out)
{
    for (size_t i = 0; i < rank; i++) {
        out[i] = i ? out[i - 1] + 1 : 0;
        while (!nmod_mat_entry(m, i, out[i])) out[i]++;
    }
    return rank;
}

/* A basis of the words' span, cheapest first. */
static void choose_words(attempt *a)
{
    size_t words = a->words->words;
    nmod_mat_t columns;
    nmod_mat_init(columns, (slong)a->size, (slong)words, a->field.p);
    for (size_t k = 0; k < words; k++)
        for (size_t e = 0; e < a->size; e++) nmod_mat_entry(columns, e, k) = a->word[k * a->size + e];
    size_t rank = (size_t)nmod_mat_rref(columns);
    a->chosen = nh_alloc_array(rank + 1, sizeof *a->chosen);
    a->kept = pivots(columns, rank, a->chosen);
    a->counter->work += (double)words * (double)rank * (double)a->size / 4; /* in blocks */
    nmod_mat_clear(columns);
}

/* The echelon form of the chosen words, and the way back to them. */
static void reduce_words(attempt *a)
{
    nmod_mat_init(a->echelon, (slong)a->kept, (slong)a->size, a->field.p);
    nmod_mat_init(a->inverse, (slong)a->kept, (slong)a->kept, a->field.p);
    for (size_t k = 0; k < a->kept; k++) set_row(a->echelon, k, a->size, a->word + a->chosen[k] * a->size);
    nmod_mat_rref(a->echelon);
    a->position = nh_alloc_array(a->kept + 1, sizeof *a->position);
    pivots(a->echelon, a->kept, a->position);
    for (size_t k = 0; k < a->kept; k++)
        for (size_t j = 0; j < a->kept; j++) nmod_mat_entry(a->inverse, k, j) = a->word[a->chosen[k] * a->size + a->position[j]];
    nmod_mat_inv(a->inverse, a->inverse);
    a->counter->work += (double)a->kept * (double)a->kept * (double)(a->size + a->kept) / 4;
}

/* Of every coordinate the least weight of a variable in it: functions of it have a coefficient for each multiple up to the order. */
static void least_weights(const nh_adapted_frame *f, size_t *weight)
{
    for (size_t k = 0; k < f->all; k++) {
        weight[k] = f->step;
        for (size_t j = 0; j < f->kept; j++)
            if (f->to[k * f->all + j] && f->weight[j] < weight[k]) weight[k] = f->weight[j];
    }
}

/* Functions of some of the coordinates must be fewer than their coefficients, or any function would be one of them.  `word`: which words; NULL: all. */
static bool are_scarce(const attempt *a, size_t order, size_t words, const size_t *word)
{
    const nh_adapted_frame *f = a->counter->frame;
    size_t m = f->all, *weight = nh_alloc_array(m + 1, sizeof *weight), *own = nh_alloc_array(m + 1, sizeof *own);
    bool good = true;
    least_weights(f, weight);
    for (uint32_t set = 1; set < (uint32_t)1 << m && good; set++) {
        size_t variables = 0, among = 0, room;
        for (size_t k = 0; k < m; k++)
            if (set >> k & 1) own[variables++] = weight[k];
        for (size_t k = 0; k < words; k++) among += !(nh_known_motions_word_coordinates(a->words, word ? word[k] : k) & ~set);
        room = nh_jet_ring_size(variables, variables == m ? f->weight : own, order, most_coefficients);
        good = among + (variables < m ? spare_few : spare) <= room;
    }
    nh_free(own);
    nh_free(weight);
    return good;
}

/* ---- which combinations of solutions are recognised ---- */

/* Of c_alpha: solutions x columns. */
static void coefficients_of(const attempt *a, const nh_graded_count *g, size_t alpha, size_t columns, const size_t *column, nmod_mat_t out)
{
    size_t N = g->total[g->order];
    for (size_t j = 0; j < columns; j++)
        for (size_t s = 0; s < N; s++) nmod_mat_entry(out, s, j) = g->series[(alpha * a->size + (column ? column[j] : j)) * N + s];
}

/* Combinations (rows) whose coefficients are combinations of words: remainders modulo the echelon form, at random combinations of their coefficients. */
static size_t recognised(attempt *a, const nh_graded_count *g, nmod_mat_t out)
{
    size_t N = g->total[g->order], tests = N + 8;
    uint64_t random = 8128;
    nmod_mat_t mix, reduced, whole, part, sum, product, conditions, null;
    nmod_mat_init(mix, (slong)a->size, (slong)tests, a->field.p);
    nmod_mat_init(reduced, (slong)a->kept, (slong)tests, a->field.p);
    nmod_mat_init(whole, (slong)N, (slong)a->size, a->field.p);
    nmod_mat_init(part, (slong)N, (slong)a->kept, a->field.p);
    nmod_mat_init(sum, (slong)N, (slong)tests, a->field.p);
    nmod_mat_init(product, (slong)N, (slong)tests, a->field.p);
    for (size_t alpha = 0; alpha < g->alphas; alpha++) {
        for (size_t e = 0; e < a->size; e++)
            for (size_t j = 0; j < tests; j++) nmod_mat_entry(mix, e, j) = nh_residue_random(a->field, &random);
        nmod_mat_mul(reduced, a->echelon, mix);
        coefficients_of(a, g, alpha, a->size, NULL, whole);
        coefficients_of(a, g, alpha, a->kept, a->position, part);
        nmod_mat_mul(product, whole, mix);
        nmod_mat_add(sum, sum, product);
        nmod_mat_mul(product, part, reduced);
        nmod_mat_sub(sum, sum, product);
        a->counter->work += (double)tests * (double)a->size * (double)(a->kept + N + 8) / 4;
    }
    nmod_mat_init(conditions, (slong)tests, (slong)N, a->field.p);
    nmod_mat_transpose(conditions, sum);
    nmod_mat_init(null, (slong)N, (slong)N, a->field.p);
    size_t nullity = (size_t)nmod_mat_nullspace(null, conditions);
    nmod_mat_init(out, (slong)nullity, (slong)N, a->field.p);
    for (size_t k = 0; k < nullity; k++)
        for (size_t s = 0; s < N; s++) nmod_mat_entry(out, k, s) = nmod_mat_entry(null, s, k);
    nmod_mat_struct *const all[] = {mix, reduced, whole, part, sum, product, conditions, null};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) nmod_mat_clear(all[i]);
    return nullity;
}

/* ---- simple representatives ---- */

/* Terms (alpha, word), the most complex first: of the highest degree in the velocities; then with the dearest word, or monomial by monomial; monomials from
 * either end. */
static size_t *order_terms(const attempt *a, const nh_graded_count *g, size_t n, size_t way)
{
    size_t terms = g->alphas * a->kept, *order = nh_alloc_array(terms + 1, sizeof *order), count = 0, highest = 0, *degree = nh_alloc_array(g->alphas + 1, sizeof *degree);
    for (size_t i = 0; i < g->alphas; i++) {
        for (size_t l = 0; l < n; l++) degree[i] += g->alpha[i * n + l];
        if (degree[i] > highest) highest = degree[i];
    }
    for (size_t d = highest + 1; d-- > 0;)
        for (size_t j = 0; j < terms; j++) {
            size_t word = way & 2 ? j % a->kept : j / g->alphas, alpha = way & 2 ? j / a->kept : j % g->alphas;
            if (way & 1) alpha = g->alphas - 1 - alpha;
            if (degree[alpha] == d) order[count++] = alpha * a->kept + (a->kept - 1 - word);
        }
    nh_free(degree);
    return order;
}

/* The reduced echelon form of the recognised combinations: their terms in this order, then the combination itself. */
static void simplest(const attempt *a, const nh_graded_count *g, const nmod_mat_t combination, const size_t *order, nmod_mat_t out)
{
    slong rows = nmod_mat_nrows(combination);
    size_t N = g->total[g->order], terms = g->alphas * a->kept, *place = nh_alloc_array(terms + 1, sizeof *place);
    nmod_mat_t part, own, coefficient;
    for (size_t j = 0; j < terms; j++) place[order[j]] = j;
    nmod_mat_init(out, rows, (slong)(terms + N), a->field.p);
    nmod_mat_init(part, (slong)N, (slong)a->kept, a->field.p);
    nmod_mat_init(own, rows, (slong)a->kept, a->field.p);
    nmod_mat_init(coefficient, rows, (slong)a->kept, a->field.p);
    for (size_t alpha = 0; alpha < g->alphas; alpha++) {
        coefficients_of(a, g, alpha, a->kept, a->position, part);
        nmod_mat_mul(own, combination, part);
        nmod_mat_mul(coefficient, own, a->inverse);
        for (slong i = 0; i < rows; i++)
            for (size_t k = 0; k < a->kept; k++) nmod_mat_entry(out, i, place[alpha * a->kept + k]) = nmod_mat_entry(coefficient, i, k);
    }
    for (slong i = 0; i < rows; i++)
        for (size_t s = 0; s < N; s++) nmod_mat_entry(out, i, terms + s) = nmod_mat_entry(combination, i, s);
    nmod_mat_rref(out);
    nmod_mat_clear(coefficient);
    nmod_mat_clear(own);
    nmod_mat_clear(part);
    nh_free(place);
}

/* ---- what is new ---- */

/* The rows of one echelon form that are new. */
typedef struct {
    nmod_mat_t row;
    size_t *order, *fresh, count, length; /* of the terms; which rows; how many; their terms together */
} representatives;

static void add_constructed(nh_construction *out, const attempt *a, const nh_graded_count *g, const representatives *r, size_t i)
{
    const nh_jet_equations *x = a->counter->equations;
    nh_constructed *c = &out->item[out->count++];
    size_t terms = g->alphas * a->kept;
    *c = (nh_constructed){.term = nh_arena_alloc(out->arena, terms * sizeof *c->term)};
    for (size_t j = 0; j < terms; j++) {
        if (!nmod_mat_entry(r->row, i, j)) continue;
        nh_ex e = nh_known_motions_word(a->words, a->chosen[r->order[j] % a->kept]);
        e = nh_mul(x->dag, e, nh_velocity_frame_monomial(a->frame, x, g->alpha + r->order[j] / a->kept * x->n));
        c->term[c->terms++] = e;
    }
}

/* What is known, as vectors: differentials at one point, or values of products under random functionals; and the same of the solutions. */
typedef struct {
    nh_count_space known;
    nh_residue *solution;   /* N x known.width */
} news;

static bool known_differentials(news *x, attempt *a)
{
    nh_differentials all, known;
    nh_count_differentials(a->counter, &all, &known);
    bool good = nh_count_known_differ(a->counter, a->series->ring, a->series->coordinate, &known);
    x->known.width = known.kept + known.n;
    for (size_t i = 0; i < known.rows && good; i++) nh_count_space_add(&x->known, a->field, known.row + i * x->known.width);
    nh_count_differentials_clear(&all, &known);
    return good;
}

static void solution_differentials(news *x, const attempt *a, const nh_graded_count *g)
{
    nh_differentials all, solution;
    nh_count_differentials(a->counter, &all, &solution);
    nh_count_solutions_differ(g, a->field, &solution);
    x->solution = nh_alloc_array(solution.rows * x->known.width + 1, sizeof *x->solution);
    memcpy(x->solution, solution.row, solution.rows * x->known.width * sizeof *x->solution);
    nh_count_differentials_clear(&all, &solution);
}

/* Products are compared with solutions to an order that determines them. */
static nh_count_series *short_series(attempt *a, size_t degree)
{
    bool regular;
    size_t order = (degree + beyond_degree / 2) * a->counter->frame->step;
    return nh_count_series_create(a->counter, order < a->series->ring->order ? order : a->series->ring->order, &regular);
}

static bool known_products(news *x, attempt *a, const nh_count_series *s, size_t degree, nh_count_functionals *f)
{
    nh_count_monomials p = nh_count_monomials_list(a->counter, degree);
    *f = nh_count_functionals_create(s->ring, a->counter->equations->n, p.count + spare, 271828 + degree);
    x->known.width = f->count;
    nh_residue *value = nh_alloc_array(p.count * f->count + 1, sizeof *value);
    bool good = p.count && nh_count_product_values(a->counter, s->ring, s->coordinate, &p, f, value);
    for (size_t i = 0; i < p.count && good; i++) nh_count_space_add(&x->known, a->field, value + i * f->count);
    nh_free(value);
    nh_count_monomials_clear(&p);
    return good;
}

/* Does a combination of solutions enlarge what is known? */
static bool is_new(const attempt *a, news *x, const nmod_mat_t row, size_t i, size_t first, size_t N)
{
    nh_residue *sum = nh_alloc_array(x->known.width + 1, sizeof *sum);
    for (size_t s = 0; s < N; s++) nh_residue_add_multiple(a->field, x->known.width, sum, x->solution + s * x->known.width, (nh_residue)nmod_mat_entry(row, i, first + s));
    bool grows = nh_count_space_add(&x->known, a->field, sum);
    nh_free(sum);
    return grows;
}

static representatives represent(const attempt *a, const nh_graded_count *g, const nmod_mat_t combination, size_t way, news *x)
{
    representatives r = {.order = order_terms(a, g, a->counter->equations->n, way)};
    size_t terms = g->alphas * a->kept, rows = (size_t)nmod_mat_nrows(combination);
    simplest(a, g, combination, r.order, r.row);
    r.fresh = nh_alloc_array(rows + 1, sizeof *r.fresh);
    for (size_t i = rows; i-- > 0;) {
        if (!is_new(a, x, r.row, i, terms, g->total[g->order])) continue;
        r.fresh[r.count++] = i;
        for (size_t j = 0; j < terms; j++) r.length += nmod_mat_entry(r.row, i, j) != 0;
    }
    return r;
}

static void representatives_clear(representatives *r)
{
    nmod_mat_clear(r->row);
    nh_free(r->order);
    nh_free(r->fresh);
}

/* Of one parity: the shortest representatives of several echelon forms. */
static void recognise(nh_construction *out, attempt *a, const nh_graded_count *g, news *x)
{
    enum { ways = 4 };
    nmod_mat_t combination;
    size_t found = recognised(a, g, combination), before = x->known.rows;
    out->recognised += found;
    representatives best = represent(a, g, combination, 0, x);
    for (size_t way = 1; way < ways && best.count; way++) {
        x->known.rows = before;
        representatives r = represent(a, g, combination, way, x), worse = r.length < best.length ? best : r;
        if (r.length < best.length) best = r;
        representatives_clear(&worse);
    }
    out->item = nh_realloc_array(out->item, out->count + best.count + 1, sizeof *out->item);
    for (size_t i = 0; i < best.count; i++) add_constructed(out, a, g, &best, best.fresh[i]);
    representatives_clear(&best);
    nmod_mat_clear(combination);
}

/* ---- a point ---- */

/* 0: none is high enough. */
static size_t order_for(const attempt *a, size_t degree)
{
    const nh_adapted_frame *f = a->counter->frame;
    size_t order = (degree + beyond_degree) * f->step;
    while (order <= most_order && !are_scarce(a, order, a->words->words, NULL)) order++;
    return order <= most_order && nh_jet_ring_size(f->kept, f->weight, order, most_coefficients) < SIZE_MAX ? order : 0;
}

typedef enum { DONE, UNLUCKY, TOO_MUCH } outcome;

static bool solve_parity(nh_construction *out, attempt *a, size_t degree, nh_parity parity, news *x, const nh_count_functionals *f, const nh_jet_ring *ring, bool *good)
{
    nh_counter *c = a->counter;
    nh_graded_problem p = nh_count_problem(c, a->series, degree, parity);
    p.keep = true;
    nh_graded_count *g = nh_graded_solve(&p);
    c->work += g->work;
    bool enough = g->solved && c->work < c->q->work && !nh_late();
    size_t N = enough ? g->total[g->order] : 0;
    out->dimension += N;
    if (N && ring) {
        x->solution = nh_alloc_array(N * x->known.width + 1, sizeof *x->solution);
        nh_count_solution_values(g, a->series->ring, f, x->solution);
    } else if (N) {
        solution_differentials(x, a, g);
    }
    *good = nh_velocity_frame_apply(a->frame, c->equations, a->series->ring, a->series->coordinate, g, &c->work);
    if (N && *good) recognise(out, a, g, x);
    nh_free(x->solution);
    x->solution = NULL;
    nh_graded_count_clear(g);
    return enough;
}

static outcome solve(nh_construction *out, attempt *a, const nh_construct_question *question)
{
    nh_count_series *s = question->further ? short_series(a, question->degree) : NULL;
    nh_count_functionals f = {0};
    news x = {0};
    bool good = s ? known_products(&x, a, s, question->degree, &f) : !question->further && known_differentials(&x, a), enough = true;
    for (int part = 0; part < (a->series->split ? 2 : 1) && good && enough; part++)
        enough = solve_parity(out, a, question->degree, !a->series->split ? NH_ALL_DEGREES : part ? NH_ODD_DEGREES : NH_EVEN_DEGREES, &x, &f, s ? s->ring : NULL, &good);
    nh_free(x.known.row);
    nh_count_functionals_clear(&f);
    nh_count_series_free(s);
    return !good ? UNLUCKY : enough ? DONE : TOO_MUCH;
}

static outcome attempt_at(nh_construction *out, attempt *a, const nh_construct_question *question)
{
    nh_counter *c = a->counter;
    bool regular;
    if (c->frame->kept != c->frame->all) return TOO_MUCH; /* functions on a leaf only */
    out->order = order_for(a, question->degree);
    if (!out->order) return TOO_MUCH;
    a->series = nh_count_series_create(c, out->order, &regular);
    if (!a->series) return regular ? TOO_MUCH : UNLUCKY;
    a->size = a->series->ring->size;
    a->field = a->series->ring->field;
    double least = (double)a->words->words * ((double)a->series->ring->pairs[a->size] + (double)a->words->words * (double)a->size / 4);
    if (c->work + least > c->q->work) return TOO_MUCH;
    a->word = nh_alloc_array(a->words->words * a->size, sizeof *a->word);
    if (!nh_known_motions_words_evaluate(a->words, a->series->ring, a->series->coordinate, a->word, &c->work)) return UNLUCKY;
    choose_words(a);
    if (!are_scarce(a, out->order, a->kept, a->chosen)) return TOO_MUCH;
    reduce_words(a);
    outcome result = solve(out, a, question);
    nmod_mat_clear(a->echelon);
    nmod_mat_clear(a->inverse);
    return result;
}

static void clear(attempt *a)
{
    nh_count_series_free(a->series);
    nh_free(a->word);
    nh_free(a->chosen);
    nh_free(a->position);
    a->series = NULL;
    a->word = NULL;
    a->chosen = a->position = NULL;
}

nh_construction *nh_construct(const nh_model *model, const nh_construct_question *question)
{
    nh_arena *arena = nh_arena_create();
    nh_construction *out = nh_arena_alloc(arena, sizeof *out);
    nh_count_question q = {.time = question->time, .degree = question->degree, .work = question->work, .known = question->known, .current = question->current};
    nh_counter c;
    *out = (nh_construction){.arena = arena};
    nh_counter_open(&c, model, &q);
    nh_known_motions_words *words = c.equations->obstacle ? NULL : nh_known_motions_words_create(c.equations, question->price, question->most_words, question->secular);
    nh_velocity_frame frame = nh_velocity_frame_of(c.equations);
    outcome o = words ? UNLUCKY : TOO_MUCH;
    for (size_t point = 0; point < most_points && o == UNLUCKY && !c.equations->obstacle && !nh_late(); point++) {
        attempt a = {.counter = &c, .words = words, .frame = &frame};
        if (!nh_count_regular_point(&c, point)) continue;
        o = attempt_at(out, &a, question);
        clear(&a);
    }
    out->words = words ? words->words : 0;
    out->limited = o != DONE;
    out->work = c.work;
    nh_velocity_frame_clear(&frame);
    nh_known_motions_words_free(words);
    nh_counter_close(&c);
    return out;
}

void nh_construction_free(nh_construction *c)
{
    if (!c) return;
    nh_free(c->item);
    nh_arena_free(c->arena);
}
