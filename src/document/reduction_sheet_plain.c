/* The sections that every reduction has, with or without its geometry: the brackets of the group, the equations of a
 * stage. */
#include "document/reduction.h"
#include "document/reduction_sheet.h"
#include "graph/dag.h"

static nh_sheet *sheet_of(const nh_reduction *r)
{
    nh_sheet *s = nh_sheet_create(r->arena, r->kinetic->dag);
    s->shown = r->options.shown;
    return s;
}

/* Those of the fields, minus the constants of the Lie algebra. */
static void put_brackets(nh_sheet *s, const nh_action *g)
{
    nh_dag *d = g->kinetic->dag;
    for (size_t a = 0; a < g->d; a++)
        for (size_t b = a + 1; b < g->d; b++) {
            bool any = false;
            if (g->outside[a * g->d + b])
                nh_sheet_words(
                    s, nh_sheet_label(
                           s, "$[e_{%zu},e_{%zu}]$ is none of their combinations: a symmetry without a closed form.",
                           a + 1, b + 1));
            for (size_t k = 0; k < g->d; k++) {
                nh_ex c = g->constant[(a * g->d + b) * g->d + k];
                if (nh_is_zero(d, c)) continue;
                if (!any) nh_sheet_sum(s, "", nh_sheet_label(s, "[e_{%zu},e_{%zu}]", a + 1, b + 1));
                any = true;
                nh_sheet_add(s, nh_neg(d, c), nh_sheet_label(s, "e_{%zu}", k + 1));
            }
        }
}

nh_sheet *nh_reduction_brackets_sheet(const nh_reduction *r, const nh_action *g)
{
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "brackets", "", "");
    put_brackets(s, g);
    s->section->words =
        s->section->lines
            ? "Brackets of the fields, $[e_{a},e_{b}]=-C^{c}_{a,b} e_{c}$ with the structure constants $C$ of the Lie "
              "algebra of the group. Those that are not listed vanish."
            : "All brackets vanish.";
    return s;
}

nh_sheet *nh_reduction_equations_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const char **label;
    nh_ex *value;
    size_t n = nh_reduction_shown(r, stage, &label, &value);
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "reduced_equations", "", "");
    for (size_t i = 0; i < n; i++) nh_sheet_formula(s, nh_sheet_label(s, "<%s>", label[i]), value[i]);
    nh_sheet_words(s, nh_sheet_label(s, "(%s)", nh_reduction_letters(r, stage)));
    return s;
}

nh_sheet *nh_reduction_remarks_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const nh_chaplygin_measure *m = &stage->measure;
    const nh_linear_momenta *l = &stage->linear;
    nh_sheet *s = sheet_of(r);
    nh_sheet_begin(s, "remarks", "", "");
    if (m->tested && m->measure && m->closed) nh_sheet_formula(s, "<density>", m->density);
    for (size_t a = 0; a < l->count * l->count; a++) {
        const char *label = nh_sheet_label(s, "N_{%zu,%zu}", a / l->count + 1, a % l->count + 1);
        if (!nh_is_zero(s->dag, l->N[a])) nh_sheet_formula(s, label, l->N[a]);
    }
    return s->section->lines ? s : NULL;
}
