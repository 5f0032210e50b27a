/* write: what every command that reports needs. */
#include <math.h>
#include <string.h>

#include "cli/cli.h"

nh_run nh_cli_run(const nh_cli *cli, const char *system_path, const char *analysis_path)
{
    return (nh_run){cli->line, system_path, analysis_path, cli->options.seed, cli->options.shown, NAN};
}

bool nh_cli_can_write(const nh_cli *cli, nh_error *error)
{
    const char *const path[] = {cli->json && strcmp(cli->json, "-") ? cli->json : NULL, cli->html, cli->tex, cli->svg};
    for (size_t i = 0; i < sizeof path / sizeof *path; i++)
        if (path[i] && !nh_output_possible(path[i], error)) return false;
    return true;
}

bool nh_cli_write(nh_cli *cli, const char *path, nh_text *text, nh_error *error)
{
    bool good = nh_output_add(&cli->files, path, nh_text_string(text), text->length, error);
    nh_text_clear(text);
    return good;
}

bool nh_cli_write_json(nh_cli *cli, char *json, nh_error *error)
{
    bool to_stdout = !strcmp(cli->json, "-"), good = true;
    if (to_stdout) fputs(json, stdout);
    else good = nh_output_add(&cli->files, cli->json, json, strlen(json), error);
    nh_free(json);
    return good;
}

bool nh_cli_written(nh_cli *cli, bool good, nh_error *error) { return nh_output_end(&cli->files, good, error); }
