#include "system/sample_grid.h"

#include <math.h>
#include <string.h>

#include "base/text.h"

static const double most_points = 1e8;
enum { most_level = 40 };

static const char *const word_of[] = {"sobol", "halton", "tensor", "sparse", "motion", "file"};

const char *nh_sample_grid_word(nh_grid_kind kind) { return word_of[kind]; }

bool nh_sample_grid_kind(const char *word, nh_grid_kind *kind, nh_error *error)
{
    size_t length = strlen(word), ending = strlen(".csv");
    *kind = NH_GRID_FILE;
    if (length > ending && !strcmp(word + length - ending, ".csv")) return true;
    for (size_t i = 0; i < NH_GRID_FILE; i++)
        if (!strcmp(word, word_of[i])) return *kind = (nh_grid_kind)i, true;
    nh_fail(error, NH_USAGE, "", "there is no grid `%s`", word);
    return nh_error_hint_near(error, word, word_of, NH_GRID_FILE,
                              "a grid is sobol, halton, tensor, sparse, motion, or a file of points: points.csv");
}

/* The number of nodes that a level adds in one variable. */
static size_t added(size_t level) { return level == 0 ? 1 : level == 1 ? 2 : (size_t)1 << (level - 1); }

/* sum over i_1 + .. + i_d = exactly l, for l = 0 .. level: one variable after the other. */
static double sparse_count(size_t dimension, size_t level)
{
    double *by = nh_alloc_array(2 * (level + 1), sizeof *by), *next = by + level + 1, sum = 0;
    by[0] = 1;
    for (size_t d = 0; d < dimension; d++) {
        for (size_t l = 0; l <= level; l++) {
            next[l] = 0;
            for (size_t i = 0; i <= l; i++) next[l] += by[l - i] * (double)added(i);
        }
        memcpy(by, next, (level + 1) * sizeof *by);
    }
    for (size_t l = 0; l <= level; l++) sum += by[l];
    nh_free(by);
    return sum;
}

size_t nh_sample_grid_count(nh_grid_kind kind, size_t dimension, size_t level)
{
    double count = kind == NH_GRID_TENSOR ? pow((double)level, (double)dimension)
                   : level < most_level   ? sparse_count(dimension, level)
                                          : INFINITY;
    return count < most_points ? (size_t)count : SIZE_MAX;
}

/* The i-th node that a level adds: 0; -1, 1; then the extrema with odd numbers of the next polynomial. */
static double nested(size_t level, size_t i)
{
    if (level == 0) return 0;
    if (level == 1) return i ? 1 : -1;
    return -cos(M_PI * (double)(2 * i + 1) / (double)((size_t)1 << level));
}

/* The product of what the levels add, appended at *at. */
static void product(size_t dimension, const size_t *level, double **at)
{
    size_t count = 1;
    for (size_t d = 0; d < dimension; d++) count *= added(level[d]);
    for (size_t p = 0; p < count; p++, *at += dimension)
        for (size_t d = 0, rest = p; d < dimension; rest /= added(level[d]), d++)
            (*at)[d] = nested(level[d], rest % added(level[d]));
}

/* All levels with i_d + .. <= left, from variable d on. */
static void unions(size_t dimension, size_t d, size_t left, size_t *level, double **at)
{
    if (d == dimension) {
        product(dimension, level, at);
        return;
    }
    for (level[d] = 0; level[d] <= left; level[d]++) unions(dimension, d + 1, left - level[d], level, at);
}

double *nh_sample_grid_nodes(nh_grid_kind kind, size_t dimension, size_t level)
{
    size_t count = nh_sample_grid_count(kind, dimension, level);
    double *node = nh_alloc_array(count * dimension + 1, sizeof *node), *at = node;
    size_t *levels = nh_alloc_array(dimension + 1, sizeof *levels);
    if (kind == NH_GRID_SPARSE) unions(dimension, 0, level, levels, &at);
    for (size_t p = 0; kind == NH_GRID_TENSOR && p < count; p++)
        for (size_t d = 0, rest = p; d < dimension; rest /= level, d++)
            *at++ = -cos(M_PI * (double)(2 * (rest % level) + 1) / (double)(2 * level));
    nh_free(levels);
    return node;
}
