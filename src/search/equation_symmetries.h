/* equation_symmetries: fields that map motions to motions, and the currents S(Phi) that they give.
 *
 * A field S = S^0 d/dt + S^s d/dq^s + W^i d/dw^i is a symmetry of the equations of motion where
 *
 *     [Gamma, S] = Gamma(S^0) Gamma,
 *     Gamma(S^s) - rho^s Gamma(S^0) - (S^0 d/dt + S^r d/dq^r) rho^s = R^s_i W^i,
 *     Gamma(W^i) - a^i Gamma(S^0) - S(a^i) = 0,
 *
 * linear equations for the S^0(t, q), S^s(t, q) of a point symmetry, which is prolonged by W, or for the S^s(t, q, w)
 * of a dynamical one with S^0 = 0: others differ from such fields by multiples of Gamma.  They are solved exactly in an
 * ansatz (relation_space.h): monomials of the letters t, positions, and sines and cosines of angles, for a dynamical
 * symmetry times 1 or a velocity.  S(Phi) is a current with Phi. */
#ifndef NH_EQUATION_SYMMETRIES_H
#define NH_EQUATION_SYMMETRIES_H

#include "search/symmetry_space.h"

typedef struct {
    nh_ex time, *space; /* S^0; m: S^s */
    bool dynamical;
} nh_equation_symmetry;

typedef enum { NH_ACTION_UNDECIDED, NH_ACTION_DEPENDENT, NH_ACTION_INDEPENDENT } nh_action_answer;

/* S(Phi) for a current Phi: zero where it is not listed. */
typedef struct {
    size_t symmetry, current;
    nh_ex value;             /* S(Phi) */
    nh_ex combination;       /* in terms of the names in the basis of the space of currents; 0: S(Phi) is not in it */
    nh_action_answer answer; /* where it is not: does it depend on the currents? */
} nh_symmetry_action;

typedef struct {
    const char *obstacle; /* the reason why no symmetries were sought, or NULL */
    size_t letters, degree, columns;
    nh_ex *letter;
    bool sure; /* these are all symmetries in the ansatz: proved */
    /* numbers of either kind; dynamical ones that are no combinations of point symmetries, and of those times
     * currents */
    size_t points, dynamical;
    nh_equation_symmetry *item; /* points, then dynamical ones */
    size_t actions;
    nh_symmetry_action *action;
} nh_equation_symmetries;

/* In the arena.  `space`: of the same currents. */
nh_equation_symmetries *nh_equation_symmetries_of(nh_arena *arena, const nh_submanifold *submanifold, size_t count,
                                                  const nh_named_current *current, const nh_symmetry_space *space,
                                                  const nh_options *options);

#endif
