#include "search/theory.h"

#include "base/progress.h"

nh_theory *nh_theory_of(nh_arena *arena, const nh_model *model, const nh_model *other, size_t most,
                        const nh_options *options)
{
    nh_theory *t = nh_arena_alloc(arena, sizeof *t);
    const nh_model *shown = other ? other : model;
    *t = (nh_theory){.model = shown,
                     .submanifold = nh_submanifold_of(arena, shown, NULL),
                     .determining = nh_determining_of(arena, shown),
                     .shown = options->shown,
                     .written = options->written,
                     .bracket = nh_arena_alloc(arena, (most + 1) * sizeof *t->bracket)};
    t->own = other ? nh_submanifold_of(arena, model, other->chart->dependent) : t->submanifold;
    t->inertial = nh_inertial_of(arena, t->submanifold);
    return t;
}

void nh_theory_add(nh_arena *arena, nh_theory *t, const char *name, const nh_symmetry *symmetry)
{
    t->bracket[t->brackets++] = (struct nh_theory_bracket){name, symmetry, nh_bracket_of(arena, t->own, symmetry)};
}

void nh_theory_space(nh_arena *arena, nh_theory *t, size_t count, const nh_named_current *current, size_t counted,
                     const nh_options *options)
{
    t->fields = nh_bracket_fields_of(arena, t->submanifold);
    t->currents = count;
    t->current = current;
    t->space = nh_symmetry_space_of(arena, t->own, count, current, counted, options);
    if (!nh_late()) t->symmetries = nh_equation_symmetries_of(arena, t->own, count, current, t->space, options);
}
