/* Words under random functionals: a basis of their span and its echelon form, and orders at which there are enough
 * coefficients to tell them apart. */
#include "count/construct_internal.h"

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

/* There must be fewer functions of some of the coordinates than coefficients, or every function would be a combination
 * of them.  `word`: which words; NULL: all. */
bool nh_construct_words_scarce(const nh_construct_attempt *a, size_t order, size_t words, const size_t *word)
{
    const nh_adapted_frame *f = a->counter->frame;
    size_t m = f->all, leaf = f->kept, *weight = nh_alloc_array(m + 1, sizeof *weight);
    size_t *own = nh_alloc_array(m + 1, sizeof *own);
    bool good = true;
    least_weights(f, weight);
    for (uint32_t set = 1; set < (uint32_t)1 << m && good; set++) {
        size_t variables = 0, among = 0, room;
        for (size_t k = 0; k < m; k++)
            if (set >> k & 1) own[variables++] = weight[k];
        for (size_t k = 0; k < words; k++)
            among += !(nh_closed_words_coordinates(a->words, word ? word[k] : k) & ~set);
        bool all = variables >= leaf; /* on a leaf only so many coordinates vary independently */
        room = nh_jet_ring_size(all ? leaf : variables, all ? f->weight : own, order, most_coefficients);
        good = among + (all ? spare : spare_few) <= room;
    }
    nh_free(own);
    nh_free(weight);
    return good;
}

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

bool nh_construct_values(nh_construct_attempt *a)
{
    const nh_jet_ring *ring = a->series->ring;
    a->width = a->words->words;
    for (size_t part = 0; part < a->parts; part++) {
        a->first[part] = a->width;
        a->width += a->solution[part]->alphas * a->solution[part]->total[ring->order];
    }
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
