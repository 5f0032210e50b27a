#include "absence/polynomial_text.h"

#include <stdbool.h>

#include "base/text.h"

/* One term behind others, its sign between. */
static void add_term(nh_text *text, const fmpq_t coefficient, slong power, const char *variable)
{
    bool negative = fmpq_sgn(coefficient) < 0, first = !text->length;
    fmpq_t size;
    fmpq_init(size);
    fmpq_abs(size, coefficient);
    bool unit = fmpq_is_one(size) && power > 0;
    char *number = fmpq_get_str(NULL, 10, size);
    nh_text_add(text, first ? (negative ? "-" : "") : negative ? " - " : " + ");
    if (!unit) nh_text_addf(text, "%s%s", number, power > 0 ? "*" : "");
    if (power > 0) nh_text_add(text, variable);
    if (power > 1) nh_text_addf(text, "^%ld", (long)power);
    flint_free(number);
    fmpq_clear(size);
}

const char *nh_polynomial_text(nh_arena *arena, const fmpq_poly_t f, const char *variable)
{
    nh_text text;
    fmpq_t coefficient;
    nh_text_init(&text);
    fmpq_init(coefficient);
    for (slong i = fmpq_poly_degree(f); i >= 0; i--) {
        fmpq_poly_get_coeff_fmpq(coefficient, f, i);
        if (!fmpq_is_zero(coefficient)) add_term(&text, coefficient, i, variable);
    }
    const char *out = nh_arena_strdup(arena, text.length ? nh_text_string(&text) : "0");
    fmpq_clear(coefficient);
    nh_text_clear(&text);
    return out;
}

const char *nh_polynomial_text_whole(nh_arena *arena, const fmpz_poly_t f, const char *variable)
{
    fmpq_poly_t g;
    fmpq_poly_init(g);
    fmpq_poly_set_fmpz_poly(g, f);
    const char *out = nh_polynomial_text(arena, g, variable);
    fmpq_poly_clear(g);
    return out;
}
