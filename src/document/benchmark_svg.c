/* benchmark_svg: the comparison as a drawing: rows of plots side by side, with their names above and what the signs
 * mean below. */
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "base/memory.h"
#include "document/benchmark.h"
#include "document/benchmark_internal.h"
#include "document/svg_internal.h"

enum { gap = 16, head = 64, title_line = 22, line = 18, letters = 165, margin = 24 };

/* Words in lines of so many letters; returns the y below them. */
static double paragraph(const char *words, double y, nh_text *out)
{
    while (*words) {
        size_t n = strlen(words);
        if (n > letters)
            for (n = letters; n > 1 && words[n] != ' ';) n--;
        nh_text part;
        nh_text_init(&part);
        nh_text_add_n(&part, words, n);
        nh_text_addf(out, "<text class=\"note\" x=\"%d\" y=\"%.0f\">", NH_SVG_LEFT, y);
        nh_escape_xml(nh_text_string(&part), out);
        nh_text_add(out, "</text>\n");
        nh_text_clear(&part);
        words += n;
        while (*words == ' ') words++;
        y += line;
    }
    return y;
}

static void heading(const char *words, const char *css, double y, nh_text *out)
{
    nh_text_addf(out, "<text class=\"%s\" x=\"%d\" y=\"%.0f\">", css, NH_SVG_LEFT, y);
    nh_escape_xml(words, out);
    nh_text_add(out, "</text>\n");
}

static double put_row(nh_benchmark_row *row, size_t number, double wide, double y, nh_text *out)
{
    char id[48];
    for (size_t k = 0; k < row->panels; k++) row->panel[k].bare = true;
    heading(row->title, "row", y + title_line, out);
    y += title_line + 8;
    nh_text_addf(out, "<g transform=\"translate(0 %.0f)\">", y);
    y += nh_svg_legend(&row->panel[0], wide, out) + 6;
    nh_text_add(out, "</g>\n");
    for (size_t k = 0; k < row->panels; k++) {
        snprintf(id, sizeof id, "row%zu-%zu", number + 1, k + 1);
        row->panel[k].id = id;
        nh_text_addf(out, "<g transform=\"translate(%.0f %.0f)\">", (double)k * (NH_SVG_WIDTH + gap), y);
        nh_svg_plot(&row->panel[k], out);
        nh_text_add(out, "</g>\n");
    }
    return paragraph(row->caption, y + row->panel[0].tall + line, out) + gap;
}

void nh_benchmark_svg(const nh_benchmark *c, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    const nh_system *system = c->question->system;
    nh_benchmark_row row[NH_BENCHMARK_ROWS];
    size_t rows = nh_benchmark_rows(c, arena, row), panels = 2;
    nh_text body;
    nh_text_init(&body);
    for (size_t i = 0; i < rows; i++) panels = row[i].panels > panels ? row[i].panels : panels;
    double wide = (double)(panels * NH_SVG_WIDTH + (panels - 1) * gap), y = head;
    heading(system->title ? system->title : system->name, "title", 30, &body);
    nh_text words;
    nh_text_init(&words);
    nh_benchmark_put_reference(c, &words);
    y = paragraph(nh_text_string(&words), 52, &body) + 6;
    nh_text_clear(&words);
    for (size_t i = 0; i < rows; i++) y = put_row(&row[i], i, wide, y, &body);
    nh_text_addf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" font-family=\"sans-serif\" "
        "font-size=\"13\">\n<style>.title{font-size:20px;font-weight:bold}.row{font-size:15px;font-weight:bold}"
        ".note{fill:#444}text.tick,text.label{fill:#444;font-size:12px}text.legend{fill:#222}</style>\n"
        "<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fff\"/>\n%s</svg>\n",
        wide, y + margin, wide, y + margin, nh_text_string(&body));
    nh_text_clear(&body);
    nh_arena_free(arena);
}
