/* atlas: the charts in which one reduced motion is computed, one after the other.
 *
 * The equations of a stage hold where the slice is transversal to the orbits and the constraints can be solved for the
 * velocities that are not among w.  Where one of the two fails, the motion continues on another slice through the
 * current position, or with other components of (x', zeta) as w.  For a Chaplygin group the equations with multipliers
 * eliminated by the connection are used as long as there is a connection; near a place where the orbits are tangent to
 * D the same reduced motion is described by quasi-velocities, with the equations of any group (reduced.h).  Neither
 * changes the group that is divided out.  The slice may be nearer to a singularity of the coordinates than the motion
 * itself: then it is moved along the orbits.  Of a second stage only the slice can be changed: it ends where the first
 * stage has no connection. */
#ifndef NH_ATLAS_H
#define NH_ATLAS_H

#include "reduction/second.h"

typedef struct {
    const nh_slice *slice;
    const nh_reduced *reduced;
    const size_t *independent; /* the components of u = (x', zeta) that are w; NULL for a second stage */
    const nh_second *second;   /* w = (x', zeta + Av x'); NULL for others */
    /* of a second stage without a connection: the slice of both groups, to whose frame `independent` belongs; NULL for
       others */
    const nh_slice *both;
    nh_reduced_flow *flow;
} nh_reduced_chart;

typedef struct nh_atlas nh_atlas;

/* Of a stage that divides out an action: as a Chaplygin system where possible, otherwise by the equations of any
 * group. */
nh_atlas *nh_atlas_create(const nh_action *action, bool chaplygin);
/* Of a second stage (initialised; its slice is not used).  `both`: the first group's generators, then those of the
   second on Q. */
nh_atlas *nh_atlas_create_second(const nh_second *second, const nh_action *both);
void nh_atlas_free(nh_atlas *atlas);

/* Charts that are known, the preferred first.  Slice and equations must outlive the atlas. */
void nh_atlas_add(nh_atlas *atlas, const nh_slice *slice, const nh_reduced *reduced, const size_t *independent,
                  const nh_second *second);
const nh_action *nh_atlas_action(const nh_atlas *atlas);
/* Motions start on this chart, wherever they start: their places are moved onto its slice.  Call after nh_atlas_add,
 * for the chart that was added last. */
void nh_atlas_prefer(nh_atlas *atlas);
/* The slice of the chart on which motions start; NULL where none was chosen. */
const nh_slice *nh_atlas_preferred(const nh_atlas *atlas);

/* A chart, known or new, that is regular at a place q with the velocity v (in the coordinates of the action's kinetic),
 * and the state z = (x, p) there.  NULL with a message where there is none. */
const nh_reduced_chart *nh_atlas_at(nh_atlas *atlas, const double *q, const double *v, double *z, nh_error *error);

/* The state z in the first chart that was added; false where that is singular. */
bool nh_atlas_start(const nh_atlas *atlas, const double *q, const double *v, double *z);

/* Makes a chart for a place at which the equations of a chart could not be integrated although its guards are far from
 * zero.  Linear systems are eliminated for this place.  Where the coordinates are nearly singular the place is moved
 * along its orbit: to exp(-moved_a e_a) q for one of the generators (moved: d values, all but one are zero),
 * differently in each attempt (from 0); from the second attempt on the slice that failed is avoided, too. q and v are
 * overwritten with the moved ones. */
const nh_reduced_chart *nh_atlas_renew(nh_atlas *atlas, const nh_reduced_chart *failed, size_t attempt, double *q,
                                       double *v, double *moved, double *z, nh_error *error);

/* The place on the slice and the velocity there of a state. */
bool nh_chart_leave(const nh_reduced_chart *chart, const double *z, double *q, double *v);

#endif
