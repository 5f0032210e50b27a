/* files: reads each file once per run.
 *
 * What was read stays in memory while this is on, so that all parts of a run see one text, whatever becomes of the file
 * meanwhile, and so that a pipe can be read as often as it is needed. */
#ifndef NH_FILES_H
#define NH_FILES_H

#include <stdint.h>

#include "base/error.h"

/* From now on until the end; not for callers that want to see changes of files.  Not while threads read. */
void nh_files_begin(void);
void nh_files_end(void);

/* The files of several runs in turn: those that are kept in this context change places with a store's, which begins as
   NULL. */
typedef struct nh_known_file *nh_file_store;
void nh_files_swap(nh_file_store *store);
void nh_files_free(nh_file_store store);

/* A text under the name of a file, whether or not there is such a file. */
void nh_files_add(const char *path, const char *text, size_t length);

/* A number that tells the texts apart that are kept in this context, in the order in which they were read. */
uint64_t nh_files_fingerprint(void);

/* The bytes of a file, at most limit + 1 of them; nh_free.  NULL with a message. */
char *nh_files_read(const char *path, size_t limit, size_t *length, nh_error *error);

#endif
