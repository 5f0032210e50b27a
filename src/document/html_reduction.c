/* A symmetry group and the reductions by it, as a page. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "graph/print.h"
#include "document/typeset.h"
#include "reduction/section.h"
#include "document/facts.h"
#include "document/html_internal.h"
#include "document/reduction.h"
#include "document/reduction_sheet.h"

/* "SE(2) x SO(2)^3" with a cross and a raised number. */
static void name_of_group(nh_html_writer *w, const char *name)
{
    for (; *name; name++) {
        size_t digits = *name == '^' ? strspn(name + 1, "0123456789") : 0;
        if (digits) nh_text_addf(w->out, "<sup>%.*s</sup>", (int)digits, name + 1);
        if (digits) name += digits;
        else if (!strncmp(name, " x ", 3)) nh_html_add(w, " \u00d7 "), name += 2;
        else nh_html_text(w, (const char[]){*name, 0});
    }
}

/* ---- fields ---- */

/* c d/dx as one line-breakable term of a sum. */
static void term(nh_html_writer *w, const char *coordinate, nh_ex c, bool first)
{
    char *text = nh_print_string(w->dag, c);
    bool sum = nh_kind_of(w->dag, c) == NH_SUM, minus = !sum && text[0] == '-';
    const char *rest = text + minus;
    if (minus || sum || !first) nh_text_addf(w->out, "<math><mrow>%s%s</mrow></math>", minus ? "<mo>\u2212</mo>" : first ? "" : "<mo>+</mo>", sum ? "<mo>(</mo>" : "");
    if (strcmp(rest, "1")) nh_html_source(w, rest);
    nh_text_addf(w->out, "<math><mrow>%s<mfrac><mo>\u2202</mo><mrow><mo>\u2202</mo>", sum ? "<mo>)</mo>" : "");
    nh_typeset(coordinate, NH_MATHML, w->out);
    nh_html_add(w, "</mrow></mfrac></mrow></math> ");
    nh_free(text);
}

static void field(nh_html_writer *w, const nh_kinetic *k, const nh_ex *component)
{
    bool first = true;
    for (size_t s = 0; s < k->m; s++) {
        if (nh_is_zero(w->dag, component[s])) continue;
        term(w, k->name[s], component[s], first);
        first = false;
    }
}

static const char *condition(const nh_condition *c) { return !c->holds ? "no" : c->all_parameters ? "proved" : c->proved ? "proved here" : "to rounding"; }

/* For which parameters, where not for all. */
static void limit(nh_html_writer *w, const nh_model *o, const nh_proof *p)
{
    if (!p->all_parameters) nh_html_text(w, p->proved ? nh_facts_holds(o, p, false) : " (to rounding)");
}

static void generators(nh_html_writer *w, const nh_action *g)
{
    nh_html_table(w, "Generators", "|field|kinetic energy|potential|constraints");
    for (size_t a = 0; a < g->d; a++) {
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_text_addf(w->out, "%zu</th><td>", a + 1); /* a name, for --group */
        field(w, g->kinetic, g->generator[a].component);
        if (g->generator[a].local) nh_html_add(w, "(local: many-valued on an angle)");
        nh_proof proof = nh_generator_proof(g->kinetic, &g->generator[a]);
        limit(w, g->kinetic->model, &proof);
        nh_text_addf(w->out, "</td><td>%s</td><td>%s</td><td>%s</td></tr>\n", condition(&g->generator[a].metric), condition(&g->generator[a].potential), condition(&g->generator[a].constraints));
    }
    nh_html_table_end(w);
}

/* ---- the algebra ---- */

static void basis(nh_html_writer *w, size_t a) { nh_text_addf(w->out, "<msub><mi>e</mi><mn>%zu</mn></msub>", a + 1); }

static void coefficient(nh_html_writer *w, nh_ex c)
{
    bool sum = nh_kind_of(w->dag, c) == NH_SUM;
    if (nh_is_number(w->dag, c, 1)) return;
    char *text = nh_print_string(w->dag, c);
    nh_text_add(w->out, sum ? "<mo>(</mo>" : "");
    nh_typeset(text, NH_MATHML, w->out);
    nh_text_add(w->out, sum ? "<mo>)</mo>" : "");
    nh_free(text);
}

static void bracket(nh_html_writer *w, const nh_action *g, size_t a, size_t b)
{
    nh_dag *d = g->kinetic->dag;
    bool first = true;
    for (size_t k = 0; k < g->d; k++) {
        nh_ex c = g->constant[(a * g->d + b) * g->d + k];
        if (nh_is_zero(d, c)) continue;
        bool negative = nh_section_negative(d, c);
        if (first) {
            nh_text_addf(w->out, "<div class=\"formula\"><math><mo>[</mo>");
            basis(w, a);
            nh_html_add(w, "<mo>,</mo>");
            basis(w, b);
            nh_html_add(w, "<mo>]</mo><mo>=</mo>");
        }
        nh_html_add(w, negative ? "<mo>\u2212</mo>" : first ? "" : "<mo>+</mo>");
        coefficient(w, negative ? nh_neg(d, c) : c);
        basis(w, k);
        first = false;
    }
    if (!first) nh_html_add(w, "</math></div>\n");
}

static void algebra(nh_html_writer *w, const nh_group *g)
{
    const nh_action *c = &g->action;
    bool abelian = true;
    for (size_t i = 0; i < c->d * c->d * c->d; i++) abelian &= nh_is_zero(c->kinetic->dag, c->constant[i]);
    if (abelian) nh_html_add(w, c->d > 1 ? "<p>All brackets vanish: the group is abelian.</p>\n" : "");
    else nh_html_add(w, "<p>Brackets of the Lie algebra</p>\n");
    for (size_t a = 0; a < c->d; a++)
        for (size_t b = a + 1; b < c->d; b++) bracket(w, c, a, b);
    nh_html_add(w, "<p>Centre of dimension ");
    nh_html_count(w, g->report.centre);
    nh_html_add(w, ", radical ");
    nh_html_count(w, g->report.radical);
    nh_html_add(w, ", derived series ");
    for (size_t i = 0; i < g->report.derived_length; i++) {
        nh_html_add(w, i ? ", " : "");
        nh_html_count(w, g->report.derived[i]);
    }
    nh_html_add(w, g->action.free ? ". It acts freely, with orbits of dimension " : ". It does not act freely; orbits of dimension ");
    nh_html_count(w, g->action.orbit);
    nh_html_add(w, ".</p>\n");
}

static void constraints(nh_html_writer *w, const nh_reduction *r, const nh_action *g)
{
    if (!r->kinetic->affine || !r->kinetic->f) return;
    nh_html_add(w, g->dimension_assumption ? "<p>The directions of the group and the allowed directions together span the tangent space" : "<p>The directions of the group and the allowed directions together do not span the tangent space");
    nh_html_add(w, "; they have ");
    nh_html_count(w, g->intersection);
    nh_html_add(w, g->chaplygin ? " in common: a Chaplygin system.</p>\n" : " in common.</p>\n");
}

static void group(nh_html_writer *w, const nh_reduction *r, const nh_group *g, const char *title)
{
    nh_text_addf(w->out, "<h3>%s%s: ", title, g->local && !g->given ? ", locally" : "");
    name_of_group(w, g->name);
    name_of_group(w, nh_reduction_globally(r, g));
    nh_html_add(w, "</h3>\n");
    if (g->jets) {
        nh_html_add(w, "<p>Local symmetries of kinetic energy, potential and constraints, counted without an ansatz: ");
        nh_html_count(w, g->jets->dimension);
        nh_html_add(w, "; of the kinetic energy alone: ");
        nh_html_count(w, g->jets->of_metric);
        nh_html_add(w, ".");
        if (r->weaker && g == r->all) {
            nh_html_add(w, " Further symmetries that change the Lagrangian by a total derivative: ");
            nh_html_count(w, r->weaker);
            nh_html_add(w, ".");
        }
        if (g->missing) nh_html_add(w, " Symmetries without a closed form: ");
        if (g->missing) nh_html_count(w, g->missing);
        nh_html_add(w, "</p>\n");
    }
    if (!g->action.d) return;
    generators(w, &g->action);
    algebra(w, g);
    constraints(w, r, &g->action);
}

/* ---- stages ---- */

static void measure(nh_html_writer *w, const nh_reduction_stage *s)
{
    const nh_chaplygin_measure *m = &s->measure;
    if (!m->tested) return;
    nh_html_add(w, "<dt>Measure</dt><dd>");
    if (m->measure) nh_html_add(w, m->size == 0 ? "the Liouville measure is invariant" : m->local ? "an invariant measure exists, but only locally: its density is many-valued on an angle" : "an invariant measure exists");
    else {
        nh_html_add(w, "no measure with a density on the shape space is invariant (|d\u0398| = ");
        nh_html_number(w, m->curl, 2);
        nh_html_add(w, ")");
    }
    if (s->kind != NH_STAGE_SECOND || s->shown->n <= 2) nh_html_add(w, m->factor ? m->local ? "; a conformal factor makes it Hamiltonian, only locally" : "; a conformal factor makes it Hamiltonian" : "; no conformal factor makes it Hamiltonian");
    if (m->measure && m->closed) {
        nh_html_formula(w, "density", m->density);
        limit(w, s->action->kinetic->model, &m->proof);
    }
    nh_html_add(w, "</dd>\n");
}

static void second(nh_html_writer *w, const nh_reduction_stage *s)
{
    const nh_second *t = s->second;
    if (s->kind != NH_STAGE_SECOND) return;
    nh_html_add(w, "<dt>Condition (ii)</dt><dd>");
    if (nh_reduction_on_levels(s)) nh_html_add(w, "holds without constraints: G = {e} and \u03a5 = 0");
    else {
        nh_html_add(w, "of a second stage, that no force acts along its fields: weak form ");
        nh_html_number(w, t->weak, 1);
        nh_html_add(w, ", strong form ");
        nh_html_number(w, t->strong, 1);
    }
    nh_html_add(w, "</dd>\n<dt>Momentum</dt><dd>");
    if (t->magnetic) nh_html_add(w, "constant, including the part of the Lagrangian that is linear in the velocities");
    else if (t->abelian) nh_html_add(w, "constant");
    else {
        nh_html_add(w, "moves on a coadjoint orbit of dimension ");
        nh_html_count(w, t->orbit);
        nh_html_add(w, ", isotropy of dimension ");
        nh_html_count(w, t->d - t->orbit);
    }
    if (s->momentum_drift >= 0) nh_html_add(w, "; it drifts by ");
    if (s->momentum_drift >= 0) nh_html_number(w, s->momentum_drift, 1);
    nh_html_add(w, "</dd>\n");
}

static void checks(nh_html_writer *w, const nh_reduction *r, const nh_reduction_stage *s)
{
    double full = r->full.seconds; /* where a method was chosen */
    const char *why = nh_reduction_no_energy(r, s);
    nh_html_add(w, "<dl><dt>Check</dt><dd>");
    if (s->compared) {
        nh_html_add(w, "after reconstruction: ");
        nh_html_number(w, s->agreement, 1);
        nh_html_add(w, s->against_full ? " from the full motion up to t = " : " from the first stage up to t = ");
        nh_html_number(w, s->reached, 4);
        if (s->unsure > 0) {
            nh_html_add(w, ", known to ");
            nh_html_number(w, s->unsure, 1);
            nh_html_add(w, " itself");
        }
    } else {
        nh_html_add(w, s->against_full ? "not compared with the full motion" : "not compared with the first stage");
    }
    if (s->choice.method) {
        nh_html_add(w, s->choice.held ? "</dd>\n<dt>Method</dt><dd>" : "</dd>\n<dt>Not accurate</dt><dd>");
        nh_html_text(w, s->choice.why);
        nh_html_add(w, "; ");
        nh_html_count(w, (size_t)s->choice.evaluations);
        nh_html_add(w, " evaluations, ");
        nh_html_number(w, full > 0 ? s->choice.seconds / full : 0, 2);
        nh_html_add(w, " times the time of the full motion");
    }
    nh_html_add(w, strcmp(nh_reduction_energy(r, s), "energy") ? "</dd>\n<dt>Moving energy</dt><dd>" : "</dd>\n<dt>Energy</dt><dd>");
    nh_html_add(w, why ? "not followed: " : "drifts by ");
    if (why) nh_html_text(w, why);
    else nh_html_number(w, s->energy_drift, 1);
    nh_html_add(w, "</dd>\n");
    second(w, s);
    measure(w, s);
    if (s->linear.count) {
        nh_html_add(w, "<dt>Linear</dt><dd>");
        nh_html_count(w, s->linear.count);
        nh_html_add(w, s->linear.count == 1 ? " current linear in the velocities" : " currents linear in the velocities");
        if (s->linear_drift >= 0) nh_html_add(w, s->linear.count == 1 ? "; it drifts by " : "; they drift by ");
        if (s->linear_drift >= 0) nh_html_number(w, s->linear_drift, 1);
        nh_html_add(w, "</dd>\n");
    }
    nh_html_add(w, "</dl>\n");
    if (s->note[0]) nh_html_warning(w, s->note);
}

static void by_stages(nh_html_writer *w, const nh_reduction_stage *s)
{
    const nh_ideals *c = s->chain;
    if (!s->by_stages) return;
    nh_html_add(w, "<p>By stages along the generators ");
    for (size_t j = 0; j < c->blocks; j++) {
        nh_html_add(w, j ? " \u2283 {" : "{");
        for (size_t i = c->start[j]; i < c->d; i++) nh_text_addf(w->out, "%s%zu", i > c->start[j] ? ", " : "", c->order[i] + 1);
        nh_html_add(w, "}");
    }
    nh_html_add(w, ": vertical and horizontal equations differ from the true accelerations by ");
    nh_html_number(w, fmax(s->poincare.stages_vertical, s->poincare.stages_horizontal), 1);
    nh_html_add(w, ", in one stage by ");
    nh_html_number(w, fmax(s->poincare.one_vertical, s->poincare.one_horizontal), 1);
    nh_html_add(w, ".</p>\n");
}

static void stage(nh_html_writer *w, const nh_reduction *r, size_t number)
{
    const nh_reduction_stage *s = &r->stage[number];
    nh_text_addf(w->out, "<article class=\"card\">\n<h3>%s: ", nh_reduction_stage_title(r, number));
    for (const char *c = nh_reduction_stage_kind(s); *c; c++) nh_text_addf(w->out, *c == '\'' ? "\u2019" : "%c", *c);
    nh_html_add(w, " ");
    name_of_group(w, s->group);
    nh_html_add(w, "</h3>\n<p>Divided out: ");
    for (size_t a = 0; a < s->action->d; a++) {
        nh_html_add(w, a ? "; " : "");
        field(w, s->action->kinetic, s->action->generator[a].component);
    }
    if (s->local) nh_html_add(w, " (this group acts only locally: it is many-valued on an angle)");
    nh_html_add(w, s->shown->n ? "</p>\n<p>Shape coordinates: " : "</p>\n<p>The shape space is a point.");
    for (size_t i = 0; i < s->shown->n; i++) {
        nh_html_add(w, i ? ", " : "");
        nh_html_name(w, nh_name_of(w->dag, s->shown->x[i]));
    }
    nh_html_add(w, "</p>\n");
    const char **label;
    nh_ex *value;
    size_t n = nh_reduction_shown(r, s, &label, &value);
    nh_html_formulas(w, n, label, value);
    nh_html_add(w, "<p class=\"note\">");
    nh_html_text(w, nh_reduction_letters(r, s));
    nh_html_add(w, "</p>\n");
    checks(w, r, s);
    by_stages(w, s);
    nh_sheet *sheet = nh_reduction_sheet(r, s);
    if (sheet) nh_sheet_html(sheet, "h4", w);
    nh_html_add(w, "</article>\n");
}

static void unused(nh_html_writer *w, const nh_reduction *r)
{
    if (r->unused_count) nh_html_add(w, "<h3>What the stages do without, and why</h3>\n<dl>\n");
    for (size_t i = 0; i < r->unused_count; i++) {
        nh_html_add(w, "<dt>");
        nh_html_text(w, r->unused[i].what);
        nh_html_add(w, "</dt><dd>");
        nh_html_text(w, r->unused[i].why);
        nh_html_add(w, "</dd>\n");
    }
    if (r->unused_count) nh_html_add(w, "</dl>\n");
}

static bool has_momenta(const nh_reduction *r) { return r->stages > 0 && r->group->action.d; }

static void momenta(nh_html_writer *w, const nh_reduction *r)
{
    if (!has_momenta(r)) return;
    size_t linear = nh_reduction_linear_stage(r);
    nh_html_add(w, "<section id=\"momenta\"><h2>Conserved momenta</h2>\n");
    if (!r->momenta.count && linear < r->stages) {
        nh_html_add(w, "<p>The ");
        nh_html_count(w, r->stage[linear].linear.count);
        nh_text_addf(w->out, " of stage %zu, linear in the velocities, %s; no momentum of the group has a closed form, among the sections of the search.</p>\n", linear + 1, r->stage[linear].linear.count == 1 ? "is conserved" : "are conserved");
    } else if (r->momenta.untried) nh_html_add(w, "<p>No search: the constraints are not solved for velocities.</p>\n");
    else if (!r->momenta.count) nh_html_add(w, "<p>No momentum of the group is conserved, among the sections of the search.</p>\n");
    for (size_t i = 0; i < r->momenta.count; i++) {
        const nh_momentum *p = &r->momenta.momentum[i];
        nh_html_add(w, "<article class=\"card\">\n");
        nh_html_formula(w, nh_reduction_momentum_name(r, p), p->value);
        const char *kind = nh_reduction_momentum_kind(p);
        nh_text_addf(w->out, "<p>%c%s ", toupper((unsigned char)*kind), kind + 1);
        field(w, r->kinetic, p->field);
        nh_html_add(w, p->local ? "; local: many-valued on an angle" : "");
        nh_html_add(w, p->proof.proved ? "; proved" : "; to rounding");
        nh_html_text(w, p->proof.all_parameters ? "" : nh_facts_holds(r->kinetic->model, &p->proof, false));
        nh_html_add(w, "</p>\n</article>\n");
    }
    nh_html_add(w, "</section>\n");
}

static void answer(nh_html_writer *w, const nh_reduction *r)
{
    const nh_group *g = r->all ? r->all : r->group;
    nh_html_add(w, g->action.d + g->missing ? g->given ? "<p class=\"answer found\">Group given: " : "<p class=\"answer found\">Symmetry group " : "<p class=\"answer none\">No symmetry of kinetic energy, potential and constraints together");
    if (g->action.d + g->missing) {
        name_of_group(w, g->name);
        nh_html_add(w, ", of dimension ");
        nh_html_count(w, g->action.d + g->missing);
        if (g->local && !g->given) nh_html_add(w, ", locally");
        name_of_group(w, nh_reduction_globally(r, g));
    }
    nh_html_add(w, ".</p>\n");
    for (size_t i = 0; i < r->stages; i++) {
        if (nh_reduction_on_levels(&r->stage[i])) continue;
        nh_html_add(w, !i ? "<p>It reduces " : nh_reduction_instead(r, i) ? "; in one step to " : ", then to ");
        if (!i) nh_html_count(w, r->kinetic->m);
        if (!i) nh_html_add(w, r->kinetic->m == 1 ? " coordinate to " : " coordinates to ");
        nh_html_count(w, r->stage[i].shown->n);
    }
    if (r->stages) nh_html_add(w, ".</p>\n");
}

/* Where an accuracy is wanted: what the stages are compared with. */
static void full_motion(nh_html_writer *w, const nh_reduction *r)
{
    if (!r->full.method) return;
    nh_html_add(w, "<p>Full motion, ");
    nh_html_text(w, r->full_formulation);
    nh_html_add(w, ": ");
    nh_html_text(w, r->full.why);
    nh_html_add(w, "; ");
    nh_html_count(w, (size_t)r->full.evaluations);
    nh_html_add(w, " evaluations.</p>\n");
}

void nh_html_reduction(const nh_reduction *r, const nh_run *run, nh_text *out)
{
    nh_html_writer w = {.out = out, .system = r->system, .dag = r->kinetic->dag, .shown = run->shown, .written = INFINITY};
    nh_html_begin(&w, "reduction by symmetry");
    answer(&w, r);
    nh_html_links(&w, has_momenta(r) ? "group|Group|stages|Reduced equations|momenta|Momenta|system|System|words|Words|repeat|Repeat it" : "group|Group|stages|Reduced equations|system|System|words|Words|repeat|Repeat it");
    for (size_t i = 0; i < r->warnings; i++) nh_html_warning(&w, r->warning[i]);
    nh_html_add(&w, "<section id=\"group\"><h2>The group</h2>\n");
    if (r->all) group(&w, r, r->all, "The whole group");
    if (r->group != r->all) group(&w, r, r->group, r->group->given ? "The given group" : "The group of the reduction");
    nh_html_add(&w, "</section>\n<section id=\"stages\"><h2>Reduced equations</h2>\n");
    if (!r->stages) nh_html_add(&w, "<p>No reduction was possible.</p>\n");
    full_motion(&w, r);
    for (size_t i = 0; i < r->stages; i++) stage(&w, r, i);
    unused(&w, r);
    nh_html_add(&w, "</section>\n");
    momenta(&w, r);
    nh_html_add(&w, "<section id=\"system\"><h2>The system</h2>\n");
    nh_html_written(&w);
    nh_html_add(&w, "</section>\n");
    nh_html_words(&w, "group, shape, stage of a reduction, Chaplygin, distribution, nonholonomic");
    nh_html_repeat(&w, run);
    nh_html_end(&w);
}
