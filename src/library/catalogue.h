/* catalogue: lists to choose from: systems, words of the reports, options, methods, functions. */
#ifndef NH_LIBRARY_CATALOGUE_H
#define NH_LIBRARY_CATALOGUE_H

#include "base/error.h"
#include "base/memory.h"
#include "base/text.h"

/* A line for each system: its name and its title.  With a word, for those that have it in their name, title, source or
 * remarks, or in the kind of their constraints ("nonholonomic"), and where that is.  False with a message: none. */
bool nh_catalogue_systems(const char *word, nh_text *out, nh_error *error);
/* Is there a system of this name? */
bool nh_catalogue_has(const char *name);
/* A system file as it is written; `whole`, and for a robot description: with all that is read from other files, in the
 * form of a system file. */
bool nh_catalogue_show(const char *path, bool whole, nh_text *out, nh_error *error);
/* "parameters, velocities": their names, one per line. */
bool nh_catalogue_names(const char *path, const char *of, nh_text *out, nh_error *error);
/* A new system file to start from.  False: `name` cannot be a name. */
bool nh_catalogue_pattern(const char *name, nh_text *out);
/* A copy of a system, by its name or path, under a new name. */
bool nh_catalogue_copy(const char *like, const char *name, nh_text *out, nh_error *error);
/* The systems with this word in their name or title, "a, b, c"; "" when there are none. */
void nh_catalogue_similar(const char *word, nh_text *out);

/* Explains words of the reports, or lists "options", "methods" or "functions"; without words: all topics. */
bool nh_catalogue_explain(nh_arena *arena, size_t words, const char *const *word, nh_text *out, nh_error *error);
/* The words that the option accepts in this command, or the command itself, with `between`; nothing where these are not
 * a fixed list. */
void nh_catalogue_values(const char *option, const char *command, const char *between, nh_text *out);

#endif
