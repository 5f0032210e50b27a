/* reduction_answer: the first screen of `reduce` on a terminal: the group, what is left by stages, and the check.  All
 * else is in the document (document/reduction.h). */
#ifndef NH_REDUCTION_ANSWER_H
#define NH_REDUCTION_ANSWER_H

#include "base/text.h"
#include "document/reduction.h"

void nh_reduction_write_answer(const nh_reduction *reduction, bool colour, nh_text *out);

#endif
