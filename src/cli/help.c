/* help: screens, the manual page and completions, all from the two tables. */
#include <getopt.h>
#include <stdbool.h>
#include <string.h>

#include "cli/cli.h"
#include "cli/cli_table.h"
#include "library/catalogue.h"

typedef struct {
    const char *name;
    int argument;
    const char *shown, *commands, *meaning;
} option_word;

typedef struct {
    const char *name, *operand, *meaning, *example;
} command_word;

#define X(code, name, argument, shown, commands, meaning) {name, argument, shown, commands, meaning},
static const option_word options[] = {NH_CLI_OPTION_TABLE(X)};
#undef X
#define X(name, operand, meaning, example) {#name, operand, meaning, example},
static const command_word commands[] = {NH_CLI_COMMAND_TABLE(X)};
#undef X
#define X(option, commands, meaning) {option, commands, meaning},
static const struct {
    const char *option, *commands, *meaning;
} meanings[] = {NH_CLI_MEANING_TABLE(X)};
#undef X
enum { meaning_count = sizeof meanings / sizeof *meanings };
enum { option_count = sizeof options / sizeof *options, command_count = sizeof commands / sizeof *commands };

/* The letter of "-q: no summary", or 0. */
static char letter(const option_word *o) { return o->meaning[0] == '-' && o->meaning[2] == ':' ? o->meaning[1] : 0; }

/* For a command, or (NULL) for all. */
static const char *meaning(const option_word *o, const char *command)
{
    for (size_t i = 0; command && i < meaning_count; i++)
        if (!strcmp(meanings[i].option, o->name) && nh_word_among(meanings[i].commands, command))
            return meanings[i].meaning;
    return letter(o) ? o->meaning + 4 : o->meaning;
}

static bool takes(const command_word *c, const option_word *o) { return nh_word_among(o->commands, c->name); }

/* ---- screens ---- */

/* Two columns on a screen of 80; an entry too long for the first column has a line of its own. */
static void put_row(const char *head, const char *text)
{
    enum { indent = 2, second = 34, screen = 80 };
    int at = printf("%*s%s", indent, "", head);
    if (at >= second) at = printf("\n") - 1;
    at += printf("%*s", second - at, "");
    for (bool first = true; *text; first = false) {
        int word = (int)strcspn(text, " ");
        if (!first && at + 1 + word > screen) at = printf("\n%*s", second, "") - 1;
        else if (!first) at += printf(" ");
        at += printf("%.*s", word, text);
        text += word + strspn(text + word, " ");
    }
    puts("");
}

static void put_option(const option_word *o, const char *command)
{
    char head[80], first[6] = "";
    if (letter(o)) snprintf(first, sizeof first, "-%c, ", letter(o));
    snprintf(head, sizeof head, "%s--%s%s%s", first, o->name, o->shown[0] ? " " : "", o->shown);
    put_row(head, meaning(o, command));
}

static void one_command(const command_word *c)
{
    printf("nhsym %s%s%s   %s\n\n", c->name, c->operand[0] ? " " : "", c->operand, c->meaning);
    for (size_t i = 0; i < option_count; i++)
        if (takes(c, &options[i])) put_option(&options[i], c->name);
    printf("\nExample\n  %s\n", c->example);
}

static void all_commands(void)
{
    puts("nhsym: symmetries and conservation laws of mechanical systems with constraints\n");
    for (size_t i = 0; i < command_count; i++) {
        char head[60];
        snprintf(head, sizeof head, "nhsym %s %s", commands[i].name, commands[i].operand);
        printf("  %-28s %s\n", head, commands[i].meaning);
    }
    puts("\n  --set NAME=VALUE             set a parameter; repeatable\n"
         "  --json [FILE|-]  --html FILE  --tex FILE  -o DIR     output files\n"
         "  --quiet  --details  --no-color  --help      `nhsym help COMMAND` lists all\n"
         "\nExample");
    for (size_t i = 0; i < command_count; i++)
        if (nh_word_among("analyze", commands[i].name)) printf("  %s\n", commands[i].example);
}

/* ---- the manual page ---- */

static void roff(const char *text)
{
    if (*text == '.' || *text == '\'') fputs("\\&", stdout);
    for (; *text; text++) {
        if (*text == '-') fputs("\\-", stdout);
        else if (*text == '\\') fputs("\\e", stdout);
        else putchar(*text);
    }
}

static void manual_page(void)
{
    puts(".TH NHSYM 1 \"\" \"nhsym " NH_VERSION "\" \"User Commands\"\n.ad l\n.SH NAME");
    puts("nhsym \\- symmetries and conservation laws of mechanical systems with constraints\n.SH SYNOPSIS");
    for (size_t i = 0; i < command_count; i++)
        printf(".B nhsym %s\n.I %s\n.br\n", commands[i].name, commands[i].operand[0] ? commands[i].operand : "\\&");
    puts(".SH COMMANDS");
    for (size_t i = 0; i < command_count; i++) {
        printf(".TP\n.B %s\n", commands[i].name);
        roff(commands[i].meaning);
        fputs("\n.br\n", stdout);
        roff(commands[i].example);
        putchar('\n');
    }
    puts(".SH OPTIONS");
    for (size_t i = 0; i < option_count; i++) {
        fputs(".TP\n\\fB\\-\\-", stdout);
        roff(options[i].name);
        fputs("\\fR ", stdout);
        roff(options[i].shown);
        putchar('\n');
        roff(meaning(&options[i], NULL));
        if (options[i].commands[0]) printf(" (%s)", options[i].commands);
        putchar('\n');
        for (size_t j = 0; j < meaning_count; j++) {
            if (strcmp(meanings[j].option, options[i].name)) continue;
            printf(".br\n%s: ", meanings[j].commands);
            roff(meanings[j].meaning);
            putchar('\n');
        }
    }
    puts(".SH EXIT STATUS\n0 success; 1 verify answers no; 2 an error in the command line; 3 an error in a file; 4 a "
         "numerical failure; the message gives the reason; 5 a limit was reached; 130 interrupted. "
         "After 5 and 130 the output files hold partial results, marked partial.\n.SH ENVIRONMENT\n.TP\n.B "
         "NHSYM_PATH\nfolders with systems and analyses, separated by colons\n.TP\n.B NHSYM_CC\nthe C compiler for "
         "long motions (default: cc); empty: no compiler\n.TP\n.B NO_COLOR\n"
         "no colours\n.SH FILES\n.TP\n.B share/nhsym\nsystems and analyses, beside the folder bin of the program\n"
         ".TP\n.B share/doc/nhsym\nthe documentation: README.md, tutorial.md, formats.md (files, "
         "command line and JSON), motions.md,\nexport.md, python.md\n.SH SEE ALSO\n.BR nhsym (3)");
}

/* ---- completions ---- */

/* Options whose values are names of the system, or begin with one: which names, as `nhsym show --of` takes them, and
 * what follows the name. */
static const struct {
    const char *option, *commands, *of, *behind;
} named[] = {
    {"set", "", "parameters", "="},
    {"input", "", "parameters", "="},
    {"initial", "", "coordinates,velocities", "="},
    {"over", "simulate benchmark", "parameters,coordinates,velocities", ""},
    {"over", "classify scan", "parameters", ""},
    {"watch", "", "coordinates,velocities", ""},
    {"event", "", "coordinates,velocities", ""},
    {"section", "", "coordinates,velocities", ""},
    {"axes", "", "coordinates,velocities", ""},
    {"current", "", "parameters,coordinates,velocities", ""},
    {"field", "", "coordinates", "="},
};
enum { named_count = sizeof named / sizeof *named };

/* The first row of an option for a command (NULL: any), or named_count. */
static size_t names_for(const char *option, const char *command)
{
    size_t i = 0;
    while (i < named_count && (strcmp(named[i].option, option) ||
                               (command && *named[i].commands && !nh_word_among(named[i].commands, command))))
        i++;
    return i;
}

/* The words that an option of a command, or a command, takes, separated by `between`; nothing where there is no fixed
 * list. */
static void put_values(const char *name, const char *shown, const char *command, const char *between)
{
    if (strchr(shown, '|') && shown[0] != '[') {
        for (; *shown; shown++) fputs(*shown == '|' ? between : (char[]){*shown, 0}, stdout);
    } else if (!strcmp(name, "help")) {
        for (size_t i = 0; i < command_count; i++) printf("%s%s", i ? between : "", commands[i].name);
        printf("%sman%sbash%szsh%sfish", between, between, between, between);
    } else {
        nh_text text;
        nh_text_init(&text);
        nh_catalogue_values(name, command, between, &text);
        fputs(nh_text_string(&text), stdout);
        nh_text_clear(&text);
    }
}

static bool has_values(const option_word *o)
{
    return (strchr(o->shown, '|') && o->shown[0] != '[') || nh_word_among("method option of", o->name);
}
static bool by_command(const option_word *o) { return !strcmp(o->name, "of"); }
static bool is_file(const option_word *o)
{
    return !strcmp(o->shown, "FILE") || !strcmp(o->shown, "DIR") || strstr(o->shown, "FILE|-");
}

/* The names of the system on the command line, for the part of the word behind its last comma; outside of quotes a
 * prime needs a backslash. */
static const char bash_names[] =
    "# bash completion for nhsym; written by `nhsym help bash`\n"
    "_nhsym_names() {\n"
    "    local word=${COMP_WORDS[COMP_CWORD]} each name names=\"\" begin end\n"
    "    for each in \"${COMP_WORDS[@]:2:COMP_CWORD-2}\"; do\n"
    "        case $each in -*) continue ;; esac\n"
    "        names=$(nhsym show \"$each\" --of \"$1\" 2>/dev/null) && break\n"
    "    done\n"
    "    end=${word##*[,; \\\"\\']} begin=${word%\"$end\"}\n"
    "    case $word in [\\\"\\']*) begin=${begin#?} ;; *) names=${names//\\'/\\\\\\'} ;; esac\n"
    "    compopt -o nospace 2>/dev/null\n"
    "    for name in $names; do case $name in \"$end\"*) COMPREPLY+=(\"$begin$name$2\") ;; esac; done\n"
    "}\n";

static void bash_named(const char *option)
{
    printf("    --%s) case ${COMP_WORDS[1]} in", option);
    for (size_t i = 0; i < named_count; i++) {
        if (strcmp(named[i].option, option)) continue;
        fputs(" ", stdout);
        for (const char *c = named[i].commands; *c; c++) putchar(*c == ' ' ? '|' : *c);
        printf("%s) COMPREPLY=(); _nhsym_names %s \"%s\" ;;", *named[i].commands ? "" : "*", named[i].of,
               named[i].behind);
    }
    puts(" esac; return ;;");
}

/* An option that takes other words in each command. */
static void bash_by_command(const option_word *o)
{
    printf("    --%s) case ${COMP_WORDS[1]} in", o->name);
    for (size_t i = 0; i < command_count; i++) {
        if (!takes(&commands[i], o)) continue;
        printf(" %s) COMPREPLY=($(compgen -W \"", commands[i].name);
        put_values(o->name, o->shown, commands[i].name, " ");
        fputs("\" -- \"$word\")) ;;", stdout);
    }
    puts(" esac; return ;;");
}

static void bash(void)
{
    fputs(bash_names, stdout);
    puts("_nhsym() {\n    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} options=\"\"\n    "
         "case $before in");
    for (size_t i = 0; i < option_count; i++) {
        if (options[i].argument != required_argument) continue;
        if (names_for(options[i].name, NULL) < named_count) {
            bash_named(options[i].name);
            continue;
        }
        if (by_command(&options[i])) {
            bash_by_command(&options[i]);
            continue;
        }
        bool file = is_file(&options[i]), equation = !strcmp(options[i].name, "option");
        printf("    %.1s%.1s%.1s--%s) %sCOMPREPLY=(", letter(&options[i]) ? "-" : "",
               letter(&options[i]) ? &options[i].meaning[1] : "", letter(&options[i]) ? "|" : "", options[i].name,
               equation ? "compopt -o nospace 2>/dev/null; " : "");
        if (file) fputs("$(compgen -f -- \"$word\")", stdout);
        else
            fputs("$(compgen -W \"", stdout), put_values(options[i].name, options[i].shown, "", " "),
                fputs("\" -- \"$word\")", stdout);
        puts("); return ;;");
    }
    fputs("    esac\n    if [ \"$COMP_CWORD\" = 1 ]; then COMPREPLY=($(compgen -W \"", stdout);
    for (size_t i = 0; i < command_count; i++) printf("%s%s", i ? " " : "", commands[i].name);
    puts("\" -- \"$word\")); return; fi\n    case ${COMP_WORDS[1]} in");
    for (size_t i = 0; i < command_count; i++) {
        printf("    %s) options=\"", commands[i].name);
        for (size_t j = 0; j < option_count; j++)
            if (takes(&commands[i], &options[j])) printf("--%s ", options[j].name);
        puts("\" ;;");
    }
    puts("    esac\n    case ${COMP_WORDS[1]} in");
    for (const char *const *name = (const char *const[]){"explain", "help", NULL}; *name; name++) {
        printf("    %s) COMPREPLY=($(compgen -W \"", *name);
        put_values(*name, "", *name, " ");
        puts("\" -- \"$word\")); return ;;");
    }
    puts("    esac\n    case $word in\n    -*) COMPREPLY=($(compgen -W \"$options\" -- \"$word\")) ;;\n"
         "    *) COMPREPLY=($(compgen -W \"$(nhsym list 2>/dev/null | cut -d' ' -f1)\" -- \"$word\") $(compgen -f -X "
         "'!*.yaml' -- \"$word\") $(compgen -f -X '!*.urdf' -- \"$word\") $(compgen -d -- \"$word\")) ;;\n    "
         "esac\n}\ncomplete -F _nhsym nhsym");
}

/* In single quotes of a shell. */
static void quoted(const char *text)
{
    for (; *text; text++)
        if (*text == '\'') fputs("'\\''", stdout);
        else putchar(*text);
}

static void zsh(void)
{
    puts("#compdef nhsym\n# written by `nhsym help zsh`\n"
         "_nhsym_names() {\n    local each\n    local -a names\n    for each in ${line[@]} ${words[3,CURRENT-1]}; do\n"
         "        [[ $each = -* ]] && continue\n        names=(${(f)\"$(nhsym show ${(Q)each} --of $1 2>/dev/null)\"}) "
         "&& [[ -n $names ]] && break\n    done\n"
         "    compset -P '*[,; ]'\n    compadd -S \"$2\" -q -a names\n}\n"
         "local -a commands systems\ncommands=(");
    for (size_t i = 0; i < command_count; i++) {
        printf("    '%s:", commands[i].name);
        quoted(commands[i].meaning);
        puts("'");
    }
    puts(")\nif (( CURRENT == 2 )); then _describe command commands; return; fi\nsystems=(${(f)\"$(nhsym list "
         "2>/dev/null | cut -d' ' -f1)\"})\ncase $words[2] in");
    for (size_t i = 0; i < command_count; i++) {
        printf("%s) _arguments", commands[i].name);
        for (size_t j = 0; j < option_count; j++) {
            if (!takes(&commands[i], &options[j])) continue;
            printf(" \\\n    '--%s%s[", options[j].name, options[j].argument == required_argument ? "=" : "");
            for (const char *c = meaning(&options[j], commands[i].name); *c; c++) {
                char one[2] = {*c, 0};
                if (strchr("[]:", *c)) putchar('\\');
                quoted(one);
            }
            size_t row = names_for(options[j].name, commands[i].name);
            printf("]%s", options[j].argument != required_argument ? ""
                          : is_file(&options[j])                   ? ":file:_files"
                                                                   : ":value:");
            if (row < named_count) printf("{_nhsym_names %s \"%s\"}", named[row].of, named[row].behind);
            if (has_values(&options[j])) {
                putchar('(');
                put_values(options[j].name, options[j].shown, commands[i].name, " ");
                putchar(')');
            }
            putchar('\'');
        }
        fputs(" \\\n    '*:word:", stdout);
        if (nh_word_among("explain help", commands[i].name))
            putchar('('), put_values(commands[i].name, "", commands[i].name, " "), putchar(')');
        else fputs("->system", stdout);
        puts("' ;;");
    }
    puts("esac\nif [[ $state == system ]]; then compadd -a systems; _files -g '*.(yaml|urdf)'; fi");
}

static void fish(void)
{
    puts("# fish completion for nhsym; written by `nhsym help fish`\n"
         "function __nhsym_names\n    set -l begin (string replace -r '[^,; \"]*$' '' -- (commandline -ct) | string "
         "replace -r '^[\"\\']' '')\n"
         "    for each in (commandline -opc)[3..-1]\n        string match -q -- '-*' $each; and continue\n"
         "        set -l names (nhsym show $each --of $argv[1] 2>/dev/null); or continue\n        string replace -r "
         "'^(.*)$' \"$begin\\$1$argv[2]\" -- $names\n        return\n    end\nend\n"
         "complete -c nhsym -f");
    for (size_t i = 0; i < command_count; i++) {
        printf("complete -c nhsym -n __fish_use_subcommand -a %s -d '", commands[i].name);
        for (const char *c = commands[i].meaning; *c; c++) printf(*c == '\'' ? "\\'" : "%c", *c);
        puts("'");
    }
    for (size_t j = 0; j < option_count; j++) {
        bool file = is_file(&options[j]), required = options[j].argument == required_argument;
        printf("complete -c nhsym -n '__fish_seen_subcommand_from %s' -l %s %s -d '", options[j].commands,
               options[j].name,
               file       ? "-r -F"
               : required ? "-x"
                          : "");
        for (const char *c = meaning(&options[j], NULL); *c; c++) printf(*c == '\'' ? "\\'" : "%c", *c);
        if (has_values(&options[j]) && !by_command(&options[j]))
            fputs("' -a '", stdout), put_values(options[j].name, options[j].shown, "", " ");
        puts("'");
        for (size_t i = 0; i < command_count && by_command(&options[j]); i++) {
            if (!takes(&commands[i], &options[j])) continue;
            printf("complete -c nhsym -n '__fish_seen_subcommand_from %s' -l %s -x -a '", commands[i].name,
                   options[j].name);
            put_values(options[j].name, options[j].shown, commands[i].name, " ");
            puts("'");
        }
    }
    for (const char *const *name = (const char *const[]){"explain", "help", NULL}; *name; name++) {
        printf("complete -c nhsym -n '__fish_seen_subcommand_from %s' -a '", *name);
        put_values(*name, "", *name, " ");
        puts("'");
    }
    for (size_t i = 0; i < named_count; i++)
        printf("complete -c nhsym -n '__fish_seen_subcommand_from %s' -l %s -x -a '(__nhsym_names %s \"%s\")'\n",
               *named[i].commands ? named[i].commands : "analyze verify simulate benchmark reduce classify scan export",
               named[i].option, named[i].of, named[i].behind);
    puts("complete -c nhsym -n '__fish_seen_subcommand_from analyze verify simulate benchmark reduce classify export "
         "scan show' -a '(nhsym list 2>/dev/null | string split -f1 \" \")'\n"
         "complete -c nhsym -n '__fish_seen_subcommand_from analyze verify simulate benchmark reduce classify export "
         "scan' -k -a '(__fish_complete_suffix .yaml .urdf)'");
}

int nh_cli_help(nh_cli *cli, nh_error *error)
{
    static const struct {
        const char *name;
        void (*print)(void);
    } files[] = {{"man", manual_page}, {"bash", bash}, {"zsh", zsh}, {"fish", fish}};
    bool asked = cli->command && !strcmp(cli->command, "help");
    const char *about = asked ? (cli->operands ? nh_cli_command_name(cli->operand[0]) : NULL) : cli->command;
    if (!about) return all_commands(), NH_OK;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (!strcmp(about, files[i].name)) return files[i].print(), NH_OK;
    for (size_t i = 0; i < command_count; i++)
        if (!strcmp(about, commands[i].name)) return one_command(&commands[i]), NH_OK;
    nh_fail(error, NH_USAGE, "", "there is no command `%s`", about);
    const char *near = nh_cli_command_near(about);
    return near ? nh_error_hint(error, "did you mean `nhsym help %s`?", near)
                : nh_error_hint(error, "`nhsym help` lists the commands"),
           NH_USAGE;
}
