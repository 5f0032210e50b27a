/* cli_table: which option belongs to which command. */
#include <string.h>

#include "cli/cli_table.h"

bool nh_word_among(const char *words, const char *word)
{
    size_t n = strlen(word);
    for (const char *at = words; n && (at = strstr(at, word)); at += n)
        if ((at == words || at[-1] == ' ') && (!at[n] || at[n] == ' ')) return true;
    return false;
}
