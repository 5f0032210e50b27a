#include <stdio.h>

#include "base/memory.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/html_internal.h"

/* ---- as it was written ---- */

static void parameters(nh_html_writer *w)
{
    const nh_system *s = w->system;
    if (!s->parameters) return;
    nh_html_table(w, "Parameters", "name|value|meaning");
    for (size_t i = 0; i < s->parameters; i++) {
        const nh_parameter *p = &s->parameter[i];
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_html_source(w, p->name);
        nh_html_add(w, "</th><td>");
        nh_html_number(w, p->value, 10);
        nh_html_add(w, " ");
        if (p->unit) nh_html_prose(w, p->unit);
        nh_html_add(w, "</td><td>");
        if (p->doc) nh_html_prose(w, p->doc);
        nh_html_add(w, "</td></tr>\n");
    }
    nh_html_table_end(w);
}

static void coordinates(nh_html_writer *w)
{
    static const char *const types[] = {"angle", "length", "number"};
    const nh_system *s = w->system;
    nh_html_table(w, "Coordinates", "name|type|meaning");
    for (size_t i = 0; i < s->coordinates; i++) {
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_html_source(w, s->coordinate[i].name);
        nh_text_addf(w->out, "</th><td>%s", types[s->coordinate[i].type]);
        if (s->coordinate[i].unit && s->coordinate[i].unit[0]) nh_html_add(w, " / "), nh_html_prose(w, s->coordinate[i].unit);
        nh_html_add(w, "</td><td>");
        if (s->coordinate[i].doc) nh_html_prose(w, s->coordinate[i].doc);
        nh_html_add(w, "</td></tr>\n");
    }
    nh_html_table_end(w);
}

void nh_html_written(nh_html_writer *w)
{
    const nh_system *s = w->system;
    const nh_deck_node *node = s->deck ? nh_deck_get(nh_deck_root(s->deck), "lagrangian") : NULL;
    nh_html_add(w, "<h3>System file</h3>\n");
    w->names = 0;
    parameters(w);
    coordinates(w);
    for (size_t i = 0; i < s->definitions; i++) {
        nh_html_add(w, "<div class=\"formula\">");
        nh_html_source(w, s->definition[i].text);
        nh_html_add(w, "</div>\n");
    }
    if (node && node->kind == NH_DECK_SCALAR && !s->chain) {
        nh_html_add(w, "<p>Lagrangian</p>\n<div class=\"formula\"><math><mi>L</mi><mo>=</mo></math> ");
        nh_html_source(w, node->text);
        nh_html_add(w, "</div>\n");
    } else {
        nh_html_add(w, s->chain ? "<p>Lagrangian, from the bodies and joints of the system file</p>\n" : "<p>Lagrangian</p>\n");
        nh_html_formula(w, "L", s->lagrangian);
    }
    if (s->constraints) nh_html_add(w, "<p>Constraints</p>\n");
    for (size_t i = 0; i < s->constraints; i++) {
        nh_html_add(w, "<div class=\"formula\">");
        nh_html_source(w, s->constraint[i].text);
        nh_html_add(w, "</div>\n");
    }
    for (size_t i = 0; i < s->coordinates && s->has_forces; i++) {
        char label[200];
        if (nh_is_zero(s->dag, s->force[i])) continue;
        snprintf(label, sizeof label, "Q_%.180s", s->coordinate[i].name);
        nh_html_add(w, "<p>Generalized force</p>\n");
        nh_html_formula(w, label, s->force[i]);
    }
}

/* ---- as it was understood ---- */

static void growth(nh_html_writer *w, size_t n, const size_t *rank)
{
    for (size_t i = 0; i < n; i++) {
        if (i) nh_html_add(w, ", ");
        nh_html_count(w, rank[i]);
    }
}

static void kind(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    const nh_distribution *d = &r->constraint;
    nh_html_add(w, "<p>");
    nh_html_count(w, r->model->m);
    nh_html_add(w, r->model->m == 1 ? " coordinate, " : " coordinates, ");
    if (r->model->k) {
        nh_html_count(w, r->model->k);
        nh_text_addf(w->out, " %s%s constraint%s: %s%s", d->type == NH_NONLINEAR && d->homogeneous ? "homogeneous " : "", nh_constraint_type_name(d->type), r->model->k == 1 ? "" : "s", nh_constraint_integrability(r->model, d),
                     d->rheonomic ? ", time-dependent" : "");
        if (d->growth.length > 1) {
            nh_html_add(w, "; growth vector (");
            growth(w, d->growth.length, d->growth.rank);
            nh_html_add(w, d->growth.proved ? ")" : "), by numbers");
        }
    } else {
        nh_html_add(w, "no constraints");
    }
    nh_html_add(w, ". Constraint submanifold of dimension ");
    nh_html_count(w, 1 + r->model->m + r->model->n);
    nh_html_add(w, ".");
    if (r->branch) {
        nh_text words;
        nh_text_init(&words);
        nh_facts_branch(r, &words);
        nh_html_add(w, " Everything was ");
        nh_html_text(w, nh_text_string(&words));
        nh_html_add(w, ".");
        nh_text_clear(&words);
    }
    nh_html_add(w, "</p>\n");
}

/* "mu", or "mu_1", ...; "F_x"; "x'": n labels in one block. */
typedef struct {
    size_t count;
    char (*text)[200];
    const char **label;
    nh_ex *e;
} formulas;

static formulas formulas_create(size_t most)
{
    return (formulas){0, nh_alloc_array(most + 1, sizeof(char[200])), nh_alloc_array(most + 1, sizeof(char *)), nh_alloc_array(most + 1, sizeof(nh_ex))};
}

static char *formulas_add(formulas *f, nh_ex e)
{
    f->label[f->count] = f->text[f->count];
    f->e[f->count] = e;
    return f->text[f->count++];
}

/* Formulas under a heading; folded away when they are many lines long: then they are there to be looked up. */
static void formulas_write(nh_html_writer *w, const char *heading, formulas *f)
{
    enum { long_block = 400 };
    double length = 0;
    for (size_t i = 0; i < f->count; i++) length += (double)nh_complexity(w->dag, f->e[i]);
    nh_text_addf(w->out, length > long_block ? "<details><summary>%s</summary>\n" : "<p>%s</p>\n", heading);
    nh_html_formulas(w, f->count, f->label, f->e);
    if (length > long_block) nh_html_add(w, "</details>\n");
    nh_free(f->text);
    nh_free(f->label);
    nh_free(f->e);
}

static void multipliers(nh_html_writer *w, const nh_model *o)
{
    if (!o->k) return;
    formulas f = formulas_create(o->k + o->m);
    for (size_t a = 0; a < o->k; a++) snprintf(formulas_add(&f, o->mu[a]), sizeof *f.text, o->k == 1 ? "mu" : "mu_%zu", a + 1);
    for (size_t s = 0; s < o->m; s++) snprintf(formulas_add(&f, o->reaction[s]), sizeof *f.text, "F_%.180s", o->system->coordinate[s].name);
    formulas_write(w, "Chetaev multipliers and constraint force", &f);
}

void nh_html_equations(nh_html_writer *w, const nh_model *o)
{
    w->names = 0;
    nh_html_add(w, "<h4>In ");
    nh_html_chart_name(w, o->chart->name);
    nh_html_add(w, "</h4>\n");
    formulas f = formulas_create(2);
    snprintf(formulas_add(&f, o->Lbar), sizeof *f.text, "L");
    snprintf(formulas_add(&f, o->E), sizeof *f.text, "E");
    formulas_write(w, "Constrained Lagrangian and energy", &f);
    f = formulas_create(o->n);
    for (size_t i = 0; i < o->n; i++) snprintf(formulas_add(&f, o->a[i]), sizeof *f.text, "%.180s'", nh_name_of(o->dag, o->chart->w[i]));
    formulas_write(w, nh_facts_equations(o), &f);
    multipliers(w, o);
}

void nh_html_system(nh_html_writer *w)
{
    nh_html_add(w, "<section id=\"system\"><h2>The system</h2>\n");
    nh_html_written(w);
    nh_html_add(w, "<h3>As it was understood</h3>\n");
    kind(w);
    nh_html_equations(w, w->r->model);
    if (w->r->other) {
        nh_html_add(w, "<details><summary>In the other velocities</summary>\n");
        nh_html_equations(w, w->r->other);
        nh_html_add(w, "</details>\n");
    }
    nh_html_add(w, "</section>\n");
}
