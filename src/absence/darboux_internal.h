/* darboux_internal: the potential, as the files that look for lines share it. */
#ifndef NH_DARBOUX_INTERNAL_H
#define NH_DARBOUX_INTERNAL_H

#include <flint/fmpq_mat.h>
#include <flint/fmpq_poly.h>

#include "absence/darboux.h"

enum { NH_DARBOUX_MOST = 12 }; /* coordinates */

typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    size_t n;
    nh_ex q[NH_DARBOUX_MOST], v[NH_DARBOUX_MOST];
    nh_ex potential; /* of degree k, parameters at their values */
    nh_ex slope[NH_DARBOUX_MOST], second[NH_DARBOUX_MOST * NH_DARBOUX_MOST];
    fmpq_mat_t inertia, inverse;
    bool plane;                  /* all lines of a polynomial in two coordinates were tried */
    bool triangle;               /* otherwise: a triangle refutes */
    nh_ex line[NH_DARBOUX_MOST]; /* otherwise: that refutes */
    nh_darboux *out;
} nh_darboux_work;

/* Notes a line and one of its eigenvalues that is not allowed; the first one remains. */
void nh_darboux_refute(nh_darboux_work *w, const char *point, const char *eigenvalue);
/* Is c on a line, and what are its eigenvalues?  Its words; NULL: its coordinates, which are numbers. */
void nh_darboux_try(nh_darboux_work *w, const nh_ex *c, const char *words);
/* The equilateral triangle of three bodies, whose coordinates stand together: (x_1, y_1, x_2, ..) or with a third axis.
 * Its place for this inertia (n x n), of which the centre of mass is 0; false: these are no three bodies. */
void nh_darboux_triangle(nh_darboux_work *w);
bool nh_darboux_triangle_place(nh_dag *dag, size_t n, const nh_ex *inertia, nh_ex *c);
/* All lines (1, s) of a polynomial in two coordinates; false: it is none, or every direction is a line. */
bool nh_darboux_plane(nh_darboux_work *w);

/* Powers with rational exponents of the symbols and of numbers, and nothing else?  Sets *roots where the exponent of
 * something else than a number is no whole number. */
bool nh_darboux_algebraic(const nh_dag *dag, size_t symbols, const nh_ex *symbol, nh_ex e, bool *roots);
/* The degree of e in the symbols where all terms of its sums have one degree; e loses its constant terms. */
bool nh_darboux_degree(nh_dag *dag, size_t n, const nh_ex *symbol, nh_ex *e, nh_num *k);
/* Of a system that is refuted: so too for all values of the parameters but countably many hypersurfaces? */
bool nh_darboux_generic(const nh_darboux_work *w, const nh_system *system);

#endif
