/* jet_eval: expressions as power series at a point (jet_point.h).
 *
 * Symbols are set to series; whatever does not depend on the symbols that vary is computed once. */
#ifndef NH_JET_EVAL_H
#define NH_JET_EVAL_H

#include "exact/jet_point.h"
#include "exact/jet_ring.h"

typedef struct nh_jet_eval nh_jet_eval;

/* Borrows both.  All expressions that will be evaluated must have been registered at the point. */
nh_jet_eval *nh_jet_eval_create(nh_jet_point *point, const nh_jet_ring *ring);
void nh_jet_eval_free(nh_jet_eval *eval);

/* The series is copied.  `varies`: what depends on this symbol is computed anew after it is set again. */
void nh_jet_eval_set(nh_jet_eval *eval, nh_ex symbol, const nh_residue *series, bool varies);

/* out: n series one after another.  False where the point is no regular one (a pole, a root that does not exist): take
   another. */
bool nh_jet_eval_all(nh_jet_eval *eval, size_t n, const nh_ex *e, nh_residue *out);

/* The atoms of exp with the logarithms and inverse hyperbolic functions (`real`), or those of sin and cos with the
 * inverse trigonometric ones, as series without constant terms, one after another into `out` (NULL: only their number).
 * False as above. */
bool nh_jet_eval_atoms(nh_jet_eval *eval, bool real, size_t *count, nh_residue *out);

#endif
