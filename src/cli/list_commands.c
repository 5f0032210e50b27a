/* list_commands: the commands that need no computation. */
#include "cli/cli.h"
#include "library/catalogue.h"

int nh_cli_version(nh_cli *cli, nh_error *error)
{
    if (cli->operands) {
        nh_fail(error, NH_USAGE, "", "`nhsym version` takes no name, found `%s`", cli->operand[0]);
        return nh_error_hint(error, "`nhsym version`, or --version"), NH_USAGE;
    }
    puts("nhsym " NH_VERSION);
    return NH_OK;
}

int nh_cli_list(nh_cli *cli, nh_error *error)
{
    const char *word = "";
    nh_text text;
    for (size_t i = 0; i < cli->operands; i++)
        word = nh_arena_printf(cli->arena, "%s%s%s", word, i ? " " : "", cli->operand[i]);
    nh_text_init(&text);
    bool some = nh_catalogue_systems(cli->operands ? word : NULL, &text, error);
    fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
    return some ? NH_OK : (int)error->code;
}

/* Without --equations the file is printed, as it is. */
static bool only_file(const nh_cli *cli, nh_error *error)
{
    const nh_request *q = &cli->ask;
    const struct {
        bool given;
        const char *name;
    } of[] = {{cli->json, "json"},
              {cli->html, "html"},
              {cli->tex, "tex"},
              {cli->folder, "output"},
              {q->settings > 0, "set"},
              {q->ons > 0, "on"},
              {q->chart != NH_CHART_AUTO, "velocities"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        if (!of[i].given) continue;
        nh_fail(error, NH_USAGE, "", "`nhsym show` takes --%s only with --equations", of[i].name);
        return nh_error_hint(error, "nhsym show %s --equations --%s ..", cli->operand[0], of[i].name);
    }
    return true;
}

int nh_cli_show(nh_cli *cli, nh_error *error)
{
    const nh_request *q = &cli->ask;
    nh_text text;
    if (cli->operands != 1) {
        nh_fail(error, NH_USAGE, "", "`nhsym show` needs the name of a system");
        nh_error_hint(error, "nhsym show sleigh");
        return NH_USAGE;
    }
    if (q->equations && q->of) {
        nh_fail(error, NH_USAGE, "", "--equations, and --of as well");
        return nh_error_hint(error, "--of prints names"), NH_USAGE;
    }
    if (q->equations) return nh_cli_documented(cli, error);
    if (!only_file(cli, error) || !nh_cli_system(cli, cli->operand[0], error)) return error->code;
    nh_text_init(&text);
    bool good = q->of ? nh_catalogue_names(q->system_path, q->of, &text, error)
                      : nh_catalogue_show(q->system_path, q->wheels || q->base, &text, error);
    nh_cli_print(&text);
    return good ? NH_OK : (int)error->code;
}

int nh_cli_explain(nh_cli *cli, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    bool good = nh_catalogue_explain(cli->arena, cli->operands, cli->operand, &text, error);
    fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
    return good ? NH_OK : (int)error->code;
}
