/* name: names of the language and their spellings. */
#ifndef NH_NAME_H
#define NH_NAME_H

#include <stdint.h>

#include "base/error.h"
#include "base/text.h"
#include "graph/function.h"

/* A character that names cannot have stands in them by its number, as uni53F0 (so fonts name it): writes it, and reads
 * it: the length of such a word at `at`, or 0. */
void nh_name_add_code(nh_text *out, uint32_t code);
size_t nh_name_code(const char *at, uint32_t *code);
/* Is the text a name of the language: a letter or _, then letters, digits and _? */
bool nh_is_name(const char *text);
/* The ASCII text for the Greek letter or subscript digit at this place ("phi", "1"), and its length in bytes there;
 * NULL: there is none. */
const char *nh_name_of_letter(const char *at, size_t *length);
/* The name at the beginning of the text as letters, digits and _ in `out` (room > 1 bytes, cut where it is longer):
 * theta for the Greek letter and for \theta, theta_1 for theta_{1}.  Returns how many bytes of the text it takes, 0:
 * there is none. */
size_t nh_name_spelled(const char *text, char *out, size_t room);
/* The ASCII text for a typographic sign, as word processors and books use them, at this place; NULL: there is none. */
const char *nh_name_of_sign(const char *at);
/* Adds to the fault what a name is made of, and a name similar to the text.  Returns false. */
bool nh_name_hint(nh_error *error, const char *text);
/* The function of this name (not pi and sqrt); and is the name taken by a function, `pi` or `t`? */
bool nh_name_is_function(const char *name, nh_function *out);
bool nh_is_reserved(const char *name);

#endif
