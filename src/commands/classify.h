/* classify: at which values of a parameter, or of two, does a system have more conservation laws than for almost all?
 *
 * The system with all other parameters at their values is analysed at a value of no importance: what is proved there
 * for every value of the parameter is known to the engine (classify/classify.h). At every special value that is
 * rational the system is analysed with exactly this number in the parameter's place.
 *
 * With two parameters the engine is classify/plane.h. The system is analysed at isolated points, and classified along
 * curves on which one parameter is a rational function of the other. With three it is classify/space.h; on surfaces on
 * which one parameter is a rational function of the others the system is classified over these. */
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
    const char *over, *second, *third; /* names of the parameters; NULL: there is no second, or no third one */
    bool shape;              /* coefficients that do not depend on cyclic coordinates */
    nh_linear_question of;   /* currents, or something else of one parameter */
    nh_options options;
} nh_classify_request;

/* What was found at one special value. */
typedef struct {
    nh_analysis *result;     /* NULL: there is none, because */
    const char *why;
    const char *shown;       /* what was found there, of other questions than that of currents; NULL */
    size_t complete;         /* the degree up to which they, or this, account for the number */
} nh_classified_value;

struct nh_classified {
    nh_arena *arena;
    const char *name, *title, *over, *second, *third; /* second, third: NULL, or another parameter that varies */
    nh_analysis *almost_all;   /* the analysis of the family */
    size_t known, *currents; /* those that hold for every value (nh_classified_current) */
    size_t degree;           /* that was asked for */
    bool shape;
    nh_classification *classification;
    nh_classified_value *value; /* of its values */
    nh_linear_question of;
    nh_linear_system *question; /* or NULL: of currents */
    size_t others, fixed;    /* other parameters: so many with values, then functions of the parameter */
    nh_setting *other;
    bool partial;            /* the run was ended before it was through */
};

nh_classified *nh_classify_system(const nh_classify_request *request, nh_error *error);
void nh_classified_free(nh_classified *classified);

/* What was found on one curve. */
typedef struct {
    const char *graph;       /* "eps = 2": this parameter as a function of the other; NULL: not of this form */
    bool upright;            /* it is that of the second name */
    nh_classified *along;    /* over the other parameter; NULL: there is none, because */
    const char *why;
    size_t complete;         /* the degree up to which its currents account for the number of integrals */
} nh_classified_curve;

/* A special point: isolated, or on a curve with more integrals than its other points. */
typedef struct {
    const char *value[2];    /* of both names of the plane: a rational number, or an equation */
    bool rational;           /* both are numbers, about: */
    double about[2];
    size_t first;
    const nh_classify_number *number; /* by degree */
    size_t curve;            /* on which; SIZE_MAX: isolated */
    const nh_special_factor *root; /* whose roots value[0] is, where it is isolated */
    const nh_classified_value *at; /* its analysis */
} nh_classified_point;

typedef struct {
    nh_classified *family;   /* without a classification */
    const char *over[2];     /* lambda and mu of the engine: the second name, then the first one */
    nh_plane *plane;
    nh_classified_curve *curve; /* of its curves */
    nh_classified_value *isolated; /* analyses at isolated points */
    size_t points;
    nh_classified_point *point;
    bool partial;
} nh_classified_plane;

/* Over both parameters. */
nh_classified_plane *nh_classify_plane_system(const nh_classify_request *request, nh_error *error);
void nh_classified_plane_free(nh_classified_plane *classified);

/* A surface on which there may be more: a special one, a cylinder over a curve of mu and nu, or a plane nu = a/b, as
 * the plane of the other two parameters. */
typedef struct {
    const nh_special_surface *polynomial;
    size_t surface;          /* of the space; SIZE_MAX: it is none of its surfaces */
    int v, other[2];         /* parameter v is a function of the others, those of the plane in this order */
    const char *graph;       /* "B = 16*A"; NULL: it is not of this form */
    nh_classified_plane *within; /* NULL: there is none, because */
    const char *why;
    size_t complete;         /* of a special one, as of a curve */
} nh_classified_part;

/* A curve that is special in a part, and has more than what it lies on. */
typedef struct {
    size_t part, index;      /* of the curves in its plane */
    const char *where;       /* "B = 16*A, 3*eps - 16*A = 0" */
} nh_classified_space_curve;

typedef struct {
    size_t part;
    const char *value[3];    /* of the names: a rational number, or an equation */
    double about[3];
    const nh_classified_point *at; /* in the plane of the part */
} nh_classified_space_point;

typedef struct {
    nh_classified *family;   /* without a classification */
    const char *over[3];     /* lambda, mu and nu of the engine: the third name, the second, the first */
    nh_space *space;
    size_t parts, curves, points;
    nh_classified_part *part;
    nh_classified_space_curve *curve;
    nh_classified_space_point *point;
    bool partial;
} nh_classified_space;

/* Over all three. */
nh_classified_space *nh_classify_space_system(const nh_classify_request *request, nh_error *error);
void nh_classified_space_free(nh_classified_space *classified);
/* "eps - 2 = 0" for a curve or surface of parameters of this family; in its arena. */
const char *nh_classified_surface_words(const nh_classified *family, const nh_special_surface *surface);

/* The current of this index, where those behind the currents found are functions of them that are polynomial in the
   velocities. */
const nh_current *nh_classified_current(const nh_analysis *analysis, size_t index);

/* "eps = 1/3", "C^2 - 3 = 0 (C = -1.7320508, 1.7320508)"; in the arena. */
const char *nh_classified_words(const nh_classified *classified, const nh_special_factor *polynomial);
/* The same for a parameter of this name. */
const char *nh_classified_values(const nh_classified *classified, const char *name,
                                 const nh_special_factor *polynomial);
/* Is it one rational number? */
bool nh_classified_rational(const nh_special_factor *polynomial, int64_t *top, int64_t *bottom);

#endif
