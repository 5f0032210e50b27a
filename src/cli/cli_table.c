/* cli_table: which option belongs to which command, and old names. */
#include <string.h>

#include "base/text.h"
#include "cli/cli_table.h"

bool nh_word_among(const char *words, const char *word)
{
    size_t n = strlen(word);
    for (const char *at = words; n && (at = strstr(at, word)); at += n)
        if ((at == words || at[-1] == ' ') && (!at[n] || at[n] == ' ')) return true;
    return false;
}

const char *nh_cli_command_name(const char *word)
{
#define X(old, name)                                                                                                   \
    if (!strcmp(word, old)) return name;
    NH_CLI_OLD_COMMAND_TABLE(X)
#undef X
    return word;
}

const char *nh_cli_command_near(const char *word)
{
    static const char *const names[] = {
#define X(name, operand, meaning, example) #name,
        NH_CLI_COMMAND_TABLE(X)
#undef X
#define X(old, name) old,
            NH_CLI_OLD_COMMAND_TABLE(X)
#undef X
    };
    const char *near = nh_text_nearest(word, names, sizeof names / sizeof *names);
    return near ? nh_cli_command_name(near) : NULL;
}
