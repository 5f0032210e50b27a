#include "search/volume_rate.h"

#include "exact/normal.h"
#include "exact/relation_express.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"

enum { largest_form = 2000 };

static nh_ex divergence(const nh_model *model)
{
    nh_dag *d = model->dag;
    nh_ex sum = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++)
        sum = nh_add(d, sum, nh_diff(d, model->rho[s], model->system->coordinate[s].q));
    for (size_t i = 0; i < model->n; i++) sum = nh_add(d, sum, nh_diff(d, model->a[i], model->chart->w[i]));
    return nh_simplify_short(d, sum, largest_form);
}

nh_ex nh_volume_rate_potential(const nh_model *model, const nh_dictionary *words, size_t max_terms)
{
    nh_dag *d = model->dag;
    nh_ex rate = divergence(model), Q = nh_int(d, 0);
    if (nh_kind_of(d, rate) == NH_NUMBER) return 0;
    size_t n = 0, most = model->m + words->lengths;
    nh_ex *part = nh_alloc_array(most + 1, sizeof *part), *c = nh_alloc_array(most + 1, sizeof *c),
          *e = nh_alloc_array(most + 1, sizeof *e);
    for (size_t s = 0; s < model->m; s++) part[n++] = model->system->coordinate[s].q;
    for (size_t s = 0; s < words->lengths; s++) part[n++] = nh_call(d, NH_LOG, words->length[s]);
    for (size_t j = 0; j < n; j++) e[j] = nh_model_gamma(model, part[j]);
    e[n] = rate;
    bool found = nh_relation_express(d, n + 1, e, model->system->parameters, model->parameter, max_terms, c);
    for (size_t j = 0; j < n && found; j++) Q = nh_add(d, Q, nh_mul(d, c[j], part[j]));
    nh_free(e);
    nh_free(c);
    nh_free(part);
    return found ? Q : 0;
}
