/* new: a system file to start from. */
#include <fcntl.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "cli/cli.h"
#include "library/catalogue.h"

int nh_cli_new(nh_cli *cli, nh_error *error)
{
    const char *name = cli->operands == 1 ? cli->operand[0] : NULL;
    nh_text text;
    nh_text_init(&text);
    if (!name || !nh_catalogue_pattern(name, &text)) {
        if (!name) nh_fail(error, NH_USAGE, "", "`nhsym new` takes one name");
        else nh_fail(error, NH_USAGE, "", "`%s` is not a name: a name is a letter, then letters, digits and _", name);
        size_t length = name ? strlen(name) : 0, ending = strlen(".yaml");
        bool file = length > ending && !strcmp(name + length - ending, ".yaml");
        const char *shown = file ? nh_arena_strndup(cli->arena, name, length - ending) : "skate";
        nh_error_hint(error, "`nhsym new %s` writes %s.yaml", shown, shown);
        return NH_USAGE;
    }
    const char *path = nh_arena_printf(cli->arena, "%s.yaml", name);
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
        unlink(path);
        return NH_NUMERIC;
    }
    if (!cli->quiet) printf("wrote %s; `nhsym analyze %s` analyses it\n", path, path);
    return NH_OK;
}
