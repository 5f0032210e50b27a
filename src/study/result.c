#include "study/result.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { most_warnings = 200 };

nh_spectrum nh_spectrum_of(nh_arena *arena, const nh_nullspace *s)
{
    nh_spectrum c = {.done = true, .verdict = s->verdict, .columns = s->columns, .rows = s->rows, .rank = s->rank, .dimension = s->dimension, .likely = s->likely,
                     .gap = s->gap, .rank_in_doubt = s->rank_in_doubt};
    c.spectrum = nh_arena_alloc(arena, (s->rank + 1) * sizeof *c.spectrum);
    if (s->rank) memcpy(c.spectrum, s->spectrum, s->rank * sizeof *c.spectrum);
    return c;
}

const char *nh_search_word(nh_search search)
{
    static const char *const words[] = {[NH_SEARCH_COMPLETE] = "complete", [NH_SEARCH_EXHAUSTED] = "exhausted", [NH_SEARCH_CUT] = "cut"};
    return words[search];
}

const char *nh_limit_words(nh_arena *arena, const nh_limit *limit) { return nh_arena_printf(arena, "--option %s=%.0f", limit->option, limit->value); }

size_t nh_result_left_out(const nh_result *r)
{
    size_t count = 0;
    for (size_t i = 0; i < r->stages; i++) count += r->stage[i].skipped;
    return count;
}

void nh_result_warn(nh_result *r, const char *format, ...)
{
    char text[1000];
    va_list list;
    if (r->warnings == most_warnings) return;
    if (!r->warning) r->warning = nh_arena_alloc(r->arena, most_warnings * sizeof *r->warning);
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    r->warning[r->warnings++] = nh_arena_strdup(r->arena, text);
}

void nh_result_free(nh_result *r)
{
    if (!r) return;
    nh_validation_free(r->validation);
    nh_hits_free(r->hits);
    nh_model_free(r->other);
    nh_model_free(r->model);
    nh_analysis_free(r->analysis);
    nh_system_free(r->system);
    nh_arena_free(r->arena);
}
