/* For the files of the graded solver. */
#ifndef NH_GRADED_SOLVER_INTERNAL_H
#define NH_GRADED_SOLVER_INTERNAL_H

#include "count/graded_solver.h"

/* An entry of the symbol; there are millions of them. */
typedef struct {
    uint32_t unknown;
    nh_residue value;
} nh_graded_entry;

typedef struct {
    const nh_graded_problem *p;
    const nh_jet_ring *r;
    nh_prime f;
    nh_arena *arena;
    size_t alphas, betas, terms;
    uint8_t *alpha, *beta; /* exponents of w */
    struct nh_graded_term *t;
    size_t N, before, stride; /* number of parameters now, and before this weight; room for them in a row */
    /* alphas x size x stride: every coefficient in terms of the parameters; then the factors of the a_j times given
     * solutions (left x given) */
    nh_residue *row;
    size_t extensions;     /* their number */
    bool *moves;           /* left x fields: a_j' is not zero along this field */
    nh_residue *condition; /* conditions x stride: on the first `reached` parameters; not used yet */
    size_t conditions, reached;
    double work;
    bool over;      /* a limit was reached */
    double planned; /* the most work that was planned for a weight before it was begun */
    /* of the weight k that is being solved: */
    /* exponents of weight k + 1: their number and the first; equations of weight k */
    size_t k, unknowns_of, first, equations;
    nh_residue *known;       /* equations x N */
    nh_graded_entry *symbol; /* entries by equation */
    size_t *start;           /* equations + 1: index of the first entry of each */
    nh_residue **fresh;      /* conditions found at this weight: rows of `known` that are no longer needed there */
    size_t fresh_count;
} nh_graded_system;

/* The coefficient of z^exponent in c_alpha, in terms of the parameters. */
static inline nh_residue *nh_graded_row(const nh_graded_system *s, size_t alpha, size_t exponent)
{
    return s->row + (alpha * s->r->size + exponent) * s->stride;
}

/* The factor of a product of a_j and a given solution. */
static inline nh_residue *nh_graded_extension(const nh_graded_system *s, size_t index)
{
    return s->row + (s->alphas * s->r->size + index) * s->stride;
}

/* A weight is solved in parts, on several threads.  How many parts there are, and so the work of each, depends on the
 * number of products, and not on the number of threads: the limit of work is reached with one thread where it is with
 * several. */
enum { NH_GRADED_PARTS = 8 };
size_t nh_graded_parts(double products);

/* The known part of an equation: known coefficients, each times a residue. */
typedef struct {
    size_t count, factors, rows; /* factors, rows: room */
    nh_residue *factor;
    const nh_residue **row;
    double work; /* of all sums so far */
} nh_graded_sum;
void nh_graded_sum_add(nh_graded_sum *sum, nh_residue factor, const nh_residue *row);

/* The alpha whose exponents are these, or -1. */
int nh_graded_find_alpha(const nh_graded_system *system, const int *exponents);

/* Each product's factor becomes a parameter. */
void nh_graded_extensions_start(nh_graded_system *system);
/* Adds sum_j a_j' (given solutions) to the equation of beta and this exponent. */
void nh_graded_extend(const nh_graded_system *system, size_t beta, size_t exponent, nh_graded_sum *sum);
/* Is a factor left that need not vanish? */
bool nh_graded_is_extended(const nh_graded_system *system);

/* Makes this coefficient a new parameter. */
void nh_graded_parameter(nh_graded_system *system, size_t alpha, size_t exponent);

/* Solves the equations of weight k for the unknowns of weight k + 1; an equation that the unknowns cannot satisfy
 * becomes a condition on earlier parameters. */
void nh_graded_solve_symbol(nh_graded_system *system);

/* The monomials of Phi and of Gamma(Phi), the terms of Gamma; every c_alpha(0) is a parameter, or every solution that
 * the problem gives. */
void nh_graded_start(nh_graded_system *system);
/* w^i X_i^k d/dz_k,  X_0^k d/dz_k,  and the rates' monomials times d/dw^l, with the series of the ring. */
void nh_graded_list_terms(nh_graded_system *system);

/* Writes the equations of weight s->k: known parts and entries of the symbol. */
void nh_graded_equations(nh_graded_system *system);

/* The equations of weight s->k solved, and the conditions that come from them used or kept; out: N, whether the symbol
   was injective. */
void nh_graded_solve_weight(nh_graded_system *system, nh_graded_count *out);

/* The coefficients that are needed after weight s->k: all up to this weight, or at the end those of the first jets,
 * unless all are kept.  Returns their number, and writes their exponents to out unless that is NULL. */
size_t nh_graded_coefficients_left(const nh_graded_system *system, uint32_t *out);

/* The conditions that are kept are used, if the work allows it. */
void nh_graded_substitute_all(nh_graded_system *system);

/* Uses the remaining conditions, and copies the first jets of the solutions, or all of their coefficients, to out. */
void nh_graded_finish(nh_graded_system *system, nh_graded_count *out);

/* Unknowns of the symbol that occur together, and sparse elimination of their equations: the shortest
 * row and its rarest column first.
 *
 * Most components are small and there are thousands of them: one after the other uses the same memory. */

typedef struct {
    uint32_t column;
    nh_residue value;
} nh_graded_cell;

typedef struct {
    size_t count, capacity;
    uint32_t *item;
} nh_graded_row_list;

/* The remaining rows by their length, in lists: a row's number plus 1, or 0 at the end. */
typedef struct {
    size_t least; /* no row is shorter */
    uint32_t *first, *next, *previous;
} nh_graded_lengths;

typedef struct {
    size_t rows, columns, rank;
    size_t *equation;               /* of each row */
    size_t *unknown;                /* of each column */
    nh_graded_cell **cells, *spare; /* spare: a replaced row whose memory serves the next one */
    size_t *room, spare_room;       /* length of each row; room of the spare one */
    size_t *length, *count;         /* number of entries of each row; number of remaining rows that have this column */
    bool *done, *pivoted;           /* rows used as pivots; columns */
    size_t *pivot_row, *pivot_column;
    nh_residue *inverse;        /* by which the row's known part is still to be multiplied */
    nh_graded_row_list *member; /* for each column: the rows that have it or had it, some more than once */
    nh_graded_lengths rest;
    double work; /* of all components so far */
} nh_graded_component;

/* Room for components of at most so many rows and columns; nh_graded_component_clear takes the same numbers. */
void nh_graded_component_init(nh_graded_component *component, size_t rows, size_t columns);
void nh_graded_component_clear(nh_graded_component *component, size_t rows, size_t columns);

/* Eliminates: afterwards row pivot_row[t] has the entry 1 at column pivot_column[t], t < rank, and its other entries
 * are at columns with a later pivot or without one.  The other rows have no entries, and their known parts are
 * conditions.
 * The caller has set rows, columns, equation and unknown; `place`: the column of each unknown. */
void nh_graded_component_solve(const nh_graded_system *system, nh_graded_component *component, const size_t *place);

#endif
