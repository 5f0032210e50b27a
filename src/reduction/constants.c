#include "reduction/constants.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "integrals/fixed.h"
#include "integrals/recognise.h"
#include "reduction/section.h"

typedef struct {
    const nh_kinetic *kinetic;
    size_t d;
    const nh_options *options;
    /* d + 1: [e_a, e_b] and the generators, their components told apart by marks; coefficients */
    nh_ex *field, *relation;
    double *like; /* d + 1: 1 and C_ab */
} work;

/* Do the fields contain parameters? */
static bool parametric(const nh_kinetic *k, size_t d, const nh_generator *generator)
{
    const nh_model *model = k->model;
    for (size_t a = 0; a < d; a++)
        for (size_t s = 0; s < k->m; s++)
            for (size_t i = 0; i < model->system->parameters; i++)
                if (nh_depends(model->dag, generator[a].component[s], model->parameter[i])) return true;
    return false;
}

static nh_ex number(nh_dag *d, double c, const nh_options *options)
{
    nh_num x;
    return nh_recognise_ratio(c, 1000, options->same, &x) ? nh_number(d, x) : nh_real(d, c);
}

/* [e_a, e_b] + C_ab^k e_k with numbers; is it zero for all parameters? */
static bool numbers_hold(const work *w, const nh_ex *constant)
{
    nh_dag *d = w->kinetic->dag;
    nh_ex sum = w->field[0];
    for (size_t k = 0; k < w->d; k++) sum = nh_add(d, sum, nh_mul(d, constant[k], w->field[1 + k]));
    return nh_normal_is_zero(d, sum, (size_t)w->options->proof_terms) == NH_ZERO;
}

/* With parameters as symbols where there is such a relation; otherwise the numbers stay. */
static void with_symbols(const work *w, nh_ex *constant)
{
    nh_dag *d = w->kinetic->dag;
    nh_fixed how = nh_fixed_relation(w->kinetic->model, w->d + 1, w->field, w->like, w->options, w->relation);
    if (!how.found || how.too_large || nh_is_zero(d, w->relation[0])) return;
    for (size_t k = 0; k < w->d; k++) constant[k] = nh_simplify(d, nh_div(d, w->relation[1 + k], w->relation[0]));
}

void nh_constants_find(const nh_kinetic *k, size_t d, const nh_generator *generator, const double *c,
                       const nh_ex *bracket, const nh_options *options, nh_ex *constant)
{
    size_t m = k->m;
    bool symbols = parametric(k, d, generator);
    for (size_t i = 0; i < d * d * d; i++) constant[i] = number(k->dag, c[i], options);
    nh_ex *e = nh_alloc_array(2 * (d + 1) + m + 1, sizeof *e), *mark = e + 2 * (d + 1);
    work w = {k, d, options, e, e + d + 1, nh_alloc_array(d + 1, sizeof *w.like)};
    nh_section_marks(k->dag, symbols ? m : 0, mark);
    for (size_t a = 0; a < d && symbols; a++) e[1 + a] = nh_section_marked(k->dag, m, mark, generator[a].component);
    for (size_t pair = 0; pair < d * d && symbols; pair++) {
        size_t a = pair / d, b = pair % d;
        nh_ex *row = constant + pair * d;
        if (a >= b) continue;
        e[0] = nh_section_marked(k->dag, m, mark, bracket + pair * m);
        w.like[0] = 1;
        for (size_t i = 0; i < d; i++) w.like[1 + i] = c[pair * d + i];
        if (!numbers_hold(&w, row)) with_symbols(&w, row);
        for (size_t i = 0; i < d; i++) constant[(b * d + a) * d + i] = nh_neg(k->dag, row[i]);
    }
    nh_free(w.like);
    nh_free(e);
}
