#include <errno.h>
#include <string.h>
#include <sys/stat.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "commands/export.h"
#include "document/export.h"

/* Documents may be all that is wanted. */
static bool target_given(const nh_cli *cli) { return cli->to || cli->folder || !(cli->json || cli->tex); }

static bool request_of(nh_cli *cli, nh_export_request *q, nh_export_target *target, nh_error *error)
{
    if (!nh_cli_one_system(cli, "nhsym export sleigh --to c -o code", error)) return false;
    *q = (nh_export_request){.command = cli->line,
                             .settings = cli->settings,
                             .setting = cli->setting,
                             .chart = cli->velocities,
                             .initial = cli->initial,
                             .group = cli->group,
                             .weak = cli->weak,
                             .of = cli->of,
                             .input = cli->input,
                             .options = cli->options};
    if (target_given(cli) && !nh_export_target_of(cli->to, target, error)) return false;
    q->system_path = nh_cli_system(cli, cli->operand[0], error);
    return q->system_path != NULL;
}

/* One target as a whole, to a file or standard output (`-`). */
static bool write_whole(nh_cli *cli, const nh_export *x, nh_export_target target, const char *prefix, const nh_run *run,
                        const char *path, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    if (path) nh_export_text(x, target, prefix, run, &text);
    return !path || nh_cli_write(cli, path, &text, error);
}

/* Into the folder; its summary says what there is. */
static bool write_files(nh_cli *cli, const nh_export *x, nh_export_target target, const char *prefix, const nh_run *run,
                        nh_error *error)
{
    nh_export_file file[NH_EXPORT_MOST_FILES];
    if (mkdir(cli->folder, 0777) && errno != EEXIST) {
        nh_fail(error, NH_NUMERIC, cli->folder, "the folder could not be created: %s", strerror(errno));
        return nh_error_hint(error, "-o takes a folder; its parent folder must exist");
    }
    size_t n = nh_export_files(x, target, prefix, run, file);
    bool good = true;
    for (size_t i = 0; i < n; i++) {
        if (good)
            good = nh_cli_write(cli, nh_cli_in_folder(cli, file[i].name), &file[i].text, error);
        else
            nh_text_clear(&file[i].text);
    }
    good = nh_cli_written(cli, good, error);
    if (!good || !nh_cli_speaks(cli)) return good;
    nh_text summary;
    nh_text_init(&summary);
    nh_export_summary(x, &summary);
    fputs(nh_text_string(&summary), stdout);
    nh_text_clear(&summary);
    for (size_t i = 0; i < n; i++) printf("%s%s", i ? ", " : "written: ", nh_cli_in_folder(cli, file[i].name));
    puts("");
    return true;
}

int nh_cli_export(nh_cli *cli, nh_error *error)
{
    nh_export_request request;
    nh_export_target target;
    const char *prefix;
    nh_cli_progress_begin(cli);
    if (!request_of(cli, &request, &target, error) || !nh_cli_can_write(cli, error)) return error->code;
    nh_export *x = nh_export_create(&request, error);
    nh_cli_progress_end();
    nh_run run = nh_cli_run(cli, request.system_path, NULL);
    if (!x) return nh_cli_failed(cli, &run, error);
    bool good = nh_export_prefix(x, cli->name, &prefix, error) &&
                (!target_given(cli) || nh_export_possible(x, target, error)),
         partial = x->partial;
    good = good && write_whole(cli, x, NH_EXPORT_JSON, prefix, &run, cli->json, error) &&
           write_whole(cli, x, NH_EXPORT_LATEX, prefix, &run, cli->tex, error);
    if (good && cli->folder) good = write_files(cli, x, target, prefix, &run, error);
    else if (good && target_given(cli) && nh_cli_delivers(cli))
        good = write_whole(cli, x, target, prefix, &run, "-", error);
    good = nh_cli_written(cli, good, error);
    nh_export_free(x);
    return !good ? (int)error->code : nh_interrupted() ? (int)nh_ended_code() : partial ? NH_LIMIT : (int)error->code;
}
