/* export_json: functions as data (docs/schema/export.json): expressions in the language of system files. */
#include <string.h>

#include "base/json.h"
#include "document/export_internal.h"

typedef struct {
    nh_source *code;
    nh_text lines;
} writer;

static void add_expression(writer *w, nh_json *list, nh_ex e)
{
    nh_source_put(w->code, e);
    nh_json_add_text(list, nh_text_string(&w->lines));
    nh_text_clear(&w->lines);
}

static void put_expressions(writer *w, nh_json *to, const char *key, size_t n, const nh_ex *e)
{
    nh_json *list = nh_json_put_array(to, key);
    for (size_t i = 0; i < n; i++) add_expression(w, list, e[i]);
}

/* The statements that the code has written. */
static void add_statements(writer *w, nh_json *list)
{
    for (char *line = w->lines.data; line && *line;) {
        size_t length = strcspn(line, "\n");
        char *equal = strstr(line, " = ");
        line[length] = *equal = 0;
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "kind", "assign");
        nh_json_put_text(item, "name", line);
        nh_json_put_text(item, "value", equal + 3);
        line += length + 1;
    }
    nh_text_clear(&w->lines);
}

/* The statements of an iteration are kept apart: they hold for the unknowns of one step. */
static void add_solve(writer *w, const nh_export_function *f, const nh_export_solve *s, nh_json *list)
{
    nh_json *item = s->newton ? nh_json_add_object(list) : NULL;
    if (s->newton) {
        nh_json_put_text(item, "kind", "newton");
        nh_json_put_text(item, "guess", f->argument[s->guess].name);
        list = nh_json_put_array(item, "statements");
        nh_source_open(w->code);
        nh_source_plan(w->code, s->n * s->n, s->matrix);
        nh_source_plan(w->code, s->n, s->right);
    }
    nh_source_parts(w->code, s->n * s->n, s->matrix);
    nh_source_parts(w->code, s->n, s->right);
    add_statements(w, list);
    if (!item) nh_json_put_text(item = nh_json_add_object(list), "kind", "solve");
    put_expressions(w, item, "unknown", s->n, s->unknown);
    nh_json *rows = nh_json_put_array(item, "matrix");
    for (size_t i = 0; i < s->n; i++) {
        nh_json *row = nh_json_add_array(rows);
        for (size_t k = 0; k < s->n; k++) add_expression(w, row, s->matrix[i * s->n + k]);
    }
    put_expressions(w, item, "right", s->n, s->right);
    if (s->newton) nh_source_close(w->code);
}

static void put_labels(const nh_export_function *f, const nh_export_array *a, nh_json *item)
{
    nh_json *list = nh_json_put_array(item, "labels");
    for (size_t i = 0; i < a->rows; i++) {
        const char *label = nh_export_label(f, a, i);
        nh_json_add_text(list, label);
    }
}

static void put_array(writer *w, const nh_export_function *f, const nh_export_array *a, nh_json *list)
{
    nh_json *item = nh_json_add_object(list);
    nh_json_put_text(item, "name", a->name);
    nh_json_put_text(item, "doc", a->doc);
    nh_json_put_number(item, "rows", (double)a->rows);
    nh_json_put_number(item, "columns", (double)a->columns);
    put_labels(f, a, item);
    put_expressions(w, item, "entries", a->rows * a->columns, a->e);
}

static void put_function(const nh_export *x, const nh_export_function *f, nh_json *list)
{
    nh_arena *arena = nh_arena_create();
    nh_ex *e;
    nh_text words;
    writer w;
    nh_text_init(&w.lines);
    w.code = nh_source_create(&nh_source_plain, f->dag, &w.lines);
    nh_json *item = nh_json_add_object(list);
    nh_text_init(&words);
    nh_export_words(x, f, "", &words);
    nh_json_put_text(item, "name", f->name);
    nh_json_put_text(item, "part", nh_export_part_name(f->part));
    nh_json_put_text(item, "doc", nh_text_string(&words));
    nh_text_clear(&words);
    nh_source_set(w.code, f->system->t, "t");
    nh_json *arguments = nh_json_put_array(item, "arguments"), *statements = nh_json_put_array(item, "statements"),
            *results = nh_json_put_array(item, "results");
    for (size_t i = 0; i < f->arguments; i++) put_array(&w, f, &f->argument[i], arguments);
    size_t n = nh_export_expressions(f, arena, &e);
    nh_source_plan(w.code, n, e);
    for (size_t i = 0; i < f->solves; i++) add_solve(&w, f, &f->solve[i], statements);
    for (size_t i = 0; i < f->results; i++)
        nh_source_parts(w.code, f->result[i].rows * f->result[i].columns, f->result[i].e);
    add_statements(&w, statements);
    for (size_t i = 0; i < f->results; i++) put_array(&w, f, &f->result[i], results);
    nh_source_free(w.code);
    nh_text_clear(&w.lines);
    nh_arena_free(arena);
}

char *nh_export_json(const nh_export *x, const nh_run *run)
{
    const nh_system *system = x->system;
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", system->name);
    nh_json *coordinates = nh_json_put_array(root, "coordinates"), *inputs = nh_json_put_array(root, "inputs");
    for (size_t i = 0; i < system->coordinates; i++) nh_json_add_text(coordinates, system->coordinate[i].name);
    for (size_t i = 0; i < system->parameters; i++)
        if (x->input[i]) nh_json_add_text(inputs, system->parameter[i].name);
    nh_json *functions = nh_json_put_array(root, "functions"), *notes = nh_json_put_array(root, "notes");
    for (size_t i = 0; i < x->functions; i++) put_function(x, &x->function[i], functions);
    for (size_t i = 0; i < x->notes; i++) nh_json_add_text(notes, x->note[i]);
    nh_json_put_bool(root, "partial", x->partial);
    if (run) nh_run_json(run, system, root);
    return nh_json_finish(root);
}
