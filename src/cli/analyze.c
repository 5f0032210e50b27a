#include <string.h>

#include "base/output.h"
#include "cli/cli.h"
#include "report/html.h"
#include "report/result_json.h"
#include "report/summary.h"

/* A system by name brings the analysis of that name with it; a file is taken alone. */
static const char *analysis_of(nh_cli *cli, const char *system)
{
    if (cli->no_analysis || strchr(system, '/') || strstr(system, ".yaml")) return NULL;
    return nh_cli_look(cli, "analyses", system);
}

static bool request_of(nh_cli *cli, nh_analyze_request *q, nh_error *error)
{
    if (cli->operands > 1) return nh_fail(error, NH_USAGE, "", "`nhsym analyze` takes one system, found `%s` too", cli->operand[1]);
    *q = (nh_analyze_request){.command = cli->line, .settings = cli->settings, .setting = cli->setting, .chart = cli->chart, .options = cli->options,
                              .seed_given = cli->seed_given, .samples_given = cli->samples_given, .tolerance_given = cli->tolerance_given,
                              .until_given = cli->until_given};
    if (cli->analysis && !(q->analysis_path = nh_cli_find(cli, "analyses", cli->analysis, error))) return false;
    const char *name = cli->operands ? cli->operand[0] : NULL;
    nh_analysis *peek = NULL;
    if (!name && q->analysis_path) { /* the analysis says which system it asks about */
        peek = nh_analysis_read(q->analysis_path, error);
        if (!peek) return false;
        if (peek->system) name = nh_arena_strdup(cli->arena, peek->system);
        nh_analysis_free(peek);
    }
    if (!name) {
        nh_fail(error, NH_USAGE, "", "analyze what?");
        return nh_error_hint(error, "nhsym analyze sleigh, or nhsym analyze mine.yaml");
    }
    q->system_path = nh_cli_find(cli, "systems", name, error);
    if (q->system_path && !q->analysis_path) q->analysis_path = analysis_of(cli, name);
    return q->system_path != NULL;
}

static bool write_json(nh_cli *cli, const nh_result *result, nh_error *error)
{
    char *json = nh_result_json(result);
    bool good = true;
    if (!strcmp(cli->json, "-")) fputs(json, stdout);
    else good = nh_output_write(cli->json, json, strlen(json), error);
    nh_free(json);
    return good;
}

static bool write_html(nh_cli *cli, const nh_result *result, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    nh_html(result, &text);
    bool good = nh_output_write(cli->html, nh_text_string(&text), text.length, error);
    nh_text_clear(&text);
    return good;
}

int nh_cli_analyze(nh_cli *cli, nh_error *error)
{
    nh_analyze_request request;
    if (!request_of(cli, &request, error)) return error->code;
    nh_result *result = nh_analyze(&request, error);
    if (!result) return error->code;
    bool to_stdout = cli->json && !strcmp(cli->json, "-"), good = true;
    if (!to_stdout && !cli->quiet) {
        nh_text text;
        nh_text_init(&text);
        nh_summary(result, (nh_summary_style){cli->colour, cli->verbose}, &text);
        fputs(nh_text_string(&text), stdout);
        nh_text_clear(&text);
    }
    if (cli->json) good = write_json(cli, result, error);
    if (cli->html && good) good = write_html(cli, result, error);
    bool partial = result->partial;
    nh_result_free(result);
    return !good ? (int)error->code : partial ? NH_LIMIT : NH_OK;
}
