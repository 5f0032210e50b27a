/* cli: declarations that all commands share.  Only this folder prints or exits. */
#ifndef NH_CLI_H
#define NH_CLI_H

#include <stdio.h>

#include "base/output.h"
#include "cli/cli_table.h"
#include "library/answer.h"
#include "nhsym.h"

#define NH_STANDARD_INPUT "/dev/stdin"

typedef enum { NH_PROGRESS_AUTO, NH_PROGRESS_ALWAYS, NH_PROGRESS_NEVER } nh_cli_progress;

typedef struct {
    const char *command;
    size_t operands;
    const char **operand;
    nh_request ask;              /* of the commands that compute */
    const char *analysis;        /* by name or path, or NULL */
    bool no_analysis;
    const char *json;            /* files; "-": standard output */
#define X(name, form, writer) const char *name;
    NH_PEN_FORM_TABLE(X)         /* likewise */
#undef X
    const char *svg, *pdf, *csv; /* pictures and tables */
    const char *wrote;           /* files of the folder, with commas */
    bool fragment;               /* the LaTeX without a preamble */
    const char *folder;          /* for all of them, or NULL */
    nh_cli_progress progress;
    bool quiet, verbose, colour, help;
    nh_output_set files;         /* that are written and not yet in their places */
    nh_arena *arena;
} nh_cli;

/* The program, from its main function: the exit code. `team` may be NULL. */
int nh_cli_main(int argc, char **argv, const nh_team *team);

/* The version and a fingerprint of the build: two different programs have different ones. */
const char *nh_cli_program(void);

/* Parse the words after the program's name. */
bool nh_cli_parse(nh_cli *cli, int argc, char **argv, nh_error *error);

/* Exit code of a command. */
typedef int nh_cli_command(nh_cli *cli, nh_error *error);
#define X(name, operand, meaning, example) nh_cli_command nh_cli_##name;
NH_CLI_COMMAND_TABLE(X)
#undef X

/* Before the work: what is being done is shown on stderr, as --progress says; --max-seconds, --max-memory, SIGINT and
 * SIGTERM end the work with what there is.  After it, before anything is written: signals end the process at once. */
void nh_cli_progress_begin(const nh_cli *cli);
void nh_cli_progress_end(void);
/* Of these two: signals and the limits of time (none when it is not finite) and memory (none when it is 0). */
void nh_cli_guard_begin(double seconds, double bytes);
void nh_cli_guard_worker(void); /* of a copy of the process: the time is for the first to watch */
void nh_cli_guard_writing(void);

/* Finds the file of a system; what it makes its reader notice goes to standard error. */
bool nh_cli_system(nh_cli *cli, const char *word, nh_error *error);

/* No answer came of the work: the exit code.  Where it was ended that is the reason, whatever failed for it, and what
   is known is written. */
int nh_cli_failed(nh_cli *cli, nh_error *error);
/* An answer in words, which are printed and stand in the folder of -o, or as a table or code; its JSON, documents,
   pictures and files, where they are wanted; what it says on standard error. */
bool nh_cli_write_answer(nh_cli *cli, const nh_answer *answer, nh_error *error);

/* Is the summary printed?  Not with --quiet, nor where an output takes standard output.  And what a command is called
 * for, such as a table or code: with --quiet as well, unless a file holds the result. */
bool nh_cli_speaks(const nh_cli *cli);
bool nh_cli_delivers(const nh_cli *cli);
/* Called before the computation: an output folder without write access is reported at once. */
bool nh_cli_can_write(const nh_cli *cli, nh_error *error);
/* A text for a file or standard output (`-`), which is cleared.  The files take their places together: with `good`, or
   not at all. */
bool nh_cli_write(nh_cli *cli, const char *path, nh_text *text, nh_error *error);
bool nh_cli_written(nh_cli *cli, bool good, nh_error *error);
/* The bytes of a picture as PDF; before anything is computed: is there a program that makes them? */
bool nh_cli_pdf_possible(nh_error *error);
bool nh_cli_pdf(const nh_text *svg, nh_text *out, nh_error *error);
/* The name of the first option that asks for a document; NULL: none does. */
const char *nh_cli_wants_document(const nh_cli *cli);
/* Text for a terminal, without its control characters; `text` is cleared. */
void nh_cli_print(nh_text *text);

/* -o DIR: make the folder; everything goes there, but for what has a place of its own. */
bool nh_cli_make_folder(nh_cli *cli, nh_error *error);
bool nh_cli_use_folder(nh_cli *cli, nh_error *error);
const char *nh_cli_in_folder(nh_cli *cli, const char *name);
/* The figures of a page as files of their own; those of an older run that this one does not have go when the files take
   their places. */
bool nh_cli_write_figures(nh_cli *cli, const char *page, nh_error *error);

#endif
