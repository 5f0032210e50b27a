/* system: the file that a command works on, with what the command line adds to it. */
#include <string.h>

#include "base/files.h"
#include "cli/cli.h"
#include "system/deck.h"
#include "system/system.h"

static const char words_of_line[] = ", command line"; /* how the name of a completed file ends */

bool nh_cli_one_system(const nh_cli *cli, const char *example, nh_error *error)
{
    if (cli->operands == 1) return true;
    if (!cli->operands) nh_fail(error, NH_USAGE, "", "`nhsym %s` needs a system", cli->command);
    else
        nh_fail(error, NH_USAGE, "", "`nhsym %s` takes one system, but a second one is given: `%s`", cli->command,
                cli->operand[1]);
    return nh_error_hint(error, "%s", example);
}

/* A word of YAML in double quotes. */
static void put_quoted(nh_text *out, const char *word)
{
    nh_text_add(out, "\"");
    for (const char *c = word; *c; c++) {
        if (*c == '"' || *c == '\\') nh_text_add(out, "\\");
        nh_text_add_n(out, *c == '\n' ? " " : c, 1);
    }
    nh_text_add(out, "\"");
}

/* What is added to the text next comes from typed[offset ..] behind an option. */
static void note(nh_cli *cli, const nh_text *out, const char *option, const char *typed, size_t offset)
{
    if (!(cli->pieces & (cli->pieces - 1))) { /* room for one more: it doubles whenever the count is a power of two */
        nh_cli_piece *more = nh_arena_alloc(cli->arena, (2 * cli->pieces + 1) * sizeof *more);
        if (cli->pieces) memcpy(more, cli->piece, cli->pieces * sizeof *more);
        cli->piece = more;
    }
    cli->piece[cli->pieces++] =
        (nh_cli_piece){.begin = out->length + 1, .offset = offset, .option = option, .typed = typed};
}

/* typed[begin .. end) as a word of the text. */
static void put_typed(nh_cli *cli, nh_text *out, const char *option, const char *typed, size_t begin, size_t end)
{
    while (begin < end && typed[begin] == ' ') begin++;
    while (begin < end && typed[end - 1] == ' ') end--;
    note(cli, out, option, typed, begin);
    put_quoted(out, nh_arena_strndup(cli->arena, typed + begin, end - begin));
}

/* "left" or "left=0.1". */
static void put_wheel(nh_cli *cli, nh_text *out, const char *typed)
{
    size_t length = strlen(typed), equal = strcspn(typed, "=");
    note(cli, out, "--wheel", typed, 0);
    if (equal < length) nh_text_add(out, "{body: ");
    put_typed(cli, out, "--wheel", typed, 0, equal);
    if (equal == length) return;
    nh_text_add(out, ", radius: ");
    put_typed(cli, out, "--wheel", typed, equal + 1, length);
    nh_text_add(out, "}");
}

/* The same file with wheels, a base and levels: a text of one line that includes it. */
static const char *completed(nh_cli *cli, const char *path)
{
    const char *slash = strrchr(path, '/');
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, "{include: ");
    put_quoted(&text, slash ? slash + 1 : path);
    for (size_t i = 0; i < cli->wheels; i++)
        nh_text_add(&text, i ? ", " : ", wheels: ["), put_wheel(cli, &text, cli->wheel[i]);
    if (cli->wheels) nh_text_add(&text, "]");
    if (cli->base) nh_text_add(&text, ", base: "), put_typed(cli, &text, "--base", cli->base, 0, strlen(cli->base));
    for (size_t i = 0; i < cli->ons; i++)
        nh_text_add(&text, i ? ", " : ", levels: ["), put_typed(cli, &text, "--on", cli->on[i], 0, strlen(cli->on[i]));
    nh_text_add(&text, cli->ons ? "]}\n" : "}\n");
    const char *name = nh_arena_printf(cli->arena, "%s%s", path, words_of_line);
    nh_files_add(name, nh_text_string(&text), text.length);
    cli->completed = nh_arena_strdup(cli->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return name;
}

void nh_cli_blame(const nh_cli *cli, nh_error *error)
{
    const char *place = cli->completed && error->code != NH_OK ? strstr(error->where, words_of_line) : NULL;
    size_t line = 0, column = 0, at = 0;
    if (!place || sscanf(place + strlen(words_of_line), ":%zu:%zu", &line, &column) != 2 || line != 1) return;
    /* columns count characters */
    for (size_t seen = 0; cli->completed[at] && (seen += ((unsigned char)cli->completed[at] & 0xC0) != 0x80) < column;)
        at++;
    const nh_cli_piece *piece = NULL;
    /* + 1: its quote counts, too */
    for (size_t i = 0; i < cli->pieces && cli->piece[i].begin <= at + 1; i++) piece = &cli->piece[i];
    if (!piece) return;
    nh_error own;
    nh_error_clear(&own);
    nh_deck_fail_typed(piece->option, piece->typed, piece->offset + (at > piece->begin ? at - piece->begin : 0), &own,
                       "%s", error->what);
    if (error->hint[0]) nh_error_hint(&own, "%s", error->hint);
    *error = own;
}

const char *nh_cli_system(nh_cli *cli, const char *word, nh_error *error)
{
    const char *path = nh_places_find(cli->arena, "systems", word, error);
    if (path && (cli->wheels || cli->base || cli->ons)) path = completed(cli, path);
    /* an analysis has warnings of its own */
    if (!path || cli->quiet || !strcmp(cli->command, "analyze") || !strcmp(cli->command, "show")) return path;
    nh_error ignored;
    nh_error_clear(&ignored);
    /* whoever reads it says what is wrong */
    nh_system *system = nh_system_read(path, cli->settings, cli->setting, &ignored);
    for (size_t i = 0; system && i < system->notes; i++) fprintf(stderr, "nhsym: %s\n", system->note[i]);
    nh_system_free(system);
    return path;
}
