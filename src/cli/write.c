/* write: what every command that reports needs. */
#include <math.h>
#include <string.h>
#include <sys/stat.h>

#include "base/progress.h"
#include "cli/cli.h"
#include "document/unfinished.h"

nh_run nh_cli_run(const nh_cli *cli, const char *system_path, const char *analysis_path)
{
    return (nh_run){cli->line, system_path, analysis_path, cli->options.seed, cli->options.shown, NAN};
}

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
#define X(name, form, writer) if (cli->name) return #name;
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

/* Two names of one regular file. */
static bool same_file(const char *a, const char *b)
{
    struct stat one, other;
    return a && b && !stat(a, &one) && !stat(b, &other) && S_ISREG(one.st_mode) && one.st_dev == other.st_dev &&
           one.st_ino == other.st_ino;
}

/* Does it replace what this run reads? */
static bool is_read(const nh_cli *cli, const char *path)
{
    bool read = same_file(path, cli->analysis) || same_file(path, cli->table);
    for (size_t i = 0; i < cli->operands; i++) read |= same_file(path, cli->operand[i]);
    return read;
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
    return nh_output_possible(to->path, error);
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

bool nh_cli_write_picture(nh_cli *cli, nh_text *svg, nh_error *error)
{
    nh_text pdf;
    nh_text_init(&pdf);
    bool good = !cli->pdf || nh_cli_pdf(svg, &pdf, error);
    good = good && (!cli->pdf || write_to(cli, cli->pdf, pdf.data, pdf.length, error));
    good = good && (!cli->svg || write_to(cli, cli->svg, nh_text_string(svg), svg->length, error));
    nh_text_clear(&pdf);
    nh_text_clear(svg);
    return good;
}

bool nh_cli_write(nh_cli *cli, const char *path, nh_text *text, nh_error *error)
{
    bool good = write_to(cli, path, nh_text_string(text), text->length, error);
    nh_text_clear(text);
    return good;
}

bool nh_cli_write_json(nh_cli *cli, char *json, nh_error *error)
{
    bool good = write_to(cli, cli->json, json, strlen(json), error);
    nh_free(json);
    return good;
}

static nh_pen_style style_of(const nh_cli *cli, nh_pen_form form, bool colour)
{
    return (nh_pen_style){.form = form, .fragment = cli->fragment, .verbose = cli->verbose, .colour = colour};
}

bool nh_cli_write_words(nh_cli *cli, nh_cli_render *render, const void *result, const nh_run *run, nh_error *error)
{
    nh_text text;
    nh_text_init(&text);
    if (nh_cli_speaks(cli)) render(result, run, style_of(cli, NH_PEN_TEXT, cli->colour), &text);
    fputs(nh_text_string(&text), stdout);
    nh_text_clear(&text);
    if (!cli->folder) return true;
    render(result, run, style_of(cli, NH_PEN_TEXT, false), &text);
    return nh_cli_write(cli, nh_cli_in_folder(cli, "summary.txt"), &text, error);
}

bool nh_cli_write_documents(nh_cli *cli, nh_cli_render *render, const void *result, const nh_run *run, nh_error *error)
{
#define X(name, form, writer) cli->name,
    const char *const path[] = {NH_PEN_FORM_TABLE(X)};
#undef X
    nh_text text;
    bool good = true;
    nh_text_init(&text);
    for (nh_pen_form form = 0; form < NH_PEN_TEXT && good; form++) {
        if (!path[form]) continue;
        render(result, run, style_of(cli, form, false), &text);
        if (form == NH_PEN_PAGE && cli->folder) good = nh_cli_write_figures(cli, nh_text_string(&text), error);
        good = nh_cli_write(cli, path[form], &text, error) && good;
    }
    return good;
}

bool nh_cli_written(nh_cli *cli, bool good, nh_error *error) { return nh_output_end(&cli->files, good, error); }

/* ---- of a run that has no result ---- */

static void render_unfinished(const void *result, const nh_run *run, nh_pen_style style, nh_text *out)
{
    nh_unfinished_write(result, run, style, out);
}

/* Words are not printed where a table or code is expected. */
static bool write_unfinished(nh_cli *cli, const nh_unfinished *u, const nh_run *run, nh_error *error)
{
    bool quiet = cli->quiet;
    cli->quiet |= cli->to || !strcmp(cli->command, "simulate");
    bool good = nh_cli_write_words(cli, render_unfinished, u, run, error);
    cli->quiet = quiet;
    if (cli->json && good) good = nh_cli_write_json(cli, nh_unfinished_json(u, run), error);
    good = good && nh_cli_write_documents(cli, render_unfinished, u, run, error);
    return nh_cli_written(cli, good, error);
}

int nh_cli_failed(nh_cli *cli, const nh_run *run, nh_error *error)
{
    char doing[80], why[80];
    if (!nh_interrupted() || error->code == NH_USAGE) return error->code;
    nh_cli_guard_writing();
    nh_error_clear(error);
    nh_progress_last(doing, sizeof doing);
    nh_ended_words(why, sizeof why);
    nh_system *system = run->system_path ? nh_system_read(run->system_path, cli->settings, cli->setting, error) : NULL;
    nh_error_clear(error);
    nh_unfinished u = {system, doing, why, !strcmp(cli->command, "analyze")};
    bool good = !system || write_unfinished(cli, &u, run, error);
    nh_system_free(system);
    if (good) nh_fail_ended(error, "before there was a result%s%s", *doing ? ": " : "", doing);
    return error->code;
}
