/* wheel_checks: what a file surely does not mean: wheels above the ground or in it, and wheels that are not round. */
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "system/bodies_tree.h"
#include "system/system_internal.h"

static const double rounding = 1e-6; /* files have numbers with few digits */

/* "left, right" */
static void add_name(nh_text *list, const nh_wheel *w, const nh_chain *c)
{
    nh_text_addf(list, "%s%s", list->length ? ", " : "", c->body[w->body].name);
}

static bool moves(const nh_system *system, nh_ex e)
{
    bool any = nh_depends(system->dag, e, system->t);
    for (size_t i = 0; i < system->coordinates; i++) any |= nh_depends(system->dag, e, system->coordinate[i].q);
    return any;
}

/* Wheels whose height above their surface is a number that is not 0.  Without gravity heights may mean nothing. */
static const char *lifted(const nh_system *system)
{
    const nh_chain *c = system->chain;
    if (nh_is_zero(system->dag, c->gravity[0]) && nh_is_zero(system->dag, c->gravity[1]) &&
        nh_is_zero(system->dag, c->gravity[2]))
        return NULL;
    nh_text list;
    const char *first = NULL;
    nh_text_init(&list);
    for (size_t i = 0; i < c->wheels; i++) {
        const nh_wheel *w = &c->wheel[i];
        if (w->kind != NH_WHEEL_ROLLING) continue;
        nh_ex height = nh_tidy(system->dag, nh_wheel_height(c, system->dag, w));
        if (moves(system, height)) continue;
        double h = nh_system_number(system, height), r = nh_system_number(system, w->radius);
        if (!(fabs(h) > rounding * fabs(r))) continue;
        add_name(&list, w, c);
        if (!first)
            first = nh_arena_printf(system->arena,
                                    "%s is %.4g %s it: move its joint by %.4g along the normal, or change its radius",
                                    c->body[w->body].name, fabs(h), h > 0 ? "above" : "below", -h);
    }
    const char *out = NULL;
    if (list.length)
        out = nh_arena_printf(system->arena, "these wheels do not touch the ground: %s; %s", nh_text_string(&list),
                              first);
    nh_text_clear(&list);
    return out;
}

/* The inertia in the axes of the wheel: along the axle, and how far those across it differ from one number. */
typedef struct {
    double axle, across, unequal, off; /* off: of the centre of mass from the axle */
    double round[9];                   /* the nearest inertia that is round */
} balance;

static balance balance_of(const nh_system *system, const nh_wheel *w)
{
    const nh_body *b = &system->chain->body[w->body];
    balance out = {.axle = 0};
    double a[3], I[9], d[3], trace = 0, along = 0, difference = 0;
    for (int i = 0; i < 3; i++) {
        a[i] = nh_system_number(system, w->axis[i]);
        d[i] = nh_system_number(system, b->center[i]) - nh_system_number(system, w->at[i]);
        along += a[i] * d[i];
    }
    for (int i = 0; i < 9; i++) I[i] = nh_system_number(system, b->inertia[i]);
    for (int i = 0; i < 3; i++) {
        trace += I[4 * i];
        for (int j = 0; j < 3; j++) out.axle += a[i] * I[3 * i + j] * a[j];
        out.off += (d[i] - along * a[i]) * (d[i] - along * a[i]);
    }
    out.across = (trace - out.axle) / 2;
    for (int i = 0; i < 9; i++) {
        out.round[i] = out.across * (i % 4 == 0) + (out.axle - out.across) * a[i / 3] * a[i % 3];
        difference += (I[i] - out.round[i]) * (I[i] - out.round[i]);
    }
    out.unequal = sqrt(difference);
    out.off = sqrt(out.off);
    return out;
}

/* "[0.003, 0.005, 0.003]", or the whole matrix. */
static const char *inertia_words(const nh_system *system, const double I[9])
{
    double products = fabs(I[1]) + fabs(I[2]) + fabs(I[5]), size = fabs(I[0]) + fabs(I[4]) + fabs(I[8]);
    if (products <= rounding * size) return nh_arena_printf(system->arena, "[%.6g, %.6g, %.6g]", I[0], I[4], I[8]);
    return nh_arena_printf(system->arena, "[[%.6g, %.6g, %.6g], [%.6g, %.6g, %.6g], [%.6g, %.6g, %.6g]]", I[0], I[1],
                           I[2], I[3], I[4], I[5], I[6], I[7], I[8]);
}

/* Of wheels that turn about their axles: are they round about these? */
static const char *unround(const nh_system *system)
{
    const nh_chain *c = system->chain;
    nh_text list;
    const char *example = NULL;
    nh_text_init(&list);
    for (size_t i = 0; i < c->wheels; i++) {
        const nh_wheel *w = &c->wheel[i];
        if (w->kind != NH_WHEEL_ROLLING || w->ball || !nh_wheel_turns(c, system->dag, w)) continue;
        balance b = balance_of(system, w);
        double size = fabs(b.axle) + 2 * fabs(b.across), r = fabs(nh_system_number(system, w->radius));
        bool unequal = b.unequal > rounding * size, off = b.off > rounding * r;
        if (!unequal && !off) continue;
        add_name(&list, w, c);
        if (!example)
            example = unequal ? nh_arena_printf(system->arena, "inertia: %s of %s would be round",
                                                inertia_words(system, b.round), c->body[w->body].name)
                              : nh_arena_printf(system->arena, "the centre of mass of %s is %.4g off its axle",
                                                c->body[w->body].name, b.off);
    }
    const char *out = NULL;
    if (list.length)
        out = nh_arena_printf(system->arena,
                              "these wheels are not round about their axles, so their angles occur in the equations of "
                              "motion: %s; %s",
                              nh_text_string(&list), example);
    nh_text_clear(&list);
    return out;
}

size_t nh_wheel_checks(const nh_system *system, const char *out[2])
{
    size_t n = 0;
    if (!system->chain || !system->chain->wheels) return 0;
    const char *const found[] = {lifted(system), unround(system)};
    for (int i = 0; i < 2; i++)
        if (found[i]) out[n++] = found[i];
    return n;
}
