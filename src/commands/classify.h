/* classify: at which values of one parameter does a system have more conservation laws than for almost all?
 *
 * The system with all other parameters at their values is analysed at a value of no importance: what is proved there
 * for every value of the parameter is known to the engine (integrals/classify.h). At every special value that is
 * rational the system is analysed with exactly this number in the parameter's place. */
#ifndef NH_STUDY_CLASSIFY_H
#define NH_STUDY_CLASSIFY_H

#include "integrals/classify.h"
#include "commands/analyze.h"

typedef struct {
    const char *command, *system_path;
    size_t settings;
    const nh_setting *setting;
    const char *over;        /* the parameter's name */
    bool shape;              /* coefficients that do not depend on cyclic coordinates */
    nh_options options;
} nh_classify_request;

/* What was found at one special value. */
typedef struct {
    nh_analysis *result;     /* NULL: there is none, because */
    const char *why;
    size_t complete;         /* the degree up to which they account for the number of integrals */
} nh_classified_value;

struct nh_classified {
    nh_arena *arena;
    const char *name, *title, *over;
    nh_analysis *almost_all;   /* the analysis of the family */
    size_t known, *currents; /* of its currents those that hold for every value */
    size_t degree;           /* that was asked for */
    bool shape;
    nh_classification *classification;
    nh_classified_value *value; /* of its values */
    size_t others;           /* other parameters, with their values */
    nh_setting *other;
    bool partial;            /* the run was ended before it was through */
};

nh_classified *nh_classify_system(const nh_classify_request *request, nh_error *error);
void nh_classified_free(nh_classified *classified);

/* "eps = 1/3", "C^2 - 3 = 0 (C = -1.7320508, 1.7320508)"; in the arena. */
const char *nh_classified_words(const nh_classified *classified, const nh_special_factor *polynomial);
/* Is it one rational number? */
bool nh_classified_rational(const nh_special_factor *polynomial, int64_t *top, int64_t *bottom);

#endif
