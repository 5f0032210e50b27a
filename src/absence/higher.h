/* higher: logarithms of higher variational equations along a motion that is an elliptic function.
 *
 *     u'' = f(u, z),  z'' = g(u, z),  g(u, 0) = 0      of a Lagrangian with constant inertia and no forces
 *     Gamma: z = 0, u'^2 = sigma(u)                    sigma a cubic polynomial without double zero
 *
 * Gamma is a torus without one point O, where u has a pole; t is its coordinate.  Solutions near it are
 * u_0(t) + e u_1(t) + e^2 u_2(t) + .., e z_1(t) + e^2 z_2(t) + ..; the k-th variational equation is that of the first
 * k coefficients.  G_k: the closure of its monodromy in the group of k-jets.
 *
 * What is proved, in this order.
 * 1. The exponents -n, n + 1 of z_1 at O are whole: n (n + 1) is a rational number, compared exactly.
 * 2. G_1 is connected.  On the plane it is unipotent.  On the normal letters, where the determinant is 1, either
 *    a closed path of Gamma has a multiplier whose absolute value is not 1, in balls, so that G_1 contains C*, and is
 *    C* or triangular or SL(2), as the path around O is unipotent; or the equation of z_1 has a solution that is a
 *    polynomial in u, or u' times one, exactly, so that G_1 is unipotent there.
 * 3. G_k is connected, because the kernel of G_k -> G_1 is unipotent.
 * 4. At the same level, for values of the constants of lower orders that are p-integral, Laurent's series of order k
 *    has an obstruction that is not 0 modulo p.  All that the recursion divides by is prime to p, so the obstruction is
 *    not 0, and the loop around O, which is the commutator of two periods, moves the k-jets: G_k is not abelian.
 * 5. A further integral that is meromorphic near Gamma would make the Lie algebra of G_k abelian, for all k.
 * So every integral that is meromorphic near Gamma is a function of the energy.  Steps 3 to 5, and why there may be no
 * second point like O, are in docs/method.md, "No other integral", "Higher order".  That no logarithm is seen proves
 * nothing. */
#ifndef NH_HIGHER_H
#define NH_HIGHER_H

#include "absence/normal_equation.h"

enum { NH_HIGHER_ORDERS = 5 }; /* that are tried */

/* Why the group of the first order is connected. */
typedef enum { NH_HIGHER_UNKNOWN, NH_HIGHER_MULTIPLIER, NH_HIGHER_SOLUTION } nh_higher_connected;

typedef struct {
    bool applies;         /* the system and its motion are as above, with whole exponents; else only obstacle is set */
    bool refuted;         /* no integral but functions of the energy is meromorphic near the motion */
    const char *obstacle; /* why not, in words; NULL: refuted */
    slong exponent;       /* n >= 0: z_1 begins with t^-n or t^(n + 1) */
    unsigned order;       /* the first at which a logarithm is seen; 0: none up to NH_HIGHER_ORDERS */
    bool across;          /* in z; else in u */
    slong power;          /* of t, where the series cannot go on */
    ulong prime;          /* that shows it; not 0 where order is not 0 */
    nh_higher_connected connected;
    const char *multiplier; /* NH_HIGHER_MULTIPLIER: its absolute value, above 1, rounded; else NULL */
    const char *trace;      /* NH_HIGHER_MULTIPLIER: of the path's matrix, "re + im i" as balls; else NULL */
    long bits;              /* NH_HIGHER_MULTIPLIER: of the balls; else 0 */
    const char *solution;   /* NH_HIGHER_SOLUTION: of the normal equation, "y", "y'*(y^2 + 1)"; else NULL */
    bool generic;           /* so too for all values of the parameters outside countably many hypersurfaces */
} nh_higher;

/* Of the motion of an equation without obstacle; in the arena.  `everything`: with n up to 30 and balls of up to 256
 * bits, which can take a few tenths of a second; else with what takes some hundredths. */
nh_higher *nh_higher_of(nh_arena *arena, const nh_closed_shape *shape, const nh_normal_equation *equation,
                        bool everything);

#endif
