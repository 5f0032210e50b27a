/* table: files of values with a line of names: initial states, and inputs over time.  Semicolons, commas or tabs
 * separate them, as in the line of names; numbers between semicolons or tabs may have a decimal comma. */
#ifndef NH_TABLE_H
#define NH_TABLE_H

#include "base/error.h"
#include "base/memory.h"

typedef struct {
    const char *path;
    size_t columns, rows;
    size_t index;      /* 1: a first column without a name, the numbers of rows, is left out; otherwise 0 */
    const char **name; /* columns */
    const char **cell; /* rows x columns, row by row: text, which may be empty */
    size_t heading;    /* the line of names in the file, from 1 */
    size_t *line;      /* rows: likewise */
} nh_table;

/* In the arena; fields may stand in double quotes, empty lines and those that begin with # are left out.  NULL with
   file and line. */
nh_table *nh_table_read(nh_arena *arena, const char *path, nh_error *error);
/* Is it a name of the time: t, time, Time [s], t (s), time_s?  Where there is no column t, such a one is it. */
bool nh_table_is_time(const char *name);
/* The column of that name; `columns` with a suggestion when there is none. */
size_t nh_table_column(const nh_table *table, const char *name, nh_error *error);
/* The number in a cell; false with its place. */
bool nh_table_number(nh_arena *arena, const nh_table *table, size_t row, size_t column, double *out, nh_error *error);

#endif
