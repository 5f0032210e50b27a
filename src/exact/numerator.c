/* numerator: expressions from the pieces of their normal form: without poles, written out as a sum, their sign. */
#include "exact/print_quotient.h"
#include "exact/form.h"
#include "exact/normal.h"

enum { most_terms = 2000 };

/* Everything below the fraction bar is dropped. */
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
    nh_forms forms;
    nh_form form;
    nh_pieces pieces;
    nh_arena *arena = nh_arena_create();
    nh_forms_init(&forms, dag, false, most_terms);
    nh_quotient_field_state state = nh_form_make(&forms, e, true, &form);
    nh_ex result = e;
    if (state == NH_FIELD_FINE && nh_pieces_make(form.field, arena, form.value, false, &pieces)) {
        keep_numerator(&pieces);
        nh_ex top = nh_print_quotient_product(&form.kernels, &pieces, false);
        if (nh_is_short(dag, top)) result = top;
    }
    nh_form_clear(&form);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    return result;
}

/* ---- the same for equal expressions ---- */

nh_ex nh_canonical_sum(nh_dag *dag, nh_ex e)
{
    nh_forms forms;
    nh_form form;
    nh_pieces pieces;
    nh_ex result = e;
    nh_arena *arena = nh_arena_create();
    nh_forms_init(&forms, dag, false, most_terms);
    if (nh_form_make(&forms, e, true, &form) == NH_FIELD_FINE &&
        nh_pieces_make(form.field, arena, form.value, false, &pieces)) {
        nh_ex sum = nh_print_quotient_terms(&form.kernels, &pieces);
        if (nh_is_short(dag, sum)) result = sum;
    }
    nh_form_clear(&form);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    return result;
}

int nh_canonical_sign(nh_dag *dag, nh_ex e)
{
    nh_forms forms;
    nh_form form;
    nh_pieces pieces;
    int sign = 1;
    nh_arena *arena = nh_arena_create();
    nh_forms_init(&forms, dag, false, most_terms);
    if (nh_form_make(&forms, e, true, &form) == NH_FIELD_FINE &&
        nh_pieces_make(form.field, arena, form.value, false, &pieces)) {
        if (nh_num_value(pieces.constant) < 0) sign = -1;
        for (size_t j = 0; j < pieces.factors; j++)
            if (pieces.factor[j].power % 2 && nh_num_value(pieces.factor[j].coefficient[0]) < 0) sign = -sign;
    }
    nh_form_clear(&form);
    nh_forms_clear(&forms);
    nh_arena_free(arena);
    return sign;
}
