/* The system of a document: as it was written, and as the program understood it; and its geometry. */
#include <stdio.h>

#include "base/memory.h"
#include "document/facts.h"
#include "document/geometry_sheet.h"
#include "document/pen.h"
#include "exact/normal.h"
#include "graph/node.h"

/* ---- as it was written ---- */

static const char *or_nothing(const char *text) { return text ? text : ""; }

static void parameters(nh_pen *p, const nh_system *system)
{
    if (!system->parameters) return;
    bool said = false; /* a column of meanings only where a meaning is given */
    for (size_t i = 0; i < system->parameters; i++) said |= *or_nothing(system->parameter[i].doc) != 0;
    nh_pen_table(p, "Parameters", said ? "name|value|meaning" : "name|value");
    for (size_t i = 0; i < system->parameters; i++) {
        const nh_parameter *a = &system->parameter[i];
        const char *doc = or_nothing(a->doc);
        if (nh_pen_is_open(&p->of, a->name)) nh_pen_row(p, said ? "#<%s>|any|%s" : "#<%s>|any%s", a->name, doc);
        else
            nh_pen_row(p, said ? "#<%s>|%.10g %s|%s" : "#<%s>|%.10g %s%s", a->name, a->value, or_nothing(a->unit), doc);
    }
    nh_pen_table_end(p);
}

static void coordinates(nh_pen *p, const nh_system *system)
{
    static const char *const types[] = {"angle", "length", "number"};
    bool said = false;
    for (size_t i = 0; i < system->coordinates; i++) said |= *or_nothing(system->coordinate[i].doc) != 0;
    nh_pen_table(p, "Coordinates", said ? "name|type|meaning" : "name|type");
    for (size_t i = 0; i < system->coordinates; i++) {
        const nh_coordinate *q = &system->coordinate[i];
        const char *unit = or_nothing(q->unit);
        nh_pen_row(p, said ? "#<%s>|%s%s%s|%s" : "#<%s>|%s%s%s%s", q->name, types[q->type], *unit ? " / " : "", unit,
                   or_nothing(q->doc));
    }
    nh_pen_table_end(p);
}

static void forces(nh_pen *p, const nh_system *system)
{
    bool said = false;
    for (size_t i = 0; i < system->coordinates && system->has_forces; i++) {
        char label[200];
        if (nh_is_zero(system->dag, system->force[i])) continue;
        if (!said) nh_pen_words(p, "Generalized forces");
        said = true;
        snprintf(label, sizeof label, "Q_%.180s", system->coordinate[i].name);
        nh_pen_formula(p, label, system->force[i]);
    }
}

static void written(nh_pen *p, const nh_system *system)
{
    const nh_deck_node *node = system->deck ? nh_deck_get(nh_deck_root(system->deck), "lagrangian") : NULL;
    nh_pen_heading(p, "System file");
    parameters(p, system);
    coordinates(p, system);
    for (size_t i = 0; i < system->definitions; i++) p->ink->equation(p->to, "", system->definition[i].text);
    nh_pen_words(p, system->chain ? "Lagrangian, from the bodies and joints of the system file" : "Lagrangian");
    if (node && node->kind == NH_DECK_SCALAR && !system->chain) p->ink->equation(p->to, "L", node->text);
    else nh_pen_formula(p, "L", system->lagrangian);
    if (system->constraints) nh_pen_words(p, "Constraints");
    for (size_t i = 0; i < system->constraints; i++) p->ink->equation(p->to, "", system->constraint[i].text);
    forces(p, system);
}

/* ---- as the program understood it ---- */

/* The functions that the constraints alone keep constant. */
static void integrals(nh_pen *p, const nh_analysis *result)
{
    size_t hidden = result->question->constraint.hidden, left = hidden - result->integrals;
    if (!hidden) return;
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "%zu %s%s: ", hidden,
               result->question->constraint.holonomic ? "integral" : "hidden holonomic constraint",
               hidden == 1 ? "" : "s");
    for (size_t i = 0; i < result->integrals; i++) {
        const nh_current *f = &result->list->found[result->integral[i]];
        nh_pen_say(p, "%s", i ? ", " : "");
        nh_pen_say(p, "<%s> = const%s", f->name, f->local ? " (local)" : "");
    }
    if (left) nh_pen_say(p, "%s%zu without a closed form in this ansatz", result->integrals ? ", and " : "", left);
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
}

static void kind(nh_pen *p, const nh_analysis *result)
{
    nh_model *model = result->question->model;
    nh_text words;
    nh_text_init(&words);
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "%zu coordinate%s, ", model->m, model->m == 1 ? "" : "s");
    if (model->k) {
        nh_facts_constraint(result, &words);
        nh_pen_say(p, "%zu %s", model->k, nh_text_string(&words));
    } else {
        nh_pen_say(p, "no constraints");
    }
    nh_pen_say(p, ". Constraint submanifold of dimension %zu.", 1 + model->m + model->n);
    nh_text_clear(&words);
    nh_facts_branch(result, &words);
    if (words.length) nh_pen_say(p, " Everything was %s.", nh_text_string(&words));
    nh_text_clear(&words);
    nh_pen_close(p, NH_PEN_WORDS);
    integrals(p, result);
}

/* Formulas under a heading; folded where they take many lines, as readers only look things up in them. */
static void block(nh_pen *p, nh_dag *d, const char *heading, size_t n, const char *const *label, const nh_ex *e)
{
    enum { long_block = 400 };
    double length = 0;
    for (size_t i = 0; i < n; i++) length += (double)nh_complexity(d, e[i]);
    bool folded = length > long_block && !p->ink->brief;
    if (folded) nh_pen_open(p, NH_PEN_FOLD, NULL, heading);
    else nh_pen_words(p, "%s", heading);
    nh_pen_formulas(p, n, label, e);
    if (folded) nh_pen_close(p, NH_PEN_FOLD);
}

/* "mu", or "mu_1", ...; "F_x". */
static void multipliers(nh_pen *p, const nh_model *model)
{
    if (!model->k) return;
    const char **label = nh_alloc_array(model->k + model->m, sizeof *label);
    nh_ex *e = nh_alloc_array(model->k + model->m, sizeof *e);
    for (size_t a = 0; a < model->k; a++) {
        label[a] = model->k == 1 ? "mu" : nh_arena_printf(model->arena, "mu_%zu", a + 1);
        e[a] = model->mu[a];
    }
    for (size_t s = 0; s < model->m; s++) {
        label[model->k + s] = nh_arena_printf(model->arena, "F_%s", model->system->coordinate[s].name);
        e[model->k + s] = model->reaction[s];
    }
    for (size_t a = 0; a < model->k && (p->ink->brief || model->k > 1); a++)
        nh_pen_words(p, "<%s> is the multiplier of <%s>.", label[a], model->system->constraint[a].text);
    if (p->ink->brief) block(p, model->dag, "Chetaev multipliers", model->k, label, e);
    else block(p, model->dag, "Chetaev multipliers and constraint force", model->k + model->m, label, e);
    nh_free(e);
    nh_free(label);
}

/* "x' = v*cos(phi)": what the quasi-velocities mean. */
static void velocities(nh_pen *p, const nh_model *model)
{
    if (!model->chart->quasi || model->framed) return;
    const char **label = nh_alloc_array(model->m + 1, sizeof *label);
    for (size_t s = 0; s < model->m; s++)
        label[s] = nh_arena_printf(model->arena, "%s'", model->system->coordinate[s].name);
    block(p, model->dag, "Velocities", model->m, label, model->rho);
    nh_free(label);
}

static void equations(nh_pen *p, const nh_model *model, bool more)
{
    bool same = model->Lbar == model->E; /* no potential */
    const char *const written = model->k ? "\\bar{L}" : "L";
    const char *const both = nh_arena_printf(model->arena, "%s = E", written);
    const char **label = nh_alloc_array(model->n + 1, sizeof *label);
    for (size_t i = 0; i < model->n; i++)
        label[i] = nh_arena_printf(model->arena, "%s'", nh_name_of(model->dag, model->chart->w[i]));
    nh_pen_open(p, NH_PEN_SUBHEADING, NULL, NULL);
    nh_pen_say(p, "In {%s}", model->chart->name);
    nh_pen_close(p, NH_PEN_SUBHEADING);
    velocities(p, model);
    if (!p->ink->brief)
        block(p, model->dag, model->k ? "Constrained Lagrangian and energy" : "Lagrangian and energy", same ? 1 : 2,
              (const char *const[]){same ? both : written, "E"}, (const nh_ex[]){model->Lbar, model->E});
    block(p, model->dag, nh_facts_equations(model), model->n, label, model->a);
    if (more) multipliers(p, model);
    nh_free(label);
}

/* Symbols of the equations of motion, the multipliers and the constraint force. */
static double length_of(const nh_model *model)
{
    double length = 0;
    for (size_t i = 0; i < model->n; i++) length += (double)nh_complexity(model->dag, model->a[i]);
    for (size_t a = 0; a < model->k; a++) length += (double)nh_complexity(model->dag, model->mu[a]);
    for (size_t s = 0; s < model->m && model->k; s++) length += (double)nh_complexity(model->dag, model->reaction[s]);
    return length;
}

void nh_pen_system(nh_pen *p, const nh_model *model, const nh_analysis *result)
{
    bool brief = p->ink->brief;
    if (brief && !result) return;
    nh_pen_section(p, "system", "The system");
    if (!brief) written(p, p->of.system);
    if (!model) return;
    if (!brief) nh_pen_heading(p, "As it was understood");
    if (result) kind(p, result);
    equations(p, model, true);
    enum { most_again = 4000 };
    if (!result || !result->question->other) return;
    double again = length_of(result->question->other);
    if (again > most_again && !p->style.verbose) {
        nh_pen_words(p, "In {%s} the equations have %zu symbols: --velocities %s shows them.",
                     result->question->other->chart->name, (size_t)again,
                     result->question->other->chart->quasi ? "quasi" : "coordinates");
        return;
    }
    nh_pen_open(p, NH_PEN_FOLD, NULL, "In the other velocities");
    equations(p, result->question->other, !brief);
    nh_pen_close(p, NH_PEN_FOLD);
}

void nh_pen_geometry(nh_pen *p, nh_arena *arena, const struct nh_theory *t)
{
    if (!t) return;
    nh_pen_section(p, "geometry", "Geometry");
    nh_pen_words(p, "In {%s}, with the numbers of the equations in \u010cech and Musilov\u00e1 (2014).",
                 t->model->chart->name);
    nh_pen_sheet(p, nh_geometry_sheet(arena, t, p->of.analysis));
}
