/* deck_build: trees that the program makes itself, from other formats or to complete a file.  Private to readers of
 * files. */
#ifndef NH_DECK_BUILD_H
#define NH_DECK_BUILD_H

#include "base/text.h"
#include "system/deck_internal.h"

/* A node whose messages point at the bytes begin .. end of the source. */
nh_deck_node *nh_deck_new(nh_deck *deck, nh_deck_kind kind, size_t begin, size_t end);
/* A scalar; and one at the place of another node (NULL: at the beginning). */
nh_deck_node *nh_deck_word(nh_deck *deck, const char *text, size_t begin, size_t end);
nh_deck_node *nh_deck_word_at(nh_deck *deck, const char *text, const nh_deck_node *place);
nh_deck_node *nh_deck_new_at(nh_deck *deck, nh_deck_kind kind, const nh_deck_node *place);
/* Adds an entry to a map that does not have the key; adds an item to a list. */
void nh_deck_put(nh_deck *deck, nh_deck_node *map, const char *key, const nh_deck_node *value);
void nh_deck_append(nh_deck *deck, nh_deck_node *list, const nh_deck_node *item);
/* A copy of a list or map that may be changed; of a map, without an entry of this name (NULL: with all). */
nh_deck_node *nh_deck_copy(nh_deck *deck, const nh_deck_node *node, const char *without);

/* "phi=0, omega=2", also with semicolons or colons, as the map {phi: 0, omega: 2}; messages point into the text, by the
 * column alone, and their code is `code`. Entries without a name or a value and names that stand twice are refused:
 * NULL. */
nh_deck *nh_deck_line(const char *name, const char *text, nh_code code, nh_error *error);

/* The tree as YAML, one line for each item of the lists of the root. */
void nh_deck_print(const nh_deck_node *root, nh_text *out);

#endif
