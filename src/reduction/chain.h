/* chain: symmetries of the kinetic energy metric of an open chain, joint by joint [ChhabraEmami2014, sec. 4].
 *
 * Joint i moves its body by E_i in the displacement subgroup Q_i; a is in its Lie algebra, U the twist of the joint's
 * frame before the joint, F the momentum of all bodies behind it (both in the joint's frame), V and h the twist and the
 * inertia of the body itself.
 *
 *     first       a joint on the ground: every a, E_i -> g E_i
 *                 (theorem 4.1)
 *     AP1         a constant twist c of space whose copy Ad(pose before the joint)^-1 c stays in Lie(Q_i): all bodies
 *                 behind the joint are moved by
 *                 one displacement of space
 *     AP2         E_i -> g E_i:  <[a, U], F> = 0 for all positions and velocities                                  (eq.
 *                 4.27)
 *     extremity   E_i -> E_i g, nothing behind the body:  <[a, V], h V> = 0                                        (eq.
 *                 4.29, with ad)
 *
 * Each condition is linear in the coefficients of a (or c): its null space over random states, and the same relation
 * with the parameters as symbols, whose coefficients are expressions of these.  The last two are exact where their
 * conditions are; the caller proves the fields (they leave K invariant, but perhaps not the potential and the
 * constraints). */
#ifndef NH_REDUCTION_CHAIN_H
#define NH_REDUCTION_CHAIN_H

#include "system/system.h"

typedef enum { NH_CHAIN_FIRST, NH_CHAIN_AP1, NH_CHAIN_AP2, NH_CHAIN_EXTREMITY, NH_CHAIN_RULES } nh_chain_rule;

typedef struct {
    nh_chain_rule rule;
    size_t joint;     /* index in system->chain->joint */
    nh_ex *component; /* m: the infinitesimal generator along the coordinates */
} nh_chain_field;

typedef struct {
    nh_arena *arena;
    size_t joints;
    size_t *dimension; /* joints x NH_CHAIN_RULES: of each joint's algebra under each rule */
    /* one per dimension that was found; a field found by several rules occurs several times */
    size_t fields;
    nh_chain_field *field;
    double last_null, first_other; /* singular values on both sides of the cuts, over all of them */
} nh_chain_symmetries;

/* Leaves out joints whose displacement is not a coordinate of their own.  NULL with a message when the system has no
 * bodies. */
nh_chain_symmetries *nh_chain_symmetries_find(const nh_system *system, uint64_t seed, nh_error *error);
/* The fields of the first rule only; NULL when the system has no bodies. */
nh_chain_symmetries *nh_chain_first_joint(const nh_system *system);
void nh_chain_symmetries_free(nh_chain_symmetries *symmetries);

const char *nh_chain_rule_name(nh_chain_rule rule);

#endif
