#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "document/analysis_json.h"
#include "document/analysis_outline.h"

/* A system by name brings the analysis of that name with it; a file is taken alone. */
static const char *analysis_of(nh_cli *cli, const char *system)
{
    if (cli->no_analysis || cli->ons || nh_places_is_path(system)) return NULL;
    return nh_places_look(cli->arena, "analyses", system);
}

static bool request_of(nh_cli *cli, nh_analyze_request *q, nh_error *error)
{
    if (cli->fragment && !cli->tex && !cli->folder) {
        nh_fail(error, NH_USAGE, "", "--fragment needs --tex");
        return nh_error_hint(error, "for example: --tex body.tex --fragment");
    }
    if (cli->operands > 1) return nh_cli_one_system(cli, "nhsym analyze sleigh", error);
    *q = (nh_analyze_request){.command = cli->line,
                              .settings = cli->settings,
                              .setting = cli->setting,
                              .chart = cli->velocities,
                              .options = cli->options,
                              .accuracy = cli->accuracy,
                              .seed_given = cli->seed_given,
                              .samples_given = cli->samples_given,
                              .tolerance_given = cli->tolerance_given,
                              .until_given = cli->until_given};
    if (cli->analysis && !(q->analysis_path = nh_places_find(cli->arena, "analyses", cli->analysis, error)))
        return false;
    const char *name = cli->operands ? cli->operand[0] : NULL;
    nh_analysis_file *peek = NULL;
    if (!name && q->analysis_path) { /* the analysis says which system it asks about */
        peek = nh_analysis_file_read(q->analysis_path, error);
        if (!peek) return false;
        if (peek->system) name = nh_arena_strdup(cli->arena, peek->system);
        nh_analysis_file_free(peek);
    }
    if (!name) {
        nh_fail(error, NH_USAGE, "", "`nhsym analyze` needs a system or an analysis file");
        return nh_error_hint(error, "nhsym analyze sleigh, or nhsym analyze mine.yaml");
    }
    q->system_path = nh_cli_system(cli, name, error);
    if (q->system_path && !q->analysis_path) q->analysis_path = analysis_of(cli, name);
    return q->system_path != NULL;
}

/* ---- what is written ---- */

static void render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    (void)run; /* the result has its own */
    nh_analysis_write(result, style, out);
}

int nh_cli_analyze(nh_cli *cli, nh_error *error)
{
    nh_analyze_request request;
    nh_cli_progress_begin(cli);
    if (!request_of(cli, &request, error) || !nh_cli_use_folder(cli, error) || !nh_cli_can_write(cli, error))
        return error->code;
    request.equations = cli->equations;
    request.no_figures = !nh_cli_wants_document(cli) && !cli->json;
    nh_analysis *result = nh_analysis_create(&request, error);
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, request.analysis_path);
    if (!result) return nh_cli_failed(cli, &run, error);
    bool good = nh_cli_write_words(cli, render, result, &run, error) &&
                (!cli->json || nh_cli_write_json(cli, nh_analysis_json(result), error)) &&
                nh_cli_write_documents(cli, render, result, &run, error);
    good = nh_cli_written(cli, good, error);
    bool partial = result->partial;
    const nh_validation *v = result->validation;
    if (good && cli->accuracy > 0 && !partial && !(v && v->accuracy.held))
        nh_fail(error, NH_NUMERIC, "", "%s",
                v ? v->accuracy.why : "no motion was computed, so the requested accuracy was not reached");
    nh_analysis_free(result);
    if (!good) return error->code;
    return nh_interrupted() ? (int)nh_ended_code() : partial ? NH_LIMIT : (int)error->code;
}
