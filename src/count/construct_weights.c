/* construct_weights: short series give the weights lambda of the solutions under a scaling; those of one weight are
 * continued alone, and recognised in words whose weights fit. [docs/method.md, sec. 10, "Weights"]
 *
 *     solve           all N solutions, up to a short order
 *     matrix_of       S on them; its characteristic polynomial has the factors x - lambda
 *     eigenspace      the solutions with S(Phi) = lambda Phi
 *     recognise       words of the weights lambda - sigma . alpha; the solutions continued to the order that tells
 *                     these words apart; nh_construct_recognise */
#include "count/construct_internal.h"

#include <flint/nmod.h>
#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <string.h>

#include "base/progress.h"
#include "count/scaling.h"

/* dependent_words: of so many words that are listed one is independent of the others, at least */
enum { spare = 24, beyond_degree = 3, most_solutions = 600, dependent_words = 10 };

typedef struct {
    nh_counter *counter;
    nh_closed_words *words;
    const nh_velocity_frame *frame;
    const nh_scalings *scalings;
    const nh_construct_question *question;
    nh_construction *out;
    size_t point;
    nh_residue *scaling;      /* kappa, mu, sigma */
    nh_residue *velocity;     /* n: the weights of the frame's velocities */
    nh_construct_attempt few; /* the short series */
} weighing;

/* ---- the scaling on the solutions ---- */

/* kappa_k q_k + mu_k */
static nh_residue *components(const weighing *w)
{
    const nh_count_series *s = w->few.series;
    size_t m = w->counter->frame->all, size = s->ring->size;
    nh_residue *along = nh_alloc_array(m * size + 1, sizeof *along);
    for (size_t k = 0; k < m; k++) {
        nh_jet_constant(s->ring, w->scaling[m + k], along + k * size);
        nh_jet_add_multiple(s->ring, along + k * size, w->scaling[k], s->coordinate + k * size);
    }
    return along;
}

/* sum_i sigma_i alpha_i for each monomial. */
static nh_residue *sums(const weighing *w, const nh_graded_count *g, const nh_residue *sigma)
{
    size_t n = w->counter->equations->n;
    nh_prime f = w->few.field;
    nh_residue *sum = nh_alloc_array(g->alphas + 1, sizeof *sum);
    for (size_t a = 0; a < g->alphas; a++)
        for (size_t i = 0; i < n; i++)
            sum[a] = nh_residue_add(f, sum[a], nh_residue_mul(f, sigma[i], nh_residue_of(f, g->alpha[a * n + i])));
    return sum;
}

/* The matrix of S on the solutions of one parity; false: the series are too short. */
static bool matrix_of(const weighing *w, const nh_graded_count *g, nmod_mat_t A)
{
    size_t N = g->total[g->order], m = w->counter->frame->all;
    nh_residue *along = components(w), *factor = sums(w, g, w->scaling + 2 * m),
               *value = nh_alloc_array(N * N + 1, sizeof *value);
    bool closed = nh_solution_matrix(w->counter, w->few.series, g, along, factor, value, &w->counter->work);
    for (size_t i = 0; i < N && closed; i++)
        for (size_t j = 0; j < N; j++) nmod_mat_entry(A, i, j) = value[i * N + j];
    nh_free(value);
    nh_free(factor);
    nh_free(along);
    return closed;
}

/* The solutions of weight lambda as rows of `out`, combinations of all N; their number. */
static size_t eigenspace(const nmod_mat_t A, size_t N, nh_residue lambda, nh_residue *out)
{
    nmod_mat_t B, X;
    nmod_mat_init_set(B, A);
    nmod_mat_init(X, (slong)N, (slong)N, A->mod.n);
    for (size_t i = 0; i < N; i++) nmod_mat_entry(B, i, i) = nmod_sub(nmod_mat_entry(B, i, i), lambda, A->mod);
    size_t count = (size_t)nmod_mat_nullspace(X, B);
    for (size_t r = 0; r < count; r++)
        for (size_t i = 0; i < N; i++) out[r * N + i] = (nh_residue)nmod_mat_entry(X, i, r);
    nmod_mat_clear(X);
    nmod_mat_clear(B);
    return count;
}

/* ---- the solutions of one weight ---- */

/* The weights of words that coefficients of these solutions can have: lambda - sigma . alpha. */
static nh_closed_weights weights_of_words(const weighing *w, const nh_graded_count *g, nh_residue lambda,
                                          nh_residue *room)
{
    nh_closed_weights out = {.field = w->few.field, .weight = room};
    nh_residue *sum = sums(w, g, w->velocity);
    for (size_t a = 0; a < g->alphas; a++) {
        nh_residue weight = nh_residue_sub(w->few.field, lambda, sum[a]);
        bool old = false;
        for (size_t i = 0; i < out.count; i++) old |= room[i] == weight;
        if (!old) room[out.count++] = weight;
    }
    nh_free(sum);
    return out;
}

/* The short series of these combinations. */
static nh_residue *combined(const weighing *w, const nh_graded_count *g, size_t count, const nh_residue *combination)
{
    size_t N = g->total[g->order], rows = g->alphas * w->few.series->ring->size;
    nh_residue *out = nh_alloc_array(rows * count + 1, sizeof *out);
    for (size_t r = 0; r < rows; r++)
        for (size_t k = 0; k < count; k++) {
            uint64_t sum = 0;
            for (size_t s = 0; s < N; s++)
                sum = nh_residue_gather(w->few.field, sum, g->series[r * N + s], combination[k * N + s]);
            out[r * count + k] = nh_residue_reduce(w->few.field, sum);
        }
    w->counter->work += (double)rows * (double)N * (double)count;
    return out;
}

/* Continues the solutions to the order at which the words can be told apart. */
static nh_construct_outcome continued(weighing *w, nh_construct_attempt *a, nh_parity parity, size_t count,
                                      const nh_residue *series)
{
    nh_counter *c = w->counter;
    bool regular;
    size_t order = nh_construct_order(a, w->question->degree), least = w->few.series->ring->order + 1;
    if (!order) return NH_CONSTRUCT_TOO_MUCH;
    w->out->order = order < least ? least : order;
    a->series = nh_count_series_create(c, w->out->order, c->q->work, &regular);
    if (!a->series) return regular ? NH_CONSTRUCT_TOO_MUCH : NH_CONSTRUCT_UNLUCKY;
    nh_graded_problem p = nh_count_problem(c, a->series, w->question->degree, parity);
    p.keep = true;
    p.from = count;
    p.from_order = w->few.series->ring->order;
    p.from_size = w->few.series->ring->size;
    p.from_series = series;
    a->field = a->series->ring->field;
    a->parts = 1;
    nh_graded_count *g = a->solution[0] = nh_graded_solve(&p);
    c->work += g->work;
    if (!g->solved || c->work >= c->q->work || nh_late()) return NH_CONSTRUCT_TOO_MUCH;
    w->out->dimension += g->total[g->order];
    a->lines = nh_count_lines_create(a->series->ring, a->words->words + g->total[g->order] + spare);
    return NH_CONSTRUCT_DONE;
}

static nh_construct_outcome recognise(weighing *w, size_t part, nh_residue lambda, size_t count,
                                      const nh_residue *combination)
{
    nh_counter *c = w->counter;
    const nh_graded_count *g = w->few.solution[part];
    nh_residue *room = nh_alloc_array(g->alphas + 1, sizeof *room);
    nh_closed_weights wanted = weights_of_words(w, g, lambda, room);
    nh_construct_outcome o = NH_CONSTRUCT_TOO_MUCH;
    bool some = nh_closed_words_list(w->words, dependent_words * w->question->most_words, &wanted);
    some = some && nh_closed_words_reduce(w->words, c->q->work, &c->work);
    if (some && w->words->words > w->out->words) w->out->words = w->words->words;
    if (some && w->words->words <= w->question->most_words) {
        nh_parity parity = w->few.parts == 1 ? NH_ALL_DEGREES : part ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
        nh_construct_attempt a = {.counter = c, .words = w->words, .frame = w->frame, .scalings = w->scalings};
        nh_residue *series = combined(w, g, count, combination);
        o = nh_count_regular_point(c, w->point) ? continued(w, &a, parity, count, series) : NH_CONSTRUCT_UNLUCKY;
        if (o == NH_CONSTRUCT_DONE) o = nh_construct_recognise(w->out, &a, w->question);
        nh_construct_attempt_clear(&a);
        nh_free(series);
    }
    nh_free(room);
    return o;
}

/* ---- all weights ---- */

/* Handles the weights of one parity whose solutions are not all known. */
static nh_construct_outcome recognise_part(weighing *w, size_t part, nh_construct_news *news)
{
    const nh_graded_count *g = w->few.solution[part];
    size_t N = g->total[g->order];
    nmod_mat_t A;
    nmod_poly_t characteristic;
    nmod_poly_factor_t factors;
    nh_construct_outcome o = NH_CONSTRUCT_DONE;
    nmod_mat_init(A, (slong)N, (slong)N, w->few.field.p);
    nmod_poly_init(characteristic, w->few.field.p);
    nmod_poly_factor_init(factors);
    nh_residue *combination = nh_alloc_array(N * N + 1, sizeof *combination);
    if (matrix_of(w, g, A)) {
        nmod_mat_charpoly(characteristic, A);
        nmod_poly_factor(factors, characteristic);
    } else o = NH_CONSTRUCT_TOO_MUCH;
    for (slong i = 0; i < factors->num && o != NH_CONSTRUCT_UNLUCKY && w->counter->work < w->counter->q->work; i++) {
        w->out->whole &= nmod_poly_degree(factors->p + i) == 1;
        if (nmod_poly_degree(factors->p + i) != 1) continue;
        nh_residue lambda = nh_residue_negative(w->few.field, (nh_residue)nmod_poly_get_coeff_ui(factors->p + i, 0));
        size_t count = eigenspace(A, N, lambda, combination);
        w->out->whole &= count == (size_t)factors->exp[i];
        if (!nh_construct_news_count(news, &w->few, part, count, combination)) continue;
        nh_construct_outcome own = recognise(w, part, lambda, count, combination);
        if (own != NH_CONSTRUCT_DONE) o = own;
    }
    nh_free(combination);
    nmod_poly_factor_clear(factors);
    nmod_poly_clear(characteristic);
    nmod_mat_clear(A);
    return o;
}

/* All solutions up to a short order. */
static nh_construct_outcome solve(weighing *w, size_t order)
{
    nh_counter *c = w->counter;
    bool regular;
    nh_construct_attempt *a = &w->few;
    w->out->solutions = 0;
    a->series = nh_count_series_create(c, order, c->q->work, &regular);
    if (!a->series) return regular ? NH_CONSTRUCT_TOO_MUCH : NH_CONSTRUCT_UNLUCKY;
    a->field = a->series->ring->field;
    a->parts = a->series->split ? 2 : 1;
    for (size_t part = 0; part < a->parts; part++) {
        nh_parity parity = a->parts == 1 ? NH_ALL_DEGREES : part ? NH_ODD_DEGREES : NH_EVEN_DEGREES;
        nh_graded_problem p = nh_count_problem(c, a->series, w->question->degree, parity);
        p.keep = true;
        nh_graded_count *g = a->solution[part] = nh_graded_solve(&p);
        c->work += g->work;
        if (!g->solved || g->total[g->order] > most_solutions || c->work >= c->q->work || nh_late())
            return NH_CONSTRUCT_TOO_MUCH;
        w->out->solutions += g->total[g->order];
    }
    return NH_CONSTRUCT_DONE;
}

/* Velocities alone may be scaled: then the weights do not tell words apart. */
static bool have_weights(const nh_closed_words *words)
{
    bool some = false;
    for (size_t i = 0; i < words->letters; i++)
        for (size_t k = 0; k < words->letter[i].powers; k++) some |= words->letter[i].power[k].weight != 0;
    return some;
}

/* The weights of the frame's velocities: sigma_i and that of the factor. */
static bool weigh_velocities(weighing *w)
{
    size_t n = w->frame->n, m = w->counter->equations->coordinates;
    nh_prime f = w->counter->equations->point->field;
    bool *constant = nh_alloc_array(n + 1, sizeof *constant), all = true;
    nh_scaling_weights(w->counter->equations, w->scaling, f, n, w->frame->value, w->velocity, constant);
    for (size_t i = 0; i < n; i++) {
        w->velocity[i] = nh_residue_add(f, w->velocity[i], w->scaling[2 * m + i]);
        all &= constant[i];
    }
    nh_free(constant);
    return all;
}

nh_construct_outcome nh_construct_by_weights(nh_construction *out, nh_counter *c, nh_closed_words *words,
                                             const nh_velocity_frame *frame, const nh_scalings *scalings, size_t point,
                                             const nh_construct_question *question)
{
    weighing w = {.counter = c,
                  .words = words,
                  .frame = frame,
                  .scalings = scalings,
                  .question = question,
                  .out = out,
                  .point = point,
                  .few = {.counter = c, .words = words, .frame = frame}};
    if (c->frame->kept != c->frame->all) return NH_CONSTRUCT_TOO_MUCH;
    nh_prime field = c->equations->point->field;
    size_t order = (question->degree + beyond_degree) * c->frame->step;
    w.scaling = nh_alloc_array(scalings->width + 1, sizeof *w.scaling);
    w.velocity = nh_alloc_array(frame->n + 1, sizeof *w.velocity);
    nh_construct_news news = {0};
    nh_construct_outcome o = NH_CONSTRUCT_UNLUCKY;
    bool good = nh_scaling_combine(scalings, field, w.scaling);
    if (good) {
        out->whole &= nh_closed_words_weigh(words, w.scaling, field);
        o = have_weights(words) && weigh_velocities(&w) ? NH_CONSTRUCT_DONE : NH_CONSTRUCT_TOO_MUCH;
    }
    if (o == NH_CONSTRUCT_DONE) o = nh_count_regular_point(c, point) ? solve(&w, order) : NH_CONSTRUCT_UNLUCKY;
    if (o == NH_CONSTRUCT_DONE && !nh_construct_news_open(&news, &w.few, question)) o = NH_CONSTRUCT_UNLUCKY;
    for (size_t part = 0; part < w.few.parts && o == NH_CONSTRUCT_DONE; part++)
        if (news.solution[part]) o = recognise_part(&w, part, &news);
    nh_construct_news_close(&news);
    nh_construct_attempt_clear(&w.few);
    nh_free(w.velocity);
    nh_free(w.scaling);
    return o;
}
