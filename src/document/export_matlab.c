/* export_matlab: one file for MATLAB and Octave: a function that returns the others as a struct of handles. */
#include <string.h>

#include "base/escape.h"
#include "document/export_internal.h"

/* A comment ends with its line. */
static void put_comment(const char *indent, const char *text, nh_text *out)
{
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n");
        nh_text_addf(out, "%s%% ", indent);
        for (size_t i = 0; i < length; i++) nh_text_add_n(out, (unsigned char)line[i] < ' ' ? " " : line + i, 1);
        nh_text_add(out, "\n");
        line += length + (line[length] == '\n');
    }
}

static void begin(nh_export_body *b)
{
    const nh_export_function *f = b->f;
    nh_text words;
    nh_text_add(b->out, "\nfunction [");
    for (size_t i = 0; i < f->results; i++) nh_text_addf(b->out, "%s%s", i ? ", " : "", b->result[i]);
    nh_text_addf(b->out, "] = %s(%s", f->name, b->time);
    for (size_t i = 0; i < f->arguments; i++) nh_text_addf(b->out, ", %s", b->argument[i]);
    if (b->x->inputs) nh_text_addf(b->out, ", %s", b->inputs);
    nh_text_addf(b->out, ", %s)\n", b->parameters);
    nh_text_init(&words);
    nh_export_words(b->x, f, "", &words);
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < (side ? f->results : f->arguments); i++) {
            nh_text_addf(&words, "%s: ", side ? b->result[i] : b->argument[i]);
            nh_export_array_words(f, side ? &f->result[i] : &f->argument[i], &words);
            nh_text_add(&words, "\n");
        }
    put_comment("    ", nh_text_string(&words), b->out);
    nh_text_clear(&words);
}

static void unpack(nh_export_body *b, const char *name, const char *array, size_t index)
{
    nh_text_addf(b->out, "%s%s = %s(%zu);\n", b->indent, name, array, index + 1);
}
static void parameter(nh_export_body *b, const char *name, const char *member)
{
    nh_text_addf(b->out, "    %s = %s.%s;\n", name, b->parameters, member);
}

static void fill(nh_export_body *b, const char *array, size_t rows, size_t columns, const nh_ex *e)
{
    size_t width = columns ? columns : 1;
    nh_text_addf(b->out, "%s%s = zeros(%zu, %zu);\n", b->indent, array, rows, width);
    for (size_t i = 0; i < rows * width; i++) {
        if (nh_is_zero(b->f->dag, e[i])) continue;
        if (columns) nh_text_addf(b->out, "%s%s(%zu, %zu) = ", b->indent, array, i / width + 1, i % width + 1);
        else nh_text_addf(b->out, "%s%s(%zu) = ", b->indent, array, i + 1);
        nh_source_put(b->code, e[i]);
        nh_text_add(b->out, ";\n");
    }
}

static void solve(nh_export_body *b, size_t i)
{
    nh_text_addf(b->out, "    %s = %s\\%s;\n", b->unknown[i], b->matrix[i], b->right[i]);
}

static void newton(nh_export_body *b, size_t i)
{
    nh_text_addf(b->out, "    %s = %s(:);\n    last_ = Inf;\n    for step_ = 1:41\n", b->unknown[i],
                 b->argument[b->f->solve[i].guess]);
    nh_export_indent(b, "        ");
}

static void newton_end(nh_export_body *b, size_t i)
{
    const char *x = b->unknown[i], *step = b->right[i];
    nh_text_add(b->out, "        if step_ == 41, error('the iteration for velocities does not converge'); end\n");
    nh_text_addf(b->out, "        %s = %s\\%s;\n        %s = %s - %s;\n", step, b->matrix[i], step, x, x, step);
    nh_text_addf(b->out, "        change_ = max(abs(%s));\n        size_ = max(abs(%s));\n", step, x);
    nh_text_add(
        b->out,
        "        if change_ <= 4e-16*size_ || (change_ < 1e-13*max(size_, 1e-2) && change_ >= last_/2), break; end\n"
        "        last_ = change_;\n    end\n");
    nh_export_indent(b, "    ");
}

static void end(nh_export_body *b)
{
    for (size_t i = 0; i < b->f->results; i++) {
        const nh_export_array *a = &b->f->result[i];
        fill(b, b->result[i], a->rows, a->columns > 1 ? a->columns : 0, a->e);
    }
    nh_text_add(b->out, "end\n");
}

static const nh_export_form form = {&nh_source_matlab, begin, unpack, parameter, fill, solve, newton, newton_end, end};

void nh_export_matlab(const nh_export *x, const char *prefix, nh_text *out)
{
    const nh_system *system = x->system;
    nh_arena *arena = nh_arena_create();
    const char *const *member = nh_export_members(x, &nh_source_matlab, arena);
    nh_text head;
    nh_text_addf(out, "function api = %s()\n", prefix);
    nh_text_init(&head);
    nh_export_head(x, "", &head);
    nh_text_addf(
        &head, "api = %s() has the functions below as api.NAME, and the values of the system file as api.parameters.\n",
        prefix);
    put_comment("", nh_text_string(&head), out);
    nh_text_clear(&head);
    nh_text_add(out, "    api = struct();\n    api.parameters = struct();\n");
    for (size_t i = 0; i < system->parameters; i++) {
        char text[40];
        nh_text_number(system->parameter[i].value, text, sizeof text);
        if (!x->input[i]) nh_text_addf(out, "    api.parameters.%s = %s;\n", member[i], text);
    }
    for (size_t i = 0; i < x->functions; i++)
        nh_text_addf(out, "    api.%s = @%s;\n", x->function[i].name, x->function[i].name);
    nh_text_add(out, "end\n");
    for (size_t i = 0; i < x->functions; i++) nh_export_put_body(&form, x, &x->function[i], prefix, member, out);
    nh_arena_free(arena);
}
