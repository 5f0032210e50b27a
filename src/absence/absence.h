/* absence: is there any other integral?  Particular motions, their normal equations, the groups of these, and what
 * follows.  [docs/method.md, "No other integral"] */
#ifndef NH_ABSENCE_H
#define NH_ABSENCE_H

#include "absence/darboux.h"
#include "absence/higher.h"
#include "absence/kovacic.h"
#include "absence/monodromy.h"
#include "absence/normal_equation.h"
#include "absence/residues.h"
#include "absence/resonance.h"
#include "search/analysis.h"

/* One plane at one level: what its engines say. */
typedef struct {
    nh_normal_equation *equation; /* its polynomials are cleared when the list is complete: read the texts */
    const char *p, *q;            /* of y'' + p y' + q y = 0 where the dimension is 2, as text; else NULL */
    nh_kovacic *kovacic;          /* or NULL: it does not apply, or was not run */
    nh_monodromy *monodromy;
    nh_residues *residues;
    nh_higher *higher;    /* or NULL: it does not apply, or the first order excludes all */
    size_t orbit;         /* e: certified dimension of an orbit of the group */
    bool rational;        /* an irregular point was used: only rational integrals are excluded */
    const char *obstacle; /* why the orbit is smaller than the dimension, or NULL */
} nh_absence_attempt;

/* NH_ABSENCE_NONE_ELSE: every integral of the class is a function of those found.  NH_ABSENCE_DEPENDENT: it depends on
 * them (some differentials vanish along the motion).  NH_ABSENCE_AT_MOST: there are at most `at_most` independent ones.
 * NH_ABSENCE_LIOUVILLE: not integrable by commuting integrals.  NH_ABSENCE_OPEN: nothing is excluded.
 * NH_ABSENCE_SETTLED: as many integrals are known as there can be. */
typedef enum {
    NH_ABSENCE_OPEN,
    NH_ABSENCE_NONE_ELSE,
    NH_ABSENCE_DEPENDENT,
    NH_ABSENCE_AT_MOST,
    NH_ABSENCE_LIOUVILLE,
    NH_ABSENCE_SETTLED
} nh_absence_verdict;

typedef struct nh_absence {
    nh_absence_verdict verdict;
    bool everything; /* all planes and engines were asked for */
    const nh_closed_shape *shape;
    size_t known;          /* independent integrals of the shape that are found and single-valued */
    size_t *known_current; /* their indices (nh_absence_current) */
    size_t many_valued;    /* found, but not used: many-valued, or in time */
    size_t at_most;        /* independent integrals of the class */
    bool rational;         /* the class: rational; else meromorphic */
    bool periodic;         /* with period 2 pi in the angles */
    bool generic;          /* so too for all parameters outside countably many hypersurfaces */
    size_t planes;         /* that were found */
    size_t attempts;
    nh_absence_attempt *attempt; /* each plane and level that was tried */
    size_t best;                 /* the attempt that decides; attempts: none does */
    nh_darboux *darboux;         /* or NULL */
    size_t resonances;
    nh_resonance **resonance;
    const char *obstacle; /* of NH_ABSENCE_OPEN: the first, in words */
    /* a refutation and an integral that is proved disagree: an error of the program; or NULL */
    const char *contradiction;
} nh_absence;

/* Fills analysis->absence.  `everything`: all planes, levels and engines; else what costs little.  Counted work decides
 * what costs little, never a clock. */
struct nh_analysis;
void nh_absence_find(struct nh_analysis *analysis, bool everything);
/* The current of this index: first those of the list, then functions of them that are polynomial in the velocities. */
const nh_current *nh_absence_current(const nh_analysis *analysis, size_t index);

#endif
