/* embedding: constraints to a parametrization of the constraint submanifold.
 *
 *     v^s = rho^s(t, q, w),   w^1..w^n,   n = m - k          [docs/method.md, sec. 1], [CechMusilova2014, sec. 2.3]
 *
 * A chart is either the user's quasi-velocities, or the independent coordinate velocities with the dependent ones
 * eliminated: symbolically where the constraints are linear in them, otherwise they stay as implicit symbols u with
 * f(t, q, w, u) = 0, found by Newton's method at points and followed by the implicit function theorem in
 * derivatives. */
#ifndef NH_EMBEDDING_H
#define NH_EMBEDDING_H

#include "evaluate/tape.h"
#include "system/system.h"

typedef enum { NH_CHART_AUTO, NH_CHART_QUASI, NH_CHART_COORDINATES } nh_chart_choice;

/* A dependent velocity that is a root: v^s = alpha sqrt(base) + beta.  In printed formulas it stands for itself, as
   a symbol of its own. */
typedef struct {
    size_t coordinate;
    nh_ex base, symbol;  /* symbol: prints as the velocity does */
    nh_ex value, square; /* sqrt(base) and symbol^2 in terms of the symbol */
} nh_root;

typedef struct {
    const nh_system *system;
    nh_arena *arena;
    const char *name; /* "quasi-velocities (omega, v)" */
    bool quasi;
    size_t n, implicit;
    nh_ex *w;      /* n velocities of the chart */
    nh_ex *rho;    /* m: coordinate velocities as functions of (t, q, w, u) */
    nh_ex *framed; /* the same of the rates along the frame (system/orientation.h); NULL: there is none */
    /* k coordinate indices, coordinate charts only; those of implicit velocities, or of a root with two branches, come
       first */
    size_t *dependent;
    size_t *free;        /* n coordinate indices: whose velocities the w are, coordinate charts only */
    nh_ex *u, *residual; /* implicit velocities and the constraints that determine them */
    size_t width;        /* 1 + m + n + implicit: the point (t, q, w, u) */
    nh_ex *symbol;       /* width */
    double *low, *high;  /* width: sampling box */
    nh_tape *newton;     /* residual and d residual / d u; NULL when nothing is implicit */
    double *probe;       /* probes x width: a few points for pivots and ranks */
    size_t probes;
    int branch; /* of a quadratic constraint: the sign of its root; 0 otherwise */
    /* of that root, and the root in coordinate velocities: branch*(2 a u + b), valid on both branches */
    nh_ex radicand, root;
    size_t roots; /* dependent velocities that are roots; that of a quadratic constraint is the first */
    nh_root *root_of;
    double pivot; /* least pivot of the elimination over the probes, relative */
    /* the dependent velocities that the user had in mind are not determined anywhere near the domain: others were
       chosen */
    bool replaced;
    bool regular; /* of coordinate velocities: the dependent ones are determined at every point */
} nh_chart;

/* Nearer to a zero of its pivot the formulas of a chart of coordinate velocities lose too many digits. */
extern const double nh_chart_least_pivot;

/* NULL on failure; the message names the constraint and the rank. */
nh_chart *nh_chart_create(nh_system *system, nh_chart_choice choice, uint64_t seed, nh_error *error);
void nh_chart_free(nh_chart *chart);

/* Complete a point: solve for the implicit velocities, starting from those in z.  False when Newton's method fails. */
bool nh_chart_complete(const nh_chart *chart, double *z);

/* The sampling interval of any symbol of the system. */
void nh_chart_range(const nh_chart *chart, nh_ex symbol, double *low, double *high);
/* The unit of a coordinate, a velocity or the time: half the width of the interval that the system's author gives;
 * without one, 1. */
double nh_chart_symbol_unit(const nh_system *system, nh_ex symbol);
/* The unit of coordinate i, also of its velocity per unit of time, so that velocities of lengths and angles compare in
 * all units of length. */
double nh_chart_unit(const nh_system *system, size_t i);
/* The factors by which the entries of R (m x n, row-major) become numbers without units; 1 in quasi-velocities. */
void nh_chart_slopes(const nh_chart *chart, double *factor);

/* The chart's velocities as functions of (t, q, q'): w = (R^T R)^-1 R^T (v - rho(0)) where rho is affine in w.  False
 * where it is not (the caller says so). */
bool nh_chart_inverse(const nh_chart *chart, nh_ex *w_of_v);

/* An expression of a chart on one branch of a quadratic constraint, with the root written in coordinate velocities
 * again: it then holds on both branches. */
nh_ex nh_chart_both_branches(const nh_chart *chart, nh_ex e);

/* For printed formulas: a dependent velocity replaces a root that is equal to it.  The result contains the symbols of
 * the chart's roots, reduced by their squares. */
nh_ex nh_chart_shown(const nh_chart *chart, nh_ex e);
/* An expression from nh_chart_shown in t, q, q'. */
nh_ex nh_chart_in_velocities(const nh_chart *chart, nh_ex shown);
/* The same as an expression of another chart of the same velocities, on its branch. */
nh_ex nh_chart_composed(const nh_chart *chart, nh_ex shown, const nh_chart *other);
/* "z' < 0": where a chart with a branch is, or, with -chart->branch, where it is not.  The caller frees it. */
char *nh_chart_branch_name(const nh_chart *chart, int branch);

/* nh_pivot_score over the chart's probes (context: the chart). */
double nh_chart_pivot_score(void *chart, nh_ex e);

/* f^a = lhs - rhs in coordinate velocities, and composed with the embedding. */
nh_ex nh_chart_constraint(const nh_chart *chart, size_t a);
nh_ex nh_chart_compose(const nh_chart *chart, nh_ex e); /* v replaced by rho */

#endif
