/* cli: declarations that all commands share.  Only this folder prints or exits. */
#ifndef NH_CLI_H
#define NH_CLI_H

#include <stdio.h>

#include "base/memory.h"
#include "base/option.h"
#include "base/output.h"
#include "base/sweep.h"
#include "base/text.h"
#include "document/pen.h"
#include "cli/cli_table.h"
#include "commands/analyze.h"
#include "commands/simulate.h"
#include "problem/places.h"

#define NH_STANDARD_INPUT "/dev/stdin"

typedef enum { NH_PROGRESS_AUTO, NH_PROGRESS_ALWAYS, NH_PROGRESS_NEVER } nh_cli_progress;

/* A value of an option in the text that completes a file: there from byte `begin` on, in what was typed from byte
   `offset` on. */
typedef struct {
    size_t begin, offset;
    const char *option, *typed;
} nh_cli_piece;

typedef struct {
    const char *command;
    size_t operands;
    const char **operand;
    const char *line;            /* the whole command, as it was typed */
    const char *analysis, *json; /* files; "-": standard output */
#define X(name, form, writer) const char *name;
    NH_PEN_FORM_TABLE(X)         /* likewise */
#undef X
    bool fragment;               /* the LaTeX without a preamble */
    const char *folder;          /* for all of them, or NULL */
    nh_cli_progress progress;
    const char *current, *field; /* questions of verify */
    bool equations;              /* of analyze and verify: the geometry written out */
    const char *initial;         /* of simulate and reduce */
    size_t methods;
    const nh_method **method;    /* --method, each */
    const char *table;           /* of initial states */
    const char *group, *chain, *inner, *to; /* of reduce; `to` of export, too */
    const char *input, *name;  /* of export */
    bool project, weak;
    const char *watch, *event, *section, *axes; /* of simulate */
    const char *over;            /* of benchmark and classify: every --over, with commas */
    size_t wheels;
    const char **wheel, *base;   /* --wheel, each; --base */
    size_t ons;
    const char **on;             /* --on, each */
    const char *completed;       /* the text that adds these to a file, or NULL */
    size_t pieces;
    nh_cli_piece *piece;
    size_t overs, numbers;
    const char **over_list, **number; /* of scan and simulate: every range, every number */
    const char *of;              /* of verify --field (constraint, equations), scan and export */
    size_t chunk, chunks, workers;
    const nh_team *team;         /* processes of one run on several machines; or NULL */
    bool scene, shape;           /* shape: of classify */
    double accuracy, spread;
    size_t ensemble;
    const char *svg, *pdf, *csv; /* of benchmark and simulate */
    bool robustness;
    double budget;
    double step;
    bool no_analysis;
    size_t settings;
    nh_setting *setting;
    nh_chart_choice velocities;
    nh_options options;
    bool seed_given, samples_given, tolerance_given, until_given;
    bool limited;                /* a time limit was given */
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

/* What simulate and benchmark ask for; `example` is the hint when no system is named. */
bool nh_cli_motion_request(nh_cli *cli, const char *example, nh_simulate_request *request, nh_error *error);

/* Before the work: what is being done is shown on stderr, as --progress says; --max-seconds, --max-memory, SIGINT and
 * SIGTERM end the work with what there is.  After it, before anything is written: signals end the process at once. */
void nh_cli_progress_begin(const nh_cli *cli);
void nh_cli_progress_end(void);
/* Of these two: signals and the limits of time (none when it is not finite) and memory (none when it is 0). */
void nh_cli_guard_begin(double seconds, double bytes);
void nh_cli_guard_worker(void); /* of a copy of the process: the time is for the first to watch */
void nh_cli_guard_writing(void);


/* Is one system named?  Else an error, with an example of the command. */
bool nh_cli_one_system(const nh_cli *cli, const char *example, nh_error *error);

/* The file of a system by name or path, with --wheel and --base; notes of the file go to standard error. */
const char *nh_cli_system(nh_cli *cli, const char *word, nh_error *error);

/* An error in what these options added to the file is one of the command line: the message shows the option and its
   value as it was typed. */
void nh_cli_blame(const nh_cli *cli, nh_error *error);

/* To repeat this command. */
nh_run nh_cli_run(const nh_cli *cli, const char *system_path, const char *analysis_path);
/* No result came of the work: the exit code.  Where it was ended that is the reason, whatever failed for it, and what
   is known is written. */
int nh_cli_failed(nh_cli *cli, const nh_run *run, nh_error *error);
/* Is the summary printed?  Not with --quiet, nor where an output takes standard output.  And what a command is called
 * for, such as a table or code: with --quiet as well, unless a file holds the result. */
bool nh_cli_speaks(const nh_cli *cli);
bool nh_cli_delivers(const nh_cli *cli);
/* Called before the computation: an output folder without write access is reported at once. */
bool nh_cli_can_write(const nh_cli *cli, nh_error *error);
/* A text for a file or standard output (`-`), which is cleared; a JSON, which is freed, for --json.  The files take
   their places together, in the last of these: with `good`, or not at all. */
bool nh_cli_write(nh_cli *cli, const char *path, nh_text *text, nh_error *error);
/* A picture to where --svg and --pdf want it; its text is cleared.  And the bytes of the PDF. */
bool nh_cli_write_picture(nh_cli *cli, nh_text *svg, nh_error *error);
bool nh_cli_pdf(const nh_text *svg, nh_text *out, nh_error *error);
bool nh_cli_write_json(nh_cli *cli, char *json, nh_error *error);
bool nh_cli_written(nh_cli *cli, bool good, nh_error *error);

/* A result in words, which are printed and stand in the folder of -o; its page and its LaTeX document, where they are
   wanted. */
typedef void nh_cli_render(const void *result, const nh_run *run, nh_pen_style style, nh_text *out);
bool nh_cli_write_words(nh_cli *cli, nh_cli_render *render, const void *result, const nh_run *run, nh_error *error);
/* The name of the first option that asks for a document; NULL: none does. */
const char *nh_cli_wants_document(const nh_cli *cli);
bool nh_cli_write_documents(nh_cli *cli, nh_cli_render *render, const void *result, const nh_run *run, nh_error *error);

/* -o DIR: make the folder; everything goes there, but for what has a place of its own. */
bool nh_cli_use_folder(nh_cli *cli, nh_error *error);
const char *nh_cli_in_folder(nh_cli *cli, const char *name);
/* The figures of a page as files of their own; those of an older run that this one does not have go when the files take
   their places. */
bool nh_cli_write_figures(nh_cli *cli, const char *page, nh_error *error);

#endif
