/* folder: -o DIR, which puts everything into one folder. */
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/cli.h"

static const char *figure_name(nh_cli *cli, size_t number)
{
    return nh_arena_printf(cli->arena, "figure%zu.svg", number);
}

const char *nh_cli_in_folder(nh_cli *cli, const char *name)
{
    return nh_arena_printf(cli->arena, "%s/%s", cli->folder, name);
}

bool nh_cli_make_folder(nh_cli *cli, nh_error *error)
{
    if (!cli->folder || !mkdir(cli->folder, 0777) || errno == EEXIST) return true;
    nh_fail(error, NH_NUMERIC, cli->folder, "the folder could not be created: %s", strerror(errno));
    return nh_error_hint(error, "-o takes a folder; its parent folder must exist");
}

bool nh_cli_use_folder(nh_cli *cli, nh_error *error)
{
    if (!cli->folder) return true;
    if (!nh_cli_make_folder(cli, error)) return false;
    if (!cli->json) cli->json = nh_cli_in_folder(cli, "result.json");
#define X(name, form, writer)                                                                                          \
    if (!cli->name) cli->name = nh_cli_in_folder(cli, "report." #name);
    NH_PEN_FORM_TABLE(X)
#undef X
    return true;
}

/* The number in a name that a figure has here; 0 for any other name. */
static size_t figure_number(nh_cli *cli, const char *name)
{
    static const char stem[] = "figure";
    if (strncmp(name, stem, sizeof stem - 1) || !isdigit((unsigned char)name[sizeof stem - 1])) return 0;
    size_t number = strtoul(name + sizeof stem - 1, NULL, 10);
    return strcmp(name, figure_name(cli, number)) ? 0 : number;
}

/* Is it a regular file that begins as this program's figure of that number does? */
static bool is_ours(const char *path, size_t number)
{
    char text[400] = "";
    struct stat info;
    int file = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    bool regular = file >= 0 && !fstat(file, &info) && S_ISREG(info.st_mode),
         begun = regular && read(file, text, sizeof text - 1) > 0;
    if (file >= 0) close(file);
    return begun && nh_answer_is_figure(text, number);
}

/* Figures with higher numbers are of an older run, and would be taken for this run's. */
static void drop_older(nh_cli *cli, size_t last)
{
    DIR *folder = opendir(cli->folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        size_t number = figure_number(cli, entry->d_name);
        const char *path = number > last ? nh_cli_in_folder(cli, entry->d_name) : NULL;
        if (path && is_ours(path, number)) nh_output_drop(&cli->files, path);
    }
    if (folder) closedir(folder);
}

bool nh_cli_write_figures(nh_cli *cli, const char *page, nh_error *error)
{
    size_t length, count = 0;
    bool good = true;
    for (const char *figure; good && nh_answer_figure(&page, &figure, &length);)
        good = nh_output_add(&cli->files, nh_cli_in_folder(cli, figure_name(cli, ++count)), figure, length, error);
    cli->figures = count;
    cli->drawn = good;
    return good;
}

bool nh_cli_written(nh_cli *cli, bool good, nh_error *error)
{
    good = good && nh_output_lock(&cli->files, error);
    if (good && cli->drawn) drop_older(cli, cli->figures);
    return nh_output_end(&cli->files, good, error);
}
