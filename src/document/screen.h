/* screen: text of 80 columns, and first screens of answers on a terminal. */
#ifndef NH_SCREEN_H
#define NH_SCREEN_H

#include "base/text.h"
#include "document/form.h"
#include "graph/expr.h"
#include "system/system.h"

enum { NH_SCREEN_LINES = 40, NH_SCREEN_HANG = 4 };

/* Words, and a formula, as lines of at most 80 columns; `hang`: the indentation of all lines but the first. */
void nh_screen_paragraph(size_t indent, size_t hang, const char *words, nh_text *out);
void nh_screen_broken(size_t indent, size_t hang, const char *formula, nh_text *out);
/* Any text, with lines of at most 80 columns, broken at blanks. */
void nh_screen_fold(const char *text, nh_text *out);

/* Is a text for a terminal wanted, without --details?  Then the answer is its first screen. */
bool nh_screen_is_wanted(nh_pen_style style);
/* The title, the answer, and the values of the parameters but those in `open` (at most three, then NULL; NULL: none is
 * open): "Pendulum   m = 1, l = 1" where they fit into the first line, otherwise below the answer; where many begin
 * alike "g = 9.81, mass: hand 1, elbow 2, shoulder 2".  Clears the answer. */
void nh_screen_begin(nh_text *out, bool colour, const nh_system *system, const char *const open[3], nh_text *answer);
/* The words as a paragraph of 80 columns, without blanks at their end; clears them. */
void nh_screen_say(nh_text *out, size_t indent, nh_text *words);
/* Lines of formulas, in the colour of formulas. */
void nh_screen_formula(nh_text *out, bool colour, const char *lines);
/* "  label = e", broken where it is long.  False, and nothing, where it is longer than a screen. */
bool nh_screen_equation(const char *label, nh_dag *dag, nh_ex e, nh_text *out);
/* The head, as "E = ", and the formula; where it is NULL or has more lines than `most`, `instead`, or if that is NULL
 * words that say so.  Was the formula written? */
bool nh_screen_put(nh_text *out, bool colour, size_t indent, const char *head, const char *formula, size_t most,
                   const char *instead);
size_t nh_screen_count(const char *text); /* lines */
/* Appends the block if it and `tail` more lines fit on the screen; clears it.  Was it appended? */
bool nh_screen_fit(nh_text *out, nh_text *block, size_t tail);
/* The last lines: what --details shows, and another line or NULL. */
void nh_screen_more(nh_text *out, const char *details, const char *other);

#endif
