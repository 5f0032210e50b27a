#include "integrals/centre_of_mass.h"

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "integrals/force_potential.h"

/* The form K_sr dq^r of p_s, where it depends on the positions alone, and on one of them; K_ss is a constant. */
static bool form_of(const nh_model *o, size_t s, nh_ex *form)
{
    nh_dag *d = o->dag;
    nh_ex rest = o->p[s], zero = nh_int(d, 0);
    bool linear = !nh_depends(d, rest, o->system->t), constant = true;
    for (size_t i = 0; i < o->n && linear; i++) {
        form[i] = nh_diff(d, o->p[s], o->chart->w[i]);
        rest = nh_substitute(d, rest, 1, &o->chart->w[i], &zero);
        for (size_t j = 0; j < o->m && linear; j++) {
            linear = !nh_depends(d, form[i], o->chart->w[j]);
            bool moves = nh_depends(d, form[i], o->system->coordinate[j].q);
            constant = constant && !moves;
            linear = linear && !(i == s && moves);
        }
    }
    return linear && !constant && nh_is_zero(d, rest) && !nh_is_zero(d, form[s]);
}

size_t nh_centre_of_mass_find(const nh_model *o, size_t max_terms, nh_centre_of_mass *out)
{
    if (o->k || o->chart->quasi) return 0;
    size_t count = 0;
    nh_ex *form = nh_alloc_array(o->m + 1, sizeof *form);
    for (size_t s = 0; s < o->m; s++) {
        if (!form_of(o, s, form)) continue;
        nh_ex F = nh_force_potential_of(o, NULL, max_terms, form);
        if (F) out[count++] = (nh_centre_of_mass){s, form[s], F};
    }
    nh_free(form);
    return count;
}
