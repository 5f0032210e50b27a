#include "graph/index.h"

#include "base/memory.h"

static size_t slot_of(const nh_index *index, nh_ex key)
{
    size_t i = (key * 0x9e3779b97f4a7c15u >> 32) & (index->capacity - 1);
    while (index->slot[i] && (nh_ex)((index->slot[i] >> 32) - 1) != key) i = (i + 1) & (index->capacity - 1);
    return i;
}

bool nh_index_get(const nh_index *index, nh_ex key, uint32_t *value)
{
    if (!index->count) return false;
    uint64_t word = index->slot[slot_of(index, key)];
    *value = (uint32_t)word;
    return word != 0;
}

static void widen(nh_index *index)
{
    nh_index wide = {.capacity = index->capacity ? 2 * index->capacity : 64, .count = index->count};
    wide.slot = nh_alloc_array(wide.capacity, sizeof *wide.slot);
    for (size_t i = 0; i < index->capacity; i++)
        if (index->slot[i]) wide.slot[slot_of(&wide, (nh_ex)((index->slot[i] >> 32) - 1))] = index->slot[i];
    nh_free(index->slot);
    *index = wide;
}

void nh_index_put(nh_index *index, nh_ex key, uint32_t value)
{
    if (2 * (index->count + 1) > index->capacity) widen(index);
    index->slot[slot_of(index, key)] = ((uint64_t)key + 1) << 32 | value;
    index->count++;
}

void nh_index_clear(nh_index *index)
{
    nh_free(index->slot);
    *index = (nh_index){0};
}
