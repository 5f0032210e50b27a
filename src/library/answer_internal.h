/* answer_internal: the rows of the table of answers. */
#ifndef NH_LIBRARY_ANSWER_INTERNAL_H
#define NH_LIBRARY_ANSWER_INTERNAL_H

#include "commands/simulate.h"
#include "library/answer.h"

#define NH_ANSWER_TABLE(X)                                                                                             \
    X(analyze) X(verify) X(simulate) X(benchmark) X(reduce) X(classify) X(scan) X(export) X(linearize) X(show)
#define X(name) extern const nh_answer_kind nh_answer_##name;
NH_ANSWER_TABLE(X)
#undef X

/* One motion for the page of another command: from the given initial state or a chosen one; NULL: none was computed.
 * The caller frees it. */
nh_simulation *nh_answer_motion_of_page(const nh_request *request);
/* The exit code of an answer that is not refuted. */
int nh_answer_code(bool partial, const nh_error *error);

#endif
