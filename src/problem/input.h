/* input: values over time that act on a system, as an expression. */
#ifndef NH_INPUT_H
#define NH_INPUT_H

#include "base/error.h"
#include "base/memory.h"

/* `text` is an expression, which is returned as it is, or FILE.csv:COLUMN: then the expression is the broken line
 * through the values of that column over the column t of the file, constant before and after.  In the arena; NULL with
 * a message. */
const char *nh_input_text(nh_arena *arena, const char *name, const char *text, nh_error *error);

#endif
