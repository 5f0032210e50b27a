/* The classification as a page. */
#include <math.h>

#include "base/memory.h"
#include "document/classification_internal.h"
#include "document/html_internal.h"

typedef struct {
    nh_html_writer w;
    bool section, card;      /* that are open */
} page;

static void end_card(page *p)
{
    if (p->card) nh_html_add(&p->w, "</article>\n");
    p->card = false;
}

static void end_section(page *p)
{
    end_card(p);
    if (p->section) nh_html_add(&p->w, "</section>\n");
    p->section = false;
}

static void section(void *to, const char *id, const char *title)
{
    page *p = to;
    end_section(p);
    nh_text_addf(p->w.out, "<section id=\"%s\"><h2>%s</h2>\n", id, title);
    p->section = true;
}

static void item(void *to, const char *title)
{
    page *p = to;
    end_card(p);
    nh_html_add(&p->w, "<article class=\"card\"><h3>");
    nh_html_prose(&p->w, title);
    nh_html_add(&p->w, "</h3>\n");
    p->card = true;
}

static void words(void *to, const char *text)
{
    page *p = to;
    nh_html_add(&p->w, "<p>");
    nh_html_prose(&p->w, text);
    nh_html_add(&p->w, "</p>\n");
}

static void formula(void *to, const char *label, const char *text)
{
    page *p = to;
    nh_html_add(&p->w, "<div class=\"formula\">");
    nh_html_name(&p->w, label);
    nh_html_add(&p->w, " <math><mo>=</mo></math> ");
    nh_html_source(&p->w, text);
    nh_html_add(&p->w, "</div>\n");
}

static void plot(void *to, nh_plot *figure, const char *caption)
{
    page *p = to;
    nh_html_figure(&p->w, figure, caption);
}

void nh_html_classification(const nh_classified *line, const nh_classified_plane *plane, const nh_run *run, nh_text *out)
{
    const nh_analysis *r = (plane ? plane->family : line)->almost_all;
    page p = {.w = {.out = out, .system = r->system, .dag = r->model->dag, .chart = r->model->chart,
                    .shown = run->shown, .written = INFINITY}};
    nh_classification_pen pen = {&p, section, item, words, formula, plot};
    nh_text answer;
    nh_text_init(&answer);
    nh_html_begin(&p.w, "classification");
    nh_classification_answer(line, plane, &answer);
    nh_html_add(&p.w, "<p class=\"answer found\">");
    nh_html_text(&p.w, nh_text_string(&answer));
    nh_html_add(&p.w, "</p>\n");
    nh_text_clear(&answer);
    nh_html_links(&p.w, plane ? "picture|The plane|almost|For almost all values|excluded|What is excluded|system|System|words|Words|repeat|Repeat it"
                  : "almost|For almost all values|excluded|What is excluded|system|System|words|Words|repeat|Repeat it");
    nh_classification_outline(line, plane, &pen);
    end_section(&p);
    nh_html_add(&p.w, "<section id=\"system\"><h2>The system</h2>\n");
    nh_html_written(&p.w);
    nh_html_add(&p.w, "<h3>As it was understood</h3>\n");
    nh_html_equations(&p.w, r->model);
    nh_html_add(&p.w, "</section>\n");
    nh_html_words(&p.w, "current, degree, proved, complete");
    nh_html_repeat(&p.w, run);
    nh_html_end(&p.w);
}
