/* named_system: the linear equations that the coefficients f_i(s) of a current satisfy.
 *
 *     Gamma(sum_i f_i b_i) = sum_i ( f_i' Gamma(s) b_i + f_i Gamma(b_i) ) = 0,
 *
 * sorted by products of states, is a linear system for the f_i with coefficients in s.  Differentiated and eliminated
 * it becomes g' = A g, f = T g for a few of them.  Where A has blocks each can be solved by itself. */
#ifndef NH_NAMED_SYSTEM_H
#define NH_NAMED_SYSTEM_H

#include "base/memory.h"
#include "geometry/model.h"

enum { NH_NAMED_WORDS = 32, NH_NAMED_ORDER = 3 };

/* Two or three unknowns that are coupled with each other and with no other. */
typedef struct {
    size_t order;
    nh_ex A[NH_NAMED_ORDER][NH_NAMED_ORDER]; /* g_i' = sum_j A_ij g_j */
    nh_ex T[NH_NAMED_WORDS][NH_NAMED_ORDER]; /* f_i = sum_j T_ij g_j */
} nh_named_block;

/* The blocks of the system for these words, at most NH_NAMED_WORDS of them; 0 where an entry has a complexity above
 * `longest`. */
size_t nh_named_blocks(const nh_model *model, nh_ex s, size_t words, const nh_ex *word, size_t longest,
                       nh_named_block out[NH_NAMED_WORDS]);

#endif
