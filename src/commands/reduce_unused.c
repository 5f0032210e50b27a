/* reduce_unused: why a symmetry is not used, and why there is no Chaplygin stage. */
#include "commands/reduce_internal.h"

#include <string.h>

static void put(nh_reduction *r, const char *what, const char *why)
{
    enum { most = sizeof r->unused / sizeof *r->unused };
    if (r->unused_count < most) r->unused[r->unused_count++] = (nh_reduction_unused){what, why};
}

void nh_reduction_no_chaplygin(nh_reduction *r)
{
    static const char what[] = "a Chaplygin stage";
    const nh_action *g = &r->group->action;
    size_t f = r->kinetic->f;
    double transversality;
    nh_arena *arena = r->arena;
    if (!f || r->brief) return;
    if (g->d < f) {
        put(r, what,
            nh_arena_printf(arena, "it divides out as many symmetries as there are constraints, %zu; the group has %zu",
                            f, g->d));
        return;
    }
    size_t count = nh_group_subalgebras(r->group, f, &transversality);
    if (r->kinetic->affine && !g->dimension_assumption)
        put(r, what,
            "the orbits of the group and the constraint distribution together do not span the tangent space: V + D is "
            "not TQ");
    else if (!count) put(r, what, nh_arena_printf(arena, "no %zu of the generators span a subalgebra", f));
    else
        put(r, what,
            nh_arena_printf(arena,
                            "where %zu of the generators span a subalgebra, their orbits meet the constraint "
                            "distribution at sample points (least ratio of singular values %.1e; option transversal)",
                            f, transversality));
}

/* Why p(zeta) is not conserved. */
static const char *violated(nh_reduction *r, const nh_chaplygin *first, const nh_ex *field)
{
    nh_error error = {0};
    nh_second t;
    const char *why =
        "its momentum is conserved only in combination with others that are not symmetries of the reduced system";
    if (!nh_second_init(&t, first, 1, field, &r->options, &error))
        why = nh_arena_printf(r->arena, "condition (ii) of Chhabra and Emami (2014) fails: %s", error.what);
    nh_error_clear(&error);
    nh_second_clear(&t);
    return why;
}

void nh_reduction_not_in_second(nh_reduction *r, const nh_chaplygin *first, const bool *used, const bool *normalises)
{
    const nh_action *g = &r->group->action;
    for (size_t a = 0; a < g->d && !r->brief; a++) {
        if (used[a]) continue;
        const char *what = nh_arena_printf(r->arena, "generator %zu in a second stage", a + 1);
        if (normalises[a]) put(r, what, violated(r, first, g->generator[a].component));
        else
            put(r, what,
                "it does not normalise the group of the first stage: its brackets with that leave it, so that it does "
                "not act on the shape space");
    }
}
