#include "motion/singular_terms.h"

#include <string.h>

#include "geometry/bordered.h"

struct nh_singular_of_model {
    nh_along_values *values;
    nh_singular_watch *watch;
};

/* Does one of the expressions depend on time, coordinates or velocities?  *told: only on known states. */
static bool varies(const nh_model *o, size_t n, const nh_ex *e, const bool *known, bool *told)
{
    bool any = false;
    *told = true;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < o->width; j++) {
            if (!nh_depends(o->dag, e[i], o->chart->symbol[j])) continue;
            any = true;
            if (known && j > 0 && !(j <= o->m + o->n && known[j - 1])) *told = false;
        }
    return any;
}

static bool entries(double t, const double *z, double *entry, void *context)
{
    return nh_along_values_at(context, t, z, entry);
}

/* Velocities that a file maps to those of the coordinates have no constraints: their mass matrix alone decides. */
static size_t terms_of(const nh_model *o, bool mapped, nh_ex *e, size_t *k)
{
    size_t m = o->m;
    *k = mapped ? 0 : o->k;
    if (mapped) return memcpy(e, o->M, o->n * o->n * sizeof *e), o->n;
    nh_ex *h = e + m * (m + o->k), *g = h + m, *f = g + o->k;
    nh_bordered_expressions(o, e, h, e + m * m, g, f);
    for (size_t i = 0; i < m * (m + o->k); i++) e[i] = nh_chart_compose(o->chart, e[i]);
    return m;
}

nh_singular_of_model *nh_singular_of_model_create(const nh_model *o, bool in_chart, const bool *known,
                                                  nh_along_values *make(size_t n, const nh_ex *e, void *context),
                                                  void *context)
{
    nh_ex *e = nh_alloc_array(o->m * (o->m + o->k) + o->m + 2 * o->k + 1, sizeof *e);
    nh_singular_of_model *c = NULL;
    bool told, mapped = in_chart && o->chart->quasi && o->system->quasi;
    size_t k, m = terms_of(o, mapped, e, &k), n = m * (m + k);
    if (varies(o, n, e, known, &told) && told) {
        c = nh_alloc(sizeof *c);
        c->values = make(n, e, context);
        c->watch = nh_singular_watch_create(&(nh_singular_terms){
            .system = o->system, .m = m, .k = k, .value = entries, .context = c->values, .mapped = mapped});
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
