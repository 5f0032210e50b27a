/* monodromy_internal: singular points, paths, transition matrices, and what they prove. */
#ifndef NH_MONODROMY_INTERNAL_H
#define NH_MONODROMY_INTERNAL_H

#include <stdint.h>

#include "absence/monodromy.h"
#include "evaluate/arb.h"

/* One of the equations; every row has its own denominator, reduced. */
typedef struct {
    size_t size;
    fmpz_poly_struct *num; /* size x size */
    fmpz_poly_struct *den; /* size */
    ulong *order;          /* size x points: of the zero of den at the singular point */
} nh_monodromy_block;

/* A direct sum with the singular points of all of its blocks. */
typedef struct {
    long bits;
    size_t size, blocks, points;
    nh_monodromy_block *block;
    acb_ptr point;  /* balls, disjoint */
    size_t steps;   /* Taylor steps done */
    uint64_t work;  /* products of complex numbers done, times their words of 64 bits */
    uint64_t limit; /* of work */
} nh_monodromy_sum;

/* Vertices of a polygon, exact numbers. */
typedef struct {
    size_t count, capacity;
    acb_ptr vertex;
} nh_monodromy_path;

/* An element of the group, or of its Lie algebra: one matrix per block. */
typedef acb_mat_struct *nh_monodromy_element;

/* False: the singular points were not separated.  Cleared by the caller in any case, as all of the following. */
bool nh_monodromy_sum_init(nh_monodromy_sum *sum, size_t blocks, const nh_linear_equation *block, long bits);
void nh_monodromy_sum_clear(nh_monodromy_sum *sum);
nh_monodromy_element nh_monodromy_element_new(const nh_monodromy_sum *sum); /* of identities */
void nh_monodromy_element_free(const nh_monodromy_sum *sum, nh_monodromy_element element);

/* The matrix that takes Y(z) to Y(z + h) along the straight line, rigorous.  z and h are exact.  False: it is not
 * known that the line meets no singular point, or the limit of work is reached. */
bool nh_monodromy_line(nh_monodromy_sum *sum, size_t b, const acb_t z, const acb_t h, acb_mat_t T);
/* Taylor's series for one step of it, see monodromy_step.c.  NH_MONODROMY_SHORTER: half of h, please. */
typedef enum { NH_MONODROMY_DONE, NH_MONODROMY_SHORTER, NH_MONODROMY_FAILED } nh_monodromy_outcome;
nh_monodromy_outcome nh_monodromy_step(nh_monodromy_sum *sum, size_t b, const acb_t z, const acb_t h, acb_mat_t T);

/* Where all loops begin and end, exact. */
void nh_monodromy_base(const nh_monodromy_sum *sum, acb_t base);
/* From the base to a circle around the point, and once around it, counterclockwise; the second path is closed. */
bool nh_monodromy_paths(const nh_monodromy_sum *sum, size_t point, nh_monodromy_path *go, nh_monodromy_path *around);
void nh_monodromy_path_clear(nh_monodromy_path *path);
/* The monodromy along the loop around the point.  False: the work is exhausted, or precision was lost. */
bool nh_monodromy_loop(nh_monodromy_sum *sum, size_t point, nh_monodromy_element loop);

/* What the loops prove. */
typedef struct {
    size_t rank, words; /* dimension that an orbit has at least; elements of the Lie algebra that show it */
    bool simple;        /* some word had certified simple eigenvalues */
    bool moduli;        /* some multiplier had an absolute value other than 1, certified */
    bool inaccurate;    /* more bits may help */
} nh_monodromy_proof;

void nh_monodromy_prove(const nh_monodromy_sum *sum, const nh_monodromy_element *loop, nh_monodromy_proof *proof);

#endif
