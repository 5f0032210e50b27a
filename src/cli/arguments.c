/* arguments: the command line. */
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/cli.h"
#include "cli/cli_table.h"

enum {
    opt_set = 256,
    opt_analysis,
    opt_no_analysis,
    opt_velocities,
    opt_json,
    opt_fragment,
    opt_current,
    opt_field,
    opt_initial,
    opt_project,
    opt_method,
    opt_initial_table,
    opt_step,
    opt_watch,
    opt_scene,
    opt_budget,
    opt_svg,
    opt_pdf,
    opt_csv,
    opt_group,
    opt_chain,
    opt_inner,
    opt_weak,
    opt_to,
    opt_tolerance,
    opt_until,
    opt_seed,
    opt_samples,
    opt_columns,
    opt_degree,
    opt_threads,
    opt_max_seconds,
    opt_max_memory,
    opt_option,
    opt_progress,
    opt_no_color,
    opt_version,
    opt_accuracy,
    opt_ensemble,
    opt_spread,
    opt_robustness,
    opt_over,
    opt_shape,
    opt_equations,
    opt_of,
    opt_number,
    opt_workers,
    opt_chunk,
    opt_input,
    opt_name,
    opt_wheel,
    opt_base,
    opt_on,
    opt_event,
    opt_section,
    opt_axes,
#define X(name, form, writer) opt_##name,
    NH_PEN_FORM_TABLE(X)
#undef X
};

#define X(code, name, argument, shown, commands, meaning) {name, argument, NULL, code},
#define OLD(code, old, argument) {old, argument, NULL, code},
static const struct option long_options[] = {NH_CLI_OPTION_TABLE(X) NH_CLI_OLD_OPTION_TABLE(OLD){NULL, 0, NULL, 0}};
#undef OLD
#undef X
#define X(code, name, argument, shown, commands, meaning) {code, name, shown, commands},
static const struct {
    int code;
    const char *name, *shown, *commands;
} owners[] = {NH_CLI_OPTION_TABLE(X)};
#undef X
#define X(name, operand, meaning, example) #name " "
static const char all_commands[] = NH_CLI_COMMAND_TABLE(X);
#undef X
enum { owner_count = sizeof owners / sizeof *owners };

/* "name=value" cut at the sign. */
static bool assignment(nh_cli *cli, const char *text, const char *option, char **name, const char **value,
                       nh_error *error)
{
    const char *equal = strchr(text, '=');
    if (!equal || equal == text) {
        nh_fail(error, NH_USAGE, "", "--%s needs NAME=VALUE, found `%s`", option, text);
        double half; /* of 0,5 */
        const char *colon = strchr(text, ':'); /* of YAML */
        if (colon && colon != text)
            return nh_error_hint(error, "--%s \"%.*s=%s\"", option, (int)(colon - text), text,
                                 colon + 1 + strspn(colon + 1, " "));
        return nh_text_to_number(text, &half)
                   ? nh_error_hint(error, "commas stand between values, and decimals behind a point: 0.5")
                   : false;
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
    if (!nh_text_to_ratio(value, &x)) {
        nh_fail(error, NH_USAGE, "", "--set %s needs a number, found `%s`", name, value);
        return nh_error_hint_number(error, value);
    }
    cli->ask.setting[cli->ask.settings++] = (nh_setting){.name = name, .value = x};
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
    if (nh_text_to_number(text, out) && *out > 0) return true;
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

/* How many bytes of dashes a word begins with, including those that word processors put for `--`: U+2013, U+2014,
 * U+2212. */
static size_t dashes(const char *word)
{
    static const char *const typeset[] = {"\xe2\x80\x93", "\xe2\x80\x94", "\xe2\x88\x92"};
    size_t n = strspn(word, "-");
    for (size_t i = 0; i < 3; i++)
        if (!strncmp(word + n, typeset[i], 3)) return n + 3 + dashes(word + n + 3);
    return n;
}

/* The name under which help shows an option: the first with its code. */
static const char *name_of(int code)
{
    const struct option *o = long_options;
    while (o->val != code) o++;
    return o->name;
}

/* Where the user can read on: the help of the command, if the line names one. */
static const char *help_of(const nh_cli *cli)
{
    bool known = cli->command && nh_word_among(all_commands, cli->command);
    return nh_arena_printf(cli->arena, known ? "nhsym help %s" : "nhsym help", cli->command);
}

static bool takes(const nh_cli *cli, const char *option)
{
    bool known = cli->command && nh_word_among(all_commands, cli->command);
    for (size_t i = 0; i < owner_count; i++)
        if (!strcmp(owners[i].name, option)) return !known || nh_word_among(owners[i].commands, cli->command);
    return false;
}

/* The option that does here what other programs call `name`: one of this command, otherwise one of another command; or
 * NULL. */
static const char *named_elsewhere(const nh_cli *cli, const char *word)
{
    static const char *const others[][3] = {
        {"language", "to"},          {"lang", "to"},         {"target", "to"},          {"format", "to", "svg"},
        {"png", "svg", "output"},    {"plot", "svg", "output"}, {"figure", "svg", "output"},
        {"picture", "svg", "output"}, {"param", "set"},      {"params", "set"},         {"parameter", "set"},
        {"parameters", "set"},       {"time", "until"},      {"tend", "until"},         {"tmax", "until"},
        {"t", "until"},              {"duration", "until"},  {"dt", "step"},            {"x0", "initial"},
        {"state", "initial"},        {"solver", "method"},   {"integrator", "method"},  {"file", "output"},
        {"dir", "output"},           {"rtol", "tolerance"},   {"eps", "tolerance"},      {"report", "html"},
        {"timeout", "max-seconds"},   {"sweep", "over"},      {"vary", "over"},         {"range", "over"},
        {"grid", "over"},             {"inputs", "input"},    {"control", "input"}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        for (size_t k = 1; k < 3 && others[i][k]; k++)
            if (!strcmp(word, others[i][0]) && takes(cli, others[i][k])) return others[i][k];
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (!strcmp(word, others[i][0])) return others[i][1];
    return NULL;
}

static const char *commands_of(const char *option)
{
    for (size_t i = 0; i < owner_count; i++)
        if (!strcmp(owners[i].name, option)) return owners[i].commands;
    return "";
}

static bool unknown_option(const nh_cli *cli, const char *word, nh_error *error)
{
    const char *names[sizeof long_options / sizeof *long_options];
    size_t n = 0;
    for (const struct option *o = long_options; o->name; o++)
        if (takes(cli, name_of(o->val))) names[n++] = o->name;
    size_t length = strcspn(word, "=");
    nh_fail(error, NH_USAGE, "", "there is no option `%.*s`", (int)length, word);
    word = nh_arena_strndup(cli->arena, word, length);
    word += dashes(word);
    const char *near = named_elsewhere(cli, word);
    if (near && !takes(cli, near)) return nh_error_hint(error, "`--%s` belongs to: %s", near, commands_of(near));
    if (!near) near = nh_text_nearest(word, names, n);
    for (const struct option *o = long_options; near && o->name; o++)
        if (!strcmp(near, o->name)) near = name_of(o->val); /* an old name: the one of today */
    return near ? nh_error_hint(error, "did you mean `--%s`?", near)
                : nh_error_hint(error, "`%s` lists them", help_of(cli));
}

/* Is it a whole name of an option, up to its end or `=`? */
static bool is_option(const char *name)
{
    for (const struct option *o = long_options; o->name; o++)
        if (strlen(o->name) == strcspn(name, "=") && !strncmp(name, o->name, strlen(o->name))) return true;
    return false;
}

/* getopt accepts any unambiguous beginning of a name.  A script that uses one breaks with the next option that begins
 * likewise, so they are refused. */
static bool in_full(const nh_cli *cli, const char *word, int code, nh_error *error)
{
    size_t length = strcspn(word, "=");
    bool named = false;
    /* -html is not -h -t -m -l */
    if (strncmp(word, "--", 2))
        return !(word[0] == '-' && word[1] && word[2] && is_option(word + 1)) || unknown_option(cli, word, error);
    for (const struct option *o = long_options; o->name; o++) {
        named = named || o->val == code;
        if (o->val == code && strlen(o->name) + 2 == length && !strncmp(word + 2, o->name, length - 2)) return true;
    }
    if (!named) return true;
    nh_fail(error, NH_USAGE, "", "there is no option `%.*s`", (int)length, word);
    return nh_error_hint(error, "write the full name: `--%s`", name_of(code));
}

static bool missing_value(const nh_cli *cli, const char *word, int code, nh_error *error)
{
    const char *shown = "VALUE";
    for (size_t i = 0; i < owner_count; i++)
        if (owners[i].code == code) shown = owners[i].shown;
    nh_fail(error, NH_USAGE, "", "`%s` needs a value", word);
    return nh_error_hint(error, "write %s %s; `%s` describes the option", word, shown, help_of(cli));
}

/* "--html --quiet": the file's name is missing.  "--html=--quiet" would be a file. */
static bool swallows_option(const char *value) { return value && !strncmp(value, "--", 2) && is_option(value + 2); }

/* `-` is a file, too: texts that were read are kept, so a pipe will do. */
static const char *file_of(const char *word) { return strcmp(word, "-") ? word : NH_STANDARD_INPUT; }

static const char **output_of(nh_cli *cli, int code)
{
    return code == opt_svg ? &cli->svg : code == opt_pdf ? &cli->pdf : &cli->csv;
}

#define X(name, form, writer) case opt_##name: cli->name = value; return true;
static bool take(nh_cli *cli, int code, const char *value, nh_error *error)
{
    switch (code) {
    case opt_set: return each(cli, value, "set", set_parameter, error);
    case opt_seed: case opt_samples: case opt_tolerance: case opt_until:
    case opt_threads: case opt_columns: case opt_degree:
        return nh_request_option(&cli->ask, name_of(code), value, error);
    case opt_max_seconds: return nh_request_option(&cli->ask, "max_seconds", value, error);
    case opt_max_memory: return size(value, &cli->ask.options.max_memory, error);
    case opt_initial: cli->ask.initial = joined(cli, cli->ask.initial, value); return true;
    case opt_initial_table: cli->ask.table = file_of(value); return true;
    case opt_method: return nh_request_methods(&cli->ask, value, error);
    case opt_project: return cli->ask.project = true;
    case opt_weak: return cli->ask.weak = true;
    case opt_step: return positive(value, "step", &cli->ask.step, error);
    case opt_to: cli->ask.to = value; return true;
    case opt_input: return each(cli, value, "input", set_input, error);
    case opt_wheel: return each(cli, value, "wheel", add_wheel, error);
    case opt_on: return each(cli, value, "on", add_level, error);
    case opt_base: cli->ask.base = value; return true;
    case opt_name: cli->ask.name = value; return true;
    case opt_watch: cli->ask.watch = joined(cli, cli->ask.watch, value); return true;
    case opt_event: cli->ask.event = also(cli, cli->ask.event, value); return true;
    case opt_section: cli->ask.section = value; return true;
    case opt_axes: cli->ask.axes = value; return true;
    case opt_svg: case opt_pdf: case opt_csv: *output_of(cli, code) = value; return true;
    case opt_budget: return seconds(value, &cli->ask.budget, error);
    case opt_accuracy: return positive(value, "accuracy", &cli->ask.accuracy, error);
    case opt_ensemble: return members(value, &cli->ask.ensemble, error);
    case opt_spread: return positive(value, "spread", &cli->ask.spread, error);
    case opt_robustness: return cli->ask.robustness = true;
    case opt_over: return each(cli, value, "over", add_range, error);
    case opt_of: cli->ask.of = joined(cli, cli->ask.of, value); return true;
    case opt_number: return each(cli, value, "number", add_number, error);
    case opt_workers: return whole(value, "workers", 256, &cli->ask.workers, error);
    case opt_chunk: return set_chunk(cli, value, error);
    case opt_shape: return cli->ask.shape = true;
    case opt_scene: return cli->ask.scene = true;
    case opt_equations: return cli->ask.equations = true;
    case opt_chain: cli->ask.chain = also(cli, cli->ask.chain, value); return true;
    case opt_inner: cli->ask.inner = also(cli, cli->ask.inner, value); return true;
    case opt_group: cli->ask.group = joined(cli, cli->ask.group, value); return true;
    case opt_current: cli->ask.current = value; return true;
    case opt_field: cli->ask.field = joined(cli, cli->ask.field, value); return true;
    case opt_option: return each(cli, value, "option", add_option, error);
    case opt_velocities: return nh_request_velocities(&cli->ask, value, error);
    case opt_json: cli->json = value ? value : "-"; return true;
    case opt_progress: return set_progress(cli, value, error);
    case 'o': return set_folder(cli, value, error);
    NH_PEN_FORM_TABLE(X)
    case opt_fragment: return cli->fragment = true;
    case opt_analysis: cli->analysis = value; return true;
    case opt_no_analysis: return cli->no_analysis = true;
    case opt_no_color: cli->colour = false; return true;
    case opt_version: cli->command = "version"; return true;
    case 'q': return cli->quiet = true;
    case 'v': return cli->verbose = true;
    default: return cli->help = true;
    }
}
#undef X

/* Numerical options, and options about how much is printed, are accepted by every command, because scripts give them to
 * all. */
static bool for_all(int code)
{
    static const int codes[] = {'q',           'v',           'h',       opt_no_color, opt_progress,
                                opt_version,   opt_option,    opt_seed,  opt_samples,  opt_columns,
                                opt_degree,    opt_tolerance, opt_until, opt_threads,  opt_max_seconds,
                                opt_max_memory};
    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++)
        if (code == codes[i]) return true;
    return false;
}

/* Any other option that the command does not know is refused: an option that silently has no effect misleads. */
static bool all_belong(const nh_cli *cli, const bool *given, nh_error *error)
{
    if (cli->help || !cli->command || !nh_word_among(all_commands, cli->command)) return true;
    for (size_t i = 0; i < owner_count; i++) {
        if (!given[i] || for_all(owners[i].code) || nh_word_among(owners[i].commands, cli->command)) continue;
        nh_fail(error, NH_USAGE, "", "`nhsym %s` does not take --%s", cli->command, owners[i].name);
        return nh_error_hint(error, "`nhsym help %s` lists its options; this one belongs to: %s", cli->command,
                             owners[i].commands);
    }
    return true;
}

/* "--json FILE" with a space: getopt does not join an optional value, but the format promises it.  Before the system's
 * name, a word counts as FILE when it ends in .json. */
static const char *optional_value(const nh_cli *cli, int argc, char **argv)
{
    if (optarg || optind >= argc) return optarg;
    const char *next = argv[optind];
    size_t length = strlen(next);
    bool file = !strcmp(next, "-") || (length > 5 && !strcmp(next + length - 5, ".json"));
    if (!file && (next[0] == '-' || cli->operands == 0)) return NULL;
    optind++;
    return next;
}

static void take_operand(nh_cli *cli, const char *word) { cli->operand[cli->operands++] = file_of(word); }

bool nh_cli_parse(nh_cli *cli, int argc, char **argv, nh_error *error)
{
    size_t most = (size_t)argc + 1; /* entries of lists, and operands */
    for (int i = 1; i < argc; i++)
        for (const char *c = argv[i]; *c; c++) most += *c == ',' || *c == ';';
    cli->ask.setting = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.setting);
    cli->operand = nh_arena_alloc(cli->arena, most * sizeof *cli->operand);
    cli->ask.over_list = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.over_list);
    cli->ask.wheel = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.wheel);
    cli->ask.on = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.on);
    cli->ask.number = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.number);
    cli->colour = isatty(STDOUT_FILENO) && !getenv("NO_COLOR");
    nh_options_default(&cli->ask.options);
    bool given[owner_count] = {false};
    opterr = 0;
    optind = 1;
    for (int code, at = optind; (code = getopt_long(argc, argv, "-:qvho:", long_options, NULL)) != -1; at = optind) {
        if (code != 1 && !in_full(cli, argv[at], code, error)) return false;
        if (code != 1 && optind - at == 2 && swallows_option(optarg)) return missing_value(cli, argv[at], code, error);
        for (size_t i = 0; i < owner_count; i++) given[i] = given[i] || owners[i].code == code;
        if (code == 1 && optarg[0] != '-' && dashes(optarg)) {
            return unknown_option(cli, optarg, error);
        } else if (code == 1) {
            if (!cli->command) cli->command = nh_cli_command_name(optarg);
            else take_operand(cli, optarg);
        } else if (code == ':') {
            return missing_value(cli, argv[at], optopt, error);
        } else if (code == '?') {
            return unknown_option(cli, argv[at], error);
        } else if (!take(cli, code, code == opt_json ? optional_value(cli, argc, argv) : optarg, error)) {
            return false;
        }
    }
    while (optind < argc) take_operand(cli, argv[optind++]);
    cli->ask.command = cli->command;
    return all_belong(cli, given, error);
}
