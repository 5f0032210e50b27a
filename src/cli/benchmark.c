#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "document/benchmark.h"

typedef struct {
    const nh_benchmark *benchmark;
    const nh_robustness *robustness; /* or NULL */
} comparison;

static void render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    const comparison *c = result;
    nh_benchmark_write(c->benchmark, c->robustness, run, style, out);
}

static bool write_all(nh_cli *cli, const nh_run *run, const nh_benchmark *c, const nh_robustness *s, nh_error *error)
{
    const comparison both = {c, s};
    nh_text text;
    nh_text_init(&text);
    bool good = nh_cli_write_words(cli, render, &both, run, error);
    if ((cli->svg || cli->pdf) && good) {
        nh_benchmark_svg(c, &text);
        good = nh_cli_write_picture(cli, &text, error);
    }
    if (cli->csv && good) {
        nh_benchmark_csv(c, &text);
        good = nh_cli_write(cli, cli->csv, &text, error);
    }
    good = good && nh_cli_write_documents(cli, render, &both, run, error);
    if (cli->json && good) good = nh_cli_write_json(cli, nh_benchmark_json(c, s, run), error);
    return nh_cli_written(cli, good, error);
}

int nh_cli_benchmark(nh_cli *cli, nh_error *error)
{
    nh_simulate_request request;
    bool maps = cli->robustness || cli->over; /* ranges are those of a map */
    if (maps && cli->methods) {
        nh_fail(error, NH_USAGE, "", "--method, and --%s as well", cli->over ? "over" : "robustness");
        return nh_error_hint(error, "maps compare five methods, which are always the same"), error->code;
    }
    nh_cli_progress_begin(cli);
    if (!nh_cli_motion_request(cli, "nhsym benchmark sleigh", &request, error) || !nh_cli_use_folder(cli, error) ||
        !nh_cli_can_write(cli, error))
        return error->code;
    if (cli->folder && !cli->csv) cli->csv = nh_cli_in_folder(cli, "runs.csv");
    /* without a budget of its own a map counts steps, so that it is the same on a busy machine */
    const double longest = 300;
    double budget = cli->budget > 0 ? cli->budget : 5, of_maps = cli->budget > 0 ? budget / 2 : longest;
    nh_benchmark *c = nh_benchmark_run(&request, maps && cli->budget > 0 ? budget / 2 : budget, error);
    nh_robustness *s =
        c && maps && !nh_interrupted() ? nh_robustness_create(&request, cli->over, of_maps, error) : NULL;
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, request.analysis_path);
    if (c && error->code == NH_OK) write_all(cli, &run, c, s, error);
    nh_robustness_free(s);
    if (c && error->code == NH_OK && nh_interrupted())
        nh_fail_ended(error, "while methods were compared: this is what was measured until then");
    nh_benchmark_free(c);
    return c ? (int)error->code : nh_cli_failed(cli, &run, error);
}
