#include "document/html.h"

#include <stdio.h>
#include <string.h>

#include "document/facts.h"
#include "document/html_internal.h"

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

/* "one is minus the energy, one the momentum of x" */
static void meanings(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    size_t told = 0;
    for (size_t k = 0; k < r->count; k++) {
        if (!r->found[k].meaning[0] || r->found[k].independence != NH_INDEPENDENT) continue;
        const char *meaning = r->found[k].meaning;
        bool bare = !strncmp(meaning, "energy", 6) || !strncmp(meaning, "momentum", 8);
        nh_html_add(w, told++ ? ", one " : "; one is ");
        nh_html_add(w, bare ? "the " : !strncmp(meaning, "integral", 8) ? "an " : "");
        nh_html_meaning(w, meaning);
    }
}

static void completeness(nh_html_writer *w)
{
    nh_text words;
    nh_text_init(&words);
    nh_facts_completeness(w->r, &words);
    if (nh_text_string(&words)[0]) {
        nh_html_add(w, "<p>");
        nh_html_text(w, nh_text_string(&words));
        nh_html_add(w, "</p>\n");
    }
    nh_text_clear(&words);
}

static void answer(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    static const char *const class[] = {"found", "none", "undecided"};
    nh_text_addf(w->out, "<p class=\"answer %s\">", class[r->verdict]);
    if (r->count) {
        nh_html_count(w, r->independent);
        nh_text_addf(w->out, " independent current%s of at most ", plural(r->independent));
        nh_html_count(w, r->local_maximum);
        meanings(w);
    } else {
        nh_html_add(w, nh_facts_nothing(r));
    }
    nh_html_add(w, ".</p>\n");
    if (r->count && r->verdict == NH_UNDECIDED) nh_html_add(w, "<p>Not all of them are certified; each card states its certificate.</p>\n");
    nh_html_add(w, r->partial ? "<p class=\"warning\"><strong>Partial:</strong> " : "<p>");
    nh_html_text(w, nh_facts_search(r));
    nh_html_add(w, "</p>\n");
    completeness(w);
}

static void warnings(nh_html_writer *w)
{
    for (size_t i = 0; i < w->r->warnings; i++) nh_html_warning(w, w->r->warning[i]);
}

static void links(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    nh_text sections;
    nh_text_init(&sections);
    nh_text_addf(&sections, "currents|Currents|%s%ssystem|System|%s%ssearch|%s|words|Words|repeat|Repeat it", r->validation ? "motion|Motion|" : "", r->figures ? "figures|Figures|" : "", r->motion ? "explicit|Explicit motion|" : "",
                 r->theory ? "geometry|Geometry|" : "",
                 r->count ? "How it was found" : "What was tried");
    nh_html_links(w, nh_text_string(&sections));
    nh_text_clear(&sections);
}

static nh_html_writer writer_of(const nh_analysis *r, nh_text *out)
{
    const nh_chart *chart = r->other && r->other->chart->roots ? r->other->chart : r->model->chart;
    return (nh_html_writer){.out = out, .system = r->system, .analysis = r->analysis, .dag = r->model->dag, .chart = chart, .shown = r->options.shown, .written = r->options.written, .r = r};
}

void nh_html(const nh_analysis *r, nh_text *out)
{
    nh_html_writer w = writer_of(r, out);
    nh_run run = {r->command, r->system_path, r->analysis_path, r->options.seed, r->options.shown, r->timing.total};
    nh_html_begin(&w, NULL);
    answer(&w);
    links(&w);
    warnings(&w);
    nh_html_currents(&w);
    nh_html_simulation_motion(&w);
    nh_html_figures(&w);
    nh_html_system(&w);
    nh_html_explicit_motion(&w);
    nh_html_geometry(&w, r->arena, r->theory);
    nh_html_evidence(&w);
    nh_html_words(&w, "current, symmetry, case, distribution, projectable, independent, local, residual, drift, gap, multiplier, nonholonomic, growth");
    nh_html_repeat(&w, &run);
    nh_html_end(&w);
}

void nh_html_plots(const nh_analysis *r, nh_html_section section, nh_figure_sink *sink, void *context)
{
    nh_text rest; /* of the section */
    nh_text_init(&rest);
    nh_html_writer w = writer_of(r, &rest);
    w.sink = sink;
    w.context = context;
    if (section == NH_SECTION_MOTION) nh_html_simulation_motion(&w);
    if (section == NH_SECTION_FIGURES) nh_html_figures(&w);
    if (section == NH_SECTION_SEARCH) nh_html_evidence(&w);
    nh_text_clear(&rest);
}

const char *nh_html_next_figure(const char **at, size_t *length)
{
    static const char begin[] = "<svg xmlns=", end[] = "</svg>"; /* text cannot hold them: it is escaped */
    const char *first = strstr(*at, begin), *last = first ? strstr(first, end) : NULL;
    if (!last) return NULL;
    *at = last + sizeof end - 1;
    *length = (size_t)(*at - first);
    return first;
}
