#include "count/one_side.h"

#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"

static void keep(nh_region *r, nh_ex u, bool above)
{
    for (size_t k = 0; k < r->count; k++)
        if (r->wall[k] == u) return;
    r->unseen |= r->count == NH_MOST_WALLS;
    if (r->count == NH_MOST_WALLS) return;
    r->wall[r->count] = u;
    r->kind[r->count++] = above ? NH_REGION_ABOVE : NH_REGION_BELOW;
}

/* The sign of u at the first probe of the chart: 1, -1, or 0 where u vanishes or has no value. */
static int side_of(const nh_model *model, nh_ex u, nh_region *side)
{
    nh_tape *tape = nh_model_tape(model, 1, &u);
    nh_tape_work *work = nh_tape_work_create(tape);
    double value;
    nh_tape_eval(tape, work, model->chart->probe, &value);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    int sign = (value > 0) - (value < 0);
    if (sign && side) keep(side, u, sign > 0);
    return sign;
}

nh_ex nh_one_side(const nh_model *model, nh_ex e, nh_region *side)
{
    enum { most_functions = 64, nested = 4 };
    nh_dag *d = model->dag;
    NH_LIST(call);
    nh_ex by[most_functions];
    for (size_t level = 0; level < nested && model->chart->probes; level++) {
        size_t n = nh_functions_in(d, e, &call), pieces = 0;
        for (size_t i = 0; i < n && i < most_functions; i++) {
            nh_function f = nh_function_of(d, call[i]);
            if (f != NH_ABS && f != NH_SIGN) continue;
            nh_ex u = nh_child(d, call[i], 0);
            int sign = side_of(model, u, side);
            if (!sign) continue;
            call[pieces] = call[i];
            by[pieces++] = nh_mul(d, nh_int(d, sign), f == NH_ABS ? u : nh_int(d, 1));
        }
        if (!pieces) break;
        e = nh_substitute(d, e, pieces, call, by);
    }
    return e;
}

nh_ex nh_one_side_of_roots(const nh_model *model, nh_ex e, nh_region *side)
{
    nh_dag *d = model->dag;
    NH_LIST(base);
    nh_ex outside, inside, before = e;
    e = nh_model_paired_roots(model, e);
    for (size_t k = 0; k < model->pairs && e != before && side; k++)
        keep(side, model->pair[k].product, model->pair[k].sign > 0);
    size_t n = model->chart->probes ? nh_radicands_in(d, e, &base) : 0;
    for (size_t i = 0; i < n; i++) {
        bool square = nh_square_split(d, nh_simplify_short(d, base[i], 0), &outside, &inside);
        if (!square || nh_kind_of(d, outside) == NH_NUMBER) continue;
        int sign = side_of(model, outside, side);
        nh_ex value = nh_mul(d, nh_int(d, sign), nh_mul(d, outside, nh_sqrt(d, inside)));
        if (sign) e = nh_substitute_root(d, e, base[i], value);
    }
    return e;
}

int nh_one_side_sign(const nh_model *model, nh_ex u, nh_region *side)
{
    int sign = nh_model_sign_at_probe(model, u);
    nh_ex wall = nh_model_without_constants(model, u);
    if (sign && side && !nh_model_sign_everywhere(model, u)) keep(side, wall, nh_model_sign_at_probe(model, wall) > 0);
    return sign;
}

bool nh_one_side_within(const nh_model *model, const nh_region *region)
{
    bool within = model->chart->probes > 0;
    for (size_t i = 0; i < region->count && within; i++) {
        nh_region_kind kind = region->kind[i];
        int wanted = kind == NH_REGION_ABOVE ? 1 : kind == NH_REGION_BELOW ? -1 : 0;
        within = kind != NH_REGION_PARTS && (!wanted || side_of(model, region->wall[i], NULL) == wanted);
    }
    return within;
}
