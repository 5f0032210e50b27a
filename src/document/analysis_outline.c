/* The answer of an analysis, and the order of its sections. */
#include <string.h>

#include "document/analysis.h"
#include "document/screen.h"
#include "document/analysis_internal.h"
#include "document/facts.h"
#include "document/geometry_sheet.h"

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

void nh_analysis_write_meaning(nh_pen *p, const nh_analysis *r, const char *meaning)
{
    static const char of[] = "momentum of ";
    const char *name = strstr(meaning, of);
    if (name) name += sizeof of - 1;
    nh_pen_say(p, "%s", name ? nh_arena_printf(r->arena, "%.*s", (int)(name - meaning), meaning) : meaning);
    if (name) nh_pen_name(p, name);
}

/* The words of the first screen. */
static void answer_of_a_page(nh_pen *p, const nh_analysis *r)
{
    static const char *const class[] = {"found", "none", "undecided"};
    nh_text words;
    nh_text_init(&words);
    nh_analysis_answer_headline(r, &words);
    nh_pen_open(p, NH_PEN_ANSWER, class[r->verdict], NULL);
    nh_pen_say(p, "%s", nh_text_string(&words));
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_text_clear(&words);
    if (r->count && r->verdict == NH_UNDECIDED)
        nh_pen_words(p, "Not all of them are certified; each card states its certificate.");
    if (r->partial) nh_pen_warning(p, nh_facts_search(r));
    nh_analysis_answer_completeness(r, &words);
    if (words.length) nh_pen_words(p, "%s", nh_text_string(&words));
    nh_text_clear(&words);
}

static void answer_of_details(nh_pen *p, const nh_analysis *r)
{
    static const char *const verdict[] = {"FOUND", "NONE", "UNDECIDED"};
    nh_text words;
    nh_text_init(&words);
    nh_facts_completeness(r, &words);
    nh_pen_open(p, NH_PEN_ANSWER, NULL, NULL);
    nh_pen_say(p, "%s: ", verdict[r->verdict]);
    if (r->count)
        nh_pen_say(p, "%zu independent current%s of at most %zu", r->independent, plural(r->independent),
                   r->local_maximum);
    else if (r->verdict == NH_FOUND) nh_pen_say(p, "%s", nh_facts_between_walls(r));
    else
        nh_pen_say(p, "no current%s %s", r->pieces ? " of all motions" : "",
                   r->verdict == NH_NONE ? "in this ansatz" : "so far");
    nh_pen_say(p, nh_analysis_by_trial(r) ? " (unknowns sought by trial)" : " (search %s)", nh_search_word(r->search));
    nh_pen_close(p, NH_PEN_ANSWER);
    if (r->count && r->verdict == NH_UNDECIDED)
        nh_pen_words(p, "Not all of them are certified; each card states its certificate.");
    if (words.length) nh_pen_words(p, "%s", nh_text_string(&words));
    if (nh_analysis_by_trial(r)) nh_pen_words(p, "%s", nh_facts_search(r));
    if (nh_facts_given(r) && !r->stages && r->search == NH_SEARCH_EXHAUSTED)
        nh_pen_words(p,
                     "The ansatz is that of the analysis file. With --no-analysis the program chooses what it tries.");
    nh_text_clear(&words);
}

/* The rate of the energy is a formula. */
static void warning(nh_pen *p, const nh_analysis *r, const char *text)
{
    size_t n = strlen(text), rate = r->energy_rate ? strlen(r->energy_rate) : 0;
    if (!rate || rate > n || strcmp(text + n - rate, r->energy_rate) != 0) {
        nh_pen_warning(p, text);
        return;
    }
    nh_pen_open(p, NH_PEN_WARNING, NULL, NULL);
    nh_pen_say(p, "%s<%s>", nh_arena_printf(r->arena, "%.*s", (int)(n - rate), text), r->energy_rate);
    nh_pen_close(p, NH_PEN_WARNING);
}

static void links(nh_pen *p, const nh_analysis *r)
{
    nh_text sections;
    nh_text_init(&sections);
    nh_text_addf(&sections, "system|System|%scurrents|Currents|%s%s%ssearch|%s|words|Words|repeat|Repeat it",
                 r->theory ? "geometry|Geometry|" : "", r->motion ? "explicit|Explicit motion|" : "",
                 r->validation ? "motion|Validation|" : "", r->figures ? "figures|Figures|" : "",
                 r->count ? "How it was found" : "The search");
    p->ink->links(p->to, nh_text_string(&sections));
    nh_text_clear(&sections);
}

static void explicit_motion(nh_pen *p, const nh_analysis *r)
{
    nh_sheet *sheet = nh_motion_sheet(r);
    if (!sheet) return;
    sheet->section->title = ""; /* the section of the document has one */
    nh_pen_section(p, "explicit", "Explicit motion");
    nh_pen_sheet(p, sheet);
}

static void as_a_paper(nh_pen *p, const nh_analysis *r)
{
    nh_pen_system(p, r->model, r);
    nh_pen_geometry(p, r->arena, r->theory);
    nh_analysis_write_currents(p, r);
    explicit_motion(p, r);
    nh_analysis_write_motion(p, r);
    nh_analysis_write_figures(p, r);
}

/* First what was asked. */
static void on_a_terminal(nh_pen *p, const nh_analysis *r)
{
    nh_analysis_write_currents(p, r);
    nh_analysis_write_motion(p, r);
    nh_pen_system(p, r->model, r);
    explicit_motion(p, r);
    nh_pen_geometry(p, r->arena, r->theory);
}

void nh_analysis_write(const nh_analysis *r, nh_pen_style style, nh_text *out)
{
    if (nh_screen_is_wanted(style) && !r->theory) {
        nh_analysis_write_answer(r, style.colour, out);
        return;
    }
    nh_pen pen, *p = &pen;
    nh_run run = {r->command,       r->system_path,  r->analysis_path, r->options.seed,
                  r->options.shown, r->timing.total, r->system_words};
    const nh_chart *chart = r->other && r->other->chart->roots ? r->other->chart : r->model->chart;
    nh_pen_subject subject = {.system = r->system,
                              .analysis = r->analysis,
                              .dag = r->model->dag,
                              .chart = chart,
                              .shown = r->options.shown,
                              .written = r->options.written};
    nh_pen_begin(p, style, &subject, NULL, out);
    if (p->ink->brief) answer_of_details(p, r);
    else answer_of_a_page(p, r);
    nh_stage *stage = p->ink->stage ? nh_analysis_stage(r, &run) : NULL;
    if (stage) p->ink->stage(p->to, stage);
    links(p, r);
    for (size_t i = 0; i < r->warnings; i++) warning(p, r, r->warning[i]);
    if (p->ink->brief) on_a_terminal(p, r);
    else as_a_paper(p, r);
    nh_analysis_write_search(p, r);
    nh_pen_glossary(
        p, "current, symmetry, case, distribution, projectable, independent, local, residual, drift, gap, multiplier, "
           "nonholonomic, growth");
    nh_pen_end(p, &run);
    nh_stage_free(stage);
}
