/* chart_rank: what --accuracy may choose from, out of what a chart measured. */
#include <math.h>

#include "study/chart_internal.h"

/* The equations of a formulation as a model sees them; false: they are not among those that motions of it can use. */
static bool velocities_of(const nh_formulation *f, const nh_model *model, const nh_model *other, nh_velocities *out)
{
    if (f->reduced || (f->model && f->model != model && f->model != other)) return false;
    *out = !f->model ? NH_ALL_COORDINATES : f->model == model ? NH_OWN_VELOCITIES : NH_OTHER_VELOCITIES;
    return true;
}

static void rank(nh_bench *c, const nh_model *model, const nh_model *other)
{
    nh_comparison *out = c->out;
    nh_ranking *r = &out->ranking[out->rankings++];
    *r = (nh_ranking){.key = nh_ranking_key(model), .begin = out->begin, .end = out->end};
    r->way = nh_arena_alloc(out->arena, (c->candidates * NH_CHART_LEVELS + 1) * sizeof *r->way);
    for (size_t i = 0; i < c->candidates * NH_CHART_LEVELS; i++) {
        const nh_contender *k = &c->candidate[i / NH_CHART_LEVELS];
        const nh_measured *m = &c->grid[i];
        nh_velocities velocities;
        if (!m->method || m->status != NH_RIGHT || !k->method || k->projected || !velocities_of(&c->formulation[k->formulation], model, other, &velocities)) continue;
        r->way[r->count++] = (nh_way){.method = k->method, .velocities = velocities, .tolerance = m->tolerance, .step = m->step,
                                      .error = fmax(m->error, out->agreement), .seconds = m->seconds / fabs(out->end - out->begin)};
    }
}

void nh_chart_rank(nh_bench *c)
{
    rank(c, c->model, c->other);
    if (c->other) rank(c, c->other, c->model);
}
