#include "study/result.h"

#include <stdarg.h>
#include <stdio.h>

enum { most_warnings = 200 };

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
