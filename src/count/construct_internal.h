/* For the files of the construction. */
#ifndef NH_CONSTRUCT_INTERNAL_H
#define NH_CONSTRUCT_INTERNAL_H

#include "count/closed_words.h"
#include "count/construct.h"
#include "count/count_internal.h"
#include "count/velocity_frame.h"

enum { NH_CONSTRUCT_ROWS_TOGETHER = 4 }; /* products of residues that dense algebra does in the time of one */

/* One attempt: a point, the solutions as series there, and the values of words and solutions under random
   functionals. */
typedef struct {
    nh_counter *counter;
    nh_known_motions_words *words;
    const nh_velocity_frame *frame; /* solutions are recognised in it */
    nh_count_series *series;
    size_t parts;            /* parities */
    nh_graded_count *solution[2];
    nh_count_lines lines;    /* functionals: more than there are words and solutions */
    nh_prime field;
    /* columns: words, then for each parity its coefficients c_alpha of each solution, alpha by alpha */
    size_t width, first[2];
    nh_residue *value;       /* functionals x width; when words are chosen: those of the words' echelon form */
    /* words that are linearly independent, cheapest first: the first rows then say what is made of them, the others are
       remainders */
    size_t kept, *chosen;
} nh_construct_attempt;

/* The least order of series at which words can be recognised; 0: none is high enough. */
size_t nh_construct_order(const nh_construct_attempt *attempt, size_t degree);
/* Functions of some of the coordinates must be fewer than their coefficients, or any function would be one of them.
   `word`: which words; NULL: all. */
bool nh_construct_words_scarce(const nh_construct_attempt *attempt, size_t order, size_t words, const size_t *word);
/* The values of words and solutions.  False: another point is needed. */
bool nh_construct_values(nh_construct_attempt *attempt);
/* A basis of the words' span, and everything in terms of it. */
void nh_construct_words_choose(nh_construct_attempt *attempt);

#endif
