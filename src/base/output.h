/* output: files that are either written completely or left unchanged. */
#ifndef NH_OUTPUT_H
#define NH_OUTPUT_H

#include "base/error.h"
#include "base/leave.h"

/* Write to a temporary file beside `path`, flush it to the disk, then rename.  On any failure an old file stays. */
bool nh_output_write(const char *path, const char *text, size_t length, nh_error *error);

/* Files that belong together: all are on the disk, beside their places, before the first is renamed, so that a full
   disk leaves all old ones. */
enum { NH_OUTPUT_LONGEST = 4200 };
typedef struct nh_output_file {
    nh_leaving leaving; /* first: the temporary file does not stay behind */
    struct nh_output_file *next;
    char path[NH_OUTPUT_LONGEST], temporary[NH_OUTPUT_LONGEST];
} nh_output_file;
typedef struct {
    nh_output_file *first, *dropped;
} nh_output_set;
bool nh_output_add(nh_output_set *set, const char *path, const char *text, size_t length, nh_error *error);
/* An old file that the new ones make wrong: it is removed after they have taken their places. */
void nh_output_drop(nh_output_set *set, const char *path);
/* With `keep` the new files take the places of the old ones; else they are removed.  False when it did not, or one
   could not. */
bool nh_output_end(nh_output_set *set, bool keep, nh_error *error);

/* Could `path` be written, so far as this can be known before there is anything to write? */
bool nh_output_possible(const char *path, nh_error *error);

#endif
