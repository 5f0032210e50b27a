/* arguments: the command line. */
#include <getopt.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli_table.h"
#include "cli/option_values.h"

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
    static const char *const others[][3] = {{"language", "to"},
                                            {"lang", "to"},
                                            {"target", "to"},
                                            {"format", "to", "svg"},
                                            {"png", "svg", "output"},
                                            {"plot", "svg", "output"},
                                            {"figure", "svg", "output"},
                                            {"picture", "svg", "output"},
                                            {"param", "set"},
                                            {"params", "set"},
                                            {"parameter", "set"},
                                            {"parameters", "set"},
                                            {"time", "until"},
                                            {"tend", "until"},
                                            {"tmax", "until"},
                                            {"t", "until"},
                                            {"duration", "until"},
                                            {"dt", "step"},
                                            {"x0", "initial"},
                                            {"state", "initial"},
                                            {"solver", "method"},
                                            {"integrator", "method"},
                                            {"file", "output"},
                                            {"dir", "output"},
                                            {"rtol", "tolerance"},
                                            {"eps", "tolerance"},
                                            {"report", "html"},
                                            {"timeout", "max-seconds"},
                                            {"sweep", "over"},
                                            {"vary", "over"},
                                            {"range", "over"},
                                            {"grid", "over"},
                                            {"inputs", "input"},
                                            {"control", "input"}};
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
        bool named = cli->operands == 1; /* then the line to write can be given */
        return nh_error_hint(error, "`nhsym help %s` lists its options; this one belongs to: %s%s%.*s%s%.100s%s%s%s",
                             cli->command, owners[i].commands, named ? " (nhsym " : "",
                             named ? (int)strcspn(owners[i].commands, " ") : 0, owners[i].commands, named ? " " : "",
                             named ? cli->operand[0] : "", named ? " --" : "", named ? owners[i].name : "",
                             named ? " ..)" : "");
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

static void take_operand(nh_cli *cli, const char *word) { cli->operand[cli->operands++] = nh_option_value_file(word); }

bool nh_cli_parse(nh_cli *cli, int argc, char **argv, nh_error *error)
{
    size_t most = (size_t)argc + 1; /* entries of lists, and operands */
    for (int i = 1; i < argc; i++)
        for (const char *c = argv[i]; *c; c++) most += *c == ',' || *c == ';';
    cli->operand = nh_arena_alloc(cli->arena, most * sizeof *cli->operand);
    cli->ask.over_list = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.over_list);
    cli->ask.wheel = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.wheel);
    cli->ask.on = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.on);
    cli->ask.number = nh_arena_alloc(cli->arena, most * sizeof *cli->ask.number);
    cli->terminal = isatty(STDOUT_FILENO);
    cli->colour = cli->terminal && !getenv("NO_COLOR");
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
        } else {
            const char *value = code == opt_json ? optional_value(cli, argc, argv) : optarg;
            if (!nh_option_value_take(cli, code, name_of(code), value, error)) return false;
        }
    }
    while (optind < argc) take_operand(cli, argv[optind++]);
    cli->ask.command = cli->command;
    return all_belong(cli, given, error);
}
