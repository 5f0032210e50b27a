/* symmetry_space: the constraint symmetries of the currents found as one linear space, and its special subspaces.
 *
 * Z(Phi) is linear in Phi, with Z(1) = Gamma/Lbar and Z(Phi Psi) = Phi Z(Psi) + Psi Z(Phi) - Phi Psi Gamma/Lbar.  That
 * Z is projectable, is of case 1, or has [Gamma, Z] in the canonical distribution, are linear conditions on Phi
 * (bracket.h): subspaces, found exactly (relation_space.h).  The rank of brackets bounds the number of
 * independent currents that fulfil one of the last two conditions at all (closure.h). */
#ifndef NH_SYMMETRY_SPACE_H
#define NH_SYMMETRY_SPACE_H

#include "base/option.h"
#include "exact/relation_space.h"
#include "integrals/bracket.h"
#include "geometry/closure.h"

typedef struct {
    const char *name;
    nh_ex phi;   /* in the chart of the model */
    bool energy; /* a multiple of the energy */
} nh_named_current;

/* Subspaces of the currents. */
typedef enum { NH_SPACE_BEST, NH_SPACE_CASE1, NH_SPACE_PROJECTABLE, NH_SPACE_INSIDE, NH_SPACES } nh_space_kind;

/* A current of the basis, and the properties of its field. */
typedef struct {
    nh_ex combination, phi; /* of the currents' names; of the currents */
    bool in[NH_SPACES];
    const nh_field *field; /* of a projectable one, simplified; else NULL */
} nh_space_member;

/* A bound for the number of currents of a kind: those that certain fields annihilate. */
typedef struct {
    nh_closure closure;
    /* independent currents of this kind that were found: currents, combinations of the basis, products of powers */
    size_t count;
    nh_ex *name; /* in terms of the currents' names */
} nh_space_bound;

typedef struct {
    const char *obstacle; /* the reason why the space was not found, or NULL */
    /* largest degree of a current in the velocities; currents of higher degree have no products */
    size_t degree;
    /* currents that have no products: of higher degree, or not polynomial in the velocities */
    size_t others;
    size_t left_out; /* products beyond the largest number */
    size_t dimension, of[NH_SPACES];
    bool sure;               /* these numbers are proved, for the products of the currents that were found */
    nh_space_member *member; /* dimension */
    nh_space_bound inside, case1;
    bool all_inside, all_case1; /* every current is of this kind: the conditions are identities */
    size_t counted; /* of all currents polynomial of this degree: an upper bound for their dimension, or 0 */
} nh_symmetry_space;

/* The currents are proved; in the arena.  `counted`: how many independent currents polynomial in the velocities, with
 * 1, of degree two there are at most; 0: not known.  `submanifold`: of the model that they are expressions of. */
nh_symmetry_space *nh_symmetry_space_of(nh_arena *arena, const nh_submanifold *submanifold, size_t count,
                                        const nh_named_current *current, size_t counted, const nh_options *options);

/* Relations among columns of functions on the velocity phase space, in the arena. */
nh_relation_space *nh_symmetry_space_relations(nh_arena *arena, const nh_model *model, const nh_options *options,
                                               size_t columns, size_t rows, const nh_ex *entry);

#endif
