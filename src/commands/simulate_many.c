/* simulate_many: ensembles of motions. */
#include "commands/simulate_internal.h"

#include "base/parallel.h"
#include "base/progress.h"

const char *nh_simulate_words(nh_simulation *s, const nh_closed_subsystem *scene,
                              void (*write)(const nh_closed_subsystem *scene, nh_text *out))
{
    nh_text words;
    nh_text_init(&words);
    write(scene, &words);
    const char *kept = nh_arena_strdup(s->arena, nh_text_string(&words));
    nh_text_clear(&words);
    return kept;
}

/* The states of all members, row by row. */
static bool initial_states(nh_simulation *s, const nh_request *q, const nh_trajectory_request *motion, double *initial,
                           nh_error *error)
{
    static const double usual = 0.1;
    double spread = q->spread > 0 ? q->spread : usual;
    size_t size = s->model->m + s->model->n;
    double *z0 = nh_arena_alloc(s->arena, size * sizeof *z0);
    nh_dynamics *d = nh_dynamics_create(s->model);
    bool good = true;
    for (size_t i = 0; q->rows && i < q->ensemble && good; i++)
        good = nh_simulate_row_start(s, &q->rows->row[i], d, motion->initial->t, motion->project, initial + i * size,
                                     error);
    if (!q->rows) good = nh_dynamics_start(d, motion->initial, motion->project, z0, error);
    if (!q->rows && good) nh_ensemble_states(size, z0, q->ensemble, spread, (uint64_t)q->options.seed, initial);
    nh_dynamics_free(d);
    return good;
}

/* Memory for doubles, and for each again as text of up to 24 characters where the table is written. */
static bool fits(const nh_request *q, const nh_trajectory_request *motion, nh_error *error)
{
    enum { bytes = sizeof(double) + 24 };
    double size = (double)bytes * (double)q->ensemble * (double)motion->count * (double)(motion->n + 2),
           most = nh_limit_memory();
    if (size <= most) return true;
    nh_fail(error, NH_LIMIT, "",
            "%zu motions at %zu times with %zu columns need %.3g GB of memory, of which there are %.3g", q->ensemble,
            motion->count, motion->n, size / (1024 * NH_MEGABYTE), most / (1024 * NH_MEGABYTE));
    return nh_error_hint(error, "fewer motions (--ensemble), times (--step) or columns (--watch) need less%s",
                         size < nh_memory_of_machine() ? "; or raise --max-memory" : "");
}

bool nh_simulate_many(nh_simulation *s, const nh_request *q, const nh_trajectory_request *motion, nh_error *error)
{
    size_t size = s->model->m + s->model->n, threads = nh_threads(q->options.threads);
    if (!fits(q, motion, error)) return false;
    double *initial = nh_alloc_array(q->ensemble, size * sizeof *initial);
    if (initial_states(s, q, motion, initial, error)) {
        if (s->checked)
            s->ensemble = nh_ensemble_accurate(motion, q->ensemble, initial, threads, q->accuracy, &s->ways.ways,
                                               &s->accuracy_of_all, error);
        else s->ensemble = nh_ensemble_create(motion, q->ensemble, initial, threads, error);
    }
    nh_free(initial);
    if (!s->ensemble) return false;
    if (s->checked)
        s->tolerance = s->accuracy_of_all.tolerance, s->held = s->accuracy_of_all.held, s->why = s->accuracy_of_all.why;
    s->method = "Prince-Dormand 8, in batches";
    s->formulation = NH_ON_SUBMANIFOLD;
    const nh_ensemble_accuracy *a = s->checked && s->accuracy_of_all.all_alone ? &s->accuracy_of_all : NULL;
    if (a) s->method = nh_arena_printf(s->arena, "%s, each alone", a->way.method->name);
    if (a && a->way.velocities == NH_ALL_COORDINATES)
        s->formulation = "all coordinates, accelerations from the bordered system";
    if (!a || motion->smallest) s->scene = nh_simulate_words(s, s->ensemble->scene, nh_closed_subsystem_words);
    return true;
}
