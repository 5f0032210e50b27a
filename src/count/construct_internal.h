/* For the files of the construction. */
#ifndef NH_CONSTRUCT_INTERNAL_H
#define NH_CONSTRUCT_INTERNAL_H

#include "count/closed_words.h"
#include "count/construct.h"
#include "count/count_internal.h"
#include "count/velocity_frame.h"

enum { NH_CONSTRUCT_ROWS_TOGETHER = 4 }; /* products of residues that dense algebra does in the time of one */

/* One attempt: a point, the solutions there as series, and the values of words and solutions under random
 * functionals. */
typedef struct {
    nh_counter *counter;
    nh_closed_words *words;
    const nh_velocity_frame *frame;
    const nh_scalings *scalings; /* NULL: the words have no weights */
    nh_count_series *series;
    size_t parts; /* number of parities */
    nh_graded_count *solution[2];
    nh_count_lines lines; /* number of functionals: more than words and solutions together */
    nh_prime field;
    /* columns: words, then for each parity its coefficients c_alpha of each solution, alpha by alpha */
    size_t width, first[2];
    nh_residue *value; /* functionals x width; when words are chosen: those of the words' echelon form */
    /* words that are linearly independent, cheapest first; of the rows of `value` the first ones then give combinations
     * of these words, the others are remainders */
    size_t kept, *chosen;
} nh_construct_attempt;

/* The lowest order of series at which words can be recognised; 0: there is none. */
size_t nh_construct_order(const nh_construct_attempt *attempt, size_t degree);
/* There must be fewer functions of some of the coordinates than coefficients, or every function would be a combination
 * of them.  `word`: which words; NULL: all. */
bool nh_construct_words_scarce(const nh_construct_attempt *attempt, size_t order, size_t words, const size_t *word);
/* Gives words and solutions their columns.  Returns the work to choose a basis, if the words are independent. */
double nh_construct_columns(nh_construct_attempt *attempt);
/* Computes the values of words and solutions.  False: another point is needed. */
bool nh_construct_values(nh_construct_attempt *attempt);
/* Chooses a basis of the words' span, and rewrites all values in terms of it. */
void nh_construct_words_choose(nh_construct_attempt *attempt);

typedef enum { NH_CONSTRUCT_DONE, NH_CONSTRUCT_UNLUCKY, NH_CONSTRUCT_TOO_MUCH } nh_construct_outcome;

/* The known integrals as vectors: differentials at one point, or values of products under random functionals; and the
 * solutions of each parity likewise. */
typedef struct {
    nh_count_space known;
    nh_residue *solution[2]; /* N x known.width; NULL where there are none */
} nh_construct_news;

/* False: another point is needed.  Close it in any case. */
bool nh_construct_news_open(nh_construct_news *news, nh_construct_attempt *attempt,
                            const nh_construct_question *question);
void nh_construct_news_close(nh_construct_news *news);
/* Does this combination of solutions enlarge what is known?  Then it is known from now on. */
bool nh_construct_news_add(nh_construct_news *news, const nh_construct_attempt *attempt, size_t part,
                           const nh_residue *combination);
/* The number of combinations (rows x N) that are new; they are not kept. */
size_t nh_construct_news_count(nh_construct_news *news, const nh_construct_attempt *attempt, size_t part, size_t rows,
                               const nh_residue *combination);

/* Recognises the solutions of the attempt, whose series are those of out->order, in its words: adds the new ones. */
nh_construct_outcome nh_construct_recognise(nh_construction *out, nh_construct_attempt *attempt,
                                            const nh_construct_question *question);
/* Frees the series, the solutions and the values of an attempt. */
void nh_construct_attempt_clear(nh_construct_attempt *attempt);

/* The same for solutions with one weight under a scaling at a time, in words of the weights that these can have.  The
 * counter is at regular point number `point`. */
nh_construct_outcome nh_construct_by_weights(nh_construction *out, nh_counter *counter, nh_closed_words *words,
                                             const nh_velocity_frame *frame, const nh_scalings *scalings, size_t point,
                                             const nh_construct_question *question);

#endif
