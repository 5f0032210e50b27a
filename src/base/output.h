/* output: files that are either written whole or left as they were. */
#ifndef NH_OUTPUT_H
#define NH_OUTPUT_H

#include "base/error.h"

/* Write to a temporary file beside `path`, flush it to the disk, then rename.  On any failure an old file stays. */
bool nh_output_write(const char *path, const char *text, size_t length, nh_error *error);

#endif
