/* determining: coefficients by exact derivatives; a term whose coefficient vanishes is left out. */
#include "geometry/determining.h"

#include "exact/normal.h"
#include "graph/dag.h"

enum { large_length = 3000 };

typedef struct {
    const nh_model *o;
    nh_determining_equation *e;
} writer;

/* A term of the equation, unless its coefficient is zero. */
static void add(writer *w, nh_ex coefficient, nh_determining_operator along, nh_determining_unknown of, size_t index)
{
    coefficient = nh_simplify_short(w->o->dag, coefficient, large_length);
    if (nh_is_zero(w->o->dag, coefficient)) return;
    w->e->term[w->e->terms++] = (nh_determining_term){coefficient, along, w->e->direction, of, index};
}

/* X_0(e), X_l(e), Y_l(e), or e itself. */
static nh_ex along(const nh_model *model, nh_determining_operator op, size_t l, nh_ex e)
{
    if (op == NH_DETERMINING_X0) return nh_model_X0(model, e);
    if (op == NH_DETERMINING_X) return nh_model_X(model, l, e);
    return op == NH_DETERMINING_Y ? nh_model_Y(model, l, e) : e;
}

/* C_i of (14)-(16). */
static nh_ex slope(const nh_model *model, nh_determining_operator op, size_t l, size_t i)
{
    nh_dag *d = model->dag;
    nh_ex e = along(model, op, l, model->pbar[i]);
    if (op == NH_DETERMINING_X0) return nh_add(d, e, model->A[i]);
    return op == NH_DETERMINING_X ? nh_add(d, e, nh_model_G(model)[i * model->n + l])
                                  : nh_sub(d, e, model->M[i * model->n + l]);
}

/* (14), (15), (16) for op = X_0, X_l, Y_l. */
static void expanded(writer *w, const nh_determining *all, nh_determining_operator op)
{
    const nh_model *model = w->o;
    nh_dag *d = model->dag;
    size_t l = w->e->direction, n = model->n;
    nh_determining_unknown Z = all->by_Z ? NH_DETERMINING_Z : NH_DETERMINING_ZETA;
    nh_ex outer = model->Lbar, inner = along(model, op, l, model->Lbar);
    if (op == NH_DETERMINING_X) inner = nh_sub(d, inner, model->A[l]);
    if (op == NH_DETERMINING_Y && all->by_Z) inner = nh_sub(d, inner, model->pbar[l]);
    for (size_t i = 0; i < n && all->by_Z; i++) {
        outer = nh_sub(d, outer, nh_mul(d, model->pbar[i], model->chart->w[i]));
        inner = nh_sub(d, inner, nh_mul(d, model->chart->w[i], slope(model, op, l, i)));
    }
    add(w, inner, NH_DETERMINING_PLAIN, NH_DETERMINING_Z0, 0);
    for (size_t i = 0; i < n; i++) add(w, slope(model, op, l, i), NH_DETERMINING_PLAIN, Z, i);
    for (size_t i = 0; i < n && op == NH_DETERMINING_X; i++)
        add(w, model->M[i * n + l], NH_DETERMINING_PLAIN, NH_DETERMINING_W, i);
    add(w, outer, op, NH_DETERMINING_Z0, 0);
    for (size_t i = 0; i < n; i++) add(w, model->pbar[i], op, Z, i);
}

/* (17), (18), (19). */
static void by_current(writer *w, nh_determining_operator op)
{
    const nh_model *model = w->o;
    nh_dag *d = model->dag;
    size_t l = w->e->direction, n = model->n;
    add(w, nh_int(d, 1), op, NH_DETERMINING_PHI, 0);
    if (op == NH_DETERMINING_X) add(w, nh_neg(d, model->A[l]), NH_DETERMINING_PLAIN, NH_DETERMINING_Z0, 0);
    for (size_t i = 0; i < n; i++) {
        nh_ex e = op == NH_DETERMINING_X0  ? model->A[i]
                  : op == NH_DETERMINING_X ? nh_model_G(model)[i * n + l]
                                           : nh_neg(d, model->M[i * n + l]);
        add(w, e, NH_DETERMINING_PLAIN, NH_DETERMINING_ZETA, i);
    }
    for (size_t i = 0; i < n && op == NH_DETERMINING_X; i++)
        add(w, model->M[i * n + l], NH_DETERMINING_PLAIN, NH_DETERMINING_W, i);
}

nh_determining *nh_determining_of(nh_arena *arena, const nh_model *model)
{
    static const nh_determining_operator op[] = {NH_DETERMINING_X0, NH_DETERMINING_X, NH_DETERMINING_Y};
    nh_determining *all = nh_arena_alloc(arena, sizeof *all);
    *all = (nh_determining){.model = model,
                            .by_Z = !model->chart->quasi,
                            .equation = nh_arena_alloc(arena, (2 + 4 * model->n) * sizeof *all->equation)};
    for (int number = 14; number <= 19; number++) {
        size_t kind = (size_t)(number - 14) % 3, lines = kind ? model->n : 1;
        for (size_t l = 0; l < lines; l++) {
            nh_determining_equation *e = &all->equation[all->count++];
            *e = (nh_determining_equation){number, l, 0, nh_arena_alloc(arena, (3 * model->n + 2) * sizeof *e->term)};
            writer w = {model, e};
            if (number < 17) expanded(&w, all, op[kind]);
            else by_current(&w, op[kind]);
        }
    }
    return all;
}
