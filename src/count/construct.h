/* construct: closed forms of integrals that the count predicts.
 *
 * The power series of the solutions of Gamma(Phi) = 0 (graded_solver.h) are continued to an order at which they have
 * more coefficients than there are words (closed_words.h).  Which combinations of the solutions have coefficients
 * c_alpha in the span of the words?  The remainder of every c_alpha modulo one echelon form of the words is linear in
 * the combination: its null space is what is recognised.  In the reduced echelon form with the most complex terms first
 * each row is a simple representative; rows whose differentials do not depend on those of the known integrals are new.
 *
 * All this holds modulo one prime and at one point.  It says of which terms an integral consists, and is no proof:
 * the caller has to solve for the coefficients of these terms and to prove the result. */
#ifndef NH_CONSTRUCT_H
#define NH_CONSTRUCT_H

#include "count/count.h"

typedef struct {
    bool time;            /* coefficients may depend on t */
    nh_count_shape shape; /* fewer coordinates allow longer series */
    /* an integral counts as new if it is no polynomial in the known ones, even if it is another function of them */
    bool further;
    const struct nh_construct_rates *rates; /* functions that words may contain beside the system's own, or NULL */
    /* solutions with one weight under a scaling of the equations at a time, where there are scalings: there are fewer
     * words of the weights that their coefficients have, and so dearer ones can be tried */
    bool weights;
    bool secular;  /* words may contain coordinates that occur only inside of functions */
    size_t degree; /* highest degree in the velocities */
    double price;  /* highest price of a word */
    size_t most_words;
    double work;    /* limit, in products of residues */
    size_t threads; /* 0: one */
    size_t known;
    const nh_ex *current;
    size_t independent; /* number of `current` */
} nh_construct_question;

typedef struct {
    size_t terms;
    nh_ex *term; /* a word times a monomial in the velocities, without coefficient; the most complex first */
} nh_constructed;

typedef struct {
    size_t solutions;             /* N */
    size_t words, order;          /* by weights: the most words of one weight */
    size_t dimension, recognised; /* how many solutions are looked at; how many of them are recognised */
    size_t count;
    nh_constructed *item; /* simplest first */
    bool limited;         /* stopped: there are too many words, or the work does not suffice */
    /* by weights: every solution is a sum of solutions with weights, and all letters have weights, so that without
     * weights no more is recognised in words of this price */
    bool whole;
    double work;
    nh_arena *arena;
} nh_construction;

/* Proposes the integrals that the count allows beyond the known ones, as lists of terms whose coefficients and proofs
 * are still to be found.  Never NULL; empty where the count cannot be made.  The caller frees it.  [docs/method.md,
 * sec. 10, "Construction"] */
nh_construction *nh_construct(const nh_model *model, const nh_construct_question *question);
void nh_construction_free(nh_construction *construction);

#endif
