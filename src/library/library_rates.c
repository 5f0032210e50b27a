/* library_rates: the equations of motion of the public interface, in all coordinates. */
#include "base/error.h"
#include "geometry/bordered.h"
#include "library/library_columns.h"
#include "library/library_internal.h"

struct nh_rates {
    nh_model    *model;
    nh_bordered *bordered;
    nh_system   *system; /* its own: it remains without the problem */
};

static bool write_equations(const nh_problem *p, nh_rates *e, nh_error *error)
{
    const nh_request *q = &p->request;
    e->system = nh_system_read(q->system_path, q->settings, q->setting, error);
    nh_chart *chart =
        e->system ? nh_chart_create(e->system, q->velocities, (uint64_t)q->options.seed, error) : NULL;
    e->model = chart ? nh_model_bare(e->system, chart) : NULL;
    if (!e->model || !nh_model_regular(e->model, error)) return false;
    e->bordered = nh_bordered_create(e->model);
    return true;
}

nh_rates *nh_rates_create(nh_problem *p, nh_error *error)
{
    nh_rates *e = nh_alloc(sizeof *e);
    *e = (nh_rates){0};
    nh_error_clear(error);
    nh_problem_enter(p);
    bool good = write_equations(p, e, error);
    nh_problem_leave(p);
    if (good) return e;
    nh_rates_free(e);
    return NULL;
}

void nh_rates_free(nh_rates *e)
{
    if (!e) return;
    nh_bordered_free(e->bordered);
    nh_model_free(e->model);
    nh_system_free(e->system);
    nh_free(e);
}

void nh_rates_at(nh_rates *e, size_t count, const double *t, const double *q, const double *v, double *out)
{
    nh_columns columns;
    nh_columns_open(&columns, nh_bordered_coordinates(e->bordered), count, t, q, v);
    for (size_t from = 0, n; (n = nh_columns_next(&columns, from)) > 0; from += n)
        nh_bordered_accelerations_batch(e->bordered, n, columns.in, count, out + from);
    nh_columns_close(&columns);
}
