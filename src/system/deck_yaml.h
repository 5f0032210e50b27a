/* deck_yaml: errors of libyaml as messages for users.  Private to deck_read.c. */
#ifndef NH_DECK_YAML_H
#define NH_DECK_YAML_H

#include "system/deck_internal.h"

#define NH_DECK_QUOTE_HINT "put the expression in double quotes"

/* `problem` and `context` are libyaml's words (context may be NULL), `at` and `since` the bytes where they stand. */
bool nh_deck_explain(const nh_deck *deck, const char *problem, size_t at, const char *context, size_t since,
                     nh_error *error);

#endif
