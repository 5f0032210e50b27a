/* completeness: have all integrals polynomial in the velocities been found?
 *
 * Two kinds are counted: those whose coefficients are functions of the coordinates, and those whose coefficients are
 * functions of time and the coordinates; for a system that depends on time only the latter.  Products of the proved
 * currents are compared with the upper bound, degree by degree (count/count.h). */
#ifndef NH_COMPLETENESS_H
#define NH_COMPLETENESS_H

#include "base/text.h"
#include "count/count.h"

enum { NH_COMPLETE_IN_COORDINATES, NH_COMPLETE_IN_TIME, NH_COMPLETENESS_KINDS };

typedef struct {
    bool counted;   /* this kind was counted */
    nh_count count; /* count for the parameters' values */
    size_t asked;   /* the degree that the user chose, or 0 */
    size_t degree;  /* complete up to this degree; 0: not even for the first */
    /* true: it is proved that all integrals up to this degree are polynomials in the known ones; false: a rank at one
     * point shows that they are functions of them */
    bool linear;
    /* the currents that are constant in a region only are needed for this */
    bool regional, only_regional;
    /* there can be no other functionally independent integrals: all are functions of the known ones */
    bool all;
    bool generic;      /* completeness also for algebraically independent parameters, as far as it was asked */
    size_t missing_at; /* the lowest degree at which the bound is not reached, or 0 */
    size_t missing;    /* at most so many functionally independent integrals are missing there */
    /* the lowest degree at which the known integrals and their products are fewer than the bound, or 0 */
    size_t incomplete_at;
    /* that bound did not change over the last orders: more work would hardly lower it */
    bool settled;
} nh_completeness;

/* The known currents: all hold for the parameters' values, those of `general` for all values. */
typedef struct {
    size_t known;
    const nh_ex *current;
    size_t independent; /* how many of these */
    size_t regional;    /* the last so many are constant in a region only, and independent */
    bool general;       /* their number without those of a region; all of them hold for all parameters */
    bool regional_general;
    bool all;             /* it is known that there are no more functionally independent ones */
    size_t until_missing; /* no degrees beyond the first one, from this one on, that misses functions; 0: all */
    unsigned kinds;       /* bit k: of kind k; 0: all.  The others are left as they are */
    size_t degree;        /* highest degree; 0: chosen here */
    double work;
    size_t threads;          /* 0: one */
    nh_count_memory *memory; /* keeps counts for the next call; NULL: nothing is kept */
} nh_completeness_question;

/* The degree up to which a kind is counted by default. */
size_t nh_completeness_degree(const nh_model *model, bool time);

/* Counts every kind, for the parameters' values.  A kind that cannot be counted, or whose work does not suffice, says
 * so in its entry; there is no other error.  [docs/method.md, sec. 10] */
void nh_completeness_of(const nh_model *model, const nh_completeness_question *question,
                        nh_completeness out[NH_COMPLETENESS_KINDS]);

/* Sets `generic` of every kind, for the question that was counted. */
void nh_completeness_generic(const nh_model *model, const nh_completeness_question *question,
                             nh_completeness completeness[NH_COMPLETENESS_KINDS]);

/* Writes what is proved, in sentences; nothing when nothing was counted.  `uncertain`: the number of currents that are
 * certified numerically and not proved. */
void nh_completeness_words(const nh_completeness completeness[NH_COMPLETENESS_KINDS], size_t uncertain, nh_text *out);

#endif
