/* scan_spaces: the smallest generalized singular values of ansatz spaces, as functions of the parameters.
 *
 * The spaces are stages of the search that are small enough, with the parameters as symbols, so that a space is the
 * same at every value. The values are those of integrals/nullspace.h. */
#include <math.h>

#include "commands/scan_internal.h"
#include "search/stages.h"
#include "integrals/echelon.h"
#include "integrals/rows.h"

enum { least_samples = 256, samples_per_column = 4 };

/* A system at some place, with the functions of its spaces. */
typedef struct {
    nh_system *system;
    nh_model *model;
    nh_dictionary words;
    nh_points *ranges;
} scene;

static void scene_end(scene *s)
{
    nh_points_free(s->ranges);
    nh_model_free(s->model);
    nh_system_free(s->system);
}

static bool scene_begin(scene *s, const nh_scan_request *q, size_t settings, const nh_setting *setting, nh_error *error)
{
    uint64_t seed = (uint64_t)q->options.seed;
    *s = (scene){.system = nh_system_read(q->system_path, settings, setting, error)};
    nh_chart *chart = s->system ? nh_chart_create(s->system, NH_CHART_AUTO, seed, error) : NULL;
    s->model = chart ? nh_model_create(s->system, chart, error) : NULL;
    if (s->model) s->words = nh_dictionary_of(s->model);
    s->ranges = s->model ? nh_points_create(s->model, least_samples, 1, seed, error) : NULL;
    if (s->ranges) return true;
    scene_end(s);
    return false;
}

/* NULL: the stage is none for this system, or too large. */
static nh_ansatz *space_at(const scene *s, const nh_scan_request *q, size_t index, nh_stage *stage)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!nh_stage_at(s->model->arena, s->model, &s->words, index, stage)) return NULL;
    if (!stage->families || nh_ansatz_size(stage->families, stage->family) > 2 * q->options.scan_columns) return NULL;
    return nh_ansatz_create(s->model, s->ranges, stage->families, stage->family, (size_t)q->options.scan_columns,
                            &ignored);
}

bool nh_scan_list_spaces(nh_scan *x, const nh_scan_request *q, nh_error *error)
{
    scene s;
    nh_stage stage;
    size_t settings;
    x->space = nh_arena_alloc(x->arena, NH_SCAN_MOST_SPACES * sizeof *x->space);
    x->columns = nh_arena_alloc(x->arena, NH_SCAN_MOST_SPACES * sizeof *x->columns);
    nh_setting *setting = nh_scan_settings(x, q, x->arena, x->points / 2, false, &settings);
    if (!q->source->spectra) return true;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!scene_begin(&s, q, settings, setting, &ignored))
        return ignored.code != NH_INPUT || nh_fail(error, ignored.code, ignored.where, "%s", ignored.what);
    for (size_t i = 0; x->spaces < NH_SCAN_MOST_SPACES && nh_stage_at(s.model->arena, s.model, &s.words, i, &stage);
         i++) {
        nh_ansatz *a = space_at(&s, q, i, &stage);
        x->columns[i] = a ? a->columns : 0;
        x->space[i] = stage.name;
        x->spaces = i + 1;
        nh_ansatz_free(a);
    }
    scene_end(&s);
    return true;
}

static void spectrum(const scene *s, const nh_scan_request *q, nh_ansatz *a, size_t index, double *smallest,
                     size_t *vanishing)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    size_t count = samples_per_column * a->columns;
    nh_points *points =
        nh_points_cover(s->model, count < least_samples ? least_samples : count, (uint64_t)q->options.seed, &ignored);
    if (!points) return;
    nh_equations *equations = nh_equations_create(a->columns, 1);
    nh_equations_leave_out(equations);
    nh_rows *rows = nh_rows_create(s->model, a, 0, NULL);
    nh_rows_current(rows, points, NULL, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(&q->options);
    nh_nullspace *n = nh_nullspace_solve(equations, &limits, &ignored);
    if (n) {
        *vanishing = n->dimension;
        size_t at = index == SIZE_MAX ? n->dimension : index;
        *smallest = at < n->rank ? n->spectrum[at] : NAN;
    }
    nh_nullspace_free(n);
    nh_rows_free(rows);
    nh_equations_free(equations);
    nh_points_free(points);
}

void nh_scan_spectra(const nh_scan *x, const nh_scan_request *q, size_t settings, const nh_setting *setting,
                     size_t space, size_t index, double *smallest, size_t *vanishing)
{
    scene s;
    nh_stage stage;
    nh_error ignored;
    nh_error_clear(&ignored);
    for (size_t i = 0; i < x->spaces; i++) {
        smallest[i] = NAN;
        vanishing[i] = 0;
    }
    if (!x->spaces || !scene_begin(&s, q, settings, setting, &ignored)) return;
    for (size_t i = 0; i < x->spaces; i++) {
        if (!x->columns[i] || (space != SIZE_MAX && space != i)) continue;
        nh_ansatz *a = space_at(&s, q, i, &stage);
        if (a) spectrum(&s, q, a, index, &smallest[i], &vanishing[i]);
        nh_ansatz_free(a);
    }
    scene_end(&s);
}
