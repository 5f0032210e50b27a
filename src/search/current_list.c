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

void nh_current_list_append(nh_analysis *result, const nh_current *checked)
{
    nh_current copy = *checked; /* it may be of this list */
    if (result->count == result->capacity) grow(result);
    result->found[result->count++] = copy;
    result->independent += copy.independence == NH_INDEPENDENT;
}

nh_current nh_current_list_take(nh_analysis *result, size_t k)
{
    nh_current taken = result->found[k];
    result->found[k] = result->found[--result->count];
    result->independent -= taken.independence == NH_INDEPENDENT;
    return taken;
}

size_t nh_current_list_take_all(nh_analysis *result, bool (*leaves)(const nh_current *current), nh_current **taken)
{
    size_t kept = 0, n = 0;
    *taken = nh_arena_alloc(result->arena, (result->count + 1) * sizeof **taken);
    for (size_t k = 0; k < result->count; k++) {
        const nh_current *f = &result->found[k];
        if (!leaves(f)) {
            result->found[kept++] = *f;
            continue;
        }
        result->independent -= f->independence == NH_INDEPENDENT;
        (*taken)[n++] = *f;
    }
    result->count = kept;
    return n;
}

void nh_current_list_sort(nh_analysis *result)
{
    nh_dag *d = result->model->dag;
    for (size_t i = 1; i < result->count; i++) {
        nh_current f = result->found[i];
        size_t j = i;
        for (; j > 0; j--) {
            if (result->found[j - 1].energy ||
                (!f.energy && nh_complexity_order(d, result->found[j - 1].phi, f.phi) <= 0))
                break;
            result->found[j] = result->found[j - 1];
        }
        result->found[j] = f;
    }
}

void nh_current_list_rank(nh_analysis *result, const nh_independence *kind, const double *fraction)
{
    result->independent = 0;
    for (size_t k = 0; k < result->count; k++) {
        result->found[k].independence = kind[k];
        result->found[k].fraction = fraction[k];
        result->independent += kind[k] == NH_INDEPENDENT;
    }
}

bool nh_current_list_append_piece(nh_analysis *result, const nh_current *checked)
{
    if (result->pieces == NH_MOST_PIECES) return false;
    if (!result->piece) result->piece = nh_arena_alloc(result->arena, NH_MOST_PIECES * sizeof *result->piece);
    result->piece[result->pieces++] = *checked;
    return true;
}

void nh_current_list_keep_pieces(nh_analysis *result, const bool *keep)
{
    size_t kept = 0;
    for (size_t k = 0; k < result->pieces; k++)
        if (keep[k]) result->piece[kept++] = result->piece[k];
    result->pieces = kept;
}

bool nh_current_list_append_further(nh_analysis *result, const nh_current *checked, size_t degree)
{
    if (result->furthers == NH_MOST_FURTHER) return false;
    if (!result->further) result->further = nh_arena_alloc(result->arena, NH_MOST_FURTHER * sizeof *result->further);
    result->further[result->furthers++] = (nh_further_integral){*checked, degree};
    return true;
}
