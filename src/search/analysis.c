#include "search/analysis.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { most_warnings = 200 };

static double rounded(double x, int digits)
{
    char text[40];
    snprintf(text, sizeof text, "%.*e", digits - 1, x);
    return isfinite(x) ? strtod(text, NULL) : x;
}

/* Singular values are rates, relative to 1, with errors of a few roundings of the largest one.  A value below these
 * errors depends on the order of additions, which differs between processors: it is replaced by the bound of the
 * errors.  The others are given with the digits that are known of all values far above it. */
nh_spectrum nh_spectrum_of(nh_arena *arena, const nh_nullspace *s)
{
    enum { digits = 3, digits_of_gap = 2 };
    static const double roundings = 64 * DBL_EPSILON;
    double bound = s->rank ? rounded(roundings * fmax(1, s->spectrum[s->rank - 1]), digits_of_gap) : 0;
    nh_spectrum c = {.done = true,
                     .verdict = s->verdict,
                     .columns = s->columns,
                     .rows = s->rows,
                     .rank = s->rank,
                     .dimension = s->dimension,
                     .likely = s->likely,
                     .gap = s->gap,
                     .rank_in_doubt = s->rank_in_doubt};
    c.spectrum = nh_arena_alloc(arena, (s->rank + 1) * sizeof *c.spectrum);
    for (size_t i = 0; i < s->rank; i++) c.spectrum[i] = fmax(bound, rounded(s->spectrum[i], digits));
    bool both = s->dimension > 0 && s->dimension < s->rank;
    if (both) c.gap = rounded(s->spectrum[s->dimension] / fmax(s->spectrum[s->dimension - 1], bound), digits_of_gap);
    return c;
}

bool nh_analysis_by_trial(const nh_analysis *result) { return result->hits && !result->hits->pencil_applied; }

const char *nh_analysis_stated_word(nh_stated_verdict verdict)
{
    static const char *const word[] = {"found", "not found", "constant", "in a region", "not conserved", "undecided"};
    return word[verdict];
}

const char *nh_search_word(nh_search search)
{
    static const char *const words[] = {
        [NH_SEARCH_COMPLETE] = "complete", [NH_SEARCH_EXHAUSTED] = "exhausted", [NH_SEARCH_CUT] = "cut"};
    return words[search];
}

const char *nh_limit_words(nh_arena *arena, const nh_limit *limit)
{
    return nh_arena_printf(arena, "--option %s=%.0f", limit->option, limit->value);
}

size_t nh_analysis_to_the_end(const nh_analysis *result)
{
    size_t n = 0;
    for (size_t k = 0; k < result->list->pieces; k++) n += result->list->piece[k].to_the_end;
    return n;
}

size_t nh_analysis_left_out(const nh_analysis *result)
{
    size_t count = 0;
    for (size_t i = 0; i < result->stages; i++) count += result->stage[i].skipped;
    return count;
}

void nh_analysis_warn(nh_analysis *result, const char *format, ...)
{
    char text[1000];
    va_list list;
    if (result->warnings == most_warnings) return;
    if (!result->warning) result->warning = nh_arena_alloc(result->arena, most_warnings * sizeof *result->warning);
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    for (size_t k = 0; k < result->warnings; k++)
        if (!strcmp(result->warning[k], text)) return; /* another search of the same system said it already */
    result->warning[result->warnings++] = nh_arena_strdup(result->arena, text);
}

void nh_analysis_free(nh_analysis *result)
{
    if (!result) return;
    nh_validation_free(result->validation);
    nh_count_memory_free(result->counted);
    nh_hits_free(result->hits);
    nh_model_free(result->question->other);
    nh_model_free(result->question->model);
    nh_analysis_file_free(result->question->analysis);
    nh_system_free(result->question->system);
    nh_arena_free(result->arena);
}
