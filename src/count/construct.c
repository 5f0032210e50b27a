/* construct: solutions as long series, recognised in the span of words. [docs/method.md, sec. 10, "Construction"]
 *
 *     values under random functionals (rows):
 *
 *                      words        c_alpha of solution 1 .. N, alpha by alpha
 *                    +-----------+------------------------------------------+
 *       kept rows    |  echelon  |  coefficients of c_alpha in the words    |      nh_construct_words_choose
 *                    +-----------+------------------------------------------+
 *       other rows   |     0     |  remainders of c_alpha                   |
 *                    +-----------+------------------------------------------+
 *
 *     recognised     combinations x of solutions whose remainders all vanish: a left null space
 *     represent      reduced echelon form, complex terms first, in four orders of the terms; the shortest is taken
 *     news           rows whose differentials (or values of products) enlarge what is known */
#include "count/construct_internal.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "exact/residue_matrix.h"
#include "graph/dag.h"

enum { spare = 24, spare_few = 8, most_points = 60 };

/* ---- which combinations of solutions are recognised ---- */

/* The combinations x of the rows with x m = 0 (m: n x columns, destroyed), as rows of out. */
static size_t left_kernel(nh_prime field, size_t n, size_t columns, const nh_residue *m, nh_residue *out)
{
    size_t width = columns + n, *pivot = nh_alloc_array(n + 1, sizeof *pivot), count = 0;
    nh_residue *both = nh_alloc_array(n * width + 1, sizeof *both);
    for (size_t i = 0; i < n; i++) {
        memcpy(both + i * width, m + i * columns, columns * sizeof *both);
        both[i * width + columns + i] = 1;
    }
    size_t rank = nh_residue_matrix_echelon(field, n, width, width, both, pivot);
    for (size_t i = 0; i < rank; i++)
        if (pivot[i] >= columns) memcpy(out + count++ * n, both + i * width + columns, n * sizeof *out);
    nh_free(both);
    nh_free(pivot);
    return count;
}

/* Writes the combinations of solutions (as rows) whose coefficients are combinations of words: random combinations of
 * their remainders vanish. */
static size_t recognised(nh_construct_attempt *a, size_t part, nh_residue *out)
{
    const nh_graded_count *g = a->solution[part];
    size_t N = g->total[g->order], tests = N + spare_few, opens = a->lines.count - a->kept;
    uint64_t random = 8128;
    nh_residue *sum = nh_alloc_array(N * tests + 1, sizeof *sum),
               *product = nh_alloc_array(N * tests + 1, sizeof *product);
    nh_residue *mix = nh_alloc_array(opens * tests + 1, sizeof *mix),
               *left = nh_alloc_array(N * opens + 1, sizeof *left);
    for (size_t alpha = 0; alpha < g->alphas; alpha++) {
        for (size_t s = 0; s < N; s++)
            for (size_t j = 0; j < opens; j++)
                left[s * opens + j] = a->value[(a->kept + j) * a->width + a->first[part] + alpha * N + s];
        for (size_t i = 0; i < opens * tests; i++) mix[i] = nh_residue_random(a->field, &random);
        nh_residue_matrix_multiply(a->field, N, opens, tests, left, mix, product);
        nh_residue_add_multiple(a->field, N * tests, sum, product, 1);
    }
    size_t nullity = left_kernel(a->field, N, tests, sum, out);
    nh_free(left);
    nh_free(mix);
    nh_free(product);
    nh_free(sum);
    return nullity;
}

/* ---- simple representatives ---- */

/* Orders the terms (alpha, word), the most complex first: by degree in the velocities; then by the price of the word,
 * or monomial by monomial, from either end. */
static size_t *order_terms(const nh_construct_attempt *a, const nh_graded_count *g, size_t n, size_t way)
{
    size_t terms = g->alphas * a->kept, *order = nh_alloc_array(terms + 1, sizeof *order), count = 0, highest = 0,
           *degree = nh_alloc_array(g->alphas + 1, sizeof *degree);
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

/* The reduced echelon form of the recognised combinations: the coefficients of their terms in this order, then the
 * combination itself.  `coefficient`: the coefficients of the words, rows x kept for each alpha. */
static nh_residue *simplest(const nh_construct_attempt *a, const nh_graded_count *g, size_t rows,
                            const nh_residue *combination, const nh_residue *coefficient, const size_t *order)
{
    size_t N = g->total[g->order], terms = g->alphas * a->kept, width = terms + N,
           *pivot = nh_alloc_array(rows + 1, sizeof *pivot);
    nh_residue *out = nh_alloc_array(rows * width + 1, sizeof *out);
    for (size_t i = 0; i < rows; i++) {
        for (size_t j = 0; j < terms; j++)
            out[i * width + j] = coefficient[(order[j] / a->kept * rows + i) * a->kept + order[j] % a->kept];
        memcpy(out + i * width + terms, combination + i * N, N * sizeof *out);
    }
    nh_residue_matrix_echelon(a->field, rows, width, width, out, pivot);
    nh_free(pivot);
    return out;
}

/* The coefficients of the recognised combinations, in terms of words. */
static nh_residue *in_words(const nh_construct_attempt *a, size_t part, size_t rows, const nh_residue *combination)
{
    const nh_graded_count *g = a->solution[part];
    size_t N = g->total[g->order], n = a->kept;
    nh_residue *out = nh_alloc_array(g->alphas * rows * n + 1, sizeof *out),
               *own = nh_alloc_array(N * n + 1, sizeof *own);
    for (size_t alpha = 0; alpha < g->alphas; alpha++) {
        for (size_t s = 0; s < N; s++)
            for (size_t k = 0; k < n; k++) own[s * n + k] = a->value[k * a->width + a->first[part] + alpha * N + s];
        nh_residue_matrix_multiply(a->field, rows, N, n, combination, own, out + alpha * rows * n);
    }
    nh_free(own);
    return out;
}

/* ---- what is new ---- */

/* The rows of one echelon form that are new. */
typedef struct {
    nh_residue *row; /* rows x (terms + N) */
    /* index of the terms; which rows; how many; the number of their terms together */
    size_t width, *order, *fresh, count, length;
} representatives;

static void add_constructed(nh_construction *out, const nh_construct_attempt *a, const nh_graded_count *g,
                            const representatives *r, size_t i)
{
    const nh_jet_equations *x = a->counter->equations;
    nh_constructed *c = &out->item[out->count++];
    size_t terms = g->alphas * a->kept;
    *c = (nh_constructed){.term = nh_arena_alloc(out->arena, terms * sizeof *c->term)};
    for (size_t j = 0; j < terms; j++) {
        if (!r->row[i * r->width + j]) continue;
        nh_ex e = nh_closed_words_expression(a->words, a->chosen[r->order[j] % a->kept]);
        e = nh_mul(x->dag, e, nh_velocity_frame_monomial(a->frame, x, g->alpha + r->order[j] / a->kept * x->n));
        c->term[c->terms++] = e;
    }
}

static representatives represent(const nh_construct_attempt *a, const nh_graded_count *g, size_t rows,
                                 const nh_residue *combination, const nh_residue *coefficient, size_t way,
                                 nh_construct_news *x, size_t part)
{
    size_t N = g->total[g->order], terms = g->alphas * a->kept;
    representatives r = {.order = order_terms(a, g, a->counter->equations->n, way), .width = terms + N};
    r.row = simplest(a, g, rows, combination, coefficient, r.order);
    r.fresh = nh_alloc_array(rows + 1, sizeof *r.fresh);
    for (size_t i = rows; i-- > 0;) {
        if (!nh_construct_news_add(x, a, part, r.row + i * r.width + terms)) continue;
        r.fresh[r.count++] = i;
        for (size_t j = 0; j < terms; j++) r.length += r.row[i * r.width + j] != 0;
    }
    return r;
}

static void representatives_clear(representatives *r)
{
    nh_free(r->row);
    nh_free(r->order);
    nh_free(r->fresh);
}

/* For one parity: the shortest representatives from several echelon forms. */
static void recognise(nh_construction *out, nh_construct_attempt *a, size_t part, nh_construct_news *x)
{
    enum { ways = 4 };
    const nh_graded_count *g = a->solution[part];
    size_t N = g->total[g->order], before = x->known.rows;
    nh_residue *combination = nh_alloc_array(N * N + 1, sizeof *combination);
    size_t found = recognised(a, part, combination);
    out->recognised += found;
    if (nh_construct_news_count(x, a, part, found, combination)) {
        nh_residue *coefficient = in_words(a, part, found, combination);
        representatives best = represent(a, g, found, combination, coefficient, 0, x, part);
        for (size_t way = 1; way < ways; way++) {
            x->known.rows = before;
            representatives r = represent(a, g, found, combination, coefficient, way, x, part),
                            worse = r.length < best.length ? best : r;
            if (r.length < best.length) best = r;
            representatives_clear(&worse);
        }
        out->item = nh_realloc_array(out->item, out->count + best.count + 1, sizeof *out->item);
        for (size_t i = 0; i < best.count; i++) add_constructed(out, a, g, &best, best.fresh[i]);
        representatives_clear(&best);
        nh_free(coefficient);
    }
    nh_free(combination);
}

/* ---- a point ---- */

/* The solutions of both parities. */
static nh_construct_outcome solve(nh_construction *out, nh_construct_attempt *a, size_t degree)
{
    nh_counter *c = a->counter;
    a->parts = a->series->split ? 2 : 1;
    for (size_t part = 0; part < a->parts; part++) {
        nh_graded_problem p = nh_count_problem(c, a->series, degree,
                                               a->parts == 1 ? NH_ALL_DEGREES
                                               : part        ? NH_ODD_DEGREES
                                                             : NH_EVEN_DEGREES);
        p.keep = true;
        nh_graded_count *g = a->solution[part] = nh_graded_solve(&p);
        c->work += g->work;
        if (!g->solved || c->work >= c->q->work || nh_late()) return NH_CONSTRUCT_TOO_MUCH;
        out->dimension += g->total[g->order];
    }
    out->solutions = out->dimension;
    return NH_CONSTRUCT_DONE;
}

/* Rewrites the coefficients of w^alpha in the frame's velocities. */
static bool in_frame(nh_construct_attempt *a)
{
    bool good = true;
    for (size_t part = 0; part < a->parts && good; part++)
        good = nh_velocity_frame_apply(a->frame, a->counter->equations, a->series->ring, a->series->coordinate,
                                       a->solution[part], &a->counter->work);
    return good;
}

/* Handles one parity after another: each new integral joins the known ones. */
nh_construct_outcome nh_construct_recognise(nh_construction *out, nh_construct_attempt *a,
                                            const nh_construct_question *question)
{
    nh_counter *c = a->counter;
    nh_construct_news x = {0};
    bool scarce = c->work + nh_construct_columns(a) < c->q->work,
         good = !scarce || (nh_construct_news_open(&x, a, question) && in_frame(a) && nh_construct_values(a));
    if (good && scarce) {
        nh_construct_words_choose(a);
        scarce = nh_construct_words_scarce(a, out->order, a->kept, a->chosen) && c->work < c->q->work && !nh_late();
    }
    for (size_t part = 0; part < a->parts && good && scarce; part++)
        if (x.solution[part]) recognise(out, a, part, &x);
    nh_construct_news_close(&x);
    return !good ? NH_CONSTRUCT_UNLUCKY : scarce ? NH_CONSTRUCT_DONE : NH_CONSTRUCT_TOO_MUCH;
}

void nh_construct_attempt_clear(nh_construct_attempt *a)
{
    for (size_t part = 0; part < a->parts; part++) nh_graded_count_clear(a->solution[part]);
    nh_count_lines_clear(&a->lines);
    nh_count_series_free(a->series);
    nh_free(a->value);
    nh_free(a->chosen);
}

static nh_construct_outcome solve_and_recognise(nh_construction *out, nh_construct_attempt *a,
                                                const nh_construct_question *question)
{
    nh_counter *c = a->counter;
    bool regular;
    out->order = nh_construct_order(a, question->degree);
    if (!out->order) return NH_CONSTRUCT_TOO_MUCH;
    a->series = nh_count_series_create(c, out->order, c->q->work, &regular);
    if (!a->series) return regular ? NH_CONSTRUCT_TOO_MUCH : NH_CONSTRUCT_UNLUCKY;
    a->field = a->series->ring->field;
    nh_construct_outcome solved = solve(out, a, question->degree);
    if (solved != NH_CONSTRUCT_DONE) return solved;
    a->lines = nh_count_lines_create(a->series->ring, a->words->words + out->dimension + spare);
    return nh_construct_recognise(out, a, question);
}

/* One attempt at the regular point of the counter. */
static nh_construct_outcome attempt_at(nh_construction *out, nh_counter *c, nh_closed_words *words,
                                       const nh_velocity_frame *frame, const nh_construct_question *question)
{
    nh_construct_attempt a = {.counter = c, .words = words, .frame = frame};
    nh_construct_outcome o = solve_and_recognise(out, &a, question);
    nh_construct_attempt_clear(&a);
    return o;
}

/* ---- the construction ---- */

/* The scalings for which the words' letters have weights. */
static nh_scalings scalings_of(nh_jet_equations *x, const nh_closed_words *words, const nh_velocity_frame *frame)
{
    size_t count = 0;
    nh_ex *function = nh_alloc_array(words->letters + frame->n + 1, sizeof *function);
    for (size_t i = 0; i < frame->n; i++)
        if (frame->shown[i] != nh_int(x->dag, 1)) function[count++] = frame->value[i];
    for (size_t i = 0; i < words->letters; i++) function[count++] = words->letter[i].power[1].value;
    nh_scalings out = nh_scaling_find(x, count, function);
    nh_free(function);
    return out;
}

nh_construction *nh_construct(const nh_model *model, const nh_construct_question *question)
{
    nh_arena *arena = nh_arena_create();
    nh_construction *out = nh_arena_alloc(arena, sizeof *out);
    nh_count_question q = {.time = question->time,
                           .shape = question->shape,
                           .idle = question->rates ? question->rates->idle : 0,
                           .idle_coordinate = question->rates ? question->rates->idle_coordinate : NULL,
                           .degree = question->degree,
                           .work = question->work,
                           .threads = question->threads,
                           .known = question->known,
                           .independent = question->independent,
                           .current = question->current};
    nh_counter c;
    *out = (nh_construction){.arena = arena, .whole = question->weights};
    nh_counter_open(&c, model, &q, false);
    nh_closed_words *words = NULL;
    nh_scalings scalings = {0};
    nh_velocity_frame frame = nh_velocity_frame_of(c.equations);
    bool some = !c.equations->obstacle;
    if (some) words = nh_closed_words_create(c.equations, question->price, question->secular, question->rates);
    some = some && !c.equations->obstacle;
    if (some && question->weights) {
        scalings = scalings_of(c.equations, words, &frame);
        some = scalings.count > 0;
    } else if (some) {
        some = nh_closed_words_list(words, question->most_words, NULL);
        if (some) some = nh_closed_words_reduce(words, INFINITY, &c.work);
    }
    nh_construct_outcome o = some ? NH_CONSTRUCT_UNLUCKY : NH_CONSTRUCT_TOO_MUCH;
    for (size_t point = 0; point < most_points && o == NH_CONSTRUCT_UNLUCKY && !c.equations->obstacle && !nh_late();
         point++) {
        if (!nh_count_regular_point(&c, point)) continue;
        out->dimension = out->recognised = 0;
        if (question->weights) o = nh_construct_by_weights(out, &c, words, &frame, &scalings, point, question);
        else o = attempt_at(out, &c, words, &frame, question);
    }
    if (words && !question->weights) out->words = words->words;
    out->limited = o != NH_CONSTRUCT_DONE;
    out->whole &= o == NH_CONSTRUCT_DONE;
    out->work = c.work;
    nh_scaling_clear(&scalings);
    nh_velocity_frame_clear(&frame);
    nh_closed_words_free(words);
    nh_counter_close(&c);
    return out;
}

void nh_construction_free(nh_construction *c)
{
    if (!c) return;
    nh_free(c->item);
    nh_arena_free(c->arena);
}
