/* deck_build: trees that the program makes itself, from other formats or to complete what a file says.  Private to readers of files. */
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
/* An entry of a map whose key was not there; an item of a list. */
void nh_deck_put(nh_deck *deck, nh_deck_node *map, const char *key, const nh_deck_node *value);
void nh_deck_append(nh_deck *deck, nh_deck_node *list, const nh_deck_node *item);
/* A copy of a list or map that may be changed; of a map, without an entry of this name (NULL: with all). */
nh_deck_node *nh_deck_copy(nh_deck *deck, const nh_deck_node *node, const char *without);

/* The tree as YAML, one line for each item of the lists of the root. */
void nh_deck_print(const nh_deck_node *root, nh_text *out);

#endif
