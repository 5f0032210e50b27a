#include "search/current_list.h"

#include <string.h>

#include "graph/measure.h"

static void grow(nh_analysis *r) /* the arena keeps the old list: there are few */
{
    size_t capacity = 2 * r->capacity + 16;
    nh_current *list = nh_arena_alloc(r->arena, capacity * sizeof *list);
    if (r->count) memcpy(list, r->found, r->count * sizeof *list);
    r->found = list;
    r->capacity = capacity;
}

void nh_current_list_append(nh_analysis *r, const nh_current *checked)
{
    nh_current copy = *checked; /* it may be of this list */
    if (r->count == r->capacity) grow(r);
    r->found[r->count++] = copy;
    r->independent += copy.independence == NH_INDEPENDENT;
}

nh_current nh_current_list_take(nh_analysis *r, size_t k)
{
    nh_current taken = r->found[k];
    r->found[k] = r->found[--r->count];
    r->independent -= taken.independence == NH_INDEPENDENT;
    return taken;
}

size_t nh_current_list_take_all(nh_analysis *r, bool (*leaves)(const nh_current *current), nh_current **taken)
{
    size_t kept = 0, n = 0;
    *taken = nh_arena_alloc(r->arena, (r->count + 1) * sizeof **taken);
    for (size_t k = 0; k < r->count; k++) {
        const nh_current *f = &r->found[k];
        if (!leaves(f)) {
            r->found[kept++] = *f;
            continue;
        }
        r->independent -= f->independence == NH_INDEPENDENT;
        (*taken)[n++] = *f;
    }
    r->count = kept;
    return n;
}

void nh_current_list_sort(nh_analysis *r)
{
    nh_dag *d = r->model->dag;
    for (size_t i = 1; i < r->count; i++) {
        nh_current f = r->found[i];
        size_t j = i;
        for (; j > 0; j--) {
            if (r->found[j - 1].energy || (!f.energy && nh_complexity_order(d, r->found[j - 1].phi, f.phi) <= 0)) break;
            r->found[j] = r->found[j - 1];
        }
        r->found[j] = f;
    }
}

void nh_current_list_rank(nh_analysis *r, const nh_independence *kind, const double *fraction)
{
    r->independent = 0;
    for (size_t k = 0; k < r->count; k++) {
        r->found[k].independence = kind[k];
        r->found[k].fraction = fraction[k];
        r->independent += kind[k] == NH_INDEPENDENT;
    }
}

bool nh_current_list_append_piece(nh_analysis *r, const nh_current *checked)
{
    if (r->pieces == NH_MOST_PIECES) return false;
    if (!r->piece) r->piece = nh_arena_alloc(r->arena, NH_MOST_PIECES * sizeof *r->piece);
    r->piece[r->pieces++] = *checked;
    return true;
}

void nh_current_list_keep_pieces(nh_analysis *r, const bool *keep)
{
    size_t kept = 0;
    for (size_t k = 0; k < r->pieces; k++)
        if (keep[k]) r->piece[kept++] = r->piece[k];
    r->pieces = kept;
}

bool nh_current_list_append_further(nh_analysis *r, const nh_current *checked, size_t degree)
{
    if (r->furthers == NH_MOST_FURTHER) return false;
    if (!r->further) r->further = nh_arena_alloc(r->arena, NH_MOST_FURTHER * sizeof *r->further);
    r->further[r->furthers++] = (nh_further_integral){*checked, degree};
    return true;
}
