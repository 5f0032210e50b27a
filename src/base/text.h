/* text: growing strings, numbers in their shortest form, and "did you mean". */
#ifndef NH_TEXT_H
#define NH_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct {
    char *data; /* always terminated once something was added; NULL before */
    size_t length, capacity;
} nh_text;

/* Strings are copied and allocated by base/memory.h, so that adding does not fail. nh_text_clear frees the text and
 * leaves it empty; nh_text_addf takes a format of printf. */
void nh_text_init(nh_text *text);
void nh_text_clear(nh_text *text);
void nh_text_add(nh_text *text, const char *string);
void nh_text_add_n(nh_text *text, const char *string, size_t length);
void nh_text_addf(nh_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));
const char *nh_text_string(const nh_text *text); /* "" when empty */
void nh_text_cut(nh_text *text, size_t length);  /* drops everything behind the first `length` bytes */

/* The shortest decimal that reads back as exactly `value`, into `out` (32 bytes are enough). */
void nh_text_number(double value, char *out, size_t size);

/* Is it [+-] digits [. digits] [e [+-] digits], with a digit before or after the point, and nothing else? */
bool nh_text_is_number(const char *text);
/* Its value.  False, with *out unchanged, when the text is no number or one that no double holds: too large, or so
 * small that it would become 0. */
bool nh_text_to_number(const char *text, double *out);
/* The two numbers of a ratio such as 5/2; of a single number `bottom` is 1.  False as above. */
bool nh_text_to_parts(const char *text, double *top, double *bottom);
/* The value of a ratio or a number.  False as above. */
bool nh_text_to_ratio(const char *text, double *out);

/* The candidate nearest to `word` (Damerau-Levenshtein, case ignored), or NULL when none is near enough to be
 * what was meant. */
const char *nh_text_nearest(const char *word, const char *const *candidates, size_t count);

/* A fingerprint of the bytes (FNV-1a) that continues `before`, the fingerprint of what stands before them; 0 at the
 * beginning. */
uint64_t nh_text_fingerprint(uint64_t before, const char *bytes, size_t length);

/* For lists on the command line: the length of the entry at `text`, which ends at a separator outside of parentheses,
 * or with the text. */
size_t nh_text_entry(const char *text, const char *separators);

/* Columns that `string` takes on a terminal (UTF-8 code points; no wide characters are used here). */
size_t nh_text_width(const char *string);

#endif
