#include "commands/scan.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "document/scan.h"
#include "document/scan_numbers.h"

static const char kept[] = "what is finished is kept; the same command continues";

static bool request_of(nh_cli *cli, nh_scan_request *q, nh_scan_source *source, nh_error *error)
{
    static const char example[] = "nhsym scan sleigh --over k=1:4:61 -o DIR";
    if (cli->operands != 1 || !cli->overs || !cli->folder) {
        nh_fail(error, NH_USAGE, "",
                cli->operands != 1 ? "scan which system?"
                : !cli->overs      ? "scan over which values of which parameter?"
                                   : "into which folder?");
        return nh_error_hint(error, "%s", example);
    }
    const char *path = nh_cli_system(cli, cli->operand[0], error);
    *q = (nh_scan_request){.system_path = path,
                           .settings = cli->settings,
                           .setting = cli->setting,
                           .axes = cli->overs,
                           .over = cli->over_list,
                           .source = source,
                           .options = cli->options,
                           .program = nh_cli_program(),
                           .folder = cli->folder,
                           .chunk = cli->chunk,
                           .chunks = cli->chunks,
                           .workers = cli->workers,
                           .begin_worker = nh_cli_guard_worker,
                           .team = cli->team};
    if (!path) return false;
    if (!q->workers || (q->team && q->team->size > 1)) q->workers = 1;
    if (q->team && q->team->size > 1 && !q->options.threads) q->options.threads = 1;
    if (q->workers > 1 && !q->options.threads) q->options.threads = 1;
    nh_scan_numbers_request numbers = {.of = cli->of, .names = cli->numbers, .name = cli->number, .system_path = path,
                                       .settings = cli->settings, .setting = cli->setting, .options = q->options};
    return nh_scan_numbers(cli->arena, &numbers, source, error);
}

/* ---- what is written ---- */

static void render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    nh_scan_write(result, run, style, out);
}

static bool write_all(nh_cli *cli, const nh_scan *x, const nh_run *run, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    if (x->chunked && !x->silent && nh_cli_speaks(cli)) { /* a part has words only */
        render(x, run, (nh_pen_style){.form = NH_PEN_TEXT, .colour = cli->colour}, &text);
        fputs(nh_text_string(&text), stdout);
        nh_text_clear(&text);
    }
    if (x->silent || x->chunked) return true;
    if (!cli->json) cli->json = nh_cli_in_folder(cli, "scan.json");
    bool good = nh_cli_use_folder(cli, error) && nh_cli_write_words(cli, render, x, run, error);
    nh_scan_csv(x, &text);
    good = nh_cli_write(cli, cli->csv ? cli->csv : nh_cli_in_folder(cli, "scan.csv"), &text, error) && good;
    good = good && nh_cli_write_json(cli, nh_scan_json(x, run), error);
    good = good && nh_cli_write_documents(cli, render, x, run, error);
    return nh_cli_written(cli, good, error);
}

static int code_of(const nh_scan *x, nh_error *error)
{
    if (nh_interrupted()) return nh_ended_code();
    if (x->finished == x->units && !(x->partial && !x->chunked)) return NH_OK;
    nh_fail(error, NH_NUMERIC, "", "%zu of %zu units were not computed%s%s", x->units - x->finished, x->units,
            x->death ? ": " : "", x->death ? x->death : "");
    nh_error_hint(error, "%s", kept);
    return error->code;
}

int nh_cli_scan(nh_cli *cli, nh_error *error)
{
    nh_scan_request request;
    nh_scan_source source;
    nh_cli_progress_begin(cli);
    if (!request_of(cli, &request, &source, error) || !nh_cli_can_write(cli, error)) return error->code;
    nh_scan *x = nh_scan_create(&request, error);
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, NULL);
    if (!x) {
        if (error->code == NH_NUMERIC) *error->hint = 0, nh_error_hint(error, "%s", kept);
        return error->code;
    }
    if (x->deaths)
        fprintf(stderr,
                "nhsym: %zu time%s a worker ended early, and what it had begun was computed again; the last time %s\n",
                x->deaths, x->deaths == 1 ? "" : "s", x->death);
    run.command = x->question; /* who computed it, and where to, is no part of the answer */
    bool good = write_all(cli, x, &run, error);
    if (!good) *error->hint = 0, nh_error_hint(error, "%s", kept);
    int code = good ? code_of(x, error) : (int)error->code;
    nh_scan_free(x);
    return code;
}
