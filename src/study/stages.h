/* stages: what the ladder tries, in order. */
#ifndef NH_STAGES_H
#define NH_STAGES_H

#include "noether/ansatz.h"
#include "noether/dictionary.h"

typedef struct {
    const char *name;
    size_t families;
    const nh_family *family;
} nh_stage;

/* Stage `index` for this dictionary, in the arena; false when there are no more.  A stage may have no families. */
bool nh_stage_at(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary, size_t index, nh_stage *out);

/* Products of the dictionary that the search for unknown exponents starts from. */
nh_family nh_stage_pencil_base(nh_arena *arena, const nh_model *model, const nh_dictionary *dictionary);

#endif
