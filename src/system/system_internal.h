/* system_internal: shared by system.c (names) and system_read.c (the file). */
#ifndef NH_SYSTEM_INTERNAL_H
#define NH_SYSTEM_INTERNAL_H

#include <stdio.h>

#include "system/system.h"

enum { NH_NO_VELOCITIES = 1, NH_NO_QUASI = 2, NH_NO_COORDINATES = 4 };

/* An expression (lhs NULL) or an equation, with errors pointing into the scalar `node`. */
bool nh_system_read_expression(const nh_system *system, const nh_deck *deck, const nh_deck_node *node, unsigned forbid,
                               size_t extras, const nh_named *extra, nh_ex *lhs, nh_ex *rhs, nh_error *error);

#endif
