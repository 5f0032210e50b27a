/* output: files that are either written completely or left unchanged. */
#ifndef NH_OUTPUT_H
#define NH_OUTPUT_H

#include <stdint.h>

#include "base/error.h"
#include "base/leave.h"

/* Writes to a temporary file beside `path`, flushes it to the disk, then renames it.  After any failure an old file is
 * unchanged. */
bool nh_output_write(const char *path, const char *text, size_t length, nh_error *error);

/* Files that belong together: all are on the disk, beside their places, before the first takes its place, so that a
 * full disk leaves all old ones; and when one cannot take its place, those before it give theirs back. */
enum { NH_OUTPUT_LONGEST = 4200, NH_OUTPUT_FOLDERS = 16 };
typedef struct nh_output_file {
    nh_leaving leaving; /* first member: the temporary file is removed when the process ends early */
    struct nh_output_file *next;
    char path[NH_OUTPUT_LONGEST], temporary[NH_OUTPUT_LONGEST];
    bool kept, placed; /* the old file has another name; the new one has its own */
} nh_output_file;
typedef struct {
    int file;
    uintmax_t device, inode;
} nh_output_folder;
typedef struct {
    nh_output_file *first, *dropped;
    nh_output_folder folder[NH_OUTPUT_FOLDERS]; /* locked ones */
    size_t folders;
} nh_output_set;
/* Writes the text to a temporary file in the folder of `path`, and adds that to the set, which begins as {0}.  False
 * when it could not be written; the set stays valid, and nh_output_end is called in any case. */
bool nh_output_add(nh_output_set *set, const char *path, const char *text, size_t length, nh_error *error);
/* Waits until no other process puts files into the same folders; nh_output_end does this, too.  False: for too long. */
bool nh_output_lock(nh_output_set *set, nh_error *error);
/* An old file that the new ones make wrong: it is removed after they have taken their places. */
void nh_output_drop(nh_output_set *set, const char *path);
/* With `keep` the new files take the places of the old ones; otherwise they are removed.  False when the new files did
 * not take their places, or when a file could not be removed. */
bool nh_output_end(nh_output_set *set, bool keep, nh_error *error);

/* Removes a file, and tries twice, because an error of the disk may pass.  Returns 0, or the errno. */
int nh_output_remove(const char *path);

/* Can `path` be written, so far as this can be known before there is anything to write? */
bool nh_output_possible(const char *path, nh_error *error);

#endif
