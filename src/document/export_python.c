/* export_python: a module for NumPy, whose functions also take arrays of many states, or one for SymPy, whose functions
 * take symbols and numbers. */
#include <ctype.h>
#include <string.h>

#include "base/escape.h"
#include "document/export_internal.h"

static const char numpy_head[] =
    "from collections import namedtuple\n"
    "\n"
    "import numpy as np\n"
    "\n"
    "\n"
    "def _array(entries):\n"
    "    \"\"\"A vector, or a matrix given by rows; entries are numbers or arrays of one shape.\"\"\"\n"
    "    try:\n"
    "        return np.array(entries, dtype=float)\n"
    "    except ValueError:  # numbers beside arrays\n"
    "        matrix = isinstance(entries[0], list)\n"
    "        flat = np.stack(np.broadcast_arrays(*(sum(entries, []) if matrix else entries)))\n"
    "        return flat.reshape(((len(entries), len(entries[0])) if matrix else (len(entries),)) + flat.shape[1:])\n"
    "\n"
    "\n"
    "def _solve(A, b):\n"
    "    \"\"\"A^-1 b, for each of many systems where the entries are arrays.\"\"\"\n"
    "    if b.ndim == 1 and A.ndim == 2:\n"
    "        return np.linalg.solve(A, b)\n"
    "    A, b = np.moveaxis(A, (0, 1), (-2, -1)), np.moveaxis(b, 0, -1)\n"
    "    many = np.broadcast_shapes(A.shape[:-2], b.shape[:-1])\n"
    "    A, b = np.broadcast_to(A, many + A.shape[-2:]), np.broadcast_to(b, many + b.shape[-1:])\n"
    "    return np.moveaxis(np.linalg.solve(A, b[..., None])[..., 0], -1, 0)\n"
    "\n"
    "\n"
    "def _small(step, x, last):\n"
    "    \"\"\"Is a step of an iteration no more than rounding, for each motion? And how long it is.\"\"\"\n"
    "    change, size = np.max(np.abs(step), axis=0), np.max(np.abs(x), axis=0)\n"
    "    return (change <= 4e-16*size) | ((change < 1e-13*np.maximum(size, 1e-2)) & (change >= last/2)), change\n";

static const char sympy_head[] = "from collections import namedtuple\n"
                                 "\n"
                                 "import sympy as sp\n"
                                 "\n"
                                 "\n"
                                 "def _array(entries):\n"
                                 "    return sp.Matrix(entries)\n"
                                 "\n"
                                 "\n"
                                 "def _solve(A, b):\n"
                                 "    return A.LUsolve(b)\n";

typedef struct {
    const nh_export *x;
    const char *const *member;
    const nh_source_language *language;
    nh_text *out;
    bool sympy;
} module;

/* ---- bodies ---- */

/* A text between triple quotes, on lines of its own. */
static void put_quoted(const char *indent, const char *text, nh_text *out)
{
    for (const char *line = text; *line;) {
        size_t length = strcspn(line, "\n");
        nh_text_add(out, indent);
        for (size_t i = 0; i < length; i++) {
            if (line[i] == '\\' || line[i] == '"') nh_text_add(out, "\\");
            nh_text_add_n(out, (unsigned char)line[i] < ' ' ? " " : line + i, 1);
        }
        nh_text_add(out, "\n");
        line += length + (line[length] == '\n');
    }
}

static void put_words(nh_export_body *b)
{
    nh_text words;
    nh_text_init(&words);
    nh_export_words(b->x, b->f, "", &words);
    for (int side = 0; side < 2; side++)
        for (size_t i = 0; i < (side ? b->f->results : b->f->arguments); i++) {
            const nh_export_array *a = side ? &b->f->result[i] : &b->f->argument[i];
            nh_text_addf(&words, "%s%s: ", side ? "returns " : "", side ? b->result[i] : b->argument[i]);
            nh_export_array_words(b->f, a, &words);
            nh_text_add(&words, "\n");
        }
    nh_text_add(b->out, "    \"\"\"\n");
    put_quoted("    ", nh_text_string(&words), b->out);
    nh_text_add(b->out, "    \"\"\"\n");
    nh_text_clear(&words);
}

static void begin(nh_export_body *b)
{
    nh_text_addf(b->out, "\n\ndef %s(%s", b->f->name, b->time);
    for (size_t i = 0; i < b->f->arguments; i++) nh_text_addf(b->out, ", %s", b->argument[i]);
    if (b->x->inputs) nh_text_addf(b->out, ", %s", b->inputs);
    nh_text_addf(b->out, ", %s=%s):\n", b->parameters, "parameters");
    put_words(b);
}

static void unpack(nh_export_body *b, const char *name, const char *array, size_t index)
{
    nh_text_addf(b->out, "%s%s = %s[%zu]\n", b->indent, name, array, index);
}
static void parameter(nh_export_body *b, const char *name, const char *member)
{
    nh_text_addf(b->out, "    %s = %s.%s\n", name, b->parameters, member);
}

static void put_row(nh_export_body *b, size_t n, const nh_ex *e)
{
    nh_text_add(b->out, "[");
    for (size_t i = 0; i < n; i++) {
        if (i) nh_text_add(b->out, ", ");
        nh_source_put(b->code, e[i]);
    }
    nh_text_add(b->out, "]");
}

static void put_array(nh_export_body *b, size_t rows, size_t columns, const nh_ex *e)
{
    nh_text_add(b->out, "_array(");
    if (!columns) put_row(b, rows, e);
    if (columns) nh_text_add(b->out, "[");
    for (size_t i = 0; columns && i < rows; i++) {
        if (i) nh_text_add(b->out, ",\n        ");
        put_row(b, columns, e + i * columns);
    }
    nh_text_add(b->out, columns ? "])" : ")");
}

static void fill(nh_export_body *b, const char *array, size_t rows, size_t columns, const nh_ex *e)
{
    nh_text_addf(b->out, "%s%s = ", b->indent, array);
    put_array(b, rows, columns, e);
    nh_text_add(b->out, "\n");
}

static void solve(nh_export_body *b, size_t i)
{
    nh_text_addf(b->out, "    %s = _solve(%s, %s)\n", b->unknown[i], b->matrix[i], b->right[i]);
}

static void newton(nh_export_body *b, size_t i)
{
    nh_text_addf(b->out,
                 "    %s = np.array(%s, dtype=float)\n    done_, last_ = False, np.inf\n    for step_ in range(40):\n",
                 b->unknown[i], b->argument[b->f->solve[i].guess]);
    nh_export_indent(b, "        ");
}

static void newton_end(nh_export_body *b, size_t i)
{
    nh_text_addf(
        b->out,
        "        step_ = _solve(%s, %s)\n        %s = %s - step_\n        small_, last_ = _small(step_, %s, last_)\n"
        "        done_ = done_ | small_\n        if np.all(done_):\n            break\n"
        "    else:\n        raise ArithmeticError(\"the iteration for velocities "
        "does not converge\")\n",
        b->matrix[i], b->right[i], b->unknown[i], b->unknown[i], b->unknown[i]);
    nh_export_indent(b, "    ");
}

static void end(nh_export_body *b)
{
    for (size_t i = 0; i < b->f->results; i++) {
        const nh_export_array *a = &b->f->result[i];
        fill(b, b->result[i], a->rows, a->columns > 1 ? a->columns : 0, a->e);
    }
    nh_text_add(b->out, "    return ");
    for (size_t i = 0; i < b->f->results; i++) nh_text_addf(b->out, "%s%s", i ? ", " : "", b->result[i]);
    nh_text_add(b->out, "\n");
}

/* ---- modules ---- */

static void put_parameters(const module *p)
{
    const nh_system *system = p->x->system;
    nh_text_add(p->out, "\n\nParameters = namedtuple(\"Parameters\", [");
    for (size_t i = 0, k = 0; i < system->parameters; i++)
        if (!p->x->input[i]) nh_text_addf(p->out, "%s\"%s\"", k++ ? ", " : "", p->member[i]);
    nh_text_add(p->out, "])\n");
    nh_text_add(p->out, p->sympy ? "#: symbols\nparameters = Parameters("
                                 : "#: the values of the system file\nparameters = Parameters(");
    for (size_t i = 0, k = 0; i < system->parameters; i++) {
        char text[40];
        nh_text_number(system->parameter[i].value, text, sizeof text);
        if (p->x->input[i]) continue;
        nh_text_addf(p->out, p->sympy ? "%s%s=sp.Symbol(\"%s\", real=True)" : "%s%s=%s", k++ ? ", " : "", p->member[i],
                     p->sympy ? system->parameter[i].name : text);
    }
    nh_text_add(p->out, ")\n");
    if (!p->sympy) return;
    nh_text_add(p->out, "#: their values in the system file\nvalues = {");
    for (size_t i = 0, k = 0; i < system->parameters; i++) {
        char text[40];
        nh_text_number(system->parameter[i].value, text, sizeof text);
        if (!p->x->input[i]) nh_text_addf(p->out, "%sparameters.%s: %s", k++ ? ", " : "", p->member[i], text);
    }
    nh_text_add(p->out, "}\n");
}

static void put_symbol_list(const module *p, const char *name, size_t n, const char *const *symbol)
{
    nh_text_addf(p->out, "%s = sp.Matrix([", name);
    for (size_t i = 0; i < n; i++) nh_text_addf(p->out, "%ssp.Symbol(\"%s\", real=True)", i ? ", " : "", symbol[i]);
    nh_text_add(p->out, "])\n");
}

/* The symbols with which to call the functions. */
static void put_symbols(const module *p)
{
    const nh_system *system = p->x->system;
    nh_arena *arena = nh_arena_create();
    const char **name = nh_arena_alloc(arena, (system->coordinates + system->parameters + 1) * sizeof *name);
    size_t n = 0;
    nh_text_add(p->out, "\n#: the time, coordinates and velocities\nt = sp.Symbol(\"t\", real=True)\n");
    for (size_t i = 0; i < system->coordinates; i++) name[i] = system->coordinate[i].name;
    put_symbol_list(p, "q", system->coordinates, name);
    for (size_t i = 0; i < system->coordinates; i++)
        name[i] = nh_arena_printf(arena, "%s'", system->coordinate[i].name);
    put_symbol_list(p, "v", system->coordinates, name);
    for (size_t i = 0; i < system->parameters; i++)
        if (p->x->input[i]) name[n++] = system->parameter[i].name;
    if (n) put_symbol_list(p, "inputs", n, name);
    nh_arena_free(arena);
}

/* An unknown of an iteration is given by the caller: `guess` is the solution itself. */
static void given(nh_export_body *b, size_t i)
{
    nh_text_addf(b->out, "    %s = %s  # the solution itself: %s below vanishes\n", b->unknown[i],
                 b->argument[b->f->solve[i].guess], b->right[i]);
}

static void given_end(nh_export_body *b, size_t i)
{
    (void)b;
    (void)i;
}

void nh_export_python(const nh_export *x, const char *prefix, bool sympy, nh_text *out)
{
    const nh_export_form form = {sympy ? &nh_source_sympy : &nh_source_python,
                                 begin,
                                 unpack,
                                 parameter,
                                 fill,
                                 solve,
                                 sympy ? given : newton,
                                 sympy ? given_end : newton_end,
                                 end};
    nh_arena *arena = nh_arena_create();
    const char *const *member = nh_export_members(x, form.language, arena);
    const module p = {x, member, form.language, out, sympy};
    nh_text head;
    nh_text_init(&head);
    nh_export_head(x, "", &head);
    nh_text_add(out, "\"\"\"\n");
    put_quoted("", nh_text_string(&head), out);
    nh_text_add(
        out,
        sympy ? "\nFunctions of symbols or numbers; `q`, `v` and `parameters` are symbols to call them with.\n\"\"\"\n"
              : "\nAn array of states has a state in each column: the first axis is that of the components.\n\"\"\"\n");
    nh_text_clear(&head);
    nh_text bodies;
    nh_text_init(&bodies);
    for (size_t i = 0; i < x->functions; i++) nh_export_put_body(&form, x, &x->function[i], prefix, member, &bodies);
    nh_source_libraries(form.language, nh_text_string(&bodies), out);
    nh_text_add(out, sympy ? sympy_head : numpy_head);
    nh_source_series(form.language, nh_text_string(&bodies), out);
    put_parameters(&p);
    if (sympy) put_symbols(&p);
    nh_text_add(out, nh_text_string(&bodies));
    nh_text_clear(&bodies);
    nh_arena_free(arena);
}
