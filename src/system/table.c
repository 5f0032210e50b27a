/* table: reads separated values: a line of names, then rows with as many fields. */
#include "system/table.h"

#include <stdint.h>
#include <string.h>
#include <strings.h>

#include "base/files.h"
#include "base/text.h"

enum { most_bytes = 1 << 28 };

/* The field at *at, without blanks and quotes around it; *at moves behind the separator, or to the end. */
static const char *next_field(nh_arena *arena, const char **at, char separator, bool *more)
{
    const char *blanks = separator == '\t' ? " " : " \t", *c = *at + strspn(*at, blanks);
    bool quoted = *c == '"';
    size_t n = 0;
    char *out = nh_arena_alloc(arena, strlen(c) + 1);
    if (quoted) c++;
    while (*c && (quoted ? *c != '"' || c[1] == '"' : *c != separator)) {
        if (quoted && *c == '"') c++;
        out[n++] = *c++;
    }
    while (quoted && *c && *c != separator) c++;
    while (!quoted && n && strchr(blanks, out[n - 1])) n--;
    out[n] = 0;
    *more = *c == separator;
    *at = c + *more;
    return out;
}

static size_t fields_of(const char *line, char separator)
{
    size_t n = 1;
    bool quoted = false;
    for (; *line; line++) {
        if (*line == '"') quoted = !quoted;
        n += *line == separator && !quoted;
    }
    return n;
}

/* What separates the names of a line: semicolons, otherwise commas, otherwise tabs. */
static char separator_of(const char *line)
{
    return fields_of(line, ';') > 1 ? ';' : fields_of(line, ',') == 1 && fields_of(line, '\t') > 1 ? '\t' : ',';
}

static void read_fields(nh_arena *arena, const char *line, const nh_table *t, char separator, const char **out)
{
    bool more = true;
    size_t skipped = t->index;
    for (size_t i = 0; more; i++) {
        const char *field = next_field(arena, &line, separator, &more);
        if (i >= skipped) out[i - skipped] = field;
    }
}

/* The line of names.  The first column is left out where it has no name: tables of pandas begin with the numbers of
 * their rows. */
static void read_names(nh_arena *arena, nh_table *t, const char *line, char separator)
{
    size_t fields = fields_of(line, separator);
    t->name = nh_arena_alloc(arena, fields * sizeof *t->name);
    read_fields(arena, line, t, separator, t->name);
    t->index = fields > 1 && (!*t->name[0] || !strcmp(t->name[0], "Unnamed: 0"));
    t->columns = fields - t->index;
    t->name += t->index;
}

static bool read_line(nh_arena *arena, nh_table *t, const char *line, char separator, size_t number, nh_error *error)
{
    size_t fields = fields_of(line, separator);
    if (fields != t->columns + t->index)
        return nh_fail(error, NH_INPUT, nh_arena_printf(arena, "%s:%zu", t->path, number),
                       "this line has %zu fields, but the line of names has %zu", fields, t->columns + t->index);
    t->line[t->rows] = number;
    read_fields(arena, line, t, separator, t->cell + t->rows++ * t->columns);
    return true;
}

/* Has a number the comma of decimals, 0,5 or -1,2e3? */
static bool has_comma(const char *cell)
{
    size_t sign = strspn(cell, "+-"), whole = strspn(cell + sign, "0123456789");
    const char *comma = cell + sign + whole;
    return sign < 2 && whole && *comma == ',' && comma[strspn(comma + 1, "0123456789eE+-") + 1] == 0 && comma[1];
}

/* Between semicolons or tabs, 0,5 is a number unless another one of the file has a point: then 1,234 may be a
 * thousand. */
static bool read_commas(nh_arena *arena, nh_table *t, nh_error *error)
{
    size_t point = SIZE_MAX, comma = SIZE_MAX, cells = t->rows * t->columns;
    double value;
    for (size_t i = 0; i < cells; i++) {
        if (has_comma(t->cell[i])) comma = comma == SIZE_MAX ? i : comma;
        else if (strchr(t->cell[i], '.') && nh_text_to_number(t->cell[i], &value)) point = i;
    }
    if (comma < SIZE_MAX && point < SIZE_MAX) {
        nh_fail(error, NH_INPUT, nh_arena_printf(arena, "%s:%zu", t->path, t->line[comma / t->columns]),
                "decimals stand behind a comma in `%s` and behind a point in `%s` of line %zu", t->cell[comma],
                t->cell[point], t->line[point / t->columns]);
        return nh_error_hint(error, "write all numbers with a point, without marks between thousands");
    }
    for (size_t i = 0; i < cells && comma < SIZE_MAX; i++) {
        if (!has_comma(t->cell[i])) continue;
        char *cell = nh_arena_strdup(arena, t->cell[i]);
        *strchr(cell, ',') = '.';
        t->cell[i] = cell;
    }
    return true;
}

/* Cuts the text at the ends of its lines. */
static bool read_lines(nh_arena *arena, nh_table *t, char *text, nh_error *error)
{
    size_t lines = 1, number = 0, fields = 0;
    char separator = 0;
    for (const char *c = text; *c; c++) lines += *c == '\n', fields += *c == ',' || *c == ';' || *c == '\t';
    t->line = nh_arena_alloc(arena, lines * sizeof *t->line);
    t->cell = nh_arena_alloc(arena, (fields + lines) * sizeof *t->cell);
    for (char *rest = text, *line; (line = strsep(&rest, "\n"));) {
        number++;
        line[strcspn(line, "\r")] = 0;
        if (!line[strspn(line, " \t")] || *line == '#') continue;
        if (t->columns && (t->rows + 1) * t->columns > fields + lines)
            return nh_fail(error, NH_INPUT, t->path, "the lines have different numbers of fields");
        if (!separator) t->heading = number, read_names(arena, t, line, separator = separator_of(line));
        else if (!read_line(arena, t, line, separator, number, error)) return false;
    }
    return separator == ',' || read_commas(arena, t, error);
}

nh_table *nh_table_read(nh_arena *arena, const char *path, nh_error *error)
{
    static const char mark[] = "\xef\xbb\xbf"; /* a byte order mark, with which some programs begin files */
    size_t length;
    char *text = nh_files_read(path, most_bytes, &length, error);
    if (!text) return NULL;
    nh_table *t = nh_arena_alloc(arena, sizeof *t);
    t->path = nh_arena_strdup(arena, path);
    bool good =
        length <= most_bytes || nh_fail(error, NH_INPUT, path, "the table is longer than %d bytes", (int)most_bytes);
    if (good && memchr(text, 0, length)) good = nh_fail(error, NH_INPUT, path, "the table contains a zero byte");
    /* the text that was read has no terminating zero */
    char *lines = good ? nh_arena_strndup(arena, text, length) : NULL;
    nh_free(text);
    if (good)
        good = read_lines(arena, t, strncmp(lines, mark, sizeof mark - 1) ? lines : lines + sizeof mark - 1, error);
    if (good && !t->rows)
        good =
            nh_fail(error, NH_INPUT, path, "the table has no rows: a line of names comes first, then one line per row");
    return good ? t : NULL;
}

static void hint_columns(const nh_table *t, nh_error *error)
{
    nh_text list;
    nh_text_init(&list);
    for (size_t i = 0; i < t->columns; i++) nh_text_addf(&list, "%s%s", i ? ", " : "", t->name[i]);
    nh_error_hint(error, "its columns are %s", nh_text_string(&list));
    nh_text_clear(&list);
}

bool nh_table_is_time(const char *name)
{
    size_t word = strncasecmp(name, "time", strlen("time")) ? *name == 't' : strlen("time");
    const char *unit = name + word + strspn(name + word, " _");
    bool second = !strcmp(unit, "[s]") || !strcmp(unit, "(s)") || (!strcmp(unit, "s") && unit[-1] == '_');
    return word && (!*unit || second);
}

size_t nh_table_column(const nh_table *t, const char *name, nh_error *error)
{
    for (size_t i = 0; i < t->columns; i++)
        if (!strcmp(t->name[i], name)) return i;
    for (size_t i = 0; i < t->columns && !strcmp(name, "t"); i++)
        if (nh_table_is_time(t->name[i])) return i;
    const char *near = nh_text_nearest(name, t->name, t->columns);
    nh_fail(error, NH_INPUT, t->path, "there is no column `%s`", name);
    if (near) nh_error_hint(error, "did you mean `%s`?", near);
    else hint_columns(t, error);
    return t->columns;
}

bool nh_table_number(nh_arena *arena, const nh_table *t, size_t row, size_t column, double *out, nh_error *error)
{
    const char *cell = t->cell[row * t->columns + column];
    if (nh_text_to_number(cell, out)) return true;
    return nh_fail(error, NH_INPUT, nh_arena_printf(arena, "%s:%zu", t->path, t->line[row]),
                   "`%s` needs a number, found `%s`", t->name[column], cell);
}
