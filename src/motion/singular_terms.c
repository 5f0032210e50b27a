#include "motion/singular_terms.h"

#include <string.h>

#include "geometry/bordered.h"

struct nh_singular_of_model {
    nh_along_values *values;
    nh_singular_watch *watch;
};

/* Does one of the expressions depend on time, coordinates or velocities?  *told: only on known states. */
static bool varies(const nh_model *model, size_t n, const nh_ex *e, const bool *known, bool *told)
{
    bool any = false;
    *told = true;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < model->width; j++) {
            if (!nh_depends(model->dag, e[i], model->chart->symbol[j])) continue;
            any = true;
            if (known && j > 0 && !(j <= model->m + model->n && known[j - 1])) *told = false;
        }
    return any;
}

static bool entries(double t, const double *z, double *entry, void *context)
{
    return nh_along_values_at(context, t, z, entry);
}

/* Velocities that a file maps to those of the coordinates have no constraints: their mass matrix alone decides. */
static size_t terms_of(const nh_model *model, bool mapped, nh_ex *e, size_t *k)
{
    size_t m = model->m;
    *k = mapped ? 0 : model->k;
    if (mapped) return memcpy(e, model->M, model->n * model->n * sizeof *e), model->n;
    nh_ex *h = e + m * (m + model->k), *g = h + m, *f = g + model->k;
    nh_bordered_expressions(model, e, h, e + m * m, g, f);
    for (size_t i = 0; i < m * (m + model->k); i++) e[i] = nh_chart_compose(model->chart, e[i]);
    return m;
}

nh_singular_of_model *nh_singular_of_model_create(const nh_model *model, bool in_chart, const bool *known,
                                                  nh_along_values *make(size_t n, const nh_ex *e, void *context),
                                                  void *context)
{
    nh_ex *e = nh_alloc_array(model->m * (model->m + model->k) + model->m + 2 * model->k + 1, sizeof *e);
    nh_singular_of_model *c = NULL;
    bool told, mapped = in_chart && model->chart->quasi && model->system->quasi;
    size_t k, m = terms_of(model, mapped, e, &k), n = m * (m + k);
    if (varies(model, n, e, known, &told) && told) {
        c = nh_alloc(sizeof *c);
        c->values = make(n, e, context);
        c->watch = nh_singular_watch_create(&(nh_singular_terms){
            .system = model->system, .m = m, .k = k, .value = entries, .context = c->values, .mapped = mapped});
    }
    nh_free(e);
    return c;
}

void nh_singular_of_model_free(nh_singular_of_model *c)
{
    if (!c) return;
    nh_singular_watch_free(c->watch);
    nh_along_values_free(c->values);
    nh_free(c);
}

nh_singular_watch *nh_singular_of_model_watch(const nh_singular_of_model *c) { return c ? c->watch : NULL; }
