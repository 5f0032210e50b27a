/* catalogue: what there is to choose from: systems, words of the reports, options, methods, functions. */
#ifndef NH_LIBRARY_CATALOGUE_H
#define NH_LIBRARY_CATALOGUE_H

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"

/* A line for each system: its name and its title.  False: there is none. */
bool nh_catalogue_systems(nh_text *out);
/* Is there a system of this name? */
bool nh_catalogue_has(const char *name);
/* A system file as it is written; `whole`, and of a robot description: with all that is read from it. */
bool nh_catalogue_show(const char *path, bool whole, nh_text *out, nh_error *error);
/* "parameters, velocities": their names, one per line. */
bool nh_catalogue_names(const char *path, const char *of, nh_text *out, nh_error *error);
/* A system file to start from.  False: `name` is none. */
bool nh_catalogue_pattern(const char *name, nh_text *out);

/* What words of the reports mean, "options", "methods" or "functions"; none: all topics. */
bool nh_catalogue_explain(nh_arena *arena, size_t words, const char *const *word, nh_text *out, nh_error *error);
/* The words that the option takes in this command, or the command itself, with `between`; nothing where these are not a
   fixed list. */
void nh_catalogue_values(const char *option, const char *command, const char *between, nh_text *out);

#endif
