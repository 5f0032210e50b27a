#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/versions.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/tex_internal.h"
#include "document/typeset.h"
#include "exact/normal.h"
#include "graph/print.h"

void nh_tex_add(nh_tex_writer *w, const char *markup) { nh_text_add(w->out, markup); }

/* ---- words ---- */

static const struct {
    unsigned code;
    const char *latex;
} letters[] = {
    {0x2212, "$-$"},         {0x2013, "--"},        {0x2014, "---"},      {0x2018, "`"},
    {0x2019, "'"},           {0x201c, "``"},        {0x201d, "''"},       {0x2026, "\\dots{}"},
    {0xb2, "$^2$"},          {0xb3, "$^3$"},        {0xb9, "$^1$"},       {0xb0, "$^\\circ$"},
    {0xb1, "$\\pm$"},        {0xb7, "$\\cdot$"},    {0xd7, "$\\times$"},  {0xb5, "$\\mu$"},
    {0x2202, "$\\partial$"}, {0x2261, "$\\equiv$"}, {0x2264, "$\\le$"},   {0x2265, "$\\ge$"},
    {0x2192, "$\\to$"},      {0x221e, "$\\infty$"}, {0x221a, "$\\surd$"}, {0x3b1, "$\\alpha$"},
    {0x3b2, "$\\beta$"},     {0x3b3, "$\\gamma$"},  {0x3b4, "$\\delta$"}, {0x3b5, "$\\varepsilon$"},
    {0x3b6, "$\\zeta$"},     {0x3b7, "$\\eta$"},    {0x3b8, "$\\theta$"}, {0x3b9, "$\\iota$"},
    {0x3ba, "$\\kappa$"},    {0x3bb, "$\\lambda$"}, {0x3bc, "$\\mu$"},    {0x3bd, "$\\nu$"},
    {0x3be, "$\\xi$"},       {0x3bf, "$o$"},        {0x3c0, "$\\pi$"},    {0x3c1, "$\\rho$"},
    {0x3c2, "$\\varsigma$"}, {0x3c3, "$\\sigma$"},  {0x3c4, "$\\tau$"},   {0x3c5, "$\\upsilon$"},
    {0x3c6, "$\\varphi$"},   {0x3c7, "$\\chi$"},    {0x3c8, "$\\psi$"},   {0x3c9, "$\\omega$"},
    {0x393, "$\\Gamma$"},    {0x394, "$\\Delta$"},  {0x398, "$\\Theta$"}, {0x39b, "$\\Lambda$"},
    {0x39e, "$\\Xi$"},       {0x3a0, "$\\Pi$"},     {0x3a3, "$\\Sigma$"}, {0x3a6, "$\\Phi$"},
    {0x3a8, "$\\Psi$"},      {0x3a9, "$\\Omega$"},
};

/* The code point at c, and its length in bytes; 0 where the text is not UTF-8. */
static unsigned decode(const unsigned char *c, size_t *bytes)
{
    size_t n = *c < 0x80 ? 1 : *c >= 0xf0 ? 4 : *c >= 0xe0 ? 3 : *c >= 0xc0 ? 2 : 0;
    unsigned code = n == 1 ? *c : *c & (0xffu >> (n + 1));
    for (size_t i = 1; i < n; i++) {
        if ((c[i] & 0xc0) != 0x80) n = 0;
        else code = code << 6 | (c[i] & 0x3fu);
    }
    *bytes = n ? n : 1;
    return n ? code : 0;
}

/* Letters with accents that every LaTeX has in its default encoding: not those with an ogonek, nor eth, thorn, eng, nor
 * a ligature of the old Dutch. */
static bool accented(unsigned code)
{
    static const unsigned missing[] = {0xd0,  0xd7,  0xde,  0xf0,  0xf7,  0xfe,  0x104, 0x105, 0x110, 0x111,
                                       0x118, 0x119, 0x126, 0x127, 0x12e, 0x12f, 0x132, 0x133, 0x138, 0x13f,
                                       0x140, 0x149, 0x14a, 0x14b, 0x166, 0x167, 0x172, 0x173};
    for (size_t i = 0; i < sizeof missing / sizeof *missing; i++)
        if (missing[i] == code) return false;
    return code >= 0xc0 && code <= 0x17e;
}

static void other_letter(nh_tex_writer *w, const char *c, unsigned code, size_t bytes)
{
    for (size_t i = 0; i < sizeof letters / sizeof *letters; i++) {
        if (letters[i].code != code) continue;
        nh_tex_add(w, letters[i].latex);
        return;
    }
    if (accented(code)) nh_text_add_n(w->out, c, bytes);
    else nh_text_addf(w->out, "[U+%04X]", code);
}

static void letter(nh_tex_writer *w, unsigned char c)
{
    if (strchr("{}$&#_%", c)) nh_text_addf(w->out, "\\%c", c);
    else if (c == '\\') nh_tex_add(w, "\\textbackslash{}");
    else if (c == '^') nh_tex_add(w, "\\textasciicircum{}");
    else if (c == '~') nh_tex_add(w, "\\textasciitilde{}");
    else if (c == '<') nh_tex_add(w, "\\textless{}");
    else if (c == '>') nh_tex_add(w, "\\textgreater{}");
    else if (c == '|') nh_tex_add(w, "\\textbar{}");
    else if (c == '"') nh_tex_add(w, "\\char34{}");
    else if (c == '\'') nh_tex_add(w, "'{}"); /* two of them do not mean quotation marks here */
    else if (c == '`') nh_tex_add(w, "`{}");
    else if (c == '-') nh_tex_add(w, "-{}");
    else nh_text_addf(w->out, "%c", c >= 0x20 && c != 0x7f ? c : ' ');
}

static void escaped(nh_tex_writer *w, const char *text, const char *between)
{
    size_t bytes;
    for (const char *c = text; *c; c += bytes) {
        unsigned code = decode((const unsigned char *)c, &bytes);
        if (bytes == 1 && code) letter(w, (unsigned char)*c);
        else other_letter(w, c, code, bytes);
        nh_tex_add(w, *c == ' ' ? "" : between);
    }
}

void nh_tex_words(nh_tex_writer *w, const char *text) { escaped(w, text, ""); }

void nh_tex_code(nh_tex_writer *w, const char *text)
{
    nh_tex_add(w, "{\\ttfamily ");
    escaped(w, text, "\\nhbreak{}");
    nh_tex_add(w, "}");
}

void nh_tex_number(nh_tex_writer *w, double value, int digits)
{
    nh_shown_number n;
    if (!nh_facts_number(value, digits, &n)) {
        nh_tex_add(w, "--");
        return;
    }
    nh_text_addf(w->out, "\\nhnumber{%s}{%s%s", n.all, n.minus ? "-" : "", n.mantissa);
    if (n.has_power) nh_text_addf(w->out, "%s10^{%d}", n.mantissa[0] ? "\\cdot " : "", n.power);
    nh_tex_add(w, "}");
}

void nh_tex_count(nh_tex_writer *w, size_t value) { nh_text_addf(w->out, "\\nhnumber{%zu}{%zu}", value, value); }

/* ---- formulas ---- */

void nh_tex_chart(nh_tex_writer *w, const char *name)
{
    char words[200], one[200];
    const char *list = nh_facts_list(name, words, sizeof words);
    nh_tex_words(w, list ? words : name);
    if (!list) return;
    nh_tex_add(w, "(");
    for (bool first = true; nh_facts_next(&list, one, sizeof one); first = false) {
        nh_tex_add(w, first ? "" : ", ");
        nh_tex_name(w, one);
    }
    nh_tex_add(w, ")");
}

void nh_tex_name(nh_tex_writer *w, const char *text)
{
    const char *unit = strstr(text, " / "); /* on an axis */
    if (unit && unit - text < 100) {
        char name[100];
        snprintf(name, sizeof name, "%.*s", (int)(unit - text), text);
        nh_tex_name(w, name);
        nh_tex_words(w, unit);
        return;
    }
    nh_text formula;
    bool word = !text[strcspn(text, " -/")]; /* otherwise it is a phrase, even if it could be a formula */
    nh_text_init(&formula);
    if (word && nh_typeset(text, NH_LATEX, &formula)) nh_text_addf(w->out, "$%s$", nh_text_string(&formula));
    else nh_tex_words(w, text);
    nh_text_clear(&formula);
}

const char *const nh_tex_formula_macro =
    "\\providecommand{\\nhformula}[1]{\\par\\addvspace{4pt plus 1pt}{\\parindent=0pt\\leftskip=2em\\rightskip=0pt plus "
    "1fil\\hangindent=2em\\hangafter=1\\binoppenalty=10000\\relpenalty=10000"
    "\\lineskiplimit=3pt\\lineskip=4pt $\\displaystyle #1$\\par}\\addvspace{4pt plus 1pt}}\n";

/* ---- the beginning and the end of a document, and how to repeat the run ---- */

static const char macros[] = "\\providecommand{\\nhnumber}[2]{$#2$} % all digits, and what is shown\n"
                             "\\providecommand{\\nhbreak}{\\penalty0\\hskip0pt\\relax}\n"
                             "\\definecolor{nhblue}{HTML}{0072B2}\\definecolor{nhred}{HTML}{D55E00}\\definecolor{"
                             "nhgreen}{HTML}{009E73}\\definecolor{nhpink}{HTML}{CC79A7}"
                             "\\definecolor{nhorange}{HTML}{E69F00}\\definecolor{nhsky}{HTML}{56B4E9}\n";

void nh_tex_head(nh_tex_writer *w, const char *what)
{
    static const char packages[] = "\\usepackage{amsmath,amssymb,longtable,pgfplots}\n";
    nh_tex_add(w, "% Written by nhsym " NH_VERSION ".\n");
    if (w->fragment)
        nh_text_addf(w->out,
                     "%% To be read by \\input; the document needs these lines before its beginning:\n%% %s%% "
                     "\\pgfplotsset{compat=1.16}\n",
                     packages);
    else
        nh_text_addf(w->out,
                     "\\documentclass[11pt,a4paper]{article}\n%s\\usepackage[margin=2.5cm]{geometry}\n\\pgfplotsset{"
                     "compat=1.16}\n",
                     packages);
    nh_tex_add(w, nh_tex_formula_macro);
    nh_tex_add(w, macros);
    if (w->fragment) return;
    nh_tex_add(w, "\\title{");
    nh_tex_words(w, w->system->title);
    if (what) nh_text_addf(w->out, ": %s", what);
    nh_tex_add(w, "}\n\\author{nhsym " NH_VERSION "}\n\\date{}\n\\begin{document}\n\\maketitle\n");
}

void nh_tex_repeat(nh_tex_writer *w, const nh_run *run)
{
    nh_tex_add(w, "\\section{To repeat it}\n\\begin{raggedright}\n");
    if (run->command) nh_tex_code(w, run->command), nh_tex_add(w, "\n\n");
    nh_tex_add(w, "nhsym " NH_VERSION ", seed ");
    nh_tex_number(w, run->seed, 17);
    if (run->system_path) nh_tex_add(w, ", system file "), nh_tex_code(w, run->system_path);
    if (run->analysis_path) nh_tex_add(w, ", analysis file "), nh_tex_code(w, run->analysis_path);
    for (size_t i = 0; nh_version_of(i).name; i++) {
        nh_tex_add(w, ", ");
        nh_tex_words(w, nh_version_of(i).name);
        nh_tex_add(w, " ");
        nh_tex_words(w, nh_version_of(i).version);
    }
    nh_tex_add(w, ", ");
    nh_tex_words(w, nh_versions_machine());
    nh_tex_add(w, ".\n\n\\end{raggedright}\n");
}
