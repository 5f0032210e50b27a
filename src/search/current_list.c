#include "search/current_list.h"

#include <stdio.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/measure.h"

/* The list, which is constant for everybody but the functions of this file, and its entries. */
static nh_current_list *own(nh_analysis *result) { return (nh_current_list *)result->list; }

static nh_current *entries(const nh_current *entry) { return (nh_current *)entry; }

void nh_current_list_begin(nh_analysis *result) { result->list = nh_arena_alloc(result->arena, sizeof *result->list); }

nh_current *nh_current_list_describe(nh_analysis *result, const nh_current *entry)
{
    (void)result; /* whoever may write it may describe its integrals */
    return entries(entry);
}

static void grow(nh_analysis *result) /* the arena keeps the old list: there are few */
{
    nh_current_list *list = own(result);
    size_t capacity = 2 * list->capacity + 16;
    nh_current *found = nh_arena_alloc(result->arena, capacity * sizeof *found);
    if (list->count) memcpy(found, list->found, list->count * sizeof *found);
    list->found = found;
    list->capacity = capacity;
}

void nh_current_list_append(nh_analysis *result, const nh_current *checked)
{
    nh_current_list *list = own(result);
    nh_current copy = *checked; /* it may be of this list */
    if (list->count == list->capacity) grow(result);
    entries(list->found)[list->count++] = copy;
    list->independent += copy.independence == NH_INDEPENDENT;
}

nh_current nh_current_list_take(nh_analysis *result, size_t k)
{
    nh_current_list *list = own(result);
    nh_current taken = list->found[k];
    entries(list->found)[k] = list->found[--list->count];
    list->independent -= taken.independence == NH_INDEPENDENT;
    return taken;
}

size_t nh_current_list_take_all(nh_analysis *result, bool (*leaves)(const nh_current *current), nh_current **taken)
{
    nh_current_list *list = own(result);
    size_t kept = 0, n = 0;
    *taken = nh_arena_alloc(result->arena, (list->count + 1) * sizeof **taken);
    for (size_t k = 0; k < list->count; k++) {
        const nh_current *f = &list->found[k];
        if (!leaves(f)) {
            entries(list->found)[kept++] = *f;
            continue;
        }
        list->independent -= f->independence == NH_INDEPENDENT;
        (*taken)[n++] = *f;
    }
    list->count = kept;
    return n;
}

void nh_current_list_sort(nh_analysis *result)
{
    nh_dag *d = result->question->model->dag;
    nh_current *found = entries(result->list->found);
    for (size_t i = 1; i < result->list->count; i++) {
        nh_current f = found[i];
        size_t j = i;
        for (; j > 0; j--) {
            if (found[j - 1].energy || (!f.energy && nh_complexity_order(d, found[j - 1].phi, f.phi) <= 0)) break;
            found[j] = found[j - 1];
        }
        found[j] = f;
    }
}

void nh_current_list_move(nh_analysis *result, size_t from, size_t to)
{
    nh_current *found = entries(result->list->found), f = found[from];
    for (size_t k = from; k > to; k--) found[k] = found[k - 1];
    found[to] = f;
}

void nh_current_list_rank(nh_analysis *result, const nh_independence *kind, const double *fraction)
{
    nh_current_list *list = own(result);
    nh_current *found = entries(list->found);
    list->independent = 0;
    for (size_t k = 0; k < list->count; k++) {
        found[k].independence = kind[k];
        found[k].fraction = fraction[k];
        list->independent += kind[k] == NH_INDEPENDENT;
    }
}

void nh_current_list_formulas(const nh_current_list *list, nh_ex *phi, bool *proved)
{
    for (size_t k = 0; k < list->count; k++) {
        phi[k] = list->found[k].phi;
        proved[k] = list->found[k].proof.proved;
    }
}

bool nh_current_list_append_piece(nh_analysis *result, const nh_current *checked)
{
    nh_current_list *list = own(result);
    if (list->pieces == NH_MOST_PIECES) return false;
    if (!list->piece) list->piece = nh_arena_alloc(result->arena, NH_MOST_PIECES * sizeof *list->piece);
    entries(list->piece)[list->pieces++] = *checked;
    return true;
}

void nh_current_list_keep_pieces(nh_analysis *result, const bool *keep)
{
    nh_current_list *list = own(result);
    size_t kept = 0;
    for (size_t k = 0; k < list->pieces; k++)
        if (keep[k]) entries(list->piece)[kept++] = list->piece[k];
    list->pieces = kept;
}

bool nh_current_list_append_further(nh_analysis *result, const nh_current *checked, size_t degree)
{
    nh_current_list *list = own(result);
    if (list->furthers == NH_MOST_FURTHER) return false;
    if (!list->further) list->further = nh_arena_alloc(result->arena, NH_MOST_FURTHER * sizeof *list->further);
    ((nh_further_integral *)list->further)[list->furthers++] = (nh_further_integral){*checked, degree};
    return true;
}

/* ---- names ---- */

/* Is a symbol named by these letters and a number? */
static bool is_used(const nh_dag *d, const char *letters)
{
    enum { most = 99 };
    char name[24];
    nh_ex symbol;
    for (int k = 0; k <= most; k++) {
        snprintf(name, sizeof name, "%s%d", letters, k);
        if (nh_symbol_find(d, name, &symbol)) return true;
    }
    return false;
}

const char *nh_current_list_name(nh_analysis *result, size_t number)
{
    static const char *const letters[] = {"Phi", "Psi", "Xi", "Current"};
    for (size_t i = 0; !result->letter; i++)
        if (i + 1 == sizeof letters / sizeof *letters || !is_used(result->question->model->dag, letters[i]))
            result->letter = letters[i];
    return nh_arena_printf(result->arena, "%s%zu", result->letter, number);
}

/* Has the source of the system this name for a current? */
static bool is_symbol(const nh_current_list *list, const char *name)
{
    for (size_t k = 0; k < list->count; k++)
        if (list->found[k].symbol && !strcmp(list->found[k].symbol, name)) return true;
    return false;
}

void nh_current_list_name_all(nh_analysis *result)
{
    const nh_current_list *list = result->list;
    for (size_t k = 0, number = 0; k < list->count; k++) {
        const char *name = list->found[k].symbol;
        while (!name) {
            name = nh_current_list_name(result, ++number);
            if (is_symbol(list, name)) name = NULL;
        }
        nh_current_list_describe(result, &list->found[k])->name = name;
    }
}
