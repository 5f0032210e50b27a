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

static void parameters(nh_pen *p, const nh_system *s)
{
    if (!s->parameters) return;
    bool said = false; /* a column of meanings only where a meaning is given */
    for (size_t i = 0; i < s->parameters; i++) said |= *or_nothing(s->parameter[i].doc) != 0;
    nh_pen_table(p, "Parameters", said ? "name|value|meaning" : "name|value");
    for (size_t i = 0; i < s->parameters; i++) {
        const nh_parameter *a = &s->parameter[i];
        const char *doc = or_nothing(a->doc);
        if (nh_pen_is_open(&p->of, a->name)) nh_pen_row(p, said ? "#<%s>|any|%s" : "#<%s>|any%s", a->name, doc);
        else
            nh_pen_row(p, said ? "#<%s>|%.10g %s|%s" : "#<%s>|%.10g %s%s", a->name, a->value, or_nothing(a->unit), doc);
    }
    nh_pen_table_end(p);
}

static void coordinates(nh_pen *p, const nh_system *s)
{
    static const char *const types[] = {"angle", "length", "number"};
    bool said = false;
    for (size_t i = 0; i < s->coordinates; i++) said |= *or_nothing(s->coordinate[i].doc) != 0;
    nh_pen_table(p, "Coordinates", said ? "name|type|meaning" : "name|type");
    for (size_t i = 0; i < s->coordinates; i++) {
        const nh_coordinate *q = &s->coordinate[i];
        const char *unit = or_nothing(q->unit);
        nh_pen_row(p, said ? "#<%s>|%s%s%s|%s" : "#<%s>|%s%s%s%s", q->name, types[q->type], *unit ? " / " : "", unit,
                   or_nothing(q->doc));
    }
    nh_pen_table_end(p);
}

static void forces(nh_pen *p, const nh_system *s)
{
    bool said = false;
    for (size_t i = 0; i < s->coordinates && s->has_forces; i++) {
        char label[200];
        if (nh_is_zero(s->dag, s->force[i])) continue;
        if (!said) nh_pen_words(p, "Generalized forces");
        said = true;
        snprintf(label, sizeof label, "Q_%.180s", s->coordinate[i].name);
        nh_pen_formula(p, label, s->force[i]);
    }
}

static void written(nh_pen *p, const nh_system *s)
{
    const nh_deck_node *node = s->deck ? nh_deck_get(nh_deck_root(s->deck), "lagrangian") : NULL;
    nh_pen_heading(p, "System file");
    parameters(p, s);
    coordinates(p, s);
    for (size_t i = 0; i < s->definitions; i++) p->ink->equation(p->to, "", s->definition[i].text);
    nh_pen_words(p, s->chain ? "Lagrangian, from the bodies and joints of the system file" : "Lagrangian");
    if (node && node->kind == NH_DECK_SCALAR && !s->chain) p->ink->equation(p->to, "L", node->text);
    else nh_pen_formula(p, "L", s->lagrangian);
    if (s->constraints) nh_pen_words(p, "Constraints");
    for (size_t i = 0; i < s->constraints; i++) p->ink->equation(p->to, "", s->constraint[i].text);
    forces(p, s);
}

/* ---- as the program understood it ---- */

/* The functions that the constraints alone keep constant. */
static void integrals(nh_pen *p, const nh_analysis *r)
{
    size_t hidden = r->constraint.hidden, left = hidden - r->integrals;
    if (!hidden) return;
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "%zu %s%s: ", hidden, r->constraint.holonomic ? "integral" : "hidden holonomic constraint",
               hidden == 1 ? "" : "s");
    for (size_t i = 0; i < r->integrals; i++) {
        const nh_current *f = &r->found[r->integral[i]];
        nh_pen_say(p, "%s", i ? ", " : "");
        nh_pen_say(p, "<%s> = const%s", f->name, f->local ? " (local)" : "");
    }
    if (left) nh_pen_say(p, "%s%zu without a closed form in this ansatz", r->integrals ? ", and " : "", left);
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
}

static void kind(nh_pen *p, const nh_analysis *r)
{
    nh_text words;
    nh_text_init(&words);
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "%zu coordinate%s, ", r->model->m, r->model->m == 1 ? "" : "s");
    if (r->model->k) {
        nh_facts_constraint(r, &words);
        nh_pen_say(p, "%zu %s", r->model->k, nh_text_string(&words));
    } else {
        nh_pen_say(p, "no constraints");
    }
    nh_pen_say(p, ". Constraint submanifold of dimension %zu.", 1 + r->model->m + r->model->n);
    nh_text_clear(&words);
    nh_facts_branch(r, &words);
    if (words.length) nh_pen_say(p, " Everything was %s.", nh_text_string(&words));
    nh_text_clear(&words);
    nh_pen_close(p, NH_PEN_WORDS);
    integrals(p, r);
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
static void multipliers(nh_pen *p, const nh_model *o)
{
    if (!o->k) return;
    const char **label = nh_alloc_array(o->k + o->m, sizeof *label);
    nh_ex *e = nh_alloc_array(o->k + o->m, sizeof *e);
    for (size_t a = 0; a < o->k; a++) {
        label[a] = o->k == 1 ? "mu" : nh_arena_printf(o->arena, "mu_%zu", a + 1);
        e[a] = o->mu[a];
    }
    for (size_t s = 0; s < o->m; s++) {
        label[o->k + s] = nh_arena_printf(o->arena, "F_%s", o->system->coordinate[s].name);
        e[o->k + s] = o->reaction[s];
    }
    for (size_t a = 0; a < o->k && (p->ink->brief || o->k > 1); a++)
        nh_pen_words(p, "<%s> is the multiplier of <%s>.", label[a], o->system->constraint[a].text);
    if (p->ink->brief) block(p, o->dag, "Chetaev multipliers", o->k, label, e);
    else block(p, o->dag, "Chetaev multipliers and constraint force", o->k + o->m, label, e);
    nh_free(e);
    nh_free(label);
}

/* "x' = v*cos(phi)": what the quasi-velocities mean. */
static void velocities(nh_pen *p, const nh_model *o)
{
    if (!o->chart->quasi || o->framed) return;
    const char **label = nh_alloc_array(o->m + 1, sizeof *label);
    for (size_t s = 0; s < o->m; s++) label[s] = nh_arena_printf(o->arena, "%s'", o->system->coordinate[s].name);
    block(p, o->dag, "Velocities", o->m, label, o->rho);
    nh_free(label);
}

static void equations(nh_pen *p, const nh_model *o, bool more)
{
    bool same = o->Lbar == o->E; /* no potential */
    const char *const written = o->k ? "\\bar{L}" : "L";
    const char *const both = nh_arena_printf(o->arena, "%s = E", written);
    const char **label = nh_alloc_array(o->n + 1, sizeof *label);
    for (size_t i = 0; i < o->n; i++) label[i] = nh_arena_printf(o->arena, "%s'", nh_name_of(o->dag, o->chart->w[i]));
    nh_pen_open(p, NH_PEN_SUBHEADING, NULL, NULL);
    nh_pen_say(p, "In {%s}", o->chart->name);
    nh_pen_close(p, NH_PEN_SUBHEADING);
    velocities(p, o);
    if (!p->ink->brief)
        block(p, o->dag, o->k ? "Constrained Lagrangian and energy" : "Lagrangian and energy", same ? 1 : 2,
              (const char *const[]){same ? both : written, "E"}, (const nh_ex[]){o->Lbar, o->E});
    block(p, o->dag, nh_facts_equations(o), o->n, label, o->a);
    if (more) multipliers(p, o);
    nh_free(label);
}

/* Symbols of the equations of motion, the multipliers and the constraint force. */
static double length_of(const nh_model *o)
{
    double length = 0;
    for (size_t i = 0; i < o->n; i++) length += (double)nh_complexity(o->dag, o->a[i]);
    for (size_t a = 0; a < o->k; a++) length += (double)nh_complexity(o->dag, o->mu[a]);
    for (size_t s = 0; s < o->m && o->k; s++) length += (double)nh_complexity(o->dag, o->reaction[s]);
    return length;
}

void nh_pen_system(nh_pen *p, const nh_model *model, const nh_analysis *r)
{
    bool brief = p->ink->brief;
    if (brief && !r) return;
    nh_pen_section(p, "system", "The system");
    if (!brief) written(p, p->of.system);
    if (!model) return;
    if (!brief) nh_pen_heading(p, "As it was understood");
    if (r) kind(p, r);
    equations(p, model, true);
    enum { most_again = 4000 };
    if (!r || !r->other) return;
    double again = length_of(r->other);
    if (again > most_again && !p->style.verbose) {
        nh_pen_words(p, "In {%s} the equations have %zu symbols: --velocities %s shows them.", r->other->chart->name,
                     (size_t)again, r->other->chart->quasi ? "quasi" : "coordinates");
        return;
    }
    nh_pen_open(p, NH_PEN_FOLD, NULL, "In the other velocities");
    equations(p, r->other, !brief);
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
