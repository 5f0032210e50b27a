/* bodies: open chains (trees) of rigid bodies and joints [ChhabraEmami2014, sec. 3].
 *
 * A joint is a product of one-parameter displacements, its screws, q = exp(xi_1 s_1) exp(xi_2 s_2) ..., about or along
 * axes through the origin of the joint's frame; the body's frame is where that frame is taken by the joint.  So at s =
 * 0 body and joint frames coincide, and a pose is
 *
 *     pose(body) = pose(parent) placement exp(xi_1 s_1) exp(xi_2 s_2) ...
 *                                                                                            (the map F, eq. 3.21)
 *
 * A displacement s is a coordinate, or an expression in coordinates and t.  The metric in the rates s' of all screws is
 *
 *     S_kl = sum over bodies h(J_k, J_l),   kinetic energy = 1/2 S_kl s_k' s_l',
 *                                                                                                       (eq. 3.22)
 *
 * computed from the leaves to the root: with the composite inertia C of everything behind screw k, F = C xi_k, S_kk =
 * <xi_k, F>, and F carried towards the root gives S_jk = <xi_j, F> [Featherstone2008, ch. 6].  The potential is -g .
 * (first moment of everything), g the acceleration of gravity (eq. 3.23 with g pointing up). */
#ifndef NH_BODIES_H
#define NH_BODIES_H

#include "system/deck.h"
#include "base/memory.h"
#include "system/screw.h"

/* The table of the kinds of joints: identifier, word of the file, screws (0: as many as `axes`), a bit for each screw
 * that turns, endings of the names of its coordinates, its keys.  Screws along `axis` need nothing else; the axes of
 * others are in bodies_values.c. */
enum { NH_JOINT_AXIS = 1, NH_JOINT_AXES = 2, NH_JOINT_PITCH = 4, NH_JOINT_ANGLES = 8 };
#define NH_JOINT_TABLE(X)                                                                                              \
    X(FIXED, "fixed", 0, 0, "", 0)                                                                                     \
    X(REVOLUTE, "revolute", 1, 1, "", NH_JOINT_AXIS)                                                                   \
    X(PRISMATIC, "prismatic", 1, 0, "", NH_JOINT_AXIS)                                                                 \
    X(HELICAL, "helical", 1, 1, "", NH_JOINT_AXIS | NH_JOINT_PITCH)                                                    \
    X(CYLINDRICAL, "cylindrical", 2, 2, "sa", NH_JOINT_AXIS)                                                           \
    X(PLANAR, "planar", 3, 4, "xya", NH_JOINT_AXIS)                                                                    \
    X(SPHERICAL, "spherical", 3, 7, "abc", NH_JOINT_ANGLES)                                                            \
    X(FREE, "free", 6, 070, "xyzabc", NH_JOINT_ANGLES)                                                                 \
    X(TRANSLATION, "translation", 0, 0, "xyz", NH_JOINT_AXES)                                                          \
    X(SCHOENFLIES, "schoenflies", 4, 010, "xyza", NH_JOINT_AXIS)                                                       \
    X(TRANSLATING_SCREW, "translating-screw", 3, 4, "xya", NH_JOINT_AXIS | NH_JOINT_PITCH)

typedef enum {
#define X(kind, word, screws, turns, letters, keys) NH_JOINT_##kind,
    NH_JOINT_TABLE(X)
#undef X
        NH_JOINT_KINDS
} nh_joint_kind;

enum { NH_GROUND = -1, NH_MOST_SCREWS = 6 };

/* One degree of freedom of a joint, in the frame right after it (or right before it: a screw does not move its own
 * axis). */
typedef struct {
    bool turns;    /* a turn about the axis (with a pitch: a helical motion), else a translation along it */
    nh_ex axis[3]; /* unit vector */
    nh_ex pitch;   /* translation per radian */
    /* displacement, and its derivative with respect to t: a coordinate and its velocity, or expressions in them */
    nh_ex s, rate;
    long coordinate; /* index of the coordinate that s is; -1: s is an expression, or the turn an orientation's */
    /* of an orientation (system/orientation.h): three screws about the body's axes, the first of which makes the whole
     * turn */
    bool oriented;
    const nh_ex *matrix; /* NULL: it is the turn by s */
    nh_ex framed;        /* its rate; of an orientation in the symbols of angular velocities */
    double low, high;    /* its sampling interval, away from a pole of Euler's angles; both 0: the default */
} nh_screw;

typedef struct {
    const char *name, *doc;
    nh_joint_kind kind;
    long parent; /* index of a body, or NH_GROUND */
    size_t child;
    nh_pose placement;    /* of the joint's frame in the parent's frame */
    size_t screws, first; /* chain->screw[first .. first + screws - 1] */
    long orientation;     /* of its three turns (an index), or -1 */
    const nh_deck_node *node;
} nh_joint;

typedef struct {
    const char *name, *doc;
    size_t joint;                      /* index of the joint that carries it */
    nh_ex mass, center[3], inertia[9]; /* in the body's frame; the inertia about the centre of mass */
    nh_pose pose;                      /* of the body's frame in the ground's */
    nh_ex position[3];                 /* of the centre of mass */
    const nh_deck_node *node;
} nh_body;

typedef enum { NH_WHEEL_KNIFE_EDGE, NH_WHEEL_ROLLING } nh_wheel_kind;

typedef struct {
    const char *name;
    nh_wheel_kind kind;
    size_t body;
    long on;       /* the body whose surface it touches, or NH_GROUND */
    nh_ex at[3];   /* a point of the blade, or the centre of the wheel, in the body's frame */
    bool ball;     /* a ball that rolls without an axle */
    nh_ex axis[3]; /* unit vector: across the blade, or the axle; in the body's frame */
    nh_ex radius;
    int normal; /* of the surface: axis number in the frame of `on` */
    const nh_deck_node *node;
} nh_wheel;

typedef struct {
    size_t bodies, joints, screws, wheels;
    nh_body *body;
    nh_joint *joint;
    nh_screw *screw;
    nh_wheel *wheel;
    size_t *order; /* joints, from the root to the leaves */
    nh_ex gravity[3];
    nh_ex *metric; /* screws x screws: S_kl */
    nh_ex kinetic, potential;
    nh_ex framed; /* the kinetic energy in the symbols of angular velocities */
    size_t m;
    nh_ex *K; /* m x m: the metric in the coordinates' velocities, as far as the rates depend on these */
} nh_chain;

typedef struct {
    nh_dag *dag;
    nh_arena *arena;
    nh_ex t;
    size_t m;
    const nh_ex *q, *v; /* coordinates and velocities */
} nh_chain_scope;

/* Computes all that bodies, joints and gravity determine: rates, poses, positions, metric, energies, K.  `order` must
 * be set. */
void nh_chain_build(nh_chain *chain, const nh_chain_scope *scope);

/* The displacement of one screw; its twist xi. */
nh_pose nh_screw_pose(nh_dag *dag, const nh_screw *screw);
nh_twist nh_screw_twist(nh_dag *dag, const nh_screw *screw);

/* The frame of a body before the last `skip` screws of its joint: its pose in the ground's frame and its twist.  With
   skip = 0 the body itself. */
void nh_chain_frame(const nh_chain *chain, nh_dag *dag, long body, size_t skip, nh_pose *pose, nh_twist *twist);

/* The forces that hold all q'' at zero, gravity included: d/dt dL/dq' - dL/dq = K q'' + out (m) for L = kinetic -
 * potential. */
void nh_chain_bias(const nh_chain *chain, const nh_chain_scope *scope, nh_ex *out);

/* Of one body about the origin of its frame. */
nh_inertia nh_body_inertia(nh_dag *dag, const nh_body *body);

/* The conditions of a wheel, linear in the rates, as expressions that vanish: at most 3; returns how many.  level[k]:
 * the function whose rate condition k is (the height of the point of contact), or 0. */
size_t nh_wheel_conditions(const nh_chain *chain, nh_dag *dag, const nh_wheel *wheel, nh_ex out[3], nh_ex level[3]);

/* Of a rolling wheel: how high its lowest point is above its surface.  Does it turn about its own axle? */
nh_ex nh_wheel_height(const nh_chain *chain, nh_dag *dag, const nh_wheel *wheel);
bool nh_wheel_turns(const nh_chain *chain, nh_dag *dag, const nh_wheel *wheel);

#endif
