/* For the files of the documents of a classification. */
#ifndef NH_REPORT_CLASSIFICATION_INTERNAL_H
#define NH_REPORT_CLASSIFICATION_INTERNAL_H

#include "base/json.h"
#include "document/classification.h"

/* A current as documents show it: in velocities where it can be. */
nh_ex nh_classification_formula(const nh_analysis *result, const nh_current *current);

/* ---- facts ---- */

/* Is the number for almost all values that of known integrals? */
bool nh_classification_is_exact(const nh_classify_row *row);
/* Is nothing open: are there, up to the height of the last degree, no other special values? */
bool nh_classification_is_closed(const nh_classified *classified);
/* Of two parameters: a line that was not classified up to the highest degree. */
bool nh_classification_is_unexamined(const nh_classified *classified, const nh_classify_wall *line);
/* "surface", "curve" or "point": the name of places of this dimension, and their number. */
const char *nh_classification_kind(const nh_classified *classified, size_t dimension, size_t *count);
/* How many values of one parameter may be special that are known modulo primes only. */
size_t nh_classification_unlifted(const nh_classified *classified);

/* ---- words ---- */

const char *nh_classification_where(const nh_classified *classified); /* "Special values" */
const char *nh_classification_side(const nh_classified *classified);  /* "for x > 0"; NULL: everywhere */
/* "have more conserved quantities than the others" without "have" */
const char *nh_classification_more(const nh_classified *classified);
/* "eps = 2" of one parameter, "eps - 2 = 0" of more; in the arena. */
const char *nh_classification_zeros(const nh_classified *classified, const nh_special_factor *polynomial);
/* What is classified, over which parameters, with which values of the others. */
void nh_classification_head(const nh_classified *classified, nh_text *out);
/* A line for one degree, for almost all values. */
void nh_classification_almost_all(const nh_classified *classified, size_t degree, nh_text *out);
/* "degree 2: 3 instead of 2, degree 3: up to 6 instead of 2."; the numbers account for integrals up to `exact`. */
void nh_classification_numbers(const nh_classified *classified, const nh_classified_place *place, nh_text *out);
/* Why it ended before the highest degree, perhaps in `room`; NULL where it did not. */
const char *nh_classification_end(const nh_classified *classified, char *room, size_t size);
/* Lines: what was not examined or not decided, and what is proved where there are not more integrals. */
void nh_classification_left(const nh_classified *classified, nh_text *out);
void nh_classification_excluded(const nh_classified *classified, nh_text *out);

/* ---- the first screen, and a picture of two or three parameters ---- */

void nh_classification_write_answer(const nh_classified *classified, bool colour, nh_text *out);
void nh_classification_picture(const nh_classified *classified, nh_pen *pen);

#endif
