/* list_commands: the commands that need no computation. */
#include <string.h>

#include "system/deck_build.h"
#include "base/escape.h"
#include "base/files.h"
#include "cli/cli.h"
#include "document/wording.h"

int nh_cli_version(nh_cli *cli, nh_error *error)
{
    (void)cli;
    (void)error;
    puts("nhsym " NH_VERSION);
    return NH_OK;
}

int nh_cli_list(nh_cli *cli, nh_error *error)
{
    if (cli->operands) {
        nh_fail(error, NH_USAGE, "", "`nhsym list` takes no name, found `%s`", cli->operand[0]);
        return nh_error_hint(error, "`nhsym list | grep %s` shows the systems with this word in their name or title",
                             cli->operand[0]),
               NH_USAGE;
    }
    const char **names;
    size_t count = nh_places_names(cli->arena, "systems", &names);
    for (size_t i = 0; i < count; i++) {
        const char *path = nh_places_look(cli->arena, "systems", names[i]);
        nh_error trouble;
        nh_error_clear(&trouble);
        nh_system *s = path ? nh_system_read(path, 0, NULL, &trouble) : NULL;
        printf("%-24s %s\n", names[i], s ? s->title : trouble.what);
        nh_system_free(s);
    }
    if (count) return NH_OK;
    nh_fail(error, NH_INPUT, "", "there are no systems in ./systems, in NHSYM_PATH or installed");
    nh_error_hint(error, "run nhsym where a folder `systems` is, or set NHSYM_PATH");
    return NH_INPUT;
}

/* A robot description, or what the command line completes, as the system file that it stands for. */
static int show_whole(const char *path, nh_error *error)
{
    nh_deck *deck = nh_system_deck(path, error);
    if (!deck) return error->code;
    nh_text text, safe;
    nh_text_init(&text);
    nh_text_init(&safe);
    nh_deck_print(nh_deck_root(deck), &text);
    nh_escape_terminal(nh_text_string(&text), &safe);
    fputs(nh_text_string(&safe), stdout);
    nh_text_clear(&safe);
    nh_text_clear(&text);
    nh_deck_free(deck);
    return NH_OK;
}

/* "parameters, velocities": their names, one per line, for programs such as the completions of a shell. */
static int show_names(const nh_cli *cli, const char *path, nh_error *error)
{
    static const char *const words[] = {"parameters", "coordinates", "velocities"};
    bool wanted[3] = {false};
    for (const char *at = cli->of; *at; at += at[strcspn(at, ",")] != 0) {
        at += strspn(at, " ");
        size_t length = strcspn(at, ", "), k = 0;
        while (k < 3 && (strlen(words[k]) != length || strncmp(words[k], at, length))) k++;
        if (k < 3) wanted[k] = true;
        else
            nh_fail(error, NH_USAGE, "", "--of does not know `%.*s`", (int)length, at),
                nh_error_hint(error, "`nhsym show` takes parameters, coordinates and velocities");
        at += strcspn(at, ",");
    }
    nh_system *s = error->code == NH_OK ? nh_system_read(path, 0, NULL, error) : NULL;
    if (!s) return error->code;
    for (size_t i = 0; wanted[0] && i < s->parameters; i++) puts(s->parameter[i].name);
    for (size_t i = 0; wanted[1] && i < s->coordinates; i++) puts(s->coordinate[i].name);
    for (size_t i = 0; wanted[2] && i < s->coordinates; i++) puts(nh_name_of(s->dag, s->coordinate[i].v));
    for (size_t i = 0; wanted[2] && i < s->quasi; i++) puts(nh_name_of(s->dag, s->quasi_velocity[i]));
    nh_system_free(s);
    return NH_OK;
}

int nh_cli_show(nh_cli *cli, nh_error *error)
{
    if (cli->operands != 1) {
        nh_fail(error, NH_USAGE, "", "`nhsym show` needs the name of a system");
        nh_error_hint(error, "nhsym show sleigh");
        return NH_USAGE;
    }
    const char *path = nh_cli_system(cli, cli->operand[0], error);
    if (!path) return error->code;
    if (cli->of) return show_names(cli, path, error);
    if (cli->wheels || cli->base) return show_whole(path, error);
    size_t length;
    char *text = nh_files_read(path, NH_DECK_SIZE_LIMIT, &length, error);
    if (!text) return error->code;
    if (length > NH_DECK_SIZE_LIMIT)
        nh_fail(error, NH_INPUT, path, "the file is larger than %d MiB", NH_DECK_SIZE_LIMIT >> 20);
    size_t blank = strspn(text, " \t\r\n");
    if (error->code == NH_OK && text[blank] == '<') return nh_free(text), show_whole(path, error);
    nh_text shown;
    nh_text_init(&shown);
    nh_text_add_n(&shown, text, length);
    nh_text safe;
    nh_text_init(&safe);
    nh_escape_terminal(nh_text_string(&shown), &safe);
    if (error->code == NH_OK) fputs(nh_text_string(&safe), stdout);
    nh_text_clear(&safe);
    nh_text_clear(&shown);
    nh_free(text);
    return error->code;
}

static void explain_options(void)
{
    for (size_t i = 0; i < nh_option_count(); i++) {
        nh_option_row o = nh_option_at(i);
        printf("%-20s %-9g %-10s %s\n", o.name, o.value, o.unit, o.doc);
    }
}

static void explain_methods(void)
{
    printf("%-16s %s\n", NH_METHOD_AUTOMATIC, "rk8pd, or bdf where the equations are stiff");
    for (size_t i = 0; i < nh_method_count(); i++) printf("%-16s %s\n", nh_method_at(i)->word, nh_method_at(i)->about);
}

static void explain_functions(void)
{
    static const char row[] = "%-24s %s\n";
    puts(NH_ELEMENTARY_WORDS "atan2(y, x) sqrt abs, and functions without elementary form.\n"
                             "Of these the last argument may move, the others are numbers or parameters; f_prime is "
                             "the derivative, as in bessel_j_prime(n, x).\n");
    for (size_t i = 0; i < nh_glossary_functions(); i++) {
        nh_glossary_entry f = nh_glossary_function_at(i);
        printf(row, f.word, f.text);
    }
    puts("\nBoth arguments of elliptic_f and elliptic_einc may move.  Values are computed by Arb, right to the last "
         "digits of a double; where a function\n"
         "is not real, it has none.  Proofs use its differential equation, neighbouring orders and Wronski's "
         "determinant.");
}

/* The words behind `explain`, with a blank between them. */
static const char *words_of(nh_cli *cli)
{
    const char *out = cli->operands ? cli->operand[0] : NULL;
    for (size_t i = 1; i < cli->operands; i++) out = nh_arena_printf(cli->arena, "%s %s", out, cli->operand[i]);
    return out;
}

/* "stage" finds the stages of a reduction and of a search, "constraint" the constraint submanifold.  How many begin
   like this? */
static size_t explain_beginning(const char *word)
{
    size_t found = 0, length = strlen(word);
    for (size_t i = 0; i < nh_glossary_count(); i++) {
        nh_glossary_entry topic = nh_glossary_at(i);
        if (strncmp(topic.word, word, length) || topic.word[length] != ' ') continue;
        printf("%s: %s\n", topic.word, topic.text);
        found++;
    }
    return found;
}

int nh_cli_explain(nh_cli *cli, nh_error *error)
{
    static const char row[] = "%-22s %s\n";
    size_t count = nh_glossary_count();
    const char **names = nh_arena_alloc(cli->arena, (count + 3) * sizeof *names), *word = words_of(cli);
    for (size_t i = 0; i < count; i++) {
        nh_glossary_entry topic = nh_glossary_at(i);
        names[i] = topic.word;
        if (!word) printf(row, topic.word, topic.text);
        else if (!strcmp(word, topic.word)) return puts(topic.text), NH_OK;
    }
    if (!word)
        return printf(row, "options", "all numerical options (nhsym explain options)"),
               printf(row, "methods", "all integrators (nhsym explain methods)"),
               printf(row, "functions", "functions of formulas (nhsym explain functions)"), NH_OK;
    if (!strcmp(word, "options")) return explain_options(), NH_OK;
    if (!strcmp(word, "methods")) return explain_methods(), NH_OK;
    if (!strcmp(word, "functions")) return explain_functions(), NH_OK;
    if (explain_beginning(word)) return NH_OK;
    names[count] = "options";
    names[count + 1] = "methods";
    names[count + 2] = "functions";
    nh_fail(error, NH_USAGE, "", "there is no topic `%s`", word);
    const char *near = nh_text_nearest(word, names, count + 3);
    /* "canonical distribution" */
    for (size_t i = cli->operands; i-- && !near;) near = nh_text_nearest(cli->operand[i], names, count + 3);
    if (near) nh_error_hint(error, "did you mean `%s`?", near);
    else nh_error_hint(error, "`nhsym explain` lists the topics");
    return NH_USAGE;
}
