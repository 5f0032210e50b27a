/* count: how many integrals polynomial in the velocities a system has, and whether those that are known are all.
 *
 *     Phi = sum over |alpha| <= d of c_alpha(q) w^alpha   or c_alpha(t, q),    any functions c_alpha
 *
 * The number N of power series that solve Gamma(Phi) = 0 up to an order r, at a point and modulo a prime, is an upper
 * bound for the dimension of the space of integrals of degree d on every connected open set of regular points
 * (docs/method.md, sec. 10); products of known integrals that are linearly independent modulo the prime are a lower
 * one.  Where both are equal there are no others.
 *
 * Out of reach: velocities that are given implicitly, equations that are not polynomial in the velocities, functions
 * that are related in ways that a choice of residues does not follow.  Then there is an obstacle, and no number. */
#ifndef NH_COUNT_H
#define NH_COUNT_H

#include "count/adapted_frame.h"
#include "count/graded_solver.h"

enum { NH_COUNT_HIGHEST_DEGREE = 12 };

typedef struct {
    size_t degree;
    size_t bound;           /* N: with the constant 1 */
    size_t known;           /* independent products of known integrals of this degree at most, with 1 */
    /* of these, products of integrals of lower degree: bound - lower are new at this degree when it is complete */
    size_t lower;
    /* of the differentials of what the bound allows and of the known integrals of any degree, at a point modulo the
       prime */
    size_t rank;
    size_t known_rank;      /* of the latter alone */
    size_t order;           /* r */
    size_t reached;         /* the lowest order from which on N is the same */
    bool bounded;           /* the symbol was injective below this order: `bound` is one */
    bool settled;           /* N did not change over the last orders; otherwise more of them may lower it */
    bool complete;          /* bound == known: all are polynomials in the known ones */
    bool functions;         /* rank == known_rank: as far as this point tells, all are functions of the known ones */
} nh_count_row;

typedef struct {
    bool time;              /* coefficients may depend on t */
    bool generic;           /* for parameters that are algebraically independent, otherwise at the values given */
    size_t rows;
    nh_count_row row[NH_COUNT_HIGHEST_DEGREE]; /* of degrees 1, 2, .. */
    size_t step;            /* the largest weight: brackets of this length span everything */
    /* the first degree that is counted by the frequencies of linear equations: such rows are no bounds, but exact, with
       order 0; 0: none */
    size_t linear;
    size_t leaf;            /* coordinates across the leaves of integrable constraints */
    uint64_t prime;
    double work;            /* products of residues, about */
    /* "for x > 0 and y < 0": the equations are defined piece by piece, and were counted there; NULL: everywhere */
    const char *where;
    const char *obstacle;   /* why nothing was counted, or NULL */
    const char *end;        /* why no higher degree was counted, or NULL */
} nh_count;

/* Numbers of solutions, for further questions about the same system: other integrals are known then.  It saves time,
   and does not change an answer. */
typedef struct nh_count_memory nh_count_memory;
nh_count_memory *nh_count_memory_create(void);
void nh_count_memory_free(nh_count_memory *memory);

typedef struct {
    bool time, generic;
    /* coefficients do not depend on cyclic coordinates; known integrals that do are left out */
    bool shape;
    nh_count_memory *memory; /* NULL: none */
    size_t degree;          /* up to which; 0: as far as `work` goes */
    /* this degree only, until all are functions of the known ones: row[0]; products are not compared */
    bool alone;
    double work;            /* products of residues, about 5e8 a second */
    size_t known;
    const nh_ex *current;   /* integrals in t, q, w: what is not polynomial in the velocities is left out */
    /* how many of them are known to be, as functions; those with named functions are left out when residues show
       more */
    size_t independent;
} nh_count_question;

/* Products of integrals that are linearly dependent: exponents of the question's integrals, products of lower degree
   first, the last one the leading one. */
typedef struct {
    size_t terms;
    uint8_t *exponent;      /* terms x known */
} nh_count_relation;

/* Relations of at most this degree in the velocities, modulo a prime, among currents that are polynomials in the
 * velocities; without those that follow from leading products of before.  At most `most` are written into out; none
 * when there are too many products. */
size_t nh_count_relations(const nh_model *model, size_t known, const nh_ex *current, size_t degree, nh_arena *arena,
                          size_t most, nh_count_relation *out);

/* Where integrals are counted, for equations that are defined piece by piece: "for x > 0 and y < 0", on the sides on
   which the first probe of the chart lies; NULL: everywhere.  In the model's arena. */
const char *nh_count_where(const nh_model *model);

/* Behind the deadline (base/progress.h) what comes out is of no use. */
nh_count nh_count_integrals(const nh_model *model, const nh_count_question *question);

#endif
