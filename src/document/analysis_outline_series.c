/* A current without closed form: its words, its coefficient functions, their plot. */
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

static void series_plot(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    enum { points = 101, most = 7 };
    const nh_series *s = f->series;
    size_t n = s->words < most ? s->words : most;
    double *x = nh_alloc_array((n + 1) * points, sizeof *x);
    nh_curve curve[most];
    char name[most][24], title[200];
    for (size_t j = 0; j < points; j++) x[j] = s->low + (s->high - s->low) * (double)j / (points - 1);
    for (size_t i = 0; i < n; i++) {
        double *y = x + (i + 1) * points;
        for (size_t j = 0; j < points; j++)
            y[j] = chebyshev(s->coefficient + i * s->stride, s->degree, 2.0 * (double)j / (points - 1) - 1);
        snprintf(name[i], sizeof *name, "f_%zu", i + 1);
        curve[i] = (nh_curve){.name = name[i], .count = points, .x = x, .x_stride = 1, .y = y, .y_stride = 1};
    }
    snprintf(title, sizeof title, "Coefficient functions of %.100s", f->name);
    nh_plot plot = {.title = title,
                    .description = "The coefficient functions over their variable",
                    .x_label = nh_name_of(result->question->model->dag, s->variable),
                    .y_label = n == 1 ? name[0] : "value",
                    .curves = n,
                    .curve = curve};
    nh_pen_plot(p, &plot, "The coefficient functions.");
    nh_free(x);
}

/* c_k for the functions from..to-1. */
static void coefficients(nh_pen *p, const nh_series *s, size_t from, size_t to)
{
    nh_text heads;
    nh_text_init(&heads);
    nh_text_add(&heads, "k");
    for (size_t i = from; i < to; i++) nh_text_addf(&heads, "|f%zu", i + 1);
    nh_pen_table(p, "Coefficients of T_k on the interval mapped to [-1, 1]", nh_text_string(&heads));
    nh_text_clear(&heads);
    for (size_t k = 0; k <= s->degree; k++) {
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        char degree[24];
        snprintf(degree, sizeof degree, "%zu", k);
        nh_pen_cell(p, NH_PEN_ROW_HEAD, "%s", degree); /* no number to be read with all its digits */
        for (size_t i = from; i < to; i++) nh_pen_cell(p, NH_PEN_CELL, "%.10g", s->coefficient[i * s->stride + k]);
        nh_pen_close(p, NH_PEN_ROW);
    }
    nh_pen_table_end(p);
}

/* "Each f is a Chebyshev series .." */
static void series_words(nh_pen *p, const nh_analysis *result, const nh_series *s)
{
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p,
               "Each f is a Chebyshev series of degree %zu in <%s>, without closed form among the functions of the "
               "search, on [%.6g, %.6g].",
               s->degree, nh_name_of(result->question->model->dag, s->variable), s->low, s->high);
    nh_pen_close(p, NH_PEN_WORDS);
}

/* Phi = f_1(q) word_1 + ... */
void nh_analysis_write_series(nh_pen *p, const nh_analysis *result, const nh_current *f)
{
    enum { beside = 4 }; /* as many functions as a page is wide enough for */
    const nh_series *s = f->series;
    const char *q = nh_name_of(result->question->model->dag, s->variable);
    nh_sheet *sheet = nh_sheet_create(result->arena, result->question->model->dag);
    sheet->shown = result->question->options.shown;
    nh_sheet_begin(sheet, "", "", "");
    nh_sheet_sum(sheet, "", nh_sheet_label(sheet, "<%s>", f->name));
    for (size_t i = 0; i < s->words; i++)
        nh_sheet_add(sheet, s->word[i], nh_sheet_label(sheet, "f_{%zu}(<%s>)", i + 1, q));
    nh_pen_sheet(p, sheet);
    series_words(p, result, s);
    series_plot(p, result, f);
    if (p->ink->brief) return; /* the JSON has all of them */
    nh_pen_open(p, NH_PEN_FOLD, NULL, "Chebyshev coefficients");
    for (size_t i = 0; i < s->words; i += beside) coefficients(p, s, i, i + beside < s->words ? i + beside : s->words);
    nh_pen_close(p, NH_PEN_FOLD);
}
