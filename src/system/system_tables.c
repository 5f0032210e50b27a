/* system_tables: `tables: [{name: V, file: potential.csv, in: [x, y]}]`, smooth functions through measured values. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/spline.h"
#include "graph/declared.h"
#include "graph/parse.h"
#include "system/system_internal.h"
#include "system/table.h"

typedef nh_system_reader reader;

/* A table while it is read: its columns of numbers, one or two variables before the value. */
typedef struct {
    const nh_table *t;
    size_t variables;
    const char *const *letter;
    double *column[3];
} values;

static bool fail_form(reader *r, const nh_deck_node *node)
{
    nh_deck_fail(r->deck, node, 0, r->error, "a table was expected: {name: V, file: potential.csv, in: [x, y]}");
    return nh_error_hint(r->error, "`in` names the columns of one variable or two, the function's name that of its "
                                   "values; `column: U` names another one, `spline: akima` another curve");
}

/* An error at a line of the table. */
static bool fail_line(reader *r, const nh_table *t, size_t row, const char *what, const char *hint)
{
    char where[sizeof r->error->where];
    snprintf(where, sizeof where, "%s:%zu", t->path, t->line[row]);
    nh_fail(r->error, NH_INPUT, where, "%s", what);
    return nh_error_hint(r->error, "%s", hint);
}

static bool read_columns(reader *r, values *v, const char *column)
{
    const nh_table *t = v->t;
    for (size_t k = 0; k <= v->variables; k++) {
        size_t at = nh_table_column(t, k < v->variables ? v->letter[k] : column, r->error);
        if (at == t->columns) return false;
        v->column[k] = nh_system_take(r, t->rows, sizeof **v->column);
        for (size_t i = 0; i < t->rows; i++)
            if (!nh_table_number(r->system->arena, t, i, at, &v->column[k][i], r->error)) return false;
    }
    return true;
}

static const char sorted[] = "sort the rows by the columns of `in`, each ascending, without repetitions";

static bool check_ascending(reader *r, const values *v)
{
    const double *x = v->column[0];
    for (size_t i = 1; i < v->t->rows; i++)
        if (!(x[i] > x[i - 1])) return fail_line(r, v->t, i, "the rows are not sorted", sorted);
    return true;
}

/* The rows are those of a rectangle, the second variable changing first; writes the numbers of nodes, y and where they
 * are not the whole rectangle a message. */
static bool check_rectangle(reader *r, const values *v, size_t *nx, size_t *ny)
{
    size_t rows = v->t->rows;
    const double *x = v->column[0], *y = v->column[1];
    for (*ny = 1; *ny < rows && x[*ny] == x[0]; ++*ny)
        if (!(y[*ny] > y[*ny - 1])) return fail_line(r, v->t, *ny, "the rows are not sorted", sorted);
    *nx = rows / *ny;
    for (size_t i = 0; i < rows; i++) {
        size_t at = i % *ny;
        if (y[i] != y[at] || x[i] != x[i - at] || (i >= *ny && at == 0 && !(x[i] > x[i - *ny])))
            return fail_line(r, v->t, i,
                             "the rows are no sorted rectangle: each value of the first column needs the "
                             "same values of the second",
                             sorted);
    }
    if (*nx * *ny == rows) return true;
    return fail_line(r, v->t, rows - 1, "the last rows are missing: the table is no whole rectangle", sorted);
}

static bool make(reader *r, size_t f, const values *v, bool akima)
{
    nh_arena *arena = r->system->arena;
    size_t nx = v->t->rows, ny = 1;
    if (v->variables == 1 ? !check_ascending(r, v) : !check_rectangle(r, v, &nx, &ny)) return false;
    if (nx < NH_SPLINE_LEAST || (v->variables == 2 && ny < NH_SPLINE_LEAST)) {
        nh_fail(r->error, NH_INPUT, v->t->path, "a table needs %d values of each variable or more", NH_SPLINE_LEAST);
        return false;
    }
    double *x = nh_system_take(r, nx, sizeof *x);
    for (size_t i = 0; i < nx; i++) x[i] = v->column[0][i * ny];
    const double *y = v->variables == 2 ? v->column[1] : NULL;
    nh_declared_give_table(r->system->dag, f, nh_spline_create(arena, akima, nx, x, ny, y, v->column[v->variables]),
                           v->letter);
    return true;
}

/* `in: [x, y]` or `in: r`. */
static bool read_letters(reader *r, const nh_deck_node *item, const nh_deck_node *in, values *v)
{
    const nh_deck_node *const *each = in->kind == NH_DECK_LIST ? in->item : &in;
    v->variables = in->kind == NH_DECK_LIST ? in->count : 1;
    if (v->variables < 1 || v->variables > 2) return fail_form(r, item);
    const char **letter = nh_system_take(r, v->variables, sizeof *letter);
    for (size_t k = 0; k < v->variables; k++) {
        if (each[k]->kind != NH_DECK_SCALAR) return fail_form(r, item);
        letter[k] = each[k]->text;
    }
    v->letter = letter;
    return true;
}

static bool read_table(reader *r, const nh_deck_node *item)
{
    static const char *const keys[] = {"name", "file", "in", "column", "spline", "doc"}, *const curves[] = {"cubic",
                                                                                                            "akima"};
    if (item->kind != NH_DECK_MAP) return fail_form(r, item);
    if (!nh_deck_only(r->deck, item, keys, sizeof keys / sizeof *keys, r->error)) return false;
    const nh_deck_node *name = nh_deck_get(item, "name"), *file = nh_deck_get(item, "file"),
                       *in = nh_deck_get(item, "in"), *curve = nh_deck_get(item, "spline");
    const char *column;
    values v = {0};
    if (!name || !file || !in || name->kind != NH_DECK_SCALAR || file->kind != NH_DECK_SCALAR)
        return fail_form(r, item);
    if (!nh_system_new_name(r, name) || !nh_system_text_of(r, item, "column", name->text, &column) ||
        !read_letters(r, item, in, &v))
        return false;
    bool akima = curve && curve->kind == NH_DECK_SCALAR && !strcmp(curve->text, "akima");
    if (curve && !akima && (curve->kind != NH_DECK_SCALAR || strcmp(curve->text, "cubic"))) {
        nh_deck_fail(r->deck, curve, 0, r->error, "a spline is `cubic` or `akima`");
        return nh_error_hint_near(r->error, curve->text ? curve->text : "", curves, 2, "in two variables it is cubic");
    }
    if (akima && v.variables == 2)
        return nh_deck_fail(r->deck, curve, 0, r->error, "in two variables splines are cubic");
    const char *path = nh_deck_beside(r->deck, file);
    nh_error unreadable;
    nh_error_clear(&unreadable);
    v.t = nh_table_read(r->system->arena, path, &unreadable);
    if (!v.t && !strstr(unreadable.what, "cannot be opened")) return *r->error = unreadable, false;
    if (!v.t) {
        nh_deck_fail(r->deck, file, 0, r->error, "the file `%s` cannot be opened", path);
        return nh_error_hint(r->error, "the name of a table is relative to the folder of the file that names it");
    }
    return read_columns(r, &v, column) && make(r, nh_declared_add(r->system->dag, name->text), &v, akima);
}

bool nh_system_read_tables(reader *r)
{
    const nh_deck_node *list;
    size_t n;
    if (!nh_system_list_of(r, r->root, "tables", &list, &n)) return false;
    for (size_t i = 0; i < n; i++)
        if (!read_table(r, list->item[i])) return false;
    return true;
}
