/* What every reduction has, with or without its geometry: the group, the equations of a stage, the conserved momenta. */
#include "document/facts.h"
#include "document/reduction.h"
#include "document/reduction_sheet.h"

static nh_sheet *sheet_of(const nh_reduction *r)
{
    nh_sheet *s = nh_sheet_create(r->arena, r->kinetic->dag);
    s->shown = r->options.shown;
    return s;
}

/* label = X^r d/dq^r */
static void put_field(nh_sheet *s, const nh_kinetic *k, const char *label, const nh_ex *component)
{
    nh_sheet_sum(s, "", label);
    for (size_t r = 0; r < k->m; r++) nh_sheet_add(s, component[r], nh_sheet_label(s, "\\frac{\\p}{\\p<%s>}", k->name[r]));
}

static void put_brackets(nh_sheet *s, const nh_action *g)
{
    nh_dag *d = g->kinetic->dag;
    for (size_t a = 0; a < g->d; a++)
        for (size_t b = a + 1; b < g->d; b++) {
            bool any = false;
            for (size_t k = 0; k < g->d; k++) {
                nh_ex c = g->constant[(a * g->d + b) * g->d + k];
                if (nh_is_zero(d, c)) continue;
                if (!any) nh_sheet_sum(s, "", nh_sheet_label(s, "[e_{%zu},e_{%zu}]", a + 1, b + 1));
                any = true;
                nh_sheet_add(s, c, nh_sheet_label(s, "e_{%zu}", k + 1));
            }
        }
}

nh_sheet *nh_reduction_group_sheet(const nh_reduction *r, const nh_group *g)
{
    nh_sheet *s = sheet_of(r);
    const char *name = nh_sheet_label(s, "%s: %s, dimension %zu%s", g->given ? "Group given" : g->local ? "Symmetry group, locally" : "Symmetry group", g->name,
                                      g->action.d + g->missing, nh_reduction_globally(r, g));
    nh_sheet_begin(s, "group", name, "Generators, and brackets of the Lie algebra; those that are not listed vanish.");
    for (size_t a = 0; a < g->action.d; a++) {
        const nh_generator *e = &g->action.generator[a];
        put_field(s, r->kinetic, nh_sheet_label(s, "e_{%zu}", a + 1), e->component);
        nh_proof proof = nh_generator_proof(r->kinetic, e);
        const char *holds = proof.all_parameters ? "" : proof.proved ? nh_facts_holds(r->kinetic->model, &proof, false) : " to rounding";
        if (e->local || *holds) nh_sheet_words(s, nh_sheet_label(s, "$e_{%zu}$ is a symmetry%s%s.", a + 1, holds, e->local ? ", locally: many-valued on an angle" : ""));
    }
    put_brackets(s, &g->action);
    return s;
}

nh_sheet *nh_reduction_equations_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const char **label;
    nh_ex *value;
    size_t n = nh_reduction_shown(r, stage, &label, &value);
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "divided", "Divided out", "");
    for (size_t a = 0; a < stage->action->d; a++) put_field(s, stage->action->kinetic, nh_sheet_label(s, "e_{%zu}", a + 1), stage->action->generator[a].component);
    nh_sheet_begin(s, "reduced_equations", "Reduced equations", nh_sheet_label(s, "%s.", nh_reduction_letters(r, stage)));
    for (size_t i = 0; i < n; i++) nh_sheet_formula(s, nh_sheet_label(s, "<%s>", label[i]), value[i]);
    return s;
}

nh_sheet *nh_reduction_momenta_sheet(const nh_reduction *r)
{
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "momenta", "Conserved momenta of the group", r->momenta.count ? "" : "None is conserved, among the sections of the search.");
    for (size_t i = 0; i < r->momenta.count; i++) {
        const nh_momentum *p = &r->momenta.momentum[i];
        const char *holds = p->proof.all_parameters ? "" : nh_facts_holds(r->kinetic->model, &p->proof, false);
        nh_sheet_words(s, nh_sheet_label(s, "A %s $xi$ (%s%s%s):", nh_reduction_momentum_kind(p), p->proof.proved ? "proved" : "to rounding", holds, p->local ? "; local: many-valued on an angle" : ""));
        put_field(s, r->kinetic, "xi", p->field);
        nh_sheet_formula(s, nh_sheet_label(s, "<%s>", nh_reduction_momentum_name(r, p)), p->value);
    }
    return s;
}
