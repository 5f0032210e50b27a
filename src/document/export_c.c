/* export_c: C99 that is C++, too: a header and a source.  Each function returns 0, or -1 where a linear system is
 * singular. */
#include <ctype.h>
#include <string.h>

#include "base/escape.h"
#include "document/export_internal.h"

static const char solver[] = "/* x = A^-1 b by elimination with pivots, rows scaled; A (n x n, row by row) is "
                             "overwritten, x stands in b.  0, or -1 where A is singular. */\n"
                             "static int nh_solve(int n, double *A, double *b)\n"
                             "{\n"
                             "    for (int i = 0; i < n; i++) {\n"
                             "        double size = 0;\n"
                             "        for (int k = 0; k < n; k++) size = fmax(size, fabs(A[i*n + k]));\n"
                             "        if (!(size > 0)) return -1;\n"
                             "        for (int k = 0; k < n; k++) A[i*n + k] /= size;\n"
                             "        b[i] /= size;\n"
                             "    }\n"
                             "    for (int j = 0; j < n; j++) {\n"
                             "        int pivot = j;\n"
                             "        for (int i = j + 1; i < n; i++)\n"
                             "            if (fabs(A[i*n + j]) > fabs(A[pivot*n + j])) pivot = i;\n"
                             "        if (!(fabs(A[pivot*n + j]) > 0)) return -1;\n"
                             "        if (pivot != j) {\n"
                             "            for (int k = j; k < n; k++) {\n"
                             "                const double other = A[pivot*n + k];\n"
                             "                A[pivot*n + k] = A[j*n + k];\n"
                             "                A[j*n + k] = other;\n"
                             "            }\n"
                             "            const double other = b[pivot];\n"
                             "            b[pivot] = b[j];\n"
                             "            b[j] = other;\n"
                             "        }\n"
                             "        for (int i = j + 1; i < n; i++) {\n"
                             "            const double factor = A[i*n + j]/A[j*n + j];\n"
                             "            if (factor == 0) continue;\n"
                             "            for (int k = j + 1; k < n; k++) A[i*n + k] -= factor*A[j*n + k];\n"
                             "            b[i] -= factor*b[j];\n"
                             "        }\n"
                             "    }\n"
                             "    for (int i = n - 1; i >= 0; i--) {\n"
                             "        for (int k = i + 1; k < n; k++) b[i] -= A[i*n + k]*b[k];\n"
                             "        b[i] /= A[i*n + i];\n"
                             "    }\n"
                             "    return 0;\n"
                             "}\n"
                             "\n";

static const char sign[] = "static double nh_sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : x; }\n\n";

/* ---- declarations ---- */

static bool has_parameters(const nh_export *x) { return x->system->parameters > x->inputs; }

/* int NAME(double t, const double q[3], .., double rate[6]) */
static void put_declaration(const nh_export *x, const nh_export_function *f, const char *prefix, const char *time,
                            const char *const *argument, const char *inputs, const char *parameters,
                            const char *const *result, nh_text *out)
{
    nh_text_addf(out, "int %s_%s(double %s", prefix, f->name, time);
    for (size_t i = 0; i < f->arguments; i++)
        nh_text_addf(out, ", const double %s[%zu]", argument[i], f->argument[i].rows);
    if (x->inputs) nh_text_addf(out, ", const double %s[%zu]", inputs, x->inputs);
    if (has_parameters(x)) nh_text_addf(out, ", const %s_parameters *%s", prefix, parameters);
    for (size_t i = 0; i < f->results; i++)
        nh_text_addf(out, ", double %s[%zu]", result[i], f->result[i].rows * f->result[i].columns);
    nh_text_add(out, ")");
}

static void put_comment_line(const char *before, const char *text, nh_text *out)
{
    nh_text_add(out, before);
    nh_escape_c_comment(text, out);
    nh_text_add(out, "\n");
}

/* The description of a function or an array, escaped for a comment. */
static void put_comment(const nh_export *x, const nh_export_function *f, nh_text *out)
{
    nh_text words, line;
    nh_text_init(&words);
    nh_export_words(x, f, "", &words);
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < (side ? f->results : f->arguments); i++) {
            const nh_export_array *a = side ? &f->result[i] : &f->argument[i];
            nh_text_init(&line);
            nh_export_array_words(f, a, &line);
            nh_text_addf(&words, "%s %s%s", side ? "->" : "  ", a->name,
                         a->columns > 1 ? " (a matrix, row by row): " : ": ");
            nh_text_addf(&words, "%s\n", nh_text_string(&line));
            nh_text_clear(&line);
        }
    const char *begin = "/* ";
    for (char *at = words.data; at && *at;) {
        size_t length = strcspn(at, "\n");
        bool more = at[length] != 0;
        at[length] = 0;
        put_comment_line(begin, at, out);
        at += length + more;
        begin = " * ";
    }
    nh_text_add(out, " */\n");
    nh_text_clear(&words);
}

static void put_parameters(const nh_export *x, const char *prefix, nh_text *out)
{
    const nh_system *s = x->system;
    nh_arena *arena = nh_arena_create();
    const char *const *member = nh_export_members(x, &nh_source_c, arena);
    if (has_parameters(x)) nh_text_addf(out, "typedef struct {\n");
    for (size_t i = 0; i < s->parameters; i++) {
        if (x->input[i]) continue;
        nh_text_addf(out, "    double %s;", member[i]);
        if (*s->parameter[i].doc || *s->parameter[i].unit) {
            nh_text_add(out, " /* ");
            nh_escape_c_comment(s->parameter[i].doc, out);
            if (*s->parameter[i].unit)
                nh_text_addf(out, "%s[%s]", *s->parameter[i].doc ? " " : "", s->parameter[i].unit);
            nh_text_add(out, " */");
        }
        nh_text_add(out, "\n");
    }
    if (has_parameters(x))
        nh_text_addf(
            out, "} %s_parameters;\n\n/* The values of the system file. */\nextern const %s_parameters %s_default;\n\n",
            prefix, prefix, prefix);
    nh_arena_free(arena);
    if (!x->inputs) return;
    nh_text_add(out, "/* inputs: ");
    for (size_t i = 0, k = 0; i < s->parameters; i++)
        if (x->input[i]) nh_text_addf(out, "%s%s", k++ ? ", " : "", s->parameter[i].name);
    nh_text_add(out, " */\n\n");
}

void nh_export_c_header(const nh_export *x, const char *prefix, nh_text *out)
{
    nh_text guard;
    nh_text_init(&guard);
    for (const char *c = prefix; *c; c++) nh_text_addf(&guard, "%c", toupper((unsigned char)*c));
    nh_text_add(out, "/*\n");
    nh_export_head(x, " * ", out);
    nh_text_addf(out,
                 " *\n * Each function returns 0, or -1 where a linear system is singular or an iteration does not "
                 "converge.  C99, or C++; link the mathematical library.\n */\n"
                 "#ifndef %s_H\n#define %s_H\n\n#ifdef __cplusplus\nextern \"C\" {\n#endif\n\n",
                 nh_text_string(&guard), nh_text_string(&guard));
    put_parameters(x, prefix, out);
    for (size_t i = 0; i < x->functions; i++) {
        const nh_export_function *f = &x->function[i];
        const char *argument[NH_EXPORT_MOST_ARRAYS], *result[NH_EXPORT_MOST_ARRAYS];
        for (size_t k = 0; k < f->arguments; k++) argument[k] = f->argument[k].name;
        for (size_t k = 0; k < f->results; k++) result[k] = f->result[k].name;
        put_comment(x, f, out);
        put_declaration(x, f, prefix, "t", argument, "inputs", "parameters", result, out);
        nh_text_add(out, ";\n\n");
    }
    nh_text_add(out, "#ifdef __cplusplus\n}\n#endif\n\n#endif\n");
    nh_text_clear(&guard);
}

/* ---- bodies ---- */

static void begin(nh_export_body *b)
{
    const nh_export_function *f = b->f;
    put_declaration(b->x, f, b->prefix, b->time, b->argument, b->inputs, b->parameters, b->result, b->out);
    nh_text_add(b->out, "\n{\n");
    nh_text_addf(b->out, "    (void)%s;", b->time);
    for (size_t i = 0; i < f->arguments; i++) nh_text_addf(b->out, " (void)%s;", b->argument[i]);
    if (b->x->inputs) nh_text_addf(b->out, " (void)%s;", b->inputs);
    if (has_parameters(b->x)) nh_text_addf(b->out, " (void)%s;", b->parameters);
    nh_text_add(b->out, "\n");
}

static void unpack(nh_export_body *b, const char *name, const char *array, size_t index)
{
    nh_text_addf(b->out, "%sconst double %s = %s[%zu];\n", b->indent, name, array, index);
}
static void parameter(nh_export_body *b, const char *name, const char *member)
{
    nh_text_addf(b->out, "    const double %s = %s->%s;\n", name, b->parameters, member);
}

static void put_entries(nh_export_body *b, const char *array, size_t n, const nh_ex *e, bool zeros)
{
    for (size_t i = 0; i < n; i++) {
        if (!zeros && nh_is_zero(b->f->dag, e[i])) continue;
        nh_text_addf(b->out, "%s%s[%zu] = ", b->indent, array, i);
        nh_source_put(b->code, e[i]);
        nh_text_add(b->out, ";\n");
    }
}

static void fill(nh_export_body *b, const char *array, size_t rows, size_t columns, const nh_ex *e)
{
    size_t n = rows * (columns ? columns : 1);
    nh_text_addf(b->out, "%sdouble %s[%zu] = {0};\n", b->indent, array, n);
    put_entries(b, array, n, e, false);
}

static void solve(nh_export_body *b, size_t i)
{
    nh_text_addf(b->out, "    if (nh_solve(%zu, %s, %s)) return -1;\n", b->f->solve[i].n, b->matrix[i], b->right[i]);
    b->unknown[i] = b->right[i];
}

/* The same loop as in nh_chart_complete: relative to the velocities, until rounding ends it. */
static void newton(nh_export_body *b, size_t i)
{
    const nh_export_solve *s = &b->f->solve[i];
    nh_text_addf(b->out,
                 "    double %s[%zu], last_ = HUGE_VAL;\n    for (int i_ = 0; i_ < %zu; i_++) %s[i_] = %s[i_];\n    "
                 "for (int step_ = 0;; step_++) {\n",
                 b->unknown[i], s->n, s->n, b->unknown[i], b->argument[s->guess]);
    nh_export_indent(b, "        ");
}

static void newton_end(nh_export_body *b, size_t i)
{
    size_t n = b->f->solve[i].n;
    const char *x = b->unknown[i], *step = b->right[i];
    nh_text_add(b->out, "        double change_ = 0, size_ = 0;\n");
    nh_text_addf(b->out, "        if (step_ == 40 || nh_solve(%zu, %s, %s)) return -1;\n", n, b->matrix[i], step);
    nh_text_addf(b->out, "        for (int i_ = 0; i_ < %zu; i_++) {\n            %s[i_] -= %s[i_];\n", n, x, step);
    nh_text_addf(b->out,
                 "            change_ = fmax(change_, fabs(%s[i_]));\n            size_ = fmax(size_, fabs(%s[i_]));\n "
                 "       }\n",
                 step, x);
    nh_text_add(
        b->out,
        "        if (change_ <= 4e-16*size_ || (change_ < 1e-13*fmax(size_, 1e-2) && change_ >= last_/2)) break;\n"
        "        last_ = change_;\n    }\n");
    nh_export_indent(b, "    ");
}

static void end(nh_export_body *b)
{
    for (size_t i = 0; i < b->f->results; i++)
        put_entries(b, b->result[i], b->f->result[i].rows * b->f->result[i].columns, b->f->result[i].e, true);
    nh_text_add(b->out, "    return 0;\n}\n\n");
}

static const nh_export_form form = {&nh_source_c, begin, unpack, parameter, fill, solve, newton, newton_end, end};

void nh_export_c_source(const nh_export *x, const char *prefix, bool include, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    const char *const *member = nh_export_members(x, &nh_source_c, arena);
    nh_text bodies;
    bool signs = false, solves = false;
    nh_text_init(&bodies);
    for (size_t i = 0; i < x->functions; i++) {
        signs |= nh_export_put_body(&form, x, &x->function[i], prefix, member, &bodies);
        solves |= x->function[i].solves > 0;
    }
    if (include) nh_text_addf(out, "#include \"%s.h\"\n\n", prefix);
    nh_source_libraries(&nh_source_c, nh_text_string(&bodies), out);
    nh_text_add(out, "#include <math.h>\n\n");
    nh_source_series(&nh_source_c, nh_text_string(&bodies), out);
    if (signs) nh_text_add(out, sign);
    if (solves) nh_text_add(out, solver);
    if (has_parameters(x)) nh_text_addf(out, "const %s_parameters %s_default = {", prefix, prefix);
    for (size_t i = 0, k = 0; i < x->system->parameters; i++) {
        char text[40];
        nh_text_number(x->system->parameter[i].value, text, sizeof text);
        if (!x->input[i]) nh_text_addf(out, "%s%s", k++ ? ", " : "", text);
    }
    if (has_parameters(x)) nh_text_add(out, "};\n\n");
    nh_text_add(out, nh_text_string(&bodies));
    nh_text_clear(&bodies);
    nh_arena_free(arena);
}
