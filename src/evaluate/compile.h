/* compile: C text as functions of this process, by the system's own compiler, in the background.
 *
 * The compiler is `cc` on the PATH, or the program that NHSYM_CC names (empty: none).  It is started without a shell,
 * reads and writes in a private folder below TMPDIR or /tmp that is removed as soon as the code is loaded, and may fail
 * in any way: then there is no code, a reason as a message, and the caller continues without compiled code. */
#ifndef NH_COMPILE_H
#define NH_COMPILE_H

#include <stdbool.h>

typedef struct nh_compilation nh_compilation;

/* Starts the compiler; never NULL. */
nh_compilation *nh_compile(const char *text);
/* The address of `function` when the code is there; otherwise NULL, and *busy says whether it may still come.  `wait`:
 * waits until this is decided, at most a minute. */
void *nh_compile_result(nh_compilation *compilation, const char *function, bool wait, bool *busy);
/* How it went: "compiled by cc in 0.07 s", or why there is no code. */
const char *nh_compile_words(const nh_compilation *compilation);
/* Ends a compiler that still runs, and unloads the code. */
void nh_compile_free(nh_compilation *compilation);

#endif
