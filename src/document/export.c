/* The descriptions of functions for all languages, and the list of files. */
#include "document/export.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "base/escape.h"
#include "document/export_internal.h"
#include "document/facts.h"
#include "document/formula.h"
#include "document/live.h"
#include "document/reduction.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "graph/node.h"

/* ---- the languages ---- */

static void write_c(const nh_export *x, const char *prefix, nh_text *out)
{
    nh_export_c_header(x, prefix, out);
    nh_text_add(out, "\n");
    nh_export_c_source(x, prefix, false, out);
}

static void write_python(const nh_export *x, const char *prefix, nh_text *out)
{
    nh_export_python(x, prefix, false, out);
}

static void write_sympy(const nh_export *x, const char *prefix, nh_text *out)
{
    nh_export_python(x, prefix, true, out);
}

static void write_js(const nh_export *x, const char *prefix, nh_text *out)
{
    (void)prefix;
    nh_live_js_file(x->analysis, out);
}

static void write_latex(const nh_export *x, const char *prefix, nh_text *out)
{
    (void)prefix;
    nh_export_latex(x, out);
}

/* A row for each nh_export_target. */
static const struct {
    const char *name, *ending;          /* of --to; of the file, after the prefix */
    const nh_source_language *language; /* whose functions are all that may occur; NULL: any may */
    void (*write)(const nh_export *x, const char *prefix, nh_text *out); /* NULL: JSON, which has the run as well */
} targets[] = {
    [NH_EXPORT_C] = {"c", ".c", &nh_source_c, write_c},
    [NH_EXPORT_PYTHON] = {"python", ".py", &nh_source_python, write_python},
    [NH_EXPORT_SYMPY] = {"sympy", "_sympy.py", &nh_source_sympy, write_sympy},
    [NH_EXPORT_MATLAB] = {"matlab", ".m", &nh_source_matlab, nh_export_matlab},
    [NH_EXPORT_JS] = {"js", ".js", NULL, write_js},
    [NH_EXPORT_LATEX] = {"latex", ".tex", NULL, write_latex},
    [NH_EXPORT_JSON] = {"json", ".json", NULL, NULL},
};
enum { TARGETS = sizeof targets / sizeof *targets };

bool nh_export_target_of(const char *name, nh_export_target *out, nh_error *error)
{
    const char *names[TARGETS];
    for (size_t i = 0; i < TARGETS; i++) {
        names[i] = targets[i].name;
        if (!name || (strcmp(name, names[i]) && !(i == NH_EXPORT_MATLAB && !strcmp(name, "octave")))) continue;
        *out = (nh_export_target)i;
        return true;
    }
    if (name) nh_fail(error, NH_USAGE, "--to", "there is no language `%.100s`", name);
    else nh_fail(error, NH_USAGE, "--to", "no language is given");
    /* other names of languages, and formats of their files */
    static const char *const others[][2] = {{"tex", "latex"}, {"numpy", "python"}, {"scipy", "python"}, {"cpp", "c"},
                                            {"c++", "c"},     {"m", "matlab"},     {"javascript", "js"}};
    for (size_t i = 0; name && i < sizeof others / sizeof *others; i++)
        if (!strcasecmp(name, others[i][0])) return nh_error_hint(error, "did you mean `%s`?", others[i][1]);
    return nh_error_hint_near(error, name ? name : "", names, TARGETS,
                              "--to takes c, python, sympy, matlab, js, latex or json");
}

bool nh_export_prefix(const nh_export *x, const char *wish, const char **out, nh_error *error)
{
    nh_text text;
    const char *name = wish ? wish : x->system->name, *first = name;
    size_t length = strlen(name);
    bool fits = isalpha((unsigned char)*first);
    for (const char *c = name; *c; c++) fits = fits && (isalnum((unsigned char)*c) || *c == '_');
    if (wish && (!fits || length > 40)) {
        nh_fail(error, NH_USAGE, "--name", "`%.100s` is not a name for functions", wish);
        return nh_error_hint(error, "a name is a letter a-z or A-Z, then letters, digits and _, 40 at most");
    }
    nh_text_init(&text);
    nh_source_identifier(&nh_source_c, name, &text);
    *out = nh_arena_printf(x->arena, "%.40s", nh_text_string(&text));
    nh_text_clear(&text);
    return true;
}

/* ---- words ---- */

void nh_export_head(const nh_export *x, const char *before, nh_text *out)
{
    nh_text_addf(out, "%s", before);
    nh_escape_c_comment(x->system->title, out);
    nh_text_add(out, ".  Exported by nhsym " NH_VERSION ".\n");
    for (size_t i = 0; i < x->notes; i++) {
        nh_text_addf(out, "%s", before);
        nh_escape_c_comment(x->note[i], out);
        nh_text_add(out, "\n");
    }
}

const char *nh_export_label(const nh_export_function *f, const nh_export_array *a, size_t row)
{
    return a->label ? a->label[row] : nh_kind_of(f->dag, a->e[row]) == NH_SYMBOL ? nh_name_of(f->dag, a->e[row]) : "";
}

void nh_export_array_words(const nh_export_function *f, const nh_export_array *a, nh_text *out)
{
    bool any = false;
    nh_text_add(out, a->doc);
    for (size_t i = 0; i < a->rows; i++) {
        const char *label = nh_export_label(f, a, i);
        if (!*label) break;
        nh_text_addf(out, "%s%s", any ? ", " : " (", label);
        any = true;
    }
    if (any) nh_text_add(out, ")");
}

static void current_words(const nh_export *x, const nh_export_function *f, const char *before, nh_text *out)
{
    const nh_analysis *result = x->analysis;
    const nh_export_array *a = &f->result[0];
    for (size_t i = 0, row = 0; i < result->list->count && row < a->rows; i++) {
        const nh_current *c = &result->list->found[i];
        if (strcmp(c->name, a->label[row])) continue;
        row++;
        const char *holds = nh_facts_holds(result->question->model, &c->proof, true);
        nh_text_addf(out, "%s%s%s%s: ", before, c->name, *c->meaning ? ", " : "", c->meaning);
        if (c->proof.proved) nh_text_addf(out, "proved%s", holds);
        else nh_text_addf(out, "conserved to %.0f digits%s%s", c->proof.digits, nh_formula_doubt(c), holds);
        if (c->local) nh_text_add(out, "; many-valued on an angle");
        if (c->series)
            nh_text_addf(out, "; a series, for %g <= %s <= %g only", c->series->low,
                         nh_name_of(result->question->model->dag, c->series->variable), c->series->high);
        nh_text_add(out, "\n");
    }
}

static void stage_words(const nh_reduction *r, size_t i, const char *before, nh_text *out)
{
    const nh_reduction_stage *s = &r->stage[i];
    const char *holds = nh_reduction_stage_holds(r, s);
    nh_text_addf(out, "%s%s (%s), by %s%s%s%s.\n", before, nh_reduction_stage_title(r, i), nh_stage_kind_name(s->kind),
                 s->group, s->local ? ", which acts locally" : "", *holds ? ", a group of symmetries" : "", holds);
}

void nh_export_words(const nh_export *x, const nh_export_function *f, const char *before, nh_text *out)
{
    for (const char *line = f->doc; *line;) {
        size_t length = strcspn(line, "\n");
        nh_text_addf(out, "%s%.*s\n", before, (int)length, line);
        line += length + (line[length] == '\n');
    }
    if (f->part == NH_EXPORT_CURRENTS) current_words(x, f, before, out);
    if (f->part == NH_EXPORT_REDUCED) stage_words(x->reduction, f->stage, before, out);
}

void nh_export_summary(const nh_export *x, nh_text *out)
{
    for (unsigned part = NH_EXPORT_EQUATIONS; part < NH_EXPORT_ALL; part <<= 1) {
        bool any = false;
        for (size_t i = 0; i < x->functions; i++) {
            if (x->function[i].part != part) continue;
            nh_text_addf(out, any ? ", %s" : "%-12s %s",
                         any ? x->function[i].name : nh_export_part_name((nh_export_part)part), x->function[i].name);
            any = true;
        }
        if (any) nh_text_add(out, "\n");
    }
    for (size_t i = 0; i < x->notes; i++) nh_text_addf(out, "  %s\n", x->note[i]);
}

/* ---- files ---- */

bool nh_export_possible(const nh_export *x, nh_export_target target, nh_error *error)
{
    const nh_source_language *language = targets[target].language;
    if (target == NH_EXPORT_JS) return nh_live_possible(x->analysis, error);
    for (size_t i = 0; i < x->functions && language; i++) {
        nh_ex *e;
        const nh_export_function *f = &x->function[i];
        size_t n = nh_export_expressions(f, x->arena, &e);
        for (size_t k = 0; k < n; k++) {
            const char *name = nh_source_lacks(language, f->dag, e[k]);
            if (!name) continue;
            if (!strcmp(name, nh_function_name(NH_TABLE))) {
                nh_fail(error, NH_USAGE, "--to",
                        "`%s` needs `%s`, a table of values, which cannot be written as code of %s", f->name,
                        nh_declared_has_table(f->dag), language->name);
                return nh_error_hint(error, "--to latex and --to json write it by its name");
            }
            nh_fail(error, NH_USAGE, "--to", "no common library of %s has the function %s, which `%s` needs",
                    language->name, name, f->name);
            return nh_error_hint(
                error, "--to python has all functions, by SciPy and mpmath; latex and json write them as they are");
        }
    }
    return true;
}

void nh_export_text(const nh_export *x, nh_export_target target, const char *prefix, const nh_run *run, nh_text *out)
{
    if (targets[target].write) {
        targets[target].write(x, prefix, out);
        return;
    }
    char *json = nh_export_json(x, run);
    nh_text_add(out, json);
    nh_free(json);
}

size_t nh_export_files(const nh_export *x, nh_export_target target, const char *prefix, const nh_run *run,
                       nh_export_file out[NH_EXPORT_MOST_FILES])
{
    out[0].name = nh_arena_printf(x->arena, "%s%s", prefix, targets[target].ending);
    nh_text_init(&out[0].text);
    if (target != NH_EXPORT_C) {
        nh_export_text(x, target, prefix, run, &out[0].text);
        return 1;
    }
    out[1].name = nh_arena_printf(x->arena, "%s.h", prefix);
    nh_text_init(&out[1].text);
    nh_export_c_source(x, prefix, true, &out[0].text);
    nh_export_c_header(x, prefix, &out[1].text);
    return 2;
}
