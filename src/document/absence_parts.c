#include "document/absence_parts.h"

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/print.h"

const nh_absence_attempt *nh_absence_parts_best(const nh_absence *a)
{
    return a->best < a->attempts ? &a->attempt[a->best] : NULL;
}

bool nh_absence_parts_angles(const nh_closed_shape *shape)
{
    bool any = false;
    for (size_t i = 0; shape && i < shape->count; i++) any |= shape->angle[i];
    return any;
}

/* Of an equation of first order. */
static nh_absence_parts_reason by_residue(const nh_residues *residues)
{
    return !residues || residues->verdict == NH_RESIDUE_OPEN ? NH_ABSENCE_BY_NOTHING
           : residues->verdict == NH_RESIDUE_MEROMORPHIC     ? NH_ABSENCE_BY_RESIDUE
                                                             : NH_ABSENCE_BY_IRREGULAR;
}

nh_absence_parts_reason nh_absence_parts_reason_of(const nh_absence *a)
{
    const nh_absence_attempt *t = nh_absence_parts_best(a);
    if (!t) return a->darboux && a->darboux->refuted ? NH_ABSENCE_BY_DARBOUX : NH_ABSENCE_BY_NOTHING;
    if (t->higher && t->higher->refuted) return NH_ABSENCE_BY_LOGARITHM;
    /* over an irregular point the group is larger than that of closed paths, which balls speak of */
    bool special = t->kovacic && t->kovacic->group == NH_GROUP_SL2 && (t->kovacic->regular || a->rational);
    bool triangular = t->kovacic && t->kovacic->group == NH_GROUP_TRIANGULAR;
    if (t->equation->dimension == 1 && by_residue(t->residues) != NH_ABSENCE_BY_NOTHING) return by_residue(t->residues);
    if (special && t->equation->dimension == 2 && t->orbit == 2) return NH_ABSENCE_BY_GROUP;
    if (a->verdict == NH_ABSENCE_LIOUVILLE && special) return NH_ABSENCE_BY_BLOCK;
    if (triangular && (a->verdict == NH_ABSENCE_LIOUVILLE || (t->equation->dimension == 2 && t->orbit == 2)))
        return NH_ABSENCE_BY_TRIANGULAR;
    if (t->monodromy && t->monodromy->rank >= t->orbit) return NH_ABSENCE_BY_MONODROMY;
    return special ? NH_ABSENCE_BY_BLOCK : NH_ABSENCE_BY_NOTHING;
}

const char *nh_absence_parts_short(nh_absence_parts_reason by)
{
    static const char *const words[] = {"Galois group SL(2)",
                                        "a block with the Galois group SL(2)",
                                        "Galois group",
                                        "a residue is not rational",
                                        "an irregular point",
                                        "monodromy, in balls",
                                        "a logarithm of higher order",
                                        "homogeneous potential",
                                        "normal variational equation"};
    return words[by];
}

/* SL(2) as the whole group, and one block of it against commuting integrals, are their own commutator groups. */
bool nh_absence_parts_periodic(const nh_absence *a)
{
    nh_absence_parts_reason by = nh_absence_parts_reason_of(a);
    bool perfect = by == NH_ABSENCE_BY_GROUP || by == NH_ABSENCE_BY_DARBOUX ||
                   (by == NH_ABSENCE_BY_BLOCK && a->verdict == NH_ABSENCE_LIOUVILLE);
    return !a->rational && (a->periodic || (nh_absence_parts_angles(a->shape) && !perfect));
}

const char *nh_absence_parts_group(nh_arena *arena, const nh_absence_attempt *t)
{
    const nh_kovacic *k = t->kovacic;
    static const char *const groups[] = {"SL(2)", "SL(2) or triangular", "open", "undecided"};
    if (k && (k->group == NH_GROUP_SL2 || k->group == NH_GROUP_TRIANGULAR)) return groups[k->group];
    if (t->higher && t->higher->refuted)
        return nh_arena_printf(arena, "connected, and not abelian at order %u", t->higher->order);
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
    for (size_t i = 0; i < a->known; i++) (*name)[i] = nh_absence_current(r, a->known_current[i])->name;
    return a->known;
}
