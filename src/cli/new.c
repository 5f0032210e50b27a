/* new: a system file to start from. */
#include <fcntl.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "base/output.h"
#include "cli/cli.h"
#include "library/catalogue.h"

/* The name of the system: the operand, else that of the file of -o, else that of the system to begin with. */
static const char *name_of(nh_cli *cli)
{
    const char *given = cli->folder ? cli->folder : cli->like, *slash = given ? strrchr(given, '/') : NULL;
    if (cli->operands == 1) return cli->operand[0];
    if (!given || cli->operands) return NULL;
    given = slash ? slash + 1 : given;
    const char *dot = strrchr(given, '.');
    return dot ? nh_arena_strndup(cli->arena, given, (size_t)(dot - given)) : given;
}

/* What the file begins with: a copy of the system of --like or of this name, else an example. */
static bool text_of(nh_cli *cli, const char *name, nh_text *text, nh_error *error)
{
    bool known = name && !cli->like && nh_catalogue_has(name);
    if (known) cli->like = name;
    if (name && cli->like) {
        nh_text example;
        nh_text_init(&example);
        bool named = nh_catalogue_pattern(name, &example);
        nh_text_clear(&example);
        if (named) return nh_catalogue_copy(cli->like, name, text, error);
    }
    if (name && nh_catalogue_pattern(name, text)) return true;
    if (!name) nh_fail(error, NH_USAGE, "", "`nhsym new` takes one name");
    else nh_fail(error, NH_USAGE, "", "`%s` is not a name: a name is a letter, then letters, digits and _", name);
    size_t length = name ? strlen(name) : 0, ending = strlen(".yaml");
    bool file = length > ending && !strcmp(name + length - ending, ".yaml");
    const char *shown = file ? nh_arena_strndup(cli->arena, name, length - ending) : "skate";
    return nh_error_hint(error, "`nhsym new %s` writes %s.yaml", shown, shown);
}

/* What was written, and systems of this name that it is not. */
static void tell(const nh_cli *cli, const char *name, const char *path)
{
    nh_text similar;
    nh_text_init(&similar);
    if (cli->like) printf("wrote %s after the system %s; `nhsym analyze %s` analyses it\n", path, cli->like, path);
    else printf("wrote %s; `nhsym analyze %s` analyses it\n", path, path);
    if (!cli->like && strcmp(name, "skate")) nh_catalogue_similar(name, &similar);
    if (similar.length)
        printf("it is a skate; systems of this name to begin with by --like: %s\n", nh_text_string(&similar));
    nh_text_clear(&similar);
}

int nh_cli_new(nh_cli *cli, nh_error *error)
{
    const char *name = name_of(cli);
    nh_text text;
    nh_text_init(&text);
    if (!text_of(cli, name, &text, error)) return nh_text_clear(&text), (int)error->code;
    const char *path = cli->folder ? cli->folder : nh_arena_printf(cli->arena, "%s.yaml", name);
    int file = open(path, O_WRONLY | O_CREAT | O_EXCL, 0666); /* never overwrites a file */
    FILE *stream = file < 0 ? NULL : fdopen(file, "w");
    if (!stream) {
        nh_text_clear(&text);
        bool there = errno == EEXIST;
        if (there) nh_fail(error, NH_INPUT, path, "this file exists already; it was not changed");
        else nh_fail(error, NH_INPUT, path, "this file could not be created: %s", strerror(errno));
        nh_error_hint(error, there ? "choose another name, or remove the file first"
                                   : "nhsym writes the file into the current folder; change to another folder");
        return NH_INPUT;
    }
    bool good = fputs(nh_text_string(&text), stream) >= 0;
    good &= fclose(stream) == 0;
    nh_text_clear(&text);
    if (!good) {
        nh_fail(error, NH_NUMERIC, path, "could not be written: %s", strerror(errno));
        nh_error_hint(error, "the incomplete file was removed; free some space, or use another folder");
        nh_output_remove(path);
        return NH_NUMERIC;
    }
    if (!cli->quiet) tell(cli, name, path);
    return NH_OK;
}
