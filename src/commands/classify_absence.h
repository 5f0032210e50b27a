/* classify_absence: for which values of one parameter may there be another integral?
 *
 * From both sides.  The values that are tried are the fractions of a range with small denominators, those of a list,
 * and the special values that the search for integrals polynomial in the velocities finds (commands/classify.h).  At
 * each of them the system is analysed, with exactly this number in the parameter's place, and it is decided whether
 * there is any other integral (absence/absence.h).  Found: there are more integrals than at the value with the fewest.
 * Excluded, by a theorem: there are no others than that many.  Undecided: neither. */
#ifndef NH_CLASSIFY_ABSENCE_H
#define NH_CLASSIFY_ABSENCE_H

#include "absence/absence.h"
#include "commands/classify.h"

typedef enum { NH_CLASSIFIED_FOUND, NH_CLASSIFIED_EXCLUDED, NH_CLASSIFIED_UNDECIDED } nh_classified_side;

typedef struct {
    int64_t top, bottom;
    const char *text;    /* "3/2" */
    bool special;        /* the search for integrals polynomial in the velocities found it */
    nh_analysis *result; /* with its absence; NULL: there is none, for this reason */
    const char *why;     /* of an undecided one too */
    nh_classified_side side;
} nh_classified_value;

typedef struct {
    nh_arena *arena;
    nh_system *system;
    const char *over; /* the parameter */
    const char
        *range; /* "from 1/2 to 5, fractions with denominators up to 4", "in the list, and special values between" */
    size_t values, capacity;
    nh_classified_value *value; /* ascending */
    size_t fewest;              /* integrals that are found at the value with the fewest */
    bool generic;               /* excluded for all values outside countably many */
    const char *generic_at;     /* the value at which that is shown, or NULL */
    nh_classified *special;     /* the search for special values; NULL: it failed, for this reason */
    const char *no_special;
    nh_analysis *letter; /* with the parameter as a letter, or NULL */
    bool partial;        /* the run ended before */
} nh_classified_absence;

/* `range`: "mu", "mu=1/2:5", "mu=1/2:5:40" (at most so many values) or "mu=1,3/2,8/3".  The request's own names are not
 * read.  The caller frees the result.  NULL with a message on bad input. */
nh_classified_absence *nh_classify_absence(const nh_classify_request *request, const char *range, nh_error *error);
void nh_classified_absence_free(nh_classified_absence *classified);
/* As many as there are on a side. */
size_t nh_classified_absence_count(const nh_classified_absence *classified, nh_classified_side side);

#endif
