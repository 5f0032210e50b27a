/* screen: first screens of answers on a terminal. */
#ifndef NH_SCREEN_H
#define NH_SCREEN_H

#include "base/text.h"
#include "graph/dag.h"
#include "system/system.h"

enum { NH_SCREEN_LINES = 40, NH_SCREEN_HANG = 4 };

/* The title with the values of the parameters: "Pendulum   m = 1, l = 1". */
void nh_screen_title(const nh_system *system, bool colour, nh_text *out);
/* The words as a paragraph of 80 columns, without blanks at their end; clears them. */
void nh_screen_say(nh_text *out, size_t indent, nh_text *words);
/* Lines of formulas, in the colour of formulas. */
void nh_screen_formula(nh_text *out, bool colour, const char *lines);
/* "  label = e", broken where it is long. */
void nh_screen_equation(const char *label, nh_dag *dag, nh_ex e, nh_text *out);
size_t nh_screen_count(const char *text); /* lines */

#endif
