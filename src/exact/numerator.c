/* numerator: expressions from the parts of their normal form: without poles, written out as a sum, and their sign. */
#include "exact/print_quotient.h"
#include "exact/form.h"
#include "exact/normal.h"
#include "graph/num.h"

enum { most_terms = 2000 };

/* A normal form split into parts. */
typedef struct {
    nh_forms forms;
    nh_form form;
    nh_pieces pieces;
    nh_arena *arena;
} taken;

/* False: it is too long; close it in any case. */
static bool take_apart(nh_dag *dag, nh_ex e, taken *x)
{
    x->arena = nh_arena_create();
    nh_forms_init(&x->forms, dag, false, most_terms);
    return nh_form_make(&x->forms, e, true, &x->form) == NH_FIELD_FINE &&
           nh_pieces_make(x->form.field, x->arena, x->form.value, false, &x->pieces);
}

static void close_pieces(taken *x)
{
    nh_form_clear(&x->form);
    nh_forms_clear(&x->forms);
    nh_arena_free(x->arena);
}

/* Drops everything below the fraction bar. */
static void keep_numerator(nh_pieces *pieces)
{
    for (size_t g = 0; g < pieces->generators; g++)
        if (pieces->exponent[g] < 0) pieces->exponent[g] = 0;
    size_t kept = 0;
    for (size_t j = 0; j < pieces->factors; j++)
        if (pieces->factor[j].power > 0) pieces->factor[kept++] = pieces->factor[j];
    pieces->factors = kept;
}

nh_ex nh_numerator(nh_dag *dag, nh_ex e)
{
    taken x;
    nh_ex result = e;
    if (take_apart(dag, e, &x)) {
        keep_numerator(&x.pieces);
        nh_ex top = nh_print_quotient_product(&x.form.kernels, &x.pieces, false);
        if (nh_is_short(dag, top)) result = top;
    }
    close_pieces(&x);
    return result;
}

/* ---- the sum that equal expressions share ---- */

nh_ex nh_canonical_sum(nh_dag *dag, nh_ex e)
{
    taken x;
    nh_ex result = e;
    if (take_apart(dag, e, &x)) {
        nh_ex sum = nh_print_quotient_terms(&x.form.kernels, &x.pieces);
        if (nh_is_short(dag, sum)) result = sum;
    }
    close_pieces(&x);
    return result;
}

int nh_canonical_sign(nh_dag *dag, nh_ex e)
{
    taken x;
    int sign = 1;
    if (take_apart(dag, e, &x)) {
        if (nh_num_value(x.pieces.constant) < 0) sign = -1;
        for (size_t j = 0; j < x.pieces.factors; j++)
            if (x.pieces.factor[j].power % 2 && nh_num_value(x.pieces.factor[j].coefficient[0]) < 0) sign = -sign;
    }
    close_pieces(&x);
    return sign;
}
