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
    nh_text text;
    if (cli->operands) {
        nh_fail(error, NH_USAGE, "", "`nhsym list` takes no name, found `%s`", cli->operand[0]);
        return nh_error_hint(error, "`nhsym list | grep %s` shows the systems with this word in their name or title",
                             cli->operand[0]),
               NH_USAGE;
    }
    nh_text_init(&text);
    bool some = nh_catalogue_systems(&text);
    fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
    if (some) return NH_OK;
    nh_fail(error, NH_INPUT, "", "there are no systems in ./systems, in NHSYM_PATH or installed");
    nh_error_hint(error, "run nhsym where a folder `systems` is, or set NHSYM_PATH");
    return NH_INPUT;
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
    if (!nh_cli_system(cli, cli->operand[0], error)) return error->code;
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
