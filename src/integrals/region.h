/* region: where does a current hold?
 *
 * A proof, or any number of digits, says that Gamma(Phi) = 0 wherever everything is smooth.  At a wall that motions
 * reach Phi may still jump: then it is one current on each side and no current of the whole motion.  Or Gamma(Phi) =
 * 0 on one side only, the side of the sampling box.  Decided at crossings: Phi in ball arithmetic nearer and nearer
 * to the wall on both sides (a difference that does not fall is a jump; what grows without bound is a pole, which no
 * motion with a finite Phi reaches), and Gamma(Phi) there.
 *
 * Where L itself jumps at a wall g(t, q) = 0 the equations of motion contain an impulse.  With velocities that go
 * through unchanged, d/dt p_s - dL/dq^s holds delta(g) times, up to a factor,
 *
 *     I_s = [p_s] dg/dt - [L] dg/dq^s,    [.]: the value above the wall minus that below.
 *
 * Only where I_s R^s_i = 0, and the constraints give the same velocities on both sides, [rho^s] = 0, does Gamma
 * describe the passage. At other walls no current of the sides is one of the whole motion.  The cut of an angle
 * atan2(y, x), and the like, is none of them: L goes on with the angle's next branch. */
#ifndef NH_REGION_H
#define NH_REGION_H

#include "integrals/crossings.h"

typedef enum { NH_REGION_ABOVE, NH_REGION_BELOW, NH_REGION_APART, NH_REGION_PARTS, NH_REGION_IMPULSE } nh_region_kind;

/* The walls at which a current ends or jumps. */
typedef struct {
    size_t count;
    nh_ex wall[NH_MOST_WALLS];
    /* holds where wall > 0; where wall < 0; on both sides, but jumps; in some parts of both sides; on both sides of an
     * impulse */
    nh_region_kind kind[NH_MOST_WALLS];
    bool unseen; /* and on one side of each further wall: there are more than the room holds (nh_walls.left_out) */
} nh_region;

/* The walls of the equations of motion, and where they are crossed: the same for all currents.  Belongs to the
 * arena. */
typedef struct {
    nh_walls walls;
    nh_crossings crossings;
    size_t impulses;
    nh_ex impulse[NH_MOST_WALLS]; /* walls at which the motion is not determined */
    nh_branch_end end;            /* where motions pass from the chart's branch to the other */
} nh_terrain;
nh_terrain nh_terrain_of(const nh_model *model, const nh_options *options, nh_arena *arena);

/* `digits`: to which Gamma(Phi) has to cancel where Phi holds; 0: it is known to vanish on all sides.  `sided`: it is
 * proved for the sides on which products of paired roots have their signs (nh_proof.sided), and holds there, if it does
 * not everywhere.  No walls in the result: Phi holds everywhere. */
nh_region nh_region_of(const nh_model *model, const nh_terrain *terrain, nh_ex phi, double digits, bool sided,
                       const nh_options *options, nh_arena *arena);

/* The walls of phi, without ends of roots, at which nothing could be decided: no motion of this chart was seen to cross
 * them, perhaps because the chart's velocities end there. phi is one function on each side. */
nh_region nh_region_open(const nh_model *model, const nh_terrain *terrain, nh_ex phi, const nh_options *options,
                         nh_arena *arena);

/* Does it hold until motions end?  They do at an impulse, which their equations do not determine. */
bool nh_region_to_the_end(const nh_region *region);

/* "for x > 0", "on each side of x - y = 0, where it jumps", "on each side of x = 0, where the motion has an impulse";
   "on one side of each further wall" (unseen); NULL for everywhere. */
const char *nh_region_text(nh_dag *dag, const nh_region *region, nh_arena *arena);

/* ---- pieces: on one side of each wall an expression is one smooth function ---- */

/* e with |u| and sign(u) as on the sides of their walls u = 0 on which the region lies (exact/walls.h). */
nh_ex nh_region_piece(const nh_model *model, const nh_region *region, nh_ex e);

/* The same on the sides on which the first probe of the chart lies.  The walls are added to `chosen` with these sides,
 * unless it is NULL; where u vanishes at the probe nothing changes. */
nh_ex nh_region_piece_at_probe(const nh_model *model, nh_ex e, nh_region *chosen);

/* Likewise sqrt(u^2 v) as u sqrt(v) or -u sqrt(v): modulo a prime the root of a square has two values, both among those
 * of the other functions; and the second of paired roots (geometry/model.h). */
nh_ex nh_region_roots_at_probe(const nh_model *model, nh_ex e, nh_region *chosen);

/* The sign of u at the probe by rigorous arithmetic, 0 where it is not known; the wall is added unless u is seen to
 * have this sign everywhere. */
int nh_region_sign_at_probe(const nh_model *model, nh_ex u, nh_region *chosen);

/* Does what holds in the region hold on the sides of the probe?  Not where it holds in some parts only. */
bool nh_region_has_probe(const nh_model *model, const nh_region *region);

#endif
