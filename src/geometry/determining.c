/* determining: coefficients by exact derivatives; a term whose coefficient vanishes is left out. */
#include "geometry/determining.h"

#include "exact/normal.h"
#include "graph/dag.h"

enum { large_length = 3000 };

typedef struct {
    const nh_model *o;
    nh_determining_equation *e;
} writer;

static void add(writer *w, nh_ex coefficient, nh_determining_operator along, nh_determining_unknown of, size_t index)
{
    coefficient = nh_simplify_short(w->o->dag, coefficient, large_length);
    if (nh_is_zero(w->o->dag, coefficient)) return;
    w->e->term[w->e->terms++] = (nh_determining_term){coefficient, along, w->e->direction, of, index};
}

static nh_ex along(const nh_model *o, nh_determining_operator op, size_t l, nh_ex e)
{
    if (op == NH_DETERMINING_X0) return nh_model_X0(o, e);
    if (op == NH_DETERMINING_X) return nh_model_X(o, l, e);
    return op == NH_DETERMINING_Y ? nh_model_Y(o, l, e) : e;
}

/* C_i of (14)-(16). */
static nh_ex slope(const nh_model *o, nh_determining_operator op, size_t l, size_t i)
{
    nh_dag *d = o->dag;
    nh_ex e = along(o, op, l, o->pbar[i]);
    if (op == NH_DETERMINING_X0) return nh_add(d, e, o->A[i]);
    return op == NH_DETERMINING_X ? nh_add(d, e, nh_model_G(o)[i * o->n + l]) : nh_sub(d, e, o->M[i * o->n + l]);
}

/* (14), (15), (16) for op = X_0, X_l, Y_l. */
static void expanded(writer *w, const nh_determining *all, nh_determining_operator op)
{
    const nh_model *o = w->o;
    nh_dag *d = o->dag;
    size_t l = w->e->direction, n = o->n;
    nh_determining_unknown Z = all->by_Z ? NH_DETERMINING_Z : NH_DETERMINING_ZETA;
    nh_ex outer = o->Lbar, inner = along(o, op, l, o->Lbar);
    if (op == NH_DETERMINING_X) inner = nh_sub(d, inner, o->A[l]);
    if (op == NH_DETERMINING_Y && all->by_Z) inner = nh_sub(d, inner, o->pbar[l]);
    for (size_t i = 0; i < n && all->by_Z; i++) {
        outer = nh_sub(d, outer, nh_mul(d, o->pbar[i], o->chart->w[i]));
        inner = nh_sub(d, inner, nh_mul(d, o->chart->w[i], slope(o, op, l, i)));
    }
    add(w, inner, NH_DETERMINING_PLAIN, NH_DETERMINING_Z0, 0);
    for (size_t i = 0; i < n; i++) add(w, slope(o, op, l, i), NH_DETERMINING_PLAIN, Z, i);
    for (size_t i = 0; i < n && op == NH_DETERMINING_X; i++)
        add(w, o->M[i * n + l], NH_DETERMINING_PLAIN, NH_DETERMINING_W, i);
    add(w, outer, op, NH_DETERMINING_Z0, 0);
    for (size_t i = 0; i < n; i++) add(w, o->pbar[i], op, Z, i);
}

/* (17), (18), (19). */
static void by_current(writer *w, nh_determining_operator op)
{
    const nh_model *o = w->o;
    nh_dag *d = o->dag;
    size_t l = w->e->direction, n = o->n;
    add(w, nh_int(d, 1), op, NH_DETERMINING_PHI, 0);
    if (op == NH_DETERMINING_X) add(w, nh_neg(d, o->A[l]), NH_DETERMINING_PLAIN, NH_DETERMINING_Z0, 0);
    for (size_t i = 0; i < n; i++) {
        nh_ex e = op == NH_DETERMINING_X0  ? o->A[i]
                  : op == NH_DETERMINING_X ? nh_model_G(o)[i * n + l]
                                           : nh_neg(d, o->M[i * n + l]);
        add(w, e, NH_DETERMINING_PLAIN, NH_DETERMINING_ZETA, i);
    }
    for (size_t i = 0; i < n && op == NH_DETERMINING_X; i++)
        add(w, o->M[i * n + l], NH_DETERMINING_PLAIN, NH_DETERMINING_W, i);
}

nh_determining *nh_determining_of(nh_arena *arena, const nh_model *o)
{
    static const nh_determining_operator op[] = {NH_DETERMINING_X0, NH_DETERMINING_X, NH_DETERMINING_Y};
    nh_determining *all = nh_arena_alloc(arena, sizeof *all);
    *all = (nh_determining){.model = o,
                            .by_Z = !o->chart->quasi,
                            .equation = nh_arena_alloc(arena, (2 + 4 * o->n) * sizeof *all->equation)};
    for (int number = 14; number <= 19; number++) {
        size_t kind = (size_t)(number - 14) % 3, lines = kind ? o->n : 1;
        for (size_t l = 0; l < lines; l++) {
            nh_determining_equation *e = &all->equation[all->count++];
            *e = (nh_determining_equation){number, l, 0, nh_arena_alloc(arena, (3 * o->n + 2) * sizeof *e->term)};
            writer w = {o, e};
            if (number < 17) expanded(&w, all, op[kind]);
            else by_current(&w, op[kind]);
        }
    }
    return all;
}
