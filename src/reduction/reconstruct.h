/* reconstruct: the full motion from a reduced one.
 *
 * The group element is written in coordinates of the second kind, g = exp(t_1 e_1) ... exp(t_d e_d), so that no group
 * coordinates are needed:
 *
 *     M(t) t' = Ad_g zeta,     column a of M: Ad of the first a - 1 factors on e_a,     Ad_exp(t_a e_a) = exp(t_a ad_a)
 *
 * and q = flow_1(t_1) o ... o flow_d(t_d) (sigma(x)); where the generators do not depend on x, q' = x'^i d_i + (Ad_g
 * zeta)^a e_a(q) instead.  Where M becomes singular, or large, the factors so far are kept and g starts again from the
 * identity; where the slice or the velocities will not do any more another chart of the atlas takes over. */
#ifndef NH_RECONSTRUCT_H
#define NH_RECONSTRUCT_H

#include "base/option.h"
#include "motion/method.h"
#include "reduction/atlas.h"

/* How a motion is computed. */
typedef struct {
    const nh_method *method; /* with error control; NULL: the one that suits (automatic.h) */
    double tolerance, steps; /* steps: at most */
    /* of nh_flow_options: errors relative to the sizes that states have along the motion; 0: all sizes 1 */
    double absolute;
    /* m: the least size of each coordinate, for its errors; NULL: from the motion */
    const double *place;
    /* largest work of the integration in units of base/effort.h: a motion that needs more is not complete; 0: no
     * limit */
    double effort;
} nh_reconstruct_how;

typedef struct {
    size_t count, m, size;   /* output times; coordinates; n + r */
    double *time, *q;        /* count; count x m (NULL without the group) */
    double *z;               /* count x (n + r): x and p along the motion, in the chart of that time */
    double *zeta;            /* count x d */
    double *energy;          /* count */
    double *energy_size;     /* count: the largest term of the energy so far, with which its drift is compared */
    size_t restarts;         /* of the coordinates of the group */
    size_t charts;           /* changes of the chart */
    size_t first_chart;      /* number of outputs before the first change of the chart */
    const nh_reduced *first; /* the equations of the first chart */
    bool complete;
    bool dependent; /* it ended where the constraints become dependent, and the equations do not continue */
    char note[256];
    long evaluations, steps;
    double effort, seconds; /* of the integration, without making charts */
} nh_reconstruction;

/* The reduced motion from z with g = identity, and the places it stands for.  `slice`: the group divided out, its
 * generators and its slice (whose x are those of `reduced`).  It ends where these become singular.  NULL with a
 * message. */
nh_reconstruction *nh_reconstruct(const nh_reduced *reduced, const nh_slice *slice, const double *z, size_t count,
                                  const double *times, const nh_reconstruct_how *how, nh_error *error);
/* The same from a place and its velocity through all charts that are needed; without the group only the reduced motion
   is computed. */
nh_reconstruction *nh_reconstruct_over(nh_atlas *atlas, const double *q, const double *v, bool group, size_t count,
                                       const double *times, const nh_reconstruct_how *how, nh_error *error);
void nh_reconstruction_free(nh_reconstruction *reconstruction);

#endif
