#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/escape.h"
#include "base/memory.h"
#include "base/versions.h"
#include "document/facts.h"
#include "document/typeset.h"
#include "document/html_internal.h"
#include "document/notation.h"
#include "document/page.h"
#include "document/wording.h"

enum { FIGURE_ID = 40 };

void nh_html_add(nh_html_writer *w, const char *markup) { nh_text_add(w->out, markup); }

/* No line begins with the sign that ends a sentence: the last formula and the sign behind it stay together. */
static size_t punctuation(nh_html_writer *w, const char *text)
{
    static const char end[] = "</math>";
    const char *written = nh_text_string(w->out);
    size_t signs = strspn(text, ".,;:)"), length = w->out->length, from = length;
    if (!signs || length < strlen(end) || strcmp(written + length - strlen(end), end)) return 0;
    while (from && strncmp(written + from, "<math", strlen("<math"))) from--;
    char *formula = nh_strdup(written + from);
    nh_text_cut(w->out, from);
    nh_text_addf(w->out, "<span class=\"word\">%s%.*s</span>", formula, (int)signs, text);
    nh_free(formula);
    return signs;
}

void nh_html_text(nh_html_writer *w, const char *text) { nh_escape_xml(text + punctuation(w, text), w->out); }

void nh_html_prose(nh_html_writer *w, const char *text)
{
    static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    for (const char *c = text; *c;) {
        const char *digit = c + 1 + (c[0] == '^' && c[1] == '-');
        const char *quoted = *c == '`' ? strchr(c + 1, '`') : NULL;
        if (quoted) {
            nh_text code;
            nh_text_init(&code);
            nh_text_add_n(&code, c + 1, (size_t)(quoted - c - 1));
            nh_html_tagged(w, "code", nh_text_string(&code));
            nh_text_clear(&code);
            c = quoted + 1;
            continue;
        }
        if (*c != '^' || *digit < '0' || *digit > '9') {
            size_t length = 1 + strcspn(c + 1, "^`");
            nh_text run;
            nh_text_init(&run);
            nh_text_add_n(&run, c, length);
            nh_html_text(w, nh_text_string(&run));
            nh_text_clear(&run);
            c += length;
            continue;
        }
        if (c[1] == '-') nh_html_add(w, "\u207b");
        for (; digit[0] >= '0' && digit[0] <= '9'; digit++) nh_html_add(w, raised[*digit - '0']);
        c = digit;
    }
}

void nh_html_letters(nh_html_writer *w, const char *label)
{
    nh_html_add(w, "<math>");
    nh_notation_write(label, NH_NOTATION_MATHML, w->out);
    nh_html_add(w, "</math>");
}

void nh_html_theory(nh_html_writer *w, const char *words)
{
    nh_text part;
    bool label;
    for (; nh_notation_next(&words, &part, &label); nh_text_clear(&part)) {
        if (label) nh_html_letters(w, nh_text_string(&part));
        else nh_html_text(w, nh_text_string(&part));
    }
}

void nh_html_tagged(nh_html_writer *w, const char *tag, const char *text)
{
    nh_text_addf(w->out, "<%s>", tag);
    nh_html_text(w, text);
    nh_text_addf(w->out, "</%s>", tag);
}

void nh_html_number(nh_html_writer *w, double value, int digits)
{
    nh_shown_number n;
    if (!nh_facts_number(value, digits, &n)) {
        nh_html_add(w, "\u2013");
        return;
    }
    nh_text_addf(w->out, "<data value=\"%s\">%s%s", n.all, n.minus ? "\u2212" : "", n.mantissa);
    if (n.has_power)
        nh_text_addf(w->out, "%s10<sup>%s%d</sup>", n.mantissa[0] ? "\u00b7" : "", n.power < 0 ? "\u2212" : "",
                     abs(n.power));
    nh_html_add(w, "</data>");
}

void nh_html_count(nh_html_writer *w, size_t value)
{
    nh_text_addf(w->out, "<data value=\"%zu\">%zu</data>", value, value);
}

static void name_figure(size_t number, char id[FIGURE_ID]) { snprintf(id, FIGURE_ID, "fig%zu", number); }

bool nh_html_is_figure(const char *text, size_t number)
{
    char id[FIGURE_ID];
    name_figure(number, id);
    return nh_svg_is_plot(text, id);
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

void nh_html_figure(nh_html_writer *w, nh_plot *plot, const char *caption)
{
    char id[FIGURE_ID];
    if (w->sink) {
        w->sink(w->context, plot, caption);
        return;
    }
    name_figure(++w->figures, id);
    plot->id = id;
    nh_html_add(w, "<figure>");
    nh_svg_plot(plot, w->out);
    nh_html_tagged(w, "figcaption", caption);
    nh_html_add(w, "</figure>\n");
}

/* ---- formulas ---- */

enum { widest = 30 }; /* symbols of a piece: about the width of a phone; a wider piece scrolls by itself */

/* Without the <mrow> around single symbols, which would be most of a formula's text. */
static void add_compact(nh_text *out, const char *piece)
{
    static const char row[] = "<mrow>", end[] = "</mrow>";
    for (const char *c = piece, *next; *c; c = next) {
        const char *inner = c + sizeof row - 1, *close = !strncmp(c, row, sizeof row - 1) && inner[0] == '<' &&
                                                                 inner[1] == 'm' && strchr("in", inner[2])
                                                             ? strstr(inner, "</m")
                                                             : NULL;
        const char *after = close ? close + sizeof "</mi>" - 1 : NULL;
        next = c + 1;
        if (after && after[-1] == '>' && !strncmp(after, end, sizeof end - 1)) {
            nh_text_add_n(out, inner, (size_t)(after - inner));
            next = after + sizeof end - 1;
        } else {
            nh_text_add_n(out, c, 1);
        }
    }
}

/* Where a line breaks between factors the page shows a dot: the sign of a soft hyphen (page/page.css). */
static void write_piece(void *context, const char *piece, nh_typeset_follows follows)
{
    nh_html_writer *w = context;
    nh_html_add(w, "<math displaystyle=\"true\">");
    add_compact(w->out, piece);
    nh_html_add(w, "</math>");
    if (follows != NH_FOLLOWS_NOTHING) nh_html_add(w, follows == NH_FOLLOWS_FACTOR ? "\u00ad" : " ");
}

void nh_html_source(nh_html_writer *w, const char *text)
{
    if (!nh_typeset_pieces(text, NH_MATHML, widest, write_piece, w)) nh_html_tagged(w, "code", text);
}

/* The same for a name within the text. */
static void write_name(nh_html_writer *w, const char *name)
{
    nh_text formula;
    nh_text_init(&formula);
    if (nh_typeset(name, NH_MATHML, &formula)) nh_text_addf(w->out, "<math>%s</math>", nh_text_string(&formula));
    else nh_html_text(w, name);
    nh_text_clear(&formula);
}

void nh_html_chart_name(nh_html_writer *w, const char *name)
{
    char words[200], one[200];
    const char *list = nh_facts_list(name, words, sizeof words);
    nh_html_text(w, list ? words : name);
    if (!list) return;
    nh_html_add(w, "<span class=\"word\">(");
    for (bool first = true; nh_facts_next(&list, one, sizeof one); first = false) {
        nh_html_text(w, first ? "" : ", ");
        write_name(w, one);
    }
    nh_html_add(w, ")</span>");
}

/* ---- tables ---- */

void nh_html_table(nh_html_writer *w, const char *caption, const char *heads)
{
    nh_html_add(w, "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"");
    nh_html_text(w, caption);
    nh_html_add(w, "\"><table>");
    nh_html_tagged(w, "caption", caption);
    if (heads) nh_html_add(w, "<thead><tr>");
    for (const char *end; heads && *heads; heads = *end ? end + 1 : end) {
        end = heads + strcspn(heads, "|");
        char *head = nh_alloc_array((size_t)(end - heads) + 1, 1);
        memcpy(head, heads, (size_t)(end - heads));
        nh_html_add(w, "<th scope=\"col\">");
        double value;
        if (nh_facts_head(head, &value)) nh_html_number(w, value, 2);
        else nh_html_text(w, *head == '#' ? head + 1 : head);
        nh_html_add(w, "</th>");
        nh_free(head);
        if (!*end) nh_html_add(w, "</tr></thead>");
    }
    nh_html_add(w, "<tbody>\n");
}

void nh_html_table_end(nh_html_writer *w) { nh_html_add(w, "</tbody></table></div>\n"); }

/* ---- a page ---- */

/* "m = 2 kg, a = 1 m" behind the title. */
static void put_values(nh_html_writer *w)
{
    enum { most = 8 };
    const nh_system *system = w->system;
    if (!system->parameters || system->parameters > most) return;
    nh_html_add(w, " <span class=\"params\">");
    for (size_t i = 0; i < system->parameters; i++) {
        nh_html_add(w, i ? ", <span class=\"word\">" : "<span class=\"word\">");
        nh_html_source(w, system->parameter[i].name);
        nh_html_add(w, " = ");
        nh_html_number(w, system->parameter[i].value, 6);
        if (*system->parameter[i].unit) nh_html_add(w, "\u00a0"), nh_html_prose(w, system->parameter[i].unit);
        nh_html_add(w, "</span>");
    }
    nh_html_add(w, "</span>");
}

void nh_html_begin(nh_html_writer *w, const char *what)
{
    nh_html_add(w, "<!DOCTYPE html>\n<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\">\n<head>\n<meta "
                   "charset=\"utf-8\"/>\n"
                   "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n"
                   "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
                   "'unsafe-inline'; font-src data:; script-src 'unsafe-inline'\"/>\n"
                   "<meta name=\"generator\" content=\"nhsym " NH_VERSION "\"/>\n<title>");
    nh_html_text(w, w->system->title);
    if (what) nh_text_addf(w->out, ": %s", what);
    nh_text_addf(w->out,
                 " \u2013 nhsym</title>\n<style>/*<![CDATA[*/\n/* The font is a part of TeX Gyre Pagella Math 1.632 by "
                 "the GUST e-foundry (GUST Font License), renamed. */\n@font-face{font-family:'nhsym "
                 "math';src:url(data:font/woff2;base64,%s) format('woff2')}\n%s/*]]>*/</style>\n</head>\n<body>\n",
                 nh_page_font, nh_page_style);
    nh_html_add(w, "<a class=\"skip\" href=\"#text\">Skip to the text</a>\n<div class=\"wrap\">\n<header "
                   "class=\"top\"><div class=\"say\">\n<h1>");
    nh_html_text(w, w->system->title);
    if (what) nh_text_addf(w->out, ": %s", what);
    put_values(w);
    nh_html_add(w, "</h1>\n");
}

void nh_html_head_end(nh_html_writer *w)
{
    const nh_system *system = w->system;
    if (w->headed) return;
    w->headed = true;
    if (system->source && system->source[0]) {
        nh_html_add(w, "<p class=\"source\">System: ");
        nh_html_text(w, system->source);
        nh_html_add(w, "</p>\n");
    }
    nh_html_add(w, "</div><div class=\"tools\"><button class=\"tool\" id=\"theme\" type=\"button\" "
                   "aria-label=\"light or dark colours\">\u25d0</button><button class=\"tool\" id=\"print\" "
                   "type=\"button\">Print</button></div></header>\n<main>\n");
}

void nh_html_links(nh_html_writer *w, const char *sections)
{
    nh_html_head_end(w);
    nh_html_add(w, "<div class=\"paper\" id=\"text\"><nav class=\"toc\" aria-label=\"Sections\"><ol>");
    while (*sections) {
        size_t id = strcspn(sections, "|"), name = strcspn(sections + id + 1, "|");
        nh_text_addf(w->out, "<li><a href=\"#%.*s\">%.*s</a></li>", (int)id, sections, (int)name, sections + id + 1);
        sections += id + 1 + name;
        sections += *sections == '|';
    }
    nh_html_add(w, "</ol></nav>\n<article>\n");
}

void nh_html_end(nh_html_writer *w)
{
    nh_html_add(w, "</article></div>\n</main></div>\n<script>//<![CDATA[\n");
    if (w->stage) nh_html_add(w, nh_page_solver), nh_html_add(w, nh_page_scene);
    nh_html_add(w, nh_page_script);
    nh_html_add(w, "//]]></script>\n</body>\n</html>\n");
}

/* ---- words ---- */

/* Is text[0..length-1] one or more whole words? */
static bool stands_alone(const char *text, size_t length, char before)
{
    bool name = isalpha((unsigned char)text[0]) && (isalpha((unsigned char)before) || before == '_');
    return !name && !isalpha((unsigned char)text[length]) && text[length] != '_';
}

/* The text of the glossary with formulas typeset. */
static void with_letters(nh_html_writer *w, const char *text)
{
    static const char *const formula[][2] = {{"[Gamma,Z] = a Gamma + b Z", "[Gamma,Z]=a Gamma+b Z"},
                                             {"[Gamma,Z] = a Gamma", "[Gamma,Z]=a Gamma"},
                                             {"[Gamma,Z]", "[Gamma,Z]"},
                                             {"L_Z(alpha) = 0", "L_{Z}(alpha)=0"},
                                             {"Gamma(Phi) = 0", "Gamma(Phi)=0"},
                                             {"Phi = alpha(Z)", "Phi=alpha(Z)"},
                                             {"D + [D,D]", "D+[D,D]"},
                                             {"10^-16", "10^{-16}"},
                                             {"mu_a", "mu_{a}"},
                                             {"Gamma", "Gamma"},
                                             {"Phi", "Phi"},
                                             {"D", "D"},
                                             {"Z", "Z"}};
    enum { formulas = sizeof formula / sizeof *formula };
    nh_text words;
    nh_text_init(&words);
    for (char before = 0; *text;) {
        size_t k = 0, length = 1;
        while (k < formulas && (strncmp(text, formula[k][0], strlen(formula[k][0])) ||
                                !stands_alone(text, strlen(formula[k][0]), before)))
            k++;
        if (k < formulas) {
            length = strlen(formula[k][0]);
            nh_html_text(w, nh_text_string(&words));
            nh_text_cut(&words, 0);
            nh_html_letters(w, formula[k][1]);
        } else {
            nh_text_add_n(&words, text, 1);
        }
        before = text[length - 1];
        text += length;
    }
    nh_html_text(w, nh_text_string(&words));
    nh_text_clear(&words);
}

/* Does the page contain the words, or the first of them? */
static bool said(const nh_html_writer *w, const char *word)
{
    const char *page = strstr(nh_text_string(w->out), "<main");
    char first[40];
    snprintf(first, sizeof first, "%.*s", (int)strcspn(word, " "), word);
    return page && strcasestr(page, first);
}

void nh_html_words(nh_html_writer *w, const char *words)
{
    nh_html_add(w, "<section id=\"words\"><h2>Words</h2>\n<dl>\n");
    for (const char *c = words; *c; c += strcspn(c, ","), c += strspn(c, ", "))
        for (size_t i = 0; i < nh_glossary_count(); i++) {
            nh_glossary_entry e = nh_glossary_at(i);
            if (strlen(e.word) != strcspn(c, ",") || strncmp(e.word, c, strlen(e.word)) || !said(w, e.word)) continue;
            nh_html_tagged(w, "dt", e.word);
            nh_html_add(w, "<dd>");
            with_letters(w, e.text);
            nh_html_add(w, "</dd>\n");
        }
    nh_html_add(w, "</dl>\n</section>\n");
}

/* ---- how to repeat the run ---- */

static void row(nh_html_writer *w, const char *what, const char *value)
{
    if (!value) return;
    nh_html_add(w, "<tr>");
    nh_text_addf(w->out, "<th scope=\"row\">%s</th><td><code>", what);
    while (*value) { /* a line breaks between words only: what is copied from it must be a command */
        size_t length = strcspn(value, " ");
        char *word = nh_alloc_array(length + 1, 1);
        memcpy(word, value, length);
        nh_html_add(w, "<span class=\"word\">");
        nh_html_text(w, word);
        nh_free(word);
        value += length;
        nh_html_add(w, *value == ' ' ? "</span> " : "</span>");
        value += *value == ' ';
    }
    nh_html_add(w, "</code></td></tr>\n");
}

void nh_html_repeat(nh_html_writer *w, const nh_run *run)
{
    nh_html_add(w, "<section id=\"repeat\"><h2>Repeat it</h2>\n");
    nh_html_table(w, "The run", NULL);
    row(w, "command", run->command);
    row(w, "program", "nhsym " NH_VERSION);
    row(w, "system file", run->system_path);
    row(w, "analysis file", run->analysis_path);
    nh_html_add(w, "<tr><th scope=\"row\">seed</th><td>");
    nh_html_number(w, run->seed, 17);
    nh_html_add(w, "</td></tr>\n");
    for (size_t i = 0; nh_version_of(i).name; i++) row(w, nh_version_of(i).name, nh_version_of(i).version);
    row(w, "machine", nh_versions_machine());
    if (isfinite(run->seconds)) {
        nh_html_add(w, "<tr><th scope=\"row\">time</th><td>");
        nh_html_number(w, run->seconds, 3);
        nh_html_add(w, " s</td></tr>\n");
    }
    nh_html_table_end(w);
    nh_html_add(w, "</section>\n");
}
