/* jet_eval: expressions as power series at a point (jet_point.h).
 *
 * Symbols are set to series; subexpressions that do not depend on the symbols that vary are computed once. */
#ifndef NH_JET_EVAL_H
#define NH_JET_EVAL_H

#include "exact/jet_point.h"
#include "exact/jet_ring.h"

typedef struct nh_jet_eval nh_jet_eval;

/* Borrows ring and point; nh_jet_eval_free.  All expressions that will be evaluated must have been registered at the
 * point. */
nh_jet_eval *nh_jet_eval_create(nh_jet_point *point, const nh_jet_ring *ring);
void nh_jet_eval_free(nh_jet_eval *eval);

/* Sets a symbol to a series, which is copied.  `varies`: it will be set again, and what depends on it is then computed
 * anew. */
void nh_jet_eval_set(nh_jet_eval *eval, nh_ex symbol, const nh_residue *series, bool varies);

/* Writes n series one after another into out.  False where the point is not regular (a pole, a root that does not
 * exist): take another point. */
bool nh_jet_eval_all(nh_jet_eval *eval, size_t n, const nh_ex *e, nh_residue *out);

/* The atoms of exp with the logarithms and inverse hyperbolic functions (`real`), or those of sin and cos with the
 * inverse trigonometric ones, as series without constant terms, one after another into `out` (NULL: only their number).
 * False as above. */
bool nh_jet_eval_atoms(nh_jet_eval *eval, bool real, size_t *count, nh_residue *out);

#endif
