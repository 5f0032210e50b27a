/* stage_solver: one stage of the search: solve a linear problem and keep the new currents. */
#ifndef NH_STAGE_SOLVER_H
#define NH_STAGE_SOLVER_H

#include "integrals/dictionary.h"
#include "integrals/field_rows.h"
#include "integrals/reflection.h"
#include "search/counted.h"
#include "search/currents.h"

/* The state of the search. */
typedef struct {
    nh_analysis *r;
    nh_current_checker *bench;
    nh_dictionary words;
    nh_points *ranges;
    nh_reflections *reflections; /* made for the first large stage */
    nh_counted counted;          /* stages that the count makes superfluous are left out */
    /* the present stage has few columns for its purpose: it may have as many as any ansatz */
    bool wide;
    const nh_field_bases *fields; /* the present stage fits fields that are made of these; NULL: it fits currents */
    bool series;                  /* of the row with series: those with names were not enough */
} nh_stage_solver;

/* Points for the ranges of columns, and a current checker; no stages yet. */
bool nh_stage_solver_begin(nh_stage_solver *solver, nh_analysis *result, nh_error *error);
void nh_stage_solver_end(nh_stage_solver *solver);

/* A stage's linear problem, solved. */
typedef struct {
    nh_ansatz *ansatz;
    nh_points *fit;
    nh_nullspace *nullspace; /* NULL when something went wrong */
    size_t sectors;
    nh_limit limit; /* the reason why it was not solved: too large */
} nh_solved;

/* Is there nothing more to find, or no work or time left? */
bool nh_stage_solver_done(const nh_stage_solver *solver);

/* Solves the linear problem of these families, unless it has too many columns (in all, or in its largest part), or
 * needs more work than is left: then `limit` says so.  The caller clears the result. */
nh_solved nh_stage_solver_solve(nh_stage_solver *solver, size_t families, const nh_family *family);
void nh_solved_clear(nh_solved *solved);

/* An entry in the list of what was tried. */
nh_stage_record *nh_stage_solver_note(nh_stage_solver *solver, const char *name);
/* The number of new currents that a stage seems to give, and the largest of the null values that they come from
 * (`worst`; may be NULL).  The other one: whether there are any. */
size_t nh_stage_solver_news(nh_stage_solver *solver, size_t families, const nh_family *family, double *worst);
bool nh_stage_solver_promising(nh_stage_solver *solver, size_t families, const nh_family *family);
/* Solves the stage, keeps the new currents, and notes it in the list. */
void nh_stage_solver_stage(nh_stage_solver *solver, const char *name, size_t families, const nh_family *family);
/* Keeps one expression if it is new and its rate cancels in ball arithmetic.  Doubles may lose all digits of it, where
 * determinants of the constraints are small on parts of the domain.  Returns the number of independent currents that it
 * gives. */
size_t nh_stage_solver_certify(nh_stage_solver *solver, nh_ex e, const char *name);
/* The same of each of n, as one stage. */
void nh_stage_solver_certify_each(nh_stage_solver *solver, size_t n, const nh_ex *e, const char *name);

/* The antiderivative of f, a function of the variable and the parameters, by the signs that functions have at the
 * model's probes; `elliptic`: elliptic integrals are forms, too.  False: none was found. */
bool nh_stage_solver_integral(const nh_stage_solver *solver, nh_ex variable, nh_ex f, bool elliptic, nh_ex *F);

/* Exponentials and waves in t and in the coordinates, with rates from the pencil. */
void nh_rates_search(nh_stage_solver *solver);
/* Systems, or blocks of coordinates, whose equations of motion are linear with constant coefficients. */
void nh_linear_motion_search(nh_stage_solver *solver);
/* Are all equations of motion of this kind? */
bool nh_linear_motion_is(nh_stage_solver *solver);
/* The same of functions of the coordinates that have such equations. */
void nh_linear_motion_functions(nh_stage_solver *solver);
/* Fields with simple components, which are functions of t and q: constants, positions, harmonics, the system's
 * functions; products of these; linear in the velocities; times exponentials and waves with rates of a pencil. */
void nh_field_fit_simple(nh_stage_solver *solver);
void nh_field_fit_products(nh_stage_solver *solver);
void nh_field_fit_linear(nh_stage_solver *solver);
void nh_field_fit_rates(nh_stage_solver *solver);
/* The last for one base, of the currents of X_i, in t and in each coordinate (rates.c). */
void nh_rates_of_fields(nh_stage_solver *solver, const nh_family *base);
/* Canonical momenta times 1 and positions, and centres of mass. */
void nh_linear_fields_search(nh_stage_solver *solver);
/* Momenta of the isometries of the kinetic energy, whatever the coordinates, and their products. */
void nh_isometries_search(nh_stage_solver *solver);
/* Two coordinates q, their velocities v, and v' = C v + K q; matrices by columns. */
typedef struct {
    nh_ex q[2], v[2], C[4], K[4];
} nh_complex_pair;
/* Returns how many independent currents it finds. */
size_t nh_complex_pair_search(nh_stage_solver *solver, const nh_complex_pair *pair);
/* Two velocities that turn along one coordinate, without a potential. */
void nh_velocity_turn_search(nh_stage_solver *solver);
/* Integrals found, up to this degree, times 1, coordinates, t and antiderivatives of the system's functions; for degree
 * one also velocities times 1 and positions.  Has it found something? */
bool nh_primitives_search(nh_stage_solver *solver, bool time, size_t degree);
/* Currents polynomial in the velocities whose coefficients are functions of one coordinate or of t: functions that have
 * names, such as Bessel's; or, besides, power series, which are no closed form. */
void nh_stage_solver_named(nh_stage_solver *solver);
void nh_stage_solver_series(nh_stage_solver *solver);

#endif
