/* relation_rows: the equations of relation_solve.h, one per monomial, and their rank modulo a prime. */
#ifndef NH_RELATION_ROWS_H
#define NH_RELATION_ROWS_H

#include "exact/normal_quotient.h"

/* The field and the expressions of the unknowns. */
typedef struct {
    nh_quotient_field *field;
    /* generator -> is it a coefficient?  The expressions in a constant's relation must be constant */
    const bool *constant;
    size_t n;
    const nh_quotient **value; /* N_j, without denominators */
} nh_relation_system;

/* A term of N_column. */
typedef struct {
    size_t column;
    long index;
    const uint32_t *monomial; /* exponents of the variable generators */
    uint64_t residue;         /* value of the constant part at the point */
} nh_relation_term;

/* The terms with one monomial. */
typedef struct {
    size_t first, last;
    size_t columns, terms; /* within the support, at the last ordering */
} nh_relation_row;

typedef struct nh_relation_rows {
    const nh_relation_system *system;
    size_t width, terms, rows;
    uint32_t *exponent;
    nh_relation_term *term;
    nh_relation_row *row;
    uint64_t *value; /* values of the constant generators at the point */
    uint64_t prime, random;
} nh_relation_rows;

void nh_relation_rows_init(nh_relation_rows *rows, const nh_relation_system *system);
void nh_relation_rows_clear(nh_relation_rows *rows);

/* Chooses random values for the constants, modulo a prime after rows->prime, that satisfy their relations.  False: none
 * were found. */
bool nh_relation_rows_choose_point(nh_relation_rows *rows);

/* The rank of the columns in `support` at the point; `chosen` gets that many independent rows, the sparsest.  With rank
 * one less than the columns, `support` is restricted to the nonzero entries of the null vector. */
size_t nh_relation_rows_rank(nh_relation_rows *rows, bool *support, size_t *chosen);

/* Is the last column a combination of those before it?  Then `support` becomes that column and those that the
 * combination needs, the first ones possible. */
bool nh_relation_rows_last(nh_relation_rows *rows, bool *support);

/* The coefficient of an unknown in an equation, NULL when there is none. */
const nh_quotient *nh_relation_rows_entry(const nh_relation_rows *rows, size_t row, size_t column);

#endif
