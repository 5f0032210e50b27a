/* For the files of the documents of a classification. */
#ifndef NH_REPORT_CLASSIFICATION_INTERNAL_H
#define NH_REPORT_CLASSIFICATION_INTERNAL_H

#include "base/json.h"
#include "document/classification.h"

/* A current as documents show it: in velocities where it can be. */
nh_ex nh_classification_formula(const nh_analysis *result, const nh_current *current);

/* ---- words ---- */

const char *nh_classification_end(const char *end, char *room, size_t size);
extern const char *const nh_classification_decide; /* options that may decide an open number */

/* classification.c: "integrals polynomial in the velocities", "More for", "more conservation laws than almost
 * all", "degree 2"; a number; for brackets the rank instead of the codimension. */
const char *nh_classification_subject(const nh_classified *classified);
const char *nh_classification_where(const nh_classified *classified);
const char *nh_classification_side(const nh_classified *classified); /* "for x > 0"; NULL: everywhere */
const char *nh_classification_more(const nh_classified *classified);
void nh_classification_level(const nh_classified *classified, size_t level, nh_text *out);
void nh_classification_amount(const nh_classified *classified, size_t bound, nh_text *out);
void nh_classification_beyond(const nh_classified *classified, size_t bound, nh_text *out); /* "more than 3" */

/* What is classified, over which parameters, with which values of the others. */
void nh_classification_head(const nh_classified *classified, nh_text *out);
/* A line for one degree. */
void nh_classification_almost_all(const nh_classified *classified, size_t degree, const nh_classify_number *number,
                                  size_t known, nh_text *out);
/* "degree 2: 3 instead of 2" */
void nh_classification_counted(const nh_classified *classified, size_t degree, bool first,
                               const nh_classify_number *number, size_t almost_all, bool complete, nh_text *out);

/* What was not examined or not decided, and what is proved where there are not more integrals. */
void nh_classification_left(const nh_classified *classified, nh_text *out);
void nh_classification_excluded(const nh_classified *classified, nh_text *out);
/* How many values may be special that are known modulo primes only. */
size_t nh_classification_unlifted(const nh_classified *classified);
/* Curves or surfaces that are degenerate or undecided. */
void nh_classification_open_words(const nh_classified *family, size_t count, const nh_plane_curve *curve, nh_text *out);
void nh_classification_plane_left(const nh_classified_plane *classified, nh_text *out);
void nh_classification_plane_excluded(const nh_classified_plane *classified, nh_text *out);
/* "B = 1, eps = 1/3   (on B - 1 = 0)"; in the family's arena. */
const char *nh_classification_place(const nh_classified_plane *classified, const nh_classified_point *point);
const char *nh_classification_space_place(const nh_classified_space *classified,
                                          const nh_classified_space_point *point);

/* classification_answer.c: the first screen; one of the three is not NULL. */
void nh_classification_write_answer(const nh_classified *line, const nh_classified_plane *plane,
                                    const nh_classified_space *space, bool colour, nh_text *out);

/* ---- outlines: classification_outline.c ---- */

/* Writes every line of the text as words; the text is cleared. */
void nh_classification_write_lines(nh_pen *pen, nh_text *text);
/* The currents with these indices; `index` NULL: all, also functions of others that are polynomial in
 * the velocities: the numbers by degree count them. */
void nh_classification_write_currents(nh_pen *pen, const nh_analysis *result, size_t count, const size_t *index);
/* Numbers by degree, from the first degree at which the number differs from that for almost all values. */
void nh_classification_write_numbers(const nh_classified *classified, nh_pen *pen, size_t rows,
                                     const nh_classify_number *number, size_t first, size_t complete,
                                     const size_t *almost_all);
void nh_classification_write_no_currents(const nh_classified *classified, nh_pen *pen, const char *why);
void nh_classification_write_value(const nh_classified *classified, nh_pen *pen, const nh_classified_value *at,
                                   size_t first);
void nh_classification_write_almost_all(const nh_classified *classified, nh_pen *pen, nh_text *degrees);
extern const char nh_classification_fewer[];

/* classification_space.c: "1 surface, 2 curves and no points with more ..", and the sections of a document. */
void nh_classification_space_answer(const nh_classified_space *space, nh_pen *pen);
void nh_classification_outline_space(const nh_classified_space *space, nh_pen *pen);
/* Planes of the last two parameters at values of the first one. */
void nh_classification_slices(const nh_classified_space *space, nh_pen *pen);

/* The plane of both parameters: curves and points by the number of integrals of the highest degree. */
void nh_classification_picture(const nh_classified_plane *plane, nh_pen *pen);

/* ---- JSON ---- */

/* The currents proved at a value or for almost all; "current" is null when it is longer than the option `written`. */
void nh_classification_put_currents(const nh_analysis *result, size_t count, const size_t *index, nh_json *to);

/* ---- JSON of two and three parameters ---- */

/* All members before the special values. */
nh_json *nh_classification_begin(const nh_classified *family, const char *obstacle, const char *end, size_t rows,
                                 const nh_plane_row *row);
/* What is proved for the classification with one parameter less; NULL: nothing. */
void nh_classification_put_along(const nh_classified *along, nh_json *to);
/* One degree; `height` may be NAN. */
nh_json *nh_classification_add_degree(nh_json *list, size_t degree, const nh_plane_row *row, double height);
/* The numbers on a curve or surface, or at a point. */
void nh_classification_put_found(nh_json *item, size_t rows, size_t first, const nh_classify_number *number,
                                 bool proved, const char *why);
/* Curves or surfaces that are degenerate or undecided: the list of the latter, to which more may be added. */
nh_json *nh_classification_put_open(const nh_classified *family, nh_json *root, size_t count,
                                    const nh_plane_curve *curve);

#endif
