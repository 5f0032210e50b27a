/* reduced: equations of motion after a reduction, all of one form.
 *
 *     M(x) w = p,      x' = X(x) w,      p' = F(x, w),      zeta = Z(x) w
 *
 * x: shape; w: velocities (those of the shape, or quasi-velocities); p: their momenta; zeta: the body velocity of the
 * group that was divided out, by which the motion in the group is found again (reconstruct.h). */
#ifndef NH_REDUCED_H
#define NH_REDUCED_H

#include "motion/motion.h"
#include "reduction/slice.h"

/* Functions of x in a matrix (rows x columns, row-major) whose chosen columns, as many as rows, must stay
   independent. */
typedef struct {
    size_t rows, columns;
    nh_ex *e;
    size_t *chosen; /* rows */
    double *unit;   /* columns: makes lengths and angles comparable */
} nh_guard;

typedef struct {
    const nh_kinetic *kinetic;
    size_t n, r, d;        /* shape coordinates, velocities, dimension of the group divided out */
    nh_ex *x, *w;          /* symbols */
    const char **momentum; /* r names of the p */
    nh_ex *M;              /* r x r, row-major */
    nh_ex *dx, *F, *zeta;  /* n, r, d as functions of (x, w) */
    nh_ex energy;          /* of (x, w); of a master equation with affine constraints the moving energy */
    bool conservative;     /* it is conserved */
    bool plain;            /* M = 1: the p are the velocities w */
    bool timed;            /* the time t occurs */
    nh_ex t;
    /* Where F has no formula: writes its r values at (x, w); false where it cannot be computed.  NULL: F has one. */
    bool (*force)(void *context, double t, const double *x, const double *w, double *F);
    void *context;
    nh_guard guard[2]; /* of the constraints, and of the generators on the slice; rows 0: none */
} nh_reduced;

/* A new one with symbols for the velocities (names[i], or NULL for u1, u2, ...) and everything zero; memory: the
   kinetic's arena. */
void nh_reduced_init(nh_reduced *reduced, const nh_kinetic *kinetic, size_t n, const nh_ex *x, size_t r, size_t d);

/* The equations of the whole symmetric system on its slice, any group, any constraints affine in the velocities, L =
 * 1/2 v K v + a v - V, forces Q: with u = (x', zeta) = rho(x) w + c(x) and omf u + bf = 0, (pi, mu) = Kf u + af,
 *
 *     rho_i . (pi, mu)' = rho_i^j (1/2 u^T d_j Kf u + d_j af u - d_j V) + rho_i^b C_ab^k zeta^a mu_k + x'^j d_j rho_i .
 *     (pi, mu) + rho_i . Qf p_i = rho_i . Kf rho w,      of rho_i . (pi, mu) the part that depends on the velocities
 *
 * Hamel's equations in the frame (d/dx, e_a); docs/method.md, sec. 9.  `independent`: the r = m - f components of u
 * that serve as w. False when the others cannot be solved for. */
bool nh_reduced_master(nh_reduced *reduced, const nh_slice *slice, const size_t *independent, nh_error *error);
/* Adds the forces without a potential in the frame to `force` (m): Fr^T Q at u = (x', zeta). */
void nh_reduced_add_forces(const nh_slice *slice, const nh_ex *u, nh_ex *force);
/* Chooses the components of the frame that serve as w: the others' minor of omf is well conditioned; group components
 * are eliminated first. */
void nh_reduced_independent(const nh_slice *slice, size_t *independent);
/* The same for one place on the slice, lengths and angles in units of the metric. */
void nh_reduced_independent_at(const nh_slice *slice, const double *q, size_t *independent);

/* (x, p) from the frame components u (m) of a velocity: w are those of `independent`. */
bool nh_reduced_start(const nh_reduced *reduced, const double *x, const double *w, double *z);

/* z = (x, p); the rate, and zeta or the energy on demand. */
typedef struct nh_reduced_flow nh_reduced_flow;
/* Keeps the equations, which have to outlive it.  The caller frees it. */
nh_reduced_flow *nh_reduced_flow_create(const nh_reduced *reduced);
void nh_reduced_flow_free(nh_reduced_flow *flow);
/* Sets the time at which it is evaluated from now on (0 at first), where the time occurs. */
void nh_reduced_flow_time(nh_reduced_flow *flow, double t);
/* A motion ends where a guard changes sign: beyond a singularity of the slice or of the connection it would mean
 * nothing; or earlier, where its modulus falls below the limit that nh_reduced_flow_limit sets. */
nh_flow_problem nh_reduced_flow_problem(nh_reduced_flow *flow);
/* The two guards at x: the minor of the chosen columns over the root of the sum of the squares of all (between -1 and
 * 1; 1 where there is no matrix), less their limit; false when they are not finite. */
bool nh_reduced_flow_guards(nh_reduced_flow *flow, const double *x, double value[2]);
/* Sets the limits for a motion from x: `part` of the guards' values there, at most `most`.  Returns the smaller modulus
 * of the two guards; 0 when not finite. */
double nh_reduced_flow_limit(nh_reduced_flow *flow, const double *x, double part, double most);
/* Are the constraints themselves dependent at x, or nearly so? */
bool nh_reduced_flow_dependent(nh_reduced_flow *flow, const double *x);
/* For functions that make the equations: the matrices that must stay regular on a slice, its generators' minor and the
 * constraints' columns (f of them). */
void nh_reduced_guard_slice(nh_reduced *reduced, const nh_slice *slice);
void nh_reduced_guard_constraints(nh_reduced *reduced, const nh_slice *slice, const size_t *columns);
/* All at once at z: rate (n + r), w (r), zeta (d), energy; each may be NULL. */
bool nh_reduced_flow_at(nh_reduced_flow *flow, const double *z, double *rate, double *w, double *zeta, double *energy);
/* The largest of the terms of the energy where nh_reduced_flow_at was last. */
double nh_reduced_flow_energy_size(nh_reduced_flow *flow);

#endif
