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
    nh_request ask;       /* commands that compute something */
    const char *analysis; /* by name or path, or NULL */
    bool no_analysis;
    const char *json; /* files; "-": standard output */
#define X(name, form, writer) const char *name;
    NH_PEN_FORM_TABLE(X) /* likewise */
#undef X
    const char *svg, *pdf, *csv; /* pictures and tables */
    const char *wrote;           /* names of the folder's files, separated by commas */
    bool fragment;               /* LaTeX without a preamble */
    const char *folder;          /* for all of them, or NULL; of `new`: the file */
    const char *like;            /* of `new`: the system to begin with, or NULL */
    nh_cli_progress progress;
    bool quiet, verbose, colour, help;
    bool terminal;       /* standard output is one */
    nh_output_set files; /* output files that are written and not yet in their places */
    size_t figures;      /* of the page, written to the folder */
    bool drawn;          /* they were */
    bool wordless;       /* the folder has no summary in words */
    nh_arena *arena;
} nh_cli;

/* Runs the program; called by its main function.  Returns the exit code.  `team` may be NULL. */
int nh_cli_main(int argc, char **argv, const nh_team *team);

/* Comma-separated values as a table of 80 columns; `all`: with all rows and columns. */
void nh_cli_table(const char *csv, bool all, nh_text *out);

/* The version and a fingerprint of the build: two different programs have different ones. */
const char *nh_cli_program(void);

/* Parses the words after the program's name. */
bool nh_cli_parse(nh_cli *cli, int argc, char **argv, nh_error *error);

/* Computes the answer of the command; writes it to the folder, or prints it.  Returns the exit code. */
int nh_cli_documented(nh_cli *cli, nh_error *error);

/* Runs the command; returns its exit code. */
typedef int nh_cli_command(nh_cli *cli, nh_error *error);
#define X(name, operand, meaning, example) nh_cli_command nh_cli_##name;
NH_CLI_COMMAND_TABLE(X)
#undef X

/* nh_cli_progress_begin, before the work: progress is shown on stderr, as --progress says; --max-seconds, --max-memory,
 * SIGINT and SIGTERM end the work with partial results. nh_cli_progress_end, after the work and before anything is
 * written: from then on signals end the process at once. */
void nh_cli_progress_begin(const nh_cli *cli);
void nh_cli_progress_end(void);
/* The parts of these two for signals and the limits of time (seconds; not finite: none) and memory (bytes; 0: none). */
void nh_cli_guard_begin(double seconds, double bytes);
void nh_cli_guard_worker(void); /* in a copy of the process: only the first process watches the time */
void nh_cli_guard_writing(void);

/* Finds the file of a system; the reader's notes about it go to standard error. */
bool nh_cli_system(nh_cli *cli, const char *word, nh_error *error);

/* The exit code of a command that has no answer.  When a limit or a signal ended the work that is the reason, whatever
 * else failed; the answer known so far is written. */
int nh_cli_failed(nh_cli *cli, nh_error *error);
/* An answer in words, as a table or as code: words are printed and written to the folder of -o.  Its JSON, documents,
 * pictures and files are written where they are wanted; its warnings go to standard error. */
bool nh_cli_write_answer(nh_cli *cli, const nh_answer *answer, nh_error *error);

/* nh_cli_speaks: is the summary printed?  Not with --quiet, nor where an output takes standard output. nh_cli_delivers:
 * is the table or code that the command is called for printed?  Also with --quiet, unless a file holds it. */
bool nh_cli_speaks(const nh_cli *cli);
bool nh_cli_delivers(const nh_cli *cli);
/* Called before the computation: an output folder without write access is reported at once. */
bool nh_cli_can_write(const nh_cli *cli, nh_error *error);
/* Writes a text, which is cleared, to a file or to standard output (`-`). nh_cli_written: all files take their places
 * together if `good`; otherwise none does. */
bool nh_cli_write(nh_cli *cli, const char *path, nh_text *text, nh_error *error);
bool nh_cli_written(nh_cli *cli, bool good, nh_error *error);
/* The bytes of a picture as PDF.  The other function asks, before anything is computed, whether there is a program that
 * makes them. */
bool nh_cli_pdf_possible(nh_error *error);
bool nh_cli_pdf(const nh_text *svg, nh_text *out, nh_error *error);
/* The name of the first option that asks for a document; NULL: none. */
const char *nh_cli_wants_document(const nh_cli *cli);
/* Text for a terminal, without its control characters; `text` is cleared. */
void nh_cli_print(nh_text *text);

/* -o DIR: makes the folder; all output goes there, unless an option names another place. */
bool nh_cli_make_folder(nh_cli *cli, nh_error *error);
bool nh_cli_use_folder(nh_cli *cli, nh_error *error);
const char *nh_cli_in_folder(nh_cli *cli, const char *name);
/* Writes the figures of a page as separate files.  Figures of an older run that this one does not have are removed when
 * the files take their places. */
bool nh_cli_write_figures(nh_cli *cli, const char *page, nh_error *error);

#endif
