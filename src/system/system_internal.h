/* system_internal: shared by system.c (names) and system_read.c (the file). */
#ifndef NH_SYSTEM_INTERNAL_H
#define NH_SYSTEM_INTERNAL_H

#include <stdio.h>

#include "system/system.h"

enum { NH_NO_VELOCITIES = 1, NH_NO_QUASI = 2 };

/* An expression (lhs NULL) or an equation, after the first `skip` bytes of the scalar `node`, with errors pointing into it. */
bool nh_system_read_expression(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, size_t skip, unsigned forbid,
                               size_t extras, const nh_named *extra, nh_ex *lhs, nh_ex *rhs, nh_error *error);

#endif
