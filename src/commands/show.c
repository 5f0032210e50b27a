#include "commands/show.h"

#include "base/progress.h"

nh_model *nh_shown_other(const nh_model *model, const nh_options *options)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!model->chart->quasi || !model->k) return NULL;
    return nh_model_create(model->system,
                           nh_chart_create(model->system, NH_CHART_COORDINATES, (uint64_t)options->seed, &ignored),
                           &ignored);
}

nh_shown *nh_shown_create(const nh_request *q, nh_error *error)
{
    nh_progress("the geometry", -1);
    nh_system *system = nh_system_read(q->system_path, q->settings, q->setting, error);
    nh_chart *chart = system ? nh_chart_create(system, q->chart, (uint64_t)q->options.seed, error) : NULL;
    nh_model *model = chart ? nh_model_create(system, chart, error) : NULL;
    if (model && nh_interrupted()) {
        nh_model_free(model);
        model = NULL;
    }
    if (!model) {
        nh_system_free(system);
        return NULL;
    }
    nh_arena *arena = nh_arena_create();
    nh_shown *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_shown){.arena = arena, .system = system, .model = model, .options = q->options};
    return s;
}

void nh_shown_complete(nh_shown *s)
{
    if (s->own) return;
    s->other = nh_shown_other(s->model, &s->options);
    s->own = s->theory = nh_theory_of(s->arena, s->model, NULL, 0, &s->options);
    if (s->other) s->theory = nh_theory_of(s->arena, s->model, s->other, 0, &s->options);
}

void nh_shown_free(nh_shown *s)
{
    if (!s) return;
    nh_model_free(s->other);
    nh_model_free(s->model);
    nh_system_free(s->system);
    nh_arena_free(s->arena);
}
