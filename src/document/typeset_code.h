/* typeset_code: expressions as C. */
#ifndef NH_TYPESET_CODE_H
#define NH_TYPESET_CODE_H

#include "base/text.h"
#include "graph/dag.h"

/* A name of the expression language as a C identifier: x' becomes x_dot, keywords get an underscore. */
void nh_typeset_c_name(const char *name, nh_text *out);

/* Assignments `target[i] = e_i;` in C99 with <math.h>, indented by four blanks.  What occurs more than once is computed once, into constants t0, t1, ...,
 * numbered from *temporaries on, which is advanced. */
void nh_typeset_c(nh_dag *dag, size_t n, const nh_ex *e, const char *const *target, size_t *temporaries, nh_text *out);

#endif
