/* A symmetry group and the reductions by it as a document: page, LaTeX, text. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/simulation.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/reduction_internal.h"
#include "document/screen.h"
#include "graph/node.h"
#include "graph/print.h"

/* "SE(2) x SO(2)^3" as it is typeset. */
static const char *group_name(const nh_reduction *r, const nh_pen *p, const char *name)
{
    nh_text text;
    nh_text_init(&text);
    for (; *name; name++) {
        bool times = !p->ink->brief && !strncmp(name, " x ", 3);
        nh_text_add_n(&text, times ? " \u00d7 " : name, times ? strlen(" \u00d7 ") : 1);
        name += times ? 2 : 0;
    }
    const char *out = nh_arena_printf(r->arena, "%s", nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

static void field(nh_pen *p, const nh_kinetic *k, const nh_ex *component)
{
    nh_pen_field(p, k->dag, k->m, k->name, component);
}

/* ---- the group ---- */

static const char *how(const nh_condition *c)
{
    return !c->holds ? "no" : c->all_parameters ? "proved" : c->proved ? "proved here" : "to rounding";
}

/* What a generator leaves invariant: in one word where all is proved. */
static void invariance(nh_pen *p, const nh_reduction *r, const nh_generator *g)
{
    const nh_condition *const c[] = {&g->metric, &g->potential, &g->constraints, &g->forces};
    static const char *const what[] = {"kinetic energy", ", potential", ", constraints", ", forces"};
    size_t n = r->kinetic->forced ? 4 : 3, proved = 0;
    for (size_t i = 0; i < n; i++) proved += c[i]->holds && c[i]->all_parameters;
    bool all = proved < n || p->style.verbose;
    if (!all) nh_pen_say(p, "; proved");
    for (size_t i = 0; i < n && all; i++) nh_pen_say(p, "%s%s %s", i ? "" : "; ", what[i], how(c[i]));
}

static void generators(nh_pen *p, const nh_reduction *r, const nh_group *g)
{
    const nh_kinetic *k = r->kinetic;
    for (size_t a = 0; a < g->action.d; a++) {
        const nh_generator *e = &g->action.generator[a];
        nh_proof proof = nh_generator_proof(k, e);
        nh_pen_fact_begin(p, nh_arena_printf(r->arena, "$e_{%zu}$", a + 1));
        field(p, k, e->component);
        nh_pen_say(p, "%s", e->local ? " (local: many-valued on an angle)" : "");
        if (!proof.all_parameters)
            nh_pen_say(p, "%s", proof.proved ? nh_facts_holds(k->model, &proof, false) : " (to rounding)");
        invariance(p, r, e);
        nh_pen_close(p, NH_PEN_FACT);
    }
}

static void algebra(nh_pen *p, const nh_reduction *r, const nh_group *g)
{
    const nh_algebra_report *report = &g->report;
    const nh_action *a = &g->action;
    nh_pen_fact_begin(p, "Algebra");
    nh_pen_say(p, "centre of dimension %zu, radical %zu, derived series ", report->centre, report->radical);
    for (size_t i = 0; i < report->derived_length; i++) nh_pen_say(p, "%s%zu", i ? ", " : "", report->derived[i]);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact(p, "Action", "%s, with orbits of dimension %zu", a->free ? "free" : "not free", a->orbit);
    if (!r->kinetic->affine || !r->kinetic->f) return;
    nh_pen_fact(p, "Constraints",
                "the directions $V$ of the group and the allowed directions $D$ together %s; their intersection has "
                "dimension %zu%s",
                a->dimension_assumption ? "span the tangent space" : "do not span the tangent space", a->intersection,
                a->chaplygin ? ": a Chaplygin system" : "");
}

static void counted(nh_pen *p, const nh_reduction *r, const nh_group *g)
{
    if (!g->jets && !g->given)
        nh_pen_fact(p, "Not counted", "%s; there may be more symmetries than the search for closed forms found",
                    nh_reduction_not_counted(r->kinetic));
    if (!g->jets) return;
    nh_pen_fact_begin(p, "Counted");
    nh_pen_say(p,
               "%zu local symmetr%s of kinetic energy, potential and constraints, without an ansatz; %zu of the "
               "kinetic energy alone",
               g->jets->dimension, g->jets->dimension == 1 ? "y" : "ies", g->jets->of_metric);
    if (!g->jets->exact) nh_pen_say(p, ", by numbers");
    if (r->weaker && g == r->all)
        nh_pen_say(p, "; %zu more that change%s the Lagrangian by a total derivative: --weak", r->weaker,
                   r->weaker == 1 ? "s" : "");
    if (g->missing) nh_pen_say(p, "; %zu without a closed form", g->missing);
    nh_pen_close(p, NH_PEN_FACT);
}

/* "Symmetry group, locally: SE(3), dimension 6; globally: SO(2)^3, of dimension 3" */
static const char *title(nh_pen *p, const nh_reduction *r, const nh_group *g)
{
    const char *what = g->given ? "Group given" : !r->all || g == r->all ? "Symmetry group" : "Group of the reduction";
    return group_name(r, p,
                      nh_arena_printf(r->arena, "%s%s: %s, dimension %zu%s", what,
                                      g->local && !g->given ? ", locally" : "", g->name, g->action.d + g->missing,
                                      nh_reduction_globally(r, g)));
}

static void group(nh_pen *p, const nh_reduction *r, const nh_group *g)
{
    if (r->all && r->group != r->all) { /* otherwise the answer has named the group */
        nh_pen_open(p, NH_PEN_HEADING, NULL, title(p, r, g));
        nh_pen_close(p, NH_PEN_HEADING);
    }
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    counted(p, r, g);
    generators(p, r, g);
    if (g->action.d) algebra(p, r, g);
    if (r->strict && g->action.d)
        nh_pen_fact(p, "Of", "the equations of motion: the Lagrangian may change by a total derivative");
    nh_pen_close(p, NH_PEN_FACTS);
    if (g->action.d > 1) nh_pen_sheet(p, nh_reduction_brackets_sheet(r, &g->action));
}

static bool same_field(const nh_reduction *r, size_t i, size_t j)
{
    const nh_chain_field *a = &r->joints->field[i], *b = &r->joints->field[j];
    return a->joint == b->joint && !memcmp(a->component, b->component, r->kinetic->m * sizeof *a->component);
}

/* The same by another momentum rule. */
static bool same_before(const nh_reduction *r, size_t i)
{
    for (size_t j = 0; j < i; j++)
        if (same_field(r, i, j)) return true;
    return false;
}

/* The meaning of the rules' names that occur. */
static void rules(nh_pen *p, const nh_chain_symmetries *c)
{
    static const char *const meaning[NH_CHAIN_RULES] = {
        [NH_CHAIN_FIRST] = "a displacement that a joint on the ground allows, of everything",
        [NH_CHAIN_AP1] = "a displacement of space that the joint allows wherever its body is, of all bodies behind it",
        [NH_CHAIN_AP2] = "a displacement in the frame that carries the joint, of all bodies behind it",
        [NH_CHAIN_EXTREMITY] = "a displacement in the frame of a body at the end of the chain, of that body"};
    bool any = false;
    if (!c->fields) return;
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    for (int k = 0; k < NH_CHAIN_RULES; k++) {
        bool there = false;
        for (size_t i = 0; i < c->fields; i++) there |= (int)c->field[i].rule == k;
        if (there) nh_pen_say(p, "%s%s: %s", any ? "; " : "", nh_chain_rule_name((nh_chain_rule)k), meaning[k]);
        any |= there;
    }
    nh_pen_say(p, " (Chhabra and Emami 2014, section 4).");
    nh_pen_close(p, NH_PEN_WORDS);
}

/* For a chain of bodies: [ChhabraEmami2014, sec. 4]. */
static void joints(nh_pen *p, const nh_reduction *r)
{
    const nh_chain_symmetries *c = r->joints;
    if (!c) return;
    nh_pen_open(p, NH_PEN_HEADING, NULL,
                c->fields ? "Symmetries of the kinetic energy, joint by joint"
                          : "Symmetries of the kinetic energy, joint by joint: none");
    nh_pen_close(p, NH_PEN_HEADING);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    for (size_t i = 0; i < c->fields; i++) {
        const nh_generator *g = &r->of_joint[i];
        if (same_before(r, i)) continue;
        nh_pen_fact_begin(p, nh_reduction_joint_name(r, c->field[i].joint));
        field(p, r->kinetic, g->component);
        for (size_t j = i; j < c->fields; j++)
            if (same_field(r, i, j)) nh_pen_say(p, "%s%s", j > i ? ", " : " (", nh_chain_rule_name(c->field[j].rule));
        const char *without =
            g->constraints.holds ? "not of the potential" : "neither of the potential nor of the constraints";
        const char *also =
            g->potential.holds ? g->constraints.holds ? "a symmetry of the system" : "not of the constraints" : without;
        nh_pen_say(p, "): %s%s", g->local ? "locally " : "", also);
        nh_pen_close(p, NH_PEN_FACT);
    }
    nh_pen_close(p, NH_PEN_FACTS);
    rules(p, c);
}

/* ---- what the constraints integrate to ---- */

static void growth(nh_pen *p, const nh_reduction *r)
{
    nh_text words;
    if (!r->growth.length) return;
    nh_pen_open(p, NH_PEN_HEADING, NULL, "What the constraints alone keep constant");
    nh_pen_close(p, NH_PEN_HEADING);
    for (size_t i = 0; i < r->leaf_count; i++) {
        char *text = nh_formula_text(r->kinetic->dag, r->leaf[i], r->options.shown);
        nh_pen_words(p, "<%s>", text);
        nh_free(text);
    }
    nh_text_init(&words);
    nh_reduction_growth_words(r, &words);
    nh_pen_words(p, "%s", nh_text_string(&words));
    nh_text_clear(&words);
}

/* ---- stages ---- */

/* Where the equations are written, and which shape coordinates are others there than along a motion. */
static void slice(nh_pen *p, const nh_reduction *r, const nh_slice *s)
{
    if (!s->d) return;
    nh_pen_fact_begin(p, "Slice");
    for (size_t a = 0; a < s->d; a++) {
        char *value = nh_print_string(s->dag, s->y[a]);
        nh_pen_say(p, "%s", a ? ", " : "");
        nh_pen_name(p, s->kinetic->name[s->along[a]]);
        nh_pen_say(p, " = %s", value);
        nh_free(value);
    }
    for (int own = 1; own >= 0; own--) {
        size_t moved = 0;
        for (size_t i = 0; i < s->n; i++) {
            if (!nh_slice_moves(s, i)) continue;
            nh_pen_say(p, moved++ ? ", " : own ? "; " : ": values on it of ");
            nh_pen_name(p, own ? nh_name_of(r->kinetic->dag, s->x[i]) : s->kinetic->name[s->shape[i]]);
        }
        if (moved && !own) nh_pen_say(p, ", which the group moves");
    }
    nh_pen_close(p, NH_PEN_FACT);
}

/* Which of them theorem 4.1 gives. */
static void first_joint(nh_pen *p, const nh_reduction *r, const nh_action *action)
{
    bool *first = nh_arena_alloc(r->arena, (action->d + 1) * sizeof *first);
    size_t count = 0, all = 0;
    nh_group_first_joint(action, first);
    for (size_t a = 0; a < action->d; a++) count += first[a];
    for (size_t i = 0; i < r->joints->fields; i++) all += r->joints->field[i].rule == NH_CHAIN_FIRST;
    if (count && count == all)
        nh_pen_say(p, "; with the whole group of the first joint (Chhabra and Emami 2014, theorem 4.1)");
}

static void divided_out(nh_pen *p, const nh_reduction *r, const nh_reduction_stage *s)
{
    const nh_reduced *o = s->shown;
    nh_pen_fact_begin(p, "Divided out");
    for (size_t a = 0; a < s->action->d; a++) {
        nh_pen_say(p, "%s", a ? "; " : "");
        field(p, s->action->kinetic, s->action->generator[a].component);
    }
    nh_pen_say(p, "%s", s->local ? " (this group acts only locally: it is many-valued on an angle)" : "");
    if (r->joints && s->kind != NH_STAGE_SECOND) first_joint(p, r, s->action);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact_begin(p, "Shape");
    for (size_t i = 0; i < o->n; i++)
        nh_pen_say(p, i ? ", " : ""), nh_pen_name(p, nh_name_of(r->kinetic->dag, o->x[i]));
    nh_pen_say(p, "%s", o->n ? "" : "a point");
    nh_pen_close(p, NH_PEN_FACT);
    slice(p, r, s->shown_slice);
    const nh_chart *chart = s->kind == NH_STAGE_QUOTIENT && r->whole ? r->whole->chart : NULL;
    if (!chart || !chart->branch) return;
    char *branch = nh_chart_branch_name(chart, chart->branch);
    nh_pen_fact(p, "Branch", "these equations hold on the branch %s, where the motion begins", branch);
    nh_free(branch);
}

static void stage(nh_pen *p, const nh_reduction *r, size_t number)
{
    const nh_reduction_stage *s = nh_reduction_named(&r->stage[number]);
    const char *kind = nh_reduction_stage_kind(s);
    nh_pen_card(
        p,
        group_name(r, p, nh_arena_printf(r->arena, "%s: %s %s", nh_reduction_stage_title(r, number), kind, s->group)));
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    divided_out(p, r, s);
    nh_reduction_conditions(s, p);
    nh_pen_close(p, NH_PEN_FACTS);
    nh_pen_sheet(p, nh_reduction_equations_sheet(r, s));
    nh_pen_sheet(p, nh_reduction_inertia_sheet(r, s));
    nh_pen_sheet(p, nh_reduction_hamilton_sheet(r, s));
    nh_pen_sheet(p, nh_reduction_helmholtz_sheet(r, s));
    nh_reduction_remarks(r, s, p);
    if (!p->ink->brief) nh_reduction_figures(r, s, p);
    nh_pen_sheet(p, nh_reduction_sheet(r, s));
    nh_pen_card_end(p);
}

/* Where an accuracy is requested: the full motion with which the stages are compared. */
static void full_motion(nh_pen *p, const nh_reduction *r)
{
    const nh_reduction_choice *c = &r->full;
    if (!c->method) return;
    nh_pen_words(p, "Full motion to t = %.4g, for agreement to %.2g, %s: %s; %ld evaluations, %.2g ms.", r->until,
                 r->wanted, r->full_formulation, c->why, c->evaluations, 1e3 * c->seconds);
}

static void unused(nh_pen *p, const nh_reduction *r)
{
    if (!r->unused_count) return;
    nh_pen_open(p, NH_PEN_HEADING, NULL, "What the stages do not use, and why");
    nh_pen_close(p, NH_PEN_HEADING);
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    for (size_t i = 0; i < r->unused_count; i++) nh_pen_fact(p, r->unused[i].what, "%s", r->unused[i].why);
    nh_pen_close(p, NH_PEN_FACTS);
}

static bool has_momenta(const nh_reduction *r)
{
    return r->stages > 0 && r->group->action.d && !(r->partial && !r->momenta.count);
}

static void no_momenta(nh_pen *p, const nh_reduction *r)
{
    size_t linear = nh_reduction_linear_stage(r), n = linear < r->stages ? r->stage[linear].linear.count : 0;
    if (n)
        nh_pen_words(p,
                     "The %zu current%s of stage %zu that %s linear in the velocities %s conserved; the search found "
                     "no momentum of the group in closed form.",
                     n, n == 1 ? "" : "s", linear + 1, n == 1 ? "is" : "are", n == 1 ? "is" : "are");
    else if (r->momenta.untried) nh_pen_words(p, "No search: the constraints are not solved for velocities.");
    else nh_pen_words(p, "The search found no conserved momentum of the group.");
}

static void momenta(nh_pen *p, const nh_reduction *r)
{
    if (!has_momenta(r)) return;
    nh_pen_section(p, "momenta", "Conserved momenta of the group");
    if (!r->momenta.count) no_momenta(p, r);
    for (size_t i = 0; i < r->momenta.count; i++) {
        const nh_momentum *m = &r->momenta.momentum[i];
        const char *name = nh_arena_printf(r->arena, "<%s>", nh_reduction_momentum_name(r, m));
        nh_pen_card(p, NULL);
        nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
        nh_pen_say(p, "%s ", nh_reduction_momentum_kind(m));
        field(p, r->kinetic, m->field);
        nh_pen_say(p, " (%s%s%s)", m->proof.proved ? "proved" : "to rounding",
                   m->proof.all_parameters ? "" : nh_facts_holds(r->kinetic->model, &m->proof, false),
                   m->local ? "; local: many-valued on an angle" : "");
        nh_pen_close(p, NH_PEN_WORDS);
        nh_pen_formula(p, name, m->value);
    }
}

static void reduces(nh_pen *p, const nh_reduction *r)
{
    bool any = false;
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "%zu coordinate%s, %zu constraint%s", r->kinetic->m, r->kinetic->m == 1 ? "" : "s", r->kinetic->f,
               r->kinetic->f == 1 ? "" : "s");
    for (size_t k = 0; k < r->stages; k++) {
        size_t i = nh_reduction_order(r, k), n = r->stage[i].shown->n;
        if (nh_reduction_on_levels(&r->stage[i])) continue;
        bool point = k == 0 && i > 0, other = nh_reduction_instead(r, i);
        if (any)
            nh_pen_say(p,
                       other    ? "; in one step to %zu"
                       : i == 0 ? "; instead of one step to %zu"
                                : ", then to %zu",
                       n);
        else nh_pen_say(p, "; reduced %sto %zu shape coordinate%s", point ? "in one step " : "", n, n == 1 ? "" : "s");
        any = true;
    }
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
}

static void answer(nh_pen *p, const nh_reduction *r)
{
    const nh_group *g = r->all ? r->all : r->group;
    size_t dimension = g->action.d + g->missing;
    nh_pen_open(p, NH_PEN_ANSWER, dimension ? "found" : "none", NULL);
    if (dimension) nh_pen_say(p, "%s", title(p, r, g));
    else nh_pen_say(p, "No symmetry of kinetic energy, potential and constraints together");
    nh_pen_close(p, NH_PEN_ANSWER);
    reduces(p, r);
}

void nh_reduction_write(const nh_reduction *r, const nh_run *run, nh_pen_style style, nh_text *out)
{
    if (nh_screen_is_wanted(style) && !(r->stages && r->stage[0].theory)) {
        nh_reduction_write_answer(r, style.colour, out);
        return;
    }
    nh_pen pen, *p = &pen;
    nh_pen_subject subject = {
        .system = r->system, .dag = r->kinetic->dag, .shown = run ? run->shown : r->options.shown};
    nh_pen_begin(p, style, &subject, "reduction by symmetry", out);
    answer(p, r);
    nh_stage *motion = p->ink->stage && r->motion && run ? nh_simulation_stage(r->motion, run) : NULL;
    if (motion) p->ink->stage(p->to, motion);
    p->ink->links(
        p->to, has_momenta(r)
                   ? "group|Group|stages|Reduced equations|momenta|Momenta|system|System|words|Words|repeat|Repeat it"
                   : "group|Group|stages|Reduced equations|system|System|words|Words|repeat|Repeat it");
    for (size_t i = 0; i < r->warnings; i++) nh_pen_warning(p, r->warning[i]);
    nh_pen_section(p, "group", "The group");
    if (r->all) group(p, r, r->all);
    if (r->group != r->all) group(p, r, r->group);
    joints(p, r);
    growth(p, r);
    nh_pen_sheet(p, nh_reduction_metric_sheet(r));
    nh_pen_section(p, "stages", "Reduced equations");
    if (!r->stages) nh_pen_words(p, "No reduction was possible.");
    full_motion(p, r);
    for (size_t i = 0; i < r->stages; i++) stage(p, r, nh_reduction_order(r, i));
    unused(p, r);
    momenta(p, r);
    nh_pen_system(p, NULL, NULL);
    nh_pen_glossary(p, "group, shape, stage of a reduction, Chaplygin, distribution, nonholonomic");
    nh_pen_end(p, run);
    nh_stage_free(motion);
}
