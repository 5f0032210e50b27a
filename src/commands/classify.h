/* classify: at which values of a parameter, or of two, does a system have more conservation laws than for almost all?
 *
 * The system with all other parameters at their values is analysed at a value without special meaning.  The search for
 * special values (classify/classify.h) knows the currents that are proved there for every value of the parameter.  At
 * every special value that is rational the system is analysed with exactly this number in the parameter's place.
 *
 * With two parameters the search is that of classify/plane.h.  The system is analysed at isolated points, and
 * classified along curves on which one parameter is a rational function of the other.  With three it is that of
 * classify/space.h; on surfaces on which one parameter is a rational function of the others the system is classified
 * over these. */
#ifndef NH_STUDY_CLASSIFY_H
#define NH_STUDY_CLASSIFY_H

#include "classify/plane.h"
#include "classify/space.h"
#include "reduction/linear_questions.h"
#include "commands/analyze.h"

typedef struct {
    const char *command, *system_path;
    size_t settings;
    const nh_setting *setting;
    const char *over, *second, *third; /* names of the parameters; second and third may be NULL */
    bool shape;                        /* coefficients that do not depend on cyclic coordinates */
    nh_linear_question of;             /* what is classified: currents, or another question, of one parameter */
    nh_options options;
} nh_classify_request;

/* The analysis at one special value. */
typedef struct {
    nh_analysis *result; /* NULL: there is none, for this reason */
    const char *why;
    const char *shown; /* for other questions than that of currents: what was found there; NULL */
    size_t complete;   /* the degree up to which all integrals are functions of these currents */
    size_t exact;      /* the degree up to which their products, or this finding, account for the number */
} nh_classified_value;

struct nh_classified {
    nh_arena *arena;
    const char *name, *title, *over, *second, *third; /* second, third: NULL, or further parameters that vary */
    nh_analysis *almost_all;                          /* the analysis at a value without special meaning */
    size_t known, *currents; /* the currents that hold for every value (nh_classified_current) */
    size_t degree;           /* the degree that the request asks for */
    bool shape;
    nh_classification *classification;
    nh_classified_value *value; /* one for each of its values */
    nh_linear_question of;
    nh_linear_system *question; /* NULL: the question is about currents */
    size_t others, fixed;       /* number of other parameters; the first `fixed` have values, the others formulas */
    nh_setting *other;
    bool partial; /* the run ended before the classification was complete */
};

/* Classifies over one parameter; the caller frees the result.  NULL with a message on bad input. */
nh_classified *nh_classify_system(const nh_classify_request *request, nh_error *error);
void nh_classified_free(nh_classified *classified);

/* The classification on one curve. */
typedef struct {
    /* "eps = 2": this parameter as a function of the other; NULL: the curve has no such form */
    const char *graph;
    bool upright;         /* that parameter is the second name */
    nh_classified *along; /* the classification over the other parameter; NULL: there is none, for this reason */
    const char *why;
    size_t complete; /* the degree up to which its currents account for the number of integrals */
} nh_classified_curve;

/* A special point: isolated, or on a curve with more integrals than its other points. */
typedef struct {
    const char *value[2]; /* the values of both parameters: a rational number, or an equation */
    bool rational;        /* are both values numbers? */
    double about[2];      /* the values as doubles, if they are rational */
    size_t first;
    const nh_classify_number *number; /* by degree */
    size_t curve;                     /* the curve on which it lies; SIZE_MAX: it is isolated */
    const nh_special_factor *root;    /* if it is isolated: the factor of which value[0] is a root */
    const nh_classified_value *at;    /* its analysis */
} nh_classified_point;

typedef struct {
    nh_classified *family; /* the family without a classification */
    const char *over[2];   /* lambda and mu are the second name and the first one */
    nh_plane *plane;
    nh_classified_curve *curve;    /* one for each of its curves */
    nh_classified_value *isolated; /* one for each isolated point of `plane` */
    size_t points;
    nh_classified_point *point;
    bool partial;
} nh_classified_plane;

/* Classifies over both parameters; the caller frees the result.  NULL with a message on bad input. */
nh_classified_plane *nh_classify_plane_system(const nh_classify_request *request, nh_error *error);
void nh_classified_plane_free(nh_classified_plane *classified);

/* A surface with possibly more integrals: a special one, a cylinder over a curve of mu and nu, or a plane nu = a/b; it
 * is classified as the plane of two of the parameters. */
typedef struct {
    const nh_special_surface *polynomial;
    size_t surface;    /* index of the special surface; SIZE_MAX: none */
    int v, other[2];   /* parameter v is a function of the two others, which are those of `plane` in this order */
    const char *graph; /* "B = 16*A"; NULL: the surface has no such form */
    nh_classified_plane *within; /* NULL: there is none, for this reason */
    const char *why;
    size_t complete; /* for a special surface, as for a curve */
} nh_classified_part;

/* A curve that is special in a part and has more integrals than everything on which it lies. */
typedef struct {
    size_t part, index; /* index among the curves of its plane */
    const char *where;  /* "B = 16*A, 3*eps - 16*A = 0" */
} nh_classified_space_curve;

typedef struct {
    size_t part;
    const char *value[3]; /* the values of the three parameters: a rational number, or an equation */
    double about[3];
    const nh_classified_point *at; /* the point in the plane of the part */
} nh_classified_space_point;

typedef struct {
    nh_classified *family; /* the family without a classification */
    const char *over[3];   /* lambda, mu and nu are the third name, the second and the first */
    nh_space *space;
    size_t parts, curves, points;
    nh_classified_part *part;
    nh_classified_space_curve *curve;
    nh_classified_space_point *point;
    bool partial;
} nh_classified_space;

/* Classifies over all three parameters, likewise. */
nh_classified_space *nh_classify_space_system(const nh_classify_request *request, nh_error *error);
void nh_classified_space_free(nh_classified_space *classified);
/* The equation "eps - 2 = 0" of a curve or surface of parameters of this family; in its arena. */
const char *nh_classified_surface_words(const nh_classified *family, const nh_special_surface *surface);

/* The current of this index: first those that were found, then functions of them that are polynomial in the
 * velocities. */
const nh_current *nh_classified_current(const nh_analysis *analysis, size_t index);

/* "eps = 1/3", "C^2 - 3 = 0 (C = -1.7320508, 1.7320508)"; in the arena. */
const char *nh_classified_words(const nh_classified *classified, const nh_special_factor *polynomial);
/* The same for a parameter of this name. */
const char *nh_classified_values(const nh_classified *classified, const char *name,
                                 const nh_special_factor *polynomial);
/* Is it one rational number? */
bool nh_classified_rational(const nh_special_factor *polynomial, int64_t *top, int64_t *bottom);

#endif
