/* option_values: what each option of the command line asks for. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/option_values.h"

/* "name=value" cut at the sign. */
static bool assignment(nh_cli *cli, const char *text, const char *option, char **name, const char **value,
                       nh_error *error)
{
    const char *equal = strchr(text, '=');
    if (!equal || equal == text) {
        nh_fail(error, NH_USAGE, "", "--%s needs NAME=VALUE, found `%s`", option, text);
        double half;                           /* of 0,5 */
        const char *colon = strchr(text, ':'); /* of YAML */
        if (colon && colon != text)
            return nh_error_hint(error, "--%s \"%.*s=%s\"", option, (int)(colon - text), text,
                                 colon + 1 + strspn(colon + 1, " "));
        const nh_setting *last = cli->ask.settings ? &cli->ask.setting[cli->ask.settings - 1] : NULL;
        bool number = nh_text_to_number(text, &half);
        if (number && last && !last->input && !strcmp(option, "set")) /* g=9,81 */
            return nh_error_hint(error, "use a decimal point: --set %s=%g.%s", last->name, last->value, text);
        return number ? nh_error_hint(error, "commas stand between values, and decimals behind a point: 0.5") : false;
    }
    size_t length = (size_t)(equal - text);
    while (length && text[length - 1] == ' ') length--;
    *name = nh_arena_strndup(cli->arena, text, length);
    *value = equal + 1 + strspn(equal + 1, " ");
    return true;
}

/* A list may be given by one option or by several, separated by semicolons or commas. */
static const char *also(nh_cli *cli, const char *before, const char *more)
{
    return before ? nh_arena_printf(cli->arena, "%s; %s", before, more) : more;
}
static const char *joined(nh_cli *cli, const char *before, const char *more)
{
    return before ? nh_arena_printf(cli->arena, "%s, %s", before, more) : more;
}

/* Reads every entry of a list, without the blanks around it. */
static bool each(nh_cli *cli, const char *list, const char *option, bool (*take)(nh_cli *, const char *, nh_error *),
                 nh_error *error)
{
    for (const char *at = list;; at++) {
        at += strspn(at, " ");
        size_t length = nh_text_entry(at, ",;"), end = length;
        while (end && at[end - 1] == ' ') end--;
        if (!end && (at[length] || at == list))
            return nh_fail(error, NH_USAGE, "", "--%s: nothing stands %s `%s`", option,
                           at == list ? "first in" : "between two commas of", list);
        if (end && !take(cli, nh_arena_strndup(cli->arena, at, end), error)) return false;
        at += length;
        if (!*at) return true;
    }
}

static bool set_parameter(nh_cli *cli, const char *text, nh_error *error)
{
    char *name;
    const char *value;
    if (!assignment(cli, text, "set", &name, &value, error)) return false;
    double x;
    if (strchr(name, '(')) { /* of a function */
        nh_request_setting(&cli->ask, (nh_setting){.name = name, .input = value});
        nh_request_typed(&cli->ask, "set", name, value);
        return true;
    }
    if (!nh_request_number(value, &x)) {
        nh_fail(error, NH_USAGE, "", "--set %s needs a number, found `%s`", name, value);
        return nh_error_hint_number(error, value);
    }
    nh_request_setting(&cli->ask, (nh_setting){.name = name, .value = x});
    return true;
}

/* Reads "u = sin(t)" or "u = FILE.csv:COLUMN"; for an export the name alone. */
static bool set_input(nh_cli *cli, const char *text, nh_error *error)
{
    char *name;
    const char *value;
    if (!strchr(text, '=')) return cli->ask.input = joined(cli, cli->ask.input, text), true;
    if (!assignment(cli, text, "input", &name, &value, error)) return false;
    return nh_request_input(&cli->ask, name, value, error);
}

static bool add_wheel(nh_cli *cli, const char *text, nh_error *error)
{
    return (void)error, cli->ask.wheel[cli->ask.wheels++] = text, true;
}
static bool add_level(nh_cli *cli, const char *text, nh_error *error)
{
    return (void)error, cli->ask.on[cli->ask.ons++] = text, true;
}
static bool add_number(nh_cli *cli, const char *text, nh_error *error)
{
    return (void)error, cli->ask.number[cli->ask.numbers++] = text, true;
}

/* Reads "k=1:2:11", "k=1" or "B"; an entry without a name, behind a comma, is one more value: k=1,2,5/2. */
static bool add_range(nh_cli *cli, const char *text, nh_error *error)
{
    (void)error;
    const char **last = cli->ask.overs ? &cli->ask.over_list[cli->ask.overs - 1] : NULL;
    bool value = last && strchr(*last, '=') && !strchr(text, '=');
    cli->ask.over = joined(cli, cli->ask.over, text);
    if (value) *last = nh_arena_printf(cli->arena, "%s,%s", *last, text);
    else cli->ask.over_list[cli->ask.overs++] = text;
    return true;
}

/* "absolute=1e-12" */
static bool add_option(nh_cli *cli, const char *text, nh_error *error)
{
    char *name;
    const char *value;
    return assignment(cli, text, "option", &name, &value, error) && nh_request_option(&cli->ask, name, value, error);
}

static bool positive(const char *text, const char *option, double *out, nh_error *error)
{
    if (nh_request_number(text, out) && *out > 0) return true;
    nh_fail(error, NH_USAGE, "", "--%s needs a positive number, found `%s`", option, text);
    return nh_error_hint_number(error, text);
}

/* "5", "5s" or "200ms". */
static bool seconds(const char *text, double *out, nh_error *error)
{
    char *end;
    *out = strtod(text, &end);
    double unit = !strcmp(end, "ms") ? 1e-3 : !*end || !strcmp(end, "s") ? 1 : 0;
    *out *= unit;
    if (end != text && *out > 0 && *out - *out == 0) return true;
    return nh_fail(error, NH_USAGE, "", "--budget needs a time such as 5s or 200ms, found `%s`", text);
}

/* "500M" or "2G", in megabytes. */
static bool size(const char *text, double *out, nh_error *error)
{
    static const char letters[] = "kmgt";
    char *end;
    double x = strtod(text, &end);
    const char *letter = *end ? strchr(letters, *end | 0x20) : NULL;
    if (letter) end += 1 + (end[1] == 'i'), end += (*end | 0x20) == 'b'; /* also GB and GiB */
    if (letter) *out = x * pow(1024, (double)(letter - letters) - 1);
    if (letter && end != text && !*end && *out > 0 && *out <= 1e9) return true;
    return nh_fail(error, NH_USAGE, "", "--max-memory needs a size such as 500M or 2G, found `%s`", text);
}

static bool members(const char *text, size_t *out, nh_error *error)
{
    double x;
    if (!positive(text, "ensemble", &x, error)) return false;
    *out = (size_t)x;
    return (x == (double)*out && x <= 1e7) ||
           nh_fail(error, NH_USAGE, "", "--ensemble needs a whole number of members up to 1e7, found `%s`", text);
}

static bool whole(const char *text, const char *option, size_t most, size_t *out, nh_error *error)
{
    double x;
    if (!nh_text_to_number(text, &x) || !(x >= 1) || x > (double)most || x != floor(x))
        return nh_fail(error, NH_USAGE, "", "--%s needs a whole number from 1 to %zu, found `%s`", option, most, text);
    *out = (size_t)x;
    return true;
}

/* "3/40": the third of forty parts. */
static bool set_chunk(nh_cli *cli, const char *text, nh_error *error)
{
    const char *slash = strchr(text, '/');
    nh_request *q = &cli->ask;
    nh_error ignored;
    nh_error_clear(&ignored);
    bool good = slash && whole(slash + 1, "chunk", 1000000, &q->chunks, &ignored);
    const char *number = good ? nh_arena_strndup(cli->arena, text, (size_t)(slash - text)) : NULL;
    if (good && whole(number, "chunk", q->chunks, &q->chunk, &ignored)) return q->chunk--, true;
    nh_fail(error, NH_USAGE, "", "--chunk needs I/N with I from 1 to N, found `%s`", text);
    return nh_error_hint(error, "--chunk 3/40 is the third of forty parts");
}

/* A word with the file ending of another option is a file for that option, unless there is a folder of this name. */
static bool set_folder(nh_cli *cli, const char *text, nh_error *error)
{
    static const char *const endings[] = {"csv", "json", "html", "tex", "svg", "pdf"};
    const char *dot = strrchr(text, '.');
    struct stat info;
    cli->folder = text;
    for (size_t i = 0; dot && i < sizeof endings / sizeof *endings; i++)
        if (!strcmp(dot + 1, endings[i]) && stat(text, &info))
            return nh_fail(error, NH_USAGE, "", "-o takes a folder, but `%s` is the name of a file", text),
                   nh_error_hint(error, "a file is written by --%s %s", endings[i], text);
    return true;
}

static bool set_progress(nh_cli *cli, const char *text, nh_error *error)
{
    static const char *const names[] = {"auto", "always", "never"};
    for (int i = 0; i < 3; i++) {
        if (strcmp(text, names[i])) continue;
        cli->progress = (nh_cli_progress)i;
        return true;
    }
    nh_fail(error, NH_USAGE, "", "--progress does not know `%s`", text);
    return nh_error_hint_near(error, text, names, sizeof names / sizeof *names,
                              "--progress takes auto, always or never");
}

/* Texts that were read are kept, so a pipe will do. */
const char *nh_option_value_file(const char *word) { return strcmp(word, "-") ? word : NH_STANDARD_INPUT; }

/* Where the text of an option is kept as it is; NULL: of another option. */
static const char **text_of(nh_cli *cli, int code)
{
    switch (code) {
    case opt_svg: return &cli->svg;
    case opt_pdf: return &cli->pdf;
    case opt_csv: return &cli->csv;
    case opt_to: return &cli->ask.to;
    case opt_base: return &cli->ask.base;
    case opt_section: return &cli->ask.section;
    case opt_axes: return &cli->ask.axes;
    case opt_current: return &cli->ask.current;
    case opt_analysis: return &cli->analysis;
    case opt_name: return &cli->ask.name;
    case opt_like: return &cli->like;
    default: return NULL;
    }
}

/* Numerical options (docs/options.md) that have a name of their own on the command line. */
static bool is_numerical(int code)
{
    return code == opt_seed || code == opt_samples || code == opt_tolerance || code == opt_until ||
           code == opt_threads || code == opt_columns || code == opt_degree;
}

/* Options without a value. */
static bool *flag_of(nh_cli *cli, int code)
{
    switch (code) {
    case opt_project: return &cli->ask.project;
    case opt_weak: return &cli->ask.weak;
    case opt_robustness: return &cli->ask.robustness;
    case opt_fit: return &cli->ask.fit;
    case opt_shape: return &cli->ask.shape;
    case opt_scene: return &cli->ask.scene;
    case opt_equations: return &cli->ask.equations;
    case opt_absence: return &cli->ask.absence;
    default: return NULL;
    }
}

#define X(name, form, writer)                                                                                          \
    case opt_##name: cli->name = value; return true;
bool nh_option_value_take(nh_cli *cli, int code, const char *name, const char *value, nh_error *error)
{
    const char **text = text_of(cli, code);
    bool *flag = flag_of(cli, code);
    if (text) return *text = value, true;
    if (flag) return *flag = true;
    if (is_numerical(code)) return nh_request_option(&cli->ask, name, value, error);
    switch (code) {
    case opt_set: return each(cli, value, "set", set_parameter, error);
    case opt_max_seconds: return nh_request_option(&cli->ask, "max_seconds", value, error);
    case opt_max_memory: return size(value, &cli->ask.options.max_memory, error);
    case opt_at:
    case opt_initial: cli->ask.initial = joined(cli, cli->ask.initial, value); return true;
    case opt_initial_table: cli->ask.table = nh_option_value_file(value); return true;
    case opt_method: return nh_request_methods(&cli->ask, value, error);
    case opt_step: return positive(value, "step", &cli->ask.step, error);
    case opt_input: return each(cli, value, "input", set_input, error);
    case opt_wheel: return each(cli, value, "wheel", add_wheel, error);
    case opt_on: return each(cli, value, "on", add_level, error);
    case opt_watch: cli->ask.watch = joined(cli, cli->ask.watch, value); return true;
    case opt_event: cli->ask.event = also(cli, cli->ask.event, value); return true;
    case opt_budget: return seconds(value, &cli->ask.budget, error);
    case opt_accuracy: return positive(value, "accuracy", &cli->ask.accuracy, error);
    case opt_ensemble: return members(value, &cli->ask.ensemble, error);
    case opt_spread: return positive(value, "spread", &cli->ask.spread, error);
    case opt_over: return each(cli, value, "over", add_range, error);
    case opt_of: cli->ask.of = joined(cli, cli->ask.of, value); return true;
    case opt_number: return each(cli, value, "number", add_number, error);
    case opt_workers: return whole(value, "workers", 256, &cli->ask.workers, error);
    case opt_chunk: return set_chunk(cli, value, error);
    case opt_chain: cli->ask.chain = also(cli, cli->ask.chain, value); return true;
    case opt_inner: cli->ask.inner = also(cli, cli->ask.inner, value); return true;
    case opt_group: cli->ask.group = joined(cli, cli->ask.group, value); return true;
    case opt_field: cli->ask.field = joined(cli, cli->ask.field, value); return true;
    case opt_option: return each(cli, value, "option", add_option, error);
    case opt_route: return nh_request_route(&cli->ask, value, error);
    case opt_grid: return nh_request_grid(&cli->ask, value, error);
    case opt_velocities: return nh_request_velocities(&cli->ask, value, error);
    case opt_json: cli->json = value ? value : "-"; return true;
    case opt_progress: return set_progress(cli, value, error);
    case 'o': return set_folder(cli, value, error); NH_PEN_FORM_TABLE(X)
    case opt_fragment: return cli->fragment = true;
    case opt_no_analysis: return cli->no_analysis = true;
    case opt_no_color: cli->colour = false; return true;
    case opt_version: cli->command = "version"; return true;
    case 'q': return cli->quiet = true;
    case 'v': return cli->verbose = true;
    default: return cli->help = true;
    }
}
#undef X
