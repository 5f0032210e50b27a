#include "commands/classify.h"

#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "document/classification.h"

static bool request_of(nh_cli *cli, nh_classify_request *q, nh_error *error)
{
    if (cli->operands != 1 || !cli->over) {
        nh_fail(error, NH_USAGE, "", "classify which system, over which parameter?");
        return nh_error_hint(error, "nhsym classify penning_trap --over w");
    }
    *q = (nh_classify_request){.command = cli->line, .settings = cli->settings, .setting = cli->setting,
                               .over = cli->over, .shape = cli->shape, .options = cli->options};
    q->system_path = nh_places_find(cli->arena, "systems", cli->operand[0], error);
    return q->system_path != NULL;
}

static void print(const nh_cli *cli, const nh_classified *x)
{
    nh_text text;
    nh_text_init(&text);
    nh_classification_text(x, cli->verbose, &text);
    fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
}

int nh_cli_classify(nh_cli *cli, nh_error *error)
{
    nh_classify_request request;
    nh_cli_progress_begin(cli);
    if (!request_of(cli, &request, error) || !nh_cli_can_write(cli, error)) return error->code;
    nh_classified *x = nh_classify_system(&request, error);
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, NULL);
    if (!x) return nh_cli_failed(cli, &run, error);
    bool good = true, partial = x->partial;
    if (nh_cli_speaks(cli)) print(cli, x);
    if (cli->json) good = nh_cli_write_json(cli, nh_classification_json(x, &run), error);
    good = nh_cli_written(cli, good, error);
    if (good && x->classification->obstacle) nh_fail(error, NH_NUMERIC, "", "%s", x->classification->obstacle);
    nh_classified_free(x);
    return !good ? (int)error->code : nh_interrupted() ? (int)nh_ended_code() : partial ? NH_LIMIT : (int)error->code;
}
