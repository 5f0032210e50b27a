/* program: from the command line to the exit code. */
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/escape.h"
#include "base/files.h"
#include "base/foreign_memory.h"
#include "base/leave.h"
#include "base/progress.h"
#include "cli/cli.h"
#include "cli/cli_table.h"
#include "library/catalogue.h"

static const struct {
    const char *name;
    nh_cli_command *run;
} commands[] = {
#define X(name, operand, meaning, example) {#name, nh_cli_##name},
    NH_CLI_COMMAND_TABLE(X)
#undef X
};
enum { command_count = sizeof commands / sizeof *commands };

extern const char nh_cli_fingerprint[]; /* the Makefile makes it */

const char *nh_cli_program(void)
{
    static char text[80];
    snprintf(text, sizeof text, "nhsym %s %s", NH_VERSION, nh_cli_fingerprint);
    return text;
}

static void out_of_memory(size_t wanted)
{
    char doing[80] = "";
    nh_leave_now();
    nh_progress_last(doing, sizeof doing);
    dprintf(STDERR_FILENO,
            "nhsym: %s%sout of memory: %.3g MB more were wanted\nhint: ask for less (a lower degree, fewer motions "
            "or times), or end other programs\n",
            doing, *doing ? ": " : "", (double)wanted / NH_MEGABYTE);
    _exit(NH_LIMIT);
}

static int run(nh_cli *cli, nh_error *error)
{
    if (cli->ask.team && cli->ask.team->size > 1 && cli->command && strcmp(cli->command, "scan")) {
        nh_fail(error, NH_USAGE, "", "several processes of nhsym-mpi share a scan, but no `%s`", cli->command);
        return nh_error_hint(error, "mpirun nhsym-mpi scan sleigh --over k=1:4:61 -o scan"), NH_USAGE;
    }
    if (cli->help || !cli->command) return nh_cli_help(cli, error);
    for (size_t i = 0; i < command_count; i++)
        if (!strcmp(cli->command, commands[i].name)) return commands[i].run(cli, error);
    nh_fail(error, NH_USAGE, "", "there is no command `%s`", cli->command);
    const char *near = nh_cli_command_near(cli->command);
    if (near) nh_error_hint(error, "did you mean `nhsym %s`?", near);
    else if (nh_catalogue_has(cli->command))
        nh_error_hint(error, "the command stands first, as in `nhsym analyze %s`", cli->command);
    else nh_error_hint(error, "`nhsym help` lists the commands");
    return NH_USAGE;
}

/* The command as one line; words with characters that a shell interprets are quoted. */
static const char *line_of(nh_cli *cli, int argc, char **argv)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, "nhsym");
    for (int i = 1; i < argc; i++) {
        bool bare = argv[i][0] && !argv[i][strspn(argv[i], plain)];
        nh_text_add(&text, bare ? " " : " '");
        for (const char *c = argv[i]; *c; c++)
            if (*c == '\'') nh_text_add(&text, "'\\''");
            else nh_text_add_n(&text, c, 1);
        nh_text_add(&text, bare ? "" : "'");
    }
    const char *line = nh_arena_strdup(cli->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return line;
}

/* Has the reader of a pipe gone? */
static bool left_alone(void)
{
    sigset_t waiting;
    return !sigpending(&waiting) && sigismember(&waiting, SIGPIPE);
}

int nh_cli_main(int argc, char **argv, const nh_team *team)
{
    nh_error error;
    nh_error_clear(&error);
    nh_memory_set_handler(out_of_memory);
    nh_foreign_memory_begin();
    nh_files_begin();
    nh_cli cli = {.arena = nh_arena_create()};
    cli.ask = (nh_request){.arena = cli.arena, .team = team};
    cli.ask.line = line_of(&cli, argc, argv);
    int code = nh_cli_parse(&cli, argc, argv, &error) ? run(&cli, &error) : (int)error.code;
    nh_request_blame(&cli.ask, &error);
    if (error.code == NH_USAGE) code = NH_USAGE;
    /* by the first process, too */
    bool said = team && team->rank && (error.code == NH_USAGE || error.code == NH_INPUT);
    if (error.code != NH_OK && !said) {
        char text[4096];
        nh_error_format(&error, text, sizeof text);
        nh_text shown;
        nh_text_init(&shown);
        nh_escape_terminal(text, &shown);
        fprintf(stderr, "nhsym: %s\n", nh_text_string(&shown));
        nh_text_clear(&shown);
    }
    nh_files_end();
    nh_arena_free(cli.arena);
    nh_answer_cleanup();
    if (fflush(stdout) || ferror(stdout)) {
        bool left = left_alone(); /* as by `| head`, which wants no more */
        if (!left) fprintf(stderr, "nhsym: standard output could not be written\n");
        code = code ? code : left ? NH_INTERRUPTED : NH_NUMERIC;
    }
    if (nh_interrupted()) _exit(code); /* an abandoned decomposition may still run */
    return code;
}
