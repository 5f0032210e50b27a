/* export_code: the body of a function in any language: names, then the unknowns, then the results. */
#include <string.h>

#include "document/export_code.h"

#include "graph/dag.h"
#include "graph/node.h"

const char *const *nh_export_members(const nh_export *x, const nh_source_language *language, nh_arena *arena)
{
    const nh_system *system = x->system;
    const char **out = nh_arena_alloc(arena, (system->parameters + 1) * sizeof *out);
    nh_source *names = nh_source_create(language, system->dag, NULL);
    for (size_t i = 0; i < system->parameters; i++)
        out[i] = nh_arena_strdup(arena, nh_source_word(names, system->parameter[i].name));
    nh_source_free(names);
    return out;
}

size_t nh_export_expressions(const nh_export_function *f, nh_arena *arena, nh_ex **out)
{
    size_t n = 0;
    for (size_t i = 0; i < f->solves; i++) n += f->solve[i].n * (f->solve[i].n + 1);
    for (size_t i = 0; i < f->results; i++) n += f->result[i].rows * f->result[i].columns;
    nh_ex *e = *out = nh_arena_alloc(arena, (n + 1) * sizeof *e);
    for (size_t i = 0; i < f->solves; i++) {
        const nh_export_solve *s = &f->solve[i];
        memcpy(e, s->matrix, s->n * s->n * sizeof *e);
        memcpy(e + s->n * s->n, s->right, s->n * sizeof *e);
        e += s->n * (s->n + 1);
    }
    for (size_t i = 0; i < f->results; i++) {
        memcpy(e, f->result[i].e, f->result[i].rows * f->result[i].columns * sizeof *e);
        e += f->result[i].rows * f->result[i].columns;
    }
    return n;
}

/* Counts every node that the function needs. */
static bool *used_nodes(const nh_export_function *f, nh_arena *arena)
{
    const nh_dag *d = f->dag;
    size_t size = nh_dag_size(d);
    bool *used = nh_arena_alloc(arena, (size + 1) * sizeof *used);
    nh_ex *e;
    for (size_t n = nh_export_expressions(f, arena, &e); n-- > 0;) used[e[n]] = true;
    for (size_t at = size; at-- > 0;) {
        nh_ex x = (nh_ex)at;
        nh_kind kind = nh_kind_of(d, x);
        if (!used[x] || kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        for (size_t i = 0; i < nh_arity(d, x); i++) {
            used[nh_child(d, x, i)] = true;
            if (kind == NH_PRODUCT) used[nh_exponent_of(d, x, i)] = true;
        }
    }
    return used;
}

/* Reserves the function's own names first, so that no symbol gets one of them. */
static void name_arrays(nh_export_body *b)
{
    const nh_export_function *f = b->f;
    b->time = nh_source_word(b->code, "t");
    for (size_t i = 0; i < f->arguments; i++) b->argument[i] = nh_source_word(b->code, f->argument[i].name);
    for (size_t i = 0; i < f->results; i++) b->result[i] = nh_source_word(b->code, f->result[i].name);
    b->inputs = nh_source_word(b->code, "inputs");
    b->parameters = nh_source_word(b->code, "parameters");
    for (size_t i = 0; i < f->solves; i++) {
        b->unknown[i] = nh_source_word(b->code, i ? "x_2" : "x_1");
        b->matrix[i] = nh_source_word(b->code, i ? "A_2" : "A_1");
        b->right[i] = nh_source_word(b->code, i ? "b_2" : "b_1");
    }
}

static void unpack(const nh_export_form *form, nh_export_body *b, const bool *used)
{
    const nh_export_function *f = b->f;
    size_t inputs = 0;
    nh_source_set(b->code, f->system->t, b->time);
    for (size_t i = 0; i < f->arguments; i++) {
        bool guess = false;
        for (size_t k = 0; k < f->solves; k++) guess = guess || (f->solve[k].newton && f->solve[k].guess == i);
        for (size_t j = 0; j < f->argument[i].rows && !guess; j++)
            if (used[f->argument[i].e[j]])
                form->unpack(b, nh_source_name(b->code, f->argument[i].e[j]), b->argument[i], j);
    }
    for (size_t i = 0; i < f->system->parameters; i++) {
        nh_ex symbol = f->system->parameter[i].symbol;
        bool input = b->x->input[i];
        if (used[symbol] && input) form->unpack(b, nh_source_name(b->code, symbol), b->inputs, inputs);
        else if (used[symbol]) form->parameter(b, nh_source_name(b->code, symbol), b->member[i]);
        inputs += input;
    }
}

static void put_newton(const nh_export_form *form, nh_export_body *b, size_t i)
{
    const nh_export_solve *s = &b->f->solve[i];
    nh_ex *all = nh_alloc_array(s->n * (s->n + 1) + 1, sizeof *all);
    memcpy(all, s->matrix, s->n * s->n * sizeof *all);
    memcpy(all + s->n * s->n, s->right, s->n * sizeof *all);
    nh_source_open(b->code);
    nh_source_plan(b->code, s->n * (s->n + 1), all);
    form->newton(b, i);
    for (size_t k = 0; k < s->n; k++) form->unpack(b, nh_source_name(b->code, s->unknown[k]), b->unknown[i], k);
    nh_source_parts(b->code, s->n * (s->n + 1), all);
    form->fill(b, b->matrix[i], s->n, s->n, s->matrix);
    form->fill(b, b->right[i], s->n, 0, s->right);
    form->newton_end(b, i);
    nh_source_close(b->code);
    nh_free(all);
}

static void put_solve(const nh_export_form *form, nh_export_body *b, size_t i)
{
    const nh_export_solve *s = &b->f->solve[i];
    if (s->newton) {
        put_newton(form, b, i);
    } else {
        nh_source_parts(b->code, s->n * s->n, s->matrix);
        nh_source_parts(b->code, s->n, s->right);
        form->fill(b, b->matrix[i], s->n, s->n, s->matrix);
        form->fill(b, b->right[i], s->n, 0, s->right);
        form->solve(b, i);
    }
}

void nh_export_indent(nh_export_body *b, const char *indent)
{
    b->indent = indent;
    nh_source_indent(b->code, indent);
}

bool nh_export_put_body(const nh_export_form *form, const nh_export *x, const nh_export_function *f, const char *prefix,
                        const char *const *member, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    nh_export_body b = {.x = x,
                        .f = f,
                        .prefix = prefix,
                        .member = member,
                        .out = out,
                        .code = nh_source_create(form->language, f->dag, out)};
    bool *used = used_nodes(f, arena);
    nh_ex *e;
    nh_export_indent(&b, "    ");
    name_arrays(&b);
    form->begin(&b);
    unpack(form, &b, used);
    size_t n = nh_export_expressions(f, arena, &e), skip = 0;
    for (size_t i = 0; i < f->solves; i++) /* iterations come first, and each has a plan of its own */
        if (f->solve[i].newton) skip += f->solve[i].n * (f->solve[i].n + 1);
    nh_source_plan(b.code, n - skip, e + skip);
    for (size_t i = 0; i < f->solves; i++) {
        put_solve(form, &b, i);
        for (size_t k = 0; k < f->solve[i].n; k++)
            if (used[f->solve[i].unknown[k]])
                form->unpack(&b, nh_source_name(b.code, f->solve[i].unknown[k]), b.unknown[i], k);
    }
    for (size_t i = 0; i < f->results; i++)
        nh_source_parts(b.code, f->result[i].rows * f->result[i].columns, f->result[i].e);
    form->end(&b);
    bool sign = nh_source_has_sign(b.code);
    nh_source_free(b.code);
    nh_arena_free(arena);
    return sign;
}
