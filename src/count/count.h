/* count: how many integrals polynomial in the velocities a system has, and whether the known ones are all of them.
 *
 * Phi = sum over |alpha| <= d of c_alpha(q) w^alpha or c_alpha(t, q), with any functions c_alpha
 *
 * The number N of power series that solve Gamma(Phi) = 0 up to an order r, at a point and modulo a prime, is an upper
 * bound for the dimension of the space of integrals of degree d on every connected open set of regular points
 * (docs/method.md, sec. 10).  The number of products of known integrals that are linearly independent modulo the prime
 * is a lower bound.  Where the two agree there are no other integrals.
 *
 * Not covered: velocities that are given implicitly, equations that are not polynomial in the velocities, and functions
 * with relations that a choice of residues does not satisfy.  Then there is an obstacle, and no number. */
#ifndef NH_COUNT_H
#define NH_COUNT_H

#include "count/adapted_frame.h"
#include "count/graded_solver.h"

enum { NH_COUNT_HIGHEST_DEGREE = 12 };

typedef struct {
    size_t degree;
    size_t bound; /* N, the constant 1 included */
    size_t known; /* linearly independent products of known integrals of at most this degree, 1 included */
    /* how many of these are products of integrals of lower degree: bound - lower are new at this degree when it is
     * complete */
    size_t lower;
    /* rank, at a point modulo the prime, of the differentials of the solutions together with those of the known
     * integrals of any degree */
    size_t rank;
    size_t known_rank; /* rank of the known ones alone */
    size_t order;      /* r */
    size_t reached;    /* the lowest order from which on N does not change */
    bool bounded;      /* the symbol was injective below this order: `bound` is an upper bound */
    bool settled;      /* N did not change over the last orders; otherwise higher orders may lower it */
    bool complete;     /* bound == known: all are polynomials in the known ones */
    /* rank == known_rank: as far as this point tells, all integrals are functions of the known ones */
    bool functions;
} nh_count_row;

typedef struct {
    bool time;    /* coefficients may depend on t */
    bool generic; /* counted for algebraically independent parameters, otherwise for their given values */
    size_t rows;
    nh_count_row row[NH_COUNT_HIGHEST_DEGREE]; /* of degrees 1, 2, .. */
    size_t step;                               /* the largest weight: brackets of this length span everything */
    size_t weights; /* their sum over the coordinates: where it and `leaf` agree, so do all ranks of brackets */
    /* the first degree that is counted by the frequencies of linear equations; such rows are exact and not bounds, with
     * order 0; 0: none */
    size_t linear;
    size_t leaf;    /* coordinates across the leaves of integrable constraints */
    size_t without; /* so many coordinates were left out, because no integral of the last degree depends on them */
    const char *const *without_name;
    uint64_t prime;
    double work; /* work so far in products of residues, about */
    /* "for x > 0 and y < 0": the equations are defined piece by piece and were counted on this side; NULL:
     * everywhere */
    const char *where;
    const char *obstacle; /* why nothing was counted, or NULL */
    const char *end;      /* why no higher degree was counted, or NULL */
    bool more;            /* higher degrees were left out, because functions are missing */
} nh_count;

/* Keeps the solutions of a system for further questions about it with other known integrals, on any thread.  It saves
 * time, and does not change an answer. */
typedef struct nh_count_memory nh_count_memory;
nh_count_memory *nh_count_memory_create(void);
void nh_count_memory_free(nh_count_memory *memory);

/* The coordinates on which coefficients may depend.  Cyclic ones are those on which the equations do not depend.
 * Without their rates fewer equations are left, and more coordinates may be cyclic for these: the angle of a disk that
 * rolls enters the rates of its place alone. */
typedef enum { NH_EVERY_COORDINATE, NH_NOT_CYCLIC, NH_CLOSED_SHAPE } nh_count_shape;

typedef struct {
    bool time, generic;
    bool timeless;        /* nothing is counted where the equations depend on time: there are no rows */
    nh_count_shape shape; /* known integrals that depend on other coordinates are left out */
    size_t idle;          /* cyclic coordinates that are left out beside those of the shape */
    const nh_ex *idle_coordinate;
    nh_count_memory *memory; /* NULL: nothing is kept */
    size_t threads;          /* 0: one; the answer does not depend on it */
    size_t degree;           /* highest degree; 0: as high as `work` allows */
    /* counts this degree only, until all solutions are functions of the known integrals: row[0]; products are not
     * compared */
    bool alone;
    size_t until_missing; /* no degrees beyond the first one, from this one on, that misses functions; 0: all */
    double work;          /* limit in products of residues; about 5e8 take a second */
    double first_work;    /* the same until a degree has a bound at all, where it is larger */
    size_t known;
    /* known integrals in t, q, w; those that are not polynomial in the velocities are left out */
    const nh_ex *current;
    /* the number of functionally independent ones; integrals with named functions are left out when residues give
     * more */
    size_t independent;
} nh_count_question;

/* Linear relations among products of integrals: exponents of the question's integrals, products of lower degree first,
 * the leading one last. */
typedef struct {
    size_t terms;
    uint8_t *exponent; /* terms x known */
} nh_count_relation;

/* Finds the relations, modulo a prime and of at most this degree in the velocities, among currents that are polynomial
 * in the velocities, except those that follow from the leading products of earlier relations.  Writes at most `most`
 * into out; none when there are too many products. */
size_t nh_count_relations(const nh_model *model, size_t known, const nh_ex *current, size_t degree, nh_arena *arena,
                          size_t most, nh_count_relation *out);

/* Only what the brackets of the frame's fields give at a regular point: step, weights and leaf, or the obstacle.  There
 * are no rows. */
nh_count nh_count_brackets(const nh_model *model, const nh_count_question *question);

/* For equations that are defined piece by piece: where integrals are counted, as "for x > 0 and y < 0", on the sides on
 * which the chart's first probe lies; NULL: everywhere.  In the model's arena. */
const char *nh_count_where(const nh_model *model);

/* Counts.  After the deadline (base/progress.h) the result must not be used.  The caller frees it. */
nh_count nh_count_integrals(const nh_model *model, const nh_count_question *question);

#endif
