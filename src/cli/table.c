/* table: comma-separated values as a table for people, on a terminal. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/cli.h"

enum { most_columns = 64, most_rows = 32, screen_width = 80, digits = 10, cell_room = 40 };

typedef struct {
    size_t count, length[most_columns];
    const char *cell[most_columns];
} csv_row;

static const char *read_row(const char *at, csv_row *row)
{
    row->count = 0;
    for (bool more = true; more; at++) {
        size_t length = strcspn(at, ",\n");
        if (row->count < most_columns) row->cell[row->count] = at, row->length[row->count++] = length;
        at += length;
        more = *at == ',';
        if (!*at) return at;
    }
    return at;
}

/* A number with ten digits, with a blank in the place of a sign. */
static void put_cell(const csv_row *row, size_t k, char out[cell_room])
{
    char *end;
    double value = strtod(row->cell[k], &end);
    bool number = row->length[k] && end == row->cell[k] + row->length[k];
    if (number) snprintf(out, cell_room, "% .*g", digits, value);
    else snprintf(out, cell_room, " %.*s", (int)row->length[k], row->cell[k]);
}

static bool is_rate(const csv_row *head, size_t k)
{
    static const char rate[] = "_dot";
    size_t n = sizeof rate - 1;
    return head->length[k] > n && !strncmp(head->cell[k] + head->length[k] - n, rate, n);
}

/* Which columns are shown: those that fit, rates of coordinates last. */
static void choose(const csv_row *head, const size_t *width, bool all, bool *shown)
{
    size_t used = 0;
    for (int rates = 0; rates < 2; rates++)
        for (size_t k = 0; k < head->count; k++) {
            if (is_rate(head, k) != (rates == 1)) continue;
            shown[k] = all || used + width[k] + 1 <= screen_width || !k;
            used += shown[k] ? width[k] + 1 : screen_width;
        }
}

static void put_row(const csv_row *row, const size_t *width, const bool *shown, nh_text *out)
{
    size_t blanks = 0;
    for (size_t k = 0; k < row->count; k++) {
        char cell[cell_room];
        if (!shown[k]) continue;
        put_cell(row, k, cell);
        nh_text_addf(out, "%*s%s", (int)blanks, "", k ? cell : cell + 1);
        size_t wide = nh_text_width(cell) - !k;
        blanks = 1 + (width[k] > wide ? width[k] - wide : 0);
    }
    nh_text_add(out, "\n");
}

void nh_cli_table(const char *csv, bool all, nh_text *out)
{
    csv_row head, row;
    size_t width[most_columns] = {0}, rows = 0, told = 0;
    bool shown[most_columns] = {false};
    const char *body = read_row(csv, &head);
    for (const char *at = csv; *at; rows++) {
        at = read_row(at, &row);
        for (size_t k = 0; k < row.count; k++) {
            char cell[cell_room];
            put_cell(&row, k, cell);
            if (nh_text_width(cell) > width[k]) width[k] = nh_text_width(cell);
        }
    }
    rows -= rows > 0;
    choose(&head, width, all, shown);
    put_row(&head, width, shown, out);
    size_t i = 0, kept = rows < most_rows || all ? rows : most_rows, next = 0;
    for (const char *at = body; *at; i++) {
        at = read_row(at, &row);
        if (i != (kept > 1 ? next * (rows - 1) / (kept - 1) : 0)) continue;
        put_row(&row, width, shown, out);
        next++;
    }
    if (kept < rows) nh_text_addf(out, "%zu of %zu rows", kept, rows);
    for (size_t k = 0; k < head.count; k++) {
        if (shown[k]) continue;
        const char *between = told ? ", " : kept < rows ? "; more columns: " : "More columns: ";
        nh_text_addf(out, "%s%.*s", between, (int)head.length[k], head.cell[k]);
        told++;
    }
    if (told || kept < rows) nh_text_add(out, "\nAll of them: --details, --csv FILE, or in a pipe.\n");
}
