/* classify: at which values of one, two or three parameters does a system have more conservation laws than for almost
 * all?
 *
 * The system with all other parameters at their values is analysed at values without special meaning.  The search for
 * special values (classify/classify.h) knows the currents that are proved there for every value of the parameters.
 *
 * Special values are zeros of polynomials: values of one parameter, curves of two, surfaces of three.  At every value
 * that is rational the system is analysed with exactly this number in the parameter's place.  On curves and surfaces on
 * which one parameter is a rational function of the others the system is classified over these, and so it is on walls
 * of three parameters: what is special there and has more than all that it lies on is a place of its own. */
#ifndef NH_STUDY_CLASSIFY_H
#define NH_STUDY_CLASSIFY_H

#include "classify/classify.h"
#include "reduction/linear_questions.h"
#include "commands/analyze.h"

typedef struct {
    const char *command, *system_path;
    size_t settings;
    const nh_setting *setting;
    const char *over[NH_MOST_PARAMETERS]; /* names of the parameters; NULL behind the last one */
    bool shape;                           /* coefficients that do not depend on cyclic coordinates */
    nh_linear_question of;                /* what is classified: currents, or another question, of one parameter */
    nh_options options;
} nh_classify_request;

/* What was constructed somewhere. */
typedef struct {
    const nh_analysis *result; /* NULL: there is none, for this reason */
    const char *why;
    size_t count;        /* of its currents (nh_classified_current) that hold there: those with these indices, */
    const size_t *index; /* or the first ones where this is NULL */
    const char *shown;   /* for other questions than that of currents: what was found there; NULL */
    size_t complete;     /* the degree up to which all integrals are functions of these currents */
    size_t exact;        /* the degree up to which their products, or this finding, account for the number */
} nh_classified_finding;

/* A value, a curve or a surface with possibly more integrals, or a wall of three parameters. */
typedef struct {
    const nh_special_factor *polynomial;
    const nh_classify_special *special; /* NULL: a wall */
    int gives;                          /* this parameter is a function of the others */
    const char *graph;                  /* "B = 16*A"; NULL: it has no such form */
    struct nh_classified *within;       /* the classification over the others; NULL: there is none */
    nh_classified_finding finding;
} nh_classified_part;

/* A place that has more integrals than everything on which it lies. */
typedef struct {
    size_t dimension;            /* 0: a value or a point, 1: a curve, 2: a surface */
    nh_special_place zeros;      /* its equations */
    const char *where;           /* "eps = 1/3", "eps - 2 = 0", "B = 16*A, 3*eps - 16*A = 0" */
    const nh_special_factor *on; /* the curve, surface or wall on which it was found; NULL */
    /* of dimension 0, for each parameter: a rational number, or an equation; the number as a double, or NAN */
    const char *value[NH_MOST_PARAMETERS];
    double about[NH_MOST_PARAMETERS];
    size_t first;
    const nh_classify_number *number; /* by degree */
    nh_classified_finding finding;
} nh_classified_place;

struct nh_classified {
    nh_arena *arena;
    const char *name, *title;
    size_t parameters;
    const char *over[NH_MOST_PARAMETERS]; /* lambda, mu, nu: the request's names, the last one first */
    nh_analysis *almost_all;              /* the analysis at values without special meaning */
    size_t known, *currents;              /* the currents that hold for every value */
    size_t degree;                        /* the degree that the request asks for */
    bool shape;
    nh_classification *classification;
    size_t parts; /* one for each of its special values, and one for each wall of three parameters */
    nh_classified_part *part;
    size_t places, place_capacity; /* by dimension, the highest one first */
    nh_classified_place *place;
    size_t owned, owned_capacity; /* analyses at values */
    nh_analysis **own;
    nh_linear_question of;
    nh_linear_system *question; /* NULL: the question is about currents */
    size_t others, fixed;       /* number of other parameters; the first `fixed` have values, the others formulas */
    nh_setting *other;
    bool partial; /* the run ended before the classification was complete */
};

/* Classifies; the caller frees the result.  NULL with a message on bad input. */
nh_classified *nh_classify_system(const nh_classify_request *request, nh_error *error);
void nh_classified_free(nh_classified *classified);

/* The current of this index: first those that were found, then functions of them that are polynomial in the
 * velocities. */
const nh_current *nh_classified_current(const nh_analysis *analysis, size_t index);

/* ---- words, in the arena ---- */

/* The equation "eps - 2 = 0" of a polynomial in the parameters. */
const char *nh_classified_equation(const nh_classified *classified, const nh_special_factor *polynomial);
/* Of a polynomial in one parameter: "eps = 1/3", "C^2 - 3 = 0 (C = -1.7320508, 1.7320508)". */
const char *nh_classified_words(const nh_classified *classified, const nh_special_factor *polynomial);

#endif
