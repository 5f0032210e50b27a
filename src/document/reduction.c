#include "document/reduction.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact/normal.h"
#include "graph/print.h"
#include "reduction/section.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/reduction_sheet.h"

/* Simplified unless it is so large that nobody would read it. */
static nh_ex shortened(const nh_reduction *r, nh_ex e)
{
    enum { largest = 4000 };
    return nh_node_count(r->kinetic->dag, e) < largest ? nh_simplify(r->kinetic->dag, e) : e;
}

size_t nh_reduction_equations(const nh_reduction *r, const nh_reduction_stage *s, nh_reduction_equation **out)
{
    const nh_reduced *o = s->shown;
    nh_dag *d = r->kinetic->dag;
    nh_arena *arena = r->kinetic->arena;
    size_t n = 0;
    nh_reduction_equation *e = nh_arena_alloc(arena, (o->n + 2 * o->r + o->d + 1) * sizeof *e);
    for (size_t i = 0; i < o->r && !o->plain; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t j = 0; j < o->r; j++) sum = nh_add(d, sum, nh_mul(d, o->M[i * o->r + j], o->w[j]));
        e[n++] = (nh_reduction_equation){o->momentum[i], shortened(r, sum)};
    }
    for (size_t i = 0; i < o->n; i++) {
        bool trivial = false; /* x' is itself one of the velocities */
        for (size_t j = 0; j < o->r; j++) trivial |= o->dx[i] == o->w[j];
        if (!trivial) e[n++] = (nh_reduction_equation){nh_name_of(d, o->x[i]), shortened(r, o->dx[i])};
        if (!trivial) e[n - 1].name = nh_arena_printf(arena, "%s'", e[n - 1].name);
    }
    for (size_t i = 0; i < o->r; i++) e[n++] = (nh_reduction_equation){nh_arena_printf(arena, "%s'", o->momentum[i]), shortened(r, o->F[i])};
    for (size_t a = 0; a < o->d; a++) e[n++] = (nh_reduction_equation){nh_arena_printf(arena, "%s_%zu", s->kind == NH_STAGE_SECOND ? "eta" : "zeta", a + 1), shortened(r, o->zeta[a])};
    *out = e;
    return n;
}

const char *nh_reduction_joint_name(const nh_reduction *r, size_t joint)
{
    const nh_chain *c = r->system->chain;
    return nh_arena_printf(r->kinetic->arena, "joint of %s", c->body[c->joint[joint].child].name);
}

/* ---- text ---- */

enum { formula_indent = 4 };

static void put_expression(nh_text *out, const char *name, nh_dag *d, nh_ex e, double shown) { nh_sheet_formulas(d, 1, &name, &e, formula_indent, shown, out); }

static void put_condition(nh_text *out, const char *what, const nh_condition *c)
{
    nh_text_addf(out, "%s %s", what, !c->holds ? "no" : c->all_parameters ? "proved" : c->proved ? "proved here" : "to rounding");
}

/* What limits a symmetry, in parentheses behind it, and the end of the line. */
static void put_holds(const nh_kinetic *k, const nh_proof *proof, bool local, nh_text *out)
{
    const char *around = local ? "local: many-valued on an angle" : "", *holds = proof->all_parameters ? "" : proof->proved ? nh_facts_holds(k->model, proof, false) + 1 : "to rounding";
    if (*around || *holds) nh_text_addf(out, "   (%s%s%s)", around, *around && *holds ? "; " : "", holds);
    nh_text_add(out, "\n");
}

static void put_generators(const nh_reduction *r, const nh_group *g, bool verbose, nh_text *out)
{
    for (size_t a = 0; a < g->action.d; a++) {
        nh_text_addf(out, "  e%zu  ", a + 1);
        nh_generator_text(r->kinetic, &g->action.generator[a], out);
        nh_proof proof = nh_generator_proof(r->kinetic, &g->action.generator[a]);
        put_holds(r->kinetic, &proof, g->action.generator[a].local, out);
        if (!verbose) continue;
        nh_text_add(out, "      leaves invariant: ");
        put_condition(out, "kinetic energy", &g->action.generator[a].metric);
        put_condition(out, ", potential", &g->action.generator[a].potential);
        put_condition(out, ", constraints", &g->action.generator[a].constraints);
        if (r->kinetic->forced) put_condition(out, ", forces", &g->action.generator[a].forces);
        nh_text_add(out, "\n");
    }
}

/* "- 2 ", "(a + b)/a ": a coefficient in a sum. */
static void put_coefficient(nh_dag *d, nh_ex c, bool first, nh_text *out)
{
    bool negative = nh_section_negative(d, c);
    nh_ex size = negative ? nh_neg(d, c) : c;
    nh_text_add(out, negative ? (first ? "-" : " - ") : first ? "" : " + ");
    if (nh_is_number(d, size, 1)) return;
    char *text = nh_print_string(d, size);
    nh_text_addf(out, nh_formula_is_sum(text) ? "(%s) " : "%s ", text);
    nh_free(text);
}

static void put_brackets(const nh_action *g, nh_text *out)
{
    nh_dag *d = g->kinetic->dag;
    bool any = false;
    for (size_t a = 0; a < g->d; a++)
        for (size_t b = a + 1; b < g->d; b++) {
            bool first = true;
            for (size_t k = 0; k < g->d; k++) {
                nh_ex c = g->constant[(a * g->d + b) * g->d + k];
                if (nh_is_zero(d, c)) continue;
                if (first) nh_text_addf(out, "%s[e%zu,e%zu] = ", any ? ", " : "  brackets of the Lie algebra: ", a + 1, b + 1);
                put_coefficient(d, c, first, out);
                nh_text_addf(out, "e%zu", k + 1);
                first = false;
                any = true;
            }
        }
    nh_text_add(out, any ? "\n" : g->d > 1 ? "  all brackets vanish\n" : "");
}

static void put_group(const nh_reduction *r, const nh_group *g, bool verbose, nh_text *out)
{
    nh_text_addf(out, "%s: %s, dimension %zu%s\n", g->given ? "Group given" : g->local ? "Symmetry group, locally" : "Symmetry group", g->name, g->action.d + g->missing, nh_reduction_globally(r, g));
    if (g->jets)
        nh_text_addf(out, "  local symmetries of kinetic energy, potential and constraints: %zu (counted without an ansatz; of the kinetic energy alone: %zu)\n", g->jets->dimension, g->jets->of_metric);
    if (r->weaker && g == r->all)
        nh_text_addf(out, "  %zu more up to a total derivative in the Lagrangian: --weak\n", r->weaker);
    if (r->strict) nh_text_add(out, "  symmetries of the equations of motion: the Lagrangian may change by a total derivative\n");
    put_generators(r, g, verbose, out);
    put_brackets(&g->action, out);
    if (!g->action.d) return;
    const nh_algebra_report *p = &g->report;
    nh_text_addf(out, "  centre of dimension %zu, radical %zu, derived series", p->centre, p->radical);
    for (size_t i = 0; i < p->derived_length; i++) nh_text_addf(out, "%s%zu", i ? ", " : " ", p->derived[i]);
    nh_text_addf(out, "\n  %s; orbits of dimension %zu", g->action.free ? "acts freely" : "does not act freely", g->action.orbit);
    if (r->kinetic->affine)
        nh_text_addf(out, "; V + D %s TQ, S = V cap D of dimension %zu%s", g->action.dimension_assumption ? "=" : "is not", g->action.intersection, g->action.chaplygin ? ": a Chaplygin system" : "");
    nh_text_add(out, "\n");
}

static bool same_field(const nh_reduction *r, size_t i, size_t j)
{
    const nh_chain_field *a = &r->joints->field[i], *b = &r->joints->field[j];
    return a->joint == b->joint && !memcmp(a->component, b->component, r->kinetic->m * sizeof *a->component);
}

/* By another rule. */
static bool same_before(const nh_reduction *r, size_t i)
{
    for (size_t j = 0; j < i; j++)
        if (same_field(r, i, j)) return true;
    return false;
}

/* Of a chain of bodies: [ChhabraEmami2014, sec. 4]. */
static void put_joints(const nh_reduction *r, nh_text *out)
{
    const nh_chain_symmetries *c = r->joints;
    if (!c) return;
    nh_text_addf(out, "\nSymmetries of the kinetic energy, joint by joint%s\n", c->fields ? "" : ": none");
    for (size_t i = 0; i < c->fields; i++) {
        const nh_generator *g = &r->of_joint[i];
        if (same_before(r, i)) continue;
        nh_text_addf(out, "  %s: ", nh_reduction_joint_name(r, c->field[i].joint));
        nh_generator_text(r->kinetic, g, out);
        for (size_t j = i; j < c->fields; j++)
            if (same_field(r, i, j)) nh_text_addf(out, "%s%s", j > i ? ", " : " (", nh_chain_rule_name(c->field[j].rule));
        const char *also = g->potential.holds ? g->constraints.holds ? "a symmetry of the system" : "not of the constraints" : g->constraints.holds ? "not of the potential" : "neither of the potential nor of the constraints";
        nh_text_addf(out, "): %s%s\n", g->local ? "locally " : "", also);
    }
}

/* The full motion, where an accuracy is wanted. */
static void put_full(const nh_reduction *r, nh_text *out)
{
    const nh_reduction_choice *c = &r->full;
    if (!c->method) return;
    nh_text_addf(out, "\nFull motion to t = %.4g, for agreement to %.1e\n  %s\n", r->until, r->wanted, c->why);
    nh_text_addf(out, "  %s: %ld evaluations, %.2g ms\n", r->full_formulation, c->evaluations, 1e3 * c->seconds);
}

typedef struct {
    nh_dag *dag;
    double shown;
    nh_text *out;
} text_pen;

static void text_words(void *to, const char *words)
{
    text_pen *p = to;
    nh_text_addf(p->out, "  %s\n", words);
}

static void text_formula(void *to, const char *label, nh_ex e)
{
    text_pen *p = to;
    put_expression(p->out, label, p->dag, e, p->shown);
}

static void put_stage(const nh_reduction *r, size_t number, double shown, nh_text *out)
{
    const nh_reduction_stage *s = &r->stage[number];
    nh_text_addf(out, "\n%s: %s %s\n", nh_reduction_stage_title(r, number), nh_reduction_stage_kind(s), s->group);
    for (size_t a = 0; a < s->action->d; a++) {
        nh_text_add(out, a ? "; " : "  group    ");
        nh_generator_text(s->action->kinetic, &s->action->generator[a], out);
    }
    if (s->local) nh_text_add(out, "\n           acts only locally: many-valued on an angle");
    nh_text_add(out, "\n  shape    ");
    for (size_t i = 0; i < s->shown->n; i++) nh_text_addf(out, "%s%s", i ? ", " : "", nh_name_of(r->kinetic->dag, s->shown->x[i]));
    if (!s->shown->n) nh_text_add(out, "none: a point");
    nh_text_add(out, "\n");
    text_pen to = {r->kinetic->dag, shown, out};
    nh_reduction_pen pen = {&to, text_words, text_formula};
    nh_reduction_conditions(s, &pen);
    const char **label;
    nh_ex *value;
    size_t n = nh_reduction_shown(r, s, &label, &value);
    nh_sheet_formulas(r->kinetic->dag, n, label, value, formula_indent, shown, out);
    nh_text_addf(out, "  (%s)\n", nh_reduction_letters(r, s));
    nh_reduction_remarks(r, s, &pen);
    nh_sheet *sheet = nh_reduction_sheet(r, s);
    if (sheet) nh_sheet_text(sheet, false, out);
}

static void put_momenta(const nh_reduction *r, double shown, nh_text *out)
{
    if (!r->stages || (r->partial && !r->momenta.count)) return;
    size_t linear = nh_reduction_linear_stage(r);
    if (r->momenta.count) nh_text_add(out, "\nConserved momenta of the group\n");
    else if (linear < r->stages) nh_text_addf(out, "\nConserved momenta of the group: the %zu of stage %zu; none has a closed form among the sections of the search\n", r->stage[linear].linear.count, linear + 1);
    else if (r->momenta.untried) nh_text_add(out, "\nNo search for momenta of the group: the constraints are not solved for velocities\n");
    else nh_text_add(out, "\nNo momentum of the group is conserved (among the sections of the search)\n");
    for (size_t i = 0; i < r->momenta.count; i++) {
        const nh_momentum *p = &r->momenta.momentum[i];
        nh_generator field = {.component = p->field};
        nh_text_addf(out, "  %s ", nh_reduction_momentum_kind(p));
        nh_generator_text(r->kinetic, &field, out);
        nh_text_addf(out, " (%s%s%s)\n", p->proof.proved ? "proved" : "to rounding", p->proof.all_parameters ? "" : nh_facts_holds(r->kinetic->model, &p->proof, false), p->local ? "; local: many-valued on an angle" : "");
        put_expression(out, nh_reduction_momentum_name(r, p), r->kinetic->dag, p->value, shown);
    }
}

static void put_all(const nh_reduction *r, bool verbose, nh_text *out)
{
    double shown = r->options.shown;
    nh_text_addf(out, "%s   with ", r->system->title);
    for (size_t i = 0; i < r->system->parameters; i++) nh_text_addf(out, "%s%s = %.6g", i ? ", " : "", r->system->parameter[i].name, r->system->parameter[i].value);
    nh_text_addf(out, "%s\n%zu coordinate%s, %zu constraint%s\n\n", r->system->parameters ? "" : "no parameters", r->kinetic->m, r->kinetic->m == 1 ? "" : "s", r->kinetic->f, r->kinetic->f == 1 ? "" : "s");
    if (r->all) put_group(r, r->all, verbose, out);
    if (r->group != r->all) put_group(r, r->group, verbose, out);
    put_joints(r, out);
    put_full(r, out);
    for (size_t i = 0; i < r->stages; i++) put_stage(r, i, shown, out);
    for (size_t i = 0; i < r->unused_count; i++) nh_text_addf(out, "%s  %s: %s\n", i ? "" : "\nWhat the stages do without, and why\n", r->unused[i].what, r->unused[i].why);
    if (r->group->action.d) put_momenta(r, shown, out);
    for (size_t i = 0; i < r->warnings; i++) nh_text_addf(out, "%swarning: %s\n", i ? "" : "\n", r->warning[i]);
}

void nh_reduction_text(const nh_reduction *r, bool verbose, nh_text *out)
{
    nh_text all;
    nh_text_init(&all);
    put_all(r, verbose, &all);
    nh_sheet_fold(nh_text_string(&all), out);
    nh_text_clear(&all);
}
