#include "report/html.h"

#include <stdio.h>
#include <string.h>

#include "report/html_internal.h"

static const char *plural(size_t n) { return n == 1 ? "" : "s"; }

/* "one is the energy" */
static void meanings(nh_html_writer *w)
{
    const nh_result *r = w->r;
    size_t told = 0;
    for (size_t k = 0; k < r->count; k++) {
        if (!r->found[k].meaning[0] || r->found[k].independence != NH_INDEPENDENT) continue;
        nh_html_add(w, told++ ? ", one the " : "; one is the ");
        nh_html_text(w, r->found[k].meaning);
    }
}

static void answer(nh_html_writer *w)
{
    const nh_result *r = w->r;
    static const char *const class[] = {"found", "none", "undecided"};
    nh_text_addf(w->out, "<p class=\"answer %s\">", class[r->verdict]);
    if (r->count) {
        nh_html_count(w, r->independent);
        nh_text_addf(w->out, " independent current%s of at most ", plural(r->independent));
        nh_html_count(w, r->local_maximum);
        meanings(w);
    } else {
        nh_html_add(w, r->verdict == NH_NONE ? "No current in this ansatz" : "Undecided: nothing found got a certificate");
    }
    nh_html_add(w, ".</p>\n");
    if (r->count && r->verdict == NH_UNDECIDED) nh_html_add(w, "<p>Not every one is certified; the cards say which.</p>\n");
    if (r->count && r->independent == r->local_maximum) nh_html_add(w, "<p>There cannot be more: together they determine every orbit locally.</p>\n");
    if (r->partial) nh_html_add(w, "<p class=\"warning\"><strong>Partial:</strong> the search ended before all stages were tried.</p>\n");
}

static void warnings(nh_html_writer *w)
{
    const nh_result *r = w->r;
    for (size_t i = 0; i < r->warnings; i++) {
        nh_html_add(w, "<p class=\"warning\"><strong>Warning:</strong> ");
        nh_html_text(w, r->warning[i]);
        nh_html_add(w, "</p>\n");
    }
}

static void head(nh_html_writer *w)
{
    nh_html_add(w, "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                   "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                   "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'\"/>\n"
                   "<meta name=\"generator\" content=\"nhsym " NH_VERSION "\"/>\n<title>");
    nh_html_text(w, w->r->system->title);
    nh_html_add(w, " \u2013 nhsym</title>\n<style>/*<![CDATA[*/\n");
    nh_html_add(w, nh_html_style);
    nh_html_add(w, "/*]]>*/</style>\n</head>\n<body>\n<main>\n");
}

static void title(nh_html_writer *w)
{
    const nh_system *s = w->r->system;
    nh_html_add(w, "<header>\n");
    nh_html_tagged(w, "h1", s->title);
    answer(w);
    if (s->source && s->source[0]) {
        nh_html_add(w, "<p class=\"source\">System: ");
        nh_html_text(w, s->source);
        nh_html_add(w, "</p>\n");
    }
    nh_html_add(w, "<nav aria-label=\"Sections\"><a href=\"#currents\">Currents</a> <a href=\"#system\">System</a> ");
    if (w->r->validation) nh_html_add(w, "<a href=\"#motion\">Motion</a> ");
    nh_html_add(w, "<a href=\"#search\">How it was found</a> <a href=\"#repeat\">Repeat it</a></nav>\n</header>\n");
}

void nh_html(const nh_result *r, nh_text *out)
{
    nh_html_writer w = {.r = r, .out = out};
    head(&w);
    title(&w);
    warnings(&w);
    nh_html_currents(&w);
    nh_html_motion(&w);
    nh_html_system(&w);
    nh_html_evidence(&w);
    nh_html_repeat(&w);
    nh_html_add(&w, "</main>\n<script>//<![CDATA[\n");
    nh_html_add(&w, nh_html_script);
    nh_html_add(&w, "//]]></script>\n</body>\n</html>\n");
}

void nh_html_motion_figures(const nh_result *r, nh_figure_sink *sink, void *context)
{
    nh_html_motion_plots(&(nh_html_writer){.r = r, .sink = sink, .context = context});
}

void nh_html_search_figures(const nh_result *r, nh_figure_sink *sink, void *context)
{
    nh_html_evidence_plots(&(nh_html_writer){.r = r, .sink = sink, .context = context});
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
