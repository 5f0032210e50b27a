#include <string.h>

#include "cli/cli.h"
#include "document/verification.h"

static bool ask(nh_cli *cli, nh_run *run, nh_verification **out, nh_error *error)
{
    if (cli->operands > 1)
        return nh_cli_one_system(cli, "nhsym verify sleigh --current \"m*v\"", error);
    if (cli->operands != 1 || !cli->current == !cli->field) {
        nh_fail(error, NH_USAGE, "", "`nhsym verify` needs one system and either --current or --field");
        return nh_error_hint(error, "nhsym verify sleigh --current \"m*v\", or --field \"Z0=1; phi=phi'; x=x'\"");
    }
    bool motions = cli->of && !strcmp(cli->of, "equations");
    if (cli->of && !motions && strcmp(cli->of, "constraint")) {
        nh_fail(error, NH_USAGE, "", "--of does not know `%s`", cli->of);
        return nh_error_hint(error, "--of takes constraint or equations");
    }
    if (cli->of && !cli->field) {
        nh_fail(error, NH_USAGE, "", "--of needs --field");
        return nh_error_hint(error, "for example: --field \"Z0=1\" --of equations");
    }
    const char *path = nh_cli_system(cli, cli->operand[0], error);
    if (path) *run = nh_cli_run(cli, path, NULL);
    nh_system *system = path ? nh_system_read(path, cli->settings, cli->setting, error) : NULL;
    if (!system) return false;
    if (motions) *out = nh_verification_of_motions(system, cli->velocities, cli->field, &cli->options, error);
    else if (cli->current)
        *out = nh_verification_of_current(system, cli->velocities, cli->current, &cli->options, error);
    else *out = nh_verification_of_field(system, cli->velocities, cli->field, &cli->options, error);
    if (*out && cli->equations) nh_verification_write_out(*out, &cli->options);
    return *out != NULL;
}

static void render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    nh_verification_write(result, run, style, out);
}

int nh_cli_verify(nh_cli *cli, nh_error *error)
{
    nh_verification *v = NULL;
    nh_run run = nh_cli_run(cli, NULL, NULL);
    nh_cli_progress_begin(cli);
    if (!nh_cli_use_folder(cli, error) || !nh_cli_can_write(cli, error) || !ask(cli, &run, &v, error) || !v)
        return nh_cli_failed(cli, &run, error);
    nh_cli_progress_end();
    bool conserved = v->conserved;
    bool good = nh_cli_write_words(cli, render, v, &run, error);
    if (cli->json && good) good = nh_cli_write_json(cli, nh_verification_json(v, &run), error);
    good = good && nh_cli_write_documents(cli, render, v, &run, error);
    good = nh_cli_written(cli, good, error);
    nh_verification_free(v);
    return !good ? (int)error->code : conserved ? NH_OK : NH_REFUTED;
}
