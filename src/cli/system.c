/* system: the file that a command works on, with what the command line adds to it. */
#include <string.h>

#include "base/files.h"
#include "cli/cli.h"
#include "system/system.h"

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

/* "left" or "left=0.1", several with commas. */
static void put_wheels(nh_text *out, const char *list, size_t *count)
{
    for (const char *at = list; *at;) {
        at += strspn(at, " ");
        size_t length = nh_text_entry(at, ",;"), equal = strcspn(at, "=,;"), end = equal;
        while (end && at[end - 1] == ' ') end--;
        char name[256], radius[256];
        snprintf(name, sizeof name, "%.*s", (int)end, at);
        snprintf(radius, sizeof radius, "%.*s", equal < length ? (int)(length - equal - 1) : 0, at + equal + 1);
        nh_text_add(out, *count ? ", " : "wheels: [");
        ++*count;
        if (equal < length) nh_text_add(out, "{body: ");
        put_quoted(out, name);
        if (equal < length) nh_text_add(out, ", radius: ");
        if (equal < length) put_quoted(out, radius + strspn(radius, " "));
        if (equal < length) nh_text_add(out, "}");
        at += length + (at[length] != 0);
    }
}

/* The same file with wheels, a base and levels: a text that includes it. */
static const char *completed(nh_cli *cli, const char *path)
{
    const char *slash = strrchr(path, '/');
    size_t count = 0;
    nh_text text;
    nh_text_init(&text);
    nh_text_add(&text, "include: ");
    put_quoted(&text, slash ? slash + 1 : path);
    nh_text_add(&text, "\n");
    for (size_t i = 0; i < cli->wheels; i++) put_wheels(&text, cli->wheel[i], &count);
    if (count) nh_text_add(&text, "]\n");
    if (cli->base) nh_text_add(&text, "base: "), put_quoted(&text, cli->base), nh_text_add(&text, "\n");
    const char *name = nh_arena_printf(cli->arena, "%s, command line", path);
    for (size_t i = 0; i < cli->ons; i++) nh_text_add(&text, i ? ", " : "levels: ["), put_quoted(&text, cli->on[i]);
    if (cli->ons) nh_text_add(&text, "]\n");
    nh_files_add(name, nh_text_string(&text), text.length);
    nh_text_clear(&text);
    return name;
}

const char *nh_cli_system(nh_cli *cli, const char *word, nh_error *error)
{
    const char *path = nh_places_find(cli->arena, "systems", word, error);
    if (path && (cli->wheels || cli->base || cli->ons)) path = completed(cli, path);
    if (!path || cli->quiet || !strcmp(cli->command, "analyze") || !strcmp(cli->command, "show")) return path; /* an analysis has warnings of its own */
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_system *system = nh_system_read(path, cli->settings, cli->setting, &ignored); /* whoever reads it says what is wrong */
    for (size_t i = 0; system && i < system->notes; i++) fprintf(stderr, "nhsym: %s\n", system->note[i]);
    nh_system_free(system);
    return path;
}
