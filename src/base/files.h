/* files: reads each file once per run.
 *
 * Between nh_files_begin and nh_files_end every text that was read stays in memory: all parts of a run see the same
 * text, even when the file changes meanwhile, and a pipe can be read several times. */
#ifndef NH_FILES_H
#define NH_FILES_H

#include <stdint.h>

#include "base/error.h"

/* Texts are kept from nh_files_begin to nh_files_end.  Not for callers that want to see changes of files; not while
 * threads read. */
void nh_files_begin(void);
void nh_files_end(void);

/* Exchanges the texts kept in this context with those in *store, which begins as NULL: so several runs each keep their
 * own files. */
typedef struct nh_known_file *nh_file_store;
void nh_files_swap(nh_file_store *store);
void nh_files_free(nh_file_store store);

/* Keeps a text under the name of a file, whether or not there is such a file. */
void nh_files_add(const char *path, const char *text, size_t length);

/* A number that identifies the texts kept in this context, in the order in which they were read. */
uint64_t nh_files_fingerprint(void);

/* The bytes of a file, at most limit + 1 of them; the caller frees them by nh_free.  NULL with a message. */
char *nh_files_read(const char *path, size_t limit, size_t *length, nh_error *error);

/* The text of a file that this program itself wrote: a regular file, not longer than a hundred megabytes, and no link
 * to another place.  NULL where there is none, and with a message where something else has its name. */
char *nh_files_own(const char *path, nh_error *error);
/* Has nothing but a regular file this name?  Otherwise a message. */
bool nh_files_regular(const char *path, nh_error *error);

#endif
