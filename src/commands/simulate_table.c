/* simulate_table: a table of motions: each row is an initial state, or a value per parameter, or both. */
#include <stdio.h>
#include <string.h>

#include "commands/simulate_internal.h"
#include "graph/node.h"
#include "system/table.h"

typedef enum { COLUMN_STATE, COLUMN_PARAMETER } column_kind;

static bool is_parameter(const nh_system *system, const char *name)
{
    for (size_t i = 0; i < system->parameters; i++)
        if (!strcmp(system->parameter[i].name, name)) return true;
    return false;
}

static const char *names_of(nh_arena *arena, const char *const *names, size_t n)
{
    const char *out = names[0];
    for (size_t i = 1; i < n; i++) out = nh_arena_printf(arena, "%s, %s", out, names[i]);
    return out;
}

/* Is it a coordinate, a velocity or the time?  Otherwise an error with a suggestion. */
static bool is_state(nh_arena *arena, const nh_table *t, const nh_system *system, const char *name, nh_error *error)
{
    size_t n = 0;
    const char **names =
        nh_arena_alloc(arena, (2 * system->coordinates + system->quasi + system->parameters + 1) * sizeof *names);
    names[n++] = "t";
    for (size_t i = 0; i < system->coordinates; i++) names[n++] = system->coordinate[i].name;
    for (size_t i = 0; i < system->coordinates; i++) names[n++] = nh_name_of(system->dag, system->coordinate[i].v);
    for (size_t i = 0; i < system->quasi; i++) names[n++] = nh_name_of(system->dag, system->quasi_velocity[i]);
    for (size_t i = 0; i < n; i++)
        if (!strcmp(names[i], name)) return true;
    for (size_t i = 0; i < system->parameters; i++) names[n++] = system->parameter[i].name;
    bool option = !strncmp(t->path, "--", 2); /* --over makes a table, too */
    nh_fail(error, option ? NH_USAGE : NH_INPUT, t->path, "%s`%s` is not a coordinate, velocity or parameter of %s",
            option ? "" : "the column ", name, system->name);
    const char *near = nh_text_nearest(name, names, n), *q = nh_system_velocity_meant(system, name, near);
    if (q) return nh_error_hint(error, NH_VELOCITY_IS_WRITTEN, q, q);
    return near ? nh_error_hint(error, "did you mean `%s`?", near)
                : nh_error_hint(error, "it has %s", names_of(arena, names, n));
}

/* The entries of the request's initial state for names that have no column in the table. */
static void keep_given(const char *given, size_t columns, const char *const *name, nh_text *words)
{
    for (const char *at = given; at && *at; at += *at == ',') {
        size_t length = nh_text_entry(at, ","), blank = strspn(at, " "), end = strcspn(at, "= ,");
        if (blank) end = blank + strcspn(at + blank, "= ,");
        bool taken = end <= blank;
        for (size_t j = 0; j < columns; j++)
            taken |= strlen(name[j]) == end - blank && !strncmp(name[j], at + blank, end - blank);
        if (!taken) nh_text_addf(words, "%s%.*s", words->length ? ", " : "", (int)(length - blank), at + blank);
        at += length;
    }
}

/* Writes the row as text after --initial and as settings, after those of the request. */
static bool read_row(nh_arena *arena, const char *given, const nh_table *t, size_t row, const char *const *name,
                     const column_kind *kind, nh_simulate_row *out, nh_error *error)
{
    nh_text words, cells;
    nh_text_init(&words);
    nh_text_init(&cells);
    bool good = true;
    out->from = nh_arena_printf(arena, "%s:%zu", t->path, t->line[row]);
    out->setting = nh_arena_alloc(arena, t->columns * sizeof *out->setting);
    for (size_t j = 0; j < t->columns && good; j++) {
        const char *cell = t->cell[row * t->columns + j];
        if (*cell) nh_text_addf(&cells, "%s%s = %s", cells.length ? ", " : "", name[j], cell);
        if (kind[j] == COLUMN_STATE && *cell) nh_text_addf(&words, "%s%s=%s", words.length ? ", " : "", name[j], cell);
        if (kind[j] == COLUMN_STATE) continue;
        nh_setting *p = &out->setting[out->settings++];
        p->name = name[j];
        good = nh_table_number(arena, t, row, j, &p->value, error);
    }
    if (words.length) keep_given(given, t->columns, name, &words);
    out->initial = words.length ? nh_arena_strdup(arena, nh_text_string(&words)) : NULL;
    out->name = nh_arena_strdup(arena, nh_text_string(&cells));
    nh_text_clear(&words);
    nh_text_clear(&cells);
    return good;
}

bool nh_simulate_rows_read(nh_arena *arena, const nh_request *q, const char *path, nh_simulate_rows *out,
                           nh_error *error)
{
    nh_table *t = nh_table_read(arena, path, error);
    nh_system *system = t ? nh_system_read(q->system_path, q->settings, q->setting, error) : NULL;
    if (!system) return false;
    const char **name = nh_arena_alloc(arena, t->columns * sizeof *name);
    column_kind *kind = nh_arena_alloc(arena, t->columns * sizeof *kind);
    bool good = true;
    *out = (nh_simulate_rows){.row = nh_arena_alloc(arena, t->rows * sizeof *out->row)};
    for (size_t j = 0; j < t->columns && good; j++) {
        name[j] =
            nh_arena_strdup(arena, nh_system_state_name(system, t->name[j])); /* the system goes before the table */
        bool own = is_parameter(system, name[j]) || nh_system_coordinate(system, name[j]) >= 0;
        if (!own && nh_table_is_time(name[j])) name[j] = "t";
        kind[j] = is_parameter(system, name[j]) ? COLUMN_PARAMETER : COLUMN_STATE;
        out->parameters += kind[j] == COLUMN_PARAMETER;
        if (kind[j] == COLUMN_STATE) good = is_state(arena, t, system, name[j], error);
    }
    nh_system_free(system);
    for (; out->count < t->rows && good; out->count++)
        good = read_row(arena, q->initial, t, out->count, name, kind, &out->row[out->count], error);
    return good;
}

void nh_simulate_row_blame(const nh_simulate_row *row, nh_error *error)
{
    if (error->code != NH_OK && !error->where[0]) snprintf(error->where, sizeof error->where, "%s", row->from);
}

bool nh_simulate_row_start(nh_simulation *s, const nh_simulate_row *row, nh_dynamics *d, double time, bool project,
                           double *z, nh_error *error)
{
    nh_analysis_file *own = nh_simulate_initial(row->from, row->initial ? row->initial : "", error);
    bool good = own && nh_analysis_file_resolve(own, s->model, error);
    if (good && own->initial.t != time)
        good = nh_fail(error, NH_INPUT, row->from,
                       "all motions of a table begin at one time, but t is %g here and %g in the first row",
                       own->initial.t, time);
    good = good && nh_dynamics_start(d, &own->initial, project, z, error);
    nh_simulate_row_blame(row, error);
    nh_analysis_file_free(own);
    return good;
}
