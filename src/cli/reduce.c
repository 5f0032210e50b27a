#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "document/export.h"
#include "document/reduction.h"

/* A language of `export`, or csv: the motions. */
static bool language_known(const char *word, nh_error *error)
{
    static const char csv[] = "csv", *const only = csv;
    nh_export_target target;
    if (!word || !strcmp(word, csv) || nh_export_target_of(word, &target, error)) return true;
    bool near = nh_text_nearest(word, &only, 1) != NULL;
    if (near || !strstr(error->hint, "did you mean")) error->hint[0] = 0;
    return near ? nh_error_hint(error, "did you mean `csv`?")
                : nh_error_hint(error, "--to takes c, python, sympy, matlab, latex or json, and csv for the motions");
}

static bool request_of(nh_cli *cli, nh_reduce_request *q, nh_error *error)
{
    if (!nh_cli_one_system(cli, "nhsym reduce crane, or nhsym reduce mine.yaml --group \"x=1; y=1\"", error))
        return false;
    *q = (nh_reduce_request){.settings = cli->settings,
                             .setting = cli->setting,
                             .chart = cli->velocities,
                             .initial = cli->initial,
                             .project = cli->project,
                             .weak = cli->weak,
                             .group = cli->group,
                             .chain = cli->chain,
                             .inner = cli->inner,
                             .accuracy = cli->accuracy,
                             .equations = cli->equations,
                             .options = cli->options};
    if (!language_known(cli->to, error)) return false;
    q->system_path = nh_cli_system(cli, cli->operand[0], error);
    return q->system_path != NULL;
}

/* Functions of the stages; LaTeX as a part of another document. */
static void put_code(const nh_cli *cli, const nh_reduction *r, nh_text *out)
{
    nh_error none = {0};
    nh_export_target target = NH_EXPORT_C;
    const char *prefix;
    nh_run run = nh_cli_run(cli, NULL, NULL);
    nh_export_target_of(cli->to, &target, &none);
    nh_export *x = nh_export_of_reduction(r);
    nh_export_prefix(x, NULL, &prefix, &none);
    if (target == NH_EXPORT_LATEX) nh_reduction_latex(r, out);
    else nh_export_text(x, target, prefix, &run, out);
    nh_export_free(x);
}

static void render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    nh_reduction_write(result, run, style, out);
}

/* The summary, the equations as code, or the motions as numbers. */
static bool print(nh_cli *cli, const nh_reduction *r, const nh_run *run, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    if (!cli->to) return nh_cli_write_words(cli, render, r, run, error);
    if (!strcmp(cli->to, "csv")) nh_reduction_csv(r, &text);
    else put_code(cli, r, &text);
    if (nh_cli_delivers(cli)) fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
    return true;
}

/* All stages were to be compared with the full motion, to the end, and to agree. */
static void complain(const nh_reduction *r, double accuracy, nh_error *error)
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

int nh_cli_reduce(nh_cli *cli, nh_error *error)
{
    nh_reduce_request request;
    nh_cli_progress_begin(cli);
    if (!request_of(cli, &request, error) || !nh_cli_use_folder(cli, error) || !nh_cli_can_write(cli, error))
        return error->code;
    nh_reduction *r = nh_reduction_create(&request, error);
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, NULL);
    if (!r) return nh_cli_failed(cli, &run, error);
    bool good = print(cli, r, &run, error);
    if (cli->csv && good) {
        nh_text table;
        nh_text_init(&table);
        nh_reduction_csv(r, &table);
        good = nh_cli_write(cli, cli->csv, &table, error);
    }
    if (cli->json && good) good = nh_cli_write_json(cli, nh_reduction_json(r, &run), error);
    good = good && nh_cli_write_documents(cli, render, r, &run, error);
    good = nh_cli_written(cli, good, error);
    bool partial = r->partial;
    if (good && cli->accuracy > 0 && !partial) complain(r, cli->accuracy, error);
    nh_reduction_free(r);
    return !good ? (int)error->code : nh_interrupted() ? (int)nh_ended_code() : partial ? NH_LIMIT : (int)error->code;
}
