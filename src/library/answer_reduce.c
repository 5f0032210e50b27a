/* answer_reduce: reductions, and functions of a system in other languages. */
#include <string.h>

#include "commands/export.h"
#include "document/export.h"
#include "document/reduction.h"
#include "library/answer_internal.h"

static const char csv[] = "csv"; /* the motions of a reduction */

/* ---- reduce ---- */

/* A language of `export`, or csv. */
static bool reduce_check(const nh_request *q, nh_error *error)
{
    static const char *const only = csv;
    nh_export_target target;
    if (!q->to || !strcmp(q->to, csv)) return true;
    if (nh_export_target_of(q->to, &target, error)) {
        if (target != NH_EXPORT_JS) return true;
        nh_fail(error, NH_USAGE, "--to", "reduced equations are not written in JavaScript");
        return nh_error_hint(error, "`nhsym export SYSTEM --to js` writes the whole motion");
    }
    bool near = nh_text_nearest(q->to, &only, 1) != NULL;
    if (near || !strstr(error->hint, "did you mean")) error->hint[0] = 0;
    return near ? nh_error_hint(error, "did you mean `csv`?")
                : nh_error_hint(error, "--to takes c, python, sympy, matlab, latex or json, and csv for the motions");
}

static bool reduction_create(nh_answer *a, nh_error *error)
{
    return (a->part[0] = nh_reduction_create(a->request, error)) != NULL;
}

static void reduction_free(nh_answer *a) { nh_reduction_free(a->part[0]); }

static void reduction_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    nh_reduction *r = a->part[0];
    nh_simulation *motion = style.form == NH_PEN_PAGE ? nh_answer_motion_of_page(a->request) : NULL;
    r->motion = motion;
    nh_reduction_write(r, &a->run, style, out);
    r->motion = NULL;
    nh_simulation_free(motion);
}

static char *reduction_json(const nh_answer *a) { return nh_reduction_json(a->part[0], &a->run); }

/* The equations as functions; LaTeX as a part of another document. */
static void put_code(const nh_answer *a, nh_text *out)
{
    nh_error none = {0};
    nh_export_target target = NH_EXPORT_C;
    const char *prefix;
    nh_run run = a->run;
    run.system_path = NULL;
    nh_export_target_of(a->request->to, &target, &none);
    nh_export *x = nh_export_of_reduction(a->part[0]);
    nh_export_prefix(x, NULL, &prefix, &none);
    if (target == NH_EXPORT_LATEX) nh_reduction_latex(a->part[0], out);
    else nh_export_text(x, target, prefix, &run, out);
    nh_export_free(x);
}

static void reduction_table(const nh_answer *a, nh_text *out) { nh_reduction_csv(a->part[0], out); }

static bool reduction_print(const nh_answer *a, nh_text *out)
{
    if (!a->request->to) return false;
    if (!strcmp(a->request->to, csv)) reduction_table(a, out);
    else put_code(a, out);
    return true;
}

/* Gives an error unless all stages were compared with the full motion, to the end, and agree. */
static void complain_of_stages(const nh_reduction *r, double accuracy, nh_error *error)
{
    for (size_t i = 0; i < r->stages && error->code == NH_OK; i++) {
        const nh_reduction_stage *s = &r->stage[i];
        if (!s->compared)
            nh_fail(error, NH_NUMERIC, "",
                    "the accuracy %.1e was not reached: stage %zu could not be compared with the full motion", accuracy,
                    i + 1);
        else if (!s->complete || s->reached < r->until)
            nh_fail(error, NH_NUMERIC, "",
                    "the accuracy %.1e was not reached to the end: stage %zu was compared to t = %.6g%s", accuracy,
                    i + 1, s->reached, s->complete ? ", the time up to which the full motion is known" : "");
        else if (!(s->agreement < accuracy))
            nh_fail(error, NH_NUMERIC, "", "the accuracy %.1e was not reached: stage %zu is %.1e from the full motion",
                    accuracy, i + 1, s->agreement);
    }
    if (r->stages && r->full.method && !r->full.held && error->code == NH_OK)
        nh_fail(error, NH_NUMERIC, "", "the accuracy %.1e was not reached: %s", accuracy, r->full.why);
}

static int reduction_code(const nh_answer *a, nh_error *error)
{
    const nh_reduction *r = a->part[0];
    if (a->request->accuracy > 0 && !r->partial) complain_of_stages(r, a->request->accuracy, error);
    return nh_answer_code(r->partial, error);
}

const nh_answer_kind nh_answer_reduce = {.name = "reduce",
                                         .check = reduce_check,
                                         .create = reduction_create,
                                         .free = reduction_free,
                                         .write = reduction_write,
                                         .json = reduction_json,
                                         .print = reduction_print,
                                         .table = reduction_table,
                                         .code = reduction_code};

/* ---- export ---- */

/* The documents of an export are optional. */
static bool target_given(const nh_request *q) { return q->to || q->folder || !q->documents; }

static bool export_check(const nh_request *q, nh_error *error)
{
    nh_export_target ignored;
    return !target_given(q) || nh_export_target_of(q->to, &ignored, error);
}

static nh_export_target target_of(const nh_answer *a)
{
    nh_error none = {0};
    nh_export_target target = NH_EXPORT_C;
    nh_export_target_of(a->request->to, &target, &none);
    return target;
}

static const char *prefix_of(const nh_answer *a)
{
    nh_error none = {0};
    const char *prefix = "";
    nh_export_prefix(a->part[0], a->request->name, &prefix, &none);
    return prefix;
}

static void export_free(nh_answer *a) { nh_export_free(a->part[0]); }

static bool export_create(nh_answer *a, nh_error *error)
{
    const nh_request *q = a->request;
    const char *prefix;
    nh_export *x = nh_export_create(q, error);
    a->part[0] = x;
    if (x && nh_export_prefix(x, q->name, &prefix, error) &&
        (!target_given(q) || nh_export_possible(x, target_of(a), error)))
        return true;
    if (x) nh_export_free(x);
    return false;
}

static void put_target(const nh_answer *a, nh_export_target target, nh_text *out)
{
    nh_export_text(a->part[0], target, prefix_of(a), &a->run, out);
}

/* The text of an export: a list of its functions in a few lines.  It has no page. */
static void export_write(const nh_answer *a, nh_pen_style style, nh_text *out)
{
    if (style.form == NH_PEN_LATEX) put_target(a, NH_EXPORT_LATEX, out);
    else nh_export_summary(a->part[0], out);
}

static char *export_json(const nh_answer *a)
{
    nh_text text;
    nh_text_init(&text);
    put_target(a, NH_EXPORT_JSON, &text);
    char *json = nh_strdup(nh_text_string(&text));
    nh_text_clear(&text);
    return json;
}

static bool export_print(const nh_answer *a, nh_text *out)
{
    if (target_given(a->request)) put_target(a, target_of(a), out);
    return true;
}

static size_t export_files(const nh_answer *a, nh_answer_file file[NH_ANSWER_FILES])
{
    _Static_assert((int)NH_EXPORT_MOST_FILES <= (int)NH_ANSWER_FILES, "there is room for the files of an export");
    nh_export_file written[NH_EXPORT_MOST_FILES];
    size_t n = nh_export_files(a->part[0], target_of(a), prefix_of(a), &a->run, written);
    for (size_t i = 0; i < n; i++) file[i] = (nh_answer_file){written[i].name, written[i].text};
    return n;
}

static int export_code(const nh_answer *a, nh_error *error)
{
    const nh_export *x = a->part[0];
    return nh_answer_code(x->partial, error);
}

const nh_answer_kind nh_answer_export = {.name = "export",
                                         .check = export_check,
                                         .create = export_create,
                                         .free = export_free,
                                         .write = export_write,
                                         .json = export_json,
                                         .print = export_print,
                                         .files = export_files,
                                         .code = export_code};
