#include "document/shown.h"

#include <stdio.h>
#include <string.h>

#include "base/json.h"
#include "document/geometry_sheet.h"
#include "document/provenance.h"
#include "document/screen.h"
#include "graph/measure.h"
#include "graph/node.h"

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

/* "3 coordinates: phi, x, y. 1 constraint. 2 independent velocities: omega, v." */
static void answer(nh_pen *p, const nh_shown *s)
{
    const nh_model *model = s->model;
    nh_pen_open(p, NH_PEN_ANSWER, "found", NULL);
    nh_pen_say(p, "%zu coordinate%s: ", model->m, plural(model->m));
    for (size_t i = 0; i < model->m; i++) nh_pen_say(p, i ? ", <%s>" : "<%s>", s->system->coordinate[i].name);
    if (model->k) nh_pen_say(p, ". %zu constraint%s", model->k, plural(model->k));
    else nh_pen_say(p, ". No constraints");
    nh_pen_say(p, ". %zu independent velocit%s: ", model->n, model->n == 1 ? "y" : "ies");
    for (size_t l = 0; l < model->n; l++)
        nh_pen_say(p, l ? ", <%s>" : "<%s>", nh_name_of(model->dag, model->chart->w[l]));
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_ANSWER);
}

static void constraints(nh_pen *p, const nh_shown *s)
{
    if (!s->system->constraints) return;
    nh_pen_heading(p, "Constraints");
    for (size_t i = 0; i < s->system->constraints; i++) p->ink->equation(p->to, "", s->system->constraint[i].text);
}

static nh_pen_subject subject(const nh_shown *s, const nh_run *run)
{
    return (nh_pen_subject){
        .system = s->system, .dag = s->model->dag, .chart = s->model->chart, .shown = run ? run->shown : 0};
}

static nh_sheet *overview(const nh_shown *s) { return nh_geometry_overview(s->arena, s->model, &s->options); }

/* ---- the first screen ---- */

/* With these sections of the sheet: bit i is section i. */
static void put_screen(const nh_shown *s, const nh_run *run, nh_pen_style style, const nh_sheet *all, unsigned sections,
                       bool system, nh_text *out)
{
    nh_pen pen, *p = &pen;
    nh_pen_subject of = subject(s, run);
    nh_sheet some = *all;
    some.section = nh_arena_alloc(s->arena, (all->sections + 1) * sizeof *some.section);
    some.sections = 0;
    for (size_t i = 0; i < all->sections; i++)
        if (sections >> i & 1) some.section[some.sections++] = all->section[i];
    nh_pen_begin(p, style, &of, "geometry", out);
    answer(p, s);
    if (system) constraints(p, s);
    nh_pen_sheet(p, &some);
    nh_pen_end(p, NULL);
}

/* Formulas that are longer than a screen need not be written to see that. */
static bool may_fit(const nh_sheet *s, const nh_sheet_section *c)
{
    enum { most = 80 * NH_SCREEN_LINES };
    double length = 0;
    for (size_t i = 0; i < c->lines; i++)
        for (size_t j = 0; j < c->line[i].left + c->line[i].right; j++)
            length += (double)nh_complexity(s->dag, c->line[i].term[j].coefficient);
    return length <= most;
}

/* The sections that fit, the more important ones first; the others are named. */
static void first_screen(const nh_shown *s, const nh_run *run, nh_pen_style style, nh_text *out)
{
    static const unsigned order[] = {NH_OVERVIEW_VELOCITIES, NH_OVERVIEW_EQUATIONS, NH_OVERVIEW_LAGRANGIAN,
                                     NH_OVERVIEW_FIELDS,     NH_OVERVIEW_FORCES,    NH_OVERVIEW_INERTIA,
                                     NH_OVERVIEW_MULTIPLIERS};
    enum { tail = 6 }; /* lines: what is too long, and how to see it */
    unsigned sections = 0;
    nh_sheet *all = overview(s);
    nh_text left, text;
    bool system = true;
    nh_text_init(&left);
    nh_text_init(&text);
    for (size_t i = 0; i <= sizeof order / sizeof *order; i++) {
        const nh_sheet_section *c = i ? &all->section[order[i - 1]] : NULL;
        bool fits = !c || may_fit(all, c);
        if (c && !c->lines) continue;
        if (fits) put_screen(s, run, style, all, sections | (c ? 1u << order[i - 1] : 0), system, &text);
        fits = fits && nh_screen_count(nh_text_string(&text)) + tail <= NH_SCREEN_LINES;
        if (!fits)
            nh_text_addf(&left, "%s%s",
                         left.length ? ", " : "Too long for this screen: ", c ? c->title : "Constraints");
        else if (c) sections |= 1u << order[i - 1];
        if (!c) system = fits;
        nh_text_clear(&text);
    }
    put_screen(s, run, style, all, sections, system, out);
    if (left.length) nh_text_add(out, "\n"), nh_text_add(&left, "."), nh_screen_say(out, 0, &left);
    nh_screen_more(out, "forms, Euler expressions, equations of symmetries, multipliers",
                   s->model->chart->quasi && s->model->k ? "--velocities coordinates   the same in them" : NULL);
}

/* ---- the whole ---- */

void nh_shown_write(nh_shown *s, const nh_run *run, nh_pen_style style, nh_text *out)
{
    if (nh_screen_is_wanted(style)) {
        first_screen(s, run, style, out);
        return;
    }
    nh_shown_complete(s);
    nh_pen pen, *p = &pen;
    nh_pen_subject of = subject(s, run);
    nh_pen_begin(p, style, &of, "geometry", out);
    answer(p, s);
    p->ink->links(p->to, s->other
                             ? "system|System|overview|Overview|quasi|Quasi-velocities|geometry|Geometry|words|Words|"
                               "repeat|Repeat it"
                             : "system|System|overview|Overview|geometry|Geometry|words|Words|repeat|Repeat it");
    nh_pen_system(p, s->model, NULL);
    nh_pen_section(p, "overview", "Overview");
    if (p->ink->brief) {
        constraints(p, s);
        nh_pen_heading(p, "Lagrangian, in all velocities");
        nh_pen_formula(p, "L", s->system->lagrangian);
    }
    nh_pen_sheet(p, overview(s));
    if (s->other) {
        nh_pen_section(p, "quasi", "Geometry in quasi-velocities");
        nh_pen_words(p, "In {%s}.", s->model->chart->name);
        nh_pen_sheet(p, nh_geometry_sheet(s->arena, s->own, NULL));
    }
    nh_pen_geometry(p, s->arena, s->theory);
    nh_pen_glossary(p, "distribution, current, symmetry");
    nh_pen_end(p, run);
}

/* ---- JSON ---- */

char *nh_shown_json(nh_shown *s, const nh_run *run)
{
    const nh_model *model = s->model;
    nh_shown_complete(s);
    nh_json *root = nh_json_object(), *list;
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", s->system->name);
    list = nh_json_put_array(root, "coordinates");
    for (size_t i = 0; i < model->m; i++) nh_json_add_text(list, s->system->coordinate[i].name);
    list = nh_json_put_array(root, "constraints");
    for (size_t i = 0; i < s->system->constraints; i++) nh_json_add_text(list, s->system->constraint[i].text);
    list = nh_json_put_array(root, "velocities");
    for (size_t l = 0; l < model->n; l++) nh_json_add_text(list, nh_name_of(model->dag, model->chart->w[l]));
    nh_sheet_json(overview(s), nh_json_put_object(root, "overview"));
    if (s->other) nh_geometry_json(s->arena, s->own, NULL, root, "in_quasi_velocities");
    else nh_json_put_null(root, "in_quasi_velocities");
    nh_geometry_json(s->arena, s->theory, NULL, root, "equations");
    if (run) nh_run_json(run, s->system, root);
    return nh_json_finish(root);
}
