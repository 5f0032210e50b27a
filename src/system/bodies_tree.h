/* bodies_tree: shared by bodies_read.c (the tree), bodies_values.c (its numbers and expressions) and system_read.c. */
#ifndef NH_BODIES_TREE_H
#define NH_BODIES_TREE_H

#include "system/bodies.h"
#include "system/system_internal.h"

enum { NH_NOBODY = -2 };

/* The index of a scalar among words, or -1 with a message ("`x` is not <what>; expected ..."). */
long nh_system_word(nh_system_reader *r, const nh_deck_node *node, const char *what, size_t count,
                    const char *const *words);
/* The body named under `key` of a map; `fallback` when there is no such key (NH_NOBODY: it is required).  NH_NOBODY
   with a message. */
long nh_system_body_word(nh_system_reader *r, const nh_deck_node *map, const char *key, long fallback);
/* An expression in parameters alone, `what` in messages; one in parameters and t; three of the first kind. */
bool nh_system_constant(nh_system_reader *r, const nh_deck_node *node, const char *what, nh_ex *out);
bool nh_system_function_of_time(nh_system_reader *r, const nh_deck_node *node, const char *what, nh_ex *out);
bool nh_system_vector(nh_system_reader *r, const nh_deck_node *list, const char *what, nh_ex out[3]);
/* Is screw k of a joint a turn? */
bool nh_joint_turns(const nh_joint *joint, size_t k);

#endif
