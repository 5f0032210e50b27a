/* missing_internal: the construction of integrals that the count misses, for the parts of missing.c. */
#ifndef NH_MISSING_INTERNAL_H
#define NH_MISSING_INTERNAL_H

#include "count/construct.h"
#include "count/construct_rates.h"
#include "search/missing.h"
#include "search/stage_solver.h"

/* What is sought: also functions of the currents found; integrals of the shape alone; with many-valued functions. */
typedef struct {
    bool further, secular, weights;
    nh_count_shape shape;
    const nh_construct_rates *rates;
} nh_missing_manner;

/* A construction without anything new: a later one finds no more, because more currents are known then. */
typedef struct {
    nh_missing_manner how; /* without the rates, which the model, the degree and the time determine */
    bool time, rates, only, more, whole;
    bool recognised; /* all solutions, and those that are new are functions of the currents */
    size_t degree, solutions;
    double price, given, work;
} nh_missing_barren;

enum { NH_MISSING_MOST_BARREN = 128, NH_MISSING_MOST_REFUSED = 32 };

/* Terms that were tried: no integral could be made from them, or a function of the currents (`known`). */
typedef struct {
    size_t terms;
    const nh_ex *term;
    bool further, known;
} nh_missing_refused;

typedef struct {
    nh_stage_solver *solver;
    size_t barrens;
    nh_missing_barren barren[NH_MISSING_MOST_BARREN];
    size_t refusals;
    nh_missing_refused refused[NH_MISSING_MOST_REFUSED];
    unsigned stale;    /* bit k: currents were found after kind k was counted */
    size_t cyclic;     /* how often cyclic coordinates can be dropped */
    double work;       /* work that is left for this count */
    size_t solutions;  /* the most that series had for the coordinates at hand */
    size_t recognised; /* the most of which all were recognised */
    double covered;    /* up to this price words were tried for these coordinates */
} nh_missing_search;

/* How many currents may be proved: those in closed form, with room for more. */
size_t nh_missing_most_proved(const nh_analysis *r);

/* Tries one kind of coefficients; `further`: integrals that are functions of the currents, too.  Was one found? */
bool nh_missing_construct(nh_missing_search *search, const nh_completeness *c, bool further);

#endif
