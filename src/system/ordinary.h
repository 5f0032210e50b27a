/* ordinary: keys and short values of a system file as people write them, in the form that docs/formats.md describes:
 * `L:` for `lagrangian:`, `constraint:`, energies `T:` and `V:`, one value without a list, `m = 1` among parameters,
 * `theta(t)` among coordinates. */
#ifndef NH_ORDINARY_H
#define NH_ORDINARY_H

#include "system/deck.h"

/* Changes the root of a deck, also keys of earlier versions.  False: two spellings of one key. */
bool nh_ordinary_keys(nh_deck *deck, nh_error *error);
/* Refuses what is no key of a system file: with what is written instead. */
bool nh_ordinary_only_known(nh_deck *deck, nh_error *error);
/* Refuses a list of parameters in which `first` has no value, with the line to write.  Returns false. */
bool nh_ordinary_ask_values(nh_deck *deck, const nh_deck_node *list, const nh_deck_node *first, nh_error *error);
/* Adds to a fault about an unknown name the line that declares it and all others that are not known; `is_known` tells.
 * Returns false. */
typedef bool nh_ordinary_known(void *context, const char *name);
bool nh_ordinary_hint_declare(const nh_deck *deck, nh_ordinary_known *is_known, void *context, nh_error *error);
/* The lines that declare the coordinates, whose velocities stand in the file, and other names that are not known;
 * NULL: there are no velocities. */
const char *nh_ordinary_declare_all(nh_deck *deck, nh_ordinary_known *is_parameter, void *context);

#endif
