/* Sections at several values, of which the unlucky ones are left out. */
#include "classify/sections.h"

#include <string.h>

#include "base/memory.h"
#include "base/progress.h"

enum { most_sections = 20, most_unlucky = 6 };

/* Sections at several values, all of the same degrees. */
typedef struct {
    size_t count, used; /* used: number of values taken, unlucky ones included */
    nh_residue value[most_sections];
    nh_common_curves at[most_sections];
} sections;

/* The index-th of some values that have no special meaning. */
static int64_t value_at(size_t index) { return 7919 + 1009 * (int64_t)index; }

static bool alike(const nh_common_curves *a, const nh_common_curves *b)
{
    return !memcmp(a->special.degree, b->special.degree, sizeof a->special.degree) &&
           !memcmp(a->degenerate.degree, b->degenerate.degree, sizeof a->degenerate.degree) &&
           a->across.degree == b->across.degree;
}

/* A section whose degrees differ is unlucky: the first one, when the second disagrees with it, otherwise the new
 * one. */
static void add_section(sections *x, nh_residue value, nh_common_curves *c)
{
    if (x->count == 1 && !alike(&x->at[0], c)) nh_common_curves_clear(&x->at[--x->count]);
    if (x->count && !alike(&x->at[0], c)) {
        nh_common_curves_clear(c);
        return;
    }
    x->value[x->count] = value;
    x->at[x->count++] = *c;
}

static bool more_sections(nh_prime f, nh_sections_look section, void *context, size_t want, sections *x)
{
    while (x->count < want && x->used < want + most_unlucky && !nh_late()) {
        nh_common_curves c = {.across = {0, NULL}};
        int64_t value = value_at(x->used++);
        if (!section(context, value, &c)) {
            nh_common_curves_clear(&c);
            return false;
        }
        add_section(x, nh_residue_of(f, value), &c);
    }
    return x->count == want;
}

nh_sections nh_sections_of(const nh_common_curves *c)
{
    return (nh_sections){
        c->special, c->degenerate, {.degree = {0, c->across.degree}, .coefficient = c->across.coefficient}};
}

static bool interpolate(const sections *x, nh_prime f, nh_sections *out)
{
    nh_residue_surface special[most_sections], degenerate[most_sections], across[most_sections];
    *out = (nh_sections){.special = {.degree = {0}}};
    for (size_t k = 0; k < x->count; k++) {
        nh_sections at = nh_sections_of(&x->at[k]);
        special[k] = at.special;
        degenerate[k] = at.degenerate;
        across[k] = at.across;
    }
    bool good = nh_residue_surface_from(f, x->count, x->value, special, &out->special) &&
                nh_residue_surface_from(f, x->count, x->value, degenerate, &out->degenerate) &&
                nh_residue_surface_from(f, x->count, x->value, across, &out->across);
    if (!good) nh_sections_clear(out);
    return good;
}

bool nh_sections_find(nh_prime f, nh_sections_look section, void *context, size_t *count, bool *too_few,
                      nh_sections *out)
{
    sections x = {.count = 0};
    bool good = true, found = false;
    for (size_t want = *count; want <= most_sections && good && !found; want += 2) {
        good = more_sections(f, section, context, want, &x);
        found = good && interpolate(&x, f, out);
        *count = want;
    }
    *too_few = good && !found;
    for (size_t k = 0; k < x.count; k++) nh_common_curves_clear(&x.at[k]);
    return found;
}

void nh_sections_clear(nh_sections *o)
{
    nh_free(o->special.coefficient);
    nh_free(o->degenerate.coefficient);
    nh_free(o->across.coefficient);
    *o = (nh_sections){.special = {.degree = {0}}};
}
