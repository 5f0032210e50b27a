#include "document/linearized.h"

#include <math.h>
#include <string.h>

#include "base/json.h"
#include "base/memory.h"
#include "graph/node.h"

const char *nh_linearized_word(nh_linear_verdict v)
{
    static const char *const word[] = {"not steady", "unknown", "unstable", "stable", "stable but for 0", "marginal"};
    return word[v];
}

const char *nh_linearized_sentence(nh_linear_verdict v)
{
    static const char *const sentence[] = {
        "The state is not steady, or its linear equations change with time: their matrix is that of this moment, and "
        "its eigenvalues do not decide about stability.",
        "No eigenvalues were enclosed.",
        "Unstable: an eigenvalue has a positive real part.",
        "Asymptotically stable in the variables of the matrix: all eigenvalues have negative real parts.",
        "All eigenvalues but 0 have negative real parts. Where the eigenvalue 0 stands for a family of steady motions "
        "of as many dimensions, the motion is stable, and motions nearby tend to the family (Lyapunov and Malkin).",
        "Marginal: no eigenvalue has a positive real part, but some have none. The linear equations do not decide "
        "about stability."};
    return sentence[v];
}

/* ---- JSON ---- */

static void put_matrix(nh_json *to, const char *key, size_t rows, size_t columns, const double *x)
{
    nh_json *matrix = nh_json_put_array(to, key);
    for (size_t i = 0; i < rows; i++) {
        nh_json *row = nh_json_add_array(matrix);
        for (size_t j = 0; j < columns; j++) nh_json_add_number(row, x[i * columns + j]);
    }
}

static void put_state(const nh_linearized *x, const nh_linear_equations *e, nh_json *to)
{
    nh_json *state = nh_json_put_object(to, "state"), *rates = nh_json_put_object(to, "accelerations");
    nh_json_put_number(state, "t", e->t);
    for (size_t i = 0; i < e->m; i++) nh_json_put_number(state, x->system->coordinate[i].name, e->q[i]);
    for (size_t i = 0; i < e->m; i++)
        nh_json_put_number(state, nh_name_of(x->system->dag, x->system->coordinate[i].v), e->v[i]);
    for (size_t i = 0; i < e->m; i++) nh_json_put_number(rates, x->system->coordinate[i].name, e->a[i]);
}

/* x, w; or those of the closed rest, or the others. */
static void put_names(const nh_linearized *x, const nh_linear_equations *e, nh_json *to, const char *key, size_t from,
                      size_t end, int closed)
{
    nh_json *list = nh_json_put_array(to, key);
    for (size_t i = from; i < end; i++)
        if (closed < 0 || e->closed[i] == (closed > 0)) nh_json_add_text(list, nh_linearize_name(x, e, i));
}

static void put_eigenvalues(const nh_linear_equations *e, nh_json *to)
{
    nh_json *list = nh_json_put_array(to, "eigenvalues");
    for (size_t i = 0; i < e->eigenvalues; i++) {
        const nh_eigenvalue *z = &e->eigenvalue[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "re", z->re);
        nh_json_put_number(item, "im", z->im);
        nh_json_put_number(item, "error", z->error);
        nh_json_put_number(item, "times", (double)z->times);
    }
}

static void put_equations(const nh_linearized *x, const nh_linear_row *row, nh_json *to)
{
    const nh_linear_equations *e = row->equations;
    if (x->over) nh_json_put_number(to, "value", row->value.value);
    nh_json_put_text(to, "why", row->why);
    nh_json_put_text(to, "verdict", e ? nh_linearized_word(row->verdict) : NULL);
    if (!e) return;
    nh_json_put_number(to, "positive", (double)row->positive);
    nh_json_put_bool(to, "steady", e->residual == 0);
    nh_json_put_bool(to, "changes", e->changes);
    nh_json_put_number(to, "residual", e->residual);
    put_state(x, e, to);
    put_names(x, e, to, "coordinates", 0, e->s, -1);
    put_names(x, e, to, "velocities", e->s, e->s + e->n, -1);
    put_names(x, e, to, "closed", 0, e->s + e->n, 1);
    put_names(x, e, to, "left_out", 0, e->s + e->n, 0);
    put_eigenvalues(e, to);
    put_matrix(to, "M", e->n, e->n, e->M);
    put_matrix(to, "C", e->n, e->n, e->C);
    put_matrix(to, "K", e->n, e->s, e->N);
    put_matrix(to, "A", e->s + e->n, e->s + e->n, e->A);
    put_matrix(to, "R", e->m, e->n, e->R);
    put_matrix(to, "S", e->m, e->m, e->S);
    put_matrix(to, "T", e->m, e->s, e->T);
    nh_json_put_number(to, "error", e->error);
}

char *nh_linearized_json(const nh_linearized *x, const nh_run *run)
{
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", x->system->name);
    nh_json_put_text(root, "at", x->at);
    nh_json_put_text(root, "over", x->over);
    nh_json_put_bool(root, "partial", x->partial);
    if (!x->over) put_equations(x, &x->row[0], root);
    else {
        nh_json *rows = nh_json_put_array(root, "rows"), *changes = nh_json_put_array(root, "changes");
        for (size_t i = 0; i < x->rows; i++) put_equations(x, &x->row[i], nh_json_add_object(rows));
        for (size_t i = 0; i < x->changes; i++) {
            const nh_linear_change *c = &x->change[i];
            nh_json *item = nh_json_add_object(changes);
            nh_json_put_number(item, "value", c->low + (c->high - c->low) / 2);
            nh_json_put_number(item, "error", (c->high - c->low) / 2);
            nh_json_put_text(item, "before", nh_linearized_word(c->before));
            nh_json_put_text(item, "after", nh_linearized_word(c->after));
            nh_json_put_number(item, "positive_before", (double)c->positive_before);
            nh_json_put_number(item, "positive_after", (double)c->positive_after);
        }
    }
    if (run) nh_run_json(run, x->system, root);
    return nh_json_finish(root);
}

/* ---- tables ---- */

static void number(nh_text *out, double x)
{
    char text[40];
    if (!isfinite(x)) return;
    nh_text_number(x, text, sizeof text);
    nh_text_add(out, text);
}

static void eigenvalue_rows(const nh_linear_equations *e, nh_text *out)
{
    nh_text_add(out, "re,im,error,times\n");
    for (size_t i = 0; i < e->eigenvalues; i++) {
        const nh_eigenvalue *z = &e->eigenvalue[i];
        number(out, z->re);
        nh_text_add(out, ",");
        number(out, z->im);
        nh_text_addf(out, ",%.2g,%zu\n", z->error, z->times);
    }
}

void nh_linearized_csv(const nh_linearized *x, nh_text *out)
{
    if (!x->over) {
        eigenvalue_rows(x->row[0].equations, out);
        return;
    }
    nh_text_addf(out, "%s,verdict,positive", x->over);
    for (size_t b = 0; b < x->branches; b++) nh_text_addf(out, ",re%zu,im%zu", b + 1, b + 1);
    nh_text_add(out, "\n");
    for (size_t i = 0; i < x->rows; i++) {
        const nh_linear_row *row = &x->row[i];
        number(out, row->value.value);
        nh_text_addf(out, ",%s,", row->equations ? nh_linearized_word(row->verdict) : "");
        if (row->equations) nh_text_addf(out, "%zu", row->positive);
        for (size_t b = 0; b < x->branches; b++) {
            nh_text_add(out, ",");
            number(out, x->re[i * x->branches + b]);
            nh_text_add(out, ",");
            number(out, x->im[i * x->branches + b]);
        }
        nh_text_add(out, "\n");
    }
}

static void entries(const nh_linearized *x, const nh_linear_row *row, char letter, const double *matrix, size_t first,
                    size_t rows, size_t columns, size_t column, nh_text *out)
{
    for (size_t i = 0; i < rows * columns; i++) {
        if (x->over) number(out, row->value.value), nh_text_add(out, ",");
        nh_text_addf(out, "%c,%s,%s,", letter, nh_linearize_name(x, row->equations, first + i / columns),
                     nh_linearize_name(x, row->equations, column + i % columns));
        number(out, matrix[i]);
        nh_text_add(out, "\n");
    }
}

void nh_linearized_matrices_csv(const nh_linearized *x, nh_text *out)
{
    if (x->over) nh_text_addf(out, "%s,", x->over);
    nh_text_add(out, "matrix,row,column,entry\n");
    for (size_t i = 0; i < x->rows; i++) {
        const nh_linear_row *row = &x->row[i];
        const nh_linear_equations *e = row->equations;
        if (!e) continue;
        entries(x, row, 'M', e->M, e->s, e->n, e->n, e->s, out);
        entries(x, row, 'C', e->C, e->s, e->n, e->n, e->s, out);
        entries(x, row, 'K', e->N, e->s, e->n, e->s, 0, out);
        entries(x, row, 'A', e->A, 0, e->s + e->n, e->s + e->n, 0, out);
    }
}

/* ---- the picture ---- */

static nh_plot in_the_plane(const nh_linearized *x, nh_curve **curves)
{
    const nh_linear_equations *e = x->row[0].equations;
    static const char name[] = "eigenvalues";
    static const double zero[2] = {0, 0};
    *curves = nh_alloc_array(1, sizeof **curves);
    size_t stride = sizeof *e->eigenvalue / sizeof(double);
    **curves = (nh_curve){.name = name,
                          .count = e->eigenvalues,
                          .x = &e->eigenvalue[0].re,
                          .y = &e->eigenvalue[0].im,
                          .x_stride = stride,
                          .y_stride = stride,
                          .dots = true};
    return (nh_plot){.id = "eigenvalues",
                     .title = "Eigenvalues",
                     .description = "The eigenvalues in the plane",
                     .x_label = "real part",
                     .y_label = "imaginary part",
                     .also_x = zero,
                     .also_y = zero,
                     .fan = true,
                     .curves = 1,
                     .curve = *curves};
}

nh_plot nh_linearized_plot(const nh_linearized *x, nh_curve **curves)
{
    if (!x->over) return in_the_plane(x, curves);
    static const double zero[2] = {0, 0};
    size_t n = x->branches;
    *curves = nh_alloc_array(2 * n + 1, sizeof **curves);
    for (size_t b = 0; b < 2 * n; b++)
        (*curves)[b] = (nh_curve){.name = nh_arena_printf(x->arena, b < n ? "Re %zu" : "Im %zu", b % n + 1),
                                  .count = x->rows,
                                  .x = &x->row[0].value.value,
                                  .x_stride = sizeof *x->row / sizeof(double),
                                  .y = (b < n ? x->re : x->im) + b % n,
                                  .y_stride = n,
                                  .dots = true};
    return (nh_plot){.id = "eigenvalues",
                     .title = "Eigenvalues",
                     .description = "Real and imaginary parts",
                     .x_label = x->over,
                     .y_label = "real and imaginary parts",
                     .also_y = zero,
                     .curves = 2 * n,
                     .curve = *curves};
}

void nh_linearized_svg(const nh_linearized *x, nh_text *out)
{
    nh_curve *curves;
    nh_plot plot = nh_linearized_plot(x, &curves);
    nh_svg_plot(&plot, out);
    nh_free(curves);
}
