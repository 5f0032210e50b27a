/* jet_conditions: the conditions on the 1-jet (xi, B) of a symmetry at one point (jets.h), as rows of a linear system.
 *
 * There is one column per jet, in the scaled coordinates of transport.h.  The rows of each kind are in
 * a list of their own, so that a kind can be left out. */
#ifndef NH_JET_CONDITIONS_H
#define NH_JET_CONDITIONS_H

#include "reduction/transport.h"

/* of the metric: with the triangles */
typedef enum { NH_OF_METRIC, NH_OF_POTENTIAL, NH_OF_CONSTRAINTS, NH_CONDITION_KINDS } nh_condition_kind;

typedef struct {
    const nh_kinetic *kinetic;
    const nh_options *options;
    nh_transport t;
    nh_tape *tape; /* V's gradient and second derivatives, omega and its derivatives, b, a and theirs */
    nh_tape_work *work;
    nh_tape *force; /* Q and its derivatives by q and v, of both; NULL without forces */
    nh_tape_work *force_work;
    double *out, *x;
    size_t m, f, columns;
    size_t rows[NH_CONDITION_KINDS], capacity[NH_CONDITION_KINDS];
    double *row[NH_CONDITION_KINDS]; /* row by row */
} nh_jet_conditions;

/* q0 fixes the scales; m(m+1)/2 columns. */
void nh_jet_conditions_init(nh_jet_conditions *conditions, const nh_kinetic *kinetic, const nh_options *options,
                            const double *q0);
void nh_jet_conditions_clear(nh_jet_conditions *conditions);

/* Appends a row of `columns` numbers, and returns it. */
double *nh_jet_conditions_row(nh_jet_conditions *conditions, nh_condition_kind kind);
/* Appends rows of all kinds at the place q (true coordinates), at which the jets are given (columns of length m + m^2);
 * false when the metric is not finite there. */
bool nh_jet_conditions_at(nh_jet_conditions *conditions, const double *q, const double *jets);

/* The columns' combinations that satisfy the rows of the metric and those asked for: basis (columns x columns at most);
 * returns how many: `dimension`, where that is known (else SIZE_MAX).  The singular values on both sides of the cut,
 * where they are wanted. */
size_t nh_jet_conditions_kernel(const nh_jet_conditions *conditions, bool potential, bool constraints, size_t dimension,
                                double *basis, double *last, double *first);
/* The rows of the metric with a larger threshold: unnecessary jets are removed later. */
size_t nh_jet_conditions_kernel_generous(const nh_jet_conditions *conditions, double *basis);
/* From now on the columns are combinations of those so far: basis (columns x kept). */
void nh_jet_conditions_restrict(nh_jet_conditions *conditions, size_t kept, const double *basis);

#endif
