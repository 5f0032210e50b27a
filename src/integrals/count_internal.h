/* For the files of the count. */
#ifndef NH_COUNT_INTERNAL_H
#define NH_COUNT_INTERNAL_H

#include "integrals/count.h"

/* One point: everything that does not depend on degree and order. */
typedef struct {
    const nh_count_question *q;
    nh_jet_equations *equations;
    nh_adapted_frame *frame;
    size_t known, *degree;   /* 0: not polynomial in the velocities, or depending on a time that is no coordinate */
    size_t *failed;          /* at how many points they could not be evaluated */
    nh_ex *current, *slope;  /* slope: d current/d w, n each */
    double work;
} nh_counter;

/* Differentials at one point (z = 0, w), as rows: along the coordinates, then along the velocities. */
typedef struct {
    size_t n, kept, rows, capacity;
    nh_residue *w, *row; /* n; rows x (kept + n) */
} nh_differentials;

/* Find the degrees of the known integrals, and leave out those without values.  False: another point is needed. */
bool nh_count_take_known(nh_counter *counter);

/* The rank of their products up to a degree; row->known and row->lower.  False as above. */
bool nh_count_products(nh_counter *counter, const nh_jet_ring *ring, const nh_residue *coordinate, size_t degree, nh_count_row *row);

/* Add the differentials of all solutions, or of the known integrals of any degree. */
void nh_count_solutions_differ(const nh_graded_count *count, nh_prime field, nh_differentials *d);
bool nh_count_known_differ(nh_counter *counter, const nh_jet_ring *ring, const nh_residue *coordinate, nh_differentials *d);
size_t nh_count_rank(const nh_differentials *d, nh_prime field);

#endif
