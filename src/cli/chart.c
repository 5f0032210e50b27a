#include <string.h>

#include "base/output.h"
#include "cli/cli.h"
#include "report/chart.h"

static bool write_all(nh_cli *cli, const nh_comparison *c, nh_error *error)
{
    bool good = true;
    nh_text text;
    nh_text_init(&text);
    if (!(cli->json && !strcmp(cli->json, "-")) && !cli->quiet) {
        nh_comparison_text(c, cli->verbose, &text);
        fputs(nh_text_string(&text), stdout);
    }
    nh_text_clear(&text);
    if (cli->svg) {
        nh_text_init(&text);
        nh_comparison_svg(c, &text);
        good = nh_output_write(cli->svg, nh_text_string(&text), text.length, error);
        nh_text_clear(&text);
    }
    if (cli->json && good) {
        char *json = nh_comparison_json(c);
        if (!strcmp(cli->json, "-")) fputs(json, stdout);
        else good = nh_output_write(cli->json, json, strlen(json), error);
        nh_free(json);
    }
    return good;
}

int nh_cli_chart(nh_cli *cli, nh_error *error)
{
    nh_simulate_request request;
    if (!nh_cli_motion_request(cli, "nhsym chart sleigh", &request, error)) return error->code;
    nh_comparison *c = nh_compare(&request, cli->budget > 0 ? cli->budget : 5, error);
    if (!c) return error->code;
    write_all(cli, c, error);
    nh_comparison_free(c);
    return error->code;
}
