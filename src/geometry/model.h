/* model: the geometry of a constrained system on its constraint submanifold.
 *
 *      (t, q, v)       all states, dimension 1 + 2m;      L, forces Q_s, constraints f^a
 *          ^
 *          |  v = rho(t, q, w)                            the chart, system/embedding.h
 *          |
 *      (t, q, w)       the constraint submanifold, dimension 1 + m + n, n = m - k;    X_0, X_i, Y_i and all below
 *          |
 *          v
 *       (t, q)         places and times
 *
 * With v = rho(t,q,w), R = d rho/dw and everything composed with the embedding [docs/method.md, sec. 2]:
 *
 *     p_s  = dL/dv^s                         momenta
 *     Lbar = L,  E = p_s rho^s - Lbar        constrained Lagrangian, energy
 *     alpha = p_s dq^s - E dt                pull-back of the Poincare-Cartan form
 *     X_0 = d/dt + rho^s d/dq^s,  X_i = R^s_i d/dq^s,  Y_i = d/dw^i        basis of the canonical distribution
 *     M_ij = Y_i(p_s) R^s_j                                  = -Bbar   [CechMusilova2014, eq. 9]
 *     A_i  = R^s_i (dL/dq^s + Q_s - X_0(p_s))                =  Abar   [CechMusilova2014, eq. 9]
 *     G_ij = X_i(p_s) R^s_j - X_j(p_s) R^s_i                           [CechMusilova2014, eq. 18]
 *     Gamma = X_0 + a^i Y_i,  M a = A                        constraint semispray [CechMusilova2014, eq. 21]
 *     c_s  = dL/dq^s + Q_s - Gamma(p_s) = mu_a df^a/dv^s     Chetaev multipliers   [CechMusilova2014, eq. 10]
 *
 * A model is constant after creation, but for G.  Threads share it: one that needs further expressions makes them in
 * a copy (nh_model_copy). */
#ifndef NH_MODEL_H
#define NH_MODEL_H

#include "exact/solve.h"
#include "system/embedding.h"

/* Square roots in the Lagrangian whose product has none.
 *
 *     sqrt(r + x) sqrt(r - x) = |y|,   r^2 = x^2 + y^2
 *
 * A normal form takes the two for independent, and modulo a prime each has two values.  Where y has one sign at all
 * probes of the chart, the second is y/sqrt(r + x) or -y/sqrt(r + x). */
typedef struct {
    nh_ex first, second; /* radicands */
    nh_ex product;       /* of the roots, but for its sign: y */
    int sign;            /* of the product at the probes */
} nh_paired_root;

typedef struct {
    nh_system *system;
    nh_chart *chart;
    nh_dag *dag;
    nh_arena *arena;
    size_t m, n, k;    /* coordinates, independent velocities, constraints */
    nh_ex *rho, *R;    /* m velocities; m x n, R[s*n + i] = d rho^s/dw^i */
    nh_ex *p, E, Lbar; /* m momenta; energy; constrained Lagrangian */
    /* rates, slopes and momenta along the frame (model_internal.h); those of the coordinates where there is none */
    bool framed;
    nh_ex *frame_rho, *frame_R, *frame_p;
    nh_ex *pbar;     /* n: p_s R^s_i, so that alpha(Z) = Lbar Z^0 + pbar_i zeta^i */
    nh_ex *M, *A;    /* mass matrix, n x n (row-major); forces, n: M w' = A */
    nh_ex *G;        /* n x n; call nh_model_G */
    nh_ex *a;        /* n: w' */
    nh_ex *mu;       /* k multipliers, of f^a = lhs - rhs as the user wrote them */
    nh_ex *nu;       /* k x m: df^a/dv^s composed; annihilates R */
    nh_ex *reaction; /* m: generalized force of the constraints on the bodies, -c_s */
    nh_lu *M_lu;
    size_t pairs; /* of roots in the Lagrangian */
    const nh_paired_root *pair;
    size_t width;           /* chart->width; points are (t, q, w, u) */
    const nh_ex *parameter; /* system->parameters symbols and values */
    const double *parameter_value;
} nh_model;

/* The geometry of a system in a chart.  The model owns the chart (the chart is freed on failure, too) and borrows the
 * system.  NULL with a message when M is singular on the submanifold. */
nh_model *nh_model_create(nh_system *system, nh_chart *chart, nh_error *error);
/* Only system, chart, rho and parameters, without any geometry: enough for motions with multipliers (nh_bordered). */
nh_model *nh_model_bare(nh_system *system, nh_chart *chart);
void nh_model_free(nh_model *model);

/* The same model in `dag`, a copy of its graph (nh_dag_copy): a thread derives there what it needs for a motion, while
 * others read the model.  Its expressions have the numbers that they have in `model`, which has to outlive it.  The
 * caller frees it by nh_model_copy_free, and the graph after it. */
nh_model *nh_model_copy(const nh_model *model, nh_dag *dag);
void nh_model_copy_free(nh_model *copy);

/* G, which is computed at the first call where the Lagrangian is long: its n m derivatives of momenta are most of the
 * model then, and no motion needs them. */
const nh_ex *nh_model_G(const nh_model *model);

/* The bodies and joints of a long Lagrangian, whose equations are computed by recursion, and the rest of the
 * Lagrangian; NULL for any other system. */
const nh_chain *nh_model_chain(const nh_model *model, nh_ex *rest);

/* Derivatives along the basis fields. */
nh_ex nh_model_X0(const nh_model *model, nh_ex e);
nh_ex nh_model_X(const nh_model *model, size_t i, nh_ex e);
nh_ex nh_model_Y(const nh_model *model, size_t i, nh_ex e);
nh_ex nh_model_gamma(const nh_model *model, nh_ex e);
/* Does e depend on parameters only: on no variable of the chart, nor on t? */
bool nh_model_is_constant(const nh_model *model, nh_ex e);
/* A product without its factors that do, and without its number; what is no product stays. */
nh_ex nh_model_without_constants(const nh_model *model, nh_ex e);

/* Omega(Z, X) for the basis fields, from the general formula
 *     Omega(A,B) = A(p_s) B^s - B(p_s) A^s - A(E) B^0 + B(E) A^0
 * (the closed forms M, A, G are tested against it).  A field has components time, space (m), velocity (n). */
typedef struct {
    nh_ex time, *space, *velocity; /* dt(Z), dq^s(Z), dw^i(Z) */
} nh_field;
/* The derivative of e along the field. */
nh_ex nh_model_along(const nh_model *model, const nh_field *field, nh_ex e);
nh_ex nh_model_omega(const nh_model *model, const nh_field *a, const nh_field *b);

/* Finds the paired roots: model->pairs. */
void nh_model_pair_roots(nh_model *model);
/* e with the second root of each pair written by the first. */
nh_ex nh_model_paired_roots(const nh_model *model, nh_ex e);

/* A tape that evaluates expressions at points (t, q, w, u), with the parameters bound; the caller frees it. */
nh_tape *nh_model_tape(const nh_model *model, size_t count, const nh_ex *out);
/* 1 or -1 where e, a function on the submanifold, has one sign at all probes of the chart; else 0. */
int nh_model_sign(const nh_model *model, nh_ex e);
/* The sign of e at the first probe by rigorous arithmetic, and that for all values of the chart's symbols; 0 where it
 * is not known. */
int nh_model_sign_at_probe(const nh_model *model, nh_ex e);
int nh_model_sign_everywhere(const nh_model *model, nh_ex e);

/* e with the parameters at their given values, decimals being the ratios that they are written as. */
nh_ex nh_model_values(const nh_model *model, nh_ex e);

/* The value of an expression of the parameters. */
double nh_model_number(const nh_model *model, nh_ex e);

/* An expression in coordinate velocities, rewritten in the velocities of the chart. */
nh_ex nh_model_compose(const nh_model *model, nh_ex e);

/* ---- has every independent velocity inertia? (model_regular.c) ---- */

/* For a model, bare or not: false where M is singular at every probe, with an error that names the directions without
 * inertia. */
bool nh_model_regular(const nh_model *model, nh_error *error);
/* Records that M is singular, with the directions without inertia; returns false. */
bool nh_model_singular(const nh_model *model, nh_error *error);

#endif
