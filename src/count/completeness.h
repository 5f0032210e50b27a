/* completeness: are the currents that were found all that there are, among those polynomial in the velocities?
 *
 * Two kinds are counted: with functions of the coordinates as coefficients, and with functions of time and the
 * coordinates; of a system that depends on time only the latter.  Products of the currents that are proved are compared
 * with the bound, degree by degree (count/count.h). */
#ifndef NH_COMPLETENESS_H
#define NH_COMPLETENESS_H

#include "base/text.h"
#include "count/count.h"

enum { NH_COMPLETE_IN_COORDINATES, NH_COMPLETE_IN_TIME, NH_COMPLETENESS_KINDS };

typedef struct {
    bool counted;           /* this kind was looked at */
    nh_count count;         /* for the parameters' values */
    size_t asked;           /* the degree that the user chose, or 0 */
    size_t degree;          /* complete up to this degree; 0: not even to the first */
    /* up to there all are polynomials in the known ones, which is proved; otherwise functions of them, tested at a
       point */
    bool linear;
    /* of those, too, that are constant in a region only; there are no others */
    bool regional, only_regional;
    bool all;               /* functions of them in any case: there can be no more functionally independent ones */
    bool generic;           /* and so for algebraically independent parameters */
    size_t missing_at;      /* the least degree at which the bound is not reached, or 0 */
    size_t missing;         /* how many functionally independent ones are missing there at most */
    /* the least degree at which the known ones, their products included, are fewer than the bound, or 0 */
    size_t incomplete_at;
    /* that number did not change over the last orders: with more work it would hardly be lower */
    bool settled;
} nh_completeness;

/* The known currents hold for the parameters' values, those of `general` for all. */
typedef struct {
    size_t known;
    const nh_ex *current;
    size_t independent;     /* of these */
    size_t regional;        /* the last so many are constant in a region only, and independent */
    bool general;           /* all others hold for all parameters; all of these */
    bool regional_general;
    bool all;               /* there can be no more functionally independent ones */
    bool again;             /* only the kind that comes first, for the parameters' values: the rest is as it was */
    size_t degree;          /* 0: chosen */
    double work;
    nh_count_memory *memory; /* NULL: none */
} nh_completeness_question;

/* The degree up to which a kind is counted unless the user chooses another. */
size_t nh_completeness_degree(const nh_model *model, bool time);

/* Counts every kind.  A kind that cannot be counted, or whose work does not suffice, says so in its entry; there is no
 * other error.  [docs/method.md, sec. 10] */
void nh_completeness_of(const nh_model *model, const nh_completeness_question *question,
                        nh_completeness out[NH_COMPLETENESS_KINDS]);

/* What is proved, in sentences; nothing when nothing was counted.  `uncertain`: how many currents are certified
   numerically and not proved. */
void nh_completeness_words(const nh_completeness completeness[NH_COMPLETENESS_KINDS], size_t uncertain, nh_text *out);

#endif
