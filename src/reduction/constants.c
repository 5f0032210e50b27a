#include "reduction/constants.h"

#include "exact/normal.h"
#include "integrals/fixed.h"
#include "integrals/recognise.h"
#include "reduction/section.h"

typedef struct {
    const nh_action *g;
    const nh_options *options;
    nh_ex *field, *relation; /* d + 1: [e_a, e_b] and the generators, their components told apart by marks; coefficients */
    double *like;            /* d + 1: 1 and C_ab */
} work;

/* Do the fields contain parameters? */
static bool parametric(const nh_action *g)
{
    const nh_model *o = g->kinetic->model;
    for (size_t a = 0; a < g->d; a++)
        for (size_t s = 0; s < g->kinetic->m; s++)
            for (size_t i = 0; i < o->system->parameters; i++)
                if (nh_depends(o->dag, g->generator[a].component[s], o->parameter[i])) return true;
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
    nh_dag *d = w->g->kinetic->dag;
    nh_ex sum = w->field[0];
    for (size_t k = 0; k < w->g->d; k++) sum = nh_add(d, sum, nh_mul(d, constant[k], w->field[1 + k]));
    return nh_normal_is_zero(d, sum, (size_t)w->options->proof_terms) == NH_ZERO;
}

/* With symbols where there is such a relation; the numbers stay where there is none. */
static void with_symbols(const work *w, nh_ex *constant)
{
    const nh_action *g = w->g;
    nh_dag *d = g->kinetic->dag;
    nh_fixed how = nh_fixed_relation(g->kinetic->model, g->d + 1, w->field, w->like, w->options, w->relation);
    if (!how.found || how.too_large || nh_is_zero(d, w->relation[0])) return;
    for (size_t k = 0; k < g->d; k++) constant[k] = nh_simplify(d, nh_div(d, w->relation[1 + k], w->relation[0]));
}

void nh_constants_find(nh_action *g, const nh_ex *bracket, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    size_t d = g->d, m = k->m;
    bool symbols = parametric(g);
    g->constant = nh_arena_alloc(k->arena, (d * d * d + 1) * sizeof *g->constant);
    for (size_t i = 0; i < d * d * d; i++) g->constant[i] = number(k->dag, g->algebra.c[i], options);
    nh_ex *e = nh_alloc_array(2 * (d + 1) + m + 1, sizeof *e), *mark = e + 2 * (d + 1);
    work w = {g, options, e, e + d + 1, nh_alloc_array(d + 1, sizeof *w.like)};
    nh_section_marks(k->dag, symbols ? m : 0, mark);
    for (size_t a = 0; a < d && symbols; a++) e[1 + a] = nh_section_marked(k->dag, m, mark, g->generator[a].component);
    for (size_t pair = 0; pair < d * d && symbols; pair++) {
        size_t a = pair / d, b = pair % d;
        nh_ex *constant = g->constant + pair * d;
        if (a >= b) continue;
        e[0] = nh_section_marked(k->dag, m, mark, bracket + pair * m);
        w.like[0] = 1;
        for (size_t i = 0; i < d; i++) w.like[1 + i] = g->algebra.c[pair * d + i];
        if (!numbers_hold(&w, constant)) with_symbols(&w, constant);
        for (size_t i = 0; i < d; i++) g->constant[(b * d + a) * d + i] = nh_neg(k->dag, constant[i]);
    }
    nh_free(w.like);
    nh_free(e);
}
