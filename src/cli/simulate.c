#include <string.h>

#include "base/output.h"
#include "cli/cli.h"
#include "report/motion.h"

bool nh_cli_motion_request(nh_cli *cli, const char *example, nh_simulate_request *q, nh_error *error)
{
    if (cli->operands != 1) {
        nh_fail(error, NH_USAGE, "", "%s which system?", cli->command);
        return nh_error_hint(error, "%s", example);
    }
    const char *name = cli->operand[0];
    *q = (nh_simulate_request){.settings = cli->settings, .setting = cli->setting, .chart = cli->chart, .initial = cli->initial, .step = cli->step, .watch = cli->watch, .scene = cli->scene, .project = cli->project,
                               .until_given = cli->until_given, .tolerance_given = cli->tolerance_given, .options = cli->options};
    q->system_path = nh_cli_find(cli, "systems", name, error);
    if (!q->system_path) return false;
    if (cli->analysis) return (q->analysis_path = nh_cli_find(cli, "analyses", cli->analysis, error)) != NULL;
    if (!cli->no_analysis && !strchr(name, '/') && !strstr(name, ".yaml")) q->analysis_path = nh_cli_look(cli, "analyses", name);
    return true;
}

int nh_cli_simulate(nh_cli *cli, nh_error *error)
{
    nh_simulate_request request;
    nh_simulation *s = nh_cli_motion_request(cli, "nhsym simulate sleigh --initial \"omega=2\" --until 10", &request, error) ? nh_simulate(&request, error) : NULL;
    if (!s) return error->code;
    bool good = true, complete = s->motion->complete;
    if (!cli->json && !cli->quiet) {
        nh_text text;
        nh_text_init(&text);
        nh_motion_csv(s, &text);
        fputs(nh_text_string(&text), stdout);
        nh_text_clear(&text);
        if (s->scene) fprintf(stderr, "nhsym: %s\n", s->scene);
    }
    if (cli->json) {
        char *json = nh_motion_json(s);
        if (!strcmp(cli->json, "-")) fputs(json, stdout);
        else good = nh_output_write(cli->json, json, strlen(json), error);
        nh_free(json);
    }
    if (!complete && good) nh_fail(error, NH_NUMERIC, "", "the motion ended at t = %g: %s", s->motion->end_time, s->motion->note);
    nh_simulation_free(s);
    return error->code;
}
