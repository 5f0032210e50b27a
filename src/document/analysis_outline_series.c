/* A current without closed form: its words, its coefficient functions, their plot. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "document/analysis_internal.h"
#include "document/formula.h"
#include "graph/node.h"

/* sum' c_k T_k(s) by Clenshaw's recurrence. */
static double chebyshev(const double *c, size_t degree, double s)
{
    double b1 = 0, b2 = 0;
    for (size_t k = degree; k > 0; k--) {
        double b0 = c[k] + 2 * s * b1 - b2;
        b2 = b1;
        b1 = b0;
    }
    return c[0] + s * b1 - b2;
}

/* Function i along the first variable, in the middle of the others: T_k(0) = 1, 0, -1, 0, .. */
static void along_first(const nh_series *s, size_t i, double *c)
{
    const double *from = s->coefficient + i * s->stride;
    for (size_t k = 0; k <= s->degree; k++) c[k] = s->index ? 0 : from[k];
    for (size_t z = 0; s->index && z < s->stride; z++) {
        const unsigned char *k = s->index + z * s->variables;
        double factor = from[z];
        for (size_t j = 1; j < s->variables; j++) factor *= k[j] % 2 ? 0 : k[j] % 4 ? -1 : 1;
        c[k[0]] += factor;
    }
}

static void series_plot(nh_pen *p, const nh_analysis *r, const nh_current *f)
{
    enum { points = 101, most = 7 };
    const nh_series *s = f->series;
    size_t n = s->words < most ? s->words : most;
    double *x = nh_alloc_array((n + 1) * points, sizeof *x);
    nh_curve curve[most];
    char name[most][24], title[200];
    double *c = nh_alloc_array(s->degree + 1, sizeof *c);
    for (size_t j = 0; j < points; j++) x[j] = s->low[0] + (s->high[0] - s->low[0]) * (double)j / (points - 1);
    for (size_t i = 0; i < n; i++) {
        double *y = x + (i + 1) * points;
        along_first(s, i, c);
        for (size_t j = 0; j < points; j++) y[j] = chebyshev(c, s->degree, 2.0 * (double)j / (points - 1) - 1);
        snprintf(name[i], sizeof *name, "f_%zu", i + 1);
        curve[i] = (nh_curve){.name = name[i], .count = points, .x = x, .x_stride = 1, .y = y, .y_stride = 1};
    }
    snprintf(title, sizeof title, "Coefficient functions of %.100s", f->name);
    nh_plot plot = {.title = title,
                    .description = "The coefficient functions over their variable",
                    .x_label = nh_name_of(r->model->dag, s->variable[0]),
                    .y_label = n == 1 ? name[0] : "value",
                    .curves = n,
                    .curve = curve};
    nh_pen_plot(p, &plot,
                s->variables == 1 ? "The coefficient functions."
                                  : "The coefficient functions, with the other variables in the middle of the box.");
    nh_free(c);
    nh_free(x);
}

/* Is term z too small to be printed?  A page shows only some of the many terms of series in several variables. */
static bool is_small(const nh_series *s, size_t z)
{
    static const double seen = 1e-10;
    bool small = true;
    for (size_t i = 0; i < s->words; i++) small &= fabs(s->coefficient[i * s->stride + z]) < seen;
    return small;
}

/* c_k for the functions from..to-1. */
static void coefficients(nh_pen *p, const nh_series *s, size_t from, size_t to)
{
    nh_text heads;
    nh_text_init(&heads);
    nh_text_add(&heads, "k");
    for (size_t i = from; i < to; i++) nh_text_addf(&heads, "|f%zu", i + 1);
    nh_pen_table(p,
                 s->index ? "Coefficients of products of T_k, one k for each edge of the box, mapped to [-1, 1]"
                          : "Coefficients of T_k on the interval mapped to [-1, 1]",
                 nh_text_string(&heads));
    nh_text_clear(&heads);
    for (size_t k = 0; k < (s->index ? s->stride : s->degree + 1); k++) {
        char index[64];
        size_t used = 0;
        if (s->index && is_small(s, k)) continue;
        for (size_t j = 0; j < s->variables; j++)
            used += (size_t)snprintf(index + used, sizeof index - used, "%s%zu", j ? ", " : "",
                                     s->index ? s->index[k * s->variables + j] : k);
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        nh_pen_cell(p, NH_PEN_ROW_HEAD, "%s", index);
        for (size_t i = from; i < to; i++) nh_pen_cell(p, NH_PEN_CELL, "%.10g", s->coefficient[i * s->stride + k]);
        nh_pen_close(p, NH_PEN_ROW);
    }
    nh_pen_table_end(p);
}

/* "Each f is a Chebyshev series .." */
static void series_words(nh_pen *p, const nh_analysis *r, const nh_series *s)
{
    bool several = s->variables > 1;
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "Each f is a Chebyshev series of %sdegree %zu in ", several ? "total " : "", s->degree);
    for (size_t j = 0; j < s->variables; j++)
        nh_pen_say(p, "%s<%s>",
                   j == 0                 ? ""
                   : j + 1 < s->variables ? ", "
                                          : " and ",
                   nh_name_of(r->model->dag, s->variable[j]));
    nh_pen_say(p, ", without closed form among the functions of the search, on ");
    for (size_t j = 0; j < s->variables && several; j++)
        nh_pen_say(p, "%s<%s> in [%.6g, %.6g]", j ? ", " : "the box ", nh_name_of(r->model->dag, s->variable[j]),
                   s->low[j], s->high[j]);
    if (!several) nh_pen_say(p, "[%.6g, %.6g]", s->low[0], s->high[0]);
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
}

/* Phi = f_1(q) word_1 + ... */
void nh_analysis_write_series(nh_pen *p, const nh_analysis *r, const nh_current *f)
{
    enum { beside = 4 }; /* as many functions as a page is wide enough for */
    const nh_series *s = f->series;
    nh_text q;
    nh_text_init(&q);
    for (size_t j = 0; j < s->variables; j++)
        nh_text_addf(&q, "%s<%s>", j ? ", " : "", nh_name_of(r->model->dag, s->variable[j]));
    nh_sheet *sheet = nh_sheet_create(r->arena, r->model->dag);
    sheet->shown = r->options.shown;
    nh_sheet_begin(sheet, "", "", "");
    nh_sheet_sum(sheet, "", nh_sheet_label(sheet, "<%s>", f->name));
    for (size_t i = 0; i < s->words; i++)
        nh_sheet_add(sheet, s->word[i], nh_sheet_label(sheet, "f_{%zu}(%s)", i + 1, nh_text_string(&q)));
    nh_pen_sheet(p, sheet);
    nh_text_clear(&q);
    series_words(p, r, s);
    series_plot(p, r, f);
    if (p->ink->brief) return; /* the JSON has all of them */
    nh_pen_open(p, NH_PEN_FOLD, NULL, "Chebyshev coefficients");
    for (size_t i = 0; i < s->words; i += beside) coefficients(p, s, i, i + beside < s->words ? i + beside : s->words);
    nh_pen_close(p, NH_PEN_FOLD);
}
