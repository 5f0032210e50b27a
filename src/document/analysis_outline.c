/* The answer of an analysis, and the order of its sections. */
#include <string.h>

#include "document/analysis.h"
#include "document/screen.h"
#include "document/analysis_internal.h"
#include "document/facts.h"
#include "document/geometry_sheet.h"

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

void nh_analysis_write_meaning(nh_pen *p, const nh_analysis *result, const char *meaning)
{
    static const char of[] = "momentum of ";
    const char *name = strstr(meaning, of);
    if (name) name += sizeof of - 1;
    nh_pen_say(p, "%s", name ? nh_arena_printf(result->arena, "%.*s", (int)(name - meaning), meaning) : meaning);
    if (name) nh_pen_name(p, name);
}

/* The words of the first screen. */
static void answer_of_a_page(nh_pen *p, const nh_analysis *result)
{
    static const char *const class[] = {"found", "none", "undecided", "undecided"};
    nh_text words;
    nh_text_init(&words);
    nh_analysis_answer_headline(result, &words);
    nh_pen_open(p, NH_PEN_ANSWER, class[result->verdict], NULL);
    nh_pen_say(p, "%s", nh_text_string(&words));
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_text_clear(&words);
    if (result->list->count && result->verdict == NH_UNDECIDED)
        nh_pen_words(p, "Not all of them are certified; each card states its certificate.");
    if (result->partial) nh_pen_warning(p, nh_facts_search(result));
    nh_analysis_answer_completeness(result, &words);
    if (words.length) nh_pen_words(p, "%s", nh_text_string(&words));
    nh_text_clear(&words);
    nh_analysis_write_absence_statement(p, result);
}

static void answer_of_details(nh_pen *p, const nh_analysis *result)
{
    const nh_current_list *list = result->list;
    static const char *const verdict[] = {"FOUND", "NONE", "UNDECIDED", "FITTED"};
    nh_text words;
    nh_text_init(&words);
    nh_facts_completeness(result, &words);
    nh_pen_open(p, NH_PEN_ANSWER, NULL, NULL);
    nh_pen_say(p, "%s: ", verdict[result->verdict]);
    if (list->count)
        nh_pen_say(p, "%zu independent current%s of at most %zu", list->independent, plural(list->independent),
                   result->question->local_maximum);
    else if (result->verdict == NH_FOUND) nh_pen_say(p, "%s", nh_facts_between_walls(result));
    else
        nh_pen_say(p, "no current%s %s", list->pieces ? " of all motions" : "",
                   result->verdict == NH_NONE ? "in this ansatz" : "so far");
    nh_pen_say(p, nh_analysis_by_trial(result) ? " (unknowns sought by trial)" : " (search %s)",
               nh_search_word(result->search));
    nh_pen_close(p, NH_PEN_ANSWER);
    if (list->count && result->verdict == NH_UNDECIDED)
        nh_pen_words(p, "Not all of them are certified; each card states its certificate.");
    if (words.length) nh_pen_words(p, "%s", nh_text_string(&words));
    if (nh_analysis_by_trial(result)) nh_pen_words(p, "%s", nh_facts_search(result));
    if (nh_facts_given(result) && !result->stages && result->search == NH_SEARCH_EXHAUSTED)
        nh_pen_words(p,
                     "The ansatz is that of the analysis file. With --no-analysis the program chooses what it tries.");
    nh_text_clear(&words);
}

/* The rate of the energy is a formula. */
static void warning(nh_pen *p, const nh_analysis *result, const char *text)
{
    size_t n = strlen(text), rate = result->energy_rate ? strlen(result->energy_rate) : 0;
    if (!rate || rate > n || strcmp(text + n - rate, result->energy_rate) != 0) {
        nh_pen_warning(p, text);
        return;
    }
    nh_pen_open(p, NH_PEN_WARNING, NULL, NULL);
    nh_pen_say(p, "%s<%s>", nh_arena_printf(result->arena, "%.*s", (int)(n - rate), text), result->energy_rate);
    nh_pen_close(p, NH_PEN_WARNING);
}

static void links(nh_pen *p, const nh_analysis *result)
{
    nh_text sections;
    nh_text_init(&sections);
    nh_text_addf(&sections, "system|System|%scurrents|Currents|%s%s%s%ssearch|%s|words|Words|repeat|Repeat it",
                 result->theory ? "geometry|Geometry|" : "",
                 nh_analysis_has_absence(result) ? "absence|Other integrals|" : "",
                 result->motion ? "explicit|Explicit motion|" : "", result->validation ? "motion|Validation|" : "",
                 result->figures ? "figures|Figures|" : "", result->list->count ? "How it was found" : "The search");
    p->ink->links(p->to, nh_text_string(&sections));
    nh_text_clear(&sections);
}

static void explicit_motion(nh_pen *p, const nh_analysis *result)
{
    nh_sheet *sheet = nh_motion_sheet(result);
    if (!sheet) return;
    sheet->section->title = ""; /* the section of the document has one */
    nh_pen_section(p, "explicit", "Explicit motion");
    nh_pen_sheet(p, sheet);
}

static void as_a_paper(nh_pen *p, const nh_analysis *result)
{
    nh_pen_system(p, result->question->model, result);
    nh_pen_geometry(p, result->arena, result->theory);
    nh_analysis_write_currents(p, result);
    nh_analysis_write_absence(p, result);
    explicit_motion(p, result);
    nh_analysis_write_motion(p, result);
    nh_analysis_write_figures(p, result);
}

/* First what was asked. */
static void on_a_terminal(nh_pen *p, const nh_analysis *result)
{
    nh_analysis_write_currents(p, result);
    nh_analysis_write_absence(p, result);
    nh_analysis_write_motion(p, result);
    nh_pen_system(p, result->question->model, result);
    explicit_motion(p, result);
    nh_pen_geometry(p, result->arena, result->theory);
}

void nh_analysis_write(const nh_analysis *result, nh_pen_style style, nh_text *out)
{
    const nh_options *options = &result->question->options;
    if (nh_screen_is_wanted(style) && !result->theory) {
        nh_analysis_write_answer(result, style.colour, out);
        return;
    }
    nh_pen pen, *p = &pen;
    nh_run run = {result->question->command,
                  result->question->system_path,
                  result->question->analysis_path,
                  options->seed,
                  options->shown,
                  result->timing.total,
                  result->question->system_words};
    const nh_chart *chart = result->question->other && result->question->other->chart->roots
                                ? result->question->other->chart
                                : result->question->model->chart;
    nh_pen_subject subject = {.system = result->question->system,
                              .analysis = result->question->analysis,
                              .dag = result->question->model->dag,
                              .chart = chart,
                              .shown = options->shown,
                              .written = options->written};
    nh_pen_begin(p, style, &subject, NULL, out);
    if (p->ink->brief) answer_of_details(p, result);
    else answer_of_a_page(p, result);
    nh_stage *stage = p->ink->stage ? nh_analysis_stage(result, &run) : NULL;
    if (stage) p->ink->stage(p->to, stage);
    links(p, result);
    for (size_t i = 0; i < result->warnings; i++) warning(p, result, result->warning[i]);
    if (p->ink->brief) on_a_terminal(p, result);
    else as_a_paper(p, result);
    nh_analysis_write_search(p, result);
    static const char words[] = "current, symmetry, case, distribution, projectable, independent, local, residual, "
                                "drift, gap, multiplier, nonholonomic, growth";
    nh_pen_glossary(p, !nh_analysis_has_absence(result)
                           ? words
                           : nh_arena_printf(result->arena,
                                             "%s, no other integral, meromorphic, invariant plane, "
                                             "normal variational equation, Galois group",
                                             words));
    nh_pen_end(p, &run);
    nh_stage_free(stage);
}
