/* construct_words: words under random functionals: a basis of their span and its echelon form, and orders at which
 * there are enough coefficients to tell them apart.
 *
 * For every set of coordinates there must be fewer words of it than coefficients up to the order: of k variables with
 * weights w_1 .. w_k these are the monomials of weight r at most; under scalings so many variables less. */
#include "count/construct_internal.h"

#include <stdlib.h>
#include <string.h>

#include "base/progress.h"
#include "exact/residue_matrix.h"

enum { spare = 24, spare_few = 2, beyond_degree = 4, most_order = 120, most_coefficients = 20000 };

/* The pivots of the words' columns are a basis of their span, the cheapest words first. */
void nh_construct_words_choose(nh_construct_attempt *a)
{
    size_t words = a->words->words;
    a->chosen = nh_alloc_array(words + 1, sizeof *a->chosen);
    a->kept = nh_residue_matrix_echelon(a->field, a->lines.count, a->width, words, a->value, a->chosen);
    a->counter->work += (double)a->width * (double)a->kept * (double)a->lines.count / NH_CONSTRUCT_ROWS_TOGETHER;
}

/* For each coordinate the least weight of a variable in it: a function of it has a coefficient for each multiple up to
 * the order. */
static void least_weights(const nh_adapted_frame *f, size_t *weight)
{
    for (size_t k = 0; k < f->all; k++) {
        weight[k] = f->step;
        for (size_t j = 0; j < f->kept; j++)
            if (f->to[k * f->all + j] && f->weight[j] < weight[k]) weight[k] = f->weight[j];
    }
}

/* How many of the coordinates of a set the scalings determine from the others, for functions of given weights: the rank
 * of their components there. */
static size_t scaled(const nh_construct_attempt *a, uint32_t set)
{
    const nh_scalings *s = a->scalings;
    const nh_jet_equations *x = a->counter->equations;
    if (!s) return 0;
    nh_prime f = x->point->field;
    size_t m = s->coordinates;
    nh_residue *component = nh_alloc_array(s->count * m + 1, sizeof *component), kappa, mu;
    for (size_t i = 0; i < s->count; i++)
        for (size_t k = 0; k < m; k++) {
            nh_num own = s->number[i * s->width + k], shift = s->number[i * s->width + m + k];
            if (set >> k & 1 && nh_residue_ratio(f, own.p, own.q, &kappa) && nh_residue_ratio(f, shift.p, shift.q, &mu))
                component[i * m + k] = nh_residue_add(f, nh_residue_mul(f, kappa, x->at[k]), mu);
        }
    size_t rank = nh_residue_matrix_rank(f, s->count, m, component);
    nh_free(component);
    return rank;
}

/* The least variables first. */
static int by_weight(const void *a, const void *b)
{
    size_t x = *(const size_t *)a, y = *(const size_t *)b;
    return (x > y) - (x < y);
}

/* Are there fewer words than `room`, of each weight? */
static bool few_enough(size_t words, const nh_residue *weight, const bool *inside, size_t room)
{
    size_t *among = nh_alloc_array(words + 1, sizeof *among), kinds = 0;
    nh_residue *kind = nh_alloc_array(words + 1, sizeof *kind);
    bool good = true;
    for (size_t k = 0; k < words && good; k++) {
        size_t i = 0;
        if (!inside[k]) continue;
        while (i < kinds && kind[i] != weight[k]) i++;
        if (i == kinds) kind[kinds++] = weight[k];
        good = ++among[i] <= room;
    }
    nh_free(kind);
    nh_free(among);
    return good;
}

bool nh_construct_words_scarce(const nh_construct_attempt *a, size_t order, size_t words, const size_t *word)
{
    const nh_adapted_frame *f = a->counter->frame;
    size_t m = f->all, leaf = f->kept, *weight = nh_alloc_array(m + 1, sizeof *weight);
    size_t *own = nh_alloc_array(m + 1, sizeof *own), *all_weights = nh_alloc_array(leaf + 1, sizeof *all_weights);
    nh_residue *kind = nh_alloc_array(words + 1, sizeof *kind);
    bool good = true, *inside = nh_alloc_array(words + 1, sizeof *inside);
    least_weights(f, weight);
    memcpy(all_weights, f->weight, leaf * sizeof *all_weights);
    qsort(all_weights, leaf, sizeof *all_weights, by_weight);
    for (size_t k = 0; k < words && a->scalings; k++)
        kind[k] = nh_closed_words_weight(a->words, a->counter->equations->point->field, word ? word[k] : k);
    for (uint32_t set = 1; set < (uint32_t)1 << m && good; set++) {
        size_t variables = 0, determined = scaled(a, set), room;
        for (size_t k = 0; k < m; k++)
            if (set >> k & 1) own[variables++] = weight[k];
        for (size_t k = 0; k < words; k++)
            inside[k] = !(nh_closed_words_coordinates(a->words, word ? word[k] : k) & ~set);
        qsort(own, variables, sizeof *own, by_weight);
        bool all = variables >= leaf; /* on a leaf only so many coordinates vary independently */
        size_t count = all ? leaf : variables, spared = all ? spare : spare_few;
        const size_t *from = all ? all_weights : own;
        determined = determined < count ? determined : count;
        room = count == determined ? 1 + spared /* one function of each weight */
                                   : nh_jet_ring_size(count - determined, from + determined, order, most_coefficients);
        good = room > spared && few_enough(words, kind, inside, room - spared);
    }
    nh_free(inside);
    nh_free(kind);
    nh_free(all_weights);
    nh_free(own);
    nh_free(weight);
    return good;
}

/* The values of all words along all lines: words x width residues. */
static bool word_values(nh_construct_attempt *a)
{
    nh_counter *c = a->counter;
    size_t words = a->words->words, order = a->series->ring->order, one = 1, all = c->equations->coordinates;
    nh_jet_ring *line = nh_jet_ring_create(a->field, 1, &one, order);
    nh_residue *series = nh_alloc_array(words * line->size, sizeof *series),
               *q = nh_alloc_array(all * line->size + 1, sizeof *q);
    bool good = true;
    for (size_t j = 0; j < a->lines.lines && good && !nh_late(); j++) {
        nh_count_along(a->series->ring, line, a->lines.curve + j * a->lines.size, all, a->series->coordinate, q);
        good = nh_closed_words_evaluate(a->words, line, q, series, &c->work);
        for (size_t k = 0; k < words && good; k++)
            nh_count_line_values(&a->lines, j, a->field, series + k * line->size, a->value + k, a->width);
    }
    nh_free(q);
    nh_free(series);
    nh_jet_ring_free(line);
    return good;
}

double nh_construct_columns(nh_construct_attempt *a)
{
    const nh_jet_ring *ring = a->series->ring;
    size_t words = a->words->words;
    a->width = words;
    for (size_t part = 0; part < a->parts; part++) {
        a->first[part] = a->width;
        a->width += a->solution[part]->alphas * a->solution[part]->total[ring->order];
    }
    return (double)a->width * (double)words * (double)a->lines.count / NH_CONSTRUCT_ROWS_TOGETHER;
}

bool nh_construct_values(nh_construct_attempt *a)
{
    const nh_jet_ring *ring = a->series->ring;
    a->value = nh_alloc_array(a->lines.count * a->width, sizeof *a->value);
    if (!word_values(a)) return false;
    for (size_t part = 0; part < a->parts; part++) {
        const nh_graded_count *g = a->solution[part];
        size_t N = g->total[g->order];
        for (size_t alpha = 0; alpha < g->alphas && N; alpha++)
            nh_count_lines_values(&a->lines, ring, N, g->series + alpha * ring->size * N,
                                  a->value + a->first[part] + alpha * N, a->width);
        a->counter->work +=
            (double)g->alphas * (double)N * (double)ring->size * (double)a->lines.lines / NH_CONSTRUCT_ROWS_TOGETHER;
    }
    return true;
}

/* 0: no order is high enough. */
size_t nh_construct_order(const nh_construct_attempt *a, size_t degree)
{
    const nh_adapted_frame *f = a->counter->frame;
    size_t order = (degree + beyond_degree) * f->step;
    while (order <= most_order && !nh_construct_words_scarce(a, order, a->words->words, NULL)) order++;
    return order <= most_order && nh_jet_ring_size(f->kept, f->weight, order, most_coefficients) < SIZE_MAX ? order : 0;
}
