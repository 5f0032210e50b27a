/* print: expressions as text that the parser reads back to the same expression. */
#ifndef NH_PRINT_H
#define NH_PRINT_H

#include "base/text.h"
#include "graph/expr.h"

/* Adds e in the expression language of system files.  Round trip: parsing the text gives e again (inexact constants to
 * the last bit).  The graph may gain nodes.  What is nested deeper than 1000 levels is written "...". */
void nh_print(nh_dag *dag, nh_ex e, nh_text *out);

/* The same as a heap string; the caller frees it by nh_free. */
char *nh_print_string(nh_dag *dag, nh_ex e);

/* The same, or NULL when e is longer than `most` by nh_complexity: a shared graph can be exponentially long on
   paper. */
char *nh_print_short(nh_dag *dag, nh_ex e, double most);

#endif
