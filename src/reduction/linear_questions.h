/* linear_questions: what else can be asked of a family of systems, as linear equations for unknown functions
 * (classify/linear_family.h).
 *
 *     measure          is exp(sigma(q)) dq dw invariant?                     one function, a multiple of exp(sigma)
 *     hamiltonization  f K_li d_j f - K_lj d_i f = U_lij f on the shape space of a Chaplygin system: then th = -d log f
 *                      fulfils T^k_ij = th_j delta^k_i - th_i delta^k_j (chaplygin.h)               one function
 *     symmetries       L_xi K = 0, xi(V) = 0, L_xi a = 0, (L_xi omega)(X_i) = 0, (L_xi omega)(v0) + xi(b) = 0
 *                      (invariance.h)                                        components of xi
 *     constraints      eta(X) = 0 for all fields X in D^(j + 1) (geometry/growth.h), level j          components of eta
 *
 * A measure or a factor exists where the dimension is 1, and not where it is 0. */
#ifndef NH_LINEAR_QUESTIONS_H
#define NH_LINEAR_QUESTIONS_H

#include "base/option.h"
#include "classify/linear_family.h"
#include "reduction/kinetic.h"

#define NH_LINEAR_QUESTION_TABLE(X)                                                                                    \
    X(NH_OF_CURRENTS, currents)                                                                                        \
    X(NH_OF_MEASURE, measure)                                                                                          \
    X(NH_OF_HAMILTONIZATION, hamiltonization)                                                                          \
    X(NH_OF_SYMMETRIES, symmetries)                                                                                    \
    X(NH_OF_INTEGRABILITY, constraints)

typedef enum {
#define X(name, word) name,
    NH_LINEAR_QUESTION_TABLE(X)
#undef X
        NH_LINEAR_QUESTIONS
} nh_linear_question;

const char *nh_linear_question_name(nh_linear_question question);

typedef struct {
    nh_arena *arena;
    const char *obstacle; /* the reason why it cannot be asked, or NULL */
    nh_linear_family family;
    nh_kinetic *kinetic; /* or NULL */
    const char *group;   /* hamiltonization: what is divided out */
} nh_linear_system;

/* For a model whose parameters have arbitrary values: the equations hold for all values.  Not for the question of
 * currents. */
nh_linear_system *nh_linear_system_create(const nh_model *model, nh_linear_question question,
                                          const nh_options *options);
void nh_linear_system_free(nh_linear_system *system);

#endif
