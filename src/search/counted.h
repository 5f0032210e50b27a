/* counted: stages that the count makes superfluous.
 *
 * Where the differentials of all solutions of degree d, counted modulo a prime (count/count.h), depend on those of
 * the currents that are proved, no function of degree d in the velocities is new, whatever its coefficients are: a
 * stage whose ansatz has no others is left out.  Where nothing is counted (constraints and Lagrangians that are not
 * polynomial in the velocities, leaves of integrable constraints) all stages are run. */
#ifndef NH_COUNTED_H
#define NH_COUNTED_H

#include "integrals/ansatz.h"
#include "search/analysis.h"

/* What is known of degrees, for either kind of coefficients (count/completeness.h). */
typedef struct {
    nh_analysis *r;
    bool on;                               /* otherwise nothing is left out */
    size_t covered[NH_COMPLETENESS_KINDS]; /* up to this degree nothing is new */
    /* at this degree something may be new, or 0; how many currents there were */
    size_t open[NH_COMPLETENESS_KINDS], open_at[NH_COMPLETENESS_KINDS];
    size_t beyond[NH_COMPLETENESS_KINDS]; /* from this degree on nothing can be counted, or 0 */
} nh_counted;

/* Can nothing in these families be new?  `timely`: they will be multiplied by functions of t. */
bool nh_counted_superfluous(nh_counted *counted, size_t families, const nh_family *family, bool timely);

/* The degree in the velocities, at most; a function of a sum of products is not looked into: what is no polynomial as
   it is written has the degree infinity. */
double nh_counted_degree_of(const nh_model *model, nh_ex e);

/* The degree of an ansatz in the velocities, infinite where it is not polynomial in them; `timely` is set where it
   contains t. */
double nh_counted_degree(const nh_model *model, size_t families, const nh_family *family, bool *timely);

/* Does e depend on a velocity of the chart? */
bool nh_counted_has_velocities(const nh_model *model, nh_ex e);

/* Can nothing of this degree be new, with any functions of the coordinates, or of t and them? */
bool nh_counted_covers(nh_counted *counted, size_t degree, bool timely);

/* Is there a kink or a jump in the equations of motion? */
bool nh_counted_has_walls(const nh_model *model);

/* The currents that are proved, in closed form; out: room for all of them.  `general`: they hold for all parameters;
   `independent`: how many are. */
size_t nh_counted_proved(const nh_analysis *result, nh_ex *out, bool *general, size_t *independent);
/* Those that are constant in a region only, likewise; they are independent of each other and of the others. */
size_t nh_counted_regional(const nh_analysis *result, nh_ex *out, bool *general);

#endif
