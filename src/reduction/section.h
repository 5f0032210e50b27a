/* section: the coefficients of combinations of fields, as expressions of the parameters.
 *
 *     sum_j c_j e_j = 0,     e_j: the conditions on field j, told apart by symbols of their own
 *
 * c is known in doubles, at the parameters' values; the relation is solved again with the parameters as symbols, which
 * is the proof of what the conditions are for.  Where that is too large the numbers are recognised, and the sum is
 * proved to vanish, or not. */
#ifndef NH_SECTION_H
#define NH_SECTION_H

#include "integrals/prove.h"
#include "reduction/kinetic.h"

/* sum_i mark[i] e[i] */
nh_ex nh_section_marked(nh_dag *dag, size_t n, const nh_ex *mark, const nh_ex *e);
/* n new symbols. */
void nh_section_marks(nh_dag *dag, size_t n, nh_ex *mark);

/* v and c have n entries; zero entries of v stay zero, and v[pivot] stays 1. */
nh_proof nh_section_coefficients(const nh_kinetic *kinetic, size_t n, const nh_ex *e, const double *v, size_t pivot,
                                 const nh_options *options, nh_ex *c);

/* The first entry that is 1, or the largest. */
size_t nh_section_pivot(size_t n, const double *v);

/* All constants c with sum_j c_j e_ij = 0 identically, for every row i, at the parameters' values: *count of them,
 * `columns` entries each, in the kinetic's arena; numbers are exact.  entry[j * rows + i], functions of positions,
 * velocities (also of the chart), and time.  NULL where this is not known: the formulas have no residues, or relations
 * were not confirmed. */
nh_ex *nh_section_relations(const nh_kinetic *kinetic, size_t columns, size_t rows, const nh_ex *entry,
                            const nh_options *options, size_t *count);
/* The same as doubles into c (columns x count), in reduced echelon form from the first column on; false: not known. */
bool nh_section_combinations(const nh_kinetic *kinetic, size_t columns, size_t rows, const nh_ex *entry,
                             const nh_options *options, double *c, size_t *count);

/* Is the number in front of it negative? */
bool nh_section_negative(const nh_dag *dag, nh_ex e);

#endif
