#include "search/other_system.h"
#include "search/current_list.h"

#include <string.h>

nh_system *nh_other_system_copy(nh_arena *arena, const nh_system *system, size_t parameters, size_t constraints)
{
    nh_system *s = nh_arena_alloc(arena, sizeof *s);
    *s = *system;
    s->parameter = nh_arena_alloc(arena, (s->parameters + parameters + 1) * sizeof *s->parameter);
    if (s->parameters) memcpy(s->parameter, system->parameter, s->parameters * sizeof *s->parameter);
    s->constraint = nh_arena_alloc(arena, (s->constraints + constraints + 1) * sizeof *s->constraint);
    if (s->constraints) memcpy(s->constraint, system->constraint, s->constraints * sizeof *s->constraint);
    s->currents = s->not_conserved = s->robustness_maps = 0;
    return s;
}

void nh_other_system_parameter(nh_system *system, const char *name, nh_ex symbol, double value)
{
    system->parameter[system->parameters++] =
        (nh_parameter){.name = name, .unit = "", .symbol = symbol, .value = value, .written = value};
}

nh_analysis *nh_other_system_open(const nh_analysis *first, nh_system *system, nh_chart_choice choice)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_analysis_question *question = nh_arena_alloc(first->arena, sizeof *question);
    *question = (nh_analysis_question){
        .options = first->question->options, .system = system, .derived = true, .left_out = first->question->left_out};
    nh_chart *chart = nh_chart_create(system, choice, (uint64_t)question->options.seed, &ignored);
    question->model = nh_model_create(system, chart, &ignored);
    if (!question->model) return NULL;
    question->local_maximum = 2 * question->model->m - question->model->k;
    question->constraint = nh_distribution_of(question->model);
    nh_analysis *other = nh_arena_alloc(first->arena, sizeof *other);
    *other = (nh_analysis){.arena = first->arena, .question = question};
    nh_current_list_begin(other);
    return other;
}

void nh_other_system_close(nh_analysis *other)
{
    if (!other) return;
    nh_count_memory_free(other->counted);
    nh_model_free(other->question->model);
}
