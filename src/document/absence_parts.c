#include "document/absence_parts.h"

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/print.h"

const nh_absence_attempt *nh_absence_parts_best(const nh_absence *a)
{
    return a->best < a->attempts ? &a->attempt[a->best] : NULL;
}

bool nh_absence_parts_special_linear(const nh_absence_attempt *t)
{
    return t && t->kovacic && t->kovacic->group == NH_GROUP_SL2;
}

bool nh_absence_parts_angles(const nh_closed_shape *shape)
{
    bool any = false;
    for (size_t i = 0; shape && i < shape->count; i++) any |= shape->angle[i];
    return any;
}

bool nh_absence_parts_by_darboux(const nh_absence *a)
{
    return !nh_absence_parts_best(a) && a->darboux && a->darboux->refuted;
}

bool nh_absence_parts_periodic(const nh_absence *a)
{
    if (a->rational) return false;
    bool special = nh_absence_parts_by_darboux(a) || nh_absence_parts_special_linear(nh_absence_parts_best(a));
    return a->periodic || (nh_absence_parts_angles(a->shape) && !special);
}

const char *nh_absence_parts_group(nh_arena *arena, const nh_absence_attempt *t)
{
    const nh_kovacic *k = t->kovacic;
    static const char *const groups[] = {"SL(2)", "not virtually abelian", "open", "undecided"};
    if (k && (k->group == NH_GROUP_SL2 || k->group == NH_GROUP_TRIANGULAR)) return groups[k->group];
    if (t->residues && t->residues->verdict == NH_RESIDUE_MEROMORPHIC) return "a residue is not rational";
    if (t->residues && t->residues->verdict == NH_RESIDUE_RATIONAL) return "infinite, by an irregular point";
    if (t->orbit && t->equation)
        return nh_arena_printf(arena, "moves in %zu of %zu dimensions", t->orbit, t->equation->dimension);
    return k ? groups[k->group] : "open";
}

const char *nh_absence_parts_verdict(const nh_absence *a)
{
    static const char *const words[] = {"open",   "none else", "dependent", "at most", "not Liouville integrable",
                                        "settled"};
    return a->contradiction ? "contradiction" : words[a->verdict];
}

size_t nh_absence_parts_roots(nh_arena *arena, const nh_closed_shape *shape, const char ***root)
{
    nh_dag *d = shape->model->dag;
    size_t found = 0, room = 0;
    NH_LIST(kept);
    NH_LIST(products);
    *root = NULL;
    for (size_t i = 0; i < shape->count; i++) {
        size_t n = nh_products_in(d, shape->rate[i], &products);
        for (size_t j = 0; j < n; j++)
            for (size_t k = 0; k < nh_arity(d, products[j]); k++) {
                nh_ex base = nh_child(d, products[j], k), exponent = nh_exponent_of(d, products[j], k);
                if (nh_kind_of(d, exponent) != NH_NUMBER || nh_number_of(d, exponent).q <= 1) continue;
                bool moves = false, known = false;
                for (size_t l = 0; l < shape->count; l++) moves |= nh_depends(d, base, shape->letter[l]);
                nh_ex e = nh_pow(d, base, nh_ratio(d, 1, nh_number_of(d, exponent).q));
                for (size_t l = 0; l < found; l++) known |= kept[l] == e;
                if (!moves || known) continue;
                nh_grow(&kept, &room, found + 1, sizeof *kept);
                kept[found++] = e;
            }
    }
    *root = nh_arena_alloc(arena, (found + 1) * sizeof **root);
    for (size_t i = 0; i < found; i++) {
        char *text = nh_print_string(d, kept[i]);
        (*root)[i] = nh_arena_strdup(arena, text);
        nh_free(text);
    }
    return found;
}

bool nh_absence_parts_excludes(const nh_absence *a)
{
    return !a->contradiction && a->verdict != NH_ABSENCE_OPEN && a->verdict != NH_ABSENCE_SETTLED;
}

size_t nh_absence_parts_known(const nh_analysis *r, const char ***name)
{
    const nh_absence *a = r->absence;
    *name = nh_arena_alloc(r->arena, (a->known + 1) * sizeof **name);
    for (size_t i = 0; i < a->known; i++) (*name)[i] = r->list->found[a->known_current[i]].name;
    return a->known;
}
