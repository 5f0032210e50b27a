/* cache: small texts that one run leaves for later ones, in $NHSYM_CACHE, $XDG_CACHE_HOME/nhsym or ~/.cache/nhsym.
 *
 * Nothing depends on them but speed: what is missing, unreadable or old is as if it had never been written, and the folder may be removed at any
 * time.  NHSYM_CACHE="" keeps and reads nothing.  Files are written whole or not at all. */
#ifndef NH_CACHE_H
#define NH_CACHE_H

#include "base/error.h"
#include "base/text.h"

/* Where the text `name` (its folders by "/") would be; false: nowhere, and `why` says so. */
bool nh_cache_path(const char *name, nh_text *path, const char **why);
/* The text (nh_free), or NULL. */
char *nh_cache_read(const char *name);
/* Folders are made where they are missing, for this user alone. */
bool nh_cache_write(const char *name, const char *text, nh_error *error);

#endif
