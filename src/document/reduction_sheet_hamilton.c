/* reduction_sheet_hamilton: Hamilton's form of a stage (reduction/hamilton.h). */
#include "document/reduction_internal.h"

#include "base/memory.h"
#include "document/reduction_sheet_internal.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "reduction/hamilton.h"

const nh_hamilton *nh_reduction_hamilton(const nh_reduction *r, const nh_reduction_stage *s)
{
    if (s->hamilton) return s->hamilton;
    nh_hamilton *h = nh_arena_alloc(r->arena, sizeof *h);
    if (s->kind == NH_STAGE_CHAPLYGIN && nh_hamilton_of_first(h, r->arena, s->chaplygin)) return h;
    if (s->kind == NH_STAGE_SECOND && nh_hamilton_of_second(h, r->arena, s->second)) return h;
    return NULL;
}

/* Ups_ij as a sum over the velocities of the shape and the constant momenta. */
static size_t form(nh_sheet *s, const nh_hamilton *h)
{
    size_t n = h->n, listed = 0;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            bool any = false;
            for (size_t k = 0; k < n + h->d; k++) any |= !nh_is_zero(h->dag, h->U[(k * n + i) * n + j]);
            if (!any) continue;
            nh_sheet_sum(
                s, "",
                nh_sheet_label(s, "Upsilon_{<%s>,<%s>}", nh_name_of(h->dag, h->x[i]), nh_name_of(h->dag, h->x[j])));
            for (size_t k = 0; k < n + h->d; k++)
                nh_sheet_add(s, h->U[(k * n + i) * n + j],
                             k < n ? nh_sheet_label(s, "<%s'>", nh_name_of(h->dag, h->x[k]))
                                   : nh_sheet_label(s, "<%s>", nh_name_of(h->dag, h->m[k - n])));
            listed++;
        }
    return listed;
}

nh_sheet *nh_reduction_hamilton_sheet(const nh_reduction *r, const nh_reduction_stage *stage)
{
    const nh_hamilton *h = nh_reduction_hamilton(r, stage);
    if (!h || !h->n) return NULL;
    nh_sheet *s = nh_sheet_create(r->arena, h->dag);
    s->shown = r->options.shown;
    nh_sheet_begin(s, "hamilton", "Hamilton's form", "");
    nh_sheet_formula(s, nh_sheet_label(s, "<%s>", nh_kinetic_unused_name(r->kinetic, "H")), h->H);
    bool bent = form(s, h) > 0, levels = nh_reduction_on_levels(stage);
    const char *more = stage->kind == NH_STAGE_SECOND ? "; $m_{a}$ is constant" : "";
    s->section->words = nh_sheet_label(
        s,
        bent ? "$<x'>^{i}=\\frac{\\p H}{\\p p_{i}}$, $p'_{i}=-\\frac{\\p H}{\\p x^{i}}+Upsilon_{i,j} <x'>^{j}$ "
               "with $Upsilon_{j,i}=-Upsilon_{i,j}$ (Chhabra and Emami 2014, eq. %s)%s. Entries that are not listed "
               "vanish."
             : "$<x'>^{i}=\\frac{\\p H}{\\p p_{i}}$, $p'_{i}=-\\frac{\\p H}{\\p x^{i}}$: $Upsilon$ vanishes "
               "(Chhabra and Emami 2014, eq. %s)%s.",
        stage->kind == NH_STAGE_SECOND && !levels ? "2.19" : "2.11", more);
    return s;
}

static void put(const nh_reduction *r, nh_json *to, const char *key, nh_ex e)
{
    char *text = nh_print_short(r->kinetic->dag, e, r->options.written);
    nh_json_put_text(to, key, text);
    nh_free(text);
}

void nh_reduction_hamilton_json(const nh_reduction *r, const nh_reduction_stage *stage, nh_json *root)
{
    const nh_hamilton *h = nh_reduction_hamilton(r, stage);
    if (!h) {
        nh_json_put_null(root, "hamilton");
        return;
    }
    nh_json *to = nh_json_put_object(root, "hamilton"), *momenta = nh_json_put_array(to, "momenta"),
            *constants = nh_json_put_array(to, "constants"), *list = nh_json_put_array(to, "upsilon"),
            *speed = nh_json_put_object(to, "x_rate"), *rate = nh_json_put_object(to, "p_rate");
    put(r, to, "hamiltonian", h->H);
    for (size_t i = 0; i < h->n; i++) nh_json_add_text(momenta, nh_name_of(h->dag, h->p[i]));
    for (size_t a = 0; a < h->d; a++) nh_json_add_text(constants, nh_name_of(h->dag, h->m[a]));
    for (size_t i = 0; i < h->n; i++)
        for (size_t j = i + 1; j < h->n; j++) {
            if (nh_is_zero(h->dag, h->form[i * h->n + j])) continue;
            nh_json *item = nh_json_add_object(list);
            nh_json_put_text(item, "i", nh_name_of(h->dag, h->x[i]));
            nh_json_put_text(item, "j", nh_name_of(h->dag, h->x[j]));
            put(r, item, "value", h->form[i * h->n + j]);
        }
    for (size_t i = 0; i < h->n; i++) put(r, speed, nh_name_of(h->dag, h->x[i]), h->speed[i]);
    for (size_t i = 0; i < h->n; i++) put(r, rate, nh_name_of(h->dag, h->p[i]), h->rate[i]);
}
