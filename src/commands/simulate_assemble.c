/* simulate_assemble: initial positions off the constraints between positions: what is said, and what --project does. */
#include <math.h>
#include <string.h>

#include "commands/simulate_internal.h"
#include "motion/assembly.h"

enum { most_shown = 6 };

/* "b by 0.41, c by 1.2 (although it was given)" */
static void add_moves(const nh_simulation *s, const nh_state *now, const double *before, nh_text *out)
{
    size_t shown = 0, more = 0;
    for (size_t i = 0; i < s->model->m; i++) {
        double by = now->q[i] - before[i];
        if (!(fabs(by) > 1e-12 * (1 + fabs(before[i])))) continue;
        if (shown == most_shown) more++;
        else
            nh_text_addf(out, "%s%s by %.4g%s", shown++ ? ", " : "", s->system->coordinate[i].name, by,
                         now->placed && now->placed[i] ? " (although it was given)" : "");
    }
    if (more) nh_text_addf(out, " and %zu more", more);
}

void nh_simulate_assemble(nh_simulation *s, nh_state *initial)
{
    size_t m = s->model->m;
    double value, distance, *before = nh_arena_alloc(s->arena, m * sizeof *before);
    nh_assembly *a = nh_assembly_create(s->model);
    s->assembled = NULL;
    memcpy(before, initial->q, m * sizeof *before);
    if (a && nh_assembly_violated(a, initial->t, initial->q, &value, &distance) &&
        (nh_assembly_move(a, initial->t, initial->placed, initial->q) ||
         (initial->placed && nh_assembly_move(a, initial->t, NULL, initial->q)))) {
        nh_text text;
        nh_text_init(&text);
        nh_text_add(&text, "--project moves the initial position onto the constraints: ");
        add_moves(s, initial, before, &text);
        s->assembled = nh_arena_strdup(s->arena, nh_text_string(&text));
        nh_text_clear(&text);
    }
    nh_assembly_free(a);
}

const char *nh_simulate_violation(const nh_simulation *s, const nh_state *at, bool projected)
{
    double value, distance;
    nh_assembly *a = nh_assembly_create(s->model);
    const char *words = a ? nh_assembly_violated(a, at->t, at->q, &value, &distance) : NULL, *out = NULL;
    if (words)
        out = nh_arena_printf(s->arena,
                              "the initial position does not satisfy %s: the error is about %.2g; along the motion %s "
                              "stays %.6g; %s",
                              words, distance, strchr(words, '=') ? "left side minus right side" : "its height", value,
                              projected ? "--project found no position near it that does"
                                        : "--project moves it to the nearest position that does");
    nh_assembly_free(a);
    return out;
}
