#include <stdio.h>

#include "base/versions.h"
#include "expr/print.h"
#include "report/html_internal.h"

/* ---- as it was written ---- */

static void parameters(nh_html_writer *w)
{
    const nh_system *s = w->r->system;
    if (!s->parameters) return;
    nh_html_add(w, "<div class=\"wide\"><table><caption>Parameters</caption><thead><tr><th scope=\"col\">name</th><th scope=\"col\">value</th><th scope=\"col\">meaning</th></tr></thead><tbody>\n");
    for (size_t i = 0; i < s->parameters; i++) {
        const nh_parameter *p = &s->parameter[i];
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_html_source(w, p->name);
        nh_html_add(w, "</th><td>");
        nh_html_number(w, p->value, 10);
        nh_html_add(w, " ");
        if (p->unit) nh_html_text(w, p->unit);
        nh_html_add(w, "</td><td>");
        if (p->doc) nh_html_text(w, p->doc);
        nh_html_add(w, "</td></tr>\n");
    }
    nh_html_add(w, "</tbody></table></div>\n");
}

static void coordinates(nh_html_writer *w)
{
    static const char *const types[] = {"angle", "length", "number"};
    const nh_system *s = w->r->system;
    nh_html_add(w, "<div class=\"wide\"><table><caption>Coordinates</caption><thead><tr><th scope=\"col\">name</th><th scope=\"col\">type</th><th scope=\"col\">meaning</th></tr></thead><tbody>\n");
    for (size_t i = 0; i < s->coordinates; i++) {
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_html_source(w, s->coordinate[i].name);
        nh_text_addf(w->out, "</th><td>%s</td><td>", types[s->coordinate[i].type]);
        if (s->coordinate[i].doc) nh_html_text(w, s->coordinate[i].doc);
        nh_html_add(w, "</td></tr>\n");
    }
    nh_html_add(w, "</tbody></table></div>\n");
}

static void written(nh_html_writer *w)
{
    const nh_system *s = w->r->system;
    const nh_deck_node *node = s->deck ? nh_deck_get(nh_deck_root(s->deck), "lagrangian") : NULL;
    nh_html_add(w, "<h3>As it was written</h3>\n");
    parameters(w);
    coordinates(w);
    for (size_t i = 0; i < s->definitions; i++) {
        nh_html_add(w, "<div class=\"formula\">");
        nh_html_source(w, s->definition[i].text);
        nh_html_add(w, "</div>\n");
    }
    if (node && node->kind == NH_DECK_SCALAR && !s->chain) {
        nh_html_add(w, "<p>Lagrangian</p>\n<div class=\"formula\"><math xmlns=\"http://www.w3.org/1998/Math/MathML\"><mi>L</mi><mo>=</mo></math> ");
        nh_html_source(w, node->text);
        nh_html_add(w, "</div>\n");
    } else {
        nh_html_add(w, s->chain ? "<p>Lagrangian, of the bodies and joints in the file</p>\n" : "<p>Lagrangian</p>\n");
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
    const nh_result *r = w->r;
    const nh_distribution *d = &r->constraint;
    nh_html_add(w, "<p>");
    nh_html_count(w, r->model->m);
    nh_html_add(w, r->model->m == 1 ? " coordinate, " : " coordinates, ");
    if (r->model->k) {
        nh_html_count(w, r->model->k);
        nh_text_addf(w->out, " %s constraint%s: %s%s%s", nh_constraint_type_name(d->type), r->model->k == 1 ? "" : "s", nh_constraint_integrability(r->model, d),
                     d->semiholonomic && !d->holonomic ? ", semiholonomic" : "", d->rheonomic ? ", time-dependent" : "");
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
    nh_html_add(w, ".</p>\n");
}

static void multipliers(nh_html_writer *w, const nh_model *o)
{
    char label[200];
    if (!o->k) return;
    nh_html_add(w, "<p>Chetaev multipliers, and the force of the constraints</p>\n");
    for (size_t a = 0; a < o->k; a++) {
        snprintf(label, sizeof label, o->k == 1 ? "mu" : "mu_%zu", a + 1);
        nh_html_formula(w, label, o->mu[a]);
    }
    for (size_t s = 0; s < o->m; s++) {
        snprintf(label, sizeof label, "F_%.180s", o->system->coordinate[s].name);
        nh_html_formula(w, label, o->reaction[s]);
    }
}

static void chart(nh_html_writer *w, const nh_model *o)
{
    char label[200];
    nh_html_add(w, "<h4>In ");
    nh_html_text(w, o->chart->name);
    nh_html_add(w, "</h4>\n<p>Constrained Lagrangian and energy</p>\n");
    nh_html_formula(w, "L", o->Lbar);
    nh_html_formula(w, "E", o->E);
    nh_html_add(w, "<p>Reduced equations</p>\n");
    for (size_t i = 0; i < o->n; i++) {
        snprintf(label, sizeof label, "%.180s'", nh_name_of(o->dag, o->chart->w[i]));
        nh_html_formula(w, label, o->a[i]);
    }
    multipliers(w, o);
}

void nh_html_system(nh_html_writer *w)
{
    nh_html_add(w, "<section id=\"system\"><h2>The system</h2>\n");
    written(w);
    nh_html_add(w, "<h3>As it was understood</h3>\n");
    kind(w);
    chart(w, w->r->model);
    if (w->r->other) {
        nh_html_add(w, "<details><summary>The same in the other chart</summary>\n");
        chart(w, w->r->other);
        nh_html_add(w, "</details>\n");
    }
    nh_html_add(w, "</section>\n");
}

/* ---- to repeat it ---- */

static void row(nh_html_writer *w, const char *what, const char *value)
{
    if (!value) return;
    nh_html_add(w, "<tr>");
    nh_text_addf(w->out, "<th scope=\"row\">%s</th><td><code>", what);
    nh_html_text(w, value);
    nh_html_add(w, "</code></td></tr>\n");
}

void nh_html_repeat(nh_html_writer *w)
{
    const nh_result *r = w->r;
    nh_html_add(w, "<section id=\"repeat\"><h2>Repeat it</h2>\n<div class=\"wide\"><table><tbody>\n");
    row(w, "command", r->command);
    row(w, "program", "nhsym " NH_VERSION);
    row(w, "system file", r->system_path);
    row(w, "analysis file", r->analysis_path);
    nh_html_add(w, "<tr><th scope=\"row\">seed</th><td>");
    nh_html_number(w, r->options.seed, 17);
    nh_html_add(w, "</td></tr>\n");
    for (size_t i = 0; nh_version_of(i).name; i++) row(w, nh_version_of(i).name, nh_version_of(i).version);
    row(w, "machine", nh_versions_machine());
    nh_html_add(w, "<tr><th scope=\"row\">time</th><td>");
    nh_html_number(w, r->timing.total, 3);
    nh_html_add(w, " s</td></tr>\n</tbody></table></div></section>\n");
}
