/* absence_words_internal: what the files absence_words*.c share. */
#ifndef NH_ABSENCE_WORDS_INTERNAL_H
#define NH_ABSENCE_WORDS_INTERNAL_H

#include "document/absence_parts.h"
#include "document/absence_words.h"

typedef struct {
    const nh_analysis *r;
    const nh_absence *a;
    const nh_absence_attempt *best;
    bool brief;   /* for a first screen */
    bool unnamed; /* .. where the letters of the equations take too much room */
    nh_text *out;
} nh_absence_writer;

/* The text between the marks of a formula, in the arena. */
const char *nh_absence_words_formula(const nh_absence_writer *writer, const char *text);
/* "z, phi or t": the letters left out, and the time; `last` stands before the last one. */
void nh_absence_words_put_left_out(const nh_absence_writer *writer, const char *last, bool time);
/* "the equations of x, y, x', y'"; of many, on a first screen, "the equations of motion without z". */
void nh_absence_words_put_equations(const nh_absence_writer *writer);
/* "those found", "Phi1 and Phi3"; on a first screen "those above", "quantities 1 and 3": they have numbers there. */
void nh_absence_words_put_known(const nh_absence_writer *writer);
/* "meromorphic near the complex motions x = 0 of energy 1/7", "rational in x, y, x', y'" */
void nh_absence_words_put_class(const nh_absence_writer *writer);

#endif
