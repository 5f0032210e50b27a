/* export: what is written for C, C++, Python, SymPy and Octave computes what the expressions are, by tapes and LAPACK, and the
 * energies and multipliers that `simulate` gives along a motion. */
#include "exported.h"
#include "exported_systems.h"

#include <cjson/cJSON.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/stat.h>

#include "commands/simulate.h"
#include "document/export.h"
#include "graph/node.h"
#include "scratch.h"
#include "sweep.h"

/* Calls of each function, of which the last is a state of a simulation where it gives the results; tests that share the systems. */
enum { probes = 3, share = 4 };

typedef struct {
    nh_export *x;
    const char *name;
    exported_call *call; /* probes for each function */
    size_t simulated;    /* calls whose results are those of a simulation */
} exported;

typedef struct {
    char folder[SCRATCH];
    size_t count;
    exported of[EXPORTED_SYSTEMS];
} batch;

/* ---- a folder with all files ---- */

static void write_file(const batch *b, const char *name, const nh_text *text)
{
    char path[SCRATCH + 100];
    snprintf(path, sizeof path, "%s/%s", b->folder, name);
    FILE *file = fopen(path, "w");
    cr_assert(file && fputs(nh_text_string(text), file) >= 0 && fclose(file) == 0, "%s", path);
}

static void write_code(const batch *b, const exported *e, nh_export_target target)
{
    nh_export_file file[NH_EXPORT_MOST_FILES];
    size_t n = nh_export_files(e->x, target, e->name, NULL, file);
    for (size_t i = 0; i < n; i++) {
        write_file(b, file[i].name, &file[i].text);
        nh_text_clear(&file[i].text);
    }
}

/* Where the Lagrangian is defined: not every probe is such a place. */
static exported_call call_of(const nh_export *x, const nh_export_function *f, size_t probe)
{
    for (size_t attempt = 0;; attempt++) {
        exported_call c = exported_call_make(x, f, probe + probes * attempt);
        bool finite = exported_run(x, f, &c);
        for (size_t r = 0; r < f->results && finite; r++)
            finite = nh_all_finite(f->result[r].rows * f->result[r].columns, c.result[r]);
        if (finite || attempt == 10) {
            cr_assert(finite, "%s of %s has no values", f->name, x->system->name);
            return c;
        }
        exported_call_clear(&c);
    }
}

/* ---- a state of a simulation ---- */

static const double *value_of(const nh_simulation *s, const char *name, nh_track_kind kind)
{
    const double *last = s->value + (s->motion->count - 1) * s->columns.count;
    for (size_t k = 0; k < s->columns.count; k++)
        if (s->columns.track[k].kind == kind && !strcmp(s->columns.track[k].name, name)) return last + k;
    return NULL;
}

/* The last state of a short motion, and its energy or multipliers. False: the function has other arguments or results. */
static bool call_at_end(const nh_simulation *s, const nh_export_function *f, exported_call *c)
{
    bool energy = !strcmp(f->name, "submanifold_energy");
    if ((!energy && strcmp(f->name, "multipliers")) || f->solves) return false;
    *c = (exported_call){.time = s->motion->time[s->motion->count - 1], .good = true};
    for (size_t i = 0; i < f->results; i++)
        c->result[i] = nh_alloc_array(f->result[i].rows * f->result[i].columns + 1, sizeof(double));
    c->argument[0] = nh_alloc_array(f->argument[0].rows + 1, sizeof(double));
    for (size_t i = 0; i < f->argument[0].rows; i++) {
        const char *name = nh_name_of(f->dag, f->argument[0].e[i]);
        const double *value = value_of(s, name, NH_TRACK_STATE);
        cr_assert_not_null(value, "%s of %s is no column", name, s->system->name);
        c->argument[0][i] = *value;
    }
    return true;
}

/* What simulation and export both give; other results are those of tapes at the same state. */
static void results_at_end(const nh_simulation *s, const nh_export *x, const nh_export_function *f, exported_call *c)
{
    bool energy = !strcmp(f->name, "submanifold_energy");
    cr_assert(exported_run(x, f, c), "%s of %s has no values", f->name, x->system->name);
    for (size_t i = 0; i < (energy ? 1 : f->result[0].rows); i++) {
        char column[20];
        snprintf(column, sizeof column, energy ? "E" : "c%zu", i + 1);
        const double *value = value_of(s, column, energy ? NH_TRACK_ENERGY : NH_TRACK_MULTIPLIER);
        cr_assert_not_null(value, "%s: %s", s->system->name, column);
        c->result[0][i] = *value;
    }
}

/* In place of the last of the ordinary calls. */
static void simulate(const char *path, exported *e)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .until_given = true, .step = 0.1};
    nh_options_default(&q.options);
    q.options.until = 0.5;
    nh_simulation *s = nh_simulation_create(&q, &error);
    must(s != NULL, &error, path);
    for (size_t i = 0; i < e->x->functions; i++) {
        const nh_export_function *f = &e->x->function[i];
        exported_call c;
        if (!call_at_end(s, f, &c)) continue;
        results_at_end(s, e->x, f, &c);
        exported_call_clear(&e->call[i * probes + probes - 1]);
        e->call[i * probes + probes - 1] = c;
        e->simulated++;
    }
    nh_simulation_free(s);
    cr_expect_gt(e->simulated, 0, "%s", path);
}

static exported make(const batch *b, const exported_system *s)
{
    char path[SCRATCH + 100];
    snprintf(path, sizeof path, "systems/%s.yaml", s->name);
    if (s->text) {
        nh_text text;
        nh_text_init(&text);
        nh_text_add(&text, s->text);
        snprintf(path, sizeof path, "%s.yaml", s->name);
        write_file(b, path, &text);
        snprintf(path, sizeof path, "%s/%s.yaml", b->folder, s->name);
        nh_text_clear(&text);
    }
    exported e = {.x = exported_make(path, NULL, s->input), .name = s->name};
    e.call = nh_alloc_array(probes * e.x->functions + 1, sizeof *e.call);
    for (size_t i = 0; i < e.x->functions; i++)
        for (size_t p = 0; p < probes; p++) e.call[i * probes + p] = call_of(e.x, &e.x->function[i], p);
    if (!s->text) simulate(path, &e);
    return e;
}

static void batch_make(batch *b, size_t part)
{
    memset(b, 0, sizeof *b);
    scratch_name(b->folder);
    cr_assert_not_null(mkdtemp(b->folder));
    for (size_t i = part; i < EXPORTED_SYSTEMS; i += share)
        if (sweep_tries(i / share + 2, 8, 8)) b->of[b->count++] = make(b, &EXPORTED[i]);
    cr_assert_gt(b->count, 0, "no system in part %zu", part);
}

static void batch_clear(batch *b)
{
    char command[SCRATCH + 20];
    for (size_t i = 0; i < b->count; i++) {
        for (size_t k = 0; k < probes * b->of[i].x->functions; k++) exported_call_clear(&b->of[i].call[k]);
        nh_free(b->of[i].call);
        nh_export_free(b->of[i].x);
    }
    snprintf(command, sizeof command, "rm -rf %s", b->folder);
    cr_expect_eq(system(command), 0);
}

/* ---- what a program prints, against what is expected ---- */

/* For each call a number, 0 where it has values, then these.  What the sanitized build writes is compared in one language: the plain one writes the same. */
static void compare(const batch *b, const char *language, const char *command, double allowed,
                    bool (*wanted)(const exported *e))
{
    char line[SCRATCH + 400];
    if (sweep_sanitized() && !sweep_whole() && strcmp(language, "C")) return;
    snprintf(line, sizeof line, "cd %s && %s", b->folder, command);
    FILE *pipe = popen(line, "r");
    cr_assert_not_null(pipe);
    size_t values = 0, calls = 0, systems = 0, simulated = 0;
    double worst = 0;
    for (size_t s = 0; s < b->count; s++) {
        const exported *e = &b->of[s];
        if (wanted && !wanted(e)) continue;
        systems++;
        simulated += e->simulated > 0;
        for (size_t k = 0; k < probes * e->x->functions; k++) {
            const nh_export_function *f = &e->x->function[k / probes];
            const exported_call *c = &e->call[k];
            bool read = fgets(line, sizeof line, pipe) != NULL;
            cr_assert(read, "%s ends before %s of %s", language, f->name, e->name);
            calls++;
            bool good = strtod(line, NULL) == 0;
            cr_expect(good == c->good, "%s, %s of %s: %s", language, f->name, e->name, good ? "has a value" : "fails");
            for (size_t r = 0; r < f->results && good; r++) {
                size_t n = f->result[r].rows * f->result[r].columns;
                double size = 1;
                for (size_t i = 0; i < n && c->good; i++) size = fmax(size, fabs(c->result[r][i]));
                for (size_t i = 0; i < n; i++) {
                    cr_assert(fgets(line, sizeof line, pipe) != NULL, "%s ends within %s of %s", language, f->name,
                              e->name);
                    double off = fabs(strtod(line, NULL) - c->result[r][i]) / size;
                    values++;
                    worst = fmax(worst, off);
                    cr_expect(!c->good || off <= allowed, "%s, %s of %s: %s[%zu] is %.17g, not %.17g", language,
                              f->name, e->name, f->result[r].name, i, strtod(line, NULL), c->result[r][i]);
                }
            }
        }
    }
    cr_expect_null(fgets(line, sizeof line, pipe), "%s prints more", language);
    cr_expect_eq(pclose(pipe), 0, "%s", language);
    cr_expect_geq(values, 20 * systems);
    cr_log_info("%s: %zu systems, %zu of them at states of a simulation; %zu calls, %zu values, largest difference %.1e",
                language, systems, simulated, calls, values, worst);
}

static void put_list(nh_text *out, const char *open, size_t n, const double *x, const char *close)
{
    nh_text_add(out, open);
    for (size_t i = 0; i < n; i++) nh_text_addf(out, "%s%.17g", i ? ", " : "", x[i]);
    nh_text_add(out, close);
}

static bool has_parameters(const nh_export *x) { return x->system->parameters > x->inputs; }

/* ---- C and C++ ---- */

static void c_call(const exported *e, const nh_export_function *f, const exported_call *c, nh_text *out)
{
    nh_text_add(out, "    {\n");
    for (size_t a = 0; a < f->arguments; a++) {
        nh_text_addf(out, "        const double a%zu[] = ", a);
        put_list(out, "{", f->argument[a].rows, c->argument[a], "};\n");
    }
    if (e->x->inputs) nh_text_addf(out, "        const double u[] = {%.17g};\n", exported_input);
    for (size_t r = 0; r < f->results; r++)
        nh_text_addf(out, "        double r%zu[%zu];\n", r, f->result[r].rows * f->result[r].columns);
    nh_text_addf(out, "        int code = %s_%s(%.17g", e->name, f->name, c->time);
    for (size_t a = 0; a < f->arguments; a++) nh_text_addf(out, ", a%zu", a);
    nh_text_addf(out, "%s", e->x->inputs ? ", u" : "");
    if (has_parameters(e->x)) nh_text_addf(out, ", &%s_default", e->name);
    for (size_t r = 0; r < f->results; r++) nh_text_addf(out, ", r%zu", r);
    nh_text_add(out, ");\n        printf(\"%d\\n\", code);\n");
    for (size_t r = 0; r < f->results; r++)
        nh_text_addf(out, "        for (int i = 0; i < %zu && code == 0; i++) printf(\"%%.17g\\n\", r%zu[i]);\n",
                     f->result[r].rows * f->result[r].columns, r);
    nh_text_add(out, "    }\n");
}

static void c_program(const batch *b)
{
    nh_text out;
    nh_text_init(&out);
    nh_text_add(&out, "#include <stdio.h>\n");
    for (size_t s = 0; s < b->count; s++) nh_text_addf(&out, "#include \"%s.h\"\n", b->of[s].name);
    for (size_t s = 0; s < b->count; s++) {
        const exported *e = &b->of[s];
        nh_text_addf(&out, "static void call_%s(void)\n{\n", e->name);
        for (size_t k = 0; k < probes * e->x->functions; k++) c_call(e, &e->x->function[k / probes], &e->call[k], &out);
        nh_text_add(&out, "}\n");
        write_code(b, e, NH_EXPORT_C);
    }
    nh_text_add(&out, "int main(void)\n{\n");
    for (size_t s = 0; s < b->count; s++) nh_text_addf(&out, "    call_%s();\n", b->of[s].name);
    nh_text_add(&out, "    return 0;\n}\n");
    write_file(b, "main.c", &out);
    nh_text_clear(&out);
}

/* ---- Python: NumPy, SymPy ---- */

static bool has(const char *command)
{
    char line[200];
    snprintf(line, sizeof line, "%s >/dev/null 2>&1", command);
    return system(line) == 0;
}

/* Debian's, or the first one: another may be in front of it on the PATH, without packages. */
static const char *python(const char *module)
{
    static const char *const all[] = {"/usr/bin/python3", "python3"};
    char line[100];
    for (size_t i = 0; i < 2; i++) {
        snprintf(line, sizeof line, "%s -c 'import %s'", all[i], module);
        if (has(line)) return all[i];
    }
    cr_log_warn("skipped: there is no Python with %s (Debian: python3-%s)", module, module);
    return NULL;
}

/* A list of calls as data: module, function, arguments. */
static void python_calls(const batch *b, const char *name, bool sympy, bool (*wanted)(const exported *e))
{
    static const char head[] =
        "import numpy as np\n"
        "def call(f, t, *a, **k):\n"
        "    try:\n"
        "        r = f(t, *[np.array(x) for x in a], **k)\n"
        "    except (ArithmeticError, np.linalg.LinAlgError):\n"
        "        return print(1)\n"
        "    print(0)\n"
        "    for x in r if isinstance(r, tuple) else (r,):\n"
        "        for y in np.ravel(x): print('%.17g' % y)\n"
        "    if not any(len(x) for x in a): return\n"
        "    many = f(t, *[np.stack([x, np.array(x)*(1 + 1e-9), x], 1) for x in map(np.array, a)], **k)\n"
        "    for x, y in zip(*[z if isinstance(z, tuple) else (z,) for z in (r, many)]):\n"
        "        y = np.broadcast_to(y.T, (3,) + x.T.shape).T if y.ndim == x.ndim else y\n"
        "        assert y.shape == x.shape + (3,), (f.__name__, y.shape, x.shape)\n"
        "        assert np.max(np.abs(y[..., 2] - x)) <= 1e-12*(1 + np.max(np.abs(x))), f.__name__\n";
    static const char symbolic[] = "import sympy as sp\n"
                                   "def call(f, t, *a, **k):\n"
                                   "    r = f(t, *a, **k)\n"
                                   "    print(0)\n"
                                   "    for x in r if isinstance(r, tuple) else (r,):\n"
                                   "        for y in x: print('%.17g' % sp.N(y, 20))\n";
    nh_text out;
    nh_text_init(&out);
    nh_text_add(&out, sympy ? symbolic : head);
    for (size_t s = 0; s < b->count; s++) {
        const exported *e = &b->of[s];
        const char *module = sympy ? "_sympy" : "";
        if (wanted && !wanted(e)) continue;
        write_code(b, e, sympy ? NH_EXPORT_SYMPY : NH_EXPORT_PYTHON);
        nh_text_addf(&out, "import %s%s as m\n", e->name, module);
        if (sympy) nh_text_add(&out, "p = m.Parameters(*[m.values[x] for x in m.parameters])\n");
        for (size_t k = 0; k < probes * e->x->functions; k++) {
            const nh_export_function *f = &e->x->function[k / probes];
            nh_text_addf(&out, "call(m.%s, %.17g", f->name, e->call[k].time);
            for (size_t a = 0; a < f->arguments; a++)
                put_list(&out, ", [", f->argument[a].rows, e->call[k].argument[a], "]");
            if (e->x->inputs) nh_text_addf(&out, ", inputs=[%.17g]", exported_input);
            nh_text_add(&out, sympy ? ", parameters=p)\n" : ")\n");
        }
    }
    write_file(b, name, &out);
    nh_text_clear(&out);
}

/* Numbers put into symbolic elimination: the smaller systems, and those with odd names. */
static bool few_coordinates(const exported *e)
{
    for (size_t i = 0; i < e->x->functions; i++)
        for (size_t k = 0; k < e->x->function[i].solves; k++)
            if (e->x->function[i].solve[k].newton) return false;
    return e->x->system->coordinates <= 5 || !strcmp(e->name, "keywords");
}

/* ---- Octave ---- */

static void octave_calls(const batch *b)
{
    static const char head[] = "1;\nwarning('off', 'all');\n"
                               "function show(varargin)\n    disp(0);\n    for i = 1:nargin\n        "
                               "printf('%.17g\\n', varargin{i}.');\n    end\nend\n";
    nh_text out;
    nh_text_init(&out);
    nh_text_add(&out, head);
    for (size_t s = 0; s < b->count; s++) {
        const exported *e = &b->of[s];
        write_code(b, e, NH_EXPORT_MATLAB);
        nh_text_addf(&out, "m = %s();\n", e->name);
        for (size_t k = 0; k < probes * e->x->functions; k++) {
            const nh_export_function *f = &e->x->function[k / probes];
            nh_text_add(&out, "[");
            for (size_t r = 0; r < f->results; r++) nh_text_addf(&out, "%sr%zu", r ? ", " : "", r);
            nh_text_addf(&out, "] = m.%s(%.17g", f->name, e->call[k].time);
            for (size_t a = 0; a < f->arguments; a++)
                put_list(&out, ", [", f->argument[a].rows, e->call[k].argument[a], "]");
            if (e->x->inputs) nh_text_addf(&out, ", %.17g", exported_input);
            nh_text_add(&out, ", m.parameters); show(");
            for (size_t r = 0; r < f->results; r++) nh_text_addf(&out, "%sr%zu", r ? ", " : "", r);
            nh_text_add(&out, ");\n");
        }
    }
    write_file(b, "calls.m", &out);
    nh_text_clear(&out);
}

static void languages(size_t part)
{
    batch b;
    batch_make(&b, part);
    c_program(&b);
    compare(&b, "C", "${CC:-cc} -std=c99 -O0 -Wall -Wextra -Werror *.c -o c_code -lm && ./c_code", 1e-12, NULL);
    char command[SCRATCH + 200];
    if (sweep_sanitized() && !sweep_whole()) { /* of what was written in other languages the plain test tells as much */
        batch_clear(&b);
        return;
    }
    if (has("c++ --version"))
        compare(&b, "C++", "c++ -x c++ -std=c++11 -O0 -Wall -Wextra -Werror *.c -o cpp_code -lm && ./cpp_code", 1e-12, NULL);
    else cr_log_warn("skipped: there is no C++ compiler (Debian: g++)");
    const char *numpy = python("numpy"), *sympy = python("sympy");
    if (numpy) {
        python_calls(&b, "calls.py", false, NULL);
        snprintf(command, sizeof command, "%s -B calls.py", numpy);
        compare(&b, "NumPy", command, 1e-12, NULL);
    }
    if (sympy) {
        python_calls(&b, "symbolic.py", true, few_coordinates);
        snprintf(command, sizeof command, "%s -B symbolic.py", sympy);
        compare(&b, "SymPy", command, 1e-12, few_coordinates);
    }
    if (has("octave-cli --version")) {
        octave_calls(&b);
        compare(&b, "Octave", "octave-cli --no-gui --no-init-file --no-history --quiet calls.m", 1e-12, NULL);
    } else {
        cr_log_warn("skipped: there is no octave-cli (Debian: octave)");
    }
    batch_clear(&b);
}

Test(export, languages_1, PLAIN_ONLY) { languages(0); }
Test(export, languages_2, WHOLE_ONLY) { languages(1); }
Test(export, languages_3, WHOLE_ONLY) { languages(2); }
Test(export, languages_4) { languages(3); }
