/* places: the folders of systems and analyses. */
#ifndef NH_PLACES_H
#define NH_PLACES_H

#include "base/error.h"
#include "base/memory.h"

/* The file of a system or analysis, in the arena: a path, or a name looked up in ./systems, NHSYM_PATH and the
 * installed data. `kind` is "systems" or "analyses".  NULL with a suggestion. */
const char *nh_places_find(nh_arena *arena, const char *kind, const char *name, nh_error *error);
/* The same without a message. */
const char *nh_places_look(nh_arena *arena, const char *kind, const char *name);
/* Is this word the path of a file, and not a name? */
bool nh_places_is_path(const char *word);
/* All names of that kind, sorted, each once. */
size_t nh_places_names(nh_arena *arena, const char *kind, const char ***names);

#endif
