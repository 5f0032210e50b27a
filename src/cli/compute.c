/* compute: the commands that compute an answer. */
#include <string.h>

#include "base/progress.h"
#include "cli/cli.h"

static bool lacks(nh_error *error, const char *what, const char *example)
{
    nh_fail(error, NH_USAGE, "", "%s", what);
    return nh_error_hint(error, "%s", example);
}

/* Is exactly one system named?  Otherwise an error, with an example of the command. */
static bool one_system(const nh_cli *cli, const char *example, nh_error *error)
{
    if (cli->operands == 1) return true;
    if (!cli->operands) nh_fail(error, NH_USAGE, "", "`nhsym %s` needs a system", cli->command);
    else
        nh_fail(error, NH_USAGE, "", "`nhsym %s` takes one system, but a second one is given: `%s`", cli->command,
                cli->operand[1]);
    return nh_error_hint(error, "%s", example);
}

/* The files that the command is about. */
static bool open_files(nh_cli *cli, nh_error *error)
{
    nh_request *q = &cli->ask;
    bool takes = nh_answer_kind_of(cli->command)->analysis;
    if (takes && cli->analysis && !nh_request_analysis(q, cli->analysis, error)) return false;
    const char *word = cli->operands ? cli->operand[0] : q->analysis_path ? nh_request_subject(q, error) : NULL;
    if (error->code != NH_OK) return false;
    if (!word)
        return lacks(error, "`nhsym analyze` needs a system or an analysis file",
                     "nhsym analyze sleigh, or nhsym analyze mine.yaml");
    if (!nh_cli_system(cli, word, error)) return false;
    if (takes && !q->analysis_path && !cli->no_analysis) nh_request_usual_analysis(q, word);
    return true;
}

static bool begin(nh_cli *cli, nh_error *error)
{
    const nh_answer_kind *kind = nh_answer_kind_of(cli->command);
    cli->ask.folder = cli->folder;
    cli->ask.documents = cli->json || nh_cli_wants_document(cli);
    nh_cli_progress_begin(cli);
    return (!kind->check || kind->check(&cli->ask, error)) && open_files(cli, error);
}

/* The answer and the outputs that are made of it; `write` says which. */
static int answer(nh_cli *cli, bool (*write)(nh_cli *, const nh_answer *, nh_error *), nh_error *error)
{
    nh_answer a;
    cli->ask.json = cli->json != NULL;
    cli->ask.csv = cli->csv != NULL;
    cli->ask.documents = cli->json || nh_cli_wants_document(cli);
    bool done = nh_answer_create(&a, &cli->ask, error);
    nh_cli_progress_end();
    if (!done) return nh_cli_failed(cli, error);
    bool good = write(cli, &a, error);
    int code = good ? a.kind->code(&a, error) : (int)error->code;
    nh_answer_free(&a);
    return code;
}

/* Writes to the folder, or prints. */
int nh_cli_documented(nh_cli *cli, nh_error *error)
{
    if (!begin(cli, error) || !nh_cli_use_folder(cli, error) || !nh_cli_can_write(cli, error)) return error->code;
    return answer(cli, nh_cli_write_answer, error);
}

int nh_cli_analyze(nh_cli *cli, nh_error *error)
{
    if (cli->fragment && !cli->tex && !cli->folder)
        return lacks(error, "--fragment needs --tex", "for example: --tex body.tex --fragment"), NH_USAGE;
    if (cli->operands > 1) return one_system(cli, "nhsym analyze sleigh", error), NH_USAGE;
    return nh_cli_documented(cli, error);
}

int nh_cli_verify(nh_cli *cli, nh_error *error)
{
    if (cli->operands > 1) return one_system(cli, "nhsym verify sleigh --current \"m*v\"", error), NH_USAGE;
    if (cli->operands != 1 || !cli->ask.current == !cli->ask.field)
        return lacks(error, "`nhsym verify` needs one system and either --current or --field",
                     "nhsym verify sleigh --current \"m*v\", or --field \"Z0=1; phi=phi'; x=x'\""),
               NH_USAGE;
    return nh_cli_documented(cli, error);
}

int nh_cli_benchmark(nh_cli *cli, nh_error *error)
{
    return one_system(cli, "nhsym benchmark sleigh", error) ? nh_cli_documented(cli, error) : NH_USAGE;
}

int nh_cli_reduce(nh_cli *cli, nh_error *error)
{
    static const char example[] = "nhsym reduce crane, or nhsym reduce mine.yaml --group \"x=1; y=1\"";
    return one_system(cli, example, error) ? nh_cli_documented(cli, error) : NH_USAGE;
}

int nh_cli_linearize(nh_cli *cli, nh_error *error)
{
    static const char example[] = "nhsym linearize double_pendulum --at \"q=pi\"";
    return one_system(cli, example, error) ? nh_cli_documented(cli, error) : NH_USAGE;
}

int nh_cli_classify(nh_cli *cli, nh_error *error)
{
    if (cli->operands > 1) return one_system(cli, "nhsym classify penning_trap --over w --degree 2", error), NH_USAGE;
    if (cli->operands != 1 || !cli->ask.over)
        return lacks(error, "classify which system, over which parameter?",
                     "nhsym classify penning_trap --over w --degree 2"),
               NH_USAGE;
    return nh_cli_documented(cli, error);
}

/* Several motions are one table, or one picture. */
static bool one_table(const nh_cli *cli, nh_error *error)
{
    const nh_request *q = &cli->ask;
    if (!q->table && !q->overs) return true;
    if (q->table && q->overs)
        return lacks(error, "--initial-table, and --over as well", "write the values of --over into the table");
    const char *document = nh_cli_wants_document(cli), *other = q->ensemble   ? "ensemble"
                                                                : cli->folder ? "output"
                                                                              : document;
    if (!other) return true;
    nh_fail(error, NH_USAGE, "", "--%s, and --%s as well", q->overs ? "over" : "initial-table", other);
    return nh_error_hint(error, "several motions are one table (--csv), one picture (--svg) or one JSON");
}

int nh_cli_simulate(nh_cli *cli, nh_error *error)
{
    if (!one_system(cli, "nhsym simulate sleigh --initial \"omega=2\" --until 10", error)) return NH_USAGE;
    if (cli->ask.input)
        return nh_fail(error, NH_USAGE, "", "--input needs NAME=EXPR, found `%s`", cli->ask.input),
               nh_error_hint(error,
                             strstr(cli->ask.input, ".csv") ? "a column of a table: --input \"u=%s:COLUMN\""
                                                            : "for example: --input \"%s=sin(t)\"",
                             cli->ask.input),
               NH_USAGE;
    if (!one_table(cli, error)) return NH_USAGE;
    cli->ask.draw = nh_cli_wants_document(cli) != NULL; /* before the folder wants all of them */
    cli->ask.picture = cli->ask.draw || cli->svg || cli->pdf || cli->folder;
    return nh_cli_documented(cli, error);
}

/* ---- a scan: its folder holds the work, too ---- */

/* Of a part of the grid only words are written; a member of a team that another speaks for writes nothing. */
static bool write_scan(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    if (!cli->json) cli->json = nh_cli_in_folder(cli, "scan.json");
    if (a->silent) return true;
    if (!a->words_only) {
        bool good = nh_cli_use_folder(cli, error) && nh_cli_write_answer(cli, a, error);
        if (!good) a->kind->code(a, error); /* the message says what is kept */
        return good;
    }
    nh_text text;
    nh_text_init(&text);
    if (nh_cli_speaks(cli)) a->kind->write(a, (nh_pen_style){.form = NH_PEN_TEXT, .colour = cli->colour}, &text);
    fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
    return true;
}

int nh_cli_scan(nh_cli *cli, nh_error *error)
{
    nh_request *q = &cli->ask;
    if (cli->operands != 1 || !q->overs || !cli->folder)
        return lacks(error,
                     cli->operands != 1 ? "scan which system?"
                     : !q->overs        ? "scan over which values of which parameter?"
                                        : "into which folder?",
                     "nhsym scan sleigh --over k=1:4:61 -o DIR"),
               NH_USAGE;
    q->program = nh_cli_program();
    q->begin_worker = nh_cli_guard_worker;
    if (!begin(cli, error) || !nh_cli_can_write(cli, error)) return error->code;
    return answer(cli, write_scan, error);
}

/* Notes of the reader of the file: an analysis has warnings of its own. */
bool nh_cli_system(nh_cli *cli, const char *word, nh_error *error)
{
    nh_text text;
    if (!nh_request_system(&cli->ask, word, error)) return false;
    if (cli->quiet || nh_word_among("analyze show", cli->command)) return true;
    nh_text_init(&text);
    nh_request_remarks(&cli->ask, "nhsym: ", &text);
    fputs(nh_text_string(&text), stderr);
    nh_text_clear(&text);
    return true;
}

/* ---- an export: code into files, or printed ---- */

/* For a folder the summary says which files it has. */
static bool write_code(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    if (!nh_cli_make_folder(cli, error) || !nh_cli_write_answer(cli, a, error)) return false;
    if (!cli->folder || !nh_cli_speaks(cli)) return true;
    nh_text summary;
    nh_text_init(&summary);
    a->kind->write(a, (nh_pen_style){.form = NH_PEN_TEXT}, &summary);
    printf("%swritten: %s\n", nh_text_string(&summary), cli->wrote);
    nh_text_clear(&summary);
    return true;
}

int nh_cli_export(nh_cli *cli, nh_error *error)
{
    if (!one_system(cli, "nhsym export sleigh --to c -o code", error)) return NH_USAGE;
    return begin(cli, error) && nh_cli_can_write(cli, error) ? answer(cli, write_code, error) : (int)error->code;
}
