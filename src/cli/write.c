/* write: what every command that reports needs. */
#include <math.h>

#include "base/output.h"
#include "cli/cli.h"

nh_run nh_cli_run(const nh_cli *cli, const char *system_path, const char *analysis_path)
{
    return (nh_run){cli->line, system_path, analysis_path, cli->options.seed, cli->options.shown, NAN};
}

bool nh_cli_write(const char *path, nh_text *text, nh_error *error)
{
    bool good = !path || nh_output_write(path, nh_text_string(text), text->length, error);
    nh_text_clear(text);
    return good;
}
