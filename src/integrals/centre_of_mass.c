#include "integrals/affine_field.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "integrals/force_potential.h"

/* The form K_sr dq^r of p_s, where it depends on the positions alone, and on one of them; K_ss is a constant. */
static bool form_of(const nh_model *model, size_t s, nh_ex *form)
{
    nh_dag *d = model->dag;
    nh_ex rest = model->p[s], zero = nh_int(d, 0);
    bool linear = !nh_depends(d, rest, model->system->t), constant = true;
    for (size_t i = 0; i < model->n && linear; i++) {
        form[i] = nh_diff(d, model->p[s], model->chart->w[i]);
        rest = nh_substitute(d, rest, 1, &model->chart->w[i], &zero);
        for (size_t j = 0; j < model->m && linear; j++) {
            linear = !nh_depends(d, form[i], model->chart->w[j]);
            bool moves = nh_depends(d, form[i], model->system->coordinate[j].q);
            constant = constant && !moves;
            linear = linear && !(i == s && moves);
        }
    }
    return linear && !constant && nh_is_zero(d, rest) && !nh_is_zero(d, form[s]);
}

size_t nh_centre_of_mass_find(const nh_model *model, size_t max_terms, nh_centre_of_mass *out)
{
    if (model->k || model->chart->quasi) return 0;
    size_t count = 0;
    nh_ex *form = nh_alloc_array(model->m + 1, sizeof *form);
    for (size_t s = 0; s < model->m; s++) {
        if (!form_of(model, s, form)) continue;
        nh_ex F = nh_force_potential_of(model, NULL, max_terms, form);
        if (F) out[count++] = (nh_centre_of_mass){s, form[s], F};
    }
    nh_free(form);
    return count;
}
