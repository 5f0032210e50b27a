/* index: a map from expressions to words, or a set of expressions. */
#ifndef NH_INDEX_H
#define NH_INDEX_H

#include "graph/expr.h"

typedef struct {
    uint64_t *slot; /* (key + 1) << 32 | value; 0 when free */
    size_t count, capacity;
} nh_index;

/* The word of the key; false where it has none. */
bool nh_index_get(const nh_index *index, nh_ex key, uint32_t *value);
void nh_index_put(nh_index *index, nh_ex key, uint32_t value); /* a key that is not there yet */
void nh_index_clear(nh_index *index);

#endif
