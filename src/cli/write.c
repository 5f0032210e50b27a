/* write: the output that all commands share. */
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "base/escape.h"
#include "base/progress.h"
#include "cli/cli.h"

/* The files of --json, --svg, --pdf, --csv and of documents; those that are not given are NULL. */
enum { outputs = 4 + NH_PEN_TEXT };
typedef struct {
    const char *option, *path;
} destination;
static void list_outputs(const nh_cli *cli, destination to[outputs])
{
#define X(name, form, writer) {#name, cli->name},
    const destination all[outputs] = {
        NH_PEN_FORM_TABLE(X){"json", cli->json}, {"svg", cli->svg}, {"pdf", cli->pdf}, {"csv", cli->csv}};
#undef X
    memcpy(to, all, sizeof all);
}

const char *nh_cli_wants_document(const nh_cli *cli)
{
#define X(name, form, writer)                                                                                          \
    if (cli->name) return #name;
    NH_PEN_FORM_TABLE(X)
#undef X
    return NULL;
}

static bool is_stdout(const char *path) { return path && !strcmp(path, "-"); }

bool nh_cli_delivers(const nh_cli *cli)
{
    destination to[outputs];
    bool taken = false, held = false;
    list_outputs(cli, to);
    for (size_t i = 0; i < outputs; i++) taken |= is_stdout(to[i].path), held |= to[i].path != NULL;
    return !taken && !(cli->quiet && held);
}

bool nh_cli_speaks(const nh_cli *cli) { return !cli->quiet && nh_cli_delivers(cli); }

/* Do two names stand for one regular file? */
static bool same_file(const char *a, const char *b)
{
    struct stat one, other;
    return a && b && !stat(a, &one) && !stat(b, &other) && S_ISREG(one.st_mode) && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

/* Would the output overwrite a file that this run reads? */
static bool is_read(const nh_cli *cli, const char *path)
{
    bool read = same_file(path, cli->analysis) || same_file(path, cli->ask.table);
    for (size_t i = 0; i < cli->operands; i++) read |= same_file(path, cli->operand[i]);
    return read;
}

/* A file of one option must not have the ending of another: its reader would find something else than the ending
 * says. */
static bool ending_fits(const destination *to, nh_error *error)
{
    static const char *const ending[][2] = {{"html", "html"}, {"tex", "tex"}, {"json", "json"}, {"svg", "svg"},
                                            {"pdf", "pdf"},   {"csv", "csv"}, {"png", "svg"},   {"jpg", "svg"}};
    const char *dot = strrchr(to->path, '.');
    for (size_t i = 0; dot && i < sizeof ending / sizeof *ending; i++) {
        if (strcasecmp(dot + 1, ending[i][0]) || !strcmp(ending[i][0], to->option)) continue;
        nh_fail(error, NH_USAGE, "", "--%s does not write files of this kind: `%s`", to->option, to->path);
        if (!strcmp(ending[i][1], to->option)) return nh_error_hint(error, "pictures are .svg or .pdf");
        return nh_error_hint(error, "did you mean --%s %s?", ending[i][1], to->path);
    }
    return true;
}

static bool can_write(const nh_cli *cli, const destination *to, size_t before, nh_error *error)
{
    if (!to->path || is_stdout(to->path)) return true;
    if (!*to->path) return nh_fail(error, NH_USAGE, "", "--%s needs the name of a file", to->option);
    if (is_read(cli, to->path)) {
        nh_fail(error, NH_USAGE, "", "--%s would replace %s, which is read", to->option, to->path);
        return nh_error_hint(error, "give it another name");
    }
    for (size_t i = 0; i < before; i++) {
        const destination *other = to - 1 - i;
        if (!other->path || (strcmp(other->path, to->path) && !same_file(other->path, to->path))) continue;
        nh_fail(error, NH_USAGE, "", "--%s and --%s would write one file, %s", other->option, to->option, to->path);
        return nh_error_hint(error, "give each a file of its own");
    }
    return ending_fits(to, error) && nh_output_possible(to->path, error);
}

bool nh_cli_can_write(const nh_cli *cli, nh_error *error)
{
    destination to[outputs];
    size_t printed = 0;
    list_outputs(cli, to);
    for (size_t i = 0; i < outputs; i++) {
        printed += is_stdout(to[i].path);
        if (!can_write(cli, &to[i], i, error)) return false;
    }
    if (cli->pdf && !nh_cli_pdf_possible(error)) return false;
    if (printed < 2) return true;
    nh_fail(error, NH_USAGE, "", "`-` prints one output, but %zu options take it", printed);
    return nh_error_hint(error, "give the others a file");
}

static bool write_to(nh_cli *cli, const char *path, const char *text, size_t length, nh_error *error)
{
    if (!is_stdout(path)) return nh_output_add(&cli->files, path, text, length, error);
    fwrite(text, 1, length, stdout);
    return true;
}

bool nh_cli_write(nh_cli *cli, const char *path, nh_text *text, nh_error *error)
{
    bool good = write_to(cli, path, nh_text_string(text), text->length, error);
    nh_text_clear(text);
    return good;
}

void nh_cli_print(nh_text *text)
{
    nh_text safe;
    nh_text_init(&safe);
    nh_escape_terminal(nh_text_string(text), &safe);
    fputs(nh_text_string(&safe), stdout);
    nh_text_clear(&safe);
    nh_text_clear(text);
}

/* ---- answers ---- */

static nh_pen_style style_of(const nh_cli *cli, nh_pen_form form, bool colour)
{
    return (nh_pen_style){.form = form, .fragment = cli->fragment, .verbose = cli->verbose, .colour = colour};
}

/* The document in words: printed, and in the folder of -o. */
static bool put_words(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    if (nh_cli_speaks(cli)) a->kind->write(a, style_of(cli, NH_PEN_TEXT, cli->colour), &text);
    fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
    if (!cli->folder || cli->wordless) return true;
    nh_pen_style all = style_of(cli, NH_PEN_TEXT, false);
    all.verbose = true;
    a->kind->write(a, all, &text);
    return nh_cli_write(cli, nh_cli_in_folder(cli, "summary.txt"), &text, error);
}

/* The file that holds the table; NULL: none does. */
static const char *table_path(nh_cli *cli, const nh_answer *a)
{
    const char *name = a->kind->table_name;
    return cli->csv && a->kind->table ? cli->csv : cli->folder && name ? nh_cli_in_folder(cli, name) : NULL;
}

/* A table as it is, or on a terminal for people. */
static void print_table(const nh_cli *cli, const nh_answer_kind *kind, const nh_text *table)
{
    nh_text text;
    nh_text_init(&text);
    bool shown = kind->tabular && cli->terminal;
    if (shown) nh_cli_table(nh_text_string(table), cli->verbose, &text);
    fputs(shown ? nh_text_string(&text) : nh_text_string(table), stdout);
    nh_text_clear(&text);
}

/* Prints a table or code, unless a file has it, otherwise the document in words; then the notes. */
static bool put_answer(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    const nh_answer_kind *k = a->kind;
    nh_text text;
    nh_text_init(&text);
    bool filed = k->table_name && table_path(cli, a), good = true;
    bool held = filed || (k->table_name && cli->json) || (k->files && cli->folder);
    bool table = k->print && k->print(a, &text), printed = table && !held && !a->failed && nh_cli_delivers(cli);
    if (printed) print_table(cli, k, &text);
    nh_text_clear(&text);
    if (!table) good = put_words(cli, a, error);
    if (k->notes && !cli->quiet) k->notes(a, cli->verbose, printed || filed, &text);
    fputs(nh_text_string(&text), stderr);
    nh_text_clear(&text);
    return good;
}

/* Writes the table and the other files to the folder. */
static bool put_files(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    nh_answer_file file[NH_ANSWER_FILES];
    const char *path = a->failed ? NULL : table_path(cli, a);
    nh_text text;
    nh_text_init(&text);
    if (path) a->kind->table(a, &text);
    bool good = !path || nh_cli_write(cli, path, &text, error);
    size_t n = good && cli->folder && a->kind->files ? a->kind->files(a, file) : 0;
    for (size_t i = 0; i < n; i++) {
        path = nh_cli_in_folder(cli, file[i].name);
        cli->wrote = cli->wrote ? nh_arena_printf(cli->arena, "%s, %s", cli->wrote, path) : path;
        good = nh_cli_write(cli, path, &file[i].text, error) && good;
    }
    return good;
}

static bool put_json(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    if (!cli->json) return true;
    char *json = a->kind->json(a);
    bool good = write_to(cli, cli->json, json, strlen(json), error);
    nh_free(json);
    return good;
}

static bool put_documents(nh_cli *cli, const nh_answer *a, nh_error *error)
{
#define X(name, form, writer) cli->name,
    const char *const path[] = {NH_PEN_FORM_TABLE(X)};
#undef X
    nh_text text;
    bool good = true;
    nh_text_init(&text);
    for (nh_pen_form form = 0; form < NH_PEN_TEXT && good; form++) {
        if (!path[form]) continue;
        a->kind->write(a, style_of(cli, form, false), &text);
        if (form == NH_PEN_PAGE && cli->folder) good = nh_cli_write_figures(cli, nh_text_string(&text), error);
        good = nh_cli_write(cli, path[form], &text, error) && good;
    }
    return good;
}

/* Writes the picture to where --svg and --pdf want it. */
static bool put_picture(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    nh_text svg, pdf;
    if ((!cli->svg && !cli->pdf) || !a->kind->picture) return true;
    nh_text_init(&svg);
    nh_text_init(&pdf);
    a->kind->picture(a, &svg);
    bool good = !cli->pdf || nh_cli_pdf(&svg, &pdf, error);
    good = good && (!cli->pdf || write_to(cli, cli->pdf, pdf.data, pdf.length, error));
    good = good && (!cli->svg || write_to(cli, cli->svg, nh_text_string(&svg), svg.length, error));
    nh_text_clear(&pdf);
    nh_text_clear(&svg);
    return good;
}

bool nh_cli_write_answer(nh_cli *cli, const nh_answer *a, nh_error *error)
{
    bool good = put_answer(cli, a, error) && put_files(cli, a, error) && put_json(cli, a, error) &&
                put_documents(cli, a, error) && put_picture(cli, a, error);
    return nh_cli_written(cli, good && !a->failed, error);
}

int nh_cli_failed(nh_cli *cli, nh_error *error)
{
    nh_answer a;
    char doing[80];
    if (!nh_interrupted() || error->code == NH_USAGE) return error->code;
    nh_cli_guard_writing();
    nh_error_clear(error);
    nh_progress_last(doing, sizeof doing);
    bool some = nh_answer_unfinished(&a, &cli->ask), quiet = cli->quiet;
    /* words are not printed where a table or code is expected */
    cli->wordless = cli->ask.to || !strcmp(cli->command, "simulate");
    cli->quiet |= cli->wordless;
    /* an older table would be taken for this run's */
    const char *table = nh_answer_kind_of(cli->command)->table_name;
    if (some && cli->folder && table) nh_output_drop(&cli->files, nh_cli_in_folder(cli, table));
    bool good = !some || (nh_cli_make_folder(cli, error) && nh_cli_write_answer(cli, &a, error));
    cli->quiet = quiet;
    if (some) nh_answer_free(&a);
    if (good) nh_fail_ended(error, "before there was a result%s%s", *doing ? ": " : "", doing);
    return error->code;
}
