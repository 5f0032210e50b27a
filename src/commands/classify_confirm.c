/* Finds by other methods what holds at a special value of a question that is not about currents: the group in closed
 * form, the growth of brackets, the measure, and the factor of a Chaplygin reduction with a density in closed form. */
#include <math.h>
#include <string.h>

#include "commands/classify_internal.h"
#include "commands/reduce.h"
#include "geometry/distribution.h"
#include "graph/print.h"
#include "nhsym.h"

/* ---- groups ---- */

static void symmetries(nh_classified *x, const nh_kinetic *k, const nh_options *options, size_t bound,
                       nh_classified_finding *out)
{
    nh_error none = {0};
    nh_group *g = nh_group_find(k, options, &none);
    if (!g) {
        out->why = nh_arena_strdup(x->arena, none.what);
        return;
    }
    size_t proved = 0;
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text, "group %s, dimension %zu:", g->name, g->action.d);
    for (size_t a = 0; a < g->action.d; a++) {
        proved += nh_generator_proof(k, &g->action.generator[a]).proved;
        nh_text_add(&text, a ? "; " : " ");
        nh_generator_text(k, &g->action.generator[a], &text);
    }
    out->shown = nh_arena_strdup(x->arena, nh_text_string(&text));
    out->complete = proved == bound;
    nh_text_clear(&text);
    nh_group_free(g);
}

/* ---- brackets ---- */

static void growth(nh_classified *x, const nh_model *model, nh_classified_finding *out)
{
    nh_distribution d = nh_distribution_of(model);
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, "growth vector (");
    for (size_t i = 0; i < d.growth.length; i++) nh_text_addf(&text, "%s%zu", i ? ", " : "", d.growth.rank[i]);
    nh_text_addf(&text, ") of %zu dimensions, %s", d.growth.dimension, nh_constraint_integrability(model, &d));
    out->shown = nh_arena_strdup(x->arena, nh_text_string(&text));
    out->complete = d.growth.proved && !d.growth.cut ? NH_LINEAR_MOST_LEVELS : 0;
    nh_text_clear(&text);
}

/* ---- a Chaplygin reduction ---- */

static void density(nh_classified *x, const nh_reduction_stage *s, nh_classified_finding *out)
{
    const nh_chaplygin_measure *m = &s->measure;
    nh_text text;
    nh_text_init(&text);
    nh_text_addf(&text, "reduced by %s, the equations ", s->group);
    if (nh_chaplygin_flat(s->chaplygin->slice, s->chaplygin->U)) {
        nh_text_add(&text, "have no gyroscopic force: they are Hamiltonian");
        out->complete = 1;
    } else {
        nh_text_add(&text, x->of == NH_OF_MEASURE ? "have the invariant measure exp(sigma) dx dp"
                                                  : "become Hamiltonian by the factor exp(sigma/(n - 1))");
        char *e =
            m->closed ? nh_print_short(s->chaplygin->dag, m->density, x->almost_all->question->options.shown) : NULL;
        if (e) nh_text_addf(&text, ", exp(sigma) = %s", e);
        nh_free(e);
        out->complete = m->closed && m->proof.proved;
    }
    out->shown = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
}

static void reduced(nh_classified *x, const nh_request *request, nh_classified_finding *out)
{
    nh_error none = {0};
    nh_reduction *r = nh_reduction_create(request, &none);
    const nh_reduction_stage *s = r && r->stages && r->stage[0].kind == NH_STAGE_CHAPLYGIN ? &r->stage[0] : NULL;
    if (!r) out->why = nh_arena_strdup(x->arena, none.what);
    else if (!s) out->why = "it is no Chaplygin system there, whose density could be constructed";
    else if (!s->measure.tested || !(x->of == NH_OF_MEASURE ? s->measure.measure : s->measure.factor))
        out->why = "the reduction there finds none";
    else density(x, s, out);
    nh_reduction_free(r);
}

/* ---- all of them ---- */

void nh_classified_confirm(nh_classified *x, const nh_classify_request *q, const nh_setting *at, size_t bound,
                           nh_classified_finding *out)
{
    nh_error none = {0};
    size_t count;
    nh_setting *setting = nh_classified_settings(x, 1, at, &count);
    nh_request request = {.system_path = q->system_path, .settings = count, .setting = setting, .options = q->options};
    if (x->of == NH_OF_MEASURE || x->of == NH_OF_HAMILTONIZATION) reduced(x, &request, out);
    else {
        nh_system *system = nh_system_read(q->system_path, count, setting, &none);
        nh_chart *chart = system ? nh_chart_create(system, NH_CHART_AUTO, (uint64_t)q->options.seed, &none) : NULL;
        nh_model *model = chart ? nh_model_create(system, chart, &none) : NULL;
        nh_kinetic *k =
            model && x->of == NH_OF_SYMMETRIES ? nh_kinetic_create(model, (uint64_t)q->options.seed, &none) : NULL;
        if (k) symmetries(x, k, &q->options, bound, out);
        else if (model && x->of == NH_OF_INTEGRABILITY) growth(x, model, out);
        else out->why = nh_arena_strdup(x->arena, none.what);
        nh_kinetic_free(k);
        nh_model_free(model);
        nh_system_free(system);
    }
    nh_free(setting);
}
