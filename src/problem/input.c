/* input: a table of values over time as one expression.
 *
 * With the slopes s_i of the pieces from t_i to t_(i+1), and s = 0 before the first time and behind the last, the
 * broken line through (t_i, u_i), i = 0..N, is
 *
 *     u(t) = (u_0 + u_N)/2 + sum_i (s_i - s_(i-1))/2 |t - t_i|,
 *
 * and since the integrators end their steps at the zeros of what stands in an absolute value, no step goes over a
 * corner. */

#include <string.h>

#include "base/text.h"
#include "problem/input.h"
#include "system/table.h"

enum { most_corners = 1000 };

static bool read_values(nh_arena *arena, const nh_table *t, size_t time, size_t column, double *x, double *u,
                        nh_error *error)
{
    for (size_t i = 0; i < t->rows; i++) {
        if (!nh_table_number(arena, t, i, time, &x[i], error) || !nh_table_number(arena, t, i, column, &u[i], error))
            return false;
        if (i && !(x[i] > x[i - 1]))
            return nh_fail(error, NH_INPUT, nh_arena_printf(arena, "%s:%zu", t->path, t->line[i]),
                           "the times of an input must rise, but %g comes after %g", x[i], x[i - 1]);
    }
    return true;
}

static const char *broken_line(nh_arena *arena, size_t count, const double *x, const double *u)
{
    nh_text out;
    char number[40], corner[40];
    nh_text_init(&out);
    nh_text_number((u[0] + u[count - 1]) / 2, number, sizeof number);
    nh_text_add(&out, number);
    double before = 0;
    for (size_t i = 0; i < count; i++) {
        double slope = i + 1 < count ? (u[i + 1] - u[i]) / (x[i + 1] - x[i]) : 0;
        nh_text_number((slope - before) / 2, number, sizeof number);
        nh_text_number(x[i], corner, sizeof corner);
        if (slope != before) nh_text_addf(&out, " + (%s)*abs(t - (%s))", number, corner);
        before = slope;
    }
    const char *kept = nh_arena_strdup(arena, nh_text_string(&out));
    nh_text_clear(&out);
    return kept;
}

/* NULL: a file alone, of which a column is the value. */
static const char *no_column(nh_arena *arena, const char *name, const char *path, nh_error *error)
{
    nh_table *t = nh_table_read(arena, path, error);
    const char *column = NULL;
    for (size_t i = 0; t && i < t->columns; i++)
        if (!column && !nh_table_is_time(t->name[i])) column = t->name[i];
    if (!t) return NULL;
    nh_fail(error, NH_USAGE, "", "--input %s needs a column of %s", name, path);
    if (column)
        nh_error_hint(error, "for example --input \"%s=%s:%s\"; the file also has a column t, the time", name, path,
                      column);
    else nh_error_hint(error, "the file has only the column t: it needs another one with the values");
    return NULL;
}

const char *nh_input_text(nh_arena *arena, const char *name, const char *text, nh_error *error)
{
    static const char ending[] = ".csv";
    const char *colon = strrchr(text, ':');
    if (!colon && !strstr(text, ending)) return text;
    if (!colon) return no_column(arena, name, text, error);
    nh_table *t = nh_table_read(arena, nh_arena_strndup(arena, text, (size_t)(colon - text)), error);
    size_t time = t ? nh_table_column(t, "t", error) : 0,
           column = t && time < t->columns ? nh_table_column(t, colon + 1, error) : 0;
    if (!t || time == t->columns || column == t->columns) return NULL;
    if (t->rows > most_corners)
        return nh_fail(error, NH_INPUT, t->path, "an input has at most %d values, and this table has %zu", most_corners,
                       t->rows),
               NULL;
    double *x = nh_arena_alloc(arena, t->rows * sizeof *x), *u = nh_arena_alloc(arena, t->rows * sizeof *u);
    return read_values(arena, t, time, column, x, u, error) ? broken_line(arena, t->rows, x, u) : NULL;
}
