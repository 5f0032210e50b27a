/* library_rates: the equations of motion of the public interface, in all coordinates. */
#include <math.h>

#include "base/error.h"
#include "geometry/bordered.h"
#include "library/library_columns.h"
#include "library/library_internal.h"

struct nh_rates {
    nh_model *model;
    nh_bordered *bordered;
    nh_system *system; /* its own: it remains without the problem */
};

typedef struct {
    const nh_request *request;
    nh_error *error;
    nh_rates *rates;
    bool good;
} writing;

static bool write_equations(const nh_request *q, nh_rates *e, nh_error *error)
{
    e->system = nh_system_read(q->system_path, q->settings, q->setting, error);
    bool numbers = e->system && nh_system_needs_values(e->system, "the code", error);
    nh_chart *chart = numbers ? nh_chart_create(e->system, q->chart, (uint64_t)q->options.seed, error) : NULL;
    e->model = chart ? nh_model_bare(e->system, chart) : NULL;
    if (!e->model || !nh_model_regular(e->model, error)) return false;
    e->bordered = nh_bordered_create(e->model);
    return true;
}

static void create(void *argument)
{
    writing *w = argument;
    nh_rates *e = nh_alloc(sizeof *e);
    *e = (nh_rates){0};
    w->good = write_equations(w->request, e, w->error);
    w->rates = e;
}

nh_rates *nh_rates_create(nh_problem *p, nh_error *error)
{
    NH_OWN_ERROR(error);
    writing w = {.request = &p->request, .error = error};
    if (nh_problem_run(p, create, &w, error) && w.good) return w.rates;
    nh_rates_free(w.rates);
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

typedef struct {
    const nh_rates *rates;
    size_t count;
    const double *t, *q, *v;
    double *out;
} evaluation;

static void evaluate(void *argument)
{
    const evaluation *r = argument;
    nh_bordered *bordered = r->rates->bordered;
    nh_columns columns;
    nh_columns_open(&columns, nh_bordered_coordinates(bordered), r->count, r->t, r->q, r->v);
    for (size_t from = 0, n; (n = nh_columns_next(&columns, from)) > 0; from += n)
        nh_bordered_accelerations_batch(bordered, n, columns.in, r->count, r->out + from);
    nh_columns_close(&columns);
}

void nh_rates_at(nh_rates *e, size_t count, const double *t, const double *q, const double *v, double *out)
{
    evaluation r = {e, count, t, q, v, out};
    if (nh_library_run(evaluate, &r)) return;
    size_t values = nh_bordered_coordinates(e->bordered) * count;
    for (size_t i = 0; i < values; i++) out[i] = NAN;
}
