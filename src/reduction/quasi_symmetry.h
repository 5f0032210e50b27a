/* quasi_symmetry: symmetries of the equations of motion that change L by a total derivative, d phi/dt.
 *
 * For L = 1/2 v K v + a v - V these are the fields that leave K, the constraints, the forces, dV and da alone; the same
 * as the symmetries of the system
 *
 *     L' = 1/2 v K v,      Q'_s = Q_s - d_s V + (d_s a_r - d_r a_s) v^r
 *
 * which has the same motions.  Where xi lies in D and no force Q acts along it,
 *
 *     J = xi . (K v + a) - phi_0 + t xi(V),      d phi_0 = L_xi a,      xi(V) constant                  [Noether],
 *     [docs/method.md, sec. 9]
 *
 * is conserved. */
#ifndef NH_QUASI_SYMMETRY_H
#define NH_QUASI_SYMMETRY_H

#include "reduction/momenta.h"

/* The same system with its potential and magnetic terms as forces; lives as long as `kinetic`, and is not freed by
   itself.  For kinetic->general only. */
nh_kinetic *nh_quasi_symmetry_kinetic(const nh_kinetic *kinetic);
/* Conserved quantities of constant combinations of the generators of a group of the weak kinetic; `kinetic` is the true
 * one.  Only those are found whose phi_0 is a polynomial of degree at most two. */
void nh_quasi_symmetry_momenta(nh_momenta *out, const nh_kinetic *kinetic, const nh_action *action,
                               const nh_options *options);

#endif
